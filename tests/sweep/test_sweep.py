"""`sweep`: pieces of any size, failing cells, progress, stopping, and a one-sentence message for every error."""

import signal
import sys
import threading

import numpy as np
import pytest

from hess_explorer.sweep import QUANTITIES, Interrupted, MissingLibrary, Outcome, Quantity, explain, sweep
from hess_explorer.sweep import run as running
from hess_explorer.sweep.quantity import CellResults
from hess_mechanics.errors import InvalidParameter, ModelError, NoField, WorkLimit
from hess_mechanics.parameters import Parameter

TORI = {"h": (-1.2, 2.0, 12), "f": (0.0, 1.2, 9)}


@pytest.fixture
def in_pieces(monkeypatch):
    """Use pieces of about this many cells."""

    def choose(cells):
        monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: cells)

    return choose


def own(compute, parts=()):
    """A quantity that exists only here, of x and y."""
    x, y = (Parameter(name, name, name, 0.0, (-1.0, 1.0), 0.1, (-10.0, 10.0), "A number.") for name in "xy")
    return Quantity("own", "q", "A quantity of this test", "1", "of x and y", (x, y), compute, parts)


def test_values_do_not_depend_on_the_pieces(in_pieces):
    whole = sweep("rotation-number", TORI, a=0.5)
    in_pieces(7)
    assert sweep("rotation-number", TORI, a=0.5).identical(whole)


def test_a_cell_without_a_number_says_why():
    found = sweep("rotation-number", {"h": [-2.0, 1.0, 1.5], "f": [0.0, 9.0]}, a=0.5)
    assert found.status.values.tolist() == [[10, 10], [11, 10], [1, 10]]
    assert np.array_equal(np.isnan(found.rotation_number.values), found.status.values >= 10)
    assert explain(found, h=-2.0, f=0.0) == "no such motion."
    assert explain(found, h=1.5, f=0.0) == "ok."
    cycles = sweep("limit-cycles", {"h": [1.0, 0.2]}, a=0.5, f=0.0)
    assert "separatrix" in explain(cycles, h=1.0).lower()
    assert "elliptic" in explain(cycles, h=0.2) or "two limit cycles" in explain(cycles, h=0.2)
    with pytest.raises(InvalidParameter, match="the coordinates h: give all"):
        explain(cycles, f=0.0)
    with pytest.raises(ModelError, match="not the result of a sweep"):
        explain(cycles.drop_attrs(), h=1.0)


def test_one_bad_cell_does_not_spoil_the_others(monkeypatch, caplog):
    def compute(cells, accuracy):
        x, y = cells["x"], cells["y"]
        if np.any(x == 3.0):
            raise NoField("x = 3 has no field.")
        if np.any((x == 4.0) & (y == 1.0)):
            raise RuntimeError("a mistake in a program")
        with np.errstate(divide="ignore"):
            return CellResults(1.0 / y + x, np.full(x.size, np.nan), np.ones(x.size, np.uint8))

    monkeypatch.setitem(QUANTITIES, "own", own(compute))
    found = sweep("own", {"x": (0.0, 5.0, 6), "y": [0.0, 1.0]})
    wanted = np.ones((6, 2), int)
    wanted[:, 0], wanted[3], wanted[4] = Outcome.BEYOND_RANGE, Outcome.NO_FIELD, (Outcome.BEYOND_RANGE, Outcome.FAILED)
    assert np.array_equal(found.status, wanted)
    assert found.own.values[[0, 1, 2, 5], 1].tolist() == [1.0, 2.0, 3.0, 6.0]
    assert explain(found, x=3.0, y=1.0) == "x = 3 has no field."
    assert "a mistake in a program" in explain(found, x=4.0, y=1.0)
    assert "a cell of a sweep failed" in caplog.text


def test_a_trace_beyond_double_range_is_no_silent_number():
    found = sweep("trace", {"a": [0.5, 500.0]}, h=1.5, f=0.6)
    assert found.status.values.tolist() == [Outcome.OK, Outcome.BEYOND_RANGE]


def test_progress_says_what_is_left(in_pieces):
    in_pieces(20)
    seen = []
    sweep("rotation-number", TORI, a=0.5, progress=seen.append)
    assert [one.done for one in seen] == sorted(one.done for one in seen)
    assert (seen[0].done, seen[0].left) == (0, None)
    assert (seen[-1].done, seen[-1].cells, seen[-1].left) == (108, 108, 0.0)
    middle = seen[len(seen) // 2]
    assert middle.left == pytest.approx(middle.seconds * (108 - middle.done) / middle.done)


def test_what_is_done_is_returned_when_it_is_stopped(in_pieces):
    in_pieces(20)
    whole = sweep("rotation-number", TORI, a=0.5)
    stop = threading.Event()
    part = sweep("rotation-number", TORI, a=0.5, stop=stop, progress=lambda now: now.done and stop.set())
    done = part.status.values > 0
    assert 0 < done.sum() < 108
    assert np.array_equal(part.rotation_number.values[done], whole.rotation_number.values[done], equal_nan=True)
    assert np.isnan(part.rotation_number.values[~done]).all()


def test_the_first_ctrl_c_lets_the_piece_end_and_the_handler_is_what_it_was(in_pieces):
    in_pieces(20)
    before = signal.getsignal(signal.SIGINT)
    seen = []

    def press(now):
        seen.append(now.done)
        signal.raise_signal(signal.SIGINT)

    # Before the first piece: it is computed no more.
    with pytest.raises(Interrupted, match=r"stopped after 0 of 108 cells\."):
        sweep("rotation-number", TORI, a=0.5, progress=press)
    assert seen == [0]
    # The second one does not wait.
    with pytest.raises(KeyboardInterrupt):
        sweep("rotation-number", TORI, a=0.5, progress=lambda now: (press(now), press(now)))
    assert seen == [0, 0, 0]
    assert signal.getsignal(signal.SIGINT) is before
    # Elsewhere than in the main thread there are no signals.
    found = []
    thread = threading.Thread(target=lambda: found.append(sweep("rotation-number", TORI, a=0.5)))
    thread.start()
    thread.join()
    assert found[0].status.all()


WRONG = [
    (("speed", {"h": [1.0]}, {}), "There is no quantity 'speed'; choose from rotation-number"),
    (("rotation-number", {"h": [1.0], "f": [0.1]}, {"h": 1.0, "a": 0.5}), "h is both swept and fixed"),
    (("rotation-number", {"h": (0.0, 1.0, 1)}, {"a": 0.5, "f": 0.1}), "has 1 values: choose 2 or more"),
    (("rotation-number", {}, {}), "one to 3 parameters, not 0"),
    (("rotation-number", {"h": ["x"]}, {"a": 0.5, "f": 0.1}), "must all be numbers"),
    (("rotation-number", {"h": [1.0, 1.0]}, {"a": 0.5, "f": 0.1}), "occurs twice"),
    (("rotation-number", {"h": [np.nan]}, {"a": 0.5, "f": 0.1}), "h = nan is not between"),
    (("rotation-number", {"h": [1.0]}, {"a": 1e9, "f": 0.1}), "a = 1e9 is not between -1000 and 1000"),
    (("crossings-suslov", {"variable": [1.5]}, {}), "variable = 1.5 is not a whole number between 1 and 5"),
    (("rotation-number", {"h": [1.0]}, {"a": 0.5, "f": 0.1, "workers": "many"}), "not the address of a Dask scheduler"),
    (("cos-chi", None, {}), "over = None is not a mapping"),
    (("cos-chi", {"I11": [10**400]}, {}), "must all be numbers"),
    (("cos-chi", {"I11": (1, 10**400, 3)}, {}), "I11 is not a finite number"),
    (("cos-chi", {"I11": [1.0]}, {"I22": 10**400}), "I22 is not a finite number"),
    (("cos-chi", {"I11": [1.0]}, {"store": 3}), "3 is not the name of a folder"),
    (("cos-chi", {"I11": [1.0]}, {"part": 3, "store": "x"}), "part = 3 is not a sequence of 2"),
    (("cos-chi", {"I11": [1.0]}, {"most_cells": "all"}), "most_cells = 'all' is not a number"),
    (("cos-chi", {"I11": [1.0]}, {"progress": "yes"}), "progress = 'yes' is not a function"),
]


@pytest.mark.parametrize("request_, said", WRONG, ids=[said[:30] for _, said in WRONG])
def test_what_is_wrong_is_one_sentence(request_, said):
    name, over, fixed = request_
    with pytest.raises(InvalidParameter, match=said):
        sweep(name, over, **fixed)


def test_work_is_capped_before_anything_is_made():
    huge = {"h": (0.0, 1.0, 10**6), "f": (0.0, 1.0, 10**6)}
    with pytest.raises(WorkLimit, match=r"1000000000000 numbers; at most 10000000 are allowed.*most_cells"):
        sweep("rotation-number", huge, a=0.5)
    with pytest.raises(WorkLimit, match="most_cells must lie between 1 and 1e\\+10"):
        sweep("rotation-number", huge, a=0.5, most_cells=10**13)
    # Three numbers at a cell count as three.
    with pytest.raises(WorkLimit, match="The sweep has 30 numbers"):
        sweep("limit-cycles", {"h": (0.0, 1.0, 10)}, a=0.5, f=0.1, most_cells=20)


@pytest.mark.parametrize("library, workers", [("xarray", None), ("zarr", None), ("distributed", "tcp://127.0.0.1:9")])
def test_a_library_that_is_missing_is_named_with_the_command_that_installs_it(monkeypatch, library, workers):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingLibrary, match=r"pip install 'hess-explorer\[sweep\]'"):
        sweep("rotation-number", TORI, a=0.5, workers=workers)
