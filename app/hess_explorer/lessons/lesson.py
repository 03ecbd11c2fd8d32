"""A lesson: steps with a text, a state of a scene, and an optional animation, question or prediction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from hess_explorer.protocol.specs import Values
from hess_mechanics.errors import ModelError

TIME = "time"
"""Name of the player's time, which can be animated like a parameter."""


class LessonError(ModelError):
    """A lesson file is invalid; the error message contains file, line, problem and remedy.

    Attributes
    ----------
    message : str
        The problem and what is allowed.
    line : int
        Line of the file, from 1.
    file : str
        Name of the file; empty if unknown.
    """

    def __init__(self, message: str, line: int, file: str = "") -> None:
        self.message, self.line, self.file = message, line, file
        super().__init__(f"{file}, line {line}: {message}" if file else f"line {line}: {message}")


@dataclass(frozen=True)
class StateLink:
    """A state of a scene.

    Attributes
    ----------
    scene : str
        Name of the scene.
    values : mapping of str to float or str
        Values of all parameters, within their bounds.
    """

    scene: str
    values: Values


@dataclass(frozen=True)
class Animation:
    """A parameter of the scene, or `TIME`, that changes from `start` to `end`.

    Attributes
    ----------
    name : str
        Name of the parameter, or `TIME`.
    start, end : float
        First and last value.
    seconds : float
        Duration of the change in seconds.
    """

    name: str
    start: float
    end: float
    seconds: float


@dataclass(frozen=True)
class HiddenLayer:
    """A layer of a picture that a step does not show.

    Attributes
    ----------
    picture : str
        Name of the picture.
    source : str
        Data source of the layer in the browser.
    """

    picture: str
    source: str


@dataclass(frozen=True)
class Prediction:
    """A layer of a picture whose position the audience guesses before it is shown.

    Attributes
    ----------
    picture : str
        Name of the picture.
    source : str
        Data source of the hidden layer in the browser.
    columns : tuple of str
        Names of its columns with positions (x, y) of points or curves.
    kind : str
        "point" for one click, compared with the nearest point; "curve" for clicks along a curve.
    outcome : StateLink
        State in which the layer is shown.
    """

    picture: str
    source: str
    columns: tuple[str, str]
    kind: Literal["point", "curve"]
    outcome: StateLink


@dataclass(frozen=True)
class LessonStep:
    """One step of a lesson.

    Attributes
    ----------
    title, text, question, answer : str
        Markdown; question and answer are empty for none, and the answer is hidden at first.
    state : StateLink
        State of the step, before its prediction is revealed.
    enlarged_picture : str
        Name of the picture to enlarge, "" for none.
    animation : Animation or None
        Change of a parameter or the time.
    prediction : Prediction or None
        Guess at a layer.
    controls : tuple of str
        Names of the parameters whose controls are beside the text.
    hidden_layer : HiddenLayer or None
        Layer that is not shown.
    pictures : tuple of str
        Names of the pictures that the step shows alone, over its text; empty for the whole page.
    line : int
        Line of its heading in the file.
    """

    title: str
    text: str
    state: StateLink
    enlarged_picture: str = ""
    animation: Animation | None = None
    question: str = ""
    answer: str = ""
    prediction: Prediction | None = None
    controls: tuple[str, ...] = ()
    hidden_layer: HiddenLayer | None = None
    pictures: tuple[str, ...] = ()
    line: int = field(default=0, compare=False)


# Lessons compare by identity, because the values of their states are mappings, which are not hashable.
@dataclass(frozen=True, eq=False)
class Lesson:
    """A lesson.

    Attributes
    ----------
    name : str
        Name in links.
    title : str
        Title in the menu.
    minutes : float
        Duration in minutes, 0 if unknown.
    steps : tuple of LessonStep
        The steps in their order.
    images : mapping of str to str
        URLs of the images by target.
    """

    name: str
    title: str
    minutes: float
    steps: tuple[LessonStep, ...]
    images: Mapping[str, str] = field(default_factory=dict)
