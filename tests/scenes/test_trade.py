"""Accuracy levels in the scenes: computations, status line, "auto", and the cost of all levels."""

import dataclasses
import re
from math import pi

import numpy as np
import pytest
from pytest import approx

from benchmarks.integrators.trade import Row, as_json, as_text, costliest, names
from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import decode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.scenes.framework.trial import Trial, bare, needed, section_error
from hess_explorer.scenes.framework.work import AUTO, Work, kept_status
from hess_mechanics.dynamics.trade import LevelCost
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, Computation
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.board import Browser

SCENES = {name: scene for name, scene in scenes().items() if scene.origin is None}
SUSLOV, QUARTIC = SCENES["suslov"], SCENES["quartic"]
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


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_every_scene_declares_what_it_computes(scene):
    assert scene.name in names()
    kinds = [trial.kind for trial in scene.trials]
    assert len(set(kinds)) == len(kinds) > 0
    for trial in scene.trials:
        assert set(trial.pictures) <= set(scene.pictures)


CHEAP = [
    (name, trial)
    for name, scene in SCENES.items()
    for trial in scene.trials
    if trial.kind in (Computation.ORBIT, Computation.MAP, Computation.COLOURS)
]


@pytest.mark.parametrize("name, trial", CHEAP, ids=[f"{name}-{trial.kind}" for name, trial in CHEAP])
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


def test_a_draft_follows_orbits_for_a_quarter_of_the_crossings():
    for scene, seen in ((SUSLOV, ("section",)), (QUARTIC, ("section",))):
        counts = {}
        for name in ("draft", "standard", "reference"):
            state, _ = completed(scene, {**(SMALL if scene is SUSLOV else {}), "accuracy": name}, seen)
            counts[name] = len(state.section.own)
        asked = 120 if scene is SUSLOV else 200
        assert counts == {"draft": asked // 4, "standard": asked, "reference": asked}


@pytest.mark.parametrize("name", ["draft", "standard", "precise"])
def test_the_status_line_says_up_to_which_crossing_the_orbit_is_where_it_is_drawn(name):
    state, report = completed(SUSLOV, {**SMALL, "accuracy": name}, ("section",))
    said = re.search(
        r"right to ½ pixel: the chosen orbit up to crossing (\d+), others up to crossing (\d+)", report.status
    )
    own, others = map(int, said.groups())
    plan = PLANS[Computation.SECTION]["reference"]
    exact = state.poincare.points([state.start], 60, True, plan.level, threads=1)
    both = min(len(state.section.own), 60)
    away = state.section.own[:both] - state.poincare.places_of(exact.states[0])[:both]
    away[:, 0] -= 2.0 * pi * np.round(away[:, 0] / (2.0 * pi))
    pixels = np.linalg.norm(away * [300.0 / pi, 600.0 / pi], axis=1)
    # The estimate of two runs: one crossing more or less.
    assert abs(int(np.flatnonzero(pixels > 0.5)[0]) - own) <= 1
    assert 3 < others < 60


def test_a_regular_orbit_is_right_to_the_end():
    _, report = completed(QUARTIC, {"ratio": 1.0, "h": 0.6}, ("section",))
    assert "right to ½ pixel: the chosen orbit to the end, others to the end (median)" in report.status


def test_the_words_for_a_section():
    assert [*kept_status(None, 200)] == []
    assert [*kept_status((200, None), 200)] == ["right to ½ pixel: the chosen orbit to the end"]
    assert [*kept_status((16, 200), 200)] == [
        "right to ½ pixel: the chosen orbit up to crossing 16, others to the end (median)"
    ]


def test_orbits_that_chaos_takes_away_are_left_aside():
    regular = np.column_stack([np.linspace(0.0, 1.0, 50), np.zeros(50)])
    late = regular + np.column_stack([np.zeros(50), 1e-3 * np.arange(50)])
    lost = regular + np.column_stack([np.zeros(50), 1e-9 * np.exp(0.5 * np.arange(50))])
    assert section_error([late, regular], [regular, regular], (1.0, 1.0)) == approx(0.049)
    assert section_error([lost, late], [regular, regular], (1.0, 1.0)) == approx(0.049)
    assert section_error([lost], [regular], (1.0, 1.0)) == 0.0
    # From the first crossings on another one.
    assert section_error([regular + 40.0], [regular], (1.0, 1.0)) == 0.0


def test_the_status_line_says_how_much_of_the_basins_hangs_on_their_cells():
    preset = next(one for one in SUSLOV.presets if one.values.get("colours") == "basins")
    values = {**SUSLOV.example(preset), **SMALL, "long": 1000.0, "accuracy": "draft"}
    state, report = completed(SUSLOV, values, ("section",))
    said = re.search(r"basins 256 × 256, twice as many cells would change ([\d.]+) % of it", report.status)
    finer, _ = completed(SUSLOV, {**values, "accuracy": "standard"}, ("section",))
    changed = 100.0 * np.mean(np.kron(state.basins.found.number, np.ones((2, 2))) != finer.basins.found.number)
    assert changed / 3.0 < float(said[1]) < 3.0 * changed


def test_the_status_line_says_how_exact_a_map_of_rotation_numbers_is():
    scene = SCENES["rotation-number"]
    errors = {}
    for name in ("draft", "standard", "precise"):
        _, report = completed(scene, {"accuracy": name}, ("map",))
        said = re.search(r"map \d+ × \d+, ρ to (\d\S+) \(99 of 100 cells\)", report.status)
        errors[name] = float(said[1].replace("−", "-"))
        assert errors[name] <= PLANS[Computation.GRID][name].promise
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
    state = scene.compute(values, scene.pictures, False)
    report = Stage(scene, Wire()).show(state, False)
    assert state.level.name == "standard"
    assert "auto: standard until it is measured" in report.status
    assert len(report.todo) == 1


def test_under_a_drag_auto_is_not_measured():
    scene = SCENES["kharlamova"]
    state = scene.compute({**scene.defaults(), "accuracy": AUTO}, scene.pictures, True)
    assert state.work.todo == []
    assert state.level.name == "draft"


def test_what_cannot_be_computed_is_measured_as_standard():
    def refuse(state, plan):
        raise InvalidParameter("No.")

    assert needed(Trial(Computation.MAP, (), refuse, lambda *_: 0.0, refuse), None) == "standard"


# ---- the cost of all --------------------------------------------------------------------------------------------


def test_the_cost_of_all_is_measured_when_its_picture_is_unfolded():
    scene = scenes()["scattering-accuracy"]
    assert scene.folded == {"trade": "Measure all that is computed", "difference": "Show what more accuracy changes"}
    state, report = completed(scene, {}, ("trade",))
    trial = next(one for one in state.trials if one.kind == Computation.MAP)
    samples = state.costs.samples[trial]
    errors, ms = state.costs.curve(trial)
    assert errors == approx([max(2.0 * one.error, 1e-9) for one in samples])
    assert ms == approx([one.ms for one in samples])
    assert any(row.startswith("map: ") and row.endswith(" pixels") for row in report.derived)
    # A draft of the map has a quarter of the cells: it is right, but not all.
    assert samples[0].error < 0.5
    assert state.costs.about().numbers == "Cheapest levels without a visible error: orbit draft, map standard."


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
        h, f = np.meshgrid(
            *(
                low + (high - low) * (np.arange(count) + 0.5) / count
                for (low, high), count in zip(axes, (m, n), strict=True)
            )
        )
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
    # More digits do not change these cells.
    state, _ = difference("rotation-number", "grid", "standard")
    assert state.comparison.about().verdict == "No cell changes."
    assert not state.comparison.found.cells.max()


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


def test_what_was_compared_is_remembered_when_one_comes_back():
    study = scenes()["rotation-number-accuracy"]
    browser, hidden = Browser(study), list({*study.pictures, *study.other.pictures})
    browser.ask(1, values={"difference": "line", "accuracy": "draft"}, hidden=hidden)
    browser.ask(2, scene="rotation-number", hidden=hidden)
    browser.ask(3, values={"h": 1.25}, hidden=hidden)
    browser.ask(4, scene="rotation-number-accuracy", hidden=hidden)
    assert {name: browser.session.values[name] for name in ("difference", "accuracy", "h")} == {
        "difference": "line",
        "accuracy": "draft",
        "h": 1.25,
    }


def test_the_error_of_a_cloud_is_measured_on_the_same_points():
    """Twice as far as another run says, at another tolerance and order; its own estimate is an independent bound."""
    scene = SCENES["singular-measures"]
    (trial,) = scene.trials
    state = bare(scene.of({**scene.defaults(), "points": "1000", "span": 6.0}))
    for name in ("draft", "standard"):
        found = trial.run(state, PLANS[Computation.CLOUD][name])
        cloud, exact = found.cloud, state.task(1000, LEVELS["reference"]).now().cloud
        radius = 300.0
        # 1.1 × the largest |ω| fits, in round steps, so a unit of ω is between 150 and 300 pixels over it.
        off = max(
            radius * np.linalg.norm(cloud.gamma - exact.gamma, axis=2).max(),
            radius / (1.1 * found.fastest) * np.linalg.norm(cloud.omega - exact.omega, axis=2).max(),
        )
        assert 0.5 * off < trial.error(state, found, None) <= 1.01 * off
        assert trial.error(state, found, None) < 20.0 * radius * cloud.error_estimate


# ---- tables -----------------------------------------------------------------------------------------------------


def test_a_row_is_a_line_of_the_table_and_an_entry_of_the_data_for_each_level_and_the_costliest_comes_first():
    levels = zip(LEVELS, (10.0, 20.0, 40.0, 60.0), (0.2, 0.02, 0.002, 0.0), strict=True)
    dear = Row("here", "section", "pixels", tuple(LevelCost(*one, one[0] != "draft") for one in levels), "standard")
    cheap = dataclasses.replace(dear, samples=tuple(dataclasses.replace(one, ms=one.ms / 20) for one in dear.samples))
    *_, line = as_text([cheap, dear]).splitlines()
    assert line == "| here | section | 10 ms, 0.2 | 20 ms, 0.02 | 40 ms, 0.002 | 60 ms, 0 | 6 × | standard | pixels |"
    entry = {"scene": "here", "kind": "section", "level": "draft", "ms": 10.0, "error": 0.2, "unit": "pixels"}
    assert as_json([dear])[0] == {**entry, "complete": False, "enough": "standard"}
    assert [costliest([cheap, dear], count) for count in (1, 5)] == [[dear], [dear, cheap]]


def test_the_accuracy_auto_of_a_work_is_none_of_the_levels():
    work = Work(AUTO)
    assert (work.auto, work.chosen) == (True, "standard")
    work.settle("precise")
    assert (work.chosen, work.level.name) == ("precise", "precise")
    assert isinstance(SUSLOV, Scene)
