"""The four pictures: they show the computed results, and each responds to the mouse."""

from __future__ import annotations

import math
import re
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from hess_explorer.views import theme
from hess_mechanics import circle_map, f_max, level, solve, systems, trace_on_curve, turning_points
from support.mechanics import angle_between, lifted_return
from support.page import DEFAULTS, FIND, PICTURES
from support.painted import assert_captions_fit
from support.pointer import HOME, STEP, assert_turned, at
from support.suslov_hess import assert_orbit, body_of, exact_states
from support.thorough import sample

REFERENCE = level("reference")
PRESETS = {preset.name: {**DEFAULTS, **preset.values} for preset in scenes()["suslov-hess"].presets}
a = DEFAULTS["I23"] / DEFAULTS["I22"]


def choose(explorer, name):
    """Choose an example, unless the page shows it already, and return its values."""
    if explorer.chosen("preset") != name:
        explorer.change(explorer.choose, "preset", name)
    return PRESETS[name]


# --- Where things are on the screen ------------------------------------------------------------------


def picture(explorer, clip):
    """Return the screen region (x, y, width, height) as an RGB array."""
    x, y, width, height = clip
    shot = explorer.page.screenshot(clip={"x": x, "y": y, "width": width, "height": height})
    return np.asarray(Image.open(BytesIO(shot)).convert("RGB")).astype(int)


def like(pixels, colour, tolerance=24):
    """Return a mask of the pixels of this colour."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return np.abs(pixels - rgb).max(axis=-1) <= tolerance


# --- Choosing by hand --------------------------------------------------------------------------------


@pytest.mark.parametrize(("h", "f"), [(0.5, 0.4), (2.75, -1.5), (-0.5, 0.3), (3.6, 0.0)])
def test_a_click_in_the_bifurcation_diagram_chooses_the_torus_under_it(explorer, h, f):
    (x, y), (wide, high) = at(explorer, "bifurcation", h, f)
    x, y = round(x), round(y)
    explorer.change(explorer.page.mouse.click, x, y)
    found = explorer.here()
    assert found[0] == pytest.approx(h, abs=wide)
    assert found[1] == pytest.approx(f, abs=high)
    # The controls follow, to the last digit, and so does all the rest.
    values = {**DEFAULTS, "h": explorer.shown("h")[0], "f": explorer.shown("f")[0]}
    assert (values["h"], values["f"]) == pytest.approx(found, rel=1e-6)
    assert_orbit(explorer, values)
    # At t = 0 n3 turns, so the moving point stands in the middle of the ring: under the pointer.
    explorer.page.mouse.move(5, 5)
    rows, columns = np.nonzero(like(picture(explorer, (x - 9, y - 9, 18, 18)), theme.POINT))
    assert rows.size > 40
    assert (columns.mean() - 8.5, rows.mean() - 8.5) == pytest.approx((0, 0), abs=1.5)


def test_a_click_where_no_motion_is_chooses_the_edge_and_says_so(explorer):
    (x, y), (wide, _) = at(explorer, "bifurcation", -0.5, 2.0)
    explorer.change(explorer.page.mouse.click, x, y)
    h, f = explorer.here()
    assert h == pytest.approx(-0.5, abs=wide)
    n = (math.sqrt(h * h + 3) - h) / 3
    assert f == pytest.approx(math.sqrt(2 * (h + n) * (1 - n * n)), rel=1e-5)
    assert "f is at that edge" in explorer.text("notes")


def test_a_drag_in_the_bifurcation_diagram_is_followed(explorer):
    axes = explorer.axes("bifurcation")
    path = [(0.2, 0.3), (0.6, 0.2), (1.4, -0.2), (2.2, -0.7), (2.9, -1.1)]
    (x, y), (wide, high) = at(explorer, "bifurcation", *path[0])
    explorer.page.mouse.move(x, y)
    explorer.page.mouse.down()
    for h, f in path[1:]:
        (x, y), _ = at(explorer, "bifurcation", h, f)
        explorer.change(explorer.page.mouse.move, x, y)
        assert explorer.here()[0] == pytest.approx(h, abs=wide)
        assert explorer.here()[1] == pytest.approx(f, abs=high)
        assert explorer.axes("bifurcation") == axes
    before = explorer.state
    explorer.page.mouse.up()
    explorer.change(lambda: explorer.slide(phi0=1.0))
    assert explorer.state <= before + 2
    assert_orbit(explorer, {**DEFAULTS, "h": explorer.shown("h")[0], "f": explorer.shown("f")[0], "phi0": 1.0})
    assert explorer.shown("h")[0] == pytest.approx(2.9, abs=wide)


@pytest.mark.parametrize("phi", [-2.5, 0.25, 3.0])
def test_a_click_in_the_circle_map_chooses_the_phase_under_it(explorer, phi):
    (x, y), (wide, _) = at(explorer, "circle", phi, 1.0)
    explorer.change(explorer.page.mouse.click, x, y)
    chosen = explorer.shown("phi0")[0]
    assert chosen == pytest.approx(phi, abs=wide)
    assert_orbit(explorer, {**DEFAULTS, "phi0": chosen})
    cobweb = explorer.data("circle-cobweb")
    assert (cobweb["phi"][0], cobweb["theta"][0]) == pytest.approx((chosen, chosen), abs=1e-6)


def test_a_hand_that_takes_its_time_still_clicks_and_drags(explorer):
    mouse = explorer.page.mouse
    (x, y), (wide, high) = at(explorer, "bifurcation", 1.8, 0.3)
    mouse.move(x, y)
    mouse.down()
    explorer.page.wait_for_timeout(800)
    explorer.change(mouse.up)
    assert explorer.here() == (pytest.approx(1.8, abs=wide), pytest.approx(0.3, abs=high))
    mouse.down()
    explorer.page.wait_for_timeout(800)
    (x, y), _ = at(explorer, "bifurcation", 2.6, -0.4)
    explorer.change(mouse.move, x, y)
    assert explorer.here() == (pytest.approx(2.6, abs=wide), pytest.approx(-0.4, abs=high))
    mouse.up()


def test_two_clicks_in_quick_succession_both_count(explorer):
    (first, _), (second, (wide, _)) = at(explorer, "bifurcation", 1.8, 0.3), at(explorer, "bifurcation", 2.6, -0.4)
    explorer.change(explorer.page.mouse.click, *first)
    explorer.change(explorer.page.mouse.click, *second)
    assert explorer.here()[0] == pytest.approx(2.6, abs=wide)


def test_a_click_in_the_plane_of_angular_velocity_chooses_nothing(explorer):
    before = explorer.state
    (x, y), _ = at(explorer, "omega", 1.0, 1.0)
    explorer.page.mouse.click(x, y)
    explorer.change(lambda: explorer.slide(phi0=1.0))
    assert explorer.state == before + 1
    assert_orbit(explorer, {**DEFAULTS, "phi0": 1.0})


# --- The sphere --------------------------------------------------------------------------------------


def radius(explorer):
    """The radius of the sphere on the screen: 0.84 of half the canvas."""
    return 0.42 * explorer.sphere.bounding_box()["width"]


def test_the_sphere_turns_with_the_mouse_as_if_it_were_held(explorer):
    box, mouse = explorer.sphere.bounding_box(), explorer.page.mouse
    state, sent = explorer.state, len(explorer.sent)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 20, y + 5)
    mouse.move(x + 60, y - 25)
    mouse.up()
    mouse.move(x - 80, y)
    turned = (HOME[0] - 60 / radius(explorer), HOME[1] - 25 / radius(explorer))
    assert_turned(explorer, *turned)
    explorer.sphere.press("Home")
    assert_turned(explorer, *HOME)
    assert (explorer.state, len(explorer.sent)) == (state, sent)


def test_the_sphere_turns_with_the_arrow_keys_up_to_the_pole_and_home_again(explorer):
    explorer.sphere.focus()
    for key, times, turned in (
        ("ArrowLeft", 2, (HOME[0] + 2 * STEP, HOME[1])),
        ("ArrowRight", 3, (HOME[0] - STEP, HOME[1])),
        ("ArrowUp", 1, (HOME[0] - STEP, HOME[1] + STEP)),
        ("ArrowDown", 2, (HOME[0] - STEP, HOME[1] - STEP)),
        ("ArrowDown", 25, (HOME[0] - STEP, -math.pi / 2)),
        ("Home", 1, HOME),
        ("ArrowLeft", 40, (HOME[0] + 40 * STEP, HOME[1])),
    ):
        for _ in range(times):
            explorer.sphere.press(key)
        assert_turned(explorer, *turned)
    assert explorer.time == 0.0


class Finger:
    """One finger on the screen of a phone."""

    def __init__(self, page):
        self.page = page
        self.session = page.context.new_cdp_session(page)

    def send(self, kind, *points):
        touches = [{"x": x, "y": y} for x, y in points]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    def drag(self, item, dx, dy):
        """From the middle of an item; returns how far the text has scrolled under it."""
        scrolled = self.scrolled
        box = item.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.send("touchStart", (x, y))
        for share in (0.2, 0.4, 0.6, 0.8, 1.0):
            self.send("touchMove", (x + dx * share, y + dy * share))
            self.page.evaluate("new Promise((done) => requestAnimationFrame(done))")
        self.send("touchEnd")
        # Scrolling takes effect in the next frame.
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return self.scrolled - scrolled

    @property
    def scrolled(self):
        return self.page.locator(".reader").evaluate("item => item.scrollTop")


def turn_to(phone, picture):
    """Choose a picture by its number."""
    number = 1 + scenes()["suslov-hess"].pictures.index(picture)
    phone.change(phone.page.get_by_role("button", name=f"Picture {number}").click)


def test_the_sphere_turns_under_a_finger_and_the_page_stays(phone):
    phone = phone()
    turn_to(phone, "sphere")
    assert Finger(phone.page).drag(phone.sphere, -40, 30) == 0
    assert_turned(phone, HOME[0] + 40 / radius(phone), HOME[1] + 30 / radius(phone))


def test_a_finger_that_moves_over_the_diagram_or_scrolls_the_text_chooses_nothing(phone):
    phone = phone()
    turn_to(phone, "bifurcation")
    before = phone.here()
    finger = Finger(phone.page)
    finger.drag(phone.picture("bifurcation").locator("canvas").first, 0, -120)
    scrolled = finger.drag(phone.page.locator(".reader"), 0, -80)
    wait_ready(phone.page)
    assert scrolled > 30
    assert phone.here() == before


def on_sphere(gamma, turn):
    """Project γ in an orthographic view: right, up and towards the viewer, on the unit sphere."""
    azimuth, elevation = turn
    right = (-math.sin(azimuth), math.cos(azimuth), 0.0)
    towards = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation))
    up = np.cross(towards, right)
    return float(np.dot(gamma, right)), float(np.dot(gamma, up)), float(np.dot(gamma, towards))


@pytest.mark.parametrize("keys", [[], ["ArrowLeft"] * 7, ["ArrowUp"] * 6 + ["ArrowRight"] * 4])
def test_the_point_on_the_sphere_is_the_vertical_seen_from_there(explorer, keys):
    explorer.sphere.focus()
    for key in keys:
        explorer.sphere.press(key)
    left = keys.count("ArrowLeft") - keys.count("ArrowRight")
    turn = (HOME[0] + STEP * left, HOME[1] + STEP * keys.count("ArrowUp"))
    assert_turned(explorer, *turn)
    box = explorer.sphere.bounding_box()
    seen = 0
    for t in (0.0, 1.7, 3.1, 6.6, 9.4):
        explorer.set_time(t)
        right, up, towards = on_sphere(exact_states(DEFAULTS, [t])[0][2:], turn)
        if towards < 0.05:
            continue
        seen += 1
        explorer.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        pixels = picture(explorer, (box["x"], box["y"], box["width"], box["height"]))
        rows, columns = np.nonzero(like(pixels, theme.POINT))
        assert rows.size > 40
        half = box["width"] / 2
        found = ((columns.mean() + 0.5 - half) / radius(explorer), (half - rows.mean() - 0.5) / radius(explorer))
        assert found == pytest.approx((right, up), abs=0.02)
    assert seen >= 2


# --- The data ----------------------------------------------------------------------------------------


def columns_of(data, *names):
    return np.column_stack([data[name] for name in names])


STATE = ("omega1", "omega2", "g1", "g2", "g3")


def assert_orbit_of_the_equations(explorer, name, values):
    orbit = columns_of(explorer.data("data-orbit"), *STATE)
    # Its integrals in S1's own variables: E = I11 b h, F1 = 1, F2 = (Iω, γ) = I11 √b f.
    body = body_of(values)
    found = systems()["suslov"].integrals(orbit.T, body.suslov.parameters)
    momentum = body.I11 * orbit[:, 0] * orbit[:, 2] + body.I22 * orbit[:, 1] * orbit[:, 3]
    momentum += body.I23 * orbit[:, 1] * orbit[:, 4]
    scale = max(1.0, float(np.max(orbit[:, :2] ** 2)) * body.I11)
    assert np.max(np.abs(found["E"] - body.I11 * body.b * values["h"])) < 3e-6 * scale
    assert np.max(np.abs(found["F1"] - 1)) < 3e-6
    assert np.max(np.abs(momentum - body.I11 * math.sqrt(body.b) * values["f"])) < 3e-6 * scale
    if not name.startswith("Separatrix"):
        assert_orbit(explorer, values)


def numbers_in(text):
    return [float(number.replace("−", "-")) for number in re.findall(r"−?\d+(?:\.\d+)?(?:e−?\d+)?", text)]


def caption_numbers(explorer, pattern):
    """Return the numbers after these words in the caption of the circle map, without those of a proof."""
    caption = re.split(r", multipliers in \[|, \|trace\| in \[|Proved: no torus", explorer.caption("circle"))[0]
    assert pattern in caption, caption
    return numbers_in(caption.split(pattern, 1)[1])


def proved(explorer, words):
    """Intervals [(low, high)] after these words in what the caption of the circle map says is proved."""
    said = explorer.caption("circle").split("Proved:")[1]
    assert words in said, said
    return [tuple(numbers_in(interval)) for interval in re.findall(r"\[[^]]*\]", said.split(words, 1)[1])]


def assert_numbers_of_captions(explorer, name, values):
    captions = {picture: explorer.caption(picture) for picture in PICTURES}
    for text in captions.values():
        title, _, sentence = text.partition("\n")
        assert title
        assert sentence.endswith(".")
    h, f = values["h"], values["f"]
    assert numbers_in(captions["bifurcation"])[:2] == pytest.approx([h, f], rel=6e-4, abs=1e-12)
    if name.startswith("Separatrix"):
        assert "no return" in captions["circle"]
        return
    roots = turning_points(h, f).roots
    heights = numbers_in(captions["sphere"].replace("n₃", ""))
    # Two that are the same are said once.
    assert (2 * heights)[-2:] == pytest.approx(roots[1:], rel=6e-4)
    # |w| = |f|/(1 − n²)^½ at a turn: where h + n cancels this does not.
    speeds = [abs(f) / math.sqrt(1 - n * n) if h + n < 0.1 else math.sqrt(2 * (h + n)) for n in roots[1:]]
    ends = numbers_in(captions["omega"].split("|w|")[1])
    assert ends * (3 - len(ends)) == pytest.approx(speeds, rel=6e-4)
    # The map by brute force: its slope at two fixed points, or its mean turn per return.
    ratio = values["I23"] / values["I22"]
    exact = circle_map(ratio, h, f, REFERENCE)
    rho = caption_numbers(explorer, "ρ =")[0]
    assert rho == pytest.approx(exact.rotation_number, rel=6e-4, abs=1e-4)
    if exact.kind != "hyperbolic":
        ((low, high),) = proved(explorer, "no cycle")
        # Both in four digits or more, and the map in doubles.
        assert low - 1e-10 <= exact.trace <= high + 1e-10
        assert high - low <= 2e-3 * high
        return
    trace = caption_numbers(explorer, "|trace|")[0]
    assert trace == pytest.approx(exact.trace, rel=6e-5, abs=1e-4)
    multipliers = proved(explorer, "exactly two cycles")
    for point, (low, high) in zip(exact.fixed_points, multipliers, strict=True):
        step = 1e-3 / max(1.0, high)
        before, after = lifted_return(ratio, h, f or 1e-9, [point.phi - step, point.phi + step])
        assert low == pytest.approx((after - before) / (2 * step), rel=3e-3)
        assert low < high <= (1.0 + 1e-3) * low
        assert trace == pytest.approx(low**0.5 + low**-0.5, rel=6e-4)


@pytest.mark.parametrize(
    ("name", "words", "expected"),
    [
        ("Pendulum", "exactly two cycles", [math.exp(-0.6 * math.pi), math.exp(0.6 * math.pi)]),
        ("On the bifurcation curve", "no cycle", [abs(trace_on_curve(a, 0.5))]),
    ],
)
def test_examples_with_a_closed_form_show_it(explorer, name, words, expected):
    choose(explorer, next(preset for preset in PRESETS if preset.startswith(name)))
    found = proved(explorer, words)
    assert all(low <= value <= high for (low, high), value in zip(found, expected, strict=True))


@pytest.mark.parametrize(
    ("name", "words", "expected"),
    [
        ("At the lock boundary", "Proved: no cycle. ρ =", [0.0]),
        ("Oscillation", "Proved: no cycle. ρ =", [-0.5]),
    ],
)
def test_examples_at_a_limit_show_it_beside_what_is_proved(explorer, name, words, expected):
    choose(explorer, next(preset for preset in PRESETS if preset.startswith(name)))
    assert caption_numbers(explorer, words) == expected


def test_the_derived_quantities_are_those_of_the_formulas(explorer):
    explorer.change(lambda: explorer.slide(I22=1.25, I23=-0.5, b3=-2.0, h=0.75, f=0.3))
    rows = dict(row.rsplit(" = ", 1) for row in explorer.text("derived").splitlines() if " = " in row)
    I11, b = (1.25**2 + 0.25) / 1.25, 2.0 / math.sqrt(1.25**2 + 0.25)
    expected = {"a": -0.4, "b": b, "I₁₁": I11, "b₂": -0.8, "E": I11 * b * 0.75, "F₂": I11 * math.sqrt(b) * 0.3}
    for name, value in expected.items():
        row = next(text for key, text in rows.items() if key.split(" ")[0] == name)
        assert numbers_in(row)[-1] == pytest.approx(value, rel=6e-6), name
    assert "A rigid body? yes" in explorer.text("derived")


def test_both_cycles_are_closed_orbits_of_the_equations(explorer):
    period = turning_points(1.5, 0.6).period
    body = body_of(DEFAULTS)
    for name in ("stable", "unstable"):
        cycle = columns_of(explorer.data(f"data-{name}"), *STATE)
        assert cycle[0] == pytest.approx(cycle[-1], abs=3e-6)
        assert np.ptp(cycle[:, 0]) > 0.1
        times = np.linspace(0.0, period / body.frequency_unit, 4001)
        exact = solve(body.suslov, cycle[0], times, REFERENCE).states
        chords = np.diff(exact, axis=0)
        passed = []
        for point in cycle:
            # The nearest point of the exact orbit, which is straight for a thousandth of a period.
            share = np.sum((point - exact[:-1]) * chords, axis=1) / np.sum(chords**2, axis=1)
            nearest = exact[:-1] + np.clip(share, 0, 1)[:, None] * chords
            away = np.linalg.norm(point - nearest, axis=1)
            assert away.min() < 1e-5, name
            passed.append(times[np.argmin(away)])
        # It goes round once, without a gap.
        assert np.all(np.diff(passed[1:-1]) > 0)
        assert np.max(np.diff(passed[1:-1])) < 0.1 * times[-1]
    # They are two: at the lower turn their phases are those of the fixed points.
    stable, unstable = (explorer.data(f"circle-{name}")["phi"][0] for name in ("stable", "unstable"))
    assert stable == pytest.approx(-unstable, abs=1e-6)


def test_the_fixed_points_are_fixed_and_told_apart(explorer):
    points = {name: explorer.data(f"circle-{name}") for name in ("stable", "unstable")}
    for name, point in points.items():
        phi = point["phi"][0]
        assert point["theta"][0] == phi
        near = np.array([phi - 1e-3, phi, phi + 1e-3])
        after = lifted_return(a, 1.5, 0.6, near)
        assert angle_between(after[1], phi) < 1e-5
        slope = (after[2] - after[0]) / 2e-3
        assert (slope < 1) == (name == "stable")
    # Filled and hollow.
    for name, colour in (("stable", theme.STABLE), ("unstable", theme.UNSTABLE)):
        (x, y), _ = at(explorer, "circle", points[name]["phi"][0], points[name]["phi"][0])
        pixels = picture(explorer, (round(x) - 12, round(y) - 12, 24, 24))
        assert like(pixels, colour).sum() > 30
        assert like(pixels[10:14, 10:14], colour).all() == (name == "stable")


def test_the_graph_and_the_cobweb_of_the_circle_map_are_those_of_the_flow(explorer):
    graph = explorer.data("circle-map")
    phi, theta = np.array(graph["xs"][0]), np.array(graph["ys"][0])
    assert phi[0] == pytest.approx(-math.pi, abs=1e-5)
    assert phi[-1] == pytest.approx(math.pi, abs=1e-5)
    assert np.all(np.diff(phi) >= 0)
    # One turn of Θ for one turn of φ, without a jump.
    assert theta[-1] - theta[0] == pytest.approx(2 * math.pi, abs=1e-5)
    assert np.max(np.abs(np.diff(theta))) < 0.1
    picks = np.linspace(0, phi.size - 1, 12).astype(int)
    assert angle_between(theta[picks], lifted_return(a, 1.5, 0.6, phi[picks])) < 2e-5
    cobweb = explorer.data("circle-cobweb")
    x, y = np.array(cobweb["phi"]), np.array(cobweb["theta"])
    assert np.all((np.diff(x) == 0) | (np.diff(y) == 0))
    iterates = y[::2]
    assert iterates[0] == pytest.approx(0.5, abs=1e-6)
    assert iterates.size >= 10
    assert angle_between(iterates[1:], lifted_return(a, 1.5, 0.6, iterates[:-1])) < 2e-5


def test_the_boundary_of_the_locked_zone_has_trace_two(explorer):
    explorer.change(lambda: explorer.slide(I22=1.0, I23=0.5))
    boundary = explorer.data("bifurcation-boundary")
    h, f = np.array(boundary["xs"][0]), np.array(boundary["ys"][0])
    assert np.array(boundary["xs"][1]) == pytest.approx(h)
    assert np.array(boundary["ys"][1]) == pytest.approx(-f)
    assert (h[-1], f[-1]) == pytest.approx((1.0, 0.0), abs=1e-6)
    # It meets the curve at h* = (1 − 2a²)/(2a√(1 + a²)).
    assert h[0] == pytest.approx(0.5 / math.sqrt(1.25), rel=1e-6)
    for i in range(1, h.size - 1, 5):
        assert circle_map(0.5, h[i], f[i], REFERENCE).trace == pytest.approx(2.0, abs=2e-4)
        assert circle_map(0.5, h[i] + 0.05, f[i], REFERENCE).kind == "hyperbolic"
        if f[i] < f_max(h[i] - 0.03):
            assert circle_map(0.5, h[i] - 0.03, f[i], REFERENCE).kind == "elliptic"
    zone = explorer.data("bifurcation-locked")
    assert zone["xs"][0][0][0][: h.size] == pytest.approx(h, rel=1e-6)
    assert zone["ys"][0][0][0][: h.size] == pytest.approx(f, rel=1e-6, abs=1e-7)


def test_the_edge_of_the_region_is_the_corrected_curve(explorer):
    for name in ("curve", "forbidden"):
        data = explorer.data(f"bifurcation-{name}")
        line = (data["xs"][0], data["ys"][0]) if name == "curve" else (data["xs"][0][0][0], data["ys"][0][0][0])
        h, f = (np.array(part) for part in line)
        inside = (f < explorer.axes("bifurcation")[3] - 1e-6) & (h > -1)
        assert inside.sum() > 100
        n = (np.sqrt(h[inside] ** 2 + 3) - h[inside]) / 3
        assert f[inside] == pytest.approx(np.sqrt(2 * (h[inside] + n) * (1 - n * n)), abs=2e-5)
    special = explorer.data("bifurcation-special")
    assert sorted(zip(special["h"], special["f"], strict=True)) == [(-1.0, 0.0), (1.0, 0.0)]


def test_the_colours_are_rotation_numbers(explorer):
    image = explorer.page.evaluate(
        """() => {
          const { data } = hess.source("bifurcation-rotation")
          const grid = data.image[0]
          return { values: Array.from(grid.numbers), shape: [grid.rows, grid.columns],
                   x: data.x[0], y: data.y[0], dw: data.dw[0], dh: data.dh[0] }
        }"""
    )
    rows, columns = image["shape"]
    assert (columns, rows) == (100, 75)
    grid = np.reshape(image["values"], (rows, columns))
    found = 0
    for i, j in ((10, 40), (30, 30), (37, 20), (45, 35), (50, 42), (60, 60)):
        h = image["x"] + (j + 0.5) * image["dw"] / columns
        f = image["y"] + (i + 0.5) * image["dh"] / rows
        n = (math.sqrt(h * h + 3) - h) / 3
        if h > -1 and abs(f) < math.sqrt(2 * (h + n) * (1 - n * n)):
            found += 1
            assert grid[i, j] == pytest.approx(circle_map(a, h, f, REFERENCE).rotation_number, abs=1e-3)
    assert found >= 4
    assert np.ptp(grid) > 0.5


def test_the_allowed_ring_is_where_the_energy_lets_the_body_be(explorer):
    region = explorer.data("omega-forbidden")
    _, n1, n2 = turning_points(1.5, 0.6).roots
    hole, inner = (region["xs"][0][0][1], region["ys"][0][0][1]), (region["xs"][1][0][0], region["ys"][1][0][0])
    orbit = explorer.data("data-orbit")
    # b = 1 here: w1 = ω1, w2 = ω2/√(1 + a²), |w|² = 2(h + n3).
    for (x, y), n in ((hole, n2), (inner, n1)):
        speed = np.hypot(x, np.array(y) / math.hypot(1, a))
        assert speed == pytest.approx(np.full(len(x), math.sqrt(2 * (1.5 + n))), rel=1e-5)
    speed = np.hypot(orbit["omega1"], np.array(orbit["omega2"]) / math.hypot(1, a))
    assert speed.min() == pytest.approx(math.sqrt(2 * (1.5 + n1)), rel=1e-3)
    assert speed.max() == pytest.approx(math.sqrt(2 * (1.5 + n2)), rel=1e-3)


@pytest.mark.parametrize("t", [0.0, 2.5, 11.3, 33.3])
def test_the_moving_point_is_at_the_state_of_its_time_in_every_plane(explorer, t):
    explorer.set_time(t)
    state = exact_states(DEFAULTS, [t])[0]
    w1, w2, n1, n2, n3 = body_of(DEFAULTS).in_units_of_b(body_of(DEFAULTS).to_reduced(state))
    point = {name: explorer.data(f"{name}-point") for name in ("omega", "bifurcation", "circle")}
    assert (point["omega"]["x"][0], point["omega"]["y"][0]) == pytest.approx(state[:2], abs=4e-3)
    rate = n1 * w2 - n2 * w1
    assert rate**2 == pytest.approx(2 * (1.5 + n3) * (1 - n3 * n3) - 0.36, abs=1e-9)
    assert point["bifurcation"]["x"][0] == pytest.approx(1.5)
    assert point["bifurcation"]["y"][0] == pytest.approx(math.hypot(0.6, rate), abs=6e-3)
    # Above the phase with which this period began stands the phase of now.
    phase = 0.5
    for _ in range(int(t / turning_points(1.5, 0.6).period)):
        phase = float(lifted_return(a, 1.5, 0.6, [phase])[0])
    assert angle_between(point["circle"]["x"][0], phase) < 2e-3
    assert angle_between(point["circle"]["y"][0], math.atan2(w1, w2)) < 5e-3


# --- What is painted ---------------------------------------------------------------------------------

PAINTED = {
    "omega": (theme.ORBIT, theme.STABLE, theme.UNSTABLE, theme.POINT, theme.FORBIDDEN),
    "sphere": (theme.ORBIT, theme.STABLE, theme.UNSTABLE, theme.POINT),
    "bifurcation": (theme.LOCKED, theme.FORBIDDEN, theme.POINT, theme.INK, theme.TURN_MAP[0]),
    "circle": (theme.MAP, theme.STABLE, theme.UNSTABLE, theme.ORBIT, theme.POINT),
}


def painted(pixels, colour):
    """Count the pixels of this colour. The orbit is a thin antialiased line, so any clear blue counts."""
    if colour != theme.ORBIT:
        return like(pixels, colour).sum()
    red, green, blue = np.moveaxis(pixels, -1, 0)
    return ((blue > green) & (green > red) & (blue - red > 60)).sum()


def canvas_of(explorer, name):
    """The pixels of a picture, its axes included."""
    box = explorer.picture(name).locator("canvas").first.bounding_box()
    return picture(explorer, (box["x"], box["y"], box["width"], box["height"]))


def test_every_picture_is_painted_in_its_colours(explorer):
    # From here the stable cycle is on the near side, and at this time the point.
    for _ in range(36):
        explorer.sphere.press("ArrowLeft")
    explorer.set_time(3.1)
    assert_turned(explorer, HOME[0] - math.pi, HOME[1])
    for name in PICTURES:
        pixels = canvas_of(explorer, name)
        for colour in PAINTED[name]:
            assert painted(pixels, colour) >= 25, (name, colour)
        # The rim is quiet: nothing is painted outside the frame but the axes.
        assert name == "sphere" or like(pixels[:6], "#FFFFFF").mean() > 0.95


def assert_every_picture_painted(explorer, name, artefacts):
    explorer.page.mouse.move(5, 5)
    for picture_name in PICTURES:
        pixels = canvas_of(explorer, picture_name)
        if picture_name == "circle" and name.startswith("Separatrix"):
            assert not like(pixels, theme.MAP).any()
            # The sentence in the middle.
            middle = pixels[int(0.35 * len(pixels)) : int(0.6 * len(pixels)), 100:280]
            assert like(middle, theme.MUTED, 60).sum() > 150
            continue
        wanted = {"omega": theme.ORBIT, "sphere": theme.ORBIT, "bifurcation": theme.FORBIDDEN, "circle": theme.MAP}
        assert painted(pixels, wanted[picture_name]) >= 40, picture_name
    assert_captions_fit(explorer, scenes()["suslov-hess"])
    explorer.page.screenshot(path=artefacts / f"example-{list(PRESETS).index(name) + 1}.png")


# One visit for all that is to be seen of an example.
@pytest.mark.parametrize("name", sample(PRESETS, 4))
def test_an_example_is_the_one_of_the_equations_with_the_right_numbers_and_painted(explorer, name, artefacts):
    values = choose(explorer, name)
    assert_orbit_of_the_equations(explorer, name, values)
    assert_numbers_of_captions(explorer, name, values)
    assert_every_picture_painted(explorer, name, artefacts)


# [before, [[at the moment at which the page says that a state is painted, two frames later], …], at last]: what is on
# the canvases of plots while a slider goes to another place, of states that no other one follows so soon.
ON_CANVASES = f"""async () => {{
  const all = (root) => [...root.querySelectorAll("*")].flatMap((item) =>
    [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const canvases = all(document).filter(
    (item) => item.matches("canvas") && item.getRootNode().host?.matches(".bk-Canvas"))
  const painted = () => canvases.map((canvas) => canvas.toDataURL())
  const frames = async (count) => {{ while (count-- > 0) await new Promise((done) => requestAnimationFrame(done)) }}
  const root = document.documentElement
  const before = painted(), seen = []
  const ready = new Promise((done) => new MutationObserver(async (changes, observer) => {{
    const then = painted(), {{ state }} = root.dataset
    await frames(2)
    if (root.dataset.state === state) seen.push([then, painted()])
    if (root.dataset.ready !== "true") return
    observer.disconnect()
    done()
  }}).observe(root, {{ attributes: true, attributeFilter: ["data-state"] }}))
  const slider = ({FIND})("h", "range")
  slider.value = 2.5
  slider.dispatchEvent(new Event("input", {{ bubbles: true }}))
  slider.dispatchEvent(new Event("change", {{ bubbles: true }}))
  await ready
  return [before, seen, painted()]
}}"""


def test_what_is_called_painted_is_painted(explorer):
    before, seen, last = explorer.page.evaluate(ON_CANVASES)
    assert sum(old != new for old, new in zip(before, last, strict=True)) >= 3
    # The first of them brings most of what is new.
    assert sum(old != new for old, new in zip(before, seen[0][1], strict=True)) >= 3
    assert [then == later for then, later in seen] == [True] * len(seen)


def test_the_separatrix_says_no_return_and_the_others_go_on(explorer):
    explorer.change(explorer.choose, "preset", "Separatrix: no return")
    assert explorer.data("circle-message")["text"] == ["Separatrix: no return"]
    for name in ("map", "cobweb", "stable", "unstable"):
        assert not any(explorer.data(f"circle-{name}").values()), name
    assert "no return" in explorer.text("status")
    assert explorer.here() == (1.0, 0.0)
    orbit = explorer.data("data-orbit")
    # From the bottom, where |w| = 2, with n3 = 1, towards w = 0 and n3 = −1.
    body = body_of(DEFAULTS)
    reduced = body.in_units_of_b(body.to_reduced(columns_of(orbit, *STATE)))
    assert np.hypot(reduced[0, 0], reduced[0, 1]) == pytest.approx(2.0, abs=1e-5)
    assert reduced[0, 4] == pytest.approx(1.0, abs=1e-5)
    assert np.hypot(reduced[-1, 0], reduced[-1, 1]) < 1e-3
    assert reduced[-1, 4] == pytest.approx(-1.0, abs=1e-5)
    explorer.set_time(3.0)
    assert explorer.data("omega-point")["x"] != []
    explorer.change(explorer.choose, "preset", "Two limit cycles")
    assert explorer.data("circle-message")["text"] == []
    assert len(explorer.data("circle-map")["xs"]) == 3
