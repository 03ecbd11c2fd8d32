"""The computed states of a file: the responses of a server for each position of the sliders."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hess_explorer.export.picture_data import complete
from hess_explorer.offline.plan import StateFamily
from hess_explorer.offline.strips import OfflineStrip, steps_of_plots
from hess_explorer.page.controls import show_controls
from hess_explorer.page.description import describe, without_gestures
from hess_explorer.protocol.specs import NumberSpec, Values, encode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import ModelError

Report = Callable[[int, int], None]
"""Receives the number of computed states and the total number."""

_LARGEST_STRIP = 600_000
"""Size of a strip in numbers, above which the next one begins: the browser decodes a strip within a few frames."""
_CLICKS = ("tap", "pan")
"""Mouse events of a plot that choose a computed state."""


def _constants(one: StateFamily) -> str:
    """Return the numbers that are constant in a family, as text."""
    idle = one.scene.idle_values(one.base)
    specs = [spec for spec in one.scene.specs if isinstance(spec, NumberSpec) and spec.name not in {*one.names, *idle}]
    return ", ".join(f"{spec.symbol} = {one.base[spec.name]:g}".replace("-", "−") for spec in specs)


@dataclass
class Recording:
    """The states of a file, computed one by one.

    Parameters
    ----------
    pictures : mapping
        The names of the pictures of each scene.
    report : callable, optional
        Called after each state with the number of computed states and the total number.
    """

    pictures: Mapping[str, Sequence[str]]
    report: Report | None = None
    _states: dict[str, tuple[int, int]] = field(default_factory=dict)
    _strips: list[OfflineStrip] = field(default_factory=list)
    _families: list[dict[str, Any]] = field(default_factory=list)
    _sliders: dict[str, dict[str, tuple[float, float]]] = field(default_factory=dict)
    _columns: dict[str, dict[str, list[str]]] = field(default_factory=dict)

    def record(self, families: Sequence[StateFamily]) -> None:
        """Compute the distinct states of families, except those recorded before.

        Raises `ModelError` if the first state of a family is impossible; other impossible states show the reason.
        """
        queries = [{encode(one.scene.name, one.values(point)): point for point in one.points} for one in families]
        total = len({query for found in queries for query in found} - self._states.keys())
        done = 0
        for one, points in zip(families, queries, strict=True):
            self._note_sliders(one)
            strip = self._begin()
            for query, point in points.items():
                if query in self._states:
                    continue
                if strip.size > _LARGEST_STRIP:
                    strip = self._begin()
                self._compute(one.scene, one.values(point), strip, must=point == one.points[0])
                self._states[query] = len(self._strips) - 1, len(strip.trees) - 1
                done += 1
                if self.report is not None:
                    self.report(done, total)
            self._families.append(
                {
                    "scene": one.scene.name,
                    "names": list(one.names),
                    "points": [list(point) for point in points.values()],
                    "states": [list(self._states[query]) for query in points],
                    "queries": list(points),
                    "fixed": _constants(one),
                }
            )

    def number_of(self, query: str) -> int:
        """Return the number of the family that begins with the state of a query."""
        return next(i for i, one in enumerate(self._families) if one["queries"][0] == query)

    def _begin(self) -> OfflineStrip:
        if not self._strips or self._strips[-1].trees:
            self._strips.append(OfflineStrip())
        return self._strips[-1]

    def _note_sliders(self, one: StateFamily) -> None:
        varied = self._sliders.setdefault(one.scene.name, {})
        for name, values in zip(one.names, zip(*one.points, strict=True), strict=True):
            low, high = varied.get(name, (np.inf, -np.inf))
            varied[name] = min(low, *values), max(high, *values)

    def _compute(self, scene: Scene[Any], values: Values, strip: OfflineStrip, *, must: bool) -> None:
        """Append a complete state, or the reason why it is impossible; raise an error for a state that `must` exist."""
        wire = Wire()
        stage = Stage(scene, wire)
        pictures = self.pictures[scene.name]
        plots = [view for view in scene.views if isinstance(view, Plot) and view.name in pictures]
        try:
            with np.errstate(all="ignore"):
                values, notes = scene.admit(values)
                state, report = complete(scene, values, pictures, lambda state: stage.show(state, False))
        except ModelError as error:
            if must:
                raise
            stage.fail(str(error))
            axes = [(plot, plot.first_axes) for plot in plots]
            texts = {"summary": "Nothing could be computed", "status": str(error), "derived": "", "notes": ""}
        else:
            axes = [(plot, plot.ranges(state, plot.first_axes)) for plot in plots]
            texts = {
                "summary": f"accuracy: {state.work.level_name}",
                # Omit the run times, which depend on the recording machine.
                "status": " · ".join(state.status()),
                "derived": "\n".join(report.quantities),
                "notes": "\n".join([*notes, *report.notes]),
            }
        for plot, ranges in axes:
            wire.put_ranges(plot.name, ranges.x, ranges.y)
        # A recorded page computes no windows, so the note on a window does not apply.
        for key, text in {**texts, "windowed": ""}.items():
            wire.set_text(key, text)
        show_controls(scene, values, wire)
        tree, block = wire.pack()
        # Sort the columns, so that the file does not depend on the process.
        tree["sources"] = dict(sorted(tree["sources"].items()))
        self._note_columns(scene, tree["sources"])
        strip.add(tree, block, steps_of_plots(axes))

    def _note_columns(self, scene: Scene[Any], sources: Mapping[str, Mapping[str, Any]]) -> None:
        """Record the columns of each data source, which states without these columns must clear."""
        canvases = {view.name for view in scene.views if not isinstance(view, Plot)}
        noted = self._columns.setdefault(scene.name, {})
        for source, columns in sources.items():
            # A canvas treats an absent column as empty.
            new = [] if source in canvases else [*columns]
            noted[source] = [*dict.fromkeys([*noted.get(source, []), *new])]

    def _picks(self, name: str) -> dict[str, list[str]]:
        """Return the columns of the handle of each plot in which a click selects a computed state.

        At least one of these columns is a varied parameter.
        """
        varied = self._sliders.get(name, {})
        handles = {
            view.name: view.handle.columns[:2]
            for view in scenes()[name].views
            if isinstance(view, Plot) and view.name in self.pictures[name] and view.handle is not None
        }
        return {plot: [*columns] for plot, columns in handles.items() if varied.keys() & {*columns}}

    def descriptions(self) -> dict[str, Any]:
        """Return the descriptions of the scenes, with the pictures, sliders and gestures of the file."""
        return {name: self._description(name) for name in self.pictures}

    def _description(self, name: str) -> dict[str, Any]:
        found = json.loads(describe(name))
        varied, picks = self._sliders.get(name, {}), self._picks(name)
        chosen = [one for one in found["pictures"] if one["name"] in self.pictures[name]]
        found["pictures"] = [
            {**one, "folded": None, "picks": list(_CLICKS)} if one["name"] in picks else without_gestures(one)
            for one in chosen
        ]
        found["controls"] = [
            {**one, "range": list(varied[one["name"]])} for one in found["controls"] if one["name"] in varied
        ]
        return {**found, "presets": [], "tries": [], "essential": [*varied], "drawn": False, "handle": None}

    def pack(self) -> tuple[dict[str, Any], list[str]]:
        """Return the index of the states, as data for JSON, and the strips in base 64."""
        picks = {name: self._picks(name) for name in self.pictures}
        index = {"families": self._families, "picks": picks, "sources": self._columns}
        return index, [base64.b64encode(strip.pack()).decode() for strip in self._strips]
