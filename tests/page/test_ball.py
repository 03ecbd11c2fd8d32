"""The scenes "Chaplygin ball" and "ball with a field" in a browser: examples, clicks, links, play, refusals."""

from __future__ import annotations

import math
from urllib.parse import urlencode

import numpy as np
import pytest

from hess_explorer.protocol.parameters import Number
from hess_explorer.scenes.framework.periodic_search import NONE
from support.ball import (
    BALL,
    SECTION,
    angles,
    circle_of,
    derivative,
    energy_of,
    first_returns,
    integrate,
    occupied,
    returned,
    shown,
    xi_of,
)
from support.page import brought, chosen, flat, said, wait_frames
from support.painted import SOURCES, assert_painted, track, yellow
from support.pointer import at, click_on, frame
from support.thorough import sample

PLANAR = {"chaplygin-ball": ("omega", "curve", "Gamma"), "ball-section": ("section", "returns", "omega")}


@pytest.fixture
def ball(tab):
    yield brought(tab, BALL)
    tab.assert_quiet()


@pytest.fixture
def field(tab):
    yield brought(tab, SECTION)
    tab.assert_quiet()


def start_of(values):
    """The exact start of the chosen orbit, of which the browser has single precision."""
    state = (BALL if "theta" in values else SECTION).compute(values, ("sphere",), False)
    return state.orbit.path.states[0]


def points(explorer, source):
    data = explorer.data(source)
    return np.column_stack([data["x"], data["y"]])


def assert_follows(explorer, values, times):
    """Assert that the orbit in the browser is that of `eq29`, to half a pixel."""
    data, found = explorer.data("data-orbit"), track(explorer)
    exact = integrate(values, start_of(values), times)
    scale = explorer.axes("omega")[1]
    for i, width in enumerate((scale, scale, 1.0, 1.0, 1.0)):
        assert np.interp(times, data["t"], found[:, i]) == pytest.approx(exact[:, i], abs=width / 500 + 1e-5)


# --- Examples ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", sample(BALL.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_the_ball_is_drawn_with_the_numbers_of_its_captions(ball, preset):
    values = chosen(ball, BALL, preset)
    assert ball.chosen("preset") == preset.name
    xi, start = xi_of(values), start_of(values)
    end = integrate(values, start, [1.3 * values["span"]])[-1]
    left, joined = said(ball, "sphere", "Γ = # at the start, Γ = # at the end")
    assert left == shown(math.cos(values["theta"]))
    assert joined == pytest.approx(end[2:4] @ xi, abs=2e-3)
    ring = ball.data("curve-chosen")
    assert (ring["x"][0], ring["y"][0]) == pytest.approx((values["phi"], circle_of(values, end)), abs=4e-3)
    assert_follows(ball, values, np.linspace(0.0, 0.5 * values["span"], 4))
    # ω lies in the strip.
    squares, moments = track(ball)[:, :2] ** 2, np.array([values["I11"], values["I22"]])
    assert np.max(squares @ moments) <= 2.0 * values["h"] * (1.0 + 1e-5)
    assert np.min(squares @ (moments + values["D"])) >= 2.0 * values["h"] * (1.0 - 1e-5)
    curve, free = (np.array(ball.data(f"curve-{name}")["ys"][0]) for name in ("ball", "free"))
    if values["D"] == 0.0:
        assert np.max(np.abs(curve - free)) < 1e-3
    if "reversal" in preset.name:
        assert said(ball, "curve", "θ⁺ = # for every φ") == [shown(math.pi - values["theta"])]
    else:
        assert said(ball, "curve", "θ⁺ from # to #") == pytest.approx([curve.min(), curve.max()], abs=6e-4)
    assert len(ball.data("omega-arcs")["xs"]) == len(ball.data("omega-arrows")["x"]) == 18
    assert_painted(ball, BALL)


@pytest.mark.parametrize("preset", sample(SECTION.presets, 3), ids=lambda preset: preset.name)
def test_an_example_with_a_field_is_drawn_with_the_numbers_of_its_captions(field, preset):
    values = chosen(field, SECTION, preset)
    assert field.chosen("preset") == preset.name
    E = values["h"] - math.hypot(values["b1"], values["b2"])
    assert said(field, "omega", "E = #.") == [shown(E)]
    assert np.max(np.abs(energy_of(values, track(field)) - E)) < 1e-5
    assert_follows(field, values, np.array([1.0, 4.0]))
    if values["periodic"] != NONE:
        place = points(field, "section-repels")[0]
        assert returned(values, place) == pytest.approx(place, abs=1e-5)
        exact = sorted(np.linalg.eigvals(derivative(values, place)), key=abs, reverse=True)
        assert said(field, "section", "Period 1, saddle with reflection. Multipliers μ = #, #, to #")[
            :2
        ] == pytest.approx(exact, abs=1e-3)
        return
    own = points(field, "section-own")
    count, cells, of = said(field, "section", "Chosen orbit: # points in # of # cells")
    assert (count, of) == (len(own), 1024)
    assert cells == pytest.approx(len(occupied(own)), abs=2)
    if values["drop"] == "all":
        assert own[:2] == pytest.approx(angles(first_returns(values, start_of(values), 2)), abs=1e-4)
    assert points(field, "section-chosen")[0] == pytest.approx((values["psi"], values["delta"]))
    assert_painted(field, SECTION)


# --- Clicks and sliders ------------------------------------------------------------------------------


def test_a_click_on_the_curve_chooses_the_phase(ball):
    unit = click_on(ball, "curve", -1.5, 1.0)
    phi = ball.shown("phi")[0]
    assert phi == pytest.approx(-1.5, abs=unit[0])
    values = {**BALL.defaults(), "phi": phi}
    end = integrate(values, start_of(values), [80.0])[-1]
    assert ball.data("curve-chosen")["y"][0] == pytest.approx(circle_of(values, end), abs=4e-3)
    assert ball.data("sphere")["circles"][1][3] == pytest.approx(end[2:4] @ xi_of(values), abs=1e-4)
    assert ball.wait_url(phi=repr(phi))["scene"] == "chaplygin-ball"


def test_a_drag_along_the_curve_leads_the_ring_along(ball):
    mouse = ball.page.mouse
    (x, y), _ = at(ball, "curve", -2.0, 1.0)
    mouse.move(x, y)
    mouse.down()
    for phi in (-1.0, 2.0):
        (x, _), (wide, _) = at(ball, "curve", phi, 1.0)
        ball.change(mouse.move, x, y)
        assert ball.data("curve-chosen")["x"][0] == pytest.approx(phi, abs=2 * wide)
    mouse.up()


def test_a_click_in_the_section_starts_the_orbit_there(field):
    unit = click_on(field, "section", -2.0, 0.7)
    psi, delta = field.shown("psi")[0], field.shown("delta")[0]
    assert (psi, delta) == (pytest.approx(-2.0, abs=unit[0]), pytest.approx(0.7, abs=unit[1]))
    values = {**SECTION.defaults(), "psi": psi, "delta": delta}
    returned = angles(first_returns(values, start_of(values), 2))
    assert points(field, "section-own")[:2] == pytest.approx(returned, abs=1e-4)
    assert track(field)[0, 2:] == pytest.approx((math.cos(psi), math.sin(psi), 0.0), abs=1e-6)
    assert field.chosen("preset") == "Choose an example…"
    # The plane of ω takes none.
    before = field.state
    left, top, right, bottom = frame(field, "omega")
    field.page.mouse.click((left + right) / 2, (top + bottom) / 2)
    wait_frames(field)
    assert field.state == before


def test_a_click_finds_the_periodic_orbit_next_to_it_and_undo_brings_the_one_before(field):
    page = field.page

    def found(source):
        page.wait_for_function(f"(hess.source('section-{source}')?.data.x ?? []).length > 0")
        return points(field, f"section-{source}")

    field.change(field.choose, "periodic", "period 1")
    saddle = found("repels")
    page.wait_for_function("(hess.source('section-stable-manifold')?.data.xs ?? []).length > 1")
    assert "\nPeriod 1, saddle. Multipliers μ = 2.19, 0.4566, to " in field.caption("section")
    assert "4 of 4 branches of its manifolds are 5 long" in field.text("derived")
    # Its orbit is that in the other pictures, and closes.
    values = {**SECTION.defaults(), "psi": float(saddle[0, 0]), "delta": float(saddle[0, 1])}
    assert angles(first_returns(values, start_of(values), 1)) == pytest.approx(saddle, abs=1e-4)
    assert track(field)[-1] == pytest.approx(track(field)[0], abs=1e-4)
    field.change(field.choose, "periodic", "period 2")
    click_on(field, "section", -0.25, 1.5)
    elliptic = found("neither")
    assert len(elliptic) == 2
    assert np.abs(elliptic - (-0.25, 1.5)).max(axis=1).min() < 0.3
    assert not len(field.data("section-repels")["x"])
    field.wait_url(periodic="period 2")
    field.change(page.locator(".param-undo").click)
    field.change(page.locator(".param-undo").click)
    assert found("repels") == pytest.approx(saddle, abs=1e-6)


def test_a_click_into_what_is_forbidden_moves_to_its_edge_and_says_so(field):
    field.change(field.type, "h", "0.3")
    click_on(field, "section", 0.5, 1.0)
    # E = −0.2 and b = (½, 0, 0.8): |ψ| > arccos(−0.4).
    assert field.shown("psi")[0] == pytest.approx(math.acos(-0.4), abs=5e-3)
    assert "γ cannot point at ψ = 0." in field.text("notes")
    assert np.all(np.cos(points(field, "section-own")[:, 0]) <= -0.4 + 1e-3)
    click_on(field, "section", 2.5, 1.0)
    assert field.text("notes") == ""


def test_dragging_the_inner_ball_to_nothing_closes_the_strip(ball):
    box, mouse = ball.slider("D").bounding_box(), ball.page.mouse
    middle = box["y"] + box["height"] / 2
    mouse.move(box["x"] + 0.7 * box["width"], middle)
    ball.change(mouse.down)
    for share in (0.3, 0.1, -0.1):
        ball.change(mouse.move, box["x"] + share * box["width"], middle)
        assert len(ball.data("omega-arcs")["xs"]) == 8
        assert ball.text("status").startswith("draft:")
    ball.change(mouse.up)
    assert ball.text("status").startswith("standard:")
    assert ball.shown("D") == (0.0, 0.0)
    (outer,), (inner,) = ball.data("omega-forbidden")["xs"]
    assert np.array_equal(outer[1], inner[0])
    assert np.max(np.abs(np.subtract(*(ball.data(f"curve-{name}")["ys"][0] for name in ("ball", "free"))))) < 1e-3


# --- What cannot be ----------------------------------------------------------------------------------

NO_LINE = "I13 = I23 = 0: there is no line of equilibria. Choose I13 or I23 other than 0."


def test_a_ball_without_a_line_of_rest_says_so_and_nothing_stale_stays(ball):
    sources = ball.page.evaluate(SOURCES)
    before = {name: ball.data(name) for name in sources}
    ball.change(ball.type, "I13", "0")
    ball.change(ball.type, "I23", "0")
    assert ball.text("status").startswith(NO_LINE)
    assert ball.text("derived") == ""
    for picture in BALL.pictures:
        assert ball.caption(picture) == NO_LINE
    for name in sources:
        data = flat(ball.data(name))
        assert data == [] or name.endswith("-message"), name
    ball.change(ball.page.locator(".param-reset").click)
    ball.unfold("Gamma")
    for name in sources:
        assert name.startswith("Gamma") or flat(ball.data(name)) == flat(before[name]), name
    assert flat(ball.data("Gamma-message")) == []


@pytest.mark.parametrize(
    ("name", "text", "value", "words"),
    [
        ("D", "-1", 0.0, "𝒟 must lie between 0 and 300"),
        ("h", "0", 1e-6, "h must lie between 1e-06 and 1e+06"),
        ("theta", "4", math.pi, "θ⁻ must lie between 0 and"),
        ("I11", "-2", 1e-3, "I₁₁ must lie between 0.001 and 1000"),
        ("digits", "99", 10.0, "−lg δ must lie between 2 and 10"),
    ],
)
def test_a_number_that_cannot_be_is_put_right_and_said(ball, name, text, value, words):
    ball.change(ball.type, name, text)
    assert ball.shown(name)[0] == pytest.approx(value)
    assert words in ball.text("notes")
    assert_painted(ball, BALL)


def test_where_the_whole_map_takes_long_its_draft_stays_with_a_sentence(ball):
    for name, text in {"D": "300", "digits": "10"}.items():
        ball.change(ball.type, name, text)
    assert "choose larger I13 or I23, or a smaller 𝒟." in ball.text("notes")
    assert len(ball.data("curve-ball")["ys"][0]) == 33
    assert "33 phases, error ≤" in ball.text("status")
    ball.change(ball.page.locator(".param-reset").click)
    assert len(ball.data("curve-ball")["ys"][0]) == 65
    assert ball.text("notes") == ""


def test_a_map_that_takes_long_is_left_out_with_a_sentence(ball):
    for name, text in {"I13": "1e-3", "I23": "1e-3", "digits": "10"}.items():
        ball.change(ball.type, name, text)
    assert "choose larger I13 or I23, or a smaller 𝒟." in ball.text("notes")
    assert ball.caption("curve").endswith("Left out: too many steps.")
    assert_painted(ball, BALL)
    for layer in ("ball", "free", "chosen", "levels"):
        assert flat(ball.data(f"curve-{layer}")) == []
    assert " ".join(ball.data("curve-message")["text"][0].split()) == ball.text("notes")
    assert len(ball.data("data-orbit")["t"]) > 10
    ball.change(ball.page.locator(".param-reset").click)
    assert len(ball.data("curve-ball")["ys"][0]) == 65
    assert flat(ball.data("curve-message")) == []


@pytest.mark.parametrize(
    "typed",
    sample(
        [
            {"h": "1e-3"},
            {"delta": "0"},
            {"delta": "9"},
            {"D": "0"},
            {"b1": "0", "b3": "0"},
            {"I13": "20", "I23": "-20"},
        ],
        3,
    ),
    ids=str,
)
def test_an_extreme_ball_with_a_field_is_drawn(field, typed):
    for name, text in typed.items():
        field.change(field.type, name, text)
    if "delta" in typed:
        assert "δ must lie between" in field.text("notes")
    if "b1" in typed:
        assert "No field" in field.caption("sphere")
    values = {spec.name: field.shown(spec.name)[0] for spec in SECTION.specs if isinstance(spec, Number)}
    E = values["h"] - math.hypot(values["b1"], values["b2"])
    assert np.max(np.abs(energy_of(values, track(field)) - E)) < 1e-4 * (1.0 + abs(E))
    assert_painted(field, SECTION)


# --- Links, play, the menu ---------------------------------------------------------------------------

LINKED = {
    "chaplygin-ball": {
        "I11": 1.25,
        "I22": 0.75,
        "I13": 0.25,
        "I23": -0.5,
        "D": 1.5,
        "h": 2.5,
        "theta": 0.75,
        "phi": -2.0,
        "digits": 4.5,
        "span": 33.0,
        "certain": "not shown",
        "accuracy": "precise",
    },
    "ball-section": {
        "I11": 1.25,
        "I22": 0.75,
        "I13": 0.25,
        "I23": -0.5,
        "D": 1.5,
        "b1": 0.25,
        "b2": -0.5,
        "b3": 0.75,
        "h": 2.5,
        "psi": -1.0,
        "delta": 0.75,
        "count": 100.0,
        "span": 33.0,
        "drop": "the later half",
        "periodic": "none",
        "reach": 7.5,
        "over": "I₁₃",
        "low": 0.25,
        "high": 0.5,
        "upwards": "δ",
        "certain": "not shown",
        "indicator": "MEGNO",
        "accuracy": "draft",
    },
}


@pytest.mark.parametrize("scene", [BALL, SECTION], ids=lambda scene: scene.name)
def test_a_link_restores_the_scene_and_reset_its_first_state(tab, scene):
    linked = LINKED[scene.name]
    assert set(linked) == {spec.name for spec in scene.specs}
    tab.open(urlencode({"v": 1, "scene": scene.name, **linked, "az": -1.25, "el": 0.5}))
    assert (tab.scene, tab.text("notes"), tab.turn) == (scene.name, "", (-1.25, 0.5))
    for name, value in linked.items():
        assert (tab.chosen(name) if isinstance(value, str) else tab.shown(name)[0]) == value
    assert_follows(tab, linked, np.array([1.0, 3.0]))
    tab.change(tab.page.locator(".param-reset").click)
    for name, value in scene.defaults().items():
        assert (tab.chosen(name) if isinstance(value, str) else tab.shown(name)[0]) == value
    tab.assert_quiet()


@pytest.mark.parametrize("scene", [BALL, SECTION], ids=lambda scene: scene.name)
def test_play_moves_the_points_along_the_orbit(tab, scene):
    explorer = brought(tab, scene)
    before = yellow(explorer)
    explorer.page.locator(".param-play").click()
    wait_frames(explorer, 60)
    explorer.page.locator(".param-play").click()
    wait_frames(explorer)
    t = explorer.time
    assert t > 0.2
    values = scene.defaults()
    (exact,) = integrate(values, start_of(values), [t])
    assert points(explorer, "omega-point")[0] == pytest.approx(exact[:2], abs=explorer.axes("omega")[1] / 200)
    if scene is BALL:
        assert points(explorer, "Gamma-point")[0] == pytest.approx((t, exact[2:4] @ xi_of(values)), abs=6e-3)
    assert yellow(explorer) != before
    explorer.assert_quiet()


def test_the_body_goes_from_scene_to_scene(tab):
    brought(tab, BALL).give(I11=1.25, I23=0.5, D=2.5)
    tab.enter("ball-section")
    assert [tab.shown(name)[0] for name in ("I11", "I23", "D")] == [1.25, 0.5, 2.5]
    assert_painted(tab, SECTION)
    tab.enter("chaplygin-ball")
    assert [tab.shown(name)[0] for name in ("I11", "I23", "D")] == [1.25, 0.5, 2.5]
    assert_painted(tab, BALL)
