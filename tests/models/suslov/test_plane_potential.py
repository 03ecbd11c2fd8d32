"""Potentials U(γ1, γ2) on a principal axis: the motion in the plane, integrability, and orbits that close."""

from math import pi, sqrt

import numpy as np
import sympy
from pytest import approx, mark

from hess_mechanics import Plane, section, systems
from hess_mechanics.suslov.plane_potential import (
    POTENTIALS,
    SYSTEM,
    PotentialBody,
    forbidden,
    level_curve,
    motion_from,
)

SUSLOV = systems()["suslov"]
every_potential = mark.parametrize("name", POTENTIALS)


def body_of(name, I11=1.0, I22=1.0):
    return PotentialBody(I11, I22, *POTENTIALS[name])


def equator_energy(body):
    """The least potential on the equator."""
    angle = np.linspace(-pi, pi, 20_001)
    return float(body.potential(np.column_stack([np.cos(angle), np.sin(angle)])).min())


def by_hand(body, x, y):
    """U as written in the module's first line, and its gradient."""
    U = (body.c1 * x**2 + body.c2 * y**2) / 2 + body.cubic * (x**2 * y - y**3 / 3) + body.quartic * x**2 * y**2
    return U, (
        body.c1 * x + 2 * body.cubic * x * y + 2 * body.quartic * x * y**2,
        body.c2 * y + body.cubic * (x**2 - y**2) + 2 * body.quartic * x**2 * y,
    )


@every_potential
def test_it_is_the_suslov_problem_with_the_gradient_for_b_and_in_the_time_tau_a_natural_system(name):
    body = PotentialBody(1.3, 0.7, *POTENTIALS[name])
    random = np.random.default_rng(1)
    for _ in range(20):
        y = random.normal(size=5)
        value, slope = by_hand(body, y[2], y[3])
        assert float(body.potential(y[2:4])) == approx(value, abs=1e-13)
        expected = SUSLOV.field(y, (1.3, 0.7, 0.0, 0.0, *slope, 0.0))
        rates = np.array(SYSTEM.field(y, body.parameters))
        assert rates == approx(expected, abs=1e-12)
        # dτ = γ3 dt: q' = p, p' = −∂V/∂q, V(q) = U(−q2/√I22, q1/√I11).
        (_, (p,)), ((q_rate,), (p_rate,)) = body.to_plane(y[None]), body.to_plane(rates[None])
        assert q_rate == approx(y[4] * p, abs=1e-12)
        assert p_rate == approx(y[4] * np.array([-slope[1] / sqrt(1.3), slope[0] / sqrt(0.7)]), abs=1e-12)


def test_the_quadratic_potential_alone_has_another_integral():
    y, p = sympy.symbols("w1 w2 g1 g2 g3"), sympy.symbols("I11 I22 c1 c2 cubic quartic")
    F2 = (p[0] * y[0] ** 2 + p[3] * y[3] ** 2) / 2
    rate = sum(F2.diff(x) * v for x, v in zip(y, SYSTEM.field(y, p), strict=True))
    assert sympy.simplify(rate.subs({p[4]: 0, p[5]: 0})) == 0


@every_potential
def test_the_period_of_a_motion_is_the_time_between_two_crossings_of_the_equator(name):
    body, start = body_of(name, 1.3, 0.8), (0.9, -0.7, 0.48, 0.6, 0.64)
    both = section(body, start, Plane((0.0, 0.0, 0.0, 0.0, 1.0)), 400.0, "reference", 2)
    found = motion_from(body, start, 40.0, "precise")
    assert (found.period, found.is_fixed_point) == (approx(float(both.times[1] - both.times[0]), abs=1e-8), False)
    assert motion_from(body, (0.6, 0.8, 0.6, 0.8, 0.0), 5.0, "standard").is_fixed_point


@every_potential
def test_equipotentials_and_what_is_forbidden(name):
    body = body_of(name)
    edge = equator_energy(body)
    for share in (0.5, 1.2):
        assert body.potential(np.concatenate(level_curve(body, share * edge))) == approx(share * edge, abs=1e-7)
    assert [len(forbidden(body, share * edge)) for share in (0.5, 100.0)] == [1, 0]
