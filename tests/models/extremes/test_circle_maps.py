"""Circle maps and rotation numbers at extreme parameters, against closed forms and orbits with many digits."""

from functools import partial
from math import exp, hypot

import numpy as np
from pytest import mark, param

import oracle
from hess_mechanics import circle_map, f_max
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.extremes import assert_promised
from support.mechanics import apart

PHASES = np.linspace(-3.0, 3.1, 14)
BOTTOM = -1 + 1e-12


def trace_error(found, log_trace):
    """Relative where the trace exceeds 1; of its logarithm where it exceeds double range."""
    if log_trace > 700:
        return abs(found.log_trace / log_trace - 1)
    trace = exp(log_trace)
    return abs(found.trace - trace) / max(1.0, trace)


def torus(name, a, h, f, truth, floor=0.0):
    return param((a, h, f), partial(truth, a, h, f), floor, id=name)


def by_orbits(name, a, h, f, digits=40, **options):
    return torus(name, a, h, f, partial(oracle.map_by_three_orbits, digits=digits), **options)


def vanishing(name, a, h, f):
    return torus(name, a, h, f, oracle.map_of_vanishing_f)


TORI = [
    vanishing("f = 1e-300", 0.5, 1.5, 1e-300),
    # The last place of h is f times 1e84: no digit of Θ is known.
    vanishing("f = 1e-100, h = 1", 0.5, 1.0, 1e-100),
    by_orbits("f = 1e-12", 0.5, 1.5, 1e-12, digits=60),
    # The last place of f_max − f = 1e-12 f moves the turning points by 5e-11.
    by_orbits("f = f_max (1 − 1e-12)", 0.5, 0.3, f_max(0.3) * (1 - 1e-12), floor=1e-10),
    vanishing("h = −1 + 1e-12, f = 0", 0.5, BOTTOM, 0.0),
    by_orbits("h = −1 + 1e-12, f = f_max/2", 0.5, BOTTOM, 0.5 * f_max(BOTTOM)),
    vanishing("h = 1 + 1e-12, f = 0", 0.5, 1 + 1e-12, 0.0),
    by_orbits("h = 1 + 1e-12, f = 1e-12", 0.5, 1 + 1e-12, 1e-12, digits=60),
    by_orbits("h = 1 − 1e-9, f = −1e-3", 0.5, 1 - 1e-9, -1e-3),
    by_orbits("h = 1e8, f = 0.9 f_max", 0.5, 1e8, 0.9 * f_max(1e8)),
    by_orbits("a = 0", 0.0, 1.5, 0.6),
    # |α| = 7e7 cancels to a trace of 6e-4, and |α| = 1e40 to 0.
    by_orbits("a = 10, f = 1e-12", 10.0, 0.3, 1e-12, digits=75, floor=1e-7),
    vanishing("a = 50, f = 0", 50.0, 0.3, 0.0),
]
WITHOUT_DIGITS = {(0.5, 1.0, 1e-100), (10.0, 0.3, 1e-12), (50.0, 0.3, 0.0)}
"""Tori whose map may report that a double does not hold it."""


@mark.parametrize(("torus", "truth", "floor"), TORI)
def test_a_circle_map_and_its_rotation_number_are_right(torus, truth, floor):
    """In Θ on its graph (where it is steep an error of Θ is one of φ), the trace, ρ and the kind."""
    exact = truth()
    theta, slope = (np.array([f(phi) for phi in PHASES]) for f in (exact.theta, exact.slope))
    half = exp(min(exact.log_trace, 1.0)) / 2
    # Maps of rotation numbers leave out what is next to the separatrix.
    in_maps = hypot(torus[1] - 1, torus[2]) > 1e-9

    def error(name):
        found, values = circle_map(*torus, name), values_at(*torus, name)
        assert values.possible[0] == in_maps
        rho, locked = [found.rotation_number], [found.kind == "hyperbolic"]
        if in_maps:
            rho, locked = [*rho, values.rho[0]], [*locked, values.locked[0]]
        # An elliptic map turns by arccos(t/2), whichever whole turns are added.
        turned = np.abs(np.abs(np.cos(np.pi * np.array(rho))) - min(1.0, half))
        wrong = abs(half - 1) > 1e-3 and any(one != (half > 1) for one in locked)
        off = np.max(apart(found.theta(PHASES), theta) / np.maximum(1.0, slope))
        return max(off, trace_error(found, exact.log_trace), turned.max(), float(wrong))

    def admitted(name):
        found = circle_map(*torus, name)
        return found.status is not Status.OK and found.error_estimate >= min(0.1, error(name) / 10)

    assert_promised(error, floor, admitted if torus in WITHOUT_DIGITS else lambda name: False)


@mark.parametrize("torus", [(50.0, 1e8, 1e4), (1e4, 1.5, 0.6), (100.0, 1.5, 0.6)])
def test_a_strongly_attracting_cycle_is_that_of_fourier_collocation(torus):
    phi, log_trace = oracle.stable_cycle(*torus)

    def error(name):
        found, values = circle_map(*torus, name), values_at(*torus, name)
        stable, unstable = found.fixed_points
        # Everything but a neighbourhood of the unstable cycle, too small for a double, falls onto the stable one.
        places = [stable.phi, -unstable.phi, *found.theta([0.0, 1.0, -1.0, 3.0])]
        off = abs(unstable.log_multiplier / (2 * log_trace) - 1)
        return max(off, *apart(places, phi), trace_error(found, log_trace), 1.0 - values.locked[0])

    assert_promised(error)
