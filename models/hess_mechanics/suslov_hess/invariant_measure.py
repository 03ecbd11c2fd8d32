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
density; the same holds for |t| = 2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Complex, frozen
from hess_mechanics.parameters import plain
from hess_mechanics.suslov_hess.bifurcation import turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, discriminants
from hess_mechanics.suslov_hess.equations import SYSTEM

__all__ = [
    "CELLS",
    "InvariantMeasure",
    "TorusMeasure",
    "density_on_torus",
    "invariant_measure",
    "on_torus",
    "poisson_kernel",
    "seen_from",
    "wide_enough",
]


def poisson_kernel(phi: Array | Sequence[float], zeta: complex | Complex) -> Array:
    """Return p(φ; ζ), per radian, for φ (...) and |ζ| < 1 that broadcast; its integral over the circle is 1."""
    z = np.exp(1j * np.asarray(phi, float))
    density: Array = (1.0 - np.abs(zeta) ** 2) / (2.0 * math.pi * np.abs(z - zeta) ** 2)
    return density


def seen_from(phi: Array | Sequence[float], zeta: complex | Complex) -> Array:
    """Return ψ(φ; ζ) in (−π, π], the hyperbolic direction of φ from ζ, for φ (...) and |ζ| < 1 that broadcast."""
    z = np.exp(1j * np.asarray(phi, float))
    angle: Array = np.angle((z - zeta) / (1.0 - np.conj(zeta) * z))
    return angle


_LEAST_GAP = 1e-150
"""Lower bound of 1 − |ζ|, which is 0 on the lock boundary."""


@dataclass(frozen=True)
class InvariantMeasure:
    """Invariant measure on the section of one torus.

    Attributes
    ----------
    a : float
        The coupling.
    h : float
        The energy, in units b = 1.
    f : float
        The area integral, in units b = 1.
    zeta : float
        The fixed point ζ, which is real.
    gap : float
        1 − |ζ|, accurate also if ζ rounds to ±1.
    rotation_number : float
        Rotation number ρ in turns per return.
    period : float
        Return time T in units b = 1.
    """

    a: float
    h: float
    f: float
    zeta: float
    gap: float
    rotation_number: float
    period: float

    def _half(self, phi: Array | Sequence[float]) -> Array:
        """Return half the angles from ζ to φ."""
        half: Array = 0.5 * (np.asarray(phi, float) - (math.pi if self.zeta < 0.0 else 0.0))
        return half

    def density(self, phi: Array | Sequence[float]) -> Array:
        """Return p(φ), per radian; same shape as φ."""
        square = self.gap * self.gap + 4.0 * (1.0 - self.gap) * np.sin(self._half(phi)) ** 2
        return np.asarray(self.gap * (2.0 - self.gap) / (2.0 * math.pi * square))

    def angle(self, phi: Array | Sequence[float]) -> Array:
        """Return ψ(φ) in (−π, π], which grows by 2πρ with each return; same shape as φ."""
        half = self._half(phi)
        turned = 2.0 * np.arctan2((2.0 - self.gap) * np.sin(half), self.gap * np.cos(half))
        turned += math.pi if self.zeta < 0.0 else 0.0
        return np.asarray(turned - 2.0 * math.pi * np.ceil(turned / (2.0 * math.pi) - 0.5))


def invariant_measure(theta: CircleMap) -> InvariantMeasure:
    """Return the invariant measure of an elliptic circle map.  Raises `InvalidParameter` for other maps."""
    if theta.kind != "elliptic":
        raise InvalidParameter(
            f"At a = {theta.a:g}, h = {theta.h:g}, f = {theta.f:g} the circle map has limit cycles, and no invariant "
            "measure with a density: choose a torus with |trace| < 2."
        )
    _, im, im_beta = theta.matrix
    # β̄z² + (ᾱ − α)z − β = 0 with an imaginary β has the roots ζ and 1/ζ: take the one inside the disk.
    root = math.sqrt(max(0.0, -float(discriminants(np.array([*theta.matrix, theta.log_scale])))))
    zeta = -im_beta / (im + math.copysign(root, im))
    # 1 − ζ² = 2 root/(|im| + root).
    gap = max(_LEAST_GAP, 2.0 * root / (abs(im) + root) / (1.0 + abs(zeta)))
    return InvariantMeasure(theta.a, theta.h, theta.f, zeta, gap, theta.rotation_number, theta.period)


@dataclass(frozen=True)
class TorusMeasure:
    """Invariant measure on the whole torus, at given times since a return.

    Attributes
    ----------
    times : ndarray of float, shape (m,)
        Times s since a return, in units b = 1.
    zeta : ndarray of complex, shape (m,)
        ζ_s at these times.
    turned : ndarray of float, shape (m,)
        δ(s) in radians up to multiples of 2π, without jumps.
    period : float
        Return time T.
    error_estimate : float
        Estimated error of the three orbits from which ζ_s and δ(s) are computed.
    """

    times: Array
    zeta: Complex
    turned: Array
    period: float
    error_estimate: float

    def density(self, phi: Array | Sequence[float]) -> Array:
        """Return the density (m, n), per radian and unit of time, at these times and at angles φ (n,)."""
        return poisson_kernel(np.asarray(phi, float)[None, :], self.zeta[:, None]) / self.period

    def angle(self, phi: Array) -> Array:
        """Return ψ(φ; ζ_s) − δ(s) (m,) in (−π, π] for angles φ (m,) at these times; it is constant along an orbit."""
        turned: Array = np.angle(np.exp(1j * (seen_from(phi, self.zeta) - self.turned)))
        return turned


_CUBE_ROOTS = np.exp(2j * math.pi * np.arange(3) / 3.0)


def _jumps(f: float) -> InvalidParameter:
    return InvalidParameter(
        f"f = {plain(f)}: w vanishes at the lower turning point, and φ jumps there. Choose another f."
    )


def on_torus(measure: InvariantMeasure, times: Sequence[float] | Array, accuracy: Accuracy) -> TorusMeasure:
    """Return ζ_s and δ(s) at the times s ≥ 0 (m,), in units b = 1.

    They follow from three orbits whose hyperbolic directions from ζ are 120° apart: their directions from ζ_s stay 120°
    apart, because a Möbius map conserves cross-ratios.
    Raises `InvalidParameter` (f = 0, where w vanishes at the return), `WorkLimit`.
    """
    if measure.f == 0.0:
        raise _jumps(measure.f)
    turning = turning_points(measure.h, measure.f)
    starts = np.angle((_CUBE_ROOTS + measure.zeta) / (1.0 + measure.zeta * _CUBE_ROOTS))
    found = [
        solve(SYSTEM.at((measure.a, 1.0)), turning.state_at_lower_turn(phi), times, accuracy) for phi in starts.tolist()
    ]
    w1, w2 = np.stack([orbit.states[:, :2] for orbit in found]).transpose(2, 0, 1)
    size = np.hypot(w1, w2)
    if not size.all():
        raise _jumps(measure.f)
    z1, z2, z3 = (w2 + 1j * w1) / size
    one, two, three = _CUBE_ROOTS
    ratio = one * (two - three) / (three * (two - one)) * (z2 - z1) / (z2 - z3)
    zeta = (z1 - ratio * z3) / (1.0 - ratio)
    turned = np.unwrap(np.angle((z1 - zeta) / (1.0 - np.conj(zeta) * z1)))
    error = max(orbit.error_estimate for orbit in found)
    return TorusMeasure(found[0].times, frozen(zeta), frozen(turned), measure.period, error)


CELLS = (120, 120)
"""Number of cells of the torus: along σ, along φ."""
_NARROWEST = 1e-4
"""Smallest 1 − |ζ_s|: below it the density is too narrow a line to draw, or to find from orbits."""


def density_on_torus(theta: CircleMap, accuracy: Accuracy, cells: tuple[int, int] = CELLS) -> Array:
    """Return the density at the centres of the cells (m, n) of the torus, relative to a uniform one; shape (n, m).

    Rows have equal φ and columns equal σ = 2πs/T, both from −π to π; σ = 0 at the return.  The mean is 1.
    Raises `InvalidParameter` if there is no density (limit cycles), at f = 0 and if it is too narrow; `WorkLimit`.
    """
    m, n = 2 * max(1, cells[0] // 2), cells[1]
    found = wide_enough(theta, (np.arange(m) + 0.5) / m * theta.period, accuracy)
    phi = (2.0 * np.arange(n) + 1.0 - n) * math.pi / n
    relative = 2.0 * math.pi * theta.period * found.density(phi)
    return frozen(np.roll(relative, m // 2, axis=0).T.copy())


def wide_enough(theta: CircleMap, times: Array, accuracy: Accuracy) -> TorusMeasure:
    """Return the invariant measure of a torus at times s ≥ 0 (m,), if its density can be drawn.

    Raises `InvalidParameter` if there is no density (limit cycles), at f = 0 and if it is too narrow; `WorkLimit`.
    """
    measure = invariant_measure(theta)
    if measure.gap >= _NARROWEST:
        found = on_torus(measure, times, accuracy)
        width = float(np.min(1.0 - np.abs(found.zeta)))
        if width >= max(_NARROWEST, 10.0 * found.error_estimate):
            return found
    raise InvalidParameter("The density lies almost on one line: choose a smaller |a| or another torus.")
