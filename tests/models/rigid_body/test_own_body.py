"""A body of one's own against the paper's systems and against equations with the multiplier as an unknown."""

import numpy as np
from pytest import approx, mark

import oracle
from hess_mechanics import OwnBody, Plane, Polynomial, SuslovBody, solve
from hess_mechanics.errors import NotPositiveDefinite
from support.mechanics import differences, followed
from support.refusals import refused

TENSOR = (1.5, 1.0, 1.2, 0.1, 0.4, 0.2)
FIELD = Polynomial(((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0.3, -0.5, 1.0))
BENT = Polynomial(((2, 0, 0), (1, 1, 2), (0, 0, 3)), (0.7, -0.4, 0.6))
SHAPE = Polynomial(((1, 0, 0), (1, 1, 0), (0, 2, 0)), (0.8, 0.6, -0.3))
OMEGA, VERTICAL = (0.5, 0.9, -0.3), (0.6, 0.0, 0.8)
TIMES = np.linspace(0.0, 10.0, 21)

BODIES = {
    "driven": OwnBody(TENSOR, FIELD, (0.3, -0.2, 1.0), (0.1, 0.2, 0.3), (0.4, 0.1, -0.6), 1.3),
    "shaped": OwnBody(TENSOR, FIELD, (0.0, 0.0, 1.0), (0.1, 0.2, 0.3), (0.4, 0.1, -0.6), 1.3, SHAPE),
    "bent": OwnBody(TENSOR, BENT, (1.0, 0.5, -0.3)),
    "free": OwnBody(TENSOR, BENT, None, (0.2, 0.1, 0.0)),
}


def motion(body, omega, times):
    """States (n, d) by the oracle's Taylor series of the plain field: the compiler takes ten seconds for each body."""
    start, p = (np.array(values)[:, None] for values in (body.start(omega, VERTICAL), body.parameters))
    return oracle.taylor(body.system.field, start, p, np.array(times)[:, None], 20, 1e-14)[:, :, 0]


def shape(body, t):
    return body.shape(np.cos(body.frequency * t), np.sin(body.frequency * t), 0.0)


def rates(body):
    """The equations with ω̇ and λ as four unknowns; the gradient of U by differences."""
    I11, I22, I33, I12, I13, I23 = body.inertia
    inertia = np.array([[I11, I12, I13], [I12, I22, I23], [I13, I23, I33]])

    def of(t, y):
        omega, gamma = y[:3], y[3:]
        K = np.array(body.momentum) + np.array(body.drive) * shape(body, t)
        (rate,) = differences(lambda s: shape(body, s), t, 1e-5)
        (gradient,) = differences(lambda g: [body.potential(*g)], gamma, 1e-5)
        N = np.cross(inertia @ omega + K, omega) + np.cross(gamma, gradient) - np.array(body.drive) * rate
        if body.constraint is None:
            return np.concatenate([np.linalg.solve(inertia, N), np.cross(gamma, omega)])
        a = np.array(body.constraint)
        whole = np.block([[inertia, -a[:, None]], [a[None], np.zeros((1, 1))]])
        return np.concatenate([np.linalg.solve(whole, [*N, 0.0])[:3], np.cross(gamma, omega)])

    return of


@mark.parametrize("name", BODIES)
def test_motions_are_those_of_the_equations_with_the_multiplier_and_keep_their_integrals(name):
    body = BODIES[name]
    states, fine = motion(body, OMEGA, TIMES), np.linspace(0.0, 10.0, 4001)
    along = followed(rates(body), states[0, :6], fine, 1e-10, 1e-11)
    assert np.abs(states[:, :6] - along[::200]).max() < 1e-7
    for integral in body.system.integrals(states.T, body.parameters).values():
        assert np.ptp(integral) < 1e-9
    if body.is_driven:
        # The work of the drive, by quadrature along the other solution.
        power = -np.gradient(shape(body, fine), fine, edge_order=2) * (along[:, :3] @ body.drive)
        assert states[-1, 8] == approx(np.trapezoid(power, fine), abs=1e-5)


def test_with_the_constraint_along_the_third_axis_it_is_the_suslov_problem():
    found = motion(OwnBody((1.5, 1.0, 1.2, 0.0, 0.4, 0.1), FIELD, (0.0, 0.0, 2.0)), (0.5, 0.4, 9.0), TIMES)
    suslov = solve(SuslovBody(1.5, 1.0, 0.4, 0.1, 0.3, -0.5, 1.0), (0.5, 0.4, *VERTICAL), TIMES, "precise").states
    assert found[:, [0, 1, 3, 4, 5]] == approx(suslov, abs=1e-9)
    assert np.abs(found[:, 2]).max() < 1e-14


def test_a_driven_body_is_seen_once_in_each_period_and_another_one_where_the_third_component_passes_zero():
    driven, period = BODIES["shaped"], 2 * np.pi / 1.3
    before, after = motion(driven, OMEGA, [0.99 * period, 1.01 * period]) @ driven.surface.normal
    assert before < 0.0 < after
    assert BODIES["bent"].surface == Plane((0.0, 0.0, 0.0, 0.0, 0.0, 1.0))


def test_numbers_in_a_potential_do_not_change_the_equations_and_other_terms_do():
    other = OwnBody(TENSOR, Polynomial(BENT.exponents, (1.0, 2.0, 3.0)), (0.0, 0.0, 1.0))
    assert other.system is BODIES["bent"].system
    assert OwnBody(TENSOR, FIELD, (0.0, 0.0, 1.0)).system is not other.system


test_what_is_no_body_is_refused = refused(
    (lambda: OwnBody((1.0, 1.0, 1.0, 2.0, 0.0, 0.0)), "not positive definite: choose larger", NotPositiveDefinite),
    (lambda: OwnBody(TENSOR, constraint=(0.0, 0.0, 0.0)), "a of the constraint is 0"),
    (lambda: OwnBody(TENSOR).start((1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), "vertical γ is 0"),
    (lambda: Polynomial(((4, 3, 0),), (1.0,)), "more than 6"),
)
