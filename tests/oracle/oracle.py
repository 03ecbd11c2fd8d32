"""Independent answers with more digits than a double has.

Orbits: Taylor series of a system's plain `field` in whatever arithmetic the numbers bring: `np.longdouble` for many
orbits at once, `decimal.Decimal` for as many digits as one likes.  Circle maps: three such orbits of `eq01`, from the
section to the section, fix a Möbius map; and closed forms where there are any.  No kernel of `models` enters.

What took long is kept in "oracle_values.json", by its arguments, and only looked up: `make_oracle_values.py` finds it
anew.
"""

import decimal
import json
import math
import time
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import reduce, wraps
from operator import mul
from pathlib import Path

import mpmath
import numpy as np
from scipy.special import ellipj

from hess_mechanics import systems
from hess_mechanics.dynamics.system import System

# ---- what is kept -----------------------------------------------------------------------------------------------

KEPT_IN = Path(__file__).with_name("oracle_values.json")
KEPT = json.loads(KEPT_IN.read_text()) if KEPT_IN.exists() else {}
"""Question → [seconds that it took, answer]; a question is the name of a function with its arguments, as JSON."""
ANSWERED = {}
"""The same of what had to be computed."""
FUNCTIONS = {}


def plain(value):
    """A value as JSON has it, with all its digits."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, MoebiusMap):
        return [mpmath.nstr(part, 60) for end in (value.A, value.B) for part in (end.real, end.imag)]
    if isinstance(value, System):
        return value.name
    return str(value) if isinstance(value, Decimal) else value


def kept(read):
    """A function whose answers are looked up where they are kept; `read` makes an answer of what JSON has."""
    def of(function):
        @wraps(function)
        def answer(*arguments, **named):
            question = json.dumps([function.__name__, *map(plain, arguments), *map(plain, named.values())])
            if question in KEPT:
                return read(KEPT[question][1])
            start = time.process_time()
            found = function(*arguments, **named)
            ANSWERED[question] = [round(time.process_time() - start, 1), found]
            return found

        FUNCTIONS[function.__name__] = function
        return answer

    return of


def found_anew(question):
    """The answer to a question, as JSON has it."""
    name, *arguments = json.loads(question)
    if name == "orbit_in_decimals":
        arguments[0] = systems()[arguments[0]]
    return plain(FUNCTIONS[name](*arguments))


# ---- Taylor series of any field, in any arithmetic --------------------------------------------------------------


class Series:
    """A power series in time, for many orbits at once, whose coefficients are found when they are asked for.

    `rule(k)` is coefficient k (one number for each orbit), from coefficients that are known by then.
    """

    __array_ufunc__ = None  # an array on the left of an operator leaves the work to the series

    def __init__(self, rule, shape, dtype):
        self.rule, self.c, self.known = rule, np.empty(shape, dtype), 0

    def upto(self, k):
        """All coefficients, filled up to order k."""
        while self.known <= k:
            self.c[self.known] = self.rule(self.known)
            self.known += 1
        return self.c

    def like(self, rule):
        return Series(rule, self.c.shape, self.c.dtype)

    def lifted(self, other):
        """`other` as a series: a number is one whose higher coefficients vanish."""
        if isinstance(other, Series):
            return other
        return self.like(lambda k: self.upto(0)[0] * 0 + (other if k == 0 else 0))

    def __neg__(self):
        return self.like(lambda k: -self.upto(k)[k])

    def __add__(self, other):
        other = self.lifted(other)
        return self.like(lambda k: self.upto(k)[k] + other.upto(k)[k])

    __radd__ = __add__

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if isinstance(other, Series):
            return self.like(lambda k: folded(self.upto(k)[: k + 1], other.upto(k)[: k + 1]))
        return self.like(lambda k: self.upto(k)[k] * other)

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Series):
            return self.like(lambda k: self.upto(k)[k] / other)

        def rule(k):
            known = folded(other.upto(k)[1:], quotient.c[:k]) if k else 0
            return (self.upto(k)[k] - known) / other.upto(0)[0]

        quotient = self.like(rule)
        return quotient

    def __rtruediv__(self, other):
        return self.lifted(other) / self

    def __pow__(self, exponent):
        return reduce(mul, [self] * exponent)


def folded(left, right):
    """Σ left[m] right[k−m], over the k+1 coefficients that `right` has."""
    left = left[: len(right)]
    if left.dtype == object:
        return (left * right[::-1]).sum(axis=0)
    return np.einsum("kl,kl->l", left, right[::-1])


def coefficients(field, y, p, order):
    """Taylor coefficients of ẏ = field(y, p), shape (d, order + 1, orbits), for y (d, orbits) and p (q, orbits)."""
    rates = []

    def variable(i):
        return Series(lambda k: y[i] if k == 0 else rates[i].upto(k - 1)[k - 1] / k, (order + 1, y.shape[1]), y.dtype)

    variables = [variable(i) for i in range(len(y))]
    rates.extend(variables[0].lifted(rate) for rate in field(variables, list(p)))
    return np.array([series.upto(order) for series in variables])


def taylor(field, y, p, times, order, tolerance):
    """States (n, d, orbits) at times (n, orbits), from y (d, orbits) at t = 0, in the arithmetic of these arrays.

    Every orbit has steps of its own: so long that the last two terms equal the tolerance (relative to a component
    where that exceeds 1).  Nothing is interpolated: steps end at the times.
    """
    number = Decimal if y.dtype == object else y.dtype.type
    y, t, out = y.copy(), times[0] * 0, []
    for target in times:
        while (moving := np.flatnonzero(t != target)).size:
            c = coefficients(field, y[:, moving], p[:, moving], order)
            size = np.maximum(np.abs(c[:, 0]).astype(float), 1.0)
            step = np.full(moving.size, np.inf)
            for k in (order - 1, order):
                last = (np.abs(c[:, k]).astype(np.longdouble) / size).max(axis=0)
                assert np.all(last < np.inf), "a coefficient beyond range: measure time in other units"
                step = np.minimum(step, (tolerance / np.maximum(last, 1e-300)) ** (1 / k))
            left = target[moving] - t[moving]
            h = np.array([x if abs(x) <= s else number(math.copysign(s, x))
                          for x, s in zip(left, step.astype(float), strict=True)])
            total = c[:, order]
            for k in range(order - 1, -1, -1):
                total = total * h + c[:, k]
            y[:, moving] = total
            t[moving] = np.where(h == left, target[moving], t[moving] + h)
        out.append(y.copy())
    return np.array(out)


def uncompiled(field):
    """The description of a field with plain functions, which take numbers of any kind."""
    constants = field.constants and (field.constants[0], field.constants[1].py_func)
    stages = tuple((names, rule.py_func) for names, rule in field.stages)
    return replace(field, rates=field.rates.py_func, stages=stages, constants=constants)


def as_decimals(values):
    """The same numbers, exactly, as decimals."""
    return np.vectorize(Decimal, otypes=[object])(np.asarray(values, dtype=object))


def as_long_doubles(texts):
    """The numbers of these texts, not by way of doubles."""
    return np.vectorize(np.longdouble, otypes=[np.longdouble])(np.array(texts))


def orbits_in_long_double(system, states, parameters, times):
    """Many orbits at once: states (orbits, d), parameters (orbits, q), times (orbits, n) → (orbits, n, d)."""
    y, p, t = (np.asarray(values, np.longdouble).T for values in (states, parameters, times))
    return np.moveaxis(taylor(system.field, y, p, t, order=28, tolerance=1e-22), -1, 0)


@kept(as_decimals)
def orbit_in_decimals(system, state, parameters, times, digits):
    """One orbit (n, d) with so many digits in each step; an unstable motion loses some of them."""
    with decimal.localcontext(prec=digits):
        y, p = (as_decimals(np.reshape(values, (-1, 1)).tolist()) for values in (state, parameters))
        t = as_decimals(np.reshape(times, (-1, 1)).tolist())
        return taylor(system.field, y, p, t, order=round(1.15 * digits), tolerance=10.0**-digits)[:, :, 0]


def distances(computed, exact):
    """|computed − exact| as doubles, without first rounding what is exact."""
    computed = as_decimals(np.asarray(computed).tolist()) if exact.dtype == object else computed.astype(exact.dtype)
    return np.abs(computed - exact).astype(float)


# ---- circle maps ------------------------------------------------------------------------------------------------


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
    def log_trace(self):
        return float(mpmath.log(abs(2 * mpmath.re(self.A))))


def decimal_of(x):
    return Decimal(mpmath.nstr(x, mpmath.mp.dps))


def roots_and_period(h, f):
    """n0 < n1 < n2 and one period of n3, with the working precision of mpmath."""
    roots = mpmath.polyroots([-2, -2 * h, 2, 2 * h - f * f], maxsteps=5000, extraprec=3 * mpmath.mp.prec)
    n0, n1, n2 = sorted(mpmath.re(root) for root in roots)
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
    # What is orthogonal to three vectors in four dimensions: their minors.
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


def map_without_a(h, f, digits=60):
    """a = 0: a rotation through −∮ f/|w|² dt, a complete elliptic integral of the third kind."""
    with mpmath.workdps(digits):
        h, f = mpmath.mpf(h), mpmath.mpf(f)
        n0, n1, n2, period = roots_and_period(h, f)
        m = (n2 - n1) / (n2 - n0)
        # n3 = n2 − (n2 − n1) sn²
        mean = mpmath.ellippi((n2 - n1) / (h + n2), m) / mpmath.ellipk(m) / (h + n2)
        return MoebiusMap(mpmath.expj(-f * period * mean / 4), mpmath.mpc(0))


def map_on_the_curve(a, n):
    """On `Geq3`: n3 = n and |w| are constant, φ̇ = −a|w| cos φ − f/|w|², for one period of small oscillations of n3.

    There 2(h+n) = (1−n²)/n and f = (1−n²)/√n; p = 2(h+n)(1−n²) − f² has p'' = −2(1+3n²)/n: the period is
    2π√(n/(1+3n²)).
    """
    n = mpmath.mpf(n)
    speed = mpmath.sqrt((1 - n * n) / n)
    time = 2 * mpmath.pi * mpmath.sqrt(n / (1 + 3 * n * n))
    turn, slide = (1 - n * n) / mpmath.sqrt(n) / speed**2 / 2, a * speed / 2
    rate = mpmath.sqrt(mpmath.mpc(turn**2 - slide**2))
    cosine, sine = mpmath.cos(rate * time), mpmath.sin(rate * time) / rate
    return MoebiusMap(mpmath.mpc(mpmath.re(cosine), -turn * mpmath.re(sine)), mpmath.mpc(0, -slide * mpmath.re(sine)))


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


# ---- closed forms of orbits -------------------------------------------------------------------------------------


def pendulum(a, h, phi, times, since=0.0, digits=40):
    """The orbit of `eq01` with b = 1, f = 0: a loxodromic pendulum; doubles (n, 5).

    θ̈ = −sin θ with θ(−since) = 0 and θ̇ > 0 there; φ slides by tan(φ/2 + π/4) ∝ e^{−aθ} from `phi` at time 0;
    w = θ̇ (sin φ, cos φ) and n = (−sin θ cos φ, sin θ sin φ, cos θ).  As φ, the double next to ±π/2 stands for ±π/2:
    a great circle.
    """
    with mpmath.workdps(digits):
        k = mpmath.sqrt((mpmath.mpf(h) + 1) / 2)
        m = k * k if k < 1 else 1 / (k * k)

        def swing(t):
            """θ and θ̇ at the time t after θ = 0."""
            if k == 1:
                return 2 * mpmath.asin(mpmath.tanh(t)), 2 / mpmath.cosh(t)
            if k < 1:
                return 2 * mpmath.asin(k * mpmath.ellipfun("sn", t, m=m)), 2 * k * mpmath.ellipfun("cn", t, m=m)
            turn = 2 * mpmath.ellipk(m) / k
            turns = mpmath.nint(t / turn)
            within = k * (t - turns * turn)
            theta = 2 * (mpmath.asin(mpmath.ellipfun("sn", within, m=m)) + mpmath.pi * turns)
            return theta, 2 * k * mpmath.ellipfun("dn", within, m=m)

        begin, _ = swing(mpmath.mpf(since))
        slides = abs(phi) != math.pi / 2
        phi = mpmath.mpf(phi) if slides else mpmath.sign(phi) * mpmath.pi / 2
        slope = mpmath.tan(phi / 2 + mpmath.pi / 4)
        rows = []
        for t in times:
            theta, speed = swing(mpmath.mpf(t) + mpmath.mpf(since))
            now = 2 * mpmath.atan(slope * mpmath.exp(a * (begin - theta))) - mpmath.pi / 2 if slides else phi
            s, c = mpmath.sin(now), mpmath.cos(now)
            rows.append([speed * s, speed * c, -mpmath.sin(theta) * c, mpmath.sin(theta) * s, mpmath.cos(theta)])
        return np.array(rows, dtype=float)


def steady_rotation(omega, gamma, times, digits=40):
    """γ̇ = γ × ω with constant ω = (ω1, ω2, 0), by the formula of Rodrigues; the state of `Biz131`, doubles (n, 5)."""
    with mpmath.workdps(digits):
        w = mpmath.matrix([*omega, 0])
        speed = mpmath.norm(w)
        axis, g = w / speed, mpmath.matrix(gamma)
        along = axis * mpmath.fdot(axis, g)
        across = mpmath.matrix([g[1] * axis[2] - g[2] * axis[1], g[2] * axis[0] - g[0] * axis[2],
                                g[0] * axis[1] - g[1] * axis[0]])
        rows = []
        for t in times:
            angle = speed * mpmath.mpf(t)
            rows.append([*omega, *(along + (g - along) * mpmath.cos(angle) + across * mpmath.sin(angle))])
        return np.array(rows, dtype=float)
