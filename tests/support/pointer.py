"""Pixels of planar pictures, clicks and fingers on them, and the turn of a sphere."""

import math

import pytest


def frame(explorer, name):
    """The rectangle between the axes of a planar picture, in pixels of the page: left, top, right, bottom."""
    explorer.lead(name)
    explorer.picture(name).scroll_into_view_if_needed()
    return explorer.page.evaluate(
        """name => {
          const found = hess.plots.find(({ model }) => model.name === name)
          const [{ x, y }, { x0, y0, x1, y1 }] = [found.el.getBoundingClientRect(), found.frame.bbox]
          return [x + x0, y + y0, x + x1, y + y1]
        }""",
        name,
    )


def at(explorer, name, x, y):
    """The pixel at which a planar picture shows a point, and how many units a pixel is wide and high."""
    left, top, right, bottom = frame(explorer, name)
    x0, x1, y0, y1 = explorer.axes(name)
    pixel = (left + (x - x0) / (x1 - x0) * (right - left), bottom - (y - y0) / (y1 - y0) * (bottom - top))
    return pixel, ((x1 - x0) / (right - left), (y1 - y0) / (bottom - top))


def shares(explorer, name, x, y):
    """Where a planar picture shows a point, as shares of its frame, which labels of the axes move by some pixels."""
    x0, x1, y0, y1 = explorer.axes(name)
    return (x - x0) / (x1 - x0), (y - y0) / (y1 - y0)


HOME = (0.6, 0.35)
STEP = math.pi / 36


def assert_turned(canvas, azimuth, elevation):
    """Assert that a sphere is painted in this view direction, now or a few frames later."""
    azimuth = math.remainder(azimuth, 2 * math.pi)
    canvas.evaluate(
        """async (canvas, turn) => {
          const off = () => Math.max(...canvas.dataset.turn.split(" ").map((x, i) => Math.abs(Number(x) - turn[i])))
          for (let i = 0; i < 60 && off() > 2e-4; i++) await new Promise((done) => requestAnimationFrame(done))
        }""",
        [azimuth, elevation],
    )
    assert tuple(map(float, canvas.get_attribute("data-turn").split())) == pytest.approx((azimuth, elevation), abs=2e-4)


def click_on(explorer, picture, x, y):
    """Click at a point; how far a pixel is."""
    pixel, unit = at(explorer, picture, x, y)
    explorer.change(explorer.click, *pixel)
    return unit


class Finger:
    """Fingers on a touch screen, as the browser itself gets them."""

    def __init__(self, page):
        self.page = page
        self.session = page.context.new_cdp_session(page)

    def send(self, kind, *points):
        """Send touchStart, touchMove, touchEnd or touchCancel with the places of all fingers, and wait for a frame."""
        touches = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def draw(self, start, end, last="touchEnd"):
        """Drag from one place to another."""
        self.send("touchStart", start)
        for share in (0.2, 0.4, 0.6, 0.8, 1.0):
            self.send("touchMove", tuple(a + (b - a) * share for a, b in zip(start, end, strict=True)))
        self.send(last)
