"""Circle map Θ(φ) of a Suslov–Hess torus (figure 7), as one matrix of SU(1,1).

Section n3 = n3^(1) (the lower turning point), w = |w|(sin φ, cos φ), units b = 1.  The equation of φ on the torus
(`eq0003`) is a Riccati equation in e^{iφ}.  With a solution (w, n) of the reduced equations (`eq01`) at a = 0 and
W = w2 + i w1 it becomes the linear system

    A' = −(ia/2)·conj(W B),   B' = −(ia/2)·conj(W A),   A(0) = 1, B(0) = 0,

which is regular also where h + n3 → 0.  Integration from the lower to the upper turning point gives
U = (A, B)·e^{iχ/2}, where χ is the angle through which W turns.  Time reversal with φ → −φ gives the second half, and
the complete map is z → (αz+β)/(β̄z+ᾱ) with z = e^{iφ} and

    α = A² − conj(B)²,   β = 2i Im(AB).

β is imaginary, so the fixed points are ±φ*, cos φ* = −Im α/Im β.  Not in the paper: see models/README.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level, as_number
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.results import Array, Cost, as_read_only, facts_of
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import f_max_of_energies, turning_points
from hess_mechanics.suslov_hess.circle_map_kernels import matrices_into, theta_of

__all__ = [
    "CircleMap",
    "FixedPoint",
    "circle_map",
    "discriminants",
    "matrices",
    "neighbours",
    "rotation_numbers_of",
]

MAX_A = 1e6
_MAX_STEPS = 200_000


def matrices(a: Array | float, h: Array, f: Array, accuracy: Accuracy) -> Array:
    """Return the matrices of the circle maps of tori, as rows (Re α, Im α, Im β, L, ζ, steps).

    α and β are the coefficients of the map z → (αz + β)/(β̄z + ᾱ), z = e^{iφ}, with |α|² − |β|² = 1.  The first three
    numbers are multiplied by e^{−L}; ζ is the lift of arg α, in radians, and `steps` the number of Taylor steps.  For
    f = 0, h < 1, where w vanishes, they are those of the limit f → 0+.

    Parameters
    ----------
    a : float or ndarray, shape (n,)
        Inertia parameter a = I23/I22.
    h : ndarray, shape (n,)
        Energy of each torus, in units b = 1.
    f : ndarray, shape (n,)
        Area integral of each torus, |f| ≤ f_max(h), in units b = 1.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    ndarray, shape (n, 6)
        A row for each torus.

    Raises
    ------
    WorkLimit
        If a torus needs too many steps.
    """
    level = as_level(accuracy)
    out = np.empty((h.size, 6))
    if not matrices_into(np.full(h.size, a, float), h, f, level.order, level.tolerance, _MAX_STEPS, out):
        raise WorkLimit("These tori need too many steps: choose a smaller |a|, or (h, f) farther from (1, 0).")
    return out


def discriminants(rows: Array) -> Array:
    """Return ((Re α)² − 1) e^{−2L} of circle maps: positive where the map locks, 0 where it is parabolic.

    It equals ((Im β)² − (Im α)²) e^{−2L}.  The first form is used where Im α and Im β are large and nearly equal,
    because their difference loses digits there.

    Parameters
    ----------
    rows : ndarray, shape (..., 6)
        Rows of `matrices`; the last two columns are not used and may be missing.

    Returns
    -------
    ndarray, shape (...,)
        Discriminants.
    """
    re, im, im_beta, log_scale, *_ = np.moveaxis(rows, -1, 0)
    unit = np.exp(-log_scale)
    cancels = im**2 + im_beta**2 > 1e4 * (re**2 + unit**2)
    values: Array = np.where(cancels, (re - unit) * (re + unit), (im_beta - im) * (im_beta + im))
    return values


def rotation_numbers_of(rows: Array) -> Array:
    """Return the rotation numbers of circle maps.

    Parameters
    ----------
    rows : ndarray, shape (n, 6)
        Rows of `matrices`.

    Returns
    -------
    ndarray, shape (n,)
        Rotation numbers ρ in turns per return: an integer where the map locks or is parabolic, otherwise
        k + arccos((−1)^k Re α)/π, k = ⌊ζ/π⌋.
    """
    re, _, _, _, zeta, _ = rows.T
    discriminant = discriminants(rows)
    k = np.floor(zeta / np.pi)
    sign = 1.0 - 2.0 * (k % 2)
    turning = k + np.arctan2(np.sqrt(np.maximum(-discriminant, 0.0)), sign * re) / np.pi
    rho: Array = np.where(discriminant < 0.0, turning, np.round(zeta / np.pi)) + 0.0  # Avoid −0.0.
    return rho


_EVEN = np.linspace(-math.pi, math.pi, 193)


@dataclass(frozen=True)
class FixedPoint:
    """Fixed point of a circle map, that is, a limit cycle of the flow on the torus.

    Attributes
    ----------
    phi : float
        The angle φ of the fixed point, in radians, −π to π.
    log_multiplier : float
        Natural logarithm of the multiplier, which itself may exceed the range of doubles: negative for a stable cycle,
        positive for an unstable one, 0 for that of a parabolic map.
    """

    phi: float
    log_multiplier: float

    @property
    def stable(self) -> bool:
        """True if the limit cycle attracts; False if it repels or the map is parabolic."""
        return self.log_multiplier < 0.0

    @property
    def multiplier(self) -> float:
        """The multiplier dΘ/dφ at the fixed point, ≥ 0; ∞ beyond the range of doubles."""
        return math.exp(self.log_multiplier) if self.log_multiplier < 709.0 else math.inf


@dataclass(frozen=True)
class CircleMap(Result):
    """Circle map Θ of one torus (a, h, f), in units b = 1; the result of `circle_map`.

    Attributes
    ----------
    a : float
        Inertia parameter, a = I23/I22, |a| ≤ 1e6.
    h : float
        Energy, h > −1.
    f : float
        Area integral, |f| ≤ f_max(h).
    level : str
        Name of the accuracy level.
    matrix : tuple of three floats
        (Re α, Im α, Im β), each times e^{−log_scale}.
    log_scale : float
        Natural logarithm of the common factor of `matrix`, ≥ 0.
    kind : str
        "elliptic" (no limit cycle; conjugate to a rotation), "parabolic" (|2 Re α| = 2 to within the error) or
        "hyperbolic" (two limit cycles).
    trace : float
        |2 Re α|, ≥ 0; ∞ beyond the range of doubles.
    log_trace : float
        Natural logarithm of `trace`, any number; −∞ if the trace is 0.
    rotation_number : float
        Rotation number ρ of the lifted map, in turns per return.
    fixed_points : tuple of FixedPoint
        The stable fixed point, then the unstable one; one for a parabolic map, none for elliptic ones and the identity.
    period : float
        Period of n3, that is, the time between two returns, in units 1/√b.
    status : Status
        State of the computation, see `Status`.
    error_estimate : float
        Estimated error of Θ in radians and of the trace (relative if the trace exceeds 1).
    cost : Cost
        Steps and time of the computation.
    """

    a: float
    h: float
    f: float
    level: str
    matrix: tuple[float, float, float]
    log_scale: float
    kind: str
    trace: float
    log_trace: float
    rotation_number: float
    fixed_points: tuple[FixedPoint, ...]
    period: float
    status: Status
    error_estimate: float
    cost: Cost

    def theta(self, phi: Array | Sequence[float]) -> Array:
        """Return the angles Θ(φ) after one return.

        Parameters
        ----------
        phi : array_like of float
            Angles φ in radians.

        Returns
        -------
        ndarray of float, same shape as phi
            Angles in (−π, π].

        Examples
        --------
        >>> from hess_mechanics import circle_map
        >>> result = circle_map(a=0.5, h=1.5, f=0.6, accuracy="standard")
        >>> result.theta([0.0, 1.0]).round(4)
        array([-1.8468, -1.7131])
        """
        return _theta(self.matrix, np.asarray(phi, float))

    def iterate(self, phi: float, count: int) -> Array:
        """Return the orbit φ, Θ(φ), …, Θ^count(φ).

        Parameters
        ----------
        phi : float
            First angle in radians.
        count : int
            Number of iterations, ≥ 0.

        Returns
        -------
        ndarray of float, shape (count + 1,)
            Angles in [−π, π].

        Examples
        --------
        >>> from hess_mechanics import circle_map
        >>> circle_map(a=0.5, h=1.5, f=0.6, accuracy="standard").iterate(0.0, 3).round(4)
        array([ 0.    , -1.8468, -1.9509, -1.9569])
        """
        orbit = np.empty(count + 1)
        orbit[0] = math.remainder(phi, 2 * math.pi)
        for i in range(count):
            orbit[i + 1 : i + 2] = self.theta(orbit[i : i + 1])
        return as_read_only(orbit)

    def labels(self) -> Labels:
        """Return the graph of Θ with names, units and coordinates.

        Returns
        -------
        Labels
            Θ over φ, continued without jumps.
        """
        phi, theta = self.graph
        return Labels(
            {"φ": (("φ",), phi)},
            {"Θ": (("φ",), theta)},
            {"φ": "rad", "Θ": "rad"},
            {
                "a": self.a,
                "h": self.h,
                "f": self.f,
                "kind": self.kind,
                "trace": self.trace,
                "rotation number": self.rotation_number,
                "period": self.period,
                **facts_of(self),
            },
        )

    @property
    def alpha_beta(self) -> tuple[complex, complex]:
        """The coefficients α and β; both times e^{700 − L} if L = `log_scale` > 700, to remain doubles."""
        re, im, beta = (value * math.exp(min(self.log_scale, 700.0)) for value in self.matrix)
        return complex(re, im), complex(0.0, beta)

    @cached_property
    def graph(self) -> tuple[Array, Array]:
        """Angles φ (n,) from −π to π and values Θ (n,), continued without jumps, dense on steep parts of the curve.

        The points are evenly spaced values of φ and the preimages of evenly spaced values of Θ.  The reversor gives the
        inverse, Θ⁻¹(ψ) = −Θ(−ψ).
        """
        phi = np.unique(np.concatenate([_EVEN, -self.theta(-_EVEN)]))
        return as_read_only(phi), as_read_only(np.unwrap(self.theta(phi)))


def _theta(matrix: tuple[float, float, float], phi: Array) -> Array:
    out, flat = np.empty(phi.size), phi.ravel()
    theta_of(*matrix, flat, np.cos(flat), np.sin(flat), out)
    return out.reshape(phi.shape)


def check_a(a: float) -> None:
    """Raise an error unless a is finite and |a| ≤ `MAX_A`.

    Parameters
    ----------
    a : float
        Inertia parameter a.

    Raises
    ------
    InvalidParameter
        If a is not finite or too large.
    """
    require_finite(a=a)
    if abs(a) > MAX_A:
        raise InvalidParameter(f"a = {a:g} is too large: choose |a| ≤ {MAX_A:g}.")


_PROBES = np.linspace(-math.pi, math.pi, 32, endpoint=False)


def _difference(m: Array, n: Array) -> float:
    """Return the difference of two maps, rows of `matrices`: the larger of those in Θ (32 phases) and the trace."""
    angles = _theta((m[0], m[1], m[2]), _PROBES) - _theta((n[0], n[1], n[2]), _PROBES)
    angle = float(np.max(np.abs(np.angle(np.exp(1j * angles)))))
    other = m[0] - n[0] * math.exp(n[3] - m[3])
    return max(angle, 2 * abs(float(other)) * _weight(m))


def _weight(m: Array) -> float:
    """Return the factor from an error of Re α e^{−L} to an error of the trace, relative if the trace exceeds 1."""
    scale = math.exp(min(m[3], 700.0))
    return scale / max(1.0, 2 * abs(float(m[0])) * scale)


def _rounding(m: Array) -> float:
    """Return the round-off of the trace from the cancellation of large terms, as below the separatrix for large a."""
    return 2 * 8e-16 * (math.hypot(m[0], m[1]) + abs(float(m[2]))) * _weight(m) if m[0] else 0.0


def neighbours(h: Array, f: Array, edge: Array) -> tuple[Array, Array]:
    """Return tori moved by three units in the last place, as `measured.perturb` moves states.

    f moves into the region, which ends at f_max(h).  h moves into the region near that edge, otherwise away from the
    separatrix; it stays if h ≤ −1 + 1e-9.

    Parameters
    ----------
    h : ndarray, shape (n,)
        Energies, in units b = 1.
    f : ndarray, shape (n,)
        Area integrals, in units b = 1.
    edge : ndarray, shape (n,)
        Values of f_max(h).

    Returns
    -------
    h : ndarray, shape (n,)
        The moved energies.
    f : ndarray, shape (n,)
        The moved area integrals.
    """
    upwards = (h >= 1.0) | (np.abs(f) > 0.5 * edge)
    moved = h + np.where(upwards, 3.0, -3.0) * np.spacing(np.abs(h))
    return np.where(h > -1.0 + 1e-9, moved, h), f * (1.0 - 3.0 * 2.0**-53)


def circle_map(a: float, h: float, f: float, accuracy: Accuracy) -> CircleMap:
    """Return the circle map of the torus (h, f).

    Parameters
    ----------
    a : float
        Inertia parameter a = I23/I22, |a| ≤ 1e6.
    h : float
        Energy, −1 < h ≤ 1e12, in units b = 1.
    f : float
        The area integral, |f| ≤ f_max(h), in units b = 1; f = 0 is the limit f → 0+.
    accuracy : str or Level
        Accuracy level or its name, see `level`.

    Returns
    -------
    CircleMap
        The map with its trace, rotation number and fixed points.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    InvalidParameter
        If a parameter is not finite, or |a| or h is too large.
    WorkLimit
        If the torus needs too many steps.

    Notes
    -----
    The error estimate compares the map with that of the torus moved by `neighbours`, at a hundredth of the tolerance,
    see `numerics.measured`.

    References
    ----------
    `eq0003`, figure 7.  The form as a Möbius map is not in the paper, see models/README.md.

    Examples
    --------
    >>> from hess_mechanics import circle_map, level
    >>> result = circle_map(a=0.0, h=1.5, f=0.6, accuracy=level("precise"))  # for a = 0 the map does not lock
    >>> result.kind, len(result.fixed_points)
    ('elliptic', 0)
    """
    level = as_level(accuracy)
    a, h, f = as_number("a", a), as_number("h", h), as_number("f", f) + 0.0  # Treat f = −0.0 as 0.
    check_a(a)
    turning = turning_points(h, f)
    here = np.array([h]), np.array([f])
    tori = here, neighbours(*here, f_max_of_energies(np.array([h])))

    def run(at: Level, _: int) -> tuple[Array, int]:
        energies, fs = tori[at.is_perturbed]
        row: Array = matrices(a, energies, fs, at)[0]
        return row, int(row[5])

    result = measured(level, run, lambda one, other: _difference(one, other) + _rounding(one))
    coarse, error = result.result, result.error
    re, im, im_beta, log_scale = (float(x) for x in coarse[:4])

    log_trace = math.log(2 * abs(re)) + log_scale if re else -math.inf
    trace = math.exp(log_trace) if log_trace < 709.0 else math.inf
    discriminant = float(discriminants(coarse))
    fixed: tuple[FixedPoint, ...] = ()
    if abs(trace - 2.0) <= 2 * min(error, 1e-3):
        kind = "parabolic"
        if im_beta:
            fixed = (FixedPoint(math.acos(max(-1.0, min(1.0, -im / im_beta))), 0.0),)
    elif discriminant > 0.0:
        kind = "hyperbolic"
        root = math.sqrt(discriminant)
        log_multiplier = -2.0 * (log_scale + math.log(abs(re) + root))
        # dΘ/dφ = (Re α + Im β sin φ*)^−2 at ±φ*: stable where the two terms have the same sign.
        phi = math.copysign(math.atan2(root, -im * math.copysign(1.0, im_beta)), re * im_beta)
        fixed = (FixedPoint(phi, log_multiplier), FixedPoint(-phi, -log_multiplier))
    else:
        kind = "elliptic"
    rho = float(rotation_numbers_of(coarse[None])[0])
    if kind == "parabolic":
        rho = round(rho) + 0.0
    return CircleMap(
        a,
        h,
        f,
        level.name,
        (re, im, im_beta),
        log_scale,
        kind,
        trace,
        log_trace,
        rho,
        fixed,
        turning.period,
        result.status,
        error,
        result.cost,
    )
