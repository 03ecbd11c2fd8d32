"""Scattering θ⁻ → θ⁺ of the Chaplygin ball with Suslov's constraint, without a field (`eq29`, b = 0).

On N^u and N^s ω = ±uξ is constant and γ rotates about ξ on a circle, cos θ = (γ, ξ).  In the transversal direction the
motion departs from N^u and approaches N^s at the rate, with J = √(I13² + I23²) and I_ξ = I11 ξ1² + I22 ξ2²,

    λ = J √(2h (I_ξ + 𝒟 sin²θ)) / det Î,   u = √(2h / (I_ξ + 𝒟 sin²θ)).

A motion with ω = u(ξ + δη) + … has departed from its circle by a term of first order in δ, found by integrating back
along N^u, where φ decreases at the rate u.  With μ(φ) = λ/u and

    H(φ) = ∫_0^∞ exp(iφ + is − ∫_0^s μ(φ + s') ds') ds

it is γ = γ_circle + δ v, (v, ξ) = −sin θ Im H, (v, η) + i(v, e3) = i cos θ e^{iφ} H̄.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody, determinant, kinetic_energy
from hess_mechanics.dynamics.ensemble import complete, ensemble
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import REFERENCE, STANDARD, Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Complex, Cost, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.free import vertical
from hess_mechanics.suslov.scattering import scattering

__all__ = ["BallScattering", "all_phases", "ball_scattering", "free_theta_plus", "start", "starts"]

MAX_STEPS = 20_000_000
_MOST_SWING = 300.0
_MOST_TURN = 0.3
"""Largest angle from the circle up to which the first order in the distance is used."""
_TINY = 1e-280
"""Lower bound on a rate, whose inverse would otherwise overflow."""
_STEPS = 2.0
"""Taylor steps of both runs per time 1/ν, at a tolerance of 1e-9 and the order of `REFERENCE`."""


@dataclass(frozen=True)
class BallScattering(Result):
    """Circles θ⁺ that motions from the circle θ⁻ of N^u approach; the result of `ball_scattering`.

    Attributes
    ----------
    theta_minus : float
        Angle θ⁻ of the initial circle in radians, 0 to π.
    phis : ndarray of float, shape (n,)
        Phases φ of γ at the start in radians.
    theta_plus : ndarray of float, shape (n,)
        Angles θ⁺ in [0, π], in radians.
    errors : ndarray of float, shape (n,)
        Estimated errors of θ⁺ in radians.
    level : str
        Name of the accuracy level.
    status : Status
        State of the computation, see `Status`.
    cost : Cost
        Steps and time of the computation.
    """

    theta_minus: float
    phis: Array
    theta_plus: Array
    errors: Array
    level: str
    status: Status
    cost: Cost

    def labels(self) -> Labels:
        """Return the scattering with names, units and coordinates.

        Returns
        -------
        Labels
            The angle θ⁺ and its error over φ.
        """
        return Labels(
            {"φ": (("φ",), self.phis)},
            {"θ⁺": (("φ",), self.theta_plus), "error": (("φ",), self.errors)},
            {"φ": "rad", "θ⁺": "rad", "error": "rad"},
            {"θ⁻": self.theta_minus, "level": self.level, "status": str(self.status), "steps": self.cost.steps},
        )

    @property
    def curve(self) -> Array:
        """The points (φ, θ⁺) in rows (n, 2)."""
        return np.column_stack([self.phis, self.theta_plus])

    def theta_plus_at(self, phi: float) -> float:
        """Return θ⁺ at a phase by linear interpolation; `phis` must increase.

        Parameters
        ----------
        phi : float
            Phase φ in radians; beyond the ends of `phis` θ⁺ keeps its value at the end.

        Returns
        -------
        float
            The angle θ⁺ in radians.
        """
        return float(np.interp(phi, self.phis, self.theta_plus))


def _phases(body: BallBody) -> Array:
    """Return equidistant phases that resolve the peak of λ at γ3 = 0, of width √(I/(I+𝒟))."""
    width = 1.0 / math.sqrt(1.0 + body.D / min(body.I11, body.I22))
    count = 2 ** math.ceil(math.log2(min(64.0 / width, 8192.0)))
    return np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)


def _moment(body: BallBody, theta: Array | float) -> Array:
    """Return (ξ, Îξ) on the circles θ."""
    xi, _ = line_of_rest(body)
    return np.asarray(body.I11 * xi[0] ** 2 + body.I22 * xi[1] ** 2 + body.D * np.sin(theta) ** 2, float)


def _growth(body: BallBody, theta: Array, phi: Array) -> Array:
    """Return μ = λ/u on the circles θ (m,) at the phases φ (n,), shape (m, n)."""
    theta = theta[:, None]
    gamma = vertical(line_of_rest(body)[0], np.cos(theta), np.sin(theta) * np.exp(1j * phi))
    inertia = determinant(list(np.moveaxis(gamma, -1, 0)), body.parameters)
    growth: Array = math.hypot(body.I13, body.I23) * _moment(body, theta) / inertia
    return np.maximum(growth, _TINY, out=growth)


def _lag(body: BallBody, theta: float, phis: Array) -> Complex | None:
    """Return H (n,) at the phases φ (n,); None if e^∫μ overflows."""
    grid = _phases(body)
    growth = np.fft.fft(_growth(body, np.array([theta]), grid)[0]) / grid.size
    order = np.fft.fftfreq(grid.size, 1.0 / grid.size)
    mean = growth[0].real
    wave = np.divide(growth, 1j * order, out=np.zeros_like(growth), where=order != 0.0)
    # The integral ∫(μ − mean) is periodic, so the remaining integrand is a periodic function times e^(−mean s).
    swing = np.fft.ifft(wave * grid.size).real
    if np.ptp(swing) > _MOST_SWING:
        return None
    parts = np.fft.fft(np.exp(1j * grid - swing)) / grid.size / (mean - 1j * order)
    swings, rest = (np.exp(1j * np.outer(phis, order)) @ np.column_stack([wave, parts])).T
    return np.asarray(np.exp(swings.real) * rest, complex)


def starts(strip: Strip, theta: float, phis: Array, distance: float) -> tuple[Array, Array]:
    """Return initial states of motions from the circle θ of N^u, and bounds on the errors of θ.

    ω is along ξ + distance·η.  γ is at φ on the circle up to a term of the order of `distance`, see the module.

    Parameters
    ----------
    strip : Strip
        The strip of the ball.
    theta : float
        Angle θ of the circle, in radians, 0 to π.
    phis : ndarray, shape (n,)
        Phases φ, in radians.
    distance : float
        Distance from N^u, nonzero.

    Returns
    -------
    states : ndarray, shape (n, 5)
        States (ω1, ω2, γ1, γ2, γ3).
    errors : ndarray, shape (n,)
        Bounds on the difference between θ and the angle of the circle from which each motion comes, in radians, ≤ π.

    Raises
    ------
    InvalidParameter
        If I13 = I23 = 0.
    """
    body = strip.body
    xi, eta = line_of_rest(body)
    lag = _lag(body, theta, phis)
    reach = 1.0 / float(_growth(body, np.array([theta]), _phases(body)).min())
    known = lag is not None and abs(distance) * float(np.max(np.abs(lag))) < _MOST_TURN
    H = lag if lag is not None and known else np.zeros(phis.size, complex)
    z = math.sin(theta) * np.exp(1j * phis) + 1j * distance * math.cos(theta) * np.exp(1j * phis) * H.conj()
    gamma = vertical(xi, math.cos(theta) - distance * math.sin(theta) * H.imag, z)
    gamma /= np.linalg.norm(gamma, axis=1)[:, None]
    direction = xi + distance * eta
    omega = direction * np.sqrt(strip.h / kinetic_energy((*direction, *gamma.T), body.parameters))[:, None]
    left = (distance * (1.0 + np.abs(H))) ** 2 if known else abs(distance) * reach
    return np.hstack([omega, gamma]), np.minimum(left + 2e-16 / abs(distance) * reach, math.pi) + np.zeros(phis.size)


def start(body: BallBody, h: float, theta: float, phi: float, distance: float) -> tuple[float, ...]:
    """Return the initial state of a motion from a circle of N^u, see `starts`.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0.
    h : float
        Energy, h > 0.
    theta : float
        Angle θ of the circle, in radians, 0 to π.
    phi : float
        Phase φ, in radians.
    distance : float
        Distance from N^u, nonzero.

    Returns
    -------
    tuple of five floats
        State (ω1, ω2, γ1, γ2, γ3).

    Raises
    ------
    InvalidParameter
        If the ball has a field, h ≤ 0, or I13 = I23 = 0.
    """
    states, _ = starts(Strip(body, h), theta, np.array([phi]), distance)
    return tuple(map(float, states[0]))


def free_theta_plus(body: BallBody, theta: float, distance: float, phis: tuple[float, ...]) -> Array:
    """Return the angles θ⁺ of the free Suslov problem with the same tensor, 𝒟 = 0.

    Parameters
    ----------
    body : BallBody
        The ball.
    theta : float
        Angle θ⁻ of the initial circle, in radians, 0 to π.
    distance : float
        Distance of the start from the unstable point, positive.
    phis : tuple of float
        Phases φ, in radians.

    Returns
    -------
    ndarray, shape (n,)
        Angles θ⁺ in [0, π], in radians.

    Raises
    ------
    InvalidParameter
        If an argument is out of range, or I13 = I23 = 0.
    WorkLimit
        If γ rotates too often during the passage.
    """
    free = SuslovBody(body.I11, body.I22, body.I13, body.I23)
    return as_read_only(scattering(free, STANDARD, 1, distance).theta_plus(theta, np.array(phis)))


def _rates(strip: Strip, theta: Array) -> Array:
    """Return the mean of λ over one turn (m,) on the circles θ (m,)."""
    growth = np.mean(_growth(strip.body, theta, _phases(strip.body)), axis=1)
    return np.asarray(np.sqrt(2.0 * strip.h / _moment(strip.body, theta)) * growth)


def ball_scattering(
    body: BallBody,
    theta_minus: float,
    phis: Sequence[float] | Array,
    h: float,
    distance: float,
    accuracy: Accuracy,
    max_steps: float = MAX_STEPS,
) -> BallScattering:
    """Return the circles that motions from one circle of N^u approach, over the phase at the start.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0 and I13 or I23 nonzero.
    theta_minus : float
        Angle θ⁻ between γ and ξ on the initial circle in radians, 0 ≤ θ⁻ ≤ π.
    phis : array_like of float, shape (n,)
        Phases φ in radians: γ(0) ≈ cos θ⁻ ξ + sin θ⁻ (cos φ η + sin φ e3), η = e3 × ξ.
    h : float
        The energy, h > 0.
    distance : float
        Distance of the start from N^u: ω(0) is along ξ + distance·η.  Its sign selects the side; 1e-10 ≤ |distance| ≤
        0.1.
    accuracy : str or Level
        Accuracy level or its name, see `level`.
    max_steps : float, optional
        Limit on the steps of all motions together, positive; they are estimated beforehand.

    Returns
    -------
    BallScattering
        The angles θ⁺ and their errors.

    Raises
    ------
    InvalidParameter
        If an argument is out of range, the ball has a field, or I13 = I23 = 0.
    WorkLimit
        If the motions need more than `max_steps` steps.

    Notes
    -----
    The motion is followed until γ has settled on a circle of N^s.  Another distance shifts the curve θ⁺(φ) along φ, by
    the rotation of γ in between, up to an error of order distance², which the estimates include.

    References
    ----------
    `eq29`, figure 10.

    Examples
    --------
    >>> from hess_mechanics import BallBody, ball_scattering
    >>> body = BallBody(3.56, 1.0, 0.0, 0.8, 1.0)
    >>> ball_scattering(body, 1.0, [0.0, 1.0], 1.0, 1e-6, "standard").theta_plus.round(4)
    array([2.0347, 2.1257])
    """
    level = as_level(accuracy)
    start = time.perf_counter()
    strip = Strip(body, h)
    xi, eta = line_of_rest(body)
    phis = np.array(phis, float, ndmin=1)
    require_finite(theta_minus=theta_minus, distance=distance)
    if phis.ndim != 1 or phis.size == 0 or not np.all(np.isfinite(phis)):
        raise InvalidParameter("The phases φ are not a list of finite numbers: give one or more finite numbers.")
    if not 0.0 <= theta_minus <= math.pi:
        raise InvalidParameter(f"θ⁻ = {theta_minus:g}, but it is an angle between two vectors: choose 0 ≤ θ⁻ ≤ π.")
    if not 1e-10 <= abs(distance) <= 0.1:
        raise InvalidParameter(f"The distance from N^u is {distance:g}: choose it from 1e-10 to 0.1, of either sign.")

    states, before = starts(strip, theta_minus, phis, distance)
    rates = _rates(strip, np.array([theta_minus, *np.linspace(0.0, math.pi, 33)]))
    # Time of departure from N^u at the rate of θ⁻, plus time of approach to N^s at that of the slowest circle.  The
    # factors 4 and 40 allow for the passage between them.
    with np.errstate(divide="ignore"):
        span = math.log(4.0 / abs(distance)) / rates[0] + math.log(40.0 / level.promise) / rates.min()
    # Steps must resolve the small distance, which determines the departure; the other half of the promise covers other
    # errors.
    tight = Level(
        level.name, 0.5 * level.promise, max(0.01 * abs(distance) * level.promise, REFERENCE.tolerance), REFERENCE.order
    )
    nu = float(np.max(SYSTEM.frequency(states.T, np.array(body.parameters))))
    steps = _STEPS * (1e-9 / tight.tolerance) ** (1.0 / tight.order) * (nu + rates.max()) * span * phis.size
    if not steps <= max_steps:
        raise WorkLimit(
            f"θ⁺ takes about {steps:.0e} steps: choose fewer phases, a cheaper accuracy, larger |I13| or "
            "|I23|, or a smaller 𝒟."
        )
    orbits = complete(ensemble(body, states, [span], tight))
    end = orbits.states[:, 0]
    along, across = end[:, 2:4] @ xi, np.hypot(end[:, 2:4] @ eta, end[:, 4])
    theta_plus = np.arctan2(across, along)

    # The angle by which θ would still change, ∫ (ω, η) dt ≈ (ω, η)/λ.
    errors = orbits.errors + before + np.abs(end[:, :2] @ eta) / _rates(strip, theta_plus)
    wall_ms = (time.perf_counter() - start) * 1e3
    return BallScattering(
        float(theta_minus),
        as_read_only(phis),
        as_read_only(theta_plus),
        as_read_only(errors),
        level.name,
        level.status(float(errors.max())),
        Cost(orbits.cost.steps, wall_ms),
    )


def all_phases(
    body: BallBody, theta_minus: float, count: int, distance: float, accuracy: Accuracy, max_steps: float
) -> BallScattering:
    """Return the scattering at equidistant phases from −π to π, both included; θ⁺ does not depend on the energy.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0 and I13 or I23 nonzero.
    theta_minus : float
        Angle θ⁻ of the initial circle, in radians, 0 to π.
    count : int
        Number of phases.
    distance : float
        Distance of the start from N^u, as in `ball_scattering`.
    accuracy : str or Level
        Accuracy level.
    max_steps : float
        Limit on the steps of all motions together, which are estimated beforehand.

    Returns
    -------
    BallScattering
        The angles θ⁺ and their errors.

    Raises
    ------
    InvalidParameter
        As `ball_scattering`.
    WorkLimit
        As `ball_scattering`.
    """
    return ball_scattering(body, theta_minus, np.linspace(-math.pi, math.pi, count), 1.0, distance, accuracy, max_steps)
