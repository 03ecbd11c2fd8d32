"""Circle maps: three orbits of `eq01`, from the section to the section, fix a Möbius map; and closed forms."""

import decimal
import math
from dataclasses import dataclass
from decimal import Decimal

import mpmath
import numpy as np
from scipy.special import ellipj

from hess_mechanics import systems
from oracle.kept import kept
from oracle.orbits import taylor


@dataclass(frozen=True)
class MoebiusMap:
    """z → (Az + B)/(B̄z + Ā), |A|² − |B|² = 1, z = e^{iφ}, in multiple precision."""

    A: mpmath.mpc
    B: mpmath.mpc

    def theta(self, phi):
        with mpmath.workdps(60):
            z = mpmath.expj(phi)
            return float(mpmath.arg((self.A * z + self.B) ** 2 / z))

    def slope(self, phi):
        """dΘ/dφ."""
        with mpmath.workdps(60):
            return float(1 / abs(self.A * mpmath.expj(phi) + self.B) ** 2)

    @property
    def digits(self):
        """The parts of A and B, as texts."""
        return [mpmath.nstr(part, 60) for end in (self.A, self.B) for part in (end.real, end.imag)]

    @property
    def log_trace(self):
        return float(mpmath.log(abs(2 * mpmath.re(self.A))))


def decimal_of(x):
    return Decimal(mpmath.nstr(x, mpmath.mp.dps))


def turning_roots(h, f):
    """n0 < n1 < n2 of 2(h + n)(1 − n²) = f², with the working precision of mpmath.

    By cosines of thirds of an angle, with three times the digits: it loses half of them where two roots are close; and
    300 more, so that a root at 0 is one as doubles.  `mpmath.polyroots` takes 5 to 200 times as long.
    """
    with mpmath.workprec(3 * mpmath.mp.prec + 1000):
        r = mpmath.sqrt(h * h + 3) / 3
        angle = mpmath.acos((9 * h - h**3 - 27 * f * f / 4) / (27 * r**3)) / 3
        roots = [2 * r * mpmath.re(mpmath.cos(angle - 2 * mpmath.pi * k / 3)) - h / 3 for k in range(3)]
    return sorted(+root for root in roots)


def roots_and_period(h, f):
    """n0 < n1 < n2 and one period of n3, with the working precision of mpmath."""
    n0, n1, n2 = turning_roots(h, f)
    return n0, n1, n2, 2 * mpmath.sqrt(2 / (n2 - n0)) * mpmath.ellipk((n2 - n1) / (n2 - n0))


THREE_PHASES = (-2, 0, 1)


def as_maps(texts):
    """The maps of these coefficients."""
    with mpmath.workdps(60):
        return [MoebiusMap(mpmath.mpc(*four[:2]), mpmath.mpc(*four[2:])) for four in texts]


@kept(as_maps)
def maps_by_three_orbits(tori, digits):
    """The maps of tori (a, h, f), doubles or texts, from where three orbits of `eq01` come back to the section."""
    start, parameters, periods = [], [], []
    with mpmath.workdps(digits), decimal.localcontext(prec=digits):
        for a, h, f in tori:
            _, n1, _, period = roots_and_period(mpmath.mpf(h), mpmath.mpf(f))
            rho = mpmath.sqrt(2 * (mpmath.mpf(h) + n1))
            nu = mpmath.mpf(f) / rho  # F2 = (w, n) = f, with n parallel to w at the turn
            for s, c in ((mpmath.sin(phi), mpmath.cos(phi)) for phi in THREE_PHASES):
                start.append([decimal_of(x) for x in (rho * s, rho * c, nu * s, nu * c, n1)])
                parameters.append([Decimal(a), Decimal(1)])
                periods.append(decimal_of(period))
        y, p, times = (np.array(values, dtype=object) for values in (start, parameters, [periods]))
        end = taylor(systems()["hess"].field, y.T, p.T, times, round(1.15 * digits), 10.0**-digits)[0]
        images = [mpmath.atan2(mpmath.mpf(str(w1)), mpmath.mpf(str(w2))) for w1, w2 in zip(*end[:2], strict=True)]
        return [moebius_map_through(images[i : i + 3]) for i in range(0, len(images), 3)]


def moebius_map_through(images):
    """The map that takes THREE_PHASES to these: arg(Az + B) = (Θ + φ)/2 is linear in Re A, Im A, Re B, Im B."""
    lines = []
    for phi, theta in zip(THREE_PHASES, images, strict=True):
        less, more = (phi - theta) / 2, (phi + theta) / 2
        lines.append([mpmath.sin(less), mpmath.cos(less), -mpmath.sin(more), mpmath.cos(more)])
    # The vector orthogonal to three vectors in four dimensions: their minors.
    minors = [(-1) ** j * mpmath.det(mpmath.matrix([line[:j] + line[j + 1 :] for line in lines])) for j in range(4)]
    A, B = mpmath.mpc(*minors[:2]), mpmath.mpc(*minors[2:])
    size = mpmath.sqrt(abs(A) ** 2 - abs(B) ** 2)
    A, B = A / size, B / size
    # By the reversor B is imaginary: its real part shows how many digits are left.
    assert abs(mpmath.re(B)) < 1e-17 * max(1, abs(mpmath.re(A))), "this map needs more digits"
    return MoebiusMap(A, B)


def map_by_three_orbits(a, h, f, digits):
    """The map of one torus."""
    return maps_by_three_orbits([(a, h, f)], digits)[0]


def map_of_vanishing_f(a, h, f=0.0):
    """f → 0+: a pendulum whose angle θ slides φ along, tan(φ/2 + π/4) → e^{−aΔθ} tan(φ/2 + π/4).

    Above the separatrix Δθ = 2π.  Below it the pendulum turns at cos θ = −h, and there φ jumps by −π: the section is
    in the middle of the jump.  Within |h − 1| ~ f of the separatrix (n1, n2) passes the saddle n3 = −1 on a hyperbola
    with semi-axes A, B, AB = f, B² − A² = 2e, e = h − 1, and w turns by −2 arctan(A/B).
    """
    with mpmath.workdps(60):
        excess, f = mpmath.mpf(h) - 1, mpmath.mpf(f)
        slide = mpmath.mpf(a) * (mpmath.pi if excess >= 0 else mpmath.acos(-mpmath.mpf(h)))
        # B² = e + √(e² + f²), without cancellation
        size = mpmath.hypot(excess, f)
        B_squared = excess + size if excess >= 0 else f * f / (size - excess)
        jump = 2 * mpmath.atan2(f, B_squared) if f else mpmath.pi * (excess < 0)
        return MoebiusMap(mpmath.cosh(slide) * mpmath.expj(-jump / 2), mpmath.mpc(0, -mpmath.sinh(slide)))


def stable_cycle(a, h, f, nodes=256):
    """(φ on the section, log of the trace) of a strongly attracting cycle, a > 0, in doubles.

    The periodic solution of φ̇ = −a|w| cos φ − f/|w|² by Fourier collocation and Newton's method: no stiffness however
    large a is.  The multiplier is the exponential of ∮ a|w| sin φ dt, and the trace twice the cosh of half of that.
    """
    with mpmath.workdps(40):
        n0, n1, n2, period = roots_and_period(mpmath.mpf(h), mpmath.mpf(f))
        gap, whole, top, period = (float(x) for x in (n2 - n1, n2 - n0, h + n2, period))
    # From the lower turn, half a period after n3 = n2.
    t = period * (np.arange(nodes) / nodes - 0.5)
    w_squared = 2 * (top - gap * ellipj(t * math.sqrt(whole / 2), gap / whole)[0] ** 2)
    drive, drift = a * np.sqrt(w_squared), f / w_squared
    waves = np.fft.fftfreq(nodes, 1 / nodes) * (np.arange(nodes) != nodes // 2)
    derivative = np.real(np.fft.ifft(2j * np.pi / period * waves[:, None] * np.fft.fft(np.eye(nodes), axis=0), axis=0))
    phi = np.full(nodes, -np.pi / 2)
    for _ in range(30):
        residual = derivative @ phi + drive * np.cos(phi) + drift
        change = np.linalg.solve(derivative - np.diag(drive * np.sin(phi)), residual)
        phi -= change
        if np.max(np.abs(change)) < 1e-14:
            break
    log_multiplier = period * np.mean(drive * np.sin(phi))
    return float(phi[0]), -log_multiplier / 2 + math.log1p(math.exp(log_multiplier))
