"""Orders of convergence, measured as slopes."""

from decimal import Decimal

import mpmath
import numpy as np
import pytest

import oracle
from hess_mechanics.numerics.taylor_kernels import columns_of
from hess_mechanics.numerics.unrolled import evaluation
from support.mechanics import SYSTEMS

ORDERS = (1, 2, 5, 10, 18, 24)
STEPS = ("0.04", "0.02", "0.01")


def slope(x, y):
    return np.polyfit(np.log(np.array(x, float)), [float(mpmath.log(value)) for value in y], 1)[0]


@pytest.fixture(scope="module", params=SYSTEMS.values(), ids=SYSTEMS)
def truth(request):
    """A system, its example in multiple precision, and the state after each of STEPS by the oracle."""
    system = request.param
    exact = oracle.orbit_in_decimals(system, *system.example, [Decimal(h) for h in STEPS], 75)
    with mpmath.workdps(75):
        state, parameters = ([mpmath.mpf(value) for value in values] for values in system.example)
        after = [[mpmath.mpf(str(value)) for value in values] for values in exact]
        return system, state, parameters, dict(zip(STEPS, after, strict=True))


@pytest.mark.parametrize("order", ORDERS)
def test_the_local_error_of_one_step_has_the_order_of_the_series(truth, order):
    system, state, parameters, exact = truth
    expand = oracle.uncompiled(system.recursion)["expand"]
    # In multiple precision, so that round-off does not end the slope: the same source, uncompiled.
    with mpmath.workdps(75):
        c, left, right = (
            np.full((order + 1, columns), mpmath.mpf(0))
            for columns in (len(state), *[columns_of(system.recursion)] * 2)
        )
        inverses = np.array([1 / mpmath.mpf(k + 1) for k in range(order)])
        c[0] = state
        expand(c, left, right, inverses, parameters, np.empty((order, system.recursion.outputs), object))
        errors = []
        for h in STEPS:
            increments = [0] * len(state)
            evaluation(len(state)).py_func(c, mpmath.mpf(h), increments)
            step = [c[0, i] + increments[i] for i in range(len(state))]
            errors.append(max(abs(left - right) for left, right in zip(step, exact[h], strict=True)))
    assert slope(STEPS, errors) == pytest.approx(order + 1, abs=0.1)
