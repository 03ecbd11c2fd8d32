"""The cloud of the ball: the scene and its captions."""

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from support.captions import texts_in

SCENE = scenes()["singular-measures"]


def captions(values):
    """The texts beside the pictures, by their names."""
    wire = Wire()
    Stage(SCENE, wire).show(complete(SCENE.admit(values)[0]), False)
    return texts_in(wire.pack()[0])


def complete(values):
    """The result with all points."""
    for task in SCENE.compute(values, SCENE.pictures, False).work.todo:
        CACHE.get(task.function, *task.arguments)
    result = SCENE.compute(values, SCENE.pictures, False)
    assert result.work.todo == []
    return result
