"""Draw an ellipsoid in orthographic projection, opaque or of glass, shaded by exact ray intersections.

`solid.js` draws the same.  Vectors are in view coordinates: right, up, towards the viewer.
"""

from __future__ import annotations

import math

import numpy as np

from hess_explorer.export.sphere_canvas import SphereCanvas
from hess_explorer.views import theme
from hess_explorer.views.elements import Colour
from hess_mechanics.numerics.results import Array

__all__ = ["EVEN", "ODD", "covers", "leaves", "lit", "outline", "paint", "shaded"]

EVEN, ODD = "#CBD6E2", "#9EAFC2"
"""Colours of the octants."""
_AMBIENT = 0.5
_LIGHT = np.array([-0.42, 0.62, 0.66]) / np.linalg.norm([-0.42, 0.62, 0.66])
"""Direction of the light, from the upper left."""
_HALFWAY = np.array([-0.23, 0.34, 0.91]) / np.linalg.norm([-0.23, 0.34, 0.91])
_GLASS = 0.22


def outline(axes: Array, semi: Array) -> tuple[float, float, float]:
    """Return the semi-axes of the projected ellipse, and the angle of the first one from the right.

    axes : unit vectors in rows (3, 3); semi : lengths of the semi-axes (3,).
    """
    x, y = (axes[:, :2] * semi[:, None]).T
    xx, xy, yy = x @ x, x @ y, y @ y
    mean, apart = 0.5 * (xx + yy), math.hypot(0.5 * (xx - yy), xy)
    return math.sqrt(mean + apart), math.sqrt(max(0.0, mean - apart)), 0.5 * math.atan2(2.0 * xy, xx - yy)


def covers(axes: Array, semi: Array, x: float, y: float, margin: float = 0.0) -> bool:
    """Return True if the ellipsoid, enlarged by the margin, covers the point (x, y) of the picture."""
    a, b, angle = outline(axes, semi)
    c, s = math.cos(angle), math.sin(angle)
    return math.hypot((c * x + s * y) / (a + margin), (c * y - s * x) / (b + margin)) < 1.0


def leaves(axes: Array, semi: Array, along: Array) -> tuple[float, bool]:
    """Return the multiple of `along` at which a ray from the centre leaves the ellipsoid; True if that is visible."""
    shares = axes @ along / semi
    return 1.0 / float(np.linalg.norm(shares)), float(shares / semi @ axes[:, 2]) >= 0.0


def shaded(
    axes: Array, semi: Array, tones: tuple[str, str], side: int, glass: bool = False
) -> tuple[Array, float, float]:
    """Return an RGBA image (side, side, 4) with the lowest row first, and half its width and height.

    The colour alternates between octants of the principal axes, which makes the rotation visible.
    """
    width, height = np.linalg.norm(axes[:, :2] * semi[:, None], axis=0)
    centres = (2.0 * np.arange(side) + 1.0) / side - 1.0
    x, y = np.meshgrid(width * centres, height * centres)
    # In coordinates that make the ellipsoid a unit sphere, a ray is start + depth × along.
    start = (x[..., None] * axes[:, 0] + y[..., None] * axes[:, 1]) / semi
    along = axes[:, 2] / semi
    a, b = along @ along, start @ along
    # Continue beyond the edge, for antialiasing.
    z = (np.sqrt(np.maximum(0.0, b * b - a * (np.sum(start * start, axis=-1) - 1.0))) - b) / a
    place = start + z[..., None] * along
    normal = (place / semi) @ axes
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    bright, shine = lit(normal)
    sharp = side / (3.0 * width)
    p, q, r = np.moveaxis(np.clip(place * (semi * sharp), -1.0, 1.0), -1, 0)
    share = 0.5 + 0.5 * p * q * r
    even, odd = (np.array([int(tone[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]) for tone in tones)
    colours = bright[..., None] * (odd + share[..., None] * (even - odd)) + (70.0 / 255.0) * shine[..., None]
    rim = 1.0 - np.maximum(0.0, normal[..., 2])
    alpha = np.minimum(1.0, _GLASS + 0.12 * share + 0.5 * rim**2 + 0.6 * shine) if glass else np.ones_like(rim)
    return np.clip(np.concatenate([colours, alpha[..., None]], axis=-1), 0.0, 1.0), float(width), float(height)


def lit(normals: Array) -> tuple[Array, Array]:
    """Return the brightness and the highlight (...) of unit normals (..., 3)."""
    return (
        _AMBIENT + (1.08 - _AMBIENT) * np.maximum(0.0, normals @ _LIGHT),
        np.maximum(0.0, normals @ _HALFWAY) ** 16,
    )


def paint(canvas: SphereCanvas, axes: Array, semi: Array, glass: bool, side: int) -> None:
    """Draw the ellipsoid on the canvas: its shading is rasterized in vector files, its outline is a line."""
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
