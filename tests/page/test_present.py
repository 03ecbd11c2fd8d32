"""Present mode for a lecture hall."""

import pytest

from hess_explorer.scenes import scenes
from support.accessible import assert_accessible
from support.page import HESS, Explorer, wait_frames
from support.thorough import sample

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
def plain(tab):
    """The page as it is at first, its controls folded."""
    tab.fresh()
    tab.fold_controls()
    yield tab
    tab.assert_quiet()


@pytest.mark.parametrize(("size", "theme"), sample([((1920, 1080), "light"), ((1280, 720), "dark")], 1))
def test_what_is_presented_is_read_from_afar_and_the_link_keeps_it(plain, open_page, server, size, theme):
    tab, page = plain, plain.page
    tab.turn_theme(is_dark=theme == "dark")
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
    boxes = [tab.picture(name).bounding_box() for name in scenes()[HESS].open_pictures]
    boxes += [item.bounding_box() for item in page.locator(".number:visible").all()]
    for box in boxes:
        assert 0 <= box["x"] < box["x"] + box["width"] <= size[0]
        assert 0 <= box["y"] < box["y"] + box["height"] <= size[1]
    # The spot goes with the pointer.
    page.mouse.move(200, 300)
    page.mouse.move(500, 320)
    spot = page.locator(".spot").bounding_box()
    assert (spot["x"] + spot["width"] / 2, spot["y"] + spot["height"] / 2) == pytest.approx((500, 320), abs=1)
    assert_accessible(page)
    # A link opens it; a picture that is large is reduced first, then Escape leaves; all is as it was.
    if theme == "dark":
        again = Explorer(open_page(tab.link().split("?")[1], size=size), server)
        wait_frames(again, 4)
        opened = again.page.evaluate(SIZES)
        for what in ("lines", "ticks"):
            one, other = (found[what].values() if what == "lines" else found[what] for found in (opened, large))
            assert sorted(one) == sorted(other)
    page.keyboard.press("1")
    wait_frames(tab, 4)
    page.keyboard.press("Escape")
    assert page.evaluate("document.documentElement.hasAttribute('data-present')")
    page.keyboard.press("Escape")
    wait_frames(tab, 4)
    page.wait_for_function("!location.search.includes('present')")
    back = page.evaluate(SIZES)
    assert (back["lines"], back["ticks"]) == (usual["lines"], usual["ticks"])


# The shelf; the pictures in sight with their edges and captions; the titles that are cut.
HALL = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const items = all(document).filter((item) => item.checkVisibility())
  const cells = items.filter((item) => item.matches(".gallery:not(.away) .picture"))
  const shelf = items.find((item) => item.matches(".shelf"))
  return {
    shelf: [shelf.clientWidth, shelf.clientHeight],
    pictures: cells.map((cell) => {
      const { right, bottom } = cell.getBoundingClientRect()
      const caption = cell.querySelector("h2")
      return [cell.dataset.name, cell.querySelector(".host").clientWidth, caption.clientHeight, right, bottom]
    }),
    cut: cells.map((cell) => cell.querySelector("h2"))
      .filter((item) => item.scrollHeight > item.clientHeight + 1 || item.scrollWidth > item.clientWidth + 1)
      .map((item) => item.textContent),
  }
}"""


@pytest.mark.parametrize("size", sample([(1920, 1080), (1280, 720), (1600, 950)], 2))
def test_pictures_fill_the_hall(tab, size):
    page, (width, height) = tab.page, size
    for scene in sample([name for name, one in scenes().items() if one.origin in (None, HESS)], 2):
        tab.fresh(scene)
        tab.resize(*size)
        desk = page.evaluate(HALL)["pictures"]
        page.keyboard.press("p")
        wait_frames(tab, 4)
        # With the keys 1, Shift 2, Shift 3 one, two, three pictures are chosen; the others are thumbnails.
        for count in range(min(4, len(desk) + 1)):
            if count > 0:
                page.keyboard.press(f"{'Shift+' if count > 1 else ''}Digit{count}")
                wait_frames(tab, 4)
            hall = page.evaluate(HALL)
            assert hall["shelf"][0] >= 0.98 * width
            assert hall["shelf"][1] >= 0.98 * height
            assert hall["cut"] == [], (scene, count)
            pictures = hall["pictures"]
            assert [name for name, *_ in pictures] == [name for name, *_ in desk]
            for _, _, _, right, bottom in pictures:
                assert right <= width
                assert bottom <= height
            # Together they take the whole width or the whole height.
            across = max(right for *_, right, _ in pictures) - min(right - edge for _, edge, _, right, _ in pictures)
            down = max(bottom for *_, bottom in pictures)
            assert max(across / width, down / height) >= 0.95, (scene, count)
            if count == 0:
                assert min(edge for _, edge, *_ in pictures) >= min(edge for _, edge, *_ in desk), scene
            else:
                edge, caption = min((edge, caption) for _, edge, caption, *_ in pictures[:count])
                assert min(edge for _, edge, *_ in pictures) >= 0.08 * height
                assert max(count * edge / width, (edge + caption) / height) >= 0.9, (scene, count)
        page.keyboard.press("Escape")
        page.keyboard.press("Escape")
        wait_frames(tab, 4)
    tab.fresh()


def test_a_thumbnail_is_drawn_whole_and_a_click_enlarges_it(plain):
    tab, page = plain, plain.page
    tab.resize(1600, 950)
    page.keyboard.press("p")
    for key in ("Digit2", "Shift+Digit4"):
        page.keyboard.press(key)
    wait_frames(tab, 4)
    circle = tab.picture("circle")
    assert circle.locator(".host").bounding_box()["width"] < 150
    # Its labels are as much smaller as the picture is.
    labels, edge = page.evaluate(
        """() => {
          const { model, el } = hess.plots.find(({ model }) => model.name === "circle")
          return [Number.parseFloat(model.below[0].axis_label_text_font_size), el.getBoundingClientRect().width]
        }"""
    )
    assert labels < edge / 10
    circle.locator(".title").click()
    wait_frames(tab, 4)
    large = [name for name, edge, *_ in page.evaluate(HALL)["pictures"] if edge > 700]
    assert large == ["circle"]
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    wait_frames(tab, 4)
