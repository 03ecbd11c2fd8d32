"""What a scene computes at the level that is chosen, kind by kind, so that cost and error can be measured at each."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from hess_explorer.scenes.framework.work import Work
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import HALF_A_PIXEL, errors_in_pixels
from hess_mechanics.dynamics.trade import Sample, measure, measure_until
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import STANDARD, Kind, Plan
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from hess_explorer.scenes.framework.scene import State

__all__ = ["Trial", "bare", "colour_error", "curve_error", "measured", "needed", "orbit_trial", "section_error"]

S = TypeVar("S", bound="State")

_SAMPLES = 400
_COLOURS = 256.0
"""Steps of a colour map."""
_LOST, _CHAOTIC, _NOTHING = 30.0, 30.0, 1e-6
"""Pixels by which an orbit is another one; by what the errors of the second half of an orbit exceed those of the first,
where neighbours part exponentially; and pixels that are round-off."""


def _always(state: State) -> bool:
    return True


@dataclass(frozen=True)
class Trial(Generic[S]):
    """One kind of computation of a scene.

    kind, pictures : which, and the pictures that show it; none: all of them.
    run(state, plan) : computes it as the scene does, by itself; error(state, result, truth) : in the `unit`.
    seen : the largest error that cannot be seen; shown(state) : whether the pictures have it now.
    """

    kind: Kind
    pictures: tuple[str, ...]
    run: Callable[[S, Plan], Any]
    error: Callable[[S, Any, Any], float]
    unit: str = "pixels"
    seen: float = HALF_A_PIXEL
    shown: Callable[[S], bool] = _always


def bare(state: S) -> S:
    """The state whatever its accuracy and pictures in sight, for the cache."""
    typed: Any = state
    accuracy = {"accuracy": STANDARD.name} if hasattr(state, "accuracy") else {}
    found: S = replace(typed, **accuracy, work=Work(), seen=frozenset(), drawn={})
    return found


def measured(trial: Trial[S], state: S) -> tuple[Sample, ...]:
    """Time and error of each level, for a `bare` state.  Raises `ModelError`."""
    return measure(trial.kind, lambda plan: trial.run(state, plan), lambda *both: trial.error(state, *both))


def needed(trial: Trial[S], state: S) -> str:
    """The cheapest level whose error cannot be seen; `standard` for what cannot be computed."""
    try:
        return measure_until(trial.kind, lambda plan: trial.run(state, plan),
                             lambda *both: trial.error(state, *both), trial.seen)
    except ModelError:
        return STANDARD.name


def _orbit(state: State, plan: Plan) -> Array:
    motion = state.motion()
    assert motion is not None, "only scenes with a motion have this trial"
    times = np.linspace(0.0, motion.span, _SAMPLES)
    return solve(motion.system, motion.state, motion.parameters, times, plan.level).states


def _orbit_error(state: State, states: Array, truth: Array) -> float:
    motion = state.motion()
    assert motion is not None
    away, first = np.abs(states - truth) * np.asarray(motion.weights), motion.system.angular_velocities
    return float(max(np.linalg.norm(part, axis=1).max() for part in (away[:, :first], away[:, first:])))


def orbit_trial() -> Trial[Any]:
    """The motion on show."""
    return Trial(Kind.ORBIT, (), _orbit, _orbit_error)


def curve_error(values: Array, exact: Array, height: float, period: float = math.inf) -> float:
    """The largest error of a curve (n,) in pixels of an axis of that length; period : of an angle, ∞ for none."""
    away = values - exact
    if math.isfinite(period):
        away = away - period * np.round(away / period)
    return PIXELS / height * float(np.abs(away).max())


def colour_error(values: Array, exact: Array) -> float:
    """The error that 99 of 100 values are below, in steps of a colour map that covers one turn; 0.0 without values."""
    return _COLOURS * float(np.percentile(np.abs(values - exact), 99.0)) if values.size else 0.0


def section_error(orbits: Sequence[Array], truth: Sequence[Array], pixels: Sequence[float],
                  periods: Sequence[float] = (math.inf,) * 2) -> float:
    """The largest error of orbits (n, 2) in pixels, chaotic ones aside: no level keeps those to their end."""
    worst = 0.0
    for one, other in zip(orbits, truth, strict=True):
        away = errors_in_pixels(one, other, pixels, periods)
        early, late = (part.max(initial=0.0) for part in np.array_split(away, 2))
        if max(early, late) < _LOST and late <= max(_CHAOTIC * early, _NOTHING):
            worst = max(worst, float(early), float(late))
    return worst
