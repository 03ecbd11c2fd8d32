"""Speed and accuracy of the motion on show in another scene: errors, drift and cost, measured here and now."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.costs import Costs, difference_picture, trade_picture
from hess_explorer.scenes.framework.looking_into import LookingInto
from hess_explorer.scenes.framework.scene import Motion, Scene
from hess_explorer.views.chart import POWERS, clipped, limit
from hess_explorer.views.layers import Columns, column, ring
from hess_explorer.views.levels import curves_of_levels, integrals, methods
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics import work_precision as mechanics
from hess_mechanics.numerics.accuracy import LEVELS, level
from hess_mechanics.numerics.results import Array

__all__ = ["looking_into"]

SAMPLES = 400
_FLOOR, _PIXEL_FLOOR = 1e-17, 1e-14


@dataclass(frozen=True)
class Study(Costs):
    """What is measured of a motion, at every level of accuracy."""

    @cached_property
    def followed(self) -> Motion:
        """The motion, as far as it is measured.  Raises `ModelError`."""
        motion = self.shown_motion
        return replace(motion, span=min(motion.span, mechanics.longest_span(*motion.named[:3])))

    @cached_property
    def measured(self) -> tuple[mechanics.WorkPoint, ...]:
        """Error and cost of every level, and of SciPy's methods where they do not take long."""
        others = () if self.dragging or mechanics.others_take_long(*self.followed.named) else self.work.get(
            mechanics.measure_others, *self.followed.named, SAMPLES)
        return self.work.get(mechanics.measure_levels, *self.followed.named, SAMPLES) + others

    @cached_property
    def growing(self) -> mechanics.ErrorGrowth:
        """Errors and drifts over time."""
        return self.work.get(mechanics.growth, *self.followed.named, self.followed.weights, SAMPLES)

    @cached_property
    def times(self) -> Array:
        """At which errors are measured, (n,), in the units of the scene."""
        return self.growing.times * self.followed.unit

    @property
    def _here(self) -> mechanics.WorkPoint:
        return next(point for point in self.measured if point.setting == self.chosen)

    @property
    def _drifts(self) -> Mapping[str, Array]:
        return self.growing.drifts[self.chosen]

    def of_method(self, method: str) -> tuple[Array, Array]:
        """Errors and milliseconds of one method."""
        own = [point for point in self.measured if point.method == method]
        return clipped(np.array([point.error for point in own]), _FLOOR), np.array([point.ms for point in own])

    def at_level(self, name: str) -> tuple[Array, Array]:
        """Error and milliseconds of one level."""
        errors, ms = self.of_method("Taylor")
        i = [*LEVELS].index(name)
        return errors[i : i + 1], ms[i : i + 1]

    def over_time(self, values: Array, floor: float = _FLOOR) -> tuple[Array, Array]:
        """Values (n,) as a curve of a logarithmic picture."""
        return self.times, clipped(values, floor)

    def drift_of(self, i: int) -> tuple[Array, Array] | None:
        """The drift of the i-th integral over time."""
        drifts = [*self._drifts.values()]
        return self.over_time(drifts[i]) if i < len(drifts) else None

    def worst(self) -> Columns:
        """What the moving points follow."""
        return {"t": column(self.times), "growth": column(clipped(self.growing.errors[self.chosen], _FLOOR)),
                "drift": column(clipped(np.max([*self._drifts.values()], axis=0), _FLOOR)),
                "pixels": column(clipped(self.growing.pixels[self.chosen], _PIXEL_FLOOR))}

    def choose(self, x: float, y: float) -> Mapping[str, str]:
        """The level whose point lies nearest to the error x."""
        if not x > 0.0:
            return {}
        own = [point for point in self.measured if point.method == "Taylor"]
        return {"accuracy": min(own, key=lambda point: abs(math.log10(max(point.error, _FLOOR) / x))).setting}

    def _about_precision(self) -> str:
        here = self._here
        said = f"{self.chosen}: {digits(here.ms, 2)} ms, error {digits(here.error, 2)}"
        other = mechanics.quickest_other(self.measured, 10.0 * here.error)
        if other is not None:
            said += f"; {other.method}: {digits(other.ms / here.ms, 2)} × as long, {digits(other.error, 2)}"
        return f"{said}."

    def _about_growth(self) -> str:
        own = self.growing.errors[self.chosen]
        return (f"{self.chosen}: {digits(float(own[-1]), 2)} at the end; promised "
                f"{digits(level(self.chosen).promise)} (dotted).")

    def _about_drift(self) -> str:
        largest = ", ".join(f"({i + 1}) {name} {digits(float(drift.max()), 2)}"
                            for i, (name, drift) in enumerate(self._drifts.items()))
        return f"{self.chosen}: at most {largest}."

    def _about_pixels(self) -> str:
        t, pixels = self.times, self.growing.pixels[self.chosen]
        wrong = np.flatnonzero(pixels > 1.0)
        if wrong.size:
            return f"{self.chosen}: wrong by less than a pixel until t = {digits(float(t[wrong[0]]))}."
        return (f"{self.chosen}: wrong by less than a pixel to the end, t = {digits(float(t[-1]))} (at most "
                f"{digits(pixels.max(), 2)}).")

    def derived(self) -> Iterator[str]:
        """The system, its parameters and the initial state; the cost of all that is computed, if that is in sight."""
        yield from self.measured_rows()
        motion, system = self.followed, self.followed.system
        yield f"System: {system.title}"
        yield f"Equations: {system.source} ({', '.join(system.labels)} in the LaTeX source)"
        named = ((system.parameters, motion.parameters, ""), (system.variables, motion.state, "(0)"))
        for names, values, when in named:
            yield from (f"{name}{when} = {digits(value, 6)}" for name, value in zip(names, values, strict=True))

    def status(self) -> Iterator[str]:
        """Cost and error of every level."""
        yield f"{self.chosen} chosen"
        for point in self.measured if self.known("measured") else ():
            if point.method == "Taylor":
                yield f"{point.setting} {digits(point.ms, 2)} ms, error {digits(point.error, 2)}"

    def notes(self) -> Iterator[str]:
        """What was left out, and why."""
        motion = self.followed
        if motion.span < self.shown_motion.span:
            yield f"Measured up to t = {digits(motion.span * motion.unit)}: a longer span takes seconds."
        if "precision" in self.seen and mechanics.others_take_long(*motion.named):
            yield "SciPy's methods are left out: over so long a span they take long. Choose a shorter one."


def _end(s: Study) -> tuple[float, float]:
    return 0.0, float(s.times[-1])


_ERRORS = (_FLOOR, 10.0)
VIEWS = (
    Plot[Study](
        name="precision", title="Cost against error", caption=Study._about_precision, log="xy",
        axes=("largest error", "milliseconds"), x=_ERRORS, y=(1e-2, 1e4), x_ticks=POWERS, y_tick_count=5,
        on_click=Study.choose,
        layers=(
            *methods(Study.of_method, Study.at_level),
            ring("chosen", lambda s: [(max(s._here.error, _FLOOR), max(s._here.ms, _FLOOR))], size=20,
                 label="chosen level"))),
    Plot[Study](
        name="growth", title="Error over time", caption=Study._about_growth, log="y", axes=("t", "error"), x=_end,
        y=_ERRORS, y_tick_count=5, dot=("t", "growth"),
        layers=(limit(lambda s: level(s.chosen).promise),
                *curves_of_levels(lambda s, name: s.over_time(s.growing.errors[name])))),
    Plot[Study](
        name="drift", title="Drift of the integrals", caption=Study._about_drift, log="y", x=_end, y=_ERRORS,
        axes=("t", "relative drift"), y_tick_count=5, dot=("t", "drift"),
        layers=integrals(Study.drift_of)),
    Plot[Study](
        name="pixels", title="What it means for the pictures", caption=Study._about_pixels, log="y", x=_end,
        axes=("t", "error in pixels"), y=(_PIXEL_FLOOR, 1e4), y_tick_count=5, dot=("t", "pixels"),
        layers=(limit(lambda s: 1.0),
                *curves_of_levels(lambda s, name: s.over_time(s.growing.pixels[name], _PIXEL_FLOOR)))),
)


def looking_into(other: Scene[Any]) -> Scene[Any]:
    """The scene "Speed and accuracy" for the motions of another one, with its parameters."""
    trade: tuple[Plot[Study], ...] = (trade_picture(other.trials),) if other.measures else ()
    return LookingInto(
        Study, __file__, other=other, title="Speed and accuracy", presets=other.presets, place=other.place,
        group="Accuracy", essential=other.essential,
        summary="Error, drift and cost of the motion on show, at every level of accuracy, measured here and now.",
        tracks={"orbit": Study.worst}, views=(*VIEWS, *trade, difference_picture()))
