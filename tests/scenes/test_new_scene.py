"""A scene of a system that is not in the package, written by the guide "A scene" of the documentation."""

from math import cos, sin
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import level
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
