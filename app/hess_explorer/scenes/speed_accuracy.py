"""Speed and accuracy of the motion on show in another scene: errors, drift and cost, measured here and now."""

from __future__ import annotations

import math
import time
from collections.abc import Collection, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Report, Scene
from hess_explorer.views import theme
from hess_explorer.views.chart import Chart, Series
from hess_explorer.views.text import number
from hess_mechanics.dynamics.work_precision import (
    SLOW_METHODS,
    Growth,
    WorkPoint,
    growth,
    longest_span,
    measure_levels,
    measure_others,
    others_take_long,
)
from hess_mechanics.numerics.accuracy import LEVELS, level
from hess_mechanics.numerics.results import Array

__all__ = ["looking_into"]

PICTURES = ("precision", "growth", "drift", "pixels")
SAMPLES = 400
_FLOOR = 1e-17
_INTEGRAL_COLORS = ("#0072B2", "#009E73", "#D55E00", "#CC79A7")
_INTEGRAL_DASHES = ("solid", "dashed", "dotdash", "dotted")
_OTHERS = {"DOP853": "#808080", "LSODA": "#56B4E9"}

_LINE = '<li><span class="line" style="border-top: 3px {} {}"></span>{}</li>'
_DOT = '<li><span class="dot" style="{}"></span>{}</li>'
_BORDERS = {"solid": "solid", "dashed": "dashed", "dotted": "dotted", "dotdash": "dashed"}

LEGEND = "".join([
    '<ul class="legend" aria-label="Legend">',
    *(_LINE.format(_BORDERS[theme.DASHES[name]], colour, name) for name, colour in theme.LEVELS.items()),
    *(_DOT.format(f"background: {colour}; border-radius: 0", f"{name} (SciPy)") for name, colour in _OTHERS.items()),
    *(_LINE.format(_BORDERS[dash], colour, f"integral {i + 1}")
      for i, (colour, dash) in enumerate(list(zip(_INTEGRAL_COLORS, _INTEGRAL_DASHES, strict=True))[:3])),
    _DOT.format("background: none; border: 3px solid #D55E00", "chosen level"),
    "</ul>",
])

THUMBNAIL = """
<path d="M5 2v26h40" fill="none" stroke="#808080" stroke-width="1.5"/>
<path d="M9 25 18 19 28 14 42 9" fill="none" stroke="#0072B2" stroke-width="2"/>
<path d="M16 12 26 7 40 3" fill="none" stroke="#808080" stroke-width="2" stroke-dasharray="3 2"/>
<circle cx="18" cy="19" r="3.5" fill="none" stroke="#D55E00" stroke-width="2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Study:
    """`points`, `growth` are None where no picture asks for them; `notes`: what was left out, and why."""

    values: Values
    motion: Motion
    points: tuple[WorkPoint, ...] | None
    growth: Growth | None
    notes: tuple[str, ...]
    wall_ms: float


def _compute(origin: Scene, values: Values, shown: Collection[str], dragging: bool) -> Study:
    start = time.perf_counter()
    assert origin.motion is not None
    motion = origin.motion(values)
    notes: list[str] = []
    longest = longest_span(motion.system.name, motion.state, motion.parameters)
    if motion.span > longest:
        motion = replace(motion, span=longest)
        notes.append(f"Measured up to t = {number(longest * motion.unit)}: a longer span takes seconds.")
    key = (motion.system.name, motion.state, motion.parameters, motion.span)

    def cached(function: Any, *arguments: Hashable) -> Any:
        return CACHE.get(function, *arguments)[0]

    points: tuple[WorkPoint, ...] | None = None
    if "precision" in shown:
        points = cached(measure_levels, *key, SAMPLES)
        if others_take_long(*key):
            notes.append("SciPy's methods are left out: over so long a span they take long. Choose a shorter one.")
        elif not dragging:
            points += cached(measure_others, *key, SAMPLES)
    errors = cached(growth, *key, motion.weights, SAMPLES) if {"growth", "drift", "pixels"} & set(shown) else None
    return Study(values, motion, points, errors, tuple(notes), (time.perf_counter() - start) * 1e3)


class StudyStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "growth-point": ("t", "growth"), "drift-point": ("t", "drift"), "pixels-point": ("t", "pixels"),
    }
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        levels = [Series(name, theme.LEVELS[name], theme.DASHES[name]) for name in LEVELS]
        span = (0.0, 40.0)
        self.precision = Chart(
            wire, "precision", ("largest error", "milliseconds"), (_FLOOR, 10.0), (1e-2, 1e4),
            [Series("Taylor", theme.ORBIT, marker="circle"),
             *(Series(name, colour, "dashed", "square") for name, colour in _OTHERS.items())],
            log_x=True, picks=("tap", "doubletap"))
        self.growth = Chart(wire, "growth", ("t", "error"), span, (_FLOOR, 10.0), levels)
        self.drift = Chart(wire, "drift", ("t", "relative drift"), span, (_FLOOR, 10.0), [
            Series(f"integral-{i}", colour, dash)
            for i, (colour, dash) in enumerate(zip(_INTEGRAL_COLORS, _INTEGRAL_DASHES, strict=True))])
        self.pixels = Chart(wire, "pixels", ("t", "error in pixels"), span, (1e-14, 1e4), levels)
        self.charts = (self.precision, self.growth, self.drift, self.pixels)
        # The player reads the time of the moving points from the source of that name.
        self.growth.add("orbit", "line", ("t", "growth"), source="data-orbit", line_alpha=0)
        self._points: Sequence[WorkPoint] = ()
        self.pictures = self.charts

    def show(self, study: Study, hold_axes: bool) -> Report:
        """Draw what was measured."""
        chosen = str(study.values["accuracy"])
        captions: dict[str, str] = {}
        if study.points is not None:
            self._show_precision(study.points, chosen)
            captions["precision"] = _precision_caption(study.points, chosen)
        if study.growth is not None:
            t = study.growth.times * study.motion.unit
            self._show_growth(study.growth, t, chosen, hold_axes)
            captions |= _growth_captions(study.growth, t, chosen)
        self._say(captions)
        return Report(_derived(study), _status(study, chosen), study.notes)

    def _show_precision(self, points: Sequence[WorkPoint], chosen: str) -> None:
        self._points = points
        self.precision.say("")
        for method in ("Taylor", *SLOW_METHODS):
            own = [point for point in points if point.method == method]
            self.precision.show(method, np.maximum([point.error for point in own], _FLOOR),
                                np.array([point.ms for point in own]))
        here = next(point for point in points if point.setting == chosen)
        self.precision.choose(max(here.error, _FLOOR), here.ms)

    def _show_growth(self, errors: Growth, t: Array, chosen: str, hold_axes: bool) -> None:
        drifts = errors.drifts[chosen]
        for chart in self.charts[1:]:
            chart.say("")
            if not hold_axes:
                chart.set_ranges((0.0, float(t[-1])), chart.y_range)
        for name in LEVELS:
            self.growth.show(name, t, errors.errors[name])
            self.pixels.show(name, t, errors.pixels[name])
        self.growth.show_limit(level(chosen).promise)
        self.pixels.show_limit(1.0)
        for i in range(len(_INTEGRAL_COLORS)):
            values = list(drifts.values())
            self.drift.show(f"integral-{i}", t if i < len(values) else np.empty(0),
                            values[i] if i < len(values) else np.empty(0))
        self.growth.assign(
            "orbit", t=t.astype(np.float32), growth=self.growth.clipped(errors.errors[chosen]),
            drift=self.drift.clipped(np.max(list(drifts.values()), axis=0)),
            pixels=self.pixels.clipped(errors.pixels[chosen]))

    def _say(self, captions: Mapping[str, str]) -> None:
        for name, text in captions.items():
            self.wire.say(name, text)

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        self._points = ()
        for chart in self.charts:
            chart.show_nothing(sentence)
        self._say(dict.fromkeys(PICTURES, sentence))

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click beside a level's point chooses that level."""
        levels = [point for point in self._points if point.method == "Taylor"]
        if picture != "precision" or not x > 0.0 or not levels:
            return {}
        nearest = min(levels, key=lambda point: abs(math.log10(max(point.error, _FLOOR) / x)))
        return {"accuracy": nearest.setting}


def _precision_caption(points: Sequence[WorkPoint], chosen: str) -> str:
    here = next(point for point in points if point.setting == chosen)
    text = f"Cost against error\n{chosen}: {number(here.ms, 2)} ms, error {number(here.error, 2)}"
    equal = [point for point in points if point.method != "Taylor" and point.error <= here.error * 10.0]
    if equal:
        other = min(equal, key=lambda point: point.ms)
        text += f"; {other.method}: {number(other.ms / here.ms, 2)} × as long, {number(other.error, 2)}"
    return text + "."


def _growth_captions(errors: Growth, t: Array, chosen: str) -> dict[str, str]:
    own, pixels, drifts = errors.errors[chosen], errors.pixels[chosen], errors.drifts[chosen]
    wrong = np.flatnonzero(pixels > 1.0)
    if wrong.size == 0:
        end = f"t = {number(float(t[-1]))}"
        meaning = f"wrong by less than a pixel to the end, {end} (at most {number(pixels.max(), 2)})"
    else:
        meaning = f"wrong by less than a pixel until t = {number(float(t[wrong[0]]))}"
    largest = ", ".join(
        f"({i + 1}) {name} {number(float(drift.max()), 2)}" for i, (name, drift) in enumerate(drifts.items()))
    return {
        "growth": f"Error over time\n{chosen}: {number(float(own[-1]), 2)} at the end; promised "
                  f"{number(level(chosen).promise)} (dotted).",
        "drift": f"Drift of the integrals\n{chosen}: at most {largest}.",
        "pixels": f"What it means for the pictures\n{chosen}: {meaning}.",
    }


def _derived(study: Study) -> list[str]:
    system = study.motion.system
    return [
        f"System: {system.title}",
        f"Equations: {system.source} ({', '.join(system.labels)} in the LaTeX source)",
        *(f"{name} = {number(value, 6)}"
          for name, value in zip(system.parameters, study.motion.parameters, strict=True)),
        *(f"{name}(0) = {number(value, 6)}"
          for name, value in zip(system.variables, study.motion.state, strict=True)),
    ]


def _status(study: Study, chosen: str) -> str:
    parts = [f"{chosen} chosen"]
    for point in study.points or ():
        if point.method == "Taylor":
            parts.append(f"{point.setting} {number(point.ms, 2)} ms, error {number(point.error, 2)}")
    parts.append(f"all measured in {study.wall_ms:.0f} ms")
    return " · ".join(parts)


def looking_into(origin: Scene) -> Scene:
    """The scene "Speed and accuracy" for the motions of another one, with its parameters."""

    def compute(values: Values, shown: Collection[str], dragging: bool) -> Study:
        return _compute(origin, values, shown, dragging)

    return Scene(
        name=f"{origin.name}-accuracy",
        title="Speed and accuracy",
        summary="Error, drift and cost of the motion on show, at every level of accuracy, measured here and now.",
        specs=origin.specs,
        presets=origin.presets,
        words=WORDS,
        pictures=PICTURES,
        admit=origin.admit,
        limits=origin.limits,
        compute=compute,
        stage=StudyStage,
        legend=LEGEND,
        thumbnail=THUMBNAIL,
        origin=origin.name,
        place=origin.place,
    )
