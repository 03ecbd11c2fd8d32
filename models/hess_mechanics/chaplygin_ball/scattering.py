"""S9: θ⁻ → θ⁺ of the Chaplygin ball without a field (`eq29` with b = 0).

On N^u and N^s, ω = ±uξ is constant and γ turns about ξ on a circle, cos θ = (γ, ξ).  Across the line the motion
leaves N^u and approaches N^s at the rate, with J = √(I13² + I23²) and I_ξ = I11 ξ1² + I22 ξ2²,

    λ = J √(2h (I_ξ + 𝒟 sin²θ)) / det Î,   u = √(2h / (I_ξ + 𝒟 sin²θ)).

A motion whose ω is still δu away from the line, ω = u(ξ + δη) + …, has left its circle by a first-order term in δ,
found by integrating back along N^u, where φ decreases at the rate u.  With μ(φ) = λ/u and

    H(φ) = ∫_0^∞ exp(iφ + is − ∫_0^s μ(φ + s') ds') ds

γ is γ_circle + δ v, (v, ξ) = −sin θ Im H, (v, η) + i(v, e3) = i cos θ e^{iφ} H̄.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody, determinant, kinetic_energy
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.dynamics.orbit import status_of
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import REFERENCE, Level, Status
from hess_mechanics.numerics.results import Array, Cost, frozen
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = ["BallScattering", "ball_scattering", "starts"]

MOST_STEPS = 20_000_000
_MOST_SWING = 300.0
_MOST_TURN = 0.3
"""Where γ has turned farther from its circle than this, the first order in the distance means nothing."""
_TINY = 1e-280
"""In the place of a rate whose inverse is beyond double range."""
_STEPS = 2.0
"""Taylor steps of both runs in the time 1/ν, at a tolerance of 1e-9 and the order of `REFERENCE`."""


@dataclass(frozen=True)
class BallScattering:
    """Where the motions go that leave the circle θ⁻ of N^u.

    phis : (n,), the phases of γ at the start; theta_plus : (n,), 0 … π; errors : (n,) their estimated errors.
    """

    theta_minus: float
    phis: Array
    theta_plus: Array
    errors: Array
    level: str
    status: Status
    cost: Cost


def _phases(body: BallBody) -> Array:
    """Phases all round, so many that λ is resolved where γ passes the plane γ3 = 0: its peak is √(I/(I+𝒟)) wide."""
    width = 1.0 / math.sqrt(1.0 + body.D / min(body.I11, body.I22))
    count = 2 ** math.ceil(math.log2(min(64.0 / width, 8192.0)))
    return np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)


def _circle(body: BallBody, theta: Array | float, phi: Array) -> Array:
    """γ = cos θ ξ + sin θ (cos φ η + sin φ e3), shape (..., 3)."""
    xi, eta = line_of_rest(body)
    across = np.sin(theta) * np.cos(phi)
    return np.stack([np.cos(theta) * xi[0] + across * eta[0], np.cos(theta) * xi[1] + across * eta[1],
                     np.sin(theta) * np.sin(phi)], axis=-1)


def _moment(body: BallBody, theta: Array | float) -> Array:
    """(ξ, Îξ) on the circles θ."""
    xi, _ = line_of_rest(body)
    return body.I11 * xi[0] ** 2 + body.I22 * xi[1] ** 2 + body.D * np.sin(theta) ** 2


def _growth(body: BallBody, theta: Array, phi: Array) -> Array:
    """μ = λ/u on the circles θ (m,) at the phases φ (n,), shape (m, n)."""
    gamma = np.moveaxis(_circle(body, theta[:, None], phi), -1, 0)
    growth = math.hypot(body.I13, body.I23) * _moment(body, theta)[:, None] / determinant(gamma, body.parameters)
    return np.maximum(growth, _TINY)


def _lag(body: BallBody, theta: float, phis: Array) -> Array | None:
    """H of the phases φ (n,); None where e^∫μ is beyond double range."""
    grid = _phases(body)
    growth = np.fft.fft(_growth(body, np.array([theta]), grid)[0]) / grid.size
    order = np.fft.fftfreq(grid.size, 1.0 / grid.size)
    mean = growth[0].real
    wave = np.divide(growth, 1j * order, out=np.zeros_like(growth), where=order != 0.0)
    # The integral of μ less its mean, and what is left to integrate: a periodic function times e^(−mean s).
    swing = np.fft.ifft(wave * grid.size).real
    if np.ptp(swing) > _MOST_SWING:
        return None
    parts = np.fft.fft(np.exp(1j * grid - swing)) / grid.size / (mean - 1j * order)
    swings, rest = (np.exp(1j * np.outer(phis, order)) @ np.column_stack([wave, parts])).T
    return np.exp(swings.real) * rest


def starts(strip: Strip, theta: float, phis: Array, distance: float) -> tuple[Array, Array]:
    """States (n, 5) of motions that come from the circle θ of N^u, with phases φ (n,), ω along ξ + distance·η.

    And their errors (n,): how far from θ, in radians, the circles may be from which they truly come.  γ is at φ on the
    circle but for a term of the order of `distance`, which the module's docstring derives.
    """
    body = strip.body
    xi, eta = line_of_rest(body)
    lag = _lag(body, theta, phis)
    reach = 1.0 / float(_growth(body, np.array([theta]), _phases(body)).min())
    known = lag is not None and abs(distance) * float(np.max(np.abs(lag))) < _MOST_TURN
    H = lag if known else np.zeros(phis.size, complex)
    z = math.sin(theta) * np.exp(1j * phis) + 1j * distance * math.cos(theta) * np.exp(1j * phis) * H.conj()
    across = np.column_stack([math.cos(theta) - distance * math.sin(theta) * H.imag, z.real, z.imag])
    across /= np.linalg.norm(across, axis=1)[:, None]
    gamma = across @ np.array([[*xi, 0.0], [*eta, 0.0], [0.0, 0.0, 1.0]])
    direction = xi + distance * eta
    omega = direction * np.sqrt(strip.h / kinetic_energy((*direction, *gamma.T), body.parameters))[:, None]
    left = (distance * (1.0 + np.abs(H))) ** 2 if known else abs(distance) * reach
    return np.hstack([omega, gamma]), np.minimum(left + 2e-16 / abs(distance) * reach, math.pi) + np.zeros(phis.size)


def _speed_and_rate(strip: Strip, theta: Array) -> tuple[Array, Array]:
    """u and the mean of λ over one turn, on the circles θ (m,)."""
    speeds = np.sqrt(2.0 * strip.h / _moment(strip.body, theta))
    return speeds, speeds * np.mean(_growth(strip.body, theta, _phases(strip.body)), axis=1)


def ball_scattering(body: BallBody, theta_minus: float, phis: Sequence[float] | Array, h: float, distance: float,
                    level: Level, most_steps: float = MOST_STEPS) -> BallScattering:
    """θ⁺ for each phase φ of γ(0) ≈ cos θ⁻ ξ + sin θ⁻ (cos φ η + sin φ e3), η = e3 × ξ; see `starts`.

    The motion starts with ω along ξ + distance·η and E = h, and is followed until γ has settled on a circle of N^s.
    distance : of either sign, for the two sides of N^u, 1e-10 ≤ |distance| ≤ 0.1.  The curve θ⁺(φ) of other
    distances is the same but for a shift of φ, the farther out the more turns γ has made; and for an error of the
    order of `distance`², which the estimates contain.
    most_steps : what it may take, as estimated before.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    start = time.perf_counter()
    strip = Strip(body, h)
    xi, eta = line_of_rest(body)
    phis = np.array(phis, float, ndmin=1)
    require_finite(theta_minus=theta_minus, distance=distance)
    if phis.ndim != 1 or phis.size == 0 or not np.all(np.isfinite(phis)):
        raise InvalidParameter("The phases φ must be one or more finite numbers.")
    if not 0.0 <= theta_minus <= math.pi:
        raise InvalidParameter(f"θ⁻ = {theta_minus:g}, but it is an angle between two vectors: choose 0 ≤ θ⁻ ≤ π.")
    if not 1e-10 <= abs(distance) <= 0.1:
        raise InvalidParameter(f"The distance from N^u is {distance:g}: choose it from 1e-10 to 0.1, or minus that.")

    states, before = starts(strip, theta_minus, phis, distance)
    _, rates = _speed_and_rate(strip, np.array([theta_minus, *np.linspace(0.0, math.pi, 33)]))
    # Out of N^u at the rate of θ⁻, into N^s at that of the slowest circle; in between about e^1.4 each.
    span = math.log(4.0 / abs(distance)) / rates[0] + math.log(40.0 / level.promise) / rates.min()
    # Steps must be exact beside the small distance too, which decides when γ leaves; and other errors need room.
    rung = Level(level.name, 0.5 * level.promise, max(0.01 * abs(distance) * level.promise, REFERENCE.tolerance),
                 REFERENCE.order)
    nu = float(np.max(SYSTEM.frequency(states.T, np.array(body.parameters))))
    steps = _STEPS * (1e-9 / rung.tolerance) ** (1.0 / rung.order) * (nu + rates.max()) * span * phis.size
    if steps > most_steps:
        raise WorkLimit(f"γ settles on its circle so slowly that θ⁺ takes some {steps:.0e} steps: choose larger I13 or "
                        "I23, or a smaller 𝒟.")
    found = ensemble(SYSTEM, states, body.parameters, [span], rung)
    end = found.states[:, 0]
    along, across = end[:, 2:4] @ xi, np.hypot(end[:, 2:4] @ eta, end[:, 4])
    theta_plus = np.arctan2(across, along)

    # What γ still turns towards ξ, ∫ (ω, η) dt ≈ (ω, η)/λ.
    _, last = _speed_and_rate(strip, theta_plus)
    errors = found.errors + before + np.abs(end[:, :2] @ eta) / last
    wall_ms = (time.perf_counter() - start) * 1e3
    return BallScattering(float(theta_minus), frozen(phis), frozen(theta_plus), frozen(errors), level.name,
                          status_of(float(errors.max()), level), Cost(found.cost.steps, wall_ms))
