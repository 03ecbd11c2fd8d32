"""The rotation number over two parameters: colours, lock zones, impossible region, line through a torus."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import (
    TURNS,
    Axes,
    CellGrid,
    Layers,
    Positions,
    Range,
    Regions,
    Sign,
    curves,
    image,
    rectangle,
    region,
    target,
)
from hess_explorer.views.maps.bifurcation_diagram import impossible
from hess_mechanics.numerics.results import Array, Mask, frozen
from hess_mechanics.suslov_hess.bifurcation import f_max
from hess_mechanics.suslov_hess.rotation_number import Torus, TorusValues

__all__ = ["across", "edges", "grids", "layers", "outside"]

S = TypeVar("S")

_ON_EDGE = 300
_CLEAR = theme.LOCKED + "00"


def _filled(values: Array, known: Mask) -> Array:
    """Fill unknown cells (n, m) with the nearest known value of the row, else of the column, else 0."""
    for axis in (1, 0):
        if not known.any():
            break
        size = values.shape[axis]
        place = np.expand_dims(np.arange(size), 1 - axis)
        before = np.maximum.accumulate(np.where(known, place, -1), axis=axis)
        after = np.flip(np.minimum.accumulate(np.flip(np.where(known, place, size), axis), axis=axis), axis)
        nearest = np.where((before < 0) | ((after < size) & (after - place < place - before)), after, before)
        found = (nearest >= 0) & (nearest < size)
        values = np.take_along_axis(values, np.clip(nearest, 0, size - 1), axis)
        known = found
    return np.where(known, values, 0.0)


def grids(values: TorusValues, cells: tuple[int, int], x: Range, y: Range) -> tuple[CellGrid, CellGrid]:
    """Return ρ and ln(|t|/2), positive in lock zones, at the centres of cells (m, n) that fill a window.

    Cells without a torus take the value of a neighbour, so that both can be interpolated up to the edge.
    """
    m, n = cells
    known = values.possible.reshape(n, m)
    with np.errstate(divide="ignore", invalid="ignore"):
        height = np.clip(np.log(0.5 * values.trace), -1.0, 1.0)
    rho, zones = (CellGrid(_filled(one.reshape(n, m), known), x, y) for one in (values.rho, height))
    return rho, zones


@lru_cache(64)
def _upper(x: Range) -> Array:
    """Return the bifurcation curve (n, 2) with f ≥ 0 within a window; it is independent of a."""
    energies = np.linspace(max(x[0], -1.0), x[1], _ON_EDGE)
    return frozen(np.array([[h, f_max(h) if h > -1.0 else 0.0] for h in energies.tolist()]))


def edges(plane: str, torus: Torus, x: Range, y: Range) -> list[Array]:
    """Return the boundary curves (n, 2) of the possible tori of a plane of `PLANES` within a window."""
    if plane == "h, f":
        if x[1] <= -1.0:
            return []
        upper = _upper(x)
        return [upper, upper * (1.0, -1.0)]
    return [np.array([[end, y[0]], [end, y[1]]]) for end in torus.range_of(plane[0]) if x[0] < end < x[1]]


def outside(plane: str, torus: Torus, x: Range, y: Range) -> Regions:
    """Return the impossible part of the window as a `region`."""
    (x0, x1), (y0, y1) = x, y
    if plane == "h, f":
        return impossible(_upper(x), Axes(x, (min(y0, -y1), max(y1, -y0)))) if x1 > -1.0 else [[rectangle(x, y)]]
    first, last = torus.range_of(plane[0])
    parts = [(x0, min(x1, first)), (max(x0, last), x1)]
    return [[rectangle(part, y)] for part in parts if part[0] < part[1]]


def layers(
    grids: Callable[[S], tuple[CellGrid, CellGrid]],
    boundary: Callable[[S], Sequence[Array]],
    impossible: Callable[[S], Regions],
    edges: Callable[[S], Sequence[Array]],
    across: Callable[[S], Sequence[Array]],
    here: Callable[[S], Positions],
) -> Layers[S]:
    """Return the layers: ρ, lock zones, curves |t| = 2 (n, 2), the line, and the torus on show if in the window.

    impossible, edges : `outside` and `edges`.
    """
    return (
        image("rho", lambda s: grids(s)[0], palette=theme.TURN_MAP, low=-0.5, high=0.5, cyclic=True, legend=(TURNS,)),
        image(
            "zones",
            lambda s: grids(s)[1],
            palette=(_CLEAR, theme.LOCKED),
            low=-1.0,
            high=1.0,
            smooth=True,
            legend=(Sign("locked, two limit cycles", "box", f"background: {theme.LOCKED}"),),
        ),
        curves("boundary", boundary, moving=False, color=theme.INK, label="its boundary, |trace| = 2"),
        region("forbidden", impossible, label="impossible", tag="impossible"),
        curves("edge", edges, moving=False, color=theme.INK, width=1.5),
        curves("across-under", across, color=theme.PAPER, width=4, alpha=0.7),
        curves("across", across, color=theme.INK, dash="dashed", label="line of ρ", tag="line of ρ"),
        *target("here", here),
    )


def across(x_axis: Range, y_axis: Range, x: float | None, y: float | None) -> list[Array]:
    """Return the vertical line at x, or else the horizontal line at y, within the window."""
    if x is not None and x_axis[0] <= x <= x_axis[1]:
        return [np.array([[x, y_axis[0]], [x, y_axis[1]]])]
    if y is not None and y_axis[0] <= y <= y_axis[1]:
        return [np.array([[x_axis[0], y], [x_axis[1], y]])]
    return []
