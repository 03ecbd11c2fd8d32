"""Changes of scene, visible pictures, drawing during a drag, and the player between two samples."""

import json

from pytest import approx

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from support.page import (
    DEFAULTS,
    FIRST,
    HESS,
    PHONE,
    STUDY,
)
from support.painted import assert_drawn
from support.pointer import HOME, STEP, assert_turned

SCENES = scenes()
# The menu offers only the accuracy page of the current scene.
OFFERED = [name for name, scene in SCENES.items() if scene.origin in (None, HESS)]
GROUPS = list(dict.fromkeys(SCENES[name].group for name in OFFERED))


# These counts would grow if a change of scene leaked anything.
HELD = """[Bokeh.documents.length, Object.keys(Bokeh.index).length, document.querySelectorAll("*").length,
  hess.plots.flatMap((plot) => [...plot.model.references()]).length]"""


def listeners(explorer):
    """Return the page's number of listeners for each kind of event."""
    session = explorer.page.context.new_cdp_session(explorer.page)
    answer = session.send(
        "Runtime.evaluate",
        {
            "expression": """JSON.stringify([document, window].map(
          (on) => Object.entries(getEventListeners(on)).map(([kind, all]) => [kind, all.length]).sort()))""",
            "includeCommandLineAPI": True,
            "returnByValue": True,
        },
    )
    session.detach()
    return json.loads(answer["result"]["value"])


# --- The menu of scenes ------------------------------------------------------------------------------


def test_the_menu_offers_the_scenes_in_groups_with_pictures_and_says_where_to_begin_and_which_is_on_show(explorer):
    page = explorer.page
    explorer.turn_theme(is_dark=True)
    explorer.open_menu()
    menu = page.get_by_role("dialog", name="Scenes", exact=True)
    assert menu.locator("h3").all_text_contents() == GROUPS
    for group in GROUPS:
        tiles = menu.get_by_role("region", name=group, exact=True).get_by_role("button").all()
        names = [name for name in OFFERED if SCENES[name].group == group]
        assert [tile.get_attribute("data-scene") for tile in tiles] == names
        for name, tile in zip(names, tiles, strict=True):
            words = tile.inner_text()
            assert SCENES[name].title in words and SCENES[name].summary in words
            assert ("start here" in words) == (name == FIRST)
            assert tile.get_attribute("aria-pressed") == str(name == HESS).lower()
            picture = tile.locator("img")
            assert picture.get_attribute("src").endswith("-dark.jpg")
            picture.scroll_into_view_if_needed()
            page.wait_for_function("item => item.complete && item.naturalWidth === 320", arg=picture.element_handle())
    explorer.change(menu.get_by_role("button", name="Loxodromic pendulum").click)
    assert explorer.scene == "loxodrome"
    assert menu.count() == 0


FOCUSED = """() => {
  let item = document.activeElement
  while (item?.shadowRoot?.activeElement) item = item.shadowRoot.activeElement
  return item?.dataset.scene ?? item?.className ?? ""
}"""


def test_the_menu_obeys_the_keyboard_and_is_searched(explorer):
    page, keys = explorer.page, explorer.page.keyboard
    button = page.locator(".param-scenes")

    def focused(*presses):
        for key in presses:
            keys.press(key)
        return page.evaluate(FOCUSED)

    button.press("Enter")
    assert focused() == HESS
    assert focused("ArrowRight") not in (HESS, "")
    assert focused("ArrowLeft") == HESS
    # Down and up again, over the edge of a group; at the top is the search.
    assert SCENES[focused(*["ArrowDown"] * 4)].group != SCENES[HESS].group
    assert focused(*["ArrowUp"] * 5) == "search"
    # Typed text goes to the search box only, also from a scene.
    keys.press("ArrowDown")
    keys.type("f loxo nowhere ")
    assert page.get_by_text("No scene matches.").is_visible()
    page.locator(".search").fill("accuracy SPEED")
    assert [tile.get_attribute("data-scene") for tile in page.locator(".scene:visible").all()] == [STUDY]
    explorer.change(keys.press, "Enter")
    assert explorer.scene == STUDY
    # The focus never leaves the dialog while it is open, and comes back to its button.
    button.press("Enter")
    for _ in range(3):
        assert focused("Shift+Tab") in (*SCENES, "search", "button")
    assert focused("Escape") == "tool param-scenes"
    assert not explorer.playing
    assert page.locator(".gallery:not(.away) .corner[aria-pressed=true]").count() == 0


# --- From one scene to another -----------------------------------------------------------------------

CHANGED = {"I22": 1.25, "I23": -0.5, "b3": -2.0, "h": 0.75, "f": -0.3, "phi0": 2.0, "span": 25.0}


def test_a_scene_changes_in_place_and_back_with_all_that_was_chosen(explorer):
    page = explorer.page
    page.evaluate("window.same = true")
    explorer.move(**CHANGED)
    explorer.change(explorer.choose, "accuracy", "precise")
    page.locator(".param-speed").select_option("2")
    explorer.set_time(7.5)
    explorer.sphere.press("ArrowUp")
    for scene in (STUDY, HESS):
        explorer.enter(scene)
        assert page.title() == f"Hess Explorer · {SCENES[scene].title}"
        assert page.get_by_role("heading", level=1).inner_text() == SCENES[scene].title
        assert_drawn(explorer, scene, {**DEFAULTS, **CHANGED, "accuracy": "precise"})
        assert {name: explorer.shown(name)[0] for name in CHANGED} == CHANGED
        assert (explorer.chosen("accuracy"), explorer.time) == ("precise", approx(7.5))
        link = explorer.wait_url(scene=scene)
        assert {name: float(link[name]) for name in CHANGED} == CHANGED
        assert explorer.sphere.count() == (scene == HESS)
    assert page.evaluate("window.same")
    assert_turned(explorer.sphere, HOME[0], HOME[1] + STEP)
    assert page.locator(".param-speed").input_value() == "2"


def test_ten_changes_in_quick_succession_leave_one_scene_and_nothing_of_the_others(explorer):
    def enter(name):
        # Without the mouse: where that rests in between, the pictures of that scene would be built.
        explorer.page.locator(f".param-scene-{name}").dispatch_event("click")

    # Each is built when it is entered first.
    for name in (STUDY, HESS):
        explorer.change(enter, name)
    at_rest, held, before = listeners(explorer), explorer.page.evaluate(HELD), explorer.state
    for _ in range(5):
        for name in (STUDY, HESS):
            enter(name)
    wait_ready(explorer.page, after=before)
    assert explorer.page.evaluate(HELD) == held
    assert explorer.scene == HESS
    assert_drawn(explorer, HESS, DEFAULTS)
    assert listeners(explorer) == at_rest
    assert explorer.page.locator(".picture:visible").count() == 6
    # One change is asked for once, and one key is pressed for one player.
    explorer.sent.clear()
    explorer.move(h=0.75)
    assert [values for frame in explorer.sent if (values := json.loads(frame)["values"])] == [{"h": 0.75}]
    explorer.page.evaluate("document.activeElement?.blur()")
    explorer.page.keyboard.press("ArrowRight")
    assert explorer.time == approx(0.2, rel=1e-5)


# --- What is in sight --------------------------------------------------------------------------------


def test_on_a_phone_one_control_is_at_hand_and_the_picture_stays_while_it_moves(phone):
    page = phone.page
    chooser = page.locator(".chooser").get_by_role("button")

    def at_hand():
        return [item.get_attribute("class").split()[1] for item in page.locator(".number:visible").all()]

    phone.change(phone.tell, "change", {"h": 0.75})
    assert at_hand() == ["param-h"]
    at_rest = listeners(phone)
    phone.turn_to("omega")
    picture, box = phone.picture("omega").bounding_box(), phone.slider("h").bounding_box()
    # Under the thumb, and as large as a thumb.
    assert 0.85 * PHONE[1] < box["y"] <= PHONE[1] - box["height"] <= PHONE[1] - 44
    phone.change(page.touchscreen.tap, box["x"] + 0.8 * box["width"], box["y"] + box["height"] / 2)
    h = phone.shown("h")[0]
    assert 2.0 < h < 4.0
    assert_drawn(phone, HESS, {**DEFAULTS, "h": h}, "omega")
    chooser.filter(has_text="b₃").click()
    assert at_hand() == ["param-b3"]
    phone.change(phone.type, "b3", "-2")
    assert phone.picture("omega").bounding_box() == picture
    chooser.filter(has_text="Example").click()
    assert at_hand() == []
    phone.change(phone.choose, "preset", "No cycle: every orbit winds")
    assert listeners(phone) == at_rest
