"""Speed and accuracy of a scene that shows no motion: cost of all that it computes, and what more accuracy changes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from hess_explorer.scenes.framework.costs import Costs, difference_picture, trade_picture
from hess_explorer.scenes.framework.looking_into import LookingInto
from hess_explorer.scenes.framework.scene import Scene

__all__ = ["without_motion"]


@dataclass(frozen=True)
class Tally(Costs):
    """What is measured where there is no motion to follow."""

    def derived(self) -> Iterator[str]:
        """What is computed, and what was measured of it."""
        yield f"Computed: {', '.join(str(trial.kind) for trial in self.trials)}"
        yield from self.measured_rows()

    def status(self) -> Iterator[str]:
        """The level."""
        yield f"{self.chosen} chosen"


def without_motion(other: Scene[Any]) -> Scene[Any]:
    """The scene "Speed and accuracy" for another one that shows no motion, with its parameters."""
    return LookingInto(
        Tally, __file__, other=other, title="Speed and accuracy", presets=other.presets, place=other.place,
        group="Accuracy", essential=other.essential,
        summary="Cost and error of all that the scene computes, at every level of accuracy, measured here and now.",
        views=(trade_picture(other.trials, folded=False), difference_picture(folded=False)))
