"""The solid body: its wheels roll without slipping."""

import base64
import io
from itertools import pairwise
from math import asin, cos, hypot, pi, sin

import numpy as np
import pytest
from PIL import Image

from hess_explorer.scenes import scenes
from support.page import brought, wait_frames
from support.thorough import sample

QUARTIC = scenes()["quartic"]
RADIUS = 0.84
"""Radius of the sphere, in halves of the canvas."""


@pytest.fixture
def quartic(tab):
    yield brought(tab, QUARTIC)
    tab.assert_quiet()


def canvas(explorer):
    return explorer.picture("body").locator("canvas.solid")


def view_of(turn):
    """Return the view axes in space, right, up and towards the viewer, as rows of (3, 3)."""
    azimuth, elevation = turn
    right = np.array([-sin(azimuth), cos(azimuth), 0.0])
    towards = np.array([cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)])
    return np.array([right, np.cross(towards, right), towards])


def placed(body, i):
    """Return the rotation (3, 3) from body to space at a sample of the attitude."""
    g, e = (np.array([body[f"{name}{k}"][i] for k in (1, 2, 3)]) for name in "ge")
    return np.array([e, -np.cross(g, e), -g])


def pixels(explorer):
    """Return the painted pixels (n, n, 4)."""
    # As a picture: Playwright packs numbers one by one, which takes seconds.
    address = canvas(explorer).evaluate("canvas => canvas.toDataURL()")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(address.split(",")[1]))).convert("RGBA"), int)


def test_a_wheel_rolls_without_slipping(quartic):
    """Its marked spoke has turned by the length of its contact's path over its radius, backwards in the body."""
    body = quartic.data("body")
    at, e = np.array(body["wheels"][:3]), np.array(body["wheels"][3:6])
    rotations = [placed(body, i) for i in range(len(body["t"]))]
    view = view_of(tuple(map(float, canvas(quartic).get_attribute("data-turn").split())))
    way, seen_well = 0.0, []
    for i, (before, now) in enumerate(pairwise(rotations), 1):
        step = now @ at - before @ at
        way += 2.0 * asin(0.5 * hypot(*step)) * np.sign(step @ (now @ e))
        contact, along, axle = (view @ now @ v for v in (at, e, np.cross(at, e)))
        # Only where the wheel is in front, and seen from the side.
        if contact[2] >= 0.2 and abs(axle[2]) >= 0.5:
            seen_well.append((i, way, contact, along, axle))
    checked = sample(seen_well, 12)
    assert len(checked) > 5
    for i, way, contact, along, axle in checked:
        quartic.set_time(body["t"][i])
        wait_frames(quartic)
        painted = pixels(quartic)
        half = painted.shape[0] / 2
        hub = 0.85 * contact + 0.024 * np.sign(axle[2]) * axle
        blue = []
        for angle in np.arange(12) * pi / 6.0 - way / 0.15:
            x, y, _ = hub + 0.6 * 0.15 * (cos(angle) * contact + sin(angle) * along)
            red, _, blueness, _ = painted[round(half - RADIUS * half * y - 0.5), round(half + RADIUS * half * x - 0.5)]
            blue.append(blueness - red > 90)
        assert blue == [True] + [False] * 11, i
