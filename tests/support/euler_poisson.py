"""The scene of the Euler–Poisson sections with all that it computes."""

from __future__ import annotations

import re

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import places
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.euler_poisson import body_of
from hess_explorer.scenes.framework.stage import Stage
from hess_mechanics.euler_poisson.andoyer import state_at
from support.wire import read

EP = scenes()["euler-poisson"]
NUMBER = r"(−?\d+(?:\.\d+)?(?:e−?\d+)?)"


class View:
    """What the scene shows of some values when all of it is computed."""

    def __init__(self, values, dragging=False, shown=EP.pictures):
        wire = Wire()
        stage = Stage(EP, wire)
        self.values, notes = EP.admit({**EP.defaults(), **values})
        assert notes == []
        self.result = EP.compute(self.values, shown, dragging)
        for task in self.result.todo:
            CACHE.get(task.function, *task.arguments)
        if self.result.todo:
            self.result = EP.compute(self.values, shown, dragging)
        self.report = stage.show(self.result, False)
        tree, block = wire.pack()
        self.data = {name: {key: read(column, block) for key, column in columns.items()}
                     for name, columns in tree["sources"].items()}
        self.axes, self.text, self.stage = tree["ranges"], tree["texts"], stage
        self.body = body_of(self.values)
        self.h, self.f = self.values["h"], self.values["f"]

    def numbers(self, picture, pattern):
        """The numbers in a caption that stand where the pattern has #."""
        found = re.search(re.escape(pattern).replace(r"\#", NUMBER), self.text[picture])
        assert found, (pattern, self.text[picture])
        return [float(text.replace("−", "-")) for text in found.groups()]

    def points(self, layer):
        data = self.data.get(f"section-{layer}", {"x": [], "y": []})
        return np.column_stack([data["x"], data["y"]]).astype(float)

    @property
    def start(self):
        return state_at(self.body, self.h, self.f, *places(self.values["starts"])[-1])
