"""What a scene shows when all that it leaves to be computed is there."""

from __future__ import annotations

import re

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.stage import Stage
from support.numbers import NUMBER
from support.wire import read


class Settled:
    """What a scene shows of some values when all that it leaves to be computed is there.

    `first` is the report of what is seen at once; `data` by source, `axes`, `text` by picture, `report`, `result`.
    """

    def __init__(self, scene, values, dragging=False, seen=None):
        self.wire = Wire()
        self.stage = Stage(scene, self.wire)
        self.values, self.notes = scene.admit({**scene.defaults(), **values})
        seen = scene.pictures if seen is None else seen
        self.first = self.stage.show(scene.compute(self.values, seen, dragging), False)
        for task in self.first.todo:
            CACHE.get(task.function, *task.arguments)
        self.result = scene.compute(self.values, seen, dragging)
        self.report = self.stage.show(self.result, False)
        tree, block = self.wire.pack()
        self.data = {name: {key: read(column, block) for key, column in columns.items()}
                     for name, columns in tree["sources"].items()}
        self.axes, self.text = tree["ranges"], tree["texts"]

    def numbers(self, picture, pattern):
        """The numbers in a caption that stand where the pattern has #."""
        found = re.search(re.escape(pattern).replace(r"\#", NUMBER), self.text[picture])
        assert found, (pattern, self.text[picture])
        return [float(number.replace("−", "-")) for number in found.groups()]

    def assert_finite(self):
        for name, columns in self.data.items():
            for column in columns.values():
                for part in column if isinstance(column, list) else [column]:
                    if not isinstance(part, str):
                        assert np.all(np.isfinite(np.asarray(part, float))), name
        for text in [*self.text.values(), self.report.status, *self.report.derived]:
            assert not re.search(r"nan|inf\b|None", text), text
