"""Result types: immutable, with read-only arrays, an error estimate and the cost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.numerics.labelled import Labels, Result, components

__all__ = [
    "Array",
    "Complex",
    "Cost",
    "Ensemble",
    "Mask",
    "Orbit",
    "Sampled",
    "SectionCrossings",
    "angle_convention",
    "angle_facts",
    "as_read_only",
    "facts_of",
    "unit_of",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

_Item = TypeVar("_Item", bound=np.generic)


def as_read_only(array: NDArray[_Item]) -> NDArray[_Item]:
    """Return the same array, made read-only, because results are cached and shared.

    Parameters
    ----------
    array : ndarray
        The array; it becomes read-only itself.

    Returns
    -------
    ndarray
        The same array.
    """
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Cost:
    """Cost of a computation.

    Attributes
    ----------
    steps : int
        Taylor steps of all runs together, ≥ 0.
    wall_ms : float
        Wall-clock time in milliseconds, ≥ 0.
    """

    steps: int
    wall_ms: float


def unit_of(variable: str) -> str:
    """Return the unit of a variable of a system.

    Parameters
    ----------
    variable : str
        Name of the variable, such as "ω1".

    Returns
    -------
    str
        The unit, with T the unit of time and I that of moments of inertia; "1" if it has none.
    """
    return {"ω": "rad/T", "w": "rad/T", "M": "I/T"}.get(variable[0], "1")


def facts_of(result: Any) -> dict[str, Any]:
    """Return the facts common to results with an error estimate.

    Parameters
    ----------
    result : object
        A result with `level`, `status`, `error_estimate` and `cost`.

    Returns
    -------
    dict
        Level, status, error estimate, time error and drifts if there are any, and steps, by name.
    """
    return {
        "level": result.level,
        "status": str(result.status),
        "error_estimate": result.error_estimate,
        **({"time_error": result.time_error} if hasattr(result, "time_error") else {}),
        **{f"drift of {name}": value for name, value in getattr(result, "drift", {}).items()},
        "steps": result.cost.steps,
    }


def angle_convention(counts: bool) -> str:
    """Return the remark on an angle in the facts of a result.

    Parameters
    ----------
    counts : bool
        True if the angle is unwrapped, not reduced to one turn.

    Returns
    -------
    str
        The remark.
    """
    return "counts on over full turns" if counts else "within one turn"


def angle_facts(angles: Iterable[str], counts: bool = True) -> dict[str, str]:
    """Return the facts of a result about its angles.

    Parameters
    ----------
    angles : iterable of str
        Names of the angles.
    counts : bool, default True
        True if they are unwrapped, not reduced to one turn.

    Returns
    -------
    dict of str to str
        The remark on each angle, by "angle" and its name.
    """
    return {f"angle {name}": angle_convention(counts) for name in angles}


@dataclass(frozen=True)
class Sampled(Result):
    """States of a motion at several times; base class of orbits, ensembles and section crossings.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times, in units T.
    states : ndarray, shape (n, d)
        States, in the order of `variables`.
    status : Status
        How the computation ended.
    error_estimate : float
        Largest estimated error of any component at any time, ≥ 0, in the unit of the component.
    drift : dict of str to float
        max |F(t) − F(0)| of each integral F, relative to |F(0)| if that exceeds 1.
    cost : Cost
        Steps and time.
    variables : tuple of str
        Names of the variables.
    angles : tuple of str
        Names of those that are angles; they are unwrapped, not reduced to one turn.
    """

    dims: ClassVar[tuple[str, ...]] = ("t",)
    """Names of the dimensions of the states; the last one is that of the times."""

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...]
    angles: tuple[str, ...] = field(default=(), kw_only=True)

    def labels(self) -> Labels:
        """Return the variables of the system, labelled with time.

        Returns
        -------
        Labels
            The variables over the times.
        """
        return Labels(
            {"t": (self.dims[-1:], self.times)},
            components(self.variables, self.states, *self.dims),
            {"t": "T", **{name: "rad" if name in self.angles else unit_of(name) for name in self.variables}},
            {
                "system": self.system,
                **facts_of(self),
                **angle_facts(self.angles),
            },
        )


@dataclass(frozen=True)
class Orbit(Sampled):
    """A trajectory, sampled at given times.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times, in units T.
    states : ndarray, shape (n, d)
        States, in the order of `variables`.
    status : Status
        How the computation ended.
    error_estimate : float
        Largest estimated error of any component at any time, ≥ 0, in the unit of the component.
    drift : dict of str to float
        max |F(t) − F(0)| of each integral F, relative to |F(0)| if that exceeds 1.
    cost : Cost
        Steps and time.
    variables : tuple of str
        Names of the variables.
    angles : tuple of str
        Names of those that are angles; they are unwrapped, not reduced to one turn.
    reason : str
        Why the motion ends before the time span does, with time and place; empty if it does not.
    """

    reason: str = ""


@dataclass(frozen=True)
class Ensemble(Sampled):
    """Several trajectories, sampled at the same times.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (m,)
        Times, in units T.
    states : ndarray, shape (n, m, d)
        States of the n orbits, in the order of `variables`.
    status : Status
        How the computation ended, for the least accurate orbit.
    error_estimate : float
        Largest estimated error of any component at any time of any orbit, ≥ 0, in the unit of the component.
    drift : dict of str to float
        Largest drift of each integral over all orbits, see `Orbit`.
    cost : Cost
        Steps and time.
    variables : tuple of str
        Names of the variables.
    angles : tuple of str
        Names of those that are angles; they are unwrapped, not reduced to one turn.
    errors : ndarray, shape (n,)
        Largest estimated error of each orbit, ∞ for one that is incomplete.
    statuses : tuple of Status
        How each orbit ended.
    ends : ndarray, shape (n,)
        Time up to which each orbit was followed; its states after it are NaN.
    last_states : ndarray, shape (n, d)
        State of each orbit at that time.
    reasons : tuple of str
        Why each orbit is incomplete, in a sentence; empty for one that is complete.
    """

    dims = ("orbit", "t")

    errors: Array
    statuses: tuple[Status, ...]
    ends: Array
    last_states: Array
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class SectionCrossings(Sampled):
    """Crossings of a surface by one orbit.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times of the crossings, in units T.
    states : ndarray, shape (n, d)
        States at the crossings, in the order of `variables`.
    status : Status
        How the computation ended.
    error_estimate : float
        Largest estimated error of any component at any crossing, ≥ 0, in the unit of the component.
    drift : dict of str to float
        max |F(t) − F(0)| of each integral F, relative to |F(0)| if that exceeds 1.
    cost : Cost
        Steps and time.
    variables : tuple of str
        Names of the variables.
    angles : tuple of str
        Names of those that are angles; they are unwrapped, not reduced to one turn.
    time_error : float
        Largest estimated error of any time, ≥ 0, in units T.  It grows along a conservative motion, even where the
        error of the states does not.
    """

    dims = ("crossing",)

    time_error: float
