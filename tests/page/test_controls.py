"""Every control of the page, as a user works it: keyboard, mouse, typing, and the player."""

import json
from math import dist, pi

from playwright.sync_api import expect
from pytest import approx

from hess_explorer.headless.browser import wait_ready
from support.page import DEFAULTS, MOMENT, POINTS, SLIDERS, wait_frames, wait_time
from support.painted import yellow
from support.suslov_hess import assert_orbit, exact_states

# --- Sliders and boxes -------------------------------------------------------------------------------


BOXES = (
    ("I23", "−0.5", -0.5),
    ("h", "0,7", 0.7),
    ("h", "7.25", 7.25),
    ("span", "12.34567890123", 12.34567890123),
    ("phi0", "pi/3", pi / 3),
)


def test_a_box_takes_an_exact_value_and_marks_what_is_none(explorer):
    values = dict(DEFAULTS)
    for name, text, value in BOXES:
        explorer.change(explorer.type, name, text)
        values[name] = value
        box, slider = explorer.shown(name)
        assert box == value
        assert slider == approx(value, abs=0.51 * SLIDERS[name])
        assert explorer.text("notes") == ""
        explorer.wait_url(**{name: repr(value)})
    assert_orbit(explorer, values)
    box, marked = explorer.box("h"), explorer.page.locator(".param-h .exact[aria-invalid=true]")
    for text, why in (("<b>2</b>", "This is not"), ("1/0", "The value is not finite")):
        explorer.type("h", text)
        # The server parses everything that is not a plain number.
        marked.wait_for()
        expect(explorer.page.locator(".param-h .why")).to_contain_text(why)
        wait_ready(explorer.page)
        assert box.input_value() == text
        box.press("Escape")
        assert marked.count() == 0
        assert box.input_value() == "7.25"
    assert_orbit(explorer, values)
    # A message beside the slider says that the model limits it, until another value is chosen.
    explorer.change(explorer.type, "f", "9")
    expect(explorer.page.locator(".why:visible")).to_have_text(explorer.text("notes"))
    assert "f was set to this limit" in explorer.text("notes")
    assert box.get_attribute("aria-invalid") != "true"
    explorer.change(explorer.type, "f", "0.5")
    expect(explorer.page.locator(".why:visible")).to_have_count(0)


def test_arrows_nudge_a_box_shift_by_ten_steps_and_a_label_is_dragged(explorer):
    for item in (explorer.box("h"), explorer.slider("h")):
        for key, value in (("ArrowUp", 1.51), ("Shift+ArrowUp", 1.61), ("ArrowDown", 1.6), ("Shift+ArrowDown", 1.5)):
            explorer.change(item.press, key)
            assert explorer.shown("h") == (value, value)
    slider = explorer.slider("h")
    for key, end in (("End", "data-high"), ("Home", "data-low")):
        explorer.change(slider.press, key)
        assert explorer.shown("h")[0] == approx(float(slider.get_attribute(end)), abs=SLIDERS["h"])
    explorer.change(explorer.type, "h", "1.5")
    label = explorer.page.locator(".param-h .label").bounding_box()
    mouse, middle = explorer.page.mouse, label["y"] + label["height"] / 2
    mouse.move(label["x"] + 5, middle)
    mouse.down()
    for x, h in ((25, 1.7), (2000, 4.0), (-25, 1.2)):
        explorer.change(mouse.move, label["x"] + x, middle)
        assert explorer.shown("h") == (h, h)
    explorer.change(mouse.up)
    assert_orbit(explorer, {**DEFAULTS, "h": 1.2})
    # All of the drag is one step.
    explorer.change(explorer.page.keyboard.press, "Control+z")
    assert explorer.shown("h") == (1.5, 1.5)


# --- Menus and buttons -------------------------------------------------------------------------------


def test_the_menus_of_accuracy_and_examples_set_the_state_and_say_when_it_is_left(explorer):
    for name in ("draft", "reference", "precise"):
        explorer.change(explorer.choose, "accuracy", name)
        assert explorer.text("status").startswith(f"{name}:")
        explorer.wait_url(accuracy=name)
    for _ in range(2):
        explorer.change(explorer.choose, "preset", "No cycle: every orbit winds")
        assert explorer.chosen("preset") == "No cycle: every orbit winds"
        # An example keeps the accuracy.
        assert explorer.chosen("accuracy") == "precise"
        assert_orbit(explorer, {**DEFAULTS, "h": 0.2, "f": 0.5})
        explorer.move(phi0=1.0)
        assert explorer.chosen("preset") == "Choose an example…"
    explorer.change(explorer.choose, "preset", "Two limit cycles")
    explorer.sent.clear()
    explorer.move(h=2.0)
    # The menu that follows the state asks for none itself.
    assert [values for frame in explorer.sent if (values := json.loads(frame)["values"])] == [{"h": 2}]


# --- The player --------------------------------------------------------------------------------------


def assert_on_orbit(explorer, values):
    """The point of (ω1, ω2) stands where the body is at the time that the slider shows."""
    found = explorer.page.evaluate(MOMENT, POINTS)
    exact = exact_states(values, [found["t"]])[0]
    # Between two samples it runs straight, a quarter of a pixel (8/600) from the curve at most.
    assert found["points"][0] == approx(exact[:2], abs=4e-3)
    return found["t"]


def wait_silence(explorer):
    """Let the server's last acknowledgements arrive."""
    frames = None
    while frames != (frames := len(explorer.received)):
        wait_frames(explorer, 12)


def test_play_and_the_time_slider_move_the_point_in_all_pictures_without_the_server(explorer):
    page, play = explorer.page, explorer.page.locator(".param-play")
    wait_silence(explorer)
    state, sent, received = explorer.state, len(explorer.sent), len(explorer.received)
    before, spot = page.evaluate(MOMENT, POINTS)["points"], yellow(explorer)
    play.click()
    wait_time(explorer, "t > 1.2")
    after = page.evaluate(MOMENT, POINTS)["points"]
    for name, old, new in zip(POINTS, before, after, strict=True):
        # In the circle map the point goes from (φ0, φ0) to (φ0, Θ(φ0)) within one period.
        assert dist(old, new) > 0.05, name
    assert dist(spot, yellow(explorer)) > 0.02
    play.click()
    assert not explorer.playing
    assert_on_orbit(explorer, DEFAULTS)
    slider = page.locator("input.param-t")
    slider.click()
    assert explorer.time == approx(20.0, abs=0.5)
    t = assert_on_orbit(explorer, DEFAULTS)
    assert page.locator(".player output").inner_text() == f"t = {t:.2f}"
    assert slider.get_attribute("aria-valuetext") == f"t = {t:.2f} of 40.00"
    slider.press("End")
    assert explorer.time == approx(40.0, rel=1e-6)
    assert (explorer.state, len(explorer.sent), len(explorer.received)) == (state, sent, received)
    assert explorer.ready


def test_the_speed_is_the_one_chosen(explorer):
    speed = explorer.page.locator(".param-speed")
    assert speed.locator("option").all_inner_texts() == ["0.25×", "0.5×", "1×", "2×", "4×", "8×"]
    speed.select_option("8")
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
        POINTS,
    )
    # One frame more or less.
    assert passed == approx(8.0 * elapsed, abs=1.2)
    explorer.wait_url(speed="8")


def test_space_and_arrow_keys_work_the_player_unless_they_mean_something_where_the_focus_is(explorer):
    page, keys = explorer.page, explorer.page.keyboard
    for key, t in (("ArrowRight", 0.2), ("ArrowRight", 0.4), ("ArrowLeft", 0.2), ("Control+ArrowRight", 0.2)):
        keys.press(key)
        assert explorer.time == approx(t, rel=1e-5)
    explorer.change(explorer.slider("h").press, "ArrowRight")
    box = explorer.box("h")
    box.focus()
    for key in ("End", "Space", "ArrowLeft"):
        keys.press(key)
    assert box.input_value() == "1.51 "
    explorer.sphere.press("ArrowRight")
    assert explorer.time == approx(0.2, rel=1e-5)
    # Space plays, whatever has the focus but a box; on the button itself it is a click, once.
    others = (
        *(".param-more", ".param-play", ".param-speed", ".group > summary", ".corner:visible", ".param-pin"),
        *(".param-text", ".lesson-menu > summary", ".chip:visible", "canvas.sphere:visible"),
    )
    for item in (explorer.slider("h"), explorer.menu("preset"), *(page.locator(name).first for name in others)):
        for playing in (True, False):
            item.press("Space")
            assert explorer.playing == playing
    # Neither was anything of them done.
    assert explorer.shown("h")[0] == 1.51
    assert page.locator(".comparison").is_hidden()
    assert page.locator(".lesson-menu").get_attribute("open") is None


def test_the_motion_goes_on_along_the_new_orbit_when_a_slider_moves(explorer):
    explorer.page.locator(".param-play").click()
    wait_time(explorer, "t > 0.4")
    explorer.move(h=0.3)
    t = assert_on_orbit(explorer, {**DEFAULTS, "h": 0.3})
    assert explorer.playing
    wait_time(explorer, f"t > {t + 0.3}")
    explorer.page.locator(".param-play").click()
    # An orbit that ends earlier takes the time with it.
    explorer.set_time(30.0)
    explorer.move(span=10.0)
    assert explorer.time == approx(10.0, rel=1e-6)
    assert_on_orbit(explorer, {**DEFAULTS, "h": 0.3, "span": 10.0})
