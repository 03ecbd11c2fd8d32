"""The free Suslov problem, b = 0 (`biz132`): ω(t) in closed form, and γ(t) from one rotation.

ξ = (I23, −I13, 0)/J and η = (I13, I23, 0)/J, J² = I13² + I23²; ξ, η, e3 are right-handed.  The line of equilibria is
ω ∥ ξ.  Every other ω moves once from the unstable to the stable point of its ellipse E = h.  With u = ω0 (t − t0) and
σ = ±1 for the two arcs (the sign of I13ω1 + I23ω2)

    ω/ω0 = (−K tanh u + σc sech u) ξ + σκ sech u η,
    w = (I22 I13² + I11 I23²)/J²,  K = I11 I22/(J w),  κ = √(I11 I22)/J,  c = κ I13 I23 (I22 − I11)/(J² w),
    ω0 = J √(2hw)/(I11 I22),

which is the solution of the paper.  γ̇ = γ × ω is linear.  In the frame that is rotated about ξ by
Φ(u) = −K ln cosh u + σc gd u, the remaining rotation is a matrix ((A, −B̄), (B, Ā)) of SU(2),

    A' = −(i/2) V B,  B' = −(i/2) V̄ A,  V = σκ sech u e^{iΦ},  V' = (−iK tanh u + iσc sech u − tanh u) V.

The integration starts at u = 0, and V decays on both sides of it, so that starts close to the line of equilibria and
long times cost neither steps nor digits.  This rotation is not in the paper: see models/README.md.
ω(t) is also the motion of the Chaplygin sleigh (I23 = 0), and of the same constraint on E(2) and SO(2,1).
"""

from __future__ import annotations

import cmath
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from hess_mechanics.dynamics.orbit import as_times, drift_of, require_finite_states
from hess_mechanics.dynamics.sampling import MOST_SAMPLES, SAGITTA
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level, as_point, unit_vector
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import measured, perturb
from hess_mechanics.numerics.results import Array, Complex, Cost, as_read_only, facts_of, unit_of
from hess_mechanics.parameters import plain
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov import additional_integral
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.free_kernels import integrate

__all__ = [
    "Equilibria",
    "FreeMotion",
    "Passage",
    "PassageConstants",
    "arcs",
    "equilibria",
    "equilibria_of_unit_rate",
    "free_motion",
    "passage",
    "rotation",
    "rotation_along_circle",
    "sample_times",
    "sampled_motion",
    "shape",
    "transfer",
    "vertical",
]

_MAX_STEPS = 200_000
_MAX_SHAPE = 1e4
"""Limit of K + κ + |c|: the work and the round-off grow with it."""


@dataclass(frozen=True)
class PassageConstants:
    """Constants of an inertia tensor that determine every passage of ω along its ellipse, see the module.

    Attributes
    ----------
    xi : ndarray, shape (3,)
        Unit vector ξ along the line of equilibria.
    eta : ndarray, shape (3,)
        Unit vector η = e3 × ξ.
    J : float
        Size √(I13² + I23²) of the products of inertia, J > 0.
    w : float
        Weighted mean (I22 I13² + I11 I23²)/J² of the moments, w > 0.
    K : float
        Dimensionless constant I11 I22/(J w), K > 0.
    kappa : float
        Dimensionless constant κ = √(I11 I22)/J, κ > 0.
    c : float
        Dimensionless constant c of the arc σ = +1, of either sign.
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
        """Upper bound K + κ + |c| on the rotation of γ per unit of u."""
        return self.K + self.kappa + abs(self.c)

    @property
    def end(self) -> float:
        """The |u| beyond which A and B change by at most 1.2e-17."""
        return 39.0 + math.log(max(1.0, self.kappa))

    def angle(self, u: Array | float, arc: int) -> Array:
        """Return Φ(u) = −K ln cosh u + σc gd u, the angle of the rotating frame about ξ.

        Parameters
        ----------
        u : float or ndarray
            Rescaled times.
        arc : int
            Arc σ, 1 or −1.

        Returns
        -------
        ndarray
            Angles in radians, of the shape of u.
        """
        return -self.K * (np.abs(u) + _tail(u) - math.log(2.0)) + arc * self.c * _gd(u)


def _tail(u: Array | float) -> Array:
    """Return ln(2 cosh u) − |u|."""
    return np.log1p(np.exp(-2.0 * np.abs(u)))


def _gd(u: Array | float) -> Array:
    """Return the Gudermannian function, ∫ sech u du."""
    return 2.0 * np.arctan(np.tanh(0.5 * np.asarray(u)))


def shape(body: SuslovBody) -> PassageConstants:
    """Return the constants of the passages of a body without a field.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.

    Returns
    -------
    PassageConstants
        The constants, with the directions ξ and η.

    Raises
    ------
    InvalidParameter
        If the body has a field, or I13 = I23 = 0.
    WorkLimit
        If I13 and I23 are too small, or I11 and I22 too different.
    """
    I11, I22, I13, I23, *b = body.parameters
    if any(b):
        raise InvalidParameter("Free motion and its scattering need a body without a field. Set b1 = b2 = b3 = 0.")
    J = math.hypot(I13, I23)
    if not J > 0.0:
        raise InvalidParameter(
            "With I13 = I23 = 0 and no field, ω is constant: there is no line of equilibria, no ξ and no "
            "scattering. Choose a nonzero I13 or I23."
        )
    n1, n2 = I13 / J, I23 / J
    w = I22 * n1 * n1 + I11 * n2 * n2
    mean = math.sqrt(I11) * math.sqrt(I22)
    kappa, K = mean / J, mean / J * (mean / w)
    c = kappa * n1 * n2 * ((I22 - I11) / w)
    angle = K + kappa + abs(c)
    if not angle <= _MAX_SHAPE:
        about = f"about {plain(angle, 2)}" if math.isfinite(angle) else "more than 1e308"
        raise WorkLimit(
            f"γ turns too often while ω passes from the unstable to the stable point ({about} radians; at most "
            f"{_MAX_SHAPE:g} are computed): choose a larger I13 or I23, or more similar I11 and I22."
        )
    return PassageConstants(
        as_read_only(np.array([n2, -n1, 0.0])), as_read_only(np.array([n1, n2, 0.0])), J, w, K, kappa, c
    )


@dataclass(frozen=True)
class Equilibria:
    """Equilibria of ω with energy h, on the line I13ω1 + I23ω2 = 0 (`biz138`, with its denominator corrected).

    There γ rotates about ξ on the circles Γ = (ξ, γ) = const, the limit cycles.

    Attributes
    ----------
    stable : ndarray, shape (2,)
        Stable point ω^(+) = −|ω|ξ, in rad/T.
    unstable : ndarray, shape (2,)
        Unstable point ω^(−) = +|ω|ξ, in rad/T.
    xi : ndarray, shape (3,)
        Unit vector ξ.
    speed : float
        Size |ω^(±)|, the angular velocity of γ, in rad/T.
    rate : float
        Rate ω0 at which ω departs and arrives, in 1/T.
    h : float
        Energy, h > 0.
    """

    stable: Array
    unstable: Array
    xi: Array
    speed: float
    rate: float
    h: float

    def gamma(self, Gamma: float, phi: float) -> tuple[float, float, float]:
        """Return the vertical on a limit cycle, γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3), η = e3 × ξ.

        Parameters
        ----------
        Gamma : float
            Height Γ = (ξ, γ) of the cycle, −1 to 1.
        phi : float
            Phase φ, in radians.

        Returns
        -------
        tuple of three floats
            The vertical γ.
        """
        g1, g2, g3 = vertical(self.xi, Gamma, cmath.rect(math.sqrt(max(0.0, 1.0 - Gamma * Gamma)), phi)).tolist()
        return g1, g2, g3


def vertical(xi: Array, Gamma: Array | float, z: Complex | complex) -> Array:
    """Return γ = Γξ + Re z η + Im z e3 with η = e3 × ξ.

    Parameters
    ----------
    xi : ndarray, shape (2,) or (3,)
        Unit vector ξ.
    Gamma : float or ndarray, shape (...)
        Component Γ along ξ, −1 to 1.
    z : complex or ndarray, shape (...)
        Components across ξ.

    Returns
    -------
    ndarray, shape (..., 3)
        Verticals γ.
    """
    z = np.asarray(z)
    return np.stack([Gamma * xi[0] - z.real * xi[1], Gamma * xi[1] + z.real * xi[0], z.imag], axis=-1)


def _rate(body: SuslovBody, of: PassageConstants, r: float) -> float:
    """Return ω0 for r = √(2h)."""
    return of.J / body.I11 * (r * math.sqrt(of.w) / body.I22)


def equilibria(body: SuslovBody, h: float) -> Equilibria:
    """Return the stable and the unstable equilibrium of ω with energy h.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    h : float
        Energy, h > 0.

    Returns
    -------
    Equilibria
        The equilibria.

    Raises
    ------
    InvalidParameter
        If the body has a field, I13 = I23 = 0, or h ≤ 0.
    WorkLimit
        If γ rotates too often during a passage, see `shape`.
    """
    of, r = shape(body), _radius(h)
    speed = r / math.sqrt(of.w)
    point = speed * of.xi[:2]
    return Equilibria(as_read_only(-point), as_read_only(point), of.xi, speed, _rate(body, of, r), h)


def _radius(h: float) -> float:
    """Return √(2h)."""
    require_finite(h=h)
    if not h > 0.0:
        raise InvalidParameter(f"E = h = {h:g}, but without a field the energy of a motion is positive: choose h > 0.")
    return math.sqrt(2.0) * math.sqrt(h)


def equilibria_of_unit_rate(body: SuslovBody) -> Equilibria:
    """Return the equilibria with the energy for which ω0 = 1.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.

    Returns
    -------
    Equilibria
        The equilibria.

    Raises
    ------
    InvalidParameter
        If the body has a field, or I13 = I23 = 0.
    WorkLimit
        If γ rotates too often during a passage, see `shape`.
    """
    return equilibria(body, 1.0 / equilibria(body, 1.0).rate ** 2)


def arcs(body: SuslovBody, h: float, count: int = 91) -> tuple[Array, Array]:
    """Return the two arcs of the ellipse E = h, from the unstable to the stable point.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    h : float
        Energy, h > 0.
    count : int, default 91
        Number of points of each arc.

    Returns
    -------
    tuple of two ndarray, shape (count, 2)
        Angular velocities (ω1, ω2), σ = +1 first.

    Raises
    ------
    InvalidParameter
        If the body has a field, I13 = I23 = 0, or h ≤ 0.
    WorkLimit
        If γ rotates too often during a passage, see `shape`.
    """
    of, r = shape(body), _radius(h)
    beta = np.linspace(-0.5 * math.pi, 0.5 * math.pi, count)
    rate, sin, cos = _rate(body, of, r), np.sin(beta), np.cos(beta)
    return as_read_only(rate * _omega(of, 1, sin, cos)), as_read_only(rate * _omega(of, -1, sin, cos))


def _omega(of: PassageConstants, arc: int, tanh: Array, sech: Array) -> Array:
    """Return ω/ω0; shape (m, 2)."""
    along = -of.K * tanh + arc * of.c * sech
    return along[:, None] * of.xi[:2] + (arc * of.kappa) * sech[:, None] * of.eta[:2]


@dataclass(frozen=True)
class Passage:
    """One motion ω(t) from the unstable to the stable equilibrium.

    Attributes
    ----------
    shape : PassageConstants
        Constants of the inertia tensor.
    arc : int
        Arc σ, 1 or −1: the sign of I13ω1 + I23ω2.
    u0 : float
        Rescaled time u at t = 0.
    rate : float
        Rate ω0 of u, in 1/T.
    """

    shape: PassageConstants
    arc: int
    u0: float
    rate: float

    def omega(self, u: Array) -> Array:
        """Return ω in closed form (`biz132`).

        Parameters
        ----------
        u : ndarray, shape (m,)
            Rescaled times.

        Returns
        -------
        ndarray, shape (m, 2)
            Angular velocities (ω1, ω2), in rad/T.
        """
        return self.rate * _omega(self.shape, self.arc, np.tanh(u), _sech(u))


def _sech(u: Array) -> Array:
    size = np.exp(-np.abs(u))
    return 2.0 * size / (1.0 + size * size)


def passage(body: SuslovBody, omega: Sequence[float]) -> Passage:
    """Return the motion of ω from its value at t = 0, however close to the line of equilibria.

    sinh u0 = sin β/|cos β|, where β is the angle, in the metric of the energy, from the middle of the arc σ = +1 to
    ω(0), positive towards the stable point.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    omega : sequence of float, shape (2,)
        Angular velocity (ω1, ω2) at t = 0, in rad/T.

    Returns
    -------
    Passage
        The motion.

    Raises
    ------
    InvalidParameter
        If the body has a field, I13 = I23 = 0, ω is 0 or on the line of equilibria, or double precision is exceeded.
    WorkLimit
        If γ rotates too often during the passage, see `shape`.
    """
    of = shape(body)
    w1, w2 = as_point(("ω1", "ω2"), omega)
    r = math.hypot(math.sqrt(body.I11) * w1, math.sqrt(body.I22) * w2)
    if r == 0.0:
        raise InvalidParameter("ω = 0: the body is at rest for ever, h = 0. Choose a nonzero ω1 or ω2.")
    # Use exact arithmetic, because the two products nearly cancel close to the line of equilibria.
    s = Fraction(body.I13) * Fraction(w1) + Fraction(body.I23) * Fraction(w2)
    if s == 0:
        raise InvalidParameter(
            "ω(0) lies on the line of equilibria I13ω1 + I23ω2 = 0: ω stays there, and γ turns about ξ for ever. "
            "Move ω off the line."
        )
    rate = _rate(body, of, r)
    if not (math.isfinite(rate) and rate > 0.0 and math.isfinite(r / math.sqrt(of.w))):
        raise InvalidParameter("This ω exceeds the range of double precision: choose a less extreme one.")
    n1, n2 = of.eta[:2]
    sin = (body.I22 * n1 * (w2 / r) - body.I11 * n2 * (w1 / r)) / math.sqrt(of.w)
    # Use ln |cos β|, because the cosine itself may underflow.
    factor = math.sqrt(body.I11 / of.w) * math.sqrt(body.I22) / of.J
    log_cos = _log(abs(s)) - math.log(r) + math.log(factor)
    if log_cos > -20.0:
        u0 = math.asinh(sin * math.exp(-log_cos))
    else:
        u0 = math.copysign(math.log(2.0) - log_cos, sin)
    return Passage(of, 1 if s > 0 else -1, u0, rate)


def _log(x: Fraction) -> float:
    """Return ln x, also for x beyond the range of doubles."""
    shift = x.numerator.bit_length() - x.denominator.bit_length()
    return math.log(float(x / Fraction(2) ** shift)) + shift * math.log(2.0)


def transfer(of: PassageConstants, arc: int, u: Array, accuracy: Accuracy) -> tuple[Complex, Complex, float, int]:
    """Return the matrices M(u) M(u[0])^−1 of SU(2), their estimated error and the number of steps.

    M is the solution of the module with M(0) = 1, constant beyond ±`of.end`.  The error is that of the rotation between
    any two of the u, estimated as in `orbit.solve`.

    Parameters
    ----------
    of : PassageConstants
        Constants of the inertia tensor.
    arc : int
        Arc σ, 1 or −1.
    u : ndarray, shape (m,)
        Rescaled times, in any order.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    A : ndarray of complex, shape (m,)
        First element of the matrices ((A, −B̄), (B, Ā)).
    B : ndarray of complex, shape (m,)
        Second element.
    error : float
        Estimated error of the rotations, ≥ 0.
    steps : int
        Taylor steps of all runs.

    Raises
    ------
    WorkLimit
        If the integration needs too many steps.
    """
    level, inside = as_level(accuracy), np.clip(u, -of.end, of.end)
    first, p = np.array([0.0, 1.0, arc * of.kappa, 0.0, 1.0, 0.0, 0.0, 0.0]), np.array([of.K, arc * of.c])

    def run(at: Level, _: int) -> tuple[tuple[Complex, Complex], int]:
        start = perturb(first) if at.is_perturbed else first
        out, total = np.empty((u.size, 8)), 0
        for side in (inside >= 0.0, inside < 0.0):
            index = np.flatnonzero(side)
            if index.size == 0:
                continue
            outwards = index[np.argsort(np.abs(inside[index]), kind="stable")]
            states = np.empty((index.size, 8))
            longest = at.longest_step(of.end)
            steps, _ = integrate(start, p, inside[outwards], at.order, at.tolerance, longest, _MAX_STEPS, states)
            if steps < 0:
                raise WorkLimit("This passage needs too many steps: choose a larger I13 or I23, or a cheaper accuracy.")
            out[outwards] = states
            total += steps
        return (out[:, 4] + 1j * out[:, 5], out[:, 6] + 1j * out[:, 7]), total

    def apart(one: tuple[Complex, Complex], other: tuple[Complex, Complex]) -> float:
        # The factor 4 covers the errors of both ends of a rotation, which is quadratic in A and B.
        return 4.0 * float((np.abs(one[0] - other[0]) + np.abs(one[1] - other[1])).max())

    result = measured(level, run, apart)
    A, B = result.result
    A, B = A * A[0].conj() + B.conj() * B[0], B * A[0].conj() - A.conj() * B[0]
    return A, B, result.error + 1e-15 * (1.0 + of.size), result.cost.steps


def rotation(motion: Passage, elapsed: Array, accuracy: Accuracy) -> tuple[Array, Array, float, int]:
    """Return the rotations of γ along a motion, and those to both of its ends.

    Parameters
    ----------
    motion : Passage
        The motion of ω.
    elapsed : ndarray, shape (m,)
        Rescaled times ω0 t from the start of the motion, in any order.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    matrices : ndarray, shape (m, 3, 3)
        Matrices with γ = matrix · γ(0).
    limits : ndarray, shape (2, 3)
        Rows with Γ^∓ = row · γ(0) for t → ∓∞.
    error : float
        Estimated error of γ, 0 to 2.
    steps : int
        Taylor steps of all runs.

    Raises
    ------
    WorkLimit
        If the integration needs too many steps.
    """
    of, arc, u0 = motion.shape, motion.arc, motion.u0
    u = u0 + elapsed
    A, B, error, steps = transfer(of, arc, np.concatenate([[u0, -of.end, of.end], u]), accuracy)
    # Transform from the rotating frame to that of the body.
    before = float(of.angle(u0, arc))
    outside = -of.K * (_elapsed_size(u0, u, elapsed) + _tail(u) - _tail(u0)) + arc * of.c * (_gd(u) - _gd(u0))
    axes = np.column_stack([of.eta, [0.0, 0.0, 1.0], of.xi])
    limits = _gamma_row(A[1:3], B[1:3] * np.exp(1j * before)) @ axes.T
    # Γ contains the product AB, so the factors of A and B cancel exactly, however large the angle.
    half = np.exp(-0.5j * outside)
    A, B = A[3:] * half, B[3:] * half.conj() * np.exp(1j * before)
    # The data ω0, K and u0 are accurate to a few units in the last place.
    error += 1e-15 * of.K * float(np.max(np.abs(elapsed), initial=0.0)) + 3e-16 * abs(u0) * (1.0 + of.size)
    return axes @ _matrices(A, B) @ axes.T, limits, min(error, 2.0), steps


def _elapsed_size(u0: float, u: Array, elapsed: Array) -> Array:
    """Return |u| − |u0|, without cancellation if the signs are equal."""
    return np.where(u * np.sign(u0) >= 0.0, math.copysign(1.0, u0) * elapsed, np.abs(u) - abs(u0))


def _gamma_row(A: Complex, B: Complex) -> Array:
    """Return the row of the rotation that gives Γ from the components along η, e3, ξ; shape (m, 3)."""
    AB = 2.0 * A * B
    return np.stack([-AB.real, AB.imag, np.abs(A) ** 2 - np.abs(B) ** 2], axis=-1)


def _matrices(A: Complex, B: Complex) -> Array:
    """Return ((A, −B̄), (B, Ā)) as rotations of (γη, γ3, Γ): z → A²z − B̄²z̄ + 2AB̄Γ with z = γη + iγ3; shape (m, 3, 3)."""
    A2, B2, AB = A * A, B.conj() ** 2, 2.0 * A * B.conj()
    z = np.stack([A2 - B2, 1j * (A2 + B2), AB], axis=-1)
    return np.stack([z.real, z.imag, _gamma_row(A, B)], axis=1)


@dataclass(frozen=True)
class FreeMotion(Result):
    """Motion of the free Suslov problem; the result of `free_motion`.

    Attributes
    ----------
    times : ndarray of float, shape (m,)
        Times, in units T.
    omega : ndarray of float, shape (m, 2)
        Angular velocity (ω1, ω2), in rad/T.
    gamma : ndarray of float, shape (m, 3)
        Vertical γ.
    Gamma : ndarray of float, shape (m,)
        Γ = (ξ, γ), −1 to 1.
    phase : ndarray of float, shape (m,)
        Phase φ of γ about ξ in (−π, π], in radians: γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3).
    limits : tuple of two floats
        Limits of Γ for t → −∞ and t → +∞, −1 to 1.
    level : str
        Name of the accuracy level.
    status : Status
        State of the computation, see `Status`.
    error_estimate : float
        Estimated absolute error of any component of ω and γ, ≥ 0.
    drift : mapping of str to float
        Drift of E, F1 and, if it exists, F2, as in `Orbit`.
    cost : Cost
        Steps and time of the computation.
    notes : tuple of str
        Remarks on the arguments.
    """

    times: Array
    omega: Array
    gamma: Array
    Gamma: Array
    phase: Array
    limits: tuple[float, float]
    level: str
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost
    notes: tuple[str, ...] = field(default=())

    def labels(self) -> Labels:
        """Return the motion with names, units and coordinates.

        Returns
        -------
        Labels
            The variables ω, γ, Γ and the phase φ over t.
        """
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
    body: SuslovBody, omega: Sequence[float], gamma: Sequence[float], times: Sequence[float] | Array, accuracy: Accuracy
) -> FreeMotion:
    """Return the motion of a body without a field.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    omega : sequence of two floats
        Angular velocity (ω1, ω2) at t = 0, in rad/T, not on the line I13ω1 + I23ω2 = 0.
    gamma : sequence of three floats
        Vertical γ at t = 0; it is normalised, with a note if its length was not 1.
    times : array_like of float, shape (m,)
        Times in order, all ≥ 0 or all ≤ 0, as in `solve`.
    accuracy : str or Level
        Accuracy level or its name, see `level`.

    Returns
    -------
    FreeMotion
        The motion at these times, and the limits of Γ.

    Raises
    ------
    InvalidParameter
        If the body has a field, I13 = I23 = 0, ω is 0 or on the line of equilibria, γ is 0, times are out of order, or
        double precision is exceeded.
    WorkLimit
        If γ rotates too often during the passage, see `shape`, or there are more than 200 000 times.

    References
    ----------
    `biz132`, `biz138`.  The rotation of γ is not in the paper, see models/README.md.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, free_motion
    >>> body = SuslovBody(2.0, 1.0, 0.3, 0.5)
    >>> motion = free_motion(body, (0.8, -0.4), (0.6, 0.0, 0.8), [0.0, 1.0], "precise")
    >>> motion.omega[-1].round(4)
    array([ 0.8096, -0.3591])
    """
    level = as_level(accuracy)
    begun = time.perf_counter()
    unit, note = unit_vector(gamma)
    t = as_times(times)
    motion = passage(body, omega)
    of = motion.shape
    with np.errstate(over="ignore"):
        elapsed = motion.rate * t
        angle = of.K * elapsed
    if not np.all(np.isfinite(angle)):
        raise InvalidParameter("This time is too long for double precision: choose a shorter one.")
    matrices, limits, error, steps = rotation(motion, elapsed, level)
    velocity, gammas = motion.omega(motion.u0 + elapsed), matrices @ np.array(unit)
    require_finite_states(velocity)
    start = np.array([*map(float, omega), *unit])
    with np.errstate(over="ignore", invalid="ignore"):
        drift = drift_of(SYSTEM, start, np.hstack([velocity, gammas]), np.array(body.parameters))
        integral = additional_integral.integral_of(body)
        if integral is not None:
            first = integral(start[:2], start[2:])
            size = max(1.0, abs(float(first)))
            drift["F2"] = float(np.max(np.abs(integral(velocity, gammas) - first))) / size
    if not all(math.isfinite(value) for value in drift.values()):
        raise InvalidParameter("The energy exceeds the range of double precision: choose a less extreme ω.")
    left, joined = np.clip(limits @ np.array(unit), -1.0, 1.0).tolist()
    return FreeMotion(
        as_read_only(t),
        as_read_only(velocity),
        as_read_only(gammas),
        as_read_only(gammas @ of.xi),
        as_read_only(np.arctan2(gammas[:, 2], gammas @ of.eta)),
        (left, joined),
        level.name,
        level.status(error),
        error * max(1.0, motion.rate * of.size),
        drift,
        Cost(steps, (time.perf_counter() - begun) * 1e3),
        (note,) if note else (),
    )


_UNIFORM = 20.0
"""For |u| > 20 the rotation of γ is uniform to 1e-8."""


def sample_times(
    body: SuslovBody, omega: Sequence[float], duration: float, weights: tuple[float, float], sagitta: float, most: int
) -> Array:
    """Return times of a motion at which the polygons of ω and γ look like the curves.

    This is `sampling.sample_times` with the accelerations in closed form.  If `most` times are too few, the uniform
    rotation near the line of equilibria is sampled less densely than the passage.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    omega : sequence of float, shape (2,)
        Angular velocity (ω1, ω2) at t = 0, in rad/T.
    duration : float
        Time, nonzero; negative: backward.
    weights : (float, float)
        Pixels per unit of ω and of γ.
    sagitta : float
        Largest distance between curve and chord, positive, in pixels.
    most : int
        Largest number of times, at least 2.

    Returns
    -------
    ndarray, shape (n,)
        Times from 0 to `duration`, both included.

    Raises
    ------
    InvalidParameter
        If the duration is 0 or not finite, or too short or long for double precision, or as `passage`.
    WorkLimit
        If γ rotates too often during the passage, see `shape`.
    """
    motion = passage(body, omega)
    of, length = motion.shape, motion.rate * duration
    if not (math.isfinite(length) and length != 0.0):
        raise InvalidParameter(
            f"The time span {duration:g} is 0, not finite, or too extreme for this ω: choose one such as 100, or -100 "
            "for backward motion."
        )
    first_u, last_u = sorted((motion.u0, motion.u0 + length))
    knots = np.clip(np.linspace(-_UNIFORM, _UNIFORM, 801), first_u, last_u)
    u = np.unique(np.concatenate([[motion.u0, motion.u0 + length], knots]))
    if u.size == 1:  # The whole time span changes u by less than round-off.
        return np.linspace(0.0, duration, min(most, 17))
    tanh, sech = np.tanh(u), _sech(u)
    speed = np.linalg.norm(_omega(of, motion.arc, tanh, sech), axis=1)
    across = math.hypot(of.c, of.kappa)
    first = sech * np.hypot(of.K * sech, across * tanh)
    second = sech * (2.0 * of.K * sech + across)
    acceleration = weights[1] * (speed**2 + first) + weights[0] * motion.rate * second
    density = np.maximum(np.sqrt(acceleration / (8.0 * sagitta)), 16.0 / abs(length))
    share = 0.5 * (density[1:] + density[:-1]) * np.diff(u)
    passing = np.abs(u[1:] + u[:-1]) < 2.0 * _UNIFORM
    inside, outside = float(share[passing].sum()), float(share[~passing].sum())
    if inside + outside > most - 1 and inside < 0.5 * most:
        share[~passing] *= (most - 1 - inside) / outside
    needed = np.concatenate([[0.0], np.cumsum(share)])
    count = int(min(most - 1, math.ceil(needed[-1]))) + 1
    samples = np.interp(np.linspace(0.0, needed[-1], count), needed, u)
    times: Array = (samples - motion.u0) / motion.rate
    times = np.clip(times if duration > 0.0 else times[::-1], min(0.0, duration), max(0.0, duration))
    times[0], times[-1] = 0.0, duration
    return times


def sampled_motion(
    body: SuslovBody,
    omega: Sequence[float],
    gamma: Sequence[float],
    duration: float,
    weights: tuple[float, float],
    accuracy: Accuracy,
    most: int = MOST_SAMPLES,
) -> FreeMotion:
    """Return the motion of a body without a field, at the times of `sample_times`.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    omega : sequence of float, shape (2,)
        Angular velocity (ω1, ω2) at t = 0, in rad/T.
    gamma : sequence of float, shape (3,)
        Vertical γ at t = 0; it is normalised.
    duration : float
        Time, nonzero; negative: backward.
    weights : (float, float)
        Pixels per unit of ω and of γ.
    accuracy : str or Level
        Accuracy level.
    most : int, default MOST_SAMPLES
        Largest number of times.

    Returns
    -------
    FreeMotion
        The motion.

    Raises
    ------
    InvalidParameter
        As `free_motion` and `sample_times`.
    WorkLimit
        As `free_motion`.
    """
    return free_motion(body, omega, gamma, sample_times(body, omega, duration, weights, SAGITTA, most), accuracy)


def rotation_along_circle(
    body: SuslovBody, omega: Sequence[float], gamma: Sequence[float], turn: float, accuracy: Accuracy
) -> tuple[float, float, float]:
    """Rotate γ(0) about the axis of the circle of all γ(0) with the same ω(0) and the same limit Γ^(−).

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    omega : sequence of float, shape (2,)
        Angular velocity (ω1, ω2) at t = 0, in rad/T.
    gamma : sequence of float, shape (3,)
        Vertical γ at t = 0.
    turn : float
        Angle of the rotation, in radians.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    tuple of three floats
        The rotated γ(0).

    Raises
    ------
    InvalidParameter
        As `passage`.
    WorkLimit
        As `passage`.
    """
    # Γ^(−) = (n, γ(0)).
    n = rotation(passage(body, omega), np.empty(0), accuracy)[1][0]
    n = n / np.linalg.norm(n)
    g = np.array(gamma, float)
    along = n * (n @ g)
    g1, g2, g3 = along + math.cos(turn) * (g - along) + math.sin(turn) * np.cross(n, g)
    return float(g1), float(g2), float(g3)
