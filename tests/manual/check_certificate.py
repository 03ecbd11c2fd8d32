"""Checks a certificate of `hess-explorer prove` with intervals of mpmath, by code of its own.

`python tests/manual/check_certificate.py FILE`, or "-" for standard input.  The theorems are in
`models/hess_mechanics/proofs.md`; here everything is computed again, more exactly, and every number that the
certificate encloses must come out inside.  A certificate is refused, with a sentence, where a part is missing or of
another kind than `prove` writes, where a number is not enclosed, and where it says "undecided" although the
recomputation decides.  Versions and seconds are not looked at.
"""

import json
import re
import sys
from contextlib import contextmanager
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path

from mpmath import iv
from mpmath.libmp import ComplexResult

ONE, ZERO = iv.mpf(1), iv.mpf(0)
TORUS, EDGE = "Suslov–Hess torus, 1", "Suslov–Hess edge, 1"
NUMBER = re.compile(r"[-+]?\d{1,5000}(\.\d{1,5000})?(E[-+]?\d{1,4})?|[-+]?\d{1,5000}/[1-9]\d{0,5000}")
MOST_BITS, MOST_TERMS = 1 << 14, 1 << 14


class Refused(Exception):
    """Raised for a certificate that does not prove its statement."""


def need(true, what):
    if not true:
        raise Refused(what)


@contextmanager
def precision(bits):
    """Compute with intervals of this many bits, and restore mpmath's precision afterwards."""
    before = iv.prec
    iv.prec = bits
    try:
        yield
    finally:
        iv.prec = before


# ---- what a certificate consists of -----------------------------------------------------------------------------


def rational(text, what="a number"):
    need(isinstance(text, str) and NUMBER.fullmatch(text), f"{what} is no number written as a text")
    return Fraction(text)


def pair(texts, what):
    """Two rationals, the smaller one first."""
    low, high = (rational(text, what) for text in texts)
    need(low <= high, f"the ends of {what} are exchanged")
    return low, high


def pairs(data, name, count):
    need(len(data[name]) == count, f"{name} has {len(data[name])} entries instead of {count}")
    return [pair(texts, name) for texts in data[name]]


def whole(number, most, what):
    need(type(number) is int and 1 <= number <= most, f"{what} is not between 1 and {most}")
    return number


# ---- intervals --------------------------------------------------------------------------------------------------


def interval(low, high=None):
    """The interval of two rationals."""
    low, high = (iv.mpf(x.numerator) / x.denominator for x in (low, low if high is None else high))
    return iv.mpf([low.a, high.b])


def inside(own, ends, what):
    low, high = ends
    need(interval(low).b <= own.a and own.b <= interval(high).a, f"{what} is not enclosed")


def power(series, exponent, first):
    """The Taylor coefficients of a power of a series, of which the first is known."""
    found = [first]
    for k in range(1, len(series)):
        terms = (((exponent + 1) * j - k) * series[j] * found[k - j] for j in range(1, k + 1))
        found.append(sum(terms, ZERO) / (k * series[0]))
    return found


def product(u, v):
    return [sum((u[j] * v[k - j] for j in range(k + 1)), ZERO) for k in range(len(u))]


def tangent(share):
    """tan(π share/2)."""
    return iv.sin(iv.pi * share / 2) / iv.cos(iv.pi * share / 2)


# ---- the steps of a torus ---------------------------------------------------------------------------------------


@cache
def roots_hold(h, f, roots):
    """Each of three disjoint intervals has a root of 2(h + n)(1 − n²) − f², so each has exactly one."""

    def p(n):
        return 2 * (h + n) * (1 - n * n) - f * f

    for low, high in roots:
        need(p(low) * p(high) < 0 if low < high else p(low) == 0, "a root is not isolated")
    need(all(one[1] < two[0] for one, two in pairwise(roots)), "the roots are not in order, one after the other")


@cache
def step(a, h, f, roots, start, end, radius, bound, terms, bits):
    """Return (A, B, C, D) of one Taylor step after checking its disc and bound, at a precision of this many bits."""
    with precision(bits):
        n0, n1, n2 = (interval(*root) for root in roots)
        s, r, K = map(interval, (start, radius, bound))
        delta = interval(end - start) if end is not None else iv.pi - s
        need(delta.a > 0 and delta.b < r.a, "a step is longer than its radius")
        kappa, cos, sin = (n2 - n1) / 2, iv.cos(s), iv.sin(s)
        w, gap = interval(h) + n1 + kappa * (1 - cos), n1 - n0 + kappa * (1 - cos)
        grow = iv.exp(r)
        change = abs(kappa) * (abs(cos) * ((grow + 1 / grow) / 2 - 1) + abs(sin) * (grow - 1 / grow) / 2)
        need(change.b < w.a and change.b < gap.a, "a disc reaches a singular point")
        A, F = interval(a), interval(f)
        largest = (abs(F) / (2 * (w - change)) + abs(A) * iv.sqrt(2 * (w + change))) / iv.sqrt(8 * (gap - change))
        need(largest.b <= K.a, "a bound on the coefficients is too small")
        need((K * delta).b < 3, "a step turns too far to count the turns")

        cosine, factor = [], kappa
        for k in range(terms):
            cosine.append(factor * (cos, -sin, -cos, sin)[k % 4])
            factor = factor / (k + 1)
        w_squared = [2 * w, *(-2 * c for c in cosine[1:])]
        q = power([8 * gap, *(-8 * c for c in cosine[1:])], -0.5, 1 / iv.sqrt(8 * gap))
        drift = [F * c for c in product(q, power(w_squared, -1, 1 / w_squared[0]))]
        drive = [A * c for c in product(q, power(w_squared, 0.5, iv.sqrt(w_squared[0])))]
        upper = [u - v for u, v in zip(drift, drive, strict=True)]
        lower = [-u - v for u, v in zip(drift, drive, strict=True)]
        rest = (iv.exp(K * r) * (delta / r) ** terms / (1 - delta / r)).b
        tail, columns = iv.mpf([-rest, rest]), []
        for x, y in (([ONE], [ZERO]), ([ZERO], [ONE])):
            for k in range(terms - 1):
                dx = sum((upper[j] * y[k - j] for j in range(k + 1)), ZERO) / (k + 1)
                dy = sum((lower[j] * x[k - j] for j in range(k + 1)), ZERO) / (k + 1)
                x.append(dx)
                y.append(dy)
            columns += [sum((c * delta**k for k, c in enumerate(series)), ZERO) + tail for series in (x, y)]
        return columns[0], columns[2], columns[1], columns[3]


def quadrant(x, y):
    """0 to 3."""
    need(0 not in x and 0 not in y, "a direction on an axis cannot be counted")
    return (0 if y > 0 else 3) if x > 0 else (1 if y > 0 else 2)


def half_period(certificate, a, h, f):
    """(A, B, C, D) from s = 0 to π by the steps, and the quarter turns of (1, 0), None where they cannot be counted."""
    roots = tuple(pairs(certificate, "roots", 3))
    roots_hold(h, f, roots)
    steps = certificate["steps"]
    need(steps, "there are no steps")
    starts = [rational(one["start"]) for one in steps]
    need(starts[0] == 0 and all(x < y for x, y in pairwise(starts)), "the steps are not in order")
    need(starts[-1] < 4, "the steps go too far")
    A, B, C, D = ONE, ZERO, ZERO, ONE
    turns = 0
    for one, start, end in zip(steps, starts, [*starts[1:], None], strict=True):
        radius, bound = rational(one["radius"]), rational(one["bound"])
        need(0 < radius < 4 and bound > 0, "a radius or a bound is not possible")
        own = step(a, h, f, roots, start, end, radius, bound, whole(one["terms"], MOST_TERMS, "terms") + 8, iv.prec)
        for name, number, ends in zip("ABCD", own, pairs(one, "matrix", 4), strict=True):
            inside(number, ends, f"{name} of a step")
        before = A, C
        p, q, r, s = own
        A, B, C, D = p * A + q * C, p * B + q * D, r * A + s * C, r * B + s * D
        if turns is None or 0 in A or 0 in C:
            turns = None
            continue
        # Less than half a turn, in the sense that the cross product has; without a sense it is within one quadrant.
        left = before[0] * C - before[1] * A
        change = (quadrant(A, C) - turns) % 4
        if change and 0 in left:
            turns = None
        else:
            turns += change if not change or left > 0 else change - 4
    for name, number, ends in zip("ABCD", (A, B, C, D), pairs(certificate, "half", 4), strict=True):
        inside(number, ends, f"{name} of half a period")
    return (A, B, C, D), turns


# ---- statements -------------------------------------------------------------------------------------------------


def verify_torus(certificate, a, h, f):
    statement = certificate["statement"]
    need(statement in ("two cycles", "no cycle", "undecided"), "this is no statement of a torus")
    if certificate["roots"] is None:
        verify_oscillation(certificate, h, f)
        return
    need(f or h > 1, "f = 0, h ≤ 1 has no such map")
    with precision(2 * whole(certificate["bits"], MOST_BITS, "bits") + 32):
        matrix, turns = half_period(certificate, a, h, f)
        A, B, C, D = matrix
        small, large = B * C, A * D
        decided = "two cycles" if small.a > 0 or large.b < 0 else "no cycle" if small.b < 0 < large.a else "undecided"
        need(
            statement == decided or (statement == "undecided" and turns is None),
            f"{statement} is not what the steps prove: {decided}",
        )
        t = 2 + 4 * small
        size = -t if large.b < 0 else t if t.a > 0 else abs(t)
        for name in ("trace", "trace_ball"):
            inside(size, pair(certificate[name], name), f"|trace|, as {name},")
        low, high = pair(certificate["trace"], "trace")
        if statement == "undecided":
            need(low <= 2 <= high, "the trace decides what is called undecided")
            need(certificate["rotation_number"] is None, "an undecided torus has no rotation number")
        else:
            need(turns is not None, "the quarter turns cannot be counted")
            need(low > 2 if statement == "two cycles" else high < 2, "the trace does not show the statement")
        if statement == "two cycles":
            verify_cycles(certificate, matrix, turns, t.a > 2)
        else:
            pairs(certificate, "fixed_points", 0)
            pairs(certificate, "multipliers", 0)
        if statement == "no cycle":
            verify_turning(certificate, -small / large, turns)


def verify_oscillation(certificate, h, f):
    """f = 0, h < 1: the map is a limit in closed form."""
    need(f == 0 and h < 1 and certificate["statement"] == "no cycle", "only for f = 0, h < 1 is the map a limit")
    need(certificate["half"] is None and certificate["steps"] == [], "where the map is a limit there are no steps")
    for name in ("fixed_points", "multipliers"):
        pairs(certificate, name, 0)
    for name, number in (("trace", 0), ("trace_ball", 0), ("rotation_number", Fraction(-1, 2))):
        need(pair(certificate[name], name) == (number, number), f"there {name} is {number}")


def verify_cycles(certificate, matrix, turns, positive):
    """The rotation number, both fixed points and their multipliers; positive : whether t > 2, not t < −2."""
    A, B, C, D = matrix
    rho = pair(certificate["rotation_number"], "rotation_number")
    need(rho == (turns + (turns + (not positive)) % 2,) * 2, "the rotation number is another integer")
    need(0 not in B * D, "the fixed points cannot be told")
    slope = iv.sqrt(A * C / (B * D))
    for ends, sign in zip(pairs(certificate, "fixed_points", 2), (1, -1), strict=True):
        wanted = sign * slope * (1 if positive == bool(B * D > 0) else -1)
        low, high = (interval(x) / iv.pi for x in ends)
        need(
            low.a > -1 and high.b < 1 and tangent(low).b <= wanted.a and wanted.b <= tangent(high).a,
            "a fixed point is not enclosed",
        )
    root = iv.sqrt(abs(A * D)) + iv.sqrt(abs(B * C))
    for number, ends in zip((1 / root**4, root**4), pairs(certificate, "multipliers", 2), strict=True):
        inside(number, ends, "a multiplier")


def verify_turning(certificate, square, turns):
    """The rotation number of a torus without cycles; square : of tan(πβ/2)."""
    rho = pair(certificate["rotation_number"], "rotation_number")
    even = turns % 2 == 0
    low, high = (interval(x - turns if even else 1 + turns - x) for x in rho[:: 1 if even else -1])
    need(
        low.a >= 0 and high.b < 1 and tangent(low).b ** 2 <= square.a and square.b <= tangent(high).a ** 2,
        "the rotation number is not enclosed",
    )


def verify_edge(certificate, a, h, f):
    """Verify a circle of states: its double root, in rationals, and the sign of n²(1 + a²) − a²."""
    n = rational(certificate["n"])
    need(0 < n < 1 and 2 * n * h == 1 - 3 * n * n and f * f * n == (1 - n * n) ** 2, "this is not on the edge")
    radicand = n * n * (1 + a * a) - a * a
    statement = certificate["statement"]
    need(
        statement == ("periodic orbit" if radicand > 0 else "two equilibria") and radicand != 0,
        "this is not what the circle does",
    )
    with precision(256):
        rate = iv.sqrt(interval(abs(radicand) / n))
        count = 0 if statement == "periodic orbit" else 2
        angles, rates = pairs(certificate, "fixed_points", count), pairs(certificate, "rates", count)
        if statement == "periodic orbit":
            inside(2 * iv.pi / rate, pair(certificate["period"], "period"), "the period")
            return
        need(certificate["period"] is None, "where there are equilibria there is no period")
        # cos φ = −f/(a|w|³), |w|² = 2(h + n); a sin φ < 0 at the attracting one, which comes first.
        cosine = iv.sqrt(interval((f / a) ** 2 / (2 * (h + n)) ** 3)) * (-1 if a * f > 0 else 1)
        for (low, high), sign in zip(angles, (-1, 1), strict=True):
            side = sign if a > 0 else -sign
            ends = sorted((side * low, side * high))
            need(ends[0] >= 0 and interval(ends[1]).b < iv.pi.a, "an equilibrium is on the wrong side")
            need(
                iv.cos(interval(ends[1])).b <= cosine.a and cosine.b <= iv.cos(interval(ends[0])).a,
                "an equilibrium is not enclosed",
            )
        for ends, number in zip(rates, (-rate, rate), strict=True):
            inside(number, ends, "a rate")


def verify(certificate):
    """Raise `Refused` unless the certificate proves its statement."""
    try:
        form = certificate["format"]
        need(form in (TORUS, EDGE), f"the format is neither “{TORUS}” nor “{EDGE}”")
        a, h, f = (rational(certificate[name], name) for name in "ahf")
        need(h > -1, "h ≤ −1 has no motion")
        (verify_torus if form == TORUS else verify_edge)(certificate, a, h, f)
    except KeyError as error:
        raise Refused(f"{error.args[0]} is missing") from None
    except (TypeError, ValueError, IndexError) as error:
        raise Refused(f"a part is not of its kind: {error}") from None
    except (ArithmeticError, ComplexResult) as error:
        raise Refused(f"its intervals are too wide to compute with: {error}") from None


def main(arguments):
    """Check the JSON of a file, or of standard input."""
    need(len(arguments) == 1, "say which file to check, or - for standard input")
    try:
        text = sys.stdin.read() if arguments[0] == "-" else Path(arguments[0]).read_text(encoding="utf-8")
        certificate = json.loads(text)
    except (OSError, ValueError, RecursionError) as error:
        raise Refused(f"this is no JSON that can be read: {error}") from None
    verify(certificate)
    print("every step and number holds")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Refused as error:
        sys.exit(f"refused: {error}")
