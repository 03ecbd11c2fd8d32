"""The chart of a scene in a browser: unfold, zoom by a box, choose by a click and a drag, keys, a finger, undo."""

import pytest
from pytest import approx

from support.pointer import at, click_on


def drag(explorer, start, end):
    mouse = explorer.page.mouse
    (x0, y0), (x1, y1) = (at(explorer, "chart", *place)[0] for place in (start, end))
    mouse.move(x0, y0)
    mouse.down()
    for share in (0.3, 0.6, 1.0):
        mouse.move(x0 + share * (x1 - x0), y0 + share * (y1 - y0))
    explorer.change(mouse.up)


@pytest.mark.parametrize("scene", ["rotation-number"])
def test_a_box_zooms_in_a_click_and_a_drag_choose_and_all_of_it_is_undone(explorer):
    group = explorer.page.locator(".group-chart")
    explorer.unfold("chart")
    assert group.is_visible()
    explorer.change(explorer.choose, "chart", "trace")
    whole = explorer.axes("chart")
    drag(explorer, (0.5, -0.75), (2.5, 0.25))
    zoomed = explorer.axes("chart")
    assert zoomed == approx([0.5, 2.5, -0.75, 0.25], abs=0.06)
    assert explorer.data("chart-numbers")["x"] == approx(zoomed[:1])
    _, (dx, dy) = at(explorer, "chart", 1.0, 0.0)
    click_on(explorer, "chart", 1.0, 0.0)
    assert explorer.torus() == (approx(1.0, abs=dx), approx(0.0, abs=dy))
    # The ring is dragged, and the other pictures follow.
    drag(explorer, explorer.torus(), (1.5, -0.5))
    h, f = explorer.torus()
    assert (h, f) == (approx(1.5, abs=2 * dx), approx(-0.5, abs=2 * dy))
    assert explorer.axes("chart") == zoomed
    assert [explorer.data("map-here")[name][0] for name in "xy"] == approx([h, f], abs=1e-6)
    assert explorer.wait_url(chart="trace", h=h, f=f)["chart_window"].count(",") == 2
    explorer.change(explorer.page.locator(".param-undo").click)
    assert explorer.torus()[0] == approx(1.0, abs=dx)
    explorer.change(explorer.tool, "clear")
    assert explorer.axes("chart") == approx(whole)
    # Its choices are there while it is.
    explorer.fold("chart")
    group.wait_for(state="hidden")
