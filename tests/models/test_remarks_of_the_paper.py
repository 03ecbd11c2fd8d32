"""Remarks of the paper that no kernel computes: each is checked here, and stands in a README or beside a scene.

Symbolic where the statement is an identity, by SciPy and closed elliptic integrals where it is about motions.
"""

import math

import mpmath
import numpy as np
import sympy as sp
from pytest import approx, mark

from hess_mechanics import circle_map, level, systems, turning_points
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.suslov_hess.equations import WITH_ATTITUDE
from hess_mechanics.suslov_hess.invariant_measure import invariant_measure
from oracle import derivative_of_flow, turning_roots
from support.mechanics import scipy_states

SUSLOV, HESS, HEAVY = (systems()[name] for name in ("suslov", "hess", "euler-poisson"))
FLOOR = level("reference")

STATE = sp.symbols("w1 w2 n1 n2 n3", real=True)
W1, W2, N1, N2, N3 = STATE
A, B = sp.symbols("a b", real=True)
V = [sp.sympify(rate) for rate in HESS.field(STATE, (A, B))]
"""The vector field of `eq01`."""
INTEGRALS = HESS.integrals(STATE, (A, B))


def along(field, function):
    """The derivative of a function of the state along a vector field."""
    return sum(rate * sp.diff(function, variable) for rate, variable in zip(field, STATE, strict=True))


# ---- section 2: remarks 3 and 4, the Hess case at f = 0 ----------------------------------------------------------


def test_the_rotation_about_n3_keeps_the_integrals_and_is_turned_into_a_multiple_of_itself():
    # Remark 4: u = −w2 ∂w1 + w1 ∂w2 − n2 ∂n1 + n1 ∂n2, [u, v] = a w1 u.
    u = [-W2, W1, -N2, N1, sp.Integer(0)]
    bracket = [sp.expand(along(u, v) - along(V, one)) for v, one in zip(V, u, strict=True)]
    assert bracket == [sp.expand(A * W1 * one) for one in u]
    assert [sp.expand(along(u, integral)) for integral in INTEGRALS.values()] == [0, 0, 0]


def test_without_a_field_the_solution_of_the_paper_is_one_and_w1_a_repels_it():
    # Remark 3, b = 0.
    t, theta, phi = sp.symbols("t theta0 phi0", real=True)
    turning = W1 * t + phi
    solution = [W1, sp.Integer(0), sp.cos(theta), sp.sin(turning) * sp.sin(theta), sp.cos(turning) * sp.sin(theta)]
    on_it = dict(zip(STATE, solution, strict=True))
    rates = [rate.subs(B, 0).subs(on_it, simultaneous=True) for rate in V]
    assert [sp.simplify(sp.diff(place, t) - rate) for place, rate in zip(solution, rates, strict=True)] == [0] * 5
    E, F1, F2 = (sp.simplify(one.subs(B, 0).subs(on_it, simultaneous=True)) for one in INTEGRALS.values())
    assert [sp.simplify(E - W1**2 / 2), F1, sp.simplify(F2 - W1 * sp.cos(theta))] == [0, 1, 0]
    # Neighbouring motions have w2 ~ e^{a w1 t}.
    assert sp.diff(V[1].subs(B, 0), W2) == A * W1


ALPHA, BETA = sp.symbols("alpha beta", real=True)
ON_SPHERE = {N1: sp.sin(ALPHA) * sp.cos(BETA), N2: sp.sin(ALPHA) * sp.sin(BETA), N3: sp.cos(ALPHA)}


def test_at_f_0_a_function_of_the_position_is_kept_the_hess_case_is_holonomic():
    # Φ = artanh(sin β) + aα of n = (sin α cos β, sin α sin β, cos α): Φ̇ is a factor that depends on n, times F2.
    rates = [rate.subs(ON_SPHERE) for rate in V]
    alpha_rate = -rates[4] / sp.sin(ALPHA)
    beta_rate = (ON_SPHERE[N1] * rates[3] - ON_SPHERE[N2] * rates[2]) / sp.sin(ALPHA) ** 2
    Phi_rate = beta_rate / sp.cos(BETA) + A * alpha_rate
    F2 = INTEGRALS["F2"].subs(ON_SPHERE)
    factor = (A * ON_SPHERE[N2] + ON_SPHERE[N3]) / (sp.sin(ALPHA) * ON_SPHERE[N1])
    assert sp.simplify(Phi_rate - factor * F2) == 0
    # F2 = 0 leaves α free: n3 moves as a pendulum, whatever β is.
    free = sp.solve(F2, W1)[0]
    energy = INTEGRALS["E"].subs(ON_SPHERE).subs(W1, free)
    assert sp.simplify(energy - (alpha_rate.subs(W1, free) ** 2 / 2 - B * sp.cos(ALPHA))) == 0


@mark.parametrize("a", [0.3, 0.7])
def test_the_multiplier_comes_near_that_of_the_pendulum_as_the_cube_of_one_over_h(a):
    off = [2.0 * math.pi * a - circle_map(a, h, 0.6, FLOOR).fixed_points[1].log_multiplier for h in (20.0, 40.0, 80.0)]
    assert [off[0] / off[1], off[1] / off[2]] == approx([8.0, 8.0], rel=0.01)


# ---- the appendix: ψ̇, how many frequencies, normal hyperbolicity ------------------------------------------------


BODIES = [
    HeavyBody.hess((1.0, 0.625, 0.375), 9.975),
    HeavyBody.hess((1.0, 1.5, 2.0), 0.7),
    HeavyBody.hess((2.0, 1.25, 1.0), 1.3),
]


@mark.parametrize("body", BODIES, ids=range(3))
@mark.parametrize("seed", range(4))
def test_the_centre_of_mass_goes_round_the_vertical_at_a1_f_over_one_minus_gamma3_squared(body, seed):
    # `eq6-12` has no a1′ = a2: it is printed for a1′ = 1.
    rng = np.random.default_rng(seed)
    r = np.array(body.r) / np.linalg.norm(body.r)
    M, gamma = rng.normal(size=3), rng.normal(size=3)
    M -= (M @ r) * r
    gamma /= np.linalg.norm(gamma)
    omega, f = np.array(body.a) * M, M @ gamma
    # In space the unit vector r has the velocity ω × r; across the vertical plane it is in, over its distance.
    across = np.cross(gamma, r)
    turning = across @ np.cross(omega, r) / (across @ across)
    assert turning == approx(body.a[1] * f / (1.0 - (gamma @ r) ** 2), rel=1e-12)
    assert abs(turning - f / (1.0 - (gamma @ r) ** 2)) > 1e-3 * abs(turning)


def period_and_precession(h, f):
    """T = ∮ dt and ∮ f/(1 − n3²) dt over one period of n3, b = 1, as complete elliptic integrals with 30 digits."""
    with mpmath.workdps(30):
        n0, n1, n2 = turning_roots(mpmath.mpf(h), mpmath.mpf(f))
        # n3 = n2 − (n2 − n1) sn²(u, m).
        m, scale = (n2 - n1) / (n2 - n0), 2 * mpmath.sqrt(2 / (n2 - n0))
        halves = [mpmath.ellippi(side * (n2 - n1) / (1 + side * n2), m) / (1 + side * n2) for side in (1, -1)]
        return float(scale * mpmath.ellipk(m)), float(f / 2 * scale * sum(halves))


TURNS = 6


def returns(a, h, f):
    """Yield for three φ the reduced states, and the factors e^{iφ} and e^{iψ} of ψ from its start, at TURNS returns.

    ψ : angle of the axis n3 about the vertical, whose increase must be the precession.
    """
    T, precession = period_and_precession(h, f)
    for phi in (-2.0, 0.3, 1.7):
        start = turning_points(h, f).state_at_lower_turn(phi)
        side = np.cross(start[2:], [0.0, 0.0, 1.0])
        # With a direction that is fixed in space.
        start = [*start, *(side / np.linalg.norm(side))]
        states = scipy_states(WITH_ATTITUDE, start, (a, 1.0), T * np.arange(TURNS + 1))
        n, e, z = states[:, 2:5], states[:, 5:], states[:, 1] + 1j * states[:, 0]
        psi = np.angle(e[:, 2] + 1j * np.cross(n, e)[:, 2])
        assert np.exp(1j * (psi - psi[0])) == approx(np.exp(1j * precession * np.arange(TURNS + 1)), abs=1e-9)
        yield states[:, :5], z / np.abs(z)


@mark.parametrize(("a", "h", "f"), [(0.5, 0.2, 0.5), (0.3, 0.5, 0.6)])
def test_where_no_cycle_is_the_body_moves_with_three_frequencies(a, h, f):
    found = circle_map(a, h, f, FLOOR)
    assert abs(found.trace) < 1.99
    # The fixed point of Θ in the unit disk; about it Θ is a rotation.
    zeta = invariant_measure(found).zeta
    for states, z in returns(a, h, f):
        angle = (z - zeta) / (1.0 - np.conj(zeta) * z)
        # n3 and |w| come back with the period T; this angle goes on by 2πρ; ψ by the precession.
        assert np.ptp(states[:, 4]) < 1e-10
        assert angle / angle[0] == approx(np.exp(2j * np.pi * found.rotation_number * np.arange(TURNS + 1)), abs=1e-9)


@mark.parametrize(("a", "h", "f"), [(0.5, 1.5, 0.6), (0.3, 2.0, 0.4)])
def test_where_cycles_are_one_angle_is_asymptotic_and_two_frequencies_are_left(a, h, f):
    found = circle_map(a, h, f, FLOOR)
    assert found.trace > 2.01
    stable = min(found.fixed_points, key=lambda point: point.log_multiplier)
    for _, z in returns(a, h, f):
        away = np.abs(z - np.exp(1j * stable.phi))
        assert away[-1] / away[-2] == approx(math.exp(stable.log_multiplier), rel=0.05)


def test_a_cycle_repels_across_the_hess_manifold_as_much_as_it_attracts_along_it():
    # The multipliers are inverse: neither is stronger, so the manifold is not normally hyperbolic.
    bridge = Bridge.of_heavy(BODIES[0])
    h, f = bridge.in_units_of_b(50.0, 5.0)
    turning = turning_points(h, f)
    time = turning.period / bridge.hess.frequency_unit
    across_of = {}
    for point in circle_map(bridge.hess.a, h, f, FLOOR).fixed_points:
        reduced = bridge.hess.from_units_of_b(turning.state_at_lower_turn(point.phi))
        matrix = derivative_of_flow(HEAVY, bridge.from_reduced(reduced), bridge.heavy.parameters, time)
        normal = np.array([*bridge.heavy.r, 0.0, 0.0, 0.0])
        carried = normal @ matrix
        across = (carried @ normal) / (normal @ normal)
        # No motion crosses r·M = 0: its gradient is carried into a multiple of itself.
        assert carried == approx(across * normal, abs=1e-7 * max(1.0, across))
        assert across * math.exp(point.log_multiplier) == approx(1.0, rel=1e-7)
        # Volume is kept; four multipliers, of the motion and of the three integrals, are 1.
        assert np.linalg.det(matrix) == approx(1.0, rel=1e-7)
        assert np.trace(matrix) == approx(4.0 + across + 1.0 / across, rel=1e-6)
        across_of[point.log_multiplier < 0.0] = across
    # Across the manifold the stable cycle repels and the unstable one attracts.
    assert across_of[True] > 20.0
    assert across_of[False] < 0.05


# ---- the introduction: SO(3), E(2), SO(2,1), and the Chaplygin sleigh --------------------------------------------


OMEGA, SPEED, KAPPA = sp.symbols("omega v kappa", real=True)
I11, I22, I13, I23 = sp.symbols("I11 I22 I13 I23", real=True)


def commutator(x, y):
    """[R, X] = Y, [R, Y] = −X, [X, Y] = κR of x = (x_R, x_X, x_Y): so(3), e(2), so(2, 1) for κ > 0, = 0, < 0."""
    return (KAPPA * (x[1] * y[2] - x[2] * y[1]), x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0])


def test_contracted_the_rotations_are_the_motions_of_the_plane():
    rho = sp.Symbol("rho", positive=True)
    L = [sp.Matrix(3, 3, lambda i, j, k=k: -sp.LeviCivita(i, j, k)) for k in range(3)]
    R, X, Y = L[0], L[1] / rho, L[2] / rho
    assert sp.zeros(3) == R * X - X * R - Y == R * Y - Y * R + X == X * Y - Y * X - R / rho**2
    # `commutator` has these relations, κ = 1/ρ².
    R, X, Y = np.eye(3, dtype=int).tolist()
    assert [commutator(R, X), commutator(R, Y), commutator(X, Y)] == [(0, 0, 1), (0, -1, 0), (KAPPA, 0, 0)]


def test_without_a_field_all_three_groups_have_the_same_equations_of_the_velocities():
    # ṗ = ad*p with the constraint that there is no velocity along Y: κ is gone.
    velocity = (OMEGA, SPEED, 0)
    p = (I11 * OMEGA, I22 * SPEED, I13 * OMEGA + I23 * SPEED)
    rates = SUSLOV.field([OMEGA, SPEED, 0, 0, 1], (I11, I22, I13, I23, 0, 0, 0))
    for axis, moment, rate in (((1, 0, 0), I11, rates[0]), ((0, 1, 0), I22, rates[1])):
        turned = sum(one * part for one, part in zip(p, commutator(velocity, axis), strict=True))
        assert sp.simplify(turned / moment - rate) == 0


def test_with_I23_0_they_are_those_of_the_chaplygin_sleigh():
    # A plane body of mass m with a blade at the distance c from the centre of mass: v̇ = cω², (J + mc²)ω̇ = −mcvω.
    m, c, J, rho = sp.symbols("m c J rho", positive=True)
    rates = SUSLOV.field([OMEGA, SPEED / rho, 0, 0, 1], (J + m * c**2, m * rho**2, m * c * rho, 0, 0, 0, 0))
    assert sp.simplify(rates[0] + m * c * SPEED * OMEGA / (J + m * c**2)) == 0
    assert sp.simplify(rho * rates[1] - c * OMEGA**2) == 0


def test_the_motion_that_attracts_is_closed_on_some_groups_and_not_on_others():
    # ωR + vX generates a closed subgroup where ω² + κv² > 0, and the line of rest has ω : v = I23 : −I13.
    basis = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    adjoint = sp.Matrix([commutator((OMEGA, SPEED, 0), one) for one in basis]).T
    x = sp.Symbol("x")
    turning = OMEGA**2 + KAPPA * SPEED**2
    assert sp.expand(adjoint.charpoly(x).as_expr() - x**3 - turning * x) == 0
    # On SO(3) always; on E(2) for I23 ≠ 0, a circle; on SO(2,1) where |I23| > |I13|.
    at_rest = turning.subs({OMEGA: I23, SPEED: -I13})
    assert [sp.expand(at_rest.subs(KAPPA, k)) for k in (1, 0, -1)] == [I13**2 + I23**2, I23**2, I23**2 - I13**2]
