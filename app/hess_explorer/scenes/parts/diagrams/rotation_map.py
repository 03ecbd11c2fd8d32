"""The rotation number of the Suslov–Hess torus over two of its parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.sliders import points
from hess_explorer.scenes.framework.windows import Window, box_window, window_of
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import (
    TURNS,
    Axes,
    CellGrid,
    Range,
    Regions,
    Sign,
    crop,
    curves,
    image,
    rectangle,
    region,
    target,
)
from hess_explorer.views.maps.bifurcation_diagram import impossible
from hess_explorer.views.picture import Corners
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.accuracy import Kind, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess import rotation_number as mechanics
from hess_mechanics.suslov_hess.bifurcation import f_max_of_energies
from hess_mechanics.suslov_hess.rotation_number import Torus, TorusValues

_COARSE, _FINE = (75, 50), (300, 200)
_ROWS = 25  # Rows of the fine map per task.
_ON_CURVE = 48  # Points of the boundary of the Arnold tongue.
_ON_EDGE = 300
FULL = {"h": (-1.0, 4.0), "f": (-3.0, 3.0), "a": (0.0, 2.0)}
BOUNDS = {"h": (-1.0, 1e6), "f": (-1e4, 1e4), "a": (-100.0, 100.0)}


def _corners(plane: str, ranges: Mapping[str, Range]) -> Window:
    """Return the lower left and upper right corners of the map over a plane."""
    x, y = (ranges[name] for name in plane.split(", "))
    return (x[0], y[0]), (x[1], y[1])


def window_over(plane: str) -> Any:
    """Declare the window of the map over a plane."""
    return points(f"The window of the map over {plane}", 2, *_corners(plane, BOUNDS))


@dataclass(frozen=True, eq=False)
class RotationMap(Part[Host]):
    """The rotation number over two parameters of a torus, with coarse cells first.

    Attributes
    ----------
    plane : str
        The two parameters, one of `PLANES`.
    torus : Torus
        The current torus.
    line : str
        Parameter that changes along the line through the torus.
    text : str
        The window as text of a link; empty for the full map.
    """

    plane: str
    torus: Torus
    line: str
    text: str

    @property
    def sides(self) -> tuple[str, str]:
        """The parameters on the axes, the horizontal one first."""
        across, up = self.plane.split(", ")
        return across, up

    @cached_property
    def window(self) -> tuple[Range, Range]:
        """The ranges of the horizontal and the vertical axis."""
        (x0, y0), (x1, y1) = window_of(self.text, _corners(self.plane, FULL))
        return (x0, x1), (y0, y1)

    @property
    def _beside(self) -> Torus:
        """The torus with both parameters of the map set to 0, as a cache key."""
        return self.torus.with_values(**dict.fromkeys(self.sides, 0.0))

    def rows(self, plan: Plan, part: slice = slice(None)) -> Task[TorusValues]:
        """Return the task of some rows of the fine map, by default all."""
        cells = plan.grid(_FINE)
        first, last, _ = part.indices(cells[1])
        return Task(mechanics.rows, self.plane, self._beside, self.window, cells, first, last, plan.level)

    @cached_property
    def grid(self) -> tuple[TorusValues, tuple[int, int]]:
        """Values of the map and its size (m, n) in cells; a coarse map until the fine one is known."""
        plan = self.work.plan(Kind.GRID)
        fine = plan.grid(_FINE)
        if not self.work.is_preview:
            parts = [
                self.work.need(self.rows(plan, slice(first, first + _ROWS)), preview=None)
                for first in range(0, fine[1], _ROWS)
            ]
            known = [part for part in parts if part is not None]
            if len(known) == len(parts):
                return mechanics.concatenate(known), fine
        coarse = Task(mechanics.rows, self.plane, self._beside, self.window, _COARSE, 0, _COARSE[1], plan.level)
        return self.work.need(coarse), _COARSE

    @cached_property
    def _grids(self) -> tuple[CellGrid, CellGrid]:
        """ρ and ln(|t|/2) over the window; the latter is positive in Arnold tongues.

        Cells without a torus repeat the nearest one, so that both can be interpolated up to the edge.
        """
        from scipy.ndimage import distance_transform_edt  # Imported here because the import is slow.

        values, (m, n) = self.grid
        outside = ~values.possible.reshape(n, m)
        nearest = tuple(distance_transform_edt(outside, return_distances=False, return_indices=True))
        with np.errstate(divide="ignore", invalid="ignore"):
            height = np.clip(np.log(0.5 * values.trace), -1.0, 1.0)
        rho, zones = (
            CellGrid(np.zeros((n, m)) if outside.all() else one.reshape(n, m)[nearest], *self.window)
            for one in (values.rho, height)
        )
        return rho, zones

    def tongue_boundary(self, plan: Plan) -> Task[Array]:
        """Return the task of the boundary |t| = 2 of the Arnold tongue in the map, points (n, 2)."""
        window = *self.window[0], *self.window[1]
        return Task(mechanics.tongue_curve, self.plane, self._beside, window, plan.level, plan.side(_ON_CURVE))

    def _boundary(self) -> list[Array]:
        """Return the curve |t| = 2 in the map; empty until known."""
        if self.work.is_preview:
            return []
        found = self.work.need(self.tongue_boundary(self.work.plan(Kind.CURVE)), preview=None)
        if found is None or not len(found):
            return []
        return [found, found * np.array([1.0, -1.0])] if self.sides[1] == "f" else [found]

    @property
    def _point(self) -> tuple[float, float]:
        """The coordinates of the torus in the plane."""
        across, up = (vars(self.torus)[name] for name in self.sides)
        return across, up

    def _here(self) -> list[tuple[float, float]]:
        """Return the point of the current torus if the window contains it."""
        (x0, x1), (y0, y1) = self.window
        return crop([self._point], ((x0, y0), (x1, y1)))

    def _across(self) -> list[Array]:
        """Return the part of the line in the window, if it lies in the plane."""
        if self.line not in self.sides:
            return []
        fixed = 1 - self.sides.index(self.line)
        at, (low, high) = self._point[fixed], self.window[fixed]
        ends = np.array([[one, at] for one in self.window[1 - fixed]])
        return [ends if fixed else ends[:, ::-1]] if low <= at <= high else []

    @cached_property
    def _upper(self) -> Array:
        """The bifurcation curve (n, 2) with f ≥ 0 within the window; it is independent of a."""
        low, high = self.window[0]
        energies = np.linspace(max(low, -1.0), high, _ON_EDGE)
        return np.column_stack([energies, f_max_of_energies(energies)])

    def _edges(self) -> list[Array]:
        """Return the boundary curves (n, 2) of the possible tori."""
        (x0, x1), y = self.window
        if self.plane == "h, f":
            return [self._upper, self._upper * (1.0, -1.0)] if x1 > -1.0 else []
        return [np.array([[end, one] for one in y]) for end in self.torus.range_of(self.plane[0]) if x0 < end < x1]

    def _impossible(self) -> Regions:
        """Return the forbidden region of the window."""
        (x0, x1), (y0, y1) = x, y = self.window
        if self.plane == "h, f":
            return impossible(self._upper, Axes(x, (min(y0, -y1), max(y1, -y0)))) if x1 > -1.0 else [[rectangle(x, y)]]
        first, last = self.torus.range_of(self.plane[0])
        parts = [(x0, min(x1, first)), (max(x0, last), x1)]
        return [[rectangle(part, y)] for part in parts if part[0] < part[1]]

    def choose(self, x: float, y: float) -> Values:
        """Return the parameters of the torus at a point of the map."""
        return dict(zip(self.sides, (x, y), strict=True))

    def box_window(self, corners: Corners) -> Values:
        """Return the window that a box selects; empty for a box without area."""
        return box_window(corners, _corners(self.plane, BOUNDS), "part_" + "".join(self.sides))

    def status(self) -> Iterator[str]:
        """Yield the size of the map, and its error once known."""
        if self.has_result("grid"):
            m, n = self.grid[1]
            task = Task(mechanics.rows_error, self.plane, self._beside, self.window, self.work.plan(Kind.GRID).level)
            error = None if self.work.is_preview else self.work.need(task, preview=None)
            yield f"map {m} × {n}" + (f", error of ρ ≤ {error:.1e} in 99 % of the cells" if error is not None else "")


rotation_map = Plot[RotationMap](
    name="map",
    title=lambda s: f"Rotation number ρ over ({s.plane})",
    axes=lambda s: s.sides,
    caption=lambda s: Caption("ρ locks only at integers, here at 0."),
    x=lambda s: s.window[0],
    y=lambda s: s.window[1],
    on_click=RotationMap.choose,
    on_box=RotationMap.box_window,
    layers=(
        image("rho", lambda s: s._grids[0], palette=theme.TURN_MAP, low=-0.5, high=0.5, cyclic=True, legend=(TURNS,)),
        image(
            "zones",
            lambda s: s._grids[1],
            palette=(theme.LOCKED + "00", theme.LOCKED),
            low=-1.0,
            high=1.0,
            smooth=True,
            legend=(Sign("locked, two limit cycles", "box", f"background: {theme.LOCKED}"),),
        ),
        curves(
            "boundary",
            RotationMap._boundary,
            is_overlay=False,
            color=theme.INK,
            label="boundary of the Arnold tongue, |trace| = 2",
        ),
        region("forbidden", RotationMap._impossible, label="impossible", tag="impossible"),
        curves("edge", RotationMap._edges, is_overlay=False, color=theme.INK, width=1.5),
        curves("across-under", RotationMap._across, color=theme.PAPER, width=4, alpha=0.7),
        curves("across", RotationMap._across, color=theme.INK, dash="dashed", label="line of ρ", tag="line of ρ"),
        *target("here", RotationMap._here),
    ),
).of
"""The picture of the map."""
