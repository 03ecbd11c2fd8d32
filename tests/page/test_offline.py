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
from support.accessible import assert_accessible
from support.offline import captions, change, move, opened

DRAFT = "scene=suslov-hess&h=1.2&f=0.3&accuracy=draft"
FIRST = "limit-cycles-and-locking"
PAGES = {
    "suslov-hess": (DRAFT, ("h=0.2:3.4:3", "f=0:1:3")),
    "kharlamova": ("scene=kharlamova", ("q1=-0.5:0.5:3", "p=0.6:1.4:3")),
}


def written(folder, name, content):
    path = folder / f"{name}.html"
    path.write_bytes(content)
    return path.as_uri()


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
    found = picture_data(DRAFT, "omega")
    orbit = found.columns["data-orbit"]
    with opened(browser, written(tmp_path, name, data)) as page:
        clock, sphere, home = (page.locator(one) for one in (".player output", "canvas.sphere", "a.home"))

        def assert_point():
            t = float(clock.text_content().removeprefix("t = "))
            expected = [np.interp(t, orbit["t"], orbit[column]) for column in ("omega1", "omega2")]
            # The time is written with two digits.
            assert point_of(page, "omega") == pytest.approx(expected, abs=0.03)

        expect(clock).to_have_text("t = 2.00")
        assert_point()
        assert sphere.first.get_attribute("data-turn") == "0.3000 0.2000"
        before = drawn(page)
        sphere.first.press("ArrowRight")
        expect(sphere.first).not_to_have_attribute("data-turn", "0.3000 0.2000")
        assert drawn(page) != before
        page.keyboard.press("Space")
        expect(clock).not_to_have_text("t = 2.00")
        page.keyboard.press("Space")
        assert_point()
        # The page says which parameters are fixed.
        assert page.locator("input.hand").count() == 0
        expect(page.locator(".fixed")).to_contain_text("This file contains one computed state. Fixed: I₂₂ = 0.96, ")
        home.dispatch_event("focus")
        assert home.get_attribute("href").startswith("https://explorer.example/?v=1&scene=suslov-hess")
        assert json.loads(page.locator("#facts").text_content())["parameters"] == dict(found.values)
        assert_accessible(page)


def address_of(page):
    """The query of the state on show, in the link to the explorer, which follows it when it is about to be used."""
    page.locator("a.home").dispatch_event("focus")
    return page.locator("a.home").get_attribute("href").partition("?")[2]


def pixels(page, name):
    """The leading pictures of a scene as colours, side by side, (n, m, 3): a file has no names in its strip."""
    leads = scenes()[name].lead or scenes()[name].open_pictures[:1]
    hosts = [page.locator(f".gallery:not(.away) .picture-{lead} .host") for lead in leads]
    shots = [Image.open(io.BytesIO(host.screenshot())).convert("RGB") for host in hosts]
    return np.concatenate([np.asarray(shot).astype(int) for shot in shots], axis=1)


@pytest.mark.parametrize("name", ["suslov-hess", pytest.param("kharlamova", marks=pytest.mark.thorough)])
def test_sliders_show_what_the_served_page_shows(browser, explorer, tmp_path, name):
    query, sliders = PAGES[name]
    explorer.fresh(name)
    with opened(browser, written(tmp_path, name, state_page(query, sliders=sliders)[1])) as page:
        for slider in sliders:
            hand = page.locator(f".param-{slider.partition('=')[0]} .hand").first
            for key in ("Home", "ArrowRight"):
                change(page, hand.press, key)
                address = address_of(page)
                explorer.change(explorer.tell, "restore", address)
                there = captions(explorer.page)
                # Another test may have unfolded a picture there.
                assert captions(page) == {one: there[one] for one in scenes()[name].open_pictures}
                for one in (page, explorer.page):
                    one.mouse.move(5, 5)
                here, there = pixels(page, name), pixels(explorer.page, name)
                assert here.shape == there.shape
                off = np.abs(here - there).max(axis=2)
                # Lines may be shifted by an eighth of a pixel of a picture that is three times as wide.
                assert (off > 64).mean() < 1e-3, address
                assert off.mean() < 0.2, address


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
    [PART, *(pytest.param(one, marks=pytest.mark.thorough) for one in package_lessons().values())],
    ids=lambda one: one.name,
)
def test_a_lesson_is_given_from_its_file(browser, tmp_path, lesson):
    uri = written(tmp_path, lesson.name, lesson_page(lesson, 3))
    count = len(lesson.steps)
    with opened(browser, uri, (1280, 720)) as page:
        assert_given(page, lesson)
        # Back to the beginning, as a lecturer does after a question.
        for _ in lesson.steps[1:]:
            change(page, page.keyboard.press, "PageUp")
        expect(page.locator(".lesson .count")).to_have_text(f"1 / {count}")
    with opened(browser, f"{uri}#lesson={lesson.name}&step=3", (390, 844), has_touch=True, is_mobile=True) as page:
        expect(page.locator(".lesson .count")).to_have_text(f"3 / {count}")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


def assert_given(page, lesson):
    """Go through all steps; guess where a step asks, move the sliders that it names."""
    for number, step in enumerate(lesson.steps):
        expect(page.locator(".lesson .count")).to_have_text(f"{number + 1} / {len(lesson.steps)}")
        expect(page.locator("html")).to_have_attribute("data-scene", step.state.scene)
        for turn in page.locator("canvas[data-turn]").evaluate_all("all => all.map(({ dataset }) => dataset.turn)"):
            assert turn == "0.6000 0.3500"
        if step.prediction is not None:
            plot = page.locator(f".gallery:not(.away) .picture-{step.prediction.picture} > .host").bounding_box()
            for share in (0.45, 0.6):
                page.mouse.click(plot["x"] + share * plot["width"], plot["y"] + 0.4 * plot["height"])
            change(page, page.keyboard.press, "PageDown")
            expect(page.locator(".said")).not_to_be_empty()
            # The state in which the truth is shown.
            there, wanted = dict(parse_qsl(address_of(page))), step.prediction.outcome.values
            assert {name: there.get(name, "") for name in wanted} == {name: str(one) for name, one in wanted.items()}
        for name in step.controls:
            slider = page.locator(f".step-controls .param-{name} .hand")
            if slider.count():
                move(page, slider)
        if step.question:
            page.keyboard.press("PageDown")
            expect(page.locator(".answer")).to_have_attribute("open", "")
        if number + 1 < len(lesson.steps):
            change(page, page.keyboard.press, "PageDown")
