"""Kharlamova's case, b3 = 0: arcs of parabolas, their periods, fixed points, orbits that touch the equator.

The arcs are held against the general Suslov system, integrated without anything of them.
"""

from math import acosh, exp, inf, sqrt

import numpy as np
from pytest import approx, mark

from hess_mechanics import level, solve, systems
from hess_mechanics.suslov.kharlamova import (
    PlaneBody,
    arc,
    fixed_point_kinds,
    mirror_image,
    periods_by_direction,
    rescaled_time,
    state_at,
)
from support.mechanics import differences
from support.refusals import refused

SUSLOV = systems()["suslov"]
FLOOR = level("reference")


def random_orbits(count, seed=1):
    """Bodies with b3 = 0, and states on both halves of the sphere."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        body = PlaneBody(*rng.uniform(0.3, 3.0, 2), *rng.normal(size=2))
        q = 0.7 * rng.uniform(-1.0, 1.0, 2) * body.axes
        state = np.array(state_at(body, tuple(q), tuple(rng.normal(size=2))))
        yield body, mirror_image(state[None])[0] if rng.uniform() < 0.5 else state


# ---- the arc ----------------------------------------------------------------------------------------------------


def test_the_point_in_the_plane_obeys_the_corrected_hamiltonian():
    for body, y in random_orbits(30):
        rates = np.array([SUSLOV.field(y, body.parameters)])
        (q,), (p,) = body.to_plane(np.array([y]))
        (q_rate,), (p_rate,) = body.to_plane(rates)
        r1, r2 = body.axes
        # dτ = γ3 dt; V = b2 q1/√I11 − b1 q2/√I22.
        assert q_rate == approx(y[4] * p, abs=1e-14)
        assert p_rate == approx(y[4] * np.array([-body.b2 / r1, body.b1 / r2]), abs=1e-14)
        energy = 0.5 * p @ p + body.b2 / r1 * q[0] - body.b1 / r2 * q[1]
        assert energy == approx(SUSLOV.integrals(y, body.parameters)["E"], abs=1e-13)


def test_orbits_run_on_their_arc_and_turn_where_it_ends():
    for body, y in random_orbits(10, seed=3):
        found = arc(body, y)
        assert found.kind == "periodic"
        states = solve(body, y, np.linspace(0.0, 1.5 * found.period, 601), FLOOR).states
        # Back after a period, and not sooner.
        assert states[400] == approx(y, abs=1e-12)
        assert np.abs(states[200] - y).max() > 1e-3
        tau = rescaled_time(found, states)
        assert found.u(tau) == approx(states[:, 2:4], abs=1e-11)
        assert found.height(tau) ** 2 == approx(states[:, 4] ** 2, abs=1e-11)
        length = found.tau[1] - found.tau[0]
        assert found.tau == approx((tau.min(), tau.max()), abs=1e-3 * length)
        assert found.height(np.array(found.tau)) ** 2 == approx(np.zeros(2), abs=1e-13)


# ---- What touches the equator, and what stands on it ------------------------------------------------------------

ROUND = PlaneBody(1.0, 1.0, 1.0, 0.0)


def touching(s, tau):
    """On (γ1, γ2) = (1 − τ²/2, sτ), whose γ3² = κ²τ² − τ⁴/4, κ² = 1 − s²: ω = (s, τ)."""
    return (s, tau, 1.0 - 0.5 * tau * tau, s * tau, sqrt((1.0 - s * s) * tau * tau - 0.25 * tau**4))


@mark.parametrize("s", [0.0, -0.5, 0.9])
def test_an_arc_that_touches_from_inside_takes_for_ever(s):
    kappa = sqrt(1.0 - s * s)
    y = touching(s, kappa)
    found = arc(ROUND, y)
    assert (found.kind, found.period) == ("asymptotic", inf)
    assert found.touch == found.tau[0] == approx(-kappa, abs=1e-7)
    assert found.tau[1] == approx(kappa, abs=1e-13)
    assert found.other == approx((-3.0 * kappa, -kappa), abs=1e-7)
    # τ̇² = κ²τ² − τ⁴/4: τ = 2κ sech κ(t − t0), there and back.
    times = np.linspace(0.0, 12.0, 60)
    t0 = acosh(2.0) / kappa
    tau = 2.0 * kappa / np.cosh(kappa * (times - t0))
    states = solve(ROUND, y, times, FLOOR).states
    assert states[:, 1] == approx(tau, abs=1e-9)
    assert states[-1] == approx((s, 0.0, 1.0, 0.0, 0.0), abs=20.0 * exp(-kappa * 11.0))


def test_fixed_points_stand_on_the_equator_and_their_stability_is_that_of_the_linear_equations():
    body = PlaneBody(1.4, 0.8, 0.5, -0.9)
    q, kind = fixed_point_kinds(body, 0.5, 73)
    for point, expected in zip(q, kind, strict=True):
        u = np.array([-point[1] / body.axes[1], point[0] / body.axes[0]])
        kinetic = 0.5 - u @ [body.b1, body.b2]
        assert bool(expected == 0.0) is bool(kinetic < 0.0)
        if kinetic < 0.0:
            continue
        omega = sqrt(2.0 * kinetic / (u**2 @ [body.I11, body.I22])) * u
        y = np.array([*omega, *u, 0.0])
        assert SUSLOV.field(y, body.parameters) == approx(np.zeros(5), abs=1e-15)
        matrix = differences(lambda y: SUSLOV.field(y, body.parameters), y)
        assert bool(np.linalg.eigvals(matrix).real.max() > 1e-3) is bool(expected < 0.0)
        found = arc(body, state_at(body, point, body.to_plane(y[None])[1][0]))
        assert (found.kind, found.stable) == ("fixed", bool(expected > 0.0))
    assert set(kind) == {-1, 0, 1}


# ---- Refusals ---------------------------------------------------------------------------------------------------


test_what_is_no_start_is_refused = refused(
    (lambda: state_at(PlaneBody(1.5, 1.0, 0.4, 0.7), (1.3, 0.0), (1.0, 0.0)), "outside the ellipse .* a start inside"),
    (lambda: periods_by_direction(PlaneBody(1.5, 1e-10, 1e308, 0.7), (0.0, 0.0), 1.0), "too fast"),
)
