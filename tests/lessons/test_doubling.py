"""Statements of the lesson on period doubling, computed by other means."""

import numpy as np
import pytest

from hess_explorer.lessons import shipped
from hess_explorer.protocol.parameters import places
from hess_explorer.scenes import scenes
from hess_mechanics import lyapunov_spectrum
from hess_mechanics.suslov.section import SuslovSection
from support.diagrams import crossings
from support.lesson_on_doubling import NAME, cascade, end, heavy_body, points_of, sets_at
from support.suslov import field
from support.view import View

STEPS = {step.title: step for step in shipped()[NAME].steps}


def settled(values, count):
    """Crossings (count, 5) of the motion after 100 others, by SciPy."""
    body, _ = heavy_body(values)
    state = scenes()["orbit-diagram"].of(values)

    def rates(_, y):
        return field(body, y)

    start = state.start
    for _ in range(2):
        start = crossings(rates, start, 50)[-1]
    return crossings(rates, start, count)


@pytest.mark.parametrize(("title", "period"), [("Look only at the crossings", 1), ("Move one number", 2)])
def test_the_motion_settles_to_the_period_that_the_lesson_says(title, period):
    step = STEPS[title]
    place = step.prediction.then if step.prediction else step.at
    assert points_of(place) == period
    found = settled(place.values, 2 * period + 1)
    np.testing.assert_allclose(found[period:], found[:-period], atol=1e-5)
    for shorter in range(1, period):
        assert np.abs(found[shorter] - found[0]).max() > 0.02


def test_beyond_the_end_no_short_period_is_left_and_other_starts_come_to_the_same_set():
    values = STEPS["The film backwards"].at.values
    assert values["I23"] == STEPS["Beyond the end"].at.values["I23"] > end(None)[1]
    own, other = (sets_at(values, chosen=chosen).attractor for chosen in (values["chosen"], "1,1.7"))
    apart = np.linalg.norm(own[:, None] - other[None], axis=2)
    assert np.quantile(apart.min(axis=1), 0.99) < 0.01
    assert np.quantile(apart.min(axis=0), 0.99) < 0.01
    for period in range(1, 65):
        assert np.abs(own[period:] - own[:-period]).max() > 0.05


def test_the_first_exponent_of_a_periodic_attractor_tends_to_0_and_that_of_the_strange_one_does_not():
    step = STEPS["Measure the chaos"]
    for given, is_chaotic in (({**step.at.values, "I23": -0.1}, False), (step.at.values, True)):
        body, E = heavy_body(given)
        start = SuslovSection(body, E, 3).state_at(*places(given["starts"])[-1])
        # The picture's time, and twice as long.
        values = [lyapunov_spectrum(body, start, span).values[0] for span in (4000.0, 8000.0)]
        if is_chaotic:
            assert min(values) > 0.02
        else:
            assert max(map(abs, values)) < 0.004


def test_attractor_and_repeller_are_apart_in_the_first_body_and_some_points_meet_in_the_other():
    def nearest(title):
        found = sets_at(STEPS[title].at.values)
        away = found.attractor[:, None] - found.repeller[None]
        away[..., 0] = np.arctan2(np.sin(away[..., 0]), np.cos(away[..., 0]))
        return np.linalg.norm(away, axis=2).min(axis=1)

    assert nearest("The film backwards").min() > 0.05
    # Many blue points are apart, and some among the orange ones.
    touching = nearest("When they touch")
    assert np.mean(touching > 0.2) > 0.3
    assert np.mean(touching < 0.05) > 0.01


def test_the_saddle_goes_on_between_the_branches():
    values = STEPS["Where has the old motion gone?"].prediction.then.values
    few = {"ways": "there and back", "steps": 20.0}
    found = View(scenes()["orbit-diagram"], values | few, seen={"diagram"})
    columns = found.data["diagram-branch-repels"]
    # It begins where the period doubles, and goes on beyond the next doubling.
    xs, ys = (np.concatenate([np.asarray(part, float) for part in columns[key]]) for key in ("xs", "ys"))
    assert xs.min() == pytest.approx(cascade().values[0], abs=1e-4)
    assert xs.max() > cascade().values[1]
    drawn = found.result.diagram.points("rising")
    between = np.unique(drawn[0][(drawn[0] > 0.0) & (drawn[0] < 0.07)])
    assert len(between) > 2
    for x in between:
        lower, upper = drawn[1][drawn[0] == x].min(), drawn[1][drawn[0] == x].max()
        assert lower + 0.01 < np.interp(x, xs, ys) < upper - 0.01
