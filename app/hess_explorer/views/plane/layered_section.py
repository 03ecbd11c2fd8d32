"""A Poincaré section with points of two kinds, a dividing curve and the forbidden region."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, Layers, Positions, Sign, compose, crop, dots, image, in_window, ring
from hess_explorer.views.plane.section_plane import concatenate
from hess_mechanics.dynamics.attraction import LOST, Arrivals
from hess_mechanics.dynamics.cells import Window
from hess_mechanics.numerics.results import Array

S = TypeVar("S")

_MANY = 50_000
_ACROSS = 384
"""Cells across a window: about one per pixel on most screens."""
_SHADES = 40
"""Shades of a basin, by the time of arrival."""
_BASINS = (
    "first basin, late to early arrival",
    *(f"{which} basin, late to early arrival" for which in ("second", "third", "fourth", "any other")),
    "no attractor reached",
)
_CLEAR = theme.FORBIDDEN + "00"


def thin_out(points: Array, window: Window) -> Array:
    """Return the points (n, 2); of more than 50,000 points only one in each of 384² cells of the window."""
    if len(points) <= _MANY:
        return points
    low, high = np.array(window)
    within = points[np.all((points >= low) & (points <= high), axis=1)]
    cells = np.minimum((within - low) * (_ACROSS / (high - low)), _ACROSS - 1).astype(int)
    one = np.full(_ACROSS * _ACROSS, -1)
    one[cells @ (_ACROSS, 1)] = np.arange(len(within))
    return np.asarray(within[np.sort(one[one >= 0])])


def _kinds(
    name: str,
    cells: Callable[[S], Array | None],
    window: Callable[[S], Window],
    colors: tuple[str, ...],
    labels: tuple[str, ...],
) -> Layer[S]:
    """Return the layer of cells (m, n) of kinds 0, 1, …; −1 is empty, and larger numbers count as the last kind."""
    shifted = compose(cells, lambda found: np.minimum(found, len(colors) - 1) + 1.5)
    return image(
        name,
        in_window(shifted, window),
        palette=(_CLEAR, *colors),
        low=0.0,
        high=len(colors) + 1.0,
        kinds=True,
        legend=tuple(
            Sign(label, "box", f"background: {color}", i + 1.0)
            for i, (label, color) in enumerate(zip(labels, colors, strict=True))
        ),
    )


def basins(arrivals: Callable[[S], Arrivals | None], window: Callable[[S], Window]) -> Layer[S]:
    """Return the layer of basins: a colour for each attractor, stronger for an earlier arrival.

    The fifth attractor and all further ones have one colour; cells that reach no attractor are grey.

    Parameters
    ----------
    arrivals : callable
        `arrivals(state)` returns the arrivals of the cells (n, m), or None.
    window : callable
        `window(state)` returns the corners of the window that the cells fill.
    """
    faint, full = 0.35, 0.95
    shades = [f"{round(255 * (faint + (full - faint) * (i + 0.5) / _SHADES)):02x}" for i in range(_SHADES)]
    colors = (*theme.BASINS, theme.MUTED)
    last = len(theme.BASINS) - 1

    def values(arrivals: Arrivals) -> Array:
        number, crossings = arrivals.number, arrivals.crossings
        # Shade by the logarithm of the arrival time, because most orbits arrive early.
        late = np.log1p(crossings)
        there = late[number >= 0]
        first, longest = np.quantile(there, (0.002, 0.998)) if there.size else (0.0, 1.0)
        shade = 1.0 - np.clip((late - first) / max(longest - first, 1e-9), 0.0, 1.0)
        kind = np.where(number >= 0, np.minimum(number, last) + 1.0, np.where(number == LOST, last + 2.0, 0.0))
        return kind + (np.floor(shade * (_SHADES - 1)) + 0.5) / _SHADES

    return image(
        "basins",
        in_window(compose(arrivals, values), window),
        palette=(
            *[_CLEAR] * _SHADES,
            *(color + shade for color in theme.BASINS for shade in shades),
            *[theme.MUTED + "60"] * _SHADES,
        ),
        low=0.0,
        high=len(colors) + 1.0,
        fine=True,
        legend=tuple(
            Sign(label, "box", f"background: linear-gradient(90deg, {color}{shades[0]}, {color}{shades[-1]})", i + 1.0)
            for i, (label, color) in enumerate(zip(_BASINS, colors, strict=True))
        ),
    )


def indicator(cells: Callable[[S], Array | None], window: Callable[[S], Window]) -> Layer[S]:
    """Return the layer of MEGNO: `cells(state)` returns the kinds (n, m) of `megno_map` over the window, or None."""
    colors = (theme.SHEET + "50", theme.UNSTABLE + "60", theme.STABLE + "70", theme.MAP + "80", theme.MUTED + "60")
    labels = ("regular", "chaotic", "regular, volume shrinks", "chaotic, volume shrinks", "motion ends early")
    return _kinds("megno", cells, window, colors, labels)


def layers(
    first: Callable[[S], Array],
    second: Callable[[S], Array],
    own: Callable[[S], Sequence[Array]],
    chosen: Callable[[S], Positions],
    forbidden_cells: Callable[[S], Array],
    window: Callable[[S], Window],
    labels: tuple[str, str],
    between: Layers[S] = (),
) -> Layers[S]:
    """Return the layers: points of both kinds, chosen orbits with rings at their starts, forbidden region in grey.

    Chosen orbits have the colours `theme.CHOSEN` in turn.

    Parameters
    ----------
    first, second : callable
        Points (n, 2) of the two kinds, as functions of the state.
    own : callable
        `own(state)` returns the points (n, 2) of each chosen orbit.
    chosen : callable
        `chosen(state)` returns the starts of these orbits, as points (x, y).
    forbidden_cells : callable
        `forbidden_cells(state)` returns cells (n, m) over the window, 1 in the forbidden region.
    window : callable
        `window(state)` returns the visible window.
    labels : tuple of str
        Names of both kinds in the legend.
    between : sequence of Layer
        Further layers, above the points of both kinds and below those of the chosen orbits.
    """

    def of_colour(i: int, color: str) -> Layer[S]:
        label = "" if i else "chosen orbit; its ring marks the start"
        return _points(f"own{i or ''}", lambda s: concatenate(own(s)[i :: len(theme.CHOSEN)]), window, 10, color, label)

    def ring_of(i: int, color: str) -> Layer[S]:
        return ring(f"chosen{i or ''}", lambda s: crop(chosen(s)[i :: len(theme.CHOSEN)], window(s)), color=color)

    return (
        image(
            "impossible",
            in_window(forbidden_cells, window),
            palette=(_CLEAR, theme.FORBIDDEN),
            low=0.0,
            high=1.0,
            kinds=True,
            legend=(Sign("impossible", "box", f"background: {theme.FORBIDDEN}", 1.0),),
            tag="impossible",
        ),
        _points("first", first, window, 5, theme.ORBIT, labels[0]),
        _points("second", second, window, 5, theme.UNSTABLE, labels[1]),
        *between,
        *(of_colour(i, color) for i, color in enumerate(theme.CHOSEN)),
        *(ring_of(i, color) for i, color in enumerate(theme.CHOSEN)),
    )


def _points(
    name: str, of: Callable[[S], Array], window: Callable[[S], Window], size: float, color: str, label: str
) -> Layer[S]:
    return dots(name, lambda s: thin_out(of(s), window(s)).T, color=color, size=size, label=label)
