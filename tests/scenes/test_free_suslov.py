"""The scenes "free Suslov problem" and "scattering": every example shows what its name and its captions promise.

The mechanics has tests of its own: here columns and captions are held against its results.
"""

import re
from itertools import pairwise
from math import acos, atan2, cos, log, pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.views.text import digits
from hess_mechanics import additional_integral, cos_chi
from hess_mechanics.suslov.additional_integral import formula
from support.free_suslov import (
    FREE,
    SCATTERING,
    SUSLOV,
    axes_of,
    energy,
    integrate,
    shown,
    tensor_of,
)
from support.view import View, example

every_free = pytest.mark.parametrize("preset", FREE.presets, ids=lambda preset: preset.name)
every_scattering = pytest.mark.parametrize("preset", SCATTERING.presets, ids=lambda preset: preset.name)


# ---- the free Suslov problem ------------------------------------------------------------------------------------


@every_free
def test_captions_circles_and_points_are_those_of_the_model(preset):
    view = View(FREE, preset.values)
    state, points = view.result, view.result.points
    assert view.numbers("omega", "Rate ω₀ = #, E = #.") == shown([points.rate, energy(view.values)])
    assert view.numbers("gamma1", "By # radians per unit of time") == shown([points.speed])
    assert view.quantities("I₁₁ = #") == shown([tensor_of(view.values)[0]])
    for name, point in (("stable", points.stable), ("unstable", points.unstable)):
        assert view.columns(f"omega-{name}-point", "x", "y")[0] == approx(point, rel=1e-6)
    # Both leave one circle, where they turn alike, φ′ − φ apart.
    (came, went), (also, other) = state.orbit.limits, state.second.limits
    assert also == approx(came, abs=1e-6)
    assert view.numbers("Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)") == shown([came, went, other])
    heights = [height for *_, height, look in view.data["sphere"]["circles"] if look != "muted"]
    assert heights == shown([came, went, other])


def test_the_second_orbit_turns_on_the_circle_that_both_leave_by_the_difference_of_the_phases():
    view = View(FREE, {})
    omega, (_, xi, eta) = (view.values["w1"], view.values["w2"]), axes_of(view.values)
    before = [-30.0 / view.result.points.rate]
    pasts = [
        integrate(view.values, omega, one.gamma[0], before)[0, 2:] for one in (view.result.orbit, view.result.second)
    ]
    first, second = (atan2(gamma[2], gamma @ eta) for gamma in pasts)
    assert pasts[0] @ xi == approx(pasts[1] @ xi, abs=1e-6)
    assert np.exp(1j * (second - first)) == approx(np.exp(1j * (view.values["phi2"] - view.values["phi"])), abs=1e-5)


@pytest.mark.parametrize("preset", FREE.presets[:2], ids=lambda preset: preset.name)
def test_the_curve_of_gamma1_is_over_time_or_goes_on_across_the_cut_of_the_azimuth(preset):
    view = View(FREE, preset.values)
    _, xi, eta = axes_of(view.values)
    orbit = {name: np.asarray(column, float) for name, column in view.data["data-orbit"].items()}
    gamma = view.columns("data-orbit", "g1", "g2", "g3")
    assert orbit["t"][-1] == approx(view.values["span"], rel=1e-6)
    assert orbit["Gamma"] == approx(gamma @ xi, abs=1e-6)
    curve = view.data["gamma1-first"]
    if view.values["across"] == "time":
        ((x,), (y,)) = curve["xs"], curve["ys"]
        assert (x, y) == (approx(orbit["t"]), approx(orbit["g1"]))
        assert view.data["gamma1-across"]["text"] == ["t"]
        return
    phase = np.arctan2(gamma[:, 2], gamma @ eta)
    assert np.exp(1j * orbit["across"]) == approx(np.exp(1j * phase), abs=1e-5)
    assert len(curve["xs"]) > 5
    for (x, y), (next_x, next_y) in pairwise(zip(curve["xs"], curve["ys"], strict=True)):
        assert (abs(x[-1]), next_x[0], next_y[0]) == (approx(pi), approx(-x[-1]), y[-1])
        assert np.max(np.abs(np.diff(x))) < pi
    assert view.data["gamma1-across"]["text"] == ["φ"]


@pytest.mark.parametrize("k, name", [(1, "Γ(t), k = 1"), (3, "Γ(t), k = 3")])
def test_with_F2_both_orbits_join_the_mirrored_circle_and_grey_circles_are_its_level(k, name):
    view = example("free-suslov", name)
    came, went, other = view.numbers("Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert went == other == -came
    f, minus, plus = view.numbers("sphere", "F₂ = #; Γ = # on C⁻, Γ = # on C⁺.")
    F2 = additional_integral(k, view.result.body)
    assert (f, minus, plus) == (shown(F2(np.array(view.result.omega), np.array(view.result.gamma))), came, went)
    # Enough to see how it turns, and few enough to see the orbits: each is (V(ω), γ) = f for some ω on the way.
    grey = [circle for circle in view.data["sphere"]["circles"] if circle[4] == "muted"]
    assert len(grey) == 4
    arc = view.result.arcs[0 if view.result.passage.arc > 0 else 1]
    lengths = np.linalg.norm(F2.vector(arc), axis=1)
    for *axis, height, _ in grey:
        nearest = np.argmin(np.linalg.norm(F2.vector(arc) / lengths[:, None] - axis, axis=1))
        assert F2.vector(arc)[nearest] / lengths[nearest] == approx(axis, abs=1e-5)
        assert f / lengths[nearest] == approx(height, abs=1e-3)
    assert re.sub(r"\s", "", formula(k)) in re.sub(r"\s", "", FREE.words)


PORTRAITS = [preset for preset in FREE.presets if preset.name.startswith("Portrait")]


@pytest.mark.parametrize("preset", PORTRAITS, ids=lambda preset: preset.name)
def test_a_portrait_has_the_signs_of_its_name_and_arrows_along_the_flow(preset):
    view = View(FREE, preset.values)
    signs = [">" if view.values[name] > 0 else "<" for name in ("I13", "I23")]
    assert re.findall("[<>]", preset.name) == signs
    points, (_, right, *_) = view.result.points, view.axes["omega"]
    # Each half of the line goes through its point, to the edge of the picture.
    for name, point in (("stable", points.stable), ("unstable", points.unstable)):
        end = view.columns(f"omega-{name}", "x", "y")[1]
        assert end == approx(np.array(point) * right / np.abs(point).max())
    for layer, count in (("arrows", 2), ("level-arrows", 6)):
        arrows = view.columns(f"omega-{layer}", "x", "y", "angle")
        assert len(arrows) == count
        energies = []
        for w1, w2, angle in arrows:
            rate = np.array(SUSLOV.field([w1, w2, 0.0, 0.0, 1.0], view.result.body.parameters)[:2], float)
            # The triangle of the marker points upwards at angle 0.
            ahead = np.array([-sin(angle), cos(angle)])
            assert ahead @ rate > 0.995 * np.linalg.norm(rate)
            energies.append(energy({**view.values, "w1": w1, "w2": w2}))
        # One on each side of the line, for every ellipse.
        first, second = np.sort(energies).reshape(-1, 2).T
        assert first == approx(second, rel=1e-5)
        assert np.all(np.diff(first) > 0.1)


def test_a_passage_beyond_the_time_span_is_announced_where_it_comes():
    view = View(FREE, {"w2": 1e-300})
    # ω2 = √(I11/I22) ω1 = 3.12 at the top of the ellipse, after growing as e^t and then as 1/cosh: half of 2 · 3.12.
    t = log(2.0 * sqrt(2.44) * 2.0) + 300.0 * log(10.0)
    assert view.report.notes == [f"The passage comes at t = {digits(t)}: choose a longer time span to see it."]


# ---- scattering -------------------------------------------------------------------------------------------------


@every_scattering
def test_captions_and_pictures_are_those_of_the_rotation(preset):
    view = View(SCATTERING, preset.values)
    values, exact, joined = view.values, cos_chi(view.result.body), view.result.map.theta_plus
    assert view.quantities("cos χ = #") == approx([exact], rel=6e-6)
    said, difference = view.numbers("chi", "cos χ = #; the closed form differs by #.")
    assert said == approx(exact, rel=6e-4)
    assert difference < 1e-6
    assert view.numbers("map", "turns ξ by χ = #.") == [shown(acos(exact))]
    assert view.columns("chi-chosen", "x", "y")[0] == approx((values["k"], exact), abs=5e-6)
    (phis,), (curve,) = view.data["curve-theta"]["xs"], view.data["curve-theta"]["ys"]
    assert curve == approx(joined(values["theta"], phis), abs=1e-6)
    if np.ptp(curve) > 1e-3:
        assert view.numbers("curve", "θ⁺ from # to #") == approx([np.min(curve), np.max(curve)], abs=1e-3)
    assert [y for y, _ in view.data["curve-levels"]["ys"]] == approx([values["theta"], pi - values["theta"]])
    # The map holds all curves.
    (grid,) = view.data["map-theta"]["image"]
    rows, columns = grid.shape
    assert [view.data["map-theta"][key][0] for key in ("x", "y", "dw", "dh")] == approx([-pi, 0.0, 2.0 * pi, pi])
    thetas, phis = (np.arange(rows) + 0.5) * pi / rows, -pi + (np.arange(columns) + 0.5) * 2.0 * pi / columns
    assert grid == approx(joined(thetas[:, None], phis), abs=1e-5)
    # The orbit on show joins the circle of the ring.
    assert view.result.orbit.limits[1] == approx(cos(view.data["curve-chosen"]["y"][0]), abs=1e-5)


def test_next_to_a_slanting_line_the_start_is_as_close_as_a_double_can_tell():
    # Where the sphere agrees with the position of the ring to less than a pixel; on an axis nothing is in the way.
    for values, digits_, within in (({"I13": 0.3, "I23": 0.5}, 12.0, 1e-3), ({}, 300.0, 1e-6)):
        view = View(SCATTERING, {**values, "digits": 300.0}, noted=True)
        assert view.values["digits"] == digits_
        assert ["1e−12" in note for note in view.notes] == [True] * bool(values)
        assert view.result.orbit.limits[1] == approx(cos(view.result.theta_plus), abs=within)


@pytest.mark.parametrize(
    "scene, picture, picked",
    [
        (FREE, "omega", {"w1": 0.25, "w2": 1.5}),
        (SCATTERING, "map", {"phi": 0.25, "theta": 1.5}),
        (SCATTERING, "chi", {"k": 0.25}),
        (SCATTERING, "sphere", {}),
    ],
)
def test_a_click_chooses_what_its_axes_say(scene, picture, picked):
    assert View(scene, {}).stage.pick(picture, 0.25, 1.5) == picked
