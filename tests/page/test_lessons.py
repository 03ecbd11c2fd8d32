"""A lesson in class: step by step, by the keys of a presenter, with guesses and the responses to them."""

from pathlib import Path
from urllib.parse import parse_qs, urlencode, urlsplit

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from hess_explorer.lessons import package_lessons, suggestions
from hess_explorer.lessons.collection import read_paths
from hess_explorer.lessons.reading import read
from support.board import SCENES
from support.page import ALL, HESS, WIDE, flat, own_tab, values_of, wait_frames
from support.pointer import at, frame
from support.serving import served

NAME = "scattering-by-a-nonholonomic-top"
# Whether a source's layers in a picture and their labels are visible, [true, false] if only some are.
SEEN = """([picture, source]) => [...new Set(
  hess.plots.find(({ model }) => model.name === picture).model.renderers
    .filter((one) => [source, `${source}-label`].includes(one.data_source?.name)).map((one) => one.visible))]"""


def here(explorer):
    """(scene, its values, lesson, step) of the address."""
    query = {name: one for name, [one] in parse_qs(urlsplit(explorer.link()).query, keep_blank_values=True).items()}
    scene = SCENES[query["scene"]]
    return scene.name, values_of(explorer, scene), query.get("lesson"), query.get("step")


def guess(explorer, prediction, press):
    """Click or tap in the picture."""
    left, top, right, bottom = frame(explorer, prediction.picture)
    shares = [(0.2, 0.7), (0.35, 0.4), (0.8, 0.4)] if prediction.kind == "curve" else [(0.3, 0.4)]
    for x, y in shares:
        press(left + x * (right - left), top + y * (bottom - top))


def test_what_can_be_tried_is_done_for_one(explorer):
    page, steps = explorer.page, suggestions()[HESS].steps
    explorer.open_text()
    assert page.locator(".words").get_by_text("Try this").count() == 0
    for number, step in enumerate(steps):
        assert page.locator(".tries h3").inner_text() == f"Try this: {step.title}"
        assert page.locator(".tries .count").inner_text() == f"{number + 1} / {len(steps)}"
        explorer.change(page.locator(".param-try").click)
        assert here(explorer)[1] == step.state.values
        page.locator(".param-try-next").click()
    assert page.locator(".tries .count").inner_text() == f"1 / {len(steps)}"


def test_a_link_to_a_step_that_is_not_there_is_one_to_the_last_and_a_lesson_is_chosen_from_the_menu(explorer):
    page, lessons = explorer.page, package_lessons()
    explorer.goto(f"/?lesson={NAME}&step=99")
    assert page.locator(".lesson .title").inner_text() == lessons[NAME].steps[-1].title
    assert "step must lie between 1 and 8" in explorer.text("notes")
    # The end is the end; back is a step, and out of the lesson are the words.
    page.keyboard.press("PageDown")
    explorer.change(page.keyboard.press, "PageUp")
    assert here(explorer)[2:] == (NAME, "7")
    explorer.leave_lesson()
    explorer.open_text()
    assert page.locator(".words").is_visible()
    assert here(explorer)[2:] == (None, None)
    page.locator(".lesson-menu > summary").click()
    assert page.locator(".lesson-menu li").count() == len(lessons)
    explorer.change(page.locator(f".param-lesson-{CYCLES}").click)
    assert here(explorer)[1:4] == (lessons[CYCLES].steps[0].state.values, CYCLES, "1")


CYCLES = "limit-cycles-and-locking"
# Width of each planar picture in sight, as Bokeh has drawn it and as the page lays it out.
WIDTHS = """() => hess.plots.filter(({ canvas_view: { el } }) => el.checkVisibility({ visibilityProperty: true }))
  .map(({ bbox, canvas_view: { el } }) => [bbox.width, el.clientWidth])"""
# How many pixels of a canvas are not empty.
PAINTED = """item => {
  const { data } = item.getContext("2d").getImageData(0, 0, item.width, item.height)
  return data.filter((alpha, i) => i % 4 === 3 && alpha > 0).length
}"""
# [lines of an element, how many of them can be seen at their places].
LINES = """item => {
  const range = document.createRange()
  range.selectNodeContents(item)
  const all = [...range.getClientRects()].filter(({ width }) => width > 1)
  const seen = all.filter(({ left, top, right, bottom }) => (
    item.contains(item.getRootNode().elementFromPoint((left + right) / 2, top + 2))
    && item.contains(item.getRootNode().elementFromPoint((left + right) / 2, bottom - 2))))
  // Parts of a formula may be higher or lower than its line.
  const count = (some) => some.map(({ bottom }) => bottom).sort((a, b) => a - b)
    .reduce(([lines, last], bottom) => bottom - last > 12 ? [lines + 1, bottom] : [lines, last], [0, -Infinity])[0]
  return [all, seen].map(count)
}"""


def test_a_lesson_in_a_narrow_and_a_wide_window_keeps_text_slider_and_pictures_in_sight(explorer):
    """One visit: from a guess that leaves no frame to pictures that have their new size."""
    page, steps = explorer.page, package_lessons()[CYCLES].steps
    explorer.begin_lesson(CYCLES, 5)
    sheet = page.locator("canvas.guess")
    sheet.press("ArrowRight")
    assert sheet.evaluate("item => item.style.boxShadow") != ""
    explorer.change(page.keyboard.press, "PageDown")
    wait_frames(explorer)
    assert sheet.evaluate("item => [getComputedStyle(item).outlineStyle, item.style.boxShadow]") == ["none", ""]
    assert sheet.evaluate("item => item.getRootNode().activeElement") is None
    # Words light up what they name, while they are pointed at.
    explorer.turn_to_step(6)
    word, glow = page.locator(".lesson .names").filter(has_text="green cycle"), page.locator("canvas.glow")
    word.hover()
    assert glow.evaluate(PAINTED) > 500
    page.locator(".lesson .title").hover()
    expect(glow).to_have_count(0)
    # A narrow window has the text of the lesson; the slider follows what is animated, beside the text too.
    explorer.turn_to_step(7)
    explorer.resize(1280, 720)
    assert page.get_by_role("tab", name="Text").get_attribute("aria-selected") == "true"
    page.locator(".param-animate").click()
    for control in page.locator(".param-h input").all():
        has_moved = "([item, least]) => Number(item.value) > least"
        page.wait_for_function(has_moved, arg=[control.element_handle(), steps[6].animation.start + 0.04])
    page.keyboard.press("Escape")
    page.mouse.click(5, 5)
    # Text and slider of a step are in sight together, and there is one value.
    explorer.turn_to_step(10)
    control = page.locator(".step-controls .param-h")
    for item in (page.locator(".lesson .text"), control):
        expect(item).to_be_in_viewport(ratio=1)
    beside, column = control.locator(".hand"), page.locator(".controls .param-h .hand")
    explorer.change(lambda: beside.press("ArrowRight"))
    moved = float(explorer.wait_url(h=column.input_value())["h"])
    assert moved > steps[9].state.values["h"]
    assert beside.input_value() == column.input_value()
    # So it is when a number in the text is dragged or moved by a key.
    word, number = page.locator(".lesson .drag"), page.locator(".lesson .drag .scrub")
    explorer.change(word.press, "ArrowRight")
    before = float(beside.input_value())
    assert float(number.inner_text()) == before > moved
    x, y, wide, high = number.bounding_box().values()
    page.mouse.move(x + wide / 2, y + high / 2)
    page.mouse.down()
    explorer.change(page.mouse.move, x + wide / 2 + 30, y + high / 2)
    page.mouse.up()
    assert float(number.inner_text()) == float(beside.input_value()) > before
    explorer.resize(*WIDE)
    assert page.locator(".step-controls").is_hidden()
    # A picture has its new size in a scene that is entered again.
    page.evaluate("document.activeElement?.blur()")
    explorer.turn_to_step(13)
    wait_frames(explorer, 4)
    widths = page.evaluate(WIDTHS)
    assert len(widths) == 3
    assert all(drawn == laid for drawn, laid in widths)


OWN = """---
title: {0}
minutes: 1
---
## One
```step
state: "?scene=suslov-hess&h=1.2&f=0.3"
```
| {0} | ![A wheel](wheel.png) |
|-----|-----------------------|
| 1   | [further](?scene=suslov-hess&h=1.5&f=0.3), [scattering](?scene=scattering&k=3) |
"""


def test_images_tables_and_links_of_own_lessons(browser, tmp_path):
    Image.new("RGB", (40, 30), "red").save(tmp_path / "wheel.png")
    for name in ("a", "b"):
        (tmp_path / f"{name}.md").write_text(OWN.format(f"Lesson {name}"), encoding="utf-8")
    lessons = read_paths([tmp_path / "b.md", tmp_path / "a.md"])[0]
    with served(lessons=lessons) as base, own_tab(browser, base, (1280, 720)) as tab:
        page, links = tab.page, tab.page.locator(".lesson a")
        tab.goto("/")
        assert page.locator(".lesson .of").inner_text() == "Lesson b"
        assert page.locator(".lesson th").first.inner_text() == "Lesson b"
        image = page.locator(".lesson img")
        assert image.evaluate("item => item.decode().then(() => [item.naturalWidth, item.naturalHeight])") == [
            40,
            30,
        ]
        page.evaluate("window.isSame = true")
        tab.change(links.filter(has_text="further").click)
        assert tab.wait_url(h=1.5)["lesson"] == "b"
        tab.change(page.locator(".param-undo").click)
        tab.wait_url(h=1.2)
        tab.change(links.filter(has_text="scattering").click)
        tab.wait_url(scene="scattering", k="3.0")
        assert page.evaluate("window.isSame")
        page.locator(".param-leave-lesson").click()
        page.locator(".lesson-menu > summary").click()
        assert page.locator(".lesson-menu button").all_inner_texts()[:2] == ["Lesson b (1 min)", "Lesson a (1 min)"]


def test_what_is_done_by_hand_is_recorded_and_replayed(explorer):
    page, states = explorer.page, []
    explorer.open_text()
    page.locator(".lesson-menu").evaluate("menu => { menu.open = true }")
    page.locator(".param-record").click()
    page.keyboard.press("Escape")
    page.keyboard.press("5")
    pixel, _ = at(explorer, "circle", -1.0, 1.0)
    # An enlarged picture, a key on a slider, a click in a picture, another picture, another scene.
    for act in (
        lambda: None,
        lambda: explorer.change(explorer.slider("h").press, "ArrowRight"),
        lambda: explorer.change(explorer.click, *pixel),
        lambda: page.keyboard.press("2"),
        lambda: explorer.show("scattering"),
    ):
        act()
        states.append(here(explorer)[:2])
    assert page.locator(".recording [role=status]").inner_text() == "Recorded: 5 steps"
    with page.expect_download() as download:
        page.locator(".param-save-recording").click()
    assert page.locator(".recording").is_hidden()
    lesson = read(Path(download.value.path()).read_text(encoding="utf-8"), "recorded")
    assert [(step.state.scene, step.state.values) for step in lesson.steps] == states
    assert [step.enlarged_picture for step in lesson.steps] == ["circle", "circle", "circle", "omega", ""]
    assert [step.controls for step in lesson.steps] == [(), ("h",), ("phi0",), (), ()]
    explorer.change(explorer.tell, "restore", urlencode({"scene": states[0][0], **states[0][1]}))
    assert here(explorer)[:2] == states[0]
    page.locator(".lesson-menu > summary").click()


# Pages of the slide on show and the one in sight; what is outside of them; how many controls the step has, and how wide
# its sliders are.
SLIDE = f"""() => {{
  {ALL}
  const found = all(document)
  const [slide, title, steps] = [".slide", ".lesson .title", ".lesson .steps"]
    .map((selector) => found.find((item) => item.matches(selector)))
  const [wide, room] = [slide.clientWidth, slide.getBoundingClientRect()]
  const isOut = (item) => [...item.getClientRects()].some(({{ left, right, top, bottom }}) => (
    top < 0 || bottom > innerHeight
    || wide > 0 && (right - left > wide + 1 || slide.contains(item) && bottom > room.bottom + 1)))
  const parts = [title, steps, ...slide.querySelectorAll("*")].filter((item) => item.checkVisibility())
  const [pages, page] = wide === 0 ? [1, 0] : [Math.round(slide.scrollWidth / wide), slide.scrollLeft / wide]
  const controls = found.filter((item) => item.matches(".step-controls > *"))
  const hands = controls.flatMap((item) => [...item.querySelectorAll(".hand")]).map((item) => item.clientWidth)
  return [pages, page, parts.filter(isOut).map((item) => item.textContent), controls.length, hands]
}}"""


def test_in_a_hall_each_step_is_a_slide_of_which_the_clicker_skips_nothing(explorer):
    page, count = explorer.page, explorer.page.locator(".lesson .count")
    explorer.resize(1280, 720)
    explorer.tell("present")
    for lesson in package_lessons().values():
        explorer.change(explorer.tell, "lesson", lesson.name)
        for number, step in enumerate(lesson.steps, 1):
            expect(count).to_have_text(f"{number} / {len(lesson.steps)}", timeout=60_000)
            # The controls come with the step, before its pictures are computed.
            expect(page.locator(".step-controls > *")).to_have_count(len(step.controls), timeout=60_000)
            wait_frames(explorer, 2)
            seen = set()
            while count.text_content().startswith(f"{number} /"):
                pages, at_page, out, controls, hands = page.evaluate(SLIDE)
                assert out == [], step.title
                assert all(wide >= 200 for wide in hands), step.title
                assert controls == len(step.controls)
                assert at_page == pytest.approx(round(at_page), abs=0.01)
                seen.add(round(at_page))
                if number == len(lesson.steps) and len(seen) == pages:
                    break
                page.keyboard.press("PageDown")
                wait_frames(explorer, 2)
            assert seen == set(range(pages)), step.title
    explorer.tell("present")


SIZES = {"present": (1600, 950), "phone": (390, 844)}
# A lesson that is computed fast.  Narrow and wide windows have a test of their own.
FAST = ((NAME, "present"),)
GIVEN = [
    pytest.param(name, place, marks=() if (name, place) in FAST else pytest.mark.thorough)
    for name in package_lessons()
    if name != "introduction"
    for place in SIZES
]
MOST_LINES = 6


def read_on(tab):
    """Turn the pages of a slide to the last."""
    pages, at_page, *_ = tab.page.evaluate(SLIDE)
    for _ in range(pages - 1 - round(at_page)):
        tab.page.keyboard.press("PageDown")


# [title, count, lines of the text, boxes of what must be in sight, width of the picture], after some frames.
SHOWN = f"""async picture => {{
  {ALL}
  for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame)
  const found = all(document)
  const [title, count, text, next] = [".lesson .title", ".lesson .count", ".lesson .text", ".param-next-step"]
    .map((selector) => found.find((item) => item.matches(selector)))
  const controls = found.filter((item) => item.matches(".step-controls > *"))
  const host = found.filter((item) => item.matches(`.gallery:not(.away) .picture-${{picture}} .host`))
  const boxes = [title, next, ...controls, ...host].map((item) => {{
    const {{ left, top, right, bottom }} = item.getBoundingClientRect()
    return [left, top, right, bottom]
  }})
  return [title.innerText, count.innerText, ({LINES})(text), controls.length, boxes, host[0]?.clientWidth ?? 0]
}}"""


def assert_in_sight(item, most=MOST_LINES):
    """Assert that the first lines of a text are in sight."""
    lines, seen = item.evaluate(LINES)
    assert seen >= min(most, lines), item


def assert_could_be_guessed(tab, prediction, axes):
    """Assert that the picture had room for the truth before it was revealed."""
    columns = [np.array(flat(tab.data(prediction.source)[name]), dtype=float) for name in prediction.columns]
    (x0, x1, y0, y1), (xs, ys) = axes, columns
    assert np.mean((x0 <= xs) & (xs <= x1) & (y0 <= ys) & (ys <= y1)) > 0.9


@pytest.mark.parametrize(("name", "place"), GIVEN)
def test_a_lesson_is_given_from_start_to_end(request, name, place):
    (width, height), lesson = SIZES[place], package_lessons()[name]
    tab = request.getfixturevalue("phone" if place == "phone" else "explorer")
    page = tab.page
    press = page.touchscreen.tap if place == "phone" else page.mouse.click
    tab.resize(width, height)
    tab.begin_lesson(name)
    if place == "present":
        tab.tell("present")
    for number, step in enumerate(lesson.steps, 1):
        title, count, (lines, seen), controls, boxes, wide = page.evaluate(SHOWN, step.enlarged_picture)
        assert (title, count) == (step.title, f"{number} / {len(lesson.steps)}")
        assert here(tab) == (step.state.scene, step.state.values, name, str(number))
        assert seen >= min(MOST_LINES, lines), title
        assert controls == len(step.controls)
        for left, top, right, bottom in boxes:
            assert 0 <= left < right <= width, title
            assert 0 <= top < bottom <= height, title
        assert wide >= 240 or not step.enlarged_picture
        if step.prediction:
            wanted, axes = [step.prediction.picture, step.prediction.source], tab.axes(step.prediction.picture)
            # No caption tells the answer.
            captions = page.locator(".gallery:not(.away) :is(.verdict, .numbers):visible")
            assert (page.evaluate(SEEN, wanted), captions.count()) == ([False], 0)
            guess(tab, step.prediction, press)
            # The picture has taken none of the clicks.
            assert here(tab)[1] == step.state.values
            read_on(tab)
            tab.change(page.keyboard.press, "PageDown")
            assert here(tab)[1] == step.prediction.outcome.values
            assert page.evaluate(SEEN, wanted) == [True]
            assert_could_be_guessed(tab, step.prediction, axes)
            said = page.locator(".lesson .said")
            said.get_by_text(" away.").wait_for()
            assert_in_sight(said)
        if step.question:
            answer = page.locator(".answer > div")
            assert answer.is_hidden()
            read_on(tab)
            page.keyboard.press("PageDown")
            wait_frames(tab, 2)
            assert_in_sight(answer, 3)
        if number < len(lesson.steps):
            read_on(tab)
            tab.change(page.keyboard.press, "PageDown")
    if place == "present":
        tab.tell("present")
