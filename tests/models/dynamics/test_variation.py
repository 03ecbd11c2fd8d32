"""Derivatives of the flow, against differences with more digits and a matrix exponential."""

import math

import numpy as np
from pytest import approx, mark, raises
from scipy.linalg import expm

from hess_mechanics import SuslovBody, level, systems
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import onto_surface, tangent
from hess_mechanics.errors import InvalidParameter, WorkLimit
from oracle.orbits import taylor
from support.mechanics import differences
from support.suslov import permanent_rotations
from support.thorough import sample

PRECISE, REFERENCE = level("precise"), level("reference")
SUSLOV = systems()["suslov"]


def by_differences(system, state, p, span):
    """The matrix by differences of the fourth order of orbits in long double, found without any kernel."""
    size, step = len(state), np.longdouble(1e-4)
    shifts = np.array([-2, -1, 1, 2]) * step
    starts = np.array(
        [
            [np.longdouble(one) + shift * (i == j) for i, one in enumerate(state)]
            for j in range(size)
            for shift in shifts
        ],
        np.longdouble,
    )
    parameters = np.repeat(np.array(p, np.longdouble)[:, None], len(starts), axis=1)
    times = np.full((1, len(starts)), span, np.longdouble)
    ends = taylor(system.field, starts.T, parameters, times, 28, 1e-22)[0]
    weights = np.array([1, -8, 8, -1], np.longdouble) / (12 * step)
    return (ends.reshape(size, size, 4) @ weights).astype(float)


def flow(body, start, times, accuracy):
    """States, ∂y(t)/∂y(0) and ln of its determinant at times, in the units of the problem."""
    problem = Problem.of(body, [start])
    scale, times = problem.scale, problem.times(np.atleast_1d(times))
    found = tangent(problem, problem.states[0], np.eye(scale.size), times, accuracy, math.inf)
    return found.states * scale, scale[:, None] * found.vectors / scale, found.volume


# The compiler takes ten seconds for the variation of a system.
some_systems = mark.parametrize("system", sample(systems().values(), 2), ids=lambda system: system.name)


@some_systems
def test_the_matrix_is_that_of_differences_with_more_digits(system):
    (matrix,) = flow(*system.example_motion, 3.0, REFERENCE)[1]
    exact = by_differences(system, *system.example, 3.0)
    assert np.abs(matrix - exact).max() < 1e-12 * np.abs(exact).max()


@some_systems
def test_for_every_system_flows_compose_and_turn_back(system):
    state, p = system.example
    states, matrices, volume = flow(system.at(p), state, [2.0, 5.0], PRECISE)
    first, both = matrices
    (rest,) = flow(system.at(p), states[0], 3.0, PRECISE)[1]
    size = np.abs(both).max()
    assert rest @ first == approx(both, abs=1e-8 * size)
    (back,) = flow(system.at(p), states[1], -5.0, PRECISE)[1]
    assert back @ both == approx(np.eye(len(state)), abs=1e-7 * size)
    assert np.log(np.linalg.det(matrices)) == approx(volume, abs=1e-8 * size)
    # The rate is carried along.
    rates = [np.array(system.field(y, p)) for y in (state, states[1].tolist())]
    assert both @ rates[0] == approx(rates[1], abs=1e-8 * size)


def test_what_cannot_be_is_refused_in_a_sentence():
    with raises(WorkLimit, match="choose a shorter"):
        flow(*SUSLOV.example_motion, 1e9, PRECISE)
    # Beside the upper equilibrium neighbours part as e^t.
    with raises(WorkLimit, match="separate beyond the range of double precision: choose a shorter time span"):
        flow(SUSLOV.at((1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)), (0.0, 0.0, 0.0, 0.0, 1.0), 800.0, PRECISE)
    with raises(InvalidParameter, match="touches the surface"):
        onto_surface(np.eye(2), np.array([1.0, 0.0]), np.array([0.0, 1.0]))


def test_at_rest_the_matrix_is_an_exponential():
    # A permanent rotation, where f = 0: V = e^{Jt}, with J by differences.
    p = (1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3)
    rest = next(permanent_rotations(SuslovBody(*p), 1.743))
    (found,) = flow(SUSLOV.at(p), rest, 2.0, PRECISE)[1]
    assert np.abs(found - expm(2.0 * differences(lambda y: SUSLOV.field(y, p), rest))).max() < 1e-8
