"""The rotation number of the Suslov–Hess torus over its parameters, and the open problem."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.charted import Charts, of_torus
from hess_explorer.scenes.framework.hess_case import map_or_none, possible_f
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.framework.sliders import accuracy_level, choice, number, parameter, places
from hess_explorer.scenes.framework.trial import COLOUR_UNIT, Trial, boundary_error, colour_error, curve_error
from hess_explorer.scenes.framework.windows import Window, boxed, inside, tidy_window, window_of
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, CellGrid
from hess_explorer.views.maps import circle_map as circle
from hess_explorer.views.maps import rotation_line, rotation_plane
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, superscript
from hess_mechanics import parameters as known
from hess_mechanics.numerics.accuracy import REFERENCE, Kind, Level, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess import rotation_number as mechanics
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.rotation_number import (
    PLANES,
    ParameterLine,
    PeriodicTorus,
    Torus,
    TorusValues,
    possible_part,
)

_COARSE, _FINE = (75, 50), (300, 200)
_ROWS = 25  # of the fine map in one task
_ON_LINE = 400
_ON_CURVE = 48  # points of the boundary of the lock zone
_RATIONALS = ("−1/2", "−1/3", "−1/4", "−2/5", "−1/5", "−3/7", "−1/6")
_FULL = {"h": (-1.0, 4.0), "f": (-3.0, 3.0), "a": (0.0, 2.0)}
_AT_MOST = {"h": (-1.0, 1e6), "f": (-1e4, 1e4), "a": (-100.0, 100.0)}
_ITERATES = 40


def _corners(plane: str, ranges: Mapping[str, tuple[float, float]]) -> Window:
    """Return the lower left and upper right corners of the map over a plane."""
    x, y = (ranges[name] for name in plane.split(", "))
    return (x[0], y[0]), (x[1], y[1])


def _window(plane: str) -> Any:
    return places(f"The window of the map over {plane}", 2, *_corners(plane, _AT_MOST))


PRESETS = (
    Preset("One plateau, and no ladder", over="h, f", line="f"),
    Preset("Along h", over="h, f", line="h", f=0.6),
    Preset("Along a, to the boundary of the plateau", over="h, a", line="a", h=0.5, f=0.6),
    Preset(
        "A closer look at ρ = −1/3", over="h, f", line="f", part_hf="0.1,0.4;0.3,0.6", rational="−1/3", h=0.25, f=0.45
    ),
    Preset("Euler–Poisson, figure 11", over="h, f", line="h", h=5.01253, f=2.0025, part_hf="-1,-4;8,4"),
)


@dataclass(frozen=True)
class RotationNumber(State):
    """One torus, a map of ρ over two parameters, and a line through the torus along one parameter."""

    a: float = parameter(known.A_HESS, bounds=_AT_MOST["a"])  # the range of the map
    h: float = parameter(known.H_HESS, 0.5, step=0.005)
    f: float = parameter(known.F_HESS, 0.8, step=0.005, doc="Area integral in units b = 1.")
    over: str = choice("Map over", PLANES, "h, f", group="State", doc="Two parameters of the map; the third is fixed.")
    line: str = choice(
        "Line along", ("f", "h", "a"), "f", group="State", doc="Parameter along which ρ and the trace are drawn."
    )
    rational: str = choice(
        "Rational number",
        _RATIONALS,
        "−1/4",
        group="State",
        doc="Rotation number to find on the line, with the number of cycles of its torus.",
    )
    epsilon: float = number(
        "ε",
        0.25,
        (0.0, 0.3),
        0.005,
        bounds=(0.0, 0.33),
        label="Away from Möbius, ε",
        doc="The other family: Θ(φ + ε sin 3φ). It is not a Möbius map: its ρ locks at many rational numbers.",
    )
    accuracy: str = accuracy_level()
    # One window for each map.
    part_hf: str = _window("h, f")
    part_ha: str = _window("h, a")
    part_fa: str = _window("f, a")

    def admitted(self, notes: list[str]) -> RotationNumber:
        """Clamp f to the region of this h, and repair the windows."""
        return replace(
            self,
            f=possible_f(self.h, self.f, notes),
            part_hf=tidy_window(self.part_hf),
            part_ha=tidy_window(self.part_ha),
            part_fa=tidy_window(self.part_fa),
        )

    @property
    def torus(self) -> Torus:
        """The torus on show."""
        return Torus(self.a, self.h, self.f)

    @property
    def sides(self) -> tuple[str, str]:
        """The parameters on the axes of the map, the horizontal one first."""
        across, up = self.over.split(", ")
        return across, up

    @property
    def place(self) -> tuple[float, float]:
        """The coordinates of the torus in the plane of the map."""
        across, up = (vars(self.torus)[name] for name in self.sides)
        return across, up

    @property
    def part(self) -> str:
        """The name of the parameter that holds the window of this map."""
        return "part_" + "".join(self.sides)

    @cached_property
    def window(self) -> Window:
        """The ranges of the horizontal and the vertical axis of the map."""
        (x0, y0), (x1, y1) = window_of(getattr(self, self.part), _corners(self.over, _FULL))
        return (x0, x1), (y0, y1)

    @property
    def beside(self) -> Torus:
        """The torus with the map's own parameters set to 0: a cache key that is constant within the plane."""
        return self.torus.at(**dict.fromkeys(self.sides, 0.0))

    @cached_property
    def grid(self) -> tuple[TorusValues, tuple[int, int]]:
        """The map and its cells (m, n), coarse first."""
        common = (self.over, self.beside, self.window)
        plan = self.plan(Kind.GRID)
        fine = plan.grid(_FINE)
        parts = [
            (
                None
                if self.work.dragging
                else self.work.need(
                    Task(mechanics.rows, *common, fine, first, min(first + _ROWS, fine[1]), plan.level), preview=None
                )
            )
            for first in range(0, fine[1], _ROWS)
        ]
        known = [part for part in parts if part is not None]
        if len(known) == len(parts):
            return mechanics.together(known), fine
        return self.work.need(Task(mechanics.rows, *common, _COARSE, 0, _COARSE[1], plan.level)), _COARSE

    @cached_property
    def grids(self) -> tuple[CellGrid, CellGrid]:
        """ρ and the zones over the window."""
        return rotation_plane.grids(*self.grid, *self.window)

    def lock(self, plan: Plan) -> tuple[str, Torus, tuple[float, float, float, float], Level, int]:
        """Return the arguments of `lock_curve`, which computes |t| = 2 in the map, (n, 2)."""
        return self.over, self.beside, (*self.window[0], *self.window[1]), plan.level, plan.side(_ON_CURVE)

    @cached_property
    def boundary(self) -> list[Array]:
        """Return |t| = 2 in the map, once known."""
        found = (
            None
            if self.work.dragging
            else self.work.need(Task(mechanics.lock_curve, *self.lock(self.plan(Kind.CURVE))), preview=None)
        )
        if found is None or not len(found):
            return []
        return [found, found * np.array([1.0, -1.0])] if self.sides[1] == "f" else [found]

    @cached_property
    def on_line(self) -> ParameterLine:
        """The tori on the line, within the window of the map if the line lies in its plane."""
        low, high = dict(zip(self.sides, self.window, strict=True)).get(self.line, _FULL[self.line])
        # The line's own parameter is set to 0, so the cache key is constant along the line.
        return possible_part(ParameterLine(self.line, self.torus.at(**{self.line: 0.0}), low, high))

    @property
    def x(self) -> Array:
        """Values of the line's parameter (n,)."""
        return self.on_line.places(_ON_LINE // 4 if self.dragging else self.plan(Kind.LINE).side(_ON_LINE))

    @cached_property
    def along(self) -> TorusValues:
        """ρ and trace at `x`."""
        return self.work.need(Task(mechanics.along, self.on_line, self.x.size, self.plan(Kind.LINE).level))

    @cached_property
    def perturbed(self) -> Array | None:
        """ρ of the other family at `x`, once known; NaN where there is no torus."""
        plan = self.plan(Kind.LINE)
        return (
            None
            if self.work.dragging
            else self.work.need(
                Task(
                    mechanics.perturbed_along,
                    self.on_line,
                    self.x.size,
                    self.epsilon,
                    plan.level,
                    plan.part(mechanics.TURNS),
                ),
                preview=None,
            )
        )

    @property
    def sought(self) -> Fraction:
        """The rational number to find on the line; its sign changes for f < 0, where ρ is positive."""
        rho = Fraction(self.rational.replace("−", "-"))
        return -rho if self.line != "f" and self.f < 0.0 else rho

    @cached_property
    def periodic(self) -> PeriodicTorus | None:
        """The torus on the line with the rational ρ; None if there is none or it is not known yet."""
        found = None if self.work.dragging else self.work.need(Task(_periodic, self.sought, self.on_line), preview=None)
        return None if found is None else found[0]

    @cached_property
    def map(self) -> CircleMap | None:
        """The circle map of the torus on show; None on the separatrix."""
        return map_or_none(self.work, self.a, self.h, self.f, self.level)

    # ---- what the pictures show --------------------------------------------------------------------------------

    def here(self) -> list[tuple[float, float]]:
        """Return the torus on show if the window of the map contains it."""
        (x0, x1), (y0, y1) = self.window
        return inside([self.place], ((x0, y0), (x1, y1)))

    def line_in_map(self) -> list[Array]:
        """Return the line through the torus within the map."""
        (x, y), (across, up) = self.place, self.sides
        return rotation_plane.across(
            *self.window, y=y if self.line == across else None, x=x if self.line == up else None
        )

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_line(self) -> Caption:
        rho = str(self.sought).replace("-", "−")
        if self.periodic is not None:
            place = digits(self.on_line.place(self.periodic.torus))
            difference = f"|Θ{superscript(self.sought.denominator)} − id|"
            defect = digits(self.periodic.defect, 1)
            return Caption(
                "All orbits of this torus are periodic.",
                f"ρ = {rho} at {self.line} = {place}: {difference} ≤ {defect}.",
            )
        return Caption("ρ locks at 0 only." if self.perturbed is None else f"No torus with ρ = {rho} is seen here.")

    def _about_circle(self) -> Caption:
        if self.map is None:
            return Caption("Separatrix: no return.")
        return Caption(
            f"{self.map.kind.capitalize()}: {circle.cycles(self.map)}.",
            f"a = {digits(self.a)}, h = {digits(self.h)}, f = {digits(self.f)}; "
            f"ρ = {digits(self.map.rotation_number)}.",
        )

    def derived(self) -> Iterator[str]:
        """Yield the circle map and the ladder of the other family."""
        if self.map is not None:
            yield circle.riccati_matrix(self.map)
            yield f"|trace| = {digits(self.map.trace, 6)}, ρ = {digits(self.map.rotation_number)}"
            if self.map.fixed_points:
                yield "multipliers " + ", ".join(digits(point.multiplier) for point in self.map.fixed_points)
        perturbed = self.known("perturbed")
        if perturbed is not None:
            steps = ", ".join(map(str, mechanics.plateaus(perturbed, self.along.possible)[:8]))
            yield f"plateaus of Θ(φ + ε sin 3φ): {steps.replace('-', '−') or 'none seen'}"

    def status(self) -> Iterator[str]:
        """Yield the status of the map and of the circle map."""
        if self.known("grid"):
            m, n = self.grid[1]
            level = self.plan(Kind.GRID).level
            error = (
                None
                if self.work.dragging
                else self.work.need(
                    Task(mechanics.rows_error, self.over, self.beside, self.window, level), preview=None
                )
            )
            yield f"map {m} × {n}" + (f", ρ to {error:.1e} (99 of 100 cells)" if error is not None else "")
        if self.map is not None:
            yield f"{self.map.level}: circle map error ≤ {self.map.error_estimate:.1e} ({self.map.status})"


def _periodic(rho: Fraction, line: ParameterLine) -> tuple[PeriodicTorus | None]:
    """Return the periodic torus in a tuple, as a bare None means "not known yet"."""
    return (mechanics.periodic_torus(rho, line, REFERENCE),)


# ---- what each level costs --------------------------------------------------------------------------------------


def _line(s: RotationNumber, plan: Plan) -> Array:
    """Return ρ of the tori on the line and of the other family."""
    places = plan.side(_ON_LINE)
    values = mechanics.along(s.on_line, places, plan.level)
    perturbed = mechanics.perturbed_along(s.on_line, places, s.epsilon, plan.level, plan.part(mechanics.TURNS))
    return np.stack([np.where(values.possible, values.rho, np.nan), perturbed])


def _line_error(s: RotationNumber, found: Array, exact: Array) -> float:
    there = np.isfinite(found) & np.isfinite(exact)
    low, high = rotation_line.RHO
    return curve_error(found[there], exact[there], high - low, period=1.0) if there.any() else math.nan


def _map(s: RotationNumber, plan: Plan) -> TorusValues:
    m, n = plan.grid(_FINE)
    return mechanics.rows(s.over, s.beside, s.window, (m, n), 0, n, plan.level)


_MEASURES: tuple[Trial[RotationNumber], ...] = (
    Trial(
        Kind.GRID,
        ("map",),
        _map,
        lambda s, found, truth: colour_error(found.rho[found.possible], truth.rho[found.possible]),
        COLOUR_UNIT,
        "cells",
    ),
    Trial(
        Kind.LINE,
        ("line", "trace"),
        _line,
        _line_error,
        alike="cells",
    ),
    Trial(
        Kind.CURVE,
        ("map",),
        lambda s, plan: mechanics.lock_curve(*s.lock(plan)),
        lambda s, found, truth: boundary_error(found, truth, Axes(*s.window)),
    ),
)

SCENE = Scene(
    RotationNumber,
    __file__,
    place=8,
    presets=PRESETS,
    measures=_MEASURES,
    charts=Charts(of_torus(lambda s: (s.a, s.h, s.f)), over=("h", "f")),
    group="Heavy body",
    essential=("a", "h", "f"),
    title="Rotation number",
    summary="Is ρ of the Suslov–Hess torus a ladder, as the paper asks? It has one plateau; another family has many.",
    views=(
        Plot(
            name="map",
            title=lambda s: f"Rotation number ρ over ({s.over})",
            axes=lambda s: s.sides,
            caption=lambda s: Caption("ρ locks at 0 only."),
            x=lambda s: s.window[0],
            y=lambda s: s.window[1],
            on_click=lambda s, x, y: {s.sides[0]: x, s.sides[1]: y},
            on_box=lambda s, corners: boxed(corners, _corners(s.over, _AT_MOST), s.part),
            layers=rotation_plane.layers(
                grids=lambda s: s.grids,
                boundary=lambda s: s.boundary,
                across=RotationNumber.line_in_map,
                impossible=lambda s: rotation_plane.outside(s.over, s.torus, *s.window),
                edges=lambda s: rotation_plane.edges(s.over, s.torus, *s.window),
                here=RotationNumber.here,
            ),
        ),
        Plot(
            name="line",
            title=lambda s: f"ρ along {s.line}",
            caption=RotationNumber._about_line,
            axes=lambda s: (s.line, "ρ"),
            x=lambda s: s.on_line.ends,
            y=rotation_line.RHO,
            on_click=lambda s, x, y: {s.line: x},
            layers=rotation_line.rho_layers(
                line=lambda s: s.on_line,
                values=lambda s: s.along,
                perturbed=lambda s: s.perturbed,
                rational=lambda s: None if s.periodic is None else float(s.sought),
                place=lambda s: s.on_line.place(s.torus),
            ),
        ),
        Plot(
            name="trace",
            title=lambda s: f"|trace| along {s.line}",
            axes=lambda s: (s.line, "|trace|"),
            caption=lambda s: Caption("Below 2: no cycle. Above: two cycles.", "Elliptic below 2, hyperbolic above."),
            x=lambda s: s.on_line.ends,
            y=rotation_line.TRACE,
            on_click=lambda s, x, y: {s.line: x},
            layers=rotation_line.trace_layers(
                line=lambda s: s.on_line, values=lambda s: s.along, place=lambda s: s.on_line.place(s.torus)
            ),
        ),
        circle.picture(
            map=lambda s: s.map,
            caption=RotationNumber._about_circle,
            iterates=lambda s: None if s.map is None else s.map.iterate(0.5, _ITERATES),
        ),
    ),
)
