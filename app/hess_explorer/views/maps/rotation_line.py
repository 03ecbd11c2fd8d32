"""Rotation number and trace along a line of tori."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.graphs.graph import pieces
from hess_explorer.views.layers import Axes, Layer, Layers, curves, levels, ring
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.rotation_number import ParameterLine, TorusValues

__all__ = ["JUMP", "RHO", "TRACE", "rho_layers", "trace_layers"]

S = TypeVar("S")
LineOf = Callable[[S], ParameterLine]
ValuesOf = Callable[[S], TorusValues]

RHO, TRACE = (-0.52, 0.52), (0.0, 6.0)
"""Vertical axes."""
JUMP = 0.3
"""Points whose ρ differs by more are not joined, as ρ jumps from −½ to ½."""
_DRAWN_TRACE = 50.0
"""Larger traces are clipped to this height beyond the frame."""


def _curve(line: ParameterLine, values: TorusValues, y: Array, jump: float) -> list[Array]:
    return pieces(np.column_stack([line.places(len(y)), y]), values.possible, jump)


def _here(line: LineOf[S], place: Callable[[S], float], curve: Callable[[S], Array]) -> tuple[Layer[S]]:
    """Return a ring on a curve at the torus on show, if it is in the frame."""

    def chosen(state: S, axes: Axes) -> list[tuple[float, float]]:
        x, heights = place(state), curve(state)
        there = np.isfinite(heights)
        if not there.any():
            return []
        y = float(np.interp(x, line(state).places(len(heights))[there], heights[there]))
        return [(x, y)] if axes.x[0] <= x <= axes.x[1] and axes.y[0] <= y <= axes.y[1] else []

    return (ring("chosen", within=chosen, size=18),)


def rho_layers(
    line: LineOf[S],
    values: ValuesOf[S],
    perturbed: Callable[[S], Array | None],
    rational: Callable[[S], float | None],
    place: Callable[[S], float],
) -> Layers[S]:
    """Return the layers: ρ along a line, ρ of another family, and the rational ρ, if a torus has it."""

    def other(state: S) -> list[Array]:
        found = perturbed(state)
        return [] if found is None else _curve(line(state), values(state), found, JUMP)

    def sought(state: S) -> list[float]:
        height = rational(state)
        return [] if height is None else [height]

    return (
        levels("levels", sought),
        curves("other", other, color=theme.MAP, dash="dashed", label="ρ of Θ(φ + ε sin 3φ)", tag="Θ(φ + ε sin 3φ)"),
        curves(
            "rho", lambda s: _curve(line(s), values(s), values(s).rho, JUMP), color=theme.ORBIT, label="ρ, trace of Θ"
        ),
        *_here(line, place, lambda s: values(s).rho),
    )


def trace_layers(line: LineOf[S], values: ValuesOf[S], place: Callable[[S], float]) -> Layers[S]:
    """Return the layers of |t| along a line; tori with |t| > 2 are locked."""

    def trace(state: S) -> Array:
        return np.minimum(values(state).trace, _DRAWN_TRACE)

    return (
        levels("levels", lambda s: [2.0]),
        curves("t", lambda s: _curve(line(s), values(s), trace(s), math.inf), color=theme.ORBIT),
        *_here(line, place, trace),
    )
