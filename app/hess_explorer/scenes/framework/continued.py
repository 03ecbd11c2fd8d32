"""An orbit diagram with the branch of a periodic orbit over it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from hess_explorer.protocol.parameters import Values, written
from hess_explorer.scenes.framework.branch import Begin, Continuation
from hess_explorer.scenes.framework.over_parameter import OverParameter
from hess_explorer.scenes.framework.parameters import choice
from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS, Closed
from hess_mechanics.dynamics.continuation import Branch

__all__ = ["Continued"]


@dataclass(frozen=True)
class Continued(OverParameter):
    """An orbit diagram, and over it the branch of the periodic orbit that is found from the chosen place."""

    branch: str = choice("Branch of a periodic orbit", (NONE, *PERIODS), NONE, group="State",
                         doc="Over the diagram: the periodic orbit that Newton's method finds from the chosen place, "
                             "continued in the parameter, through folds. A click on it shows that orbit.")

    @cached_property
    def continuation(self) -> Continuation | None:
        """The branch, if one is asked for."""
        if self.branch == NONE:
            return None
        (low, _), (high, _) = self.frame
        begin = Begin(self.family, self.at, self.place, PERIODS[self.branch], (min(low, self.at), max(high, self.at)))
        return Continuation(self.work, begin, self.side)

    @property
    def closed(self) -> Closed | None:
        """The orbit from which it is continued, where there is one."""
        return None if self.continuation is None else self.continuation.closed

    @property
    def continued(self) -> list[Branch]:
        """What is known of the branch."""
        return [] if self.continuation is None else self.continuation.branches

    @property
    def turn(self) -> float:
        """Of the coordinate that the diagram shows."""
        return self.section.turns[self.side]

    def choose(self, x: float, y: float) -> Values:
        """A click: on the branch, the parameter and the orbit that is there; elsewhere, what is seen there."""
        found = None if self.continuation is None else self.continuation.chosen(x, y, self.frame)
        if found is None:
            return super().choose(x, y)
        value, place, period = found
        return {self.name: value, "chosen": written([place]), "branch": f"period {period}"}

    def about(self, x: float, y: float) -> str:
        """The bifurcation, or the orbit of the branch, under the mouse."""
        return "" if self.continuation is None else self.continuation.about(x, y, self.frame)

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_diagram(self) -> str:
        if self.continuation is None:
            return super()._about_diagram()
        return self.continuation.caption or self.awaited("A periodic orbit is")

    def derived(self) -> Iterator[str]:
        """The bifurcations of the branch."""
        if self.continuation is not None:
            yield from self.continuation.derived()

    def status(self) -> Iterator[str]:
        """How exact the branch is."""
        if self.continuation is not None:
            yield from self.continuation.status()

    def notes(self) -> Iterator[str]:
        """Why there is no branch, or why it ends within the range."""
        yield from super().notes()
        if self.continuation is not None:
            yield from self.continuation.notes()
