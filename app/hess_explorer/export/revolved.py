"""Shade a translucent surface of revolution in orthographic projection, by exact ray intersections.

`revolved.js` paints the same.  Vectors are in view coordinates: right, up, towards the viewer.  ψ is the angle about
the axis, from the side of the viewer.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hess_explorer.export.solid import lit
from hess_explorer.views.layers import Columns
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.invariant_measure import poisson_kernel

__all__ = ["shaded"]


def shaded(section: Columns, view: tuple[float, float], tones: tuple[Array, Array, Array], side: int) -> Array:
    """Return an RGBA image (side, side, 4) of the square about the unit sphere, with the lowest row first.

    section : columns of a `TorusInSpace`; tones : RGB of the outside, the inside and the densest part.
    Each line of sight meets the cone between two points of the cross-section in closed form.
    """
    azimuth, elevation = view
    # A view along the equator would have to be a case of its own.
    flat, steep = math.cos(elevation), math.copysign(max(1e-3, abs(math.sin(elevation))), elevation)
    centres = (2.0 * np.arange(side) + 1.0) / side - 1.0
    x, y = (one.ravel() for one in np.meshgrid(centres, centres))
    radius, height, normals = section["radius"], section["height"], _normals(section)
    image = np.zeros((side * side, 4))
    hits: list[tuple[Any, ...]] = []
    for i in range(len(radius) - 1):
        dr, dz = radius[i + 1] - radius[i], height[i + 1] - height[i]
        # Along the cone's side, at the share s, the line of sight is this far before the axis.
        start, slope = (flat * height[i] - y) / steep, flat * dz / steep
        a, b, c = slope**2 - dr**2, start * slope - radius[i] * dr, start**2 + x**2 - radius[i] ** 2
        root = np.sqrt(np.where(b * b >= a * c, b * b - a * c, np.nan))
        for sign in (-1.0, 1.0):
            with np.errstate(divide="ignore", invalid="ignore"):
                # The form without cancellation, also for a = 0.
                q = -b - np.copysign(root, b)
                s = q / a if sign > 0.0 else c / q
            at = np.flatnonzero((s >= 0.0) & (s < 1.0) & (radius[i] + s * dr > 0.0))
            ahead = start[at] + slope * s[at]
            depth = flat * ahead + steep * (height[i] + s[at] * dz)
            hits.append((at, depth, i + s[at], np.arctan2(x[at], ahead)))
    at, depth, place, psi = (np.concatenate(column) for column in zip(*hits, strict=True))
    across, up = (np.interp(place, np.arange(len(normals)), column) for column in normals.T)
    normal = np.column_stack(
        [across * np.sin(psi), flat * up - steep * across * np.cos(psi), flat * across * np.cos(psi) + steep * up]
    )
    colours = _glass(normal, _share(section, place, azimuth + psi), tones)
    # From back to front, one hit of each line of sight after the other.
    order = np.lexsort((depth, at))
    at, colours = at[order], colours[order]
    first = np.flatnonzero(np.diff(at, prepend=-1))
    rank = np.arange(at.size) - np.repeat(first, np.diff(first, append=at.size))
    for k in range(int(rank.max(initial=-1)) + 1):
        now = rank == k
        alpha = colours[now, 3:]
        image[at[now]] = image[at[now]] * (1.0 - alpha) + np.column_stack([colours[now, :3] * alpha, alpha])
    image[:, :3] /= np.maximum(image[:, 3:], 1e-9)
    return np.clip(image, 0.0, 1.0).reshape(side, side, 4)


def _normals(section: Columns) -> Array:
    """Return the outward normals (n, 2) of the closed cross-section."""
    closed = np.column_stack([section["radius"], section["height"]])
    around = np.concatenate([closed[-2:-1], closed, closed[1:2]])
    along = around[2:] - around[:-2]
    length = np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    return np.asarray(np.column_stack([-along[:, 1], along[:, 0]]) / length)


def _glass(normal: Array, share: Array, tones: tuple[Array, Array, Array]) -> Array:
    """Return the RGBA colours (n, 4) of a surface with these normals (n, 3) in the view, as in `revolved.js`."""
    front = normal[:, 2:] >= 0.0
    seen_normal = np.where(front, normal, -normal)
    bright, shine = (column[:, None] for column in lit(seen_normal))
    tone = np.where(front, tones[0], tones[1])
    tone = tone + share[:, None] * (tones[2] - tone)
    glint = np.where(front, 0.35 * shine, 0.0)
    alpha = np.where(front, 0.2, 0.3) + 0.5 * (1.0 - seen_normal[:, 2:]) ** 2 + 0.4 * share[:, None] + glint
    return np.clip(np.column_stack([bright * tone + glint, alpha]), 0.0, 1.0)


def _share(section: Columns, place: Array, angle: Array) -> Array:
    """Return the invariant density at points (n,) relative to its largest value; 0 if it is not shown."""
    if not len(section.get("re", ())):
        return np.zeros(len(place))
    zeta = section["re"] + 1j * section["im"]
    there = np.interp(place, np.arange(len(zeta)), zeta)
    # w = |w|(sin φ, cos φ); the kernel is largest where e^{iφ} is nearest to ζ.
    largest = np.max((1.0 + np.abs(zeta)) / (1.0 - np.abs(zeta))) / (2.0 * math.pi)
    return np.asarray(np.minimum(1.0, poisson_kernel(0.5 * math.pi - angle, there) / largest))
