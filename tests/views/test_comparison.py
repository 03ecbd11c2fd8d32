"""Differences between pictures: points, curves and cells against values set by hand."""

import math

import numpy as np
from pytest import approx

from hess_explorer.views.comparison import Cells, Curves, Frame, Marks, compared
from hess_explorer.views.layers import Axes

FRAME = Frame(Axes((0.0, 6.0), (0.0, 3.0)), ("x", "y"))
"""100 pixels for a unit across, 200 up."""


def marks(points, **more):
    return Marks(FRAME, (np.array(points, float),), **more)


def test_a_point_changes_where_it_moves_by_more_than_half_a_pixel():
    one = marks([[1.0, 1.0], [2.0, 1.0], [3.0, 1.0], [9.0, 1.0]])
    finer = marks([[1.004, 1.0], [2.0, 1.003], [3.0, 1.001], [8.0, 1.0], [4.0, 2.0], [7.0, 2.0]])
    found = compared(one, finer)
    assert found.same.tolist() == [[1.0, 1.0], [3.0, 1.0]]
    assert found.changed.tolist() == [[2.0, 1.0]]
    # Invisible points are not counted.
    assert found.added.tolist() == [[4.0, 2.0]]
    assert found.largest == approx(0.6)
    assert found.share == approx(1.0 / 3.0)


def test_what_the_finer_run_has_not_changes_and_an_angle_may_pass_its_cut():
    found = compared(marks([[0.001, 1.0], [2.0, 1.0]], periods=(6.0, math.inf)), marks([[5.999, 1.0]]))
    assert found.same.tolist() == [[0.001, 1.0]]
    assert found.changed.tolist() == [[2.0, 1.0]]
    assert found.largest == approx(0.2)


def test_a_point_changes_where_it_moves_in_another_picture():
    places = [[1.0, 1.0], [2.0, 1.0]]
    one, other = (
        marks(places, elsewhere=((np.array(places), np.array(sphere)),))
        for sphere in ([[0.0, 0.0, 0.0]] * 2, [[0.0, 0.0, 0.4], [0.0, 0.6, 0.0]])
    )
    assert compared(one, other).changed.tolist() == [[2.0, 1.0]]


def test_the_crossing_is_named_from_which_on_chaos_has_another_orbit():
    regular = np.column_stack([np.linspace(1.0, 2.0, 50), np.ones(50)])
    # 1e-6 pixels at first, ×10 every 5 crossings: ½ pixel is passed after 28.5 of them.
    torn = regular + np.column_stack([1e-8 * 10.0 ** (np.arange(50) / 5.0), np.zeros(50)])
    wide = Frame(Axes((0.0, 6.0), (0.0, 6.0)), ("x", "y"))
    one, finer = (Marks(wide, orbits, crossings=True) for orbits in ((torn, regular), (regular, regular)))
    found = compared(one, finer)
    assert (found.orbits, found.lost) == (2, (30,))


def test_curves_are_compared_wherever_their_points_lie():
    ends, many = np.array([[0.0, 1.0], [6.0, 1.0]]), np.column_stack([np.linspace(0.0, 6.0, 37), np.ones(37)])
    found = compared(Curves(FRAME, (ends,)), Curves(FRAME, (many,)))
    assert len(found.same) == 300
    assert len(found.changed) == len(found.added) == 0
    # A chord below an arch of 2 pixels: the ends stay.
    x = np.linspace(0.0, 6.0, 301)
    arch = np.column_stack([x, 1.0 + 0.01 * np.sin(math.pi * x / 6.0)])
    found = compared(Curves(FRAME, (ends,)), Curves(FRAME, (arch,)))
    assert found.largest == approx(2.0, rel=1e-3)
    # Half a pixel is passed where sin = ¼.
    assert found.changed[:, 0].min() == approx(6.0 / math.pi * math.asin(0.25), abs=0.03)
    assert len(found.added) == approx(len(found.changed), abs=2)


def test_a_curve_that_only_one_has_is_there_and_not_elsewhere():
    low, high = (np.array([[0.0, y], [6.0, y]]) for y in (1.0, 2.0))
    found = compared(Curves(FRAME, (low,)), Curves(FRAME, (low, high)))
    assert len(found.changed) == 0
    assert np.all(found.added[:, 1] == 2.0)
    # Against its own counterpart, although the other one lies there too.
    found = compared(Curves(FRAME, (low, high), in_pairs=True), Curves(FRAME, (high, low), in_pairs=True))
    assert found.share == 1.0
    assert compared(Curves(FRAME, (low, high)), Curves(FRAME, (high, low))).share == 0.0
    assert compared(Curves(FRAME, (low,)), Curves(FRAME, ())).share == 1.0
    assert compared(Curves(FRAME, ()), Curves(FRAME, ())).share == 0.0


def test_cells_are_compared_as_the_finer_picture_has_them():
    coarse, fine = (
        np.array([[1.0, 2.0], [np.nan, np.nan]]),
        np.array([[1.0, 1.2, 2.0, 2.0], [1.0, 1.0, 2.6, 2.0], [np.nan, 5.0, np.nan, np.nan], [np.nan] * 4]),
    )
    found = compared(Cells(FRAME, coarse, 0.5), Cells(FRAME, fine, 0.5))
    assert found.cells.tolist() == [[0, 0, 0, 0], [0, 0, 1, 0], [-1, 1, -1, -1], [-1] * 4]
    assert found.share == approx(2.0 / 9.0)
    assert found.largest == approx(0.6)
    assert compared(Cells(FRAME, fine, 0.5), Cells(FRAME, fine, 0.5)).share == 0.0
    nothing = Cells(FRAME, np.full((2, 2), np.nan), 0.5)
    assert compared(nothing, nothing).share == 0.0
