"""The scene "Suslov problem with gravity" in a browser: the colours of cells."""

import io

import numpy as np
import pytest
from PIL import Image

from hess_explorer.headless.browser import wait_ready
from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.cells import centres
from support.page import said, wait_frames
from support.painted import assert_painted
from support.pointer import frame

SUSLOV = scenes()["suslov"]
KINDS = (((86, 180, 233), 0x50 / 255), ((213, 94, 0), 0x60 / 255))
"""Colours of MEGNO, and how much of them is seen: regular and chaotic cells."""
FEW = {"orbits": 8.0, "count": 40.0, "long": 50.0, "I13": 0.0, "I23": 0.0, "h": 4.0, "accuracy": "draft"}


def colours_of_cells(explorer, picture, shape):
    """(n, m, 3), of the pixels in the middles of the cells of a planar picture."""
    left, top, right, bottom = frame(explorer, picture)
    n, m = shape
    shot = np.asarray(Image.open(io.BytesIO(explorer.page.screenshot())).convert("RGB"), float)
    x, y = np.meshgrid(centres(left, right, m), centres(bottom, top, n))
    return shot[y.astype(int), x.astype(int)]


@pytest.mark.parametrize("scene", [SUSLOV.name])
def test_cells_of_megno_are_seen_in_their_colours_under_the_points(explorer):
    values = {**SUSLOV.defaults(), **FEW, "indicator": "nothing"}
    explorer.change(explorer.tell, "restore", encode(SUSLOV.name, values))
    before = colours_of_cells(explorer, "section", (12, 18))
    explorer.change(explorer.choose, "indicator", "MEGNO")
    kinds = np.array(explorer.data("section-megno")["image"][0]).reshape(12, 18) - 1.5
    chaotic = said(explorer, "section", "# % chaotic.")
    assert chaotic == [pytest.approx(100.0 * np.mean(kinds[kinds >= 0.0] % 2.0 == 1.0), abs=0.51)]
    assert set(kinds[kinds >= 0.0]) == {0.0, 1.0}
    after = colours_of_cells(explorer, "section", (12, 18))
    for kind in (0.0, 1.0):
        colour, share = KINDS[int(kind)]
        mixed = (1.0 - share) * before[kinds == kind] + share * np.array(colour)
        # All but the cells over whose middles a point stands.
        assert np.mean(np.abs(after[kinds == kind] - mixed).max(axis=1) < 4.0) > 0.8
    assert_painted(explorer, SUSLOV)


@pytest.mark.parametrize("scene", [SUSLOV.name])
def test_the_section_is_computed_where_the_wheel_zooms_and_a_double_click_shows_the_whole(explorer):
    explorer.change(explorer.tell, "restore", encode(SUSLOV.name, {**SUSLOV.defaults(), **FEW, "indicator": "nothing"}))
    whole, link, mouse = explorer.axes("section"), explorer.link(), explorer.page.mouse
    left, top, right, bottom = frame(explorer, "section")
    x, y = (left + right) / 2, (top + bottom) / 2
    mouse.move(x, y)

    def double_click():
        mouse.dblclick(x, y)

    for restore in (double_click, explorer.picture("section").locator(".whole").click):
        # One computation for all turns of the wheel, in the window that the browser shows until then.
        before = explorer.state
        for _ in range(3):
            mouse.wheel(0, -100)
        wait_frames(explorer)
        zoomed = explorer.axes("section")
        wait_ready(explorer.page, after=before)
        x0, x1, y0, y1 = explorer.axes("section")
        assert (x0, x1, y0, y1) == pytest.approx(zoomed, rel=1e-6)
        assert f"window={x0:.4g}"[:11] in explorer.link()
        first, starts = explorer.data("section-first"), explorer.data("section-chosen")
        # New orbits start there.
        assert sum(x0 <= x <= x1 and y0 <= y <= y1 for x, y in zip(first["x"], first["y"], strict=True)) >= 8
        explorer.change(restore)
        assert explorer.axes("section") == whole
        assert explorer.data("section-chosen") == starts
        assert explorer.link() == link
    # Each click adds an orbit in another colour.
    explorer.change(explorer.click, x, y)
    assert len(explorer.data("section-chosen1")["x"]) == 1
    assert explorer.data("sphere")["look"] == "chosen-1"
