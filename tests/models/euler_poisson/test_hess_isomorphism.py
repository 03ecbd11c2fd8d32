"""The Hess manifold of Euler–Poisson is the Suslov–Hess case for all signs; two misprints of the appendix."""

from math import copysign, hypot, sqrt

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import systems
from hess_mechanics.errors import NoField, WorkLimit
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge, share_of
from hess_mechanics.euler_poisson.hess_manifold import run_free
from hess_mechanics.suslov_hess.equations import HessBody
from support.refusals import refused

HEAVY, REDUCED = systems()["euler-poisson"], systems()["hess"]
# Both orders of the moments, all signs of r1, r3 and μ, another length of r; and a ≤ 1, a > 1.
BODIES = [
    HeavyBody((1 / I1, 1 / I2, 1 / I3), (s1 * length * body.r[0], 0.0, s3 * length * body.r[2]), mu)
    for I1, I2, I3 in ((0.375, 0.625, 1.0), (5.0, 1.0, 0.1))
    for body in [HeavyBody.hess((I1, I2, I3), 1.0)]
    for s1, s3, mu, length in ((1, 1, 1.995, 5.0), (-1, 1, 0.7, 1.0), (1, -1, -1.3, 2.0), (-1, -1, -0.4, 1.0))
]
SUSLOV_BODIES = [
    HessBody(1.0, -0.5, 2.0),
    HessBody(0.5, 1.5, -1.0),
    HessBody(2.0, 0.0, -0.3),
]

GESS1 = Bridge.of_heavy(HeavyBody((1.0, 1.6, 1 / 0.375), (3.0, 0.0, 4.0), 1.995))


def somewhere(seed=0):
    """A state of `eq01`, n² = 1."""
    state = np.random.default_rng(seed).normal(size=5)
    state[2:] /= np.linalg.norm(state[2:])
    return state


# ---- two equations of the paper that nothing here uses -----------------------------------------------------------


UNIT_BODY = HeavyBody.hess((0.7, 1.0, 1.25), 0.8)
"""a2 = a1′ = 1, the unit in which the appendix writes its angles; b′ of `m15.9` is the paper's b and a13."""


def in_the_axes_of_the_circular_section(body):
    """U of `m15.14`, and b′ of `m15.9` in these axes."""
    a1, a2, a3 = body.a
    c, s = sqrt((a3 - a2) / (a3 - a1)), sqrt((a2 - a1) / (a3 - a1))
    U = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    A = U @ np.diag(body.a) @ U.T
    assert (A[0, 0], A[1, 1], A[0, 1], A[1, 2]) == approx((a2, a2, 0.0, 0.0), abs=1e-14)
    assert U @ np.array(body.r) == approx([0.0, 0.0, hypot(*body.r)], abs=1e-14)
    return U, A[0, 2]


def in_those_axes(seed):
    """M, γ, Ṁ and γ̇ of a state with M3 = 0, from the field in the principal axes; b′, μ, h and f."""
    body = UNIT_BODY
    U, b = in_the_axes_of_the_circular_section(body)
    rng = np.random.default_rng(seed)
    M, gamma = np.array([*rng.normal(size=2), 0.0]), rng.normal(size=3)
    gamma /= np.linalg.norm(gamma)
    rate = np.array(HEAVY.field([*(U.T @ M), *(U.T @ gamma)], body.parameters))
    h = 0.5 * (M @ M) - body.mu * gamma[2]
    return M, gamma, U @ rate[:3], U @ rate[3:], b, body.mu, h, M @ gamma


@mark.parametrize("seed", range(2))
def test_the_equation_of_phi_begins_with_the_other_sign(seed):
    # `eq6-11`, with the angles of `eq6-10`.
    _, gamma, _, rate, b, mu, h, f = in_those_axes(seed)
    s = hypot(gamma[0], gamma[1])
    sin, cos = gamma[0] / s, gamma[1] / s
    turned = (rate[0] * cos - rate[1] * sin) / s
    speed = sqrt(2.0 * (h - (f * f / (2.0 * s * s) - mu * gamma[2])))
    side = copysign(1.0, rate[2])
    assert rate[2] == approx(side * s * speed, abs=1e-13)
    first = f * (gamma[2] - b * s * sin) / (s * s)
    assert turned == approx(-first - side * b * cos * speed, abs=1e-13)
    # With the printed sign it would be off by twice the first term.
    assert 2.0 * abs(first) > 0.02


@mark.parametrize("seed", range(3))
def test_the_riccati_equation_of_z_ends_with_the_square_of_K(seed):
    # `klas-gess-2`, z = M1 + i M2; the sign of μ follows that in K².
    M, _, rates, turning, b, mu, _, f = in_those_axes(seed)
    z, K2 = complex(M[0], M[1]), float(M @ M)

    def residual(last):
        return complex(rates[0], rates[1]) + 0.5j * b * z * z - mu * (turning[2] + 1j * f) / K2 * z + 0.5j * b * last

    assert abs(residual(K2)) <= 1e-14 * (1.0 + K2)
    assert abs(residual(sqrt(K2))) > 1e-3


# ---- the translation ---------------------------------------------------------------------------------------------


@mark.parametrize("body", BODIES, ids=range(len(BODIES)))
def test_the_field_of_euler_poisson_on_the_manifold_is_that_of_the_reduced_suslov_problem(body):
    bridge = Bridge.of_heavy(body)
    assert abs(bridge.hess.a) == approx(body.hess_a, rel=1e-13)
    for seed in range(5):
        reduced = somewhere(seed)
        state = bridge.from_reduced(reduced)
        assert state[:3] @ np.array(body.r) == approx(0.0, abs=1e-14)
        assert bridge.to_reduced(state) == approx(reduced, abs=1e-14 * (1.0 + np.max(np.abs(state))))
        away = bridge.hess.in_units_of_b(reduced) + np.array([0.0, 0.0, 0.01, 0.0, 0.0])
        assert bridge.distance(state[None], away[None]) == approx(0.01, rel=1e-6)
        assert bridge.from_suslov(bridge.hess.from_reduced(reduced)) == approx(state, rel=1e-13, abs=1e-13)
        rate = np.array(HEAVY.field(state, body.parameters))
        # The translation is linear: what it makes of the rate is the rate of what it makes.
        expected = REDUCED.field(reduced, (bridge.hess.a, bridge.hess.b))
        assert bridge.to_reduced(rate) == approx(np.array(expected), abs=2e-14 * np.max(np.abs(rate)) + 2e-14)
        assert rate[:3] @ np.array(body.r) == approx(0.0, abs=1e-13 * np.max(np.abs(rate)))
        own, scaled = HEAVY.integrals(state, body.parameters), bridge.hess.in_units_of_b(reduced)
        units = REDUCED.integrals(scaled, (bridge.hess.a, 1.0))
        assert bridge.in_units_of_b(own["H"], own["F1"]) == approx((units["E"], units["F2"]), rel=1e-12)
        assert bridge.from_units_of_b(units["E"], units["F2"]) == approx((own["H"], own["F1"]), rel=1e-12)


@mark.parametrize("hess", SUSLOV_BODIES, ids=str)
def test_a_heavy_body_made_from_a_suslov_body_is_in_the_hess_case_and_rigid_where_one_is(hess):
    for share in (0.05, 0.5, 1.0):
        body = Bridge.of_suslov(hess, share).heavy
        assert body.is_hess
        assert body.check.is_body == (abs(hess.a) < 1.0)
        again = Bridge.of_heavy(body).hess
        assert (again.I22, again.I23, again.b3) == approx((hess.I22, hess.I23, hess.b3), rel=1e-12, abs=1e-15)
        assert share_of(body) == approx(share, rel=1e-12)
    assert Bridge.of_suslov(hess).hess is hess


test_bodies_that_have_no_counterpart_are_refused = refused(
    (lambda: Bridge.of_heavy(HeavyBody.hess((1.0, 0.625, 0.375), 1.0, 0.01)), "not in the Hess case"),
    (lambda: Bridge.of_heavy(HeavyBody((1.0, 1.6, 2.5), (0.0, 0.0, 0.0), 1.0)), "Choose a nonzero r", NoField),
)


# ---- the leak ----------------------------------------------------------------------------------------------------


def test_too_long_a_run_is_refused():
    start = tuple(GESS1.from_reduced(somewhere()))
    with raises(WorkLimit, match=r"choose a shorter (time span|one)"):
        run_free(GESS1.heavy, start, 1e9, 3, "draft", held=True)
