"""Bridge, loxodromic pendulum, b on a principal axis, tracks and motions without a field, at extreme parameters."""

from math import atan2, cos, sin, sqrt

import numpy as np
from pytest import mark, param

import oracle
from hess_mechanics import HessBody, SuslovBody, f_max, solve, systems, turning_points
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_manifold import run_free
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicPendulum, loxodromic_motion
from hess_mechanics.suslov import kharlamova
from hess_mechanics.suslov.free import free_motion
from hess_mechanics.suslov.kharlamova import PlaneBody
from support.extremes import assert_promised, off
from support.loxodrome import closed_form

SUSLOV, UP = systems()["suslov"], (0.6, 0.0, 0.8)
GESS1 = Bridge.of_heavy(HeavyBody.hess((1.0, 0.625, 0.375), 9.975))


@mark.parametrize(
    ("bridge", "h", "share"),
    [
        param(GESS1, 1e8, 0.5, id="h = 1e8"),
        param(GESS1, 0.3, 1.0 - 1e-9, id="f = f_max (1 − 1e-9)"),
        param(Bridge.of_heavy(HeavyBody.hess((1e3, 1.0, 1e-3), 1.0)), 1.5, 0.3, id="moments 1e3, 1, 1e-3"),
        param(Bridge.of_suslov(HessBody(1.0, 50.0, -1.0)), 1.5, 0.3, id="a = 50"),
    ],
)
def test_held_on_the_manifold_euler_poisson_is_suslovs_motion(bridge, h, share):
    """Over 20 periods of n3, relative to the fastest ω."""
    turning = turning_points(h, share * f_max(h))
    start = tuple(bridge.from_reduced(bridge.hess.from_units_of_b(turning.state_at_lower_turn(0.5))))
    times = np.linspace(0.0, 20 * turning.period / bridge.hess.frequency_unit, 801)
    suslov = solve(bridge.hess.suslov, bridge.hess.from_reduced(bridge.to_reduced(start)), times, "reference")
    exact = bridge.hess.in_units_of_b(bridge.hess.to_reduced(suslov.states))

    def error(name):
        run = run_free(bridge.heavy, start, times[-1], times.size, name, held=True)
        # Off the manifold the two have no state in common.
        assert np.max(np.abs(run.offset)) < 1e-12
        return np.max(bridge.distance(run.states, exact)) / sqrt(2.0 * (h + 1.0))

    assert_promised(error, floor=2e-11)


@mark.parametrize(
    ("moments", "h", "span"),
    [
        param((1.0, 1.5, 2.0), -1.0 + 1e-4, 50.0, id="h = −1 + 1e-4"),
        param((1.0, 1.5, 2.0), 1.0, 20.0, id="h = 1, to the top"),
        param((1.0, 1.5, 2.0), 1e4, 1.0, id="h = 1e4"),
        param((1.0, 1.0 + 1e-6, 1.0 + 2e-6), 1.5, 30.0, id="a = 1e-6"),
        param((1.0, 10.0, 1000.0), 1.5, 30.0, id="a = 9 (not a rigid body)"),
    ],
)
def test_both_axes_of_the_loxodromic_pendulum_are_those_of_jacobis_functions(moments, h, span):
    one = LoxodromicPendulum(HeavyBody.hess(moments, 0.7), h, 0.4)
    speed = 4.0 * sqrt(2.0 * (h + 1.0) + 4.0)

    def motion(name):
        return loxodromic_motion(one, span / one.frequency_unit, name)

    def error(name):
        found = motion(name)
        axes = found.attitude.axes
        assert np.max(np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3))) < 1e-14
        return np.max(np.abs(np.array([found.centre, found.middle]) - closed_form(one, found.orbit.times))) / speed

    # The saddle magnifies the rounding of the start.
    at_saddle = h == 1.0
    assert_promised(error, admitted=lambda name: at_saddle and error(name) <= motion(name).orbit.error_estimate)


ASYMPTOTIC = atan2(1.0, 0.5)
"""Direction at (0.5, −0.5) of the parabola that touches the equator."""


@mark.parametrize(
    ("body", "place", "p", "floor"),
    [
        param(PlaneBody(1e2, 1e-2, 0.4, 0.7), (3.0, -0.02), (1.0, 0.5), 0.0, id="I11/I22 = 1e4"),
        param(PlaneBody(1.5, 1.0, 0.4, 0.7), (0.3, -0.2), (1e3, 10.0), 0.0, id="|p| = 1e3"),
        # The saddle magnifies the rounding of the start.
        param(
            PlaneBody(1.0, 1.0, 1.0, 0.0),
            (0.5, -0.5),
            (sqrt(1.25) * cos(ASYMPTOTIC + 1e-6), sqrt(1.25) * sin(ASYMPTOTIC + 1e-6)),
            1e-9,
            id="1e-6 from the asymptotic orbit",
        ),
    ],
)
def test_orbits_with_b3_0_close_after_the_period_in_closed_form(body, place, p, floor):
    start = np.array(kharlamova.state_at(body, place, p))
    arc = kharlamova.arc(body, start)
    unit = np.array([arc.rate, arc.rate, 1.0, 1.0, 1.0])
    assert_promised(lambda name: np.max(np.abs(solve(body, start, [arc.period], name).states[0] - start) / unit), floor)


@mark.parametrize(
    ("tensor", "omega", "times"),
    [
        param((2.44, 1.0, 0.0, 0.5), (2.0, 1e-300), [1.0, 690.0, 692.0, 740.0], id="1e-300 off the line"),
        param((2.0, 1.0, 0.3, 0.5), (0.5, -0.3 + 1e-16), [1.0, 100.0, 130.0, 160.0], id="1e-16 off a slanting line"),
        param((1.0, 1.0, 0.006, 0.008), (0.7, 0.7), [1.0, 100.0, 300.0], id="I13, I23 = 0.01"),
    ],
)
def test_a_motion_without_a_field_keeps_its_digits(tensor, omega, times):
    body = SuslovBody(*tensor)
    exact = oracle.orbit_in_decimals(SUSLOV, [*omega, *UP], body.parameters, times, 30)

    def error(name):
        found = free_motion(body, omega, UP, times, name)
        return off(np.hstack([found.omega, found.gamma]), exact)

    assert_promised(error)
