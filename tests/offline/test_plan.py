"""The states that a file will hold."""

import numpy as np
import pytest

from hess_explorer.offline.pages import page_family
from hess_explorer.offline.plan import MAX_STATES, family, read_slider, slider_of, values_across
from hess_explorer.scenes import scenes
from hess_mechanics.errors import InvalidParameter

SCENE = scenes()["suslov-hess"]
BASE = {**SCENE.defaults(), "h": 1.2, "f": 0.3}


def test_a_slider_has_readable_values_and_that_of_the_state():
    name, values = read_slider("h=0.2:3.5:12", SCENE, BASE, 40)
    assert name == "h"
    assert {0.2, 0.5, 1.2, 3.5} <= {*values}
    assert list(values) == sorted(values)
    assert all(len(f"{value:g}") <= 5 for value in values)
    # Steps that are small beside the values keep their digits.
    assert len({*values_across(1.0, 1.0001, 11, 1.0)}) == 11


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("h", "is not a slider: write NAME=LOW:HIGH:COUNT"),
        ("h=1:nan:3", "must increase"),
        ("h=-1e9:1:3", "within"),
        ("h=1:2:9999", "2 to 400 values"),
        ("cells=0:1:3", "has no number 'cells' to vary: choose one of I22, "),
    ],
)
def test_a_slider_that_cannot_be_is_refused(text, why):
    with pytest.raises(InvalidParameter, match=why):
        read_slider(text, SCENE, BASE, 40)


def test_lines_go_through_the_state_and_a_grid_has_all_combinations():
    h, f = read_slider("h=1:2:3", SCENE, BASE, 40), read_slider("f=0:0.4:3", SCENE, BASE, 40)
    lines = family(SCENE, BASE, [h, f])
    assert lines.points[0] == (1.2, 0.3)
    assert {*lines.points} == {(1.0, 0.3), (1.2, 0.3), (1.5, 0.3), (2.0, 0.3), (1.2, 0.0), (1.2, 0.2), (1.2, 0.4)}
    grid = family(SCENE, BASE, [h, f], grid=True)
    assert len(grid.points) == len({*grid.points}) == len(h[1]) * len(f[1])
    # Consecutive states are neighbours, so that their differences are small.
    steps = np.abs(np.diff(np.array(grid.points[1:]), axis=0)).max(axis=1)
    assert steps.max() <= 0.5
    assert grid.values((2.0, 0.4)) == {**BASE, "h": 2.0, "f": 0.4}
    assert len(family(SCENE, BASE, [], grid=True).points) == 1
    drag_values = family(SCENE, BASE, [h], drag_values={"accuracy": "draft"})
    assert drag_values.values(drag_values.points[0])["accuracy"] == "standard"
    assert drag_values.values((2.0,))["accuracy"] == "draft"


def test_the_number_of_states_is_bounded():
    with pytest.raises(InvalidParameter, match=f"at most {MAX_STATES}"):
        page_family("h=1.2&f=0.3", ["h=0:3:400", "f=0:1:100"], grid=True)


def test_a_choice_has_no_slider():
    assert slider_of(SCENE, "accuracy", BASE, 10) == ()
