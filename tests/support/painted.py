"""Checks of painted pictures: present, finite, and in the right place."""

from __future__ import annotations

import math
import re

import numpy as np

from support.page import flat


def yellow(explorer):
    """The middle of the moving point on the sphere, in shares of the canvas."""
    return explorer.sphere.evaluate(
        """canvas => {
          const { width, height } = canvas
          const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data
          let [n, x, y] = [0, 0, 0]
          for (let i = 0; i < pixels.length; i += 4) {
            if (Math.abs(pixels[i] - 240) + Math.abs(pixels[i + 1] - 228) + Math.abs(pixels[i + 2] - 66) > 12) continue
            if (pixels[i + 3] < 70) continue
            n += 1, x += (i / 4) % width, y += Math.floor(i / 4 / width)
          }
          return n > 20 ? [x / n / width, y / n / height] : null
        }"""
    )


SOURCES = "hess.plotted()"


def track(explorer, source="data-orbit"):
    data = explorer.data(source)
    return np.column_stack([data[name] for name in ("omega1", "omega2", "g1", "g2", "g3")])


def assert_captions_fit(explorer, scene):
    """Assert that each caption fits its narrowest place: four pictures side by side, as on a wide page.

    On a laptop the places are wider, and on a phone they grow with the text.
    """
    for picture in scene.pictures:
        words = explorer.picture(picture).locator(".caption")
        assert words.evaluate("words => words.scrollHeight <= words.clientHeight"), words.inner_text()


def assert_painted(explorer, scene):
    """Assert finite data, captions that fit, and painted pixels on every canvas."""
    assert_captions_fit(explorer, scene)
    for name in explorer.page.evaluate(SOURCES):
        assert all(isinstance(x, str) or math.isfinite(x) for x in flat(explorer.data(name))), name
    for picture in scene.open_pictures:
        assert not re.search(r"nan|inf|none", explorer.caption(picture), re.IGNORECASE)
        drawn = explorer.picture(picture).evaluate(
            """picture => {
              const canvases = (root) => [...root.querySelectorAll("*")].flatMap((item) =>
                [...(item.tagName === "CANVAS" ? [item] : []), ...(item.shadowRoot ? canvases(item.shadowRoot) : [])])
              return canvases(picture).map((canvas) => canvas.getContext("2d")
                .getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value !== 0))
            }"""
        )
        assert drawn
        assert any(drawn)
    explorer.assert_quiet()
