"""A store of a sweep as a chart of the page, for `hess-explorer serve --chart`."""

import json

import numpy as np
import pytest
from playwright.sync_api import expect

from hess_explorer.headless.screenshot import server_process
from hess_explorer.server.served_chart import ServedChart
from hess_explorer.sweep import explain, read, sweep
from hess_explorer.sweep.shown import chart_file
from hess_mechanics.errors import InvalidParameter
from support.processes import UNWARMED

OVER = {"h": (-0.5, 2.0, 6), "f": (-1.0, 1.0, 5)}


def test_a_sweep_is_the_chart_that_the_page_would_save(tmp_path):
    found = sweep("rotation-number", OVER, a=0.25)
    (tmp_path / "chart.json").write_text(json.dumps(chart_file(found), allow_nan=False))
    again = read(tmp_path / "chart.json")
    assert again.attrs["state"].startswith("v=1&scene=") and "a=0.25" in again.attrs["state"]
    assert np.array_equal(again.rotation_number, found.rotation_number, equal_nan=True)
    assert np.array_equal(again.status, found.status)
    assert again.rotation_number.dims == ("h", "f")
    # A cell is computed again as a state of the scene.
    assert explain(again, h=-0.5, f=1.0) == explain(found, h=-0.5, f=1.0)
    # `serve --chart` shows the file that the page has saved, too.
    assert chart_file(again) == chart_file(found)


def test_a_long_side_has_every_second_cell():
    found = sweep("rotation-number", {"h": (0.0, 2.0, 401), "f": [0.1, 0.3]}, a=0.25)
    chart = chart_file(found)
    assert (chart["x"]["count"], chart["x"]["low"], chart["x"]["high"]) == (201, 0.0, 2.0)
    assert chart["values"][:201] == found.rotation_number.values[::2, 0].tolist()


@pytest.mark.parametrize(
    "over, said",
    [
        ({"h": [0.5, 1.0]}, "A chart has two sides, but this sweep is over h"),
        ({"h": [0.5, 1.0, 2.0], "f": [0.1, 0.2]}, "evenly spaced"),
        ({"h": [0.5], "f": [0.1, 0.2]}, "needs two values or more"),
    ],
)
def test_what_is_no_chart_is_said(over, said):
    with pytest.raises(InvalidParameter, match=said):
        chart_file(sweep("rotation-number", over, a=0.5, **({} if "f" in over else {"f": 0.1})))


def test_of_three_sides_one_has_a_chosen_value():
    found = sweep("rotation-number", {"a": [0.25, 0.5], **OVER})
    chart = chart_file(found, {"a": 0.5})
    assert "a=0.5" in chart["state"]
    single = chart_file(sweep("rotation-number", OVER, a=0.5))
    assert (chart["values"], chart["link"]) == (single["values"], single["link"])
    for at, said in (
        ({}, "is over a, h, f: choose a value of each further one with --slice"),
        ({"a": 0.3}, "no cells at a = 0.3: the nearest are at 0.25"),
        ({"b": 1.0}, "no side 'b' to choose a value of: choose among a, h, f"),
    ):
        with pytest.raises(InvalidParameter, match=said):
            chart_file(found, at)


def test_a_function_belongs_to_no_scene():
    def own(x, y):
        return x * y

    with pytest.raises(InvalidParameter, match="No scene shows own over x and y"):
        chart_file(sweep(own, {"x": [0.0, 1.0], "y": [0.0, 1.0]}))


def test_the_page_opens_the_chart_with_its_state(browser, server):
    page = browser.new_page()
    insert = f"() => document.head.insertAdjacentHTML('beforeend', {json.dumps(ServedChart.HEAD)})"
    page.add_init_script(f"addEventListener('DOMContentLoaded', {insert})")
    chart = chart_file(sweep("rotation-number", OVER, a=0.25))
    page.route("**/chart.json", lambda route: route.fulfill(json=chart))
    page.goto(f"{server}/")
    expect(page.locator(".param-a input.exact")).to_have_value("0.25", timeout=60_000)
    for side, (name, (low, high, count)) in zip("xy", OVER.items(), strict=True):
        expect(page.locator(f".param-{side}")).to_have_value(name)
        found = [page.locator(f".param-{side}-{what}").input_value() for what in ("from", "to", "cells")]
        assert [*map(float, found)] == [low, high, count]
    page.close()


@pytest.mark.thorough
def test_a_page_opens_the_chart_of_its_server(browser, tmp_path):
    sweep("rotation-number", OVER, a=0.25, store=tmp_path / "rho.zarr")
    with server_process(tmp_path / "log", UNWARMED, ["--chart", str(tmp_path / "rho.zarr")]) as (_, url):
        page = browser.new_page()
        page.goto(f"{url}/?scene=suslov-hess")
        page.get_by_text("6 × 5, precise accuracy").wait_for(timeout=60_000)
        assert page.get_by_text("Chart: ρ").is_visible()
        page.close()
