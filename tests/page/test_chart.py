"""The chart of a scene in a browser: unfold, zoom by a box, choose by a click and a drag, keys, a finger, undo."""

import pytest
from pytest import approx

from support.pointer import at, click_on


@pytest.fixture
def scene():
    return "rotation-number"


@pytest.fixture
def page(explorer):
    explorer.unfold("chart")
    explorer.change(explorer.choose, "chart", "trace")
    return explorer


def drag(page, start, end):
    page.page.mouse.move(*at(page, "chart", *start)[0])
    page.page.mouse.down()
    (x0, y0), (x1, y1) = (at(page, "chart", *place)[0] for place in (start, end))
    for share in (0.3, 0.6, 1.0):
        page.page.mouse.move(x0 + share * (x1 - x0), y0 + share * (y1 - y0))
    page.change(page.page.mouse.up)


def test_a_box_zooms_in_a_click_and_a_drag_choose_and_all_of_it_is_undone(page):
    whole = page.axes("chart")
    drag(page, (0.5, -0.75), (2.5, 0.25))
    assert page.axes("chart") == approx([0.5, 2.5, -0.75, 0.25], abs=0.06)
    zoomed = page.axes("chart")
    assert page.data("chart-numbers")["x"] == approx(zoomed[:1])
    _, (dx, dy) = at(page, "chart", 1.0, 0.0)
    click_on(page, "chart", 1.0, 0.0)
    assert (page.shown("h")[0], page.shown("f")[0]) == (approx(1.0, abs=dx), approx(0.0, abs=dy))
    # The ring is dragged, and the other pictures follow.
    drag(page, (page.shown("h")[0], page.shown("f")[0]), (1.5, -0.5))
    h, f = page.shown("h")[0], page.shown("f")[0]
    assert (h, f) == (approx(1.5, abs=2 * dx), approx(-0.5, abs=2 * dy))
    assert page.axes("chart") == zoomed
    assert [page.data("map-here")[name][0] for name in "xy"] == approx([h, f], abs=1e-6)
    values = page.wait_url(chart="trace", h=h, f=f)
    assert values["chart_window"].count(",") == 2
    page.change(page.page.locator(".param-undo").click)
    assert page.shown("h")[0] == approx(1.0, abs=dx)
    page.change(page.page.locator(".param-clear").click)
    assert page.axes("chart") == approx(whole)


def test_its_choices_are_there_while_it_is(page):
    group = page.page.locator(".group-chart")
    assert group.is_visible()
    assert group.evaluate("group => group.open")
    page.fold("chart")
    group.wait_for(state="hidden")
