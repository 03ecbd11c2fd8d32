"""The scenes "Suslov problem with gravity" and "rotation number" in a browser: examples, clicks, links, refusals."""

from __future__ import annotations

import io
import math
import re
from urllib.parse import urlencode

import numpy as np
import pytest
from PIL import Image

from hess_explorer.protocol.parameters import places
from hess_explorer.scenes import scenes
from hess_mechanics import circle_map
from hess_mechanics.dynamics.cells import centres
from hess_mechanics.numerics.accuracy import REFERENCE
from support.free_suslov import shown
from support.page import brought, chosen, flat, said, values_of
from support.painted import SOURCES, assert_painted
from support.pointer import at, frame
from support.thorough import sample
from support.view import View

SUSLOV, ROTATION = scenes()["suslov"], scenes()["rotation-number"]
KINDS = (
    ((86, 180, 233), 0x50 / 255),
    ((213, 94, 0), 0x60 / 255),
    ((0, 158, 115), 0x70 / 255),
    ((191, 102, 153), 0x80 / 255),
)
"""Colours of MEGNO and how much of them is seen: regular, chaotic, and both where volume shrinks."""
FEW = {"orbits": 8, "count": 40, "long": 50}


@pytest.fixture
def suslov(tab):
    brought(tab, SUSLOV).give(**FEW)
    yield tab
    tab.assert_quiet()


@pytest.fixture
def rotation(tab):
    yield brought(tab, ROTATION)
    tab.assert_quiet()


def opened(tab, scene, **values):
    """The page of a link with these values."""
    return tab.open(urlencode({"v": 1, "scene": scene.name, **values}))


def points(explorer, layer):
    data = explorer.data(f"section-{layer}")
    return np.column_stack([data["x"], data["y"]])


def colours_of_cells(explorer, picture, shape):
    """(n, m, 3), of the pixels in the middles of the cells of a planar picture."""
    left, top, right, bottom = frame(explorer, picture)
    n, m = shape
    shot = np.asarray(Image.open(io.BytesIO(explorer.page.screenshot())).convert("RGB"), float)
    x, y = np.meshgrid(centres(left, right, m), centres(bottom, top, n))
    return shot[y.astype(int), x.astype(int)]


def drag(explorer, picture, first, last):
    """Draw a box between two points of a picture."""
    mouse = explorer.page.mouse
    (x0, y0), _ = at(explorer, picture, *first)
    (x1, y1), unit = at(explorer, picture, *last)
    mouse.move(x0, y0)
    mouse.down()
    mouse.move(0.5 * (x0 + x1), 0.5 * (y0 + y1), steps=4)
    mouse.move(x1, y1, steps=4)
    explorer.change(mouse.up)
    return unit


# --- The Suslov problem ------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", sample(SUSLOV.presets, 4), ids=lambda preset: preset.name)
def test_an_example_of_the_suslov_problem_is_drawn_with_the_numbers_of_its_captions(tab, preset):
    explorer = brought(tab, SUSLOV)
    values = chosen(explorer, SUSLOV, preset)
    assert explorer.chosen("preset") == preset.name
    E = values["h"] - math.hypot(values["b1"], values["b2"], values["b3"])
    assert said(explorer, "omega", "E = #.") == [shown(E)]
    assert explorer.chosen("colours") == preset.values["colours"]
    if preset.values["colours"] == "basins":
        share, rest = said(explorer, "section", "Two attractors. Basins: # % and # % of the cells.")
        cells = np.array(explorer.data("section-basins")["image"][0]).ravel()
        assert share == pytest.approx(100.0 * np.mean(cells == 2.5), abs=0.51)
        assert rest == pytest.approx(100.0 * np.mean(cells == 1.5), abs=0.51)
    else:
        assert said(explorer, "section", "# points forward") == [len(points(explorer, "first"))]
        assert flat(explorer.data("section-basins")) == []
    exponent, _, mean, end = said(explorer, "exponent", "λ = # ± #, div = # after t = #.")
    assert end == values["long"]
    for curve, value in (("lambda", exponent), ("divergence", mean)):
        assert explorer.data(f"exponent-{curve}")["ys"][0][-1] == pytest.approx(value, rel=6e-3, abs=1e-6)
    assert (exponent > 0.05) == preset.name.startswith(("A chaotic sea", "Strange attractor", "On a principal axis"))
    assert (mean < -0.1) == ("ttractor" in preset.name or "attracts" in preset.name)
    assert_painted(explorer, SUSLOV)


def test_a_slider_of_the_suslov_problem_changes_section_and_orbit(suslov):
    before = points(suslov, "first")
    suslov.change(lambda: suslov.slide(b3=0.9))
    expected = View(SUSLOV, {**{name: float(value) for name, value in FEW.items()}, "b3": 0.9})
    assert points(suslov, "first") == pytest.approx(
        np.column_stack([expected.data["section-first"][axis] for axis in "xy"]), abs=1e-5
    )
    assert len(points(suslov, "first")) == len(before)
    assert not np.array_equal(points(suslov, "first"), before)
    assert suslov.wait_url(b3="0.9")["scene"] == "suslov"
    assert said(suslov, "omega", "E = #.") == [shown(1.0 - math.hypot(0.5, 0.5, 0.9))]


def test_every_plane_and_all_that_can_be_shown(suslov):
    for colours in ("basins", "forward only", "forward and backward in time"):
        suslov.change(suslov.choose, "colours", colours)
        assert (len(points(suslov, "second")) > 0) == (colours == "forward and backward in time")
        assert (flat(suslov.data("section-basins")) != []) == (colours == "basins")
    for plane in ("γ₁ = 0", "γ₂ = 0"):
        suslov.change(suslov.choose, "plane", plane)
        assert plane in suslov.caption("section")
        assert len(points(suslov, "first")) > 10
    assert_painted(suslov, SUSLOV)
    # MEGNO: the caption counts the cells, and each is seen in its colour under the points.
    suslov.change(
        lambda: suslov.page.evaluate(
            "detail => hess.tell('change', detail)", {"I13": 0.0, "I23": 0.0, "h": 4.0, "accuracy": "draft"}
        )
    )
    before = colours_of_cells(suslov, "section", (12, 18))
    suslov.change(suslov.choose, "indicator", "MEGNO")
    kinds = np.array(suslov.data("section-megno")["image"][0]).reshape(12, 18) - 1.5
    regular, chaotic, _, shrinks = said(
        suslov, "section", "# % of the cells regular, # % chaotic. MEGNO after t = #; volume shrinks in about # %."
    )
    there = kinds[kinds >= 0.0]
    assert chaotic == pytest.approx(100.0 * np.mean(there % 2.0 == 1.0), abs=0.51)
    assert shrinks == pytest.approx(100.0 * np.mean(there >= 2.0), abs=0.51)
    assert regular + chaotic == pytest.approx(100.0, abs=1.1)
    assert set(there) == {0.0, 1.0}
    after = colours_of_cells(suslov, "section", (12, 18))
    for kind in np.unique(there):
        colour, share = KINDS[int(kind)]
        mixed = (1.0 - share) * before[kinds == kind] + share * np.array(colour)
        # All but the cells over whose middles a point stands.
        assert np.mean(np.abs(after[kinds == kind] - mixed).max(axis=1) < 4.0) > 0.8
    assert_painted(suslov, SUSLOV)


def test_a_click_starts_an_orbit_and_undo_and_clear_take_it_back(suslov):
    pixel, unit = at(suslov, "section", 0.5, 2.0)
    suslov.change(suslov.page.mouse.click, *pixel)
    first, last = points(suslov, "chosen")
    assert first == pytest.approx([1.0, 1.0], abs=1e-6)
    assert last == pytest.approx([0.5, 2.0], abs=2.0 * max(unit))
    assert len(points(suslov, "own")) == 2 * FEW["count"]
    written = suslov.page.wait_for_function(
        "(new URLSearchParams(location.search).get('starts') ?? '').split(';')[1]"
    ).json_value()
    assert [float(x) for x in written.split(",")] == pytest.approx(last, abs=1e-5)
    suslov.change(suslov.page.locator(".param-undo").click)
    assert len(points(suslov, "chosen")) == 1
    suslov.change(suslov.page.mouse.click, *pixel)
    suslov.change(suslov.page.locator(".param-clear").click)
    assert points(suslov, "chosen") == pytest.approx(np.array([[1.0, 1.0]]))


def test_a_box_looks_closer_and_undo_looks_at_the_whole_again(suslov):
    unit = drag(suslov, "section", (-1.0, 0.5), (1.5, 2.0))
    assert suslov.axes("section") == pytest.approx([-1.0, 1.5, 0.5, 2.0], abs=2.0 * max(unit))
    written = suslov.page.wait_for_function("new URLSearchParams(location.search).get('window')").json_value()
    (x0, y0), (x1, y1) = places(written)
    assert [x0, x1, y0, y1] == pytest.approx(suslov.axes("section"), abs=1e-6)
    suslov.change(suslov.page.locator(".param-undo").click)
    assert suslov.axes("section") == pytest.approx([-math.pi, math.pi, 0.0, math.pi], abs=1e-6)


def test_a_link_brings_back_window_starts_and_choices(tab):
    linked = {
        **FEW,
        "h": 1.25,
        "plane": "γ₂ = 0",
        "colours": "forward only",
        "drop": "the later half",
        "starts": "0.5,2;-0.5,1.5",
        "window": "-1,1;2,3",
        "accuracy": "precise",
    }
    explorer = opened(tab, SUSLOV, **linked)
    explorer.wait_url(I11="1.5", b3="0.7", long="50.0")
    found = values_of(explorer, SUSLOV)
    assert {name: found[name] for name in linked} == linked
    assert explorer.axes("section") == pytest.approx([-1.0, 2.0, 1.0, 3.0])
    assert points(explorer, "chosen") == pytest.approx(np.array([[0.5, 2.0], [-0.5, 1.5]]), abs=1e-6)
    assert "precise:" in explorer.text("status")
    assert explorer.text("notes") == ""
    explorer.assert_quiet()


def test_nothing_possible_in_a_window_is_a_sentence_and_clear_the_way_back(tab):
    # E = −0.1: impossible all round the angle of b.
    h = -0.1 + math.hypot(0.5, 0.5, 0.7)
    explorer = brought(tab, SUSLOV)
    explorer.change(
        lambda: explorer.page.evaluate(
            "detail => hess.tell('change', detail)", {**FEW, "h": h, "starts": "-2.356,1.5", "window": "-2.5,1;-2.2,2"}
        )
    )
    sentence = "Nothing is possible in this window with the energy E = -0.1: choose a larger h, or press Clear"
    assert explorer.text("status").startswith(sentence)
    for picture in SUSLOV.pictures:
        assert explorer.caption(picture).startswith(sentence)
    drawn = [name for name in explorer.page.evaluate(SOURCES) if "message" not in name and flat(explorer.data(name))]
    assert drawn == []
    explorer.change(explorer.page.locator(".param-clear").click)
    assert len(points(explorer, "first")) > 10
    explorer.assert_quiet()


def test_an_energy_below_the_plane_is_raised_and_said(suslov):
    suslov.change(suslov.type, "h", "0.01")
    bottom = math.hypot(0.5, 0.5, 0.7) - math.hypot(0.5, 0.5)
    assert f"Motions reach γ₃ = 0 only for h > {bottom:.4g}" in suslov.text("notes")
    assert bottom < suslov.shown("h")[0] < 1.02 * bottom
    assert len(points(suslov, "first")) > 1


def test_an_exponent_over_too_long_a_time_is_said(tab):
    explorer = brought(tab, SUSLOV)
    explorer.give(orbits=1, count=2, I11=1e-3, I22=1e-3, h=1e6, span=0.01, long=2e4)
    assert "choose a shorter time span" in explorer.text("notes")
    explorer.assert_quiet()


# --- The rotation number -----------------------------------------------------------------------------


@pytest.mark.parametrize("preset", sample(ROTATION.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_the_rotation_number_is_drawn_with_the_numbers_of_its_captions(rotation, preset):
    values = chosen(rotation, ROTATION, preset)
    assert rotation.chosen("preset") == preset.name
    exact = circle_map(values["a"], values["h"], values["f"], REFERENCE)
    (rho,) = said(rotation, "circle", "ρ = #.")
    assert rho == pytest.approx(exact.rotation_number, abs=1e-4)
    line, rational = preset.values["line"], values["rational"]
    assert f"ρ along {line}" in rotation.caption("line")
    if "No torus" not in rotation.caption("line"):
        place, defect = said(rotation, "line", f"ρ = {rational} at {line} = #: |Θ^{rational[-1]} − id| ≤ #")
        torus = {**{name: values[name] for name in "ahf"}, line: place}
        p, q = map(int, rational.replace("−", "-").split("/"))
        assert circle_map(*torus.values(), REFERENCE).rotation_number == pytest.approx(p / q, abs=1e-5)
        assert defect < 1e-12
    assert "map 300 × 200" in rotation.text("status")
    across, up = preset.values["over"].split(", ")
    ring = rotation.data("map-here")
    assert (ring["x"][0], ring["y"][0]) == pytest.approx((values[across], values[up]), abs=1e-6)
    assert re.search(r"plateaus of Θ\(φ \+ ε sin 3φ\): [−\d]", rotation.text("derived"))
    assert_painted(rotation, ROTATION)


def test_a_slider_of_the_rotation_number_changes_all_pictures(rotation):
    before = rotation.data("trace-t")
    rotation.change(lambda: rotation.slide(a=0.7))
    exact = circle_map(0.7, 0.5, 0.8, REFERENCE)
    assert said(rotation, "circle", "ρ = #.") == [pytest.approx(exact.rotation_number, abs=1e-4)]
    x, y = rotation.data("trace-t")["xs"], rotation.data("trace-t")["ys"]
    assert np.interp(0.8, np.concatenate(x), np.concatenate(y)) == pytest.approx(exact.trace, abs=2e-3)
    assert rotation.data("trace-t") != before
    assert rotation.wait_url(a="0.7")["scene"] == "rotation-number"


def test_a_click_in_the_map_and_one_on_the_line_choose_the_torus(rotation):
    pixel, unit = at(rotation, "map", 2.0, -0.5)
    rotation.change(rotation.page.mouse.click, *pixel)
    h, f = rotation.shown("h")[0], rotation.shown("f")[0]
    assert (h, f) == (pytest.approx(2.0, abs=2.0 * unit[0]), pytest.approx(-0.5, abs=2.0 * unit[1]))
    exact = circle_map(0.5, h, f, REFERENCE)
    assert said(rotation, "circle", "ρ = #.") == [pytest.approx(exact.rotation_number, abs=1e-4)]
    pixel, unit = at(rotation, "line", 1.0, 0.2)
    rotation.change(rotation.page.mouse.click, *pixel)
    assert rotation.shown("f")[0] == pytest.approx(1.0, abs=2.0 * unit[0])
    assert rotation.shown("h")[0] == h


def test_a_box_in_the_map_is_computed_again_and_undone(rotation):
    unit = drag(rotation, "map", (0.0, 0.2), (0.9, 1.1))
    assert rotation.axes("map") == pytest.approx([0.0, 0.9, 0.2, 1.1], abs=2.0 * max(unit))
    x0, x1, y0, y1 = rotation.axes("map")
    rho = np.array(rotation.data("map-rho")["image"][0]).reshape(200, 300)
    h, f = x0 + 150.5 * (x1 - x0) / 300, y0 + 50.5 * (y1 - y0) / 200
    assert rho[50, 150] == pytest.approx(circle_map(0.5, h, f, REFERENCE).rotation_number, abs=1e-5)
    rotation.change(rotation.page.locator(".param-undo").click)
    assert rotation.axes("map") == pytest.approx([-1.0, 4.0, -3.0, 3.0])


def test_every_plane_and_line_is_painted(rotation):
    for plane, line in (("h, a", "h"), ("f, a", "a"), ("f, a", "f")):
        if rotation.chosen("over") != plane:
            rotation.change(rotation.choose, "over", plane)
        if rotation.chosen("line") != line:
            rotation.change(rotation.choose, "line", line)
        assert f"({plane})" in rotation.caption("map")
        assert (
            rotation.page.evaluate("""() => {
          const { below, left } = hess.plots.find(({ model }) => model.name === "map").model
          return `${below[0].axis_label}, ${left[0].axis_label}`
        }""")
            == plane
        )
    assert_painted(rotation, ROTATION)
    rotation.change(rotation.page.locator(".param-reset").click)
    assert rotation.chosen("over") == "h, f"


def test_outside_the_region_f_is_put_on_its_edge_and_on_the_separatrix_there_is_no_map(rotation):
    rotation.change(rotation.type, "f", "2.5")
    assert "At h = 0.5 only |f| ≤" in rotation.text("notes")
    rotation.change(rotation.type, "f", "0")
    rotation.change(rotation.type, "h", "1")
    assert rotation.caption("circle").endswith("Separatrix: no return.")
    rotation.assert_quiet()


def test_a_link_of_the_rotation_number_with_nonsense_is_put_right(tab):
    explorer = opened(tab, ROTATION, h="abc", a="1e9", epsilon="0.9", over="x, y", part_hf="1,nan;2,3")
    assert explorer.shown("h")[0] == ROTATION.defaults()["h"]
    assert (explorer.shown("a")[0], explorer.shown("epsilon")[0]) == (100.0, 0.33)
    assert explorer.chosen("over") == "h, f"
    explorer.assert_quiet()


def test_the_scenes_are_entered_from_one_another_whatever_was_chosen(tab):
    explorer = brought(tab, SUSLOV)
    explorer.change(
        lambda: explorer.page.evaluate(
            "detail => hess.tell('change', detail)", {**FEW, "plane": "γ₁ = 0", "window": "0,0.5;1,2"}
        )
    )
    explorer.enter("rotation-number")
    assert explorer.chosen("over") == "h, f"
    assert explorer.axes("map") == pytest.approx([-1.0, 4.0, -3.0, 3.0])
    explorer.change(explorer.choose, "over", "f, a")
    explorer.enter("suslov")
    assert explorer.chosen("plane") in SUSLOV.specs[8].options
    assert len(points(explorer, "first")) > 10
    explorer.assert_quiet()
