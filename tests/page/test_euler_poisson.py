"""The scene "Euler–Poisson: sections" in a browser: long work, and Stop."""

import re

import pytest
from playwright.sync_api import expect

from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes
from support.page import one_tab
from support.processes import UNWARMED

EP = scenes()["euler-poisson"]
SMALL = {**EP.defaults(), "orbits": 8.0, "count": 40.0, "long": 20.0, "span": 5.0, "indicator": "nothing"}

HELD_BACK = """
import functools, sys, time
from collections import Counter
from pathlib import Path
from hess_explorer.scenes.parts.sections import section as sections

gate, piece, begun = Path(sys.argv.pop(1)), sections.section_crossings, Counter()

@functools.wraps(piece)
def held(section, starts, crossings, *more, **limits):
    begun[section.h] += crossings == 4000
    while 20 < section.h < 21 and begun[section.h] > 6 and gate.exists():
        time.sleep(0.02)
    return piece(section, starts, crossings, *more, **limits)

sections.section_crossings = held
""" + UNWARMED[1]
"""The server; a section of 4000 crossings at 20 < h < 21 stops growing after six pieces, while a file is there."""


@pytest.fixture(scope="module")
def gate(tmp_path_factory):
    return tmp_path_factory.mktemp("gate") / "closed"


@pytest.fixture(scope="module")
def held_back(browser, tmp_path_factory, gate):
    """One tab on that server."""
    log = tmp_path_factory.mktemp("held back") / "server.log"
    with server_process(log, ("-c", HELD_BACK, str(gate))) as (_, base):
        yield from one_tab(browser, base)
        gate.unlink(missing_ok=True)
    assert "Traceback" not in log.read_text()


@pytest.fixture
def long_section(held_back, gate):
    """long_section(h) → the page while a section of that energy is computed, of which six pieces come."""

    def begin(h):
        held_back.fresh(EP.name)
        held_back.change(held_back.tell, "restore", encode(EP.name, SMALL))
        gate.touch()
        held_back.type("count", "4000")
        held_back.type("h", str(h))
        held_back.type("orbits", "400")
        held_back.page.locator(".computing").wait_for(state="visible")
        held_back.page.wait_for_function("hess.source('section-first').data.x.length > 0")
        return held_back

    yield begin
    gate.unlink(missing_ok=True)
    held_back.assert_quiet()


def test_a_long_section_fills_keeps_what_is_typed_in_its_box_and_can_be_stopped(long_section, gate):
    page = long_section(20.01)
    before, typed = page.state, page.box("h")
    typed.fill("43")
    # States of the section come between the keys.
    page.page.wait_for_function("state => Number(document.documentElement.dataset.state) > state + 1", arg=before)
    assert not page.ready
    assert typed.input_value() == "43"
    # Escape would stop it.
    typed.fill("20.01")
    box = page.page.locator(".computing")
    bar = box.locator("progress")
    # The first pieces wait for their kernels.
    expect(bar).not_to_have_js_property("value", 0, timeout=60_000)
    assert 0 < float(bar.evaluate("bar => bar.value")) < float(bar.evaluate("bar => bar.max"))
    box.locator("button").click()
    # Pieces already started are still drawn.
    gate.unlink()
    page.page.wait_for_function("document.documentElement.dataset.ready === 'true'")
    found = re.search(r"Stopped: (\d+) of (\d+) parts are drawn\.", page.text("notes"))
    assert found
    done, total = map(int, found.groups())
    assert 0 < done < total
    box.wait_for(state="hidden")
