"""The scenes "Suslov problem with gravity" and "rotation number" in a browser: cells and axes that are chosen."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.cells import centres
from support.page import brought, said
from support.painted import assert_painted
from support.pointer import at, frame

SUSLOV, ROTATION = scenes()["suslov"], scenes()["rotation-number"]
KINDS = (((86, 180, 233), 0x50 / 255), ((213, 94, 0), 0x60 / 255))
"""Colours of MEGNO, and how much of them is seen: regular and chaotic cells."""
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


def colours_of_cells(explorer, picture, shape):
    """(n, m, 3), of the pixels in the middles of the cells of a planar picture."""
    left, top, right, bottom = frame(explorer, picture)
    n, m = shape
    shot = np.asarray(Image.open(io.BytesIO(explorer.page.screenshot())).convert("RGB"), float)
    x, y = np.meshgrid(centres(left, right, m), centres(bottom, top, n))
    return shot[y.astype(int), x.astype(int)]


def test_cells_of_megno_are_seen_in_their_colours_under_the_points(suslov):
    suslov.change(
        lambda: suslov.page.evaluate(
            "detail => hess.tell('change', detail)",
            {"I13": 0.0, "I23": 0.0, "h": 4.0, "accuracy": "draft", "indicator": "nothing"},
        )
    )
    before = colours_of_cells(suslov, "section", (12, 18))
    suslov.change(suslov.choose, "indicator", "MEGNO")
    kinds = np.array(suslov.data("section-megno")["image"][0]).reshape(12, 18) - 1.5
    chaotic = said(suslov, "section", "# % chaotic.")
    assert chaotic == [pytest.approx(100.0 * np.mean(kinds[kinds >= 0.0] % 2.0 == 1.0), abs=0.51)]
    assert set(kinds[kinds >= 0.0]) == {0.0, 1.0}
    after = colours_of_cells(suslov, "section", (12, 18))
    for kind in (0.0, 1.0):
        colour, share = KINDS[int(kind)]
        mixed = (1.0 - share) * before[kinds == kind] + share * np.array(colour)
        # All but the cells over whose middles a point stands.
        assert np.mean(np.abs(after[kinds == kind] - mixed).max(axis=1) < 4.0) > 0.8
    assert_painted(suslov, SUSLOV)


def crossings(explorer):
    return int(re.search(r"([\d,]+) points;", explorer.caption("section"))[1].replace(",", ""))


def test_a_density_fills_a_window_and_a_click_starts_an_orbit_over_it(suslov):
    whole = np.array(suslov.data("section-density-0")["image"][0])
    # Two stages of 128 orbits.
    assert crossings(suslov) == 12_288
    assert "x" not in suslov.data("section-first") or not len(suslov.data("section-first")["x"])
    # The sea lies in the middle of the section: neither paper nor the grey of impossible places.
    assert np.ptp(colours_of_cells(suslov, "section", (40, 40))[5:35, 22:32], axis=(0, 1)).max() > 60.0
    suslov.change(lambda: suslov.page.evaluate("hess.tell('change', { window: '0,1;1.5,2.5' })"))
    closer = np.array(suslov.data("section-density-0")["image"][0])
    assert 0 < crossings(suslov) < 12_288
    assert closer.shape == whole.shape and not np.array_equal(closer, whole)
    (x, y), _ = at(suslov, "section", 0.7, 1.7)
    suslov.set_time(5.0)
    suslov.change(lambda: suslov.page.mouse.click(x, y))
    # The motion starts there.
    assert suslov.time == 0.0
    assert len(suslov.data("section-own")["x"]) == 2 * FEW["count"]
    assert np.array_equal(np.array(suslov.data("section-density-0")["image"][0]), closer)
    assert_painted(suslov, SUSLOV)
