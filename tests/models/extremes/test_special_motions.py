"""Bridge, loxodromic pendulum, b on a principal axis, tracks and motions without a field, at extreme parameters."""

from math import atan2, copysign, cos, hypot, sin, sqrt, tan

import mpmath
import numpy as np
from pytest import mark, param

import oracle
from hess_mechanics import HessBody, SuslovBody, f_max, solve, systems, turning_points
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_manifold import run_free
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicPendulum, loxodromic_motion
from hess_mechanics.suslov import kharlamova, quartic
from hess_mechanics.suslov.free import free_motion
from hess_mechanics.suslov.kharlamova import PlaneBody
from hess_mechanics.suslov.quartic import QuarticBody
from hess_mechanics.suslov_hess.torus import track
from support.extremes import assert_promised, off
from support.loxodrome import swing_at


def closed_form(one, tau):
    """Centre of mass and middle axis in space, along (γ, e, γ × e), at the times τ in units b = 1."""
    a1, a2, a3 = one.body.a
    a = (1 if a1 > a3 else -1) * sqrt((a3 - a2) * (a2 - a1)) / a2
    alpha = swing_at(one.h, tau)
    l = 2.0 * np.arctan(tan(0.5 * one.l) * np.exp(a * alpha))
    centre = np.stack([np.cos(alpha), 0.0 * alpha, -np.sin(alpha)], axis=1)
    return centre, np.stack([np.sin(l) * np.sin(alpha), np.cos(l), np.sin(l) * np.cos(alpha)], axis=1)


SUSLOV, UP = systems()["suslov"], (0.6, 0.0, 0.8)
GESS1 = Bridge.of_heavy(HeavyBody.hess((1.0, 0.625, 0.375), 9.975))


@mark.parametrize(
    ("bridge", "h", "share"),
    [
        param(GESS1, 1e8, 0.5, id="h = 1e8"),
        param(GESS1, 0.3, 1.0 - 1e-9, id="f = f_max (1 − 1e-9)"),
        param(Bridge.of_heavy(HeavyBody.hess((1e3, 1.0, 1e-3), 1.0)), 1.5, 0.3, id="moments 1e3, 1, 1e-3"),
        param(Bridge.of_heavy(HeavyBody.hess((1.0, 0.625, 0.375), -1e-6)), 1.5, 0.3, id="μ|r| = −1e-6"),
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
        assert np.max(np.abs(run.off)) < 1e-12
        return np.max(bridge.distance(run.states, exact)) / sqrt(2.0 * (h + 1.0))

    assert_promised(error, floor=2e-11)


@mark.parametrize(
    ("moments", "h", "span"),
    [
        param((1.0, 1.5, 2.0), -1.0 + 1e-4, 50.0, id="h = −1 + 1e-4"),
        param((1.0, 1.5, 2.0), 1.0, 20.0, id="h = 1, to the top"),
        param((1.0, 1.5, 2.0), 1e4, 1.0, id="h = 1e4"),
        param((1.0, 1.5, 2.0), 0.3, 500.0, id="t = 500"),
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
        param(PlaneBody(1.5, 1.0, 1e-10, 2e-10), (0.3, -0.2), (0.0, 0.0), 0.0, id="b = 1e-10, from rest, T = 6e5"),
        param(PlaneBody(1.5, 1.0, 0.4, 0.7), (0.3, -0.2), (1e3, 10.0), 0.0, id="|p| = 1e3"),
        param(PlaneBody(1.5, 1.0, 0.4, 0.7), (0.0, -sqrt(1.0 - 1e-11)), (1.0, 0.5), 0.0, id="1e-12 inside the edge"),
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
    ("body", "place"),
    [
        param(QuarticBody(1e2, 1e-2, 1.0, 0.8), (0.05, 3.0), id="I11/I22 = 1e4"),
        param(QuarticBody(2.0, 1.0, 1.0, 1e6), (sqrt(2e6), 0.0), id="h = 1e6 |b3|"),
        param(QuarticBody(2.0, 1.0, 1.0, -1.0 + 1e-9), (1e-5, 0.0), id="1e-9 above the bottom"),
    ],
)
def test_in_the_quartic_potential_the_vertical_keeps_its_length(body, place):
    """With γ1 and γ2 from the momenta, and γ3 against the height of the place, relative to h/b3."""
    start = quartic.state_at(body, place, 0.5)
    times = np.linspace(0.0, 5.0 * sqrt(body.I11 / abs(body.b3)), 60)
    ratio = abs(body.E / body.b3)

    def error(name):
        states = solve(body, start, times, name).states
        places, p = body.to_plane(states)
        # The error of γ² is twice that of γ, whose length is at most √3 times a component's.
        length = np.abs(np.sum(p * p, axis=1) + states[:, 4] ** 2 - 1.0) / (2.0 * sqrt(3.0))
        return max(length.max(), np.abs(states[:, 4] - body.height(places)).max() / max(1.0, ratio))

    # γ3 from ω cancels where ω is large: what h/b3 loses of it.
    assert_promised(error, floor=1e-12 + 1e-15 * ratio)


def in_the_body(body, states):
    """`eq01` in units b = 1 → `Biz131`: the units (b < 0 turns the vertical over), then the rotation by arctan a."""
    unit, r = sqrt(abs(body.b)), hypot(1.0, body.a)
    w1, w2 = unit * states[:, 0], unit * states[:, 1] * r
    n1, n2, n3 = copysign(1.0, body.b) * states[:, 2:].T
    return np.column_stack([w1, w2, n1, (n2 - body.a * n3) / r, (n3 + body.a * n2) / r])


@mark.parametrize(("b3", "h", "span", "floor"), [(-1e6, 1.7, 20.0, 0.0), (-1.0, 1.0, 10.0, 1e-11)])
def test_a_track_with_f_0_is_a_loxodromic_pendulum(b3, h, span, floor):
    """From n3 = −1; on the separatrix from n3 = 1, whose saddle magnifies the rounding of the start."""
    body = HessBody(1.0, 0.5, b3)
    since = 0 if h == 1 else -mpmath.ellipk(2 / (mpmath.mpf(h) + 1)) * mpmath.sqrt(2 / (mpmath.mpf(h) + 1))

    def error(name):
        found = track(body, h, 0.0, 0.4, span / sqrt(abs(body.b)), name, 4.0)
        exact = in_the_body(body, oracle.pendulum(body.a, h, 0.4, found.orbit.times[::40], since))
        return off(np.hstack([found.omega, found.gamma])[::40], exact)

    assert_promised(error, floor)


@mark.parametrize(
    ("tensor", "omega", "times"),
    [
        param((2.44, 1.0, 0.0, 0.5), (2.0, 1e-300), [1.0, 690.0, 692.0, 740.0], id="1e-300 off the line"),
        param((2.0, 1.0, 0.3, 0.5), (0.5, -0.3 + 1e-16), [1.0, 100.0, 130.0, 160.0], id="1e-16 off a slanting line"),
        param((1e6, 1.0, 0.3, 0.5), (1e-3, 1.0), [1.0, 10.0], id="I11/I22 = 1e6"),
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
