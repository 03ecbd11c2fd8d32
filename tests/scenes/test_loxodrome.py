"""The scene "loxodromic pendulum": the track in space."""

from math import pi

import numpy as np
import pytest
from pytest import approx

from support.loxodrome import LOXODROME, slope
from support.view import View


def curve_of(view, picture, look):
    """The only curve of that look, (n, 3)."""
    (found,) = [np.array(curve, float) for name, _, *curve in view.data[picture]["curves"] if name == look]
    return found.T


every_preset = pytest.mark.parametrize("preset", LOXODROME.presets, ids=lambda preset: preset.name)


@every_preset
def test_the_computed_track_lies_on_the_loxodrome_and_both_are_seen_from_below_upwards(preset):
    view = View(LOXODROME, preset.values)
    loxodrome, track = curve_of(view, "space", "muted"), curve_of(view, "space", "orbit")
    for points in (loxodrome, track):
        assert np.linalg.norm(points, axis=1) == approx(1.0, abs=1e-6)
    # In Mercator's chart about e, the first axis, both are a straight line of slope a, and the same one.
    lines = []
    for x, y, z in (track.T, loxodrome.T):
        clear = np.flatnonzero(np.abs(x) < 0.999)
        between = slice(clear[0], clear[-1] + 1)
        latitude = np.log(np.tan(0.5 * np.arctan2(np.hypot(y, z), x)[between]))
        lines.append(latitude - slope(view.values) * np.unwrap(np.arctan2(-z, -y)[between]))
        assert np.ptp(lines[-1]) < 1e-3
    turns = (lines[0][0] - lines[1][0]) / (2.0 * pi * slope(view.values))
    assert turns == approx(round(turns), abs=1e-3)
    # The centre of mass starts at the bottom, in the plane across e.
    centre = curve_of(view, "body", "stable")
    assert centre[0] == approx([0.0, 0.0, -1.0], abs=1e-6)
    assert np.max(np.abs(centre[:, 0])) < 1e-4
    assert centre[:, 2] == approx(view.data["data-orbit"]["height"], abs=1e-6)
