"""Signs of half a turn over a cell of the lock zone, by two lines between which all directions of solutions stay.

With the angle ψ, tan ψ = √(α/β) tan(s/2), the direction θ of a solution of the linear system of `lock_zone` obeys

    dθ/dψ = −½√(1 − ζ) − a√ζ q cos 2θ,   ζ = z/(1 + z),   1/z = cos²ψ/β + sin²ψ/α,   q = 1/(ρ cos²ψ + sin²ψ/ρ),

ρ = √(α/β), 0 ≤ ψ ≤ π/2.  A broken line that is everywhere steeper than the right-hand side on it, for all α and β of
the cell, stays above all solutions; likewise below.  From θ = 0 they lead to the quadrant of (A, C), from π/2 to that
of (B, D), and these signs decide.  The error is of first order in the size of the cell, but does not grow with e^{πa}:
where solutions run together, the lines do too.  See `hess_mechanics/proofs.md`.
"""

from __future__ import annotations

import math

from hess_mechanics.numerics.balls import ArbBall
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES

__all__ = ["proved_by_directions"]

_SIGNS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""Of cos θ and sin θ, by quadrants."""


def proved_by_directions(a: ArbBall, alpha: tuple[float, float], beta: tuple[float, float], pieces: int) -> str | None:
    """Return what is proved of all tori, α ≠ β, of a cell; None where nothing is.

    Parameters
    ----------
    a : not negative.
    alpha, beta : the ends of the cell, meant exactly.
    pieces : of each broken line.
    """
    from flint import arb

    parts = _coefficients(a, alpha, beta, pieces)
    width = arb.pi() / (2 * pieces)
    quadrants = []
    for start in (arb(0), arb.pi() / 2):
        low, high = (2 * _end(parts, width, start, sense) / arb.pi() for sense in (-1, 1))
        if not (low.is_finite() and high.is_finite()):
            return None
        k = math.floor(float(low))
        # Comparisons of balls are true only where they are certain.
        if not (low > k and high < k + 1):
            return None
        quadrants.append(_SIGNS[k % 4])
    (A, C), (B, D) = quadrants
    return TWO_CYCLES if B * C > 0 or A * D < 0 else NO_CYCLE


def _coefficients(
    a: ArbBall, alpha: tuple[float, float], beta: tuple[float, float], pieces: int
) -> list[tuple[ArbBall, ArbBall]]:
    """½√(1 − ζ) and a√ζ q on each piece, over the cell."""
    from flint import arb

    (a0, a1), (b0, b1) = ([arb(x) for x in ends] for ends in (alpha, beta))
    ratio = (a0 / b1).sqrt().union((a1 / b0).sqrt())
    found = []
    for i in range(pieces):
        sine, cosine = (
            x.nonnegative_part()
            for x in (y * y for y in (arb.pi() * arb(i).union(arb(i + 1)) / (2 * pieces)).sin_cos())
        )
        # z grows with α and with β.
        low, high = (1 / (cosine / b0 + sine / a0)).lower(), (1 / (cosine / b1 + sine / a1)).upper()
        zeta = (low / (1 + low)).union(high / (1 + high))
        found.append(((1 - zeta).sqrt() / 2, a * zeta.sqrt() / (ratio * cosine + sine / ratio)))
    return found


def _end(parts: list[tuple[ArbBall, ArbBall]], width: ArbBall, theta: ArbBall, sense: int) -> ArbBall:
    """Where the line above (1) or below (−1) all solutions from there ends."""
    for turn, drive in parts:
        # A slope no solution has is always good; others are tried, from the slopes that solutions have next to it.
        steep = sense * (turn + abs(drive)).upper()
        slope = _slope(turn, drive, theta + (width * steep).union(-width * steep), sense)
        for _ in range(2):
            there = _slope(turn, drive, theta.union(theta + width * slope), sense)
            if sense * (slope - there) >= 0:
                steep = slope
            slope = there
        end = theta + width * steep
        theta = end.upper() if sense > 0 else end.lower()
    return theta


def _slope(turn: ArbBall, drive: ArbBall, theta: ArbBall, sense: int) -> ArbBall:
    """The most, or the least, of the right-hand side over these angles."""
    found = -turn - drive * (2 * theta).cos()
    return found.upper() if sense > 0 else found.lower()
