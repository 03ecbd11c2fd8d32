"""Checks the cells of `hess-explorer prove-zone --format json` with intervals of mpmath, by code of its own.

`python tests/check_zone.py FILE`, or "-" for standard input.  With the angle ψ,
tan ψ = √(α/β) tan(s/2), the direction θ of a solution of the linear system (`hess_mechanics.suslov_hess.lock_zone`)
obeys one equation, ψ from 0 to π/2,

    dθ/dψ = −½√(1 − ζ) − a√ζ q cos 2θ,   ζ = z/(1 + z),   1/z = cos²ψ/β + sin²ψ/α,   q = 1/(ρ cos²ψ + sin²ψ/ρ),

ρ = √(α/β), so two broken lines above and below all right-hand sides of a cell hold all its solutions.  From θ = 0 they
lead to the first column (A, C) of half a turn, from π/2 to the second, (B, D): their quadrants are the signs that
decide.  A cell for which these lines are too far apart is halved across its longer side, and both halves are checked.

A statement is one of the tori of a cell, α ≠ β.  Where α = β there is no torus but a circle of states, on which
n3 = 1/√(1 + 4α) stays: see `models/hess_mechanics/proofs.md`.
"""

import math
import sys

from mpmath import iv

from check_certificate import Refused, need, part, precision, rational, read

FORMAT = "Suslov–Hess lock zone, 1"
PRECISION, PIECES, HALVINGS = 53, 48, 7
NAMES = ("two cycles", "no cycle", "undecided")


def interval(low, high):
    return iv.mpf([iv.mpf(low).a, iv.mpf(high).b])


def coefficients(alpha, beta, pieces):
    """½√(1 − ζ) and √ζ q on each piece of ψ, for all of a cell."""
    (a0, a1), (b0, b1) = alpha, beta
    ratio = iv.sqrt(interval(a0, a1) / interval(b0, b1))
    found = []
    for i in range(pieces):
        sine, cosine = (f(iv.pi * interval(i, i + 1) / (2 * pieces)) ** 2 for f in (iv.sin, iv.cos))
        # z grows with α and with β.
        low, high = (1 / (cosine / iv.mpf(b) + sine / iv.mpf(a)) for a, b in ((a0, b0), (a1, b1)))
        low, high = iv.mpf(low.a), iv.mpf(high.b)
        zeta = iv.mpf([(low / (1 + low)).a, (high / (1 + high)).b])
        found.append((iv.sqrt(1 - zeta) / 2, iv.sqrt(zeta) / (ratio * cosine + sine / ratio)))
    return found


def edge(a, pieces, start, upper):
    """The end of a broken line above, or below, all solutions from there."""
    theta, width = iv.mpf(start), iv.pi / (2 * len(pieces))
    for turn, drive in pieces:
        # How far the line may come in this piece is guessed, and then found to be so.
        most = (abs(turn) + abs(a * drive)).b
        around = theta + iv.mpf([-1, 1]) * width * most
        for _ in range(3):
            slope = -turn - a * drive * iv.cos(2 * around)
            side = iv.mpf(slope.b if upper else slope.a)
            line = theta + iv.mpf([0, 1]) * width * side
            around = line
            slope = -turn - a * drive * iv.cos(2 * around)
            if slope.b <= side.b if upper else slope.a >= side.a:
                break
            around = theta + iv.mpf([-1, 1]) * width * max(abs(slope.a), abs(slope.b))
        else:
            side = iv.mpf(most if upper else -most)
        theta = iv.mpf((theta + width * side).b if upper else (theta + width * side).a)
    return theta


def quadrant(low, high):
    """Return the quadrant that holds all angles in this interval; None if it touches an axis."""
    ends = [float((2 * end / iv.pi).mid) for end in (low, high)]
    if not all(map(math.isfinite, ends)):
        return None
    first, last = map(math.floor, ends)
    sure = first < (2 * low / iv.pi).a and (2 * high / iv.pi).b < last + 1
    return first if first == last and sure else None


def signs(a, alpha, beta, pieces):
    """Return the statement proved for every torus of a cell by the signs of A, B, C, D; None if nothing is proved."""
    parts = coefficients(alpha, beta, pieces)
    found = [quadrant(edge(a, parts, start, False), edge(a, parts, start, True)) for start in (iv.mpf(0), iv.pi / 2)]
    if None in found:
        return None
    (A, C), (B, D) = (((1, 1), (-1, 1), (-1, -1), (1, -1))[k % 4] for k in found)
    if B * C > 0 or A * D < 0:
        return "two cycles"
    return "no cycle"


def holds(a, alpha, beta, statement, halvings, pieces=PIECES):
    found = signs(a, alpha, beta, pieces)
    if found is not None:
        return found == statement
    if halvings == 0:
        return False
    first, second = alpha[1] / alpha[0], beta[1] / beta[0]
    low, high = alpha if first >= second else beta
    middle = math.sqrt(low) * math.sqrt(high)
    if not low < middle < high:
        return False
    for half in ((low, middle), (middle, high)):
        parts = (half, beta) if first >= second else (alpha, half)
        if not holds(a, *parts, statement, halvings - 1, math.ceil(pieces * 1.4)):
            return False
    return True


def sides(cell, name):
    """Two doubles, 0 < low < high."""
    found = part(cell, name, list)
    need(
        len(found) == 2 and all(isinstance(x, float) and 0 < x < math.inf for x in found) and found[0] < found[1],
        "this is no cell",
    )
    return found


def verify(zone, halvings=HALVINGS):
    """Raise `Refused` unless every cell has the stated property; return the number of decided cells.

    What is refused is what is not proved of a cell; whether cells overlap, and how much they cover, is not looked at.
    """
    need(part(zone, "format", str) == FORMAT, f"the format is not “{FORMAT}”")
    a, count = rational(part(zone, "a", str), "a"), 0
    with precision(PRECISION):
        # The zone depends on |a| only: φ → φ + π changes its sign.
        size = abs(iv.mpf(a.numerator) / a.denominator)
        for cell in part(zone, "cells", list):
            alpha, beta, statement = sides(cell, "alpha"), sides(cell, "beta"), part(cell, "statement", str)
            need(statement in NAMES, "this is no statement of a cell")
            if statement == "undecided":
                continue
            need(holds(size, alpha, beta, statement, halvings), f"α in {alpha}, β in {beta}: {statement} is not proved")
            count += 1
    return count


if __name__ == "__main__":
    try:
        print(f"{verify(read(sys.argv[1:]))} cells hold")
    except Refused as error:
        sys.exit(f"refused: {error}")
