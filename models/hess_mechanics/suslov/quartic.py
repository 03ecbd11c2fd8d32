"""The Suslov problem with e and the centre of mass on one principal axis, b1 = b2 = 0 (`eqs02`).

At E = h the energy gives γ3 = h/b3 − (b3/2)(q1²/I22 + q2²/I11) with q = (I22 ω2, −I11 ω1)/b3, and p = (γ1, γ2) obeys

    q̇ = −p,  ṗ = ∇V(q),  V = γ3²/2,  H = p²/2 + V = 1/2:

a point in a quartic potential, always at the level ½, with time reversed ({p_i, q_k} = δ_ik).  It moves where |γ3| ≤ 1:
inside an ellipse for |h| < |b3|, between two for h > |b3|.  For I11 = I22 the potential is central, and q1 p2 − q2 p1 =
I11(ω1γ1 + ω2γ2)/b3 is an integral.  Time is not rescaled.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.section import Plane, SectionPoints, occupied_cells, section_points
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, NoField, OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.rigid_body.inertia import require_finite, require_positive_definite
from hess_mechanics.suslov.equations import SYSTEM

__all__ = [
    "QuarticBody",
    "QuarticSection",
    "angular_momentum",
    "level_error",
    "quartic_section",
    "seeds",
    "spread_section",
    "start_on_section",
    "state_at",
    "state_on_section",
    "visited",
]

_TURNS = 120.0
"""Time allowed per crossing, in units in which ω is at most 1; few orbits take longer."""
_EDGE = 1e-9
_INSIDE = 1e-9
_MIDDLE = 1e-100
"""Sizes below it, in units of the region, have no direction."""
_MOST_SIZE = 1e30
"""Largest q: numbers in pictures are single precision."""


@dataclass(frozen=True)
class QuarticBody:
    """A body with I13 = I23 = 0 and b = (0, 0, b3), at the energy h.

    Raises `NoField` (b3 = 0), `OutsideRegion` (h ≤ −|b3|), `InvalidParameter`, `NotPositiveDefinite`.

    >>> from hess_mechanics import QuarticBody
    >>> QuarticBody(1.3, 0.8, 1.0, h=2.0).b3
    1.0
    """

    I11: float
    I22: float
    b3: float
    h: float

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(self.I11, self.I22)
        if self.b3 == 0.0:
            raise NoField("b3 = 0: without a field γ₃ does not follow from the energy. Choose b3 other than 0.")
        if not self.h > -abs(self.b3):
            raise OutsideRegion(f"No motion has the energy h = {self.h:g}: choose h above −|b3| = {-abs(self.b3):.6g}.")
        smallest, largest = sorted(self.axes)
        if not 1.0 / _MOST_SIZE <= smallest <= largest <= _MOST_SIZE:
            sizes = " and ".join(f"{one:.2g}" if math.isfinite(one) else "beyond 1e308" for one in self.axes)
            raise InvalidParameter(
                f"The region in the plane has half axes {sizes}, which no picture can show: choose h, b3 and the "
                "moments of inertia less different in size."
            )

    @property
    def system(self) -> System:
        """Its equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """p of the system "suslov"."""
        return (self.I11, self.I22, 0.0, 0.0, 0.0, 0.0, self.b3)

    @property
    def axes(self) -> tuple[float, float]:
        """Semi-axes of the ellipse that bounds the motion, γ3 b3 = −|b3|."""
        size = 2.0 * (self.h + abs(self.b3))
        return math.sqrt(size * self.I22) / abs(self.b3), math.sqrt(size * self.I11) / abs(self.b3)

    @property
    def hole(self) -> float:
        """Size of the forbidden inner ellipse, in units of `axes`; 0 for h ≤ |b3|."""
        size = abs(self.b3)
        return math.sqrt(max(0.0, self.h - size) / (self.h + size))

    @property
    def integrable(self) -> bool:
        """Whether q1p2 − q2p1 is an integral."""
        return self.I11 == self.I22

    def pixels_per_unit(self, half_width: float) -> tuple[float, ...]:
        """For each variable, in pictures that show q within ± half_width, and γ within the unit circle; (5,)."""
        radius = 0.5 * PIXELS
        scale = radius / (half_width * abs(self.b3))
        return (scale * self.I11, scale * self.I22, radius, radius, radius)

    def inside(self, q: tuple[float, float]) -> tuple[float, float]:
        """The place where the point may be next to q: q itself, unless the energy forbids it."""
        first, second = self.axes
        x, y = q[0] / first, q[1] / second
        size, inner = math.hypot(x, y), self.hole
        if inner <= size <= 1.0:
            return q
        if size < _MIDDLE:
            x, y, size = 1.0, 0.0, 1.0
        # The ring may be thin.
        room = min(_INSIDE, 0.25 * (1.0 - inner))
        share = min(1.0 - room, max(inner + room, size)) / size
        return share * x * first, share * y * second

    @property
    def across(self) -> int:
        """The index of the q that is 0 on the section: the one along the minor axis.

        For h > |b3| a point can stay near one end of the major axis for ever, but it always crosses that axis.
        """
        return 0 if self.I11 > self.I22 else 1

    @property
    def longest(self) -> float:
        """Half the longer axis of the ellipse, along which the section lies."""
        return self.axes[1 - self.across]

    def ellipse(self, size: float = 1.0) -> Array:
        """The ellipse in which the point may be, a closed curve (n, 2), or one of another size."""
        angle = np.linspace(0.0, 2.0 * math.pi, 181)
        return np.asarray(size * np.array(self.axes) * np.column_stack([np.cos(angle), np.sin(angle)]))

    def holes(self) -> list[Array]:
        """The ellipse in which it may not be, if there is one."""
        return [self.ellipse(self.hole)] if self.hole > 0.0 else []

    def equipotentials(self, heights: Sequence[float]) -> list[Array]:
        """Closed curves (n, 2) on which γ3 has these values."""
        share = [(self.h - self.b3 * g3) / (self.h + abs(self.b3)) for g3 in heights]
        return [self.ellipse(math.sqrt(one)) for one in share if one > 0.0]

    @property
    def plane(self) -> Plane:
        """The section q_i = 0, i = `across`, crossed while q_i grows, in terms of ω."""
        sense = 1 if self.b3 > 0.0 else -1
        if self.across == 0:
            return Plane((0.0, 1.0, 0.0, 0.0, 0.0), sense=sense)
        return Plane((1.0, 0.0, 0.0, 0.0, 0.0), sense=-sense)

    def height(self, q: Array) -> Array:
        """γ3 at q (..., 2); the potential V is γ3²/2."""
        q = np.asarray(q, float)
        return np.asarray(self.h / self.b3 - 0.5 * self.b3 * (q[..., 0] ** 2 / self.I22 + q[..., 1] ** 2 / self.I11))

    def to_plane(self, states: Array) -> tuple[Array, Array]:
        """q and p (m, 2) from states (m, 5)."""
        q = np.column_stack([self.I22 * states[:, 1], -self.I11 * states[:, 0]]) / self.b3
        return q, states[:, 2:4].copy()

    def on_section(self, states: Array) -> Array:
        """The section's coordinates (n, 2), the other q and its p, of states (n, 5)."""
        q, p = self.to_plane(states)
        along = 1 - self.across
        return np.column_stack([q[:, along], p[:, along]])

    def section_boundary(self, count: int = 181) -> Array:
        """A closed curve (n, 2) that bounds the section, p² + γ3² = 1.

        With a hole it bounds the right half only; the left half is its image under q → −q.
        """
        size = abs(self.b3)
        first = math.acos(self.h / size) if self.h < size else 0.0
        angle = np.linspace(first, 2.0 * math.pi - first, count)
        share = (self.h - size * np.cos(angle)) / (self.h + size)
        x, y = self.longest * np.sqrt(np.maximum(0.0, share)), np.sin(angle)
        right = np.column_stack([x, y])
        return right if first == 0.0 else np.vstack([right, right[::-1] * np.array([-1.0, 1.0])])

    def section_boundaries(self) -> list[Array]:
        """The closed curves (n, 2) that bound the section: two with a hole."""
        right = self.section_boundary()
        return [right, right * np.array([-1.0, 1.0])] if self.hole > 0.0 else [right]


def visited(body: QuarticBody, points: Array, cells: int) -> int:
    """In how many of cells² of the section's rectangle points (n, 2) of it lie."""
    x, y = points.T
    return occupied_cells(np.column_stack([math.pi / body.longest * x, 0.5 * math.pi * (1.0 + y)]), cells)


def level_error(body: QuarticBody, states: Array) -> float:
    """The largest |H − ½| of states (m, 5), H = (p² + γ3²)/2 on the level of all motions."""
    q, p = body.to_plane(states)
    H = 0.5 * (np.sum(p * p, axis=1) + body.height(q) ** 2)
    return float(np.abs(H - 0.5).max())


def state_at(body: QuarticBody, q: Sequence[float], direction: float) -> tuple[float, ...]:
    """The state (5,) at q (2,) with the velocity q̇ = −p in `direction`, an angle in radians.

    Raises `OutsideRegion` where |γ3| > 1.
    """
    require_finite(q1=q[0], q2=q[1], direction=direction)
    g3 = float(body.height(np.array(q)))
    if abs(g3) > 1.0 + _EDGE:
        raise OutsideRegion(
            f"At q = ({q[0]:.6g}, {q[1]:.6g}) the potential is {0.5 * g3 * g3:.6g}, above the level ½: γ₃ would be "
            f"{g3:.6g}. Choose a start that is not grey."
        )
    g3 = min(1.0, max(-1.0, g3))
    size = math.sqrt((1.0 - g3) * (1.0 + g3))
    omega = (-body.b3 * q[1] / body.I11, body.b3 * q[0] / body.I22)
    return (*omega, -size * math.cos(direction), -size * math.sin(direction), g3)


def state_on_section(body: QuarticBody, x: float, y: float) -> tuple[float, ...]:
    """The state (5,) at (x, y) of the section, see `on_section`.  Raises `OutsideRegion`."""
    q = (x, 0.0) if body.across else (0.0, x)
    g3 = float(body.height(np.array(q)))
    left = (1.0 - g3) * (1.0 + g3) - y * y
    if left < -_EDGE:
        raise OutsideRegion("There p² + γ₃² would exceed 1: choose a place that is not grey.")
    # The q that is 0 grows where its p is negative.
    other = -math.sqrt(max(0.0, left))
    velocity = (-y, -other) if body.across else (-other, -y)
    return state_at(body, q, math.atan2(velocity[1], velocity[0]))


def start_on_section(body: QuarticBody, x: float, y: float) -> tuple[float, float, float]:
    """q1, q2 and the direction of q̇ for `state_at` at (x, y) of the section.  Raises `OutsideRegion`."""
    (q,), (p,) = body.to_plane(np.array([state_on_section(body, x, y)]))
    return float(q[0]), float(q[1]), math.atan2(-p[1], -p[0])


def angular_momentum(body: QuarticBody, states: Array) -> Array:
    """q1 p2 − q2 p1 (m,) of states (m, 5): an integral for I11 = I22."""
    q, p = body.to_plane(states)
    return np.asarray(q[:, 0] * p[:, 1] - q[:, 1] * p[:, 0])


def seeds(body: QuarticBody, count: int) -> list[tuple[float, ...]]:
    """States of the section, spread over the part that the energy allows."""
    golden = (math.sqrt(5.0) - 1.0) / 2.0
    longest = body.longest
    found = []
    for i in range(count):
        share = (i * golden) % 1.0
        inner = body.hole**2
        # Even in q² from the hole to the edge, and in p for this q.
        x = longest * math.sqrt(inner + (1.0 - inner) * (0.002 + 0.996 * (i + 0.5) / count))
        g3 = float(body.height(np.array((x, 0.0) if body.across else (0.0, x))))
        size = math.sqrt(max(0.0, (1.0 - g3) * (1.0 + g3)))
        found.append(state_on_section(body, x if i % 2 else -x, 0.98 * size * (2.0 * share - 1.0)))
    return found


def quartic_section(
    body: QuarticBody, starts: Sequence[Sequence[float]], crossings: int, level: Accuracy, most_steps: int
) -> SectionPoints:
    """The first crossings of `body.plane` by each orbit, states as in `section_points`.

    most_steps : per orbit.  Raises `InvalidParameter`, `WorkLimit`.
    """
    speed = math.sqrt(2.0 * (body.h + abs(body.b3)) / max(body.I11, body.I22))
    end = crossings * _TURNS / speed
    if not math.isfinite(end):
        raise InvalidParameter("The motion is too slow for double precision: choose less extreme parameters.")
    try:
        return section_points(body, starts, body.plane, end, level, crossings, most_steps=most_steps)
    except WorkLimit:
        raise WorkLimit(
            f"{crossings} crossings take an orbit more than {most_steps} steps here: choose fewer of them, "
            "a smaller h, or I11 and I22 less different."
        ) from None


def spread_section(body: QuarticBody, orbits: int, crossings: int, level: Accuracy, most_steps: int) -> SectionPoints:
    """The section of so many orbits, spread over what is possible of it: `quartic_section` from `seeds`."""
    return quartic_section(body, seeds(body, orbits), crossings, level, most_steps)


@dataclass(frozen=True)
class QuarticSection(PoincareSection):
    """The section of a body at its energy, in (q, p) along the longer axis: canonical coordinates.

    Its methods raise as `QuarticBody`.
    """

    body: QuarticBody

    names: ClassVar[tuple[str, str]] = ("q", "p")
    turns: ClassVar[tuple[float, float]] = (math.inf, math.inf)
    system: ClassVar[System] = SYSTEM

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        """The rectangle about it."""
        return (-self.body.longest, self.body.longest), (-1.0, 1.0)

    @property
    def parameters(self) -> tuple[float, ...]:
        """Of the body."""
        return self.body.parameters

    @property
    def surface(self) -> Plane:
        """The other q = 0."""
        return self.body.plane

    @property
    def slowness(self) -> float:
        """√ of the ratio of the moments of inertia."""
        return math.sqrt(max(self.body.I11, self.body.I22) / min(self.body.I11, self.body.I22))

    @property
    def constants(self) -> Mapping[str, float]:
        """Moments of inertia, b3 and h."""
        return vars(self.body)

    @property
    def integrable(self) -> str:
        """The case I11 = I22, see `QuarticBody.integrable`."""
        return "the integrable case I₁₁ = I₂₂" if self.body.integrable else ""

    def moved(self, name: str, value: float) -> QuarticSection:
        """With another value of a constant."""
        return QuarticSection(replace(self.body, **{name: value}))

    def states_at(self, q: Array, p: Array) -> tuple[Array, Mask]:
        """The states (n, 5) at (q, p) (n,), and whether motions cross there (n,): p² + γ3² < 1."""
        q, p = np.array(q, float, ndmin=1), np.array(p, float, ndmin=1)
        body, along, zero = self.body, 1 - self.body.across, np.zeros(q.shape)
        place, momentum = np.stack([zero, q] if along else [q, zero]), np.empty((2, q.size))
        g3 = body.height(place.T)
        left = (1.0 - g3) * (1.0 + g3) - p * p
        # The q that is 0 grows where its p is negative.
        momentum[along], momentum[1 - along] = p, -np.sqrt(np.maximum(0.0, left))
        omega = -body.b3 * place[1] / body.I11, body.b3 * place[0] / body.I22
        return np.stack([*omega, *momentum, g3], axis=1), left > 0.0

    def places_of(self, states: Array) -> Array:
        """(q, p) (n, 2) of states (n, 5) of the section."""
        return self.body.on_section(states)
