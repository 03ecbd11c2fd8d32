"""The scene "Euler–Poisson: sections" in a browser: clicks, a box, Undo, Clear, Stop, links."""

import math
import re
from urllib.parse import parse_qsl, urlsplit

import pytest
from playwright.sync_api import expect
from pytest import approx

from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.parameters import places
from support.euler_poisson import EP
from support.page import brought, one_tab
from support.pointer import at
from support.processes import UNWARMED

NUMBERS = {"orbits": 8.0, "count": 40.0, "long": 20.0, "span": 5.0}
SMALL = {**NUMBERS, "indicator": "nothing"}


def values_of(explorer):
    query = dict(parse_qsl(urlsplit(explorer.link()).query, keep_blank_values=True))
    return {spec.name: type(spec.default)(query[spec.name]) for spec in EP.specs}


@pytest.fixture
def page(tab):
    """The page with a small section."""
    brought(tab, EP).give(**SMALL)
    yield tab
    tab.assert_quiet()


def shown_points(explorer):
    # Sources that have never held data are not sent.
    return sum(len(explorer.data(f"section-{layer}").get("x", ())) for layer in ("first", "second"))


# --- What a user does --------------------------------------------------------------------------------


def test_a_click_starts_an_orbit_and_clear_takes_it_back(page):
    (x, y), _ = at(page, "section", 0.8, -0.35)
    page.change(lambda: page.page.mouse.click(x, y))
    assert places(values_of(page)["starts"]) == [
        (0.0, 0.2),
        (approx(0.8, abs=0.03), approx(-0.35, abs=0.01)),
    ]
    assert len(page.data("section-own")["x"]) == 2 * SMALL["count"]
    page.change(page.page.locator(".param-clear").click)
    assert values_of(page)["starts"] == "0,0.2"


def test_a_box_looks_closer_and_undo_looks_at_the_whole_again(page):
    (x0, y0), _ = at(page, "section", -2.25, -0.27)
    (x1, y1), _ = at(page, "section", -1.45, 0.33)
    page.page.mouse.move(x0, y0)
    page.page.mouse.down()
    page.page.mouse.move(0.5 * (x0 + x1), 0.5 * (y0 + y1), steps=4)
    page.page.mouse.move(x1, y1, steps=4)
    page.change(page.page.mouse.up)
    (l0, low), (l1, high) = places(values_of(page)["window"])
    assert (l0, l1) == approx((-2.25, -1.45), abs=0.04)
    assert (low, high) == approx((-0.27, 0.33), abs=0.015)
    assert page.axes("section") == approx([l0, l1, low, high], abs=1e-5)
    # It is filled with orbits of its own, all on one side of the barrier there.
    assert shown_points(page) == SMALL["orbits"] * SMALL["count"]
    page.change(page.page.locator(".param-undo").click)
    assert values_of(page)["window"] == ""
    assert page.axes("section") == approx([-math.pi, math.pi, -1.0, 1.0], abs=1e-5)


# --- Long work ---------------------------------------------------------------------------------------

HELD_BACK = """
import functools, sys, time
from collections import Counter
from pathlib import Path
from hess_explorer.scenes import euler_poisson

gate, piece, begun = Path(sys.argv.pop(1)), euler_poisson._batch, Counter()

@functools.wraps(piece)
def held(section, starts, crossings, level):
    begun[section.h] += crossings == 4000
    while 20 < section.h < 21 and begun[section.h] > 6 and gate.exists():
        time.sleep(0.02)
    return piece(section, starts, crossings, level)

euler_poisson._batch = held
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
        brought(held_back, EP).give(**SMALL)
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
