"""A scene in a notebook: its address and display, and the state it returns."""

import re
import sys
import time
import types
from html import escape

import pytest

import hess_explorer as hess
from hess_explorer.headless.browser import wait_ready
from hess_explorer.library import exploring
from hess_explorer.server.liveness import is_alive


def wait_reached(shown, h):
    """Wait until the state in Python is the one that was reached by hand."""
    end = time.monotonic() + 30.0
    while shown.state.parameters["h"] != h:
        assert time.monotonic() < end, shown.state
        time.sleep(0.05)


@pytest.mark.thorough
def test_what_is_done_in_a_notebook_is_the_state_in_python(browser):
    with hess.explore("suslov-hess", h=1.2, accuracy="draft") as shown:
        assert (shown.state.scene, shown.state.parameters["h"]) == ("suslov-hess", 1.2)
        port = int(re.match(r"http://127\.0\.0\.1:(\d+)/\?", shown.url)[1])
        assert f'src="{escape(shown.url)}&amp;embed=1"' in shown._repr_html_()
        page = browser.new_page()
        page.goto(shown.url)
        wait_ready(page)
        box = page.locator(".param-h input.exact")
        box.fill("0.5")
        box.press("Enter")
        wait_reached(shown, 0.5)
        assert shown.state.parameters["accuracy"] == "draft"
        page.close()
    assert not is_alive("127.0.0.1", port)


def test_a_scene_is_reached_by_its_port_and_in_a_hub_or_colab_by_another_address(monkeypatch):
    assert exploring._address(8123) == "http://127.0.0.1:8123/"
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/me/")
    assert exploring._address(8123) == "/user/me/proxy/8123/"
    monkeypatch.delenv("JUPYTERHUB_SERVICE_PREFIX")
    asked = []
    colab = types.SimpleNamespace(eval_js=lambda code: asked.append(code) or "https://port.colab.example")
    monkeypatch.setitem(sys.modules, "google.colab.output", colab)
    assert exploring._address(8123) == "https://port.colab.example/"
    assert asked == ["google.colab.kernel.proxyPort(8123)"]
