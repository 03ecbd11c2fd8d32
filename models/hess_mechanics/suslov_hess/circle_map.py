"""The circle map Θ(φ) of the Suslov–Hess torus (figure 7) as one matrix of SU(1,1).

Section n3 = n3^(1) (the lower turning point), w = |w|(sin φ, cos φ), units b = 1.  The equation of φ on the torus
(`eq0003`) is a Riccati equation in e^{iφ}; with (w, n) a solution of the reduced equations (`eq01`) at a = 0 and
W = w2 + i w1 it becomes the linear system

    A' = −(ia/2)·conj(W B),   B' = −(ia/2)·conj(W A),   A(0) = 1, B(0) = 0,

which is regular also where h + n3 → 0.  From the lower to the upper turning point it gives U = (A, B)·e^{iχ/2}, χ the
angle through which W turns; time reversal with φ → −φ gives the way back, so that the whole map
z → (αz+β)/(β̄z+ᾱ), z = e^{iφ}, is

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
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.results import Array, Cost, facts_of, frozen
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import turning_points
from hess_mechanics.suslov_hess.bifurcation_kernels import largest_f
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


def matrices(h: Array, f: Array, a: float, level: Accuracy) -> Array:
    """(Re α, Im α, Im β, L, ζ, steps), see `monodromy`, for each torus (h[i], f[i]); shape (n, 6).

    All (h[i], f[i]) must be possible, |f| ≤ f_max(h).  Raises `WorkLimit`.
    """
    level = as_level(level)
    out = np.empty((h.size, 6))
    matrices_into(h, f, float(a), level.order, level.tolerance, _MAX_STEPS, out)
    if np.any(out[:, 5] < 0):
        raise WorkLimit("These tori need too many steps: choose smaller a, or (h, f) farther from (1, 0).")
    return out


def discriminants(rows: Array) -> Array:
    """(Re α)² − |det| = (Im β)² − (Im α)², times e^{−2L}, from the rows of `matrices`; positive where the map locks.

    The first form is used where Im α and Im β are large and nearly equal, and would cancel.
    """
    re, im, im_beta, log_scale, *_ = np.moveaxis(rows, -1, 0)
    unit = np.exp(-log_scale)
    cancels = im**2 + im_beta**2 > 1e4 * (re**2 + unit**2)
    found: Array = np.where(cancels, (re - unit) * (re + unit), (im_beta - im) * (im_beta + im))
    return found


def rotation_numbers_of(rows: Array) -> Array:
    """ρ from the rows of `matrices`: an integer where the map locks, otherwise k + arccos(±Re α)/π; shape (n,)."""
    re, _, _, _, zeta, _ = rows.T
    discriminant = discriminants(rows)
    k = np.floor(zeta / np.pi)
    sign = 1.0 - 2.0 * (k % 2)
    turning = k + np.arctan2(np.sqrt(np.maximum(-discriminant, 0.0)), sign * re) / np.pi
    rho: Array = np.where(discriminant < 0.0, turning, np.round(zeta / np.pi)) + 0.0  # no −0.0
    return rho


_EVEN = np.linspace(-math.pi, math.pi, 193)


@dataclass(frozen=True)
class FixedPoint:
    """A fixed point of Θ, that is, a limit cycle.  The multiplier itself may exceed double range."""

    phi: float
    log_multiplier: float

    @property
    def stable(self) -> bool:
        """Whether the limit cycle attracts."""
        return self.log_multiplier < 0.0

    @property
    def multiplier(self) -> float:
        """dΘ/dφ at the fixed point; ∞ where it exceeds double range."""
        return math.exp(self.log_multiplier) if self.log_multiplier < 709.0 else math.inf


@dataclass(frozen=True)
class CircleMap(Result):
    """Θ for one torus (a, h, f), units b = 1, angles in radians.

    matrix : (Re α, Im α, Im β), each times e^{−log_scale}.
    kind : "elliptic" (no cycle; conjugate to a rotation), "parabolic", "hyperbolic" (two cycles).
    trace, log_trace : |2 Re α| and its logarithm (the trace is ∞ beyond double range).
    rotation_number : lifted, turns per return; fixed_points : stable first.
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
        """Θ(φ) in (−π, π]; same shape as φ."""
        return _theta(self.matrix, np.asarray(phi, float))

    def iterate(self, phi: float, count: int) -> Array:
        """φ, Θ(φ), …, Θ^count(φ); shape (count + 1,)."""
        orbit = np.empty(count + 1)
        orbit[0] = math.remainder(phi, 2 * math.pi)
        for i in range(count):
            theta_of(*self.matrix, orbit[i : i + 1], orbit[i + 1 : i + 2])
        return frozen(orbit)

    def labels(self) -> Labels:
        """Θ over φ, continued without jumps."""
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
        """α and β of the map; at most e^700 times `matrix`, where they are beyond double range."""
        re, im, beta = (value * math.exp(min(self.log_scale, 700.0)) for value in self.matrix)
        return complex(re, im), complex(0.0, beta)

    @cached_property
    def graph(self) -> tuple[Array, Array]:
        """φ (n,) from −π to π and Θ (n,), continued without jumps, close together on the curve also where it is steep.

        The reversor gives the inverse, Θ⁻¹(ψ) = −Θ(−ψ): values at even φ and at even Θ are joined.
        """
        phi = np.unique(np.concatenate([_EVEN, -self.theta(-_EVEN)]))
        return frozen(phi), frozen(np.unwrap(self.theta(phi)))


def _theta(matrix: tuple[float, float, float], phi: Array) -> Array:
    out = np.empty(phi.size)
    theta_of(*matrix, phi.ravel(), out)
    return out.reshape(phi.shape)


def check_a(a: float) -> None:
    """Raise `InvalidParameter` unless a is finite and |a| ≤ `MAX_A`."""
    require_finite(a=a)
    if abs(a) > MAX_A:
        raise InvalidParameter(f"a = {a:g} is too large: choose |a| ≤ {MAX_A:g}.")


_PROBES = np.linspace(-math.pi, math.pi, 32, endpoint=False)


def _difference(m: Array, n: Array) -> float:
    """The difference of two computed maps, rows of `matrices`: in Θ over 32 phases, and in the trace."""
    turned = _theta((m[0], m[1], m[2]), _PROBES) - _theta((n[0], n[1], n[2]), _PROBES)
    angle = float(np.max(np.abs(np.angle(np.exp(1j * turned)))))
    other = m[0] - n[0] * math.exp(n[3] - m[3])
    return max(angle, 2 * abs(float(other)) * _weight(m))


def _weight(m: Array) -> float:
    """The factor from an error of Re α e^{−L} to one of the trace, relative where the trace exceeds 1."""
    scale = math.exp(min(m[3], 700.0))
    return scale / max(1.0, 2 * abs(float(m[0])) * scale)


def _rounding(m: Array) -> float:
    """The round-off of the trace where its large parts cancel, as below the separatrix for large a."""
    return 2 * 8e-16 * (math.hypot(m[0], m[1]) + abs(float(m[2]))) * _weight(m) if m[0] else 0.0


def neighbours(h: Array, f: Array, edge: Array) -> tuple[Array, Array]:
    """Return tori (h, f), each (n,), moved by three units in the last place, as `measured.nearby` moves states.

    f moves into the region, which ends at the `edge` f_max(h) (n,); h moves into it near that edge, otherwise away from
    the separatrix.
    """
    upwards = (h >= 1.0) | (np.abs(f) > 0.5 * edge)
    moved = h + np.where(upwards, 3.0, -3.0) * np.spacing(np.abs(h))
    return np.where(h > -1.0 + 1e-9, moved, h), f * (1.0 - 3.0 * 2.0**-53)


def circle_map(a: float, h: float, f: float, level: Accuracy) -> CircleMap:
    """The circle map of the torus (h, f) at this a.

    The error estimate is the difference, in Θ and in the trace (relative where that exceeds 1), from a second run with
    a hundredth of the tolerance, of one of its `neighbours`: see `numerics.measured`.
    Raises `OutsideRegion`, `Separatrix`, `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import circle_map, level
    >>> found = circle_map(a=0.0, h=1.5, f=0.6, level=level("precise"))  # without coupling nothing locks
    >>> found.kind, len(found.fixed_points)
    ('elliptic', 0)
    """
    level = as_level(level)
    try:
        a, h, f = float(a), float(h), float(f) + 0.0  # f = −0.0 is f = 0
    except (TypeError, ValueError):
        require_finite(a=a, h=h, f=f)
        raise
    check_a(a)
    turning = turning_points(h, f)
    here = np.array([h]), np.array([f])
    tori = here, neighbours(*here, np.array([largest_f(h)]))

    def run(at: Level, _: int) -> tuple[Array, int]:
        energies, fs = tori[at.aside]
        row: Array = matrices(energies, fs, a, at)[0]
        return row, int(row[5])

    found = measured(level, run, lambda one, other: _difference(one, other) + _rounding(one))
    coarse, error = found.result, found.error
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
        found.status,
        error,
        found.cost,
    )
