"""The scene "loxodromic pendulum", and the body on the Suslov–Hess page: pictures and captions are correct."""

import re
from math import acos, asin, atan, copysign, exp, hypot, pi, sqrt, tan

import numpy as np
import pytest
from pytest import approx

from support.loxodrome import HESS, LOXODROME, swing_at
from support.view import NUMBER, View


def slope(values):
    """a, with the sign of I3 − I1."""
    a1, a2, a3 = (1.0 / values[name] for name in ("I1", "I2", "I3"))
    return copysign(sqrt((a3 - a2) * (a2 - a1)) / a2, a1 - a3)


def clock(values):
    """The unit of time, 1/√(μ/I2)."""
    return sqrt(values["I2"] / values["m"])


def curve_of(view, picture, look):
    """The only curve of that look, (n, 3)."""
    (found,) = [np.array(curve, float) for name, _, *curve in view.data[picture]["curves"] if name == look]
    return found.T


every_preset = pytest.mark.parametrize("preset", LOXODROME.presets, ids=lambda preset: preset.name)


@every_preset
def test_a_preset_shows_what_its_captions_promise(preset):
    view = View(LOXODROME, preset.values)
    values, orbit = view.values, view.data["data-orbit"]
    a, h, l0 = slope(values), values["energy"], values["l"]
    said, error = view.numbers("angle", "= #; the track agrees to #.")
    theta = asin(1.0 / hypot(1.0, a))
    assert said == approx(theta, rel=6e-4)
    assert error < 2e-5
    drawn = view.data["angle-theta"]
    assert len(drawn["x"]) > 5
    assert drawn["y"] == approx(theta, abs=2e-5)
    assert view.data["angle-promised"]["y"] == approx([theta] * 2, abs=1e-5)
    assert view.numbers("body", "Largest distance from the vertical plane: #.")[0] < 1e-5
    alpha = swing_at(h, orbit["t"].astype(float) / clock(values))
    assert orbit["height"] == approx(-np.cos(alpha), abs=2e-5 * max(1.0, values["span"] / 20))
    assert orbit["l"] == approx(2.0 * np.arctan(tan(l0 / 2) * np.exp(a * alpha)), abs=1e-4)
    if h < 1.0:
        reach, top = view.numbers("height", "The body swings. α = ±# at most; the height reaches h = #.")
        assert (reach, top) == (approx(acos(-h), rel=6e-4), approx(h))
        ends = view.numbers("space", "l from # to #.")
        assert (orbit["l"].min(), orbit["l"].max()) == approx(tuple(ends), abs=2e-3)
    elif h == 1.0:
        end = 2.0 * atan(tan(l0 / 2) * exp(a * pi))
        assert view.numbers("space", "l from # towards #.")[1] == approx(end, rel=6e-4)
    else:
        assert view.numbers("height", "The body rotates. # turns") == [approx(abs(alpha[-1]) / (2 * pi), rel=6e-4)]
        assert view.numbers("space", "l from # to #.") == approx([l0, orbit["l"][-1]], rel=6e-4)


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


def test_the_status_line_says_error_drift_and_how_orthonormal_it_was():
    status = View(LOXODROME, {"accuracy": "precise"}).report.status
    assert re.search(rf"^precise: orbit .*(error ≤ {NUMBER} \(ok\)|floor)", status)
    assert "(e,γ)" in status
    assert re.search(rf"γ, e orthonormalised, defect {NUMBER}", status)


# --- The body of the Suslov–Hess case ----------------------------------------------------------------


def test_the_body_of_the_hess_case_is_one_of_the_admissible_ones():
    view = View(HESS, {}, seen={"body"})
    I33, *moments = view.numbers("body", "I₃₃ = # (does not affect the motion), principal moments #, #, #.")
    low, high = view.result.body.check.I33
    assert abs(I33 - 0.5 * (low + high)) < 1e-3
    I22, I23 = 0.96, 0.28
    exact = np.linalg.eigvalsh([[I22 + I23**2 / I22, 0, 0], [0, I22, I23], [0, I23, I33]])
    assert moments == approx(exact, rel=6e-4)
    body = view.data["body"]
    assert (np.array(body["semi"]) / body["semi"][2]) ** 2 == approx(exact / exact[2], rel=1e-3)
    assert body["t"][-1] == 40.0
