"""Roots of one step's polynomial: none lost, none doubled, each accurate to round-off."""

import mpmath
import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from pytest import approx, mark, param
from scipy.optimize import brentq

from hess_mechanics.numerics import events_kernels as crossings

EPS = np.finfo(float).eps


class Pieces(np.ndarray):
    """Scratch space for the subintervals, which stops an endless search."""

    def __setitem__(self, place, value):
        self.written = getattr(self, "written", 0) + 1
        assert self.written < 2 * self.enough, "the search does not end"
        super().__setitem__(place, value)


def found_roots(e, h, below=None, end=None, enough=50_000):
    """Run `roots_on_step` with at most `enough` bisections; the signs at the ends default to those of e.

    Uncompiled, so that one root too many raises an error instead of writing outside the array.
    """
    e = np.array(e, float)
    end = np.polyval(e[::-1], h) if end is None else end
    below = bool(e[0] < 0.0) if below is None else below
    roots = np.full(e.size, np.nan)
    pieces = np.zeros((crossings._DEPTH + 2, 2)).view(Pieces)
    pieces.enough = enough
    found = crossings.roots_on_step.py_func(e, h, below, end, bool(end < 0.0), 0, roots, pieces)
    return roots[:found]


def reach(e, s, h):
    """Bound the distance from a root s at which double precision may locate it on [0, h].

    Horner's rule errs by at most 2n ε Σ|e_k| h^k, coefficients multiplied out from their roots by about as much
    again; the slope turns that into a distance.  s itself is rounded, and the search may stop at 1e-16 of h.
    """
    e = np.array(e, float)
    noise = 4.0 * e.size * EPS * float(np.polyval(np.abs(e[::-1]), h))
    return noise / abs(np.polyval(np.polyder(e[::-1]), s)) + 2.0 * EPS * h


def agree(found, e, roots, h):
    return len(found) == len(roots) and all(abs(a - b) <= reach(e, b, h) for a, b in zip(found, roots, strict=True))


def product(roots, others=(1.0,)):
    """∏ (s − r) and another polynomial."""
    return (Polynomial.fromroots(roots) * Polynomial(others)).coef


with_others = mark.parametrize(
    "others",
    [
        param((1.0,), id="alone"),
        param((2.0, 0.0, 1.0), id="with a complex pair"),
        param((3.0, 1.0, 0.5, -0.25, 0.125), id="with four more far away"),
    ],
)


@mark.parametrize("height", [1e-6, 1e-10, 1e-14])
def test_what_is_flat_at_first_is_not_halved_away(height):
    """s²⁰ bends by 380 at the end and hardly at the start: uniform pieces for the largest bend would be 2e5."""
    e = np.zeros(21)
    e[0], e[20] = height, -1.0
    found = found_roots(e, 1.0, enough=200)
    assert found == approx([height**0.05], rel=1e-14)
    e[20] = 1.0
    assert len(found_roots(e, 1.0, enough=200)) == 0


@mark.parametrize(("depth", "count"), [(1e-3, 0), (1e-13, 0), (-1e-13, 2), (-1e-3, 2)])
@mark.parametrize("root", [0.5, 0.7123456789])
@mark.parametrize("sign", [1.0, -1.0])
def test_a_turning_this_near_the_plane_is_on_its_side(depth, count, root, sign):
    # A plane that is touched is not crossed: at 1/2 that is exact.
    assert len(found_roots(product((0.5, 0.5)), 1.0)) == 0
    e = product((root, root))
    e[0] += depth
    found = found_roots(sign * e, 1.0)
    assert len(found) == count
    if count:
        apart = np.sqrt(-depth)
        # The turning is known to some 1e-16 of its height, the roots to that over twice their distance.
        assert found == approx([root - apart, root + apart], abs=4 * EPS / apart)


@mark.parametrize("rounding", [-1e-17, 0.0, 1e-17])
@mark.parametrize("direction", [1.0, -1.0])
@with_others
def test_a_crossing_where_two_steps_meet_is_seen_exactly_once(rounding, direction, others):
    # From −1 to 1 through 0 in two steps; where they meet, round-off says how high the orbit is.
    whole = Polynomial(direction * np.array([0.0, *others]))
    first = whole(Polynomial([-1.0, 1.0])).coef
    places = [*(found_roots(first, 1.0, end=rounding) - 1.0), *found_roots(whole.coef, 1.0, below=rounding < 0.0)]
    assert places == approx([0.0], abs=1e-14)


@mark.parametrize("direction", [1.0, -1.0])
def test_a_step_that_starts_or_ends_on_the_plane_keeps_its_other_roots(direction):
    e = direction * product((0.0, 0.5, 1.0))
    leaving = direction > 0.0
    # Told that it comes from the side to which it goes: the start is no root.
    assert found_roots(e, 1.0, below=not leaving, end=0.0)[0] == approx(0.5, abs=EPS)
    # Told that it comes from the other side: it is one.
    assert found_roots(e, 1.0, below=leaving, end=0.0)[:2] == approx([0.0, 0.5], abs=EPS)
    # Being on the plane counts as above it: so the end is a root of a step that comes from below.
    assert len(found_roots(e, 1.0, below=not leaving, end=0.0)) == (2 if leaving else 1)


def changes_of_side(e, h):
    """The roots of e in (0, h) at which it changes sides; None where it turns, starts or ends too near 0 to tell.

    Between two neighbours among the turnings, which `numpy.roots` finds, there is one root or none.
    """
    turnings = np.roots(np.trim_zeros(np.polyder(e[::-1]), "f"))
    inside = turnings.real[(np.abs(turnings.imag) < 1e-6) & (turnings.real > 0.0) & (turnings.real < h)]
    places = np.array([0.0, *np.sort(inside), h])
    heights = np.polyval(e[::-1], places)
    if np.any(np.abs(heights) < 1e-7 * np.polyval(np.abs(e[::-1]), h)):
        return None
    return [
        brentq(lambda s: np.polyval(e[::-1], s), low, high, xtol=4 * EPS, rtol=4 * EPS)
        for low, high, left, right in zip(places, places[1:], heights, heights[1:], strict=False)
        if left * right < 0.0
    ]


@given(st.lists(st.integers(-1000, 1000), min_size=2, max_size=25), st.floats(0.1, 1.5))
def test_random_polynomials_have_the_roots_that_numpy_finds(coefficients, h):
    e = np.array(coefficients) / 1000.0
    assume(np.any(e[1:]))
    roots = changes_of_side(e, h)
    assume(roots is not None)
    assert agree(found_roots(e, h), e, roots, h)


@mark.parametrize(
    ("e", "h"),
    [
        param(product((0.3,), (1.0, 0.0, 0.0, 1000.0)), 1.0, id="flat, then steep"),
        param([-0.5, 0.0, 2.0, 2.0], 1.0, id="no slope at the left end"),
        param(product((1e-12, -1.0)), 1.0, id="a root beside the left end"),
        param([-0.5] + [0.0] * 22 + [1.0], 1.0, id="a high power"),
        param([-0.6e-12, 1e-12], 0.75, id="a low line"),
    ],
)
@mark.parametrize("sign", [1.0, -1.0])
def test_around_a_hard_root_the_polynomial_changes_sides(e, h, sign):
    (found,) = found_roots(sign * np.array(e), h)
    around = reach(e, found, h)
    with mpmath.workdps(700):
        before, after = (mpmath.polyval([mpmath.mpf(x) for x in reversed(e)], found + d) for d in (-around, around))
        assert before < 0 < after
