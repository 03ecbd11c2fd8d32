"""S14: the loxodromic pendulum, a heavy body in the Hess case with area integral f = 0 (`eq6-14` … `klas-gess-4`).

The centre of mass swings as a pendulum in a vertical plane, M stays along the normal e of that plane, and the middle
axis makes the angle l with M (M1 = K sin l, M2 = K cos l).  With α the angle of the centre of mass from its lowest
place, α̇ = w, l̇ = a w sin l, so that

    ln tan(l/2) = ln tan(l(0)/2) + a α:

on the sphere fixed in space, with the pole e, l is the distance from the pole and α the longitude (up to a constant) of
the middle axis: its track is a loxodrome.  Corrections to the paper used here: in `klas-gess-4` it is the rate of
ln tan(l/2) that is ±a13 K, and the constant angle θ of `klas-gess-3` is not the nutation angle, which is l.

It is computed by `eq01` on the invariant manifold itself: for h > 1 `hh01` leaves it by a factor e^{2πa} in each turn.
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
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.attitude import HESS, Attitude, attitude
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = ["SETTLED", "LoxodromicMotion", "LoxodromicPendulum", "loxodromic_motion"]

SETTLED = 20.0
"""Time on the separatrix, in units b = 1, after which the centre of mass is at rest to the eye, e^−20 from the top."""
_MOST = 4000
_AT_THE_POLE = 0.02
"""Distance from the pole below which a direction of the track means nothing."""
_SHORT = 0.1


@dataclass(frozen=True)
class LoxodromicPendulum:
    """A body of the Hess case, |r| = 1, at the energy H = h μ, h in units of the field; h = 1 is the separatrix.

    l : the angle between M and the middle axis when the centre of mass passes its lowest place.
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
            raise InvalidParameter(f"l = {self.l:g}: there the middle axis stays at a pole, and has no track. Choose "
                                   "0 < l < π.")

    @cached_property
    def bridge(self) -> Bridge:
        """The Suslov body of the same motions, and the way to its states."""
        return Bridge.of_heavy(self.body)

    @property
    def a(self) -> float:
        """a = b'/a1' of `m15.14`, with its sign."""
        return self.bridge.hess.a

    @property
    def frequency_unit(self) -> float:
        """√(a2 μ): in units b = 1 time is t√(a2 μ)."""
        return self.bridge.hess.frequency_unit

    @property
    def angle(self) -> float:
        """θ of `klas-gess-3`, sin θ = 1/√(1+a²): between the track and the plane of the circular section."""
        return math.atan2(1.0, abs(self.a))

    @property
    def amplitude(self) -> float:
        """The largest α of an oscillation; ∞ for h ≥ 1."""
        return math.acos(-self.h) if self.h < 1.0 else math.inf

    @property
    def start(self) -> Array:
        """The state of `attitude.HESS` at the lowest place of the centre of mass, e along M; shape (8,)."""
        s, c = math.cos(self.l), math.sin(self.l)
        w = math.sqrt(2.0 * (self.h + 1.0))
        return np.array([w * s, w * c, 0.0, 0.0, 1.0, -s, -c, 0.0])

    @property
    def principal(self) -> Array:
        """(3, 3): (n1, n2, n3) → principal axes, v @ principal; a reflection."""
        return self.bridge.from_reduced(np.hstack([np.zeros((3, 2)), np.eye(3)]))[:, 3:]

    def l_at(self, swing: Array) -> Array:
        """l at the angle α = swing (n,) of the centre of mass, from the closed form."""
        with np.errstate(over="ignore"):
            return 2.0 * np.arctan(math.tan(0.5 * self.l) * np.exp(self.a * np.asarray(swing)))

    def middle_axis_at(self, swing: Array) -> Array:
        """The middle axis in space, along (γ, e, γ × e), at the angles α = swing (n,): the loxodrome, (n, 3)."""
        l, alpha = self.l_at(swing), np.asarray(swing)
        return np.stack([np.sin(l) * np.sin(alpha), np.cos(l), np.sin(l) * np.cos(alpha)], axis=1)

    def length(self, span: float) -> float:
        """`span` in units b = 1; on the separatrix at most `SETTLED`."""
        length = span * self.frequency_unit
        return min(length, SETTLED) if self.h == 1.0 else length


@dataclass(frozen=True)
class LoxodromicMotion:
    """One motion of a loxodromic pendulum.

    times : (n,), in the body's units; attitude : `axes` in the principal axes, its orbit in units b = 1.
    centre, middle : (n, 3) centre of mass and middle axis in space, along (γ, e, γ × e).
    """

    pendulum: LoxodromicPendulum
    times: Array
    attitude: Attitude
    centre: Array
    middle: Array

    @cached_property
    def swing(self) -> Array:
        """α (n,): the angle of the centre of mass from its lowest place."""
        return frozen(np.unwrap(np.arctan2(-self.centre[:, 2], self.centre[:, 0])))

    @cached_property
    def l(self) -> Array:  # noqa: E743 (the symbol of Andoyer and Deprit)
        """l (n,): the angle between e and the middle axis."""
        return frozen(np.arctan2(np.hypot(self.middle[:, 0], self.middle[:, 2]), self.middle[:, 1]))

    @property
    def off_plane(self) -> float:
        """How far the centre of mass comes from its great circle."""
        return float(np.max(np.abs(self.centre[:, 1])))

    @cached_property
    def measured(self) -> tuple[Array, Array]:
        """Times and θ (m,) from one sample of the middle axis to the next, by nothing but where it is on the sphere.

        A loxodrome meets all meridians, great circles through ±e, at one angle: that between two points of it has
        the tangent Δ longitude / Δ ln tan(l/2).  Not near the poles, nor where the axis turns back.
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


def loxodromic_motion(pendulum: LoxodromicPendulum, span: float, level: Level) -> LoxodromicMotion:
    """The motion over `span` of the body's time, sampled for pictures of `PIXELS`, from the lowest place.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    require_finite(span=span)
    radius = 0.5 * PIXELS
    lying = attitude(HESS, pendulum.start, (pendulum.a, 1.0), pendulum.length(span), level,
                     (0.0, 0.0, *(radius,) * 6), SAGITTA, _MOST)
    axes = lying.axes @ pendulum.principal
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    lying = replace(lying, axes=frozen(axes))
    return LoxodromicMotion(
        pendulum=pendulum, times=frozen(lying.times / pendulum.frequency_unit), attitude=lying,
        centre=frozen(lying.in_space(pendulum.body.r)), middle=frozen(lying.in_space((0.0, 1.0, 0.0))))
