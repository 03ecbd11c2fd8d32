"""The (ω1, ω2)-plane: columns of a motion, what the energy forbids, arrows along curves, round axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.views.layers import Columns, Range, f32
from hess_mechanics.numerics.results import Array

__all__ = ["arrows_on", "centred", "nice_above", "outside", "ring_outside", "square", "velocity_columns"]


def velocity_columns(times: Array | None, omega: Array, gamma: Array, **more: Array) -> Columns:
    """The columns of a motion for this plane and the sphere: ω (m, 2), γ (m, 3), and further ones for the player."""
    moving = {} if times is None else {"t": f32(times)}
    return {**moving, "omega1": f32(omega[:, 0]), "omega2": f32(omega[:, 1]),
            **{f"g{i + 1}": f32(gamma[:, i]) for i in range(3)}, **{name: f32(one) for name, one in more.items()}}


def nice_above(value: float) -> float:
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(step for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * (1 - 1e-12)))


def centred(half_width: float) -> Range:
    """An axis about 0."""
    return -half_width, half_width


def square(half_width: float) -> Array:
    """A square (4, 2) about 0."""
    return half_width * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def outside(curve: Array, half_width: float) -> list[Array]:
    """For a `region`: all but the inside of a closed curve (m, 2)."""
    return [square(half_width), curve]


def ring_outside(inner: Array, outer: Array, half_width: float) -> list[list[Array]]:
    """For a `region`: all but the ring between two closed curves (m, 2); axes that are held may be larger ones."""
    return [outside(outer, 4.0 * half_width), [inner]]


def arrows_on(curves: Sequence[Array], half_width: float) -> tuple[list[float], list[float], list[float]]:
    """For `arrows`: x, y, angle in the middle of each curve (m, 2) that is long enough for one."""
    x, y, angle = [], [], []
    for curve in curves:
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
        if length[-1] < 0.02 * half_width:
            continue
        i = min(int(np.searchsorted(length, 0.5 * length[-1])), len(curve) - 1)
        step = curve[i] - curve[i - 1]
        x.append(float(curve[i, 0]))
        y.append(float(curve[i, 1]))
        # A triangle points upwards at angle 0.
        angle.append(float(np.arctan2(step[1], step[0]) - np.pi / 2))
    return x, y, angle
