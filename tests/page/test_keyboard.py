"""The page by keyboard and by screen reader: names, places chosen by arrow keys, and what is announced."""

from urllib.parse import parse_qsl, urlsplit

import pytest
from playwright.sync_api import expect

from support.accessible import assert_accessible
from support.page import ALL, wait_frames
from support.pointer import at, shares


def test_arrow_keys_move_the_ring_of_the_bifurcation_diagram_by_pixels(explorer):
    # Loaded again: after some other tests the first key was not answered.
    page = explorer.open().page
    host = page.get_by_role("application", name="Bifurcation diagram: arrow keys move the ring")
    h, f = explorer.here()
    _, (wide, high) = at(explorer, "bifurcation", h, f)
    host.focus()
    expect(host).to_be_focused()
    explorer.change(host.press, "ArrowRight")
    assert explorer.here() == pytest.approx((h + wide, f), abs=0.51 * max(wide, high))
    assert explorer.here()[0] > h
    explorer.change(page.keyboard.press, "Shift+ArrowUp")
    assert explorer.here()[1] == pytest.approx(f + 10 * high, abs=0.51 * high + 1e-9)
    # The controls follow; the player keeps its time.
    assert explorer.shown("f")[0] == pytest.approx(explorer.here()[1], rel=1e-6)
    assert explorer.time == 0.0
    assert_accessible(page, host)
    # The place of the ring stays where it is.
    before, ring = explorer.axes("bifurcation"), explorer.here()
    where = shares(explorer, "bifurcation", *ring)
    for key in ("+", "+", "-"):
        host.press(key)
    wait_frames(explorer)
    x0, x1, *_ = explorer.axes("bifurcation")
    assert x1 - x0 == pytest.approx(0.8 * (before[1] - before[0]), rel=1e-6)
    assert shares(explorer, "bifurcation", *ring) == pytest.approx(where, abs=0.01)
    host.press("0")
    assert explorer.axes("bifurcation") == before
    assert explorer.here() == ring


def test_enter_chooses_the_place_of_the_cross_in_a_section(explorer):
    explorer.fresh("suslov")
    host = explorer.picture("section").get_by_role("application")
    assert "arrow keys move a cross, Enter chooses" in host.get_attribute("aria-label")
    x0, x1, y0, y1 = explorer.axes("section")
    _, (wide, high) = at(explorer, "section", x0, y0)
    for key in ("ArrowRight", "Shift+ArrowDown"):
        host.press(key)
    expect(host.locator(".cross")).to_be_visible()
    explorer.change(explorer.page.keyboard.press, "Enter")
    start = dict(parse_qsl(urlsplit(explorer.link()).query))["starts"].split(";")[-1]
    middle = (x0 + x1) / 2 + wide, (y0 + y1) / 2 - 10 * high
    assert [*map(float, start.split(","))] == pytest.approx(middle, abs=0.6 * max(wide, high))


def test_a_changed_verdict_is_announced_once_and_the_clock_never(explorer):
    page = explorer.page
    assert page.locator(".player output").get_attribute("aria-live") == "off"
    # The first captions are known when the hand has rested.
    page.wait_for_timeout(1200)
    before = explorer.caption("circle")
    page.evaluate(
        f"() => {{ {ALL}; window.heard = []; const item = all(document).find((one) => one.matches('.announced'));"
        " new MutationObserver(() => heard.push(item.textContent)).observe(item, {childList: true}) }"
    )
    # Many states in one hand's move, until the cycles are gone.
    explorer.change(lambda: [explorer.slide(I23=value) for value in (0.2, 0.15, 0.1, 0.05, 0.0)])
    page.wait_for_function("heard.length > 0")
    assert explorer.caption("circle") != before
    (heard,) = page.evaluate("heard")
    assert "Circle map:" in heard
    verdict = explorer.picture("circle").locator(".verdict").text_content()
    assert verdict in heard
    # The line above the pictures says it too, and which number did it.
    said = page.locator(".moves").inner_text()
    assert said.startswith("I₂₃ ") and "→ 0. " in said and f"Circle map: {verdict}" in said
    # The same verdict with other numbers is not said again.
    explorer.move(phi0=1.0)
    page.wait_for_timeout(1200)
    assert len(page.evaluate("heard")) == 1
    expect(page.locator(".moves")).to_contain_text("→ 1. No verdict changed.")
