"""How neighbours of an orbit move with it: ∂y(t)/∂y(0) by the variational equations, and return maps' derivatives.

V̇ = J(y(t)) V with V(0) = 1, J the Jacobian of the field, found by differentiating the traced field and integrated in
the same Taylor steps as the orbit (`numerics.variation_kernels`).  It exists for every system.

The neighbour ahead on the same orbit needs no integration: V f(y(0)) = f(y(t)).  Where the motion is not slow at its
start, d − 1 columns across f are followed: of five variables four, which fill one vector of the processor and not two.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import MAX_STEPS, checked_times, require_finite_states, status_of
from hess_mechanics.dynamics.section import Plane, Surface, section
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Level, Status
from hess_mechanics.numerics.labelled import Labelled, Labels
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array, Cost, frozen
from hess_mechanics.numerics.taylor_kernels import STEP_LIMIT_REACHED

__all__ = ["Return", "Transition", "followed", "onto_surface", "return_matrix", "transition_matrix"]

_MOVES = 0.1
"""Of |f| in units in which states are O(1): what f(y(t)) is off is divided by it."""


@dataclass(frozen=True)
class Transition(Labelled):
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
            {"derivative": (("t", "of", "by"), self.matrices)}, {"t": "T"},
            {"system": self.system, "level": self.level, "status": str(self.status),
             "error_estimate": self.error_estimate, "steps": self.cost.steps})


def transition_matrix(system: System, state: Sequence[float] | Array, parameters: Sequence[float],
                      times: float | Sequence[float] | Array, level: Level) -> Transition:
    """∂y(t)/∂y(0) of the orbit from `state` (d,) at the given times (n,), monotonic from 0, or at one time.

    As in `solve`, all is computed twice, and again where the level's promise is not kept.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> import numpy as np
    >>> from hess_mechanics import level, systems, transition_matrix
    >>> suslov = systems()["suslov"]
    >>> found = transition_matrix(suslov, *suslov.example, 2.0, level("precise"))
    >>> bool(abs(np.log(np.linalg.det(found.matrices[-1])) - found.log_volume[-1]) < 1e-9)
    True
    """
    begun = time.perf_counter()
    t = checked_times(np.atleast_1d(np.asarray(times, float)))
    problem = Problem.of(system, [state], parameters)
    scaled_times = problem.times(t)
    total = 0

    def run(level: Level) -> tuple[Array, Array, Array]:
        nonlocal total
        steps, states, frames, volume = followed(system, problem, scaled_times, level.order, level.tolerance,
                                                 MAX_STEPS - total)
        if steps == STEP_LIMIT_REACHED:
            raise WorkLimit(f"This time span needs more than {MAX_STEPS} steps: choose a shorter one, or a cheaper "
                            "level.")
        require_finite_states(states)
        if not np.all(np.isfinite(frames)):
            raise WorkLimit("Neighbours part beyond the range of double precision: choose a shorter time span.")
        total += steps
        return states, frames, volume

    current = level
    coarse = run(current)
    while True:
        go_on()
        tighter = current.tightened()
        fine = run(tighter)
        safety = 4.0 if current.is_floor else 1.25
        largest = np.abs(fine[1]).max(axis=(1, 2), keepdims=True)
        error = safety * max(float(np.abs(coarse[0] - fine[0]).max()),
                             float((np.abs(coarse[1] - fine[1]) / largest).max())) + 2e-16
        if error <= level.promise or current.is_floor:
            break
        current, coarse = tighter, fine
    states, frames, volume = coarse
    matrices = problem.scale[:, None] * frames / problem.scale
    return Transition(system.name, level.name, frozen(t), frozen(states * problem.scale), frozen(matrices),
                      frozen(volume), status_of(error, level), error,
                      Cost(total, (time.perf_counter() - begun) * 1e3), system.variables)


def followed(system: System, problem: Problem, times: Array, order: int, tolerance: float, most_steps: int
             ) -> tuple[int, Array, Array, Array]:
    """Steps, states (n, d), V (n, d, d) and ∫ tr J dt (n,) at the times (n,), all in the units of the problem.

    The number of steps is `STEP_LIMIT_REACHED` where they do not suffice.
    """
    size, p = len(system.variables), problem.parameters.tolist()
    rate = np.array(system.field(problem.states[0].tolist(), p), float)
    speed = float(np.linalg.norm(rate))
    others = speed > _MOVES
    # Orthonormal, the first column along the motion or against it.
    basis = np.linalg.qr(np.column_stack([rate, np.eye(size)]))[0] if others else np.eye(size)
    columns = np.ascontiguousarray(basis[:, int(others):])
    states, frames = np.empty((times.size, size)), np.empty((times.size, size, size - int(others)))
    volume = np.empty(times.size)
    steps = (system.vary_others if others else system.vary)(
        problem.states[0], columns, problem.parameters, times, order, tolerance, most_steps, math.inf, states, frames,
        np.empty((times.size, size - int(others))), volume)
    if not others or steps == STEP_LIMIT_REACHED:
        return steps, states, frames, volume
    ahead = np.stack(np.broadcast_arrays(*system.field(list(states.T), p)), axis=1) / speed
    matrices = ahead[:, :, None] * (rate / speed) + frames @ columns.T
    return steps, states, matrices, volume


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


def return_matrix(system: System, state: Sequence[float] | Array, parameters: Sequence[float], surface: Surface,
                  end: float, level: Level, returns: int = 1, gradient: Sequence[float] | Array | None = None
                  ) -> Return | None:
    """The return of this number to the surface before the time `end`, which may be negative; None if there is none.

    gradient : of the surface at the crossing; that of a `Plane` is its normal.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import Plane, level, return_matrix, systems
    >>> suslov = systems()["suslov"]
    >>> found = return_matrix(suslov, *suslov.example, Plane((0.0, 0.0, 0.0, 0.0, 1.0)), 50.0, level("precise"))
    >>> bool(abs(found.matrix[4]).max() < 1e-9)  # where it returns to, γ3 is 0
    True
    """
    if gradient is None:
        if not isinstance(surface, Plane):
            raise InvalidParameter("Give the gradient of this surface at the crossing: only that of a plane is known.")
        gradient = surface.normal
    crossings = section(system, state, parameters, surface, end, level, returns)
    if len(crossings.times) < returns:
        return None
    moment = float(crossings.times[-1])
    found = transition_matrix(system, state, parameters, moment, level)
    rate = np.array(system.field(crossings.states[-1].tolist(), list(parameters)), float)
    return Return(moment, crossings.states[-1], frozen(onto_surface(found.matrices[0], rate, np.asarray(gradient))),
                  found)
