"""The page as a whole: when it is ready, what its link restores, what it refuses, and what it survives.

`Explorer` is what all tests of the page drive it with; the expected numbers come from `models` or from closed forms.
"""

from __future__ import annotations

import math
import re
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

import numpy as np
import pytest

from conftest import scene_of
from hess_explorer.headless.browser import wait_ready
from hess_explorer.headless.screenshot import running_server
from hess_explorer.protocol.parameters import MAX_QUERY, Number
from hess_explorer.scenes import scenes
from hess_mechanics import HessBody, level, solve, systems, turning_points

HESS, STUDY = "suslov-hess", "suslov-hess-accuracy"
FIRST = next(iter(scenes()))
"""The scene of a page whose address names none."""
DEFAULTS = scenes()[HESS].defaults()
PICTURES = ("omega", "sphere", "bifurcation", "circle")
SLIDERS = {"I22": 0.01, "I23": 0.01, "b3": 0.01, "h": 0.01, "f": 0.01, "phi0": 0.01, "span": 1.0}
"""The numbers, with the step of each slider at the default state."""


class Explorer:
    """A page that is open: what a user does with it, and what is to be seen on it."""

    def __init__(self, page, base):
        self.page = page
        self.base = base
        self.errors, self.outside, self.sent, self.received = [], [], [], []
        # Long enough for a machine that does much else; nothing is measured here.
        page.set_default_timeout(60_000)
        host = urlsplit(base).netloc

        def on_url(url):
            if urlsplit(url).netloc not in ("", host):
                self.outside.append(url)

        # Playwright takes no built-in methods.
        def on_sent(frame):
            self.sent.append(frame)

        def on_received(frame):
            self.received.append(frame)

        def on_socket(socket):
            on_url(socket.url)
            socket.on("framesent", on_sent)
            socket.on("framereceived", on_received)

        page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", lambda request: on_url(request.url))
        page.on("websocket", on_socket)

    def open(self, query=""):
        """The page of a query; one that names no scene is one of the Suslov–Hess scene."""
        return self.goto(f"/?{scene_of(query)}")

    def goto(self, address):
        """The page of exactly this address."""
        self.page.goto(self.base + address)
        wait_ready(self.page)
        return self

    def fresh(self, scene=HESS):
        """The default state, at t = 0, at rest, the sphere turned back: as if opened anew, but sooner."""
        url = self.page.url
        # Whatever a test that failed still held.
        self.page.mouse.up()
        if not url.startswith(self.base) or "theme=dark" in url or not self.ready or self.scene != scene:
            return self.open(f"scene={scene}")
        if self.playing:
            self.page.locator(".param-play").click()
        self.page.locator(".param-speed").select_option("1")
        self.set_time(0.0)
        if scene == HESS:
            self.sphere.press("Home")
        if self.accuracy != DEFAULTS["accuracy"]:
            self.change(self.choose, "accuracy", DEFAULTS["accuracy"])
        before = self.state
        ready = self.page.evaluate(ENTER, [(name, DEFAULTS[name]) for name in SLIDERS])
        wait_ready(self.page, after=before - (ready == "true"))
        if self.text("notes"):
            return self.open(f"scene={scene}")
        self.page.evaluate("document.activeElement?.blur()")
        self.page.mouse.move(5, 5)
        return self

    def assert_quiet(self):
        """No error was reported and no other host was asked for anything."""
        assert not self.errors, self.errors
        assert not self.outside, self.outside

    # What the page says.

    @property
    def state(self):
        return int(self.page.evaluate("document.documentElement.dataset.state"))

    @property
    def ready(self):
        return self.page.evaluate("document.documentElement.dataset.ready") == "true"

    def data(self, name):
        """The columns of a source of the scene on show; nested lists for polygons and lines of several parts."""
        return self.page.evaluate(
            """name => {
              const plain = (x) => ArrayBuffer.isView(x) || Array.isArray(x) ? Array.from(x, plain) : x
              const { data } = window.hess.source(name)
              return Object.fromEntries(Object.entries(data).map(([key, column]) => [key, plain(column)]))
            }""", name)

    def here(self):
        """(h, f) where the ring stands in the bifurcation diagram."""
        ring = self.data("bifurcation-here")
        return ring["h"][0], ring["f"][0]

    def axes(self, name):
        """(x from, x to, y from, y to) of a planar picture."""
        return self.page.evaluate(
            """name => {
              const { x_range: x, y_range: y } = window.hess.plots.find(({ model }) => model.name === name).model
              return [x.start, x.end, y.start, y.end]
            }""", name)

    def picture(self, name):
        """A picture of the scene on show, with its caption: those of scenes seen before stay where they are, unseen."""
        return self.page.locator(f".gallery:not(.away) .picture-{name}")

    def caption(self, picture):
        return self.picture(picture).locator(".caption").inner_text()

    def text(self, look):
        """What stands in the status line, the notes or the derived quantities."""
        return self.page.locator(f".text.{look}").text_content()

    @property
    def scene(self):
        """The name of the scene on show."""
        return self.page.locator(".scene[aria-pressed=true]").get_attribute("data-scene")

    @property
    def accuracy(self):
        """The level in the menu."""
        return self.chosen("accuracy")

    def chosen(self, menu):
        """The option that a menu shows, in its words."""
        return self.menu(menu).evaluate("menu => menu.selectedOptions[0]?.textContent ?? null")

    def shown(self, name):
        """(box, slider) of a number."""
        return float(self.box(name).input_value()), float(self.slider(name).input_value())

    @property
    def time(self):
        return float(self.page.locator("input.param-t").input_value())

    @property
    def playing(self):
        return self.page.locator(".player[role=group]").get_attribute("data-playing") == "true"

    @property
    def turn(self):
        """(azimuth, elevation) of the sphere as it is painted."""
        return tuple(map(float, self.sphere.get_attribute("data-turn").split()))

    def wait_url(self, **values):
        """Wait until the address bar has these values, and return all that it has."""
        self.page.wait_for_function(
            "wanted => wanted.every(([key, value]) => new URLSearchParams(location.search).get(key) === value)",
            arg=[[key, str(value)] for key, value in values.items()])
        return dict(parse_qsl(urlsplit(self.page.url).query))

    # What a user does.

    def slider(self, name):
        return self.page.locator(f".param-{name} input[type=range]")

    def box(self, name):
        return self.page.locator(f".param-{name} input[type=text]")

    def menu(self, name):
        return self.page.locator(f".param-{name} select")

    @property
    def sphere(self):
        return self.page.locator(".gallery:not(.away) canvas.sphere")

    def change(self, action, *arguments):
        """Do something that asks for a new state, and wait until it is painted."""
        before = self.state
        action(*arguments)
        wait_ready(self.page, after=before)

    def enter(self, scene):
        """Choose a scene from the menu."""
        self.change(self.page.locator(f".param-scene-{scene}").click)

    def type(self, name, text):
        """Type into the box of a number, and Enter."""
        box = self.box(name)
        box.fill(text)
        box.press("Enter")

    def slide(self, **values):
        """Move sliders all at once, as one input event each."""
        return self.page.evaluate(SLIDE, list(values.items()))

    def choose(self, menu, option):
        """Choose an option of a menu."""
        self.menu(menu).select_option(label=option)

    def play_until(self, t):
        """Let it play until the time slider has come past t."""
        self.page.locator(".param-play").click()
        while self.time <= t:
            self.page.wait_for_timeout(20)
        self.page.locator(".param-play").click()

    def set_time(self, t):
        """Move the time slider."""
        self.page.locator("input.param-t").evaluate(
            "(slider, t) => { slider.value = t; slider.dispatchEvent(new Event('input'));"
            " slider.dispatchEvent(new Event('change')) }", t)


FIND = """(name, kind) => {
  const find = (root, selector) => {
    const found = root.querySelector(selector)
    if (found) return found
    for (const item of root.querySelectorAll("*")) {
      const inside = item.shadowRoot && find(item.shadowRoot, selector)
      if (inside) return inside
    }
    return null
  }
  return find(document, `.param-${name} input[type=${kind}]`)
}"""
# All within one task of the browser; the answer is whether the page still says it is ready.
SLIDE = f"""pairs => {{
  for (const [name, value] of pairs) {{
    const slider = ({FIND})(name, "range")
    slider.value = value
    slider.dispatchEvent(new Event("input", {{ bubbles: true }}))
  }}
  return document.documentElement.dataset.ready
}}"""
ENTER = f"""pairs => {{
  for (const [name, value] of pairs) {{
    const box = ({FIND})(name, "text")
    box.value = value
    box.dispatchEvent(new Event("change", {{ bubbles: true }}))
  }}
  return document.documentElement.dataset.ready
}}"""


def one_tab(browser, server):
    """One tab for the tests of a module: loading a page is what takes longest."""
    context = browser.new_context(viewport={"width": 1600, "height": 950})
    yield Explorer(context.new_page(), server)
    context.close()


def default_state(tab):
    """The page in its default state; when the test ends it may have reported no error and asked no other host."""
    tab.fresh()
    tab.assert_quiet()
    yield tab
    tab.assert_quiet()


class Line:
    """Between a page and its server: can hold back what the server says."""

    def __init__(self, page):
        self._socket, self._held, self._holding = None, [], False
        page.route_web_socket(re.compile(r"/ws"), self._connect)

    def _connect(self, socket):
        self._socket = socket
        socket.connect_to_server().on_message(self._hear)

    def _hear(self, message):
        if self._holding:
            self._held.append(message)
        else:
            self._socket.send(message)

    def hold(self):
        self._holding = True

    def cut(self):
        """As when the server ends."""
        self._socket.close()

    def release(self):
        self._holding = False
        while self._held:
            self._socket.send(self._held.pop(0))


def page_on_a_line(browser, server):
    """(explorer, line): the page in its default state, and what is between it and the server."""
    context = browser.new_context(viewport={"width": 1600, "height": 950})
    page = context.new_page()
    line = Line(page)
    explorer = Explorer(page, server).open()
    yield explorer, line
    explorer.assert_quiet()
    context.close()


# Each module of browser tests makes its own fixtures of these.
tab = pytest.fixture(scope="module")(one_tab)
on_a_line = pytest.fixture(page_on_a_line)
explorer = pytest.fixture(default_state)


def flat(data):
    """All numbers of a source's columns, however nested, in order."""
    if isinstance(data, dict):
        return [x for key in sorted(data) for x in flat(data[key])]
    return [x for part in data for x in flat(part)] if isinstance(data, list) else [data]


def body_of(values):
    return HessBody(values["I22"], values["I23"], values["b3"])


def exact_states(values, times):
    """(ω1, ω2, γ1, γ2, γ3) at these times, in the variables of S1 and not, as the page does it, in those of S8."""
    body = body_of(values)
    start = turning_points(values["h"], values["f"]).state_at_lower_turn(values["phi0"])
    state = body.from_reduced(body.from_units_of_b(start))
    return solve(systems()["suslov"], state, body.suslov.parameters, times, level("reference")).states


def rounding(values, times, states):
    """How far the body gets in half of the last digit of these times, which are sent in single precision."""
    rates = np.abs(systems()["suslov"].field(states.T, body_of(values).suslov.parameters)).T
    return rates * np.spacing(np.float32(times))[:, None] / 2


def assert_orbit(explorer, values, within=2e-6):
    """The orbit in the browser is that of these values: where it starts, where it ends, and in between."""
    orbit = explorer.data("data-orbit")
    times = np.array(orbit["t"])
    last = min(values["span"], 100 * turning_points(values["h"], values["f"]).period / body_of(values).frequency_unit)
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(last, rel=1e-6)
    assert np.all(np.diff(times) > 0)
    picks = np.unique(np.linspace(0, times.size - 1, 7).astype(int))
    exact = exact_states(values, times[picks])
    found = np.column_stack([np.array(orbit[name])[picks] for name in ("omega1", "omega2", "g1", "g2", "g3")])
    allowed = within * np.maximum(1.0, np.abs(exact)) + rounding(values, times[picks], exact)
    assert np.max(np.abs(found - exact) - allowed) <= 0.0
    assert explorer.here() == pytest.approx((values["h"], values["f"]), rel=1e-7)


# --- The ready flag ----------------------------------------------------------------------------------

RECORD = """
  window.record = []
  const canvases = (within) => Array.from(within.querySelectorAll("*")).flatMap(
    (item) => [...(item.tagName === "CANVAS" ? [item] : []), ...(item.shadowRoot ? canvases(item.shadowRoot) : [])])
  const drawn = (canvas) => canvas.width > 0 && canvas.getContext("2d")
    .getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value !== 0)
  new MutationObserver(() => {
    const { ready, state } = document.documentElement.dataset
    const count = ready === "true" ? canvases(document).filter(drawn).length : null
    window.record.push({ ready, state: Number(state), drawn: count })
  }).observe(document, { attributes: true, subtree: true, attributeFilter: ["data-ready", "data-state"] })
"""


def test_a_page_says_it_is_ready_once_and_when_its_pictures_are_drawn(browser, server):
    context = browser.new_context(viewport={"width": 1600, "height": 950})
    context.add_init_script(RECORD)
    explorer = Explorer(context.new_page(), server).open()
    record = explorer.page.evaluate("record")
    context.close()
    assert record[0]["ready"] == "false"
    assert [entry["ready"] for entry in record].count("true") == 1
    assert record[-1]["ready"] == "true"
    assert record[-1]["state"] == 1
    # Three planar pictures of two canvases each, and the sphere.
    assert record[-1]["drawn"] == 7
    explorer.assert_quiet()


def test_a_change_takes_the_flag_down_at_once_and_the_state_number_up(explorer):
    for h in (0.9, 0.2, 3.3):
        before = explorer.state
        assert explorer.slide(h=h) == "false"
        wait_ready(explorer.page, after=before)
        assert explorer.state == before + 1
        assert explorer.here() == (pytest.approx(h), 0.6)


@pytest.mark.parametrize("pause_ms", [0, 4])
def test_the_newest_of_fifty_changes_wins_and_none_arrives_later(explorer, pause_ms):
    before = explorer.state
    values = np.linspace(-0.5, 2.0, 50).round(2)
    at_the_end = explorer.page.evaluate(
        f"""async ([values, pause]) => {{
          const slide = {SLIDE}
          for (const value of values) {{
            slide([["h", value]])
            if (pause > 0) await new Promise((done) => setTimeout(done, pause))
          }}
          return Number(document.documentElement.dataset.state)
        }}""", [values.tolist(), pause_ms])
    wait_ready(explorer.page, after=at_the_end)
    painted = explorer.state
    # Of what came while a state was on its way only the newest is asked for.
    assert painted - at_the_end <= 2
    assert pause_ms > 0 or painted - before <= 2
    assert_orbit(explorer, {**DEFAULTS, "h": 2.0})
    assert explorer.shown("h") == (2.0, 2.0)
    # Whatever were still under way would be painted before the answer to this.
    explorer.change(lambda: explorer.slide(f=0.5))
    assert explorer.state == painted + 1


def test_changes_of_several_sliders_at_once_are_one_state(explorer):
    before = explorer.state
    values = {"I22": 1.2, "I23": -0.5, "b3": -2.0, "h": 0.7, "f": -0.3, "phi0": 2.0, "span": 11.0}
    explorer.change(lambda: explorer.slide(**values))
    assert explorer.state - before <= 2
    assert_orbit(explorer, {**DEFAULTS, **values})


def test_an_answer_that_takes_long_is_said_to_be_under_way(on_a_line):
    explorer, line = on_a_line
    page = explorer.page
    sign = page.locator(".text.busy")
    assert sign.is_hidden()
    assert sign.get_attribute("role") == "status"
    line.hold()
    before = explorer.state
    explorer.slide(h=0.9)
    sign.wait_for(state="visible")
    assert sign.inner_text().startswith("Computing…")
    assert (explorer.ready, explorer.state, explorer.here()[0]) == (False, before, 1.5)
    box = sign.bounding_box()
    assert min(box["width"], box["height"]) > 20
    assert 0 < box["x"] < box["x"] + box["width"] <= 1600
    assert 0 < box["y"] < box["y"] + box["height"] <= 950
    line.release()
    wait_ready(page, after=before)
    assert sign.is_hidden()
    assert_orbit(explorer, {**DEFAULTS, "h": 0.9})
    # What comes in time is not announced.
    page.evaluate("""() => {
      window.said = []
      document.addEventListener("hess:texts", (event) => { if (event.detail.busy) said.push(event.detail.busy) })
    }""")
    for h in (0.8, 0.7):
        explorer.change(lambda h=h: explorer.slide(h=h))
    page.evaluate("new Promise((done) => setTimeout(done, 600))")
    assert page.evaluate("said") == []


def test_a_page_that_has_lost_its_server_says_so_and_keeps_saying_it(on_a_line):
    explorer, line = on_a_line
    page = explorer.page
    sign = page.locator(".text.busy")
    line.cut()
    sign.wait_for(state="visible")
    assert sign.inner_text().startswith("The connection to the server is lost.")
    # What is chosen now cannot be shown, and is not said to be under way.
    explorer.slide(h=0.9)
    page.evaluate("new Promise((done) => setTimeout(done, 600))")
    assert sign.inner_text().startswith("The connection to the server is lost.")
    assert not explorer.ready
    # The pictures stay what they were, and so does the motion on them.
    assert explorer.here()[0] == 1.5
    page.locator(".param-play").click()
    assert explorer.playing


# --- The link ----------------------------------------------------------------------------------------

OTHER_KEYS = ("v", "scene", "accuracy", "theme")
"""Those of the keys of a link that hold no numbers."""
LINKED = {"I22": 1.25, "I23": -0.5, "b3": -2.5, "h": 0.75, "f": -0.4, "phi0": -2.0, "span": 15.0}


def assert_linked(explorer, values):
    for name, value in values.items():
        box, slider = explorer.shown(name)
        assert box == value, name
        # A slider stands at the nearest of its steps.
        assert slider == pytest.approx(value, abs=0.51 * SLIDERS[name]), name
    assert_orbit(explorer, {**DEFAULTS, **values})


def test_a_link_restores_the_whole_state(explorer):
    query = {"v": 1, **LINKED, "accuracy": "precise", "t": 5.25, "speed": 4, "az": -2.25, "el": 1.125, "theme": "dark"}
    explorer.open(urlencode(query))
    assert_linked(explorer, LINKED)
    assert explorer.accuracy == "precise"
    assert explorer.text("status").startswith("precise:")
    assert explorer.time == pytest.approx(5.25)
    assert explorer.page.locator(".param-speed").input_value() == "4"
    assert explorer.turn == (-2.25, 1.125)
    assert explorer.text("notes") == ""
    # And the page says so in its own words, losing nothing.
    found = explorer.wait_url(v="1", accuracy="precise", theme="dark")
    numbers = {name: float(text) for name, text in found.items() if name not in OTHER_KEYS}
    assert numbers == {name: float(value) for name, value in query.items() if name not in OTHER_KEYS}


def test_the_link_follows_what_the_user_does_and_opens_the_same_page_elsewhere(explorer, open_page):
    explorer.change(lambda: explorer.slide(I22=1.25, I23=-0.5, h=0.75, span=15.0))
    explorer.change(lambda: explorer.type("f", "1e-3"))
    explorer.change(lambda: explorer.choose("accuracy", "reference"))
    explorer.set_time(7.5)
    explorer.page.locator(".param-speed").select_option("2")
    explorer.sphere.press("ArrowUp")
    explorer.wait_url(I22="1.25", I23="-0.5", h="0.75", span="15.0", f="0.001", accuracy="reference")
    explorer.wait_url(t="7.500", speed="2", az="0.6000", el=f"{0.35 + math.pi / 36:.4f}")

    other = Explorer(open_page(urlsplit(explorer.page.url).query), explorer.base)
    assert_linked(other, {"I22": 1.25, "I23": -0.5, "h": 0.75, "span": 15.0, "f": 1e-3})
    assert other.time == pytest.approx(7.5)
    assert other.page.locator(".param-speed").input_value() == "2"
    assert other.turn == pytest.approx((0.6, 0.35 + math.pi / 36), abs=6e-4)
    assert other.text("notes") == ""
    for name in ("data-orbit", "data-stable", "circle-map", "bifurcation-boundary", "bifurcation-point", "omega-point"):
        assert other.data(name) == explorer.data(name), name
    for name in PICTURES:
        assert other.caption(name) == explorer.caption(name)
    assert other.text("status").split(" · ")[:3] == explorer.text("status").split(" · ")[:3]


def test_a_speed_that_the_player_does_not_offer_is_put_right_in_the_link_too(explorer):
    explorer.open("speed=3&h=0.75")
    shown = explorer.page.locator(".param-speed").input_value()
    found = explorer.wait_url(v="1")
    assert float(found.get("speed", "1")) == float(shown)


def test_a_link_made_at_the_pole_of_the_sphere_opens_without_a_note(explorer):
    for _ in range(20):
        explorer.sphere.press("ArrowUp")
    explorer.page.wait_for_function("location.search.includes('el=1.57')")
    assert explorer.turn[1] == pytest.approx(math.pi / 2, abs=1e-4)
    explorer.open(urlsplit(explorer.page.url).query)
    assert explorer.text("notes") == ""
    assert explorer.turn[1] == pytest.approx(math.pi / 2, abs=1e-3)


def test_nonsense_in_a_link_is_clamped_key_by_key_with_a_note_each(explorer):
    nonsense = {"I22": -4, "I23": "banana", "b3": "nan", "h": 0.25, "f": 99, "phi0": "1e400", "span": "",
                "accuracy": "best", "t": -1, "speed": 100, "az": 9, "el": "up", "theme": "blue"}
    explorer.open(urlencode(nonsense))
    # f_max at h = 1/4 by the corrected Geq3: n = 1/2 has h = (1 − 3/4)/1 = 1/4 and f = (3/4)/√½.
    top = 0.75 * math.sqrt(2)
    expected = {**DEFAULTS, "I22": 1e-3, "h": 0.25, "f": top}
    # a = I23/I22 is kept within 100.
    expected["I23"] = 0.1
    for name in SLIDERS:
        assert explorer.shown(name)[0] == pytest.approx(expected[name], rel=1e-9), name
    notes = explorer.text("notes").splitlines()
    assert explorer.page.locator(".text.notes").is_visible()
    for symbol in ("I₂₂", "I₂₃", "b₃", "φ₀", "t ", "Accuracy", "speed", "azimuth", "elevation", "Theme", "f is at"):
        assert any(symbol in note for note in notes), symbol
    assert not any("banana" in note or "blue" in note for note in notes)
    assert explorer.time == 0.0
    assert explorer.page.locator(".param-speed").input_value() == "8"
    azimuth, elevation = explorer.turn
    assert abs(azimuth) <= math.pi + 1e-4
    assert elevation == 0.35
    # The first change of the user takes the notes of the link away.
    explorer.change(lambda: explorer.slide(h=0.3))
    assert not any("Accuracy" in note or "φ₀" in note for note in explorer.text("notes").splitlines())


@pytest.mark.parametrize(("query", "expected"), [
    ("h=%2B2.5", {"h": 2.5}),
    ("h=2.5e%2B0&f=+0.5", {"h": 2.5, "f": 0.5}),
    ("h=2%26f%3D0.1", {}),
    ("f=0.1%23&phi0=%00", {}),
    ("h=%FF%FE&%FF=1&f=0.25", {"f": 0.25}),
    ("v=99&h=2.5", {"h": 2.5}),
])
def test_a_value_is_read_as_it_was_written_and_no_key_leaks_into_another(explorer, query, expected):
    explorer.open(query)
    assert {name: explorer.shown(name)[0] for name in SLIDERS} == {
        name: value for name, value in {**DEFAULTS, **expected}.items() if name in SLIDERS}
    noted = query in ("h=2%26f%3D0.1", "f=0.1%23&phi0=%00", "h=%FF%FE&%FF=1&f=0.25", "v=99&h=2.5")
    assert bool(explorer.text("notes")) == noted


@pytest.mark.parametrize("payload", [
    "<img src=x onerror=window.pwned=1>",
    "\"'><script>window.pwned=1</script>",
    "javascript:window.pwned=1",
])
def test_a_script_in_any_key_of_a_link_is_neither_run_nor_shown(explorer, payload):
    keys = ["v", *DEFAULTS, "t", "speed", "az", "el", "theme"]
    explorer.open("&".join(f"{key}={quote(payload)}" for key in keys) + f"&{quote(payload)}=1")
    for name in SLIDERS:
        assert explorer.shown(name)[0] == DEFAULTS[name]
    assert explorer.page.evaluate("window.pwned") is None
    seen = explorer.page.evaluate(
        """() => {
          const all = (root) => Array.from(root.querySelectorAll("*")).flatMap(
            (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
          return all(document).filter((item) => !["SCRIPT", "STYLE"].includes(item.tagName))
            .flatMap((item) => [...item.childNodes].filter((child) => child.nodeType === 3).map((child) => child.data)
              .concat([...item.attributes].map((attribute) => attribute.value)))
        }""")
    assert len(seen) > 500
    assert not [text for text in seen if "pwned" in text or "onerror" in text]
    assert len(explorer.text("notes").splitlines()) == len(keys)
    # The page's own link is clean again.
    assert "pwned" not in urlencode(explorer.wait_url(v="1"))


def test_whatever_a_text_of_the_page_is_told_to_say_it_shows_as_text(explorer):
    payload = "<img src=x onerror=window.pwned=1><b>bold</b>"
    said = {"status": payload, "omega": payload}
    explorer.page.evaluate("detail => document.dispatchEvent(new CustomEvent('hess:texts', { detail }))", said)
    assert explorer.text("status") == payload
    assert explorer.caption("omega") == payload
    assert explorer.page.locator(".text img, .text b").count() == 0
    assert explorer.page.evaluate("window.pwned") is None
    explorer.open()


def assert_defaults(explorer, scene, **others):
    """The page shows the default state of this scene, but for the values of others that it knows."""
    assert explorer.scene == scene
    for spec in scenes()[scene].specs:
        value = others.get(spec.name, spec.default)
        if isinstance(spec, Number):
            assert explorer.shown(spec.name) == (value, value), spec.name
        else:
            assert explorer.chosen(spec.name) == value, spec.name


def test_an_address_without_a_link_opens_the_first_scene_in_its_default_state(explorer):
    explorer.goto("/")
    assert_defaults(explorer, FIRST)
    assert explorer.text("notes") == ""
    assert explorer.wait_url(v="1")["scene"] == FIRST


def test_a_link_that_is_too_long_shows_the_defaults_and_a_note(explorer):
    explorer.goto(f"/?scene={HESS}&h=2.5&x={'7' * MAX_QUERY}")
    assert_defaults(explorer, FIRST)
    assert str(MAX_QUERY) in explorer.text("notes")


def test_a_link_of_very_many_keys_opens_the_page_all_the_same(explorer):
    explorer.open("h=2.5&" + "&".join(f"k{i}=1" for i in range(250)))
    assert explorer.here()[0] == 2.5


# --- Sessions ----------------------------------------------------------------------------------------

def test_two_sessions_do_not_affect_each_other(explorer, open_page):
    other = Explorer(open_page("h=0.5&f=0.2&phi0=1"), explorer.base)
    explorer.change(lambda: explorer.slide(h=2.5, I22=1.5))
    other.change(lambda: other.slide(span=20.0))
    assert other.state == 2
    assert_orbit(other, {**DEFAULTS, "h": 0.5, "f": 0.2, "phi0": 1.0, "span": 20.0})
    assert_orbit(explorer, {**DEFAULTS, "h": 2.5, "I22": 1.5})
    other.change(lambda: other.slide(h=0.4))
    assert explorer.shown("h")[0] == 2.5
    explorer.change(lambda: explorer.slide(f=0.3))
    assert_orbit(explorer, {**DEFAULTS, "h": 2.5, "I22": 1.5, "f": 0.3})


def test_what_no_control_of_the_page_would_send_does_no_harm(explorer):
    explorer.change(lambda: explorer.page.evaluate(
        """() => {
          for (const detail of [{ nobody: 1 }, { h: "<b>", f: null, I22: [1], accuracy: 3 }, { b3: {} }])
            document.dispatchEvent(new CustomEvent("hess:change", { detail }))
          document.dispatchEvent(new CustomEvent("hess:pick", { detail: ["nowhere", 1, 1] }))
        }"""))
    assert_orbit(explorer, DEFAULTS)
    explorer.change(lambda: explorer.page.evaluate(
        """document.dispatchEvent(new CustomEvent("hess:change", { detail: { h: 1e300, phi0: 1 } }))"""))
    assert explorer.here()[0] == 1e6
    explorer.change(lambda: explorer.slide(h=1.5))
    assert_orbit(explorer, {**DEFAULTS, "phi0": 1.0})


def test_a_page_whose_server_has_ended_keeps_its_pictures_and_plays_on(browser, tmp_path):
    context = browser.new_context(viewport={"width": 1600, "height": 950})
    page = context.new_page()
    closed = []
    page.on("websocket", lambda socket: socket.on("close", lambda _: closed.append(socket)))
    names = ("data-orbit", "circle-map", "bifurcation-here", "bifurcation-boundary")
    with running_server(tmp_path / "server.log") as base:
        explorer = Explorer(page, base).open("h=0.75")
        before = {name: explorer.data(name) for name in names}
        captions = [explorer.caption(name) for name in PICTURES]
        explorer.wait_url(h="0.75")
    while not closed:
        page.wait_for_function("new Promise((done) => requestAnimationFrame(() => done(true)))")
    assert {name: explorer.data(name) for name in names} == before
    assert [explorer.caption(name) for name in PICTURES] == captions
    page.locator(".param-play").click()
    page.wait_for_function("window.hess.source('data-orbit') != null")
    page.wait_for_function("document.querySelector('html').dataset.ready === 'true'")
    playing_from = explorer.data("omega-point")
    page.wait_for_function(
        "x => window.hess.source('omega-point').data.x[0] !== x", arg=playing_from["x"][0])
    explorer.sphere.press("ArrowLeft")
    page.wait_for_function("location.search.includes('az=0.687')")
    assert explorer.turn[0] == pytest.approx(0.6 + math.pi / 36, abs=1e-4)
    explorer.assert_quiet()
    context.close()
