"""S9: θ⁻ → θ⁺ of the Chaplygin ball without a field (`eq29` with b = 0).

On N^u and N^s, ω = ±uξ is constant and γ turns about ξ on a circle, cos θ = (γ, ξ).  Across the line the motion
leaves N^u and approaches N^s at the rate, with J = √(I13² + I23²) and I_ξ = I11 ξ1² + I22 ξ2²,

    λ = J √(2h (I_ξ + 𝒟 sin²θ)) / det Î,   u = √(2h / (I_ξ + 𝒟 sin²θ)).
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .accuracy import REFERENCE, Level, Status
from .chaplygin_ball import SYSTEM, BallBody, determinant, kinetic_energy
from .ensemble import ensemble
from .errors import InvalidParameter
from .orbit import status_of
from .results import Array, Cost, frozen
from .rigid_body import require_finite
from .strip import Strip, line_of_rest

__all__ = ["BallScattering", "ball_scattering"]

_PHASES = np.linspace(0.0, 2.0 * math.pi, 256, endpoint=False)


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


def _circle(body: BallBody, theta: Array | float, phi: Array) -> Array:
    """γ = cos θ ξ + sin θ (cos φ η + sin φ e3), shape (..., 3)."""
    xi, eta = line_of_rest(body)
    across = np.sin(theta) * np.cos(phi)
    return np.stack([np.cos(theta) * xi[0] + across * eta[0], np.cos(theta) * xi[1] + across * eta[1],
                     np.sin(theta) * np.sin(phi)], axis=-1)


def _speed_and_rate(strip: Strip, theta: Array) -> tuple[Array, Array]:
    """u and the mean of λ over one turn, on the circles θ (m,)."""
    body = strip.body
    xi, _ = line_of_rest(body)
    moment = body.I11 * xi[0] ** 2 + body.I22 * xi[1] ** 2 + body.D * np.sin(theta) ** 2
    gamma = np.moveaxis(_circle(body, theta[:, None], _PHASES), -1, 0)
    slowness = np.mean(1.0 / determinant(gamma, body.parameters), axis=1)
    return np.sqrt(2.0 * strip.h / moment), math.hypot(body.I13, body.I23) * np.sqrt(2.0 * strip.h * moment) * slowness


def ball_scattering(body: BallBody, theta_minus: float, phis: Sequence[float] | Array, h: float, distance: float,
                    level: Level) -> BallScattering:
    """θ⁺ for each phase φ of γ(0) = cos θ⁻ ξ + sin θ⁻ (cos φ η + sin φ e3), η = e3 × ξ.

    The motion starts with ω along ξ + distance·η and E = h, and is followed until γ has settled on a circle of N^s.
    distance : of either sign, for the two sides of N^u, 0 < |distance| ≤ 0.1.  The curve θ⁺(φ) of other distances is
    the same but for a shift of φ, the farther out the more turns γ has made; and for an error of the order of
    `distance` itself, which the estimates contain.
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
    if not 1e-15 <= abs(distance) <= 0.1:
        raise InvalidParameter(f"The distance from N^u is {distance:g}: choose it from 1e-15 to 0.1, or minus that.")

    gamma = _circle(body, theta_minus, phis)
    direction = xi + distance * eta
    omega = direction * np.sqrt(h / kinetic_energy((*direction, *gamma.T), body.parameters))[:, None]
    speeds, rates = _speed_and_rate(strip, np.array([theta_minus, *np.linspace(0.0, math.pi, 33)]))
    # Out of N^u at the rate of θ⁻, into N^s at that of the slowest circle; in between about e^1.4 each.
    span = math.log(4.0 / abs(distance)) / rates[0] + math.log(40.0 / level.promise) / rates.min()
    # Steps must be exact beside the small distance too, which decides when γ leaves; and other errors need room.
    rung = Level(level.name, 0.5 * level.promise, max(0.01 * abs(distance) * level.promise, REFERENCE.tolerance),
                 REFERENCE.order)
    found = ensemble(SYSTEM, np.hstack([omega, gamma]), body.parameters, [span], rung)
    end = found.states[:, 0]
    along, across = end[:, 2:4] @ xi, np.hypot(end[:, 2:4] @ eta, end[:, 4])
    theta_plus = np.arctan2(across, along)

    # What γ still turns towards ξ, ∫ (ω, η) dt ≈ (ω, η)/λ; the same before the start, whose own distance is rounded.
    _, last = _speed_and_rate(strip, theta_plus)
    before = (abs(distance) + 2e-16 / abs(distance)) * speeds[0] / rates[0]
    errors = found.errors + before + np.abs(end[:, :2] @ eta) / last
    wall_ms = (time.perf_counter() - start) * 1e3
    return BallScattering(float(theta_minus), frozen(phis), frozen(theta_plus), frozen(errors), level.name,
                          status_of(float(errors.max()), level), Cost(found.cost.steps, wall_ms))
