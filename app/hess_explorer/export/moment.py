"""The moving point of an orbit and the points of a cloud at a given time, interpolated between samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_explorer.views.layers import Columns
from hess_mechanics.numerics.results import Array

__all__ = ["CloudFrame", "between", "clouds_at", "density_at", "end", "state_at"]


def between(times: Array, t: float) -> tuple[int, float]:
    """Return (i, s) with t = times[i] + s (times[i + 1] − times[i]), clamped to the range of times."""
    i = int(np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(times) - 2))
    return i, float(np.clip((t - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0))


def end(columns: Mapping[str, Columns]) -> float:
    """Return the last time of the orbit or of the clouds; 0 if nothing moves."""
    clouds = (one["times"] for one in columns.values() if "frames0" in one)
    tracks = (columns.get("data-orbit", {}).get("t", ()), *clouds)
    return max((float(times[-1]) for times in tracks if len(times) > 1), default=0.0)


def state_at(track: Columns, angles: tuple[str, ...], t: float) -> dict[str, float]:
    """Return the columns of the orbit at time t, interpolated as on the page; {} without an orbit."""
    if len(track.get("t", ())) < 2:
        return {}
    i, s = between(track["t"], t)
    found = {}
    for name, column in track.items():
        a, b = float(column[i]), float(column[i + 1])
        # An angle that crosses ±π between two samples is not interpolated.
        found[name] = (a if s < 0.5 else b) if name in angles and abs(b - a) > 1.0 else a + s * (b - a)
    return found


@dataclass(frozen=True)
class CloudFrame:
    """Phase points at one time: ω1, ω2 (n, 2), γ (n, 3), and ln|s| (n,) if there is no field."""

    omega: Array
    gamma: Array
    log_s: Array | None


def clouds_at(columns: Columns, t: float) -> list[CloudFrame]:
    """Return the clouds of a `CloudPlane` at time t, by cubic Hermite interpolation between frames."""
    found = []
    for k in (0, 1):
        if len(columns.get(f"frames{k}", ())):
            found.append(_cloud(columns, k, t))
    return found


def _cloud(columns: Columns, k: int, t: float) -> CloudFrame:
    times, sense = columns["times"], columns["sense"]
    signs = columns.get(f"signs{k}")
    frames = np.asarray(columns[f"frames{k}"], float).reshape(len(times), 5, -1)
    i, u = between(times, t)
    step = float(times[i + 1] - times[i]) * sense
    b = u * u * (3.0 - 2.0 * u)
    e, f = u * (1.0 - u) ** 2 * step, u * u * (u - 1.0) * step
    ends = [_slopes(frames[j], signs, columns["body"]) for j in (i, i + 1)]
    at = (1.0 - b) * frames[i] + b * frames[i + 1] + e * ends[0] + f * ends[1]
    gamma = at[2:] / np.linalg.norm(at[2:], axis=0)
    return CloudFrame(_velocities(at[:2], signs, columns["body"]).T, gamma.T, None if signs is None else at[1])


def _velocities(at: Array, signs: Array | None, body: Any) -> Array:
    """Return ω1, ω2 (2, n): the rows of `at`, or with signs of s from (ω, ξ) and ln|s|, s = I13ω1 + I23ω2."""
    if signs is None:
        return at
    J = float(np.hypot(body[2], body[3]))
    n1, n2 = body[2] / J, body[3] / J
    across = signs * np.exp(at[1]) / J
    return np.stack([n2 * at[0] + n1 * across, n2 * across - n1 * at[0]])


def _slopes(at: Array, signs: Array | None, body: Any) -> Array:
    """Return the derivative of a frame (5, n): ω̇ = s Î⁻¹(−ω2, ω1) by `eq29`, or Îω̇ = (b3γ2, −b3γ1); γ̇ = γ × ω."""
    I11, I22, I13, I23, D, b3 = body
    w1, w2 = _velocities(at[:2], signs, body)
    g1, g2, g3 = at[2:]
    a11, a12, a22 = I11 + D * (g2**2 + g3**2), -D * g1 * g2, I22 + D * (g1**2 + g3**2)
    det = a11 * a22 - a12**2
    f1, f2 = (b3 * g2, -b3 * g1) if signs is None else (-w2, w1)
    h1, h2 = (a22 * f1 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det
    turning = (-g3 * w2, g3 * w1, g1 * w2 - g2 * w1)
    if signs is None:
        return np.stack([h1, h2, *turning])
    s, J = signs * np.exp(at[1]), float(np.hypot(I13, I23))
    return np.stack([s * (I23 * h1 - I13 * h2) / J, I13 * h1 + I23 * h2, *turning])


def density_at(columns: Columns, t: float) -> tuple[Array, Array]:
    """Return |s| and the density of the first cloud per unit of |s|, in bins of equal width in ln|s|."""
    clouds = clouds_at(columns, t)
    if not clouds or clouds[0].log_s is None:
        return np.empty(0), np.empty(0)
    first, wide, count = columns["bins"]
    log_s = clouds[0].log_s
    counts = np.histogram(log_s, first + wide * np.arange(count + 1))[0]
    s = np.exp(first + (np.arange(count) + 0.5) * wide)
    full = counts > 0
    return s[full], counts[full] / (log_s.size * wide * s[full])
