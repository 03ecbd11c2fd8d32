"""Cells of the lock zone: statements proved for a cell hold for tori inside it, and not across the boundary."""

import math
import random
from fractions import Fraction

import numpy as np
from pytest import approx, fixture, mark
from scipy.integrate import quad

from hess_mechanics import EdgeProof, circle_map, curve_point, f_max, level, lock_boundary, prove, turning_points
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.balls import enclosure, exact, working
from hess_mechanics.suslov_hess.lock_zone import (
    ZoneCell,
    _half_over,
    alpha_beta,
    cell_area,
    lock_zone,
    places,
    refined,
    region_area,
)
from hess_mechanics.suslov_hess.zone_directions import proved_by_directions
from support.refusals import refused

REFERENCE = level("reference")


@fixture(scope="module")
def zones():
    asked = ("0.5", 4.0, 60), ("2.5", 3.0, 80)
    return {a: lock_zone(a, h_end, cells) for a, h_end, cells in asked}


def around(h, f, radius):
    """Return the cell centred at a torus."""
    grow = math.exp(radius)
    return ZoneCell(*((x / grow, x * grow) for x in alpha_beta(turning_points(h, f).roots)))


def half_over(a, cell):
    """Enclosures of (A, B, C, D) for all tori of a cell."""
    with working(64):
        found, _ = _half_over(exact("a", a), cell)
        return [enclosure(x) for x in found]


def tori(rng, h_end, count):
    """Random tori (h, f), f > 0, even over the region."""
    found = []
    while len(found) < count:
        h, f = rng.uniform(-1, h_end), rng.uniform(0, f_max(h_end))
        if 0.01 < f < f_max(h):
            found.append((h, f))
    return found


def statement_at(zone, h, f):
    """Return the statement of the cells that contain this torus; None outside all cells."""
    place = alpha_beta(turning_points(h, f).roots)
    found = {cell.statement for cell in zone.cells if place in cell}
    return found.pop() if len(found) == 1 else None


def test_alpha_and_beta_name_a_torus_and_lead_back():
    for h, f in tori(random.Random(1), 5.0, 100):
        alpha, beta = alpha_beta(turning_points(h, f).roots)
        _, n1, n2 = turning_points(h, f).roots
        assert alpha == approx((1 - n1 * n1) / (n1 + n2) ** 2, rel=1e-9)
        assert beta == approx((1 - n2 * n2) / (n1 + n2) ** 2, rel=1e-9)
        assert alpha >= beta > 0
        assert places(np.array([alpha]), np.array([beta]))[0] == approx([h, f], rel=1e-9, abs=1e-12)
    h, f = curve_point(0.4)
    alpha, beta = alpha_beta(turning_points(h, f * (1 - 1e-15)).roots)
    assert alpha == approx(beta, rel=1e-6)


@mark.parametrize(
    ("a", "h", "f", "radius"),
    [
        ("0.5", 1.5, 0.6, 0.2),
        ("-1.3", 1.0, 1.2, 0.1),
        ("0.3", -0.5, 0.05, 0.25),
        ("0.5", 1.0, 1.5, 1e-6),
    ],
)
def test_the_half_map_of_any_torus_of_a_cell_is_enclosed(a, h, f, radius):
    """Against proofs of single tori, by other variables and other bounds; all four signs of two directions."""
    cell = around(h, f, radius)
    found = half_over(a, cell)
    rng = random.Random(5)
    assert max(enclosed.width for enclosed in found) < 70 * radius
    reached = 0.0
    for i in range(8):
        shares = (i & 1, i >> 1 & 1) if i < 4 else (rng.random(), rng.random())
        alpha, beta = (
            low * (high / low) ** (0.001 + 0.998 * share)
            for (low, high), share in zip((cell.alpha, cell.beta), shares, strict=True)
        )
        if alpha < beta:
            continue
        here, there = places(np.array([alpha]), np.array([beta]))[0]
        # The zone depends on |a| only: φ → φ + π changes its sign.
        half = prove(a.lstrip("-"), Fraction(here), Fraction(there), 64).half
        for known, enclosed in zip(half, found, strict=True):
            assert enclosed.low < known.low <= known.high < enclosed.high
            middle = (enclosed.low + enclosed.high) / 2
            reached = max(reached, float(2 * abs(known.low - middle) / enclosed.width))
    # The enclosure is also narrow enough to exclude wrong values.
    assert reached > 0.02


@mark.parametrize(
    ("a", "statement", "circle"), [("3", "two cycles", "two equilibria"), ("0.1", "no cycle", "periodic orbit")]
)
def test_a_cell_across_the_edge_speaks_of_tori_and_the_circle_there_has_its_own_statement(a, statement, circle):
    """h = 13/8, f = 15/8 has the double root n3 = 1/4, so α = β = 15/4."""
    zone = lock_zone(a, 4.0, 60)
    (cell,) = (cell for cell in zone.cells if (3.75, 3.75) in cell)
    assert cell.statement == statement
    on_it = prove(a, "13/8", "15/8")
    assert isinstance(on_it, EdgeProof)
    assert on_it.statement == circle
    assert on_it.n == Fraction(1, 4)
    assert prove(a, "13/8", Fraction(15, 8) - Fraction(1, 10**30)).statement == statement


def test_what_is_proved_of_cells_holds_for_tori_in_them(zones):
    rng = random.Random(2)
    for a, zone in zones.items():
        seen = {"two cycles": 0, "no cycle": 0, "undecided": 0}
        for h, f in tori(rng, zone.h_end, 200):
            said = statement_at(zone, h, f)
            if said is None:
                continue
            seen[said] += 1
            if said != "undecided":
                assert (circle_map(float(a), h, f, REFERENCE).trace > 2) == (said == "two cycles"), (a, h, f)
        # So often does the area say that a random torus is decided.
        shares = [zone.areas[name] / region_area(zone.h_end) for name in seen]
        assert [count / 200 for count in seen.values()] == approx(shares, abs=0.13)


def test_the_boundary_lies_in_undecided_cells_only(zones):
    for a, zone in zones.items():
        points = [(h, f) for h, f in lock_boundary(float(a), REFERENCE)[1:-1] if h < zone.h_end and f > 0.01]
        assert len(points) > 20
        assert {statement_at(zone, h, f) for h, f in points} <= {"undecided", None}
        assert sum(statement_at(zone, h, f) == "undecided" for h, f in points) > 0.8 * len(points)


@mark.parametrize("a", ["0.5", "2"])
def test_next_to_the_boundary_small_cells_are_decided_and_none_across_it(a):
    h, f = lock_boundary(float(a), REFERENCE)[20]
    for radius in (1e-3, 1e-6):
        found = [half_over(a, around(h + shift * radius, f, radius)) for shift in (-20, 0, 20)]
        below = [(b.low * c.high, b.high * c.high) for _, b, c, _ in found]
        signs = [1 if min(ends) > 0 else -1 if max(ends) < 0 else 0 for ends in below]
        assert signs == [-1, 0, 1]


@mark.parametrize(("a", "h", "f"), [(0.5, 1.5, 0.6), (0.5, 0.2, 0.5)])
def test_lines_next_to_one_torus_decide_what_its_map_does(a, h, f):
    theta, cell = circle_map(a, h, f, REFERENCE), around(h, f, 1e-4)
    with working(64) as library:
        said = [proved_by_directions(library.arb(a), cell.alpha, cell.beta, pieces) for pieces in (4, 400)]
        wide = proved_by_directions(library.arb(a), (1e-6, 1e6), (1e-6, 1e6), 50)
    assert said[1] == ("two cycles" if theta.trace > 2 else "no cycle")
    assert said[0] in (None, said[1])
    assert wide is None


def test_the_decided_share_grows_and_cells_cover_the_region(zones):
    zone = zones["0.5"]
    later = refined(zone, 60)
    assert lock_zone("0.5", 4.0, 10).decided < zone.decided < later.decided
    assert zone.decided > 0.7
    # With matrices alone, 60 cells left everything undecided for a = 2.
    assert zones["2.5"].decided > 0.85
    assert later.tried == zone.tried + 60
    for one in (zone, later):
        covered = sum(cell_area(cell, one.h_end) for cell in one.cells)
        assert covered == approx(region_area(4.0), rel=0.02)
    assert region_area(4.0) == approx(quad(f_max, -1 + 1e-12, 4.0)[0], rel=1e-6)


test_what_no_zone_is_proved_of_is_refused = refused(
    (lambda: lock_zone("6"), "≤ 3"),
    (lambda: lock_zone("x"), "exact"),
    (lambda: lock_zone("0.5", math.nan), "h > −1", OutsideRegion),
    (lambda: lock_zone("0.5", 1e9), "at most"),
    (lambda: lock_zone("0.5", 4.0, -1), "choose at most"),
)
