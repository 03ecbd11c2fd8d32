"""The numbers in the lesson "How do we know?", computed."""

import math
import sys

import numpy as np

from hess_explorer.lessons import shipped
from hess_explorer.scenes import scenes
from hess_mechanics import circle_map, level, lyapunov_spectrum
from hess_mechanics.dynamics import work_precision
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.suslov import free
from support.deviations import deviations
from support.lesson_on_constraints import free_body
from support.moved import from_moved_starts

NAME = "how-do-we-know"
STEPS = {step.title: step for step in shipped()[NAME].steps}
DIGITS = -math.log10(sys.float_info.epsilon)
"""The digits of a double, 15.7."""


def moved_growth(values, of):
    """Decimal logarithms of the late "errors" or "pixels" of each level, from sixteen starts moved by a few ulps."""
    found = from_moved_starts(lambda: getattr(growth(values), of))
    return {name: [math.log10(one[name][-20:].max()) for one in found] for name in LEVELS}


def growth(values):
    """Errors and drifts of the motion of a state of "Speed and accuracy", at every level."""
    scene = next(one for one in scenes().values() if one.origin and set(values) == {spec.name for spec in one.specs})
    motion = scene.of(values).precision.followed
    return work_precision.growth(*motion.named, motion.weights, 400)


def bought_by_a_digit(_step):
    """10, the time that a digit buys, the digits of a double, and a time at which no level is right to a pixel."""
    state = scenes()["orbit-diagram"].of(STEPS["What is a picture of chaos worth?"].at.values)
    section = state.poincare
    starts = section.spread(section.window, 16)
    units = math.log(10.0) / np.array([lyapunov_spectrum(state.body, start, 8000.0).values[0] for start in starts])
    assert deviations(units, 14.0) > 5.0 > -5.0 > deviations(units, 18.0)
    values = STEPS["Chaos eats digits"].prediction.then.values | {"span": 300.0}
    for found in moved_growth(values, "pixels").values():
        assert deviations(found, 0.0) > 5.0
    return 10.0, 16.0, round(DIGITS), 300.0


def passage(step):
    """ω(t) of the state that is revealed."""
    values = step.prediction.then.values
    return free.passage(free_body(values), (values["w1"], values["w2"]))


def left(step):
    """The logarithm of 10³⁰⁰, 10³⁰⁰, and the time of the passage."""
    found = passage(step)
    assert found.rate == 1.0
    return math.log(10.0) * 300.0, 10.0, 300.0, -found.u0 / found.rate


def trace(step):
    values = step.at.values
    found = circle_map(values["I23"] / values["I22"], values["h"], values["f"], level("precise"))
    assert found.trace > 2.0
    return 2.0, len(found.fixed_points), 2.0


ROWS = {
    "about 16 digits of": lambda s: (round(DIGITS),),
    # Two doubles for a number.
    "with 31 digits": lambda s: (math.floor(2.0 * 53.0 * math.log10(2.0)),),
    "the four\n**levels": lambda s: (len(LEVELS),),
    "up to $t$ = 240, too": lambda s: tuple({s.at.values["span"], s.prediction.then.values["span"]}),
    "$\\ln 10/\\lambda$. For this body that is about 16 units. With its 16 digits the computer\n"
    "is lost long before $t$ = 300": bought_by_a_digit,
    "$\\omega_1$ = −2. The": lambda s: (s.at.values["w1"],),
    "$\\omega_1$ = 2 and $\\omega_2=10^{-300}$": lambda s: (
        s.prediction.then.values["w1"],
        10.0,
        -math.log10(s.prediction.then.values["w2"]),
    ),
    "up to $t$ = 400\nand sees": lambda s: (0.5 * s.at.values["span"],),
    "up to $t$ = 800.": lambda s: (s.prediction.then.values["span"],),
    "$e^{691}$ is $10^{300}$:\nthe body leaves at $t$ = 692.6": left,
    "Up to $t$ = 12 one": lambda s: (s.animation.start,),
    "*exactly two cycles*": lambda s: (trace(s)[1],),
    "more than 2, and there are two. The interval lies above 2": trace,
    "exactly two limit cycles": lambda s: (trace(s)[1],),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
