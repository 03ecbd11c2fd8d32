"""Present mode for a lecture hall."""

import pytest
from playwright.sync_api import expect

from hess_explorer.scenes import scenes
from support.accessible import assert_accessible
from support.page import HESS, wait_frames

# The size of every text in sight, those of axes in the lead among them; the widths of Bokeh's lines there, by model.
SIZES = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const written = (item) => [...item.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim() !== "")
  const texts = all(document).filter((item) => (written(item) || item.matches("input[type=text], select"))
    && item.checkVisibility({ visibilityProperty: true }) && !item.closest("option, .gallery.away")
    && item.getBoundingClientRect().width > 1)
  const leads = hess.plots.filter(({ el }) => el.checkVisibility() && !el.closest(".aside"))
  const axes = leads.flatMap(({ model }) => [...model.below, ...model.left])
  const parts = leads.flatMap(({ model }) => [...model.references()])
  return {
    texts: texts.map((item) => [
      item.textContent || item.className, Number.parseFloat(getComputedStyle(item).fontSize)]),
    ticks: axes.flatMap(({ axis_label_text_font_size, major_label_text_font_size }) => (
      [axis_label_text_font_size, major_label_text_font_size].map(Number.parseFloat))),
    lines: Object.fromEntries(parts.filter(({ line_width }) => line_width?.value > 0)
      .map(({ id, line_width }) => [id, line_width.value])),
  }
}"""
# The widths of lines that the canvas of the sphere is told to stroke in one painting, in device pixels.
STROKES = """item => new Promise((resolve) => {
  const ctx = item.getContext("2d")
  const widths = new Set()
  const { stroke } = ctx
  ctx.stroke = (...path) => {
    widths.add(ctx.lineWidth * ctx.getTransform().a)
    stroke.apply(ctx, path)
  }
  item.dispatchEvent(new KeyboardEvent("keydown", { key: "Home" }))
  requestAnimationFrame(() => requestAnimationFrame(() => {
    delete ctx.stroke
    resolve([...widths].sort((a, b) => a - b))
  }))
})"""


def test_what_is_presented_is_read_from_afar_and_the_link_keeps_it(explorer):
    page, essential = explorer.page, scenes()[HESS].essential
    explorer.fold_controls()
    explorer.resize(1920, 1080)
    # In the lead, where lines have their full width.
    for key in ("2", "Shift+Digit3"):
        page.keyboard.press(key)
    wait_frames(explorer, 4)
    usual, strokes = page.evaluate(SIZES), explorer.sphere.evaluate(STROKES)
    page.evaluate("document.activeElement?.blur()")
    page.keyboard.press("p")
    page.wait_for_function("location.search.includes('present=1')")
    # Bar, controls, player and legend appear on demand.
    expect(page.locator(".tools, .number, .player[role=group], .signs").filter(visible=True)).to_have_count(0)
    wait_frames(explorer, 4)
    large, thick = page.evaluate(SIZES), explorer.sphere.evaluate(STROKES)
    page.keyboard.press("m")
    wait_frames(explorer, 4)
    large["texts"] += page.evaluate(SIZES)["texts"]
    assert len(large["texts"]) > 20
    assert [(text, points) for text, points in large["texts"] if points < 20] == []
    assert len(large["ticks"]) == 4
    assert min(large["ticks"]) >= 20
    assert len(usual["lines"]) > 4
    # On a large screen they grow a little more, with the type.
    assert large["lines"] == pytest.approx({name: 2 * width for name, width in usual["lines"].items()}, rel=0.01)
    assert thick == pytest.approx([2 * width for width in strokes], rel=0.01)
    # All of it is in sight.
    expect(page.locator(".signs summary")).to_be_in_viewport(ratio=1)
    numbers = page.locator(".number").filter(visible=True)
    assert numbers.count() == len(essential)
    pictures = map(explorer.picture, scenes()[HESS].open_pictures)
    for item in (*pictures, *(page.locator(f".number.param-{name}").filter(visible=True) for name in essential)):
        # Edges lie between pixels.
        expect(item).to_be_in_viewport(ratio=0.999)
    # The spot goes with the pointer.
    page.mouse.move(200, 300)
    page.mouse.move(500, 320)
    x, y, wide, high = page.locator(".spot").bounding_box().values()
    assert (x + wide / 2, y + high / 2) == pytest.approx((500, 320), abs=1)
    assert_accessible(page)
    # First the usual lead comes back.
    for _ in range(2):
        page.keyboard.press("Escape")
    page.wait_for_function("!location.search.includes('present')")
    for key in ("2", "Shift+Digit3"):
        page.keyboard.press(key)
    wait_frames(explorer, 4)
    back = page.evaluate(SIZES)
    assert (back["lines"], back["ticks"]) == (usual["lines"], usual["ticks"])
