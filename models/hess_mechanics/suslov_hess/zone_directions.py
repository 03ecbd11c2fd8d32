"""Signs of the half map over a cell of the lock zone, from polygonal bounds of the directions of solutions.

With the angle ψ, tan ψ = √(α/β) tan(s/2), the direction θ of a solution of the linear system of `lock_zone` obeys

    dθ/dψ = −½√(1 − ζ) − a√ζ q cos 2θ,   ζ = z/(1 + z),   1/z = cos²ψ/β + sin²ψ/α,   q = 1/(ρ cos²ψ + sin²ψ/ρ),

ρ = √(α/β), 0 ≤ ψ ≤ π/2.  A polygonal line that is everywhere steeper than the right-hand side on it, for all α and β
of the cell, stays above all solutions; similarly for a line below.  The lines from θ = 0 give the quadrant of (A, C),
those from π/2 the quadrant of (B, D), and these signs decide.  The error is of first order in the size of the cell,
but does not grow with e^{πa}: the lines converge where the solutions do.  See `hess_mechanics/proofs.md`.
"""

from __future__ import annotations

import math

from hess_mechanics.numerics.balls import ArbBall
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES

__all__ = ["proved_by_directions"]

_SIGNS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
"""Signs of cos θ and sin θ in the four quadrants."""


def proved_by_directions(a: ArbBall, alpha: tuple[float, float], beta: tuple[float, float], pieces: int) -> str | None:
    """Return the statement proved for all tori, α ≠ β, of a cell; None if nothing is proved.

    Parameters
    ----------
    a : ArbBall
        The coupling, not negative.
    alpha : tuple of two floats
        Ends of the interval of α, taken as exact.
    beta : tuple of two floats
        Ends of the interval of β, taken as exact.
    pieces : int
        Number of pieces of each polygonal line.

    Returns
    -------
    str or None
        `TWO_CYCLES`, `NO_CYCLE` or None.
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
        # A comparison of balls is true only if it is certain.
        if not (low > k and high < k + 1):
            return None
        quadrants.append(_SIGNS[k % 4])
    (A, C), (B, D) = quadrants
    return TWO_CYCLES if B * C > 0 or A * D < 0 else NO_CYCLE


def _coefficients(
    a: ArbBall, alpha: tuple[float, float], beta: tuple[float, float], pieces: int
) -> list[tuple[ArbBall, ArbBall]]:
    """Return ½√(1 − ζ) and a√ζ q on each piece, enclosed over the cell."""
    from flint import arb

    (a0, a1), (b0, b1) = ([arb(x) for x in ends] for ends in (alpha, beta))
    ratio = (a0 / b1).sqrt().union((a1 / b0).sqrt())
    found = []
    for i in range(pieces):
        sine, cosine = (
            x.nonnegative_part()
            for x in (y * y for y in (arb.pi() * arb(i).union(arb(i + 1)) / (2 * pieces)).sin_cos())
        )
        # z increases with α and with β.
        low, high = (1 / (cosine / b0 + sine / a0)).lower(), (1 / (cosine / b1 + sine / a1)).upper()
        zeta = (low / (1 + low)).union(high / (1 + high))
        found.append(((1 - zeta).sqrt() / 2, a * zeta.sqrt() / (ratio * cosine + sine / ratio)))
    return found


def _end(parts: list[tuple[ArbBall, ArbBall]], width: ArbBall, theta: ArbBall, sense: int) -> ArbBall:
    """Return the end of the line from `theta` above (sense = 1) or below (sense = −1) all solutions."""
    for turn, drive in parts:
        # A slope beyond those of all solutions is always valid; try tighter ones from the slopes near the line.
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
    """Return the maximum (sense = 1) or the minimum (sense = −1) of the right-hand side over the angles `theta`."""
    found = -turn - drive * (2 * theta).cos()
    return found.upper() if sense > 0 else found.lower()
