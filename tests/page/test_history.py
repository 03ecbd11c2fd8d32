"""Undo and Redo, and the browser's Back and Forward, over all that changes a state."""

import pytest

from hess_explorer.headless.browser import wait_ready
from support.page import DEFAULTS, HESS
from support.suslov_hess import assert_orbit


def numbers(explorer, *names):
    return tuple(explorer.shown(name)[0] for name in names)


def test_undo_and_redo_go_through_all_that_was_done_and_one_drag_is_one_step(explorer):
    page = explorer.page
    undo, redo = page.locator(".param-undo"), page.locator(".param-redo")
    explorer.goto(f"/?scene={HESS}")
    assert undo.is_disabled()
    assert redo.is_disabled()
    seen = [(DEFAULTS["h"], DEFAULTS["f"])]

    def done(action, *arguments):
        explorer.change(action, *arguments)
        seen.append(numbers(explorer, "h", "f"))
        assert seen[-1] != seen[-2]

    done(lambda: explorer.slide(f=0.3))
    done(explorer.type, "h", "0.7")
    # A drag with many states on the way.
    box = explorer.slider("h").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.4 * box["width"], middle)
    page.mouse.down()
    for share in (0.45, 0.5, 0.6):
        explorer.change(page.mouse.move, box["x"] + share * box["width"], middle)
    explorer.change(page.mouse.up)
    seen.append(numbers(explorer, "h", "f"))
    done(explorer.choose, "preset", "No cycle: every orbit winds")
    explorer.enter("loxodrome")
    assert redo.is_disabled()
    # With the keys, from wherever the focus is.
    explorer.change(page.keyboard.press, "Control+z")
    assert page.evaluate("document.documentElement.dataset.scene") == HESS
    for shown in reversed(seen):
        assert numbers(explorer, "h", "f") == shown
        if shown is not seen[0]:
            explorer.change(page.keyboard.press, "Control+z")
    assert undo.is_disabled()
    assert_orbit(explorer, DEFAULTS)
    for shown in seen[1:3]:
        explorer.change(redo.click)
        assert numbers(explorer, "h", "f") == shown
    for shown in seen[3:]:
        explorer.change(page.keyboard.press, "Control+Shift+z")
        assert numbers(explorer, "h", "f") == shown
    explorer.change(page.keyboard.press, "Control+y")
    assert page.evaluate("document.documentElement.dataset.scene") == "loxodrome"
    assert redo.is_disabled()
    # From a change on is nothing to redo.
    explorer.change(page.keyboard.press, "Control+z")
    explorer.change(lambda: explorer.slide(h=2.5))
    assert redo.is_disabled()
    # The browser undoes text that is still being typed.
    explorer.box("h").fill("9")
    explorer.box("h").press("Control+z")
    assert explorer.here()[0] == pytest.approx(2.5)


def test_back_and_forward_go_by_scenes_and_examples_and_do_not_reload(explorer):
    page = explorer.page
    page.evaluate("window.kept = true")
    # A browser keeps fifty entries, and other tests have made some in this tab.
    length = min(page.evaluate("history.length") + 2, 50)
    explorer.change(lambda: explorer.slide(h=0.7))
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    explorer.change(lambda: explorer.slide(f=0.25))
    explorer.enter("loxodrome")
    # As long as it takes the browser to tell of it.
    assert page.evaluate("history.length") == length
    for name, h, f in ((HESS, 0.2, 0.25), (HESS, 0.7, 0.6)):
        before = explorer.state
        page.evaluate("history.back()")
        wait_ready(page, after=before)
        assert page.evaluate("document.documentElement.dataset.scene") == name
        assert numbers(explorer, "h", "f") == (h, f)
        assert explorer.wait_url(h=str(h), f=str(f))["scene"] == HESS
    for name in (HESS, "loxodrome"):
        before = explorer.state
        page.evaluate("history.forward()")
        wait_ready(page, after=before)
        assert page.evaluate("document.documentElement.dataset.scene") == name
    assert page.evaluate("history.length") == length
    assert page.evaluate("window.kept")
    # Going back is a change as any other: it can be undone.
    explorer.change(page.keyboard.press, "Control+z")
    assert numbers(explorer, "h", "f") == (0.2, 0.25)
