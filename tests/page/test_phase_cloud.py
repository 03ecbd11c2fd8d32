"""Clouds in the browser: a click puts a patch there.  Points between two frames: `static/cloud.test.mjs`."""

import math

import pytest
from pytest import approx


@pytest.mark.parametrize("scene", ["singular-measures"])
def test_a_click_in_the_plane_puts_a_patch_there(explorer):
    canvas = explorer.picture("omega").locator("canvas")
    box = canvas.bounding_box()
    # Up and to the left, at the centre of the frame's upper left quarter.
    upper_left = {"x": 46 + (box["width"] - 54) / 4, "y": 8 + (box["height"] - 50) / 4}
    explorer.change(lambda: canvas.click(position=upper_left))
    assert explorer.chosen("start") == "small patch"
    angle = explorer.shown("angle")[0]
    assert angle == approx(0.75 * math.pi, abs=0.01)
    w1, w2 = explorer.page.evaluate(
        "hess.clouds(hess.source('omega'), 0).map(({ w1, w2 }) => [w1, w2].map((all) => all.reduce((a, b) => a + b)))"
    )[0]
    assert math.atan2(w2, w1) == approx(angle, abs=0.01)
