"""The branch of a periodic orbit beside a section: its range, clicks and words."""

import re
from functools import cache

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.periodic import difference
from support.thorough import sample
from support.view import View, values_of

SCENES = scenes()
EXAMPLES = {"quartic": "A pitchfork", "ball-section": "Period doubling", "euler-poisson": "Where the two Hess"}
every = pytest.mark.parametrize("name", EXAMPLES)


def example(name):
    """The values of the example that has a branch, without manifolds."""
    return {**values_of(SCENES[name], EXAMPLES[name]), "reach": 0.0}


@cache
def shown(name, *given):
    """Only its branch is in sight."""
    return View(SCENES[name], {**example(name), **dict(given)}, seen=["branch"])


def marks(view):
    """The bifurcations that are listed: kind, value, error."""
    found = [re.fullmatch(r"(.+) of period (\d+) at (\S+) = (\S+) ± (\S+)", line) for line in view.report.quantities]
    return [(one[1], *(float(one[i].replace("−", "-")) for i in (4, 5))) for one in found if one]


def points_of(view):
    """Return all points of the branch: the parameter, the places (m, 2), the multipliers."""
    return [
        point
        for part in view.result.branch.branches
        for point in zip(part.values.tolist(), part.points, part.multipliers, strict=True)
    ]


@pytest.mark.parametrize("name", sample(EXAMPLES, 2))
def test_a_click_on_the_branch_shows_that_orbit_and_away_from_it_nothing_happens(name):
    view = shown(name)
    state = view.result
    picture = next(one for one in SCENES[name].views if one.name == "branch")
    side = state.poincare.names.index(state.upwards)
    value, there, _ = max(points_of(view), key=lambda one: one[0] < 0.9 * view.values["high"] and one[0])
    place = there[0]
    chosen = picture.on_click(state, value, place[side])
    along = chosen[state.branch.along[state.over]]
    assert along == approx(value, abs=1e-3)
    # The range stays as it was; a narrow one is enough here.
    assert (chosen["low"], chosen["high"]) == state.branch.ends
    after = View(SCENES[name], {**view.values, **chosen, "low": along - 0.01, "high": along + 0.01}, seen=["branch"])
    orbit = after.result.periodic_orbit.closed_orbit.orbit
    assert np.abs(difference(state.poincare.turns, orbit.points, place)).max(axis=1).min() < 0.02
    # The orbit is marked.
    assert after.data["branch-shown"]["x"][0] == approx(along, abs=1e-6)
    assert after.data["branch-shown"]["y"] == approx(orbit.points[:, side], abs=1e-6)
    low, high = state.branch.vertical_range
    away = state, state.branch.ends[0], high + (high - low)
    assert (picture.on_click(*away), picture.on_hover(*away)) == ({}, "")
    assert picture.on_hover(state, value, place[side]).startswith(f"{state.over} = ")
    # A box looks closer.
    at = marks(view)[0][1]
    assert picture.on_box(state, (at + 0.1, 0.0, at - 0.1, 1.0)) == {"low": at - 0.1, "high": at + 0.1}


@every
def test_without_a_periodic_orbit_the_picture_says_what_to_do(name):
    scene = SCENES[name]
    view = View(scene, {"orbits": 0.0} if name == "euler-poisson" else {}, seen=["branch"])
    assert view.verdict("branch").startswith("No periodic orbit is chosen. Choose a periodic orbit")
    assert "Choose a Periodic orbit" in " ".join(view.data["branch-message"]["text"][0].split())
    assert not any("branch" in line for line in (*view.report.quantities, *view.report.notes, view.report.status))
    # Out of sight it is not computed.
    few = {"count": 20.0, **({"orbits": 0.0} if name == "euler-poisson" else {})}
    hidden = View(scene, {**example(name), **few}, seen=["section"], whole=False)
    assert not any("continuation" in task.function.__module__ for task in hidden.report.todo)


@every
def test_the_range_is_within_what_is_possible_and_about_the_value_where_none_is_chosen(name):
    scene = SCENES[name]
    defaults, bounds = scene.defaults(), {spec.name: getattr(spec, "bounds", None) for spec in scene.specs}
    along = scene.of(defaults).branch.along
    for over, parameter in along.items():
        low, high = scene.of({**defaults, "over": over}).branch.ends
        assert low < defaults[parameter] < high
        # Ends in the wrong order, and beyond the bounds of the parameter.
        ends = scene.of({**defaults, "over": over, "low": 1e5, "high": -1e5}).branch.ends
        assert ends == (max(bounds[parameter][0], -1e5), min(bounds[parameter][1], 1e5))
    # Over another parameter the range is about that one.
    chosen = {**defaults, "low": 1.0, "high": 2.0}
    assert scene.adjustments(chosen, {**defaults, "over": [*along][1]}) == {"low": 0.0, "high": 0.0}
    assert scene.adjustments(defaults, {**defaults, "low": 1.0}) == {}


def test_while_a_slider_is_held_only_what_is_known_is_drawn():
    scene, values = SCENES["ball-section"], example("ball-section")
    known, same = (View(scene, values, seen=["branch"], is_preview=is_preview) for is_preview in (False, True))
    for one, other in zip(*(view.curve("branch-branch-attracts") for view in (same, known)), strict=True):
        assert len(one) == len(other) > 20
        assert one == approx(other)
    moved = View(SCENES["ball-section"], {**values, "b3": 0.71}, seen=["branch"], is_preview=True, whole=False)
    assert moved.verdict("branch") == "A periodic orbit is computed when the slider is released."
    assert moved.result.branch.branches == []
    assert moved.report.todo == ()


def test_where_a_branch_hardly_gets_on_no_more_of_it_is_computed():
    # At h = 1.4435 an orbit begins to touch the section: steps are of 1e-10, and sixteen parts were asked for.
    view = View(SCENES["ball-section"], {"periodic": "period 1", "reach": 0.0}, seen=["branch"])
    downwards = [part for part in view.result.branch.branches if part.values[-1] < 2.0]
    assert len(downwards) == 2
    assert downwards[-1].values[-1] == approx(1.44351, abs=1e-5)
    assert "The branch continues, but is not computed further." in view.report.notes
