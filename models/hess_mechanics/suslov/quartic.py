"""The Suslov problem with e and the centre of mass on one principal axis, b1 = b2 = 0 (`eqs02`).

The energy E gives γ3 = E/b3 − (b3/2)(q1²/I22 + q2²/I11) with q = (I22 ω2, −I11 ω1)/b3, and p = (γ1, γ2) obeys

    q̇ = −p,  ṗ = ∇V(q),  V = γ3²/2,  H = p²/2 + V = 1/2:

a point in a quartic potential, always at the level ½, with time reversed ({p_i, q_k} = δ_ik).  It moves where |γ3| ≤ 1:
inside an ellipse for |E| < |b3|, between two ellipses for E > |b3|.  For I11 = I22 the potential is central, and
q1 p2 − q2 p1 = I11(ω1γ1 + ω2γ2)/b3 is an integral.  Time is not rescaled.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.motions import section_motions, with_default
from hess_mechanics.dynamics.plane_section import Plane
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, NoField, OutsideRegion
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.parameters import Parameter, plain
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.plane_potential import PlaneProblem

__all__ = [
    "SECTION",
    "QuarticBody",
    "QuarticSection",
    "angular_momentum",
    "level_error",
    "start_on_section",
    "state_at",
]

_EDGE = 1e-9
_INSIDE = 1e-9
_MIDDLE = 1e-100
"""Size, in units of the region, below which a point has no direction."""
_MOST_SIZE = 1e30
"""Largest semi-axis, and inverse of the smallest: numbers in plots are single precision."""


@dataclass(frozen=True)
class QuarticBody(PlaneProblem):
    """Body with I13 = I23 = 0 and b = (0, 0, b3), at the energy E.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0; its unit is the unit I of moments of inertia.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in units I.
    b3 : float
        Third component of **b** = −mg **r**, with **r** the centre of mass; nonzero, in units I/T².
    E : float
        Energy, E > −|b3|, in units I/T².

    Raises
    ------
    NoField
        If b3 = 0.
    OutsideRegion
        If E ≤ −|b3|.
    InvalidParameter
        If a parameter is not finite, or a semi-axis of the region of motion is not from 1e-30 to 1e30.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    References
    ----------
    `eqs02`.

    Examples
    --------
    >>> from hess_mechanics import QuarticBody
    >>> body = QuarticBody(1.3, 0.8, 1.0, E=2.0)
    >>> [round(axis, 4) for axis in body.axes]
    [2.1909, 2.7928]
    """

    b3: float
    E: float

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.b3 == 0.0:
            raise NoField("b3 = 0: without a field the energy does not determine γ₃. Choose a nonzero b3.")
        if not -abs(self.b3) < self.E:
            raise OutsideRegion(f"No motion has the energy E = {self.E:g}: choose E above −|b3| = {-abs(self.b3):.6g}.")
        smallest, largest = sorted(self.axes)
        if not 1.0 / _MOST_SIZE <= smallest <= largest <= _MOST_SIZE:
            sizes = " and ".join(f"{plain(one, 2)}" if math.isfinite(one) else "beyond 1e308" for one in self.axes)
            raise InvalidParameter(
                f"The region in the plane has semi-axes {sizes}, which no picture can show: choose more similar sizes "
                "of E, b3 and the moments of inertia."
            )

    @property
    def h(self) -> float:
        """The energy above the lowest, −|b3|."""
        return self.E + abs(self.b3)

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p of the system "suslov"."""
        return (self.I11, self.I22, 0.0, 0.0, 0.0, 0.0, self.b3)

    @property
    def axes(self) -> tuple[float, float]:
        """The semi-axes along q1 and q2 of the ellipse γ3 b3 = −|b3| that bounds the motion."""
        size = 2.0 * self.h
        return math.sqrt(size * self.I22) / abs(self.b3), math.sqrt(size * self.I11) / abs(self.b3)

    def _size(self, height: Array | float) -> Array:
        """Return the size of the ellipse on which γ3 has a given value, in units of `axes`; 0 if it does not exist."""
        size = abs(self.b3)
        return np.sqrt(np.maximum(0.0, self.E - self.b3 * np.asarray(height)) / (self.E + size))

    @property
    def hole(self) -> float:
        """The size of the forbidden inner ellipse in units of `axes`; 0 for E ≤ |b3|."""
        return float(self._size(math.copysign(1.0, self.b3)))

    @property
    def integrable(self) -> bool:
        """True if q1p2 − q2p1 is an integral."""
        return self.I11 == self.I22

    def pixels_per_unit(self, half_width: float) -> tuple[float, ...]:
        """Return the pixels per unit of each variable in plots of |q| ≤ half_width and of the unit circle of γ.

        Parameters
        ----------
        half_width : float
            Largest |q| of the plot, positive.

        Returns
        -------
        tuple of five floats
            Pixels per unit of ω1, ω2, γ1, γ2, γ3.
        """
        radius = 0.5 * PIXELS
        scale = radius / (half_width * abs(self.b3))
        return (scale * self.I11, scale * self.I22, radius, radius, radius)

    def nearest_possible(self, q: tuple[float, float]) -> tuple[float, float]:
        """Return q if the energy allows it, otherwise the nearest allowed point in its direction, a little inside.

        Parameters
        ----------
        q : tuple of two floats
            Point of the plane.

        Returns
        -------
        tuple of two floats
            Point at which |γ3| ≤ 1; on the axis of q1 if q is 0 and forbidden.
        """
        first, second = self.axes
        x, y = q[0] / first, q[1] / second
        size, inner = math.hypot(x, y), self.hole
        if inner <= size <= 1.0:
            return q
        if size < _MIDDLE:
            x, y, size = 1.0, 0.0, 1.0
        # Leave less room in a narrow ring.
        room = min(_INSIDE, 0.25 * (1.0 - inner))
        share = min(1.0 - room, max(inner + room, size)) / size
        return share * x * first, share * y * second

    @property
    def minor_axis(self) -> int:
        """The index of the q that is 0 on the section: the one along the minor axis.

        For E > |b3| an orbit can stay near one end of the major axis forever, but it always crosses that axis.
        """
        return 0 if self.I11 > self.I22 else 1

    @property
    def major_semi_axis(self) -> float:
        """The major semi-axis of the ellipse, along which the section lies."""
        return self.axes[1 - self.minor_axis]

    def ellipse(self, size: float = 1.0) -> Array:
        """Return the ellipse that bounds the motion, or a similar one.

        Parameters
        ----------
        size : float, optional
            Factor of the semi-axes, ≥ 0.

        Returns
        -------
        ndarray of float, shape (181, 2)
            Points q of the closed curve.
        """
        angle = np.linspace(0.0, 2.0 * math.pi, 181)
        return np.asarray(size * np.array(self.axes) * np.column_stack([np.cos(angle), np.sin(angle)]))

    def equipotentials(self, heights: Sequence[float]) -> list[Array]:
        """Return the curves on which γ3 has given values.

        Parameters
        ----------
        heights : sequence of float
            Values of γ3, −1 to 1.

        Returns
        -------
        list of ndarray of float, shape (181, 2)
            Closed curves of points q, one for each value that γ3 has on a curve.
        """
        return [self.ellipse(size) for size in self._size(np.array(heights)).tolist() if size > 0.0]

    def holes(self) -> list[Array]:
        """Return the boundary of the forbidden inner ellipse, if there is one.

        Returns
        -------
        list of ndarray of float, shape (181, 2)
            One closed curve of points q for E > |b3|, otherwise empty.
        """
        return self.equipotentials([math.copysign(1.0, self.b3)])

    @property
    def plane(self) -> Plane:
        """The section q_i = 0, i = `minor_axis`, crossed while q_i increases, in terms of ω."""
        rising = self.minor_axis == 0
        return Plane((float(not rising), float(rising), 0.0, 0.0, 0.0), sense=1 if rising == (self.b3 > 0.0) else -1)

    def height(self, q: Array) -> Array:
        """Return γ3 at points of the plane; the potential is V = γ3²/2.

        Parameters
        ----------
        q : array_like of float, shape (..., 2)
            Points of the plane.

        Returns
        -------
        ndarray of float, shape (...)
            Values of γ3.
        """
        q = np.asarray(q, float)
        return np.asarray(self.E / self.b3 - 0.5 * self.b3 * (q[..., 0] ** 2 / self.I22 + q[..., 1] ** 2 / self.I11))

    def to_plane(self, states: Array) -> tuple[Array, Array]:
        """Return the plane coordinates q and momenta p of states.

        Parameters
        ----------
        states : ndarray of float, shape (m, 5)
            States (ω1, ω2, γ1, γ2, γ3).

        Returns
        -------
        q : ndarray of float, shape (m, 2)
            Points (I22 ω2, −I11 ω1)/b3.
        p : ndarray of float, shape (m, 2)
            Momenta (γ1, γ2).
        """
        q = np.column_stack([self.I22 * states[:, 1], -self.I11 * states[:, 0]]) / self.b3
        return q, states[:, 2:4].copy()

    def omega(self, q: Any) -> tuple[Any, Any]:
        """Return ω1, ω2 at the point q.

        Parameters
        ----------
        q : tuple of two floats or arrays
            Points of the plane.

        Returns
        -------
        tuple of two floats or arrays
            Components −b3 q2/I11, b3 q1/I22.
        """
        return -self.b3 * q[1] / self.I11, self.b3 * q[0] / self.I22

    def section_boundaries(self) -> list[Array]:
        """Return the curves p² + γ3² = 1 that bound the section.

        Returns
        -------
        list of ndarray of float, shape (n, 2)
            One closed curve of points (q, p), n = 362, or two with n = 181 for E ≥ |b3|, the right one first.
        """
        size = abs(self.b3)
        first = math.acos(self.E / size) if size > self.E else 0.0
        angle = np.linspace(first, 2.0 * math.pi - first, 181)
        right = np.column_stack(
            [self.major_semi_axis * self._size(math.copysign(1.0, self.b3) * np.cos(angle)), np.sin(angle)]
        )
        left = right * np.array([-1.0, 1.0])
        return [np.vstack([right, left[::-1]])] if first else [right, left]


def level_error(body: QuarticBody, states: Array) -> float:
    """Return the largest |H − ½| of states, where H = (p² + γ3²)/2 is ½ on all motions.

    Parameters
    ----------
    body : QuarticBody
        The body.
    states : ndarray, shape (m, 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    float
        The largest |H − ½|.
    """
    q, p = body.to_plane(states)
    return float(0.5 * np.abs(np.sum(p * p, axis=1) + body.height(q) ** 2 - 1.0).max())


def state_at(body: QuarticBody, q: Sequence[float], direction: float) -> tuple[float, ...]:
    """Return the state at a point of the plane with a given direction of q̇ = −p.

    Parameters
    ----------
    body : QuarticBody
        The body.
    q : sequence of float, shape (2,)
        Point of the plane, at which |γ3| ≤ 1.
    direction : float
        Angle of q̇, in radians.

    Returns
    -------
    tuple of five floats
        State (ω1, ω2, γ1, γ2, γ3).

    Raises
    ------
    OutsideRegion
        If |γ3| exceeds 1 by more than 1e-9 at the point.
    InvalidParameter
        If a number is not finite.
    """
    require_finite(q1=q[0], q2=q[1], direction=direction)
    g3 = float(body.height(np.array(q)))
    if abs(g3) > 1.0 + _EDGE:
        raise OutsideRegion(
            f"At q = ({q[0]:.6g}, {q[1]:.6g}) the potential is {0.5 * g3 * g3:.6g}, above the level ½: γ₃ would be "
            f"{g3:.6g}. Choose a start in the region of motion."
        )
    g3 = min(1.0, max(-1.0, g3))
    size = math.sqrt((1.0 - g3) * (1.0 + g3))
    return (*body.omega(q), -size * math.cos(direction), -size * math.sin(direction), g3)


def start_on_section(body: QuarticBody, x: float, y: float) -> tuple[float, float, float]:
    """Return the arguments of `state_at` for a point of the section.

    Parameters
    ----------
    body : QuarticBody
        The body.
    x : float
        Coordinate q along the major axis.
    y : float
        Its momentum p.

    Returns
    -------
    tuple of three floats
        Values q1, q2 and the direction of q̇, in radians.

    Raises
    ------
    OutsideRegion
        If no motion crosses the section there.
    """
    p = QuarticSection(body).state_at(x, y)[2:4]
    return (*((x, 0.0) if body.minor_axis else (0.0, x)), math.atan2(-p[1], -p[0]))


def angular_momentum(body: QuarticBody, states: Array) -> Array:
    """Return q1 p2 − q2 p1 of states, an integral for I11 = I22.

    Parameters
    ----------
    body : QuarticBody
        The body.
    states : ndarray, shape (m, 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (m,)
        Values of q1 p2 − q2 p1.
    """
    q, p = body.to_plane(states)
    return np.asarray(q[:, 0] * p[:, 1] - q[:, 1] * p[:, 0])


@dataclass(frozen=True)
class QuarticSection(PoincareSection):
    """Section of a body at its energy, in the canonical coordinates (q, p) along the major axis.

    Parameters
    ----------
    body : QuarticBody
        The body, with its energy.
    """

    body: QuarticBody

    names: ClassVar[tuple[str, str]] = ("q", "p")
    turns: ClassVar[tuple[float, float]] = (math.inf, math.inf)
    system: ClassVar[System] = SYSTEM

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        """The rectangle that contains the section."""
        return (-self.body.major_semi_axis, self.body.major_semi_axis), (-1.0, 1.0)

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters of the body."""
        return self.body.parameters

    @property
    def surface(self) -> Plane:
        """The plane on which the other q is 0."""
        return self.body.plane

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the larger to the smaller of I11 and I22."""
        return math.sqrt(max(self.body.I11, self.body.I22) / min(self.body.I11, self.body.I22))

    @property
    def constants(self) -> Mapping[str, float]:
        """The moments of inertia, b3 and E."""
        return vars(self.body)

    @property
    def integrable(self) -> str:
        """The integrable case I11 = I22 in words, see `QuarticBody.integrable`, or an empty string."""
        return "the integrable case I₁₁ = I₂₂" if self.body.integrable else ""

    def at_constant(self, name: str, value: float) -> QuarticSection:
        """Return the section with another value of one constant.

        Parameters
        ----------
        name : str
            Name of the constant: I11, I22, b3 or E.
        value : float
            Its new value.

        Returns
        -------
        QuarticSection
            The other section.

        Raises
        ------
        ModelError
            As `QuarticBody`.
        """
        return QuarticSection(replace(self.body, **{name: value}))

    def states_at(self, q: Array | float, p: Array | float) -> tuple[Array, Mask]:
        """Return the states at points of the section.

        Parameters
        ----------
        q : float or ndarray, shape (n,)
            Coordinates q.
        p : float or ndarray, shape (n,)
            Momenta p.

        Returns
        -------
        states : ndarray, shape (n, 5)
            States (ω1, ω2, γ1, γ2, γ3).
        possible : ndarray of bool, shape (n,)
            True for points with motion, p² + γ3² < 1.
        """
        q, p = np.array(q, float, ndmin=1), np.array(p, float, ndmin=1)
        along = 1 - self.body.minor_axis
        place, momentum = np.zeros((2, q.size)), np.zeros((2, q.size))
        place[along], momentum[along] = q, p
        g3 = self.body.height(place.T)
        left = (1.0 - g3) * (1.0 + g3) - p * p
        # On the section one q vanishes, and increases where its p is negative.
        momentum[1 - along] = -np.sqrt(np.maximum(0.0, left))
        return np.stack([*self.body.omega(place), *momentum, g3], axis=1), left > 0.0

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie.

        Parameters
        ----------
        states : ndarray, shape (n, 5)
            States of the section.

        Returns
        -------
        ndarray, shape (n, 2)
            Coordinates q and p.
        """
        q, p = self.body.to_plane(states)
        along = 1 - self.body.minor_axis
        return np.column_stack([q[:, along], p[:, along]])


SECTION = section_motions(
    "quartic",
    "Suslov problem with b1 = b2 = 0, a point of a section",
    (with_default(known.I11, 2.0), with_default(known.I22, 1.0), with_default(known.B3, 1.0), known.H_QUARTIC),
    (
        Parameter("q", "q", "Start: q", 0.8, (-1.5, 1.5), 0.01, (-1e3, 1e3), "Coordinate along the major axis."),
        Parameter("p", "p", "Start: p", 0.0, (-1.0, 1.0), 0.01, (-1.0, 1.0), "Its momentum."),
    ),
    lambda values: QuarticSection(QuarticBody(*(values[name] for name in ("I11", "I22", "b3", "h")))),
    SYSTEM,
    period=3,
)
"""Motions from points of the section along the major axis of the region of motion."""
