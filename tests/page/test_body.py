"""The solid body: its outline, hidden lines, and the moving point behind a sphere."""

import base64
import io
from itertools import pairwise
from math import asin, cos, hypot, pi, sin, sqrt

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


def hit(ellipsoid, ray):
    """The nearest point of the surface x·Q·x = 1 that a ray of sight through (x, y) meets, None where it meets none."""
    x, y = ray
    a = ellipsoid[2, 2]
    b = ellipsoid[2, 0] * x + ellipsoid[2, 1] * y
    c = np.array([x, y]) @ ellipsoid[:2, :2] @ np.array([x, y]) - 1.0
    square = b * b - a * c
    return None if square < 0.0 else (-b + sqrt(square)) / a


def seen(explorer, i):
    """The body in the view: its matrix Q with x·Q·x = 1, and the matrix from its own axes to the view."""
    body = explorer.data("body")
    turn = tuple(map(float, canvas(explorer).get_attribute("data-turn").split()))
    to_view = view_of(turn) @ placed(body, i)
    principal = np.array(body["axes"])
    return to_view @ principal.T @ np.diag(1.0 / np.square(body["semi"])) @ principal @ to_view.T, to_view


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_the_body_ends_where_the_ellipse_of_its_outline_is(quartic, dark):
    if dark:
        quartic.page.get_by_role("button", name="theme").click()
    times = quartic.data("body")["t"]
    i = len(times) // 3
    quartic.set_time(times[i])
    wait_frames(quartic)
    ellipsoid, _ = seen(quartic, i)
    # The outline: where the discriminant of the ray vanishes.
    Q = ellipsoid[:2, :2] - np.outer(ellipsoid[:2, 2], ellipsoid[2, :2]) / ellipsoid[2, 2]
    painted = pixels(quartic)
    half = painted.shape[0] / 2
    rows, columns = np.indices(painted.shape[:2])
    x, y = (columns + 0.5 - half) / (RADIUS * half), (half - rows - 0.5) / (RADIUS * half)
    size = np.sqrt(Q[0, 0] * x * x + 2.0 * Q[0, 1] * x * y + Q[1, 1] * y * y)
    pixel = 1.0 / (RADIUS * half) / np.sqrt(np.linalg.eigvalsh(Q)[0] ** -1.0)
    assert np.all(painted[size < 1.0 - 3.0 * pixel, 3] == 255)
    # Beside it are but lines: the sphere, its equator, rods, the trail.  Its shadow is on the ground below the sphere.
    beside = (size > 1.0 + 3.0 * pixel) & (np.hypot(x, y) < 0.97)
    assert np.mean(painted[beside & (y > -0.5), 3] == 0) > 0.75
    assert np.mean(painted[(np.hypot(3.0 * x, y + 0.94) < 0.2), 3] > 20) > 0.9
    # It is lit from above on the left.
    inside = size < 0.9
    brightness = painted[..., :3].mean(axis=-1)
    assert brightness[inside & (y - x > 0.25)].mean() > 1.25 * brightness[inside & (y - x < -0.25)].mean()
    if dark:
        assert brightness[inside].mean() < 150
        quartic.page.get_by_role("button", name="theme").click()


def test_what_is_behind_the_body_is_hidden_and_what_is_before_it_is_not(quartic):
    """The rod of e is black: its points are seen exactly where no ray of sight meets the body before them."""
    times, hidden, shown = quartic.data("body")["t"], [], []
    for i in range(0, len(times), len(times) // 16):
        quartic.set_time(times[i])
        wait_frames(quartic)
        ellipsoid, to_view = seen(quartic, i)
        painted = pixels(quartic)
        half = painted.shape[0] / 2
        for place in np.linspace(0.2, 0.95, 12)[:, None] * (to_view @ [0.0, 0.0, 1.0]):
            x, y, z = place
            front = hit(ellipsoid, (x, y))
            wheels = [side * 0.85 * to_view @ [1.0, 0.0, 0.0] for side in (1.0, -1.0)]
            # Not where the rod comes out of the body, nor where a wheel may be.
            if (
                0.8 < place @ ellipsoid @ place < 1.3
                or (front is not None and abs(z - front) < 0.05)
                or min(hypot(*(place - wheel)[:2]) for wheel in wheels) < 0.25
            ):
                continue
            pixel = painted[round(half - RADIUS * half * y - 0.5), round(half + RADIUS * half * x - 0.5)]
            (hidden if front is not None and z < front else shown).append(pixel[:3].max() < 70 and pixel[3] > 150)
    assert len(hidden) > 30
    assert not any(hidden)
    assert len(shown) > 30
    # The trail crosses it now and then.
    assert np.mean(shown) > 0.9


def test_the_point_behind_the_sphere_is_as_strong_as_before_it_and_has_a_ring_that_says_so(quartic):
    orbit = quartic.data("data-orbit")
    behind = {True: [], False: []}
    for i in range(0, len(orbit["t"]), len(orbit["t"]) // 12):
        quartic.set_time(orbit["t"][i])
        wait_frames(quartic)
        sphere = quartic.sphere
        x, y, z = view_of(tuple(map(float, sphere.get_attribute("data-turn").split()))) @ [
            orbit[name][i] for name in ("g1", "g2", "g3")
        ]
        around = sphere.evaluate(
            """(canvas, [x, y]) => {
              const half = canvas.width / 2
              const at = (radius, angle) => [...canvas.getContext("2d").getImageData(
                Math.round(half + 0.84 * half * x + radius * Math.cos(angle) - 0.5),
                Math.round(half - 0.84 * half * y + radius * Math.sin(angle) - 0.5), 1, 1).data]
              const angles = Array.from({ length: 60 }, (_, i) => i * Math.PI / 30)
              return [at(0, 0), angles.map((angle) => at(11, angle))]
            }""",
            [x, y],
        )
        middle, ring = np.array(around[0]), np.array(around[1])
        assert middle == pytest.approx([240, 228, 66, 255], abs=3)
        if abs(z) > 0.1:
            behind[bool(z < 0.0)].append(np.mean((ring[:, :3].max(axis=1) < 120) & (ring[:, 3] > 100)))
    assert len(behind[True]) > 1
    assert len(behind[False]) > 1
    assert min(behind[True]) > 0.25
    assert max(behind[False]) < 0.15


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
