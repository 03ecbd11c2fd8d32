"""Sections γ_k = 0 of the Suslov problem with gravity at an energy E, F1 = 1, in coordinates that cover them.

At an upward crossing of γ_k = 0, ψ is the angle of γ in the plane of the other two axes, and δ ∈ (0, π) the angle of
the direction u of ω = |ω|u from the direction that conserves γ_k:

    k = 3: γ = (cos ψ, sin ψ, 0),  u = (cos(ψ+δ), sin(ψ+δ)),        as γ̇3 = γ1ω2 − γ2ω1;
    k = 1: γ = (0, cos ψ, sin ψ),  u = −sgn(sin ψ) (cos δ, sin δ),  as γ̇1 = −γ3ω2;
    k = 2: γ = (cos ψ, 0, sin ψ),  u = sgn(sin ψ) (sin δ, cos δ),   as γ̇2 = γ3ω1.

The energy gives |ω| wherever E > (b, γ).
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.cells import Window, even_points
from hess_mechanics.dynamics.motions import body_parameters, integer, section_motions, with_default
from hess_mechanics.dynamics.plane_section import Plane
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.results import Array, Mask, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody

__all__ = ["SECTION", "AngleSection", "SuslovSection"]

_EDGE = 1e-6
_COLUMNS = 240


def _side(psi: Array) -> Array:
    return np.where(np.sin(psi) < 0.0, -1.0, 1.0)


@dataclass(frozen=True)
class AngleSection(PoincareSection):
    """Section γ_k = 0 in (ψ, δ) at the energy E, crossed while γ_k increases.

    Parameters
    ----------
    body : object
        Body whose last three parameters are b1, b2, b3.
    E : float
        Energy, any finite number.
    k : int, default 3
        Index of the component of γ that is 0 on the section, 1, 2 or 3.

    Raises
    ------
    InvalidParameter
        If E is not finite or k is out of range.
    """

    body: Any
    E: float
    k: int = 3

    names: ClassVar[tuple[str, str]] = ("ψ", "δ")
    turns: ClassVar[tuple[float, float]] = (2.0 * math.pi, math.inf)
    window: ClassVar[tuple[tuple[float, float], ...]] = ((-math.pi, math.pi), (0.0, math.pi))

    def __post_init__(self) -> None:
        require_finite(E=self.E)
        if self.k not in (1, 2, 3):
            raise InvalidParameter(
                f"k = {self.k} is out of range: choose 1, 2 or 3 for the section γ1 = 0, γ2 = 0 or γ3 = 0."
            )

    @property
    @abstractmethod
    def _bottom(self) -> float:
        """The energy at which h = 0."""

    @abstractmethod
    def _kinetic(self, u: Array, gamma: Array) -> Array:
        """Return the kinetic energy (n,) for ω = u (2, n) at γ (3, n)."""

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters of the body."""
        return tuple(self.body.parameters)

    @property
    def surface(self) -> Plane:
        """The plane γ_k = 0."""
        return Plane(tuple(float(i == self.k + 1) for i in range(5)))

    @property
    def _in_plane(self) -> tuple[int, int]:
        """The indices of the other two components of γ."""
        first, second = (i for i in range(3) if i != self.k - 1)
        return first, second

    @property
    def _field(self) -> tuple[float, float]:
        """The components of b for the other two components of γ."""
        b = self.parameters[-3:]
        first, second = self._in_plane
        return b[first], b[second]

    @property
    def lowest_energy(self) -> float:
        """The energy above which motions cross the section, the minimum of (b, γ) on it."""
        return -math.hypot(*self._field)

    @property
    def h(self) -> float:
        """The energy above the one at which h = 0, which the subclass chooses."""
        return self.E - self._bottom

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters of the body, and the energy as E and as h."""
        return {**vars(self.body), "E": self.E, "h": self.h}

    def at_constant(self, name: str, value: float) -> Self:
        """Return the section with another value of one constant; E stays the same when the body changes.

        Parameters
        ----------
        name : str
            Name of the constant, one of `constants`.
        value : float
            Its new value.

        Returns
        -------
        AngleSection
            The other section.

        Raises
        ------
        InvalidParameter
            If the value is not finite.
        NotPositiveDefinite
            If a moment of inertia is not positive.
        """
        if name in vars(self.body):
            return replace(self, body=replace(self.body, **{name: value}))
        return replace(self, E=value + self._bottom if name == "h" else value)

    def require_reached(self) -> None:
        """Raise an error if no motion of this energy reaches the section.

        Raises
        ------
        OutsideRegion
            If E is not above `lowest_energy`.
        """
        if self.lowest_energy >= self.E:
            raise OutsideRegion(
                f"No motion with E = {self.E:g} reaches γ{self.k} = 0: choose E above {self.lowest_energy:.6g}."
            )

    def states_at(self, psi: Array, delta: Array) -> tuple[Array, Mask]:
        """Return the states at points of the section.

        Parameters
        ----------
        psi : ndarray, shape (n,)
            Angles ψ, in radians.
        delta : ndarray, shape (n,)
            Angles δ, in radians, 0 < δ < π.

        Returns
        -------
        states : ndarray, shape (n, 5)
            States (ω1, ω2, γ1, γ2, γ3).
        possible : ndarray of bool, shape (n,)
            True for points that motions cross: 0 < δ < π and E > (b, γ).
        """
        psi, delta = np.array(psi, float, ndmin=1), np.array(delta, float, ndmin=1)
        gamma = self._gamma(psi)
        side = _side(psi)
        if self.k == 3:
            u = np.stack([np.cos(psi + delta), np.sin(psi + delta)])
        elif self.k == 1:
            u = -side * np.stack([np.cos(delta), np.sin(delta)])
        else:
            u = side * np.stack([np.sin(delta), np.cos(delta)])
        kinetic = self.E - np.array(self.parameters[-3:]) @ gamma
        speed = np.sqrt(np.maximum(0.0, kinetic) / self._kinetic(u, gamma))
        inside = (delta > 0.0) & (delta < math.pi) & np.isfinite(psi)
        return np.vstack([speed * u, gamma]).T, inside & (kinetic > 0.0)

    def _gamma(self, psi: Array) -> Array:
        gamma = np.zeros((3, psi.size))
        gamma[self._in_plane, :] = np.cos(psi), np.sin(psi)
        return gamma

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie.

        Parameters
        ----------
        states : ndarray, shape (n, 5)
            States with γ_k = 0.

        Returns
        -------
        ndarray, shape (n, 2)
            Angles ψ, −π to π, and δ, 0 to π, in radians.
        """
        first, second = self._in_plane
        psi = np.arctan2(states[:, 2 + second], states[:, 2 + first])
        w1, w2 = states[:, 0], states[:, 1]
        if self.k == 3:
            delta = np.arctan2(w2, w1) - psi
            delta = np.abs(np.arctan2(np.sin(delta), np.cos(delta)))
        elif self.k == 1:
            delta = np.arctan2(np.abs(w2), -_side(psi) * w1)
        else:
            delta = np.arctan2(np.abs(w1), _side(psi) * w2)
        return np.column_stack([psi, delta])

    def _arcs(self, psi0: float, psi1: float) -> list[tuple[float, float]]:
        """Return the intervals of ψ0 … ψ1 where (b, γ) < E, in order."""
        (first, second), size, turn = self._field, -self.lowest_energy, 2.0 * math.pi
        if size < self.E:
            return [(psi0, psi1)]
        if size <= -self.E:
            return []
        half = math.acos(-self.E / size)
        bottom = math.atan2(-second, -first)
        turns = range(math.floor((psi0 - bottom) / turn) - 1, math.ceil((psi1 - bottom) / turn) + 2)
        arcs = ((max(psi0, bottom + turn * n - half), min(psi1, bottom + turn * n + half)) for n in turns)
        return [arc for arc in arcs if arc[0] < arc[1]]

    def spread(self, count: int, window: Window | None = None) -> tuple[tuple[float, ...], ...]:
        """Return states that are spread evenly over the part of a window that motions cross.

        Parameters
        ----------
        count : int
            Number of states.
        window : ((float, float), (float, float)), optional
            Lower left and upper right corner (ψ, δ) of the window, in radians.  By default the whole section.

        Returns
        -------
        tuple of tuple of float
            The states; fewer only if the possible part is empty or too small for double precision.
        """
        (psi0, delta0), (psi1, delta1) = window or ((-math.pi, 0.0), (math.pi, math.pi))
        arcs = self._arcs(psi0, psi1)
        if not arcs or not count:
            return ()
        shares = even_points(count, 0.5)
        ends = np.cumsum([0.0, *(high - low for low, high in arcs)])
        along = ends[-1] * shares[0]
        arc = np.searchsorted(ends[1:-1], along)
        psi = along - ends[arc] + np.array([low for low, _ in arcs])[arc]
        delta = delta0 + (delta1 - delta0) * shares[1]
        states, ok = self.states_at(psi, np.clip(delta, _EDGE, math.pi - _EDGE))
        return tuple(tuple(map(float, state)) for state in states[ok])

    def possible(self, psi: Array) -> Mask:
        """Return True where the energy allows motion.

        Parameters
        ----------
        psi : ndarray, shape (n,)
            Angles ψ, in radians.

        Returns
        -------
        ndarray of bool, shape (n,)
            True for possible angles.
        """
        return np.asarray(np.array(self.parameters[-3:]) @ self._gamma(psi) < self.E)

    def forbidden_cells(self, window: Window) -> Array:
        """Return the forbidden region of a window, as cells.

        Parameters
        ----------
        window : ((float, float), (float, float))
            Lower left and upper right corner (ψ, δ) of the window, in radians.

        Returns
        -------
        ndarray, shape (1, 240)
            1 where the energy does not allow ψ, otherwise 0.
        """
        psi = np.linspace(window[0][0], window[1][0], _COLUMNS + 1)
        return as_read_only(1.0 - self.possible(0.5 * (psi[1:] + psi[:-1]))[None, :].astype(float))


@dataclass(frozen=True)
class SuslovSection(AngleSection):
    """Section γ_k = 0 of a Suslov body at the energy E; h counts from the lowest energy of the body.

    Parameters
    ----------
    body : SuslovBody
        The body.
    E : float
        Energy, any finite number.
    k : int, default 3
        Index of the component of γ that is 0 on the section, 1, 2 or 3.

    Raises
    ------
    InvalidParameter
        If E is not finite or k is out of range.
    """

    body: SuslovBody

    system: ClassVar[System] = SYSTEM

    @property
    def _bottom(self) -> float:
        return -math.hypot(self.body.b1, self.body.b2, self.body.b3)

    def _kinetic(self, u: Array, gamma: Array) -> Array:
        return np.asarray(0.5 * (self.body.I11 * u[0] ** 2 + self.body.I22 * u[1] ** 2))

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the larger to the smaller of I11 and I22."""
        return math.sqrt(max(self.body.I11, self.body.I22) / min(self.body.I11, self.body.I22))

    @property
    def integrable(self) -> str:
        """The integrable case in words, or an empty string.

        The cases are I13 = I23 = b3 = 0, and I13 = I23 = 0 with I11 = I22 and b along e.
        """
        b = self.body
        if b.I13 == b.I23 == b.b3 == 0.0:
            return "Kharlamova's integrable case"
        if b.I13 == b.I23 == b.b1 == b.b2 == 0.0 and b.I11 == b.I22:
            return "the integrable case I₁₁ = I₂₂, b along e"
        return ""


def _section(values: Mapping[str, float]) -> SuslovSection:
    body = SuslovBody(*(values[name] for name in SYSTEM.parameters))
    section = SuslovSection(body, 0.0, int(values["k"])).at_constant("h", values["h"])
    section.require_reached()
    return section


SECTION = section_motions(
    "suslov-section",
    "Suslov problem, a point of a section",
    (
        *body_parameters(SYSTEM, 1.5, 1.0, 0.0, 0.0, 0.3, -0.5, 1.0),
        with_default(known.H_SUSLOV, 3.0),
        integer("k", "k", 3, 1, 3, "The section is γ_k = 0, upward crossings."),
    ),
    (with_default(known.PSI, 1.5), with_default(known.DELTA, 1.2)),
    _section,
    SYSTEM,
)
"""Motions from the section γ_k = 0."""
