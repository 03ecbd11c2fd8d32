"""A scene of a system that is not in the package, written by the guide "A scene" of the documentation."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.stage import Stage
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import level
from support.captions import texts_in
from support.pendulum import mechanics, scene
from support.wire import read

SCENE = scene.SCENE
VALUES = SCENE.defaults()


def drawn(values):
    """The columns of each source, the captions, and the report."""
    wire = Wire()
    report = Stage(SCENE, wire).show(SCENE.compute(values, SCENE.pictures, False), hold_axes=False)
    tree, block = wire.pack()
    return (
        {
            source: {name: read(one, block) for name, one in columns.items()}
            for source, columns in tree["sources"].items()
        },
        texts_in(tree),
        report,
    )


def angular_momentum(theta, u, g, E):
    """|L| at a place of the section, by hand: x₂ = 0, so L = x₁ẋ₂."""
    return np.abs(np.sin(theta)) * np.sqrt(2.0 * (E + g * np.cos(theta)) - u * u)


def test_the_scene_has_at_most_sixty_lines():
    assert len(Path(scene.__file__).read_text(encoding="utf-8").splitlines()) <= 60


def test_the_section_shows_a_curve_of_the_angular_momentum():
    data, texts, _ = drawn(VALUES)
    points = np.array([data["section-own"]["x"], data["section-own"]["y"]])
    assert points.shape == (2, 200)
    assert np.ptp(points[0]) > 0.3
    expected = angular_momentum(0.8, 0.5, 1.0, 0.5)
    assert angular_momentum(*points, 1.0, 0.5) == pytest.approx(expected, abs=1e-5)
    assert "200 crossings of the chosen orbit" in texts["section"]


def test_the_orbit_is_that_of_scipy():
    data, _, report = drawn({**VALUES, "E": 0.7, "lasts": 12.0, "accuracy": "precise"})
    # By Newton's equations with the force along the rod, from θ = 0.8, u = 0.5.
    sine, cosine = math.sin(0.8), math.cos(0.8)
    velocity = [0.5 * cosine, math.sqrt(2.0 * (0.7 + cosine) - 0.25), 0.5 * sine]

    def field(t, y):
        v, x = y[:3], y[3:]
        return np.concatenate([np.array([0.0, 0.0, -1.0]) + (x[2] - v @ v) * x, v])

    found = solve_ivp(
        field,
        (0.0, 12.0),
        [*velocity, sine, 0.0, -cosine],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        t_eval=data["data-orbit"]["t"],
    ).y
    # Data are sent to the browser in single precision.
    assert np.abs(np.array([data["data-orbit"]["x1"], data["data-orbit"]["x2"]]) - found[3:5]).max() < 1e-6
    assert "section" in report.status
    assert "Taylor steps" in report.status


def test_a_click_in_the_section_starts_the_orbit_there():
    picture = SCENE.views[0]
    state = SCENE.compute(VALUES, SCENE.pictures, False)
    moved, notes = SCENE.admit({**VALUES, **picture.on_click(state, -1.2, 0.1)})
    assert notes == []
    data, _, _ = drawn(moved)
    first = np.array([data["section-own"]["x"][0], data["section-own"]["y"][0]])
    assert angular_momentum(*first, 1.0, 0.5) == pytest.approx(angular_momentum(-1.2, 0.1, 1.0, 0.5), abs=1e-5)


def test_an_energy_without_motions_is_said_and_not_drawn():
    with pytest.raises(OutsideRegion, match="larger energy"):
        SCENE.compute({**VALUES, "E": -2.0}, SCENE.pictures, False)


def test_the_tools_of_the_mechanics_take_the_section():
    """A conical pendulum, u = 0 at the right angle, is a fixed point of the return map."""
    theta, g = 0.9, 1.0
    v2 = g * math.sin(theta) ** 2 / math.cos(theta)
    section = mechanics.PendulumSection(g, v2 / 2.0 - g * math.cos(theta))
    image = ReturnMap(section, level("precise")).image(np.array([theta, 0.0]))
    assert image == pytest.approx((theta, 0.0), abs=1e-9)
