"""Smooth invariant measure of a Suslov–Hess torus without limit cycles, |t| < 2, and the linear flow on it.

Not in the paper.  An elliptic Θ is a Möbius map of the unit disk with one fixed point ζ inside it.  The map
z → (z − ζ)/(1 − ζ̄z) takes ζ to 0 and conjugates Θ to a rotation:

    ψ(Θ(φ)) = ψ(φ) + 2πρ,   ψ = arg((e^{iφ} − ζ)/(1 − ζ̄e^{iφ})),

and ψ'(φ)/2π is the Poisson kernel of ζ, an invariant density on the circle (`circle_map`: ζ is real there),

    p(φ; ζ) = (1 − |ζ|²)/(2π |e^{iφ} − ζ|²),   p(Θ(φ)) Θ'(φ) = p(φ).

All orbits return to n3 = n3^(1) after the same time T, so p dφ ds/T is an invariant measure of the flow, where s is the
time since the last return.  The motion of φ during the time s is a Möbius map too (`eq0003` is a Riccati equation).  It
takes ζ to some ζ_s with ζ_T = ζ: the density at s is p(φ; ζ_s), and along every orbit

    ψ(φ; ζ_s) = ψ(φ0; ζ) + δ(s),   δ(T) = 2πρ mod 2π.

So s and ψ − δ(s) + 2πρs/T are angles of the torus in which the flow is linear: quasi-periodic for irrational ρ,
periodic on every orbit for rational ρ.  If |t| > 2 every orbit tends to a limit cycle, and no invariant measure has a
density; the same holds for |t| = 2, unless Θ is the identity.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Complex, as_read_only
from hess_mechanics.parameters import plain
from hess_mechanics.suslov_hess.bifurcation import turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, discriminants
from hess_mechanics.suslov_hess.equations import SYSTEM

__all__ = ["CELLS", "InvariantMeasure", "density_on_torus", "invariant_measure", "zeta_at"]


_LEAST_GAP = 1e-150
"""Lower bound on 1 − |ζ|, which is 0 on the lock boundary."""


@dataclass(frozen=True)
class InvariantMeasure:
    """Invariant measure on the section of one torus.

    Attributes
    ----------
    zeta : float
        The fixed point ζ of the circle map inside the unit disk, real; it may round to ±1.
    gap : float
        1 − |ζ|, at least 1e-150, accurate also if ζ rounds to ±1.
    """

    zeta: float
    gap: float

    def density(self, phi: Array | Sequence[float]) -> Array:
        """Return the invariant density p(φ).

        Parameters
        ----------
        phi : array_like of float
            Angles φ, in radians.

        Returns
        -------
        ndarray
            Density per radian, of the shape of φ.
        """
        half = 0.5 * (np.asarray(phi, float) - (math.pi if self.zeta < 0.0 else 0.0))
        square = self.gap * self.gap + 4.0 * (1.0 - self.gap) * np.sin(half) ** 2
        return np.asarray(self.gap * (2.0 - self.gap) / (2.0 * math.pi * square))


def invariant_measure(theta: CircleMap) -> InvariantMeasure:
    """Return the invariant measure of an elliptic circle map.

    Parameters
    ----------
    theta : CircleMap
        The circle map.

    Returns
    -------
    InvariantMeasure
        The measure.

    Raises
    ------
    InvalidParameter
        If the map is not elliptic.
    """
    if theta.kind != "elliptic":
        raise InvalidParameter(
            f"At a = {theta.a:g}, h = {theta.h:g}, f = {theta.f:g} the circle map is not elliptic, as an invariant "
            "density requires: choose a torus with |trace| < 2."
        )
    _, im, im_beta = theta.matrix
    # β̄z² + (ᾱ − α)z − β = 0 with an imaginary β has the roots ζ and 1/ζ: take the one inside the disk.
    root = math.sqrt(max(0.0, -float(discriminants(np.array([*theta.matrix, theta.log_scale])))))
    zeta = -im_beta / (im + math.copysign(root, im))
    # 1 − ζ² = 2 root/(|im| + root).
    gap = max(_LEAST_GAP, 2.0 * root / (abs(im) + root) / (1.0 + abs(zeta)))
    return InvariantMeasure(zeta, gap)


_CUBE_ROOTS = np.exp(2j * math.pi * np.arange(3) / 3.0)
_NARROWEST = 1e-4
"""Smallest 1 − |ζ_s|: below it the density is too narrow a line to draw, or to find from orbits."""


def zeta_at(theta: CircleMap, times: Sequence[float] | Array, accuracy: Accuracy) -> Complex:
    """Return the points ζ_s that determine the invariant density of a torus at times s since a return.

    They follow from three orbits whose hyperbolic directions from ζ are 120° apart: their directions from ζ_s stay 120°
    apart, because a Möbius map conserves cross-ratios.

    Parameters
    ----------
    theta : CircleMap
        The circle map of the torus.
    times : array_like, shape (m,)
        Times s ≥ 0 in increasing order, in units b = 1.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    ndarray of complex, shape (m,)
        Points ζ_s of the unit disk.

    Raises
    ------
    InvalidParameter
        If the map is not elliptic, f = 0, the density is too narrow to draw, or the times are not in order.
    WorkLimit
        If an orbit needs too many steps.
    """
    measure = invariant_measure(theta)
    narrow = InvalidParameter("The density lies almost on one line: choose a smaller |a| or another torus.")
    if measure.gap < _NARROWEST:
        raise narrow
    jumps = InvalidParameter(
        f"f = {plain(theta.f)}: w vanishes at the lower turning point, and φ jumps there. Choose another f."
    )
    if theta.f == 0.0:
        raise jumps
    turning = turning_points(theta.h, theta.f)
    starts = np.angle((_CUBE_ROOTS + measure.zeta) / (1.0 + measure.zeta * _CUBE_ROOTS))
    orbits = [
        solve(SYSTEM.at((theta.a, 1.0)), turning.state_at_lower_turn(phi), times, accuracy) for phi in starts.tolist()
    ]
    w1, w2 = np.stack([orbit.states[:, :2] for orbit in orbits]).transpose(2, 0, 1)
    size = np.hypot(w1, w2)
    if not size.all():
        raise jumps
    z1, z2, z3 = (w2 + 1j * w1) / size
    one, two, three = _CUBE_ROOTS
    ratio = one * (two - three) / (three * (two - one)) * (z2 - z1) / (z2 - z3)
    zeta = (z1 - ratio * z3) / (1.0 - ratio)
    error = max(orbit.error_estimate for orbit in orbits)
    if np.min(1.0 - np.abs(zeta)) < max(_NARROWEST, 10.0 * error):
        raise narrow
    return as_read_only(zeta)


CELLS = (120, 120)
"""Number of cells of the torus: along σ, along φ."""


def density_on_torus(theta: CircleMap, accuracy: Accuracy, cells: tuple[int, int] = CELLS) -> Array:
    """Return the invariant density over a torus, relative to a uniform one.

    Parameters
    ----------
    theta : CircleMap
        The circle map of the torus.
    accuracy : str or Level
        Accuracy level.
    cells : (int, int), default CELLS
        Number of cells (m, n) along σ = 2πs/T, with T the period of n3, and along φ; m is rounded down to an even
        number, at least 2.

    Returns
    -------
    ndarray, shape (n, m)
        Density at the centres of the cells, σ and φ from −π to π, σ = 0 at the return; the mean is 1.

    Raises
    ------
    InvalidParameter
        As `zeta_at`.
    WorkLimit
        As `zeta_at`.
    """
    m, n = 2 * max(1, cells[0] // 2), cells[1]
    zeta = zeta_at(theta, (np.arange(m) + 0.5) / m * theta.period, accuracy)[:, None]
    z = np.exp(1j * (2.0 * np.arange(n) + 1.0 - n) * math.pi / n)
    relative = (1.0 - np.abs(zeta) ** 2) / np.abs(z - zeta) ** 2
    return as_read_only(np.roll(relative, m // 2, axis=0).T.copy())
