"""Results of computations: frozen, with read-only arrays, an error estimate and the cost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.numerics.accuracy import Status

__all__ = ["Array", "Complex", "Cost", "Ensemble", "Mask", "Orbit", "Section", "frozen"]

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


@dataclass(frozen=True)
class Orbit:
    """A trajectory sampled at given times.

    times : (n,); states : (n, d), in the order of the system's `variables`.
    error_estimate : largest estimated error of any component at any sample, absolute.
    drift : for each integral, max |F(t) − F(0)|, relative to |F(0)| where that exceeds 1.
    """

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    notes: tuple[str, ...] = field(default=())


@dataclass(frozen=True)
class Ensemble:
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


@dataclass(frozen=True)
class Section:
    """Crossings of a surface by one orbit: times (n,), states (n, d), the rest as in `Orbit`."""

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
