"""Proved enclosure of the shown orbit: stated beside the estimate, drawn where it is wider than a pixel."""

import math
import sys
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest

import oracle
from hess_explorer.compute.cache import Task
from hess_explorer.scenes import scenes
from hess_explorer.scenes.parts.orbits.proof import proved_error
from hess_mechanics import circle_map, level
from hess_mechanics.suslov_hess.equations import SYSTEM
from support.thorough import sample
from support.view import View

SEEN = frozenset({"omega", "sphere"})
SCENES = {scene.name: scene for scene in scenes().values()}
HESS = SCENES["suslov-hess"]
PROVING = [name for name, scene in SCENES.items() if "certain" in scene.defaults() and scene.origin is None]
STRONG = {"I22": 0.5, "I23": 1.5, "h": 0.5, "f": 0.3}
UNSTABLE = {**STRONG, "phi0": circle_map(3.0, 0.5, 0.3, level("reference")).fixed_points[1].phi, "span": 20.0}
"""An orbit that starts on an unstable cycle, as well as a double can: neighbours part by e^12 in each turn."""


def shown(scene, values, **more):
    return View(scene, {**values, "certain": "shown"}, seen=SEEN & set(scene.pictures), **more)


def sentence(view):
    (said,) = (part for part in view.report.status.split(" · ") if part.startswith("proved error"))
    return said


def tasks(view):
    return [task for task in view.first.todo if task.function is proved_error]


@pytest.mark.parametrize("name", sample(PROVING, 4))
def test_a_short_orbit_is_right_to_its_end_and_nothing_is_drawn(name):
    scene = SCENES[name]
    view = shown(scene, {"span": 1.0}, whole=False)
    (task,) = tasks(view)
    found = task.compute()
    assert found.sentence.startswith("proved error ≤ ")
    assert found.sentence.endswith("certainly right to ½ pixel to its end")
    assert (found.band, found.circles) == ((), ())
    # So small as the level promises, in units in which the state is O(1), and not nothing.
    assert 0.0 < float(found.sentence.split("≤ ")[1].split(",")[0].replace("−", "-")) < 1e-4


@cache
def unstable(accuracy):
    """The view of that orbit, and its true states at the same times."""
    view = shown(HESS, {**UNSTABLE, "accuracy": accuracy})
    return view, true_states(view.result.motion(), view.result.track.orbit.times)


def test_a_band_holds_the_true_orbit_where_it_is_wider_than_a_pixel():
    view, truth = unstable("standard")
    said, (state, motion) = sentence(view), (view.result, view.result.motion())
    until = float(said.split("t = ")[1].split(";")[0].replace("−", "-"))
    assert 8.0 < until < 20.0
    band = [
        np.column_stack(part)
        for part in zip(
            *([np.asarray(one[0][0], float) for one in view.data["omega-band"][key]] for key in ("xs", "ys")),
            strict=True,
        )
    ]
    orbit, times = state.track.orbit, state.track.times
    errors = np.abs(orbit.states - truth) * motion.weights
    sizes = np.maximum(*(np.linalg.norm(part, axis=1) for part in (errors[:, :2], errors[:, 2:])))
    assert np.all(sizes[times <= until * (1 - 1e-9)] <= 0.5)
    assert sizes[np.searchsorted(times, until * 1.001)] > 0.4
    # Every true state there lies in a polygon of the band.
    late = (np.linalg.norm(errors[:, :2], axis=1) > 0.6) & (np.linalg.norm(errors[:, :2], axis=1) < 100.0)
    assert np.any(late)
    unit = np.array([1.0, math.hypot(1.0, 3.0)]) * state.body.frequency_unit
    for place in truth[late, :2] * unit:
        assert any(inside(place, polygon) for polygon in band)
    assert max(np.ptp(polygon, axis=0).max() for polygon in band) > 2.0 * state.half_width / 600.0
    circles = [circle for circle in view.data["sphere"]["circles"] if circle[4] == "muted"]
    assert 0 < len(circles) <= 16
    assert all(0.5 / 300 < math.acos(circle[3]) < 0.6 for circle in circles)


def true_states(motion, times):
    """Integrate with 45 decimals from exactly these doubles."""
    return np.array(
        oracle.orbits.orbit_in_decimals(SYSTEM, motion.start, motion.parameters, times.tolist(), 45), dtype=float
    )


def inside(place, polygon):
    """Left of every side of a convex polygon, to round-off of single precision."""
    sides = np.diff(polygon, axis=0)
    away = place - polygon[:-1]
    return np.all(sides[:, 0] * away[:, 1] - sides[:, 1] * away[:, 0] >= -1e-5)


def test_an_orbit_that_leaves_an_unstable_cycle_is_not_called_right():
    """All levels go down to the floor for it, and say of that what decimals say."""
    for accuracy in sample(("standard", "draft", "reference"), 1):
        view, truth = unstable(accuracy)
        orbit = view.result.track.orbit
        error = np.abs(orbit.states - truth).max()
        assert 0.01 < error <= orbit.error_estimate
        assert "too small" not in sentence(view)


def test_an_estimate_that_is_too_small_is_given_away():
    view = shown(HESS, {"span": 5.0, "accuracy": "draft"}, whole=False)
    (task,) = tasks(view)
    finding, motion, units = task.arguments
    found = finding.compute()
    least = np.abs(found.orbit.states - true_states(motion, found.orbit.times)).max()
    for estimate, too_small in ((1.1 * least, False), (0.9 * least, True)):
        judgement = proved_error(Task(_told, Told(found, estimate)), motion, units)
        assert ("the estimate is too small, as the error reaches" in judgement.sentence) == too_small


@dataclass(frozen=True, eq=False)
class Told:
    """A track, with another estimate of its error."""

    track: object
    estimate: float


def _told(told):
    return replace(told.track, orbit=replace(told.track.orbit, error_estimate=told.estimate))


def test_nothing_is_proved_in_a_drag_or_unasked(monkeypatch):
    assert not tasks(shown(HESS, {}, is_preview=True))
    assert not tasks(View(HESS, {}, seen=SEEN, whole=False))
    monkeypatch.setitem(sys.modules, "flint", None)
    view = shown(HESS, {"h": 1.43})
    assert "proofs need python-flint: pip install 'hess-explorer[prove]'" in view.report.status
    assert not tasks(view)
