"""View of a scene for given values, without a browser."""

import re
from functools import cache

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from hess_mechanics.errors import WorkLimit
from support.captions import texts_in
from support.wire import read

NUMBER = r"(−?\d+(?:\.\d+)?(?:e−?\d+)?)"
"""A number as captions write it."""
FEW = {"orbits": 4.0, "count": 20.0, "long": 20.0}
"""Values for what does not depend on how much of a section is shown."""
STATE = ("omega1", "omega2", "g1", "g2", "g3")
"""The columns of an orbit of the Suslov problem."""


def numbers_in(text, pattern):
    """Return the numbers in a text at the places of # in the pattern; a space matches any white space."""
    found = re.search(re.escape(pattern).replace(r"\#", NUMBER).replace(r"\ ", r"\s"), text)
    assert found, (pattern, text)
    return [float(number.replace("−", "-")) for number in found.groups()]


class View:
    """View of a scene for given values, after all pending computations.

    `values` are the admitted values, and `notes` the changes to them; `begun` and `first` are result and report of the
    first view, `result` and `report` those of the final one; `data` by source, `axes` and `text` by picture.
    Notes and refused work are errors unless expected: then `notes` and `refused` hold the messages.
    Sections show points; with `density` they show the density if the values do.
    """

    def __init__(
        self, scene, values, is_preview=False, seen=None, noted=False, refusing=False, whole=True, density=False
    ):
        self.wire = Wire()
        self.stage = Stage(scene, self.wire)
        values = {**scene.defaults(), **values}
        if values.get("indicator") == "density" and not density:
            values["indicator"] = "nothing"
        self.values, self.notes = scene.admit(values)
        assert noted or self.notes == []
        # A chart has cells without a number, and tests of its own.
        seen = [name for name in scene.pictures if name != "chart"] if seen is None else seen
        self.refused, self._left_out = [], []
        self.begun = self.result = scene.compute(self.values, seen, is_preview)
        self.first = self.report = self.stage.show(self.result, False)
        # Results may request more; an orbit diagram comes in twenty parts, one after the other.
        for _ in range(30 if whole else 0):
            if not self._complete(scene, seen, is_preview, refusing):
                break
        assert not whole or len(self.report.todo) == len(self.refused)
        tree, block = self.wire.pack()
        self.data = {
            name: {key: read(column, block) for key, column in columns.items()}
            for name, columns in tree["sources"].items()
        }
        self.axes, self.captions, self.text = tree["ranges"], tree["captions"], texts_in(tree)

    def _complete(self, scene, seen, is_preview, refusing):
        """Compute and show the pending results; return whether there were any."""
        left = [task for task in self.report.todo if task not in self._left_out]
        for task in left:
            try:
                CACHE.get(task.function, *task.arguments)
            except WorkLimit as error:
                assert refusing, error
                self.refused.append(str(error))
                self._left_out.append(task)
        if left:
            self.result = scene.compute(self.values, seen, is_preview)
            self.report = self.stage.show(self.result, False)
        return bool(left)

    def numbers(self, picture, pattern):
        """Return the numbers in a caption at the places of # in the pattern."""
        return numbers_in(self.text[picture], pattern)

    def quantities(self, pattern):
        """Return the numbers in the derived quantities at the places of # in the pattern."""
        return numbers_in("\n".join(self.report.quantities), pattern)

    def verdict(self, picture):
        """Return what a caption says below its title."""
        return self.text[picture].split("\n")[1]

    def curve(self, source):
        """Return xs and ys of the joined parts of a graph's series."""
        columns = self.data[source]
        return tuple(np.concatenate([np.asarray(part, float) for part in columns[key]] or [[]]) for key in ("xs", "ys"))

    def columns(self, source, *names):
        """Columns of a source side by side, (n, k)."""
        return np.column_stack([self.data[source][name] for name in names]).astype(float)

    def points(self, layer):
        """The points of a layer of the section, (n, 2)."""
        columns = self.data.get(f"section-{layer}", {"x": [], "y": []})
        return np.column_stack([columns["x"], columns["y"]]).astype(float)

    def assert_finite(self):
        """Assert that all drawn and written numbers are finite."""
        for name, columns in self.data.items():
            for column in columns.values():
                for part in column if isinstance(column, list) else [column]:
                    # A rod of a body is a list of numbers and words.
                    numbers = [x for x in part if not isinstance(x, str)] if isinstance(part, list) else part
                    if not isinstance(part, str):
                        assert np.all(np.isfinite(np.asarray(numbers, float))), name
        for text in [*self.text.values(), self.report.status, *self.report.quantities]:
            assert not re.search(r"nan|inf\b|None", text), text


def values_of(scene, beginning):
    """The values of the first example whose name begins so."""
    return next(one.values for one in scene.presets if one.name.startswith(beginning))


@cache
def example(name, beginning, **options):
    """View of that example of the scene of this name."""
    return View(scenes()[name], values_of(scenes()[name], beginning), **options)
