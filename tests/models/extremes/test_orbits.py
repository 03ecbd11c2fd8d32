"""Orbits at extreme parameters and states: within the promise of each level of a closed form or a Taylor series."""

from math import cos, pi, sin, sqrt

import numpy as np
from pytest import mark, param, raises

import oracle
from hess_mechanics import HeavyBody, solve, systems
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from support.andoyer import GESS1
from support.extremes import BARRIER, UPRIGHT, assert_promised, off

HESS, SUSLOV, BALL = (systems()[name] for name in ("hess", "suslov", "ball"))
UP = (0.6, 0.0, 0.8)
START = (0.8, -0.4, *UP)
FIELD = (0.3, -0.5, 1.0)
TENSOR, LONG, SMALL = (2.0, 1.0, 0.3, 0.5), (1e6, 1.0, 0.3, 200.0), (1.0, 1e-6, 3e-7, 5e-4)
BOTTOM = -1 + 1e-12
HEAVY_UP = (0.36, 0.48, 0.8)
HEAVY_START = (1.3, -2.0, 0.7, *HEAVY_UP)
SADDLE = 1e-11
"""A saddle amplifies the rounding of the start by e^t."""


def motion(name, body, start, times, truth=None, digits=36, floor=0.0, unit=None):
    """Return a case whose truth is by default a Taylor series with this many digits."""

    def series():
        return oracle.orbit_in_decimals(body.system, start, body.parameters, times, digits)

    return param(body, start, times, truth or series, floor, unit, id=f"{body.system.name}: {name}")


def hess(name, start, times, a=0.5, **options):
    return motion(name, HESS.at((a, 1.0)), start, times, **options)


def suslov(name, start, times, tensor=TENSOR, **options):
    return motion(name, SUSLOV.at((*tensor, *FIELD)), start, times, **options)


def ball(name, start, times, D=2.0, tensor=TENSOR, b=FIELD, **options):
    return motion(name, BALL.at((*tensor, D, *b)), start, times, **options)


def pendulum(name, a, h, times, phi=0.4, b=1.0, **options):
    """Return a motion with f = 0 from n3 = 1; the times are in units of 1/√b."""
    root, fast = sqrt(b), 2 * sqrt((h + 1) / 2)
    units = np.array([root, root, 1, 1, 1])
    start = np.array([fast * sin(phi), fast * cos(phi), 0.0, 0.0, 1.0]) * units

    def truth():
        return oracle.pendulum(a, h, phi, times) * units

    return motion(name, HESS.at((a, b)), start, np.asarray(times) / root, truth, **options)


def at_rest(body, state, time):
    return motion("at rest", body, state, [time], lambda: np.array([state]), unit=1.0)


MOTIONS = [
    pendulum("separatrix, h = 1 exactly", 0.5, 1.0, [1.0, 5.0, 10.0], phi=pi / 2),
    hess("separatrix, φ = 0.4", (2 * sin(0.4), 2 * cos(0.4), 0.0, 0.0, 1.0), [1.0, 5.0, 10.0], floor=SADDLE),
    # Of h − 1 = 2e-9 a double keeps 7 digits, and with it of the time that the passage takes.
    hess("separatrix grazed, h = 1 + 2e-9", (2 + 1e-9, 0.0, 0.0, 0.0, 1.0), [1.0, 12.0, 24.0], floor=1e-6),
    hess("separatrix grazed, h = 1, f = 1e-6", (2.0, 0.0, 5e-7, 0.0, 1.0), [1.0, 8.0, 16.0], floor=100 * SADDLE),
    pendulum("h = −1 + 1e-12", 0.5, BOTTOM, [1.0, 10.0, 100.0], unit=1.0),
    pendulum("h = 1e8", 0.5, 1e8, [1e-5, 1e-4, 1e-2]),
    # The last place of the start changes the period, 1e3/2π times over.
    pendulum("b = 1e-6, t = 1e6", 0.5, 0.3, [1e2, 1e3], b=1e-6, floor=1e-11),
    pendulum("a = 1e4", 1e4, 1.5, [0.001, 0.01, 0.1]),
    hess("a = 0", (0.3, 0.9, *UP), [1.0, 5.0, 20.0], a=0.0),
    at_rest(HESS.at((0.75, 1.0)), (0.0, 0.0, 0.0, 0.0, 1.0), 1e6),
    # ω2 may come to √(2E/I22).
    suslov("I11/I22 = 1e6, all energy in ω1", (1.0, 0.0, *UP), [0.1, 1.0], LONG, unit=1000.0),
    # ω1 changes by 1/ratio: the unit of time is √ratio times too short.
    suslov("I11/I22 = 0.99e20", (1.0, 0.5, *UP), [1.0, 5.0], (0.99e20, 1.0, 0.3, 0.5), digits=25),
    suslov("I22 = 1e-6", (0.1, 10.0, *UP), [0.001, 0.02], SMALL),
    ball("𝒟 = 1e-6", START, [1.0, 5.0, 20.0], D=1e-6),
    ball("𝒟 = 1e6", START, [1.0, 5.0, 20.0], D=1e6),
    # The energy allows ω = √(2E/I22) for γ along ω.
    ball("𝒟 = 1e6, γ3 = 0", (0.8, -0.4, 0.6, 0.8, 0.0), [1.0, 5.0], D=1e6, unit=880.0),
    ball("on the line", (1.0, 0.0, *UP), [1.0, 20.0], D=1.0, tensor=(2.0, 1.0, 0.0, 1.0), b=(0.0, 0.0, 0.0)),
    # The rounding of the start grows twenty-fold in each period of n3.
    motion(
        "1e-9 above the Hess manifold",
        GESS1,
        AndoyerSection(GESS1, 50.0, 5.0).state_at(0.7, BARRIER + 1e-9),
        [0.5, 2.0],
        digits=40,
        floor=1e-11,
    ),
    motion("h at the bottom", UPRIGHT, (1e-5, -5e-6, 0.0, 0.0, 0.0, 1.0), [1.0, 30.0], digits=40, unit=1.0),
    at_rest(UPRIGHT, (0.0, 0.0, 0.0, 0.0, 0.0, -1.0), 1e4),
    motion(
        "moments 1e6, 1, 1e-6",
        HeavyBody.hess((1e6, 1.0, 1e-6), 9.975),
        (1e3, 1.0, 1e-4, *HEAVY_UP),
        [1e-5, 3e-4],
        digits=40,
    ),
    motion("μ|r| = 1e6", HeavyBody.hess((1.0, 0.625, 0.375), 1e6), HEAVY_START, [1e-3, 1e-2], digits=40),
]


@mark.parametrize(("body", "start", "times", "truth", "floor", "unit"), MOTIONS)
def test_an_orbit_is_where_its_level_promises(body, start, times, truth, floor, unit):
    exact = truth()
    assert_promised(lambda name: off(solve(body, start, times, name).states, exact, unit), floor)


def test_moments_so_different_that_the_unit_of_time_says_nothing_are_refused():
    with raises(InvalidParameter, match=r"choose a ratio of at most 1e\+20\."):
        solve(SUSLOV.at((1.01e20, 1.0, 0.3, 0.5, *FIELD)), START, [1.0])
