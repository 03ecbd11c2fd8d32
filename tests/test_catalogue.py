"""Everything in the catalogue, in each way in which it can be used: Python, command, sweep, chart and trade."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import hess_mechanics
from hess_explorer.__main__ import main
from hess_explorer.compute.cells import Outcome, evaluate
from hess_explorer.sweep import sweep
from hess_mechanics import LEVELS, level
from hess_mechanics.catalogue import NoValue, catalogue, computations_of, find
from hess_mechanics.errors import InvalidParameter
from support.henon_heiles import SYSTEM

SWING = replace(SYSTEM, example=(0.0, 0.1, 0.35, 0.05))
OWN = dict(computations_of(SWING))
# The periodic orbit near its example is elliptic.
del OWN["manifold henon-heiles-section"]
EVERY = {**catalogue(), **OWN}
# Takes a minute; the other sections have the same computation.
del EVERY["dynamics plane-potential-section"]


def covering(keys):
    """Some of the keys, in which each computation and each system occurs at least once."""
    found, there = [], set()
    for key in sorted(keys, key=lambda key: "suslov-section" not in key):
        if not there.issuperset(key.split()):
            found.append(key)
            there.update(key.split())
    return found


SOME = covering(catalogue())


def values_of(of, result):
    """The numbers of a result by name, None where it has none."""
    found = {}
    for name, number in of.numbers.items():
        try:
            found[name] = number.read(result)
        except NoValue:
            found[name] = None
    return found


@pytest.fixture(scope="module")
def drafted():
    """The result of the example of each computation at `draft`, computed once."""
    known = {}

    def result(key):
        if key not in known:
            known[key] = EVERY[key].compute(EVERY[key].example, "draft")
        return known[key]

    return result


@pytest.mark.parametrize("key", EVERY)
def test_in_python_it_returns_a_labelled_result_with_its_numbers(key, drafted):
    of, found = EVERY[key], drafted(key)
    labels = found.labels()
    assert labels.variables or labels.facts
    numbers = [value for value in values_of(of, found).values() if value is not None]
    assert numbers
    assert all(map(math.isfinite, numbers))


def test_every_function_is_public():
    assert {of.function.__name__ for of in catalogue().values()} <= set(hess_mechanics.__all__)


@pytest.mark.parametrize("key", SOME)
def test_the_command_prints_the_same_numbers(key, drafted, capsys):
    of = find(key)
    options = [f"--{name}={value}" for name, value in of.example.items()]
    assert main([*key.split(), *options, "--accuracy", "draft", "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["numbers"] == values_of(of, drafted(key))


@pytest.mark.parametrize("key", SOME)
def test_a_sweep_and_the_cells_of_a_chart_hold_the_same_number(key, drafted):
    of = find(key)
    name, number = next(iter(of.numbers.items()))
    exact = number.read(drafted(key))
    given = {each: value for each, value in of.example.items() if not isinstance(value, str)}
    last = of.parameters[-1].name
    over = {last: [of.values(given)[last]]}
    found = sweep(key, over, numbers=[name], accuracy="draft", **{each: given[each] for each in given if each != last})
    assert found[name.replace("-", "_")].values.item() == exact
    # A chart is over two parameters, the first cell of this one is the example.
    first, second = of.parameters[:2]
    columns = {each: np.full(4, float(value)) for each, value in given.items()}
    for side, at in ((first, [0, 0, 1, 1]), (second, [0, 1, 0, 1])):
        columns[side.name] = np.array([of.values(given)[side.name], 1.01 * side.default + 0.01])[at]
    cells = evaluate(of, [name], columns, level("draft"))
    assert cells.values[name][0] == exact
    assert Outcome.NOT_COMPUTED not in cells.status
    assert Outcome.FAILED not in cells.status


@pytest.mark.parametrize("key", SOME)
def test_the_trade_has_cost_and_error_of_each_level(key):
    of = find(key)
    found = of.trade(of.example)
    assert [one.level for one in found] == [*LEVELS]
    assert all(one.ms > 0.0 for one in found)
    assert all(one.error >= 0.0 for one in found if one.is_measured)


# ---- what is refused ---------------------------------------------------------------------------------------------


def test_a_name_that_is_not_there_is_answered_with_those_that_are_close():
    of = find("circle-map")
    for call, said in (
        (lambda: find("circel-map"), "circle-map"),
        (lambda: of.values({"b": 1.0}), "has no parameter 'b'; choose from a, h, f"),
        (lambda: of.number("rho"), "has no number 'rho'; choose from rotation-number"),
        (lambda: find("branch suslov-section").values({"parameter": "I33"}), r"parameter = 'I33': choose one of I11, "),
    ):
        with pytest.raises(InvalidParameter, match=said):
            call()


def test_a_cell_says_why_it_has_no_number_and_the_others_stay():
    of = find("circle-map")
    columns = {
        "a": np.full(5, 0.5),
        "h": np.array([1.5, -2.0, 1.0, 1.5, 0.2]),
        "f": np.array([0.6, 0.0, 0.0, 9.0, 0.6]),
    }
    both = evaluate(of, ["trace", "stable"], columns, level("draft"))
    at_once = evaluate(of, ["trace"], columns, level("draft"))
    assert at_once.status.tolist() == both.status.tolist()
    assert [Outcome(one).words for one in both.status] == ["ok", "no such motion", "separatrix", "no such motion", "ok"]
    assert np.isfinite(both.values["trace"]).tolist() == [True, False, False, False, True]
    # The last torus has no limit cycle, but a trace: it is not without a value.
    assert np.isnan(both.values["stable"]).tolist() == [False, True, True, True, True]
    assert "no pair of limit cycles" in both.reasons[4]
    assert at_once.values["trace"][0] == pytest.approx(both.values["trace"][0], rel=1e-9)
