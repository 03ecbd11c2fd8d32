"""Twelve systems of textbooks, given by their fields alone, against an integrator of another family."""

import numpy as np
from pytest import approx, mark

from hess_mechanics import solve
from support.mechanics import scipy_states
from support.textbook import TEXTBOOK
from support.thorough import sample


def test_each_keeps_its_integrals_along_the_plain_field():
    for system, _ in TEXTBOOK.values():
        state, p = system.example
        step = 1e-5 * np.array(system.field(state, p))
        ahead, behind = (system.integrals(np.array(state) + sign * step, p) for sign in (1, -1))
        for name in ahead:
            assert ahead[name] == approx(behind[name], abs=1e-10), (system.name, name)


@mark.parametrize("name", sample(TEXTBOOK, 1))
def test_orbits_agree_with_an_independent_integrator(name):
    system, span = TEXTBOOK[name]
    times = np.linspace(0.0, span, 9)
    expected = scipy_states(system, *system.example, times, 1e-13, 1e-13)
    found = solve(*system.example_motion, times, "reference")
    size = max(1.0, float(np.abs(expected).max()))
    assert np.abs(found.states - expected).max() < 3e-8 * size
    assert found.error_estimate < 1e-9 * size
    assert max(found.drift.values(), default=0.0) < 1e-11
