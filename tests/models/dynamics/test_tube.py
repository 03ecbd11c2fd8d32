"""Tubes of every system enclose the motion computed to many digits; orbits are checked against them."""

from dataclasses import replace
from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
from pytest import approx, mark, raises

import oracle
from hess_mechanics import ProvedOrbit, solve, systems, tube
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics import functions as f
from support.thorough import sample


def assert_encloses(found, exact, digits):
    """The exact states, numbers with some more digits, lie in a tube that is narrower than one digit."""
    assert found.complete
    slack = Fraction(1, 10 ** (digits + 3))
    for values, intervals in zip(exact, found.states, strict=True):
        for value, one in zip(values, intervals, strict=True):
            assert one.low - slack <= Fraction(str(value)) <= one.high + slack
            # So narrow that one wrong digit would be seen.
            assert one.width < Fraction(1, 10**digits)


@mark.parametrize(
    ("name", "times", "digits"),
    [
        *((name, times, 20) for name, times in sample(product(systems(), ([0.3, 1.0], [-0.3, -1.0])), 2)),
        ("suslov", [-6.0, -12.0], 15),
        # Within the first step.
        ("hess", [0.01], 100),
        # In 5e-324 a rate of size 1 moves the start by as much.
        ("suslov", [0.0, 5e-324], 18),
    ],
)
def test_the_motion_to_more_digits_lies_in_its_tube(name, times, digits):
    system = systems()[name]
    exact = oracle.orbit_in_decimals(system, *system.example, times, digits + 30)
    found = tube(*system.example_motion, times, digits)
    assert_encloses(found, exact, digits)
    assert found.to_pandas().iloc[0, 1] == float(found.states[0][0].low)


def test_an_orbit_is_judged():
    system = systems()["suslov"]
    state, parameters = system.example
    times = np.linspace(0.0, 3.0, 7)
    found = tube(system.at(parameters), state, times)
    fine, rough = (solve(system.at(parameters), state, times, name) for name in ("reference", "draft"))
    truth = np.array([[float((one.low + one.high) / 2) for one in row] for row in found.states])
    for orbit in (fine, rough):
        proved = ProvedOrbit(orbit, found)
        known = np.max(np.abs(orbit.states - truth))
        assert proved.least - 1e-15 <= known <= proved.largest + 1e-15
        assert proved.least <= orbit.error_estimate
    assert ProvedOrbit(fine, found, 1e-12).valid_until == 3.0
    bounds, away = ProvedOrbit(rough, found).bounds, np.abs(rough.states - truth)
    assert np.all(away <= bounds + 1e-15)
    assert np.all(bounds <= away + 1e-15)
    # A sample moved by 1e-6: right before it, and not after.
    moved = fine.states.copy()
    moved[4, 2] += 1e-6
    wrong = ProvedOrbit(replace(fine, states=moved), found, 1e-7)
    assert wrong.valid_until == times[3]
    assert (wrong.least, wrong.largest) == approx((1e-6, 1e-6), rel=1e-6)


def test_a_tube_ends_where_the_work_does():
    system = systems()["hess"]
    found = tube(*system.example_motion, [0.1, 0.5, 50.0], most_work=2e5)
    assert (found.complete, found.reached_work_limit) == (False, True)
    assert found.times.tolist() == [0.1, 0.5]
    assert len(found.states) == 2
    more = tube(*system.example_motion, [0.1, 0.5, 3.0], most_work=1e6)
    assert more.complete and not more.reached_work_limit
    # Before the first of its times: nothing is proved.
    none = tube(*system.example_motion, [50.0], most_work=1e3)
    judged = ProvedOrbit(solve(*system.example_motion, [50.0], "draft"), none, 1.0)
    assert judged.bounds.shape == (0, 5)
    assert judged.valid_until == 0.0
    assert np.isnan([judged.least, judged.largest]).all()


def test_a_divisor_that_vanishes_ahead_ends_a_tube_and_raises_nothing():
    """ẋ = −1, ẏ = x (1/x): the Taylor series of x and y end after two terms, so nothing in them warns of x = 0."""
    system = System("divides", lambda y, p: (-1 + 0 * y[0], y[0] * (1 / y[0])), "x y", example=(1.0, 0.0))
    found = tube(*system.example_motion, [0.25, 0.5, 2.0], digits=9)
    assert found.times.tolist() == [0.25, 0.5]
    assert not found.complete
    for t, (x, y) in zip(found.times, found.states, strict=True):
        assert Fraction(1 - t) in x
        assert Fraction(t) in y
    # If it vanishes at the start there is no first step.
    assert tube(system.at(()), (0.0, 0.0), [0.5], digits=15).states == ()


def every_function(y, p):
    """A field with all functions: of variables, of parameters, of functions."""
    x, z = y
    return (
        f.sin(z) * f.exp(-(x**2)) + f.tanh(z) - 2 ** f.sin(x) * f.tan(z / 9) / 3,
        f.atan2(x, 1 + z**2) - f.log(2 + f.cos(x)) + (1 + x**2) ** p[0] * f.cosh(z / 3) / 5 - f.asin(f.tanh(x) / 2)
        + f.atan(z) - f.acos(x / 9) * f.sqrt(p[0]) + f.sinh(z / 7) - (2 + f.sin(z)) ** f.cos(x),
    )  # fmt: skip


def test_functions_in_a_field_have_tubes_too():
    """By mpmath's own Taylor series."""
    system = System("every function", every_function, "x z", {"a": 0.3}, example=(0.4, 0.3))
    with mpmath.workdps(26):
        start, p = ([mpmath.mpf(x) for x in values] for values in system.example)
        exact = mpmath.odefun(lambda _, y: every_function(y, p), 0, start)(0.02)
        assert_encloses(tube(*system.example_motion, [0.02], digits=20), [exact], 20)


def test_before_a_narrow_pulse_an_integral_smaller_than_any_double_is_enclosed():
    system = System("pulse", lambda y, p: (1.0 + 0.0 * y[0], f.exp(-p[0] * (y[0] - 1.0) ** 2)), "x z", {"c": 1e6})
    found = tube(system.at((1e6,)), (0.0, 0.0), [0.5], digits=18)
    ((_, before),) = found.states
    # To leading order in 1/c, z = exp(−c/4)/c = 10^−108579.6.
    assert before.low <= Fraction(1, 10**108580)
    assert Fraction(1, 10**108579) <= before.high < Fraction(1, 10**300)
    assert "E-" in repr(before)


def test_what_has_no_tube_is_refused():
    system = systems()["hess"]
    for words, said in ((([0.1, -0.1],), "increasing times from 0 on"), (([1.0], 0), "from 1 to 100")):
        with raises(InvalidParameter, match=said):
            tube(*system.example_motion, *words)
    other = systems()["suslov"]
    orbit = solve(*other.example_motion, [0.1], "draft")
    with raises(InvalidParameter, match="differ in their system"):
        ProvedOrbit(orbit, tube(*system.example_motion, [0.1]))
