"""The rotation number of the Suslov–Hess torus over its parameters, and an open problem of the paper."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, torus_charts
from hess_explorer.scenes.framework.hess_case import CYCLES_MERGE, map_or_none, possible_f
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.framework.sliders import accuracy_level, choice, number, parameter
from hess_explorer.scenes.framework.trial import COLOUR_UNIT, Trial, boundary_error, colour_error, curve_error
from hess_explorer.scenes.framework.windows import normalized_window
from hess_explorer.scenes.parts.diagrams.rotation_map import BOUNDS, FULL, RotationMap, rotation_map, window_over
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes
from hess_explorer.views.maps import circle_map as circle
from hess_explorer.views.maps import rotation_line
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, superscript
from hess_mechanics import parameters as known
from hess_mechanics.numerics.accuracy import REFERENCE, Kind, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess import rotation_number as mechanics
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.rotation_number import (
    PLANES,
    ParameterLine,
    PeriodicTorus,
    Torus,
    possible_part,
)

_ON_LINE = 400
_RATIONALS = ("−1/2", "−1/3", "−1/4", "−2/5", "−1/5", "−3/7", "−1/6")
_ITERATES = 40


PRESETS = (
    Preset("One plateau, no devil's staircase", over="h, f", line="f"),
    Preset("Along h", over="h, f", line="h", f=0.6),
    Preset("Along a, to the boundary of the plateau", over="h, a", line="a", h=0.5, f=0.6),
    Preset(
        "A closer look at ρ = −1/3", over="h, f", line="f", part_hf="0.1,0.4;0.3,0.6", rational="−1/3", h=0.25, f=0.45
    ),
    Preset("Euler–Poisson, figure 11", over="h, f", line="h", h=5.01253, f=2.0025, part_hf="-1,-4;8,4"),
)


@dataclass(frozen=True)
class RotationNumber(State):
    """A torus, a map of ρ over two parameters, and a line through the torus along one parameter."""

    a: float = parameter(known.A_HESS, bounds=BOUNDS["a"])  # Range of the map.
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
        doc="Rational rotation number of the torus to find on the line.",
    )
    epsilon: float = number(
        "ε",
        0.25,
        (0.0, 0.3),
        0.005,
        bounds=(0.0, 0.33),
        label="Perturbation ε of the other family",
        doc="Parameter of the other family Θ(φ + ε sin 3φ), which is not Möbius: its ρ locks at many rational numbers.",
    )
    accuracy: str = accuracy_level()
    # Each map has its own window.
    part_hf: str = window_over("h, f")
    part_ha: str = window_over("h, a")
    part_fa: str = window_over("f, a")

    def valid_state(self, notes: list[str]) -> RotationNumber:
        """Return the state with f clamped to the region of this h and valid windows; append notes."""
        return replace(
            self,
            f=possible_f(self.h, self.f, notes),
            part_hf=normalized_window(self.part_hf),
            part_ha=normalized_window(self.part_ha),
            part_fa=normalized_window(self.part_fa),
        )

    @property
    def torus(self) -> Torus:
        """The torus (a, h, f)."""
        return Torus(self.a, self.h, self.f)

    @part
    def rho(self) -> RotationMap:
        """The rotation number over two parameters."""
        window = getattr(self, "part_" + self.over.replace(", ", ""))
        return RotationMap(self, self.over, self.torus, self.line, window)

    @cached_property
    def parameter_line(self) -> ParameterLine:
        """The tori on the line, within the window of the map if the line lies in its plane."""
        low, high = dict(zip(self.rho.sides, self.rho.window, strict=True)).get(self.line, FULL[self.line])
        # Set the line's own parameter to 0, so that the cache key is constant along the line.
        return possible_part(ParameterLine(self.line, self.torus.with_values(**{self.line: 0.0}), low, high))

    @cached_property
    def tori(self) -> rotation_line.Tori:
        """ρ and trace of tori on the line."""
        count = _ON_LINE // 4 if self.is_preview else self.plan(Kind.LINE).side(_ON_LINE)
        values = self.work.need(Task(mechanics.values_along, self.parameter_line, count, self.plan(Kind.LINE).level))
        return rotation_line.Tori(self.parameter_line.values(count), values, self.parameter_line.value_of(self.torus))

    @cached_property
    def other_family(self) -> Array | None:
        """ρ of the other family at the same parameters, NaN without a torus; None until known."""
        plan, count = self.plan(Kind.LINE), self.tori.x.size
        turns = plan.part(mechanics.TURNS)
        task = Task(mechanics.perturbations_along, self.parameter_line, count, self.epsilon, plan.level, turns)
        return None if self.is_preview else self.work.need(task, preview=None)

    @property
    def target(self) -> Fraction:
        """The rational rotation number to find on the line; for f < 0 positive, like ρ, unless the line is along f."""
        rho = Fraction(self.rational.replace("−", "-"))
        return -rho if self.line != "f" and self.f < 0.0 else rho

    @cached_property
    def _search(self) -> tuple[PeriodicTorus | None] | None:
        task = Task(_periodic, self.target, self.parameter_line)
        return None if self.work.is_preview else self.work.need(task, preview=None)

    @property
    def periodic(self) -> PeriodicTorus | None:
        """The torus on the line with the rational ρ; None without such a torus and until known."""
        return None if self._search is None else self._search[0]

    @cached_property
    def map(self) -> CircleMap | None:
        """The circle map of the torus; None on the separatrix."""
        return map_or_none(self.work, self.a, self.h, self.f, self.level)

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_line(self) -> Caption:
        rho = str(self.target).replace("-", "−")
        if self.periodic is not None:
            value = digits(self.parameter_line.value_of(self.periodic.torus))
            difference = f"|Θ{superscript(self.target.denominator)} − id|"
            defect = digits(self.periodic.defect, 1)
            return Caption(
                "All orbits of this torus are periodic.",
                f"ρ = {rho} at {self.line} = {value}: {difference} ≤ {defect}.",
            )
        return Caption(
            "ρ locks only at integers, here at 0." if self._search is None else f"No torus with ρ = {rho} found here."
        )

    def _about_circle(self) -> Caption:
        if self.map is None:
            return Caption("Separatrix: no return.")
        return Caption(
            f"{self.map.kind.capitalize()}: {circle.cycles(self.map)}.",
            f"a = {digits(self.a)}, h = {digits(self.h)}, f = {digits(self.f)}; "
            f"ρ = {digits(self.map.rotation_number)}.",
        )

    def quantities(self) -> Iterator[str]:
        """Yield trace and ρ of the circle map, and the devil's staircase of the other family."""
        if self.map is not None:
            yield circle.riccati_matrix(self.map)
            yield f"|trace| = {digits(self.map.trace, 6)}, ρ = {digits(self.map.rotation_number)}"
            if self.map.fixed_points:
                yield "multipliers " + ", ".join(digits(point.multiplier) for point in self.map.fixed_points)
        other_family = self.peek("other_family")
        if other_family is not None:
            steps = ", ".join(map(str, mechanics.plateaus(other_family, self.tori.values.possible)[:8]))
            yield f"plateaus of Θ(φ + ε sin 3φ): {steps.replace('-', '−') or 'none seen'}"

    def status(self) -> Iterator[str]:
        """Yield the status of the map and of the circle map."""
        yield from super().status()
        if self.map is not None:
            yield f"{self.map.level}: circle map error ≤ {self.map.error_estimate:.1e} ({self.map.status})"


def _periodic(rho: Fraction, line: ParameterLine) -> tuple[PeriodicTorus | None]:
    """Return the periodic torus in a tuple, because a bare None means "not known yet"."""
    return (mechanics.periodic_torus(rho, line, REFERENCE),)


# ---- cost of each level ------------------------------------------------------------------------------------------


def _line(s: RotationNumber, plan: Plan) -> Array:
    """Return ρ of the tori on the line and of the other family."""
    count = plan.side(_ON_LINE)
    values = mechanics.values_along(s.parameter_line, count, plan.level)
    other_family = mechanics.perturbations_along(
        s.parameter_line, count, s.epsilon, plan.level, plan.part(mechanics.TURNS)
    )
    return np.stack([np.where(values.possible, values.rho, np.nan), other_family])


def _line_error(s: RotationNumber, values: Array, exact: Array) -> float:
    there = np.isfinite(values) & np.isfinite(exact)
    low, high = rotation_line.RHO
    return curve_error(values[there], exact[there], high - low, period=1.0) if there.any() else math.nan


_MEASURES: tuple[Trial[RotationNumber], ...] = (
    Trial(
        Kind.GRID,
        ("map",),
        lambda s, plan: s.rho.rows(plan).compute(),
        lambda s, found, truth: colour_error(found.rho[found.possible], truth.rho[found.possible]),
        COLOUR_UNIT,
        "cells",
    ),
    Trial(
        Kind.LINE,
        ("line", "trace"),
        _line,
        _line_error,
        shared_setting="cells",
    ),
    Trial(
        Kind.CURVE,
        ("map",),
        lambda s, plan: s.rho.tongue_boundary(plan).compute(),
        lambda s, found, truth: boundary_error(found, truth, Axes(*s.rho.window)),
    ),
)

SCENE = Scene(
    RotationNumber,
    __file__,
    place=8,
    presets=PRESETS,
    level_trials=_MEASURES,
    charts=Charts(torus_charts(lambda s: (s.a, s.h, s.f)), over=("h", "f")),
    group="Heavy body",
    essential=("a", "h", "f"),
    answers=(
        Answer("On the separatrix nothing returns: there is no rotation number.", lambda s: s.map is None),
        Answer(
            "Locked: two loops exist, and the rotation number stays an integer.",
            lambda s: s.map is not None and s.map.kind == "hyperbolic",
        ),
        CYCLES_MERGE,
        Answer("Not locked: the body winds on, and its rotation number changes smoothly."),
    ),
    title="Rotation number",
    summary="Is ρ of the Suslov–Hess torus a devil's staircase? It has one plateau; another family has many.",
    views=(
        rotation_map(lambda s: s.rho),
        Plot(
            name="line",
            title=lambda s: f"ρ along {s.line}",
            caption=RotationNumber._about_line,
            axes=lambda s: (s.line, "ρ"),
            x=lambda s: s.parameter_line.ends,
            y=rotation_line.RHO,
            on_click=lambda s, x, y: {s.line: x},
            layers=rotation_line.rho_layers(
                lambda s: s.tori,
                lambda s: s.other_family,
                lambda s: [] if s.periodic is None else [float(s.target)],
            ),
        ),
        Plot(
            name="trace",
            title=lambda s: f"|trace| along {s.line}",
            axes=lambda s: (s.line, "|trace|"),
            caption=lambda s: Caption("Below 2: no limit cycle. Above: two.", "Elliptic below 2, hyperbolic above."),
            x=lambda s: s.parameter_line.ends,
            y=rotation_line.TRACE,
            on_click=lambda s, x, y: {s.line: x},
            layers=rotation_line.trace_layers(lambda s: s.tori),
        ),
        circle.picture(
            map=lambda s: s.map,
            caption=RotationNumber._about_circle,
            iterates=lambda s: None if s.map is None else s.map.iterate(0.5, _ITERATES),
        ),
    ),
)
