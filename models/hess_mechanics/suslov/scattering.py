"""Scattering (θ⁻, φ) → θ⁺ of the free Suslov problem, as one rotation (figure 4).

Every motion departs from a circle Γ⁻ = cos θ⁻ about the unstable point and approaches a circle Γ⁺ = cos θ⁺ about the
stable one.  With (A, B) of `free` from one end to the other

    Γ⁺ = cos χ Γ⁻ + sin χ √(1−Γ⁻²) cos(φ − φ*),   cos χ = |A|² − |B|²,  φ* = π − arg AB.

The phase φ has two meanings:
 - asymptotic: the limit t → −∞ of (azimuth of γ about ξ) + Φ(u), that is, the azimuth at u = 0 if only the component
   of ω along ξ had rotated γ;
 - at the start: the azimuth of γ(0) about ξ, with ω(0) at a given distance from the unstable point (caption of
   `fig0111`) and θ⁻ the angle between γ(0) and ξ.  For small distances that is the same curve, shifted by Φ(u0).
The azimuth is counted from η towards e3: γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3).  Nothing depends on h.

cos χ has a closed form for every tensor.  In s = sinh u the equations have three regular singular points, ±i and ∞:
about i the monodromy has the trace 2C, C = cos(π/2 √(κ² − (K + ic)²)), and along the half circle at ∞ it is diagonal,
e^{±πK/2}.  Hence |A|² = (Re C/cosh(πK/2))² + (Im C/sinh(πK/2))².  For I13 = 0 or I23 = 0, c = 0 and k² = κ² − K²,
and cos χ = 2cos²(πk/2)/cosh²(πK/2) − 1.  This formula is not in the paper: see models/README.md.
"""

from __future__ import annotations

import cmath
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.cells import centres
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import Accuracy, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Cost, as_read_only, facts_of
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov.additional_integral import I11_at
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.free import PassageConstants, equilibria, shape, transfer, vertical

__all__ = ["Scattering", "cos_chi", "cos_chi_over", "scattering", "start", "theta_plus_grid"]


@dataclass(frozen=True)
class Scattering(Result):
    """Rotation from the circles S₋ to the circles S₊ along one arc; the result of `scattering`.

    Attributes
    ----------
    level : str
        Name of the accuracy level.
    A : complex
        Element of the matrix ((A, −B̄), (B, Ā)) of SU(2), in the frame rotated by Φ.
    B : complex
        The other element.
    cos_chi : float
        Coefficient cos χ, −1 to 1, see Notes.
    sin_chi : float
        Coefficient sin χ, 0 to 1, see Notes.
    phi_star : float
        Phase φ* in radians, −π to π, see Notes; 0 if sin χ = 0.
    status : Status
        State of the computation, see `Status`.
    error_estimate : float
        Estimated error of Γ⁺, 0 to 2, for any θ⁻ and φ.
    cost : Cost
        Steps and time of the computation.

    Notes
    -----
    cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*).
    """

    level: str
    A: complex
    B: complex
    cos_chi: float
    sin_chi: float
    phi_star: float
    status: Status
    error_estimate: float
    cost: Cost

    def labels(self) -> Labels:
        """Return the scattering with names, units and coordinates.

        Returns
        -------
        Labels
            The angle θ⁺ over 91 angles θ⁻ from 0 to π and 181 phases φ from −π to π.
        """
        theta, phi = np.linspace(0.0, math.pi, 91), np.linspace(-math.pi, math.pi, 181)
        return Labels(
            {"θ⁻": (("θ⁻",), theta), "φ": (("φ",), phi)},
            {"θ⁺": (("θ⁻", "φ"), self.theta_plus(theta[:, None], phi[None, :]))},
            {"θ⁻": "rad", "φ": "rad", "θ⁺": "rad"},
            {"cos χ": self.cos_chi, "φ*": self.phi_star, **facts_of(self)},
        )

    def theta_plus(self, theta: Array | float, phi: Array | Sequence[float] | float) -> Array:
        """Return the outgoing angle θ⁺.

        Parameters
        ----------
        theta : array_like of float
            Incoming angle θ⁻ in radians.
        phi : array_like of float
            Phase φ in radians; it broadcasts with theta.

        Returns
        -------
        ndarray of float
            Angles in [0, π], of the common shape of θ⁻ and φ.

        Examples
        --------
        >>> from hess_mechanics import SuslovBody, scattering
        >>> round(float(scattering(SuslovBody(4.0, 1.0, 0.0, 0.75), "precise").theta_plus(1.0, 0.5)), 6)
        2.317184
        """
        theta, phi, A, B = np.asarray(theta, float), np.asarray(phi, float), self.A, self.B
        Gamma, y = np.cos(theta), np.sin(theta) * np.exp(1j * phi)
        image = 2.0 * A * B.conjugate() * Gamma + A * A * y - B.conjugate() ** 2 * y.conj()
        # The arc cosine would lose half the digits at 0 and π.
        return np.asarray(np.arctan2(np.abs(image), self.cos_chi * Gamma - 2.0 * np.real(A * B * y)), float)


def _u_at(of: PassageConstants, distance: float) -> float:
    """Return the u < 0 at which the component of ω across ξ, ω0 κ sech u, is `distance` |ω⁻| = `distance` ω0 K.

    Raises `InvalidParameter` if ω never gets that far from the line of equilibria.
    """
    require_finite(distance=distance)
    most = of.kappa / of.K
    if not 0.0 < distance <= most:
        raise InvalidParameter(
            f"The distance {distance:g} of the start from the unstable point is not on the arc: choose one above 0 and "
            f"up to {most:.6g}, in units of the angular velocity there."
        )
    ratio = of.K / of.kappa * distance
    if ratio < 1e-8:
        return math.log(0.5) + math.log(of.K / of.kappa) + math.log(distance)
    return -math.acosh(max(1.0, 1.0 / ratio))


def _check_arc(arc: int) -> None:
    if arc not in (1, -1):
        raise InvalidParameter(f"arc = {arc}: choose 1 or −1, the sign of I13ω1 + I23ω2 on the arc.")


def scattering(body: SuslovBody, accuracy: Accuracy, arc: int = 1, distance: float | None = None) -> Scattering:
    """Return the scattering of γ along one arc of the motion of ω.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    accuracy : str or Level
        Accuracy level or its name, see `level`.
    arc : {1, -1}, default 1
        Arc σ, the sign of I13ω1 + I23ω2.
    distance : float, optional
        Component of ω across ξ at the start, in units of |ω⁻|, above 0 and at most κ/K; for I13 = 0 it is |ω2(0)|/|ω⁻|.
        Then φ and θ⁻ belong to the start.  By default they are asymptotic.

    Returns
    -------
    Scattering
        The rotation and its angle χ.

    Raises
    ------
    InvalidParameter
        If the body has a field, I13 = I23 = 0, or the arc or the distance is impossible.
    WorkLimit
        If γ rotates too often during the passage, see `shape`.

    Notes
    -----
    The error is estimated as in `solve`.

    References
    ----------
    `fig0111`.  The closed form of cos χ is not in the paper, see models/README.md.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, scattering
    >>> result = scattering(SuslovBody(4.0, 1.0, 0.0, 0.75), "precise")
    >>> round(result.cos_chi, 6)
    -0.907965
    """
    level = as_level(accuracy)
    begun = time.perf_counter()
    _check_arc(arc)
    of = shape(body)
    first = -of.end if distance is None else _u_at(of, float(distance))
    A, B, error, steps = transfer(of, arc, np.array([first, of.end]), level)
    # Transform the azimuth at the start to the rotating frame.
    before = 0.0 if distance is None else float(of.angle(first, arc))
    half = cmath.exp(0.5j * before)
    alpha, beta = complex(A[1]) * half, complex(B[1]) * half
    error += 3e-16 * abs(before)
    cosine, sine = abs(alpha) ** 2 - abs(beta) ** 2, 2.0 * abs(alpha) * abs(beta)
    phi_star = cmath.phase(-(alpha * beta).conjugate()) if sine > 0.0 else 0.0
    wall_ms = (time.perf_counter() - begun) * 1e3
    return Scattering(
        level.name,
        alpha,
        beta,
        min(1.0, max(-1.0, cosine)),
        min(1.0, sine),
        phi_star,
        level.status(error),
        min(error, 2.0),
        Cost(steps, wall_ms),
    )


def cos_chi(body: SuslovBody) -> float:
    """Return cos χ in closed form, for any inertia tensor; see the module.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.

    Returns
    -------
    float
        The cosine of the angle χ, −1 to 1.

    Raises
    ------
    InvalidParameter
        If the body has a field, or I13 = I23 = 0.
    WorkLimit
        If γ rotates too often during a passage, see `shape`.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, cos_chi
    >>> round(cos_chi(SuslovBody(2.0, 1.0, 0.3, 0.5)), 6)
    -0.956593
    """
    of = shape(body)
    root = cmath.sqrt(of.kappa**2 - complex(of.K, of.c) ** 2)
    # Factor out the exponential growth of cos(π/2 root) and cosh(πK/2), which would overflow.
    angle = 0.5 * math.pi * root
    grown = abs(angle.imag)
    C_re = math.cos(angle.real) * 0.5 * (1.0 + math.exp(-2.0 * grown))
    C_im = math.sin(angle.real) * math.copysign(0.5 * math.expm1(-2.0 * grown), angle.imag)
    height = 0.5 * math.pi * of.K
    factor = math.exp(grown - height)
    A_re = factor * 2.0 * C_re / (1.0 + math.exp(-2.0 * height))
    A_im = factor * 2.0 * C_im / -math.expm1(-2.0 * height) if C_im else 0.0
    return min(1.0, 2.0 * (A_re**2 + A_im**2) - 1.0)


def cos_chi_over(low: int, high: int, I22: float, I13: float, I23: float) -> Array:
    """Return cos χ in closed form over k in steps of 0.05, with I11 from `I11_at`.

    Parameters
    ----------
    low, high : int
        First and last k, both included; low ≤ high.
    I22 : float
        Moment of inertia about the second axis, I22 > 0.
    I13, I23 : float
        Products of inertia, in the unit of I22.

    Returns
    -------
    ndarray, shape (m, 2)
        Values of k and cos χ; a k with I11 ≤ 0, or for which `cos_chi` raises an error, is left out.
    """
    rows = []
    for one in np.linspace(low, high, 20 * (high - low) + 1).tolist():
        try:
            rows.append((one, cos_chi(SuslovBody(I11_at(one, I22, I13, I23), I22, I13, I23))))
        except ModelError:
            continue
    return as_read_only(np.array(rows).reshape(-1, 2))


def theta_plus_grid(rotation: Scattering, m: int, n: int) -> Array:
    """Return θ⁺ at the centres of the cells of −π < φ < π, 0 < θ⁻ < π.

    Parameters
    ----------
    rotation : Scattering
        The scattering.
    m, n : int
        Number of cells in φ and in θ⁻.

    Returns
    -------
    ndarray, shape (n, m)
        Angles θ⁺ in radians; rows have increasing θ⁻, columns increasing φ.
    """
    phi, theta = centres(-math.pi, math.pi, m), centres(0.0, math.pi, n)
    return as_read_only(rotation.theta_plus(theta[:, None], phi[None, :]))


def start(
    body: SuslovBody, h: float, theta: float, phi: float, distance: float, arc: int = 1
) -> tuple[tuple[float, float], tuple[float, float, float]]:
    """Return the initial ω and γ of the orbit that starts at given angles and distance from the unstable point.

    For I13 I23 ≠ 0 the rounding of ω to doubles limits the accuracy of the time of the passage: below a distance of
    1e-8 the phase of arrival shifts, and Γ⁺ by at most 1e-16/distance.

    Parameters
    ----------
    body : SuslovBody
        Body with b = 0, and I13 or I23 nonzero.
    h : float
        Energy, h > 0.
    theta : float
        Incoming angle θ⁻, in radians.
    phi : float
        Azimuth φ, in radians: the phase of `scattering` with this distance.
    distance : float
        Component of ω across ξ, in units of |ω⁻|, above 0 and at most κ/K.
    arc : {1, -1}, default 1
        Arc σ, the sign of I13ω1 + I23ω2.

    Returns
    -------
    omega : tuple of two floats
        Angular velocity (ω1, ω2), in rad/T.
    gamma : tuple of three floats
        Vertical γ.

    Raises
    ------
    InvalidParameter
        If a number is out of range, the body has a field, or I13 = I23 = 0.
    WorkLimit
        If γ rotates too often during the passage, see `shape`.
    """
    _check_arc(arc)
    require_finite(theta=theta, phi=phi)
    of, line = shape(body), equilibria(body, h)
    u = _u_at(of, float(distance))
    sech, tanh = of.K / of.kappa * distance, math.tanh(u)
    omega = line.rate * ((arc * of.c * sech - of.K * tanh) * of.xi + arc * of.kappa * sech * of.eta)
    g1, g2, g3 = vertical(of.xi, math.cos(theta), cmath.rect(math.sin(theta), phi)).tolist()
    return (float(omega[0]), float(omega[1])), (g1, g2, g3)
