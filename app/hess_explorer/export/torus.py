"""Draw the torus in space with Matplotlib: a translucent surface, and the curves on it.

What the surface hides of a curve is drawn before it, as in `torus.js`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.export.moment import state_at
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.revolved import shaded
from hess_explorer.export.solid import EVEN, ODD
from hess_explorer.export.sphere_canvas import LOOKS, Look, SphereCanvas
from hess_explorer.views import theme
from hess_explorer.views.elements import Colour
from hess_explorer.views.layers import Columns
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["draw_moving", "draw_still", "sides"]

_SIDE = 512
"""Width and height of the surface in pixels."""
_SLACK, _FAR = 0.05, 2.5
"""A point on the surface is hidden by what lies between these distances from it, towards the eye."""
_FAINT = 0.4
_RING: Look = (theme.INK, (0, (2, 3)), 0.9)


def draw_still(frame: Frame, data: PictureData, colour: Colour) -> None:
    """Draw the surface and its curves."""
    canvas = _canvas(frame, data, colour)
    canvas.prepare()
    own = _section(data)
    if not len(own.get("radius", ())):
        return
    angle = np.linspace(0.0, 2.0 * math.pi, 181)
    ring = float(own["radius"][0]) * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(181)])
    curves = [(_RING, ring)]
    for name in ("orbit", "stable", "unstable"):
        columns = data.columns.get(f"{data.picture.name}-{name}", {})
        if len(columns.get("x", ())) > 1:
            curves.append((LOOKS[name], np.column_stack([columns[one] for one in "xyz"])))
    for near in (False, True):
        for look, path in curves:
            canvas.stroke(path, look, near, 1.0 if near else _FAINT, sides(own, path, canvas.view))
        if not near:
            _paint(canvas, own)


def draw_moving(frame: Frame, data: PictureData, colour: Colour, t: float, point: bool) -> None:
    """Draw the moving point at time t, if `point`."""
    state = state_at(data.columns.get(f"{data.picture.name}-orbit", {}), (), t) if point else {}
    if state:
        canvas = _canvas(frame, data, colour)
        canvas.start(2.0)
        place = np.array([state[name] for name in "xyz"])
        canvas.moving_point(place, canvas.is_near(sides(_section(data), place[None], canvas.view)[0]))


def _canvas(frame: Frame, data: PictureData, colour: Colour) -> SphereCanvas:
    return SphereCanvas(frame, (data.client["az"], data.client["el"]), colour)


def _section(data: PictureData) -> Columns:
    return data.columns.get(data.picture.name, {})


def sides(section: Columns, points: Array, view: tuple[float, float]) -> Array:
    """Return vectors (n, 3) that point to the viewer where the surface does not hide the point, else away."""
    azimuth, elevation = view
    flat = math.cos(elevation)
    towards = np.array([flat * math.cos(azimuth), flat * math.sin(azimuth), math.sin(elevation)])
    x, y, z = np.moveaxis(points[:, None] + np.linspace(_SLACK, _FAR, 120)[:, None] * towards, -1, 0)
    # Along the first half of the cross-section the radius grows, and the height is positive.
    half = len(section["radius"]) // 2 + 1
    top = np.interp(np.hypot(x, y), section["radius"][:half], section["height"][:half], left=-1.0, right=-1.0)
    hidden = np.any(np.abs(z) < top, axis=1)
    found: Array = np.where(hidden, -1.0, 1.0)[:, None] * towards
    return found


def _paint(canvas: SphereCanvas, section: Columns) -> None:
    """Paint the surface; in vector files it is pixels."""
    from matplotlib.image import AxesImage

    outside, inside, densest = (_rgb(canvas.colour(one)) for one in (EVEN, ODD, theme.STABLE))
    image = AxesImage(
        canvas.frame, extent=(-1.0, 1.0, -1.0, 1.0), origin="lower", interpolation="bilinear", zorder=canvas.above()
    )
    image.set_data(shaded(section, canvas.view, (outside, inside, densest), _SIDE))
    canvas.frame.add_image(image)


def _rgb(colour: str) -> Array:
    return np.array([int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
