"""Statements of the lesson "How do we know?", computed up to twice the time."""

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from hess_mechanics import lyapunov_spectrum
from hess_mechanics.suslov.free import free_motion
from support.deviations import deviations
from support.lesson_on_evidence import STEPS, growth, moved_growth


def test_the_drift_of_the_energy_is_less_than_a_tenth_of_the_error():
    found = growth(STEPS["A small drift proves little"].state.values)
    assert found.drifts["draft"]["E"].max() < 0.1 * found.errors["draft"].max()


@pytest.mark.chaotic
def test_in_chaos_the_error_grows_to_the_size_of_the_picture_and_in_a_regular_motion_it_does_not():
    step = STEPS["Chaos magnifies errors"]
    assert growth(step.state.values).pixels["standard"].max() < 1.0
    found = moved_growth(step.prediction.outcome.values, "errors")["standard"]
    assert deviations(found, -1.0) > 5.0 > -5.0 > deviations(found, 1.5)


@pytest.mark.chaotic
def test_the_mean_divergence_of_the_chaotic_body_agrees_at_twice_the_time():
    state = scenes()["orbit-diagram"].of(STEPS["What is a picture of chaos worth?"].state.values)
    section, span = state.poincare, state.long
    starts = section.spread(32)
    one, twice = ([lyapunov_spectrum(state.body, y, t).divergence for y in starts] for t in (span, 2.0 * span))
    # Twice the time begins with the whole of the other one: its error alone would not do.
    assert abs(deviations(np.subtract(one, twice), 0.0)) < 5.0
    assert np.std(one, ddof=1) < 0.05 * abs(np.mean(one))
    assert deviations(one, 0.0) < -5.0


def test_the_less_extreme_start_looks_steady_up_to_the_first_time_and_not_up_to_the_last():
    step = STEPS["Double the time"]
    state = scenes()["free-suslov"].of(step.state.values)
    times = np.linspace(0.0, step.animation.end, 401)
    Gamma = free_motion(state.body, state.omega, state.gamma, times, "precise").Gamma
    assert np.ptp(Gamma[times <= step.animation.start]) < 0.01
    assert abs(Gamma[-1] - Gamma[0]) > 0.5
