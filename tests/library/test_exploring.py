"""A scene in a notebook: its display, and the state it returns."""

import re
import time
from html import unescape

import pytest

import hess_explorer as hess
from hess_explorer.headless.browser import wait_ready
from hess_explorer.server.liveness import is_alive
from hess_mechanics.errors import InvalidParameter


def test_a_scene_in_a_notebook_says_what_the_hand_has_reached(browser):
    with hess.explore("suslov-hess", h=1.2, accuracy="draft") as shown:
        assert (shown.state.scene, shown.state.parameters["h"]) == ("suslov-hess", 1.2)
        address = unescape(re.search(r'<iframe src="([^"]+)"', shown._repr_html_())[1])
        port = int(re.search(r":(\d+)/", address)[1])
        page = browser.new_page()
        page.goto(address)
        wait_ready(page)
        box = page.locator(".param-h input.exact")
        box.fill("0.5")
        box.press("Enter")
        end = time.monotonic() + 30.0
        while shown.state.parameters["h"] != 0.5:
            assert time.monotonic() < end, shown.state
            time.sleep(0.05)
        assert shown.state.parameters["accuracy"] == "draft"
        page.close()
    assert not is_alive("127.0.0.1", port)


def test_what_cannot_be_starts_nothing():
    with pytest.raises(InvalidParameter, match="no parameter 'height_of_it'"):
        hess.explore("suslov-hess", height_of_it=1.0)
