"""A scene that looks into the motion of another one: with its parameters, and pictures of its own."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

from hess_explorer.protocol.parameters import Spec, Value, Values
from hess_explorer.scenes.framework.parameters import Slider
from hess_explorer.scenes.framework.scene import Motion, Scene, State
from hess_explorer.scenes.framework.trial import Trial, bare, measured
from hess_mechanics.dynamics.trade import Sample
from hess_mechanics.numerics.accuracy import Kind

__all__ = ["Insight", "LookingInto"]

I = TypeVar("I", bound="Insight")


@dataclass(frozen=True)
class Insight(State):
    """A state of such a scene; that of the other one is a part of it, so no name of one can hide a name of the other.

    shown : the state of the other scene; trials : what is computed there.
    """

    shown: State
    trials: tuple[Trial[Any], ...]

    @cached_property
    def costs(self) -> dict[Kind, tuple[Sample, ...] | None]:
        """Time and error of every level, for each kind of computation; None until it is known."""
        plain = bare(self.shown)
        return {trial.kind: None if self.dragging else self.work.later(measured, trial, plain)
                for trial in self.trials if trial.shown(plain)}

    @property
    def chosen(self) -> str:
        """The name of the level of accuracy on show, whether or not a slider is held."""
        return self.work.chosen

    @cached_property
    def shown_motion(self) -> Motion:
        """The motion on show there.  Raises `ModelError`."""
        motion = self.shown.motion()
        assert motion is not None, "only scenes with a motion are looked into"
        return motion


@dataclass(frozen=True, repr=False)
class LookingInto(Scene[I]):
    """A scene for the motions of the scene `other`; its state is an `Insight`."""

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
        """The parameters of the other scene."""
        return self.other.specs

    def in_sight(self, state: I) -> Iterator[tuple[Trial[Any], State]]:
        """All that the other scene computes."""
        plain = bare(state.shown)
        return ((trial, plain) for trial in self.other.trials if trial.shown(plain))

    def of(self, values: Values, seen: Collection[str] = (), dragging: bool = False) -> I:
        """The state of these values; nothing is computed yet."""
        shown = self.other.of(values, seen, dragging)
        return self.state(shown, self.other.trials, work=shown.work, seen=shown.seen)

    def admit(self, values: Values) -> tuple[dict[str, Value], list[str]]:
        """As the other scene does."""
        return self.other.admit(values)

    def limits(self, values: Values) -> dict[str, Slider]:
        """As the other scene has them."""
        return dict(self.other.limits(values))
