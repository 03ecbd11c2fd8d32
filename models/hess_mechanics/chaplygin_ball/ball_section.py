"""Section γ3 = 0 of the Chaplygin ball with Suslov's constraint at an energy E, F1 = 1, in coordinates that cover it.

At an upward crossing of γ3 = 0, γ = (cos ψ, sin ψ, 0) and ω is at an angle δ ∈ (0, π) from it:
ω = |ω| (cos(ψ+δ), sin(ψ+δ)), as γ̇3 = |ω| sin δ.  The energy gives |ω| wherever E > (b, γ).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody, kinetic_energy
from hess_mechanics.chaplygin_ball.integrable_cases import has_area_integral, is_reversible
from hess_mechanics.dynamics.motions import body_parameters, section_motions, with_default
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.system import System
from hess_mechanics.numerics.accuracy import DRAFT
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.suslov_section import AngleSection

__all__ = ["SECTION", "BallSection", "largest_speed", "nearest_possible_psi"]

_EDGE = 1e-3
_SAMPLES = 129


def nearest_possible_psi(band: tuple[float, float], psi: float) -> float:
    """Return the possible ψ nearest to a given ψ.

    Parameters
    ----------
    band : (float, float)
        Centre and half width of the band of forbidden ψ, in radians.
    psi : float
        Angle ψ, in radians.

    Returns
    -------
    float
        `psi` itself, or an angle in [−π, π] just outside the band if `psi` lies in it or within 1e-3 rad of it.
    """
    middle, half = band
    away = math.remainder(psi - middle, 2.0 * math.pi)
    if abs(away) >= half + _EDGE:
        return psi
    moved = math.remainder(middle + math.copysign(min(half + 2.0 * _EDGE, math.pi), away), 2.0 * math.pi)
    return max(-math.pi, min(math.pi, moved))


def largest_speed(body: BallBody, start: tuple[float, ...], duration: float) -> float:
    """Return the largest |ω| at 129 samples of an orbit.

    Parameters
    ----------
    body : BallBody
        The ball.
    start : tuple of five floats
        Initial state.
    duration : float
        Time, nonzero; negative: backward.

    Returns
    -------
    float
        The largest |ω|, in rad/T.

    Raises
    ------
    InvalidParameter
        As `solve`.
    WorkLimit
        As `solve`.
    """
    coarse = solve(body, start, np.linspace(0.0, duration, _SAMPLES), DRAFT)
    return float(np.hypot(*coarse.states[:, :2].T).max())


@dataclass(frozen=True)
class BallSection(AngleSection):
    """Section γ_k = 0 of a ball; h counts from the lowest energy of the plane.

    Parameters
    ----------
    body : BallBody
        The ball.
    E : float
        Energy, any finite number.
    k : int, default 3
        Index of the section, 1, 2 or 3.
    """

    body: BallBody

    system: ClassVar[System] = SYSTEM

    @property
    def _bottom(self) -> float:
        return self.lowest_energy

    @property
    def forbidden(self) -> tuple[float, float] | None:
        """Centre and half width, in radians, of the band of ψ that the energy forbids; None if every ψ is possible.

        Raises
        ------
        OutsideRegion
            If no ψ is possible.
        """
        self.require_reached()
        (first, second), size = self._field, -self.lowest_energy
        return None if size <= self.E else (math.atan2(second, first), math.acos(self.E / size))

    def _kinetic(self, u: Array, gamma: Array) -> Array:
        return np.asarray(kinetic_energy((*u, *gamma), self.parameters))

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the largest moment of inertia with 𝒟 to the smallest without."""
        return math.sqrt((max(self.body.I11, self.body.I22) + self.body.D) / min(self.body.I11, self.body.I22))

    @property
    def integrable(self) -> str:
        """Name of the integrable case, see `integrable_cases`; empty if none is known."""
        if is_reversible(self.body):
            return "the case I₁₃ = I₂₃ = b₃ = 0, whose orbits are closed"
        return "the integrable case I₁₁ = I₂₂, b along e₃" if has_area_integral(self.body) else ""


SECTION = section_motions(
    "ball-section",
    "Chaplygin ball, a point of a section",
    (*body_parameters(SYSTEM, 1.0, 3.0, 0.2, -0.1, 5.0, 0.5, 0.2, 0.8), with_default(known.H_BALL, 2.5)),
    (with_default(known.PSI, 1.5), with_default(known.DELTA, 1.2)),
    lambda values: BallSection(BallBody(*(values[name] for name in SYSTEM.parameters)), 0.0).at_constant(
        "h", values["h"]
    ),
    SYSTEM,
)
"""Motions from the section γ3 = 0."""
