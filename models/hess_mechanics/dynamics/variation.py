"""Variational equations: the derivative ∂y(t)/∂y(0) along an orbit, and derivatives of return maps.

V̇ = J(y(t)) V with V(0) = 1, where J is the Jacobian of the field.  J comes from differentiating the traced field and
is integrated in the same Taylor steps as the orbit (`numerics.variation_kernels`), so V exists for every system.

The column along the motion needs no integration: V f(y(0)) = f(y(t)).  Unless the motion is slow at its start, only the
d − 1 columns across f are integrated: for five variables four, which fill one vector register instead of two.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import (
    MAX_STEPS,
    checked_times,
    end_of,
    require_finite_neighbours,
    require_finite_states,
    require_steps,
)
from hess_mechanics.dynamics.section import Surface, section
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Printed, Result
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.results import Array, Cost, facts_of, frozen

__all__ = [
    "Return",
    "Transition",
    "followed",
    "frame_ahead",
    "neighbours",
    "onto_surface",
    "return_matrix",
    "transition_matrix",
]

_MOVES = 0.1
"""Smallest |f(y(0))| for the shortcut, in units in which states are O(1): errors of f(y(t)) are divided by it."""


@dataclass(frozen=True)
class Transition(Result):
    """The transition matrix ∂y(t)/∂y(0) along an orbit.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times.
    states : ndarray, shape (n, d)
        States at these times.
    matrices : ndarray, shape (n, d, d)
        Row i, column j: ∂y_i(t)/∂y_j(0), in the units of the states.
    log_volume : ndarray, shape (n,)
        ∫ tr J dt, computed independently; equals ln det of the matrix.
    status : Status
        How the computation ended.
    error_estimate : float
        Largest estimated error of a matrix relative to its largest entry, in units in which states are O(1), or of a
        state.
    cost : Cost
        Steps and time.
    variables : tuple of str
        Names of the variables.
    """

    system: str
    level: str
    times: Array
    states: Array
    matrices: Array
    log_volume: Array
    status: Status
    error_estimate: float
    cost: Cost
    variables: tuple[str, ...]

    def labels(self) -> Labels:
        """Return the matrices, labelled with time and the names of their rows and columns.

        Returns
        -------
        Labels
            The derivatives over time, rows and columns.
        """
        of, by = np.array(self.variables), np.array([f"{name}(0)" for name in self.variables])
        return Labels(
            {"t": (("t",), self.times), "of": (("of",), of), "by": (("by",), by)},
            {"derivative": (("t", "of", "by"), self.matrices)},
            {"t": "T"},
            {"system": self.system, **facts_of(self)},
        )


def transition_matrix(
    body: Body, state: Sequence[float] | Array, times: float | Sequence[float] | Array, level: Accuracy
) -> Transition:
    """Return the transition matrix ∂y(t)/∂y(0) along an orbit.

    As in `solve`, everything is computed twice, and again if the promise of the level is missed.

    Parameters
    ----------
    body : Body
        The body.
    state : array_like, shape (d,)
        Initial state.
    times : float or array_like, shape (n,)
        Times, monotonic from 0 forward or backward.
    level : str or Level
        Accuracy level.

    Returns
    -------
    Transition
        States and matrices at these times.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the times are not monotonic.
    WorkLimit
        If the orbit needs too many steps, or the matrix overflows.

    Examples
    --------
    >>> import numpy as np
    >>> from hess_mechanics import level, systems, transition_matrix
    >>> suslov = systems()["suslov"]
    >>> found = transition_matrix(*suslov.example_motion, 2.0, level("precise"))
    >>> bool(abs(np.log(np.linalg.det(found.matrices[-1])) - found.log_volume[-1]) < 1e-9)
    True
    """
    level = as_level(level)
    t = checked_times(np.atleast_1d(np.asarray(times, float)))
    problem, system = Problem.of(body, [state]), body.system
    scaled_times = problem.times(t)
    problems = (problem, problem.nearby())

    def run(level: Level, spent: int) -> tuple[tuple[Array, Array, Array], int]:
        steps, states, frames, volume = followed(
            system, problems[level.aside], scaled_times, level.order, level.tolerance, MAX_STEPS - spent
        )
        require_steps(
            steps,
            f"This motion needs more than {MAX_STEPS} steps: choose a shorter time span or a cheaper accuracy.",
            lambda: end_of(problem, problem.states[0], scaled_times[-1]),
        )
        require_finite_states(states)
        require_finite_neighbours(frames, volume)
        return (states, frames, volume), steps

    def apart(one: tuple[Array, Array, Array], other: tuple[Array, Array, Array]) -> float:
        largest = np.abs(other[1]).max(axis=(1, 2), keepdims=True)
        return max(float(np.abs(one[0] - other[0]).max()), float((np.abs(one[1] - other[1]) / largest).max()))

    found = measured(level, run, apart)
    states, frames, volume = found.result
    with np.errstate(over="ignore"):
        matrices = problem.scale[:, None] * frames / problem.scale
    require_finite_neighbours(matrices)
    return Transition(
        system.name,
        level.name,
        frozen(t),
        frozen(states * problem.scale),
        frozen(matrices),
        frozen(volume),
        found.status,
        found.error,
        found.cost,
        system.variables,
    )


def followed(
    system: System, problem: Problem, times: Array, order: int, tolerance: float, most_steps: int
) -> tuple[int, Array, Array, Array]:
    """Return the steps, the states (n, d), V (n, d, d) and ∫ tr J dt (n,) at the times (n,), in units of the problem.

    The number of steps is `STEP_LIMIT_REACHED` if `most_steps` do not suffice.
    """
    basis, speed = frame_ahead(system, problem, np.eye(len(system.variables)), _MOVES)
    steps, states, frames, _, volume = neighbours(
        system,
        problem.states[0],
        basis,
        problem.parameters,
        times,
        order,
        tolerance,
        most_steps,
        math.inf,
        speed > _MOVES,
    )
    return steps, states, frames @ basis.T, volume


def frame_ahead(system: System, problem: Problem, frame: Array, slow: float) -> tuple[Array, float]:
    """Return d orthonormal columns, the first one along f(y) at the start, the others from `frame`; and |f|.

    If |f| is at most `slow`, all columns come from the frame.  Raises `InvalidParameter` if |f| overflows.
    """
    try:
        rate = [float(x) for x in system.field(problem.states[0].tolist(), problem.parameters.tolist())]
    except ArithmeticError:
        rate = [math.inf]
    speed = math.hypot(*rate)
    require_finite_states(np.array(speed))
    return np.linalg.qr(np.column_stack([rate, frame]) if speed > slow else frame)[0], speed


def neighbours(
    system: System,
    state: Array,
    frame: Array,
    parameters: Array,
    times: Array,
    order: int,
    tolerance: float,
    most_steps: int,
    limit: float,
    ahead: bool,
) -> tuple[int, Array, Array, Array, Array]:
    """Return steps, states (n, d), V (n, d, d), logarithms (n, d) of the lengths removed from V, and ∫ tr J dt (n,).

    Parameters
    ----------
    system : System
        The equations of motion.
    state : ndarray, shape (d,)
        State y at time 0.
    frame : ndarray, shape (d, d)
        Orthonormal V at time 0.
    parameters : ndarray, shape (q,)
        Parameters of the system.
    times : ndarray, shape (n,)
        Times, monotonic from 0.
    order : int
        Order of the Taylor series.
    tolerance : float
        Local error of a step.
    most_steps : int
        Largest number of steps.
    limit : float
        Condition of V at which its columns are orthonormalised; ∞ for never.
    ahead : bool
        True if the first column is parallel to f(y), f(y) ≠ 0.  This column is known and never normalised; at the
        `limit` the others are made orthogonal to it.
    """
    size = len(system.variables)
    known = int(ahead and size > 1)
    states, volume = np.tile(state, (times.size, 1)), np.empty(times.size)
    frames, growth = np.empty((times.size, size, size - known)), np.empty((times.size, size - known))
    steps = (system.vary_others if known else system.vary)(
        state,
        np.ascontiguousarray(frame[:, known:]),
        parameters,
        times,
        order,
        tolerance,
        most_steps,
        limit,
        states,
        frames,
        growth,
        volume,
    )
    if known:
        # The caller checks for overflow.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            rates = np.stack(np.broadcast_arrays(*system.field(list(states.T), parameters.tolist())), axis=1)
        at_first = float(frame[:, 0] @ system.field(state.tolist(), parameters.tolist()))
        frames = np.concatenate([(rates / at_first)[:, :, None], frames], axis=2)
        growth = np.concatenate([np.zeros((times.size, 1)), growth], axis=1)
    return steps, states, frames, growth, volume


def onto_surface(matrix: Array, rate: Array, gradient: Array) -> Array:
    """Return the derivative (…, d, k) of the first return to a surface, from that of the flow, `matrix` (…, d, k).

    A neighbour arrives earlier or later: (1 − f nᵀ/(n·f)) V, where f is the `rate` ẏ (…, d) and n the `gradient` (…, d)
    of the surface at the crossing.  Raises `InvalidParameter` if an orbit is tangent to the surface.
    """
    across = (gradient * rate).sum(axis=-1)
    size = np.linalg.norm(gradient, axis=-1) * np.linalg.norm(rate, axis=-1)
    if not np.all(np.abs(across) > 1e-12 * size):
        raise InvalidParameter("The orbit touches the surface here and does not cross it: choose another start.")
    along = gradient[..., None, :] @ matrix / across[..., None, None]
    return np.asarray(matrix - rate[..., :, None] * along)


@dataclass(frozen=True)
class Return(Printed):
    """A return of an orbit to a surface.

    Attributes
    ----------
    time : float
        Time of the return.
    state : ndarray, shape (d,)
        State at the return.
    matrix : ndarray, shape (d, d)
        ∂y(return)/∂y(start).  Its columns are tangent to the surface, and it maps the direction of motion to 0.
    transition : Transition
        Derivative of the flow at that time, with its error and cost.
    """

    time: float
    state: Array
    matrix: Array
    transition: Transition


def return_matrix(
    body: Body, state: Sequence[float] | Array, surface: Surface, end: float, level: Accuracy, returns: int = 1
) -> Return | None:
    """Return the n-th return of an orbit to a surface, with its derivative.

    Parameters
    ----------
    body : Body
        The body.
    state : array_like, shape (d,)
        Initial state.
    surface : Plane or Surface
        The surface.
    end : float
        End of the time span; may be negative.
    level : str or Level
        Accuracy level.
    returns : int, default 1
        Number n of the return.

    Returns
    -------
    Return or None
        The return; None if the orbit does not return n times before `end`.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the orbit is tangent to the surface.
    WorkLimit
        If the orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import Plane, level, return_matrix, systems
    >>> suslov = systems()["suslov"]
    >>> found = return_matrix(*suslov.example_motion, Plane((0.0, 0.0, 0.0, 0.0, 1.0)), 50.0, level("precise"))
    >>> bool(abs(found.matrix[4]).max() < 1e-9)  # γ3 = 0 at the return
    True
    """
    crossings = section(body, state, surface, end, level, returns)
    if len(crossings.times) < returns:
        return None
    moment = float(crossings.times[-1])
    found = transition_matrix(body, state, moment, level)
    end_state = crossings.states[-1]
    rate = np.array(body.system.field(end_state.tolist(), list(body.parameters)), float)
    matrix = onto_surface(found.matrices[0], rate, surface.gradient(end_state))
    return Return(moment, end_state, frozen(matrix), found)
