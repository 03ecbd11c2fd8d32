"""The first ten seconds: automatic motion, the suggested drag, and the effect of the mouse."""

from contextlib import ExitStack

import pytest
from pytest import approx

from support.page import HESS, VISITOR, own_tab
from support.pointer import at, click_on

SIGN = ".drag-me:visible"
# The cursor over a place in the window, whatever is on top there; what is said of the place on hover.
UNDER = """([x, y]) => {
  let item = document.elementFromPoint(x, y)
  while (item.shadowRoot?.elementFromPoint(x, y) && item.shadowRoot.elementFromPoint(x, y) !== item)
    item = item.shadowRoot.elementFromPoint(x, y)
  const { cursor } = getComputedStyle(item)
  for (let at = item; at; at = at.parentElement ?? at.getRootNode().host) if (at.title) return [cursor, at.title]
  return [cursor, ""]
}"""


@pytest.fixture
def fresh_browser(browser, server):
    """fresh_browser(query, reduced_motion) → a page that is ready, of a visitor who has never been here."""
    with ExitStack() as tabs:
        yield lambda query, motion: tabs.enter_context(
            own_tab(browser, server, script=VISITOR, reduced_motion=motion)
        ).open(query)


def moves(explorer):
    """Return whether the time advances within a few frames."""
    return explorer.page.locator("input.param-t").evaluate(
        """async (slider) => {
          const before = slider.value
          for (let i = 0; i < 6; i++) await new Promise(requestAnimationFrame)
          return slider.value !== before
        }"""
    )


def test_a_scene_begins_in_gentle_motion_that_goes_on_under_the_hand_and_asks_for_nothing(fresh_browser):
    explorer = fresh_browser(f"scene={HESS}", "no-preference")
    page = explorer.page
    # A link with a state has no introduction.
    assert page.get_by_role("region", name="Lesson", exact=True).count() == 0
    # The address is written a moment after the first state.
    page.wait_for_function("location.search.includes('v=1')")
    assert page.locator(SIGN).count() == 1
    before = explorer.state, page.url, page.evaluate("history.length"), len(explorer.sent)
    page.mouse.move(300, 300)
    assert all(moves(explorer) for _ in range(3))
    # No state, no address, no entry for Back, no message.
    assert (explorer.state, page.url, page.evaluate("history.length"), len(explorer.sent)) == before
    # It goes on under the hand; the player's own key is a pause.
    page.mouse.click(800, 5)
    page.mouse.wheel(0, 10)
    assert explorer.playing
    assert moves(explorer)
    page.keyboard.press("Space")
    assert not moves(explorer)
    assert explorer.time > 0
    explorer.show("scattering")
    assert explorer.playing
    # No animation starts a second time.
    explorer.show(HESS)
    assert not explorer.playing
    # A click among parameters leaves the time as it is; one that chooses a start starts the motion.
    explorer.set_time(5.0)
    click_on(explorer, "bifurcation", 2.0, 0.5)
    assert (explorer.playing, explorer.time) == (False, 5.0)
    click_on(explorer, "circle", -2.5, 1.0)
    assert moves(explorer) and explorer.time < 5.0
    # A link with a time opens at that time; a speed not offered is put right, and the handle is not pointed out again.
    explorer.open(f"scene={HESS}&t=3.5&speed=3")
    assert (explorer.playing, explorer.time) == (False, approx(3.5))
    assert page.locator(".param-speed").input_value() != "3"
    assert page.locator(SIGN).count() == 0


def test_the_one_handle_says_drag_me_once_and_what_the_mouse_does_is_said_where_it_does_it(fresh_browser):
    explorer = fresh_browser(f"scene={HESS}", "reduce")
    page, sign = explorer.page, explorer.page.locator(SIGN)
    # Nothing moves by itself if the user prefers reduced motion.
    assert not explorer.playing
    # Beside the ring of the diagram.
    (x, y), _ = at(explorer, "bifurcation", *explorer.here())
    box = sign.bounding_box()
    assert 0 < box["x"] - x < 40
    assert box["y"] + box["height"] / 2 == approx(y, abs=3)
    explorer.change(page.locator(".param-h .hand").press, "ArrowRight")
    assert sign.count() == 0
    # In another scene the hint is beside a slider's thumb.
    explorer.enter("scattering")
    slider, box = explorer.slider("phi").bounding_box(), sign.bounding_box()
    assert slider["y"] < box["y"] + box["height"] / 2 < slider["y"] + slider["height"]
    # Hints for dragging, clicking and rotating.
    for scene, picture, cursor, word in (
        ("scattering", "curve", "move", "Drag"),
        ("scattering", "body", "grab", "turns"),
        ("free-suslov", "omega", "pointer", "Click"),
    ):
        explorer.show(scene)
        explorer.lead(picture)
        box = explorer.picture(picture).locator(".host").bounding_box()
        place = [box["x"] + 0.6 * box["width"], box["y"] + 0.4 * box["height"]]
        page.mouse.move(*place)
        found, said = page.evaluate(UNDER, place)
        assert (found, word in said) == (cursor, True), picture
