"""Tangent dynamics: an orbit with tangent vectors, which give its exponents, indicators and multipliers.

V̇ = J(y(t)) V, where J is the Jacobian of the field; the solution with V(0) = 1 is the fundamental matrix.  J is the
derivative of the traced field, so every system has one; V is integrated in the same Taylor steps as the orbit
(`numerics.variation_kernels`).

The column along the motion needs no integration: V f(y(0)) = f(y(t)).  Unless the motion is slow at its start, only the
d − 1 columns across f are integrated.  For five variables these four fill one vector register instead of two.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import (
    MAX_STEPS,
    end_of,
    require_finite_neighbours,
    require_finite_states,
    require_steps,
)
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array

__all__ = ["LONGEST", "Tangent", "flow_frame", "generic_direction", "return_derivative", "tangent"]

LONGEST = 1e6
"""Length at which a single vector is normalised."""


@dataclass(frozen=True)
class Tangent:
    """An orbit with k tangent vectors δ, δ̇ = J δ, at n times, in the scaled units of its `Problem`.

    Attributes
    ----------
    steps : int
        Number of steps.
    states : ndarray, shape (n, d)
        States of the orbit.
    vectors : ndarray, shape (n, d, k)
        The tangent vectors, orthonormalised on the way where the limit of `tangent` required it.  If it never did, and
        they started as the unit matrix, this is the fundamental matrix.
    log_growth : ndarray, shape (n, k)
        Logarithms of the lengths that were removed from the vectors up to each time.
    volume : ndarray, shape (n,)
        ∫ tr J dt up to each time.
    """

    steps: int
    states: Array
    vectors: Array
    log_growth: Array
    volume: Array

    @property
    def lengths(self) -> Array:
        """Logarithms of the lengths of the vectors, including the removed ones, shape (n, k)."""
        return np.asarray(self.log_growth + np.log(np.linalg.norm(self.vectors, axis=1)))


def generic_direction(size: int) -> Array:
    """Return a unit vector in a direction that no symmetry singles out.

    Parameters
    ----------
    size : int
        Number d of components.

    Returns
    -------
    ndarray, shape (d, 1)
        The vector.
    """
    direction = np.cos(1.0 + np.arange(size) ** 2)
    return np.asarray(direction / np.linalg.norm(direction))[:, None]


def flow_frame(problem: Problem, frame: Array, slow: float) -> tuple[Array, float]:
    """Return orthonormal columns, the first one along ±f(y) unless the motion is slow, and the speed |f| at its start.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    frame : ndarray, shape (d, d)
        Independent columns that are orthonormalised: after f if |f| exceeds `slow`, else alone.
    slow : float
        Smallest |f| of a moving orbit.

    Returns
    -------
    columns : ndarray, shape (d, d)
        The orthonormal columns.
    speed : float
        Speed |f|, in scaled units.

    Raises
    ------
    InvalidParameter
        If |f| is not finite.
    """
    try:
        rate = [float(x) for x in problem.system.field(problem.states[0].tolist(), problem.parameters.tolist())]
    except ArithmeticError:
        rate = [math.inf]
    speed = math.hypot(*rate)
    require_finite_states(np.array(speed))
    return np.linalg.qr(np.column_stack([rate, frame]) if speed > slow else frame)[0], speed


def tangent(
    problem: Problem,
    start: Array,
    vectors: Array,
    times: Array,
    level: Level,
    limit: float,
    ahead: bool = False,
    spent: int = 0,
    where: Callable[[], WorkLimit | None] | None = None,
) -> Tangent:
    """Return the orbit from a state with its tangent vectors, at given times.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    start : ndarray, shape (d,)
        State at time 0, in scaled units.
    vectors : ndarray, shape (d, k)
        Vectors at time 0; k is 1 or d.
    times : ndarray, shape (n,)
        Times, monotonic from 0 forward or backward, in units of 1/ν.
    level : Level
        Order and tolerance of the steps.
    limit : float
        Condition of the vectors, or length of a single one, at which they are orthonormalised.
    ahead : bool, default False
        True if the first of d vectors is parallel to f(y), f(y) ≠ 0.  This vector is known and never normalised; at the
        `limit` the others are made orthogonal to it.
    spent : int, default 0
        Steps that other runs have taken of the allowed 2 000 000.
    where : callable, optional
        Function that returns the error of a motion that stops.  By default that of the motion from `start`.

    Returns
    -------
    Tangent
        The orbit and its vectors.

    Raises
    ------
    InvalidParameter
        If the motion exceeds the range of double precision.
    WorkLimit
        If the motion needs too many steps, or its neighbours separate beyond the range of double precision.
    MotionEnds
        If the motion or a neighbour cannot be followed to the last time.
    """
    system, p, (d, k) = problem.system, problem.parameters, vectors.shape
    known = int(ahead and d > 1)
    vary = system.transverse_variation if known else system.tangent_variation if k == 1 else system.full_variation
    states, volume = np.empty((times.size, d)), np.empty(times.size)
    frames, removed = np.empty((times.size, d, k - known)), np.empty((times.size, k - known))
    own, options = np.ascontiguousarray(vectors[:, known:]), (level.order, level.tolerance, MAX_STEPS - spent, limit)
    steps = vary(start, own, p, times, *options, states, frames, removed, volume)
    require_steps(
        steps,
        f"This motion needs more than {MAX_STEPS} steps: choose a shorter time span or a cheaper accuracy.",
        where or (lambda: end_of(problem, start, float(times[-1]))),
    )
    require_finite_states(states)
    if known:
        # `require_finite_neighbours` reports an overflow.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            along = system.rates(states, p) / (vectors[:, 0] @ system.field(start.tolist(), p.tolist()))
        frames = np.concatenate([along[:, :, None], frames], axis=2)
        removed = np.concatenate([np.zeros((times.size, 1)), removed], axis=1)
    require_finite_neighbours(frames, removed, volume)
    return Tangent(steps, states, frames, removed, volume)


def return_derivative(matrix: Array, rate: Array, gradient: Array) -> Array:
    """Return the derivative of the first return to a surface, from that of the flow.

    A neighbour arrives earlier or later: (1 − f nᵀ/(n·f)) V.

    Parameters
    ----------
    matrix : ndarray, shape (..., d, k)
        Derivative V of the flow.
    rate : ndarray, shape (..., d)
        Rate f = ẏ at the crossing.
    gradient : ndarray, shape (..., d)
        Gradient n of the surface at the crossing.

    Returns
    -------
    ndarray, shape (..., d, k)
        Derivative of the return.

    Raises
    ------
    InvalidParameter
        If an orbit is tangent to the surface, or at rest on it.
    """
    across = (gradient * rate).sum(axis=-1)
    size = np.linalg.norm(gradient, axis=-1) * np.linalg.norm(rate, axis=-1)
    if not np.all(np.abs(across) > 1e-12 * size):
        raise InvalidParameter("The orbit touches the surface here or rests on it: choose another start.")
    along = gradient[..., None, :] @ matrix / across[..., None, None]
    return np.asarray(matrix - rate[..., :, None] * along)
