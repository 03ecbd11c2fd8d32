"""Trials: measure the cost and error of a scene's computations at each level of accuracy."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from hess_explorer.compute.budget import OverBudget
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.layers import Axes
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import HALF_A_PIXEL, distances_to_curve, errors_in_pixels, has_diverged
from hess_mechanics.dynamics.trade import LevelCost, SharedSetting, first_sufficient, measure
from hess_mechanics.dynamics.work_precision import longest_duration
from hess_mechanics.dynamics.work_precision import truth as exactly
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import STANDARD, Kind, Plan
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from hess_explorer.scenes.framework.scene import Motion, State

S = TypeVar("S", bound="State")

_SAMPLES = 400
_COLOUR = 1.0 / 256.0
"""One step of a colour map that covers one turn of an angle."""
COLOUR_UNIT = "steps of the colour, 99 of 100 cells"


def _always(state: object) -> bool:
    return True


@dataclass(frozen=True)
class Trial(Generic[S]):
    """One kind of computation of a scene.

    Attributes
    ----------
    kind : Kind
        The kind of computation.
    pictures : tuple of str
        Names of the pictures that show it; empty for all pictures.
    run : callable
        `run(state, plan)` computes it as the scene does.
    error : callable
        `error(state, result, truth)` returns the error in `unit`; NaN if there is nothing to compare.
    unit : str
        Unit of the error.
    shared_setting : str
        Setting of a plan that the reference shares with the measured level, because only equal points are compared;
        empty for none.
    tolerance : float
        Largest invisible error, in `unit`.
    condition : callable
        `condition(state)` returns True if the pictures show it in this state.
    most : tuple of (str, float)
        Upper limits of parameters with which it takes about a second.
    """

    kind: Kind
    pictures: tuple[str, ...]
    run: Callable[[S, Plan], Any]
    error: Callable[[S, Any, Any], float]
    unit: str = "pixels"
    shared_setting: SharedSetting = ""
    tolerance: float = HALF_A_PIXEL
    condition: Callable[[S], bool] = _always
    most: tuple[tuple[str, float], ...] = ()

    def small_state(self, state: S) -> S:
        """Return the state with parameters limited to `most`, so that it is computed in about a second."""
        less = {name: min(float(getattr(state, name)), most) for name, most in self.most}
        return state.with_values(less) if less else state


@dataclass(frozen=True)
class Refusal:
    """The reason why a trial could not be measured; it is cached like a result.

    Attributes
    ----------
    reason : str
        A sentence for the user.
    """

    reason: str


def bare_state(state: S) -> S:
    """Return the state without its accuracy and visible pictures, as a cache key."""
    typed: Any = state
    accuracy = {"accuracy": STANDARD.name} if hasattr(state, "accuracy") else {}
    found: S = replace(typed, **accuracy, work=Work(), visible=frozenset(), sources={})
    return found


def level_costs(trial: Trial[S], state: S) -> tuple[LevelCost, ...] | Refusal:
    """Return the measured time and error of each level, or why there are none, for a state from `bare_state`.

    Raises `OverBudget`.
    """
    try:
        return tuple(measure(*_of(trial, state), shared_setting=trial.shared_setting))
    except OverBudget:
        # Do not cache this failure: a later attempt may be faster.
        raise
    except ModelError as error:
        return Refusal(str(error))


def sufficient_level(trial: Trial[S], state: S) -> str:
    """Return the cheapest level with full resolution and an invisible error, or the finest level if there is none.

    Return `standard` if no error can be measured.  Raises `OverBudget`.
    """
    try:
        return first_sufficient(measure(*_of(trial, state), shared_setting=trial.shared_setting), trial.tolerance)
    except OverBudget:
        raise
    except ModelError:
        return STANDARD.name


def _of(trial: Trial[S], state: S) -> tuple[Kind, Callable[[Plan], Any], Callable[[Any, Any], float]]:
    """Return kind, run and error of a trial as arguments of `measure`."""
    less = trial.small_state(state)
    return trial.kind, lambda plan: trial.run(less, plan), lambda *both: trial.error(less, *both)


def _measured_span(motion: Motion) -> float:
    return min(motion.duration, longest_duration(*motion.arguments[:3]))


def _orbit(state: State, plan: Plan) -> Array:
    motion = state.motion()
    assert motion is not None, "only scenes with a motion have this trial"
    times = np.linspace(0.0, _measured_span(motion), _SAMPLES)
    return solve(motion, motion.start, times, plan.level).states


def _orbit_error(state: State, states: Array, truth: object) -> float:
    motion = state.motion()
    assert motion is not None
    # Compare with an orbit of 31 digits, because no level is more accurate than `reference`.
    exact = exactly(*motion.arguments[:3], _measured_span(motion), _SAMPLES)
    away, first = exact.errors_of(states) * np.asarray(motion.weights), motion.system.angular_velocities
    return float(max(np.linalg.norm(part, axis=1).max() for part in (away[:, :first], away[:, first:])))


def orbit_trial() -> Trial[Any]:
    """Return the trial of the current motion."""
    return Trial(Kind.ORBIT, (), _orbit, _orbit_error)


def curve_error(values: Array, exact: Array, height: float, period: float = math.inf) -> float:
    """Return the largest error of a curve (n,) in pixels of an axis of length `height`.

    Parameters
    ----------
    values, exact : array (n,)
        The curve and its reference.
    height : float
        Length of the axis, positive, in units of the curve.
    period : float
        Period of an angle; ∞ for other values.
    """
    away = values - exact
    if math.isfinite(period):
        away = away - period * np.round(away / period)
    return PIXELS / height * float(np.abs(away).max())


def boundary_error(curve: Array, exact: Array, axes: Axes) -> float:
    """Return the largest distance in pixels from the visible points of the reference to the polyline of a curve.

    Parameters
    ----------
    curve, exact : array (n, 2)
        The curve and its reference.
    axes : Axes
        Axes of the plot.

    Returns
    -------
    float
        The distance; NaN if the curve is empty or no point of the reference is visible.
    """
    (x, y), (low, high) = exact.T, np.array([axes.x, axes.y]).T
    there = exact[(x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1])]
    pixels = PIXELS / (high - low)
    return float(distances_to_curve(there * pixels, curve * pixels).max()) if len(curve) and len(there) else math.nan


def colour_error(values: Array, exact: Array) -> float:
    """Return the 99th percentile of the error, in steps of a colour map that covers one turn; NaN without values.

    Parameters
    ----------
    values, exact : array
        Values and their reference, of the same shape, in turns.
    """
    return float(np.percentile(np.abs(values - exact), 99.0)) / _COLOUR if values.size else math.nan


def section_error(
    orbits: Sequence[Array], truth: Sequence[Array], pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> float:
    """Return the largest error of the regular orbits, in pixels; no level follows a chaotic orbit to its end.

    Parameters
    ----------
    orbits, truth : sequence of array (n, 2)
        Points of the orbits and of their references, in the same order.
    pixels : sequence of float
        Pixels per unit of each coordinate.
    periods : sequence of float
        Period of each coordinate, ∞ if it is not an angle.

    Returns
    -------
    float
        The error; NaN if all orbits are chaotic or empty.
    """
    aways = [errors_in_pixels(one, other, pixels, periods) for one, other in zip(orbits, truth, strict=True)]
    return max((float(away.max()) for away in aways if away.size and not has_diverged(away)), default=math.nan)
