"""Statements of the lesson "What a nonholonomic constraint does", computed by other means."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hess_explorer.lessons import shipped
from hess_explorer.scenes import scenes
from hess_mechanics.suslov import free
from support.lesson_on_constraints import cloud_body, free_body
from support.suslov import divergence, energy, field

STEPS = {step.title: step for step in shipped()["what-a-nonholonomic-constraint-does"].steps}


def moved(body, start, times):
    """States (5, n) of a motion by SciPy."""
    options = {"rtol": 1e-11, "atol": 1e-12}
    return solve_ivp(lambda _, y: field(body, y), (0.0, times[-1]), start, "DOP853", times, **options).y


def test_the_guess_is_the_stable_point_of_the_new_body_and_lies_on_its_line():
    values = STEPS["Where will it stop?"].prediction.then.values
    body = free_body(values)
    points = free.equilibria(body, 0.5 * (body.I11 * values["w1"] ** 2 + body.I22 * values["w2"] ** 2))
    assert values["I13"] * points.stable[0] + values["I23"] * points.stable[1] == pytest.approx(0.0, abs=1e-14)
    start = np.array([values["w1"], values["w2"]])
    assert np.linalg.norm(start - points.unstable) < 0.06
    # A small distance from the line grows, and later shrinks, at the rate ω₀.
    w = moved(body, [*start, 0.0, 0.0, 1.0], np.array([0.0, 0.5, 18.0, 18.5]))[:2]
    off = np.log(np.abs(body.I13 * w[0] + body.I23 * w[1]))
    assert off[1] - off[0] == pytest.approx(0.5 * points.rate, rel=0.01)
    assert off[3] - off[2] == pytest.approx(-0.5 * points.rate, rel=0.01)


def cloud(title):
    step = STEPS[title]
    values, scene = step.at.values, scenes()["singular-measures"]
    assert scene.admit(values) == (values, [])
    return scene.compute(values, {"omega", "divergence"}, dragging=False), values


@pytest.mark.parametrize(("title", "sense"), [("A cloud of states", 1.0), ("The film backwards", -1.0)])
def test_a_cloud_gathers_at_one_half_of_the_line_in_each_direction_of_time(title, sense):
    values = STEPS[title].at.values
    assert values["direction"] == ("forward" if sense > 0 else "backward")
    body = cloud_body(values)
    points = free.equilibria(body, values["h"])
    end = points.stable if sense > 0 else points.unstable
    generator = np.random.default_rng(1)
    for angle in generator.uniform(0.0, 2.0 * math.pi, 12):
        w = math.sqrt(2.0 * values["h"]) * np.array([math.cos(angle) / body.I11**0.5, math.sin(angle) / body.I22**0.5])
        run = solve_ivp(
            lambda _, y: sense * field(body, y), (0.0, 28.0), [*w, 0.0, 0.0, 1.0], "DOP853", [14.0, 28.0], rtol=1e-10
        )
        assert np.linalg.norm(run.y[:2, 0] - end) < 0.05
        assert np.linalg.norm(run.y[:2, 1] - end) < 1e-5


def test_the_patch_grows_then_shrinks_to_about_a_thousandth():
    found, values = cloud("How fast volume is lost")
    [left] = [float(text.split("= ")[1]) for text in found.derived() if text.startswith("V(t)/V(0)")]
    assert 0.0009 < left < 0.0014
    # By SciPy, from the middle of the patch: the integral of the divergence.
    body = cloud_body(values)
    r = math.sqrt(2.0 * values["h"])
    w = r * np.array([math.cos(values["angle"]) / body.I11**0.5, math.sin(values["angle"]) / body.I22**0.5])

    def rates(_, y):
        return [*field(body, y[:5]), divergence(body, y[:5])]

    start = [*w, 0.0, 0.0, 1.0, 0.0]
    run = solve_ivp(rates, (0.0, 14.0), start, "DOP853", np.linspace(0.0, 14.0, 281), rtol=1e-10, atol=1e-12)
    logarithm = run.y[5]
    assert max(logarithm) > 0.1
    assert logarithm[-1] < -4.0
    slopes = np.diff(logarithm)[-20:] / 0.05
    np.testing.assert_allclose(slopes, -free.equilibria(body, values["h"]).rate, rtol=1e-3)


def test_the_heavy_body_keeps_one_sense_of_turning_and_reverses_from_the_other():
    one = scenes()["orbit-diagram"].of(STEPS["Turned one way"].at.values)
    wrong = scenes()["orbit-diagram"].of(STEPS["Turned the wrong way"].prediction.then.values)
    energies = [energy(state.body, state.start) for state in (one, wrong)]
    assert energies[0] == pytest.approx(energies[1], abs=1e-12)
    # Up to twice the time span of the picture.
    times = np.linspace(0.0, 2.0 * one.span, 2401)

    def turning(state):
        y = moved(state.body, state.start, times)
        return (y[:2] * y[2:4]).sum(axis=0)

    steady, reversing = turning(one), turning(wrong)
    assert steady.max() < -0.5
    assert np.ptp(steady[-600:]) < 0.2 * np.ptp(steady[:600])
    assert reversing[0] == pytest.approx(-steady[0], rel=0.01)
    assert reversing[0] > 0.5
    assert reversing[times > 40.0].max() < 0.0
    # A pixel is some thousandth of the picture.
    assert wrong.orbit.path.error_estimate < 1e-4
