"""Derivatives of the flow and of return maps, against mpmath, other solvers and an exact answer."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from hess_mechanics import (
    Plane,
    SuslovBody,
    circle_map,
    level,
    return_matrix,
    systems,
    transition_matrix,
    turning_points,
)
from hess_mechanics.dynamics.section import section
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.variation import onto_surface
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.rigid_body.reversal import Reversal
from oracle.orbits import taylor
from support.suslov import permanent_rotations

PRECISE, REFERENCE = level("precise"), level("reference")
SUSLOV = systems()["suslov"]
GAMMA3 = Plane((0.0, 0.0, 0.0, 0.0, 1.0))


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


@pytest.mark.parametrize("system", systems().values(), ids=systems())
def test_the_matrix_is_that_of_differences_with_more_digits(system):
    found = transition_matrix(*system.example_motion, 3.0, REFERENCE)
    exact = by_differences(system, *system.example, 3.0)
    assert np.abs(found.matrices[0] - exact).max() < 1e-12 * np.abs(exact).max()
    assert found.error_estimate < 1e-12


def test_the_matrix_is_that_of_variational_equations_written_by_hand():
    state, p = SUSLOV.example
    I11, I22, I13, I23, b1, b2, b3 = p

    def rates(_, z):
        w1, w2, g1, g2, g3 = z[:5]
        s = I13 * w1 + I23 * w2
        J = np.array(
            [
                [-I13 * w2 / I11, -(s + I23 * w2) / I11, 0.0, b3 / I11, -b2 / I11],
                [(s + I13 * w1) / I22, I23 * w1 / I22, -b3 / I22, 0.0, b1 / I22],
                [0.0, -g3, 0.0, 0.0, -w2],
                [g3, 0.0, 0.0, 0.0, w1],
                [-g2, g1, w2, -w1, 0.0],
            ]
        )
        return [*SUSLOV.field(z[:5], p), *(J @ z[5:].reshape(5, 5)).ravel()]

    times = np.array([3.0, 11.0, 20.0])
    run = solve_ivp(
        rates, (0.0, 20.0), [*state, *np.eye(5).ravel()], t_eval=times, method="DOP853", rtol=1e-12, atol=1e-13
    )
    found = transition_matrix(SUSLOV.at(p), state, times, PRECISE)
    for i, matrix in enumerate(found.matrices):
        assert matrix == pytest.approx(run.y[5:, i].reshape(5, 5), abs=1e-8 * np.abs(matrix).max())
    assert found.states == pytest.approx(run.y[:5].T, abs=1e-8)


@pytest.mark.parametrize("system", systems().values(), ids=systems())
def test_for_every_system_flows_compose_turn_back_and_keep_the_integrals(system):
    state, p = system.example
    whole = transition_matrix(system.at(p), state, [2.0, 5.0], PRECISE)
    first, both = whole.matrices
    rest = transition_matrix(system.at(p), whole.states[0], 3.0, PRECISE).matrices[0]
    size = np.abs(both).max()
    assert rest @ first == pytest.approx(both, abs=1e-8 * size)
    back = transition_matrix(system.at(p), whole.states[1], -5.0, PRECISE).matrices[0]
    assert back @ both == pytest.approx(np.eye(len(state)), abs=1e-7 * size)
    assert np.log(np.linalg.det(whole.matrices)) == pytest.approx(whole.log_volume, abs=1e-8 * size)
    # The rate is carried along, and the gradients of the integrals backwards.
    rates = [np.array(system.field(y, p)) for y in (state, whole.states[1].tolist())]
    assert both @ rates[0] == pytest.approx(rates[1], abs=1e-8 * size)
    for name in system.integrals(state, p):
        before, after = (
            np.array(
                [
                    mpmath.diff(
                        lambda *y, name=name: system.integrals(y, p)[name],
                        tuple(map(float, at)),
                        tuple(int(i == j) for i in range(len(state))),
                    )
                    for j in range(len(state))
                ],
                float,
            )
            for at in (state, whole.states[1])
        )
        assert after @ both == pytest.approx(before, abs=1e-7 * size)


def test_its_numbers_have_names_units_and_an_error():
    found = transition_matrix(*SUSLOV.example_motion, [1.0, 2.0], PRECISE)
    data = found.to_xarray()
    assert float(data.derivative.sel(of="γ1", by="ω2(0)", t=2.0)) == found.matrices[1, 2, 1]
    assert data.attrs["status"] == "ok"
    assert found.error_estimate < 1e-9
    assert not found.matrices.flags.writeable


def test_what_cannot_be_is_refused_in_a_sentence():
    with pytest.raises(InvalidParameter, match="times must be"):
        transition_matrix(*SUSLOV.example_motion, math.nan, PRECISE)
    with pytest.raises(WorkLimit, match="choose a shorter"):
        transition_matrix(*SUSLOV.example_motion, 1e9, PRECISE)
    # Beside the upper equilibrium neighbours part as e^t.
    with pytest.raises(WorkLimit, match="part beyond the range of double precision: choose a shorter time span"):
        transition_matrix(SUSLOV.at((1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)), (0.0, 0.0, 0.0, 0.0, 1.0), 800.0, PRECISE)
    with pytest.raises(InvalidParameter, match="touches the surface"):
        onto_surface(np.eye(2), np.array([1.0, 0.0]), np.array([0.0, 1.0]))


# ---- return maps ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("surface", [GAMMA3, Reversal()], ids=["a plane", "a curved surface"])
def test_the_derivative_of_a_return_is_that_of_differences(surface):
    state, p = SUSLOV.example
    found = return_matrix(SUSLOV.at(p), state, surface, 60.0, REFERENCE, returns=2)
    step = 1e-5

    def end(start):
        return section(SUSLOV.at(p), start, surface, 60.0, REFERENCE, 2).states[1]

    for j in range(5):
        shift = step * np.eye(5)[j]
        assert found.matrix[:, j] == pytest.approx(
            (end(state + shift) - end(state - shift)) / (2 * step), abs=1e-7 * np.abs(found.matrix).max()
        )
    assert found.matrix @ SUSLOV.field(state, p) == pytest.approx(np.zeros(5), abs=1e-10)


def test_without_a_return_there_is_none():
    assert return_matrix(*SUSLOV.example_motion, GAMMA3, 0.1, PRECISE) is None


def test_multipliers_of_limit_cycles_are_those_of_the_moebius_map():
    """On a torus of the Suslov–Hess case the circle map is a Möbius map, whose multipliers are known exactly."""
    a, h, f = 0.5, 1.5, 0.6
    theta, turning = circle_map(a, h, f, REFERENCE), turning_points(h, f)
    hess, plane = systems()["hess"], Plane((0.0, 0.0, 0.0, 0.0, 1.0))
    assert [point.stable for point in theta.fixed_points] == [True, False]
    for point in theta.fixed_points:
        start = turning.state_at_lower_turn(point.phi)
        found = transition_matrix(hess.at((a, 1.0)), start, turning.period, REFERENCE)
        assert found.states[0] == pytest.approx(start, abs=1e-12)
        # Four of the five multipliers are 1: those of the motion itself and of three integrals.
        assert found.log_volume[0] == pytest.approx(point.log_multiplier, abs=1e-11)
        assert np.trace(found.matrices[0]) - 4.0 == pytest.approx(point.multiplier, rel=1e-9)
        crossing = section(hess.at((a, 1.0)), start, plane, turning.period, REFERENCE, 1).states[0]
        returned = return_matrix(hess.at((a, 1.0)), crossing, plane, 2.0 * turning.period, REFERENCE)
        assert returned.state == pytest.approx(crossing, abs=1e-11)
        assert returned.time == pytest.approx(turning.period, abs=1e-11)
        # On the section the motion itself has none.
        assert np.trace(returned.matrix) - 3.0 == pytest.approx(point.multiplier, rel=1e-9)


def test_the_neighbour_ahead_goes_where_the_motion_goes_and_at_rest_nothing_is_left_out():
    p = (1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3)
    system = SUSLOV
    # Five columns, all of them integrated.
    state, times = (0.8, 1.3, 0.6, 0.0, 0.8), np.array([0.5, 3.0])
    problem = Problem.of(system.at(p), [state])
    frames = np.empty((2, 5, 5))
    system.vary(
        problem.states[0],
        np.eye(5),
        problem.parameters,
        problem.times(times),
        24,
        1e-17,
        10_000,
        math.inf,
        np.empty((2, 5)),
        frames,
        np.empty((2, 5)),
        np.empty(2),
    )
    found = transition_matrix(system.at(p), state, times, REFERENCE).matrices
    assert np.abs(found - problem.scale[:, None] * frames / problem.scale).max() < 1e-12
    # A permanent rotation, where f = 0: V = e^{Jt}, with J by differences.
    start = next(permanent_rotations(SuslovBody(*p), 1.743))
    columns = [
        (np.array(system.field(start + h, p)) - np.array(system.field(start - h, p))) / 2e-6 for h in 1e-6 * np.eye(5)
    ]
    found = transition_matrix(system.at(p), start, 2.0, PRECISE).matrices[0]
    assert np.abs(found - expm(2.0 * np.column_stack(columns))).max() < 1e-8
