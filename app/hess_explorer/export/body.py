"""Draw the body in space with Matplotlib: the far parts before the body, the near parts after it, as in `body.js`."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hess_explorer.export import solid
from hess_explorer.export.moment import between
from hess_explorer.export.sphere_canvas import LOOKS, Look, SphereCanvas, circle, seen
from hess_explorer.views import theme
from hess_explorer.views.layers import Columns
from hess_mechanics.numerics.results import Array

__all__ = ["BodyDrawing", "placing"]

_TRAIL, _PIECES = 160, 16
_WHEEL, _THICK = 0.15, 0.024
_CAVITY, _INNER = 0.62, 0.26
_SPOKES = 5
_STEEL, _STEEL_EDGE = "#7C8794", "#39424D"
_BALL = 0.055
"""Radius of the ball at the end of a rod with a mass."""
_SHADES = 224
"""Width and height of the shading in pixels."""
_COLUMNS = ("g1", "g2", "g3", "e1", "e2", "e3")


def placing(attitude: Columns, t: float) -> Array:
    """Return the rotation (3, 3) from the body to the axes of the picture: e, −γ × e and −γ, which points up.

    attitude : the columns t, γ and e along the motion, orthonormal at the samples.
    """
    i, s = between(attitude["t"], t)
    there = [float(attitude[name][i] + s * (attitude[name][i + 1] - attitude[name][i])) for name in _COLUMNS]
    placed: Array = _turned(np.array([there]))[0]
    return placed


def _turned(directions: Array) -> Array:
    """Return the rotations (n, 3, 3) from γ and e (n, 6), which linear interpolation has made inexact."""
    g, raw = directions[:, :3], directions[:, 3:]
    g = g / np.linalg.norm(g, axis=1, keepdims=True)
    e = raw - np.sum(g * raw, axis=1, keepdims=True) * g
    e /= np.linalg.norm(e, axis=1, keepdims=True)
    return np.stack([e, -np.cross(g, e), -g], axis=1)


class BodyDrawing:
    """Draws a body at time t: call `half(False)`, `middle()`, `half(True)` in this order.

    own : the columns of its picture; attitude : the columns of its motion, {} without a motion.
    """

    def __init__(self, canvas: SphereCanvas, own: Columns, attitude: Columns, t: float) -> None:
        self.canvas, self.own = canvas, own
        self.turn: Array | None = None
        self.path, self.trace = np.empty((0, 3)), np.empty((0, 3))
        self.ways = np.zeros(1)
        semi = own.get("semi", ())
        if len(attitude.get("t", ())) > 1:
            self.turn = placing(attitude, t)
            if own.get("trail"):
                self.path = self._path(attitude, t, own["trail"][:3])
            if own.get("wheels"):
                self.trace = self._path(attitude, t, own["wheels"][:3])
                i, s = between(attitude["t"], t)
                arc = np.asarray(own["arc"])
                self.ways = np.append(arc[max(0, i - _TRAIL) : i + 1], arc[i] + s * (arc[i + 1] - arc[i]))
        self.semi = np.array(semi, float)
        # The principal axes in space and in the view.
        self.axes = np.array(own["axes"]) @ self.turn.T if self.turn is not None and len(semi) == 3 else None
        self.seen = None if self.axes is None else seen(self.axes, *canvas.view)

    def _path(self, attitude: Columns, t: float, of: Sequence[float]) -> Array:
        tip, (i, _) = np.array(of, float), between(attitude["t"], t)
        samples = np.column_stack([attitude[name][max(0, i - _TRAIL) : i + 1] for name in _COLUMNS])
        assert self.turn is not None
        return np.vstack([_turned(samples) @ tip, self.turn @ tip])

    def half(self, near: bool) -> None:
        """Draw the far or near half of everything except the body itself."""
        if not near and self.axes is not None:
            self._shadow(self.axes)
        for look, weight, *curve in self.own.get("curves", ()):
            ink, dash, usual = LOOKS[look]
            self.canvas.stroke(np.array(curve).T, (ink, dash, 0.6 * weight or usual), near, 1.0 if near else 0.45)
        if self.turn is None:
            return
        if len(self.path):
            self._trail(self.path, self.own["trail"][3], near)
        if len(self.trace):
            self._trail(self.trace, self.own["wheels"][6], near)
            self._turns(near)
        if near and self.seen is not None and len(self.own.get("section", ())) == 4:
            self._section()
        self._principal_axes(near)
        self._weights(near)
        self._wheels(near)
        for x, y, z, look, label in self.own.get("rods", ()):
            self._rod(self.turn @ np.array([x, y, z]), LOOKS[look], label, near, ball=look == "mass")
        if len(self.own.get("axis", ())) == 3 and self.canvas.is_near(self.own["axis"]) == near:
            self._arrow(np.array(self.own["axis"]), self.own.get("label", ""))

    def middle(self) -> None:
        """Draw the body, between both halves."""
        if self.seen is None:
            return
        hollow = bool(self.own.get("hollow"))
        if hollow:
            self._inside()
        solid.paint(self.canvas, self.seen, self.semi, hollow, _SHADES)

    def _inside(self) -> None:
        """Draw the cavity of a glass ball and the ball inside."""
        canvas = self.canvas
        canvas.disc(0.0, 0.0, _CAVITY, facecolor="none", edgecolor=canvas.colour(theme.INK), linewidth=0.7, alpha=0.5)
        x, y, _ = canvas.at((0.0, 0.0, _INNER - _CAVITY))
        self._ball(x, y, _INNER, "#9AA0AA", theme.INK)
        x, y, _ = canvas.at((0.0, 0.0, -_CAVITY))
        canvas.dot(x, y, 3.0, color=canvas.colour(theme.INK))

    def _ball(self, x: float, y: float, radius: float, colour: str, edge: str) -> None:
        canvas = self.canvas
        canvas.disc(x, y, radius, facecolor=canvas.colour(colour), linewidth=0.9, edgecolor=canvas.colour(edge))
        # The light comes from the upper left.
        canvas.disc(
            x - 0.35 * radius, y + 0.38 * radius, 0.28 * radius, facecolor="white", edgecolor="none", alpha=0.85
        )

    def _mass(self, x: float, y: float) -> None:
        """Draw a centre of mass: a disc in quarters, as in engineering drawings."""
        canvas = self.canvas
        ink = canvas.colour(theme.INK)
        canvas.disc(x, y, _BALL, facecolor=canvas.colour(theme.PAPER), linewidth=0.9, edgecolor=ink)
        for start in (0.0, math.pi):
            angles = np.linspace(start, start + 0.5 * math.pi, 13)
            arc = _BALL * np.column_stack([np.cos(angles), np.sin(angles)])
            canvas.area(np.array([x, y]) + np.vstack([[0.0, 0.0], arc]), facecolor=ink, linewidth=0)

    def _trail(self, path: Array, look: str, near: bool) -> None:
        count, most = len(path), _TRAIL // _PIECES
        ink, dash, _ = LOOKS[look]
        for k in range(_PIECES):
            # The newest piece ends at the moving point.
            first, last = max(0, count - 1 - (k + 1) * most), count - 1 - k * most
            if last < 1:
                break
            share = 1.0 - k / _PIECES
            self.canvas.stroke(
                path[first : last + 1], (ink, dash, 0.7 + 1.4 * share), near, (1.0 if near else 0.4) * share
            )

    def _turns(self, near: bool) -> None:
        """Draw a dot on the trace of the wheel where its marked spoke touched the sphere."""
        turns = self.ways / (2.0 * math.pi * _WHEEL)
        ink = self.canvas.colour(LOOKS[self.own["wheels"][6]][0])
        for i in np.flatnonzero(np.diff(np.floor(turns))):
            whole = math.floor(max(turns[i], turns[i + 1]))
            share = (whole - turns[i]) / (turns[i + 1] - turns[i])
            place = self.trace[i] + share * (self.trace[i + 1] - self.trace[i])
            if self.canvas.is_near(place) == near:
                age = max(0.0, 1.0 - (len(turns) - 1 - i - share) / _TRAIL)
                self.canvas.dot(*self.canvas.at(place)[:2], 4.0, color=ink, alpha=(1.0 if near else 0.4) * age)

    def _shadow(self, axes: Array) -> None:
        """Draw the shadow on the ground below the sphere, in light from above: ellipses that become smaller."""
        canvas = self.canvas
        if canvas.view[1] <= 0.0:
            return
        ring = circle(np.array([0.0, 0.0, 1.0]), 0.0)[:, :2]
        a, b, angle = solid.outline(axes, self.semi)
        c, s = math.cos(angle), math.sin(angle)
        below = (ring * [1.1 * a, 1.1 * b]) @ np.array([[c, s], [-s, c]])
        for size in np.linspace(1.0, 0.4, 13):
            ground = np.column_stack([size * below, np.full(len(below), -1.0)])
            corners = seen(ground, *canvas.view)[:, :2]
            canvas.area(corners, facecolor="black", alpha=0.022, linewidth=0)

    def _section(self) -> None:
        """Draw the visible part of the circular section."""
        assert self.axes is not None
        assert self.turn is not None
        *normal, radius = self.own["section"]
        ring = circle(self.turn @ np.array(normal), 0.0)
        sides = (ring @ self.axes.T / self.semi**2) @ self.axes
        self.canvas.stroke(radius * ring, (theme.INK, (0, (4, 3)), 1.5), True, sides=sides)

    def _principal_axes(self, near: bool) -> None:
        if self.axes is None:
            return
        for axis, length, name in zip(self.axes, self.semi + 0.1, self.own["names"], strict=True):
            if name:
                for sign in (1.0, -1.0):
                    self._rod(sign * length * axis, (theme.INK, "-", 1.2), name if sign > 0.0 else "", near)

    def _rod(self, to: Array, look: Look, label: str, near: bool, ball: bool = False) -> None:
        """Draw a rod from the surface to its end, in the half in which it leaves the surface."""
        canvas = self.canvas
        at, is_near = (
            (0.0, canvas.is_near(to))
            if self.seen is None
            else solid.leaves(self.seen, self.semi, seen(to[None, :], *canvas.view)[0])
        )
        if is_near != near or at >= 1.0:
            return
        canvas.line(0.99 * at * to, to, look)
        x, y, _ = canvas.at(to)
        if ball:
            self._mass(x, y)
        right, up, _ = canvas.at((1.0 + 0.12 / float(np.linalg.norm(to))) * to)
        if ball:
            # Beside the ball, even if the rod points to the viewer.
            far = math.hypot(x, y)
            along = (x / far, y / far) if far > 0.1 else (0.7, 0.7)
            right, up = (at + (2.5 * _BALL) * one for at, one in zip((x, y), along, strict=True))
        # A partly hidden label would be illegible.
        if near or self.seen is None or not solid.covers(self.seen, self.semi, right, up, 0.05):
            canvas.write(label, right, up)

    def _weights(self, near: bool) -> None:
        """Draw the weights on their rods."""
        canvas = self.canvas
        assert self.turn is not None
        for *at, radius in self.own.get("weights", ()):
            to = self.turn @ np.array(at)
            assert self.seen is not None
            if solid.leaves(self.seen, self.semi, seen(to[None, :], *canvas.view)[0])[1] != near:
                continue
            if not self.own["hollow"]:
                self._rod(to, (theme.INK, "-", 1.2), "", near)
            x, y, _ = canvas.at(to)
            self._ball(x, y, radius, _STEEL, _STEEL_EDGE)

    def _wheels(self, near: bool) -> None:
        if not self.own.get("wheels"):
            return
        assert self.turn is not None
        at, e = np.array(self.own["wheels"][:6]).reshape(2, 3) @ self.turn.T
        for sign in (1.0, -1.0):
            touching = sign * at
            self._rod((1.0 - _WHEEL) * touching, (theme.INK, "-", 1.8), "", near)
            if self.canvas.is_near(touching) == near:
                self._wheel(touching, e, sign * self.ways[-1])

    def _wheel(self, touching: Array, e: Array, way: float) -> None:
        """Draw a wheel whose contact point has moved by `way` towards e."""
        canvas = self.canvas
        axle = np.cross(touching, e)
        axle /= np.linalg.norm(axle)
        side = _THICK if canvas.is_near(axle) else -_THICK
        rim, middle, ink = circle(axle, 0.0)[::4], (1.0 - _WHEEL) * touching, canvas.colour(theme.INK)

        def disc(along: float, size: float, face: str) -> None:
            canvas.area(
                seen(middle + along * axle + size * rim, *canvas.view)[:, :2],
                facecolor=face,
                edgecolor=ink,
                linewidth=1.3,
                joinstyle="round",
            )

        # A stack of discs makes the tread.
        for along in (-side, -0.6 * side, -0.2 * side, 0.2 * side, 0.6 * side):
            disc(along, _WHEEL, ink)
        disc(side, _WHEEL, canvas.colour(theme.PAPER))
        hub, marked = middle + side * axle, canvas.colour(LOOKS[self.own["wheels"][6]][0])
        for k in reversed(range(_SPOKES)):
            angle = 2.0 * math.pi * k / _SPOKES - way / _WHEEL
            spoke = math.cos(angle) * touching + math.sin(angle) * e
            look = (LOOKS[self.own["wheels"][6]][0], "-", 2.4) if k == 0 else (theme.INK, "-", 1.2)
            canvas.line(hub, hub + 0.92 * _WHEEL * spoke, look)
        disc(side, 0.2 * _WHEEL, ink)
        canvas.dot(*canvas.at(touching)[:2], 4.0, color=marked)

    def _arrow(self, along: Array, label: str) -> None:
        """Draw an arrow outwards from the sphere, with the label next to its head."""
        canvas = self.canvas
        canvas.line(1.02 * along, 1.15 * along, (theme.INK, "-", 1.5))
        (x, y, _), (x0, y0, _) = canvas.at(1.15 * along), canvas.at(1.02 * along)
        if math.hypot(x - x0, y - y0) > 3.0 * canvas.point:
            angle, size = math.atan2(y - y0, x - x0), 4.2 * canvas.point
            corners = np.array([[math.cos(angle + turned), math.sin(angle + turned)] for turned in (0.0, 2.4, -2.4)])
            canvas.area(np.array([x, y]) + size * corners, color=canvas.colour(theme.INK), linewidth=0)
        canvas.write(label, x + (8.0 + 2.8 * len(label)) * canvas.point, y)
