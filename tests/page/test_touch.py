"""Gestures of fingers on a phone: drags, strokes, scrolling and zooming."""

import pytest

from hess_explorer.headless.browser import wait_ready
from support.page import numbers_in
from support.pointer import HOME, Finger, assert_turned, at, shares


def middle(item):
    box = item.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def scrolled(phone):
    """Return how far the text is scrolled."""
    return phone.page.locator(".reader").evaluate("item => item.scrollTop")


def pinch(finger, x, y):
    """Spread two fingers to four times their distance."""
    for away in (20, 40, 60, 80):
        finger.send("touchMove" if away > 20 else "touchStart", (x - away, y), (x + away, y))
    finger.send("touchEnd")


@pytest.mark.parametrize("picture", ["sphere", "body"])
def test_a_picture_in_space_turns_under_a_finger_as_if_it_were_held_and_two_do_nothing(phone, picture):
    phone.turn_to(picture)
    before, canvas, finger = scrolled(phone), phone.picture(picture).locator("canvas[tabindex]"), Finger(phone.page)
    x, y = middle(canvas)
    finger.draw((x, y), (x - 40, y + 30))
    assert scrolled(phone) == before
    radius = 0.84 * canvas.bounding_box()["width"] / 2
    assert_turned(canvas, HOME[0] + 40 / radius, HOME[1] + 30 / radius)
    link = phone.link()
    pinch(finger, x, y)
    assert phone.page.evaluate("visualViewport.scale") == 1
    assert phone.link() == link


def test_two_fingers_zoom_a_plane_and_neither_the_page_nor_the_state(phone):
    for picture in ("omega", "bifurcation"):
        phone.turn_to(picture)
        finger, link, (x0, x1, y0, y1) = Finger(phone.page), phone.link(), phone.axes(picture)
        # The ring is in the middle of the fingers.
        place = phone.here() if picture == "bifurcation" else (0.0, 0.0)
        (pixel, _), where = at(phone, picture, *place), shares(phone, picture, *place)
        pinch(finger, *pixel)
        left, right, low, high = phone.axes(picture)
        assert (right - left, high - low) == pytest.approx(((x1 - x0) / 4, (y1 - y0) / 4), rel=1e-3)
        assert shares(phone, picture, *place) == pytest.approx(where, abs=0.04)
        assert phone.page.evaluate("visualViewport.scale") == 1
        phone.picture(picture).locator(".whole").tap()
        assert phone.axes(picture) == [x0, x1, y0, y1]
        assert phone.link() == link
        assert phone.picture(picture).locator(".whole").is_hidden()


def test_a_finger_moves_a_slider(phone):
    slider, (before, _) = phone.slider("h"), phone.shown("h")
    box = slider.bounding_box()
    low, high = (float(slider.get_attribute(end)) for end in ("min", "max"))
    x, y = box["x"] + box["width"] * (before - low) / (high - low), box["y"] + box["height"] / 2
    phone.change(Finger(phone.page).draw, (x, y), (x + 40, y))
    wait_ready(phone.page)
    after, slid = phone.shown("h")
    assert before < after == pytest.approx(slid)
    phone.wait_url(h=after)


@pytest.mark.parametrize("last", ["touchEnd", "touchCancel"])
def test_the_ring_follows_a_finger_and_one_elsewhere_chooses_nothing_and_scrolls_the_text(phone, last):
    phone.turn_to("bifurcation")
    finger, reader = Finger(phone.page), phone.page.locator(".reader")
    (x, y), _ = at(phone, "bifurcation", *phone.here())
    # A finger is wider than the ring.
    end, (wide, high) = at(phone, "bifurcation", 2.2, -0.5)
    phone.change(finger.draw, (x + 12, y - 8), end, last)
    wait_ready(phone.page)
    here = phone.here()
    assert here == (pytest.approx(2.2, abs=wide), pytest.approx(-0.5, abs=high))
    assert phone.torus() == pytest.approx(here, rel=1e-6)
    assert numbers_in(phone.caption("bifurcation"), "h = #, f = #") == pytest.approx(here, rel=1e-2)
    reader.evaluate("item => { item.scrollTop = 0 }")
    (x, y), _ = at(phone, "bifurcation", 3.0, 1.0)
    finger.draw((x, y), (x, y - 120))
    assert scrolled(phone) == 0
    x, y = middle(reader)
    finger.draw((x, y), (x, y - 80))
    wait_ready(phone.page)
    assert scrolled(phone) > 30
    assert phone.here() == here
    assert phone.picture("bifurcation").locator(".hover").is_hidden()
