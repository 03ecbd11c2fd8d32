"""The scenes "free Suslov problem" and "scattering" in a browser: examples, clicks, keys, links, play, refusals."""

from __future__ import annotations

import math
import re
from urllib.parse import parse_qsl, urlencode, urlsplit

import numpy as np
import pytest

from support.free_suslov import (
    FREE,
    SCATTERING,
    axes_of,
    circle_joined,
    cos_chi_on_an_axis,
    ends,
    energy,
    gamma_at,
    integrate,
    rate_of,
    shown,
    start_of,
    tensor_of,
)
from support.page import brought, chosen, flat, said, values_of, wait_frames
from support.painted import SOURCES, assert_painted, track, yellow
from support.pointer import at, click_on
from support.thorough import sample

PLANAR = {"free-suslov": ("omega", "gamma1", "Gamma"), "scattering": ("curve", "map", "chi")}


@pytest.fixture
def free(tab):
    yield brought(tab, FREE)
    tab.assert_quiet()


@pytest.fixture
def scattering(tab):
    yield brought(tab, SCATTERING)
    tab.assert_quiet()


# --- Examples ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", sample(FREE.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_free_motion_is_drawn_with_the_numbers_of_its_captions(free, preset):
    values = chosen(free, FREE, preset)
    assert free.chosen("preset") == preset.name
    omega, gamma, _ = start_of(values)
    past, future = ends(values, omega, gamma)
    _, xi, _ = axes_of(values)
    came, went, other = said(free, "Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert (came, went) == (shown(past[2:] @ xi), shown(future[2:] @ xi))
    if "Γ⁺ = −Γ⁻" in preset.name:
        assert went == other == -came
    if "two circles" in preset.name:
        assert abs(went - other) > 0.05
    assert said(free, "omega", "Rate ω₀ = #, E = #.") == [
        shown(rate_of(values, energy(values, omega))),
        shown(energy(values, omega)),
    ]
    orbit = track(free)
    assert orbit[0] == pytest.approx(
        [values["w1"], values["w2"], *gamma_at(values, math.acos(values["Gamma"]), values["phi"])], abs=1e-6
    )
    # At the end of the time span ω has come to the stable point, and each γ to its circle.
    assert orbit[-1, :2] == pytest.approx(future[:2], abs=2e-3)
    assert orbit[-1, 2:] @ xi == pytest.approx(went, abs=2e-3)
    assert track_of_second(free)[-1] @ xi == pytest.approx(other, abs=2e-3)
    assert_painted(free, FREE)


def track_of_second(explorer):
    data = explorer.data("data-second")
    return np.column_stack([data[name] for name in ("g1", "g2", "g3")])


@pytest.mark.parametrize("preset", sample(SCATTERING.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_scattering_is_drawn_with_the_numbers_of_its_captions(scattering, preset):
    values = chosen(scattering, SCATTERING, preset)
    assert scattering.chosen("preset") == preset.name
    theta, phi, delta = values["theta"], values["phi"], 10.0 ** -values["digits"]
    exact = math.acos(circle_joined(values, theta, phi, delta))
    assert said(scattering, "sphere", "φ = #: from θ⁻ = # to θ⁺ = #.") == [
        shown(phi),
        shown(theta),
        pytest.approx(exact, abs=1e-3),
    ]
    ring = scattering.data("curve-chosen")
    assert (ring["x"][0], ring["y"][0]) == pytest.approx((phi, exact), abs=1e-5)
    curve = scattering.data("curve-theta")
    assert np.interp(phi, curve["xs"][0], curve["ys"][0]) == pytest.approx(exact, abs=1e-4)
    scattering.unfold("chi")
    computed, closed, difference = said(scattering, "chi", "Computed #; closed form #, difference #.")
    if values["I13"] == 0.0:
        assert (computed, closed) == (pytest.approx(cos_chi_on_an_axis(values), abs=6e-6),) * 2
    assert abs(computed - closed) < 2e-6
    assert difference < 1e-6
    if "reversal" in preset.name:
        assert np.ptp(curve["ys"][0]) < 1e-5
        assert curve["ys"][0][0] == pytest.approx(math.pi - theta, abs=1e-5)
    _, xi, _ = axes_of(values)
    orbit = track(scattering)
    assert (orbit[0, 2:] @ xi, orbit[-1, 2:] @ xi) == pytest.approx((math.cos(theta), math.cos(exact)), abs=1e-3)
    assert_painted(scattering, SCATTERING)


def test_an_example_about_gamma_1_sets_what_it_is_drawn_against(free):
    by_time, by_phase = FREE.presets[:2]
    chosen(free, FREE, by_phase)
    assert free.chosen("preset") == by_phase.name
    assert free.data("gamma1-across")["text"] == ["φ"]
    assert free.axes("gamma1")[:2] == pytest.approx([-math.pi, math.pi])
    assert len(free.data("gamma1-first")["xs"]) > 5
    chosen(free, FREE, by_time)
    assert free.chosen("preset") == by_time.name
    assert free.data("gamma1-across")["text"] == ["t"]
    assert free.axes("gamma1")[:2] == [0.0, 30.0]


# --- Clicks ------------------------------------------------------------------------------------------


def test_a_click_in_the_plane_starts_the_motion_there(free):
    unit = click_on(free, "omega", -1.0, 1.5)
    w1, w2 = free.shown("w1")[0], free.shown("w2")[0]
    assert (w1, w2) == (pytest.approx(-1.0, abs=unit[0]), pytest.approx(1.5, abs=unit[1]))
    values = {**FREE.defaults(), "w1": w1, "w2": w2}
    gamma = gamma_at(values, math.acos(values["Gamma"]), values["phi"])
    assert track(free)[0] == pytest.approx([w1, w2, *gamma], abs=1e-6)
    _, future = ends(values, (w1, w2), gamma)
    stable = free.data("omega-stable-point")
    assert (stable["x"][0], stable["y"][0]) == pytest.approx(tuple(future[:2]), abs=1e-6)
    assert free.chosen("preset") == "Choose an example…"
    values = free.wait_url(w1=repr(w1), w2=repr(w2))
    assert values["scene"] == "free-suslov"


def test_a_click_on_the_curve_puts_that_orbit_on_the_sphere(scattering):
    low = scattering.data("curve-theta")
    lowest = int(np.argmin(low["ys"][0]))
    unit = click_on(scattering, "curve", low["xs"][0][lowest], low["ys"][0][lowest])
    phi = scattering.shown("phi")[0]
    assert phi == pytest.approx(low["xs"][0][lowest], abs=unit[0])
    values = {**SCATTERING.defaults(), "phi": phi}
    exact = circle_joined(values, values["theta"], phi, 10.0 ** -values["digits"])
    # The lowest, for θ⁻ = π/2.
    chi = math.acos(cos_chi_on_an_axis(values))
    assert math.acos(exact) == pytest.approx(abs(chi - math.pi / 2), abs=1e-3)
    _, xi, _ = axes_of(values)
    assert track(scattering)[0, 2:] == pytest.approx(gamma_at(values, values["theta"], phi), abs=1e-6)
    assert track(scattering)[-1, 2:] @ xi == pytest.approx(exact, abs=1e-3)
    circles = scattering.data("sphere")["circles"]
    assert [circle[3] for circle in circles] == pytest.approx([0.0, exact], abs=1e-5)


def test_a_drag_along_the_curve_leads_the_ring_along(scattering):
    mouse = scattering.page.mouse
    (x, y), _ = at(scattering, "curve", -2.0, 1.0)
    mouse.move(x, y)
    mouse.down()
    for phi in (-1.0, 1.0, 2.5):
        (x, _), (wide, _) = at(scattering, "curve", phi, 1.0)
        scattering.change(mouse.move, x, y)
        assert scattering.data("curve-chosen")["x"][0] == pytest.approx(phi, abs=2 * wide)
    mouse.up()


def test_a_click_on_the_map_chooses_phase_and_circle(scattering):
    unit = click_on(scattering, "map", -1.5, 2.2)
    phi, theta = scattering.shown("phi")[0], scattering.shown("theta")[0]
    assert (phi, theta) == (pytest.approx(-1.5, abs=unit[0]), pytest.approx(2.2, abs=unit[1]))
    values = {**SCATTERING.defaults(), "phi": phi, "theta": theta}
    exact = math.acos(circle_joined(values, theta, phi, 10.0 ** -values["digits"]))
    # The colour under the ring, the curve beside, and the caption all say the same.
    grid = np.array(scattering.data("map-theta")["image"][0]).reshape(120, 240)
    cell = int(theta / math.pi * 120), int((phi + math.pi) / (2 * math.pi) * 240)
    assert grid[cell] == pytest.approx(exact, abs=0.03)
    assert scattering.data("curve-chosen")["y"][0] == pytest.approx(exact, abs=1e-5)
    assert said(scattering, "sphere", "to θ⁺ = #.") == [shown(exact)]


def test_a_click_on_the_graph_of_cos_chi_chooses_k(scattering):
    scattering.unfold("chi")
    _, _, low, high = scattering.axes("chi")
    unit = click_on(scattering, "chi", 4.4, (low + high) / 2)
    k = scattering.shown("k")[0]
    assert k == pytest.approx(4.4, abs=unit[0])
    values = {**SCATTERING.defaults(), "k": k}
    ring = scattering.data("chi-chosen")
    assert (ring["x"][0], ring["y"][0]) == pytest.approx((k, cos_chi_on_an_axis(values)), abs=1e-5)
    assert f"I₁₁ = {tensor_of(values)[0]:.6g}" in scattering.text("derived")


# --- Keys, boxes, sliders ----------------------------------------------------------------------------


def test_the_slider_of_k_drives_the_inertia_and_F2_comes_and_goes(free):
    slider = free.slider("k")
    slider.focus()
    for _ in range(11):
        free.change(slider.press, "ArrowRight")
    assert free.shown("k")[0] == pytest.approx(2.95)
    assert "F₂: none known" in free.text("derived")
    free.change(slider.press, "ArrowRight")
    # I11 = 1 + 9/4.
    assert "I₁₁ = 3.25" in free.text("derived")
    assert "F₂, degree 3 in ω" in free.text("derived")
    assert re.search(r"F2 \de−\d+", free.text("status"))
    came, went, other = said(free, "Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert went == other == -came
    free.change(slider.press, "ArrowRight")
    assert "F2" not in free.text("status")


def test_while_a_slider_is_held_a_draft_is_drawn_and_then_the_chosen_level(scattering):
    box, mouse = scattering.slider("k").bounding_box(), scattering.page.mouse
    middle = box["y"] + box["height"] / 2
    mouse.move(box["x"] + 0.3 * box["width"], middle)
    scattering.change(mouse.down)
    for share in (0.5, 0.7):
        scattering.change(mouse.move, box["x"] + share * box["width"], middle)
        assert scattering.text("status").startswith("draft:")
        values = {**SCATTERING.defaults(), "k": scattering.shown("k")[1]}
        exact = math.acos(circle_joined(values, values["theta"], values["phi"], 10.0 ** -values["digits"]))
        # To half a pixel of the picture.
        assert scattering.data("curve-chosen")["y"][0] == pytest.approx(exact, abs=0.5 * math.pi / 600)
    scattering.change(mouse.up)
    assert scattering.text("status").startswith("standard:")


@pytest.mark.parametrize(("name", "text"), [("w2", "1e-300"), ("w2", "−1e−300"), ("I23", "-0.5"), ("k", "15")])
def test_a_box_of_the_free_motion_takes_what_is_extreme(free, name, text):
    free.change(free.type, name, text)
    value = float(text.replace("−", "-"))
    assert free.shown(name)[0] == value
    values = {**FREE.defaults(), name: value}
    assert free.wait_url(**{name: repr(value)})["scene"] == "free-suslov"
    assert track(free)[0] == pytest.approx(
        [values["w1"], values["w2"], *gamma_at(values, math.acos(values["Gamma"]), values["phi"])], abs=1e-6
    )
    if name == "w2":
        # It is announced when it comes: ω2 grows as e^t up to twice √2.44 · 2.
        t = math.log(4.0 * math.sqrt(2.44)) + 300.0 * math.log(10.0)
        assert f"The passage comes at t = {t:.1f}" in free.text("notes")


# --- What is no motion -------------------------------------------------------------------------------

NO_XI = "I₁₃ = I₂₃ = 0: without a field ω does not change, and there is no ξ. Choose one of them other than 0."
ON_THE_LINE = (
    "ω(0) lies on the line of equilibria I13ω1 + I23ω2 = 0: ω stays there, and γ turns about ξ for ever. "
    "Move ω off the line."
)
AT_REST = "ω = 0: the body is at rest for ever, h = 0. Choose ω1 or ω2 other than 0."
TOO_OFTEN = "γ turns too often while ω passes from the unstable to the stable point"
NEGATIVE = "k = {} would make I₁₁ = {}; a moment of inertia is positive. Choose a larger k."
REFUSED = [
    (FREE, {"I23": "0"}, NO_XI),
    (FREE, {"w2": "0"}, ON_THE_LINE),
    (FREE, {"w1": "0", "w2": "0"}, AT_REST),
    # I11 = 1 − 9/4, and below 1 − 4 · 0.64.
    (FREE, {"k": "-3"}, NEGATIVE.format("−3", "−1.25")),
    (FREE, {"I23": "1e-5"}, TOO_OFTEN),
    (SCATTERING, {"I23": "0"}, NO_XI),
    (SCATTERING, {"k": "-2"}, NEGATIVE.format("−2", "−1.56")),
    (SCATTERING, {"I23": "1e-5"}, TOO_OFTEN),
]


@pytest.mark.parametrize(
    ("scene", "typed", "sentence"), REFUSED, ids=[f"{scene.name} {typed}" for scene, typed, _ in REFUSED]
)
def test_what_is_no_motion_says_so_and_nothing_stale_stays(tab, scene, typed, sentence):
    explorer = brought(tab, scene)
    sources = explorer.page.evaluate(SOURCES)
    before = {name: explorer.data(name) for name in sources}
    for name, text in typed.items():
        explorer.change(explorer.type, name, text)
    assert explorer.text("status").startswith(sentence)
    assert explorer.text("derived") == ""
    whole = explorer.text("status").split(" · ")[0]
    for picture in scene.pictures:
        assert explorer.caption(picture) == whole
    for name in sources:
        data = flat(explorer.data(name))
        if name.endswith("-message"):
            assert " ".join(next(x for x in data if isinstance(x, str)).split()) == whole
        else:
            assert data == [], name
    assert {f"{picture}-message" for picture in PLANAR[scene.name]} <= set(sources)
    assert explorer.data("sphere") == {"axis": [], "label": "", "circles": [], "marks": []}
    # And all is there again.
    explorer.change(explorer.page.locator(".param-reset").click)
    for name in sources:
        if name.split("-")[0] not in scene.folded:
            assert flat(explorer.data(name)) == flat(before[name]), name
    explorer.assert_quiet()


# --- Links -------------------------------------------------------------------------------------------

LINKED = {
    "free-suslov": {
        "I22": 1.25,
        "I13": 0.25,
        "I23": -0.5,
        "k": 1.75,
        "w1": -1.0,
        "w2": 0.75,
        "Gamma": -0.25,
        "phi": 2.0,
        "phi2": -1.5,
        "span": 17.0,
        "across": "phase",
        "accuracy": "precise",
    },
    "scattering": {
        "I22": 1.25,
        "I13": 0.25,
        "I23": -0.5,
        "k": 1.75,
        "theta": 0.75,
        "phi": -2.0,
        "digits": 4.5,
        "accuracy": "reference",
    },
}


@pytest.mark.parametrize("scene", LINKED)
def test_a_link_restores_the_scene_and_reset_its_first_state(tab, scene):
    kind, linked = {"free-suslov": FREE, "scattering": SCATTERING}[scene], LINKED[scene]
    tab.open(urlencode({"v": 1, "scene": scene, **linked, "az": -1.25, "el": 0.5}))
    assert tab.scene == scene
    assert tab.text("notes") == ""
    assert tab.text("status").startswith(f"{linked['accuracy']}:")
    for name, value in linked.items():
        assert (tab.chosen(name) if isinstance(value, str) else tab.shown(name)[0]) == value
    assert tab.turn == (-1.25, 0.5)
    assert values_of(tab, kind) == linked
    if scene == "free-suslov":
        start = (linked["w1"], linked["w2"], *gamma_at(linked, math.acos(linked["Gamma"]), linked["phi"]))
    else:
        start = (*track(tab)[0, :2], *gamma_at(linked, linked["theta"], linked["phi"]))
        exact = circle_joined(linked, linked["theta"], linked["phi"], 10.0 ** -linked["digits"])
        assert math.cos(tab.data("curve-chosen")["y"][0]) == pytest.approx(exact, abs=1e-6)
    assert track(tab)[0] == pytest.approx(start, abs=1e-6)
    tab.change(tab.page.locator(".param-reset").click)
    for name, value in kind.defaults().items():
        assert (tab.chosen(name) if isinstance(value, str) else tab.shown(name)[0]) == value
    tab.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    tab.change(lambda: tab.slide(I22=1.5))
    tab.page.locator(".param-share").click()
    tab.page.locator(".param-link").click()
    tab.page.keyboard.press("Escape")
    copied = dict(parse_qsl(urlsplit(tab.page.evaluate("navigator.clipboard.readText()")).query))
    assert (copied["scene"], copied["I22"]) == (scene, "1.5")
    tab.assert_quiet()


def test_a_link_with_nonsense_is_put_right_and_said(tab):
    tab.open("scene=free-suslov&w1=abc&k=1e9&Gamma=-7&across=sideways&phi2=nan")
    assert tab.shown("w1")[0] == FREE.defaults()["w1"]
    assert (tab.shown("k")[0], tab.shown("Gamma")[0]) == (50.0, -1.0)
    assert tab.chosen("across") == "time"
    for symbol in ("ω₁", "k", "Γ", "γ₁ against", "φ′"):
        assert symbol in tab.text("notes")
    tab.assert_quiet()


# --- Play --------------------------------------------------------------------------------------------


def test_play_moves_the_points_along_the_motion(free):
    free.change(lambda: free.slide(w2=0.5))
    values = {**FREE.defaults(), "w2": 0.5}
    gamma = gamma_at(values, math.acos(values["Gamma"]), values["phi"])
    before = yellow(free)
    free.page.locator(".param-play").click()
    free.page.wait_for_function("hess.source('Gamma-point').data.x[0] > 0.7")
    free.page.locator(".param-play").click()
    wait_frames(free)
    t = free.time
    (exact,) = integrate(values, (2.0, 0.5), gamma, [t])
    points = {name: free.data(f"{name}-point") for name in ("omega", "gamma1", "Gamma")}
    places = {name: (point["x"][0], point["y"][0]) for name, point in points.items()}
    # Between two samples it runs straight, a quarter of a pixel from the curve at most.
    assert places["omega"] == pytest.approx(tuple(exact[:2]), abs=8e-3)
    assert places["gamma1"] == pytest.approx((t, exact[2]), abs=4e-3)
    # ξ = e1.
    assert places["Gamma"] == pytest.approx((t, exact[2]), abs=4e-3)
    assert yellow(free) != before
    free.change(free.choose, "across", "phase")
    azimuth = math.atan2(exact[4], exact[3])
    point = free.data("gamma1-point")
    assert (point["x"][0], point["y"][0]) == pytest.approx((azimuth, exact[2]), abs=2e-2)


def test_play_moves_the_orbit_of_the_scattering_on_the_sphere(scattering):
    before = yellow(scattering)
    end = float(scattering.page.locator("input.param-t").get_attribute("max"))
    # In units of 1/ω0: as long after the passage as before it.
    assert end == pytest.approx(2.0 * math.log(10.0) * SCATTERING.defaults()["digits"] + 8.0, rel=1e-6)
    scattering.page.locator(".param-speed").select_option("4")
    scattering.page.locator(".param-play").click()
    wait_frames(scattering, 30)
    scattering.page.locator(".param-play").click()
    assert 0.0 < scattering.time < end
    assert yellow(scattering) != before
    scattering.page.locator(".param-speed").select_option("1")


# --- The scenes among the others ---------------------------------------------------------------------


def test_the_scenes_are_entered_from_the_menu_and_share_the_body(tab):
    tab.fresh()
    tab.give(I22=1.5, I23=0.75)
    tab.enter("free-suslov")
    assert (tab.shown("I22")[0], tab.shown("I23")[0]) == (1.5, 0.75)
    assert_painted(tab, FREE)
    tab.change(lambda: tab.slide(k=1.0))
    tab.enter("scattering")
    assert (tab.shown("I22")[0], tab.shown("I23")[0], tab.shown("k")[0]) == (1.5, 0.75, 1.0)
    assert_painted(tab, SCATTERING)
    (curve,) = tab.data("curve-theta")["ys"]
    assert np.ptp(curve) < 1e-5
    tab.enter("free-suslov")
    came, went, other = said(tab, "Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)")
    assert went == other == -came
    tab.enter("suslov-hess")
    tab.assert_quiet()
