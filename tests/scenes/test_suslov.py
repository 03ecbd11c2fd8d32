"""The scene "Suslov problem with gravity": basins, planes, starts, windows, and what is said of attractors."""

from functools import cache
from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import points_of
from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.basins import contraction
from support.deviations import deviations
from support.view import FEW, View, values_of

SCENE = scenes()["suslov"]
TWO, PRINCIPAL = "Two attractors", "On a principal axis"
CELLS = 256
"""Columns and rows of a draft of basins."""


@cache
def example(name):
    """View of that example; basins of 256 × 256 cells take a quarter of the time of 512 × 512."""
    level = {"accuracy": "draft"} if name == TWO else {}
    return View(SCENE, {**values_of(SCENE, name), **level})


# ---- the examples ------------------------------------------------------------------------------------------------


def test_a_saddle_bounds_the_basins_and_its_manifold_runs_between_their_cells():
    view = example(TWO)
    (saddle,) = view.result.basins.saddles
    assert (saddle.kind, saddle.period) == ("saddle", 1)
    assert view.points("repels") == approx(saddle.points)
    numbers = view.result.basins.arrivals.number
    for branch in view.result.basins.manifolds:
        psi, delta = branch.points.T
        column = np.floor((psi + pi) / (2.0 * pi) * CELLS).astype(int) % CELLS
        row = np.clip(np.floor(delta / pi * CELLS).astype(int), 2, CELLS - 3)
        around = [numbers[(row + i), (column + j) % CELLS] for i in (-2, 0, 2) for j in (-2, 0, 2)]
        # At its end a tongue of the basin is narrower than a pixel.
        assert np.mean(np.ptp(around, axis=0) == 1) > 0.95
    assert sum(branch.length for branch in view.result.basins.manifolds) > 9.0


def test_where_volume_is_kept_no_attractor_is_claimed():
    view = View(SCENE, {**FEW, "I13": 0.0, "I23": 0.0, "colours": "basins", "h": 2.0, "long": 300.0})
    assert view.text["section"].endswith("No attractor is visible. mean div = 0 ± 0.")


def scores(view, count):
    """The mean divergence along orbits from all over the section, in units of its error; an attractor is below −3."""
    section = view.result.poincare
    found = (contraction(section.body, y, view.values["long"]) for y in section.spread(count))
    return [one.mean / one.error for one in found]


@pytest.mark.chaotic
def test_a_sea_that_is_its_own_mirror_image_is_no_attractor():
    view = View(SCENE, {**FEW, "colours": "basins", "long": 1000.0})
    assert view.result.basins.arrivals is None
    assert "section-basins" not in view.data or not view.data["section-basins"]
    mean, error = view.numbers("section", "No attractor is visible. mean div = # ± #.")
    assert abs(mean) < 5.0 * error < 0.05
    # So it is called whatever the motion.
    found = np.array(scores(view, 48))
    assert deviations(found, -3.0) > 5.0
    assert deviations(found > -3.0, 0.5) > 5.0


# ---- planes, choices, controls -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "plane, colours",
    [("γ₃ = 0", "forward and backward in time"), ("γ₁ = 0", "forward only"), ("γ₂ = 0", "basins")],
)
def test_every_plane_and_choice_is_shown(plane, colours):
    view = View(SCENE, {**FEW, "plane": plane, "colours": colours, "starts": "-0.3,1"})
    view.assert_finite()
    assert plane in view.text["section"]
    assert len(view.points("first")) > 10
    assert (len(view.points("second")) > 10) == (colours == "forward and backward in time")
    assert (view.result.basins.attractors is not None) == (colours == "basins")
    assert view.points("chosen") == approx(np.array([[-0.3, 1.0]]), abs=1e-6)
    # The chosen orbit starts in the plane.
    height = view.data["data-orbit"][f"g{'₀₁₂₃'.index(plane[1])}"]
    assert height[1] > height[0] == approx(0.0, abs=1e-7)


def test_the_later_half_are_the_later_points():
    every = View(SCENE, {**FEW, "drop": "all"}, seen=("section",))
    later = View(SCENE, {**FEW, "drop": "the later half"}, seen=("section",))
    whole, half = every.points("first"), later.points("first")
    assert (len(whole), len(half)) == (80, 40)
    assert np.array_equal(half, whole.reshape(4, 20, 2)[:, 10:].reshape(-1, 2))


def test_a_click_adds_an_orbit_and_a_box_selects_a_window():
    view = View(SCENE, FEW)
    assert points_of(view.stage.pick("section", 0.3, 2.0)["starts"]) == [(1.0, 1.0), (0.3, 2.0)]
    assert view.stage.pick("omega", 0.3, 2.0) == {}
    low, high = points_of(view.stage.box("section", (1.0, 4.0, -0.5, 2.0))["window"])
    assert low == (-0.5, 2.0)
    assert high == approx((1.0, pi), abs=1e-5)
    assert view.stage.box("section", (1.0, 2.0, 1.0, 3.0)) == view.stage.box("sphere", (1.0, 2.0, 0.0, 3.0)) == {}
    both = View(SCENE, {**FEW, "starts": "1,1;0.3,2"})
    assert len(both.points("own1")) == len(both.points("own")) == len(view.points("own"))
    # Each has a colour of its own, in the section, in the plane and on the sphere.
    for i, found in enumerate((view, both)):
        assert found.points(f"chosen{i or ''}") == approx(np.array([[[1.0, 1.0]], [[0.3, 2.0]]][i]), abs=1e-6)
        assert [len(found.data.get(f"omega-orbit{k}", {}).get("x", ())) > 0 for k in ("", 1)] == [i == 0, i == 1]
        assert found.data["sphere"]["look"] == f"chosen-{i}"


def test_a_window_is_that_of_a_box_until_a_box_around_everything():
    view = View(SCENE, {**FEW, "window": "-0.5,2;1,3"})
    assert view.result.section.frame == ((-0.5, 2.0), (1.0, 3.0))
    assert view.text["windowed"] == "section"
    assert view.stage.box("section", (-1e300, -1e300, 1e300, 1e300)) == {"window": ""}
    assert View(SCENE, FEW, seen=("section",)).text["windowed"] == ""


def test_a_start_where_nothing_is_possible_is_replaced_and_said():
    # E = −0.1: not where (b, γ) > E, at the angle of b.
    values = {**FEW, "h": -0.1 + hypot(0.5, 0.5, 0.7), "starts": f"1,1;{atan2(-0.5, -0.5)},1"}
    view = View(SCENE, values, seen=("section",))
    (note,) = view.report.notes
    assert "no motion has this energy" in note
    psi, delta = view.points("chosen")[-1]
    assert -0.5 * (cos(psi) + sin(psi)) < -0.1
    assert 0.0 < delta < pi


def test_a_window_without_a_point_says_so_when_no_more_will_come():
    values = {**FEW, "count": 600.0, "orbits": 0.0, "starts": "2,2", "window": "-0.01,0.01;0.01,0.011"}
    view = View(SCENE, values, seen=("section",))
    x, y = view.points("own").T
    assert len(x) == 600
    none = not np.any((np.abs(x) <= 0.01) & (y >= 0.01) & (y <= 0.011))
    said = " ".join(view.data.get("section-message", {}).get("text", [""])).replace("\n", " ")
    assert none
    assert said == "None of the points lies in this window: choose more crossings, or press Undo"
    # While more may come, it is not said; nor where there is one.
    waiting = SCENE.compute({**view.values, "h": 1.016}, ("section",), False)
    assert waiting.work.todo
    picture = next(view for view in SCENE.views if view.name == "section")
    assert picture.message(waiting) == ""
    whole = View(SCENE, {**values, "window": ""}, seen=("section",))
    assert "section-message" not in whole.data


@pytest.mark.parametrize("plane", ["γ₃ = 0", "γ₁ = 0", "γ₂ = 0"])
@pytest.mark.parametrize("h", [1e-6, 0.2])
def test_an_energy_that_does_not_reach_the_plane_is_raised_and_shown(plane, h):
    view = View(SCENE, {**FEW, "h": h, "plane": plane}, noted=True)
    size = {"γ₃ = 0": hypot(0.5, 0.5), "γ₁ = 0": hypot(0.5, 0.7), "γ₂ = 0": hypot(0.5, 0.7)}[plane]
    bottom = hypot(0.5, 0.5, 0.7) - size
    assert (view.values["h"] == h) == (h > bottom)
    assert bool(view.notes) == (h <= bottom)
    if view.notes:
        assert f"only for h > {bottom:.4g}" in view.notes[0]
        assert bottom < view.values["h"] < 1.02 * bottom
    view.assert_finite()
    assert len(view.points("first")) > 1


def test_the_conformal_time_of_a_long_motion_is_not_drawn_and_that_is_said():
    long = View(SCENE, {**values_of(SCENE, PRINCIPAL), **FEW, "span": 9e3}, seen={"conformal"})
    assert "choose a shorter time span" in long.text["conformal"]
