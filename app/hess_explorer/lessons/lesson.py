"""What a lesson is: steps, each a text, a state of a scene, and what is done with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from hess_explorer.protocol.parameters import Values

__all__ = ["TIME", "Animation", "Lesson", "LessonError", "LessonStep", "Prediction", "StateLink"]

TIME = "time"
"""Animated like a parameter: it is that of the player."""


class LessonError(Exception):
    """A lesson that cannot be given: file, line, what is wrong and what to write.

    message : with what is allowed; line : of the file, from 1.
    """

    def __init__(self, message: str, line: int, file: str = "") -> None:
        self.message, self.line, self.file = message, line, file
        super().__init__(f"{file}, line {line}: {message}" if file else f"line {line}: {message}")


@dataclass(frozen=True)
class StateLink:
    """A state of a scene: all its values, within their bounds."""

    scene: str
    values: Values


@dataclass(frozen=True)
class Animation:
    """A number of the scene, or `TIME`, that goes from `start` to `end` in so many seconds."""

    name: str
    start: float
    end: float
    seconds: float


@dataclass(frozen=True)
class Prediction:
    """What the audience places in a picture before it is there.

    picture, layer : what is the truth, in the state `then`, which is shown when it is revealed.
    source, columns : where the browser finds it: positions (x, y), or those of curves.
    what : "point": one click, the truth is the nearest of the points; "curve": clicks along a curve.
    """

    picture: str
    layer: str
    source: str
    columns: tuple[str, str]
    what: Literal["point", "curve"]
    then: StateLink


@dataclass(frozen=True)
class LessonStep:
    """One page of a lesson.

    text, answer : Markdown; `answer` is hidden until it is asked for.  look : the picture to look at, "" for all alike.
    """

    title: str
    text: str
    at: StateLink
    look: str = ""
    animation: Animation | None = None
    question: str = ""
    answer: str = ""
    prediction: Prediction | None = None


# Its values are a mapping: it is equal to itself alone.
@dataclass(frozen=True, eq=False)
class Lesson:
    """A lesson; name : as in a link; minutes : how long it takes, 0 if nobody counts them."""

    name: str
    title: str
    minutes: float
    steps: tuple[LessonStep, ...]
