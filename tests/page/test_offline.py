"""A state in one HTML file: it plays and turns from the disk, where every request is refused."""

import json
from contextlib import contextmanager

import numpy as np
import pytest
from playwright.sync_api import expect

from hess_explorer.export.picture_data import picture_data
from hess_explorer.page.offline import as_html, bundled
from hess_mechanics.errors import ModelError
from support.accessible import assert_accessible

DRAFT = "h=1.2&f=0.3&accuracy=draft"
POINT = """name => {
    const models = Bokeh.documents.flatMap((one) => [...one.all_models])
    const { data } = models.find((one) => one.name === name)
    const read = (column) => (data instanceof Map ? data.get(column) : data[column])[0]
    return [read("x"), read("y")]
}"""


@contextmanager
def opened(browser, path):
    """The file in a browser without any network; no error, and no request but for the file itself."""
    context = browser.new_context(viewport={"width": 1400, "height": 850}, offline=True, reduced_motion="reduce")
    errors, asked = [], []
    context.on("console", lambda message: errors.append(message.text) if message.type in ("error", "warning") else None)
    context.on("weberror", lambda error: errors.append(str(error.error)))
    context.on("request", lambda request: asked.append(request.url))
    try:
        page = context.new_page()
        page.goto(path.as_uri())
        page.wait_for_selector("html[data-ready=true]", state="attached")
        yield page
        assert errors == []
        assert [url for url in asked if not url.startswith("data:")] == [path.as_uri()]
    finally:
        context.close()


def time_of(page):
    """The time of the player."""
    return float(page.locator("#player output").text_content().removeprefix("t = "))


def test_a_state_plays_and_turns_from_the_disk(browser, tmp_path):
    name, data = as_html(f"{DRAFT}&t=2&az=0.3&el=0.2", home="https://explorer.example/")
    assert name == "suslov-hess"
    path = tmp_path / "suslov-hess.html"
    path.write_bytes(data)
    with opened(browser, path) as page:
        assert page.locator("#pictures .picture").count() == 6
        captions = page.locator("#pictures .title").all_text_contents()
        assert captions == [
            "The body in space",
            "Angular velocity (ω₁, ω₂)",
            "Poisson sphere",
            "Bifurcation diagram",
            "Circle map",
            "The torus in space",
        ]
        found = picture_data(DRAFT, "omega")
        orbit = found.columns["data-orbit"]

        def assert_point(t):
            expected = [np.interp(t, orbit["t"], orbit[column]) for column in ("omega1", "omega2")]
            # The time is written with two digits.
            assert page.evaluate(POINT, "omega-point") == pytest.approx(expected, abs=0.03)

        assert time_of(page) == 2.0
        assert_point(2.0)
        sphere = page.locator("#pictures canvas.sphere").first
        assert sphere.get_attribute("data-turn") == "0.3000 0.2000"
        before = sphere.evaluate("canvas => canvas.toDataURL()")
        box = sphere.bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2 + 60, box["y"] + box["height"] / 2 + 20)
        page.mouse.up()
        page.wait_for_function(
            "before => document.querySelector('#pictures').shadowRoot"
            ".querySelector('canvas.sphere').toDataURL() !== before",
            arg=before,
        )
        assert float(sphere.get_attribute("data-turn").split()[0]) < 0.29
        page.keyboard.press("Space")
        page.wait_for_function(
            "() => Number(document.querySelector('#player').shadowRoot"
            ".querySelector('output').textContent.slice(4)) > 2.3"
        )
        page.keyboard.press("Space")
        stopped = time_of(page)
        assert_point(stopped)
        # Controls that need a server are disabled, with the reason.
        sliders = page.locator("#controls input")
        assert sliders.count() == 7
        assert all(sliders.nth(i).is_disabled() for i in range(7))
        expect(page.locator("#controls")).to_contain_text("This file holds one state")
        link = picture_data(f"{DRAFT}&t=2&az=0.3&el=0.2").link
        assert page.locator("header a").get_attribute("href") == f"https://explorer.example/?{link}"
        facts = json.loads(page.locator("#facts").text_content())
        assert facts["parameters"] == dict(found.values)
        assert facts["status"][0] == "accuracy: draft"
        assert facts["program"] == found.facts["program"]
        assert facts["link"] in page.locator("meta[name=description]").get_attribute("content")
        assert "error" in page.locator("meta[name=description]").get_attribute("content")
        assert page.locator("#words math").count() > 3
        assert_accessible(page)


def test_clouds_move_without_a_server_and_only_the_pictures_asked_for_are_there(browser, tmp_path):
    path = tmp_path / "clouds.html"
    path.write_bytes(as_html("scene=singular-measures&points=1000&accuracy=draft", ("omega", "density"))[1])
    with opened(browser, path) as page:
        assert [one.get_attribute("data-name") for one in page.locator("#pictures .picture").all()] == [
            "omega",
            "density",
        ]
        cloud = page.locator("#pictures canvas.cloud")
        before = cloud.evaluate("canvas => canvas.toDataURL()")
        page.keyboard.press("ArrowRight")
        page.wait_for_function(
            "before => document.querySelector('#pictures').shadowRoot"
            ".querySelector('canvas.cloud').toDataURL() !== before",
            arg=before,
        )


def test_the_modules_in_the_file_name_each_other_and_nothing_else():
    modules = bundled("page/offline.js")
    assert {"page/offline.js", "page/bus.js", "pictures/sphere.js", "controls/player.js"} <= modules.keys()
    # The modules that talk to the server are not included.
    assert not {"page/client.js", "page/requests.js", "page/websocket.js"} & modules.keys()


def test_a_picture_that_is_not_there_is_refused():
    with pytest.raises(ModelError, match="has no picture 'x': choose one of body"):
        as_html(DRAFT, ["x"])
