"""The loxodromic pendulum in a browser, and the body on the Suslov–Hess page."""

import math

import numpy as np
import pytest

from support.loxodrome import LOXODROME, clock, swing_at
from support.page import brought, flat, wait_frames


@pytest.fixture
def loxodrome(tab):
    yield brought(tab, LOXODROME)
    tab.assert_quiet()


def canvas(explorer, picture):
    return explorer.picture(picture).locator("canvas.solid")


def has_mass_at(explorer, picture, x, y, z):
    """Return whether black and white quarters meet at a point of space, in a picture turned by (az, el)."""
    light = canvas(explorer, picture).evaluate(
        """(canvas, [x, y, z]) => {
          const [az, el] = canvas.dataset.turn.split(" ").map(Number)
          const [ca, sa, ce, se] = [Math.cos(az), Math.sin(az), Math.cos(el), Math.sin(el)]
          const half = canvas.width / 2
          const px = half + 0.84 * half * (ca * y - sa * x)
          const py = half - 0.84 * half * (ce * z - se * (ca * x + sa * y))
          const { data } = canvas.getContext("2d").getImageData(Math.round(px) - 4, Math.round(py) - 4, 9, 9)
          return Array.from(data).filter((_, i) => i % 4 === 0)
        }""",
        [x, y, z],
    )
    return sum(one > 240 for one in light) > 20 and sum(one < 50 for one in light) > 20


def centre_at(values, t):
    """Return the position of the centre of mass in the picture's space."""
    alpha = float(swing_at(values["energy"], np.array(t / clock(values))))
    return 0.0, math.sin(alpha), -math.cos(alpha)


def test_the_body_moves_with_time_in_both_pictures(loxodrome):
    values = LOXODROME.defaults()
    for t in (1.7, 2.2):
        loxodrome.set_time(t)
        wait_frames(loxodrome)
        for picture in ("body", "space"):
            assert has_mass_at(loxodrome, picture, *centre_at(values, t)), (t, picture)
            assert not has_mass_at(loxodrome, picture, *centre_at(values, t + 0.6)), (t, picture)
    before = canvas(loxodrome, "body").screenshot()
    loxodrome.play_until(2.3)
    assert canvas(loxodrome, "body").screenshot() != before


# --- The body on the Suslov–Hess page -----------------------------------------------------------------


def test_a_picture_that_is_folded_is_not_computed(explorer):
    explorer.change(lambda: explorer.slide(h=0.2))
    assert flat(explorer.data("torus-density")) == []
    assert not explorer.picture("torus").is_visible()
    explorer.unfold("torus")
    first = explorer.data("torus-density")
    assert flat(first) != []
    explorer.fold("torus")
    # The browser tells what is in sight a moment after it has changed.
    wait_frames(explorer)
    explorer.change(lambda: explorer.slide(h=0.4))
    assert explorer.data("torus-density") == first
    explorer.unfold("torus")
    assert explorer.data("torus-density") != first
