"""Charts of the page, without a browser: computed cells, their order, and validation of requests."""

import json
import math
import re
import threading
import time

import numpy as np
import pytest
from pytest import approx

from hess_explorer.__main__ import main
from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import Task
from hess_explorer.page.charts import Charts
from hess_explorer.protocol.messages import parse
from hess_explorer.protocol.parameters import MAX_QUERY, Number
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.sweep import StoreError, explain, read
from hess_explorer.sweep import charting as running
from hess_explorer.sweep.chart import MOST_SIDE, Chart, at_first, sides_of_places, swept
from hess_explorer.sweep.charting import Charting
from hess_explorer.sweep.quantities import QUANTITIES
from hess_explorer.sweep.quantity import Outcome
from hess_explorer.sweep.run import sweep
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import level
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.kharlamova import PlaneBody, arc, state_at
from hess_mechanics.suslov.scattering import cos_chi
from support.asynchronous import wait_until
from support.wire import read_frame

CHARTED = [(scene.name, one.quantity) for scene in scenes().values() for one in scene.charts]


def wish(state="scene=suslov-hess", quantity="rotation-number", x=("h", -0.9, 2.0, 9), y=("f", -1.5, 1.5, 7), part=0):
    return {"state": state, "quantity": quantity, "part": part, "x": list(x), "y": list(y)}


def whole(chart):
    """Return the numbers (rows, columns), and the status of the cells."""
    found = chart.compute(np.arange(chart.cells, dtype=np.int32))
    shape = chart.y.count, chart.x.count
    return found.values.reshape(shape), found.status.reshape(shape)


class Page:
    """Client side of a chart, which records every response."""

    def __init__(self):
        self.cells, self.told = b"", []
        self.charts = Charts()

    def send(self, message):
        """Return the response, or None."""
        request = parse(message)
        if request is None:
            return None
        told, _, cells = read_frame(self.charts.answer(request).encode())
        if not told:
            return None
        self.cells = cells
        self.told.append(told["chart"])
        return self.told[-1]

    def all_of(self, given):
        """Run a chart to its end as the browser does; return the last response, the numbers and the status."""
        head = self.send({"chart": {"start": given, "id": 7}})
        values, status = np.full(head["of"], np.nan), np.zeros(head["of"], np.uint8)
        known = 0
        while True:
            count = head["cells"]
            assert head["first"] == known and len(self.cells) == 13 * count
            where = np.frombuffer(self.cells, "<i4", count, 8 * count)
            assert not status[where].any()
            values[where] = np.frombuffer(self.cells, "<f8", count)
            status[where] = np.frombuffer(self.cells, np.uint8, count, 12 * count)
            known += count
            if not head["running"] and count == 0:
                return head, values, status
            time.sleep(0.005)
            head = self.send({"chart": {"more": known, "id": 7}})


@pytest.mark.parametrize("scene, quantity", CHARTED)
def test_what_a_scene_offers_is_in_the_table_and_depends_on_its_sliders(scene, quantity):
    assert quantity in QUANTITIES
    found = scenes()[scene]
    numbers = {spec.name for spec in found.specs if isinstance(spec, Number)}
    numbers |= {side["name"] for side in sides_of_places(found)}
    over = swept(scene, quantity)
    assert len(over) >= 2 and set(over) <= numbers
    # Those that a newcomer sees come first.
    opened = [name in found.essential for name in over]
    assert opened == sorted(opened, reverse=True)
    charted = next(one for one in found.charts if one.quantity == quantity)
    assert set(charted.pictures) <= set(found.pictures)


def test_what_the_quantity_needs_follows_from_each_state():
    """Against the mechanics called by hand: I11 of the body follows from k, the start of a motion from q and p."""
    values, _ = whole(
        Chart.read(wish("scene=scattering&I22=1.2&I13=0.1", "cos-chi", ("k", 0.5, 2.5, 3), ("I23", 0.2, 0.8, 2)))
    )
    for i, I23 in enumerate((0.2, 0.8)):
        for j, k in enumerate((0.5, 1.5, 2.5)):
            body = SuslovBody(1.2 + k * k * (0.1**2 + I23**2) / 1.2, 1.2, 0.1, I23)
            assert values[i, j] == approx(cos_chi(body), rel=1e-12)
    values, status = whole(
        Chart.read(wish("scene=kharlamova&p=0.7", "period", ("q1", -0.5, 2.0, 3), ("alpha", 0.1, 1.1, 2)))
    )
    body = PlaneBody(1.5, 1.0, 0.4, 0.7)
    for i, alpha in enumerate((0.1, 1.1)):
        for j, q1 in enumerate((-0.5, 0.75)):
            start = state_at(body, (q1, -0.2), (0.7 * math.cos(alpha), 0.7 * math.sin(alpha)))
            assert values[i, j] == approx(arc(body, start).period, rel=1e-12)
    # Outside the ellipse, √1.5 wide, there is no start.
    assert (status[:, 2] == Outcome.INVALID_PARAMETER).all() and np.isnan(values[:, 2]).all()


def test_the_place_of_a_start_on_a_section_is_a_place_of_a_chart():
    """Against sweeps over the section's coordinates; cells without a possible motion have no number."""
    given = wish(
        "scene=suslov&accuracy=draft&starts=0.5,0.5;1,1&h=0.9",
        "megno-suslov",
        ("starts:0", -3.0, 3.0, 5),
        ("starts:1", 0.3, 2.0, 3),
    )
    chart = Chart.read(given)
    values, status = whole(chart)
    body = {name: chart.values[name] for name in ("I11", "I22", "I13", "I23", "b1", "b2", "b3", "h")}
    over = {"psi": (-3.0, 3.0, 5), "delta": (0.3, 2.0, 3)}
    expected = sweep("megno-suslov-section", over, level="draft", **body, k=3).megno_suslov_section.values.T
    # The link has ten digits of a place, of which chaotic motions make more.
    assert np.array_equal(np.isnan(values), np.isnan(expected)) and np.isnan(values).any()
    assert values[~np.isnan(values)] == approx(expected[~np.isnan(values)], rel=0.05)
    assert (status[np.isnan(values)] == Outcome.OUTSIDE_REGION).all()
    assert "no motion has this energy" in chart.why(
        *(side.places[i] for side, i in zip((chart.x, chart.y), np.argwhere(np.isnan(values))[0][::-1], strict=True))
    )


def test_every_quantity_of_a_scene_has_a_number_in_its_first_state():
    found = [one for scene in scenes().values() for one in at_first(scene)]
    assert len(found) == len(CHARTED)
    # A torus may be without limit cycles.
    numbers = {Outcome.OK, Outcome.FLOOR, Outcome.PROMISE_NOT_MET, Outcome.NO_VALUE}
    assert {int(one.status[0]) for one in found} <= numbers


@pytest.mark.parametrize("sides", [(192, 192), (100, 7), (2, 2)])
def test_coarse_comes_first_and_every_cell_once(sides):
    chart = Chart.read(wish(x=("h", 0.0, 1.0, sides[0]), y=("f", 0.0, 1.0, sides[1])))
    order = chart.order
    assert np.array_equal(np.sort(order), np.arange(sides[0] * sides[1]))
    # After the first ones each cell is at most half a coarse one away from one that is known.
    rows, columns = np.divmod(order[: 24 * 24], sides[0])
    step = max(1, 2 ** math.ceil(math.log2(max(sides) / 24)))
    first = min(24 * 24, -(-sides[0] // step) * -(-sides[1] // step))
    assert not (rows[:first] % step).any() and not (columns[:first] % step).any()


def test_a_chart_comes_to_the_browser_piece_by_piece_and_whole():
    page = Page()
    given = wish(x=("h", -0.9, 2.0, 40), y=("f", -1.5, 1.5, 30))
    head, values, status = page.all_of(given)
    expected, ends = whole(Chart.read(given))
    assert np.array_equal(values, expected.ravel(), equal_nan=True) and np.array_equal(status, ends.ravel())
    assert (head["done"], head["of"], head["reason"], head["level"]) == (1200, 1200, "", "standard")
    assert head["x"] == ["h", -0.9, 2.0, 40]
    assert len(page.told) >= 3
    # Cells already sent to the browser are not kept.
    head = page.send({"chart": {"more": 0, "id": 7}})
    assert head == {"id": 7, "reason": "", "running": False, "cells": 0}


def test_why_a_cell_has_no_number_is_said():
    page = Page()
    head = page.send({"chart": {"why": wish(), "at": [0.5, 1.5]}})
    assert head["why"] == "no such motion." and head["at"] == [0.5, 1.5]
    given = wish("scene=kharlamova", "period", ("q1", -1, 9, 3), ("q2", -1, 1, 3))
    head = page.send({"chart": {"why": given, "at": [9, 0]}})
    assert "is outside the ellipse" in head["why"]
    assert "choose a start inside it" in head["why"]
    # Nobody can click beyond the sides: there the nearest cell answers, and no number of the sentence is infinite.
    far, edge = (page.send({"chart": {"why": given, "at": [x, 0.0]}})["why"] for x in (1e300, given["x"][2]))
    assert far == edge


@pytest.mark.parametrize(
    "given, said",
    [
        ({}, "needs the link of a state"),
        (wish(state="scene=suslov-hess&h=1" + "0" * MAX_QUERY), "needs the link of a state"),
        (wish(quantity=["h"]), "can be charted"),
        (wish(part=1), "has 1 numbers"),
        (wish(x=("h", 0.0, "1", 9)), "A side is one of"),
        (wish("scene=suslov", "megno-suslov", x=("starts:2", 0.0, 1.0, 9)), "A side is one of .*starts:0, starts:1"),
        (wish(x=("h", 0.0, 1.0, 9.5)), "A side is one of"),
        (wish(x=("h", math.nan, 1.0, 9)), "must be two numbers"),
        (wish(x=("h", 0.0, 10**400, 9)), "must be two numbers"),
        (wish(x=("h", 1.0, 1.0, 9)), "two different numbers"),
        (wish(x=("f", 0.0, 1.0, 9)), "Both axes are f"),
    ],
)
def test_nothing_that_comes_from_outside_is_believed(given, said):
    with pytest.raises(InvalidParameter, match=said):
        Chart.read(given)
    page = Page()
    head = page.send({"chart": {"start": given, "id": 1}})
    assert re.search(said, head["reason"]) and head["running"] is False and "of" not in head


def test_numbers_are_clamped_and_turned_round():
    chart = Chart.read(
        wish("scene=suslov-hess&I22=1e9&h=nonsense", x=("h", 1e9, -5.0, 10**9), y=("f", -1e300, 1e300, -4))
    )
    assert chart.x.low == approx(-1.0, abs=1e-8) and (chart.x.high, chart.x.count) == (1e6, MOST_SIDE)
    assert (chart.y.low, chart.y.high, chart.y.count) == (-1e4, 1e4, 2)
    assert chart.values["I22"] == 1000.0
    assert chart.level is level("standard")


@pytest.fixture
def slow(monkeypatch):
    """Make every cell wait until it is released; return the semaphores (let, begun)."""
    let, begun = threading.Semaphore(0), threading.Semaphore(0)
    plain = Chart.compute

    def compute(self, indices):
        begun.release()
        assert let.acquire(timeout=60.0)
        return plain(self, indices)

    monkeypatch.setattr(Chart, "compute", compute)
    return let, begun


def test_stopped_it_stays_at_what_is_known_and_another_one_takes_its_place(slow):
    let, begun = slow
    page = Page()
    page.send({"chart": {"start": wish(), "id": 1}})
    let.release()
    assert begun.acquire(timeout=60.0) and begun.acquire(timeout=60.0)
    page.send({"chart": {"stop": True}})
    let.release(20)
    head = page.send({"chart": {"more": 0, "id": 1}})
    assert (head["running"], head["reason"]) == (False, "Stopped.") and 0 < head["cells"] < head["of"]
    # An answer to who asks for the one before would be taken for one about this.
    page.send({"chart": {"start": wish(), "id": 2}})
    assert page.send({"chart": {"more": 0, "id": 1}}) is None
    first = page.charts._charting
    assert first.running
    page.charts.end()
    assert not first.running and page.charts._charting is None
    let.release(20)


def test_it_takes_turns_with_what_others_wait_for(slow):
    let, begun = slow
    chart = Charting(Chart.read(wish()))
    assert begun.acquire(timeout=60.0)
    # While a piece of the chart is on its way, others get the other thread, and their turn between two of its pieces.
    ran = []
    other = Background()
    other.follow([Task(ran.append, (i,)) for i in range(5)])
    wait_until(lambda: let.release() or other.left == 0)
    assert sorted(ran) == [0, 1, 2, 3, 4]
    let.release(100)
    wait_until(lambda: not chart.running)
    assert chart.reason == ""


def test_a_chart_has_so_much_of_the_processor_and_says_so(monkeypatch):
    chart = Charting(
        Chart.read(
            wish(
                "scene=suslov&accuracy=draft&long=10000", "lyapunov-suslov", ("h", 0.5, 4.0, 64), ("I13", -0.4, 0.4, 64)
            )
        ),
        seconds=0.3,
    )
    wait_until(lambda: not chart.running)
    assert chart.reason == running.USED_UP
    where, values, status = chart.since(0)
    assert 0 < where.size < chart.chart.cells
    assert np.isfinite(values).all() and (status == Outcome.OK).all()


def test_a_fault_is_said_and_logged(monkeypatch, caplog):
    def broken(self, indices):
        raise RuntimeError("broken")

    monkeypatch.setattr(Chart, "compute", broken)
    chart = Charting(Chart.read(wish()))
    wait_until(lambda: not chart.running)
    assert chart.reason == running.FAILED and "a chart failed" in caplog.text


def test_a_fault_in_one_cell_is_of_this_cell_alone(monkeypatch, caplog):
    def arguments(state):
        if state.h > 1.9:
            raise RuntimeError("broken")
        return {"a": 0.5, "h": state.h, "f": state.f}

    chart = Chart.read(wish(x=("h", 1.2, 2.0, 3), y=("f", 0.1, 0.4, 2)))
    values, status = whole(Chart(chart.scene, chart.values, Charted("rotation-number", arguments), 0, chart.x, chart.y))
    assert (status[:, :2] == Outcome.OK).all() and (status[:, 2] == Outcome.FAILED).all()
    assert np.isnan(values[:, 2]).all() and "a cell of a sweep failed" in caplog.text


def test_the_part_of_a_quantity_that_has_several_numbers():
    alone = sweep("limit-cycles", over={"h": (1.3, 1.7, 3), "f": (0.3, 0.6, 2)}, level="standard", a=0.28 / 0.96)
    for i in range(3):
        given = wish(quantity="limit-cycles", part=i, x=("h", 1.3, 1.7, 3), y=("f", 0.3, 0.6, 2))
        assert np.array_equal(whole(Chart.read(given))[0], alone.limit_cycles.values[:, :, i].T)


def file_of(given, head, values, status):
    """Return the file that the page saves, see "static/controls/chart_file.js"."""
    sides = {side: dict(zip(("name", "low", "high", "count"), head[side], strict=True), symbol="s") for side in "xy"}
    what = QUANTITIES[given["quantity"]]
    return {
        "program": "hess-explorer chart",
        "title": what.title,
        "link": f"http://localhost/?{given['state']}",
        "scene": "suslov-hess",
        "state": given["state"],
        "quantity": what.name,
        "part": given["part"],
        "symbol": what.symbol,
        "units": what.units,
        "turn": what.turn,
        "level": head["level"],
        "error": head["error"],
        "version": head["version"],
        **sides,
        "values": [value if math.isfinite(value) else None for value in values.tolist()],
        "status": status.tolist(),
    }


def test_a_chart_that_was_saved_is_read_as_sweeps_are(tmp_path, capsys):
    given = wish("scene=suslov-hess&I22=0.8&I23=0.4&accuracy=precise")
    head, values, status = Page().all_of(given)
    assert head["error"] is None
    path = tmp_path / "chart.json"
    path.write_text(json.dumps(file_of(given, head, values, status)), encoding="utf-8")
    found = read(path)
    same = sweep("rotation-number", over={"h": (-0.9, 2.0, 9), "f": (-1.5, 1.5, 7)}, a=0.5)
    assert found.rotation_number.dims == same.rotation_number.dims
    for name in ("h", "f", "rotation_number", "status"):
        assert np.array_equal(found[name].values, same[name].values, equal_nan=True)
    assert found.rotation_number.attrs == same.rotation_number.attrs
    assert found.attrs["version"] == same.attrs["version"] and found.attrs["link"].endswith(given["state"])
    assert json.loads(found.attrs["parameters"])["I23"] == "0.4"
    assert explain(found, h=-0.9, f=1.5) == "no such motion."
    # By the command too.
    assert main(["sweep", "--read", str(path), "--format", "csv"]) == 0
    assert capsys.readouterr().out.count("\n") >= 63


@pytest.mark.parametrize(
    "change",
    [
        {"program": "a letter"},
        {"quantity": "speed"},
        {"status": [1] * 62 + [300]},
        {"values": ["x"] * 63},
        {"y": {"name": "f", "low": 0, "high": 1, "count": 10**9}},
        {"level": "sloppy"},
    ],
)
def test_a_file_that_is_no_whole_chart_is_refused(tmp_path, change):
    head, values, status = Page().all_of(wish())
    path = tmp_path / "chart.json"
    path.write_text(json.dumps({**file_of(wish(), head, values, status), **change}), encoding="utf-8")
    with pytest.raises(StoreError, match="not contain a complete chart: choose a file written by Save on the page"):
        read(path)
