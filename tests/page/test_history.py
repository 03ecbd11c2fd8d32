"""Undo and Redo, and the browser's Back and Forward, over all that changes a state."""

from hess_explorer.headless.browser import wait_ready
from support.page import DEFAULTS, HESS
from support.suslov_hess import assert_orbit


def test_undo_and_redo_go_through_all_that_was_done_and_one_drag_is_one_step(explorer):
    """What is a step is tested without a browser (`static/history.test.mjs`)."""
    page = explorer.page
    undo, redo = page.locator(".param-undo"), page.locator(".param-redo")
    explorer.goto(f"/?scene={HESS}")
    assert undo.is_disabled() and redo.is_disabled()
    seen = [explorer.torus()]
    explorer.change(explorer.type, "f", "0.3")
    seen.append(explorer.torus())
    box = explorer.slider("h").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.4 * box["width"], middle)
    page.mouse.down()
    for share in (0.45, 0.6):
        explorer.change(page.mouse.move, box["x"] + share * box["width"], middle)
    explorer.change(page.mouse.up)
    seen.append(explorer.torus())
    assert len({*seen}) == 3
    explorer.enter("loxodrome")
    # With the keys, from wherever the focus is.
    for shown in reversed(seen):
        explorer.change(page.keyboard.press, "Control+z")
        assert explorer.torus() == shown
    assert undo.is_disabled()
    assert_orbit(explorer, DEFAULTS)
    explorer.change(redo.click)
    for key in ("Control+Shift+z", "Control+y"):
        explorer.change(page.keyboard.press, key)
    assert explorer.scene == "loxodrome"
    assert redo.is_disabled()
    explorer.change(undo.click)
    # The browser undoes text that is still being typed.
    explorer.box("h").fill("9")
    explorer.box("h").press("Control+z")
    assert explorer.torus() == seen[2]


def test_back_and_forward_go_by_scenes_and_examples_and_do_not_reload(explorer):
    page = explorer.page
    page.evaluate("window.kept = true")
    explorer.move(h=0.7)
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    explorer.move(f=0.25)
    explorer.enter("loxodrome")

    def go(direction, scene):
        before = explorer.state
        page.evaluate(f"history.{direction}()")
        wait_ready(page, after=before)
        assert explorer.scene == scene

    for h, f in ((0.2, 0.25), (0.7, 0.6)):
        go("back", HESS)
        assert explorer.torus() == (h, f)
        assert explorer.wait_url(h=str(h), f=str(f))["scene"] == HESS
    for name in (HESS, "loxodrome"):
        go("forward", name)
    assert page.evaluate("window.kept")
    # Going back is a change as any other: it can be undone.
    explorer.change(page.keyboard.press, "Control+z")
    assert explorer.torus() == (0.2, 0.25)
