"""An ellipsoid seen from afar, opaque or of glass: shaded by rays that meet it in closed form, with its outline.

As `solid.js` draws it.  Vectors are those of the view: to the right, upwards, towards the eye.
"""

from __future__ import annotations

import math

import numpy as np

from hess_explorer.export.sphere_canvas import SphereCanvas
from hess_explorer.views import theme
from hess_explorer.views.elements import Colour
from hess_mechanics.numerics.results import Array

__all__ = ["EVEN", "ODD", "covers", "leaves", "outline", "paint", "shaded"]

EVEN, ODD = "#CBD6E2", "#9EAFC2"
"""The tones of the octants."""
_AMBIENT = 0.5
_LIGHT = np.array([-0.42, 0.62, 0.66]) / np.linalg.norm([-0.42, 0.62, 0.66])
"""Over the left shoulder of whoever looks."""
_HALFWAY = np.array([-0.23, 0.34, 0.91]) / np.linalg.norm([-0.23, 0.34, 0.91])
_GLASS = 0.22


def outline(axes: Array, semi: Array) -> tuple[float, float, float]:
    """Half axes of the ellipse in which it is seen, and the angle of the first one from the right.

    axes : (3, 3), unit vectors in rows; semi : (3,), the lengths along them.
    """
    x, y = (axes[:, :2] * semi[:, None]).T
    xx, xy, yy = x @ x, x @ y, y @ y
    mean, apart = 0.5 * (xx + yy), math.hypot(0.5 * (xx - yy), xy)
    return math.sqrt(mean + apart), math.sqrt(max(0.0, mean - apart)), 0.5 * math.atan2(2.0 * xy, xx - yy)


def covers(axes: Array, semi: Array, x: float, y: float, margin: float = 0.0) -> bool:
    """Whether it hides the place (x, y), or would, were it larger all round by the margin."""
    a, b, angle = outline(axes, semi)
    c, s = math.cos(angle), math.sin(angle)
    return math.hypot((c * x + s * y) / (a + margin), (c * y - s * x) / (b + margin)) < 1.0


def leaves(axes: Array, semi: Array, along: Array) -> tuple[float, bool]:
    """Where a ray from its middle leaves it, as a multiple of `along`, and whether that is on the side that is seen."""
    shares = axes @ along / semi
    return 1.0 / float(np.linalg.norm(shares)), float(shares / semi @ axes[:, 2]) >= 0.0


def shaded(
    axes: Array, semi: Array, tones: tuple[str, str], side: int, glass: bool = False
) -> tuple[Array, float, float]:
    """Colours (side, side, 4) from 0 to 1, from below, and half of the width and the height that they fill.

    The tone changes between octants of the principal axes, so that one sees it turn.
    """
    width, height = np.linalg.norm(axes[:, :2] * semi[:, None], axis=0)
    centres = (2.0 * np.arange(side) + 1.0) / side - 1.0
    x, y = np.meshgrid(width * centres, height * centres)
    # In the coordinates in which it is the unit sphere a ray is start + depth × along.
    start = (x[..., None] * axes[:, 0] + y[..., None] * axes[:, 1]) / semi
    along = axes[:, 2] / semi
    a, b = along @ along, start @ along
    # Beside the edge it goes on, so that there is something to smooth it with.
    z = (np.sqrt(np.maximum(0.0, b * b - a * (np.sum(start * start, axis=-1) - 1.0))) - b) / a
    place = start + z[..., None] * along
    normal = (place / semi) @ axes
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    lit, shine = np.maximum(0.0, normal @ _LIGHT), np.maximum(0.0, normal @ _HALFWAY)
    for _ in range(4):
        shine *= shine
    sharp = side / (3.0 * width)
    p, q, r = np.moveaxis(np.clip(place * (semi * sharp), -1.0, 1.0), -1, 0)
    share = 0.5 + 0.5 * p * q * r
    even, odd = (np.array([int(tone[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]) for tone in tones)
    bright = _AMBIENT + (1.08 - _AMBIENT) * lit
    colours = bright[..., None] * (odd + share[..., None] * (even - odd)) + (70.0 / 255.0) * shine[..., None]
    rim = 1.0 - np.maximum(0.0, normal[..., 2])
    alpha = np.minimum(1.0, _GLASS + 0.12 * share + 0.5 * rim**2 + 0.6 * shine) if glass else np.ones_like(rim)
    return np.clip(np.concatenate([colours, alpha[..., None]], axis=-1), 0.0, 1.0), float(width), float(height)


def paint(canvas: SphereCanvas, axes: Array, semi: Array, glass: bool, side: int) -> None:
    """On the canvas; its shades are pixels in a vector file too, its outline is a line."""
    from matplotlib.image import AxesImage
    from matplotlib.patches import Ellipse

    colour: Colour = canvas.colour
    colours, width, height = shaded(axes, semi, (colour(EVEN), colour(ODD)), side, glass)
    a, b, angle = outline(axes, semi)
    edge = Ellipse(
        (0.0, 0.0),
        2.0 * a,
        2.0 * b,
        angle=math.degrees(angle),
        facecolor="none",
        edgecolor=colour(theme.INK),
        linewidth=0.7,
        alpha=0.55,
    )
    image = AxesImage(
        canvas.frame,
        extent=(-width, width, -height, height),
        origin="lower",
        interpolation="bilinear",
        zorder=canvas.above(),
    )
    image.set_data(colours)
    edge.set_zorder(canvas.above())
    canvas.frame.add_patch(edge)
    canvas.frame.add_image(image)
    image.set_clip_path(edge)
