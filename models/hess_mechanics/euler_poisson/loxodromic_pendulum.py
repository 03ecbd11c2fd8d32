"""The loxodromic pendulum: a heavy body in the Hess case with area integral f = 0 (`eq6-14` … `klas-gess-4`).

The centre of mass swings as a pendulum in a vertical plane, M stays along the normal e of that plane, and the middle
axis makes the angle l with M (M1 = K sin l, M2 = K cos l).  With α the angle of the centre of mass from its lowest
point, α̇ = w, l̇ = a w sin l, so that

    ln tan(l/2) = ln tan(l(0)/2) + a α:

on the sphere fixed in space with the pole e, l is the polar distance and α, up to a constant, the longitude of the
middle axis: its track is a loxodrome.  Two corrections to the paper: ±a13 K is the rate of ln tan(l/2)
(`klas-gess-4`), and the constant angle θ (`klas-gess-3`) is not the nutation angle, which is l.

The motion is computed by the reduced Suslov–Hess equations (`eq01`), that is, on the invariant manifold: for h > 1
the Euler–Poisson equations leave it by a factor e^{2πa} per turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.attitude import Attitude, attitude
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.equations import WITH_ATTITUDE

__all__ = ["SETTLED", "LoxodromicMotion", "LoxodromicPendulum", "loxodromic_motion"]

SETTLED = 20.0
"""Time on the separatrix, in units b = 1, after which the centre of mass is e^−20 from the top: visibly at rest."""
_MOST = 4000
_AT_THE_POLE = 0.02
"""Distance from the pole below which the direction of the track is not measured."""
_SHORT = 0.1
"""Steps in longitude shorter than this share of the longest are not measured."""


@dataclass(frozen=True)
class LoxodromicPendulum:
    """A body in the Hess case, |r| = 1, with the energy H = h μ; h = 1 is the separatrix.

    l : angle between M and the middle axis when the centre of mass passes its lowest point.
    Raises `OutsideRegion` (h ≤ −1), `InvalidParameter` (no field; not the Hess case; l not inside (0, π)).
    """

    body: HeavyBody
    h: float
    l: float

    def __post_init__(self) -> None:
        require_finite(h=self.h, l=self.l)
        if not self.body.is_hess or not self.body.mu > 0.0:
            raise InvalidParameter("A loxodromic pendulum needs a field and the Hess condition: choose μ > 0.")
        if not self.h > -1.0:
            raise OutsideRegion(f"h = {self.h:.12g} is at or below the bottom: no motion. Choose h > −1.")
        if not 0.0 < self.l < math.pi:
            raise InvalidParameter(
                f"l = {self.l:g}: there the middle axis stays at a pole, and has no track. Choose 0 < l < π."
            )

    @cached_property
    def bridge(self) -> Bridge:
        """The Suslov body with the same motions, and the map of the states."""
        return Bridge.of_heavy(self.body)

    @property
    def a(self) -> float:
        """a = b'/a1' (`m15.14`), with its sign."""
        return self.bridge.hess.a

    @property
    def frequency_unit(self) -> float:
        """√(a2 μ): in units b = 1 time is t√(a2 μ)."""
        return self.bridge.hess.frequency_unit

    @property
    def angle(self) -> float:
        """θ, sin θ = 1/√(1+a²) (`klas-gess-3`): the angle between the track and the plane of the circular section."""
        return math.atan2(1.0, abs(self.a))

    @property
    def amplitude(self) -> float:
        """The largest α of an oscillation; ∞ for h ≥ 1."""
        return math.acos(-self.h) if self.h < 1.0 else math.inf

    @property
    def start(self) -> Array:
        """The state of `WITH_ATTITUDE` with the centre of mass at its lowest point and e along M; shape (8,)."""
        s, c = math.cos(self.l), math.sin(self.l)
        w = math.sqrt(2.0 * (self.h + 1.0))
        return np.array([w * s, w * c, 0.0, 0.0, 1.0, -s, -c, 0.0])

    @property
    def principal(self) -> Array:
        """The reflection (3, 3) from (n1, n2, n3) to principal axes, v @ principal."""
        return self.bridge.from_reduced(np.hstack([np.zeros((3, 2)), np.eye(3)]))[:, 3:]

    def l_at(self, swing: Array) -> Array:
        """l (n,) at the angles α = swing (n,) of the centre of mass, in closed form."""
        with np.errstate(over="ignore"):
            l: Array = 2.0 * np.arctan(math.tan(0.5 * self.l) * np.exp(self.a * np.asarray(swing)))
        return l

    def middle_axis_at(self, swing: Array) -> Array:
        """The loxodrome (n, 3): the middle axis in space, along (γ, e, γ × e), at the angles α = swing (n,)."""
        l, alpha = self.l_at(swing), np.asarray(swing)
        return np.stack([np.sin(l) * np.sin(alpha), np.cos(l), np.sin(l) * np.cos(alpha)], axis=1)

    def windings(self, to_the_pole: float, turns: float) -> tuple[float, float]:
        """The α between which the loxodrome comes as near to its poles as this, or winds so often to either side."""
        most = 2.0 * math.pi * turns
        reach, middle = -math.log(math.tan(0.5 * to_the_pole)), math.log(math.tan(0.5 * self.l))
        if abs(self.a) * most <= reach + abs(middle):
            return -most, most
        return (-reach - middle) / self.a, (reach - middle) / self.a

    def length(self, span: float) -> float:
        """`span` in units b = 1, at most `SETTLED` on the separatrix."""
        length = span * self.frequency_unit
        return min(length, SETTLED) if self.h == 1.0 else length


@dataclass(frozen=True)
class LoxodromicMotion:
    """One motion of a loxodromic pendulum.

    times : (n,), in the body's units; attitude : its `axes` in principal axes, its orbit in units b = 1.
    centre, middle : (n, 3), centre of mass and middle axis in space, along (γ, e, γ × e).
    """

    pendulum: LoxodromicPendulum
    times: Array
    attitude: Attitude
    centre: Array
    middle: Array

    @cached_property
    def swing(self) -> Array:
        """α (n,): the angle of the centre of mass from its lowest point."""
        return frozen(np.unwrap(np.arctan2(-self.centre[:, 2], self.centre[:, 0])))

    @cached_property
    def l(self) -> Array:  # noqa: E743 (the symbol of Andoyer and Deprit)
        """l (n,): the angle between e and the middle axis."""
        return frozen(np.arctan2(np.hypot(self.middle[:, 0], self.middle[:, 2]), self.middle[:, 1]))

    @property
    def off_plane(self) -> float:
        """The largest distance of the centre of mass from its great circle."""
        return float(np.max(np.abs(self.centre[:, 1])))

    @cached_property
    def measured(self) -> tuple[Array, Array]:
        """Times and θ (m,) between consecutive samples, measured from the middle axis on the sphere alone.

        A loxodrome meets all meridians, the great circles through ±e, at one angle, whose tangent between two of its
        points is Δ longitude / Δ ln tan(l/2).  Samples near the poles and where the axis turns back are left out.
        """
        m, l = self.middle, self.l
        longitude = np.unwrap(np.arctan2(m[:, 0], m[:, 2]))
        with np.errstate(divide="ignore"):
            latitude = np.log(np.tan(0.5 * l))
        clear = np.sin(l) > _AT_THE_POLE
        apart = np.abs(np.diff(longitude))
        good = clear[1:] & clear[:-1]
        good &= apart > _SHORT * np.max(apart, initial=0.0, where=good)
        change = np.abs(np.diff(np.where(clear, latitude, 0.0)))
        times = 0.5 * (self.times[1:] + self.times[:-1])
        return frozen(times[good]), frozen(np.arctan2(apart, change)[good])


def loxodromic_motion(pendulum: LoxodromicPendulum, span: float, level: Accuracy) -> LoxodromicMotion:
    """The motion over `span` of the body's time from the lowest point, sampled for pictures of `PIXELS`.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import HeavyBody, LoxodromicPendulum, level, loxodromic_motion
    >>> pendulum = LoxodromicPendulum(HeavyBody.hess((1.0, 1.5, 2.0), 1.0), 0.5, 0.3)
    >>> float(loxodromic_motion(pendulum, 4.0, level("standard")).times[-1])
    4.0
    """
    require_finite(span=span)
    radius = 0.5 * PIXELS
    lying = attitude(
        WITH_ATTITUDE.at((pendulum.a, 1.0)),
        pendulum.start,
        pendulum.length(span),
        level,
        (0.0, 0.0, *(radius,) * 6),
        SAGITTA,
        _MOST,
    )
    axes = lying.axes @ pendulum.principal
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    lying = replace(lying, axes=frozen(axes))
    return LoxodromicMotion(
        pendulum=pendulum,
        times=frozen(lying.times / pendulum.frequency_unit),
        attitude=lying,
        centre=frozen(lying.in_space(pendulum.body.r)),
        middle=frozen(lying.in_space((0.0, 1.0, 0.0))),
    )
