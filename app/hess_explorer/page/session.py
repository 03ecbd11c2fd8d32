"""The session of one page: turns each requested change into a computation and pictures."""

from __future__ import annotations

import logging
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from hess_explorer.compute.background import Background
from hess_explorer.compute.budget import ClientGone
from hess_explorer.lessons import suggestions
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.background_tasks import BackgroundTasks
from hess_explorer.page.controls import show_controls
from hess_explorer.page.description import describe
from hess_explorer.page.lesson_description import describe_lesson
from hess_explorer.page.requested import RequestedState
from hess_explorer.protocol.expressions import NotANumber, evaluate
from hess_explorer.protocol.messages import PictureBox, PicturePoint, Request, Response, StateResponse, StepChoice
from hess_explorer.protocol.specs import Formula, NumberSpec, Points, Values, encode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Report, Scene
from hess_explorer.scenes.framework.stage import Stage
from hess_mechanics.errors import ModelError

logger = logging.getLogger("hess_explorer")

FAILURE = "This state could not be computed. Press Reset, and please report the link."


class Session:
    """Computes and draws the states of a page: requested values → admitted values → result → pictures.

    A change only updates the requested state.  The browser requests the state after its last change, and the next one
    only when that is painted, so requests do not pile up and the newest state wins.

    Parameters
    ----------
    scene : Scene
        The initial scene.
    values : mapping
        Values of its parameters.
    notes : list of str
        Corrections of the link.
    lessons : mapping
        Available lessons by name.
    pictures : collection of str
        Visible pictures, until the browser reports which are in the viewport.

    Attributes
    ----------
    requested : RequestedState
        The requested state.
    values : mapping of str to float or str
        Admitted values of the last state; empty before the first one.
    wire : Wire
        The changes that the next response will contain.
    is_new : bool
        True if the last requested state was drawn anew; False if it was already drawn, or only got new results.
    """

    def __init__(
        self,
        scene: Scene[Any],
        values: Values,
        notes: list[str],
        lessons: Mapping[str, Lesson],
        pictures: Collection[str],
    ) -> None:
        self.requested = RequestedState(scene, values, notes)
        self.wire = Wire()
        self._lessons = lessons
        self._tasks = BackgroundTasks()
        # The browser keeps the pictures of all visited scenes; each stage records what is drawn there.
        self._stages: dict[str, Stage[Any]] = {}
        self._described: set[str] = set()
        self._in_sight = pictures
        self._held = False
        self._number = 0
        self.is_new = False
        self.values: Values = {}
        # Scene, requested values and notes of the drawn state; None before the first one and after an unexpected error.
        self._drawn: tuple[str, Values, list[str]] | None = None
        self._drawn_pictures: Collection[str] = ()
        # Names of the values that the scene has limited.
        self._limited: set[str] = set()
        # True if a control shows a value other than that of the state.
        self._mistaken = False

    @property
    def scene(self) -> Scene[Any]:
        """The current scene."""
        return self.requested.scene

    @property
    def stage(self) -> Stage[Any]:
        """The pictures of the current scene."""
        if self.scene.name not in self._stages:
            self._stages[self.scene.name] = Stage(self.scene, self.wire)
        return self._stages[self.scene.name]

    @property
    def background(self) -> Background:
        """The background work of the current state."""
        return self._tasks.background

    def answer(self, request: Request) -> Response:
        """Process a request and return the response, which contains a state if the request asked for one.

        Raises `ClientGone` if the page has closed meanwhile; the page shows any other error.
        """
        scene = self.scene
        try:
            # `hess_mechanics` checks its results for overflow itself, so NumPy's warnings would be noise.
            with np.errstate(all="ignore"):
                self._apply(request)
                if self.scene is not scene:
                    self._in_sight = self.scene.open_pictures
                elif request.hidden is not None:
                    self._in_sight = [name for name in scene.pictures if name not in request.hidden]
                if request.requested is not None:
                    self._update(request.held)
        except ClientGone:
            raise
        # Log any error; the page shows neither a traceback nor an outdated picture.
        except Exception:
            logger.exception("a state failed at %s", encode(self.scene.name, self.requested.values))
            self._tasks.drop()
            self._drawn = None
            self.values = dict(self.requested.values)
            self._say(self._refuse(FAILURE), [])
        lesson = self._lessons.get(request.lesson or "")
        lesson_text = describe_lesson(lesson) if lesson else ""
        if request.requested is None:
            return Response(lesson=lesson_text)
        self._number += 1
        tree, block = self.wire.pack()
        state = StateResponse(
            self._number,
            request.requested,
            encode(self.scene.name, self.values),
            tree,
            self.scene.name,
            self._tasks.progress,
        )
        # Describe a scene that may be chosen next only if the scene did not change now.
        near = request.near if self.scene is scene else None
        return Response(self._description(near), lesson_text, state, block)

    def start_tasks(self) -> None:
        """Start the background work of the state; call it after the response has been sent."""
        self._tasks.start()

    def _description(self, near: str | None) -> str:
        """Return the description of the current scene, or of the scene `near`, unless it was sent before."""
        for name in (self.scene.name, near):
            if name is not None and name not in self._described and (name == self.scene.name or name in scenes()):
                self._described.add(name)
                return describe(name)
        return ""

    def _apply(self, request: Request) -> None:
        """Update the requested state; clicks refer to the drawn state."""
        wanted, scene = self.requested, self.scene
        if request.restore is not None:
            wanted.restore(request.restore)
        if request.reset:
            self._change(self.scene.defaults())
        for preset in self.scene.presets:
            if preset.name == request.preset:
                self._change(self.scene.example(preset))
        # Empty values are no change while tasks are running (a poll), nor together with an undo step.
        if request.values or (request.values is not None and self._tasks.progress is None and request.restore is None):
            self._change(request.values)
        if request.expressions:
            self._evaluate(request.expressions)
        if request.clear:
            self._change({name: spec.default for name, spec in wanted.specs.items() if isinstance(spec, Points)})
        if request.picked is not None:
            self._pick(request.picked)
        if request.hover is not None:
            self._hover(request.hover)
        if request.scene in scenes() and self.scene is scene:
            wanted.change_scene(scenes()[request.scene])
        if request.step is not None:
            self._go(request.step)
        if self._drawn is None or (self.scene.name, wanted.values) != self._drawn[:2]:
            self._tasks.cancel_running()
        if request.stop:
            self._tasks.stop()

    def _change(self, values: Values) -> None:
        self.requested.change(values)
        for name, spec in self.requested.specs.items():
            if isinstance(spec, Formula) and name in values and (note := spec.read(values[name])[1]):
                self.wire.set_text(f"error-{name}", note)
        # The control must be corrected even if the state does not change.
        self._mistaken |= any(self.values.get(name) != value for name, value in values.items())

    def _evaluate(self, expressions: Mapping[str, str]) -> None:
        """Set numbers typed as expressions; an error is shown at its input field."""
        for name, text in expressions.items():
            if isinstance(self.requested.specs.get(name), NumberSpec):
                try:
                    self.requested.change({name: evaluate(text)})
                    # The input field must show the number, even if it is unchanged.
                    self._mistaken = True
                except NotANumber as refusal:
                    self.wire.set_text(f"error-{name}", str(refusal))

    def _pick(self, picked: PicturePoint | PictureBox) -> None:
        """Set the values that a click or a box selects, or append the reason why it selects none."""
        try:
            chosen = (
                self.stage.pick(picked.picture, picked.x, picked.y)
                if isinstance(picked, PicturePoint)
                else self.stage.box(picked.picture, picked.corners)
            )
        except ModelError as error:
            self.requested.notes = [str(error)]
        else:
            if chosen:
                self._change(chosen)

    def _hover(self, point: PicturePoint) -> None:
        if point.picture in self.scene.pictures:
            try:
                text = self.stage.hover(point.picture, point.x, point.y)
            except ModelError as error:
                text = str(error)
            self.wire.set_text(f"hover-{point.picture}", text)

    def _go(self, step: StepChoice) -> None:
        """Go to the state of a step of a lesson, or of a suggestion of the scene."""
        lesson = self._lessons.get(step.lesson) or suggestions().get(step.lesson)
        if lesson is not None and 0 <= step.number < len(lesson.steps):
            found = lesson.steps[step.number]
            self.requested.go_to(found.prediction.outcome if step.revealed and found.prediction else found.state)

    def _update(self, held: bool) -> None:
        """Draw the requested state unless it is already drawn."""
        # When a slider is released, accuracy, axes and other controls may have to be updated.
        released = self._held and not held
        self._held = held
        wanted = self.requested
        self.is_new = (
            released
            or self._mistaken
            or self._drawn != (self.scene.name, wanted.values, wanted.notes)
            or not set(self._in_sight) <= set(self._drawn_pictures)
        )
        if self.is_new:
            self._draw()
        elif self._tasks.progress is not None and self._tasks.has_updates:
            self._draw(more=True)

    def _draw(self, more: bool = False) -> None:
        """Draw the requested state.

        Parameters
        ----------
        more : bool
            True to redraw it with new results of the background tasks.
        """
        wanted, ended = self.requested, self._tasks.is_done(more)
        self.values, notes = wanted.values, list[str]()
        try:
            self.values, notes = self.scene.admit(wanted.values)
            self._say_limits({name for name, value in self.values.items() if value != wanted.values[name]}, notes)
            state = self.scene.compute(self.values, self._in_sight, self._held)
            report = self.stage.show(state, hold_axes=self._held)
        except ModelError as error:
            if wanted.carried:
                # A scene that the user enters must not fail because of values chosen elsewhere.
                wanted.restart()
                return self._draw()
            report = self._refuse(str(error))
        wanted.carried = False
        notes = [*notes, *self._tasks.follow(report, more, ended)]
        # During a drag the controls are not updated, unless the state differs from their values.
        if not self._held or notes:
            show_controls(self.scene, self.values, self.wire)
        self._say(report, notes)
        self._drawn = self.scene.name, dict(wanted.values), wanted.notes
        self._drawn_pictures, self._mistaken = self._in_sight, False
        return None

    def _say_limits(self, limited: set[str], notes: list[str]) -> None:
        """Say beside the controls of limited values why they are limited."""
        for name in limited | self._limited:
            self.wire.set_text(f"limit-{name}", "\n".join(notes) if name in limited else "")
        self._limited = limited

    def _say(self, report: Report, notes: list[str]) -> None:
        self.wire.set_text("summary", report.summary)
        self.wire.set_text("status", report.status)
        self.wire.set_text("notes", "\n".join([*self.requested.notes, *notes, *report.notes]))
        self.wire.set_text("derived", "\n".join(report.quantities))

    def _refuse(self, sentence: str) -> Report:
        """Clear the pictures and show the reason."""
        self.stage.fail(sentence, hold_axes=self._held)
        return Report((), sentence, (), (), 0, "Nothing could be computed")
