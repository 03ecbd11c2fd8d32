"""States of the explorer in Python: parameters by name, error messages, drawing, and the underlying mechanics."""

import io
import xml.etree.ElementTree as ET
from html import escape

import holoviews as hv
import numpy as np
import pytest
from PIL import Image
from pytest import approx

import hess_explorer as hess
from hess_explorer.export.picture_data import picture_data
from hess_explorer.headless.drawing import png_of
from hess_mechanics import BallBody, HeavyBody, HessBody, SuslovBody, basins, circle_map, level, return_map
from hess_mechanics.errors import ModelError
from hess_mechanics.euler_poisson import equations as euler_poisson

DRAWN = [
    ("suslov-hess", "circle", "cobweb", ("phi", "theta")),
    ("free-suslov", "omega", "arrows", ("x", "y")),
    ("scattering", "map", "theta", ("value",)),
]


def test_a_link_and_its_parameters_are_the_same_state():
    state = hess.from_link("https://example.org/x/?v=1&scene=suslov&b1=-0.5&starts=0.5,1;1,1&t=2.5")
    again = hess.state("suslov", b1=-0.5, starts=[(0.5, 1.0), (1, np.float64(1.0))], t=2.5)
    assert again.link == state.link == hess.from_link(state.link).link
    assert (state.scene, state.notes) == ("suslov", ())
    assert state.replace(b1=0.25, t=0.0).parameters == {**again.parameters, "b1": 0.25}
    noted = hess.from_link("h=-7&scene=suslov-hess", lenient=True)
    assert noted.parameters["h"] == approx(-1.0)
    assert noted.notes[0].startswith("h must lie between -1 and")


def test_a_notebook_shows_a_state_by_its_parameters_and_link():
    found = hess.state("suslov-hess", h=1.25, f=0.3)
    said = found._repr_html_()
    ET.fromstring(f"<div>{said}</div>")
    assert "<th>h</th><td>1.25</td>" in said and escape(found.link) in said
    assert said.count("<tr>") == len(found.parameters)


def test_scenes_pictures_layers_and_columns_that_are_not_there_are_named():
    state = hess.state("suslov-hess", accuracy="draft")
    for call, sentence in (
        (lambda: hess.state("suslov-hess", height=1.0), "has no parameter 'height': choose one of I22, I23, b3, h"),
        (
            lambda: hess.state("suslov-hess", h="high"),
            "'high' is not a number: h .* between -1 and 1e6",
        ),
        (lambda: state.data("x"), "has no picture 'x': choose one of body"),
        (lambda: state.data("circle")["z"], "no column 'z': choose one of layer"),
        (lambda: state.data("circle").layer("z"), "no layer 'z': choose one of cobweb"),
        (lambda: state.save("x.doc", "circle"), "The file format '.doc' is not supported"),
        (lambda: hess.state("suslov", starts=[(10**400, 1.0)]), "must be a list of pairs"),
    ):
        with pytest.raises(ModelError, match=sentence):
            call()


def test_the_mechanics_behind_a_state_are_objects_of_the_library():
    state = hess.state("suslov-hess", I22=1.5, I23=0.3, h=1.2, f=0.3)
    assert state.body == HessBody(1.5, 0.3, -1.0)
    assert state.section is None
    assert state.motion.duration == approx(40.0 * state.body.frequency_unit)
    kinds = {"suslov": SuslovBody, "chaplygin-ball": BallBody, "euler-poisson": HeavyBody}
    assert {name: type(hess.state(name).body) for name in kinds} == kinds
    section = hess.state("euler-poisson", f=1.0, h=40.0).section
    states, possible = section.states_at(np.array([0.3]), np.array([0.2]))
    # On the section (M, γ) = f, and the energy is h.
    integrals = euler_poisson.integrals(states[0], section.body.parameters)
    assert possible.all()
    assert (integrals["H"], integrals["F1"]) == approx((40.0, 1.0))


def test_a_layer_is_a_data_set_with_coordinates_and_units():
    data = hess.state("suslov-hess", accuracy="draft").data("circle")
    layers = data.to_xarray()
    assert tuple(layers) == data.layers
    found = layers["stable"]
    assert (list(found.coords), list(found.data_vars)) == (["phi"], ["theta"])
    assert found.phi.attrs["units"] == found.theta.attrs["units"] == "rad"
    curve = layers["map"]
    assert (set(curve.coords), list(curve.data_vars)) == ({"part", "x"}, ["y"])
    assert (curve.attrs["x_axis"], curve.attrs["y_axis"]) == data.axes
    assert np.array_equal(curve.y, data.layer("map")["y"])


def test_a_figure_is_that_of_the_file_and_can_be_changed():
    state = hess.state("suslov-hess", accuracy="draft")
    figure = state.figure("circle", width=60.0)
    (axes,) = figure.axes
    found = picture_data(state.link, "circle").axes
    assert (axes.get_xlim(), axes.get_ylim()) == (found.x, found.y)
    assert figure.get_size_inches() == approx([60.0 / 25.4] * 2)


@pytest.mark.parametrize("scene, picture, layer, columns", DRAWN)
def test_a_plot_draws_the_numbers_of_the_data_on_the_axes_of_the_page(scene, picture, layer, columns):
    state = hess.state(scene, accuracy="draft")
    plot, data = state.plot(picture), state.data(picture)
    part = data.layer(layer)
    elements = plot.traverse(lambda one: one, [hv.Curve, hv.Path, hv.Points, hv.Image, hv.Polygons])
    drawn = [
        [
            one.dimension_values(name)
            for name in (one.vdims if isinstance(one, hv.Image) else one.dimensions())[: len(columns)]
        ]
        for one in elements
    ]
    drawn = [[one[np.isfinite(one)] for one in found] for found in drawn]
    wanted = [part[name] for name in columns]
    assert any(all(map(np.array_equal, map(np.sort, found), map(np.sort, wanted))) for found in drawn)
    figure = hv.render(plot, "bokeh")
    axes = picture_data(state.link, picture).axes
    assert (figure.x_range.start, figure.x_range.end) == approx(axes.x)
    assert (figure.y_range.start, figure.y_range.end) == approx(axes.y)
    assert figure.title.text == data.facts["title"]


@pytest.mark.usefixtures("browser")
def test_a_sphere_is_the_figure_for_paper_in_pixels():
    state = hess.state("suslov-hess", accuracy="draft", az=1.0, el=-0.4)
    pixels = state.plot("sphere").dimension_values(2, flat=False)
    figure = np.asarray(Image.open(io.BytesIO(png_of(picture_data(state.link, "sphere"), 71.0))).convert("RGB"))
    assert np.array_equal(pixels[::-1], figure[..., 0] / np.float32(255.0))
    assert pixels.std() > 0.05


TWO = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)


@pytest.mark.parametrize("backend", ["bokeh", "matplotlib"])
def test_pictures_and_results_are_drawn_with_either_extension(backend):
    hv.extension(backend)
    try:
        for plot in (
            hess.state("suslov-hess", accuracy="draft").plot("sphere"),
            circle_map(a=0.5, h=1.5, f=0.6, accuracy=level("draft")).plot(),
            basins(return_map(TWO, E=1.842, accuracy="draft"), cells=(6, 4)).plot(),
        ):
            assert hv.render(plot) is not None
            assert hv.Store.current_backend == backend
    finally:
        hv.Store.set_current_backend("bokeh")
