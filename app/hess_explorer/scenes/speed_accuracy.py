"""Speed and accuracy of another scene: its errors and costs at every level, measured here and now."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from hess_explorer.protocol.parameters import Choice, Spec, Value, Values
from hess_explorer.scenes.framework.parameters import Slider
from hess_explorer.scenes.framework.scene import Scene, State
from hess_explorer.scenes.framework.trial import Trial, bare
from hess_explorer.scenes.parts.comparison import Comparison
from hess_explorer.scenes.parts.costs import Costs
from hess_explorer.scenes.parts.precision import Precision
from hess_explorer.views.picture import Picture
from hess_mechanics.numerics.accuracy import Computation

__all__ = ["SpeedAccuracy", "speed_and_accuracy"]

_COMPARED = "difference"
"""The parameter that says what is compared."""
_COSTLIEST = (
    Computation.ROTATION,
    Computation.BASINS,
    Computation.INDICATOR,
    Computation.SECTION,
    Computation.GRID,
    Computation.CLOUD,
    Computation.COLOURS,
    Computation.MAP,
    Computation.CURVE,
    Computation.LINE,
    Computation.EXPONENT,
    Computation.ORBIT,
)
"""From what takes longest on: as `hess-explorer bench --trade` measures it."""


@dataclass(frozen=True)
class Study(State):
    """What is measured of a state of the other scene.

    shown : that state; trials : what is computed there; difference : the name of the kind of those whose levels are
    compared.
    """

    shown: State
    trials: tuple[Trial[Any], ...]
    difference: str

    @cached_property
    def costs(self) -> Costs:
        """Time and error of all that the state shows."""
        plain = bare(self.shown)
        return Costs(self.work, plain, tuple(trial for trial in self.trials if trial.shown(plain)))

    @cached_property
    def comparison(self) -> Comparison:
        """What the next level changes."""
        compared = next(trial for trial in self.trials if trial.kind == self.difference)
        return Comparison(self.work, bare(self.shown), compared)

    @cached_property
    def precision(self) -> Precision | None:
        """The motion at every level; None for a scene without one.  Raises `ModelError`."""
        motion = self.shown.motion()
        return None if motion is None else Precision(self.work, motion)

    def limits(self) -> Mapping[str, Slider]:
        """As the other scene has them."""
        return self.shown.limits()

    def derived(self) -> Iterator[str]:
        """What was measured and compared in the pictures in sight; the motion, or what is computed without one."""
        if self.precision is None:
            yield f"Computed: {', '.join(str(trial.kind) for trial in self.trials)}"
        if "trade" in self.seen:
            yield from self.costs.rows()
        if "difference" in self.seen:
            yield from self.comparison.rows()
        if self.precision is not None:
            yield from self.precision.derived()

    def status(self) -> Iterator[str]:
        """The level, and what every level costs."""
        yield f"{self.work.chosen} chosen"
        if self.precision is not None:
            yield from self.precision.status()

    def notes(self) -> Iterator[str]:
        """What was left out, and why."""
        if self.precision is not None:
            yield from self.precision.notes()


def _precision(state: Study) -> Precision:
    assert state.precision is not None, "only scenes with a motion have these pictures"
    return state.precision


@dataclass(frozen=True, repr=False)
class SpeedAccuracy(Scene[Study]):
    """The scene "Speed and accuracy" of the scene `other`, with the same parameters."""

    other: Scene[Any] = field(kw_only=True)

    @property
    def origin(self) -> str:
        """The name of the other scene."""
        return self.other.name

    @property
    def name(self) -> str:
        """As in a link."""
        return f"{self.origin}-accuracy"

    @cached_property
    def specs(self) -> tuple[Spec, ...]:
        """The parameters of the other scene, and which of its computations is compared, where there are several."""
        kinds = tuple(str(trial.kind) for trial in self.other.trials)
        choice = Choice(
            _COMPARED,
            "What is compared",
            kinds,
            self._costliest,
            "Of the scene, at the chosen level and at the next more exact one.",
        )
        return (*self.other.specs, choice) if len(kinds) > 1 else self.other.specs

    @cached_property
    def _costliest(self) -> str:
        """The kind that takes longest of what a newcomer sees there."""
        plain = bare(self.other.of(self.other.defaults()))
        return str(min((trial.kind for trial in self.other.trials if trial.shown(plain)), key=_COSTLIEST.index))

    def in_sight(self, state: Study) -> Iterator[tuple[Trial[Any], State]]:
        """All that the other scene computes."""
        return ((trial, state.costs.shown) for trial in state.costs.trials)

    def of(self, values: Values, seen: Collection[str] = (), dragging: bool = False) -> Study:
        """The state of these values; nothing is computed yet."""
        shown = self.other.of(values, seen, dragging)
        difference = str(values.get(_COMPARED, self._costliest))
        return Study(shown, self.other.trials, difference, work=shown.work, seen=shown.seen)

    def admit(self, values: Values) -> tuple[dict[str, Value], list[str]]:
        """As the other scene does."""
        admitted, notes = self.other.admit(values)
        for spec in self.specs[len(self.other.specs) :]:
            admitted[spec.name], note = spec.read(str(values[spec.name]))
            notes += [note] if note else []
        return admitted, notes


def speed_and_accuracy(other: Scene[Any]) -> SpeedAccuracy:
    """The scene "Speed and accuracy" of another one, whether or not that shows a motion."""
    moving = other.has_motion
    words, about = (
        ("speed_accuracy", "Error, drift and cost of the motion on show")
        if moving
        else ("speed_accuracy_of_maps", "Cost and error of all that the scene computes")
    )
    pictures: list[Picture[Study]] = [one.of_part(_precision) for one in Precision.pictures()] if moving else []
    if other.measures:
        pictures.append(Costs.picture(other.trials, folded=moving).of_part(lambda s: s.costs))
    pictures.append(Comparison.picture(folded=moving).of_part(lambda s: s.comparison))
    return SpeedAccuracy(
        Study,
        str(Path(__file__).with_name(f"{words}.md")),
        other=other,
        title="Speed and accuracy",
        presets=other.presets,
        place=other.place,
        group="Accuracy",
        essential=other.essential,
        summary=f"{about}, at every level of accuracy, measured here and now.",
        tracks={"orbit": lambda s: _precision(s).track()} if moving else {},
        views=tuple(pictures),
    )
