"""How neighbours of an orbit move with it: ∂y(t)/∂y(0) by the variational equations, and return maps' derivatives.

V̇ = J(y(t)) V with V(0) = 1, J the Jacobian of the field, found by differentiating the traced field and integrated in
the same Taylor steps as the orbit (`numerics.variation_kernels`).  It exists for every system.

The neighbour ahead on the same orbit needs no integration: V f(y(0)) = f(y(t)).  Where the motion is not slow at its
start, d − 1 columns across f are followed: of five variables four, which fill one vector of the processor and not two.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import (
    MAX_STEPS,
    checked_times,
    require_finite_neighbours,
    require_finite_states,
    require_steps,
)
from hess_mechanics.dynamics.section import Surface, section
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
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
"""Of |f| in units in which states are O(1): what f(y(t)) is off is divided by it."""


@dataclass(frozen=True)
class Transition(Result):
    """∂y(t)/∂y(0) along an orbit.

    times : (n,); states : (n, d); matrices : (n, d, d), row i, column j: ∂y_i(t)/∂y_j(0), in the units of the states.
    log_volume : (n,), ∫ tr J dt, which is ln det of the matrix, found apart from it.
    error_estimate : the largest estimated error of a matrix beside its largest entry, in units in which states are
        O(1), or of a state.
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
        """The matrix over t and the names of its rows and columns, the states over t."""
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
    """∂y(t)/∂y(0) of the orbit from `state` (d,) at the given times (n,), monotonic from 0, or at one time.

    As in `solve`, all is computed twice, and again where the level's promise is not kept.
    Raises `InvalidParameter`, `WorkLimit`.

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
            steps, f"This motion needs more than {MAX_STEPS} steps: choose a shorter time span or a cheaper accuracy."
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
    """Steps, states (n, d), V (n, d, d) and ∫ tr J dt (n,) at the times (n,), all in the units of the problem.

    The number of steps is `STEP_LIMIT_REACHED` where they do not suffice.
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
    """Orthonormal columns (d, d), the first along the first motion, f(y), or against it, the others from a frame; |f|.

    Where |f| is at most `slow`: only from the frame.  Raises `InvalidParameter` where it is beyond double range.
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
    """Steps, states (n, d), V (n, d, d), ln of the lengths taken from V's columns (n, d) and ∫ tr J dt (n,).

    state (d,), frame (d, d), orthonormal : y and V at the time 0.  All as `variation_integrator` has them.
    ahead : whether the first column is along f(y) or against it, not 0, and so known; it is kept as it is, and at the
        `limit` the others are orthonormalised beside it.
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
        # Who asked for them looks whether they are numbers.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            rates = np.stack(np.broadcast_arrays(*system.field(list(states.T), parameters.tolist())), axis=1)
        at_first = float(frame[:, 0] @ system.field(state.tolist(), parameters.tolist()))
        frames = np.concatenate([(rates / at_first)[:, :, None], frames], axis=2)
        growth = np.concatenate([np.zeros((times.size, 1)), growth], axis=1)
    return steps, states, frames, growth, volume


def onto_surface(matrix: Array, rate: Array, gradient: Array) -> Array:
    """The derivative (d, d) of the first return to a surface, from that of the flow at the time of the crossing.

    A neighbour arrives earlier or later: (1 − f nᵀ/(n·f)) V, with f the `rate` ẏ and n the `gradient` of the surface at
    the crossing.  Raises `InvalidParameter` where the orbit touches the surface.
    """
    across = float(gradient @ rate)
    if not abs(across) > 1e-12 * float(np.linalg.norm(gradient) * np.linalg.norm(rate)):
        raise InvalidParameter("The orbit touches the surface here and does not cross it: choose another start.")
    return np.asarray(matrix - np.outer(rate, gradient @ matrix) / across)


@dataclass(frozen=True)
class Return:
    """A return of an orbit to a surface: when, where, and ∂y(return)/∂y(start).

    matrix : (d, d); its columns are tangent to the surface, and it takes the direction of the motion to 0.
    transition : the derivative of the flow up to that time, with its error and cost.
    """

    time: float
    state: Array
    matrix: Array
    transition: Transition


def return_matrix(
    body: Body, state: Sequence[float] | Array, surface: Surface, end: float, level: Accuracy, returns: int = 1
) -> Return | None:
    """The return of this number to the surface before the time `end`, which may be negative; None if there is none.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import Plane, level, return_matrix, systems
    >>> suslov = systems()["suslov"]
    >>> found = return_matrix(*suslov.example_motion, Plane((0.0, 0.0, 0.0, 0.0, 1.0)), 50.0, level("precise"))
    >>> bool(abs(found.matrix[4]).max() < 1e-9)  # where it returns to, γ3 is 0
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
