"""Clouds in the browser: points between two frames, and a click."""

import json
import math

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes
from hess_mechanics import level
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import cloud_of, frame_times, patch

SCENE = scenes()["singular-measures"]
HERE = ".gallery:not(.away) .picture-{} canvas"
WIDTH = 600
"""Pixels of a picture that interpolation is to be right for."""
EVERY = 20
"""One point in so many is compared: all take the same path through the code."""

# The columns ω1, ω2, γ1, γ2, γ3 of each cloud.
CLOUDS = """slider => JSON.stringify(hess.clouds(hess.source("omega"), Number(slider.value))
  .map(({ w1, w2, g1, g2, g3 }) => [w1, w2, g1, g2, g3].map((one) => Array.from(one))))"""


@pytest.fixture
def scene():
    return SCENE.name


def clouds(explorer):
    """(5, n) of each cloud on the page."""
    return [np.array(one, float) for one in json.loads(explorer.page.locator("input.param-t").evaluate(CLOUDS))]


CHANGED = {
    "start": "small patch",
    "D": 2.0,
    "b3": -2.0,
    "direction": "backward",
    "span": 8.0,
}


def test_between_frames_nearly_all_points_are_right_to_a_pixel(explorer):
    values = {**SCENE.defaults(), **CHANGED}
    body = BallBody(*(values[name] for name in ("I11", "I22", "I13", "I23", "D")))
    states = patch(body, values["h"], values["angle"], values["spread"], 10_000)
    frames = frame_times(body, states, values["span"], values["b3"])
    explorer.change(explorer.tell, "restore", encode(SCENE.name, values))
    for frame in (0, frames.size // 2, frames.size - 2):
        t = 0.5 * float(frames[frame] + frames[frame + 1])
        explorer.set_time(t)
        exact = cloud_of(body, states[::EVERY], np.array([0.0, -t]), level("precise"))
        right = np.hstack([exact.omega[:, 1], exact.gamma[:, 1]])
        half = explorer.page.evaluate("hess.source('omega').data.half")
        (found,) = clouds(explorer)
        off = found.T[::EVERY] - right
        for part, pixels in ((slice(0, 2), WIDTH / (2.0 * half)), (slice(2, 5), WIDTH / 2.0)):
            error = np.linalg.norm(off[:, part], axis=1) * pixels
            assert np.quantile(error, 0.99) < 1.0
            assert error.max() < 3.0


def test_a_click_in_the_plane_puts_a_patch_there(explorer):
    canvas = explorer.page.locator(HERE.format("omega"))
    box = canvas.bounding_box()
    # Up and to the left, at the centre of the frame's upper left quarter.
    upper_left = {"x": 46 + (box["width"] - 54) / 4, "y": 8 + (box["height"] - 50) / 4}
    explorer.change(lambda: canvas.click(position=upper_left))
    assert explorer.chosen("start") == "small patch"
    angle = explorer.shown("angle")[0]
    assert angle == approx(0.75 * math.pi, abs=0.01)
    (found,) = clouds(explorer)
    assert math.atan2(found[1].mean(), found[0].mean()) == approx(angle, abs=0.01)
