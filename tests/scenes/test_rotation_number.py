"""The scene "rotation number": its window, its levels, and where nothing is possible."""

import math

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import decode
from hess_explorer.scenes import scenes
from hess_mechanics import circle_map, f_max
from hess_mechanics.numerics.accuracy import REFERENCE
from support.view import View
from support.view import example as example_of

SCENE = scenes()["rotation-number"]


def example(name):
    return example_of("rotation-number", name)


def test_tori_lock_at_0_only_and_no_multiplier_exceeds_that_of_the_pendulum():
    """The corollary of section 2 of `proofs.md`."""
    rng = np.random.default_rng(3)
    kinds = set()
    for _ in range(200):
        a, h = rng.uniform(-2.0, 2.0), rng.uniform(-0.9, 4.0)
        found = circle_map(a, h, rng.uniform(-1.0, 1.0) * f_max(h), REFERENCE)
        kinds.add(found.kind)
        assert (found.rotation_number == 0.0) == (found.kind == "hyperbolic")
        assert all(abs(one.log_multiplier) < 2.0 * math.pi * abs(a) for one in found.fixed_points)
    assert kinds == {"elliptic", "hyperbolic"}
    assert circle_map(0.5, 1.5, 0.0, REFERENCE).fixed_points[1].log_multiplier == approx(math.pi)


def test_the_map_is_coarse_first_and_stays_coarse_under_a_drag():
    values = {"a": 0.512}
    view = View(SCENE, values, is_preview=True)
    assert view.report.todo == ()
    assert "map 75 × 50" in view.report.status
    released = View(SCENE, values)
    assert "map 75 × 50" in released.first.status
    assert 0 < len(released.first.todo) <= released.first.total
    assert "map 300 × 200" in released.report.status


def test_a_window_beyond_what_is_allowed_is_refused_in_a_link_and_cut_in_a_box():
    values, notes = decode("part_hf=-50,-2;3,2", SCENE.specs)
    assert values["part_hf"] == ""
    assert "The window of the map over h, f must be points x,y;x,y" in notes[0]
    stage = View(SCENE, {}).stage
    assert stage.box("map", (3.0, 2.0, -50.0, -2.0)) == {"part_hf": "-1,-2;3,2"}
    assert stage.box("map", (-20.0, 2.0, -50.0, -2.0)) == {}


def test_on_the_separatrix_there_is_no_circle_map():
    view = View(SCENE, {"h": 1.0, "f": 0.0})
    assert view.text["circle"] == "Circle map\nSeparatrix: no return."
    assert view.report.todo == ()
    view.assert_finite()


def test_a_box_is_the_window_of_its_own_map_and_of_no_other():
    stage = View(SCENE, {"over": "f, a", "line": "h"}).stage
    assert stage.pick("map", 0.4, 0.7) == {"f": 0.4, "a": 0.7}
    assert stage.pick("line", 0.3, -0.2) == stage.pick("trace", 0.3, 3.0) == {"h": 0.3}
    box = stage.box("map", (0.9, 0.1, 0.2, 0.5))
    values, notes = SCENE.admit({**SCENE.defaults(), **box})
    assert notes == []
    assert values["part_fa"] == "0.2,0.1;0.9,0.5"
    assert values["part_hf"] == values["part_ha"] == ""
    assert View(SCENE, {**values, "over": "f, a"}, seen=("map",)).result.rho.window == ((0.2, 0.9), (0.1, 0.5))
    for plane in ("h, f", "h, a"):
        seen = (View(SCENE, {**given, "over": plane}, seen=("map",)).result.rho.window for given in (values, {}))
        assert next(seen) == next(seen)


@pytest.mark.parametrize("line, over", [("h", "h, f"), ("f", "f, a"), ("a", "h, a")])
def test_where_nothing_is_possible_nothing_is_drawn_but_grey(line, over):
    # At the edge of what is possible: beside the torus on show there is none.
    view = View(SCENE, {"h": -0.5, "f": 0.999999 * f_max(-0.5), "line": line, "over": over})
    view.assert_finite()
    place = view.values[line]
    for picture in ("line", "trace"):
        ring = view.data[f"{picture}-chosen"]
        assert ring["x"] == approx([place], abs=1e-6)
    exact = circle_map(view.values["a"], -0.5, view.values["f"], REFERENCE)
    assert view.data["line-chosen"]["y"] == approx([exact.rotation_number], abs=0.02)
