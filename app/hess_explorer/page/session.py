"""One user's session: the single place where a change becomes a computation and a picture.

A fast drag skips states, it never queues them: see `Session`.
"""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.budget import Abandoned
from hess_explorer.lessons import tries
from hess_explorer.lessons.lesson import Lesson, StateLink
from hess_explorer.page.controls import show_controls
from hess_explorer.page.description import describe, describe_lesson
from hess_explorer.page.pieces import Pieces
from hess_explorer.page.wanted import Wanted, as_float
from hess_explorer.protocol.expressions import NotANumber, evaluate
from hess_explorer.protocol.parameters import Choice, Link, Number, Places, Value, Values, encode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Report, Scene
from hess_explorer.scenes.framework.stage import Stage
from hess_mechanics.errors import ModelError

__all__ = ["Session", "linked"]

logger = logging.getLogger("hess_explorer")

FAILED = "This state could not be computed. Press Reset, and please report the link."


def linked(link: Link, here: str) -> tuple[Scene[Any], dict[str, Value]]:
    """The scene that a link names, else the one of the name `here`, and its values there."""
    scene = scenes()[str(link.value(Choice("scene", "Scene", tuple(scenes()), here)))]
    return scene, link.values(scene.specs)


class Page(Protocol):
    """What a session speaks to: see `Desk`, whose attributes these are."""

    scene: str
    lesson: str
    block: bytes
    state: str

    def on_msg(self, handle: Callable[[Any], object]) -> None:
        """Have each message handled, as its `data`."""


class Session:
    """Wanted values → admitted values → result → pictures.

    A change only notes what is wanted.  The browser asks for the state behind its last change, and not again
    before that is painted: so nothing queues, and the newest state wins.

    Parameters
    ----------
    ready : its messages ask for states, and it receives them.
    scene : what is shown first; values : the state to begin with; notes : what had to be changed in the link;
    lessons : those that can be given, by name; pictures : those in sight, until the browser says what is.
    """

    def __init__(self, ready: Page, scene: Scene[Any], values: Values, notes: list[str],
                 lessons: Mapping[str, Lesson], pictures: Collection[str] | None = None) -> None:
        self.ready = ready
        self._lessons = lessons
        self.wire = Wire()
        self._pieces = Pieces()
        self.background = self._pieces.background
        self._stages: dict[str, Stage[Any]] = {}
        self._described: set[str] = set()
        self._left: dict[str, Values] = {}
        self._own_instead = False
        self._held = False
        self._number = 0
        self._enter(scene, values, notes, pictures)
        self._guarded(self._draw)
        self._send(0)
        ready.on_msg(lambda event: self._receive(event.data))

    def _enter(self, scene: Scene[Any], values: Values, notes: list[str],
               pictures: Collection[str] | None = None) -> None:
        self.scene = scene
        self._wanted = Wanted(scene, values, notes)
        self.values: Values = dict(self._wanted.values)
        self._shown: Collection[str] = scene.open_pictures if pictures is None else pictures
        # The browser keeps the pictures of all scenes that it has seen, and a stage knows what it has drawn on them.
        if scene.name not in self._stages:
            self._stages[scene.name] = Stage(scene, self.wire)
            self._describe(scene.name)
        self.stage = self._stages[scene.name]
        self._dirty = True
        self._pieces.resume()

    def _describe(self, name: str) -> None:
        """Give the browser what it needs to build the pictures of a scene, once."""
        if name not in self._described:
            self._described.add(name)
            self.ready.scene = describe(name)

    def _change_scene(self, scene: Scene[Any]) -> None:
        """Another scene as it was left (at first: in its own first state), with what was changed in this one and means
        the same there."""
        wanted = self._wanted.values
        self._left[self.scene.name] = values = wanted
        # "Speed and accuracy" of a scene is of the very same state.
        self._own_instead = (scene.origin or scene.name) != (self.scene.origin or self.scene.name)
        if not self._own_instead:
            values = {**self._left.get(scene.name, {}), **wanted}
        else:
            values = scene.taken_over(self._left.get(scene.name, scene.defaults()), self.scene, wanted)
        self._enter(scene, values, [])

    def change(self, values: Values) -> None:
        """The user wants these values."""
        # A note on what came before goes, also where the state stays.
        self._dirty |= bool(self._wanted.notes)
        if self._wanted.change(values):
            self._pieces.resume()
            self._dirty = True
        # Also where the state stays but a control shows something else: it must be put right.
        self._dirty |= any(self.values.get(name) != value for name, value in values.items())

    def _evaluate(self, expressions: dict[Any, Any]) -> None:
        """The user wants what these texts are as numbers; what is wrong with one is said at its box."""
        for name, text in expressions.items():
            if isinstance(self._wanted.specs.get(name), Number) and isinstance(text, str):
                try:
                    self.change({name: evaluate(text)})
                    # The box shows the number, also where it was that before.
                    self._dirty = True
                except NotANumber as refusal:
                    self.wire.say(f"error-{name}", str(refusal))

    def reset(self) -> None:
        """Back to the scene's defaults."""
        self.change(self.scene.defaults())

    def _restore(self, query: str) -> bool:
        """The state of a link, or of a step that is undone; whether that is in another scene."""
        link = Link(query)
        scene, values = linked(link, self.scene.name)
        notes = link.notes
        if scene is self.scene:
            self.change(values)
            self._wanted.notes, self._dirty = notes, self._dirty or bool(notes)
            return False
        self._left[self.scene.name] = self._wanted.values
        self._own_instead = False
        self._enter(scene, values, notes)
        return True

    def _picked(self, picked: Any) -> Values:
        """The values that a click [picture, x, y] or a box [picture, x0, y0, x1, y1] chooses; else a note why not."""
        try:
            match picked:
                case [str(name), *given] if all(map(math.isfinite, place := [as_float(one) for one in given])):
                    match place:
                        case [x, y]:
                            return self.stage.pick(name, x, y)
                        case [x0, y0, x1, y1]:
                            return self.stage.box(name, (x0, y0, x1, y1))
        except ModelError as error:
            self._wanted.notes, self._dirty = [str(error)], True
        return {}

    def _place_of(self, step: Any) -> StateLink | None:
        """The state that a step [lesson or scene, number, whether its guess is revealed] goes to."""
        match step:
            case [str(name), int(number), bool(revealed)]:
                lesson = self._lessons.get(name) or tries().get(name)
                if lesson is not None and 0 <= number < len(lesson.steps):
                    found = lesson.steps[number]
                    return found.prediction.then if revealed and found.prediction else found.at
        return None

    def _go(self, place: StateLink) -> None:
        """Show the state of a step: all of it, whatever was chosen before."""
        scene = scenes()[place.scene]
        if scene is self.scene:
            self.change(place.values)
        else:
            self._left[self.scene.name] = self._wanted.values
            self._enter(scene, place.values, [])

    def _hover(self, picture: Any, x: float, y: float) -> None:
        text = ""
        if picture in self.scene.pictures and math.isfinite(x) and math.isfinite(y):
            try:
                text = self.stage.hover(picture, x, y)
            except ModelError as error:
                text = str(error)
            self.wire.say(f"hover-{picture}", text)

    def _receive(self, message: Any) -> None:
        """A message of the browser: nothing in it is trusted, and who waits for an answer gets one."""
        if not isinstance(message, dict):
            return
        requested = message.get("requested")
        if not self._guarded(partial(self._handle, message)) and isinstance(requested, int):
            self._send(requested)

    def _guarded(self, work: Callable[[], object]) -> bool:
        """Whether this could be done; else the page says that something failed."""
        try:
            # The mechanics check their results for overflow themselves: NumPy's warnings would only be noise.
            with np.errstate(all="ignore"):
                work()
        except Abandoned:
            raise
        # Whatever it is, no traceback and no older picture stays on the page; the log says all.
        except Exception:
            logger.exception("a state failed at %s", encode(self.scene.name, self._wanted.values))
            self._pieces.drop()
            self._dirty = True
            self._say(self._refuse(FAILED), [])
            return False
        return True

    def _handle(self, message: dict[Any, Any]) -> None:
        query, moved = message.get("restore"), False
        if isinstance(query, str):
            moved = self._restore(query)
        if message.get("reset") is True:
            self.reset()
        for preset in self.scene.presets:
            if preset.name == message.get("preset"):
                self.change(self.scene.example(preset))
        values = message.get("values")
        # What asks for more of the same is no change, nor is what says nothing beside a step back.
        if isinstance(values, dict) and (values or (self._pieces.progress is None and not isinstance(query, str))):
            self.change({name: value for name, value in values.items() if name in self._wanted.specs})
        expressions = message.get("expressions")
        if isinstance(expressions, dict):
            self._evaluate(expressions)
        if message.get("clear") is True:
            self.change({name: spec.default for name, spec in self._wanted.specs.items() if isinstance(spec, Places)})
        picked = self._picked(message.get("picked"))
        if picked:
            self.change(picked)
        hover = message.get("hover")
        if isinstance(hover, list) and len(hover) == 3:
            self._hover(hover[0], *map(as_float, hover[1:]))
        if message.get("stop") is True:
            self._pieces.stop()
        lesson = message.get("lesson")
        if isinstance(lesson, str) and lesson in self._lessons:
            self.ready.lesson = describe_lesson(self._lessons[lesson])
        place = self._place_of(message.get("step"))
        requested = message.get("requested")
        scene, near = (scenes().get(name) if isinstance(name, str) else None
                       for name in (message.get("scene"), message.get("near")))
        # One description goes with one state.
        if moved:
            pass
        elif scene is not None and scene is not self.scene:
            self._change_scene(scene)
        elif near is not None:
            self._describe(near.name)
        here = self.scene
        if place is not None:
            self._go(place)
        hidden = message.get("hidden")
        # Those of another scene say nothing of this one.
        if isinstance(hidden, list) and self.scene is here:
            shown = [name for name in self.scene.pictures if name not in hidden]
            # What comes into sight must be of this state.
            self._dirty |= not set(shown) <= set(self._shown)
            self._shown = shown
        if isinstance(requested, int):
            held = message.get("held") is True
            # When a slider is let go, accuracy, axes and other controls may have to follow.
            self._dirty |= self._held and not held
            self._held = held
            if self._dirty:
                self._draw()
            elif self._pieces.progress is not None and self._pieces.news:
                self._draw(more=True)
            self._send(requested)

    def _send(self, answers: int) -> None:
        self._number += 1
        tree, block = self.wire.pack()
        self.ready.block = block
        self.ready.state = json.dumps({
            "number": self._number, "answers": answers, "query": encode(self.scene.name, self.values), "tree": tree,
            "scene": self.scene.name, "progress": self._pieces.progress,
        })
        self._pieces.begin()

    def _draw(self, more: bool = False) -> None:
        """The pictures of what is wanted; `more`: of the same, of which more may be known by now."""
        self._dirty = False
        ended = self._pieces.ended(more)
        notes: list[str] = []
        try:
            self.values, notes = self.scene.admit(self._wanted.values)
            state = self.scene.compute(self.values, self._shown, self._held)
            report = self.stage.show(state, hold_axes=self._held)
        except ModelError as error:
            if self._own_instead:
                # Whoever enters a scene meets a picture, not a refusal of what was chosen elsewhere.
                self._own_instead = False
                self._wanted = Wanted(self.scene, self.scene.defaults(), [
                    "What was chosen before is not possible here: this is the scene's own first state."])
                return self._draw()
            report = self._refuse(str(error))
        except Abandoned:
            raise
        # Whatever it is, no traceback and no older picture stays on the page; the log says all.
        except Exception:
            logger.exception("a computation failed at %s", encode(self.scene.name, self._wanted.values))
            report = self._refuse(FAILED)
        self._own_instead = False
        notes = [*notes, *self._pieces.follow(report, more, ended)]
        # Under a drag the controls wait, unless the state had to differ from what they say.
        if not self._held or notes:
            show_controls(self.scene, self.values, self.wire)
        self._say(report, notes)

    def _say(self, report: Report, notes: list[str]) -> None:
        self.wire.say("summary", report.summary)
        self.wire.say("status", report.status)
        self.wire.say("notes", "\n".join([*self._wanted.notes, *notes, *report.notes]))
        self.wire.say("derived", "\n".join(report.derived))

    def _refuse(self, sentence: str) -> Report:
        """Show why there is nothing to see."""
        self.stage.fail(sentence, hold_axes=self._held)
        return Report((), sentence, (), (), 0, "Nothing could be computed")
