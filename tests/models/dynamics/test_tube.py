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

TIMES = [0.0, 0.3, 1.0]


@mark.parametrize(("name", "sign"), sample(product(sorted(systems()), (1, -1)), 2))
def test_the_motion_to_thirty_digits_lies_in_its_tube(name, sign):
    """By mpmath's own Taylor series of the plain field."""
    system = systems()[name]
    state, parameters = system.example
    found = tube(system.at(parameters), state, [sign * t for t in TIMES], digits=20)
    assert found.complete
    assert found.width < 1e-20
    assert [one.low for one in found.states[0]] == [Fraction(x) for x in state]
    with mpmath.workdps(30):
        start, p = ([mpmath.mpf(x) for x in some] for some in (state, parameters))
        solution = mpmath.odefun(lambda _, y: [sign * rate for rate in system.field(y, p)], 0, start)
        for t, intervals in zip(TIMES, found.states, strict=True):
            for x, one in zip(solution(mpmath.mpf(t)), intervals, strict=True):
                value = Fraction(mpmath.nstr(x, 30))
                slack = Fraction(1, 10**25)
                assert one.low - slack <= value <= one.high + slack
                # So narrow that one wrong digit of twenty would be seen.
                assert one.width < Fraction(5, 10**20)


@mark.parametrize("name", sample(["suslov", "ball"], 1))
def test_a_long_motion_lies_in_its_tube(name):
    """The tube's radii exceed the requested digits; checked in decimal arithmetic, backward in time."""
    system = systems()[name]
    state, parameters = system.example
    found = tube(system.at(parameters), state, [-6.0, -12.0], digits=15)
    assert found.complete
    known = oracle.orbits.orbit_in_decimals(system, state, parameters, [-6.0, -12.0], 45)
    for values, intervals in zip(known, found.states, strict=True):
        for value, one in zip(values, intervals, strict=True):
            assert one.low - Fraction(1, 10**30) <= Fraction(value) <= one.high + Fraction(1, 10**30)
            assert one.width < Fraction(1, 10**15)


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
        assert proved.least <= known + 1e-15
        assert known <= proved.largest + 1e-15
        assert proved.least <= orbit.error_estimate
    assert ProvedOrbit(fine, found, 1e-12).right_until == 3.0
    bounds, away = ProvedOrbit(rough, found).bounds, np.abs(rough.states - truth)
    assert np.all(away <= bounds + 1e-15)
    assert np.all(bounds <= away + 1e-15)
    # A sample moved by 1e-6: right before it, and not after.
    moved = fine.states.copy()
    moved[4, 2] += 1e-6
    wrong = ProvedOrbit(replace(fine, states=moved), found, 1e-7)
    assert wrong.right_until == times[3]
    assert (wrong.least, wrong.largest) == approx((1e-6, 1e-6), rel=1e-6)


def test_a_tube_ends_where_the_work_does():
    system = systems()["hess"]
    found = tube(*system.example_motion, [0.1, 0.5, 50.0], most_work=2e5)
    assert not found.complete
    assert found.times.tolist() == [0.1, 0.5]
    assert len(found.states) == 2
    # Before the first of its times: nothing is proved.
    none = tube(*system.example_motion, [50.0], most_work=1e3)
    judged = ProvedOrbit(solve(*system.example_motion, [50.0], "draft"), none, 1.0)
    assert judged.bounds.shape == (0, 5)
    assert judged.right_until == 0.0
    assert np.isnan([judged.least, judged.largest]).all()


def test_work_is_counted_and_more_of_it_goes_farther():
    system = systems()["hess"]
    motion = system.at((187.0, 1.0)), (0.3, 1.42, -0.6, 0.0, 0.8), np.linspace(0.05, 2.0, 40)
    short, again, longer = (tube(*motion, most_work=work) for work in (3e4, 3e4, 1e5))
    assert short.work_limited
    assert longer.work_limited
    assert short.times.tolist() == again.times.tolist()
    assert 0 < short.times.size < longer.times.size < 40
    assert not tube(*motion[:2], [0.05]).work_limited


def divides(field):
    """An own system of x and y whose field divides by x."""
    return System("divides", field, "x y", example=(1.0, 0.0))


def test_a_divisor_that_vanishes_ahead_ends_a_tube_and_raises_nothing():
    """ẋ = −1, ẏ = x (1/x): the Taylor series of x and y end after two terms, so nothing in them warns of x = 0."""
    system = divides(lambda y, p: (-1 + 0 * y[0], y[0] * (1 / y[0])))
    found = tube(system.at(()), (1.0, 0.0), [0.25, 0.5, 2.0], digits=9)
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
    system = System("every function", every_function, "x z", {"a": 0.3}, example=(0.4, 0.3))
    times = [0.02]
    found = tube(*system.example_motion, times, digits=20)
    assert found.complete
    with mpmath.workdps(26):
        exact = mpmath.odefun(lambda _, y: every_function(y, [mpmath.mpf(0.3)]), 0, [mpmath.mpf(0.4), mpmath.mpf(0.3)])
        for t, state in zip(times, found.states, strict=True):
            for x, one in zip(exact(t), state, strict=True):
                low, high = (mpmath.mpf(end.numerator) / end.denominator for end in (one.low, one.high))
                assert low - 1e-24 <= x <= high + 1e-24
                assert high - low < 1e-20


def test_many_digits_are_found_within_the_first_step_too():
    system, digits = systems()["hess"], 100
    found = tube(*system.example_motion, [0.01], digits)
    assert found.complete
    assert found.width < 10.0**-digits
    (known,) = oracle.orbit_in_decimals(system, *system.example, [0.01], digits + 10)
    for x, one in zip(known, found.states[0], strict=True):
        value, slack = Fraction(x), Fraction(1, 10 ** (digits + 3))
        assert one.low - slack <= value <= one.high + slack


def test_what_has_no_tube_is_refused():
    system = systems()["hess"]
    for words, said in ((([0.1, -0.1],), "must be monotonic"), (([1.0], 0), "from 1 to 100")):
        with raises(InvalidParameter, match=said):
            tube(*system.example_motion, *words)
    other = systems()["suslov"]
    orbit = solve(*other.example_motion, [0.1], "draft")
    with raises(InvalidParameter, match="same system"):
        ProvedOrbit(orbit, tube(*system.example_motion, [0.1]))


@mark.parametrize("t", [0.0, 5e-324])
def test_at_the_start_a_tube_is_the_start(t):
    body, state = systems()["suslov"].example_motion
    found = tube(body, state, [t])
    assert found.complete
    for x, one in zip(state, found.states[0], strict=True):
        # In 5e-324 a rate of size 1 moves it by as much.
        assert one.low - Fraction(1e-300) <= Fraction(x) <= one.high + Fraction(1e-300)
        assert float(one.high - one.low) < 1e-18
    assert found.to_pandas()["γ3 low"].to_list() == [state[4]]
