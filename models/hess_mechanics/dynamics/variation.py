"""Variational equations: the derivative ∂y(t)/∂y(0) along an orbit, and derivatives of return maps.

V̇ = J(y(t)) V with V(0) = 1, where J is the Jacobian of the field.  J comes from differentiating the traced field and
is integrated in the same Taylor steps as the orbit (`numerics.variation_kernels`), so V exists for every system.

The column along the motion needs no integration: V f(y(0)) = f(y(t)).  Unless the motion is slow at its start, only the
d − 1 columns across f are integrated: for five variables four, which fill one vector register instead of two.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
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
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.results import Array, Cost, facts_of, frozen

__all__ = [
    "LONGEST",
    "Tangent",
    "Transition",
    "frame_ahead",
    "one_direction",
    "onto_surface",
    "tangent",
    "transition_matrix",
]

LONGEST = 1e6
"""Length at which a single vector is normalised."""
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
    body: Body, start: Sequence[float] | Array, times: float | Sequence[float] | Array, accuracy: Accuracy
) -> Transition:
    """Return the transition matrix ∂y(t)/∂y(0) along an orbit.

    As in `solve`, everything is computed twice, and again if the promise of the level is missed.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state.
    times : float or array_like, shape (n,)
        Times, monotonic from 0 forward or backward.
    accuracy : str or Level
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
    level = as_level(accuracy)
    t = checked_times(np.atleast_1d(np.asarray(times, float)))
    problem, system = Problem.of(body, [start]), body.system
    scaled_times = problem.times(t)
    problems = (problem, problem.nearby())

    def run(level: Level, spent: int) -> tuple[tuple[Array, Array, Array], int]:
        own = problems[level.aside]
        basis, speed = frame_ahead(own, np.eye(len(system.variables)), _MOVES)
        found = tangent(own, own.states[0], basis, scaled_times, level, ahead=speed > _MOVES, spent=spent)
        return (found.states, found.vectors @ basis.T, found.volume), found.steps

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


@dataclass(frozen=True)
class Tangent:
    """An orbit with k tangent vectors δ, δ̇ = J δ, at n times, in units of the problem.

    steps : number of steps; states (n, d); vectors (n, d, k); removed (n, k) : logarithms of the lengths that were
    removed from the vectors; volume (n,) : ∫ tr J dt.
    """

    steps: int
    states: Array
    vectors: Array
    removed: Array
    volume: Array

    @property
    def lengths(self) -> Array:
        """Logarithms (n, k) of the lengths of the vectors."""
        return np.asarray(self.removed + np.log(np.linalg.norm(self.vectors, axis=1)))


def one_direction(size: int) -> Array:
    """Return a unit vector (d, 1) in a direction that no symmetry singles out."""
    direction = np.cos(1.0 + np.arange(size) ** 2)
    return np.asarray(direction / np.linalg.norm(direction))[:, None]


def frame_ahead(problem: Problem, frame: Array, slow: float) -> tuple[Array, float]:
    """Return d orthonormal columns, the first one along f(y) at the start, the others from `frame`; and |f|.

    If |f| is at most `slow`, all columns come from the frame.  Raises `InvalidParameter` if |f| overflows.
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
    limit: float = math.inf,
    ahead: bool = False,
    spent: int = 0,
    where: Callable[[], WorkLimit | None] | None = None,
) -> Tangent:
    """Integrate the orbit from a state with tangent vectors.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    start : ndarray, shape (d,)
        State at time 0.
    vectors : ndarray, shape (d, k)
        Vectors at time 0, k = 1 or d.
    times : ndarray, shape (n,)
        Times, monotonic from 0.
    level : Level
        Order and tolerance of the steps.
    limit : float, default ∞
        Condition of the vectors, or length of a single one, at which they are orthonormalised.
    ahead : bool, default False
        True if the first of d vectors is parallel to f(y), f(y) ≠ 0.  This vector is known and never normalised; at the
        `limit` the others are made orthogonal to it.
    spent : int, default 0
        Steps that other runs have used up.
    where : callable, optional
        Function that returns the error of a motion that stops.  By default that of the motion from `start`.

    Returns
    -------
    Tangent
        The orbit and its vectors.

    Raises
    ------
    InvalidParameter, WorkLimit
        If the motion or a neighbour cannot be followed to the last time.
    """
    system, p, (d, k) = problem.system, problem.parameters, vectors.shape
    known = int(ahead and d > 1)
    vary = system.vary_others if known else system.vary_one if k == 1 else system.vary
    states, volume = np.empty((times.size, d)), np.empty(times.size)
    found, removed = np.empty((times.size, d, k - known)), np.empty((times.size, k - known))
    own, options = np.ascontiguousarray(vectors[:, known:]), (level.order, level.tolerance, MAX_STEPS - spent, limit)
    steps = vary(start, own, p, times, *options, states, found, removed, volume)
    require_steps(
        steps,
        f"This motion needs more than {MAX_STEPS} steps: choose a shorter time span or a cheaper accuracy.",
        where or (lambda: end_of(problem, start, float(times[-1]))),
    )
    require_finite_states(states)
    if known:
        # An overflow is found below.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            along = system.rates(states, p) / (vectors[:, 0] @ system.field(start.tolist(), p.tolist()))
        found = np.concatenate([along[:, :, None], found], axis=2)
        removed = np.concatenate([np.zeros((times.size, 1)), removed], axis=1)
    require_finite_neighbours(found, removed, volume)
    return Tangent(steps, states, found, removed, volume)


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
