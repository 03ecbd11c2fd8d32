"""Draw spheres with Matplotlib in the orthographic view of the link: the Poisson sphere, and the body in space.

The far half is faint and drawn first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.export.body import BodyDrawing
from hess_explorer.export.clouds import on_sphere
from hess_explorer.export.moment import clouds_at, state_at
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.sphere_canvas import LOOKS, SphereCanvas, circle, graticule
from hess_explorer.views import theme
from hess_explorer.views.body import BodyInSpace
from hess_explorer.views.elements import Colour
from hess_explorer.views.layers import Columns
from hess_explorer.views.poisson_sphere import Sphere

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["draw_moving", "draw_still"]

_FAINT = 0.3


def draw_still(frame: Frame, data: PictureData, colour: Colour) -> None:
    """Draw the static parts: the far half, and the near half if only a point moves."""
    canvas = _canvas(frame, data, colour)
    canvas.prepare()
    _half(canvas, data, False)
    if not _has_guest(data):
        canvas.outline()
        _half(canvas, data, True)


def draw_moving(frame: Frame, data: PictureData, colour: Colour, t: float, point: bool) -> None:
    """Draw the body or the clouds at time t, and what lies above them; point : True to include the moving point."""
    canvas = _canvas(frame, data, colour)
    # Above all static parts.
    canvas.start(2.0)
    picture, columns = data.picture, data.columns
    if isinstance(picture, BodyInSpace):
        body = BodyDrawing(canvas, columns.get(picture.name, {}), columns.get(picture.attitude or picture.name, {}), t)
        body.half(False)
        canvas.outline()
        body.middle()
        _half(canvas, data, True, body)
    elif isinstance(picture, Sphere) and picture.clouds:
        clouds = clouds_at(columns.get(picture.clouds, {}), t)
        on_sphere(canvas, clouds, False)
        canvas.outline()
        _half(canvas, data, True)
        on_sphere(canvas, clouds, True)
    state = state_at(columns.get("data-orbit", {}), data.scene.angles, t) if point else {}
    if isinstance(picture, Sphere) and "g1" in state:
        place = [state[name] for name in ("g1", "g2", "g3")]
        canvas.moving_point(place, canvas.is_near(place))


def _canvas(frame: Frame, data: PictureData, colour: Colour) -> SphereCanvas:
    return SphereCanvas(frame, (data.client["az"], data.client["el"]), colour)


def _has_guest(data: PictureData) -> bool:
    picture = data.picture
    return isinstance(picture, BodyInSpace) or (isinstance(picture, Sphere) and bool(picture.clouds))


def _half(canvas: SphereCanvas, data: PictureData, near: bool, body: BodyDrawing | None = None) -> None:
    picture = data.picture
    own = data.columns.get(picture.name, {})
    in_space = picture if isinstance(picture, BodyInSpace) else None
    for line in [circle(np.array([0.0, 0.0, 1.0]), 0.0)] if in_space and in_space.bare else graticule():
        canvas.stroke(line, (theme.INK, "-", 0.4), near, 0.25 if near else 0.1)
    if isinstance(picture, Sphere):
        for axis, label in zip(np.eye(3), picture.labels, strict=True):
            _axis(canvas, axis, label, near)
        if len(own.get("axis", ())):
            _axis(canvas, np.array(own["axis"]), own["label"], near)
    faint = 1.0 if near else _FAINT
    for a, b, c, height, look in own.get("circles", ()):
        canvas.stroke(circle(np.array([a, b, c]), height), LOOKS[look], near, faint)
    for track, look in (picture.looks if isinstance(picture, Sphere) else {}).items():
        columns = data.columns.get(f"data-{track}", {})
        if len(columns.get("g1", ())) > 1:
            canvas.stroke(_gamma(columns), LOOKS[look], near, faint)
    if body is not None:
        body.half(near)
    for x, y, z, look, label in own.get("marks", ()):
        if canvas.is_near((x, y, z)) == near:
            _mark(canvas, (x, y, z), look, label, faint)


def _gamma(columns: Columns) -> Any:
    return np.column_stack([columns[name] for name in ("g1", "g2", "g3")])


def _axis(canvas: SphereCanvas, axis: Any, label: str, near: bool) -> None:
    if canvas.is_near(axis) != near:
        return
    alpha = 0.9 if near else 0.4
    canvas.line(axis, 1.12 * axis, (theme.INK, "-", 0.8), alpha)
    x, y, _ = canvas.at(1.2 * axis)
    canvas.write(label, x, y, alpha)


def _mark(canvas: SphereCanvas, at: tuple[float, float, float], look: str, label: str, alpha: float) -> None:
    x, y, _ = canvas.at(at)
    ink = canvas.colour(LOOKS[look][0])
    canvas.dot(
        x,
        y,
        4.5,
        markerfacecolor="none" if look == "unstable" else ink,
        markeredgecolor=ink,
        markeredgewidth=1.4,
        alpha=alpha,
    )
    canvas.write(label, 1.15 * x, 1.15 * y)
