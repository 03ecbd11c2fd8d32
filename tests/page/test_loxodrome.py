"""The loxodromic pendulum in a browser, and the body on the Suslov–Hess page."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support.loxodrome import HESS, LOXODROME, clock, slope, swing_at
from support.page import brought, chosen, flat, said, wait_frames
from support.painted import assert_painted
from support.thorough import sample

YELLOW = (240, 228, 66)


@pytest.fixture
def loxodrome(tab):
    yield brought(tab, LOXODROME)
    tab.assert_quiet()


def canvas(explorer, picture):
    return explorer.picture(picture).locator("canvas.solid")


def colour_at(explorer, picture, x, y, z):
    """The colour of the pixel at a point of space, in the picture of a sphere turned by (az, el)."""
    return tuple(
        canvas(explorer, picture).evaluate(
            """(canvas, [x, y, z]) => {
          const [az, el] = canvas.dataset.turn.split(" ").map(Number)
          const [ca, sa, ce, se] = [Math.cos(az), Math.sin(az), Math.cos(el), Math.sin(el)]
          const half = canvas.width / 2
          const px = half + 0.84 * half * (ca * y - sa * x)
          const py = half - 0.84 * half * (ce * z - se * (ca * x + sa * y))
          return Array.from(canvas.getContext("2d").getImageData(Math.round(px), Math.round(py), 1, 1).data).slice(0, 3)
        }""",
            [x, y, z],
        )
    )


def centre_at(values, t):
    """Return the position of the centre of mass in the picture's space."""
    alpha = float(swing_at(values["energy"], np.array(t / clock(values))))
    return 0.0, math.sin(alpha), -math.cos(alpha)


@pytest.mark.parametrize("preset", sample(LOXODROME.presets, 3), ids=lambda preset: preset.name)
def test_a_preset_is_drawn_with_the_numbers_of_its_captions(loxodrome, preset):
    values = chosen(loxodrome, LOXODROME, preset)
    assert loxodrome.chosen("preset") == preset.name
    theta, error = said(loxodrome, "angle", "θ = #; measured on the track, to #.")
    assert theta == pytest.approx(math.asin(1.0 / math.hypot(1.0, slope(values))), rel=6e-6)
    assert error < 2e-5
    if values["energy"] < 1.0:
        assert said(loxodrome, "height", "α = ±# at most; the height reaches h = #.")[0] == pytest.approx(
            math.acos(-values["energy"]), rel=6e-4
        )
    orbit = loxodrome.data("data-orbit")
    alpha = swing_at(values["energy"], np.array(orbit["t"]) / clock(values))
    assert orbit["height"] == pytest.approx(-np.cos(alpha), abs=2e-4)
    assert_painted(loxodrome, LOXODROME)


def test_a_slider_moves_the_angle(loxodrome):
    loxodrome.change(lambda: loxodrome.slide(I2=1.25))
    theta, _ = said(loxodrome, "angle", "θ = #; measured on the track, to #.")
    values = {**LOXODROME.defaults(), "I2": 1.25}
    assert theta == pytest.approx(math.asin(1.0 / math.hypot(1.0, slope(values))), rel=6e-6)
    loxodrome.change(lambda: loxodrome.slide(energy=0.5))
    assert said(loxodrome, "height", "α = ±# at most;")[0] == pytest.approx(math.acos(-0.5), rel=6e-4)


def test_a_moment_that_is_not_between_the_others_is_refused_in_the_pictures(loxodrome):
    loxodrome.change(lambda: loxodrome.type("I2", "2.5"))
    for picture in LOXODROME.pictures:
        assert "I2 = 2.5 must lie between I1 = 1 and I3 = 2" in loxodrome.caption(picture)
    assert loxodrome.data("body") == {}
    loxodrome.change(loxodrome.page.locator(".param-reset").click)
    assert_painted(loxodrome, LOXODROME)


def test_the_body_moves_with_time_in_both_pictures(loxodrome):
    values = LOXODROME.defaults()
    for t in (1.7, 2.2):
        loxodrome.set_time(t)
        wait_frames(loxodrome)
        for picture in ("body", "space"):
            assert colour_at(loxodrome, picture, *centre_at(values, t)) == pytest.approx(YELLOW, abs=3), (t, picture)
            assert colour_at(loxodrome, picture, *centre_at(values, t + 0.6)) != pytest.approx(YELLOW, abs=3)
    before = canvas(loxodrome, "body").screenshot()
    loxodrome.play_until(2.3)
    assert canvas(loxodrome, "body").screenshot() != before


def test_keys_turn_the_body_and_the_link_keeps_it(loxodrome):
    canvas(loxodrome, "body").press("ArrowUp")
    wait_frames(loxodrome)
    assert canvas(loxodrome, "body").get_attribute("data-turn") == f"0.6000 {0.35 + math.pi / 36:.4f}"
    loxodrome.wait_url(el=f"{0.35 + math.pi / 36:.4f}")
    canvas(loxodrome, "body").press("Home")


# --- The body on the Suslov–Hess page -----------------------------------------------------------------


def test_the_body_of_the_hess_case_is_among_the_first_pictures_and_moves(explorer):
    body, orbit = explorer.data("body"), explorer.data("data-orbit")
    assert body["t"][-1] == orbit["t"][-1]
    moments = said(explorer, "body", "(does not affect the motion), principal moments #, #, #.")
    assert (np.array(body["semi"]) / body["semi"][2]) ** 2 == pytest.approx(np.array(moments) / moments[2], rel=1e-3)
    still = canvas(explorer, "body").screenshot()
    explorer.set_time(2.0)
    wait_frames(explorer)
    assert canvas(explorer, "body").screenshot() != still
    explorer.change(lambda: explorer.slide(h=1.2))
    assert explorer.data("body")["g1"] != body["g1"]
    explorer.assert_quiet()


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


def test_where_there_is_no_body_the_page_says_so_and_draws_none(tab):
    hess = brought(tab, HESS)
    assert hess.data("body")["semi"]
    hess.change(hess.choose, "preset", "Strong contraction, a = 3 (not a rigid body)")
    assert hess.data("body") == {}
    assert "Not drawn" in hess.caption("body")
    hess.assert_quiet()
