"""Checks of painted pictures: present, finite, and in the right place."""

import math
import re

import pytest

from hess_explorer.scenes import scenes
from support.board import contents
from support.page import flat
from support.view import View


def yellow(explorer):
    """The middle of the moving point on the sphere, which has a canvas of its own, in shares of that."""
    return explorer.sphere.evaluate(
        """sphere => {
          const canvas = sphere.parentElement.querySelector(".moving")
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


def assert_captions_fit(explorer, scene):
    """Assert that each caption fits its narrowest place: four pictures side by side, as on a wide page.

    On a laptop the places are wider, and on a phone they grow with the text.
    """
    for picture in scene.pictures:
        words = explorer.picture(picture).locator(".caption")
        assert words.evaluate("words => words.scrollHeight <= words.clientHeight"), words.inner_text()


def alike(found, expected):
    """Return whether two lists have the same texts, and the same numbers up to rounding."""
    texts, numbers = (
        [[x for x in items if isinstance(x, str) == kind] for items in (found, expected)] for kind in (True, False)
    )
    return texts[0] == texts[1] and numbers[0] == pytest.approx(numbers[1], rel=2e-6, abs=2e-6)


def assert_drawn(explorer, name, values, *pictures):
    """Assert that these pictures (else all open ones) of a scene show the data that it computes; return its view."""
    scene = scenes()[name]
    view = View(scene, values, seen=set(pictures or scene.open_pictures), noted=True)
    for source, columns in contents(view.data).items():
        # The player moves the points.
        if source.endswith("-point"):
            continue
        data = explorer.data(source)
        for key, column in columns.items():
            # Measured times differ.
            if not (
                source.startswith("precision-")
                and (key == "y" or source.startswith(("precision-DOP", "precision-LSO")))
            ):
                assert alike(flat(data[key]), column), (source, key)
    return view


def assert_painted(explorer, scene):
    """Assert finite data, captions that fit, and painted pixels on every canvas."""
    assert_captions_fit(explorer, scene)
    for name in explorer.page.evaluate("hess.plotted()"):
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
