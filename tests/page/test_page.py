"""The page as a whole: when it is ready, restoring links, refusals, and recovery from failures.

`Explorer` is what all tests of the page drive it with; the expected numbers come from `models` or from closed forms.
"""

import signal
from math import pi
from urllib.parse import quote, urlencode, urlsplit

from playwright.sync_api import expect
from pytest import approx

from hess_explorer.headless.browser import wait_ready
from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.specs import NumberSpec, Points
from hess_explorer.scenes import scenes
from support.page import DEFAULTS, FIRST, SLIDERS, own_tab, wait_frames
from support.processes import UNWARMED
from support.suslov_hess import assert_orbit


def assert_defaults(explorer, scene, **others):
    """Assert that the page shows the scene's default state, except for values shared with other scenes."""
    assert explorer.scene == scene
    for spec in scenes()[scene].specs:
        value = others.get(spec.name, spec.default)
        if isinstance(spec, NumberSpec):
            assert explorer.shown(spec.name) == (value, value), spec.name
        elif not isinstance(spec, Points):
            assert explorer.chosen(spec.name) == value, spec.name


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
    window.record.push({ ready, state: Number(state), drawn: count, at: performance.now() })
  }).observe(document, { attributes: true, subtree: true, attributeFilter: ["data-ready", "data-state"] })
"""


def test_an_address_without_a_link_opens_the_first_scene_and_says_it_is_ready_once_when_that_is_drawn(browser, server):
    with own_tab(browser, server, script=RECORD) as explorer:
        explorer.goto("/")
        record = explorer.page.evaluate("record")
        assert_defaults(explorer, FIRST)
        assert explorer.text("notes") == ""
        assert explorer.wait_url(v="1")["scene"] == FIRST
    assert record[0]["ready"] == "false"
    assert [entry["ready"] for entry in record].count("true") == 1
    assert record[-1]["ready"] == "true"
    # Once more with what is proved, if that was not known; until then the page asks every 80 ms at most.
    painted = next(entry["at"] for entry in record if entry["state"] == 1)
    assert 1 <= record[-1]["state"] <= 2 + (record[-1]["at"] - painted) / 79.0
    # Three planar pictures of three canvases each, the cells of one, the body, and the sphere and the torus of two.
    assert record[-1]["drawn"] == 15


def test_an_answer_that_takes_long_is_said_and_moves_no_control_back(with_websocket):
    explorer, websocket = with_websocket
    page, sign = explorer.page, explorer.page.locator(".text.busy")
    assert sign.is_hidden()
    websocket.hold()
    before = explorer.state
    explorer.choose("preset", "No cycle: every orbit winds")
    expect(sign).to_contain_text("Computing…")
    expect(sign).to_be_in_viewport(ratio=1)
    explorer.slide(phi0=1.0)
    explorer.slider("phi0").evaluate("""slider => {
      window.shown = []
      hess.listen("controls", () => shown.push(Number(slider.value)))
    }""")
    assert (explorer.ready, explorer.state, explorer.here()[0]) == (False, before, 1.5)
    websocket.release()
    wait_ready(page, after=before + 1)
    assert sign.is_hidden()
    assert_orbit(explorer, {**DEFAULTS, "h": 0.2, "f": 0.5, "phi0": 1.0})
    assert set(page.evaluate("shown")) == {1.0}
    for name, value in {"h": 0.2, "f": 0.5, "phi0": 1.0}.items():
        assert explorer.shown(name) == (value, value)


def test_a_page_that_has_lost_its_server_says_so_and_goes_on_with_all_changes_when_it_is_back(with_websocket):
    explorer, websocket = with_websocket
    page = explorer.page
    sign = page.locator(".text.busy")
    explorer.move(f=0.5)
    asked = []

    def keep(route):
        asked.append(route)

    # The server does not answer yet.
    page.route("**/liveness", keep)
    websocket.cut()
    sign.wait_for(state="visible")
    assert sign.inner_text().startswith("Connection to the server lost.")
    # Without a connection a new value is neither shown nor announced as in progress.
    explorer.slide(h=0.9)
    wait_frames(explorer, 12)
    assert sign.inner_text().startswith("Connection to the server lost.")
    assert not explorer.ready
    # The pictures stay what they were, and so does the motion on them.
    assert explorer.here() == (1.5, 0.5)
    page.locator(".param-play").click()
    assert explorer.playing
    while not asked:
        page.wait_for_timeout(50)
    with page.expect_navigation(timeout=60_000):
        asked[0].continue_()
    page.unroute("**/liveness")
    wait_ready(page)
    # With the change, and with all steps before it.
    assert explorer.here() == (0.9, 0.5)
    assert sign.inner_text() == ""
    assert len(asked) == 1
    for here in ((1.5, 0.5), (1.5, 0.6)):
        explorer.change(page.locator(".param-undo").click)
        assert explorer.here() == here
    explorer.change(page.locator(".param-redo").click)
    assert explorer.here() == (1.5, 0.5)


def test_a_frozen_server_is_named_within_ten_seconds_and_the_page_goes_on_with_it(browser, tmp_path):
    with server_process(tmp_path / "log", UNWARMED) as (process, base), own_tab(browser, base) as explorer:
        explorer.open()
        sign = explorer.page.locator(".text.busy", has_text="The server does not respond.")
        process.send_signal(signal.SIGSTOP)
        try:
            before = explorer.state
            explorer.slide(h=0.9)
            sign.wait_for(timeout=10_000)
        finally:
            process.send_signal(signal.SIGCONT)
        wait_ready(explorer.page, after=before)
        assert sign.count() == 0
        assert explorer.here() == (0.9, 0.6)


# --- The link ----------------------------------------------------------------------------------------


def test_the_link_follows_what_the_user_does_and_opens_the_same_page_elsewhere(explorer, browser):
    """All of the pictures is compared in "test_by_hand"."""
    values = {"I22": 1.25, "I23": -0.5, "h": 0.75, "span": 15.0, "f": 1e-3}
    explorer.move(I22=1.25, I23=-0.5, h=0.75, span=15.0)
    explorer.change(explorer.type, "f", "1e-3")
    explorer.change(explorer.choose, "accuracy", "reference")
    explorer.set_time(7.5)
    explorer.page.locator(".param-speed").select_option("2")
    explorer.sphere.press("ArrowUp")
    explorer.wait_url(**values, accuracy="reference", t="7.500", speed="2", az="0.6000", el=f"{0.35 + pi / 36:.4f}")
    # Up to the pole, where a rounded angle is beyond it.
    for _ in range(20):
        explorer.sphere.press("ArrowUp")
    explorer.page.wait_for_function("location.search.includes('el=1.57')")
    assert explorer.turn[1] == approx(pi / 2, abs=1e-4)
    with own_tab(browser, explorer.base) as other:
        other.open(urlsplit(explorer.page.url).query)
        for name, value in values.items():
            box, slider = other.shown(name)
            assert box == value, name
            # A slider stands at the nearest of its steps.
            assert slider == approx(value, abs=0.51 * SLIDERS[name]), name
        assert_orbit(other, {**DEFAULTS, **values})
        assert other.time == approx(7.5)
        assert other.page.locator(".param-speed").input_value() == "2"
        assert other.turn == approx((0.6, pi / 2), abs=6e-4)
        assert other.text("notes") == ""


def test_a_script_in_any_key_of_a_link_is_neither_run_nor_shown(explorer):
    payload, script = "\"'><img src=x onerror=pwned=1>", "<script>pwned=1</script>"
    keys = ["v", *DEFAULTS, "t", "speed", "az", "el", "theme", "large"]
    explorer.open("&".join(f"{key}={quote(payload)}" for key in keys) + f"&{quote(script + payload)}=1")
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
        }"""
    )
    assert len(seen) > 500
    assert not [text for text in seen if "pwned" in text or "onerror" in text]
    assert len(explorer.text("notes").splitlines()) == len(keys) + 1
    assert "no parameter '…'" in explorer.text("notes")
    # The page's own link is clean again; the first change of the user takes the notes of the link away.
    assert "pwned" not in urlencode(explorer.wait_url(v="1"))
    explorer.move(h=0.3)
    assert explorer.text("notes") == ""


def test_whatever_a_text_of_the_page_is_told_to_say_it_shows_as_text(explorer):
    payload = "<img src=x onerror=window.pwned=1><b>bold</b>"
    explorer.tell("texts", {"status": payload})
    explorer.tell("captions", {"omega": dict.fromkeys(("title", "verdict", "numbers"), payload)})
    assert explorer.text("status") == payload
    assert explorer.caption("omega").count(payload) == 3
    assert explorer.page.locator(".text img, .text b").count() == 0
    assert explorer.page.evaluate("window.pwned") is None
