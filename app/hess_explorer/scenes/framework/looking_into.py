"""A scene that looks into the motion of another one: with its parameters, and pictures of its own."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

from hess_explorer.protocol.parameters import Choice, Spec, Value, Values
from hess_explorer.scenes.framework.parameters import Slider
from hess_explorer.scenes.framework.scene import Motion, Scene, State
from hess_explorer.scenes.framework.trial import Refused, Trial, bare, differing, measured, next_level
from hess_explorer.views.comparison import Difference
from hess_mechanics.dynamics.trade import LevelCost
from hess_mechanics.numerics.accuracy import Computation

__all__ = ["Insight", "LookingInto"]

I = TypeVar("I", bound="Insight")

COMPARED = "difference"
"""The parameter that says what is compared."""
_COSTLIEST = (Computation.ROTATION, Computation.BASINS, Computation.INDICATOR, Computation.SECTION, Computation.GRID,
              Computation.CLOUD, Computation.COLOURS,
              Computation.MAP, Computation.CURVE, Computation.LINE, Computation.EXPONENT, Computation.ORBIT)
"""From what takes longest on: as `hess-explorer bench --trade` measures it."""


@dataclass(frozen=True)
class Insight(State):
    """A state of such a scene; that of the other one is a part of it, so no name of one can hide a name of the other.

    shown : the state of the other scene; trials : what is computed there; difference : the name of the kind of those
    whose levels are compared.
    """

    shown: State
    trials: tuple[Trial[Any], ...]
    difference: str

    @cached_property
    def costs(self) -> dict[Computation, tuple[LevelCost, ...] | Refused | None]:
        """Time and error of every level, for each kind of computation, or why not; None until it is known."""
        plain = bare(self.shown)
        return {trial.kind: None if self.dragging else self.work.later(measured, trial, plain)
                for trial in self.trials if trial.shown(plain)}

    @property
    def chosen(self) -> str:
        """The name of the level of accuracy on show, whether or not a slider is held."""
        return self.work.chosen

    @property
    def compared(self) -> Trial[Any]:
        """What of it is compared."""
        return next(trial for trial in self.trials if trial.kind == self.difference)

    @cached_property
    def changes(self) -> Difference | Refused | None:
        """What the next more exact level changes, or why that is not found; None until it is known, and where there is
        nothing to compare."""
        plain, finer = bare(self.shown), next_level(self.chosen)
        if self.dragging or finer is None or not self.compared.shown(plain):
            return None
        return self.work.later(differing, self.compared, plain, self.chosen, finer)

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
        """The parameters of the other scene, and which of its computations is compared, where there are several."""
        kinds = tuple(str(trial.kind) for trial in self.other.trials)
        choice = Choice(COMPARED, "What is compared", kinds, self._costliest,
                        "Of the scene, at the chosen level and at the next more exact one.")
        return (*self.other.specs, choice) if len(kinds) > 1 else self.other.specs

    @property
    def _costliest(self) -> str:
        """The kind that takes longest of what a newcomer sees there."""
        plain = bare(self.other.of(self.other.defaults()))
        return str(min((trial.kind for trial in self.other.trials if trial.shown(plain)), key=_COSTLIEST.index))

    def in_sight(self, state: I) -> Iterator[tuple[Trial[Any], State]]:
        """All that the other scene computes."""
        plain = bare(state.shown)
        return ((trial, plain) for trial in self.other.trials if trial.shown(plain))

    def of(self, values: Values, seen: Collection[str] = (), dragging: bool = False) -> I:
        """The state of these values; nothing is computed yet."""
        shown = self.other.of(values, seen, dragging)
        difference = str(values.get(COMPARED, self._costliest))
        return self.state(shown, self.other.trials, difference, work=shown.work, seen=shown.seen)

    def admit(self, values: Values) -> tuple[dict[str, Value], list[str]]:
        """As the other scene does."""
        admitted, notes = self.other.admit(values)
        for spec in self.specs[len(self.other.specs) :]:
            admitted[spec.name], note = spec.read(str(values[spec.name]))
            notes += [note] if note else []
        return admitted, notes

    def limits(self, values: Values) -> dict[str, Slider]:
        """As the other scene has them."""
        return dict(self.other.limits(values))
