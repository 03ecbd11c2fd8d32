"""What the levels mean in the scenes: what each computes, what the status line says of it, "auto", the cost of all."""

import dataclasses
import math
import re

import numpy as np
import pytest

from hess_explorer.benchmark.trade import Row, as_json, as_text, costliest, names
from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.scenes.framework.trial import Trial, bare, needed, section_error
from hess_explorer.scenes.framework.work import AUTO, Work, kept_status
from hess_mechanics.dynamics.trade import Sample
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, Kind
from hess_mechanics.suslov.section import coordinates, suslov_points

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


CHEAP = [(name, trial) for name, scene in SCENES.items() for trial in scene.trials
         if trial.kind in (Kind.ORBIT, Kind.MAP, Kind.COLOURS)]


@pytest.mark.parametrize(("name", "trial"), CHEAP, ids=[f"{name}-{trial.kind}" for name, trial in CHEAP])
def test_a_finer_level_has_a_smaller_error(name, trial):
    state = bare(SCENES[name].of(SCENES[name].defaults()))
    truth = trial.run(state, dataclasses.replace(
        PLANS[trial.kind]["reference"], level=REFERENCE.tightened()))
    errors = [trial.error(state, trial.run(state, plan), truth) for plan in PLANS[trial.kind].values()]
    # The truth of an unstable motion is not known to more than 1e-4 pixels.
    assert errors[0] > 30.0 * errors[2] > 0.0
    # Of colours `standard` has the tolerance of `draft`, and smaller cells.
    assert errors[0] >= 0.9 * errors[1]
    assert errors[0] < 1.0


# ---- sections ---------------------------------------------------------------------------------------------------


def test_a_draft_follows_orbits_for_a_quarter_of_the_crossings():
    for scene, seen in ((SUSLOV, ("section",)), (QUARTIC, ("section",))):
        counts = {}
        for name in ("draft", "standard", "reference"):
            state, _ = completed(scene, {**(SMALL if scene is SUSLOV else {}), "accuracy": name}, seen)
            counts[name] = len(state.own)
        asked = 120 if scene is SUSLOV else 200
        assert counts == {"draft": asked // 4, "standard": asked, "reference": asked}


@pytest.mark.parametrize("name", ["draft", "standard", "precise"])
def test_the_status_line_says_up_to_which_crossing_the_orbit_is_where_it_is_drawn(name):
    state, report = completed(SUSLOV, {**SMALL, "accuracy": name}, ("section",))
    said = re.search(r"right to ½ pixel: the chosen orbit up to crossing (\d+), others up to crossing (\d+)",
                     report.status)
    own, others = map(int, said.groups())
    plan = PLANS[Kind.SECTION]["reference"]
    exact = suslov_points(state.body, 3, [state.start], 60, True, plan.level, threads=1)
    both = min(len(state.own), 60)
    away = state.own[:both] - coordinates(exact.states[0], 3)[:both]
    away[:, 0] -= 2.0 * math.pi * np.round(away[:, 0] / (2.0 * math.pi))
    pixels = np.linalg.norm(away * [300.0 / math.pi, 600.0 / math.pi], axis=1)
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
        "right to ½ pixel: the chosen orbit up to crossing 16, others to the end (median)"]


def test_orbits_that_chaos_takes_away_are_left_aside():
    regular = np.column_stack([np.linspace(0.0, 1.0, 50), np.zeros(50)])
    late = regular + np.column_stack([np.zeros(50), 1e-3 * np.arange(50)])
    lost = regular + np.column_stack([np.zeros(50), 1e-9 * np.exp(0.5 * np.arange(50))])
    assert section_error([late, regular], [regular, regular], (1.0, 1.0)) == pytest.approx(0.049)
    assert section_error([lost, late], [regular, regular], (1.0, 1.0)) == pytest.approx(0.049)
    assert section_error([lost], [regular], (1.0, 1.0)) == 0.0
    # From the first crossings on another one.
    assert section_error([regular + 40.0], [regular], (1.0, 1.0)) == 0.0


def test_the_status_line_says_how_much_of_the_basins_hangs_on_their_cells():
    preset = next(one for one in SUSLOV.presets if one.values.get("colours") == "basins")
    values = {**SUSLOV.example(preset), **SMALL, "accuracy": "draft"}
    state, report = completed(SUSLOV, values, ("section",))
    said = re.search(r"basins 18 × 12, twice as many cells would change ([\d.]+) % of it", report.status)
    finer, _ = completed(SUSLOV, {**values, "accuracy": "standard"}, ("section",))
    changed = 100.0 * np.mean(np.kron(state.basin, np.ones((2, 2))) != finer.basin)
    assert changed / 3.0 < float(said[1]) < 3.0 * changed


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

    assert needed(Trial(Kind.MAP, (), refuse, lambda *_: 0.0), None) == "standard"


def test_every_scene_offers_auto_and_all_levels():
    for scene in SCENES.values():
        (accuracy,) = [spec for spec in scene.specs if spec.name == "accuracy"]
        assert accuracy.options == (*LEVELS, AUTO)
        assert accuracy.default == "standard"


# ---- the cost of all --------------------------------------------------------------------------------------------


def test_the_cost_of_all_is_measured_when_its_picture_is_unfolded():
    scene = scenes()["scattering-accuracy"]
    assert scene.folded == {"trade": "Measure all that is computed"}
    state, report = completed(scene, {}, ("trade",))
    samples = state.costs[Kind.MAP]
    errors, ms = state.cost_of(Kind.MAP)
    assert errors == pytest.approx([max(2.0 * one.error, 1e-9) for one in samples])
    assert ms == pytest.approx([one.ms for one in samples])
    assert any(row.startswith("map: ") and row.endswith(" pixels") for row in report.derived)
    # A draft of the map has a quarter of the cells: it is right, but not all.
    assert samples[0].error < 0.5
    assert state.about_costs() == "Enough to the eye: orbit draft, map standard."


def test_a_scene_that_computes_only_its_motion_has_no_such_picture():
    assert "trade" not in scenes()["kharlamova-accuracy"].pictures


# ---- tables -----------------------------------------------------------------------------------------------------

ROWS = [Row("here", "section", "pixels", tuple(
    Sample(name, ms, error, name != "draft") for name, ms, error in zip(LEVELS, times, (0.2, 0.02, 0.002, 0.0),
                                                                        strict=True)), "standard")
        for times in ((1.0, 2.0, 4.0, 8.0), (10.0, 20.0, 40.0, 60.0))]


def test_the_table_has_a_line_for_each_kind_and_the_ratio():
    lines = as_text(ROWS).splitlines()
    assert len(lines) == 4
    assert lines[2] == ("| here | section | 1 ms, 0.2 | 2 ms, 0.02 | 4 ms, 0.002 | 8 ms, 0 | 8 × | standard | pixels |")


def test_the_data_have_an_entry_for_each_level():
    data = as_json(ROWS)
    assert len(data) == 8
    assert data[4] == {"scene": "here", "kind": "section", "level": "draft", "ms": 10.0, "error": 0.2,
                       "unit": "pixels", "complete": False, "enough": "standard"}


def test_the_costliest_come_first():
    assert costliest(ROWS, 1) == [ROWS[1]]
    assert costliest(ROWS, 5) == [ROWS[1], ROWS[0]]


def test_the_accuracy_auto_of_a_work_is_none_of_the_levels():
    work = Work(AUTO)
    assert (work.auto, work.chosen) == (True, "standard")
    work.settle("precise")
    assert (work.chosen, work.level.name) == ("precise", "precise")
    assert isinstance(SUSLOV, Scene)
