"""A swarm: motions from many starts at once, which the pictures show as beads beside the moving point.

A scene says where the starts lie and which columns of "orbit" its pictures follow (`Swarm`).  The choices of the swarm,
which are parameters of the state, its track and the graph of its spread follow from them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, make_dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import ChoiceSpec
from hess_explorer.scenes.framework.part import Part, part
from hess_explorer.scenes.framework.sliders import declare
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Columns, Range, column, line
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.numerics.accuracy import DRAFT, STANDARD
from hess_mechanics.numerics.measured import SAFETY
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from hess_explorer.scenes.framework.scene import Motion

__all__ = ["SWARM", "Swarm", "spread_picture", "turned", "with_swarm"]

S = TypeVar("S")

SWARM = "swarm"
"""Name of the track."""
ONE, SPREAD, NEAR, FORWARD, BACKWARD = "1", "over the phase", "near this start", "forward", "backward"
_COUNTS = (ONE, "2", "8", "50", "200", "2000")
_NEAR = 0.02
"""Share of the phase that a swarm near the chosen start takes."""
_BYTES = 1_900_000
"""Largest size of the columns of a swarm."""
_ERROR = 0.5
"""Largest error of a bead, in pixels; from then on it is not drawn."""
_FEW, _FIRST, _TRIALS = 12, 64, 3
"""Number of motions from which the spacing of the samples is chosen; its first share of the time, and the trials."""


@dataclass(frozen=True)
class Swarm(Generic[S]):
    """How a scene shows a swarm.

    Attributes
    ----------
    starts : callable
        `starts(state, angles)` returns initial states (n, d) of the system of `State.motion`, at angles (n,) from the
        chosen start, in radians; the phase is one turn.
    columns : callable
        `columns(state, times, states)` returns the columns (n, m) that the pictures follow; times (m,) and states
        (n, m, d) are those of the motion's system.
    angles, steps : tuple of str
        Columns that are angles, and those that are constant during a period.
    period : callable
        `period(state)` returns the period at whose multiples the steps lie, in the time of the system, or None.
    rate : callable
        `rate(state)` returns the rate at which neighbours are expected to separate near the end, per unit of t in either
        sense of time, and its name; or None.
    """

    starts: Callable[[S, Array], Array]
    columns: Callable[[S, Array, Array], Columns]
    angles: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    period: Callable[[S], float | None] = lambda state: None
    rate: Callable[[S], tuple[float, str] | None] = lambda state: None


def turned(motion: Motion, angles: Array) -> Array:
    """Return states whose velocity is turned, with the energy of the motion's initial state.

    The angular velocity (ω1, ω2) of states (ω1, ω2, γ) is turned in its plane.  The angular momentum M of states (M, γ)
    is turned about γ, so that (M, γ) stays the same.

    Parameters
    ----------
    motion : Motion
        The motion; the first integral of its system is quadratic in the velocity.
    angles : array (n,)
        Angles in radians.

    Returns
    -------
    array (n, d)
        The states.
    """
    state = np.array(motion.state)
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    k = 2 if state.size == 5 else 3
    p, gamma = state[:k], state[-3:]
    fixed = np.zeros(2) if k == 2 else (p @ gamma) * gamma
    q = p - fixed
    across = np.array([-q[1], q[0]]) if k == 2 else np.cross(gamma, q)
    along = cos * q + sin * across

    def energy(scale: float) -> Array:
        found = np.tile(state, (len(angles), 1))
        found[:, :k] = fixed + scale * along
        return np.asarray(next(iter(motion.system.integrals([*found.T], motion.parameters).values())))

    # Three values determine the quadratic function.
    zero, plus, minus = energy(0.0), energy(1.0), energy(-1.0)
    a, b = 0.5 * (plus + minus) - zero, 0.5 * (plus - minus)
    goal = np.asarray(next(iter(motion.system.integrals([*state], motion.parameters).values())))
    root = np.sqrt(np.maximum(b * b + 4.0 * a * (goal - zero), 0.0))
    scale = np.divide(root - b, 2.0 * a, out=np.ones_like(a), where=a > 0.0)
    found = np.tile(state, (len(angles), 1))
    found[:, :k] = fixed + scale[:, None] * along
    return found


@dataclass(frozen=True)
class _Motions:
    """Motions of a swarm at evenly spaced times.

    Attributes
    ----------
    times : array (m,)
        Times of the system, of either sign.
    states : array (n, m, d)
        States.
    until : array (n,)
        Index of the sample up to which each motion is right to half a pixel, a real number.
    """

    times: Array
    states: Array
    until: Array


def _midpoints(x: Array) -> Array:
    """Return values (n, m − 1, d) halfway between evenly spaced samples (n, m, d), as "swarm.js" interpolates them."""
    before, after = 3.0 * (x[:, :1] - x[:, 1:2]) + x[:, 2:3], 3.0 * (x[:, -1:] - x[:, -2:-1]) + x[:, -3:-2]
    p = np.concatenate([before, x, after], axis=1)
    return np.asarray((9.0 * (p[:, 1:-2] + p[:, 2:-1]) - p[:, :-3] - p[:, 3:]) / 16.0)


def _interpolation_errors(states: Array, weights: Array) -> Array:
    """Return the errors (n, m − 1), in pixels, of interpolation between the even ones of samples (n, 2m − 1, d)."""
    return np.asarray((np.abs(_midpoints(states[:, ::2]) - states[:, 1::2]) * weights).max(axis=2))


def _motions(motion: Motion, starts: tuple[tuple[float, ...], ...], most: int, period: float | None) -> _Motions:
    """Return the motions from several starts, at no more than `most` times; see `Motion` for the rest."""
    body, weights = motion.system.at(motion.parameters), np.array(motion.weights)

    def sampled(chosen: Any, span: float, m: int) -> Any:
        return ensemble(body, chosen, np.linspace(0.0, span, 2 * m - 1), DRAFT)

    few = starts[:: max(1, len(starts) // _FEW)]
    spacing = abs(motion.span) / _FIRST
    for _ in range(_TRIALS):
        m = max(4, min(most, 1 + round(abs(motion.span) / spacing)))
        states = sampled(few, math.copysign((m - 1) * spacing, motion.span), m).states
        worst = float(np.nanmax(_interpolation_errors(states, weights), initial=0.0))
        if worst <= 0.5 * _ERROR:
            break
        # The error is proportional to the fourth power of a small spacing.
        spacing *= 0.9 * (0.5 * _ERROR / worst) ** 0.25
    if period is not None:
        spacing = period / math.ceil(period / spacing)
    m = max(4, min(most, 1 + math.ceil(abs(motion.span) / spacing)))
    span = math.copysign((m - 1) * spacing, motion.span)
    found = sampled(starts, span, m)
    states = found.states[:, ::2].copy()
    wrong = np.repeat(_interpolation_errors(found.states, weights) > _ERROR, 2, axis=1)
    loose = np.flatnonzero(~(found.errors * weights.max() <= _ERROR))
    if loose.size:
        finer = ensemble(body, np.array(starts)[loose], found.times, STANDARD)
        apart = (np.abs(finer.states - found.states[loose]) * weights).max(axis=2)
        states[loose] = finer.states[:, ::2]
        wrong[loose] |= ~(SAFETY * apart[:, 1:] <= _ERROR)
    until = np.where(wrong.any(axis=1), 0.5 * np.argmax(wrong, axis=1), m - 1.0)
    return _Motions(found.times[::2], states, until)


@dataclass(frozen=True, eq=False)
class _SwarmPart(Part[Any]):
    """The swarm of a state."""

    swarm: Swarm[Any]

    @cached_property
    def angles(self) -> Array:
        """Angles (n,) of the starts; empty without a swarm."""
        n = int(self.host.swarm)
        share = _NEAR if self.host.swarm_from == NEAR else 1.0
        return share * 2.0 * math.pi * ((np.arange(n) + 0.5) / n - 0.5) if n > 1 else np.empty(0)

    @property
    def _sign(self) -> float:
        return -1.0 if self.host.swarm_time == BACKWARD else 1.0

    @property
    def _motion(self) -> Motion:
        motion: Motion = self.host.motion()
        return replace(motion, span=self._sign * motion.span)

    @cached_property
    def motions(self) -> _Motions | None:
        """The motions; None without a swarm."""
        if not self.angles.size:
            return None
        starts = tuple(map(tuple, self.swarm.starts(self.host, self.angles).tolist()))
        named = self.swarm.columns(self.host, np.zeros(1), np.array(starts)[:1, None])
        most = max(4, _BYTES // (2 * len(starts) * len(named)))
        return self.work.need(Task(_motions, self._motion, starts, most, self.swarm.period(self.host)))

    def track(self) -> Columns | None:
        """Return the columns of the swarm, see "swarm.js"; None without one."""
        found = self.motions
        if found is None:
            return None
        columns = self.swarm.columns(self.host, found.times, found.states)
        values = np.array([one.T for one in columns.values()])
        low, high = np.nanmin(values, axis=(1, 2)), np.nanmax(values, axis=(1, 2))
        step = np.maximum((high - low) / 65534.0, 1e-300)
        quantised = np.nan_to_num((values - low[:, None, None]) / step[:, None, None]) - 32767.0
        kinds = [
            "angle" if name in self.swarm.angles else "step" if name in self.swarm.steps else "" for name in columns
        ]
        return {
            "count": len(found.states),
            "spacing": float(abs(found.times[1]) * self._motion.unit),
            "names": [*columns],
            "kinds": kinds,
            "low": low.tolist(),
            "step": step.tolist(),
            "until": column(found.until),
            "values": np.rint(quantised).astype("<i2").ravel(),
            "palette": [*theme.TURN_MAP[::8]],
        }

    @cached_property
    def spread(self) -> tuple[Array, Array] | None:
        """Times of the player (m,), and the relative distance (3, m) of neighbours: a tenth, half and nine tenths of them.

        None without neighbours.
        """
        found = self.motions
        if found is None:
            return None
        apart = np.linalg.norm(np.diff(found.states * np.array(self._motion.weights), axis=0), axis=2)
        # Once a motion is not known any more, its distances are not either.
        known = np.arange(found.times.size) <= np.minimum(found.until[1:], found.until[:-1])[:, None]
        ratio = np.where(known & (apart[:, :1] > 0.0), apart / np.maximum(apart[:, :1], 1e-300), np.nan)
        enough = known.mean(axis=0) > 0.5
        return np.abs(found.times[enough]) * self._motion.unit, np.nanquantile(
            ratio[:, enough], (0.1, 0.5, 0.9), axis=0
        )

    @property
    def expected(self) -> tuple[Array, Array] | None:
        """The expected growth of distances (2,) at the first and the last time (2,); None if none is known."""
        rate = self.swarm.rate(self.host)
        if rate is None or self.spread is None:
            return None
        ends = self.spread[0][[0, -1]]
        return ends, np.exp(np.clip(rate[0] * ends, -100.0, 100.0))

    @property
    def heights(self) -> Range:
        """The vertical axis of the graph."""
        low, high = (-1.0, 1.0)
        if self.spread is not None:
            values = np.log10(np.clip(self.spread[1], 1e-12, 1e12))
            low, high = min(low, float(values.min()) - 0.1), max(high, float(values.max()) + 0.1)
        return 10.0**low, 10.0**high

    @property
    def caption(self) -> Caption:
        """The caption of the graph."""
        if self.spread is None:
            return Caption("No swarm.", "Choose more than one body in the group Swarm.")
        rate = self.swarm.rate(self.host)
        median = digits(float(self.spread[1][1, -1]), 2)
        said = "" if rate is None else f" {rate[1]}."
        return Caption(f"Neighbours at the end: {median} times as far apart (median).", f"Between: 8 of 10.{said}")


def spread_picture() -> Plot[Any]:
    """Return the graph of the distance between neighbours of the swarm over time."""

    def curve(i: int) -> Callable[[Any], tuple[Array, Array] | None]:
        return lambda s: None if s.swarm_part.spread is None else (s.swarm_part.spread[0], s.swarm_part.spread[1][i])

    return Plot(
        name="spread",
        title="Spread of the swarm",
        caption=lambda s: s.swarm_part.caption,
        axes=("t", "distance of neighbours, 1 at the start"),
        log="y",
        x=lambda s: (0.0, 1.0) if s.swarm_part.spread is None else (0.0, float(s.swarm_part.spread[0][-1])),
        y=lambda s: s.swarm_part.heights,
        message=lambda s: "" if s.swarm_part.spread is not None else "Choose more than one body in the group Swarm.",
        button="Show the spread of the swarm",
        layers=(
            line(
                "least", curve(0), color=theme.MUTED, width=1, label="a tenth of the neighbours is closer, or farther"
            ),
            line("most", curve(2), color=theme.MUTED, width=1),
            line(
                "expected",
                lambda s: s.swarm_part.expected,
                color=theme.UNSTABLE,
                dash="dashed",
                label="expected near the end",
                tag="expected",
            ),
            line("median", curve(1), color=theme.ORBIT, label="neighbours, median", tag="median"),
        ),
    )


def with_swarm(state: type[Any], swarm: Swarm[Any]) -> type[Any]:
    """Return a class of states with the additional choices of a swarm, which do not change other results."""
    specs = (
        ChoiceSpec(
            "swarm", "Bodies", _COUNTS, ONE, "Number of bodies that move at once, each from its own start.", "Swarm"
        ),
        ChoiceSpec(
            "swarm_from",
            "Starts",
            (SPREAD, NEAR),
            SPREAD,
            "All around, or within 2 % of a turn of the chosen start.",
            "Swarm",
        ),
        ChoiceSpec(
            "swarm_time",
            "Time of the swarm",
            (FORWARD, BACKWARD),
            FORWARD,
            "Backward, all go where they came from.",
            "Swarm",
        ),
    )
    return make_dataclass(
        state.__name__,
        [(spec.name, str, declare(spec, compare=False)) for spec in specs],
        bases=(state,),
        frozen=True,
        namespace={"__module__": state.__module__, "swarm_part": part(lambda s: _SwarmPart(s, swarm))},
    )
