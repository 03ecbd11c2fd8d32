"""Loops: films whose last frame meets the first, with a caption and the link, for slides and posts."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np

from hess_explorer.export.moment import end
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.solid import EVEN, ODD
from hess_explorer.views import theme
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import Sphere
from hess_mechanics.numerics.results import Array

__all__ = ["WIDTH", "footer", "in_dark", "loop_times", "on_dark", "period"]

WIDTH = 135.0
"""Width in millimetres: 1080 pixels."""
_CLOSE, _AWAY = 0.01, 0.1
"""A motion has returned within the first share of its extent, after it was further away than the second."""
_LINE, _LINES = 96, 3
"""Letters of a line below the picture; most lines of the link."""


def period(data: PictureData) -> float | None:
    """Return the time after which a picture repeats itself, or None.

    Only a point on a still picture repeats itself: trails, clouds and bodies remember where they came from.
    """
    picture, track = data.picture, data.columns.get("data-orbit", {})
    stands = (isinstance(picture, Plot) and not isinstance(picture, CloudPlane)) or (
        isinstance(picture, Sphere) and not picture.clouds
    )
    names = [name for name in track if name != "t"]
    if not stands or not names or len(track["t"]) < 4:
        return None
    columns = []
    for name in names:
        values = np.asarray(track[name], float)
        if name in data.scene.angles:
            columns += [np.cos(values), np.sin(values)]
        else:
            columns.append((values - values.min()) / (np.ptp(values) or 1.0))
    return _first_return(np.asarray(track["t"], float), np.stack(columns, axis=1))


def _first_return(times: Array, states: Array) -> float | None:
    """Return the time at which the polygon of states (n, k) first comes back to its start in the same direction."""
    start, along = states[0], np.diff(states, axis=0)
    lengths = np.maximum(np.sum(along**2, axis=1), 1e-300)
    share = np.clip(np.sum((start - states[:-1]) * along, axis=1) / lengths, 0.0, 1.0)
    far = np.linalg.norm(states[:-1] + share[:, None] * along - start, axis=1)
    gone = np.maximum.accumulate(np.linalg.norm(states[:-1] - start, axis=1)) > _AWAY
    # The orbit has passed its start where the next stretch is further away.
    nearest = np.append(far[:-1] <= far[1:], False)
    found = np.flatnonzero(gone & nearest & (far < _CLOSE) & (along @ along[0] > 0.0))
    if not found.size:
        return None
    lasts = float(times[found[0]] + share[found[0]] * np.diff(times)[found[0]])
    # A motion near a saddle or in a chaotic sea also returns once, but does not repeat itself from then on.
    later = times >= lasts
    again = np.stack([np.interp(times[later] - lasts, times, column) for column in states.T], axis=1)
    return lasts if np.max(np.linalg.norm(states[later] - again, axis=1)) < 5.0 * _CLOSE else None


def loop_times(data: PictureData, count: int) -> Array:
    """Return the times of the frames (count,): over a period of the motion, or there and back, slower at both ends."""
    phase = np.arange(count) / count
    lasts = period(data)
    return lasts * phase if lasts is not None else 0.5 * end(data.columns) * (1.0 - np.cos(2.0 * np.pi * phase))


def footer(data: PictureData, home: str) -> str:
    """Return one line of caption and the link; the tags of the file have a link that is too long to be shown."""
    link = f"{home}?{data.link}"
    lines = [link[i : i + _LINE] for i in range(0, len(link), _LINE)]
    shown = lines if len(lines) <= _LINES else [*lines[: _LINES - 1], f"{lines[_LINES - 1][:-1]}…"]
    return "\n".join([textwrap.shorten(data.caption, _LINE, placeholder=" …"), *shown])


def in_dark(colour: str) -> str:
    """Return the colour on a dark page."""
    shades = {**dict(theme.SHADES.values()), EVEN: "#96A4B6", ODD: "#6B7B90"}
    if colour == "white":
        return shades[theme.PAPER]
    # A style may have no colour, which is None.
    return shades.get(colour[:7].upper(), colour[:7]) + colour[7:] if colour and colour.startswith("#") else colour


def on_dark() -> Mapping[str, Any]:
    """Return Matplotlib's settings of a dark page."""
    ink, paper = theme.SHADES["ink"][1], theme.SHADES["paper"][1]
    inks = ("text.color", "axes.edgecolor", "axes.labelcolor", "axes.titlecolor", "xtick.color", "ytick.color")
    return dict.fromkeys(inks, ink) | dict.fromkeys(("figure.facecolor", "axes.facecolor"), paper)
