"""Rotation number and trace along a line of tori."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.graphs.graph import pieces
from hess_explorer.views.layers import Axes, Layers, curves, levels, ring
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.rotation_number import TorusValues

S = TypeVar("S")
RHO, TRACE = (-0.52, 0.52), (0.0, 6.0)
"""Vertical axes."""
_JUMP = 0.3
"""Points whose ρ differs by more are not joined, as ρ jumps from −½ to ½."""
_DRAWN_TRACE = 50.0
"""Larger traces are clipped to this height beyond the frame."""


@dataclass(frozen=True)
class Tori:
    """Tori along a line of parameters.

    Attributes
    ----------
    x : array (n,)
        Values of the parameter.
    values : TorusValues
        ρ and trace of each torus.
    current : float
        Parameter of the current torus.
    """

    x: Array
    values: TorusValues
    current: float

    def curve(self, y: Array, jump: float = math.inf) -> list[Array]:
        """Return the parts (k, 2) of the graph of y (n,) over the existing tori, cut at changes above `jump`."""
        return pieces(np.column_stack([self.x, y]), self.values.possible, jump)

    @property
    def trace(self) -> Array:
        """|t| (n,), clipped beyond the frame; NaN without a torus."""
        return np.minimum(self.values.trace, _DRAWN_TRACE)

    def ring(self, y: Array, axes: Axes) -> list[tuple[float, float]]:
        """Return the point of the current torus on the graph of y (n,), as a list; empty outside the frame.

        The height is interpolated between the tori with a finite y.
        """
        there = np.isfinite(y)
        if not there.any():
            return []
        height = float(np.interp(self.current, self.x[there], y[there]))
        inside = axes.x[0] <= self.current <= axes.x[1] and axes.y[0] <= height <= axes.y[1]
        return [(self.current, height)] if inside else []


def rho_layers(
    tori: Callable[[S], Tori], perturbed: Callable[[S], Array | None], rational: Callable[[S], Sequence[float]]
) -> Layers[S]:
    """Return the layers: ρ along a line, ρ of another family, dotted lines at some ρ, and a ring at the current torus.

    Parameters
    ----------
    tori : callable
        `tori(state)` returns the tori along the line.
    perturbed : callable
        `perturbed(state)` returns ρ (n,) of the other family at the same tori; None until known.
    rational : callable
        `rational(state)` returns the heights of the dotted lines.
    """

    def other(state: S) -> list[Array]:
        found = perturbed(state)
        return [] if found is None else tori(state).curve(found, _JUMP)

    return (
        levels("levels", rational),
        curves("other", other, color=theme.MAP, dash="dashed", label="ρ of Θ(φ + ε sin 3φ)", tag="Θ(φ + ε sin 3φ)"),
        curves("rho", lambda s: tori(s).curve(tori(s).values.rho, _JUMP), color=theme.ORBIT, label="ρ, trace of Θ"),
        ring("chosen", data_in_axes=lambda s, axes: tori(s).ring(tori(s).values.rho, axes), size=18),
    )


def trace_layers(tori: Callable[[S], Tori]) -> Layers[S]:
    """Return the layers: |t| along a line, a dotted line at 2, and a ring at the current torus.

    Tori with |t| > 2 have limit cycles.
    """
    return (
        levels("levels", lambda s: [2.0]),
        curves("t", lambda s: tori(s).curve(tori(s).trace), color=theme.ORBIT),
        ring("chosen", data_in_axes=lambda s, axes: tori(s).ring(tori(s).trace, axes), size=18),
    )
