"""Layout, light and dark themes, and accessibility of the page."""

import base64
import io

import numpy as np
import pytest
from PIL import Image, ImageStat
from playwright.sync_api import expect
from pytest import approx

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from support.accessible import assert_accessible, contrast
from support.page import ALL, HESS, SLIDERS, brought_on_phone, own_tab, wait_frames
from support.thorough import sample

SIZES = {"wide": (1600, 950), "laptop": (1280, 720), "phone": (390, 844), "sideways": (844, 390)}
COVERED = {"wide": 0.52, "laptop": 0.5, "reading": 0.4}
"""The least share of the window that pictures cover, also beside the text; for at least three pictures, all square."""
SCENES = [name for name, scene in scenes().items() if scene.origin in (None, HESS)]


@pytest.fixture
def look_at(request):
    """look_at(scene, size, theme) → the shared tab, or that of a phone, with that scene in its first state."""
    tabs = []

    def enter(scene, size="wide", theme="light"):
        if size in ("phone", "sideways"):
            tab = brought_on_phone(request.getfixturevalue("phone_tab"), scene)
        else:
            tab = request.getfixturevalue("tab").fresh(scene)
            tab.fold_controls()
        tab.resize(*SIZES[size])
        tab.turn_theme(is_dark=theme == "dark")
        tabs.append(tab)
        return tab

    yield enter
    for tab in tabs:
        tab.assert_quiet()


# Whichever of these a picture is, without its caption.
INSIDE = ":is(canvas.sphere, canvas.solid, canvas.torus, .bk-Figure)"


def brightness(shot):
    return ImageStat.Stat(shot.convert("L")).median[0]


# Where the drawings without their captions are; where the axes of planar pictures begin and end, and how high they are;
# how much higher than its place each caption is; where the player and the sliders are that are open at first; by how
# much anything of the page could be scrolled but what is meant to.
PLACES = """([names, essential, inside]) => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const items = all(document)
  const box = (item) => {
    const { x, y, width, height } = item.getBoundingClientRect()
    return { x, y, width, height }
  }
  const gallery = items.find((item) => item.matches(".gallery:not(.away)"))
  const cells = names.map((name) => gallery.querySelector(`.picture-${name}`)).filter((cell) => cell.checkVisibility())
  const shown = cells.map((cell) => cell.dataset.name)
  return {
    boxes: cells.map((cell) => box(all(cell).find((item) => item.matches(inside)))),
    frames: hess.plots.filter(({ model }) => shown.includes(model.name)).map(({ el, frame: { bbox } }) => {
      const { x } = el.getBoundingClientRect()
      return [x + bbox.x0, x + bbox.x1, bbox.y1 - bbox.y0]
    }),
    captions: cells.map((cell) => cell.querySelector("h2"))
      .map((item) => [item.textContent, item.scrollHeight - item.clientHeight]),
    tools: items.filter((item) => item.matches(".player[role=group]") || essential.some(
      (name) => item.matches(`.param-${name} .hand`))).filter((item) => item.checkVisibility()).map(box),
    scrolled: items
      .filter((item) => item.matches("html, body, .frame, .stage, .gallery:not(.away)"))
      .map((item) => [item.className, item.scrollHeight - item.clientHeight, item.scrollWidth - item.clientWidth]),
  }
}"""


def points_of(page, scene):
    shown = scenes()[scene]
    return page.evaluate(PLACES, [list(shown.open_pictures), list(shown.essential), INSIDE])


def assert_covered(places, size, name):
    boxes, (width, height) = places["boxes"], SIZES[size]
    if len(boxes) >= 3:
        assert sum(box["width"] * box["height"] for box in boxes) >= COVERED[name] * width * height, name
        assert min(box["width"] for box in boxes) >= 150, name


# Where the pictures in sight are, those that lead first and how many lead.
HALL = f"""() => {{
  {ALL}
  const cells = all(document).filter((item) => item.matches(".gallery:not(.away) .picture") && item.checkVisibility())
  const isAside = (item) => item.classList.contains("aside")
  const boxes = cells.sort((a, b) => isAside(a) - isAside(b)).map((item) => {{
    const {{ left, top, right, bottom, width }} = item.getBoundingClientRect()
    return [left, top, right, bottom, width]
  }})
  return [boxes, cells.filter((item) => !isAside(item)).length]
}}"""


def assert_fills_hall(page, width, height, share, least):
    boxes, leading = page.evaluate(HALL)
    for left, top, right, bottom, edge in boxes:
        assert 0 <= left < right <= width + 1
        assert 0 <= top < bottom <= height + 1
        assert edge >= least
    left, top, right, bottom, _ = np.array(boxes[:leading]).T
    assert max((max(right) - min(left)) / width, (max(bottom) - min(top)) / height) >= share


def assert_in_sight(places, width, height, count, share=0.5):
    """All pictures are square and in the window, as player and sliders are; nothing scrolls.

    That they do not overlap is for `assert_apart_and_whole`, and for "static/arrange.test.mjs" in windows of all sizes.
    """
    boxes = places["boxes"]
    assert len(boxes) == count
    assert all(box["width"] == approx(box["height"], abs=2) for box in boxes)
    for box in [*boxes, *places["tools"]]:
        assert 0 <= box["x"] < box["x"] + box["width"] <= width
        assert 0 <= box["y"] < box["y"] + box["height"] <= height
    # One slider at hand on a phone; the player has nothing to play in one scene.
    assert len(places["tools"]) >= 2
    for left, right, high in places["frames"]:
        assert 0 <= left < right <= width
        assert min(right - left, high) > share * min(box["width"] for box in boxes)
    for name, down, right in places["scrolled"]:
        assert max(down, right) <= 1, name
    for text, over in places["captions"]:
        assert over <= 1, text


# Elements that must not overlap: in the main part and beside it.
PARTS = (
    "h1, .param-sharing, .param-more, h2.caption, .bk-Figure, canvas:is(.sphere, .solid, .torus), .player[role=group], "
    ".reader",
    ".param-scenes, .menu, .number, .text.help, .text.derived",
)
# Visible ones only.
BOXES = """items => items.filter((item) => item.checkVisibility({ visibilityProperty: true })).map((item) => {
  const { left, top, right, bottom } = item.getBoundingClientRect()
  return [item.className, left, top, right, bottom]
})"""
CUT_OFF = """items => items.filter((item) => item.checkVisibility({ visibilityProperty: true })
    && Math.max(item.scrollHeight - item.clientHeight, item.scrollWidth - item.clientWidth) > 1)
  .map((item) => item.textContent)"""


def assert_apart_and_whole(page, size):
    """Assert that no elements overlap and that no text is clipped."""
    for selector in PARTS:
        parts = page.locator(selector).evaluate_all(BOXES)
        # On a phone one picture and one control are.
        assert len(parts) >= (6 if size in ("wide", "laptop") else 2)
        for i, (name, left, top, right, bottom) in enumerate(parts):
            for other, left_of, top_of, right_of, bottom_of in parts[:i]:
                across, down = min(right, right_of) - max(left, left_of), min(bottom, bottom_of) - max(top, top_of)
                assert min(across, down) <= 0.5, (name, other)
    # Lines above the pictures end in an ellipsis where they are too long.
    assert (
        page.locator(".text:not(.details, .moves, .says, .caption), .legend li, .number, h1").evaluate_all(CUT_OFF)
        == []
    )


# A place in the corner of each planar picture in sight, where nothing is drawn; the colours of its texts.
TEXTS = """() => {
  const canvas = document.createElement("canvas").getContext("2d")
  const rgb = (colour) => {
    canvas.fillStyle = colour
    canvas.fillRect(0, 0, 1, 1)
    return [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3)
  }
  return hess.plots.filter(({ el }) => el.checkVisibility()).map(({ el, model: { below, left } }) => {
    const { x, bottom } = el.getBoundingClientRect()
    return [[x + 3, bottom - 4], [below[0], left[0]].flatMap(
      (axis) => [axis.major_label_text_color, axis.axis_label_text_color].map(rgb))]
  })
}"""


def assert_looks(page, scene, size, theme, artefacts):
    """A scene has its columns and colours, and nothing is covered, cut off or hard to read."""
    shot = Image.open(io.BytesIO(page.screenshot(path=artefacts / f"{scene}-{size}-{theme}.png")))
    assert (brightness(shot) > 200) if theme == "light" else (brightness(shot) < 60)
    # A phone shows one picture, upright a second, small one.
    count = {"phone": 2, "sideways": 1}.get(size, len(scenes()[scene].open_pictures))
    assert_in_sight(points_of(page, scene), *SIZES[size], count)
    assert_apart_and_whole(page, size)
    for corner, colours in page.evaluate(TEXTS):
        behind = shot.convert("RGB").getpixel(tuple(map(int, corner)))
        assert min(contrast(colour, behind) for colour in colours) >= 4.5, behind


# Orbit diagrams take the server half a minute: they come last, and a sample has none.
BY_COST = sorted(SCENES, key=lambda name: name.endswith("-diagram"))


# One visit for all that is to be seen of a scene: to enter one takes longer than to look at it.
@pytest.mark.parametrize(
    "theme, scene",
    [*(("light", scene) for scene in sample(BY_COST, 1)), *(("dark", scene) for scene in sample(SCENES[1:], 1))],
)
def test_a_scene_has_its_columns_and_colours_and_nothing_is_covered_cut_off_or_hard_to_read(
    look_at, artefacts, theme, scene
):
    tab = look_at(scene, "wide", theme)
    assert_looks(tab.page, scene, "wide", theme, artefacts)
    assert_covered(points_of(tab.page, scene), "wide", "wide")
    tab.page.keyboard.press("t")
    wait_frames(tab, 4)
    assert_covered(points_of(tab.page, scene), "wide", "reading")
    assert tab.page.locator(".words").is_visible()
    tab.page.keyboard.press("t")
    tab.resize(*SIZES["laptop"])
    assert_in_sight(points_of(tab.page, scene), *SIZES["laptop"], len(scenes()[scene].open_pictures))
    assert_covered(points_of(tab.page, scene), "laptop", "laptop")
    tab.tell("present")
    for size in ((1600, 950), (1920, 1080), SIZES["laptop"]):
        tab.resize(*size)
        # The strip can be read from afar.
        assert_fills_hall(tab.page, *size, 0.9, 200)
    for key in ("1", "Shift+Digit4", "m"):
        tab.page.keyboard.press(key)
        wait_frames(tab, 4)
        assert_fills_hall(tab.page, *SIZES["laptop"], 0.9 if key == "1" else 0, 100 if key == "m" else 200)
    tab.tell("present")
    tab.page.keyboard.press("Escape")
    tab.resize(*SIZES["phone"])
    assert_looks(tab.page, scene, "phone", theme, artefacts)


TARGETS = """items => items.filter((item) => item.checkVisibility()).map((item) => {
  const { width, height } = item.getBoundingClientRect()
  return [item.className || item.tagName, Math.min(width, height)]
})"""


# Where a phone is the first that a page has seen; one that is turned.
@pytest.mark.parametrize(
    "scene, size, theme", [(HESS, "phone", "light"), ("scattering", "phone", "light"), (HESS, "sideways", "dark")]
)
def test_a_phone_has_all_of_it_and_one_hand_suffices(look_at, artefacts, scene, size, theme):
    page = look_at(scene, size, theme).page
    assert_looks(page, scene, size, theme, artefacts)
    # A term is a word of a sentence, as high as its line.
    for name, smallest in page.locator("button:not(.term, .names), select, input").evaluate_all(TARGETS):
        assert smallest >= 43.9, name
    if size == "phone":
        assert_accessible(page)
    # The picture and the slider stay where they are while the text is scrolled, and no formula makes that wider.
    before, reader = points_of(page, scene), page.locator(".reader")
    reader.evaluate("item => item.scrollTo(0, 400)")
    assert reader.evaluate("item => item.scrollTop") > 100
    assert points_of(page, scene) == before
    assert reader.evaluate("item => item.scrollWidth - item.clientWidth") <= 0
    reader.evaluate("item => item.scrollTo(0, 0)")


# Sums up how far the layout shifts without a hand.
SHIFTS = """window.shifted = 0
new PerformanceObserver((list) => { for (const { value } of list.getEntries()) window.shifted += value })
  .observe({ type: "layout-shift", buffered: true })"""


@pytest.mark.parametrize("size", ["laptop", "wide"])
def test_nothing_moves_while_the_page_loads(browser, server, size):
    with own_tab(browser, server, SIZES[size], SHIFTS) as tab:
        tab.page.goto(f"{server}/?scene={HESS}")
        wait_ready(tab.page)
        wait_frames(tab, 4)
        assert tab.page.evaluate("window.shifted") <= 0.05


def edges(page):
    return [box["width"] for box in points_of(page, HESS)["boxes"]]


def test_a_picture_leads_by_its_key_or_a_click_and_the_link_keeps_it(look_at):
    """How large the others are is tested without a browser (`static/arrange.test.mjs`)."""
    tab = look_at(HESS, "laptop")
    page, keys = tab.page, tab.page.keyboard
    stage, usual = page.locator(".shelf").bounding_box()["height"], edges(page)
    first, _, third, *_, last = scenes()[HESS].open_pictures
    for i, press in enumerate((tab.picture(first).click, lambda: keys.press("2"))):
        press()
        wait_frames(tab, 4)
        assert edges(page)[i] >= 0.7 * stage
        assert_in_sight(points_of(page, HESS), *SIZES["laptop"], 6)
    # The others live.
    before = tab.caption(last)
    tab.move(h=0.2)
    assert tab.caption(last) != before
    keys.press("3")
    keys.press("Shift+Digit1")
    assert tab.wait_url(large=f"{third},{first}")
    wait_frames(tab, 4)
    two = edges(page)
    assert two[0] == two[2] > max(two[1], *two[3:])
    keys.press("Escape")
    page.wait_for_function("!location.search.includes('large')")
    wait_frames(tab, 4)
    assert edges(page) == usual
    for is_full in ("!==", "==="):
        keys.press("f")
        page.wait_for_function(f"document.fullscreenElement {is_full} null")


def test_where_there_is_little_room_controls_and_text_are_tabs(look_at):
    page = look_at(HESS, "laptop").page
    controls, text = page.get_by_role("tab", name="Controls"), page.get_by_role("tab", name="Text")
    for tab, has_text in ((controls, True), (text, False)):
        tab.press("ArrowRight")
        assert page.locator(".param-h .hand").is_visible() is not has_text
        assert page.locator(".words").is_visible() is has_text
        assert text.get_attribute("aria-selected") == str(has_text).lower()
        assert_accessible(page)


def test_the_page_is_dark_from_its_first_frame_as_its_system_is_until_a_theme_is_chosen(browser, server):
    with own_tab(browser, server, color_scheme="dark") as tab:
        page = tab.page
        page.set_content("<body style='background: black'>")
        # From a dark page on, no frame is bright.
        session, frames = page.context.new_cdp_session(page), []

        def keep(event):
            frames.append(Image.open(io.BytesIO(base64.b64decode(event["data"]))).convert("L"))
            session.send("Page.screencastFrameAck", {"sessionId": event["sessionId"]})

        session.on("Page.screencastFrame", keep)
        session.send("Page.startScreencast", {"format": "png"})
        # The first frames may still show the empty, white page that was there before the black one.
        while not frames or ImageStat.Stat(frames[-1]).mean[0] > 0:
            page.wait_for_timeout(20)
        frames.clear()
        tab.goto(f"/?scene={HESS}")
        session.send("Page.stopScreencast")
        means = [ImageStat.Stat(frame).mean[0] for frame in frames]
        assert len(means) > 2
        assert max(means) < 80, means

        def turns(scheme, is_dark):
            page.emulate_media(color_scheme=scheme)
            # The browser tells the page of a new preference before it draws the next frame.
            wait_frames(tab, 2)
            assert tab.dark is is_dark, scheme

        turns("light", False)
        turns("dark", True)
        assert "theme=" not in page.url
        tab.tool("theme")
        page.wait_for_function("location.search.includes('theme=light')")
        turns("light", False)
        turns("dark", False)


def test_no_rule_of_wcag_is_broken(look_at):
    # A state with a note, a pinned one, and a box that holds no number and says so to everyone: all there can be.
    tab = look_at(HESS)
    page, box = tab.page, tab.box("h")
    page.get_by_role("button", name="Compare").click()
    tab.move(I22=0.5, I23=1.5)
    tab.type("h", "abc")
    # The server parses everything that is not a plain number.
    page.locator(".param-h .exact[aria-invalid=true]").wait_for()
    assert "number" in page.locator(".param-h .why").inner_text()
    assert page.locator(".text.notes").is_visible()
    assert page.locator(".comparison").is_visible()
    assert_accessible(page)
    box.press("Escape")
    tab.open_menu()
    assert_accessible(page, page.get_by_role("dialog", name="Scenes", exact=True))
    page.keyboard.press("Escape")
    page.locator(".param-unpin").click()


STOP = """() => {
  let item = document.activeElement
  while (item?.shadowRoot?.activeElement) item = item.shadowRoot.activeElement
  const own = /^(A|BUTTON|SUMMARY)$/.test(item.tagName) ? item.textContent : ""
  const name = item.ariaLabel || item.labels?.[0]?.textContent || item.title || own
  const classes = []
  for (let at = item; at; at = at.parentElement ?? at.getRootNode().host)
    classes.push(...[...(at.classList ?? [])].filter((name) => /^param-|^sphere$|^corner$/.test(name)))
  return [`${item.tagName}.${item.className}`, name.trim(), classes]
}"""
"""The element in focus, its name, and the controls that it is part of."""


def test_every_control_is_reached_by_the_tab_key_and_every_stop_has_a_name(look_at):
    tab = look_at(HESS).unfold_controls()
    page = tab.page
    page.locator(".param-scenes").focus()
    reached, stops = set(), []
    while stops[5:] == [] or stops[-1] != stops[0]:
        stop, name, classes = page.evaluate(STOP)
        assert name or stop.startswith("BODY"), stop
        reached |= set(classes)
        stops.append(stop)
        assert len(stops) < 120
        page.keyboard.press("Tab")
    tools = [
        "preset",
        "accuracy",
        "sharing",
        "more",
        "pin",
        "present",
        "play",
        "t",
        "speed",
        "scenes",
        "details",
        "text",
    ]
    # The first picture comes soon, and the player before the groups of controls.
    at = {name: next(i for i, stop in enumerate(stops) if name in stop) for name in ("CANVAS", "param-play", "exact")}
    assert at["CANVAS"] <= 12
    assert at["param-play"] < at["exact"]
    assert {"sphere", "corner", *(f"param-{name}" for name in (*tools, *SLIDERS))} <= reached
    # Each that is disabled says why.
    said = page.locator(":disabled").evaluate_all("items => items.map((item) => item.title)")
    assert said
    assert all(title.startswith("Disabled: ") for title in said), said
    tab.fold_controls()


def test_on_a_phone_tools_without_room_in_the_bar_are_in_a_menu(look_at):
    page = look_at(HESS, "phone").page
    more, present = page.locator(".param-more"), page.locator(".param-present")
    far = [page.locator(f".param-{name}") for name in ("redo", "pin", "fullscreen", "theme", "reset")]
    presents = "document.documentElement.hasAttribute('data-present')"
    assert not any(item.is_visible() for item in far)
    more.click()
    for item in far:
        expect(item).to_be_in_viewport(ratio=1)
    assert_accessible(page, page.get_by_role("group", name="More"))
    present.click()
    assert page.evaluate(presents)
    assert not far[1].is_visible()
    # By keys alone, too.
    more.press("Enter")
    present.press("Enter")
    assert not page.evaluate(presents)
    # In a wider window they stand in the bar again, in their order.
    page.set_viewport_size({"width": 1600, "height": 950})
    present.wait_for()
    labels = " · ".join(page.locator(".tools .label:visible").all_inner_texts())
    assert labels == "Undo · Redo · Compare · Share · Present · More"
    for menu, names in (
        ("sharing", "Link, QR code, embed · Invite an audience · Export data, figures, films"),
        ("more", "Remove clicks and boxes · Reset · Full screen · Light or dark"),
    ):
        page.locator(f".param-{menu}").click()
        assert " · ".join(page.locator(f".more.{menu} .label:visible").all_inner_texts()) == names
        page.keyboard.press("Escape")
