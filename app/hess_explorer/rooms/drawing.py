"""Draw the lecturer's picture once for all followers of a room, as a complete state in one frame."""

from __future__ import annotations

import asyncio
import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from hess_explorer.compute.pool import RequestQueue
from hess_explorer.lessons.lesson import Lesson, LessonStep
from hess_explorer.page.description import describe, without_gestures
from hess_explorer.page.lesson_description import describe_lesson
from hess_explorer.page.opening import opening
from hess_explorer.page.session import Session
from hess_explorer.protocol.messages import Request, Response
from hess_explorer.rooms.messages import Show
from hess_explorer.scenes.framework.scene import Scene

_LEFT_OUT: dict[str, Any] = {
    "handle": None,
    "words": "",
    **{key: [] for key in ("controls", "essential", "groups", "presets", "tries")},
}
"""Empty values for the parts of a description that need a session."""


@dataclass(frozen=True)
class Frames:
    """The encoded responses for a state.

    Attributes
    ----------
    scene : bytes
        Frame with the description of the picture.
    state : bytes
        Frame with the complete state and the texts beside it.
    """

    scene: bytes
    state: bytes


def step_of(lessons: Mapping[str, Lesson], show: Show) -> LessonStep | None:
    """Return the step of the lesson that the lecturer shows; None without a lesson or for an unknown one."""
    lesson = lessons.get(show.lesson)
    return lesson.steps[show.step - 1] if lesson and 0 < show.step <= len(lesson.steps) else None


class RoomDrawing:
    """Draws the states of one room, outside the thread of the event loop.

    Each state is complete, so that a follower who arrives late or misses a state needs no other one.
    """

    def __init__(self, lessons: Mapping[str, Lesson]) -> None:
        self._lessons = lessons
        self._queue = RequestQueue()
        self._show: Show | None = None
        # Computes the missing results of the current state.
        self._session: Session | None = None
        self._left = 0
        self._progress: tuple[int, int] | None = None

    @property
    def has_updates(self) -> bool:
        """True if parts of the state have been computed since it was drawn."""
        return self._session is not None and self._session.background.backlog != self._left

    async def draw(self, show: Show) -> Frames | None:
        """Return the frames of a state, or None if they could not be made."""
        loop = asyncio.get_running_loop()
        done: asyncio.Future[Frames | None] = loop.create_future()

        def tell(frames: Frames | None) -> None:
            if not done.done():
                done.set_result(frames)

        def work() -> None:
            frames = None
            try:
                frames = self._draw(show)
            finally:
                loop.call_soon_threadsafe(tell, frames)

        self._queue.put(work)
        return await done

    def end(self) -> None:
        """Stop all computations."""
        self._queue.end()
        if self._session is not None:
            self._session.background.stop()

    def _draw(self, show: Show) -> Frames:
        opened = opening(show.query)
        scene, step = opened.scene, step_of(self._lessons, show)
        picture = _picture(scene, step, show.picture)
        session = Session(scene, opened.values, opened.notes, {}, [picture])
        is_same, is_going = show == self._show, self._session is not None and self._session.background.backlog > 0
        left = self._session.background.backlog if self._session is not None else 0
        answer = session.answer(Request(requested=0))
        state = answer.state
        assert state is not None, "a request for a state has one in its answer"
        # Running tasks of the same state continue: the new session finds their results in the cache. Tasks that ended
        # without a result would only fail again.
        if not (is_same and (is_going or state.progress in (None, self._progress))):
            if self._session is not None:
                self._session.background.stop()
            self._session = session
            session.start_tasks()
            left = session.background.backlog
        self._show, self._left, self._progress = show, left, state.progress
        name = f"{scene.name}/{picture}"
        state = dataclasses.replace(state, scene=name)
        return Frames(
            Response(scene=_describe(scene.name, picture)).encode(),
            Response(state=state, block=answer.block, show=self._texts(scene, picture, step, show)).encode(),
        )

    def _texts(self, scene: Scene[Any], picture: str, step: LessonStep | None, show: Show) -> str:
        """Return the texts beside the picture for followers, as JSON."""
        told: dict[str, Any] = {"scene": scene.title, "number": show.step, "revealed": show.revealed, "step": None}
        if step is not None:
            lesson = self._lessons[show.lesson]
            # Only the lecturer sees the answer.
            told["step"] = {**json.loads(describe_lesson(lesson))["steps"][show.step - 1], "answer": ""}
            told["lesson"] = lesson.title
            # The lecturer may have left the scene of the step.
            if step.prediction is None or (scene.name, picture) != (step.state.scene, step.prediction.picture):
                told["step"].pop("prediction", None)
        return json.dumps(told)


def _picture(scene: Scene[Any], step: LessonStep | None, enlarged: str) -> str:
    """Return the name of the picture for followers.

    The order of preference is: that of the prediction, the lecturer's enlarged one, the step's, the first open one.
    """
    look = step.enlarged_picture if step is not None else ""
    guess = step.prediction.picture if step is not None and step.prediction else ""
    return next(name for name in (guess, enlarged, look, *scene.open_pictures) if name in scene.pictures)


@lru_cache(maxsize=200)
def _describe(name: str, picture: str) -> str:
    """Return the description of one picture of a scene, as JSON."""
    described = json.loads(describe(name))
    [kept] = [one for one in described["pictures"] if one["name"] == picture]
    return json.dumps({**described, **_LEFT_OUT, "name": f"{name}/{picture}", "pictures": [without_gestures(kept)]})
