"""Layers as HoloViews elements and as Matplotlib draws them: orientation, direction of rotation, holes."""

import math

import holoviews as hv
import numpy as np
import pytest

from hess_explorer.views import layers
from hess_explorer.views.elements import overlay
from hess_explorer.views.layers import Axes, CellGrid
from hess_explorer.views.plot import Plot

AXES = Axes((0.0, 3.0), (0.0, 2.0))
GREYS = ("#000000", "#808080", "#ffffff")


@pytest.fixture(autouse=True)
def matplotlib():
    """Elements have options for Matplotlib; the backend in use stays."""
    hv.renderer("matplotlib")


def drawn(layer):
    """The elements of a plot with this layer alone, and Matplotlib's axis with them."""
    plot = Plot(name="plot", title="", caption=lambda s: "", axes=("x", "y"), x=AXES.x, y=AXES.y, layers=(layer,))
    found = overlay(plot, {plot.source_of(layer): layer.data(None)}, AXES, ("x", "y"))
    return list(found), hv.render(found, backend="matplotlib").axes[0]


def image(cells, **look):
    data = CellGrid(np.array(cells), AXES.x, AXES.y)
    return layers.image("cells", lambda _: data, palette=GREYS, low=0.0, high=1.0, **look)


def test_cells_lie_where_their_numbers_are():
    """Rows go up, columns to the right."""
    ((element,), axis) = drawn(image([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]))
    assert [float(element[x, y]) for x, y in ((0.5, 0.5), (2.5, 0.5), (0.5, 1.5))] == [0.1, 0.3, 0.4]
    (artist,) = axis.images
    x0, x1, y0, y1 = artist.get_extent()
    assert (x0, x1) == (0.0, 3.0) and sorted((y0, y1)) == [0.0, 2.0]
    lowest = 0 if (artist.origin == "lower") == (y0 < y1) else -1
    assert artist.get_array()[lowest].tolist() == [0.1, 0.2, 0.3]


@pytest.mark.parametrize(
    "look, drawn_as", [({}, "nearest"), ({"smooth": True}, "bilinear"), ({"cyclic": True}, "nearest")]
)
def test_numbers_that_go_round_are_not_mixed(look, drawn_as):
    """The mean of −½ and ½ turns is not 0."""
    _, axis = drawn(image([[0.0, 1.0], [0.0, 1.0]], **look))
    assert axis.images[0].get_interpolation() == drawn_as


def test_an_area_keeps_its_hole():
    outer = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]])
    hole = np.array([[1.0, 0.5], [2.0, 0.5], [2.0, 1.5], [1.0, 1.5]])
    ((element,), axis) = drawn(layers.region("area", lambda _: [[outer, hole]]))
    assert np.asarray(element.holes()[0][0][0])[:, :2].tolist() == hole.tolist()
    (path,) = axis.collections[0].get_paths()
    points = {tuple(point) for point in path.vertices.tolist()}
    assert points == {tuple(point) for point in (*outer.tolist(), *hole.tolist())}


def test_an_arrow_points_along_its_angle_counterclockwise_from_upwards():
    one = np.array([1.0])
    _, axis = drawn(layers.arrows("arrows", lambda _: (one, one, -one), color="red"))
    (path,) = axis.collections[0].get_paths()
    corners = np.unique(path.vertices.round(12), axis=0)
    # The tip of a triangle is the corner farthest from the middle of all.
    tip = max(corners - corners.mean(axis=0), key=np.linalg.norm)
    assert tip / np.linalg.norm(tip) == pytest.approx((math.sin(1.0), math.cos(1.0)), abs=1e-9)


@pytest.mark.parametrize("count, pixels", [(10, False), (6000, True)])
def test_very_many_markers_are_pixels_in_a_vector_file(count, pixels):
    x = np.linspace(0.0, 3.0, count)
    _, axis = drawn(layers.points("points", lambda _: (x, x / 2.0), color="red", size=4.0))
    assert bool(axis.collections[0].get_rasterized()) is pixels
