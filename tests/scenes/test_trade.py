"""Accuracy levels in the scenes: computations, status line, "auto", and the cost of all levels."""

import dataclasses
import re
import types
from math import nan

import numpy as np
import pytest
from pytest import approx

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import decode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.scenes.framework.trial import Trial, bare, needed, section_error
from hess_explorer.scenes.framework.work import AUTO
from hess_explorer.scenes.parts.costs import Costs
from hess_mechanics.dynamics.cells import centres
from hess_mechanics.dynamics.trade import LevelCost, beyond
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, Kind
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.thorough import sample

SCENES = {name: scene for name, scene in scenes().items() if scene.origin is None}
SUSLOV = SCENES["suslov"]
SMALL = {"orbits": 12.0, "count": 120.0, "long": 50.0}


def completed(scene, values, seen):
    """The state when all that waits is computed, and its report."""
    for _ in range(5):
        state = scene.compute({**scene.defaults(), **values}, seen, False)
        report = Stage(scene, Wire()).show(state, False)
        if not report.todo:
            return state, report
        for task in report.todo:
            CACHE.get(task.function, *task.arguments)
    raise AssertionError(report.todo)


# ---- what is declared -------------------------------------------------------------------------------------------


CHEAP = [
    (name, trial)
    for name, scene in SCENES.items()
    for trial in scene.trials
    if trial.kind in (Kind.ORBIT, Kind.MAP, Kind.COLOURS)
]


@pytest.mark.parametrize("name, trial", sample(CHEAP, 6), ids=lambda one: getattr(one, "kind", one))
def test_a_finer_level_has_a_smaller_error(name, trial):
    state = bare(SCENES[name].of(SCENES[name].defaults()))
    truth = trial.run(state, dataclasses.replace(PLANS[trial.kind]["reference"], level=REFERENCE.tightened()))
    errors = [trial.error(state, trial.run(state, plan), truth) for plan in PLANS[trial.kind].values()]
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
        _, report = completed(SUSLOV, {**SMALL, "accuracy": name}, ("section",))
        said = r"right to ½ pixel: the chosen orbit up to crossing (\d+), others up to crossing (\d+)"
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
    state, plan = bare(scene.of(scene.defaults())), PLANS[Kind.INDICATOR]["reference"]
    cells = trial.run(state, plan)
    twice = trial.run(state, dataclasses.replace(plan, cells=2.0 * plan.cells))
    whole = np.mean(np.kron(cells, np.ones((2, 2))) != twice)
    assert whole > 0.05
    # A quarter of the finer cells, one in each.
    deviation = np.sqrt(whole * (1.0 - whole) / cells.size)
    measured = trial.error(state, cells, trial.run(state, beyond(Kind.INDICATOR)))
    assert measured == approx(100.0 * whole, abs=500.0 * deviation)


def test_the_status_line_says_how_exact_a_map_of_rotation_numbers_is():
    scene = SCENES["rotation-number"]
    errors = {}
    for name in ("draft", "standard", "precise"):
        _, report = completed(scene, {"accuracy": name}, ("map",))
        said = re.search(r"map \d+ × \d+, ρ to (\d\S+) \(99 of 100 cells\)", report.status)
        errors[name] = float(said[1].replace("−", "-"))
        assert errors[name] <= PLANS[Kind.GRID][name].promise
    assert errors["draft"] > errors["standard"] > errors["precise"] > 0.0


# ---- auto -------------------------------------------------------------------------------------------------------


def test_auto_is_the_cheapest_level_that_is_right_to_half_a_pixel():
    scene = SCENES["suslov-hess"]
    state, report = completed(scene, {"accuracy": AUTO}, ("omega",))
    (orbit,) = [trial for trial in scene.trials if not trial.pictures]
    assert needed(orbit, bare(state)) == "draft"
    assert report.status.startswith("draft: orbit")
    assert "auto: draft · " in report.status
    # Half as many cells in the diagram are seen, so that is not enough for it.
    state, report = completed(scene, {"accuracy": AUTO}, ("omega", "bifurcation"))
    assert state.level.name == "standard"
    assert "auto: standard · " in report.status


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

    assert needed(Trial(Kind.MAP, (), refuse, lambda *_: 0.0, refuse), None) == "standard"


# ---- the cost of all --------------------------------------------------------------------------------------------


def test_the_cost_of_all_is_measured_when_its_picture_is_unfolded():
    scene = scenes()["scattering-accuracy"]
    assert scene.folded == {"trade": "Measure all that is computed", "difference": "Show what more accuracy changes"}
    state, report = completed(scene, {}, ("trade",))
    trial = next(one for one in state.trials if one.kind == Kind.MAP)
    samples = state.costs.samples[trial]
    errors, ms = state.costs.curve(trial)
    assert errors == approx([max(2.0 * one.error, 1e-9) for one in samples])
    assert ms == approx([one.ms for one in samples])
    assert any(row.startswith("map: ") and row.endswith(" pixels") for row in report.derived)
    # A draft of the map has a quarter of the cells: it is right, but not all.
    assert samples[0].error < 0.5
    assert state.costs.about().numbers == "Cheapest levels without a visible error: orbit draft, map standard."


def test_a_chaotic_section_has_no_error_and_says_so():
    trial = next(one for one in SUSLOV.trials if one.kind == Kind.SECTION)
    costs = tuple(LevelCost(name, 1.0, nan, True) for name in LEVELS)
    work = types.SimpleNamespace(dragging=False, later=lambda *_: costs)
    found = Costs(work, bare(SUSLOV.of(SUSLOV.defaults())), (trial,))
    assert found.about().numbers == "Section has no error to measure: all of it is chaotic, or there is nothing."
    assert (found.curve(trial), found.rings(), found.level("draft"), [*found.rows()]) == (None, [], None, [])


def test_what_is_too_large_to_be_measured_or_compared_says_so_and_leaves_no_axes_of_before():
    scene, stage = scenes()["singular-measures-accuracy"], Stage(scenes()["singular-measures-accuracy"], Wire())

    def shown(**values):
        for _ in range(2):
            state = scene.compute({**scene.defaults(), **values}, ("trade", "difference"), False)
            report = stage.show(state, False)
            for task in report.todo:
                CACHE.get(task.function, *task.arguments)
        return state, report, stage.wire.pack()[0]["ranges"]["difference"]

    assert max(shown(points="1000", h=3.0)[2]) > 1.5
    state, report, axes = shown(h=60.0, span=200.0)
    why = "In this time the cloud turns too often for 30 frames: choose a time span below "
    assert state.costs.about().numbers.startswith(f"Cloud cannot be measured: {why}")
    assert state.comparison.about().numbers.startswith(why)
    assert state.comparison.message() == "The cloud cannot be compared"
    assert (report.todo, axes) == ((), [-1.0, 1.0, -1.0, 1.0])


# ---- what the next level changes ----------------------------------------------------------------------------------


def difference(name, kind, level, **values):
    """The state of "Speed and accuracy" with its difference picture, when that is known."""
    return completed(scenes()[f"{name}-accuracy"], {"difference": kind, "accuracy": level, **values}, ("difference",))


def test_the_cells_that_change_are_those_of_the_finer_grid_with_another_colour():
    scene, (state, _) = SCENES["rotation-number"], difference("rotation-number", "grid", "draft")
    axes = scene.of(scene.defaults()).window
    found = {}
    for name, (m, n) in (("draft", (150, 100)), ("standard", (300, 200))):
        h, f = np.meshgrid(*(centres(*axis, count) for axis, count in zip(axes, (m, n), strict=True)))
        values = values_at(0.5, h.ravel(), f.ravel(), LEVELS[name])
        # Locked tori have one tone, whatever ρ.
        shown = np.where(values.possible, np.where(values.locked, 9.0, values.rho), np.nan)
        found[name] = shown.reshape(n, m)
    coarse, fine = np.kron(found["draft"], np.ones((2, 2))), found["standard"]
    changed = (np.abs(coarse - fine) > 1.0 / 256.0) | (np.isnan(coarse) ^ np.isnan(fine))
    nothing = np.isnan(coarse) & np.isnan(fine)
    assert np.array_equal(state.comparison.found.cells, np.where(nothing, -1.0, changed))
    share = 100.0 * changed[~nothing].mean()
    assert 3.0 < share < 12.0
    assert float(re.search(r"([\d.]+) % of the cells change\.", state.comparison.about().verdict)[1]) == (
        approx(share, rel=0.05)
    )
    assert "difference" in scenes()["rotation-number-accuracy"].open_pictures


def test_of_a_regular_motion_nothing_moves():
    state, _ = difference("quartic", "section", "standard", ratio=1.0, h=0.6)
    assert len(state.comparison.found.changed) == len(state.comparison.found.lost) == 0
    assert len(state.comparison.found.same) > 4000
    assert state.comparison.about().verdict.startswith("Nothing moves by more than ")


def test_there_is_nothing_beyond_the_last_level_and_nothing_of_what_is_not_shown():
    state, report = difference("scattering", "map", "reference")
    assert state.comparison.found is None
    assert report.todo == ()
    assert state.comparison.about().words == "Nothing to compare with. No level is more accurate than reference."
    state, _ = difference("suslov", "basins", "draft")
    assert state.comparison.about().words == "The scene shows no basins now."
    scene = scenes()["scattering-accuracy"]
    held = scene.compute({**scene.defaults(), "accuracy": "draft"}, ("difference",), True)
    assert (held.comparison.found, held.comparison.about().words) == (None, "Compared when a slider is released.")


def test_what_is_compared_is_one_of_the_kinds_the_costliest_at_first():
    scene = scenes()["euler-poisson-accuracy"]
    assert scene.defaults()["difference"] == "rotation number"
    # Basins are shown only where they are asked for.
    assert scenes()["suslov-accuracy"].defaults()["difference"] == "section"
    values, notes = decode("v=1&difference=everything", scene.specs)
    assert values["difference"] == "rotation number"
    assert notes == [
        "What is compared must be one of orbit, section, indicator, exponent, rotation number: set to rotation number."
    ]
    admitted, notes = scene.admit({**scene.defaults(), "difference": "<b>"})
    assert admitted == scene.defaults()
    assert len(notes) == 1
    # A scene that computes only its motion has no such pictures.
    motion = scenes()["kharlamova-accuracy"]
    assert ("difference" in motion.defaults(), "trade" in motion.pictures) == (False, False)
