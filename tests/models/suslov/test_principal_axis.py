"""The Suslov problem on a principal axis: Poisson brackets, the Jacobi identity, invariant measure."""

import numpy as np
import pytest
import sympy

from hess_mechanics import level, solve, systems
from hess_mechanics.suslov.principal_axis import divergence, energy_gradient, poisson_matrix

SUSLOV = systems()["suslov"]
FLOOR = level("reference")
STATE = sympy.symbols("w1 w2 g1 g2 g3", real=True)
BODY = sympy.symbols("I11 I22 I13 I23 b1 b2 b3", real=True)
PRINCIPAL = tuple(0 if str(symbol) in ("I13", "I23") else symbol for symbol in BODY)


def random_points(count, seed=0):
    """States and parameters with I13 = I23 = 0, off the equator."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        gamma = rng.normal(size=3)
        p = [*rng.uniform(0.3, 3.0, 2), 0.0, 0.0, *rng.normal(size=3)]
        yield [*rng.normal(size=2), *(gamma / np.linalg.norm(gamma))], p


def test_the_brackets_give_the_equations_of_motion():
    for y, p in random_points(50):
        P, gradient = np.array(poisson_matrix(y, p), float), np.array(energy_gradient(y, p))
        assert pytest.approx(-P.T) == P
        assert y[4] * P @ gradient == pytest.approx(SUSLOV.field(y, p), abs=1e-13)


def test_the_jacobi_identity_and_the_casimir_function():
    P = sympy.Matrix(poisson_matrix(STATE, PRINCIPAL))

    def jacobiator(i, j, k):
        turns = ((i, j, k), (j, k, i), (k, i, j))
        return sum(P[one, m] * sympy.diff(P[two, three], x) for one, two, three in turns for m, x in enumerate(STATE))

    for i in range(5):
        for j in range(i):
            for k in range(j):
                assert sympy.simplify(jacobiator(i, j, k)) == 0
    F1 = sympy.Matrix([0, 0, *(2 * g for g in STATE[2:])])
    assert sympy.simplify(P * F1) == sympy.zeros(5, 1)
    for y, p in random_points(20, seed=2):
        assert np.linalg.matrix_rank(np.array(poisson_matrix(y, p), float), tol=1e-9) == 4
        # γ3 P has a limit on the equator, of rank 2.
        near = np.array(poisson_matrix([*y[:4], 1e-12], p), float)
        assert np.linalg.matrix_rank(1e-12 * near, tol=1e-9) == 2


def test_liouvilles_equation():
    rates = SUSLOV.field(STATE, BODY)
    total = sum(sympy.diff(rate, x) for rate, x in zip(rates, STATE, strict=True))
    assert sympy.simplify(total - divergence(STATE, BODY)) == 0
    assert divergence(STATE, PRINCIPAL) == 0
    # In τ the density is γ3, and 1 would not do.
    in_tau = sympy.Matrix(poisson_matrix(STATE, PRINCIPAL)) * sympy.Matrix(energy_gradient(STATE, PRINCIPAL))
    for density, kept in ((STATE[4], True), (1, False)):
        change = sum(sympy.diff(density * rate, x) for rate, x in zip(in_tau, STATE, strict=True))
        assert (sympy.simplify(change) == 0) is kept


@pytest.mark.parametrize(("I23", "kept"), [(0.0, True), (0.4, False)])
def test_the_flow_keeps_volume_on_a_principal_axis_only(I23, kept):
    p, y = [1.5, 1.0, 0.0, I23, 0.4, -0.3, 0.8], np.array([0.7, -0.2, 0.48, 0.6, 0.64])
    d = 1e-5

    def end(start):
        return solve(SUSLOV, start, p, [3.0], FLOOR).states[0]

    columns = [(end(y + d * e) - end(y - d * e)) / (2.0 * d) for e in np.eye(5)]
    assert bool(abs(np.linalg.det(np.array(columns)) - 1.0) < 1e-7) is kept
