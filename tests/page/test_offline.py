"""Pages in files: from the disk, where every request is refused, they do what the served page does."""

import io
import json
import re
from dataclasses import replace
from urllib.parse import parse_qsl

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from hess_explorer.export.picture_data import picture_data
from hess_explorer.lessons import package_lessons
from hess_explorer.offline.pages import lesson_page, state_page
from hess_explorer.scenes import scenes
from hess_mechanics.errors import ModelError
from support.accessible import assert_accessible
from support.offline import captions, change, move, opened

DRAFT = "scene=suslov-hess&h=1.2&f=0.3&accuracy=draft"
FIRST = "limit-cycles-and-locking"
# Five pages, with two sliders each.
PAGES = {
    "suslov-hess": (DRAFT, ("h=0.2:3.4:3", "f=0:1:3")),
    "free-suslov": ("scene=free-suslov", ("k=0.2:0.9:3", "I23=-0.3:0.3:3")),
    "chaplygin-ball": ("scene=chaplygin-ball", ("D=0.5:3:3", "h=0.5:2:3")),
    "kharlamova": ("scene=kharlamova", ("q1=-0.5:0.5:3", "p=0.6:1.4:3")),
    "loxodrome": ("scene=loxodrome", ("energy=0.5:2:3", "l=0.1:0.5:3")),
}


def written(folder, name, content):
    path = folder / f"{name}.html"
    path.write_bytes(content)
    return path.as_uri()


def time_of(page):
    """The time of the player."""
    return float(page.locator(".player output").text_content().removeprefix("t = "))


def point_of(page, name):
    """The place of the moving point of a plot, from the pixels of its canvas."""
    return page.evaluate(
        """name => {
            const plot = Bokeh.index.roots.find(({ model }) => model.name === name)
            const canvas = plot.canvas_view.overlays.el.nextElementSibling
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true })
            copy.drawImage(canvas, 0, 0)
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height)
            const painted = [...Array(data.length / 4).keys()].filter((i) => data[4 * i + 3] > 127)
            const middle = (one) => painted.reduce((sum, i) => sum + one(i), 0) / painted.length
            const ratio = canvas.width / plot.bbox.width
            const { x_scale: x, y_scale: y } = plot.frame
            return [
                x.invert(middle((i) => i % canvas.width) / ratio),
                y.invert(middle((i) => Math.floor(i / canvas.width)) / ratio),
            ]
        }""",
        name,
    )


def drawn(page):
    return page.locator("canvas.sphere").first.evaluate("canvas => canvas.toDataURL()")


def test_a_state_plays_and_turns_from_the_disk(browser, tmp_path):
    name, data = state_page(f"{DRAFT}&t=2&az=0.3&el=0.2", home="https://explorer.example/")
    assert name == "suslov-hess"
    with opened(browser, written(tmp_path, name, data)) as page:
        assert page.locator(".picture").count() == 6
        found = picture_data(DRAFT, "omega")
        orbit = found.columns["data-orbit"]

        def assert_point(t):
            expected = [np.interp(t, orbit["t"], orbit[column]) for column in ("omega1", "omega2")]
            # The time is written with two digits.
            assert point_of(page, "omega") == pytest.approx(expected, abs=0.03)

        assert time_of(page) == 2.0
        assert_point(2.0)
        sphere = page.locator("canvas.sphere").first
        assert sphere.get_attribute("data-turn") == "0.3000 0.2000"
        before = drawn(page)
        box = sphere.bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2 + 60, box["y"] + box["height"] / 2 + 20)
        page.mouse.up()
        expect(sphere).not_to_have_attribute("data-turn", "0.3000 0.2000")
        assert float(sphere.get_attribute("data-turn").split()[0]) < 0.29
        assert drawn(page) != before
        page.keyboard.press("Space")
        expect(page.locator(".player output")).not_to_have_text("t = 2.00")
        page.keyboard.press("Space")
        assert_point(time_of(page))
        # The page says which parameters are fixed.
        assert page.locator("input.hand").count() == 0
        expect(page.locator(".fixed")).to_contain_text("This file holds one computed state. Fixed: I₂₂ = 0.96, ")
        page.locator("a.home").dispatch_event("focus")
        assert (
            page.locator("a.home").get_attribute("href").startswith("https://explorer.example/?v=1&scene=suslov-hess")
        )
        facts = json.loads(page.locator("#facts").text_content())
        assert facts["parameters"] == dict(found.values)
        assert_accessible(page)


def address_of(page):
    """The query of the state on show, in the link to the explorer, which follows it when it is about to be used."""
    page.locator("a.home").dispatch_event("focus")
    return page.locator("a.home").get_attribute("href").partition("?")[2]


def pixels(page):
    """The pictures as colours (n, m, 3)."""
    shot = page.locator(".stage > div").first.screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


@pytest.mark.parametrize(
    "name", ["suslov-hess", *(pytest.param(one, marks=pytest.mark.thorough) for one in PAGES if one != "suslov-hess")]
)
def test_sliders_show_what_the_served_page_shows(browser, explorer, tmp_path, name):
    query, sliders = PAGES[name]
    content = state_page(query, sliders=sliders)[1]
    names = [slider.partition("=")[0] for slider in sliders]
    explorer.fresh(name)
    with opened(browser, written(tmp_path, name, content)) as page:
        for step in range(4):
            slider = page.locator(f".param-{names[step // 2]} .hand").first
            change(page, slider.press, "Home" if step % 2 == 0 else "ArrowRight")
            address = address_of(page)
            explorer.change(explorer.tell, "restore", address)
            there = captions(explorer.page)
            # Another test may have unfolded a picture there.
            assert captions(page) == {name: there[name] for name in scenes()[name].open_pictures}
            for one in (page, explorer.page):
                one.mouse.move(5, 5)
            here, there = pixels(page), pixels(explorer.page)
            assert here.shape == there.shape
            off = np.abs(here - there).max(axis=2)
            # Lines may be shifted by an eighth of a pixel of a picture that is three times as wide.
            assert (off > 64).mean() < 5e-4, (step, address)
            assert off.mean() < 0.1, (step, address)


def test_the_file_says_what_it_cannot_show_and_keeps_its_place(browser, tmp_path):
    uri = written(tmp_path, "page", state_page(DRAFT, ("omega", "bifurcation"), ("h=0.2:3.4:6", "f=0:1:5"))[1])
    with opened(browser, uri) as page:
        notes = page.locator(".notes")
        change(page, page.locator(".param-h .hand").press, "End")
        assert page.locator(".param-h input.exact").input_value() == "3.4"
        expect(notes).to_be_hidden()
        change(page, page.locator(".param-f .hand").press, "Home")
        expect(notes).to_have_text("h is 1.2 again: this file moves one slider at a time.")
        # A click in the bifurcation diagram chooses the nearest state.
        plot = page.locator(".picture[data-name=bifurcation] .host").bounding_box()
        change(page, page.mouse.click, plot["x"] + 0.85 * plot["width"], plot["y"] + 0.4 * plot["height"])
        expect(notes).to_contain_text("the nearest one is shown")
        assert float(page.locator(".param-h input.exact").input_value()) > 2
        change(page, page.keyboard.press, "Control+z")
        assert page.locator(".param-f input.exact").input_value() == "0"
        page.wait_for_url(re.compile(r"h=1\.2&f=0(\.0)?&"))
        address = page.url
    assert "#v=1&scene=suslov-hess" in address
    with opened(browser, address) as page:
        assert page.locator(".param-f input.exact").input_value() == "0"


# Of the first lesson the steps with a guess, a question and a slider.
PART = replace(package_lessons()[FIRST], steps=package_lessons()[FIRST].steps[4:7])


@pytest.mark.parametrize(
    "lesson",
    [
        pytest.param(PART, id="part"),
        *(pytest.param(one, marks=pytest.mark.thorough, id=one.name) for one in package_lessons().values()),
    ],
)
def test_a_lesson_is_given_from_its_file(browser, tmp_path, lesson):
    uri = written(tmp_path, lesson.name, lesson_page(lesson, 3))
    with opened(browser, uri, (1280, 720)) as page:
        assert_given(page, lesson)
        # Back to the beginning, as a lecturer does after a question.
        for _ in lesson.steps[1:]:
            change(page, page.keyboard.press, "PageUp")
        expect(page.locator(".lesson .count")).to_have_text(f"1 / {len(lesson.steps)}")
    with opened(browser, f"{uri}#lesson={lesson.name}&step=3", (390, 844), has_touch=True, is_mobile=True) as page:
        expect(page.locator(".lesson .count")).to_have_text(f"3 / {len(lesson.steps)}")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


def assert_given(page, lesson):
    """Go through all steps; guess where a step asks, move the sliders that it names."""
    for number, step in enumerate(lesson.steps):
        expect(page.locator(".lesson .count")).to_have_text(f"{number + 1} / {len(lesson.steps)}")
        expect(page.locator("html")).to_have_attribute("data-scene", step.at.scene)
        for turn in page.locator("canvas[data-turn]").evaluate_all("all => all.map(({ dataset }) => dataset.turn)"):
            assert turn == "0.6000 0.3500"
        if step.prediction is not None:
            plot = page.locator(f".gallery:not(.away) .picture-{step.prediction.picture} > .host").bounding_box()
            for share in (0.45, 0.6):
                page.mouse.click(plot["x"] + share * plot["width"], plot["y"] + 0.4 * plot["height"])
            change(page, page.keyboard.press, "PageDown")
            expect(page.locator(".said")).not_to_be_empty()
            # The state in which the truth is shown.
            there = dict(parse_qsl(address_of(page)))
            assert [there.get(name, "") for name in step.prediction.then.values] == [
                str(value) for value in step.prediction.then.values.values()
            ]
        for name in step.controls:
            slider = page.locator(f".step-controls .param-{name} .hand")
            if slider.count():
                move(page, slider)
        if step.question:
            page.keyboard.press("PageDown")
            expect(page.locator(".answer")).to_have_attribute("open", "")
        if number + 1 < len(lesson.steps):
            change(page, page.keyboard.press, "PageDown")


def test_a_picture_that_is_not_there_is_refused():
    with pytest.raises(ModelError, match="has no picture 'x': choose one of body"):
        state_page(DRAFT, ["x"])
