"""Potentials U(γ1, γ2) on a principal axis: the motion in the plane, integrability, chaos, and orbits that close."""

from math import pi, sqrt

import numpy as np
import sympy
from pytest import approx, mark
from scipy.integrate import solve_ivp

from hess_mechanics import section, solve, systems
from hess_mechanics.chaplygin_ball.section import EQUATOR
from hess_mechanics.dynamics.lyapunov import lyapunov_exponent
from hess_mechanics.errors import NotPositiveDefinite, OutsideRegion
from hess_mechanics.suslov.kharlamova import mirrored
from hess_mechanics.suslov.plane_potential import (
    POTENTIALS,
    SYSTEM,
    PotentialBody,
    equator_energy,
    forbidden,
    level_curve,
    motion_from,
    separable_integral,
    state_at,
)
from support.deviations import deviations
from support.refusals import refused

SUSLOV = systems()["suslov"]
every_potential = mark.parametrize("name", POTENTIALS)


def body_of(name, I11=1.0, I22=1.0):
    return PotentialBody(I11, I22, *POTENTIALS[name])


def by_hand(body, x, y):
    """U as written in the module's first line, and its gradient."""
    U = (body.c1 * x**2 + body.c2 * y**2) / 2 + body.cubic * (x**2 * y - y**3 / 3) + body.quartic * x**2 * y**2
    return U, (
        body.c1 * x + 2 * body.cubic * x * y + 2 * body.quartic * x * y**2,
        body.c2 * y + body.cubic * (x**2 - y**2) + 2 * body.quartic * x**2 * y,
    )


@every_potential
def test_the_field_is_that_of_the_suslov_problem_with_the_gradient_for_b(name):
    body = PotentialBody(1.3, 0.7, *POTENTIALS[name])
    random = np.random.default_rng(1)
    for _ in range(20):
        y = random.normal(size=5)
        value, slope = by_hand(body, y[2], y[3])
        assert float(body.potential(y[2:4])) == approx(value, abs=1e-13)
        assert body.gradient(y[2:4]) == approx(np.array(slope), abs=1e-12)
        expected = SUSLOV.field(y, (1.3, 0.7, 0.0, 0.0, *slope, 0.0))
        assert SYSTEM.field(y, body.parameters) == approx(expected, abs=1e-12)


@mark.parametrize(
    ("name", "E", "end"), [("quadratic", 0.2, 20.0), ("Hénon–Heiles", 0.1, 20.0), ("quartic", 0.05, 10.0)]
)
def test_in_the_time_tau_it_is_the_natural_system_in_the_plane(name, E, end):
    body = body_of(name, 1.3, 0.7)
    start = state_at(body, E, 0.2, 0.1)
    r1, r2 = sqrt(1.3), sqrt(0.7)

    def rate(_, z):
        # q' = p, p' = −∂V/∂q, V(q) = U(−q2/√I22, q1/√I11); and t' = 1/γ3.
        g1, g2 = -z[1] / r2, z[0] / r1
        _, (U1, U2) = by_hand(body, g1, g2)
        return [z[2], z[3], -U2 / r1, U1 / r2, 1.0 / sqrt(1.0 - g1 * g1 - g2 * g2)]

    w1, w2, g1, g2, _ = start
    run = solve_ivp(
        rate,
        (0.0, end),
        [r1 * g2, -r2 * g1, r1 * w1, r2 * w2, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=np.linspace(0.1, end, 7),
    )
    states = solve(body, start, run.y[4], "reference").states
    plane = np.column_stack([r1 * states[:, 3], -r2 * states[:, 2], r1 * states[:, 0], r2 * states[:, 1]])
    assert plane == approx(run.y[:4].T, abs=1e-7)
    assert np.all(states[:, 4] > 0.0)


@mark.parametrize(("I11", "I22", "c1", "c2"), [(1.0, 1.0, 1.0, 0.6), (2.0, 0.5, 0.4, -0.3), (0.3, 1.1, -1.0, 2.0)])
def test_the_quadratic_potential_has_another_integral_on_both_sides_of_the_equator(I11, I22, c1, c2):
    body = PotentialBody(I11, I22, c1, c2)
    assert body.separates
    states = solve(body, (0.8, -0.5, 0.6, 0.0, 0.8), np.linspace(0.0, 60.0, 300), "precise").states
    assert np.ptp(separable_integral(body, states)) <= 1e-8
    assert np.ptp(states[:, 0]) > 0.05
    assert states[:, 4].min() < 0.0 < states[:, 4].max()
    # Symbolically: Ḟ2 = 0 for the quadratic potential alone.
    y, p = sympy.symbols("w1 w2 g1 g2 g3"), sympy.symbols("I11 I22 c1 c2 cubic quartic")
    F2 = (p[0] * y[0] ** 2 + p[3] * y[3] ** 2) / 2
    rate = sum(F2.diff(x) * v for x, v in zip(y, SYSTEM.field(y, p), strict=True))
    assert sympy.simplify(rate.subs({p[4]: 0, p[5]: 0})) == 0
    assert sympy.simplify(rate.subs(p[4], 0)) != 0
    assert sympy.simplify(rate.subs(p[5], 0)) != 0


@every_potential
def test_below_the_least_potential_on_the_equator_motions_stay_on_one_side(name):
    body = body_of(name, 1.3, 0.8)
    edge = equator_energy(body)
    angle = np.linspace(-pi, pi, 200_001)
    assert edge == approx(min(body.potential(np.column_stack([np.cos(angle), np.sin(angle)]))), abs=1e-8)
    times = np.linspace(0.0, 300.0, 3000)
    for share in (0.5, 0.99):
        start = state_at(body, share * edge, 0.1, 0.02)
        states = solve(body, start, times, "standard").states
        assert states[:, 4].min() > 0.0


@mark.chaotic
@mark.parametrize(
    ("name", "E", "chaotic"), [("quadratic", 0.29, False), ("Hénon–Heiles", 0.163, True), ("quartic", 0.098, True)]
)
def test_the_integrable_one_is_regular_and_the_others_have_chaos(name, E, chaotic):
    body = body_of(name)
    assert equator_energy(body) > E
    starts = [state_at(body, E, g2 + 0.002 * k, 0.1) for g2 in (-0.2, 0.25) for k in range(8)]
    exponents = [lyapunov_exponent(body, start, 1500.0).value for start in starts]
    # For a regular motion it falls as ln(t)/t, to 0.005 here.
    if chaotic:
        assert deviations(exponents, 0.05) > 5.0
    else:
        assert deviations(exponents, 0.008) < -5.0


@mark.parametrize(
    ("name", "start"), [("quadratic", (0.9, -0.7, 0.48, 0.6, 0.64)), ("quartic", (1.5, 0.4, 0.0, 0.6, -0.8))]
)
def test_an_orbit_that_crosses_the_equator_twice_closes_whatever_the_potential(name, start):
    body = body_of(name, 1.3, 0.8)
    both = section(body, start, EQUATOR, 400.0, "reference", crossings=2)
    assert both.states[1] == approx(both.states[0], abs=1e-9)
    period = float(both.times[1] - both.times[0])
    back = solve(body, start, [period], "reference").states[0]
    assert back == approx(np.array(start), abs=1e-9)
    # Before and after the crossing it is its mirror image.
    before, after = (solve(body, both.states[0], [sign * 0.4], "reference").states[0] for sign in (-1.0, 1.0))
    assert before == approx(mirrored(after), abs=1e-10)


@every_potential
def test_a_motion_for_a_picture_knows_its_period_and_its_integral(name):
    body, start = body_of(name, 1.3, 0.8), (0.9, -0.7, 0.48, 0.6, 0.64)
    found = motion_from(body, start, 40.0, "precise")
    both = section(body, start, EQUATOR, 400.0, "reference", 2)
    assert found.period == approx(float(both.times[1] - both.times[0]), abs=1e-8)
    assert found.missed < 1e-8
    assert found.crossings >= 2
    assert (found.integral < 1e-10) is body.separates
    # A motion that stays on one side has no period.
    slow = motion_from(body, state_at(body, 0.7 * equator_energy(body), 0.1, 0.02), 40.0, "standard")
    assert (slow.crossings, slow.period, slow.fixed) == (0, None, False)
    assert motion_from(body, (0.6, 0.8, 0.6, 0.8, 0.0), 5.0, "standard").fixed


@every_potential
def test_equipotentials_and_what_is_forbidden(name):
    body = body_of(name)
    angle = np.linspace(0.0, 2.0 * pi, 400)
    rays = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    # U grows along every ray, so that there is one place at most.
    values = body.potential(np.linspace(0.0, 1.0, 200)[:, None, None] * rays)
    assert np.all(np.diff(values, axis=0) > -1e-12)
    edge = equator_energy(body)
    for share in (0.5, 1.2):
        parts = level_curve(body, share * edge)
        assert parts
        for part in parts:
            assert body.potential(part) == approx(share * edge, abs=1e-7)
    for share, where in ((0.5, 1), (100.0, 0)):
        areas = forbidden(body, share * edge)
        assert len(areas) == where


test_what_is_wrong_is_said = refused(
    (lambda: state_at(body_of("quadratic"), 0.1, 0.9, 0.0), "choose a larger E", OutsideRegion),
    (lambda: state_at(body_of("quadratic"), 0.1, 1.2, 0.0), "choose .γ2. < 1"),
    (lambda: PotentialBody(1.0, 0.0, 1.0, 1.0), "choose I22 > 0", NotPositiveDefinite),
)
