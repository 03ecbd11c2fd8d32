"""Proofs that a torus (a, h, f), three rationals taken as exact, has exactly two limit cycles, or none.

Units b = 1.  Let n3 = n1 + κ(1 − cos s), κ = (n2 − n1)/2, so that s runs from 0 to π in half a period of n3.  The
equation of φ (`eq0003`), φ' = −a|w| cos φ − f/|w|², |w|² = 2(h + n3), is that of φ = 2 arg(x + iy) along the linear
system

    dx/ds = q(f/|w|² − a|w|) y,   dy/ds = −q(f/|w|² + a|w|) x,   q = 1/(2√(2(n3 − n0))),

whose coefficients are analytic around the whole interval; the turning points of n3 are regular.  Its matrix from s = 0
to π is P = ((A, B), (C, D)), AD − BC = 1.  The coefficients are even about π and the system has no diagonal, so the
matrix from π to 2π is σP⁻¹σ, σ = diag(1, −1), and the whole map is

    ((AD + BC, 2BD), (2AC, AD + BC)),   t = 2 + 4BC = 4AD − 2.

So t > 2 if BC > 0, t < −2 if AD < 0, |t| < 2 if BC < 0 < AD: signs, without cancellation.  The fixed points
are tan(φ/2) = ±√(AC/BD) and the multipliers (√|AD| + √|BC|)^∓4.  The rotation number is an integer, or
ρ = m + {β or 1 − β}, β = (2/π) arctan √(−BC/AD), m = ⌊2θ/π⌋ (β for even m), where θ is the angle through which P
turns (1, 0): by the reversor, the whole map turns it beyond kπ exactly if the half map turns it beyond kπ/2.

Proof by ball arithmetic: each number below is a ball of Arb that contains the true value.  n0, n1, n2 are isolated
exactly.  For complex |s − s0| ≤ r, |n3(s) − n3(s0)| ≤ Δ = κ(|cos s0|(cosh r − 1) + |sin s0| sinh r).  If Δ is less
than h + n3(s0) and n3(s0) − n0, it bounds the coefficients of the system by some K, hence its solutions by e^{Kr} and,
by Cauchy's estimate, the remainder of their Taylor series after N terms at a step δ by e^{Kr} τ^N/(1 − τ), τ = δ/r.
Steps and radii are chosen in double precision; balls check everything that the proof assumes of them.
On the edge of the region there is no torus; `edge` has a theorem of its own for it.  The theorems and their
proofs are in `hess_mechanics/proofs.md`; they are not in the paper.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from operator import mul

from hess_mechanics.errors import InvalidParameter, OutsideRegion, Separatrix, WorkLimit
from hess_mechanics.numerics.balls import (
    ArbBall,
    Enclosure,
    ExactNumber,
    enclosure,
    exact,
    rational,
    series_coefficients,
    working_precision,
)
from hess_mechanics.numerics.labelled import ShortRepr
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.suslov_hess.bifurcation import f_max
from hess_mechanics.suslov_hess.circle_map import MAX_A
from hess_mechanics.suslov_hess.edge import EdgeProof, prove_edge

__all__ = [
    "FIRST_BITS",
    "MAX_BITS",
    "MAX_WORK",
    "NO_CYCLE",
    "TWO_CYCLES",
    "UNDECIDED",
    "Proof",
    "ProofStep",
    "prove",
]

TWO_CYCLES, NO_CYCLE, UNDECIDED = "two cycles", "no cycle", "undecided"
FIRST_BITS, MAX_BITS = 64, 512
MAX_WORK = 2e7
"""Limit on the number of steps times the square of their terms, in one proof at one precision: about 15 s."""
_SHARE = 0.8
_GROWTH = 8
"""Largest K r of a step: with δ = r/4 no direction then turns by more than 2, which is less than π."""
_LEAST_F = Fraction(1, 10**100)

Matrix = tuple[ArbBall, ArbBall, ArbBall, ArbBall]
"""(A, B, C, D) by rows."""


@dataclass(frozen=True)
class ProofStep:
    """One Taylor step and the bounds on its remainder.

    Attributes
    ----------
    start : Fraction
        The value of s at which the step starts, 0 to π; it ends at the start of the next step, or at π.
    radius : Fraction
        Radius r of the disc |s − start| ≤ r, positive.
    bound : Fraction
        Upper bound K on the coefficients of the linear system on the disc, positive.
    terms : int
        Number N of terms of the Taylor series.
    matrix : tuple of Enclosure
        Enclosures of the elements A, B, C, D of the matrix of the step, by rows.
    """

    start: Fraction
    radius: Fraction
    bound: Fraction
    terms: int
    matrix: tuple[Enclosure, ...]


@dataclass(frozen=True)
class Proof(ShortRepr):
    """Result of `prove` for a torus (a, h, f), rationals in units b = 1: a proved statement, or undecided.

    Attributes
    ----------
    a : Fraction
        Inertia parameter, |a| ≤ 1e6.
    h : Fraction
        Energy, −1 < h ≤ 1e12.
    f : Fraction
        Area integral.
    statement : str
        `TWO_CYCLES` (|t| > 2), `NO_CYCLE` (|t| < 2) or `UNDECIDED`; t is the trace of the circle map.
    trace : Enclosure
        Enclosure of |t|.
    rotation_number : Enclosure or None
        Rotation number in turns per return; None if undecided.
    fixed_points : tuple of Enclosure
        Angles φ of the stable and of the unstable limit cycle in radians; empty without limit cycles or if undecided.
    multipliers : tuple of Enclosure
        Multipliers of the stable and of the unstable limit cycle; empty without limit cycles or if undecided.
    roots : tuple of Enclosure or None
        n0 < n1 < n2; None for f = 0, h < 1, where the map is a limit in closed form.
    half_turn : tuple of Enclosure or None
        Elements A, B, C, D of the matrix of the half map, by rows; None where `roots` is None.
    steps : tuple of ProofStep
        The Taylor steps; empty where `roots` is None.
    bits : int
        Precision in bits, at least 64.
    seconds : float
        Wall time in seconds.

    Notes
    -----
    The statement holds for the equations with exactly these rationals if the ball arithmetic of Arb is correct.
    """

    a: Fraction
    h: Fraction
    f: Fraction
    statement: str
    trace: Enclosure
    rotation_number: Enclosure | None
    fixed_points: tuple[Enclosure, ...]
    multipliers: tuple[Enclosure, ...]
    roots: tuple[Enclosure, ...] | None
    half_turn: tuple[Enclosure, ...] | None
    steps: tuple[ProofStep, ...]
    bits: int
    seconds: float

    @property
    def trace_decimals(self) -> tuple[str, str]:
        """Two decimals that enclose |t| with enough digits for the statement; doubles if these suffice."""
        low, high = self.trace.double_decimals()
        digits = 17
        while (self.statement == TWO_CYCLES and Fraction(low) <= 2) or (
            self.statement == NO_CYCLE and Fraction(high) >= 2
        ):
            digits *= 2
            low, high = self.trace.decimals(digits)
        return low, high


def prove(
    a: ExactNumber,
    h: ExactNumber,
    f: ExactNumber,
    most_bits: int = MAX_BITS,
    most_work: float = MAX_WORK,
    digits: int = 6,
) -> Proof | EdgeProof:
    """Prove that the torus (a, h, f) has exactly two limit cycles, or none; the result may be undecided.

    On the edge of the region, where there is no torus, prove how its circle of states moves.

    Parameters
    ----------
    a : str, float or Fraction
        Inertia parameter a = I23/I22, |a| ≤ 1e6, taken as exact, see `balls.exact`.
    h : str, float or Fraction
        Energy, −1 < h ≤ 1e12, in units b = 1, taken as exact.
    f : str, float or Fraction
        Area integral, |f| ≤ f_max(h), in units b = 1, taken as exact.
    most_bits : int, optional
        Largest precision in bits, at least 64.
    most_work : float, optional
        Largest number of Taylor steps times the square of their terms, at one precision; positive.
    digits : int, optional
        Number of decimal digits to which |t| is to be enclosed; the result has fewer if a limit is reached.

    Returns
    -------
    Proof or EdgeProof
        A `Proof` with the statement `TWO_CYCLES`, `NO_CYCLE` or, where the limits do not suffice, `UNDECIDED`.  An
        `EdgeProof` exactly if 2(h + n)(1 − n²) − f² has a double root.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a number cannot be taken as exact, |a| or h is too large, or f too close to 0.
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    WorkLimit
        If `most_work` is reached at the first precision, (h, f) is too close to (1, 0), or an `EdgeProof` needs more
        precision than allowed.

    Notes
    -----
    The precision doubles until the statement is decided and |t| known to `digits` digits, or until `most_bits` or
    `most_work` is reached.

    References
    ----------
    `eq0003`.  The theorem is not in the paper, see `hess_mechanics/proofs.md`.

    Examples
    --------
    >>> from hess_mechanics import prove
    >>> prove("0.5", "1.5", "0.6").statement
    'two cycles'
    >>> prove("0.5", "13/8", "15/8").statement
    'two equilibria'
    """
    begun = time.perf_counter()
    at = exact("a", a), exact("h", h), exact("f", f)
    _require_torus(*at)
    if _discriminant(*at[1:]) == 0:
        return prove_edge(*at)
    if at[2] == 0 and at[1] < 1:
        with working_precision(FIRST_BITS):
            return _oscillation(*at, begun)
    bits, proof = FIRST_BITS, None
    while True:
        with working_precision(bits):
            turns = _turns(at[1], at[2], bits)
            plan, work = [], 0.0
            for step in _plan(at[0], at[2], turns, bits):
                plan.append(step)
                work += step[2] ** 2
                if work > most_work:
                    if proof is None:
                        raise WorkLimit(
                            f"This proof needs more than {len(plan)} steps: choose a smaller |a|, or (h, f) "
                            "farther from (1, 0)."
                        )
                    return proof
            proof = _proof(at, turns, plan, bits, begun)
        known = proof.trace.precision < 10.0**-digits and proof.rotation_number is not None
        if (known and proof.statement != UNDECIDED) or 2 * bits > most_bits:
            return proof
        bits *= 2


def _require_torus(a: Fraction, h: Fraction, f: Fraction) -> None:
    """Raise an error unless motions with exactly this (h, f) exist.

    The sign of the discriminant of 2(h + n)(1 − n²) − f² decides.

    Parameters
    ----------
    a : Fraction
        Inertia parameter.
    h : Fraction
        Energy, in units b = 1.
    f : Fraction
        Area integral, in units b = 1.

    Raises
    ------
    InvalidParameter
        If |a| or h is too large, or f too close to 0.
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    """
    if abs(a) > MAX_A or h > 10**12:
        raise InvalidParameter(f"a = {float(a):g}, h = {float(h):g}: choose |a| ≤ {MAX_A:g} and h ≤ 1e12.")
    if f and abs(f) < _LEAST_F:
        raise InvalidParameter(f"f = {float(f):g} is too close to 0: choose f = 0 or |f| ≥ 1e-100.")
    if h <= -1:
        raise OutsideRegion(f"h = {float(h):.12g} is not above the lowest energy: choose h > −1.")
    if f == 0 and h == 1:
        raise Separatrix("h = 1, f = 0 is the separatrix: no return. Move h or f a little.")
    if _discriminant(h, f) < 0:
        largest = f_max(max(float(h), -1.0 + 1e-16))
        raise OutsideRegion(
            f"No motion has exactly h = {float(h):.15g} and f = {float(f):.15g}: at this h choose "
            f"|f| ≤ {largest * (1 - 1e-11):.12g}, or a larger h."
        )


def _discriminant(h: Fraction, f: Fraction) -> Fraction:
    """Return a quarter of the discriminant of −2n³ − 2hn² + 2n + (2h − f²): positive in the region, 0 on its edge."""
    A, B, C, D = -2, -2 * h, 2, 2 * h - f * f
    return Fraction(18 * A * B * C * D - 4 * B**3 * D + B * B * C * C - 4 * A * C**3 - 27 * A * A * D * D) / 4


@dataclass(frozen=True)
class _Turns:
    """The roots n0, n1, n2 and balls with small relative radii: w = h + n1, gap = n1 − n0, κ = (n2 − n1)/2."""

    roots: tuple[Enclosure, ...]
    w: ArbBall
    gap: ArbBall
    kappa: ArbBall


def _turns(h: Fraction, f: Fraction, bits: int) -> _Turns:
    """Return the isolated roots W = h + n of 2W(1 − (W − h)²) − f², with enough bits for the gaps between them."""
    precision = 2 * bits + 64
    while True:
        with working_precision(precision) as library:
            arb, H = library.arb, rational(h)
            cubic = library.fmpq_poly([rational(c) for c in (-f * f, 2 * (1 - h * h), 4 * h, Fraction(-2))])
            W = sorted((root.real for root, _ in cubic.numer().complex_roots()), key=lambda root: root.mid())
            w, gap = W[1], W[1] - W[0]
            # A comparison of balls is true only if it is certain.
            if w > 0 and gap > 0 and W[1] < W[2] and (min(w.rel_accuracy_bits(), gap.rel_accuracy_bits()) > bits + 16):
                return _Turns(tuple(enclosure(root - arb(H)) for root in W), w, gap, (W[2] - W[1]) / 2)
        precision *= 2


def _plan(a: Fraction, f: Fraction, turns: _Turns, bits: int) -> Iterator[tuple[Fraction, Fraction, int]]:
    """Yield (start, radius, terms) of each step, chosen in double precision."""
    size, drift = abs(float(a)), abs(float(f))
    w1, g1, kappa = (float(x) for x in (turns.w, turns.gap, turns.kappa))
    s = 0.0
    while s < math.pi:
        rise = 2.0 * kappa * math.sin(0.5 * s) ** 2
        w, g = w1 + rise, g1 + rise

        def bound(r: float, s: float = s, w: float = w, g: float = g) -> float:
            d = kappa * (abs(math.cos(s)) * 2.0 * math.sinh(0.5 * r) ** 2 + abs(math.sin(s)) * math.sinh(r))
            if d > _SHARE * min(w, g):
                return math.inf
            return 0.5 / math.sqrt(2.0 * (g - d)) * (0.5 * drift / (w - d) + size * math.sqrt(2.0 * (w + d)))

        r = 2.0
        while not r * bound(r) <= _GROWTH * 0.999:
            r *= 0.85
        yield Fraction(s), Fraction(r), math.ceil(0.5 * (bits + r * bound(r) / math.log(2.0))) + 4
        s += 0.25 * r


def _proof(
    at: tuple[Fraction, Fraction, Fraction],
    turns: _Turns,
    plan: list[tuple[Fraction, Fraction, int]],
    bits: int,
    begun: float,
) -> Proof:
    """Return the proof that the steps of a plan give at the present precision, or that it is undecided."""
    from flint import arb

    a, f = arb(rational(at[0])), arb(rational(at[2]))
    A, B, C, D = arb(1), arb(0), arb(0), arb(1)
    theta = arb(0)
    steps = []
    for i, (start, radius, terms) in enumerate(plan):
        check_limit()
        s = arb(rational(start))
        delta = (arb(rational(plan[i + 1][0])) if i + 1 < len(plan) else arb.pi()) - s
        K, matrix = _step(a, f, turns, s, arb(rational(radius)), delta, terms)
        p, q, r, d = matrix
        before = A, C
        A, B, C, D = p * A + q * C, p * B + q * D, r * A + d * C, r * B + d * D
        theta += arb.atan2(before[0] * C - before[1] * A, before[0] * A + before[1] * C)
        steps.append(ProofStep(start, radius, K, terms, tuple(map(enclosure, matrix))))
    statement, t = _verdict(A, B, C, D)
    rotation = _rotation(statement, t, A, B, C, D, theta)
    cycles = _cycles(t, A, B, C, D) if statement == TWO_CYCLES else ((), ())
    if rotation is None or cycles is None:
        # The sign of the trace is certain, but the rotation number or the cycles need more digits.
        statement, rotation, cycles = UNDECIDED, None, ((), ())
    trace = Enclosure(max(Fraction(0), t.low, -t.high), max(abs(t.low), abs(t.high)))
    return Proof(
        *at,
        statement,
        trace,
        rotation,
        *cycles,
        turns.roots,
        tuple(map(enclosure, (A, B, C, D))),
        tuple(steps),
        bits,
        time.perf_counter() - begun,
    )


def _step(
    a: ArbBall, f: ArbBall, turns: _Turns, s: ArbBall, r: ArbBall, delta: ArbBall, terms: int
) -> tuple[Fraction, Matrix]:
    """Return K and the matrix of the step δ from s, by its Taylor series and Cauchy's bound on the remainder."""
    from flint import arb, arb_series, ctx

    rise = 2 * turns.kappa * (s / 2).sin() ** 2
    w, gap = turns.w + rise, turns.gap + rise
    change = abs(turns.kappa) * (abs(s.cos()) * 2 * (r / 2).sinh() ** 2 + abs(s.sin()) * r.sinh())
    largest = (abs(f) / (2 * (w - change)) + abs(a) * (2 * (w + change)).sqrt()) / (8 * (gap - change)).sqrt()
    K = Fraction(math.nextafter(float(largest) * (1.0 + 1e-12), math.inf))
    # No direction turns by more than Kδ < π, so the angle between its ends is the angle through which it turns.
    if not (
        change < w
        and change < gap
        and largest < arb(rational(K))
        and 0 < delta < r
        and arb(rational(K)) * r <= _GROWTH
        and arb(rational(K)) * delta < arb.pi()
    ):
        raise WorkLimit("A Taylor step of this proof is too long for its precision: choose (h, f) farther from (1, 0).")
    tau = delta / r
    rest = (arb(rational(K)) * r).exp() * tau**terms / (1 - tau)

    ctx.cap = terms
    # The series of h + n3 and n3 − n0 differ in the first coefficient only: it is small near a singular point, and
    # computed without cancellation.
    change_of_n3 = (-turns.kappa * arb_series([s, 1]).cos()).coeffs()[1:]
    w_squared = 2 * arb_series([w, *change_of_n3])
    q = (8 * arb_series([gap, *change_of_n3])).rsqrt()
    drift, drive = q * f / w_squared, q * a * w_squared.sqrt()
    upper, lower = (series_coefficients(series, terms) for series in (drift - drive, -drift - drive))
    powers = [arb(1)]
    for _ in range(terms - 1):
        powers.append(powers[-1] * delta)
    tail = arb(0, rest.abs_upper())
    columns = []
    for start in ((1, 0), (0, 1)):
        x, y = [arb(start[0])], [arb(start[1])]
        for k in range(terms - 1):
            following = (
                sum(map(mul, upper, reversed(y)), arb(0)) / (k + 1),
                sum(map(mul, lower, reversed(x)), arb(0)) / (k + 1),
            )
            x.append(following[0])
            y.append(following[1])
        columns.append([sum(map(mul, series, powers), arb(0)) + tail for series in (x, y)])
    (A, C), (B, D) = columns
    return K, (A, B, C, D)


def _verdict(A: ArbBall, B: ArbBall, C: ArbBall, D: ArbBall) -> tuple[str, Enclosure]:
    """Return the statement and the enclosure of t, the intersection of its two forms."""
    small, large = enclosure(B * C), enclosure(A * D)
    t = Enclosure(2 + 4 * max(small.low, large.low - 1), 2 + 4 * min(small.high, large.high - 1))
    if t.low > 2 or t.high < -2:
        return TWO_CYCLES, t
    return (NO_CYCLE if t.low > -2 and t.high < 2 else UNDECIDED), t


def _cycles(
    t: Enclosure, A: ArbBall, B: ArbBall, C: ArbBall, D: ArbBall
) -> tuple[tuple[Enclosure, ...], tuple[Enclosure, ...]] | None:
    """Return φ and the multipliers of the stable and of the unstable cycle; None if the balls are too wide."""
    phi = 2 * (A * C / (B * D)).sqrt().atan()
    multiplier = (abs(A * D).sqrt() + abs(B * C).sqrt()) ** -4
    if not (phi.is_finite() and multiplier.is_finite() and multiplier > 0):
        return None
    # The eigenvalue of (1, κ), κ = tan(φ/2), is (AD + BC) + 2BDκ, and AD + BC = t/2.  For κ > 0 it is the larger one
    # if BD has the sign of t.  BD is not 0, as φ is finite.
    if (t.low > 0) != (B * D > 0):
        phi = -phi
    return (enclosure(phi), enclosure(-phi)), (enclosure(multiplier), enclosure(1 / multiplier))


def _rotation(
    statement: str, t: Enclosure, A: ArbBall, B: ArbBall, C: ArbBall, D: ArbBall, theta: ArbBall
) -> Enclosure | None:
    """Return ρ; None if the statement is undecided or the balls are too wide."""
    from flint import arb

    quadrants = enclosure(2 * theta / arb.pi()) if theta.is_finite() else None
    if statement == UNDECIDED or quadrants is None or math.floor(quadrants.low) != math.floor(quadrants.high):
        return None
    m = math.floor(quadrants.low)
    if statement == TWO_CYCLES:
        # ρ is the even number of m and m + 1 for t > 2, and the odd number for t < −2.
        locked = Fraction(m + (m + int(t.low < 0)) % 2)
        return Enclosure(locked, locked)
    share = 2 * (-(B * C) / (A * D)).sqrt().atan() / arb.pi()
    return enclosure(m + (share if m % 2 == 0 else 1 - share)) if share.is_finite() else None


def _oscillation(a: Fraction, h: Fraction, f: Fraction, begun: float) -> Proof:
    """Return the proof for f = 0, h < 1, where the pendulum swings.

    In the limit f → 0+ φ turns by −π where w = 0, so that Θ∘Θ = id and t = 0.
    """
    zero, half = Enclosure(Fraction(0), Fraction(0)), Enclosure(Fraction(-1, 2), Fraction(-1, 2))
    return Proof(a, h, f, NO_CYCLE, zero, half, (), (), None, None, (), FIRST_BITS, time.perf_counter() - begun)
