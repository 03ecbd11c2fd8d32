"""Isomorphism of the Hess manifold of the Euler–Poisson equations with the Suslov–Hess case.

On r1 M1 + r3 M3 = 0 (`g2p6f1`) the Euler–Poisson equations of a body with the Hess condition (`gess-*1`) are closed.
In the axes e2, e3' = r/|r|, e1' = e2 × e3' (`m15.9`, `m15.14`) the matrix A has a1' = a2 twice on its diagonal and b'
off it, M3' = 0 (`m15.10`), and with m = μ|r|

    w = (a1' M2', a1' M1'),  n = (−γ2', −γ1', γ3'),  a = b'/a1',  b = a1' m

transform the equations on the manifold (`gess05`) to the reduced Suslov–Hess equations (`eq01`) without rescaling time;
the map of the axes is a reflection.  (The paper prints other factors of n and b.)  For the Suslov body with
I11 = 1/a1' energy and area integral are the same numbers: E = H, F2 = −F1.  `Bridge` is this isomorphism for one pair
of bodies.
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

__all__ = ["Bridge", "largest_area_integral", "largest_distance", "share_of"]


def _tilt(body: HeavyBody) -> tuple[float, float]:
    """Return (sin, cos) of the angle from Ox3 to r, in the (r1, r3)-plane.  Raises `InvalidParameter`, `NoField`."""
    if not body.is_hess:
        raise InvalidParameter(
            "This body is not in the Hess case: choose I2 between I1 and I3, r2 = 0 and r1² (a3 − a2) = r3² (a2 − a1)."
        )
    length = math.hypot(*body.r)
    if length == 0.0:
        raise NoField("r = 0: the centre of mass is the fixed point and defines no axis. Choose a nonzero r.")
    return body.r[0] / length, body.r[2] / length


def share_of(body: HeavyBody) -> float:
    """Return the share with which `Bridge.of_suslov` restores the moments of a heavy body in the Hess case.

    It restores them only for a share in (0, 1].  A share above 1 belongs to a body that is not rigid, a share of 0 to
    one with I2 ≥ I1, I3.  If r1 r3 < 0 the moments I1 and I3 are exchanged.

    Parameters
    ----------
    body : HeavyBody
        Body in the Hess case.

    Returns
    -------
    float
        The share, ≥ 0.

    Raises
    ------
    InvalidParameter
        If the body is not in the Hess case.
    NoField
        If r = 0.
    """
    squared = Bridge.of_heavy(body).hess.a ** 2
    return (1.0 - min(body.a) / body.a[1]) / (0.5 * (1.0 - squared if squared < 1.0 else 1.0))


@dataclass(frozen=True)
class Bridge:
    """Isomorphism between the motions of a heavy body in the Hess case and those of a Suslov body.

    Use `of_heavy` or `of_suslov` to construct it.  Time is the same for both bodies.

    Attributes
    ----------
    heavy : HeavyBody
        Body of the Euler–Poisson equations, with states (M, γ) of shape (..., 6).
    hess : HessBody
        Body of the Suslov–Hess case, with reduced states (w, n) of shape (..., 5).

    References
    ----------
    `m15.9`, `m15.14`, `gess05`.

    Examples
    --------
    >>> from hess_mechanics import Bridge, HeavyBody
    >>> bridge = Bridge.of_heavy(HeavyBody.hess((1.0, 1.5, 2.0), 3.0))
    >>> round(bridge.hess.a, 6), round(bridge.heavy.hess_a, 6)
    (0.353553, 0.353553)
    """

    heavy: HeavyBody
    hess: HessBody

    @classmethod
    def of_heavy(cls, heavy: HeavyBody) -> Bridge:
        """Return the pair for a heavy body.

        Parameters
        ----------
        heavy : HeavyBody
            Body in the Hess case, r nonzero.

        Returns
        -------
        Bridge
            The pair of bodies: I11 = 1/a1', and a = b'/a1' has the sign of r1 r3 (a1 − a3).

        Raises
        ------
        InvalidParameter
            If the body is not in the Hess case.
        NoField
            If r = 0.
        """
        s, c = _tilt(heavy)
        a = s * c * (heavy.a[0] - heavy.a[2]) / heavy.a[1] + 0.0  # Avoid −0.0.
        I22 = 1.0 / (heavy.a[1] * (1.0 + a * a))
        b = heavy.a[1] * heavy.mu * math.hypot(*heavy.r)
        return cls(heavy, HessBody(I22, a * I22, -b * I22 * math.hypot(1.0, a)))

    @classmethod
    def of_suslov(cls, hess: HessBody, share: float = 0.5) -> Bridge:
        """Return the pair for a Suslov body.

        Parameters
        ----------
        hess : HessBody
            Body of the Suslov–Hess case.
        share : float, default 0.5
            Choice of the free moment of the heavy body, 0 < share ≤ 1, see Notes; a rigid body if |a| < 1.

        Returns
        -------
        Bridge
            The pair of bodies.

        Raises
        ------
        InvalidParameter
            If share is not in (0, 1], or the moments are too different.
        NotPositiveDefinite
            If a moment of the heavy body is not positive.

        Notes
        -----
        The heavy body has a1' = 1/I11, r1, r3 ≥ 0, |r| = 1, μ = b/a1', and a1 > a3 for a > 0.  One of its moments is
        free, as I33 is in the Suslov problem: with a1 = a2 (1 − x), a3 = a2 (1 + a²/x), or a1 and a3 exchanged, it is
        a rigid body for 0 < x ≤ (1 − a²)/2; x is `share` times that bound, or times ½ if |a| ≥ 1.
        """
        require_finite(share=share)
        if not 0.0 < share <= 1.0:
            raise InvalidParameter(f"share = {share:g}: choose 0 < share ≤ 1, such as 0.5 for the middle.")
        squared = hess.a * hess.a
        x = share * 0.5 * (1.0 - squared if squared < 1.0 else 1.0)
        moments = hess.I11 / (1.0 - x), hess.I11, hess.I11 / (1.0 + squared / x)
        return cls(HeavyBody.hess(moments if hess.a <= 0.0 else moments[::-1], hess.b * hess.I11), hess)

    def to_reduced(self, states: Array) -> Array:
        """Return the reduced states of states of the heavy body.

        Parameters
        ----------
        states : array_like of float, shape (..., 6)
            States (M, γ); the component M3' normal to the manifold is dropped.

        Returns
        -------
        ndarray of float, shape (..., 5)
            States (w, n).
        """
        M1, M2, M3, g1, g2, g3 = np.moveaxis(np.asarray(states, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([a * M2, a * (c * M1 - s * M3), -g2, s * g3 - c * g1, s * g1 + c * g3], axis=-1)

    def from_reduced(self, reduced: Array) -> Array:
        """Return the states of the heavy body on the Hess manifold; the inverse of `to_reduced`.

        Parameters
        ----------
        reduced : array_like of float, shape (..., 5)
            States (w, n).

        Returns
        -------
        ndarray of float, shape (..., 6)
            States (M, γ).
        """
        w1, w2, n1, n2, n3 = np.moveaxis(np.asarray(reduced, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([c * w2 / a, w1 / a, -s * w2 / a, s * n3 - c * n2, -n1, c * n3 + s * n2], axis=-1)

    def from_suslov(self, states: Array) -> Array:
        """Return the states of the heavy body on the Hess manifold.

        Parameters
        ----------
        states : array_like of float, shape (..., 5)
            States (ω1, ω2, γ1, γ2, γ3) of the Suslov problem.

        Returns
        -------
        ndarray of float, shape (..., 6)
            States (M, γ).
        """
        return self.from_reduced(self.hess.to_reduced(states))

    def distance(self, states: Array, reduced: Array) -> Array:
        """Return the distance between states of the heavy body and reduced states with b = 1.

        Parameters
        ----------
        states : ndarray of float, shape (n, 6)
            States (M, γ).
        reduced : ndarray of float, shape (n, 5)
            States (w, n) in units b = 1.

        Returns
        -------
        ndarray of float, shape (n,)
            Largest difference of any component of (w, n), or |a1' M3'| if that is larger, in units b = 1.

        Raises
        ------
        NoField
            If b = 0.
        """
        difference = self.hess.in_units_of_b(self.to_reduced(states)) - reduced
        s, c = _tilt(self.heavy)
        off = self.heavy.a[1] * (s * states[:, 0] + c * states[:, 2]) / self.hess.frequency_unit
        return np.asarray(np.maximum(np.max(np.abs(difference), axis=1), np.abs(off)), float)

    def in_units_of_b(self, H: float, F1: float) -> tuple[float, float]:
        """Return (h, f) in units b = 1 for the integrals of the heavy body.

        Parameters
        ----------
        H : float
            Energy of the heavy body, in units I/T².
        F1 : float
            Area integral (M, γ), in units I/T.

        Returns
        -------
        h : float
            The energy, in units b = 1.
        f : float
            The area integral, in units b = 1.

        Raises
        ------
        NoField
            If b = 0.
        """
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return a * H / (nu * nu), 0.0 - math.copysign(a, self.hess.b) * F1 / nu

    def from_units_of_b(self, h: float, f: float) -> tuple[float, float]:
        """Return the integrals of the heavy body for (h, f); the inverse of `in_units_of_b`.

        Parameters
        ----------
        h : float
            The energy, in units b = 1.
        f : float
            The area integral, in units b = 1.

        Returns
        -------
        H : float
            Energy of the heavy body, in units I/T², equal to E of the Suslov body.
        F1 : float
            Area integral (M, γ), in units I/T, equal to −F2 of the Suslov body.

        Raises
        ------
        NoField
            If b = 0.
        """
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return nu * nu * h / a, 0.0 - math.copysign(nu, self.hess.b) * f / a


def largest_area_integral(weight: float, I2: float, h: float) -> float:
    """Return the largest |(M, γ)| on the Hess manifold at one energy.

    Parameters
    ----------
    weight : float
        The product μ|r|, nonzero, in units I/T².
    I2 : float
        Middle moment of inertia, positive, in units I.
    h : float
        Energy H, above −|weight|, in units I/T².

    Returns
    -------
    float
        The largest |(M, γ)|, in units I/T.

    Raises
    ------
    OutsideRegion
        If h ≤ −|weight|.
    """
    return f_max(h / abs(weight)) * math.sqrt(abs(weight) * I2)


def largest_distance(h: float) -> float:
    """Return an upper bound on `Bridge.distance` between two motions of one energy.

    Parameters
    ----------
    h : float
        Energy, h > −1, in units b = 1.

    Returns
    -------
    float
        The bound, in units b = 1.
    """
    return 4.0 * math.sqrt(2.0 * (h + 1.0)) + 4.0
