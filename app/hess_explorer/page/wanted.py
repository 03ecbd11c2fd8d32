"""What the user wants of a scene: its values, each within its bounds, and notes on what had to be changed."""

from __future__ import annotations

import math
from typing import Any

from hess_explorer.protocol.parameters import Choice, Number, Spec, Value, Values
from hess_explorer.scenes.framework.scene import Scene

__all__ = ["Wanted", "as_float"]


def as_float(value: Any) -> float:
    """A number from the browser; NaN for whatever is none."""
    try:
        return float(value) if isinstance(value, int | float) else math.nan
    except OverflowError:
        return math.nan


class Wanted:
    """The values wanted of a scene.

    scene : of which; values : to begin with, defaults where they say nothing; notes : on them.
    """

    def __init__(self, scene: Scene[Any], values: Values, notes: list[str]) -> None:
        self.scene = scene
        self.specs = {spec.name: spec for spec in scene.specs}
        self.values: dict[str, Value] = scene.defaults()
        self.notes = notes
        # What comes from another scene is within the bounds of that one.
        for name in self.specs.keys() & values.keys():
            self._want(self.specs[name], values[name])

    def change(self, values: Values) -> bool:
        """The user wants these values; whether that is a change.  The notes are on this one alone."""
        before = dict(self.values)
        self.notes = []
        for name, value in values.items():
            if name in self.specs:
                self._want(self.specs[name], value)
        if any(isinstance(spec, Choice) and self.values[name] != before[name] for name, spec in self.specs.items()):
            for name, value in self.scene.carried(before, self.values).items():
                spec = self.specs[name]
                if name not in values and isinstance(spec, Number):
                    self._want(spec, value)
        return self.values != before

    def _want(self, spec: Spec, value: Any) -> None:
        """Want a value within the bounds of its parameter; of a number that had to be changed there is a note."""
        if isinstance(spec, Number):
            self.values[spec.name], note = spec.admit(as_float(value))
            if note:
                self.notes.append(note)
        else:
            self.values[spec.name], _ = spec.read(str(value))
