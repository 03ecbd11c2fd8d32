"""A state reached by hand looks, pixel for pixel, as the same state opened by its link.

What an earlier state leaves behind (ticks of other axes, a layer that was not cleared) is a difference of a few pixels
that no comparison of data can see.
"""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from hess_explorer.scenes import scenes
from support.page import Explorer
from support.pointer import frame

PAUSE = 450
"""Milliseconds after which the address bar has followed, and two clicks are no double click."""

# Planar picture → the events of Bokeh that choose something in it.
PICKS = "() => Object.fromEntries(hess.plots.map(({ model }) => [model.name, Object.keys(model.js_event_callbacks)]))"


@pytest.fixture(scope="module")
def hand(browser, server):
    """One tab for all scenes."""
    context = browser.new_context(viewport={"width": 1600, "height": 950})
    explorer = Explorer(context.new_page(), server)
    yield explorer
    explorer.assert_quiet()
    context.close()


def pause(explorer):
    explorer.page.evaluate("pause => new Promise((done) => setTimeout(done, pause))", PAUSE)


# The picture that was clicked last has the focus, and a dotted line about it.
BLUR = """() => {
  let focused = document.activeElement
  while (focused?.shadowRoot?.activeElement) focused = focused.shadowRoot.activeElement
  focused?.blur()
}"""


def pictures(explorer):
    """All pictures with their captions as they are on the screen, as RGB."""
    explorer.page.mouse.move(5, 5)
    explorer.page.evaluate(BLUR)
    pause(explorer)
    shot = explorer.page.locator(".gallery:not(.away)").screenshot()
    return Image.open(io.BytesIO(shot)).convert("RGB")


def assert_same_by_link(explorer, artefacts, walk):
    """Open the link of what is on the screen, and compare."""
    by_hand = pictures(explorer)
    scene, address = explorer.scene, explorer.page.url.removeprefix(explorer.base)
    by_link = pictures(explorer.goto(address))
    assert by_hand.size == by_link.size, address
    apart = np.abs(np.asarray(by_hand, int) - np.asarray(by_link, int)).max(axis=2)
    # Where two edges meet on a canvas the browser rounds by one step of 255, which nobody sees.
    apart[apart == 1] = 0
    if apart.any():
        by_hand.save(artefacts / f"{scene}-{walk}-by-hand.png")
        by_link.save(artefacts / f"{scene}-{walk}-by-link.png")
    rows, columns = np.nonzero(apart)
    where = "" if rows.size == 0 else f"x {columns.min()}…{columns.max()}, y {rows.min()}…{rows.max()}"
    assert rows.size == 0, f"{rows.size} pixels differ ({where}) from {address}"


def through_examples(explorer):
    """Every example in turn, and back to the one before the last."""
    names = [name for name in explorer.menu("preset").locator("option").all_text_contents() if "…" not in name]
    for name in [*names, *names[-2:-1]]:
        if explorer.chosen("preset") != name:
            explorer.change(explorer.choose, "preset", name)


def through_numbers(explorer):
    """The first numbers typed, one after the other, each twice; one that is refused is taken back.

    While a state is refused the axes stay as they were, so that they do not jump under a slider that is dragged.
    """
    boxes = explorer.page.locator(".number")
    names = [classes.split("param-")[1].split()[0] for classes in
             boxes.evaluate_all("boxes => boxes.map((box) => box.className)")]
    for share in (0.8, 0.6):
        for name in names[:3]:
            before = explorer.shown(name)[0]
            low, high = (float(explorer.slider(name).get_attribute(end)) for end in ("min", "max"))
            text = f"{low + share * (high - low):.3g}"
            if before != float(text):
                explorer.change(explorer.type, name, text)
            if is_refused(explorer) and explorer.shown(name)[0] != before:
                explorer.change(explorer.type, name, repr(before))


def is_refused(explorer):
    """Whether all captions say the same: why there is nothing to see."""
    captions = explorer.page.locator(".gallery:not(.away) .picture:not(.folded) .caption").all_text_contents()
    return len(captions) > 1 and len(set(captions)) == 1


def through_pictures(explorer):
    """A box in every picture that has boxes, and a click in every one that has clicks."""
    mouse = explorer.page.mouse
    for name, events in explorer.page.evaluate(PICKS).items():
        if not explorer.picture(name).is_visible():
            continue
        left, top, right, bottom = frame(explorer, name)
        if "panstart" in events:
            mouse.move(left + 0.3 * (right - left), top + 0.35 * (bottom - top))
            mouse.down()
            mouse.move(left + 0.6 * (right - left), top + 0.6 * (bottom - top), steps=4)
            explorer.change(mouse.up)
        if "tap" in events:
            pause(explorer)
            explorer.change(mouse.click, left + 0.45 * (right - left), top + 0.4 * (bottom - top))


# A page takes longest to load: one link for each of these.
WALKS = {"controls": (through_examples, through_numbers), "pictures": (through_pictures,)}


@pytest.mark.parametrize("scene", scenes())
def test_a_state_reached_by_hand_looks_as_the_one_its_link_opens(hand, artefacts, scene):
    if hand.page.url != "about:blank" and hand.page.locator(f".param-scene-{scene}").count():
        hand.enter(scene)
    else:
        hand.open(f"scene={scene}")
    for walk, ways in WALKS.items():
        for way in ways:
            way(hand)
        assert_same_by_link(hand, artefacts, walk)
