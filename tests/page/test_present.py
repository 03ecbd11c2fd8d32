"""Present mode for a lecture hall."""

import pytest
from playwright.sync_api import expect

from hess_explorer.scenes import scenes
from support.accessible import assert_accessible
from support.page import HESS, wait_frames

# The size of every text in sight, those of the axes among them; the widths of Bokeh's lines by plot and model.
SIZES = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const written = (item) => [...item.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim() !== "")
  const texts = all(document).filter((item) => (written(item) || item.matches("input[type=text], select"))
    && item.checkVisibility({ visibilityProperty: true }) && !item.closest("option, .gallery.away")
    && item.getBoundingClientRect().width > 1)
  const axes = hess.plots.flatMap(({ model }) => [...model.below, ...model.left])
  const parts = hess.plots.flatMap(({ model }) => [...model.references()])
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


@pytest.fixture
def plain(explorer):
    """The page as it is at first, its controls folded."""
    explorer.fold_controls()
    return explorer


def test_what_is_presented_is_read_from_afar_and_the_link_keeps_it(plain):
    tab, page, size = plain, plain.page, (1920, 1080)
    tab.resize(*size)
    usual, strokes = page.evaluate(SIZES), tab.sphere.evaluate(STROKES)
    page.evaluate("document.activeElement?.blur()")
    page.keyboard.press("p")
    page.wait_for_function("location.search.includes('present=1')")
    wait_frames(tab, 4)
    # Bar, controls, player and legend appear on demand.
    assert page.locator(".tools, .number, .player[role=group], .signs").filter(visible=True).count() == 0
    page.keyboard.press("m")
    wait_frames(tab, 4)
    large = page.evaluate(SIZES)
    assert len(large["texts"]) > 20
    for text, points in large["texts"]:
        assert points >= 20, text
    assert len(large["ticks"]) >= 12
    assert min(large["ticks"]) >= 20
    assert len(usual["lines"]) > 10
    # On a large screen they grow a little more, with the type.
    assert large["lines"] == pytest.approx({name: 2 * width for name, width in usual["lines"].items()}, rel=0.01)
    assert tab.sphere.evaluate(STROKES) == pytest.approx([2 * width for width in strokes], rel=0.01)
    essential = scenes()[HESS].essential
    numbers = page.locator(".number").evaluate_all(
        "items => items.filter((item) => item.checkVisibility()).map((item) => item.className)"
    )
    assert len(numbers) == len(essential)
    assert all(f"param-{name}" in " ".join(numbers) for name in essential)
    # All of it is in sight.
    pictures = [tab.picture(name) for name in scenes()[HESS].open_pictures]
    for item in (*pictures, *page.locator(".number:visible").all()):
        # Edges lie between pixels.
        expect(item).to_be_in_viewport(ratio=0.999)
    # The spot goes with the pointer.
    page.mouse.move(200, 300)
    page.mouse.move(500, 320)
    spot = page.locator(".spot").bounding_box()
    assert (spot["x"] + spot["width"] / 2, spot["y"] + spot["height"] / 2) == pytest.approx((500, 320), abs=1)
    assert_accessible(page)
    page.keyboard.press("Escape")
    wait_frames(tab, 4)
    page.wait_for_function("!location.search.includes('present')")
    back = page.evaluate(SIZES)
    assert (back["lines"], back["ticks"]) == (usual["lines"], usual["ticks"])
