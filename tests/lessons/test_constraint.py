"""Statements of the lesson "What a nonholonomic constraint does", computed."""

import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from hess_explorer.lessons import package_lessons
from hess_explorer.scenes import scenes
from hess_mechanics import solve
from hess_mechanics.suslov import free
from support.lesson_on_constraints import cloud_body, free_body
from support.suslov import divergence, energy

STEPS = {step.title: step for step in package_lessons()["what-a-nonholonomic-constraint-does"].steps}


def moved(body, start, times):
    """States (n, 5) of a motion."""
    return solve(body, start, times, "precise").states


def test_the_guess_is_the_stable_point_of_the_new_body_and_lies_on_its_line():
    values = STEPS["Where will ω stop?"].prediction.outcome.values
    body, start = free_body(values), np.array([values["w1"], values["w2"]])
    points = free.equilibria(body, 0.5 * (body.I11 * start[0] ** 2 + body.I22 * start[1] ** 2))
    assert values["I13"] * points.stable[0] + values["I23"] * points.stable[1] == pytest.approx(0.0, abs=1e-14)
    assert np.linalg.norm(start - points.unstable) < 0.06
    assert moved(body, [*start, 0.0, 0.0, 1.0], [40.0])[0, :2] == pytest.approx(points.stable, abs=1e-6)


def test_the_patch_grows_then_shrinks_to_about_a_thousandth():
    values = STEPS["How fast volume is lost"].state.values
    found = scenes()["singular-measures"].compute(values, {"divergence"}, is_preview=False)
    [left] = [float(text.split("= ")[1]) for text in found.quantities() if text.startswith("V(t)/V(0)")]
    assert 0.0009 < left < 0.0014
    # From the middle of the patch: the integral of the divergence along its motion.
    body, r, times = cloud_body(values), math.sqrt(2.0 * values["h"]), np.linspace(0.0, 14.0, 281)
    w = r * np.array([math.cos(values["angle"]) / body.I11**0.5, math.sin(values["angle"]) / body.I22**0.5])
    rates = divergence(body, moved(body, [*w, 0.0, 0.0, 1.0], times).T)
    logarithm = cumulative_trapezoid(rates, times, initial=0.0)
    assert max(logarithm) > 0.1
    assert logarithm[-1] < -4.0
    np.testing.assert_allclose(rates[-20:], -free.equilibria(body, values["h"]).rate, rtol=1e-3)


def test_the_heavy_body_keeps_one_sense_of_turning_and_reverses_from_the_other():
    one = scenes()["orbit-diagram"].of(STEPS["A rotation about the vertical"].state.values)
    wrong = scenes()["orbit-diagram"].of(STEPS["The opposite rotation"].prediction.outcome.values)
    assert energy(one.body, one.start) == pytest.approx(energy(wrong.body, wrong.start), abs=1e-12)
    # Up to twice the time span of the picture.
    times = np.linspace(0.0, 2.0 * one.span, 2401)
    moving = (moved(state.body, state.start, times) for state in (one, wrong))
    steady, reversing = ((y[:, :2] * y[:, 2:4]).sum(axis=1) for y in moving)
    assert steady.max() < -0.5
    assert np.ptp(steady[-600:]) < 0.2 * np.ptp(steady[:600])
    assert reversing[0] == pytest.approx(-steady[0], rel=0.01)
    assert reversing[0] > 0.5
    assert reversing[times > 40.0].max() < 0.0
    # A pixel is some thousandth of the picture.
    assert wrong.orbit.path.error_estimate < 1e-4
