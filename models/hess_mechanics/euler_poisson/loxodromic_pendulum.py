"""The loxodromic pendulum: a heavy body in the Hess case with area integral f = 0 (`eq6-14` … `klas-gess-4`).

The centre of mass swings as a pendulum in a vertical plane, M stays along the normal e of that plane, and the middle
axis makes the angle l with M (M1 = K sin l, M2 = K cos l).  With α the angle of the centre of mass from its lowest
point, α̇ = w, l̇ = a w sin l, so that

    ln tan(l/2) = ln tan(l(0)/2) + a α:

on the sphere fixed in space with the pole e, l is the polar distance and α, up to a constant, the longitude of the
middle axis: its track is a loxodrome.  Two corrections to the paper: ±a13 K is the rate of ln tan(l/2)
(`klas-gess-4`), and the constant angle θ (`klas-gess-3`) is not the nutation angle, which is l.

The motion is computed from the reduced Suslov–Hess equations (`eq01`), that is, on the invariant manifold: for h > 1
solutions of the Euler–Poisson equations depart from it by a factor e^{2π|a|} per turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_mechanics.dynamics.orbit import as_duration, solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_a
from hess_mechanics.numerics.labelled import ShortRepr
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.rigid_body.attitude import Attitude, orthonormal
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.equations import WITH_ATTITUDE

__all__ = ["SETTLING_TIME", "LoxodromicMotion", "LoxodromicPendulum", "loxodromic_motion"]

SETTLING_TIME = 20.0
"""Time on the separatrix, in units b = 1, after which the centre of mass is within 4e^−20 rad of the top."""
_MOST = 4000
_AT_THE_POLE = 0.02
"""Distance from the pole below which the direction of the track is not measured."""
_SHORT = 0.1
"""Smallest step in longitude that is measured, as a share of the largest."""


@dataclass(frozen=True)
class LoxodromicPendulum:
    """Heavy body in the Hess case with area integral f = 0 at one energy.

    Parameters
    ----------
    body : HeavyBody
        Body in the Hess case with μ > 0 and |r| = 1, which is not checked.
    h : float
        Energy in units of μ, H = h μ, h > −1; h = 1 is the separatrix.
    l : float
        Angle between M and the middle axis when the centre of mass passes its lowest point, in radians, 0 < l < π.

    Raises
    ------
    OutsideRegion
        If h ≤ −1.
    InvalidParameter
        If the body is not in the Hess case, μ ≤ 0, a number is not finite, or l is not in (0, π).

    References
    ----------
    `eq6-14`, `klas-gess-3`, `klas-gess-4`.

    Examples
    --------
    >>> from hess_mechanics import HeavyBody, LoxodromicPendulum
    >>> pendulum = LoxodromicPendulum(HeavyBody.hess((1.0, 1.5, 2.0), 1.0), 0.5, 0.3)
    >>> round(pendulum.angle, 6)
    1.230959
    """

    body: HeavyBody
    h: float
    l: float

    def __post_init__(self) -> None:
        as_a(HeavyBody, self.body)
        require_finite(h=self.h, l=self.l)
        if not self.body.is_hess or not self.body.mu > 0.0:
            raise InvalidParameter(
                "A loxodromic pendulum needs μ > 0 and the Hess condition: choose μ > 0 and a body from "
                "`HeavyBody.hess`."
            )
        if not self.h > -1.0:
            raise OutsideRegion(f"h = {self.h:.12g} is not above the lowest energy: choose h > −1.")
        if not 0.0 < self.l < math.pi:
            raise InvalidParameter(
                f"l = {self.l:g} is out of range: choose 0 < l < π. At 0 and π the middle axis stays at a pole."
            )

    @cached_property
    def bridge(self) -> Bridge:
        """The Suslov body with the same motions, and the map of the states."""
        return Bridge.of_heavy(self.body)

    @property
    def a(self) -> float:
        """The parameter a = b'/a1' (`m15.14`), with its sign."""
        return self.bridge.hess.a

    @property
    def frequency_unit(self) -> float:
        """The unit of frequency √(a2 μ), in 1/T: in units b = 1 time is t√(a2 μ)."""
        return self.bridge.hess.frequency_unit

    @property
    def angle(self) -> float:
        """The angle θ between the track of the middle axis and the meridians through ±e, in radians (`klas-gess-3`).

        sin θ = 1/√(1 + a²).
        """
        return math.atan2(1.0, abs(self.a))

    @property
    def amplitude(self) -> float:
        """The largest α of an oscillation, in radians; ∞ for h ≥ 1."""
        return math.acos(-self.h) if self.h < 1.0 else math.inf

    @property
    def start(self) -> Array:
        """The state (8,) of `WITH_ATTITUDE` with the centre of mass at its lowest point and e along M."""
        s, c = math.cos(self.l), math.sin(self.l)
        w = math.sqrt(2.0 * (self.h + 1.0))
        return np.array([w * s, w * c, 0.0, 0.0, 1.0, -s, -c, 0.0])

    @property
    def principal(self) -> Array:
        """The matrix (3, 3) of a reflection: v @ principal has the components of v = (n1, n2, n3) in principal axes."""
        return self.bridge.from_reduced(np.hstack([np.zeros((3, 2)), np.eye(3)]))[:, 3:]

    def l_at(self, swing: Array) -> Array:
        """Return the angle l in closed form.

        Parameters
        ----------
        swing : array_like of float, shape (n,)
            Angles α of the centre of mass in radians.

        Returns
        -------
        ndarray of float, shape (n,)
            Angles l in radians.
        """
        with np.errstate(over="ignore"):
            l: Array = 2.0 * np.arctan(math.tan(0.5 * self.l) * np.exp(self.a * np.asarray(swing)))
        return l

    def middle_axis_at(self, swing: Array) -> Array:
        """Return the loxodrome, the track of the middle axis in space.

        Parameters
        ----------
        swing : array_like of float, shape (n,)
            Angles α of the centre of mass in radians.

        Returns
        -------
        ndarray of float, shape (n, 3)
            Unit vectors along (γ, e, γ × e).
        """
        l, alpha = self.l_at(swing), np.asarray(swing)
        return np.stack([np.sin(l) * np.sin(alpha), np.cos(l), np.sin(l) * np.cos(alpha)], axis=1)

    def windings(self, to_the_pole: float, turns: float) -> tuple[float, float]:
        """Return the interval of α over which to draw the loxodrome.

        Parameters
        ----------
        to_the_pole : float
            Distance from both poles, in radians, at which the curve ends, between 0 and π/2.
        turns : float
            Largest number of windings to either side; if they do not reach both ends, the curve has this many.

        Returns
        -------
        tuple of two floats
            Both ends α, in radians; for a < 0 the first may be the larger one.
        """
        most = 2.0 * math.pi * turns
        reach, middle = -math.log(math.tan(0.5 * to_the_pole)), math.log(math.tan(0.5 * self.l))
        if abs(self.a) * most <= reach + abs(middle):
            return -most, most
        return (-reach - middle) / self.a, (reach - middle) / self.a

    def length(self, duration: float) -> float:
        """Return a duration in units b = 1, at most `SETTLING_TIME` on the separatrix.

        Parameters
        ----------
        duration : float
            Time in the units of the body; negative: backward, without the limit.

        Returns
        -------
        float
            Time in units b = 1.
        """
        length = duration * self.frequency_unit
        return min(length, SETTLING_TIME) if self.h == 1.0 else length


@dataclass(frozen=True)
class LoxodromicMotion(ShortRepr):
    """Motion of a loxodromic pendulum; the result of `loxodromic_motion`.

    Attributes
    ----------
    pendulum : LoxodromicPendulum
        The pendulum.
    times : ndarray of float, shape (n,)
        Times in the units of the body, up to `SETTLING_TIME` in units b = 1 on the separatrix.
    attitude : Attitude
        The attitude: γ, e and γ × e in the principal axes of the body.
    orbit : Orbit
        The orbit of `WITH_ATTITUDE`, in units b = 1.
    centre : ndarray of float, shape (n, 3)
        Direction of the centre of mass in space, along (γ, e, γ × e).
    middle : ndarray of float, shape (n, 3)
        Direction of the middle axis in space, along (γ, e, γ × e).
    """

    pendulum: LoxodromicPendulum
    times: Array
    attitude: Attitude
    orbit: Orbit
    centre: Array
    middle: Array

    @cached_property
    def swing(self) -> Array:
        """The angle α (n,) of the centre of mass from its lowest point, in radians, continued over full turns."""
        return as_read_only(np.unwrap(np.arctan2(-self.centre[:, 2], self.centre[:, 0])))

    @cached_property
    def l(self) -> Array:  # noqa: E743 (the symbol of Andoyer and Deprit)
        """The angle l (n,) between e and the middle axis, in radians."""
        return as_read_only(np.arctan2(np.hypot(self.middle[:, 0], self.middle[:, 2]), self.middle[:, 1]))

    @property
    def plane_distance(self) -> float:
        """The largest distance of the centre of mass from its great circle."""
        return float(np.max(np.abs(self.centre[:, 1])))

    @cached_property
    def angles(self) -> tuple[Array, Array]:
        """Times (m,) midway between samples, and θ (m,) there in radians, measured on the track of the middle axis.

        A loxodrome meets all meridians, the great circles through ±e, at one angle, whose tangent between two of its
        points is |Δ longitude / Δ ln tan(l/2)|.  Samples near the poles and near reversals of the axis are left out.
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
        return as_read_only(times[good]), as_read_only(np.arctan2(apart, change)[good])


def loxodromic_motion(pendulum: LoxodromicPendulum, duration: float, accuracy: Accuracy) -> LoxodromicMotion:
    """Return the motion of a loxodromic pendulum that starts at its lowest point.

    Parameters
    ----------
    pendulum : LoxodromicPendulum
        The pendulum.
    duration : float
        Time, in the units of the body, nonzero; negative: backward.  A positive one is cut at `SETTLING_TIME` on
        the separatrix.
    accuracy : str or Level
        Accuracy level or its name, see `level`.

    Returns
    -------
    LoxodromicMotion
        The motion, sampled for plots.

    Raises
    ------
    InvalidParameter
        If the duration is not finite, 0 or too short.
    WorkLimit
        If the motion needs too many samples or steps.

    References
    ----------
    `eq6-14`, `klas-gess-3`.

    Examples
    --------
    >>> from hess_mechanics import HeavyBody, LoxodromicPendulum, loxodromic_motion
    >>> pendulum = LoxodromicPendulum(HeavyBody.hess((1.0, 1.5, 2.0), 1.0), 0.5, 0.3)
    >>> motion = loxodromic_motion(pendulum, 4.0, "standard")
    >>> float(motion.times[-1]), round(float(motion.l[-1]), 5)
    (4.0, 0.50954)
    """
    span = as_duration(duration, "a loxodromic motion")
    system = WITH_ATTITUDE.at((pendulum.a, 1.0))
    weights = np.array([0.0] * 2 + [0.5 * PIXELS] * 6)
    times = sample_times(system, pendulum.start, pendulum.length(span), weights, SAGITTA, _MOST)
    orbit = solve(system, pendulum.start, times, accuracy)
    principal = pendulum.principal
    axes, defect = orthonormal(orbit.states[:, 2:5] @ principal, orbit.states[:, 5:] @ principal)
    lying = Attitude(as_read_only(orbit.times / pendulum.frequency_unit), as_read_only(axes), defect)
    return LoxodromicMotion(
        pendulum=pendulum,
        times=lying.times,
        attitude=lying,
        orbit=orbit,
        centre=as_read_only(lying.in_space(pendulum.body.r)),
        middle=as_read_only(lying.in_space((0.0, 1.0, 0.0))),
    )
