"""The Poisson sphere as a figure: orthographic, from where the link looks; what lies behind is faint."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.export.shown import Shown
from hess_explorer.views import theme
from hess_explorer.views.poisson_sphere import Sphere
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["draw_sphere", "seen"]

_LOOKS: dict[str, tuple[str, Any, float]] = {
    "orbit": (theme.ORBIT, "-", 1.3), "second": (theme.MAP, "-", 1.3), "stable": (theme.STABLE, "-", 1.8),
    "unstable": (theme.UNSTABLE, (0, (5, 3)), 1.8), "limit": (theme.INK, (0, (2, 3)), 0.7),
    "muted": (theme.MUTED, "-", 0.7)}
"""Colour, dash and weight by the names of `Circle`, `Mark` and the tracks."""
_FAINT = 0.3
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)


def seen(points: Array, azimuth: float, elevation: float) -> Array:
    """(n, 3) in the axes of the body → to the right, upwards, towards the eye."""
    ca, sa, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(elevation), math.sin(elevation)
    turned: Array = points @ np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]]).T
    return turned


def draw_sphere(frame: Frame, shown: Shown, colour: Callable[[str], str]) -> None:
    """The outline, parallels and meridians, the axes, circles, marks and tracks."""
    sphere = shown.picture
    assert isinstance(sphere, Sphere)
    view = shown.client["az"], shown.client["el"]
    frame.set(xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), aspect="equal")
    frame.set_axis_off()
    frame.plot(np.cos(_ANGLES), np.sin(_ANGLES), color=colour(theme.INK), linewidth=0.6, alpha=0.5)
    for curve in _graticule():
        _stroke(frame, seen(curve, *view), colour(theme.INK), "-", 0.4, (0.25, 0.1))
    for axis, label in zip(np.eye(3), ("γ₁", "γ₂", "γ₃"), strict=True):
        _axis(frame, axis, label, view, colour)
    own = shown.columns.get(sphere.name, {})
    if len(own.get("axis", ())):
        _axis(frame, np.array(own["axis"]), own["label"], view, colour)
    for a, b, c, height, look in own.get("circles", ()):
        _drawn(frame, _circle(np.array([a, b, c]), height), look, view, colour)
    for track, look in sphere.looks.items():
        columns = shown.columns.get(f"data-{track}", {})
        if len(columns.get("g1", ())) > 1:
            _drawn(frame, np.column_stack([columns[name] for name in ("g1", "g2", "g3")]), look, view, colour)
    for x, y, z, look, label in own.get("marks", ()):
        _mark(frame, np.array([x, y, z]), look, label, view, colour)


def _graticule() -> Iterator[Array]:
    for height in (-0.5, 0.0, 0.5):
        yield _circle(np.array([0.0, 0.0, 1.0]), height)
    for angle in np.arange(3) * math.pi / 3.0:
        yield _circle(np.array([-math.sin(angle), math.cos(angle), 0.0]), 0.0)


def _circle(axis: Array, height: float) -> Array:
    """The circle (γ, axis) = height, (n, 3)."""
    axis = axis / np.linalg.norm(axis)
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.linalg.norm(across)
    radius = math.sqrt(max(0.0, 1.0 - height**2))
    turned: Array = height * axis + radius * (
        np.cos(_ANGLES)[:, None] * across + np.sin(_ANGLES)[:, None] * np.cross(axis, across))
    return turned


def _drawn(frame: Frame, points: Array, look: str, view: tuple[float, float], colour: Callable[[str], str]) -> None:
    ink, dash, weight = _LOOKS[look]
    _stroke(frame, seen(points, *view), colour(ink), dash, weight, (1.0, _FAINT))


def _stroke(frame: Frame, curve: Array, colour: str, dash: Any, weight: float, alphas: Sequence[float]) -> None:
    """The near parts, and faint the far ones."""
    near = curve[1:, 2] + curve[:-1, 2] >= 0.0
    for side, alpha, order in ((True, alphas[0], 2.0), (False, alphas[1], 1.0)):
        at = np.flatnonzero(near == side)
        for run in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
            if run.size:
                part = curve[run[0] : run[-1] + 2]
                frame.plot(part[:, 0], part[:, 1], color=colour, linestyle=dash, linewidth=weight, alpha=alpha,
                           zorder=order)


def _axis(frame: Frame, axis: Array, label: str, view: tuple[float, float], colour: Callable[[str], str]) -> None:
    (x, y, depth), = seen(axis[None, :], *view)
    alpha = 0.9 if depth >= 0.0 else 0.4
    frame.plot((x, 1.12 * x), (y, 1.12 * y), color=colour(theme.INK), linewidth=0.8, alpha=alpha)
    frame.text(1.2 * x, 1.2 * y, label, ha="center", va="center", color=colour(theme.INK), alpha=alpha)


def _mark(frame: Frame, at: Array, look: str, label: str, view: tuple[float, float],
          colour: Callable[[str], str]) -> None:
    (x, y, depth), = seen(at[None, :], *view)
    ink = colour(_LOOKS[look][0])
    frame.scatter([x], [y], s=20.0, facecolors="none" if look == "unstable" else ink, edgecolors=ink, linewidths=1.4,
                  alpha=1.0 if depth >= 0.0 else _FAINT, zorder=3.0 if depth >= 0.0 else 1.0)
    if label:
        frame.text(1.15 * x, 1.15 * y, label, ha="center", va="center", color=colour(theme.INK))
