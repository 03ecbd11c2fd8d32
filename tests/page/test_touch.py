"""Gestures of fingers on a phone: drags, boxes, strokes, taps and scrolling."""

import re
from urllib.parse import parse_qsl, urlsplit

import pytest

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from support.page import HESS, numbers_in
from support.pointer import HOME, Finger, assert_turned, at, frame
from support.thorough import sample


def turn_to(phone, picture, scene=HESS):
    """Choose a picture by its number."""
    number = 1 + scenes()[scene].pictures.index(picture)
    chip = phone.page.locator(".chips .chip").nth(number - 1)
    if chip.get_attribute("aria-pressed") != "true":
        phone.change(chip.click)


def middle(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def scrolled(phone):
    """Return how far the text is scrolled."""
    return phone.page.locator(".reader").evaluate("item => item.scrollTop")


@pytest.mark.parametrize("picture", ["sphere", "body"])
def test_a_sphere_turns_under_a_finger_and_the_page_stays(phone, picture):
    phone = phone()
    turn_to(phone, picture)
    before, canvas = scrolled(phone), phone.picture(picture).locator("canvas:not(.ghost)")
    x, y = middle(canvas.bounding_box())
    Finger(phone.page).draw((x, y), (x - 40, y + 30))
    assert scrolled(phone) == before
    radius = 0.84 * canvas.bounding_box()["width"] / 2
    assert_turned(canvas, HOME[0] + 40 / radius, HOME[1] + 30 / radius)


def test_a_finger_moves_a_slider_and_its_name(phone):
    phone = phone()
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
    sample([(HESS, "omega"), (HESS, "sphere"), (HESS, "bifurcation"), ("rotation-number", "map"), (HESS, "body")], 3),
)
def test_two_fingers_zoom_and_choose_nothing(phone, scene, picture):
    phone = phone(scene)
    turn_to(phone, picture, scene)
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
    phone = phone()
    turn_to(phone, "bifurcation")
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


def test_a_second_finger_does_not_move_the_ring(phone):
    phone = phone()
    turn_to(phone, "bifurcation")
    start, _ = at(phone, "bifurcation", *phone.here())
    other, _ = at(phone, "bifurcation", 3.0, 1.0)
    end, (wide, high) = at(phone, "bifurcation", 1.5, 0.2)
    finger = Finger(phone.page)
    finger.send("touchStart", start)
    finger.send("touchMove", ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    finger.send("touchMove", end)
    finger.send("touchStart", end, other)
    finger.send("touchMove", end, (other[0] + 20, other[1] + 20))
    finger.send("touchEnd")
    wait_ready(phone.page)
    assert phone.here() == (pytest.approx(1.5, abs=wide), pytest.approx(0.2, abs=high))


def test_a_finger_away_from_the_ring_or_on_the_text_chooses_nothing(phone):
    phone = phone()
    turn_to(phone, "bifurcation")
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


@pytest.mark.parametrize(("scene", "picture"), sample(TAPPED, 4))
def test_a_finger_taps_every_picture_that_takes_clicks(phone, scene, picture):
    phone = phone(scene)
    turn_to(phone, picture, scene)
    left, top, right, bottom = frame(phone, picture)
    # The place gives a new state, or a note on why there is none.
    phone.change(phone.page.touchscreen.tap, 0.45 * left + 0.55 * right, 0.5 * (top + bottom))


def test_a_finger_starts_an_orbit_in_a_section(phone):
    phone = phone("suslov")
    turn_to(phone, "section", "suslov")
    place, unit = at(phone, "section", 0.7, 1.9)
    phone.change(phone.page.touchscreen.tap, *place)
    starts = dict(parse_qsl(urlsplit(phone.link()).query))["starts"]
    x, y = map(float, starts.split(";")[-1].split(","))
    assert (x, y) == (pytest.approx(0.7, abs=unit[0]), pytest.approx(1.9, abs=unit[1]))


def test_a_finger_draws_a_box_and_a_cancelled_one_is_forgotten(phone):
    phone = phone("rotation-number")
    turn_to(phone, "map", "rotation-number")
    left, top, right, bottom = frame(phone, "map")
    start = (left + 0.3 * (right - left), top + 0.3 * (bottom - top))
    end = (left + 0.7 * (right - left), top + 0.7 * (bottom - top))
    axes = phone.axes("map")
    Finger(phone.page).draw(start, end, "touchCancel")
    wait_ready(phone.page)
    assert phone.axes("map") == axes
    phone.change(Finger(phone.page).draw, start, end)
    wait_ready(phone.page)
    x0, x1, *_ = phone.axes("map")
    assert x1 - x0 == pytest.approx(0.4 * (axes[1] - axes[0]), rel=0.1)


def test_a_phone_opens_on_the_picture_that_the_sentence_speaks_of(phone):
    tab = phone("quartic")
    for name in ("scattering", "suslov-hess", "chaplygin-ball"):
        tab.change(tab.page.evaluate, "scene => hess.tell('scene', scene)", name)
        scene = scenes()[name]
        (view,) = (view for view in scene.views if tab.picture(view.name).is_visible())
        # The sentence asks for a click or a drag: the picture takes it.
        assert re.search("Click|Drag|drag", scene.moves)
        assert view.hands
        # Each chip has the name of its picture, and the one on show is pressed.
        chips = tab.page.locator(".chips .chip")
        pressed = chips.and_(tab.page.locator("[aria-pressed=true]"))
        assert pressed.text_content() == tab.picture(view.name).locator(".title").text_content()
        names = chips.all_text_contents()
        assert len(set(names)) == len(scene.views)
        assert all(re.search("[a-z]", text) for text in names)
