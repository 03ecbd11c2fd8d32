"""The pictures of the Suslov–Hess scene: colours, when they are painted, and when they are computed."""

from io import BytesIO
from math import exp, pi

import numpy as np
from PIL import Image
from pytest import approx

from hess_explorer.views import theme
from support.page import FIND, PICTURES, flat, own_tab, wait_frames
from support.pointer import HOME, assert_turned, at, frame, shares


def picture(explorer, clip):
    """Return the screen region (x, y, width, height) as an RGB array."""
    x, y, width, height = clip
    shot = explorer.page.screenshot(clip={"x": x, "y": y, "width": width, "height": height})
    return np.asarray(Image.open(BytesIO(shot)).convert("RGB")).astype(int)


def like(pixels, colour):
    """Return a mask of the pixels of this colour."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return np.abs(pixels - rgb).max(axis=-1) <= 24


# --- What is painted ---------------------------------------------------------------------------------

PAINTED = {
    "omega": (theme.ORBIT, theme.STABLE, theme.UNSTABLE, theme.POINT, theme.FORBIDDEN),
    "sphere": (theme.ORBIT, theme.STABLE, theme.UNSTABLE, theme.POINT),
    "bifurcation": (theme.LOCKED, theme.FORBIDDEN, theme.MUTED, theme.INK, theme.TURN_MAP[0]),
    "surface": (theme.ORBIT, theme.STABLE, theme.UNSTABLE, theme.POINT),
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
    assert_turned(explorer.sphere, HOME[0] - pi, HOME[1])
    for name in (*PICTURES, "surface"):
        pixels = canvas_of(explorer, name)
        for colour in PAINTED[name]:
            assert painted(pixels, colour) >= 25, (name, colour)
        # The rim is quiet: nothing is painted outside the frame but the axes.
        assert name == "sphere" or like(pixels[:6], "#FFFFFF").mean() > 0.95


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


def test_a_picture_that_is_folded_is_not_computed(explorer):
    explorer.move(h=0.2)
    assert flat(explorer.data("torus-density")) == []
    assert not explorer.picture("torus").is_visible()
    explorer.unfold("torus")
    first = explorer.data("torus-density")
    assert flat(first) != []
    explorer.fold("torus")
    # The browser tells what is in sight a moment after it has changed.
    wait_frames(explorer)
    explorer.move(h=0.4)
    assert explorer.data("torus-density") == first
    explorer.unfold("torus")
    assert explorer.data("torus-density") != first


def test_axes_that_depend_on_the_state_have_their_names_from_the_first_one_on(browser, server):
    names = """() => hess.plots.filter(({ model }) => model.name === "line")
      .map(({ model }) => [model.below[0].axis_label, model.left[0].axis_label])"""
    with own_tab(browser, server) as explorer:
        assert explorer.open("scene=rotation-number").page.evaluate(names) == [["f", "ρ"]]


def test_a_wheel_zooms_at_the_pointer_the_right_button_moves_and_the_whole_comes_back(explorer):
    mouse, before, link = explorer.page.mouse, explorer.axes("omega"), explorer.link()
    (pixel, _), where = at(explorer, "omega", 1.0, -2.0), shares(explorer, "omega", 1.0, -2.0)
    mouse.move(*pixel)
    mouse.wheel(0, -400)
    wait_frames(explorer)
    x0, x1, *_ = explorer.axes("omega")
    assert x1 - x0 == approx((before[1] - before[0]) * exp(-0.8), rel=1e-6)
    assert shares(explorer, "omega", 1.0, -2.0) == approx(where, abs=0.01)
    left, top, right, bottom = frame(explorer, "omega")
    mouse.down(button="right")
    mouse.move(pixel[0] + 30, pixel[1] - 20, steps=3)
    mouse.up(button="right")
    moved = where[0] + 30 / (right - left), where[1] + 20 / (bottom - top)
    assert shares(explorer, "omega", 1.0, -2.0) == approx(moved, abs=0.02)
    explorer.picture("omega").locator(".whole").click()
    assert explorer.axes("omega") == before
    # A double click chooses nothing, and what is wider than the whole is the whole.
    (wide, high), _ = at(explorer, "bifurcation", 0.5, 1.0)
    whole = explorer.axes("bifurcation")
    for restore in (lambda: mouse.dblclick(wide, high), lambda: mouse.wheel(0, 4000)):
        mouse.move(wide, high)
        mouse.wheel(0, -400)
        wait_frames(explorer)
        assert explorer.axes("bifurcation") != whole
        restore()
        explorer.page.wait_for_timeout(400)
        assert explorer.axes("bifurcation") == whole
    assert explorer.link() == link
    # A click in a zoomed picture chooses the value under the mouse.
    mouse.wheel(0, -400)
    wait_frames(explorer)
    (wide, high), unit = at(explorer, "bifurcation", 1.2, 0.3)
    explorer.change(explorer.click, wide, high)
    assert explorer.here() == (approx(1.2, abs=unit[0]), approx(0.3, abs=unit[1]))
