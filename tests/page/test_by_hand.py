"""A state reached by hand looks, pixel for pixel, as the same state opened by its link.

What an earlier state leaves behind (ticks of other axes, a layer that was not cleared) is a difference of a few pixels
that no comparison of data can see.
"""

import io
import math
import re

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from hess_explorer.protocol.specs import NumberSpec
from hess_explorer.scenes import scenes
from support.page import wait_frames
from support.pointer import frame
from support.thorough import sample

SCENES = scenes()
MOST = 2
"""With more examples, a sample is tested: leftovers of an earlier one show at the end."""

# Planar picture → the events of Bokeh that choose something in it.
PICKS = "() => Object.fromEntries(hess.plots.map(({ model }) => [model.name, Object.keys(model.js_event_callbacks)]))"


# The picture that was clicked last has the focus, and a dotted line about it.
BLUR = """() => {
  let focused = document.activeElement
  while (focused?.shadowRoot?.activeElement) focused = focused.shadowRoot.activeElement
  focused?.blur()
}"""


def pictures(explorer):
    """All pictures with their captions as they are on the screen, as RGB."""
    # Later results have arrived.
    expect(
        explorer.page.locator(".gallery:not(.away) .caption").filter(
            has_text=re.compile(r"Measured so far|[Bb]eing computed")
        )
    ).to_have_count(0, timeout=120_000)
    explorer.page.mouse.move(5, 5)
    explorer.page.evaluate(BLUR)
    wait_frames(explorer)
    shot = explorer.page.locator(".gallery:not(.away)").screenshot()
    return Image.open(io.BytesIO(shot)).convert("RGB")


def assert_same_by_link(explorer, artefacts, name):
    """Open the link to the current state, and compare."""
    address = explorer.link().removeprefix(explorer.base)
    by_hand = pictures(explorer)
    by_link = pictures(explorer.goto(address))
    assert by_hand.size == by_link.size, address
    apart = np.abs(np.asarray(by_hand, int) - np.asarray(by_link, int)).max(axis=2)
    # Where two edges meet on a canvas the browser rounds by one step of 255, which is invisible.
    count = int(np.sum(apart > 1))
    if count:
        by_hand.save(artefacts / f"{name}-by-hand.png")
        by_link.save(artefacts / f"{name}-by-link.png")
    assert count == 0, f"{count} pixels differ from {address}"


def through_examples(explorer):
    """Examples in turn, the last of them too, and back to the one before it."""
    names = [name for name in explorer.menu("preset").locator("option").all_text_contents() if "…" not in name]
    names = names[:: -math.ceil(len(names) / MOST)][::-1]
    for name in [*names, *names[-2:-1]]:
        if explorer.chosen("preset") != name:
            explorer.change(explorer.choose, "preset", name)


def through_numbers(explorer):
    """The numbers typed, one after the other; the first of them twice."""
    specs = [spec for spec in SCENES[explorer.scene].specs if isinstance(spec, NumberSpec)]
    free = [spec for spec in specs if explorer.box(spec.name).count() and explorer.box(spec.name).is_enabled()]
    for share, chosen in ((0.8, free[:1]), (0.6, free[:3])):
        for spec in chosen:
            low, high = (float(explorer.slider(spec.name).get_attribute(end)) for end in ("min", "max"))
            text = f"{low + share * (high - low):.3g}"
            if explorer.shown(spec.name)[0] != float(text):
                explorer.change(explorer.type, spec.name, text)


def through_pictures(explorer):
    """A box in every picture that has boxes, and a click in every one that has clicks."""
    mouse = explorer.page.mouse
    for name, events in explorer.page.evaluate(PICKS).items():
        if explorer.picture(name).is_visible():
            left, top, right, bottom = frame(explorer, name)
            wide, high = right - left, bottom - top
            if "panstart" in events:
                mouse.move(left + 0.3 * wide, top + 0.35 * high)
                mouse.down()
                mouse.move(left + 0.6 * wide, top + 0.6 * high, steps=4)
                explorer.change(mouse.up)
            if "tap" in events:
                explorer.change(explorer.click, left + 0.45 * wide, top + 0.4 * high)


# First one that takes numbers, boxes and clicks, and is computed fast.
OWN = sorted(
    (name for name, scene in SCENES.items() if scene.origin is None), key=lambda name: name != "rotation-number"
)


@pytest.mark.parametrize("scene", sample(OWN, 1))
def test_a_state_reached_by_hand_looks_as_the_one_its_link_opens(explorer, artefacts, scene):
    # All levels draw the same picture.
    explorer.change(explorer.choose, "accuracy", "draft")
    through_examples(explorer)
    through_pictures(explorer)
    # Last, for numbers change axes.
    through_numbers(explorer)
    assert_same_by_link(explorer, artefacts, scene)
