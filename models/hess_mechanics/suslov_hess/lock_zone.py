"""Proofs over the lock zone in (h, f): cells in which all tori have two limit cycles, or none has.

With σ = n1 + n2, α = (1 − n1²)/σ² and β = (1 − n2²)/σ² the linear system of `proof` depends on α and β alone:

    u = √(αβ)/(4z√(1 + z)),   v = (a/2)√(z/(1 + z)),   z = α sin²(s/2) + β cos²(s/2),
    dx/ds = (u − v) y,   dy/ds = −(u + v) x,

since n0 = −h − σ, |w|² = 2σz, n3 − n0 = σ(1 + z).  Each torus with f > 0 has one pair α > β > 0, and

    σ = 2/√((1 + α + β)² − 4αβ),   h = (α + β − 1)σ/2,   f = √(2αβ) σ^(3/2).

Exchanging α and β is s → π − s, which conserves BC and AD.  So a cell may extend across α = β, the edge of the region.
Its statement is about its tori, α ≠ β.  On α = β there is no torus but a circle of states, see `edge`: in a cell with
"two cycles" it has exactly two equilibria, in a cell with "no cycle" it is one periodic orbit.

A cell is a rectangle of (α, β).  Along a straight line of (ln α, ln β) from its centre, P = Pc(1 + Y1 + R), where Pc
is P at the centre, and Y1 is linear and follows from the variational equations there (Taylor steps with Cauchy's bound,
as in `proof`).  With the matrix M of the system, and bounds over the cell,

    R' = F(Y1 + R) + F2,   |F| ≤ |Pc⁻¹| |M'| |Pc|,   |F2| ≤ ½ |Pc⁻¹| |M''| |Pc|;

logarithmic derivatives of u and v are sums of fractions between 0 and 1, hence bounded for every cell.  The error is
of second order in the size of the cell, so that only cells on the boundary |t| = 2 remain undecided.  They are halved
across the side that contributes more to the error.  That needs small cells, and for large |a| very small ones, so each
cell is first tried by `zone_directions`.
The theorem and its proof are in `hess_mechanics/proofs.md`; they are not in the paper.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from operator import mul
from typing import Any

import numpy as np

from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.balls import (
    ArbBall,
    ExactNumber,
    exact,
    rational,
    series_coefficients,
    working,
)
from hess_mechanics.numerics.labelled import Printed
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES, UNDECIDED
from hess_mechanics.suslov_hess.zone_directions import proved_by_directions

__all__ = [
    "MOST_A",
    "LockZone",
    "ZoneCell",
    "alpha_beta",
    "cell_area",
    "cell_outline",
    "lock_zone",
    "places",
    "refined",
    "region_area",
]

MOST_A, _MOST_H, _MOST_CELLS = 3.0, 1e3, 100_000
_BITS = 64
_TAIL_BITS = 18
"""Bits of the remainder of a Taylor step: far smaller than the error over a cell."""
_STEPS = 120
"""Largest number of steps; halving the cell is cheaper than more."""
_LARGEST, _LARGEST_LINEAR, _SMALL = 1.2, 0.5, 0.15
"""Largest half logarithm of α1/α0 or β1/β0 of a cell: to be tried at all; to be tried by its matrix, for a = 0 (less
for other a); to be tried by lines of four times as many pieces."""
_PIECES = 48
_PARTS = 2
"""Number of parts of each step; bounds over the cell are constant on a part."""
_ENDS = 2.0**-20, 2.0**20
"""Range of α and β: everything beyond is undecided, f < 0.003 for most h."""
_SHARE, _GROWTH, _STEP = 0.8, 8.0, 0.25
_BEND = 12.0
"""Points along each side of an outline whose ends differ by 2 in their logarithms."""


@dataclass(frozen=True)
class ZoneCell:
    """Cell of all tori, α ≠ β, in a rectangle of (α, β), and the statement proved for all of them.

    Attributes
    ----------
    alpha : tuple of two floats
        Ends of the interval of α, taken as exact.
    beta : tuple of two floats
        Ends of the interval of β, taken as exact.
    statement : str
        `TWO_CYCLES`, `NO_CYCLE` or `UNDECIDED`.
    across : int or None
        Side, 0 (α) or 1 (β), across which an undecided cell is halved.

    Notes
    -----
    If a cell meets the edge, α = β, its statement does not include the circles of states there.
    """

    alpha: tuple[float, float]
    beta: tuple[float, float]
    statement: str = UNDECIDED
    across: int | None = None

    def __contains__(self, place: tuple[float, float]) -> bool:
        return all(low <= x <= high for x, (low, high) in zip(place, (self.alpha, self.beta), strict=True))


@dataclass(frozen=True)
class LockZone(Printed):
    """Proved cells of the lock zone for −1 < h ≤ h_end and f > 0; f < 0 is symmetric.

    Attributes
    ----------
    a : Fraction
        The coupling.
    h_end : float
        Largest energy, in units b = 1.
    cells : tuple of ZoneCell
        Cells that cover the region except a strip next to f = 0 and h = −1.
    tried : int
        Number of cells for which a proof was tried.
    """

    a: Fraction
    h_end: float
    cells: tuple[ZoneCell, ...]
    tried: int

    @cached_property
    def areas(self) -> dict[str, float]:
        """Area in (h, f) of each statement, in double precision; the area outside all cells counts as undecided."""
        found = dict.fromkeys((TWO_CYCLES, NO_CYCLE, UNDECIDED), 0.0)
        for cell in self.cells:
            if cell.statement != UNDECIDED:
                found[cell.statement] += cell_area(cell, self.h_end)
        found[UNDECIDED] = max(0.0, region_area(self.h_end) - sum(found.values()))
        return found

    @property
    def decided(self) -> float:
        """The decided share of the area."""
        return 1.0 - self.areas[UNDECIDED] / region_area(self.h_end)


def lock_zone(a: ExactNumber, h_end: float = 4.0, cells: int = 200) -> LockZone:
    """Prove where in the region of (h, f) all tori have two limit cycles, and where none has.

    Parameters
    ----------
    a : str, float or Fraction
        The coupling a = I23/I22, |a| ≤ 3, taken as exact, see `balls.exact`.
    h_end : float, optional
        Largest energy, −1 < h_end ≤ 1000, in units b = 1.
    cells : int, optional
        Number of cells for which a proof is tried.

    Returns
    -------
    LockZone
        Cells in (α, β) with their statements.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a, h_end or cells is out of range.
    OutsideRegion
        If h_end ≤ −1.

    References
    ----------
    `eq0003`.  The theorem is not in the paper, see `hess_mechanics/proofs.md`.

    Examples
    --------
    >>> from hess_mechanics import lock_zone
    >>> zone = lock_zone("0.5", cells=20)
    >>> zone.tried, round(zone.decided, 2)
    (20, 0.65)
    """
    number = exact("a", a)
    if abs(number) > MOST_A:
        raise InvalidParameter(f"a = {float(number):g}: cells of the lock zone are proved for |a| ≤ {MOST_A:g}.")
    if not h_end > -1.0:
        raise OutsideRegion(f"h = {h_end:g} is not above the lowest energy: choose h > −1.")
    if not h_end <= _MOST_H:
        raise InvalidParameter(f"h = {h_end:g}: the lock zone is proved up to h = {_MOST_H:g} at most.")
    return refined(LockZone(number, float(h_end), (ZoneCell(_ENDS, _ENDS),), 0), cells)


def refined(zone: LockZone, cells: int) -> LockZone:
    """Return the lock zone after proofs for a further number of cells, always the largest undecided one first.

    Raises `MissingLibrary`, `InvalidParameter`.
    """
    if not 0 <= cells <= _MOST_CELLS:
        raise InvalidParameter(f"{cells} cells: choose at most {_MOST_CELLS}.")
    done = [cell for cell in zone.cells if cell.statement != UNDECIDED]
    # The counter breaks ties between equal areas, so that cells are never compared.
    open_ = [
        (-cell_area(cell, zone.h_end), i, cell) for i, cell in enumerate(zone.cells) if cell.statement == UNDECIDED
    ]
    heapq.heapify(open_)
    count, tried = len(zone.cells), 0
    while open_ and tried < cells:
        go_on()
        area, _, cell = heapq.heappop(open_)
        if area == 0.0:
            # All remaining cells lie beyond h_end.
            break
        if cell.across is None and max(_radii(cell)) <= _LARGEST:
            cell = _proved(zone.a, cell)
            tried += 1
            if cell.statement != UNDECIDED:
                done.append(cell)
                continue
        for half in _halves(cell):
            own = cell_area(half, zone.h_end)
            if own > 0.0:
                heapq.heappush(open_, (-own, count, half))
                count += 1
    return replace(zone, cells=(*done, *(cell for _, _, cell in open_)), tried=zone.tried + tried)


def _radii(cell: ZoneCell) -> tuple[float, float]:
    """Return half the logarithms of α1/α0 and β1/β0."""
    return 0.5 * math.log(cell.alpha[1] / cell.alpha[0]), 0.5 * math.log(cell.beta[1] / cell.beta[0])


def _halves(cell: ZoneCell) -> Iterator[ZoneCell]:
    across = cell.across
    if across is None:
        across = int(np.argmax(_radii(cell)))
    low, high = (cell.alpha, cell.beta)[across]
    middle = math.sqrt(low) * math.sqrt(high)
    for ends in ((low, middle), (middle, high)):
        yield ZoneCell(ends, cell.beta) if across == 0 else ZoneCell(cell.alpha, ends)


# ---- Geometry of the cells ------------------------------------------------------------------------------------------


def alpha_beta(roots: tuple[float, float, float]) -> tuple[float, float]:
    """Return (α, β) of a torus, from n0, n1, n2 of `turning_points`."""
    n0, n1, n2 = roots
    total = n1 + n2
    # 1 − n1² = σ(h + n2) and h = −n0 − n1 − n2 avoid the cancellation in 1 − n1².
    return -(n0 + n1) / total, -(n0 + n2) / total


def places(alpha: Array, beta: Array) -> Array:
    """Return (h, f) of each pair (α, β); shape (n, 2)."""
    sigma = 2.0 / np.sqrt((1.0 + alpha + beta) ** 2 - 4.0 * alpha * beta)
    return np.column_stack([0.5 * (alpha + beta - 1.0) * sigma, np.sqrt(2.0 * alpha * beta) * sigma**1.5])


def cell_outline(cell: ZoneCell, h_end: float) -> Array:
    """Return the outline (n, 2) in (h, f) of the part of a cell with β ≤ α and h ≤ h_end; it may be empty."""
    (x0, x1), (y0, y1) = (np.log(ends) for ends in (cell.alpha, cell.beta))
    corners = _cut(np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]), np.array([1.0, -1.0]), 0.0)
    if len(corners) < 3:
        return np.empty((0, 2))
    count = max(1, math.ceil(_BEND * max(_radii(cell))))
    share = np.arange(min(count, 6))[:, None] / min(count, 6)
    sides = np.vstack([p + share * (q - p) for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True)])
    return _cut(places(*np.exp(sides).T), np.array([-1.0, 0.0]), -h_end)


def _cut(polygon: Array, normal: Array, least: float) -> Array:
    """Return the part of a convex or nearly convex polygon with (normal, x) ≥ least."""
    over = polygon @ normal - least
    if np.all(over >= 0.0):
        return polygon
    kept: list[Array] = []
    for p, q, here, there in zip(polygon, np.roll(polygon, -1, axis=0), over, np.roll(over, -1), strict=True):
        if here >= 0.0:
            kept.append(p)
        if (here > 0.0) != (there > 0.0) and here != there:
            kept.append(p + here / (here - there) * (q - p))
    return np.array(kept).reshape(-1, 2)


def cell_area(cell: ZoneCell, h_end: float) -> float:
    """Return the area of the outline of a cell."""
    outline = cell_outline(cell, h_end)
    if len(outline) < 3:
        return 0.0
    x, y = (outline - outline[0]).T
    return 0.5 * abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))


def region_area(h_end: float) -> float:
    """Return ∫ f_max dh from −1 to h_end, as an integral of (1 − n²)(1 + 3n²)/(2n^(5/2)) over n on the edge."""
    n = 1.0 / (h_end + math.sqrt(h_end * h_end + 3.0))

    def primitive(n: float) -> float:
        return -1.0 / (3.0 * n * math.sqrt(n)) + 2.0 * math.sqrt(n) - 0.6 * n * n * math.sqrt(n)

    return primitive(1.0) - primitive(n)


# ---- Proof of one cell ----------------------------------------------------------------------------------------------


def _proved(a: Fraction, cell: ZoneCell) -> ZoneCell:
    """Return the cell with the statement proved for all of its tori, or with the side across which to halve it."""
    with working(_BITS) as library:
        size, radius = abs(library.arb(rational(a))), max(_radii(cell))
        linear = radius <= _LARGEST_LINEAR / (1.0 + 0.5 * float(a) ** 2)
        pieces = math.ceil(_PIECES * max(1.0, 0.5 * abs(float(a))) * (4 if radius < _SMALL and not linear else 1))
        statement = proved_by_directions(size, cell.alpha, cell.beta, pieces)
        if statement is not None:
            return replace(cell, statement=statement)
        found = _half_over(a, cell) if linear else None
        if found is None:
            return replace(cell, across=int(np.argmax(_radii(cell))))
        (A, B, C, D), across = found
        # A comparison of balls is true only if it is certain.
        small, large = B * C, A * D
        if small > 0 or large < 0:
            return replace(cell, statement=TWO_CYCLES)
        if small < 0 and large > 0:
            return replace(cell, statement=NO_CYCLE)
        return replace(cell, across=across)


Pair = tuple[ArbBall, ArbBall]
Column = tuple[list[Any], list[list[Any]], ArbBall]
"""Polynomials of a step: x and y; their derivatives by ln α and ln β; the ball of the remainder."""


def _half_over(a: Fraction, cell: ZoneCell) -> tuple[tuple[ArbBall, ...], int] | None:
    """Return (A, B, C, D) over a cell and the side, 0 or 1, that contributes more to their width, or None."""
    from flint import arb

    A = abs(arb(rational(a)))
    ends = [[arb(x) for x in pair] for pair in (cell.alpha, cell.beta)]
    centre = [(low * high).sqrt() for low, high in ends]
    radii = [((high / low).log() / 2).upper() for low, high in ends]
    zero, one = arb(0), arb(1)
    columns = [([one, zero], [[zero, zero], [zero, zero]]), ([zero, one], [[zero, zero], [zero, zero]])]
    rest = [[zero, zero], [zero, zero]]
    change = [0.0, 0.0]
    plan = _plan(abs(float(a)), *(float(x.mid()) for x in centre))
    if len(plan) > _STEPS:
        return None
    starts = [arb(s) for s, _, _ in plan]
    for s, end, (_, radius, terms) in zip(starts, [*starts[1:], arb.pi()], plan, strict=True):
        delta = end - s
        step = _step(A, centre, radii, s, arb(radius), delta, terms, columns)
        if step is None:
            return None
        for j in range(_PARTS):
            part, width = (delta * j / _PARTS).union(delta * (j + 1) / _PARTS), (delta / _PARTS).upper()
            first, second, each = _bounds(A, centre, ends, radii, s + part)
            rest = _with_rest(rest, step, part, width, first, second)
            change = [old + float(width * new) for old, new in zip(change, each, strict=True)]
        columns = [
            ([p(delta) + tail for p in xy], [[p(delta) + tail for p in pair] for pair in pairs])
            for xy, pairs, tail in step
        ]
    found, linear, left = [], [], []
    for i, k in ((0, 0), (0, 1), (1, 0), (1, 1)):
        linear.append([columns[k][1][d][i].abs_upper() for d in (0, 1)])
        left.append((abs(columns[0][0][i]) * rest[0][k] + abs(columns[1][0][i]) * rest[1][k]).upper())
        found.append(columns[k][0][i] + arb(0, (linear[-1][0] + linear[-1][1] + left[-1]).upper()))
    if not all(x.is_finite() for x in found):
        return None
    # Use the width of B, whose sign decides in most cells.
    doubt = [float(linear[1][d]) + float(left[1]) * change[d] / (change[0] + change[1]) for d in (0, 1)]
    return tuple(found), int(doubt[1] > doubt[0])


def _with_rest(
    rest: list[list[ArbBall]], step: list[Column], part: ArbBall, width: ArbBall, first: Pair, second: Pair
) -> list[list[ArbBall]]:
    """Return bounds of R at the end of a part of a step, from those at its start."""
    X = [[step[k][0][i](part) + step[k][2] for k in (0, 1)] for i in (0, 1)]
    inverse = [[X[1][1], -X[0][1]], [-X[1][0], X[0][0]]]
    Y1 = [[0, 0], [0, 0]]
    for d in (0, 1):
        D = [[step[k][1][d][i](part) + step[k][2] for k in (0, 1)] for i in (0, 1)]
        Y1 = [
            [(Y1[i][k] + abs(inverse[i][0] * D[0][k] + inverse[i][1] * D[1][k])).upper() for k in (0, 1)]
            for i in (0, 1)
        ]
    F, F2 = _turned(X, first), _turned(X, second)
    return _grown(
        F,
        width,
        [
            [(rest[i][k] + width * (F[i][0] * Y1[0][k] + F[i][1] * Y1[1][k] + F2[i][k])).upper() for k in (0, 1)]
            for i in (0, 1)
        ],
    )


def _plan(a: float, alpha: float, beta: float) -> list[tuple[float, float, int]]:
    """Return (start, radius, terms) of each step for the centre, chosen in double precision."""
    q, m, k = math.sqrt(alpha * beta), 0.5 * (alpha + beta), 0.5 * (alpha - beta)
    found: list[tuple[float, float, int]] = []
    s = 0.0
    while s < math.pi and len(found) <= _STEPS:
        z, c, d = m - k * math.cos(s), abs(k * math.cos(s)), abs(k * math.sin(s))

        def growth(r: float, z: float = z, c: float = c, d: float = d) -> float:
            change = c * 2.0 * math.sinh(0.5 * r) ** 2 + d * math.sinh(r)
            if change > _SHARE * z:
                return math.inf
            low, high = z - change, z + change
            return r * (q / (4.0 * low) + 0.5 * a * math.sqrt(high)) / math.sqrt(1.0 + low)

        r = 2.0
        while not growth(r) <= _GROWTH * 0.999:
            r *= 0.85
        found.append((s, r, math.ceil(0.5 * (_TAIL_BITS + growth(r) / math.log(2.0))) + 3))
        s += _STEP * r
    return found


def _step(
    A: ArbBall,
    centre: list[ArbBall],
    radii: list[ArbBall],
    s: ArbBall,
    r: ArbBall,
    delta: ArbBall,
    terms: int,
    columns: list[tuple[list[ArbBall], list[list[ArbBall]]]],
) -> list[Column] | None:
    """Return the columns of P and of radius · ∂P/∂ ln α, radius · ∂P/∂ ln β along a step; None if it is too long."""
    from flint import arb, arb_poly, arb_series, ctx

    ctx.cap = terms
    zero = arb(0)
    alpha, beta = centre
    cosine = arb_series([s, 1]).cos().coeffs()
    change = abs(s.cos()) * 2 * (r / 2).sinh() ** 2 + abs(s.sin()) * r.sinh()
    z0, k = (alpha + beta - (alpha - beta) * cosine[0]) / 2, (alpha - beta) / 2
    low, high = z0 - abs(k) * change, z0 + abs(k) * change
    if not (low > 0 and delta < r):
        return None
    q = (alpha * beta).sqrt()
    u_most, v_most = q / (4 * low * (1 + low).sqrt()), A / 2 * (high / (1 + low)).sqrt()

    z = arb_series([z0, *(-k * c for c in cosine[1:])])
    root, inverse = (1 + z).rsqrt(), 1 / z
    u, v = q * root * inverse / 4, A / 2 * root * z.sqrt()
    upper, lower = (series_coefficients(series, terms) for series in (u - v, -u - v))
    one = arb_series([(1 - cosine[0]) / 2, *(-c / 2 for c in cosine[1:])])
    derivatives, most = [], zero
    for number, radius, shape in ((alpha, radii[0], one), (beta, radii[1], 1 - one)):
        # (ln z)' = share, (ln u)' = 1/2 − share (1 + z/(2(1 + z))), (ln v)' = share/(2(1 + z)).
        share = number * shape * inverse
        du = radius * u * (arb_series([arb(1) / 2]) - share * (1 + z * root * root / 2))
        dv = radius * v * share * root * root / 2
        derivatives.append([series_coefficients(series, terms) for series in (du - dv, -du - dv)])
        largest = number * (abs(shape.coeffs()[0]) + change / 2) / low
        most = _largest(
            most,
            radius * (u_most * (largest * (1 + high / (2 * (1 + low))) + 0.5) + v_most * largest / (2 * (1 + low))),
        )
    tau = delta / r
    remainder = ((u_most + v_most + most) * r).exp() * tau**terms / (1 - tau)

    found: list[Column] = []
    for (x0, y0), starts in columns:
        x, y = [x0], [y0]
        pairs = [([dx], [dy]) for dx, dy in starts]
        size = _largest(x0, y0, *(d for pair in starts for d in pair))
        for n in range(terms - 1):
            back_x, back_y = x[::-1], y[::-1]
            for (dx, dy), (du, dl) in zip(pairs, derivatives, strict=True):
                following = (
                    sum(map(mul, upper, dy[::-1]), zero) + sum(map(mul, du, back_y), zero),
                    sum(map(mul, lower, dx[::-1]), zero) + sum(map(mul, dl, back_x), zero),
                )
                dx.append(following[0] / (n + 1))
                dy.append(following[1] / (n + 1))
            x.append(sum(map(mul, upper, back_y), zero) / (n + 1))
            y.append(sum(map(mul, lower, back_x), zero) / (n + 1))
        found.append(
            (
                [arb_poly(x), arb_poly(y)],
                [[arb_poly(dx), arb_poly(dy)] for dx, dy in pairs],
                arb(0, (remainder * size).abs_upper()),
            )
        )
    return found


def _largest(*numbers: ArbBall) -> ArbBall:
    """Return the largest absolute value, without rounding."""
    found = numbers[0].abs_upper()
    for number in numbers[1:]:
        found = found.max(number.abs_upper())
    return found


def _bounds(
    A: ArbBall, centre: list[ArbBall], ends: list[list[ArbBall]], radii: list[ArbBall], s: ArbBall
) -> tuple[Pair, Pair, list[ArbBall]]:
    """Return bounds over a cell and a part of a step.

    They are bounds of |u'| and |v'|, of ½|u''| and ½|v''|, and of |u'| + |v'| along each side.
    """
    from flint import arb

    sine, cosine = (s / 2).sin() ** 2, (s / 2).cos() ** 2
    (a0, a1), (b0, b1) = ends
    half, one = arb(1) / 2, arb(1)
    # share = α sin²/z increases with α/β and s, and ζ = z/(1 + z) with α and β: their ends give their range.
    s0, s1 = _nonnegative(sine)
    c0, c1 = _nonnegative(cosine)
    share = (a0 * s0 / (a0 * s0 + b1 * c1)).union(a1 * s1 / (a1 * s1 + b0 * c0))
    z0, z1 = a0 * s0 + b0 * c0, a1 * s1 + b1 * c1
    zeta = (z0 / (1 + z0)).union(z1 / (1 + z1))
    rx, ry = radii
    factor = 1 + zeta / 2
    du = [(abs(half - share * factor) * rx).upper(), (abs(half - (1 - share) * factor) * ry).upper()]
    shares = [(abs(share) * rx).upper(), (abs(1 - share) * ry).upper()]
    dv = [(abs(1 - zeta) / 2 * x).upper() for x in shares]
    z = centre[0] * sine + centre[1] * cosine
    rise, lift = du[0] + du[1], dv[0] + dv[1]
    u_most = ((centre[0] * centre[1]).sqrt() / (4 * z * (1 + z).sqrt())).abs_upper() * rise.exp()
    v_most = (A / 2 * (1 / (1 + 1 / z)).sqrt()).abs_upper() * lift.exp()
    # (ln z)'' = share (1 − share) (difference of the logarithmic directions)², ζ' = ζ(1 − ζ) (ln z)'.
    bend = (share * (1 - share)).abs_upper() * (rx + ry) ** 2
    curve = (zeta * (1 - zeta)).abs_upper() / 2 * (shares[0] + shares[1]) ** 2
    first = (u_most * rise).upper(), (v_most * lift).upper()
    second = (
        (u_most / 2 * (rise**2 + bend * factor + curve)).upper(),
        (v_most / 2 * (lift**2 + bend * (one - zeta) / 2 + curve)).upper(),
    )
    return first, second, [(u_most * du[i] + v_most * dv[i]).upper() for i in (0, 1)]


def _nonnegative(x: ArbBall) -> tuple[ArbBall, ArbBall]:
    """Return the ends of a ball that encloses a nonnegative number."""
    from flint import arb

    low = x.lower()
    return low if low > 0 else arb(0), x.upper()


def _turned(X: list[list[ArbBall]], most: Pair) -> list[list[ArbBall]]:
    """Return |P⁻¹ E P| for E = ((0, e − g), (−e − g, 0)), from bounds of |e| and |g|."""
    (A, B), (C, D) = X
    e, g = most
    # The coefficients of e and of g in the entries of P⁻¹ E P.
    entries = [
        [(D * C + B * A, B * A - D * C), (D * D + B * B, B * B - D * D)],
        [(-C * C - A * A, C * C - A * A), (-C * D - A * B, C * D - A * B)],
    ]
    return [[(abs(p) * e + abs(q) * g).upper() for p, q in row] for row in entries]


def _grown(F: list[list[ArbBall]], width: ArbBall, R: list[list[ArbBall]]) -> list[list[ArbBall]]:
    """Return bounds of e^(F width) R, for matrices with nonnegative entries."""
    T = [[width * x for x in row] for row in F]
    norm = _largest(T[0][0] + T[0][1], T[1][0] + T[1][1])
    more = norm * norm / 2 * norm.exp()
    return [
        [(R[i][k] + (T[i][0] + more) * R[0][k] + (T[i][1] + more) * R[1][k]).upper() for k in (0, 1)] for i in (0, 1)
    ]
