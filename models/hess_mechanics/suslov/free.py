"""The free Suslov problem, b = 0 (`biz132`): closed-form ω(t), and γ(t) by one rotation.

ξ = (I23, −I13, 0)/J and η = (I13, I23, 0)/J, J² = I13² + I23²; ξ, η, e3 are right-handed.  Every ω that is not on
the line of equilibria ω ∥ ξ passes once from the unstable to the stable point of its ellipse E = h.  With
u = ω0 (t − t0), σ = ±1 for the two arcs (the sign of I13ω1 + I23ω2)

    ω/ω0 = (−K tanh u + σc sech u) ξ + σκ sech u η,
    w = (I22 I13² + I11 I23²)/J²,  K = I11 I22/(J w),  κ = √(I11 I22)/J,  c = κ I13 I23 (I22 − I11)/(J² w),
    ω0 = J √(2hw)/(I11 I22),

which is the paper's solution.  γ̇ = γ × ω is linear.  In the frame that has turned about ξ by
Φ(u) = −K ln cosh u + σc gd u, the rest is a matrix ((A, −B̄), (B, Ā)) of SU(2),

    A' = −(i/2) V B,  B' = −(i/2) V̄ A,  V = σκ sech u e^{iΦ},  V' = (−iK tanh u + iσc sech u − tanh u) V.

V decays on both sides of u = 0, where the integration starts, so neither starts close to the line nor long times cost
steps or digits.  This rotation is not in the paper: see models/README.md.
ω(t) is also the motion of the Chaplygin sleigh (I23 = 0), and of the same constraint on E(2) and SO(2,1).
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from hess_mechanics.dynamics.orbit import checked_times, drift_of, require_finite_states
from hess_mechanics.dynamics.sampling import MOST_SAMPLES, SAGITTA
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import measured, nearby
from hess_mechanics.numerics.results import Array, Complex, Cost, facts_of, frozen, unit_of
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov import additional_integral
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody, unit_vector
from hess_mechanics.suslov.free_kernels import integrate

__all__ = [
    "Equilibria",
    "FreeMotion",
    "FreeRotation",
    "Passage",
    "PassageConstants",
    "arcs",
    "equilibria",
    "equilibria_of_unit_rate",
    "free_motion",
    "passage",
    "propagate",
    "rotation",
    "sample_times",
    "sampled_motion",
    "shape",
    "turned_along_circle",
    "turning",
]

_MAX_STEPS = 100_000
_MAX_SHAPE = 1e4
"""Limit of K + κ + |c|: the work grows with it, and so does round-off."""


@dataclass(frozen=True)
class PassageConstants:
    """The constants of a tensor that determine every passage, see the module.

    xi, eta : (3,) unit vectors; J, w, K, kappa, c : numbers (c for the arc σ = +1).
    """

    xi: Array
    eta: Array
    J: float
    w: float
    K: float
    kappa: float
    c: float

    @property
    def size(self) -> float:
        """K + κ + |c|: how fast γ can turn, per unit of u."""
        return self.K + self.kappa + abs(self.c)

    @property
    def end(self) -> float:
        """Beyond |u| = end A and B change by less than 1e-17."""
        return 39.0 + math.log(max(1.0, self.kappa))

    def turned(self, u: Array | float, arc: int) -> Array:
        """Φ(u) = −K ln cosh u + σc gd u, the angle about ξ of the turning frame; shape of u."""
        return -self.K * _log_cosh(u) + arc * self.c * _gd(u)


def _log_cosh(u: Array | float) -> Array:
    size = np.abs(u)
    return size + np.log1p(np.exp(-2.0 * size)) - math.log(2.0)


def _gd(u: Array | float) -> Array:
    """The Gudermannian function, ∫ sech u du."""
    return 2.0 * np.arctan(np.tanh(0.5 * np.asarray(u)))


def shape(body: SuslovBody) -> PassageConstants:
    """K, κ, c and the directions ξ, η of a body without a field.

    Raises `InvalidParameter` (a field; I13 = I23 = 0), `WorkLimit` (I13, I23 too small, or I11 and I22 too different).
    """
    I11, I22, I13, I23, *b = body.parameters
    if any(b):
        raise InvalidParameter(
            "There is a field: the free motion and its scattering are of b = 0. Set b1 = b2 = b3 = 0."
        )
    J = math.hypot(I13, I23)
    if not J > 0.0:
        raise InvalidParameter(
            "With I13 = I23 = 0 and no field ω does not change: there is no line of equilibria, no ξ and no "
            "scattering. Choose I13 or I23 other than 0."
        )
    n1, n2 = I13 / J, I23 / J
    w = I22 * n1 * n1 + I11 * n2 * n2
    mean = math.sqrt(I11) * math.sqrt(I22)
    kappa, K = mean / J, mean / J * (mean / w)
    c = kappa * n1 * n2 * ((I22 - I11) / w)
    angle = K + kappa + abs(c)
    if not angle <= _MAX_SHAPE:
        about = f"about {angle:.2g}" if math.isfinite(angle) else "more than 1e308"
        raise WorkLimit(
            f"γ turns too often while ω passes from the unstable to the stable point ({about} radians; at most "
            f"{_MAX_SHAPE:g} are computed): choose larger I13, I23, or I11 and I22 less different."
        )
    return PassageConstants(frozen(np.array([n2, -n1, 0.0])), frozen(np.array([n1, n2, 0.0])), J, w, K, kappa, c)


@dataclass(frozen=True)
class Equilibria:
    """The line of equilibria I13ω1 + I23ω2 = 0 on the ellipse E = h (`biz138`, its denominator corrected).

    stable, unstable : (2,) ω^(+) = −|ω|ξ and ω^(−) = +|ω|ξ, where γ turns about ξ on the circles Γ = (ξ, γ) = const,
    the limit cycles; speed : |ω^(±)|, its angular velocity; xi : (3,); rate : ω0, at which ω leaves and arrives.
    """

    stable: Array
    unstable: Array
    xi: Array
    speed: float
    rate: float
    h: float

    def gamma(self, Gamma: float, phi: float) -> tuple[float, float, float]:
        """γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3), η = e3 × ξ."""
        x1, x2, _ = self.xi
        across = math.sqrt(max(0.0, 1.0 - Gamma * Gamma))
        return (
            float(Gamma * x1 - across * math.cos(phi) * x2),
            float(Gamma * x2 + across * math.cos(phi) * x1),
            across * math.sin(phi),
        )


def _rate(body: SuslovBody, of: PassageConstants, r: float) -> float:
    """ω0 for r = √(2h)."""
    return of.J / body.I11 * (r * math.sqrt(of.w) / body.I22)


def equilibria(body: SuslovBody, h: float) -> Equilibria:
    """The stable and the unstable point with energy h.  Raises `InvalidParameter` (h ≤ 0 too), `WorkLimit`."""
    of, r = shape(body), _radius(h)
    speed = r / math.sqrt(of.w)
    point = speed * of.xi[:2]
    return Equilibria(frozen(-point), frozen(point), of.xi, speed, _rate(body, of, r), h)


def _radius(h: float) -> float:
    """√(2h)."""
    require_finite(h=h)
    if not h > 0.0:
        raise InvalidParameter(f"E = h = {h:g}, but without a field the energy of a motion is positive: choose h > 0.")
    return math.sqrt(2.0) * math.sqrt(h)


def equilibria_of_unit_rate(body: SuslovBody) -> Equilibria:
    """Those with the energy at which ω0 = 1.  Raises `InvalidParameter`, `WorkLimit`."""
    return equilibria(body, 1.0 / equilibria(body, 1.0).rate ** 2)


def arcs(body: SuslovBody, h: float, count: int = 91) -> tuple[Array, Array]:
    """The two arcs of the ellipse E = h from the unstable to the stable point, σ = +1 first; (count, 2) each.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    of, r = shape(body), _radius(h)
    beta = np.linspace(-0.5 * math.pi, 0.5 * math.pi, count)
    rate, sin, cos = _rate(body, of, r), np.sin(beta), np.cos(beta)
    return frozen(rate * _omega(of, 1, sin, cos)), frozen(rate * _omega(of, -1, sin, cos))


def _omega(of: PassageConstants, arc: int, tanh: Array, sech: Array) -> Array:
    """ω/ω0; shape (m, 2)."""
    along = -of.K * tanh + arc * of.c * sech
    return along[:, None] * of.xi[:2] + (arc * of.kappa) * sech[:, None] * of.eta[:2]


@dataclass(frozen=True)
class Passage:
    """One motion ω(t): its tensor's `PassageConstants`, arc σ = ±1, u0 = u(0), rate ω0 and speed |ω^(±)|."""

    shape: PassageConstants
    arc: int
    u0: float
    rate: float
    speed: float

    def u(self, times: Array) -> Array:
        """u at the times (m,)."""
        return self.u0 + self.rate * times

    def omega(self, u: Array) -> Array:
        """ω (m, 2), closed form of `biz132`."""
        return self.rate * _omega(self.shape, self.arc, np.tanh(u), _sech(u))


def _sech(u: Array) -> Array:
    size = np.exp(-np.abs(u))
    return 2.0 * size / (1.0 + size * size)


def passage(body: SuslovBody, omega: Sequence[float]) -> Passage:
    """The motion that starts with ω(0), however close to the line of equilibria.

    sinh u0 = tan β, where (cos β, sin β) is ω(0) on the ellipse E = h, seen from its middle towards σ = +1.
    Raises `InvalidParameter` (ω = 0, or on the line of equilibria), `WorkLimit`.
    """
    of = shape(body)
    w1, w2 = (float(x) for x in omega)
    require_finite(ω1=w1, ω2=w2)
    r = math.hypot(math.sqrt(body.I11) * w1, math.sqrt(body.I22) * w2)
    if r == 0.0:
        raise InvalidParameter("ω = 0: the body is at rest for ever, h = 0. Choose ω1 or ω2 other than 0.")
    # Exact, because close to the line of equilibria the two products nearly cancel.
    s = Fraction(body.I13) * Fraction(w1) + Fraction(body.I23) * Fraction(w2)
    if s == 0:
        raise InvalidParameter(
            "ω(0) lies on the line of equilibria I13ω1 + I23ω2 = 0: ω stays there, and γ turns about ξ for ever. "
            "Move ω off the line."
        )
    rate = _rate(body, of, r)
    speed = r / math.sqrt(of.w)
    if not (math.isfinite(rate) and rate > 0.0 and math.isfinite(speed)):
        raise InvalidParameter("This ω leaves the range of double precision: choose a less extreme one.")
    n1, n2 = of.eta[:2]
    sin = (body.I22 * n1 * (w2 / r) - body.I11 * n2 * (w1 / r)) / math.sqrt(of.w)
    # ln |cos β|, because the cosine itself may underflow.
    factor = math.sqrt(body.I11 / of.w) * math.sqrt(body.I22) / of.J
    log_cos = _log(abs(s)) - math.log(r) + math.log(factor)
    if log_cos > -20.0:
        u0 = math.asinh(sin * math.exp(-log_cos))
    else:
        u0 = math.copysign(math.log(2.0) - log_cos, sin)
    return Passage(of, 1 if s > 0 else -1, u0, rate, speed)


def _log(x: Fraction) -> float:
    """ln x, also for x beyond the range of doubles."""
    shift = x.numerator.bit_length() - x.denominator.bit_length()
    return math.log(float(x / Fraction(2) ** shift)) + shift * math.log(2.0)


def propagate(of: PassageConstants, arc: int, u: Array, level: Accuracy) -> tuple[Complex, Complex, int]:
    """A and B at each u (m,), in any order, and the Taylor steps this took.  Raises `WorkLimit`."""
    level = as_level(level)
    inside = np.clip(u, -of.end, of.end)
    start = np.array([0.0, 1.0, arc * of.kappa, 0.0, 1.0, 0.0, 0.0, 0.0])
    if level.aside:
        start = nearby(start)
    p = np.array([of.K, arc * of.c])
    out = np.empty((u.size, 8))
    total = 0
    for side in (inside >= 0.0, inside < 0.0):
        index = np.flatnonzero(side)
        if index.size == 0:
            continue
        outwards = index[np.argsort(np.abs(inside[index]), kind="stable")]
        states = np.empty((index.size, 8))
        steps = integrate(start, p, inside[outwards], level.order, level.tolerance, _MAX_STEPS, states)
        if steps < 0:
            raise WorkLimit("This passage needs too many steps: choose larger I13, I23, or a cheaper level.")
        out[outwards] = states
        total += steps
    return out[:, 4] + 1j * out[:, 5], out[:, 6] + 1j * out[:, 7], total


def turning(of: PassageConstants, arc: int, u: Array, level: Accuracy) -> tuple[Complex, Complex, float, int]:
    """A and B at each u (m,), the error estimate of the rotation between any two of them, and all steps.

    The error is measured as in `orbit.solve`.  Raises `WorkLimit`.
    """

    def run(at: Level, _: int) -> tuple[tuple[Complex, Complex], int]:
        A, B, steps = propagate(of, arc, u, at)
        return (A, B), steps

    def apart(one: tuple[Complex, Complex], other: tuple[Complex, Complex]) -> float:
        # A rotation is quadratic in A and B, and both its ends have errors: a factor of 4.
        return 4.0 * float((np.abs(one[0] - other[0]) + np.abs(one[1] - other[1])).max())

    found = measured(as_level(level), run, apart)
    return *found.result, found.error + 1e-15 * (1.0 + of.size), found.cost.steps


@dataclass(frozen=True)
class FreeRotation:
    """The motion of every γ that shares one ω(0).

    times : (m,); omega : (m, 2); matrices : (m, 3, 3), γ(t) = matrix · γ(0).
    limits : (2, 3), the same for Γ at t → −∞ and t → +∞: Γ^∓ = limits · γ(0).
    error_estimate : of any component of ω and γ, absolute.
    """

    times: Array
    omega: Array
    matrices: Array
    limits: Array
    passage: Passage
    status: Status
    error_estimate: float
    cost: Cost


def rotation(body: SuslovBody, omega: Sequence[float], times: Sequence[float] | Array, level: Accuracy) -> FreeRotation:
    """The rotation along the motion that starts with ω(0), at times as in `orbit.solve`.

    Raises `InvalidParameter` (a field, I13 = I23 = 0, ω = 0 or on the line of equilibria, times out of order),
    `WorkLimit`.
    """
    level = as_level(level)
    start = time.perf_counter()
    t = checked_times(times)
    motion = passage(body, omega)
    of, arc, u0 = motion.shape, motion.arc, motion.u0
    with np.errstate(over="ignore"):
        elapsed = motion.rate * t
        angle = of.K * elapsed
    if not np.all(np.isfinite(angle)):
        raise InvalidParameter("This time is too long for double precision: choose a shorter one.")
    u = u0 + elapsed
    A, B, error, steps = turning(of, arc, np.concatenate([[u0, -of.end, of.end], u]), level)
    # M(u) M(u0)^−1, then back into the frame of the body.
    A, B = A * A[0].conj() + B.conj() * B[0], B * A[0].conj() - A.conj() * B[0]
    before = float(of.turned(u0, arc))
    outside = -of.K * (_elapsed_size(u0, u, elapsed) + _tail(u) - _tail(u0)) + arc * of.c * (_gd(u) - _gd(u0))
    limits = _gamma_row(A[1:3], B[1:3] * np.exp(1j * before)) @ _axes(of).T
    # The same factor in both: it cancels exactly in Γ, which contains AB, however large the angle.
    half = np.exp(-0.5j * outside)
    A, B = A[3:] * half, B[3:] * half.conj() * np.exp(1j * before)
    found = _axes(of) @ _matrices(A, B) @ _axes(of).T

    # Errors of the data: ω0, K and u0 are known to a few units in the last place.
    error += 1e-15 * of.K * float(np.max(np.abs(elapsed))) + 3e-16 * abs(u0) * (1.0 + of.size)
    error = min(error, 2.0)
    velocity = motion.omega(u)
    require_finite_states(velocity)
    wall_ms = (time.perf_counter() - start) * 1e3
    absolute = error * max(1.0, motion.rate * of.size)
    return FreeRotation(
        frozen(t),
        frozen(velocity),
        frozen(found),
        frozen(limits),
        motion,
        level.status(error),
        absolute,
        Cost(steps, wall_ms),
    )


def _tail(u: Array | float) -> Array:
    return np.log1p(np.exp(-2.0 * np.abs(u)))


def _elapsed_size(u0: float, u: Array, elapsed: Array) -> Array:
    """|u| − |u0|, without cancellation while the sign is the same."""
    return np.where(u * np.sign(u0) >= 0.0, math.copysign(1.0, u0) * elapsed, np.abs(u) - abs(u0))


def _axes(of: PassageConstants) -> Array:
    """η, e3, ξ as columns."""
    return np.column_stack([of.eta, [0.0, 0.0, 1.0], of.xi])


def _gamma_row(A: Complex, B: Complex) -> Array:
    """Γ of the image, from components along η, e3, ξ; shape (m, 3)."""
    AB = 2.0 * A * B
    return np.stack([-AB.real, AB.imag, np.abs(A) ** 2 - np.abs(B) ** 2], axis=-1)


def _matrices(A: Complex, B: Complex) -> Array:
    """((A, −B̄), (B, Ā)) as rotations of (γη, γ3, Γ): z → A²z − B̄²z̄ + 2AB̄Γ with z = γη + iγ3; shape (m, 3, 3)."""
    A2, B2, AB = A * A, B.conj() ** 2, 2.0 * A * B.conj()
    z = np.stack([A2 - B2, 1j * (A2 + B2), AB], axis=-1)
    return np.stack([z.real, z.imag, _gamma_row(A, B)], axis=1)


@dataclass(frozen=True)
class FreeMotion(Result):
    """One motion of the free Suslov problem.

    times : (m,); omega : (m, 2); gamma : (m, 3); Gamma : (m,) = (ξ, γ);
    phase : (m,) in (−π, π], of γ about ξ: γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3);
    limits : (Γ^(−), Γ^(+)) for t → −∞ and t → +∞;
    error_estimate : of any component of ω and γ; drift : of E, F1 and, where it exists, F2, as in `Orbit`.
    """

    times: Array
    omega: Array
    gamma: Array
    Gamma: Array
    phase: Array
    limits: tuple[float, float]
    passage: Passage
    level: str
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    notes: tuple[str, ...] = field(default=())

    def labels(self) -> Labels:
        """ω, γ, Γ and the phase φ over t."""
        named = {
            name: (("t",), values)
            for name, values in zip(
                (*SYSTEM.variables, "Γ", "φ"), (*self.omega.T, *self.gamma.T, self.Gamma, self.phase), strict=True
            )
        }
        return Labels(
            {"t": (("t",), self.times)},
            named,
            {"t": "T", **{name: unit_of(name) for name in named}, "φ": "rad"},
            {"Γ⁻": self.limits[0], "Γ⁺": self.limits[1], **facts_of(self)},
        )


def free_motion(
    body: SuslovBody, omega: Sequence[float], gamma: Sequence[float], times: Sequence[float] | Array, level: Accuracy
) -> FreeMotion:
    """The motion from ω(0) (2,) and γ(0) (3,) at times as in `orbit.solve`.

    γ(0) is normalised, with a note where that changed it.  Raises as `rotation`.

    >>> from hess_mechanics import SuslovBody, free_motion, level
    >>> body = SuslovBody(2.0, 1.0, 0.3, 0.5)
    >>> free_motion(body, (0.8, -0.4), (0.6, 0.0, 0.8), [0.0, 1.0], level("precise")).level
    'precise'
    """
    level = as_level(level)
    begun = time.perf_counter()
    unit, note = unit_vector(gamma)
    turned = rotation(body, omega, times, level)
    vertical = turned.matrices @ np.array(unit)
    of = turned.passage.shape
    states = np.hstack([turned.omega, vertical])
    start = np.array([*map(float, omega), *unit])
    with np.errstate(over="ignore", invalid="ignore"):
        drift = drift_of(SYSTEM, start, states, np.array(body.parameters))
        integral = additional_integral.of_body(body)
        if integral is not None:
            first = integral(start[:2], start[2:])
            size = max(1.0, abs(float(first)))
            drift["F2"] = float(np.max(np.abs(integral(turned.omega, vertical) - first))) / size
    if not all(math.isfinite(value) for value in drift.values()):
        raise InvalidParameter("The energy leaves the range of double precision: choose a less extreme ω.")
    limits = np.clip(turned.limits @ np.array(unit), -1.0, 1.0)
    cost = Cost(turned.cost.steps, (time.perf_counter() - begun) * 1e3)
    return FreeMotion(
        turned.times,
        turned.omega,
        frozen(vertical),
        frozen(vertical @ of.xi),
        frozen(np.arctan2(vertical[:, 2], vertical @ of.eta)),
        (float(limits[0]), float(limits[1])),
        turned.passage,
        level.name,
        turned.status,
        turned.error_estimate,
        drift,
        cost,
        (note,) if note else (),
    )


_PASSING = 20.0
"""Beyond |u| = 20 the rotation of γ is uniform to 1e-8."""


def sample_times(
    body: SuslovBody, omega: Sequence[float], span: float, weights: tuple[float, float], sagitta: float, most: int
) -> Array:
    """At most `most` times from 0 to `span` (not 0) at which straight lines between samples look like the curves.

    weights : pixels per unit of ω and of γ; sagitta : largest distance between curve and chord, in pixels, as in
    `sampling.sample_times`, with the accelerations in closed form.  Where `most` times are too few, the uniform
    rotation near the line of equilibria is thinned out first.  Raises as `passage`.
    """
    motion = passage(body, omega)
    of, length = motion.shape, motion.rate * span
    if not (math.isfinite(length) and length != 0.0):
        raise InvalidParameter("The time span must be a finite number other than 0.")
    first_u, last_u = sorted((motion.u0, motion.u0 + length))
    knots = np.clip(np.linspace(-_PASSING, _PASSING, 801), first_u, last_u)
    u = np.unique(np.concatenate([[motion.u0, motion.u0 + length], knots]))
    if u.size == 1:  # so little happens that the phase of the passage stays the same number
        return np.linspace(0.0, span, min(most, 17))
    tanh, sech = np.tanh(u), _sech(u)
    speed = np.linalg.norm(_omega(of, motion.arc, tanh, sech), axis=1)
    across = math.hypot(of.c, of.kappa)
    first = sech * np.hypot(of.K * sech, across * tanh)
    second = sech * (2.0 * of.K * sech + across)
    acceleration = weights[1] * (speed**2 + first) + weights[0] * motion.rate * second
    density = np.maximum(np.sqrt(acceleration / (8.0 * sagitta)), 16.0 / abs(length))
    share = 0.5 * (density[1:] + density[:-1]) * np.diff(u)
    passing = np.abs(u[1:] + u[:-1]) < 2.0 * _PASSING
    inside, outside = float(share[passing].sum()), float(share[~passing].sum())
    if inside + outside > most - 1 and inside < 0.5 * most:
        share[~passing] *= (most - 1 - inside) / outside
    needed = np.concatenate([[0.0], np.cumsum(share)])
    count = int(min(most - 1, math.ceil(needed[-1]))) + 1
    samples = np.interp(np.linspace(0.0, needed[-1], count), needed, u)
    times: Array = (samples - motion.u0) / motion.rate
    times = np.clip(times if span > 0.0 else times[::-1], min(0.0, span), max(0.0, span))
    times[0], times[-1] = 0.0, span
    return times


def sampled_motion(
    body: SuslovBody,
    omega: Sequence[float],
    gamma: Sequence[float],
    span: float,
    weights: tuple[float, float],
    level: Accuracy,
    most: int = MOST_SAMPLES,
) -> FreeMotion:
    """The motion over `span`, at times as `sample_times` says for pictures of these weights.  Raises as `rotation`."""
    return free_motion(body, omega, gamma, sample_times(body, omega, span, weights, SAGITTA, most), level)


def turned_along_circle(
    body: SuslovBody, omega: Sequence[float], gamma: Sequence[float], turn: float, level: Accuracy
) -> tuple[float, float, float]:
    """γ(0) of the motion with the same ω(0) that comes from the same circle Γ^(−), turned along it by `turn` radians.

    Raises as `rotation`.
    """
    # Γ^(−) = (n, γ(0)).
    n = rotation(body, omega, [1.0], level).limits[0]
    n = n / np.linalg.norm(n)
    g = np.array(gamma, float)
    along = n * (n @ g)
    g1, g2, g3 = along + math.cos(turn) * (g - along) + math.sin(turn) * np.cross(n, g)
    return float(g1), float(g2), float(g3)
