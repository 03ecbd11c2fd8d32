"""A scene of a system that is not in the package, written by the guide "A scene" of the documentation."""

from math import cos, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import level
from support.mechanics import followed
from support.pendulum import mechanics, scene
from support.view import View

SCENE = scene.SCENE


def angular_momentum(theta, u, g, E):
    """|L| at a place of the section, by hand: x₂ = 0, so L = x₁ẋ₂."""
    return np.abs(np.sin(theta)) * np.sqrt(2.0 * (E + g * np.cos(theta)) - u * u)


def test_the_scene_has_at_most_sixty_lines():
    assert len(Path(scene.__file__).read_text(encoding="utf-8").splitlines()) <= 60


def test_the_section_shows_a_curve_of_the_angular_momentum():
    view = View(SCENE, {})
    points = view.points("own")
    assert points.shape == (200, 2)
    assert np.ptp(points[:, 0]) > 0.3
    expected = angular_momentum(0.8, 0.5, 1.0, 0.5)
    assert angular_momentum(*points.T, 1.0, 0.5) == approx(expected, abs=1e-5)
    assert "200 crossings of the chosen orbit" in view.text["section"]


def test_the_orbit_is_that_of_scipy():
    view = View(SCENE, {"E": 0.7, "span": 12.0, "accuracy": "precise"})
    # By Newton's equations with the force along the rod, from θ = 0.8, u = 0.5.
    sine, cosine = sin(0.8), cos(0.8)
    velocity = [0.5 * cosine, sqrt(2.0 * (0.7 + cosine) - 0.25), 0.5 * sine]

    def field(t, y):
        v, x = y[:3], y[3:]
        return np.concatenate([np.array([0.0, 0.0, -1.0]) + (x[2] - v @ v) * x, v])

    exact = followed(field, [*velocity, sine, 0.0, -cosine], view.data["data-orbit"]["t"])
    # Data are sent to the browser in single precision.
    assert np.abs(view.columns("data-orbit", "x1", "x2") - exact[:, 3:5]).max() < 1e-6
    assert "section" in view.report.status
    assert "Taylor steps" in view.report.status


def test_an_energy_without_motions_is_said_and_not_drawn():
    with pytest.raises(OutsideRegion, match="larger energy"):
        View(SCENE, {"E": -2.0})


def test_the_tools_of_the_mechanics_take_the_section():
    """A conical pendulum, u = 0 at the right angle, is a fixed point of the return map."""
    theta, g = 0.9, 1.0
    v2 = g * sin(theta) ** 2 / cos(theta)
    section = mechanics.PendulumSection(g, v2 / 2.0 - g * cos(theta))
    image = ReturnMap(section, level("precise")).image(np.array([theta, 0.0]))
    assert image == approx((theta, 0.0), abs=1e-9)
