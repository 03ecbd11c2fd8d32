"""The rotation number over two parameters: colours, lock zones, what is impossible, the line through a torus."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Grid, Layer, Range, Sign, curves, image, target, text
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.rotation_number import TorusValues

__all__ = ["across", "grids", "layers"]

S = TypeVar("S")

_ZONES = (theme.FORBIDDEN + "00", theme.FORBIDDEN, theme.LOCKED)


def grids(values: TorusValues, cells: tuple[int, int], x: Range, y: Range) -> tuple[Grid, Grid]:
    """ρ, and the zone (free, impossible, locked), at the centres of cells (m, n) that fill a window."""
    m, n = cells
    zones = np.where(values.possible, np.where(values.locked, 2.5, 0.5), 1.5)
    # Cells without a torus lie under their zone, whatever their colour.
    rho = np.where(values.possible, values.rho, 0.0)
    return Grid(rho.reshape(n, m), x, y), Grid(zones.reshape(n, m), x, y)


def layers(grids: Callable[[S], tuple[Grid, Grid]], boundary: Callable[[S], Sequence[Array]],
           across: Callable[[S], Sequence[Array]], here: Callable[[S], Sequence[tuple[float, float]]],
           names: Callable[[S], str]) -> tuple[Layer[S], ...]:
    """Colours and zones; curves (n, 2) where |t| = 2; the line, and the torus on show, if it is in sight.

    names : what the axes are, as that is not always the same.
    """
    return (
        image("rho", lambda s: grids(s)[0], palette=theme.NUMBER_MAP, low=-0.5, high=0.5,
              legend=(Sign("ρ from −½ to ½", "box rho", ""),)),
        image("zones", lambda s: grids(s)[1], palette=_ZONES, low=0.0, high=3.0,
              legend=(Sign("locked, two limit cycles", "box", f"background: {theme.LOCKED}"),
                      Sign("impossible", "box", f"background: {theme.FORBIDDEN}"))),
        curves("boundary", boundary, moving=False, color="black", label="its boundary, |trace| = 2"),
        curves("across", across, color=theme.MUTED, dash="dashed", label="the line"),
        *target("here", here),
        text("names", names),
    )


def across(x_axis: Range, y_axis: Range, x: float | None, y: float | None) -> list[Array]:
    """The line of this x, or else of this y, through the window, if it is in sight."""
    if x is not None and x_axis[0] <= x <= x_axis[1]:
        return [np.array([[x, y_axis[0]], [x, y_axis[1]]])]
    if y is not None and y_axis[0] <= y <= y_axis[1]:
        return [np.array([[x_axis[0], y], [x_axis[1], y]])]
    return []
