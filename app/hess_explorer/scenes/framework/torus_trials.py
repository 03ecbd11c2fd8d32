"""The trial of the boundary of the lock zone, for scenes of the Suslov–Hess tori."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.views.comparison import Curves, Frame, compared
from hess_mechanics.numerics.accuracy import Kind, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["boundary"]

S = TypeVar("S", bound=State)


def boundary(picture: str, run: Callable[[S, Plan], Array], frame: Callable[[S], Frame]) -> Trial[S]:
    """Return the trial of the curve |t| = 2 (n, 2) in a picture; run(state, plan) computes the curve."""

    def look(s: S, found: Array) -> Curves:
        return Curves(frame(s), (found,) if len(found) else ())

    def error(s: S, found: Array, truth: Array) -> float:
        difference = compared(look(s, found), look(s, truth))
        return difference.largest if len(difference.same) + len(difference.changed) and len(truth) else math.nan

    return Trial(Kind.CURVE, (picture,), run, error, look)
