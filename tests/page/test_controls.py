"""Every control of the page, as a user works it: keyboard, mouse, typing, and the player."""

import re
from math import copysign, dist, pi, sqrt
from urllib.parse import parse_qsl, urlsplit

import pytest
from pytest import approx

from hess_explorer.headless.browser import wait_ready
from hess_mechanics import f_max
from hess_mechanics.numerics.accuracy import LEVELS
from support.page import DEFAULTS, FIND, MOMENT, POINTS, SLIDERS, wait_frames, wait_time
from support.painted import yellow
from support.suslov_hess import assert_orbit, exact_states
from support.thorough import sample

# Final positions of the sliders from the default state; f at the last hundredth inside the region.
ENDS = {
    "I22": (0.2, 3.0),
    "I23": (-2.0, 2.0),
    "b3": (-3.0, -0.05),
    "h": (-0.99, 4.0),
    "f": (-1.81, 1.81),
    "phi0": (-3.14, 3.14),
    "span": (1.0, 200.0),
}
SCALES = {**ENDS, "f": (-3.0, 3.0)}
"""Ends of each slider; the slider of f exceeds the possible range, because it does not change with h."""
# All numbers are controls of one kind, with ends and steps of their own.
numbers = pytest.mark.parametrize("name", sample(["h", "I22", "f", "I23", "span", "b3", "phi0"], 3))


# --- Sliders and boxes -------------------------------------------------------------------------------


@numbers
def test_a_slider_obeys_the_keyboard(explorer, name):
    slider, step = explorer.slider(name), SLIDERS[name]
    slider.focus()
    for key, steps in (("ArrowRight", 1), ("ArrowUp", 2), ("ArrowLeft", 1), ("ArrowDown", 0), ("ArrowRight", 1)):
        explorer.change(slider.press, key)
        expected = DEFAULTS[name] + steps * step
        assert explorer.shown(name) == approx((expected, expected), abs=1e-9)
    assert_orbit(explorer, {**DEFAULTS, name: DEFAULTS[name] + step})


@numbers
def test_a_slider_reaches_its_ends_and_no_further(explorer, name):
    slider = explorer.slider(name)
    slider.focus()
    for key, end in (("End", ENDS[name][1]), ("Home", ENDS[name][0])):
        explorer.change(slider.press, key)
        assert explorer.shown(name)[0] == approx(end, abs=1e-9)
        slider.press("ArrowRight" if key == "End" else "ArrowLeft")
        assert explorer.shown(name)[0] == approx(end, abs=1e-9)
    # Corrections that keep a number compatible with the others are noted; only f depends on another number.
    admitted = {**DEFAULTS, name: ENDS[name][0]}
    admitted["f"] = max(min(admitted["f"], f_max(admitted["h"])), -f_max(admitted["h"]))
    assert_orbit(explorer, admitted)


@numbers
def test_a_slider_follows_the_mouse(explorer, name):
    low, high = SCALES[name]
    box = explorer.slider(name).bounding_box()
    middle = box["y"] + box["height"] / 2
    mouse = explorer.page.mouse
    before = explorer.state
    mouse.move(box["x"] + 0.35 * box["width"], middle)
    mouse.down()
    for share in (0.4, 0.5, 0.6, 0.65, 0.7):
        mouse.move(box["x"] + share * box["width"], middle)
    mouse.up()
    wait_ready(explorer.page, after=before)
    value, slider = explorer.shown(name)
    assert slider == approx(value, abs=1e-9)
    # The middle of the thumb (16 px) is under the pointer.
    share = (0.7 * box["width"] - 8) / (box["width"] - 16)
    assert value == approx(low + share * (high - low), abs=0.02 * (high - low) + SLIDERS[name])
    assert_orbit(explorer, {**DEFAULTS, name: value})


@pytest.mark.parametrize(
    "name, text, value",
    [
        ("I22", " 1.375 ", 1.375),
        ("I23", "−0.5", -0.5),
        ("h", "0,7", 0.7),
        ("h", "7.25", 7.25),
        ("f", "−1e−8", -1e-8),
        ("span", "12.34567890123", 12.34567890123),
    ],
)
def test_a_box_takes_an_exact_value(explorer, name, text, value):
    explorer.change(explorer.type, name, text)
    box, slider = explorer.shown(name)
    assert box == value
    assert slider == approx(value, abs=0.51 * SLIDERS[name])
    assert explorer.box(name).get_attribute("aria-invalid") != "true"
    assert_orbit(explorer, {**DEFAULTS, name: value})
    assert explorer.text("notes") == ""
    assert float(explorer.wait_url(**{name: repr(value)})[name]) == value


def test_a_box_is_read_when_it_is_left_too(explorer):
    explorer.box("h").fill("0.25")
    explorer.change(explorer.box("phi0").focus)
    assert_orbit(explorer, {**DEFAULTS, "h": 0.25})


def test_what_is_not_a_number_is_marked_and_changes_nothing(explorer):
    for text in ("abc", "", "<b>2</b>", "1/0"):
        explorer.type("h", text)
        # The server parses everything that is not a plain number.
        explorer.page.locator(".param-h .exact[aria-invalid=true]").wait_for()
        assert (
            explorer.box("h")
            .evaluate("box => box.validationMessage")
            .startswith(("This is not", "The value is not finite"))
        ), text
        explorer.page.wait_for_function("document.documentElement.dataset.ready === 'true'")
        assert explorer.box("h").input_value() == text
        phi0 = 0.5 if explorer.shown("phi0")[0] == 1.0 else 1.0
        explorer.change(lambda phi0=phi0: explorer.slide(phi0=phi0))
        assert_orbit(explorer, {**DEFAULTS, "phi0": phi0})
        # The mark goes with what was wrong.
        explorer.box("h").press("Escape")
        assert explorer.page.locator(".param-h .exact[aria-invalid=true]").count() == 0
        assert explorer.box("h").input_value() == "1.5"


@pytest.mark.parametrize(
    "name, text, value, note",
    [
        ("I23", "5000", 96.0, "can be at most 100"),
        ("f", "-99", None, "f was set to this limit"),
        ("span", "-1", 0.01, "t must lie between"),
    ],
)
def test_what_is_out_of_range_is_clamped_with_a_note_each_time(explorer, name, text, value, note):
    if value is None:
        # On the curve at h = 3/2: n = 1/(h + √(h² + 3)), f = (1 − n²)/√n (Geq3, corrected).
        n = 1 / (1.5 + sqrt(5.25))
        value = copysign((1 - n * n) / sqrt(n), float(text))
    for _ in range(2):
        explorer.change(explorer.type, name, text)
        assert explorer.shown(name)[0] == approx(value, rel=1e-12)
        assert note in explorer.text("notes")
        assert explorer.page.locator(".text.notes").is_visible()


def test_the_f_slider_reaches_its_edge_finds_zero_and_writes_round_numbers_at_any_h(explorer):
    for h in (0.75, 1.01, 2.5, 3.99):
        explorer.change(lambda h=h: explorer.slide(h=h))
        low, high, step = (
            float(explorer.slider("f").get_attribute(name)) for name in ("data-low", "data-high", "step")
        )
        assert (-low, high) == approx((f_max(h), f_max(h)), abs=1.01 * step)
        explorer.change(lambda: explorer.slide(f=0.37))
        assert explorer.box("f").input_value() == "0.37"
        explorer.change(lambda: explorer.slide(f=0.0))
        assert explorer.box("f").input_value() == "0"
        assert explorer.here()[1] == 0.0


def test_a_box_reads_expressions_and_shows_their_numbers(explorer):
    for name, text, value in (("phi0", "pi/3", pi / 3), ("h", "sqrt(2)", sqrt(2)), ("f", "−1/7", -1 / 7)):
        explorer.change(explorer.type, name, text)
        assert float(explorer.box(name).input_value()) == approx(value, rel=1e-15)
        # Once more: the text goes, though the number stays.
        explorer.change(explorer.type, name, text)
        assert float(explorer.box(name).input_value()) == approx(value, rel=1e-15)
    assert_orbit(explorer, {**DEFAULTS, "phi0": pi / 3, "h": sqrt(2), "f": -1 / 7})
    # After a refusal a number is welcome.
    explorer.type("h", "sqrt(-1)")
    explorer.page.locator(".param-h .exact[aria-invalid=true]").wait_for()
    assert "not finite" in explorer.box("h").evaluate("box => box.validationMessage")
    explorer.change(explorer.type, "h", "2")
    assert explorer.box("h").evaluate("box => box.validity.valid")
    assert_orbit(explorer, {**DEFAULTS, "phi0": pi / 3, "h": 2.0, "f": -1 / 7})


def test_arrows_nudge_a_box_shift_by_ten_steps_and_a_label_is_dragged(explorer):
    for item in (explorer.box("h"), explorer.slider("h")):
        for key, value in (("ArrowUp", 1.51), ("Shift+ArrowUp", 1.61), ("ArrowDown", 1.6), ("Shift+ArrowDown", 1.5)):
            explorer.change(item.press, key)
            assert explorer.shown("h") == (value, value)
    assert_orbit(explorer, DEFAULTS)
    label = explorer.page.locator(".param-h .label").bounding_box()
    mouse, middle = explorer.page.mouse, label["y"] + label["height"] / 2
    mouse.move(label["x"] + 5, middle)
    mouse.down()
    explorer.change(mouse.move, label["x"] + 25, middle)
    assert explorer.shown("h") == (1.7, 1.7)
    explorer.change(mouse.move, label["x"] + 2000, middle)
    assert explorer.shown("h") == (4.0, 4.0)
    explorer.change(mouse.move, label["x"] - 25, middle)
    assert explorer.shown("h") == (1.2, 1.2)
    explorer.change(mouse.up)
    assert_orbit(explorer, {**DEFAULTS, "h": 1.2})
    # All of the drag is one step.
    explorer.change(explorer.page.keyboard.press, "Control+z")
    assert explorer.shown("h") == (1.5, 1.5)


def test_a_button_moves_a_slider_to_and_fro_until_it_is_touched(explorer):
    page = explorer.page
    sway, pace = page.locator(".param-f .sway"), page.locator(".param-f .pace")
    assert pace.is_hidden()
    sway.click()
    pace.select_option("4")
    # Beyond its start, to the upper end, and below it again.
    for condition in ("value > 1.7", "value < 0.4"):
        page.wait_for_function(f"() => {{ const value = Number(({FIND})('f', 'range').value); return {condition} }}")
    # It goes on: between two of its values the page may be ready for a moment.
    page.wait_for_function("document.documentElement.dataset.ready !== 'true'")
    # Only one at a time.
    page.locator(".param-phi0 .sway").click()
    assert sway.get_attribute("aria-pressed") == "false"
    assert page.locator(".param-phi0 .pace").input_value() == "4"
    before = explorer.state
    page.keyboard.press("Escape")
    wait_ready(page, after=before)
    assert page.locator(".sway[aria-pressed=true]").count() == 0
    f, phi0 = explorer.shown("f")[0], explorer.shown("phi0")[0]
    assert f == approx(round(f, 2), abs=1e-12)
    assert_orbit(explorer, {**DEFAULTS, "f": f, "phi0": phi0})
    # Let go, it is of the accuracy chosen, and each was one step.
    assert explorer.text("status").startswith("standard:")
    sway.click()
    explorer.slider("f").press("ArrowRight")
    assert sway.get_attribute("aria-pressed") == "false"
    page.wait_for_function("document.documentElement.dataset.ready === 'true'")
    page.locator(".param-reset").click()


# --- Menus and buttons -------------------------------------------------------------------------------


def test_the_accuracy_menu_changes_level_error_and_link_and_nothing_else(explorer):
    for name in ("draft", "precise", "reference", "standard"):
        explorer.change(explorer.choose, "accuracy", name)
        status = explorer.text("status")
        assert status.startswith(f"{name}:")
        errors = [float(text.replace("−", "-")) for text in re.findall(r"error ≤ (\S+)", status)]
        assert len(errors) == 2
        if name != "reference":
            assert max(errors) <= LEVELS[name].promise
        assert explorer.accuracy == name
        explorer.wait_url(accuracy=name)
    for name in SLIDERS:
        assert explorer.shown(name)[0] == DEFAULTS[name]


def test_the_menu_of_examples_sets_the_state_and_says_when_it_is_left(explorer):
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    assert explorer.chosen("preset") == "No cycle: every orbit winds"
    assert_orbit(explorer, {**DEFAULTS, "h": 0.2, "f": 0.5})
    explorer.change(lambda: explorer.slide(phi0=1.0))
    assert explorer.chosen("preset") == "Choose an example…"
    # The same one again.
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    assert_orbit(explorer, {**DEFAULTS, "h": 0.2, "f": 0.5})
    explorer.change(explorer.choose, "preset", "Two limit cycles")
    assert_orbit(explorer, DEFAULTS)
    before = explorer.state
    explorer.change(lambda: explorer.slide(h=2.0))
    # The menu that follows the state asks for none itself; what is proved of the state comes after it.
    assert explorer.state in (before + 1, before + 2)
    # An example keeps the accuracy.
    explorer.change(explorer.choose, "accuracy", "precise")
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    assert explorer.text("status").startswith("precise:")


def test_reset_brings_everything_back(explorer):
    explorer.change(lambda: explorer.slide(I22=1.2, I23=-0.5, b3=-2.0, h=0.7, f=-0.3, phi0=2.0, span=11.0))
    explorer.change(explorer.choose, "accuracy", "draft")
    before = explorer.state
    explorer.page.locator(".param-reset").click()
    wait_ready(explorer.page, after=before)
    assert_orbit(explorer, DEFAULTS)
    assert explorer.text("status").startswith("standard:")
    for name in SLIDERS:
        assert explorer.shown(name)[0] == DEFAULTS[name]


def test_copy_link_copies_the_state_that_is_on_the_screen(explorer):
    explorer.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    explorer.wait_url(h="1.5", f="0.6")
    explorer.change(lambda: explorer.slide(h=0.75))
    # At once: a user does not wait for the address bar.
    explorer.page.locator(".param-share").click()
    link = explorer.page.locator(".param-link")
    link.click()
    link.get_by_text("Copied").wait_for(state="visible")
    copied = explorer.page.evaluate("navigator.clipboard.readText()")
    assert copied.startswith(explorer.base)
    assert dict(parse_qsl(urlsplit(copied).query))["h"] == "0.75"
    explorer.page.keyboard.press("Escape")


# --- The player --------------------------------------------------------------------------------------


def moment(explorer):
    found = explorer.page.evaluate(MOMENT, POINTS)
    return found["t"], dict(zip(POINTS, found["points"], strict=True))


def assert_on_orbit(explorer, values):
    """The point of (ω1, ω2) stands where the body is at the time that the slider shows."""
    t, points = moment(explorer)
    exact = exact_states(values, [t])[0]
    # Between two samples it runs straight, a quarter of a pixel (8/600) from the curve at most.
    assert points["omega-point"] == approx(exact[:2], abs=4e-3)
    return t


def wait_silence(explorer):
    """Let the server's last acknowledgements arrive."""
    frames = None
    while frames != (frames := len(explorer.received)):
        wait_frames(explorer, 12)


def test_play_moves_the_point_in_all_four_pictures_without_the_server(explorer):
    wait_silence(explorer)
    state, sent, received = explorer.state, len(explorer.sent), len(explorer.received)
    _, before = moment(explorer)
    spot = yellow(explorer)
    explorer.page.locator(".param-play").click()
    assert explorer.playing
    wait_time(explorer, "t > 1.2")
    t, after = moment(explorer)
    assert t < 20
    for name in POINTS:
        if name != "circle-point":
            assert dist(before[name], after[name]) > 0.05, name
    # In the circle map the point goes from (φ0, φ0) to (φ0, Θ(φ0)) within one period.
    assert after["circle-point"][0] == approx(0.5, abs=1e-5)
    assert abs(after["circle-point"][1] - 0.5) > 0.05
    assert dist(spot, yellow(explorer)) > 0.02
    assert_on_orbit(explorer, DEFAULTS)
    explorer.page.locator(".param-play").click()
    assert not explorer.playing
    assert (explorer.state, len(explorer.sent), len(explorer.received)) == (state, sent, received)
    assert explorer.ready


def test_pause_stops_the_point_and_writes_the_time_into_the_link(explorer):
    play = explorer.page.locator(".param-play")
    assert play.get_attribute("aria-label") == "Play (Space)"
    play.click()
    assert play.get_attribute("aria-label") == "Pause (Space)"
    wait_time(explorer, "t > 0.3")
    play.click()
    t = explorer.time
    wait_frames(explorer)
    assert explorer.time == t
    # To the link's three digits; a range input drops the last digits of t, so a tie may be rounded either way.
    explorer.page.wait_for_function(
        "t => Math.abs(new URLSearchParams(location.search).get('t') - t) < 0.000501", arg=t
    )
    assert_on_orbit(explorer, DEFAULTS)


def test_steps_go_forward_and_back_and_stop_at_the_start(explorer):
    forward, back = explorer.page.locator(".param-forward"), explorer.page.locator(".param-back")
    for steps in (1, 2, 3):
        forward.click()
        assert explorer.time == approx(steps * 40.0 / 200, rel=1e-5)
        assert_on_orbit(explorer, DEFAULTS)
    for steps in (2, 1, 0, 0):
        back.click()
        assert explorer.time == approx(steps * 40.0 / 200, abs=1e-5)
    assert explorer.page.locator(".player output").inner_text() == "t = 0.00"


def test_the_time_slider_moves_the_point_at_once(explorer):
    box = explorer.page.locator("input.param-t").bounding_box()
    state, sent = explorer.state, len(explorer.sent)
    explorer.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert explorer.time == approx(20.0, abs=0.5)
    t = assert_on_orbit(explorer, DEFAULTS)
    assert explorer.page.locator(".player output").inner_text() == f"t = {t:.2f}"
    assert explorer.page.locator("input.param-t").get_attribute("aria-valuetext") == f"t = {t:.2f} of 40.00"
    explorer.page.locator("input.param-t").press("End")
    assert explorer.time == approx(40.0, rel=1e-6)
    assert_on_orbit(explorer, DEFAULTS)
    assert (explorer.state, len(explorer.sent)) == (state, sent)


@pytest.mark.parametrize("speed", ["0.5", "8"])
def test_the_speed_is_the_one_chosen(explorer, speed):
    options = explorer.page.locator(".param-speed option").all_inner_texts()
    assert options == ["0.25×", "0.5×", "1×", "2×", "4×", "8×"]
    explorer.page.locator(".param-speed").select_option(speed)
    explorer.page.locator(".param-play").click()
    # A frame that comes late moves it by a tenth of a second at most.
    elapsed, passed = explorer.page.evaluate(
        f"""async (names) => {{
          const at = () => ({MOMENT})(names).t
          const frame = () => new Promise((done) => requestAnimationFrame(done))
          for (let i = 0; i < 3; i++) await frame()
          const [start, from] = [await frame(), at()]
          let [now, played] = [start, 0]
          while (now - start < 900) {{
            const next = await frame()
            played += Math.min(100, next - now)
            now = next
          }}
          return [played / 1000, at() - from]
        }}""",
        list(POINTS),
    )
    # One frame more or less.
    assert passed == approx(float(speed) * elapsed, abs=0.15 * float(speed))
    explorer.page.locator(".param-play").click()
    explorer.wait_url(speed=speed)


def test_at_the_end_the_motion_begins_again(explorer):
    explorer.set_time(39.6)
    explorer.page.locator(".param-speed").select_option("2")
    explorer.page.locator(".param-play").click()
    wait_time(explorer, "t < 5")
    assert explorer.playing


def test_space_and_arrow_keys_work_the_player_from_anywhere_on_the_page(explorer):
    keyboard = explorer.page.keyboard
    keyboard.press("ArrowRight")
    keyboard.press("ArrowRight")
    assert explorer.time == approx(0.4, rel=1e-5)
    keyboard.press("ArrowLeft")
    assert explorer.time == approx(0.2, rel=1e-5)
    keyboard.press("Space")
    assert explorer.playing
    wait_time(explorer, "t > 0.5")
    keyboard.press("Space")
    assert not explorer.playing
    keyboard.press("Control+ArrowRight")
    t = explorer.time
    wait_frames(explorer, 2)
    assert explorer.time == t
    assert_on_orbit(explorer, DEFAULTS)


def test_keys_that_mean_something_where_the_focus_is_leave_the_player_alone(explorer):
    explorer.change(explorer.slider("h").press, "ArrowRight")
    assert explorer.time == 0.0
    box = explorer.box("h")
    box.focus()
    explorer.page.keyboard.press("End")
    explorer.page.keyboard.press("Space")
    explorer.page.keyboard.press("ArrowLeft")
    assert box.input_value() == "1.51 "
    explorer.sphere.press("ArrowRight")
    assert explorer.time == 0.0
    assert not explorer.playing
    # Space plays, whatever has the focus but a box; on the button itself it is a click, once.
    page = explorer.page
    others = (
        ".param-reset",
        ".param-play",
        ".param-speed",
        ".group > summary",
        ".corner:visible",
        ".param-pin",
        ".lesson-menu > summary",
        ".unfold:visible",
        "canvas.solid:visible",
        ".param-h .sway",
    )
    for item in (explorer.slider("h"), explorer.menu("preset"), *(page.locator(name).first for name in others)):
        for playing in (True, False):
            item.press("Space")
            assert explorer.playing == playing
    assert explorer.shown("h")[0] == 1.51
    # Neither was anything of them done.
    assert page.locator(".comparison").is_hidden()
    assert page.locator(".lesson-menu").get_attribute("open") is None
    assert page.locator(".param-h .sway").get_attribute("aria-pressed") == "false"


def test_the_motion_goes_on_along_the_new_orbit_when_a_slider_moves(explorer):
    explorer.page.locator(".param-play").click()
    wait_time(explorer, "t > 0.4")
    explorer.change(lambda: explorer.slide(h=0.3))
    t = assert_on_orbit(explorer, {**DEFAULTS, "h": 0.3})
    assert explorer.playing
    wait_time(explorer, f"t > {t + 0.3}")
    explorer.page.locator(".param-play").click()
    explorer.set_time(30.0)
    # An orbit that ends earlier takes the time with it.
    explorer.change(lambda: explorer.slide(span=10.0))
    assert explorer.time == approx(10.0, rel=1e-6)
    assert_on_orbit(explorer, {**DEFAULTS, "h": 0.3, "span": 10.0})


def test_the_names_of_examples_are_shown_whole_and_move_nothing(explorer):
    menu, slider = explorer.menu("preset"), explorer.slider("h")
    names = menu.evaluate("menu => [...menu.options].map(({ text }) => text)")
    place = slider.bounding_box()
    for name in (min(names[1:], key=len), max(names, key=len)):
        explorer.change(menu.select_option, name)
        text = (
            explorer.page.locator(".param-preset")
            .get_by_text(name, exact=True)
            .and_(explorer.page.locator("span:not(.longest)"))
        )
        inner, outer = text.bounding_box(), menu.bounding_box()
        assert outer["y"] <= inner["y"]
        assert inner["y"] + inner["height"] <= outer["y"] + outer["height"]
        assert text.evaluate("item => item.scrollWidth <= item.clientWidth && item.scrollHeight <= item.clientHeight")
        assert slider.bounding_box() == place
