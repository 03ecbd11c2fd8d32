"""What a scene is: its parameters, what it computes, its pictures, its words."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Choice, Spec, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_mechanics.dynamics.system import System

__all__ = ["Boxed", "Hovered", "Motion", "Picture", "Preset", "Report", "Scene", "Stage"]


@dataclass(frozen=True)
class Preset:
    """A named state: the differences from the scene's defaults."""

    name: str
    values: Values


class Picture(Protocol):
    """One picture on the page; its caption is the text of that name."""

    name: str
    kind: str
    """Who draws it in the browser: "plot" is Bokeh, others are in "pictures.js"."""

    def describe(self) -> dict[str, Any]:
        """Name, kind, and what else the browser needs to know before the first data."""

    def show_nothing(self, sentence: str) -> None:
        """Draw nothing but the reason."""


@dataclass(frozen=True)
class Report:
    """What the page says beside the pictures: derived quantities, the status line, notes.

    todo : what is still to be computed before the state is complete; total : of how many pieces.
    """

    derived: Sequence[str]
    status: str
    notes: Sequence[str] = field(default=())
    todo: Sequence[Task] = field(default=())
    total: int = 0


@runtime_checkable
class Boxed(Protocol):
    """A stage in whose pictures a box can be drawn with the mouse."""

    def box(self, picture: str, corners: tuple[float, float, float, float]) -> Values:
        """The values that a box from (x0, y0) to (x1, y1) of a picture chooses."""


@runtime_checkable
class Hovered(Protocol):
    """A stage that says something of the place under the mouse."""

    def hover(self, picture: str, x: float, y: float) -> str:
        """One line on the place (x, y) of a picture.  Raises `ModelError`."""


class Stage(Protocol):
    """The pictures of a scene in one session; what they show goes by the wire that they were made with."""

    pictures: Sequence[Picture]

    dots: Mapping[str, tuple[str, str]]
    """For the player: source of a moving point → columns of the source `data-orbit`."""

    angles: Sequence[str]
    """Those of the columns that are angles."""

    def show(self, result: Any, hold_axes: bool) -> Report:
        """Draw a result, and say the captions."""

    def fail(self, sentence: str) -> None:
        """Draw nothing but this sentence."""

    def pick(self, picture: str, x: float, y: float) -> Values:
        """The values that a click at (x, y) of a picture chooses."""


@dataclass(frozen=True)
class Motion:
    """One motion of a system: what "Speed and accuracy" looks into.

    system, state, parameters, span : as for `models.solve`, in the units of the computation.
    weights : (d,) from the variables to the scene's pictures, in pixels for a unit.
    unit : the time of the page in these units of time, so that t = time of the computation × unit.
    """

    system: System
    state: tuple[float, ...]
    parameters: tuple[float, ...]
    span: float
    weights: tuple[float, ...]
    unit: float


@dataclass(frozen=True)
class Scene:
    """One scene of the explorer.

    pictures : their names.  A picture that cannot be seen is not computed.
    folded : those of them that are not seen until a button is pressed, and what it says.
    admit(values) : values that are possible together, and notes on what was changed.
    limits(values) : slider ranges (low, high, step) that depend on other values.
    compute(values, shown, dragging) : what the pictures `shown` need, from admitted values; while a slider is
        dragged at the cheapest accuracy that is right to a pixel.  Raises `ModelError`.
    stage(wire) : the pictures of one session.
    legend : HTML; thumbnail : the inside of a 48 × 32 SVG for the menu of scenes.
    motion(values) : the motion on show, for the scene "Speed and accuracy" of this one.
    origin : the name of the scene whose motion this one looks into.
    place : its place in the menu; the first one opens the page.
    """

    name: str
    title: str
    summary: str
    specs: tuple[Spec, ...]
    presets: tuple[Preset, ...]
    words: str
    pictures: tuple[str, ...]
    admit: Callable[[Values], tuple[dict[str, Value], list[str]]]
    limits: Callable[[Values], Mapping[str, tuple[float, float, float]]]
    compute: Callable[[Values, Collection[str], bool], Any]
    stage: Callable[[Wire], Stage]
    legend: str
    thumbnail: str
    motion: Callable[[Values], Motion] | None = None
    origin: str | None = None
    place: int = 0
    folded: Mapping[str, str] = field(default_factory=dict)

    @property
    def open_pictures(self) -> tuple[str, ...]:
        """The pictures that are seen at first."""
        return tuple(name for name in self.pictures if name not in self.folded)

    def defaults(self) -> dict[str, Value]:
        """The state a newcomer sees."""
        return {spec.name: spec.default for spec in self.specs}

    def example(self, preset: Preset) -> dict[str, Value]:
        """All numbers and places of a preset; choices such as the accuracy stay as they are."""
        numbers = {spec.name: spec.default for spec in self.specs if not isinstance(spec, Choice)}
        return {**numbers, **preset.values}
