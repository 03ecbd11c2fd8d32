"""Checks a certificate of `hess-explorer prove` with intervals of mpmath, by code of its own.

`python tests/check_certificate.py FILE`, or "-" for standard input.  The mathematics is in the docstring of
`hess_mechanics.suslov_hess.proof`; here all of it is computed again, more exactly, and every number that the
certificate encloses must come out inside.  Versions, seconds and bits are not looked at.
"""

import json
import sys
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path

from mpmath import iv

ONE, ZERO = iv.mpf(1), iv.mpf(0)


class Refused(Exception):
    """A certificate that does not prove what it states."""


def need(true, what):
    if not true:
        raise Refused(what)


def interval(low, high=None):
    """The interval of two rationals."""
    low, high = (iv.mpf(x.numerator) / x.denominator for x in (low, low if high is None else high))
    return iv.mpf([low.a, high.b])


def inside(own, texts, what):
    low, high = map(Fraction, texts)
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


@cache
def roots_hold(h, f, roots):
    """Each of three disjoint intervals has a root of 2(h + n)(1 − n²) − f², the second may be exact and double."""
    def p(n):
        return 2 * (h + n) * (1 - n * n) - f * f

    for low, high in roots:
        need(low <= high and (p(low) * p(high) < 0 if low < high else p(low) == 0), "a root is not isolated")
    double = roots[1] == roots[2] and roots[1][0] == roots[1][1]
    slope = 2 * (1 - roots[1][0] ** 2) - 4 * (h + roots[1][0]) * roots[1][0]
    apart = slope == 0 if double else roots[1][1] < roots[2][0]
    need(roots[0][1] < roots[1][0] and apart, "the roots are not in order")


@cache
def step(a, h, f, roots, start, end, radius, bound, terms, precision):
    """(A, B, C, D) of one Taylor step, after its disc and its bound are found right."""
    iv.prec = precision
    n0, n1, n2 = (interval(*root) for root in roots)
    s, r, K, delta = map(interval, (start, radius, bound, end - start)) if end else (
        interval(start), interval(radius), interval(bound), iv.pi - interval(start))
    need(delta.a > 0 and delta.b < r.a, "a step is longer than its radius")
    kappa, cos, sin = (n2 - n1) / 2, iv.cos(s), iv.sin(s)
    w, gap = h.numerator / iv.mpf(h.denominator) + n1 + kappa * (1 - cos), n1 - n0 + kappa * (1 - cos)
    grow = iv.exp(r)
    change = abs(kappa) * (abs(cos) * ((grow + 1 / grow) / 2 - 1) + abs(sin) * (grow - 1 / grow) / 2)
    need(change.b < w.a and change.b < gap.a, "a disc reaches a singular point")
    A, F = interval(a), interval(f)
    largest = (abs(F) / (2 * (w - change)) + abs(A) * iv.sqrt(2 * (w + change))) / iv.sqrt(8 * (gap - change))
    need(largest.b <= K.a, "a bound of the coefficients is too small")
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


def verify(certificate):
    """Raise `Refused`, `KeyError`, `ValueError` or `TypeError` unless the certificate proves its statement."""
    a, h, f = (Fraction(certificate[name]) for name in "ahf")
    statement, steps = certificate["statement"], certificate["steps"]
    need(h > -1 and statement in ("two cycles", "no cycle", "undecided"), "this is no statement of a torus")
    if certificate["roots"] is None:
        need(f == 0 and h < 1 and statement == "no cycle" and not steps, "only for f = 0, h < 1 is the map a limit")
        need([*map(Fraction, certificate["trace"] + certificate["rotation_number"])] == [0, 0, Fraction(-1, 2),
             Fraction(-1, 2)], "there the trace is 0 and ρ = −1/2")
        return
    need(f or h > 1, "f = 0, h ≤ 1 has no such map")
    roots = tuple(tuple(map(Fraction, root)) for root in certificate["roots"])
    need(len(roots) == 3, "there are three roots")
    roots_hold(h, f, roots)
    starts = [Fraction(one["start"]) for one in steps]
    need(starts[0] == 0 and all(x < y for x, y in pairwise(starts)), "the steps are not in order")
    need(starts[-1] < 4, "the steps go too far")

    A, B, C, D = ONE, ZERO, ZERO, ONE
    turns = 0
    for one, start, end in zip(steps, starts, [*starts[1:], None], strict=True):
        own = step(a, h, f, roots, start, end, Fraction(one["radius"]), Fraction(one["bound"]), one["terms"] + 8,
                   2 * certificate["bits"] + 32)
        for name, number, texts in zip("ABCD", own, one["matrix"], strict=True):
            inside(number, texts, f"{name} of a step")
        before = A, C
        p, q, r, s = own
        A, B, C, D = p * A + q * C, p * B + q * D, r * A + s * C, r * B + s * D
        if statement == "undecided":
            continue
        # Less than half a turn, in the sense that the cross product has.
        left = before[0] * C - before[1] * A
        need(0 not in left or f == 0, "the sense of a turn is not known")
        change = (quadrant(A, C) - turns) % 4
        turns += change if left > 0 else change - 4 if change else 0
    for name, number, texts in zip("ABCD", (A, B, C, D), certificate["half"], strict=True):
        inside(number, texts, f"{name} of half a period")

    small, large = B * C, A * D
    t = 2 + 4 * small
    if statement == "two cycles":
        need(small.a > 0 or large.b < 0, "|trace| > 2 is not so")
    if statement == "no cycle":
        need(small.b < 0 < large.a, "|trace| < 2 is not so")
    size = -t if large.b < 0 else t if t.a > 0 else abs(t)
    for name in ("trace", "trace_ball"):
        inside(size, certificate[name], f"|trace|, as {name},")
    low, high = map(Fraction, certificate["trace"])
    need({"two cycles": low > 2, "no cycle": high < 2}.get(statement, True), "the trace does not show the statement")
    if statement == "undecided":
        return
    rho = [*map(Fraction, certificate["rotation_number"])]
    if statement == "no cycle":
        need(not certificate["fixed_points"] and not certificate["multipliers"], "a rotation has no fixed point")
        even = turns % 2 == 0
        low, high = (interval(x - turns if even else 1 + turns - x) for x in rho[:: 1 if even else -1])
        square = -small / large
        need(low.a >= 0 and high.b < 1 and tangent(low).b ** 2 <= square.a and square.b <= tangent(high).a ** 2,
             "the rotation number is not enclosed")
        return
    need(rho == [turns + (turns + (small.a <= 0)) % 2] * 2, "the rotation number is another integer")
    slope = iv.sqrt(A * C / (B * D))
    for phi, sign in zip(certificate["fixed_points"], (1, -1), strict=True):
        low, high = (interval(Fraction(x)) for x in phi)
        wanted = sign * slope * (1 if (large > 0) == (B * D > 0) else -1)
        low, high = low / iv.pi, high / iv.pi
        need(low.a > -1 and high.b < 1 and tangent(low).b <= wanted.a and wanted.b <= tangent(high).a,
             "a fixed point is not enclosed")
    root = iv.sqrt(abs(large)) + iv.sqrt(abs(small))
    for number, texts in zip((1 / root**4, root**4), certificate["multipliers"], strict=True):
        inside(number, texts, "a multiplier")


def tangent(share):
    """tan(π share/2)."""
    return iv.sin(iv.pi * share / 2) / iv.cos(iv.pi * share / 2)


if __name__ == "__main__":
    text = sys.stdin.read() if sys.argv[1] == "-" else Path(sys.argv[1]).read_text()
    try:
        verify(json.loads(text))
    except (Refused, KeyError, ValueError, TypeError) as error:
        sys.exit(f"refused: {error}")
    print("every step and number holds")
