"""Every control of the page, as a user works it: keyboard, mouse, typing, and the player."""

import json
from math import dist, pi

import pytest
from pytest import approx

from support.page import DEFAULTS, MOMENT, POINTS, SLIDERS, wait_frames, wait_time
from support.painted import yellow
from support.suslov_hess import assert_orbit, exact_states

# --- Sliders and boxes -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name, text, value",
    [
        ("I23", "−0.5", -0.5),
        ("h", "0,7", 0.7),
        ("h", "7.25", 7.25),
        ("span", "12.34567890123", 12.34567890123),
        ("phi0", "pi/3", pi / 3),
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


def test_what_is_not_a_number_is_marked_and_changes_nothing(explorer):
    for text in ("<b>2</b>", "1/0"):
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


def test_arrows_nudge_a_box_shift_by_ten_steps_and_a_label_is_dragged(explorer):
    for item in (explorer.box("h"), explorer.slider("h")):
        for key, value in (("ArrowUp", 1.51), ("Shift+ArrowUp", 1.61), ("ArrowDown", 1.6), ("Shift+ArrowDown", 1.5)):
            explorer.change(item.press, key)
            assert explorer.shown("h") == (value, value)
    assert_orbit(explorer, DEFAULTS)
    slider = explorer.slider("h")
    for key, end in (("End", "data-high"), ("Home", "data-low")):
        explorer.change(slider.press, key)
        assert explorer.shown("h")[0] == approx(float(slider.get_attribute(end)), abs=SLIDERS["h"])
    explorer.change(explorer.type, "h", "1.5")
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


# --- Menus and buttons -------------------------------------------------------------------------------


def test_the_accuracy_menu_changes_level_error_and_link_and_nothing_else(explorer):
    for name in ("draft", "precise", "reference", "standard"):
        explorer.change(explorer.choose, "accuracy", name)
        status = explorer.text("status")
        assert status.startswith(f"{name}:")
        assert status.count("error ≤ ") == 2
        assert explorer.chosen("accuracy") == name
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
    explorer.sent.clear()
    explorer.change(lambda: explorer.slide(h=2.0))
    # The menu that follows the state asks for none itself.
    assert [values for frame in explorer.sent if (values := json.loads(frame)["values"])] == [{"h": 2}]
    # An example keeps the accuracy.
    explorer.change(explorer.choose, "accuracy", "precise")
    explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
    assert explorer.text("status").startswith("precise:")


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


def test_the_speed_is_the_one_chosen(explorer):
    speed = "8"
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
    )
    for item in (explorer.slider("h"), explorer.menu("preset"), *(page.locator(name).first for name in others)):
        for playing in (True, False):
            item.press("Space")
            assert explorer.playing == playing
    assert explorer.shown("h")[0] == 1.51
    # Neither was anything of them done.
    assert page.locator(".comparison").is_hidden()
    assert page.locator(".lesson-menu").get_attribute("open") is None


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
