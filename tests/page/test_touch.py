"""Gestures of fingers on a phone: drags, boxes, strokes, taps and scrolling."""

import pytest

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from support.page import HESS, numbers_in
from support.pointer import HOME, Finger, assert_turned, at, frame
from support.thorough import sample


def middle(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def scrolled(phone):
    """Return how far the text is scrolled."""
    return phone.page.locator(".reader").evaluate("item => item.scrollTop")


@pytest.mark.parametrize("picture", ["sphere", "body"])
def test_a_sphere_turns_under_a_finger_and_the_page_stays(phone, picture):
    phone.turn_to(picture)
    before, canvas = scrolled(phone), phone.picture(picture).locator("canvas[tabindex]")
    x, y = middle(canvas.bounding_box())
    Finger(phone.page).draw((x, y), (x - 40, y + 30))
    assert scrolled(phone) == before
    radius = 0.84 * canvas.bounding_box()["width"] / 2
    assert_turned(canvas, HOME[0] + 40 / radius, HOME[1] + 30 / radius)


def test_a_finger_moves_a_slider_and_its_name(phone):
    for item, start in ((phone.slider("h"), None), (phone.page.locator(".param-h .label"), 0.5)):
        item.scroll_into_view_if_needed()
        box, (before, _) = item.bounding_box(), phone.shown("h")
        low, high = (float(phone.slider("h").get_attribute(end)) for end in ("min", "max"))
        x = box["x"] + box["width"] * ((before - low) / (high - low) if start is None else start)
        y = box["y"] + box["height"] / 2
        phone.change(Finger(phone.page).draw, (x, y), (x + 40, y))
        wait_ready(phone.page)
        after, slider = phone.shown("h")
        assert before < after == pytest.approx(slider)
        assert float(phone.wait_url(h=after)["h"]) == after


# One picture of each kind, with and without gestures of one finger.
@pytest.mark.parametrize(
    ("scene", "picture"),
    sample([(HESS, "omega"), (HESS, "sphere"), (HESS, "bifurcation"), ("rotation-number", "map"), (HESS, "body")], 2),
)
def test_two_fingers_zoom_and_choose_nothing(phone, picture):
    phone.turn_to(picture)
    x, y = middle(phone.picture(picture).locator(".host").bounding_box())
    before, finger = phone.link(), Finger(phone.page)
    finger.send("touchStart", (x - 20, y))
    finger.send("touchStart", (x - 20, y), (x + 20, y))
    for away in (40, 60, 80):
        finger.send("touchMove", (x - away, y), (x + away, y))
    finger.send("touchEnd")
    scale = phone.page.evaluate("visualViewport.scale")
    finger.session.send("Emulation.setPageScaleFactor", {"pageScaleFactor": 1})
    assert scale > 1.2
    assert phone.link() == before


@pytest.mark.parametrize("last", ["touchEnd", "touchCancel"])
def test_the_ring_follows_a_finger_and_the_caption_says_where_it_is(phone, last):
    phone.turn_to("bifurcation")
    (x, y), _ = at(phone, "bifurcation", *phone.here())
    # A finger is wider than the ring.
    start = (x + 12, y - 8)
    end, (wide, high) = at(phone, "bifurcation", 2.2, -0.5)
    phone.change(Finger(phone.page).draw, start, end, last)
    wait_ready(phone.page)
    assert phone.here() == (pytest.approx(2.2, abs=wide), pytest.approx(-0.5, abs=high))
    assert (phone.shown("h")[0], phone.shown("f")[0]) == pytest.approx(phone.here(), rel=1e-6)
    assert numbers_in(phone.caption("bifurcation"), "h = #, f = #") == pytest.approx(phone.here(), rel=1e-2)
    assert phone.picture("bifurcation").locator(".hover").is_hidden()


def test_a_finger_away_from_the_ring_or_on_the_text_chooses_nothing(phone):
    phone.turn_to("bifurcation")
    reader = phone.page.locator(".reader")
    reader.evaluate("item => { item.scrollTop = 0 }")
    before, finger = phone.here(), Finger(phone.page)
    (x, y), _ = at(phone, "bifurcation", 3.0, 1.0)
    finger.draw((x, y), (x - 20, y + 90))
    finger.draw((x, y), (x, y - 120))
    assert scrolled(phone) == 0
    x, y = middle(reader.bounding_box())
    finger.draw((x, y), (x, y - 80))
    wait_ready(phone.page)
    assert scrolled(phone) > 30
    assert phone.here() == before
    assert phone.picture("bifurcation").locator(".hover").is_hidden()


TAPPED = [
    (name, view.name)
    for name, scene in scenes().items()
    for view in scene.views
    if scene.origin is None and "tap" in getattr(view, "events", ())
]


@pytest.mark.parametrize(("scene", "picture"), sample(TAPPED, 2))
def test_a_finger_taps_every_picture_that_takes_clicks(phone, picture):
    phone.turn_to(picture)
    left, top, right, bottom = frame(phone, picture)
    # The place gives a new state, or a note on why there is none.
    phone.change(phone.page.touchscreen.tap, 0.45 * left + 0.55 * right, 0.5 * (top + bottom))
