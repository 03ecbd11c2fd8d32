"""The Suslov problem on a principal axis: Poisson brackets, the Jacobi identity, invariant measure, both times."""

from itertools import combinations

import numpy as np
import sympy
from pytest import approx

from hess_mechanics import SuslovBody, level, systems
from hess_mechanics.errors import WorkLimit
from hess_mechanics.suslov.principal_axis import conformal, divergence, energy_gradient, poisson_matrix
from support.mechanics import followed
from support.refusals import refused

SUSLOV = systems()["suslov"]
FLOOR = level("reference")
GENERAL = SuslovBody(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8)
START = (0.7, -0.2, 0.48, 0.6, 0.64)
STATE = sympy.symbols("w1 w2 g1 g2 g3", real=True)
BODY = sympy.symbols("I11 I22 I13 I23 b1 b2 b3", real=True)
PRINCIPAL = tuple(0 if str(symbol) in ("I13", "I23") else symbol for symbol in BODY)


def test_the_brackets_give_the_equations_of_motion_and_obey_the_jacobi_identity_with_a_casimir_function():
    P = sympy.Matrix(poisson_matrix(STATE, PRINCIPAL))
    rates = STATE[4] * P * sympy.Matrix(energy_gradient(STATE, PRINCIPAL))
    assert sympy.simplify(rates - sympy.Matrix(SUSLOV.field(STATE, PRINCIPAL))) == sympy.zeros(5, 1)
    assert sympy.simplify(P + P.T) == sympy.zeros(5)

    def jacobiator(i, j, k):
        turns = ((i, j, k), (j, k, i), (k, i, j))
        return sum(P[one, m] * sympy.diff(P[two, three], x) for one, two, three in turns for m, x in enumerate(STATE))

    assert all(sympy.simplify(jacobiator(*three)) == 0 for three in combinations(range(5), 3))
    F1 = sympy.Matrix([0, 0, *(2 * g for g in STATE[2:])])
    assert sympy.simplify(P * F1) == sympy.zeros(5, 1)
    assert P.rank() == 4
    # γ3 P has a limit on the equator, of rank 2.
    assert sympy.simplify(STATE[4] * P).subs(STATE[4], 0).rank() == 2


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


# ---- both times along a motion ----------------------------------------------------------------------------------


def test_tau_is_the_integral_of_gamma3():
    found = conformal(GENERAL, START, -30.0, "reference")
    some = [0, 10, 50, -1]
    exact = followed(
        lambda _, y: [*SUSLOV.field(y[:5], GENERAL.parameters), y[4]], [*START, 0.0], found.orbit.times[some], 1e-12
    )
    assert found.tau[some] == approx(exact[:, 5], abs=1e-9)
    _, _, g1, g2, g3 = found.orbit.states.T
    assert found.brackets == approx(np.column_stack([g2 / (1.5 * g3), -g1 / g3]), rel=1e-12)
    assert found.residual < 1e-12
    assert found.turns == np.count_nonzero(g3[1:] * g3[:-1] < 0.0)


test_other_bodies_and_spans_are_refused = refused(
    (lambda: conformal(SuslovBody(1.5, 1.0, 0.1, 0.0), START, 1.0, FLOOR), "I13 = I23 = 0"),
    (lambda: conformal(GENERAL, START, 0.0, FLOOR), "nonzero"),
    (lambda: conformal(GENERAL, START, 1e6, FLOOR), "choose a shorter time span", WorkLimit),
)
