"""Statements of the lesson on period doubling, computed."""

import numpy as np
import pytest

from hess_explorer.lessons import package_lessons
from hess_explorer.protocol.specs import places
from hess_explorer.scenes import scenes
from hess_mechanics import lyapunov_spectrum
from hess_mechanics.suslov.suslov_section import SuslovSection
from support.deviations import deviations
from support.diagrams import nearest
from support.diagrams import settled as many
from support.lesson_on_doubling import NAME, cascade, end, heavy_body, points_of
from support.view import View

STEPS = {step.title: step for step in package_lessons()[NAME].steps}


@pytest.mark.parametrize(("title", "period"), [("Look only at the crossings", 1), ("Move one number", 2)])
def test_the_motion_settles_to_the_period_that_the_lesson_says(title, period):
    step = STEPS[title]
    assert points_of(step.prediction.then if step.prediction else step.at) == period


def places_at(title, count, kept, forward=True):
    """Settled places of many orbits of a step's body, see `diagrams.settled`."""
    return many(scenes()["orbit-diagram"].of(STEPS[title].at.values).poincare, count, kept, forward=forward)


@pytest.mark.chaotic
def test_beyond_the_end_no_short_period_is_left_and_other_starts_come_to_the_same_set():
    assert STEPS["The film backwards"].at.values["I23"] == STEPS["Beyond the end"].at.values["I23"] > end(None)[1]
    orbits = places_at("The film backwards", 24, 200)
    # The farthest places of each orbit from those of all others, one in a hundred.
    off = [
        np.quantile(nearest(own, np.concatenate([*orbits[:i], *orbits[i + 1 :]])), 0.99) for i, own in enumerate(orbits)
    ]
    assert deviations(off, 0.01) < -5.0
    for period in range(1, 65):
        farthest = np.abs(orbits[:, period:] - orbits[:, :-period]).max(axis=(1, 2))
        assert deviations(farthest, 0.05) > 5.0


@pytest.mark.chaotic
def test_the_first_exponent_of_a_periodic_attractor_tends_to_0_and_that_of_the_strange_one_does_not():
    values = STEPS["Measure the chaos"].at.values
    strange, periodic = (SuslovSection(*heavy_body({**values, "I23": I23}), 3) for I23 in (values["I23"], -0.1))
    start = periodic.state_at(*places(values["starts"])[-1])
    # The picture's time, and twice as long.
    for span in (4000.0, 8000.0):
        assert abs(lyapunov_spectrum(periodic.body, start, span).values[0]) < 0.004
        found = [lyapunov_spectrum(strange.body, y, span).values[0] for y in strange.spread(16)]
        assert deviations(found, 0.02) > 5.0


@pytest.mark.chaotic
def test_attractor_and_repeller_are_apart_in_the_first_body_and_some_points_meet_in_the_other():
    def apart(title):
        # As many points as the picture has, once for each of many starts.
        both = (places_at(title, 32, 1500, forward) for forward in (True, False))
        return np.array([nearest(*pair) for pair in zip(*both, strict=True)])

    assert deviations(apart("The film backwards").min(axis=1), 0.05) > 5.0
    # Many blue points are apart, and some among the orange ones.
    touching = apart("When they touch")
    assert deviations(np.mean(touching > 0.2, axis=1), 0.15) > 5.0
    assert deviations(np.mean(touching < 0.05, axis=1), 0.005) > 5.0


def test_the_saddle_goes_on_between_the_branches():
    values = STEPS["Where has the old motion gone?"].prediction.then.values
    few = {"ways": "there and back", "steps": 20.0}
    found = View(scenes()["orbit-diagram"], values | few, seen={"diagram"})
    # It begins where the period doubles, and goes on beyond the next doubling.
    xs, ys = found.curve("diagram-branch-repels")
    assert xs.min() == pytest.approx(cascade().values[0], abs=1e-4)
    assert xs.max() > cascade().values[1]
    drawn = found.result.diagram.points("rising")
    between = np.unique(drawn[0][(drawn[0] > 0.0) & (drawn[0] < 0.07)])
    assert len(between) > 2
    for x in between:
        there = drawn[1][drawn[0] == x]
        assert there.min() + 0.01 < np.interp(x, xs, ys) < there.max() - 0.01
