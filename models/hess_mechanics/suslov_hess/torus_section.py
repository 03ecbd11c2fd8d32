"""Section of one Suslov–Hess torus: n3 increases through the middle of its range; the coordinate is the angle of w.

At fixed (h, f), units b = 1, let w = ρ (sin φ, cos φ), ρ² = 2(h + n3), at n3 = (n3^(1) + n3^(2))/2.  Then

    (n1, n2) = (f/ρ) w/ρ + √(1 − n3² − f²/ρ²) (cos φ, −sin φ),   as ṅ3 = n1 w2 − n2 w1 > 0.

The return map is conjugate to Θ of `circle_map`, whose section is the lower turning point n3 = n3^(1): the multipliers
of both are equal.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.motions import section_motions, with_default
from hess_mechanics.dynamics.plane_section import Plane
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import PRECISE
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, turning_points
from hess_mechanics.suslov_hess.circle_map import circle_map
from hess_mechanics.suslov_hess.equations import SYSTEM

__all__ = ["SECTION", "TorusSection"]


@dataclass(frozen=True)
class TorusSection(PoincareSection):
    """Section of the torus (h, f) of the reduced equations, in units b = 1, with the coordinate φ.

    Parameters
    ----------
    a : float
        Inertia parameter a = I23/I22, any finite number.
    h : float
        Energy, h > −1.
    f : float
        Area integral, |f| ≤ f_max(h).
    """

    a: float
    h: float
    f: float

    names: ClassVar[tuple[str]] = ("φ",)
    turns: ClassVar[tuple[float]] = (2.0 * math.pi,)
    window: ClassVar[tuple[tuple[float, float], ...]] = ((-math.pi, math.pi),)
    system: ClassVar[System] = SYSTEM

    @cached_property
    def turning_points(self) -> TurningPoints:
        """The turning points of n3."""
        return turning_points(self.h, self.f)

    @property
    def n3(self) -> float:
        """The value of n3 on the section, the middle of its range."""
        return 0.5 * (self.turning_points.roots[1] + self.turning_points.roots[2])

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters a and b = 1."""
        return (self.a, 1.0)

    @property
    def surface(self) -> Plane:
        """The plane of constant n3, crossed while n3 increases."""
        return Plane((0.0, 0.0, 0.0, 0.0, 1.0), self.n3)

    @property
    def slowness(self) -> float:
        """A tenth of the period of n3 times the bound √(2(h + 3)) on the angular velocity, at least 1."""
        return max(1.0, 0.1 * self.turning_points.period * math.sqrt(2.0 * (self.h + 3.0)))

    @property
    def constants(self) -> Mapping[str, float]:
        """The constants a, h and f."""
        return {"a": self.a, "h": self.h, "f": self.f}

    @cached_property
    def measure(self) -> str:
        """Reason, in words, why the torus has a smooth invariant measure; empty if none is known."""
        # There is no circle map on the separatrix, nor for |a| > 1e6.
        with suppress(ModelError):
            if circle_map(self.a, self.h, self.f, PRECISE).kind == "elliptic":
                return "the trace of the circle map is below 2, so the torus has a smooth invariant measure"
        return ""

    def at_constant(self, name: str, value: float) -> TorusSection:
        """Return the section with another value of one constant.

        Parameters
        ----------
        name : str
            Name of the constant, "a", "h" or "f".
        value : float
            Its new value.

        Returns
        -------
        TorusSection
            The other section.
        """
        return replace(self, **{name: value})

    def states_at(self, phi: Array) -> tuple[Array, Mask]:
        """Return the states at points of the section.

        Parameters
        ----------
        phi : ndarray, shape (n,)
            Angles φ, in radians.

        Returns
        -------
        states : ndarray, shape (n, 5)
            States (w1, w2, n1, n2, n3).
        possible : ndarray of bool, shape (n,)
            True for every finite angle.

        Raises
        ------
        OutsideRegion
            If no motion has this h and f.
        Separatrix
            If h = 1 and f = 0.
        """
        n3 = self.n3
        rho = math.sqrt(2.0 * (self.h + n3))
        along = self.f / rho
        across = math.sqrt(max(0.0, 1.0 - n3 * n3 - along * along))
        s, c = np.sin(phi), np.cos(phi)
        gamma = along * s + across * c, along * c - across * s, np.full(s.size, n3)
        return np.column_stack([rho * s, rho * c, *gamma]), np.isfinite(s)

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie.

        Parameters
        ----------
        states : ndarray, shape (n, 5)
            States of the section.

        Returns
        -------
        ndarray, shape (n, 1)
            Angles φ, −π to π, in radians.
        """
        return np.arctan2(states[:, :1], states[:, 1:2])


SECTION = section_motions(
    "torus",
    "Suslov–Hess case, a point of a torus",
    (with_default(known.A_HESS, 0.7), with_default(known.H_HESS, 0.5), known.F_HESS),
    (with_default(known.CIRCLE_PHASE, 1.0),),
    lambda values: TorusSection(values["a"], values["h"], values["f"]),
    SYSTEM,
)
"""Motions from the middle of the range of n3, on the torus (h, f) in units b = 1."""
