# mypy: allow-untyped-defs
"""Kernels of `tags`: draw curves and regions on the grid of a frame, and find the best place of a label.

The grid is indexed [row, column]; lengths are fractions of the frame, from its lower left corner.
"""

from __future__ import annotations

import math

import numpy as np

from hess_mechanics.numerics.jit import inner, kernel


@kernel
def sample_curve(x, y, count):
    """Return `count` points (2, count) evenly along the index of a curve of at least two points."""
    found = np.empty((2, count))
    for k in range(count):
        at = k * (x.size - 1.0) / (count - 1.0)
        i = min(int(at), x.size - 2)
        found[0, k] = x[i] + (at - i) * (x[i + 1] - x[i])
        found[1, k] = y[i] + (at - i) * (y[i + 1] - y[i])
    return found


@kernel
def mark(grid, points, value):
    """Set the cells of the points (2, n) that are in the frame."""
    cells = grid.shape[0]
    for k in range(points.shape[1]):
        x, y = points[0, k], points[1, k]
        if 0.0 <= x < 1.0 and 0.0 <= y < 1.0:
            grid[int(y * cells), int(x * cells)] = value


@kernel
def fill(grid, ring):
    """Negate the cells whose middle is inside a closed curve (2, n), that is, right of an odd number of its edges."""
    cells, n = grid.shape[0], ring.shape[1]
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        x0, y0, x1, y1 = ring[0, i], ring[1, i], ring[0, j], ring[1, j]
        for row in range(cells):
            height = (row + 0.5) / cells
            if (y0 <= height) != (y1 <= height):
                x = x0 + (height - y0) / (y1 - y0) * (x1 - x0)
                first = min(max(math.ceil(x * cells - 0.5), 0.0), float(cells))
                for column in range(int(first), cells):
                    grid[row, column] = 1.0 - grid[row, column]


@inner
def sums(grid):
    """Return the summed-area table of a grid (n, n), with shape (n + 1, n + 1)."""
    cells = grid.shape[0]
    found = np.zeros((cells + 1, cells + 1))
    for row in range(cells):
        total = 0.0
        for column in range(cells):
            total += grid[row, column]
            found[row + 1, column + 1] = found[row, column + 1] + total
    return found


@inner
def mean(sums_of_grid, x, y, half_width, half_height):
    """Return the mean of the cells in a box about a point."""
    cells = sums_of_grid.shape[0] - 1
    x0 = max(0, min(cells, int(np.rint((x - half_width) * cells))))
    x1 = max(0, min(cells, int(np.rint((x + half_width) * cells))))
    y0 = max(0, min(cells, int(np.rint((y - half_height) * cells))))
    y1 = max(0, min(cells, int(np.rint((y + half_height) * cells))))
    total = sums_of_grid[y1, x1] - sums_of_grid[y0, x1] - sums_of_grid[y1, x0] + sums_of_grid[y0, x0]
    return total / max(1, (x1 - x0) * (y1 - y0))


@kernel
def best_label(grid, region, places, half_width, half_height, edge, pull):
    """Return (cost, covered, x, y) of the best label about one of the places (2, n), inside the cells of a region.

    `covered` is the mean of the grid under the label.  The cost is infinite if no label fits into the region and into
    the frame without its edge.
    """
    total, of_region, found = sums(grid), sums(region), (math.inf, 0.0, 0.0, 0.0)
    for k in range(places.shape[1]):
        x, y = places[0, k], places[1, k]
        if abs(x - 0.5) + half_width > 0.5 - edge or abs(y - 0.5) + half_height > 0.5 - edge:
            continue
        if mean(of_region, x, y, half_width, half_height) <= 0.999:
            continue
        covered = mean(total, x, y, half_width, half_height)
        cost = covered + pull * math.hypot(1.0 - x, 1.0 - y)
        if cost < found[0]:
            found = (cost, covered, x, y)
    return found


def compile_labels() -> None:
    """Compile the kernels that place labels, or load them."""
    grid, points = np.zeros((2, 2)), np.zeros((2, 2))
    mark(grid, sample_curve(*points, 2), 0.0)
    fill(grid, points)
    best_label(grid, grid, points, 0.1, 0.1, 0.0, 0.0)
