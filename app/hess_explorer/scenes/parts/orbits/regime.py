"""The regime of a motion: its kind, its attractor and its repeller."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Part, Sectioned
from hess_explorer.views.caption import Caption
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.parameter_diagram import Sets, at_state, sets_of
from hess_mechanics.dynamics.regime import Dynamics
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import Array

__all__ = ["Regime"]

_NOTHING = np.empty((0, 2))
_MANY = 24
"""Largest number of places drawn as large marks: so few dots would be hard to see."""


class _Host(Sectioned, Protocol):
    @property
    def place(self) -> tuple[float, float]:
        """The start of the motion.  Raises `ModelError`."""


@dataclass(frozen=True, eq=False)
class Regime(Part[_Host]):
    """The kind of motion that starts at a place of a section, with its attractor and its repeller.

    long : the averaging time of the divergence.
    """

    long: float

    @cached_property
    def sets(self) -> Sets | None:
        """Attractor and repeller; None until known."""
        few = (60, 120) if self.work.dragging else (500, 1500)
        task = Task(sets_of, self.host.poincare, self.host.place, *few, self.work.plan(Kind.SECTION).level)
        return self.work.need(task, preview=task if self.work.dragging else None)

    @property
    def attractor(self) -> Array:
        """Places (n, 2) of the attractor."""
        return _NOTHING if self.sets is None else self.sets.attractor

    @property
    def repeller(self) -> Array:
        """Places (n, 2) of the repeller."""
        return _NOTHING if self.sets is None else self.sets.repeller

    @cached_property
    def kind(self) -> Dynamics | None:
        """The kind of motion and of dynamics; None until known."""
        if self.work.dragging:
            return None
        t, level = self.work.plan(Kind.EXPONENT).share * self.long, self.work.plan(Kind.SECTION).level
        task = Task(at_state, self.host.poincare, self.host.place, 500, 1500, t, level)
        # It takes as long as the diagram, whose orbits and doublings come first.
        return self.work.newest([[task]], last=True)[0]

    @property
    def caption(self) -> Caption:
        """The caption: the kind of motion, conservative or dissipative."""
        found = self.kind
        if found is None:
            return Caption(self.work.awaited())
        motion = found.motion
        kind = f"Period {motion.period}" if motion.period else motion.kind.words.capitalize()
        if not found.comparisons:
            return Caption(f"{kind}.", "Attractor and repeller are not compared: the orbit leaves.")
        if found.verdict == "not told apart":
            return Caption(
                f"{kind}.", f"Attractor and repeller not distinguished; |mean div| < {digits(motion.bound, 1)}."
            )
        if motion.map_.volume_kept:
            return Caption(f"{kind}. Conservative: volume is preserved.")
        if motion.measure:
            return Caption(f"{kind}. Conservative: mean div = 0.", f"{motion.measure[0].upper()}{motion.measure[1:]}.")
        div = f"div = {digits(motion.divergence, 2)} ± {digits(motion.divergence_error, 1)}"
        away = f"{digits(found.distance, 2)} ± {digits(found.distance_error, 1)} away"
        # Short enough for four lines in a small cell.
        return Caption(f"{kind}. Looks {found.verdict}.", f"{div}; repeller {away}.")


def few(found: Array) -> Array | None:
    """Return the distinct places (2, m) if there are few, to be drawn as large marks; else None."""
    _, first = np.unique(np.round(found, 4), axis=0, return_index=True)
    return found[first].T if 0 < len(first) <= _MANY else None
