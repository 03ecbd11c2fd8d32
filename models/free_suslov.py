"""S2: the Suslov problem without a field, b = 0 (`biz132`).

ω(t) does not depend on γ, and γ̇ = γ × ω is linear: one rotation carries every γ(0) to its γ(t).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .accuracy import Level, Status
from .ensemble import ensemble
from .errors import InvalidParameter
from .results import Array, Cost, frozen
from .suslov import SYSTEM, SuslovBody

__all__ = ["Rotation", "rotation"]


@dataclass(frozen=True)
class Rotation:
    """The motion of all γ that share one ω(0).

    times : (m,); omega : (m, 2); matrices : (m, 3, 3), γ(t) = matrix · γ(0).
    """

    times: Array
    omega: Array
    matrices: Array
    status: Status
    error_estimate: float
    cost: Cost

    def carry(self, gamma: Array) -> Array:
        """γ(t) for every γ(0) in the rows of gamma (n, 3); shape (n, m, 3)."""
        return np.einsum("mij,nj->nmi", self.matrices, np.asarray(gamma, float))


def rotation(body: SuslovBody, omega: Sequence[float], times: Sequence[float] | Array, level: Level) -> Rotation:
    """The rotation along the motion that starts with ω(0), from the orbits of the three unit vectors.

    Raises `InvalidParameter` (a field, times out of order), `WorkLimit`.
    """
    if any(body.parameters[4:]):
        raise InvalidParameter("Only without a field, b = 0, is the motion of γ one rotation.")
    found = ensemble(SYSTEM, [(*omega, *axis) for axis in np.eye(3)], body.parameters, times, level)
    columns = found.states[:, :, 2:]
    return Rotation(found.times, frozen(found.states[0, :, :2].copy()), frozen(np.moveaxis(columns, 0, 2).copy()),
                    found.status, float(found.errors.max()), found.cost)
