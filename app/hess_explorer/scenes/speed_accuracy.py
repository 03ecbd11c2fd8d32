"""Speed and accuracy of another scene: its errors and costs at every level, measured live."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from hess_explorer.protocol.specs import Spec, Value, Values
from hess_explorer.scenes.framework.scene import Scene, State
from hess_explorer.scenes.framework.sliders import Slider
from hess_explorer.scenes.framework.trial import Trial, bare_state
from hess_explorer.scenes.parts.orbits.costs import Costs, costs_picture
from hess_explorer.scenes.parts.orbits.precision import PRECISION_PICTURES, Precision
from hess_explorer.views.picture import Picture


@dataclass(frozen=True)
class Study(State):
    """Measurements of a state of another scene.

    Attributes
    ----------
    base : State
        State of the other scene.
    trials : tuple of Trial
        Computations of that scene.
    """

    base: State
    trials: tuple[Trial[Any], ...]

    @cached_property
    def costs(self) -> Costs:
        """Time and error of all computations that apply to the state."""
        plain = bare_state(self.base)
        return Costs(self.work, plain, tuple(trial for trial in self.trials if trial.condition(plain)))

    @cached_property
    def precision(self) -> Precision | None:
        """The motion at every level; None for a scene without a motion.  Raises `ModelError`."""
        motion = self.base.motion()
        return None if motion is None else Precision(self.work, motion)

    def limits(self) -> Mapping[str, Slider]:
        """Return the slider ranges of the other scene."""
        return self.base.limits()

    def quantities(self) -> Iterator[str]:
        """Yield the results for the visible pictures, and the motion or the kinds of computation."""
        if self.precision is None:
            yield f"Computed: {', '.join(str(trial.kind) for trial in self.trials)}"
        if "trade" in self.visible:
            yield from self.costs.rows()
        if self.precision is not None:
            yield from self.precision.quantities()

    def status(self) -> Iterator[str]:
        """Yield the chosen level and the cost of every level."""
        yield f"{self.work.level_name} chosen"
        if self.precision is not None:
            yield from self.precision.status()

    def notes(self) -> Iterator[str]:
        """Yield the omitted measurements and the reasons."""
        if self.precision is not None:
            yield from self.precision.notes()


def _precision(state: Study) -> Precision:
    assert state.precision is not None, "only scenes with a motion have these pictures"
    return state.precision


@dataclass(frozen=True, repr=False)
class SpeedAccuracy(Scene[Study]):
    """The scene "Speed and accuracy" of another scene, with the same parameters.

    Attributes
    ----------
    other : Scene
        The other scene.
    """

    other: Scene[Any] = field(kw_only=True)

    @property
    def origin(self) -> str:
        """The name of the other scene."""
        return self.other.name

    @property
    def name(self) -> str:
        """The name in links."""
        return f"{self.origin}-accuracy"

    @cached_property
    def specs(self) -> tuple[Spec, ...]:
        """The parameters of the other scene."""
        return self.other.specs

    def visible_trials(self, state: Study) -> Iterator[tuple[Trial[Any], State]]:
        """Return the computations of the other scene that apply to the state, each with the state to compute."""
        return ((trial, state.costs.base) for trial in state.costs.trials)

    def of(self, values: Values, visible: Collection[str] = (), is_preview: bool = False) -> Study:
        """Return the state with these values, without computing anything."""
        base = self.other.of(values, visible, is_preview)
        return Study(base, self.other.trials, work=base.work, visible=base.visible)

    def admit(self, values: Values) -> tuple[dict[str, Value], list[str]]:
        """Return valid values and notes, by the rules of the other scene."""
        return self.other.admit(values)


def speed_and_accuracy(other: Scene[Any]) -> SpeedAccuracy:
    """Return the scene "Speed and accuracy" of another scene."""
    moving = other.has_motion
    words, about = (
        ("speed_accuracy", "Error, drift and cost of the motion")
        if moving
        else ("speed_accuracy_of_maps", "Cost and error of all computations of the scene")
    )
    pictures: list[Picture[Study]] = [one.of(_precision) for one in PRECISION_PICTURES if moving]
    if other.level_trials:
        pictures.append(costs_picture(other.trials, folded=moving).of(lambda s: s.costs))
    return SpeedAccuracy(
        Study,
        str(Path(__file__).with_name(f"{words}.md")),
        other=other,
        title="Speed and accuracy",
        presets=other.presets,
        place=other.place,
        group="Accuracy",
        essential=other.essential,
        summary=f"{about} at every level of accuracy, measured live.",
        tracks={"orbit": lambda s: _precision(s).track()} if moving else {},
        views=tuple(pictures),
    )
