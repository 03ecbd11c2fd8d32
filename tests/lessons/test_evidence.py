"""Statements of the lesson "How do we know?", computed up to twice the time."""

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from hess_mechanics import level, lyapunov_spectrum, prove, regime, return_map, solve
from hess_mechanics.dynamics.tube import ProvedOrbit, tube
from hess_mechanics.suslov.free import free_motion
from support.deviations import deviations
from support.diagrams import settled
from support.lesson_on_evidence import STEPS, growth, moved_growth


def test_a_thousand_times_smaller_error_costs_hardly_more_and_errors_do_not_explode():
    values = STEPS["How the error grows"].at.values
    errors = growth(values).errors
    assert errors["precise"].max() < 1e-2 * errors["standard"].max() < 1e-4 * errors["draft"].max()
    # Terms of a step, each as dear as the terms before it: an upper bound on the work of a step.
    motion = scenes()["suslov-hess-accuracy"].of(values).precision.limited_motion
    times = np.linspace(0.0, motion.span, 400)
    body = motion.system.at(motion.parameters)
    work = [
        solve(body, motion.state, times, level(name)).cost.steps * level(name).order ** 2
        for name in ("standard", "precise")
    ]
    assert work[1] < 2.5 * work[0]
    # Up to twice the time of the picture.
    for span in (values["span"], 2.0 * values["span"]):
        found = growth({**values, "span": span}).errors["draft"]
        half = len(found) // 2
        # An exponent of 0.143, as that of the chaotic body, would make it 17 to 300 times as large.
        assert found[half:].max() < 10.0 * found[:half].max()
        assert found.max() < level("draft").promise


def test_the_drift_of_the_energy_is_less_than_a_tenth_of_the_error():
    found = growth(STEPS["A small drift proves little"].at.values)
    [energy] = [drift for name, drift in found.drifts["draft"].items() if name == "E"]
    assert energy.max() < 0.1 * found.errors["draft"].max()


@pytest.mark.chaotic
def test_in_chaos_the_error_grows_to_the_size_of_the_picture_and_in_a_regular_motion_it_does_not():
    step = STEPS["Chaos eats digits"]
    assert growth(step.at.values).pixels["standard"].max() < 1.0
    found = moved_growth(step.prediction.then.values, "errors")["standard"]
    assert deviations(found, -1.0) > 5.0 > -5.0 > deviations(found, 1.5)


@pytest.mark.chaotic
def test_the_mean_divergence_of_the_chaotic_body_agrees_at_twice_the_time():
    state = scenes()["orbit-diagram"].of(STEPS["What is a picture of chaos worth?"].at.values)
    section, span = state.poincare, state.long
    starts = section.spread(32)
    one, twice = ([lyapunov_spectrum(state.body, y, t).divergence for y in starts] for t in (span, 2.0 * span))
    # Twice the time begins with the whole of the other one: its error alone would not do.
    assert abs(deviations(np.subtract(one, twice), 0.0)) < 5.0
    assert np.std(one, ddof=1) < 0.05 * abs(np.mean(one))
    assert deviations(one, 0.0) < -5.0
    # Every motion is called chaotic, and its error is one.
    map_ = return_map(state.body, E=section.E)
    found = [regime(map_, place, duration=span) for place in settled(section, 8, 1)[:, 0]]
    assert {motion.kind.words for motion in found} == {"chaotic"}
    off = [(motion.divergence - np.mean(twice)) / motion.divergence_error for motion in found]
    assert np.sqrt(np.mean(np.square(off))) < 5.0


def test_the_less_extreme_start_looks_steady_up_to_the_first_time_and_not_up_to_the_last():
    step = STEPS["Corrected by twice the time"]
    state = scenes()["free-suslov"].of(step.at.values)
    times = np.linspace(0.0, step.animation.end, 401)
    Gamma = free_motion(state.body, state.omega, state.gamma, times, "precise").Gamma
    assert np.ptp(Gamma[times <= step.animation.start]) < 0.01
    assert abs(Gamma[-1] - Gamma[0]) > 0.5


@pytest.mark.chaotic
def test_the_theorem_is_proved_and_the_tube_of_the_chaotic_motion_ends_before_its_curve():
    pytest.importorskip("flint")
    values = STEPS["From an estimate to a theorem"].at.values
    found = prove(values["I23"] / values["I22"], values["h"], values["f"])
    assert found.statement == "two cycles"
    state = scenes()["orbit-diagram"].of(STEPS["Where a proof gives up"].at.values)
    motion, orbit = state.motion(), state.orbit.path
    bounds = ProvedOrbit(orbit, tube(motion, motion.state, orbit.times, 16, 1e6)).bounds
    assert 10.0 < orbit.times[len(bounds) - 1] < 0.9 * orbit.times[-1]
    # The curve goes on to be right: the truth to 31 digits.
    found = moved_growth({**STEPS["Chaos eats digits"].prediction.then.values, "span": state.span}, "pixels")
    assert deviations(found["standard"], 0.0) < -5.0
