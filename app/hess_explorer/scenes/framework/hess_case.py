"""What the scenes of the Hess case have in common: the parameters of both bodies, what is possible, words."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Self

from hess_explorer.scenes.framework.inertia import CentreOfMass, Moments, Tensor
from hess_explorer.scenes.framework.parameters import Slider, like, number, slider_within
from hess_explorer.scenes.framework.scene import Motion, State
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import pixels_per_unit
from hess_mechanics.errors import ModelError, NoField, Separatrix
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge, largest_area_integral
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.balls import Enclosure, exact
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, f_max, turning_points
from hess_mechanics.suslov_hess.certificate import claim
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.edge import TWO_EQUILIBRIA, EdgeProof
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES, Proof, prove
from hess_mechanics.suslov_hess.torus import Track, cycles

__all__ = [
    "BY_THE_UNSTABLE_CYCLE", "OF_HEAVY", "RIS", "UNITS_OF_B", "UNSURE", "HeavyMotion", "Proved", "SuslovBody",
    "limit_cycles", "map_or_none", "possible_f", "proved", "reduced_motion",
]

_MAX_A = 100.0
_MOST_BITS, _MOST_WORK = 256, 1e6
"""Of a proof in the background: less than a second."""

_INSIDE = 1.0 - 1e-12
"""Room for the round-off of the translation at the edge of what is possible."""

UNSURE = 1e-9
BY_THE_UNSTABLE_CYCLE = "This motion starts next to the unstable cycle: on the torus too any round-off grows there."

UNITS_OF_B, OF_HEAVY = "Suslov–Hess, in units b = 1", "Euler–Poisson"
"""Whose energy and area integral h and f are."""

RIS = {"I1": 1.0, "I2": 1.5, "I3": 2.0, "m": math.sqrt(0.5)}
"""The body of figures 13 and 14, after half a turn about its middle axis."""


def reduced_motion(hess: HessBody, turning: TurningPoints, phi0: float, length: float) -> Motion:
    """The motion of a torus with phase φ0, over a length of time in units b = 1, for "Speed and accuracy"."""
    start = tuple(turning.state_at_lower_turn(phi0).tolist())
    weights = pixels_per_unit(math.sqrt(2.0 * (turning.h + 1.0)))
    return Motion(SYSTEM, start, (hess.a, 1.0), length, weights, 1.0 / hess.frequency_unit)


def possible_f(h: float, f: float, notes: list[str]) -> float:
    """f, in units b = 1, inside the region of this h; what was changed is said in the notes."""
    largest = f_max(h)
    if abs(f) <= largest:
        return f
    notes.append(f"At h = {digits(h)} only |f| ≤ {digits(largest)} is possible: f is at that edge now.")
    return math.copysign(largest, f)


def map_or_none(work: Work, a: float, h: float, f: float, level: Level) -> CircleMap | None:
    """The circle map of a torus in units b = 1; None on the separatrix."""
    try:
        return work.get(circle_map, a, h, f, level)
    except Separatrix:
        return None


def limit_cycles(work: Work, hess: HessBody, theta: CircleMap | None, level: Level, half_width: float
                 ) -> tuple[Track, Track] | None:
    """The stable and the unstable limit cycle on the torus of a circle map, where there are two; see `torus.cycles`."""
    if theta is None or theta.kind != "hyperbolic":
        return None
    return work.get(cycles, hess, theta.h, theta.f, theta.fixed_points[0], level, half_width)


@dataclass(frozen=True)
class Proved:
    """What is proved of a torus: a short sentence for the caption of its map, and one with more digits."""

    badge: str
    said: str


def proved(I22: float, I23: float, h: float, f: float) -> Proved:
    """What is proved of the torus of a body, whose doubles stand for exactly the decimals that its boxes show."""
    try:
        found = prove(exact("I23", I23) / exact("I22", I22), h, f, _MOST_BITS, _MOST_WORK)
    except ModelError as error:
        return Proved("Not proved.", f"Not proved: {error}")
    if isinstance(found, EdgeProof):
        moves = "two equilibria" if found.statement == TWO_EQUILIBRIA else "one periodic orbit"
        return Proved(f"Proved: no torus, but a circle with n₃ constant: {moves}.", claim(found))
    if found.statement == NO_CYCLE:
        # To as many digits as show that it is less than 2.
        least = next(count for count in itertools.count(4) if Fraction(found.trace.decimals(count)[1]) < 2)
        return Proved(f"Proved: no cycle, |trace| in {_within(found.trace, least)}.",
                      f"Proved: no cycle, |trace| in {_within(found.trace, least + 7)}{_costs(found)}")
    if found.statement != TWO_CYCLES:
        return Proved(f"Undecided at {found.bits} bits.", f"Undecided at {found.bits} bits: |trace| is too close to 2")
    less, more = found.multipliers
    return Proved(f"Proved: exactly two cycles, multipliers in {_within(less, 4)}, {_within(more, 4)}.",
                  f"Proved: exactly two cycles, multipliers in {_within(less, 11)}, {_within(more, 11)}{_costs(found)}")


def _within(found: Enclosure, count: int) -> str:
    return f"[{', '.join(found.decimals(count))}]".replace("E+", "e").replace("E-", "e−")


def _costs(found: Proof) -> str:
    return f" ({len(found.steps)} steps, {found.bits} bits)"


@dataclass(frozen=True)
class SuslovBody(State):
    """The body of a motion in the Suslov problem; mixed into the state of a scene."""

    I22: float = like(Tensor, "I22", 0.96, softbounds=(0.2, 3.0),
                      doc="Moment of inertia about the second body axis. I₁₁ follows from it and I₂₃.")
    I23: float = like(Tensor, "I23", 0.28,
                      doc="Product of inertia. a = I₂₃/I₂₂ tilts the circular section; a = 0 decouples the motion.")
    b3: float = like(CentreOfMass, "b3", -1.0, softbounds=(-3.0, -0.05), bounds=(-1e3, -1e-3),
                     doc="Third component of b = −mg r. It sets the unit of time; b₂ follows from it.")

    @cached_property
    def body(self) -> HessBody:
        """The body."""
        return HessBody(self.I22, self.I23, self.b3)

    @property
    def units(self) -> tuple[float, float]:
        """Of w1 and w2, in those of ω1 and ω2."""
        return self.body.frequency_unit, self.body.frequency_unit * math.hypot(1.0, self.body.a)

    def possible_I23(self, notes: list[str]) -> float:
        """I23 with |a| ≤ 100; what was changed is said in the notes."""
        bound = _MAX_A * self.I22
        if abs(self.I23) <= bound:
            return self.I23
        I23 = math.copysign(bound, self.I23)
        notes.append(f"a = I₂₃/I₂₂ is kept within ±{_MAX_A:g}: I₂₃ is {digits(I23)} now.")
        return I23


@dataclass(frozen=True)
class HeavyMotion(Moments):
    """A motion of Euler–Poisson on the Hess manifold: body, integrals, phase; mixed into the state of a scene."""

    m: float = number("μ|r|", 9.975, (-20.0, 20.0), 0.005, bounds=(-1e3, 1e3), group="Body",
                      label="Weight times distance, μ|r|",
                      doc="The potential is −μ(r, γ). Its sign is that of r.")
    h: float = number("h", 50.0, (-9.0, 100.0), 0.05, bounds=(-1e3, 1e5), label="Energy h", doc="H = h; above −μ|r|.",
                      means=OF_HEAVY)
    f: float = number("f", 5.0, (-8.0, 8.0), 0.05, bounds=(-1e3, 1e3), label="Area integral f",
                      doc="(M, γ) = f. Its range follows h.", means=OF_HEAVY)
    phi0: float = number("φ₀", 0.5, (-3.14, 3.14), 0.01, bounds=(-math.pi, math.pi), label="Phase φ₀",
                         doc="Phase of the start on the torus, at the lowest place of the centre of mass, in radians.")

    @property
    def _least_weight(self) -> float:
        """So that h in units of μ|r| is a number to compute with."""
        return max(1e-3, 1e-9 * abs(self.h))

    @property
    def _largest_f(self) -> float:
        return largest_area_integral(self.m, self.I2, self.h) * _INSIDE

    def admitted(self, notes: list[str]) -> Self:
        """h above the bottom, and f inside the region of this h."""
        state, bottom = self, -abs(self.m) * _INSIDE
        if abs(self.m) < self._least_weight:
            return self
        if self.h < bottom:
            state = replace(state, h=bottom)
            notes.append(f"The energy is above −μ|r|: h is {digits(bottom)} now.")
        largest = state._largest_f
        if abs(self.f) > largest:
            state = replace(state, f=math.copysign(largest, self.f))
            notes.append(f"At h = {digits(state.h)} only |f| ≤ {digits(largest)} is possible on the Hess manifold: "
                         "f is at that edge now.")
        return state

    def limits(self) -> Mapping[str, Slider]:
        """The sliders of h and f span what is possible, in round steps; the moments keep their order."""
        m, moments = abs(self.m), super().limits()
        if m < self._least_weight or self.h <= -m:
            return moments
        step = 10.0 ** (math.floor(math.log10(m)) - 2)
        low = -math.floor(m / step * 0.995) * step
        return {**moments, "h": (low, max(10.0 * m, self.h), step), "f": slider_within(self._largest_f)}

    @cached_property
    def bridge(self) -> Bridge:
        """The heavy body, and the Suslov body of its motions.  Raises `InvalidParameter`, `NoField`."""
        if abs(self.m) < self._least_weight:
            raise NoField(f"μ|r| = {digits(self.m)}: without weight there is no Hess case. Choose μ|r| of at least "
                          f"{digits(self._least_weight)}.")
        return Bridge.of_heavy(HeavyBody.hess(self.moments, self.m))

    @cached_property
    def turning(self) -> TurningPoints:
        """(h, f) in units b = 1, and where n3 turns.  Raises `Separatrix`, `OutsideRegion`."""
        try:
            return turning_points(*self.bridge.in_units_of_b(self.h, self.f))
        except Separatrix:
            raise Separatrix("h = μ|r|, f = 0 is the separatrix: n₃ has no period. Choose another h, or f other than "
                             "0.") from None

    @cached_property
    def map(self) -> CircleMap:
        """The circle map of the torus."""
        return self.work.get(circle_map, self.bridge.hess.a, self.turning.h, self.turning.f, self.level)

    @property
    def period(self) -> float:
        """One period of n3, in the time of the body."""
        return self.map.period / self.bridge.hess.frequency_unit

    @cached_property
    def start(self) -> tuple[float, ...]:
        """The state of the reduced system where n3 turns below, in units b = 1."""
        return tuple(self.turning.state_at_lower_turn(self.phi0).tolist())
