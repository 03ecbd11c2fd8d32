"""Results of computations: frozen, with read-only arrays, an error estimate and the cost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
    "facts_of",
    "frozen",
    "unit_of",
]

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


@dataclass(frozen=True)
class Sampled(Result):
    """States of a motion at some times.

    times : (n,); states : (n, d), in the order of the system's `variables`.
    error_estimate : largest estimated error of any component at any sample, absolute.
    drift : for each integral, max |F(t) − F(0)|, relative to |F(0)| where that exceeds 1; variables : names.
    """

    dims: ClassVar[tuple[str, ...]] = ("t",)
    """Dimensions of the states; the times run along the last of them."""

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...]

    def labels(self) -> Labels:
        """The variables of the system over the dimensions."""
        return Labels(
            {"t": (self.dims[-1:], self.times)},
            components(self.variables, self.states, *self.dims),
            {"t": "T", **{name: unit_of(name) for name in self.variables}},
            {"system": self.system, **facts_of(self)},
        )


@dataclass(frozen=True)
class Orbit(Sampled):
    """A trajectory sampled at given times."""


@dataclass(frozen=True)
class Ensemble(Sampled):
    """Many trajectories sampled at the same times.

    times : (m,); states : (n, m, d); drift : the largest over all orbits.
    errors : (n,), largest estimated error of each orbit.
    """

    dims = ("orbit", "t")

    errors: Array


@dataclass(frozen=True)
class SectionCrossings(Sampled):
    """Crossings of a surface by one orbit."""

    dims = ("crossing",)
