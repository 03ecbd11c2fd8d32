"""Two states in the same pictures: the ghost of the one before, the pinned one, and how they differ."""

import pytest

from hess_explorer.headless.browser import wait_ready
from support.accessible import assert_accessible
from support.page import DEFAULTS, wait_frames
from support.suslov_hess import assert_orbit

# The painted pixels of ghosts: of the planar pictures, inside Bokeh's own trees, and of the spheres.
GHOSTS = """canvases => canvases.map((canvas) => {
  if (canvas.width === 0) return 0
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)
  let painted = 0
  for (let i = 3; i < data.length; i += 4) if (data[i] > 40) painted += 1
  return painted
})"""


def ghosts(explorer):
    """Return the number of painted pixels of each ghost, some frames later."""
    wait_frames(explorer, 3)
    return [count for count in explorer.page.locator("canvas.ghost:visible").evaluate_all(GHOSTS) if count > 100]


def rows(explorer):
    return {
        name: (one, two)
        for name, one, two in explorer.page.locator(".comparison tbody tr").evaluate_all(
            "rows => rows.map((row) => [...row.children].map((cell) => cell.textContent))"
        )
    }


def test_while_a_slider_is_held_the_state_before_it_is_seen_and_no_longer(explorer):
    page = explorer.page
    box = explorer.slider("h").bounding_box()
    middle = box["y"] + box["height"] / 2
    assert ghosts(explorer) == []
    page.mouse.move(box["x"] + 0.5 * box["width"], middle)
    page.mouse.down()
    explorer.change(page.mouse.move, box["x"] + 0.6 * box["width"], middle)
    # The plane, the sphere, the diagram, the circle map and the torus.
    before = ghosts(explorer)
    assert len(before) == 5
    explorer.change(page.mouse.move, box["x"] + 0.7 * box["width"], middle)
    # That of the first moment stays as it was painted.
    assert ghosts(explorer) == before
    explorer.change(page.mouse.up)
    assert ghosts(explorer) == []


PAINTED_TURN = """async (canvas) => {
  for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame)
  return canvas.dataset.turn
}"""
H_AXIS = """() => {
  const { x_range: x } = hess.plots.find(({ model }) => model.name === "bifurcation").model
  return [x.start, x.end]
}"""


@pytest.mark.thorough
def test_both_states_are_seen_side_by_side_where_time_and_rotation_are_the_same(explorer):
    page = explorer.page
    page.locator(".param-pin").click()
    explorer.move(h=1.8)
    page.locator(".param-beside").click()
    dialog = page.get_by_role("dialog", name="Side by side")
    halves = [page.locator("iframe.half").nth(i).element_handle().content_frame() for i in range(2)]
    one, other = halves
    for half, h in zip(halves, (1.5, 1.8), strict=True):
        half.wait_for_load_state()
        wait_ready(half)
        assert float(half.locator(".param-h input[type=text]").input_value()) == h
        # All pictures at once.
        assert half.locator(".picture:visible").count() == 6
    # Both show the axes of both.
    assert one.evaluate(H_AXIS) == other.evaluate(H_AXIS)
    assert_accessible(page, dialog)
    one.locator("input.param-t").evaluate(
        "slider => { slider.value = 3.5; slider.dispatchEvent(new Event('input')) }",
    )
    other.locator(".player output", has_text="t = 3.50").wait_for()
    one.locator("canvas.solid").press("ArrowLeft")
    turn = one.locator("canvas.solid").evaluate(PAINTED_TURN)
    other.locator(f"canvas.solid[data-turn='{turn}']").wait_for()
    # By its event: Playwright does not find its way into a frame that is zoomed.
    for _ in range(2):
        one.locator(".param-play").dispatch_event("click")
        other.locator(".player output").filter(has_not_text="t = 3.50").wait_for()
    assert other.locator(".player[role=group]").get_attribute("data-playing") != "true"
    dialog.get_by_role("button", name="Close").click()
    assert page.locator("iframe.half").first.is_hidden()
    page.locator(".param-unpin").click()


def test_a_pinned_state_is_seen_beside_others_named_in_numbers_and_gone_back_to(explorer):
    page = explorer.page
    pin, table = page.locator(".param-pin"), page.locator(".comparison")
    assert table.is_hidden()
    pin.click()
    assert pin.get_attribute("aria-pressed") == "true"
    assert rows(explorer) == {}
    explorer.move(h=1.8)
    assert len(ghosts(explorer)) == 5
    found = rows(explorer)
    assert found["h"] == ("1.5", "1.8")
    assert not {"a", "b", "f", "I₂₃", "accuracy"} & set(found)
    # E = I₁₁ b h.
    one, two = (float(text.replace("−", "-")) for text in found["E = I₁₁ b h"])
    # Four digits are shown.
    assert abs(two / one - 1.8 / 1.5) < 1e-3
    # There and back, by the key and the button.
    explorer.change(page.keyboard.press, "c")
    assert_orbit(explorer, DEFAULTS)
    assert len(ghosts(explorer)) == 5
    explorer.change(page.locator(".param-flip").click)
    assert_orbit(explorer, {**DEFAULTS, "h": 1.8})
    # In another scene it is named, and gone back to.
    explorer.enter("loxodrome")
    assert "Suslov–Hess" in table.text_content()
    assert rows(explorer) == {}
    assert ghosts(explorer) == []
    explorer.change(page.locator(".param-flip").click)
    assert_orbit(explorer, DEFAULTS)
    page.locator(".param-unpin").click()
    assert table.is_hidden()
    assert ghosts(explorer) == []
