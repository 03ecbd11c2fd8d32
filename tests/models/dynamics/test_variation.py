"""Derivatives of the flow, against differences with more digits and a matrix exponential."""

import math

import numpy as np
from pytest import approx, raises

import oracle
from hess_mechanics import level, systems
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import return_derivative, tangent
from hess_mechanics.errors import InvalidParameter, WorkLimit
from support.mechanics import some_systems

PRECISE, REFERENCE = level("precise"), level("reference")
SUSLOV = systems()["suslov"]


def flow(body, start, times, accuracy):
    """States, ∂y(t)/∂y(0) and ln of its determinant at times, in the units of the problem."""
    problem = Problem.of(body, [start])
    scale, times = problem.scale, problem.times(np.atleast_1d(times))
    found = tangent(problem, problem.states[0], np.eye(scale.size), times, accuracy, math.inf)
    return found.states * scale, scale[:, None] * found.vectors / scale, found.volume


@some_systems
def test_the_matrix_is_that_of_differences_with_more_digits(system):
    (matrix,) = flow(*system.example_motion, 3.0, REFERENCE)[1]
    exact = oracle.derivative_of_flow(system, *system.example, 3.0)
    assert np.abs(matrix - exact).max() < 1e-12 * np.abs(exact).max()


@some_systems
def test_for_every_system_flows_turn_back_and_carry_the_rate_along(system):
    state, p = system.example
    states, matrices, volume = flow(system.at(p), state, [2.0, 5.0], PRECISE)
    both, size = matrices[1], np.abs(matrices[1]).max()
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
        return_derivative(np.eye(2), np.array([1.0, 0.0]), np.array([0.0, 1.0]))
