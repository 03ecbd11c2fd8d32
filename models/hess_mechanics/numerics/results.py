"""What computations return: frozen, with read-only arrays, an error estimate and the cost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.numerics.accuracy import Status

__all__ = ["Array", "Cost", "Ensemble", "Orbit", "Section", "frozen"]

Array = NDArray[np.float64]


def frozen(array: Array) -> Array:
    """The same array, read-only: results are shared by every session that asks for them."""
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Cost:
    """Taylor steps taken (all runs together) and wall-clock milliseconds."""

    steps: int
    wall_ms: float


@dataclass(frozen=True)
class Orbit:
    """A trajectory sampled at given times.

    times : (n,); states : (n, d), in the order of the system's `variables`.
    error_estimate : the largest estimated error of any component at any sample.
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

    times : (m,); states : (n, m, d); errors : (n,) the largest estimated error of each orbit;
    drift : for each integral the largest over all orbits, as in `Orbit`.
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
    """The crossings of a plane by one orbit: times (n,), states (n, d), the rest as in `Orbit`."""

    system: str
    level: str
    times: Array
    states: Array
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
