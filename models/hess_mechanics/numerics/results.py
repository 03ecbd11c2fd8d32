"""Results of computations: frozen, with read-only arrays, an error estimate and the cost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.numerics.labelled import Labels, Result

__all__ = ["Array", "Complex", "Cost", "Ensemble", "Mask", "Orbit", "SectionCrossings", "facts_of", "frozen", "unit_of"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

_Item = TypeVar("_Item", bound=np.generic)


def frozen(array: NDArray[_Item]) -> NDArray[_Item]:
    """The same array, read-only: results are cached and shared between sessions."""
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Cost:
    """Taylor steps of all runs together, and wall-clock milliseconds."""

    steps: int
    wall_ms: float


def unit_of(variable: str) -> str:
    """The unit of a variable of a system, T the unit of time and I that of moments of inertia."""
    return {"ω": "rad/T", "w": "rad/T", "M": "I/T"}.get(variable[0], "1")


def facts_of(result: Any) -> dict[str, Any]:
    """What every result says of its runs: level, status, error estimate, drifts where it has them, steps."""
    return {
        "level": result.level,
        "status": str(result.status),
        "error_estimate": result.error_estimate,
        **{f"drift of {name}": value for name, value in getattr(result, "drift", {}).items()},
        "steps": result.cost.steps,
    }


def _labels(result: Orbit | Ensemble | SectionCrossings, dims: tuple[str, ...]) -> Labels:
    """Times along the last of the dimensions, and a variable for each component of the state."""
    names = result.variables or tuple(f"y{i + 1}" for i in range(result.states.shape[-1]))
    variables = {name: (dims, result.states[..., i]) for i, name in enumerate(names)}
    units = {"t": "T", **{name: unit_of(name) for name in names}}
    return Labels({"t": (dims[-1:], result.times)}, variables, units, {"system": result.system, **facts_of(result)})


@dataclass(frozen=True)
class Orbit(Result):
    """A trajectory sampled at given times.

    times : (n,); states : (n, d), in the order of the system's `variables`.
    error_estimate : largest estimated error of any component at any sample, absolute.
    drift : for each integral, max |F(t) − F(0)|, relative to |F(0)| where that exceeds 1; variables : names.
    """

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...] = ()

    def labels(self) -> Labels:
        """The variables of the system over t."""
        return _labels(self, ("t",))


@dataclass(frozen=True)
class Ensemble(Result):
    """Many trajectories sampled at the same times.

    times : (m,); states : (n, m, d); errors : (n,), largest estimated error of each orbit;
    drift : as in `Orbit`, the largest over all orbits.
    """

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    errors: Array
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...] = ()

    def labels(self) -> Labels:
        """The variables of the system over orbit and t."""
        return _labels(self, ("orbit", "t"))

    @property
    def error_estimate(self) -> float:
        """Of any orbit."""
        return float(np.max(self.errors, initial=0.0))


@dataclass(frozen=True)
class SectionCrossings(Result):
    """Crossings of a surface by one orbit: times (n,), states (n, d), the rest as in `Orbit`."""

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...] = ()

    def labels(self) -> Labels:
        """The variables of the system at the crossings, and when these are."""
        return _labels(self, ("crossing",))
