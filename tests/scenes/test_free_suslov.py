"""The scenes "free Suslov problem" and "scattering": every example shows what its name and its captions promise.

The numbers beside the pictures are held against the general Suslov system, integrated without anything of the free
motion's formulas, and against closed forms written out here.
"""

import re
from itertools import pairwise
from math import acos, atan2, cos, log, pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import SuslovBody, additional_integral
from hess_mechanics.suslov.additional_integral import formula
from support.free_suslov import (
    FREE,
    SCATTERING,
    SUSLOV,
    axes_of,
    circle_joined,
    cos_chi_on_an_axis,
    ends,
    energy,
    integrate,
    rate_of,
    shown,
    start_of,
    tensor_of,
)
from support.view import View, example

every_free = pytest.mark.parametrize("preset", FREE.presets, ids=lambda preset: preset.name)
every_scattering = pytest.mark.parametrize("preset", SCATTERING.presets, ids=lambda preset: preset.name)


# ---- the free Suslov problem ------------------------------------------------------------------------------------


@every_free
def test_the_rate_the_energy_and_the_last_turning_are_those_of_the_paper(preset):
    view = View(FREE, preset.values)
    I11, I22, I13, I23 = tensor_of(view.values)
    h = energy(view.values, (view.values["w1"], view.values["w2"]))
    J, xi, _ = axes_of(view.values)
    # biz138, its denominator corrected: |ω±| = J √(2h/(I11 I23² + I22 I13²)).
    size = J * sqrt(2.0 * h / (I11 * I23**2 + I22 * I13**2))
    rate, E = view.numbers("omega", "Rate ω₀ = #, E = #.")
    (speed,) = view.numbers("gamma1", "By # radians per unit of time")
    assert (rate, E, speed) == (shown(rate_of(view.values, h)), shown(h), shown(size))
    assert view.derived("I₁₁ = #")[0] == approx(I11, rel=6e-4)
    assert view.derived("ω₀ = #")[0] == approx(rate_of(view.values, h), rel=6e-4)
    points = {name: [view.data[f"omega-{name}-point"][axis][0] for axis in "xy"] for name in ("stable", "unstable")}
    assert points["stable"] == approx(-size * xi[:2], rel=1e-6)
    assert points["unstable"] == approx(size * xi[:2], rel=1e-6)


@every_free
def test_the_orbits_come_from_the_circle_and_go_to_the_circles_that_are_said(preset):
    view = View(FREE, preset.values)
    omega, gamma, _ = start_of(view.values)
    past, future = ends(view.values, omega, gamma)
    _, xi, eta = axes_of(view.values)
    came, went, other = view.numbers("Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert (came, went) == (shown(past[2:] @ xi), shown(future[2:] @ xi))
    # The second orbit, from where it is drawn to start (next to the line it shares the first part with nothing).
    first = view.result.second.gamma[0]
    if abs(view.values["w2"]) < 1e-290:
        t = log(1e-7) - log(view.values["w2"])
        turned = complex(first[1], first[2]) * np.exp(-2j * t)
        first = np.array([first[0], turned.real, turned.imag])
    second_past, second_future = ends(view.values, omega, first)
    assert came == shown(second_past[2:] @ xi)
    assert other == shown(second_future[2:] @ xi)
    assert second_past[2:] @ xi == approx(past[2:] @ xi, abs=1e-6)
    # Both turn alike there, φ′ − φ apart.
    phases = [atan2(end[4], end[2:] @ eta) for end in (past, second_past)]
    asked = view.values["phi2"] - view.values["phi"]
    assert np.exp(1j * (phases[1] - phases[0])) == approx(np.exp(1j * asked), abs=1e-5)
    # The circles on the sphere are these.
    heights = [height for *_, height, look in view.data["sphere"]["circles"] if look != "muted"]
    assert heights == shown([came, went, other])


@every_free
def test_the_curves_are_those_of_the_general_system(preset):
    view = View(FREE, preset.values)
    omega, gamma, since = start_of(view.values)
    _, xi, eta = axes_of(view.values)
    orbit = {name: np.asarray(column, float) for name, column in view.data["data-orbit"].items()}
    assert orbit["t"][0] == 0.0
    assert orbit["t"][-1] == approx(view.values["span"], rel=1e-6)
    chosen = np.flatnonzero((orbit["t"] > since) & (orbit["t"] < since + 25.0))[::17]
    assert chosen.size > 10
    exact = integrate(view.values, omega, gamma, orbit["t"][chosen] - since)
    # Times are in single precision: what the state does in half of their last digit is none of its errors.
    rates = np.abs(SUSLOV.field(exact.T, (*tensor_of(view.values), 0.0, 0.0, 0.0))).T
    rounding = np.spacing(orbit["t"][chosen].astype(np.float32))[:, None] / 2 * rates
    found = np.column_stack([orbit[name][chosen] for name in ("omega1", "omega2", "g1", "g2", "g3")])
    near = 2e-6 if since == 0.0 else 1e-5
    assert np.max(np.abs(found - exact) - rounding) < near
    assert orbit["Gamma"][chosen] == approx(found[:, 2:] @ xi, abs=1e-6)
    curve = view.data["gamma1-first"]
    x, y = np.concatenate(curve["xs"]), np.concatenate(curve["ys"])
    if view.values["across"] == "time":
        assert len(curve["xs"]) == 1
        assert x == approx(orbit["t"])
        assert y == approx(orbit["g1"])
        assert view.data["gamma1-across"]["text"] == ["t"]
    else:
        # Against the azimuth; each part of the curve goes on where the last one left, at the other edge.
        phase = np.arctan2(exact[:, 4], exact[:, 2:] @ eta)
        assert np.exp(1j * orbit["across"][chosen]) == approx(np.exp(1j * phase), abs=1e-5)
        ends_ = [(part[0], part[-1]) for part in curve["xs"]]
        assert len(ends_) > 5
        for (_, left), (entered, _) in pairwise(ends_):
            assert abs(left) == approx(pi)
            assert entered == approx(-left)
        heights = [(part[0], part[-1]) for part in curve["ys"]]
        assert all(a[1] == b[0] for a, b in pairwise(heights))
        assert all(np.max(np.abs(np.diff(part))) < pi for part in curve["xs"])
        assert view.data["gamma1-across"]["text"] == ["φ"]


@pytest.mark.parametrize("k, name", [(1, "Γ(t), k = 1"), (3, "Γ(t), k = 3")])
def test_with_F2_both_orbits_join_the_mirrored_circle_and_F2_is_that_of_the_paper(k, name):
    view = example("free-suslov", name)
    came, went, other = view.numbers("Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert went == other == -came
    for end in (view.result.orbit.limits[1], view.result.second.limits[1]):
        assert end == approx(-view.result.orbit.limits[0], abs=1e-7)
    f, minus, plus = view.numbers("sphere", "F₂ = #; Γ = # on C⁻, Γ = # on C⁺.")
    assert (minus, plus) == (came, went)
    body = SuslovBody(*tensor_of(view.values))
    F2, (omega, gamma, _) = additional_integral(k, body), start_of(view.values)
    assert f == shown(F2(omega, gamma))
    # Its level is, for some ω on the way, the grey circle (V(ω), γ) = f, where V is what F2 has before γ.
    turn = np.linspace(0.0, pi, 20001)
    way = np.column_stack([np.cos(turn) / sqrt(body.I11), np.sin(turn) / sqrt(body.I22)])
    V = F2.vector(sqrt(2.0 * energy(view.values, omega)) * way)
    length = np.linalg.norm(V, axis=1)
    grey = [circle for circle in view.data["sphere"]["circles"] if circle[4] == "muted"]
    # Enough to see how it turns, and few enough to see the orbits.
    assert len(grey) == 4
    for *axis, height, _ in grey:
        nearest = np.argmin(np.linalg.norm(V / length[:, None] - axis, axis=1))
        assert V[nearest] / length[nearest] == approx(axis, abs=1e-3)
        assert F2(omega, gamma) / length[nearest] == approx(height, abs=1e-3)
    assert "F2" in view.report.status
    assert re.sub(r"\s", "", formula(k)) in re.sub(r"\s", "", FREE.words)


@pytest.mark.parametrize("name", ["Γ(t), k = 1.5", "Γ(t), I₁₃ ≠ 0"])
def test_without_F2_two_phases_join_two_circles(name):
    view = example("free-suslov", name)
    _, went, other = view.numbers("sphere", "From Γ⁻ = # to Γ⁺ = # and #.")
    assert abs(went - other) > 0.05
    assert "F₂: none known" in " ".join(view.report.derived)
    assert (view.values["I13"] != 0.0) == ("I₁₃ ≠ 0" in name)


PORTRAITS = [preset for preset in FREE.presets if preset.name.startswith("Portrait")]


@pytest.mark.parametrize("preset", PORTRAITS, ids=lambda preset: preset.name)
def test_a_portrait_has_the_signs_of_its_name_and_arrows_along_the_flow(preset):
    view = View(FREE, preset.values)
    I11, I22, I13, I23 = tensor_of(view.values)
    signs = [">" if x > 0 else "<" for x in (I13, I23)]
    assert re.findall("[<>]", preset.name) == signs
    # Each half of the line is told apart by the sign of the eigenvalue of biz132 along the ellipse there.
    for name, sign in (("stable", -1.0), ("unstable", 1.0)):
        x, y = (np.asarray(view.data[f"omega-{name}"][axis], float) for axis in "xy")
        assert I13 * x + I23 * y == approx(np.zeros(2), abs=1e-6)
        w1, w2 = x[1], y[1]
        # ∂ω̇1/∂ω1 + ∂ω̇2/∂ω2; the other eigenvalue is 0.
        assert sign * (-I13 * w2 / I11 + I23 * w1 / I22) > 0.0
        # To the edge of the picture.
        _, right, *_ = view.axes["omega"]
        assert max(abs(w1), abs(w2)) == approx(right)
    for layer, count in (("arrows", 2), ("level-arrows", 6)):
        arrows = view.data[f"omega-{layer}"]
        assert len(arrows["x"]) == count
        energies = set()
        for w1, w2, angle in zip(arrows["x"], arrows["y"], arrows["angle"], strict=True):
            rate = np.array(SUSLOV.field([w1, w2, 0.0, 0.0, 1.0], (I11, I22, I13, I23, 0.0, 0.0, 0.0))[:2], float)
            # The triangle of the marker points upwards at angle 0.
            ahead = np.array([-sin(angle), cos(angle)])
            assert ahead @ rate > 0.995 * np.linalg.norm(rate)
            energies.add(round(energy(view.values, (w1, w2)), 6))
        # One on each side of the line, for every ellipse.
        assert len(energies) == count // 2


def test_a_passage_beyond_the_time_span_is_announced_where_it_comes():
    view = View(FREE, {"w2": 1e-300})
    (note,) = view.report.notes
    # ω2 = √(I11/I22) ω1 = 3.12 at the top of the ellipse, after growing as e^t and then as 1/cosh: half of 2 · 3.12.
    t = log(2.0 * sqrt(2.44) * 2.0) + 300.0 * log(10.0)
    assert float(re.search(r"t = ([\d.]+)", note)[1]) == shown(t)


# ---- scattering -------------------------------------------------------------------------------------------------


@every_scattering
def test_cos_chi_computed_and_in_closed_form_are_both_right(preset):
    view = View(SCATTERING, {**preset.values, "accuracy": "reference"})
    said, difference = view.numbers("chi", "cos χ = #; the closed form differs by #.")
    computed = view.result.limit.cos_chi
    if view.values["I13"] == 0.0:
        exact = cos_chi_on_an_axis(view.values)
        assert computed == approx(exact, abs=2e-12)
    else:
        # ξ itself goes to the circle χ: from 1e-6 of the unstable point, to 1e-6.
        exact = circle_joined(view.values, 0.0, 0.0, 1e-6)
        assert computed == approx(exact, abs=5e-6)
    assert view.derived("cos χ = #")[0] == approx(computed, rel=6e-6)
    assert said == approx(exact, rel=6e-4)
    assert difference < 1e-13
    (chi,) = view.numbers("map", "turns ξ by χ = #.")
    assert cos(chi) == approx(exact, abs=1e-3)
    assert (view.data["chi-chosen"]["x"][0], view.data["chi-chosen"]["y"][0]) == approx(
        (view.values["k"], exact), abs=5e-6
    )


@every_scattering
def test_the_curve_leads_where_the_general_system_does_whatever_the_energy(preset):
    view = View(SCATTERING, preset.values)
    delta = 10.0 ** -view.values["digits"]
    (phis,), (curve,) = view.data["curve-theta"]["xs"], view.data["curve-theta"]["ys"]
    for i, h in ((40, 0.3), (170, 2.0), (301, 50.0)):
        exact = circle_joined(view.values, view.values["theta"], float(phis[i]), delta, h)
        assert cos(curve[i]) == approx(exact, abs=2e-6)
    # From the lowest to the highest: the image of the circle θ⁻ about an axis turned by χ.
    theta = view.values["theta"]
    chi = acos(view.derived("cos χ = #")[0])
    low, high = abs(chi - theta), min(chi + theta, 2.0 * pi - chi - theta)
    assert (np.min(curve), np.max(curve)) == (approx(low, abs=5e-4), approx(high, abs=5e-4))
    if high - low > 1e-3:
        assert view.numbers("curve", "θ⁺ from # to #") == [approx(low, abs=1e-3), approx(high, abs=1e-3)]
    assert view.data["curve-levels"]["y0"] == approx([theta, pi - theta])


@every_scattering
def test_the_map_holds_all_curves(preset):
    view = View(SCATTERING, preset.values)
    (grid,) = view.data["map-theta"]["image"]
    rows, columns = grid.shape
    thetas = (np.arange(rows) + 0.5) * pi / rows
    phis = -pi + (np.arange(columns) + 0.5) * 2.0 * pi / columns
    assert [view.data["map-theta"][key][0] for key in ("x", "y", "dw", "dh")] == approx([-pi, 0.0, 2.0 * pi, pi])
    # The mean of cos θ⁺ over a circle is cos χ cos θ⁻.
    assert np.cos(grid).mean(axis=1) == approx(view.derived("cos χ = #")[0] * np.cos(thetas), abs=1e-5)
    exact = circle_joined(view.values, thetas[rows // 3], phis[columns // 5], 10.0 ** -view.values["digits"])
    assert cos(grid[rows // 3, columns // 5]) == approx(exact, abs=2e-6)


def test_next_to_a_slanting_line_the_start_is_as_close_as_a_double_can_tell():
    slanting = {"I13": 0.3, "I23": 0.5, "digits": 300.0}
    values, (note,) = SCATTERING.admit({**SCATTERING.defaults(), **slanting})
    assert values["digits"] == 12.0
    assert "1e−12" in note
    result = SCATTERING.compute(values, SCATTERING.pictures, False)
    # The sphere agrees with the position of the ring to less than a pixel.
    assert result.orbit.limits[1] == approx(cos(float(result.map.theta_plus(values["theta"], values["phi"]))), abs=1e-3)
    # On an axis nothing is in the way.
    straight = View(SCATTERING, {"digits": 300.0})
    assert straight.result.orbit.limits[1] == approx(cos(float(straight.result.map.theta_plus(pi / 2, 0.5))), abs=1e-6)


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
