"""Accuracy levels in the scenes: computations, status line, "auto", and the cost of all levels."""

import dataclasses
import re
import types
from math import nan

import numpy as np
import pytest
from pytest import approx

from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.scenes.framework.trial import Trial, bare_state, level_costs, section_error, sufficient_level
from hess_explorer.scenes.framework.work import AUTO
from hess_explorer.scenes.parts.orbits.costs import Costs
from hess_mechanics.dynamics.trade import LevelCost, truth_plan
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, PLANS, Kind
from support.thorough import sample
from support.view import View

SCENES = {name: scene for name, scene in scenes().items() if scene.origin is None}
SUSLOV = SCENES["suslov"]
SMALL = {"orbits": 12.0, "count": 120.0, "long": 50.0}


# ---- what is declared -------------------------------------------------------------------------------------------


CHEAP = [
    (name, trial)
    for name, scene in SCENES.items()
    for trial in scene.trials
    if trial.kind in (Kind.ORBIT, Kind.MAP, Kind.COLOURS)
]


@pytest.mark.parametrize("name, trial", sample(CHEAP, 6), ids=lambda one: getattr(one, "kind", one))
def test_a_finer_level_has_a_smaller_error(name, trial):
    state = bare_state(SCENES[name].of(SCENES[name].defaults()))
    errors = [one.error for one in level_costs(trial, state)]
    # The truth of an unstable motion is not known to more than 1e-4 pixels.
    assert errors[0] > 30.0 * errors[2] > 0.0
    # For colours `standard` has the tolerance of `draft`, and smaller cells.
    assert errors[0] >= 0.9 * errors[1]
    assert errors[0] < 1.0


# ---- sections ---------------------------------------------------------------------------------------------------


def test_the_status_line_says_up_to_which_crossing_the_orbit_is_where_it_is_drawn():
    """That it is right is in `test_estimates_of_pictures`."""
    found = {}
    for name in ("draft", "precise"):
        report = View(SUSLOV, {**SMALL, "accuracy": name}, seen=("section",)).report
        said = r"error below ½ pixel: chosen orbit up to crossing (\d+), others up to crossing (\d+)"
        found[name] = [*map(int, re.search(said, report.status).groups())]
    assert all(3 < draft < precise for draft, precise in zip(*found.values(), strict=True))


def test_orbits_that_chaos_takes_away_are_left_aside():
    regular = np.column_stack([np.linspace(0.0, 1.0, 50), np.zeros(50)])
    late = regular + np.column_stack([np.zeros(50), 1e-3 * np.arange(50)])
    lost = regular + np.column_stack([np.zeros(50), 1e-9 * np.exp(0.5 * np.arange(50))])
    assert section_error([late, regular], [regular, regular], (1.0, 1.0)) == approx(0.049)
    assert section_error([lost, late], [regular, regular], (1.0, 1.0)) == approx(0.049)
    # Without any orbit there is no error, not even 0.
    assert np.isnan(section_error([lost], [regular], (1.0, 1.0)))
    # From the first crossings on another one.
    assert np.isnan(section_error([regular + 40.0], [regular], (1.0, 1.0)))
    assert np.isnan(section_error([], [], (1.0, 1.0)))


def test_cells_are_measured_on_a_grid_twice_as_fine():
    """At `reference` the error was 0 %: the truth had the same cells."""
    scene = SCENES["quartic"]
    trial = next(one for one in scene.trials if one.kind == Kind.INDICATOR)
    state, plan = bare_state(scene.of(scene.defaults())), PLANS[Kind.INDICATOR]["reference"]
    cells = trial.run(state, plan)
    twice = trial.run(state, dataclasses.replace(plan, cells=2.0 * plan.cells))
    whole = np.mean(np.kron(cells, np.ones((2, 2))) != twice)
    assert whole > 0.05
    # A quarter of the finer cells, one in each.
    deviation = np.sqrt(whole * (1.0 - whole) / cells.size)
    measured = trial.error(state, cells, trial.run(state, truth_plan(Kind.INDICATOR)))
    assert measured == approx(100.0 * whole, abs=500.0 * deviation)


def test_the_status_line_says_how_exact_a_map_of_rotation_numbers_is():
    scene = SCENES["rotation-number"]
    errors = {}
    for name in ("draft", "standard", "precise"):
        report = View(scene, {"accuracy": name}, seen=("map",)).report
        said = re.search(r"map \d+ × \d+, error of ρ ≤ (\d\S+) in 99 % of the cells", report.status)
        errors[name] = float(said[1].replace("−", "-"))
        assert errors[name] <= PLANS[Kind.GRID][name].promise
    assert errors["draft"] > errors["standard"] > errors["precise"] > 0.0


# ---- auto -------------------------------------------------------------------------------------------------------


def test_auto_is_the_cheapest_level_that_is_right_to_half_a_pixel():
    scene = SCENES["suslov-hess"]
    view = View(scene, {"accuracy": AUTO}, seen=("omega",))
    (orbit,) = [trial for trial in scene.trials if not trial.pictures]
    assert sufficient_level(orbit, bare_state(view.result)) == "draft"
    assert view.report.status.startswith("draft: orbit")
    assert "auto: draft · " in view.report.status
    # Half as many cells in the diagram are seen, so that is not enough for it.
    view = View(scene, {"accuracy": AUTO}, seen=("omega", "bifurcation"))
    assert view.result.level.name == "standard"
    assert "auto: standard · " in view.report.status


def test_until_it_is_measured_auto_is_standard():
    scene = SCENES["kharlamova"]
    values = {**scene.defaults(), "accuracy": AUTO, "span": scene.defaults()["span"] + 0.125}
    state = scene.compute(values, scene.open_pictures, False)
    report = Stage(scene, Wire()).show(state, False)
    assert state.level.name == "standard"
    assert "auto: standard until it is measured" in report.status
    assert len(report.todo) == 1


def test_what_cannot_be_computed_is_measured_as_standard():
    def refuse(state, plan):
        raise InvalidParameter("No.")

    assert sufficient_level(Trial(Kind.MAP, (), refuse, lambda *_: 0.0), None) == "standard"


# ---- the cost of all --------------------------------------------------------------------------------------------


def test_the_cost_of_all_is_measured_when_its_picture_is_unfolded():
    scene = scenes()["scattering-accuracy"]
    assert {view.name: view.button for view in scene.views if view.button} == {"trade": "Measure all computations"}
    # A scene that computes only its motion has no such picture.
    assert "trade" not in scenes()["kharlamova-accuracy"].pictures
    view = View(scene, {}, seen=("trade",))
    trial = next(one for one in view.result.trials if one.kind == Kind.MAP)
    samples = view.result.costs.samples[trial]
    errors, ms = view.result.costs.curves[trial]
    assert errors == approx([max(2.0 * one.error, 1e-9) for one in samples])
    assert ms == approx([one.ms for one in samples])
    assert any(row.startswith("map: ") and row.endswith(" pixels") for row in view.report.quantities)
    # A draft of the map has a quarter of the cells: it is right, but not all.
    assert samples[0].error < 0.5
    assert view.result.costs.caption().numbers == "Cheapest levels without a visible error: orbit draft, map standard."


def section_costs(error):
    """Return the costs of a section whose error is the same at all levels."""
    trial = next(one for one in SUSLOV.trials if one.kind == Kind.SECTION)
    costs = tuple(LevelCost(name, 1.0, error, True) for name in LEVELS)
    work = types.SimpleNamespace(is_preview=False, need=lambda *_, **__: costs)
    return Costs(work, bare_state(SUSLOV.of(SUSLOV.defaults())), (trial,))


def test_an_error_that_stays_visible_is_said_and_no_level_recommended():
    found = section_costs(1e3)
    assert (found.caption().numbers, found.rings()) == ("Section has a visible error at every level.", [])
    assert section_costs(0.0).caption().numbers == "Cheapest levels without a visible error: section draft."


def test_a_chaotic_section_has_no_error_and_says_so():
    found = section_costs(nan)
    assert found.caption().numbers == "Section has no error to measure: everything is chaotic, or nothing is drawn."
    assert (found.curves, found.rings(), found.level("draft"), [*found.rows()]) == ({}, [], None, [])


def test_what_is_too_large_to_be_measured_says_so():
    view = View(scenes()["singular-measures-accuracy"], {"h": 60.0, "span": 200.0}, seen=("trade",))
    why = "In this time the cloud moves too fast for 30 frames: choose a time span below "
    assert view.result.costs.caption().numbers.startswith(f"Cloud cannot be measured: {why}")
    assert view.report.todo == ()
