"""Section γ3 = 0 of the Chaplygin ball with Suslov's constraint at E = h, F1 = 1, in coordinates that cover it.

At an upward crossing of γ3 = 0, γ = (cos ψ, sin ψ, 0) and ω is at an angle δ ∈ (0, π) from it:
ω = |ω| (cos(ψ+δ), sin(ψ+δ)), as γ̇3 = |ω| sin δ.  The energy gives |ω| wherever h > (b, γ).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball.energy_surface import omega_of_energy
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody, kinetic_energy
from hess_mechanics.chaplygin_ball.integrable_cases import has_area_integral, is_reversible
from hess_mechanics.dynamics.motions import body_parameters, on_section, usual
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.plane_section import MAX_STEPS, Plane, SectionPoints, section_points
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, ModelError, WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, Accuracy
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.suslov_section import AngleSection

__all__ = [
    "EQUATOR",
    "SECTION",
    "BallSection",
    "ball_section",
    "fastest",
    "forbidden_band",
    "outside_band",
    "seeds",
    "state_at",
]

EQUATOR = Plane((0.0, 0.0, 0.0, 0.0, 1.0))
_EDGE = 1e-3
_SAMPLES = 129
_COLUMNS = 240
_TURNS = 30.0
"""Time limit per crossing, in units of 1/ν; few orbits take longer."""


def state_at(body: BallBody, h: float, psi: float, delta: float) -> tuple[float, ...]:
    """Return the state (5,) of the section at (ψ, δ).  Raises `InvalidParameter`, `OutsideRegion` (h below (b, γ))."""
    require_finite(psi=psi, delta=delta)
    if not 0.0 < delta < math.pi:
        raise InvalidParameter(f"δ = {delta:g}: on this section, where γ3 increases, choose δ between 0 and π.")
    gamma = (math.cos(psi), math.sin(psi), 0.0)
    omega = omega_of_energy(body, (math.cos(psi + delta), math.sin(psi + delta)), gamma, h)
    return (*omega, *gamma)


def forbidden_band(body: BallBody, h: float) -> tuple[float, float] | None:
    """Return (middle, half width) of the band of ψ that h forbids, (b, γ) > h; None if every ψ is possible.

    Raises `InvalidParameter` if no ψ is possible.
    """
    size = math.hypot(body.b1, body.b2)
    if h <= -size:
        raise InvalidParameter(
            f"With the energy h = {h:g} the ball never reaches the plane γ3 = 0: choose h above {-size:.6g}."
        )
    if h >= size:
        return None
    return math.atan2(body.b2, body.b1), math.acos(h / size)


def outside_band(band: tuple[float, float], psi: float) -> float:
    """Return the possible ψ in [−π, π] next to this one, which is changed only in or next to a `forbidden_band`."""
    middle, half = band
    away = math.remainder(psi - middle, 2.0 * math.pi)
    if abs(away) >= half + _EDGE:
        return psi
    moved = math.remainder(middle + math.copysign(min(half + 2.0 * _EDGE, math.pi), away), 2.0 * math.pi)
    return max(-math.pi, min(math.pi, moved))


def seeds(body: BallBody, h: float, count: int) -> list[tuple[float, ...]]:
    """Return states of the section, spread evenly over the possible (ψ, cos δ).  Raises `InvalidParameter`."""
    band = forbidden_band(body, h)
    middle, forbidden = (0.0, 0.0) if band is None else band
    golden = (math.sqrt(5.0) - 1.0) / 2.0
    found = []
    for i in range(count):
        share = (i * golden) % 1.0
        psi = middle + forbidden + _EDGE + share * (2.0 * (math.pi - forbidden) - 2.0 * _EDGE)
        found.append(state_at(body, h, psi, math.acos(1.0 - 2.0 * (i + 0.5) / count)))
    return found


def ball_section(
    body: BallBody,
    h: float,
    starts: Sequence[Sequence[float]],
    crossings: int,
    accuracy: Accuracy,
    most_steps: int = MAX_STEPS,
) -> SectionPoints:
    """Return the first `crossings` crossings of each orbit from `starts`, on all cores, as in `section_points`.

    most_steps : limit of steps per orbit.  Raises `InvalidParameter`, `WorkLimit`.
    """
    speed = math.sqrt(2.0 * (h + math.hypot(*body.parameters[5:])) / min(body.I11, body.I22))
    end = crossings * _TURNS * math.sqrt(1.0 + body.D / min(body.I11, body.I22)) / speed
    try:
        return section_points(body, starts, EQUATOR, end, accuracy, crossings, most_steps=most_steps)
    except WorkLimit:
        raise WorkLimit(
            f"{crossings} crossings take an orbit more than {most_steps} steps here: choose fewer of them, "
            "or smaller I13 and I23."
        ) from None


def fastest(body: BallBody, start: tuple[float, ...], duration: float) -> float:
    """Return the largest |ω| of a few samples along the orbit from a state (5,).  Raises as `solve`."""
    coarse = solve(body, start, np.linspace(0.0, duration, _SAMPLES), DRAFT)
    return float(np.hypot(*coarse.states[:, :2].T).max())


@dataclass(frozen=True)
class BallSection(AngleSection):
    """Section γ3 = 0 of a ball at the energy h.  Its methods raise `InvalidParameter`."""

    body: BallBody
    h: float

    system: ClassVar[System] = SYSTEM

    @property
    def _axis(self) -> int:
        return 2

    @property
    def _energy(self) -> float:
        return self.h

    def _kinetic(self, u: Array, gamma: Array) -> Array:
        return np.asarray(kinetic_energy((*u, *gamma), self.parameters))

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the largest moment of inertia with 𝒟 to the smallest without."""
        return math.sqrt((max(self.body.I11, self.body.I22) + self.body.D) / min(self.body.I11, self.body.I22))

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters of the body, and h."""
        return {**vars(self.body), "h": self.h}

    @property
    def integrable(self) -> str:
        """The case of `integrable_cases` in words, or an empty string."""
        if is_reversible(self.body):
            return "the case I₁₃ = I₂₃ = b₃ = 0, whose orbits are closed"
        return "the integrable case I₁₁ = I₂₂, b along e₃" if has_area_integral(self.body) else ""

    def somewhere(self) -> tuple[float, ...] | None:
        """Return a state of the section; None if no motion crosses it."""
        with suppress(ModelError):
            return seeds(self.body, self.h, 1)[0]
        return None


def _section(values: Mapping[str, float]) -> BallSection:
    body = BallBody(*(values[name] for name in SYSTEM.parameters))
    return BallSection(body, values["h"] - math.hypot(body.b1, body.b2))


SECTION = on_section(
    "ball-section",
    "Chaplygin ball, a point of a section",
    (*body_parameters(SYSTEM, 1.0, 3.0, 0.2, -0.1, 5.0, 0.5, 0.2, 0.8), usual(known.H_BALL, 2.5)),
    (usual(known.PSI, 1.5), usual(known.DELTA, 1.2)),
    _section,
    SYSTEM,
)
"""Motions from the section γ3 = 0."""
