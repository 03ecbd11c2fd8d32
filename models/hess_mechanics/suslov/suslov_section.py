"""Sections γ_k = 0 of the Suslov problem with gravity at E = h, F1 = 1, in coordinates that cover them.

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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.cells import Window, evenly
from hess_mechanics.dynamics.motions import body_parameters, on_section, usual, whole
from hess_mechanics.dynamics.plane_section import MAX_STEPS, Plane, SectionPoints, section_points
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.parallel import THREADS
from hess_mechanics.numerics.results import Array, Mask, frozen
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody

__all__ = ["SECTION", "AngleSection", "SuslovSection", "require_reached"]

_TURNS = 40.0
"""Time limit per crossing, in units of 1/ν; few orbits take longer."""
_EDGE = 1e-6
_COLUMNS = 240


def _side(psi: Array) -> Array:
    return np.where(np.sin(psi) < 0.0, -1.0, 1.0)


@dataclass(frozen=True)
class AngleSection(PoincareSection):
    """Section γ_k = 0 in (ψ, δ) at an energy, crossed while γ_k increases; b are the last parameters of the body."""

    body: Any

    names: ClassVar[tuple[str, str]] = ("ψ", "δ")
    turns: ClassVar[tuple[float, float]] = (2.0 * math.pi, math.inf)
    window: ClassVar[tuple[tuple[float, float], ...]] = ((-math.pi, math.pi), (0.0, math.pi))

    @property
    @abstractmethod
    def _axis(self) -> int:
        """Index of the component of γ that is 0, k − 1."""

    @property
    @abstractmethod
    def _energy(self) -> float: ...

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
        return Plane(tuple(float(i == self._axis + 2) for i in range(5)))

    @property
    def _in_plane(self) -> tuple[int, int]:
        """The indices of the other two components of γ."""
        first, second = (i for i in range(3) if i != self._axis)
        return first, second

    @property
    def _field(self) -> tuple[float, float]:
        """The components of b for the other two components of γ."""
        b = self.parameters[-3:]
        first, second = self._in_plane
        return b[first], b[second]

    @property
    def lowest_energy(self) -> float:
        """The energy below which no motion reaches the plane."""
        return -math.hypot(*self._field)

    def moved(self, name: str, value: float) -> Self:
        """Return the section with another value of one constant."""
        if name in vars(self.body):
            return replace(self, body=replace(self.body, **{name: value}))
        return replace(self, **{name: value})

    def states_at(self, psi: Array, delta: Array) -> tuple[Array, Mask]:
        """Return the states (n, 5) at (ψ, δ) (n,), and the mask (n,) of the places with motion."""
        psi, delta = np.array(psi, float, ndmin=1), np.array(delta, float, ndmin=1)
        gamma = self._gamma(psi)
        side = _side(psi)
        if self._axis == 2:
            u = np.stack([np.cos(psi + delta), np.sin(psi + delta)])
        elif self._axis == 0:
            u = -side * np.stack([np.cos(delta), np.sin(delta)])
        else:
            u = side * np.stack([np.sin(delta), np.cos(delta)])
        kinetic = self._energy - np.array(self.parameters[-3:]) @ gamma
        speed = np.sqrt(np.maximum(0.0, kinetic) / self._kinetic(u, gamma))
        inside = (delta > 0.0) & (delta < math.pi) & np.isfinite(psi)
        return np.vstack([speed * u, gamma]).T, inside & (kinetic > 0.0)

    def _gamma(self, psi: Array) -> Array:
        gamma = np.zeros((3, psi.size))
        gamma[self._in_plane, :] = np.cos(psi), np.sin(psi)
        return gamma

    def places_of(self, states: Array) -> Array:
        """Return (ψ, δ) (n, 2) of states (n, 5) of the section."""
        first, second = self._in_plane
        psi = np.arctan2(states[:, 2 + second], states[:, 2 + first])
        w1, w2 = states[:, 0], states[:, 1]
        if self._axis == 2:
            delta = np.arctan2(w2, w1) - psi
            delta = np.abs(np.arctan2(np.sin(delta), np.cos(delta)))
        elif self._axis == 0:
            delta = np.arctan2(np.abs(w2), -_side(psi) * w1)
        else:
            delta = np.arctan2(np.abs(w1), _side(psi) * w2)
        return np.column_stack([psi, delta])

    def possible(self, psi: Array) -> Mask:
        """Return the mask (n,) of the angles ψ that the energy allows."""
        return np.asarray(np.array(self.parameters[-3:]) @ self._gamma(psi) < self._energy)

    def impossible(self, window: Window) -> Array:
        """Return cells (1, n) over the window: 1 where the energy does not allow ψ."""
        psi = np.linspace(window[0][0], window[1][0], _COLUMNS + 1)
        return frozen(1.0 - self.possible(0.5 * (psi[1:] + psi[:-1]))[None, :].astype(float))


@dataclass(frozen=True)
class SuslovSection(AngleSection):
    """Section γ_k = 0 of a body at E = h, crossed while γ_k increases.  Raises `InvalidParameter`."""

    body: SuslovBody
    E: float
    k: int

    system: ClassVar[System] = SYSTEM

    def __post_init__(self) -> None:
        require_finite(E=self.E)
        if self.k not in (1, 2, 3):
            raise InvalidParameter("The section is γ1 = 0, γ2 = 0 or γ3 = 0: choose 1, 2 or 3.")

    @property
    def _axis(self) -> int:
        return self.k - 1

    @property
    def _energy(self) -> float:
        return self.E

    def _kinetic(self, u: Array, gamma: Array) -> Array:
        return np.asarray(0.5 * (self.body.I11 * u[0] ** 2 + self.body.I22 * u[1] ** 2))

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the moments of inertia."""
        return math.sqrt(max(self.body.I11, self.body.I22) / min(self.body.I11, self.body.I22))

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters of the body, and E."""
        return {**vars(self.body), "E": self.E}

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

    def state_at(self, psi: float, delta: float) -> tuple[float, ...]:
        """Return the state (5,) at (ψ, δ).  Raises `InvalidParameter` if the energy does not allow it."""
        states, ok = self.states_at(np.array([psi]), np.array([delta]))
        if not ok[0]:
            raise InvalidParameter(
                f"At ψ = {psi:.6g}, δ = {delta:.6g} no motion has the energy E = {self.E:.6g}: choose a "
                "larger energy, or another point with 0 < δ < π."
            )
        return tuple(map(float, states[0]))

    def invariant_density(self, psi: Array, delta: Array) -> Array:
        """Return σ(ψ, δ) (n,), 0 where the energy is impossible: for I13 = I23 = 0 σ dψ dδ is conserved.

        The flow conserves dω dγ.  With ω = |ω|u and K = I11u1² + I22u2² this is dE/K times the differential of the
        angle of u times dγ_k dψ, and the flux through γ_k = 0 has the factor γ̇_k = |ω| c sin δ: σ = √(2(E − (b, γ))) c
        sin δ/K^(3/2), where c = 1 for k = 3 and |sin ψ| for the others. Raises `InvalidParameter`.
        """
        body = self.body
        if body.I13 != 0.0 or body.I23 != 0.0:
            raise InvalidParameter("The return map conserves an area only for I13 = I23 = 0: set these to 0.")
        states, ok = self.states_at(psi, delta)
        w1, w2 = states[:, 0], states[:, 1]
        speed = np.hypot(w1, w2)
        growth = SYSTEM.field(list(states.T), body.parameters)[self.k + 1]
        twice = np.where(ok, body.I11 * w1 * w1 + body.I22 * w2 * w2, 1.0)  # K|ω|² = 2(E − (b, γ))
        return np.where(ok, speed**2 * growth / twice, 0.0)

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

    def spread(self, window: Window, count: int) -> tuple[tuple[float, ...], ...]:
        """Return at most `count` states, spread evenly over the possible part of the window.

        There are fewer only if nothing is possible, or if the possible part contains no double.
        """
        (psi0, delta0), (psi1, delta1) = window
        arcs = self._arcs(psi0, psi1)
        if not arcs or not count:
            return ()
        shares = evenly(count, 0.5)
        ends = np.cumsum([0.0, *(high - low for low, high in arcs)])
        along = ends[-1] * shares[0]
        arc = np.searchsorted(ends[1:-1], along)
        psi = along - ends[arc] + np.array([low for low, _ in arcs])[arc]
        delta = delta0 + (delta1 - delta0) * shares[1]
        states, ok = self.states_at(psi, np.clip(delta, _EDGE, math.pi - _EDGE))
        return tuple(tuple(map(float, state)) for state in states[ok])

    def points(
        self,
        starts: Sequence[Sequence[float]],
        crossings: int,
        forward: bool,
        accuracy: Accuracy,
        threads: int = THREADS,
        most_steps: int = MAX_STEPS,
    ) -> SectionPoints:
        """Return the first `crossings` crossings of each orbit, forward or backward in time, as in `section_points`.

        Raises `InvalidParameter`, `WorkLimit`.
        """
        nu = float(np.max(SYSTEM.frequency(np.array(starts, float).T, np.array(self.parameters))))
        end = crossings * _TURNS * self.slowness / max(nu, 1e-300)
        return section_points(
            self.body, starts, self.surface, end if forward else -end, accuracy, crossings, threads, most_steps
        )

    def somewhere(self) -> tuple[float, ...] | None:
        """Return a state of the section; None if no motion crosses it."""
        return next(iter(self.spread(((-math.pi, 0.0), (math.pi, math.pi)), 1)), None)


def require_reached(section: SuslovSection) -> None:
    """Raise `OutsideRegion` if no motion of this energy reaches the plane."""
    if section.lowest_energy >= section.E:
        raise OutsideRegion(
            f"No motion with E = {section.E:g} reaches γ{section.k} = 0: choose E above {section.lowest_energy:.6g}."
        )


def _section(values: Mapping[str, float]) -> SuslovSection:
    body = SuslovBody(*(values[name] for name in SYSTEM.parameters))
    found = SuslovSection(body, values["h"] - math.hypot(body.b1, body.b2, body.b3), int(values["k"]))
    require_reached(found)
    return found


SECTION = on_section(
    "suslov-section",
    "Suslov problem, a point of a section",
    (
        *body_parameters(SYSTEM, 1.5, 1.0, 0.0, 0.0, 0.3, -0.5, 1.0),
        usual(known.H_SUSLOV, 3.0),
        whole("k", "k", 3, 1, 3, "The section is γ_k = 0, γ_k growing."),
    ),
    (usual(known.PSI, 1.5), usual(known.DELTA, 1.2)),
    _section,
    SYSTEM,
)
"""Motions from the section γ_k = 0."""
