"""The scene of the Suslov–Hess case: the density over the circle map."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from hess_explorer.views.circle_map import EVENLY
from hess_mechanics import circle_map
from hess_mechanics.numerics.accuracy import REFERENCE
from support.view import View

SCENE = scenes()["suslov-hess"]
SIDE = 2.0 * math.pi


@pytest.mark.parametrize(("I23", "h", "f"), [(0.5, 0.5, 0.5), (0.3, -0.2, -0.7), (0.9, -0.5, 0.3)])
def test_the_curve_over_the_bottom_is_where_iterates_are(I23, h, f):
    view = View(SCENE, {"I22": 1.0, "I23": I23, "h": h, "f": f}, seen={"circle"})
    phi, height = view.curve("circle-density")
    density = (height + math.pi) / (SIDE * EVENLY * SIDE)
    assert np.sum(0.5 * (density[1:] + density[:-1]) * np.diff(phi)) == pytest.approx(1.0, abs=1e-3)
    orbit = circle_map(view.result.body.a, h, f, REFERENCE).iterate(0.3, 20_000)
    shares, edges = np.histogram(orbit, 12, (-math.pi, math.pi))
    fine = np.linspace(-math.pi, math.pi, 12 * 50 + 1)
    expected = [np.trapezoid(np.interp(part, phi, density), part)
                for part in (fine[i * 50 : (i + 1) * 50 + 1] for i in range(12))]
    assert edges[0] == pytest.approx(fine[0])
    assert shares / orbit.size == pytest.approx(expected, abs=3e-3)
    assert np.ptp(expected) > 0.01
    zeta, = view.derived("ζ of the invariant density = #")
    # Its kernel is largest on the ray to ζ, where it is (1 + |ζ|)/(1 − |ζ|) times the even density.
    assert density.max() * SIDE == pytest.approx((1.0 + abs(zeta)) / (1.0 - abs(zeta)), rel=1e-3)


def test_beside_limit_cycles_no_density_is_drawn():
    view = View(SCENE, {"I22": 1.0, "I23": 0.5, "h": 1.5, "f": 0.6}, seen={"circle"})
    assert not len(view.data.get("circle-density", {"xs": []})["xs"])
    assert not any("ζ" in row for row in view.report.derived)
