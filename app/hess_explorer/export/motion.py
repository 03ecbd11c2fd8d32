"""The times of the frames of a film or a loop, and the lines below a loop."""

from __future__ import annotations

import textwrap

import numpy as np

from hess_explorer.export.figure import densities
from hess_explorer.export.picture_data import PictureData
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Sphere
from hess_mechanics.numerics.results import Array

_CLOSE, _AWAY = 0.01, 0.1
"""Distances, as fractions of the extent of a motion: it returns within the first after exceeding the second."""
_LETTERS, _LINES = 96, 3
"""Maximum number of characters of a line below the picture, and of lines of the link."""


def _end(data: PictureData) -> float:
    """Return the latest final time of the orbit and the clouds; 0 if nothing moves."""
    clouds = (one["times"] for one in data.columns.values() if "frames0" in one)
    tracks = (data.columns.get("data-orbit", {}).get("t", ()), *clouds)
    return max((float(times[-1]) for times in tracks if len(times) > 1), default=0.0)


def moves(data: PictureData) -> bool:
    """Return whether the picture changes with time."""
    picture = data.picture
    # A plot may show the track of a motion without a point that moves.
    follows = picture.followers or densities(data) if isinstance(picture, Plot) else "orbit" in picture.tracks
    return bool(follows) and _end(data) > 0.0


def film_times(data: PictureData, count: int) -> Array:
    """Return evenly spaced times (count,) of the frames, from the start to the end of the motion, both included."""
    return np.linspace(0.0, _end(data), count)


def period(data: PictureData) -> float | None:
    """Return the period of a picture, or None if it does not repeat itself.

    Only a point on a still picture repeats itself; trails, clouds and bodies also show the past.
    """
    picture, track = data.picture, data.columns.get("data-orbit", {})
    stands = isinstance(picture, Plot) or (isinstance(picture, Sphere) and not picture.clouds)
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
    """Return the time at which an orbit first returns to its start in the same direction, from states (n, k).

    None if it does not return, or does not repeat itself afterwards.
    """
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
    # A motion near a saddle or in a chaotic sea may return once without repeating itself afterwards.
    later = times >= lasts
    again = np.stack([np.interp(times[later] - lasts, times, column) for column in states.T], axis=1)
    return lasts if np.max(np.linalg.norm(states[later] - again, axis=1)) < 5.0 * _CLOSE else None


def loop_times(data: PictureData, count: int) -> Array:
    """Return the times (count,) of the frames of a loop, without its end, which equals its start.

    They cover one period of the motion if it has one; otherwise the motion forwards and backwards, slower at both ends.
    """
    phase = np.arange(count) / count
    lasts = period(data)
    return lasts * phase if lasts is not None else 0.5 * _end(data) * (1.0 - np.cos(2.0 * np.pi * phase))


def loop_lines(data: PictureData, home: str) -> list[str]:
    """Return the lines below a loop: the caption, shortened to one line, and the link, shortened to `_LINES` lines.

    The metadata contain the complete link.
    """
    link = f"{home}?{data.link}"
    lines = [link[i : i + _LETTERS] for i in range(0, len(link), _LETTERS)]
    shown = lines if len(lines) <= _LINES else [*lines[: _LINES - 1], f"{lines[_LINES - 1][:-1]}…"]
    return [textwrap.shorten(data.caption, _LETTERS, placeholder=" …"), *shown]
