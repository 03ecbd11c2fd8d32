"""The numbers in the lessons on locking, on scattering and on two layers, computed; see `support.numbers`."""

import math
from functools import cache

import numpy as np

from hess_mechanics import HeavyBody, circle_map, level, scattering
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from support.lesson_on_constraints import free_body
from support.numbers import DIGITS
from support.rotation_number import displacement

PRECISE = level("precise")


def torus(values):
    return circle_map(values["I23"] / values["I22"], values["h"], values["f"], PRECISE)


def here(step):
    return torus(step.state.values)


def then(step):
    return step.prediction.outcome.values


def a_of(step):
    return step.state.values["I23"] / step.state.values["I22"]


def crossings(values):
    """Return how often the graph of the circle map crosses the diagonal."""
    phases = np.linspace(-math.pi, math.pi, 20_000)
    off = displacement(values["I23"] / values["I22"], values["h"], values["f"])(phases)
    return int(np.sum(np.diff(np.sign(off)) != 0.0))


@cache
def birth(I22=0.96, I23=0.28, f=0.6):
    """Return the energy at which the graph touches the diagonal, and the trace there, up to its rounding."""
    low, high = 0.5, 1.5
    for _ in range(30):
        middle = 0.5 * (low + high)
        met = crossings({"I22": I22, "I23": I23, "h": middle, "f": f})
        low, high = (low, middle) if met else (middle, high)
    return high, (circle_map(I23 / I22, high, f, PRECISE).trace, 1e-4)


def threshold(_step):
    """Return the trace from which on there are two fixed points."""
    return birth()[1:]


def turned(step, **changes):
    """Return the angle χ through which the passage turns ξ, in degrees."""
    return math.degrees(math.acos(scattering(free_body({**step.state.values, **changes}), PRECISE).cos_chi))


def outgoing(step):
    found = scattering(free_body(step.state.values), PRECISE).theta_plus(
        step.state.values["theta"], np.linspace(0, 7, 20001)
    )
    return float(found.min()), float(found.max())


def on_the_wall(step):
    """Return the circle map of the Hess manifold of a heavy body."""
    one = step.state.values
    body = Bridge.of_heavy(HeavyBody.hess((one["I1"], one["I2"], one["I3"]), one["m"])).hess
    a1 = 1.0 / one["I2"]
    return circle_map(body.a, a1 * one["h"] / body.b, a1 * one["f"] / math.sqrt(body.b), PRECISE)


def lost(step):
    """Return 10 to the digits of a double, its logarithm, and the exponent of a return on the wall."""
    scale = 10.0 ** round(DIGITS)
    return scale, math.log(scale), on_the_wall(step).fixed_points[1].log_multiplier


ROWS = {
    "limit-cycles-and-locking": {
        "−0.3959 turns": lambda s: (here(s).rotation_number,),
        "If it is more than 2, there are exactly two fixed points": lambda s: (
            *threshold(s),
            crossings({**s.state.values, "h": 1.5}),
        ),
        "Here the trace is 1.0187": lambda s: (here(s).trace,),
        "φ = −2.187, it is 0.232": lambda s: (
            torus(then(s)).fixed_points[0].phi,
            torus(then(s)).fixed_points[0].multiplier,
        ),
        "multipliers is 1:": lambda s: (math.exp(sum(one.log_multiplier for one in here(s).fixed_points)),),
        "At h = 1.076 the curve touches, and the trace is 2": lambda s: birth(
            *(s.state.values[name] for name in ("I22", "I23", "f"))
        ),
        "locked at 0, and there are two cycles": lambda s: (here(s).rotation_number, crossings(s.state.values)),
        # The trace on the bifurcation curve, 2cos(π√(n²(1+a²)−a²)/√(1+3n²)), is 2 where n²(1+a²) = a².
        "$a$ is 0.2917, so that is $n_3$ = 0.28, at the energy h = 1.366": lambda s: (
            a_of(s),
            a_of(s) / math.hypot(1.0, a_of(s)),
            (1 - 2 * a_of(s) ** 2) / (2 * a_of(s) * math.hypot(1.0, a_of(s))),
        ),
        "For $a$ = 0.3 that is 6.586": lambda s: (a_of(s), here(s).fixed_points[1].multiplier),
        "where the trace tends to 0. Every orbit closes after two": lambda s: (
            here(s).trace,
            # The map is conjugate to a rotation by ρ.
            abs(1.0 / here(s).rotation_number),
        ),
        "in this family only at 0": lambda s: (circle_map(0.5, 1.5, 0.6, PRECISE).rotation_number,),
        "With $a$ = 3 the contraction is strong: one swing leaves 1.5·10⁻⁸": lambda s: (
            a_of(s),
            here(s).fixed_points[0].multiplier,
        ),
        "about 535": lambda s: (circle_map(1.0, 1.5, 1e-9, PRECISE).fixed_points[1].multiplier,),
    },
    "scattering-by-a-nonholonomic-top": {
        "between 1.013 and 2.129": outgoing,
        "$\\chi$ = 148.0°": lambda s: (turned(s),),
        "to its opposite, $\\chi=180°$": lambda s: (turned(s, k=1.0),),
        "With $I_{23}$ = 0.4 the angle is already 175.5°": lambda s: (
            0.5 * s.state.values["I23"],
            turned(s, I23=0.5 * s.state.values["I23"]),
        ),
    },
    "two-chaotic-layers-that-never-mix": {
        "exceeds 2, there are two limit cycles. Here $|a|$ is 0.5 and |trace| is 4.904": lambda s: (
            *threshold(s),
            len(on_the_wall(s).fixed_points),
            abs(on_the_wall(s).a),
            on_the_wall(s).trace,
        ),
        "a factor of 22.0": lambda s: (on_the_wall(s).fixed_points[1].multiplier,),
        "The logarithm of 10¹⁶ is 36.8, and the exponent is 3.091": lost,
        "gone after 12": lambda s: (math.ceil(lost(s)[1] / lost(s)[2]),),
        "Less than 2; it is 1.124. There": lambda s: (*threshold(s), on_the_wall(s).trace),
        "for this body 3.1416": lambda s: (on_the_wall(s).fixed_points[1].log_multiplier,),
        "which is 23.14": lambda s: (on_the_wall(s).fixed_points[1].multiplier,),
    },
}
"""A phrase of each lesson → the function that computes the numbers in it from the step."""
