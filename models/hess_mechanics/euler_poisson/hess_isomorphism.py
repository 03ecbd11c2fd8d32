"""The isomorphism of the Hess manifold of Euler–Poisson with the Suslov–Hess case.

On r1 M1 + r3 M3 = 0 (`g2p6f1`) the Euler–Poisson equations of a body with the Hess condition (`gess-*1`) are closed.
In the axes e2, e3' = r/|r|, e1' = e2 × e3' (`m15.9`, `m15.14`) the matrix A has a1' = a2 twice on its diagonal and b'
off it, M3' = 0 (`m15.10`), and with m = μ|r|

    w = (a1' M2', a1' M1'),  n = (−γ2', −γ1', γ3'),  a = b'/a1',  b = a1' m

turn the equations on the manifold (`gess05`) into the reduced Suslov–Hess equations (`eq01`) without rescaling time;
the map of the axes is a reflection.  (The paper prints other factors of n and b.)  For the Suslov body with
I11 = 1/a1' energy and area integral are the same numbers: E = H, F2 = −F1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter, NoField
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import f_max
from hess_mechanics.suslov_hess.equations import HessBody

__all__ = ["Bridge", "heavy_body", "hess_body", "largest_area_integral", "largest_distance", "share_of"]


def _tilt(body: HeavyBody) -> tuple[float, float]:
    """(sin, cos) of the angle from Ox3 to r, in the (r1, r3)-plane.  Raises `InvalidParameter`, `NoField`."""
    if not body.is_hess:
        raise InvalidParameter(
            "This body is not in the Hess case: choose I2 between I1 and I3, r2 = 0 and r1² (a3 − a2) = r3² (a2 − a1)."
        )
    length = math.hypot(*body.r)
    if length == 0.0:
        raise NoField("r = 0: the centre of mass is the fixed point, and gives no axis. Choose r other than 0.")
    return body.r[0] / length, body.r[2] / length


def hess_body(body: HeavyBody) -> HessBody:
    """The Suslov body, I11 = 1/a1', whose motions are those of a heavy body on the Hess manifold.

    a = b'/a1' has the sign of r1 r3 (a1 − a3).  Raises `InvalidParameter` outside the Hess case, `NoField` (r = 0).
    """
    s, c = _tilt(body)
    a = s * c * (body.a[0] - body.a[2]) / body.a[1] + 0.0  # no −0.0
    I22 = 1.0 / (body.a[1] * (1.0 + a * a))
    b = body.a[1] * body.mu * math.hypot(*body.r)
    return HessBody(I22, a * I22, -b * I22 * math.hypot(1.0, a))


def heavy_body(body: HessBody, share: float = 0.5) -> HeavyBody:
    """A heavy body in the Hess case, a1' = 1/I11, whose motions on the Hess manifold are those of a Suslov body.

    It has r1, r3 ≥ 0, |r| = 1, μ = b/a1', and a1 > a3 for a > 0.  One of its moments is free, as I33 is in the
    Suslov problem: with a1 = a2 (1 − x), a3 = a2 (1 + a²/x), or a1 and a3 exchanged, it is a rigid body for
    0 < x ≤ (1 − a²)/2; x is `share` times that bound, or times ½ where |a| ≥ 1.
    Raises `InvalidParameter` for a share outside (0, 1].
    """
    require_finite(share=share)
    if not 0.0 < share <= 1.0:
        raise InvalidParameter(f"share = {share:g} does not lie in (0, 1]: choose 0.5 for the middle.")
    squared = body.a * body.a
    x = share * 0.5 * (1.0 - squared if squared < 1.0 else 1.0)
    moments = body.I11 / (1.0 - x), body.I11, body.I11 / (1.0 + squared / x)
    return HeavyBody.hess(moments if body.a <= 0.0 else moments[::-1], body.b * body.I11)


def share_of(body: HeavyBody) -> float:
    """The share with which `heavy_body` gives back the moments of a heavy body in the Hess case.

    Above 1 the body is not rigid, and there is no way back; where r1 r3 < 0 the moments I1 and I3 come back exchanged.
    Raises `InvalidParameter` outside the Hess case, `NoField` (r = 0).
    """
    squared = hess_body(body).a ** 2
    return (1.0 - min(body.a) / body.a[1]) / (0.5 * (1.0 - squared if squared < 1.0 else 1.0))


@dataclass(frozen=True)
class Bridge:
    """A heavy body in the Hess case and the Suslov body with the same motions.

    Made by `of_heavy` or `of_suslov`.  States (M, γ) are (…, 6), reduced states (w, n) (…, 5), in the same time.
    """

    heavy: HeavyBody
    hess: HessBody

    @classmethod
    def of_heavy(cls, heavy: HeavyBody) -> Bridge:
        """From Euler–Poisson.  Raises `InvalidParameter`, `NoField`."""
        return cls(heavy, hess_body(heavy))

    @classmethod
    def of_suslov(cls, hess: HessBody, share: float = 0.5) -> Bridge:
        """From the Suslov problem; share as for `heavy_body`.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return cls(heavy_body(hess, share), hess)

    def to_reduced(self, states: Array) -> Array:
        """(M, γ) → (w, n), dropping the component M3' off the manifold."""
        M1, M2, M3, g1, g2, g3 = np.moveaxis(np.asarray(states, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([a * M2, a * (c * M1 - s * M3), -g2, s * g3 - c * g1, s * g1 + c * g3], axis=-1)

    def from_reduced(self, reduced: Array) -> Array:
        """The inverse of `to_reduced`, on the Hess manifold."""
        w1, w2, n1, n2, n3 = np.moveaxis(np.asarray(reduced, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([c * w2 / a, w1 / a, -s * w2 / a, s * n3 - c * n2, -n1, c * n3 + s * n2], axis=-1)

    def to_suslov(self, states: Array) -> Array:
        """(M, γ) → (ω1, ω2, γ1, γ2, γ3) of the Suslov problem; shape (..., 5)."""
        return self.hess.from_reduced(self.to_reduced(states))

    def from_suslov(self, states: Array) -> Array:
        """The inverse of `to_suslov`."""
        return self.from_reduced(self.hess.to_reduced(states))

    def distance(self, states: Array, reduced: Array) -> Array:
        """The distance (n,) of states (M, γ) (n, 6) from reduced states (n, 5) with b = 1.

        The largest difference of any component of (w, n), or |a1' M3'|, in units b = 1.
        """
        difference = self.hess.in_units_of_b(self.to_reduced(states)) - reduced
        s, c = _tilt(self.heavy)
        off = self.heavy.a[1] * (s * states[:, 0] + c * states[:, 2]) / self.hess.frequency_unit
        return np.asarray(np.maximum(np.max(np.abs(difference), axis=1), np.abs(off)), float)

    def in_units_of_b(self, H: float, F1: float) -> tuple[float, float]:
        """Energy and area integral of Euler–Poisson → (h, f) in units b = 1.  Raises `NoField`."""
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return a * H / (nu * nu), 0.0 - math.copysign(a, self.hess.b) * F1 / nu

    def from_units_of_b(self, h: float, f: float) -> tuple[float, float]:
        """The inverse of `in_units_of_b`: H = E and F1 = −F2 of the Suslov body."""
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return nu * nu * h / a, 0.0 - math.copysign(nu, self.hess.b) * f / a


def largest_area_integral(weight: float, I2: float, h: float) -> float:
    """The largest |(M, γ)| on the Hess manifold at the energy h of a body with μ|r| = weight."""
    return f_max(h / abs(weight)) * math.sqrt(abs(weight) * I2)


def largest_distance(h: float) -> float:
    """No two motions of the energy h, units b = 1, are further apart, as `Bridge.distance` measures it."""
    return 4.0 * math.sqrt(2.0 * (h + 1.0)) + 4.0
