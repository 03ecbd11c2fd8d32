"""The density of crossings in a section: a tone for each pixel, a colour for each kind of orbits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views.layers import Layers, Sign, image, in_window
from hess_mechanics.dynamics.cells import Window
from hess_mechanics.numerics.results import Array

S = TypeVar("S")
_TONES = 256
_FAINTEST = 0.3
"""Tone of a pixel with a single crossing."""
_BRIGHT = 0.995
"""Share of the visited pixels below the full tone: a few pixels at fixed points would leave all others faint."""


def tones(counts: Sequence[Array]) -> list[Array]:
    """Return the opacity (n, m) of each kind of orbits, 0 to 255, in drawing order.

    The tone grows with the logarithm of the number of crossings in a pixel.  Each kind covers the previous ones in
    proportion to its share of the crossings, so that the colours mix by these shares.

    Parameters
    ----------
    counts : sequence of array (n, m)
        Number of crossings of each kind in each pixel, not all 0.
    """
    total = np.sum(counts, axis=0)
    full = max(2.0, float(np.quantile(total[total > 0], _BRIGHT)))
    tone = _FAINTEST + (1.0 - _FAINTEST) * np.minimum(np.log(np.maximum(total, 1)) / np.log(full), 1.0)
    so_far = np.cumsum(counts, axis=0)
    return [np.rint((_TONES - 1) * tone * one / np.maximum(upto, 1)) for one, upto in zip(counts, so_far, strict=True)]


def layers(
    tones: Callable[[S], Sequence[Array]],
    window: Callable[[S], Window],
    labels: tuple[str, ...],
    colors: tuple[str, ...],
) -> Layers[S]:
    """Return one layer of pixels per kind of orbits.

    Parameters
    ----------
    tones : callable
        `tones(state)` returns the opacities of `tones`, one array (n, m) for each kind; a layer without one is empty.
    window : callable
        `window(state)` returns the corners of the window that the pixels fill.
    labels, colors : tuple of str
        Legend entry and colour of each kind.
    """

    def of(i: int) -> Callable[[S], Array | None]:
        def cells(state: S) -> Array | None:
            found = tones(state)
            return found[i] if i < len(found) else None

        return cells

    return tuple(
        image(
            f"density-{i}",
            in_window(of(i), window),
            palette=tuple(f"{color}{tone:02x}" for tone in range(_TONES)),
            low=0.0,
            high=float(_TONES),
            fine=True,
            legend=(Sign(label, "box", f"background: linear-gradient(90deg, {color}26, {color})"),),
        )
        for i, (label, color) in enumerate(zip(labels, colors, strict=True))
    )
