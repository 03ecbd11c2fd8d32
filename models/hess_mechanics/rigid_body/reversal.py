"""Reversals: times at which a body with ω3 = 0 changes the sense of its rotation about the vertical.

Its rate about the vertical is w = (ω, γ), as |γ| = 1; it reverses where w passes through 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

import numpy as np

from hess_mechanics.dynamics.plane_section import section
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, SectionCrossings
from hess_mechanics.rigid_body.reversal_kernels import NO_TURN

__all__ = ["Reversal", "rate", "reversals"]

_VARIABLES = ("ω1", "ω2", "γ1", "γ2", "γ3")
MAX_REVERSALS = 5000
"""Largest number of reversals of one motion."""


@dataclass(frozen=True)
class Reversal:
    """The surface (ω, γ) = 0, crossed in either sense."""

    sense: ClassVar[int] = 0

    def gradient(self, state: Array) -> Array:
        """Return the gradient of (ω, γ).

        Parameters
        ----------
        state : ndarray, shape (5,)
            State (ω1, ω2, γ1, γ2, γ3).

        Returns
        -------
        ndarray, shape (5,)
            Derivatives with respect to the state.
        """
        return np.array([*state[2:4], *state[:2], 0.0])

    def crossing_kernel(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """Return the kernel that finds crossings of the surface, see `plane_section.Surface`.

        Parameters
        ----------
        system : System
            System with the variables (ω1, ω2, γ1, γ2, γ3).
        problem : Problem
            Not used: the surface does not depend on the parameters.

        Returns
        -------
        kernel : callable
            The kernel.
        normal : ndarray, shape (1,)
            0, not used by this surface.
        offset : float
            Value of (ω, γ) on the surface, 0.

        Raises
        ------
        InvalidParameter
            If the system has other variables.
        """
        if system.variables != _VARIABLES:
            raise InvalidParameter(
                f"{system.title} has no reversals: give a system with the variables {', '.join(_VARIABLES)}."
            )
        return _cross(system), np.zeros(1), 0.0


@cache
def _cross(system: System) -> Callable[..., Any]:
    return system.surface_kernel("turn", NO_TURN)


def rate(states: Array) -> Array:
    """Return the rate (ω, γ) of rotation about the vertical.

    Parameters
    ----------
    states : ndarray, shape (n, 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (n,)
        Rates, in rad/T.
    """
    return np.asarray(states[:, 0] * states[:, 2] + states[:, 1] * states[:, 3])


def reversals(body: Body, start: Sequence[float], duration: float, accuracy: Accuracy) -> SectionCrossings:
    """Return the reversals of a motion, the times at which (ω, γ) changes sign, up to the first 5000.

    Parameters
    ----------
    body : Body
        Body of a system with the variables (ω1, ω2, γ1, γ2, γ3).
    start : sequence of float, shape (5,)
        Initial state.
    duration : float
        Time, any finite number; negative: backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    SectionCrossings
        Times and states.

    Raises
    ------
    InvalidParameter
        If a number is out of range, or the system has other variables.
    WorkLimit
        If the motion needs too many steps.
    """
    return section(body, start, Reversal(), duration, accuracy, MAX_REVERSALS)
