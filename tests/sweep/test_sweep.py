"""`sweep`: numbers of the catalogue in pieces of any size, failing cells, progress, and one-sentence errors."""

import sys

import pytest

from hess_explorer.sweep import MissingLibrary, Outcome, explain, sweep
from hess_mechanics.catalogue import find
from hess_mechanics.errors import InvalidParameter, WorkLimit


def test_values_are_those_of_the_computation_whatever_the_pieces(tori, in_pieces):
    numbers = ("trace", "rotation-number", "stable")
    whole = tori(numbers=numbers)
    in_pieces(7)
    assert tori(numbers=numbers).identical(whole)
    assert list(whole.data_vars) == ["trace", "rotation_number", "stable", "status"]
    alone = find("circle-map").compute({"a": 0.5, **{name: float(whole[name][5]) for name in "hf"}})
    here = whole.isel(h=5, f=5)
    assert (whole.h[0], whole.h[-1]) == (-1.2, 2.0)
    assert (float(here.trace), float(here.rotation_number)) == (alone.of.trace, alone.of.rotation_number)
    assert (whole.trace.attrs["symbol"], whole.h.attrs["units"]) == ("|t|", "1")


def test_a_number_with_an_estimate_and_the_name_of_an_axis():
    found = sweep("orbit suslov", {"w1": [0.2, 0.8]}, numbers=("w1", "w2"), duration=2.0)
    orbit = find("orbit suslov").compute({"w1": 0.2, "duration": 2.0})
    assert list(found.data_vars) == ["w1_value", "w1_value_error", "w2", "w2_error", "status"]
    assert found.w1_value.values[0] == orbit.states[-1, 0]
    assert found.w2_error.values[0] == orbit.error_estimate
    assert list(sweep("orbit suslov", {"duration": [1.0, 2.0]}).data_vars) == ["w1", "w1_error", "status"]


def test_a_cell_without_a_number_says_why():
    found = sweep("circle-map", {"h": [-2.0, 1.0, 1.5], "f": [0.0, 9.0]}, a=0.5)
    assert found.status.values.tolist() == [[10, 10], [11, 10], [1, 10]]
    assert (explain(found, h=-2.0, f=0.0), explain(found, h=1.5, f=0.0)) == ("no such motion.", "ok.")
    cycles = sweep("circle-map", {"h": [0.2]}, numbers=["stable"], a=0.5, f=0.0)
    assert "no pair of limit cycles" in explain(cycles, h=0.2)
    steep = sweep("circle-map", {"a": [500.0]}, numbers=["trace"], h=1.5, f=0.6)
    assert steep.status.item() == Outcome.BEYOND_RANGE
    with pytest.raises(InvalidParameter, match="pass values of"):
        explain(cycles, f=0.0)


def test_progress_says_what_is_left(tori, in_pieces):
    in_pieces(20)
    seen = []
    tori(progress=seen.append)
    assert (seen[0].done, seen[0].remaining) == (0, None)
    assert (seen[-1].done, seen[-1].cells, seen[-1].remaining) == (108, 108, 0.0)
    middle = seen[len(seen) // 2]
    assert middle.remaining == pytest.approx(middle.seconds * (108 - middle.done) / middle.done)


WRONG = [
    ({"computation": "speed"}, "There is no computation 'speed'"),
    ({"numbers": ("speed",)}, "circle-map has no number 'speed'; choose from rotation-number"),
    ({"h": 1.0}, "h is both swept and fixed"),
    ({"over": {}}, "map one to 3 parameters"),
    ({"over": {"h": [1.0, 1.0]}}, "one or more different numbers"),
    ({"workers": "many"}, "workers = 'many'"),
    ({"over": {"h": (0.0, 1.0, 10**6), "f": (0.0, 1.0, 10**6)}}, "1000000000000 cells, but at most 10000000"),
]


@pytest.mark.parametrize("change, said", WRONG, ids=[said[:30] for _, said in WRONG])
def test_what_is_wrong_is_one_sentence(tori, change, said):
    with pytest.raises((InvalidParameter, WorkLimit), match=said):
        tori(**change)


def test_a_library_that_is_missing_is_named_with_the_command_that_installs_it(monkeypatch, tori):
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(MissingLibrary, match=r"pip install 'hess-explorer\[sweep\]'"):
        tori()
