"""A swarm: motions from many starts at once, which the pictures show as beads beside the moving point.

A scene defines the starts and the columns of "orbit" that its pictures follow (`Swarm`).  The choices of the swarm,
which are parameters of the state, its track and the graph of its spread follow from them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, make_dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import ChoiceSpec, points_of
from hess_explorer.scenes.framework.part import Part, part
from hess_explorer.scenes.framework.sliders import declare
from hess_explorer.scenes.framework.swarm_motions import ERROR, SwarmMotions, swarm_motions, turned_starts
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Columns, Range, column
from hess_explorer.views.space.body import to_picture_axes
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.sampling import MOST_SAMPLES
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import second_directions

if TYPE_CHECKING:
    from hess_explorer.scenes.framework.scene import Motion

S = TypeVar("S")

SWARM = "swarm"
"""Name of the track."""
ONE, SPREAD, NEAR, LINE = "1", "over the phase", "near this start", "along a line"
FORWARD, BACKWARD = "forward", "backward"
_COUNTS = (ONE, "2", "8", "50", "200", "2000")
_NEAR = 0.02
"""Share of the phase that a swarm near the chosen start takes."""
_ABOVE = 10.0
"""A distance is known if it exceeds this many times the errors of both motions, or `ERROR`."""
_SEEN = 1e-12, 1e12
"""Smallest and largest relative distance of the graph."""
_IN_SPACE = 50
"""Largest number of bodies whose centres of mass are shown in space."""
_BYTES = 1_900_000
"""Largest size of the columns of a swarm, in bytes."""


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
        Names of the columns that are angles, and of those that are constant during a period.
    period : callable
        `period(state)` returns the period at whose multiples the steps lie, in the time of the system; None without
        steps.
    rate : callable
        `rate(state)` returns the asymptotic rate, per unit of t, at which neighbours separate in the time direction of
        the swarm, and a phrase that names it; None if it is unknown.
    """

    starts: Callable[[S, Array], Array]
    columns: Callable[[S, Array, Array], Columns]
    angles: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    period: Callable[[S], float | None] = lambda state: None
    rate: Callable[[S], tuple[float, str] | None] = lambda state: None


def turned_swarm(
    more: Callable[[S, Array], Columns] = lambda state, states: {}, angles: tuple[str, ...] = ()
) -> Swarm[S]:
    """Return the swarm of `turned_starts`, for states (ω1, ω2, γ) or (M, γ).

    Parameters
    ----------
    more : callable
        `more(state, states)` returns further columns (k,) of states (k, d).
    angles : tuple of str
        Names of the further columns that are angles.
    """

    def columns(state: Any, times: Array, states: Array) -> Columns:
        found = {f"g{i}": states[..., i - 4] for i in (1, 2, 3)}
        if states.shape[-1] == 5:
            found |= {f"omega{i}": states[..., i - 1] for i in (1, 2)}
        flat = more(state, states.reshape(-1, states.shape[-1]))
        return {**found, **{name: one.reshape(states.shape[:2]) for name, one in flat.items()}}

    def rate(state: Any) -> tuple[float, str] | None:
        # Backward in time another exponent is the largest.
        return state.exponent.separation if state.swarm_time == FORWARD and hasattr(state, "exponent") else None

    return Swarm(lambda state, angles: turned_starts(state.motion(), angles), columns, angles, rate=rate)


@dataclass(frozen=True, eq=False)
class _SwarmPart(Part[Any]):
    """The swarm of a state."""

    swarm: Swarm[Any]

    @cached_property
    def angles(self) -> Array:
        """Angles (n,) of the bodies, in radians: of their starts, or about the vertical; empty without a swarm."""
        n = int(self.host.swarm)
        share = _NEAR if self.host.swarm_from == NEAR else 1.0
        return share * 2.0 * math.pi * ((np.arange(n) + 0.5) / n - 0.5) if n > 1 else np.empty(0)

    @property
    def _clicked(self) -> list[tuple[float, float]]:
        """The last two points clicked in a section, or fewer, if the starts are to lie on a line; otherwise empty."""
        return points_of(self.host.starts)[-2:] if self.host.swarm_from == LINE else []

    @property
    def starts(self) -> Array:
        """Initial states (n, d): at the angles, or on a line once two points are clicked.

        Points of the line at which no motion is possible are left out.  Raises `ModelError`.
        """
        if len(self._clicked) < 2:
            return self.swarm.starts(self.host, self.angles)
        first, last = self._clicked
        states, possible = self.host.poincare.states_at(*np.linspace(first, last, self.angles.size).T)
        return np.asarray(states[possible])

    @property
    def _sign(self) -> float:
        return -1.0 if self.host.swarm_time == BACKWARD else 1.0

    @property
    def _motion(self) -> Motion:
        motion: Motion = self.host.motion()
        return replace(motion, duration=self._sign * motion.duration)

    @cached_property
    def motions(self) -> SwarmMotions | None:
        """The motions; None without a swarm, and if no motion is possible on the line of starts."""
        if not self.angles.size:
            return None
        starts = tuple(map(tuple, self.starts.tolist()))
        if not starts:
            return None
        named = self.swarm.columns(self.host, np.zeros(1), np.array(starts)[:1, None])
        most = max(4, min(MOST_SAMPLES, _BYTES // (2 * len(starts) * (len(named) + 3))))
        return self.work.need(Task(swarm_motions, self._motion, starts, most, self.swarm.period(self.host)))

    def track(self) -> Columns | None:
        """Return the columns of the swarm, see "swarm.js"; None without `motions`."""
        found = self.motions
        if found is None:
            return None
        columns = {**self.swarm.columns(self.host, found.times, found.states)}
        columns |= self._centres(found, columns)
        values = np.array([one.T for one in columns.values()])
        low, high = np.nanmin(values, axis=(1, 2)), np.nanmax(values, axis=(1, 2))
        step = np.maximum((high - low) / 65534.0, 1e-300)
        quantised = np.nan_to_num((values - low[:, None, None]) / step[:, None, None]) - 32767.0
        kinds = {**dict.fromkeys(self.swarm.angles, "angle"), **dict.fromkeys(self.swarm.steps, "step")}
        return {
            "count": len(found.states),
            "spacing": float(abs(found.times[1]) * self._motion.unit),
            "names": [*columns],
            "kinds": [kinds.get(name, "") for name in columns],
            "low": low.tolist(),
            "step": step.tolist(),
            "until": column(found.until),
            "values": np.rint(quantised).astype("<i2").ravel(),
            "palette": list(theme.SWARM),
        }

    def _centres(self, motions: SwarmMotions, columns: Columns) -> Columns:
        """Return the columns mx, my, mz of the centres of mass of up to 50 Suslov bodies or balls; otherwise nothing.

        The bodies start at different angles about the vertical.
        """
        mass = getattr(getattr(self.host, "solid", None), "mass", None)
        angles = self.angles[: len(motions.states)]
        if mass is None or "omega1" not in columns or self.angles.size > _IN_SPACE:
            return {}
        times = motions.times
        between = self.swarm.columns(self.host, 0.5 * (times[1:] + times[:-1]), motions.halfway)

        def stacked(*names: str) -> Array:
            """Return vectors (n, 2m − 1, 3) at the samples and halfway between them."""
            found = np.zeros((*motions.states.shape[:1], 2 * times.size - 1, 3))
            for k, name in enumerate(names):
                found[:, ::2, k], found[:, 1::2, k] = columns[name], between[name]
            return found

        verticals = stacked("g1", "g2", "g3")
        fine = np.linspace(0.0, times[-1], verticals.shape[1])
        second = second_directions(self._motion.unit * fine, stacked("omega1", "omega2"), verticals)[:, ::2]
        verticals = verticals[:, ::2]
        down, e, f = (one @ mass.along for one in (verticals, second, np.cross(verticals, second)))
        # The angle of a body about γ is arbitrary: add the chosen angles to that of the current motion.
        own = self.host.solid.attitude.in_space(mass.along)[0]
        turn = angles + math.atan2(own[2], own[1]) - np.arctan2(f[:, 0], e[:, 0])
        across = np.exp(1j * turn)[:, None] * (e + 1j * f)
        positions = to_picture_axes(np.stack([down, across.real, across.imag], axis=2))
        return {f"m{name}": positions[..., i] for i, name in enumerate("xyz")}

    @cached_property
    def spread(self) -> tuple[Array, Array] | None:
        """Times (m,) of the player, and quantiles (3, m) of the distance of neighbours relative to that at the start.

        The quantiles are 0.1, 0.5 and 0.9.  None without motions, and if fewer than two times are known.
        """
        found = self.motions
        if found is None:
            return None
        apart = np.linalg.norm(np.diff(found.states * np.array(self._motion.weights), axis=0), axis=2)
        # A distance is unknown after the end of either motion, and below both ERROR and _ABOVE times the errors.
        both = np.arange(found.times.size) <= np.minimum(found.until[1:], found.until[:-1])[:, None]
        known = both & (apart > np.minimum(_ABOVE * (found.errors[1:] + found.errors[:-1]), ERROR)[:, None])
        ratio = np.where(both & (apart[:, :1] > 0.0), apart / np.maximum(apart[:, :1], 1e-300), np.nan)
        # End the graph before 10 % of the distances are lost: the remaining ones would be a biased sample.
        count = int(np.argmin([*(known.mean(axis=0) > 0.9), False]))
        if count < 2:
            return None
        quantiles = np.nanquantile(ratio[:, :count], (0.1, 0.5, 0.9), axis=0)
        return np.abs(found.times[:count]) * self._motion.unit, quantiles

    @property
    def expected(self) -> tuple[Array, Array] | None:
        """The first and the last time (2,), and the expected growth of distances at them (2,); None if unknown."""
        rate = self.swarm.rate(self.host)
        if rate is None or self.spread is None:
            return None
        ends = self.spread[0][[0, -1]]
        return ends, np.exp(np.clip(rate[0] * ends, *np.log(_SEEN)))

    @property
    def heights(self) -> Range:
        """The range of the vertical axis of the graph, which includes 0.1 to 10."""
        curves = [] if self.spread is None else [self.spread[1].ravel(), *(self.expected or ())[1:]]
        values = np.log10(np.clip(np.concatenate([[0.1, 10.0], *curves]), *_SEEN))
        low, high = float(values.min()) - 0.1, float(values.max()) + 0.1
        return 10.0**low, 10.0**high

    def notes(self) -> Iterator[str]:
        """Yield a note if a second click is missing, the motions are shortened, or some beads fade out early."""
        if len(self._clicked) == 1:
            yield "Click a second point in the section to start the bodies on the line between both points."
        if not self.has_result("motions") or self.motions is None:
            return
        ends = self.motions.until * abs(self.motions.times[1])
        if ends.max() < 0.99 * abs(self._motion.duration):
            yield f"The {ends.size} bodies are shown up to t = {digits(float(ends.max()) * self._motion.unit)}."
        elif ends.min() < 0.99 * abs(self._motion.duration):
            yield "Beads fade out before their error exceeds half a pixel."

    @property
    def reason(self) -> str:
        """Why there is no graph; empty if there is one."""
        if self.motions is None:
            return "Choose more than one body in the group Swarm, with possible starts."
        return (
            "" if self.spread is not None else "Neighbours are too close, or lost too soon, to measure their distance."
        )

    @property
    def caption(self) -> Caption:
        """The caption of the graph."""
        if self.spread is None:
            return Caption("The spread is not measured.", self.reason)
        rate = self.swarm.rate(self.host)
        median = digits(float(self.spread[1][1, -1]), 2)
        said = "" if rate is None else f" {rate[1]}."
        return Caption(
            f"Neighbours at the end: {median} times as far apart (median).", f"Thin lines enclose 8 of 10.{said}"
        )


def _choice(name: str, label: str, options: tuple[str, ...], doc: str) -> ChoiceSpec:
    return ChoiceSpec(name, label, options, options[0], doc, "Swarm")


def with_swarm(state: type[Any], swarm: Swarm[Any]) -> type[Any]:
    """Return a class of states with the additional choices of a swarm, which do not change other results.

    Parameters
    ----------
    state : type
        Class of the states without the swarm.
    swarm : Swarm
        The starts and columns.
    """
    origins: tuple[str, ...] = (SPREAD, NEAR)
    about = "All around, or within 1 % of a turn of the chosen start."
    if any(one.name == "starts" for one in fields(state)):
        origins, about = (*origins, LINE), f"{about} A line joins the last two points clicked in the section."
    specs = (
        _choice("swarm", "Bodies", _COUNTS, "How many bodies move at once, each from its own start."),
        _choice("swarm_from", "Starts", origins, about),
        _choice("swarm_time", "Time of the swarm", (FORWARD, BACKWARD), "Backward: where the motions came from."),
    )
    return make_dataclass(
        state.__name__,
        [(spec.name, str, declare(spec, compare=False)) for spec in specs],
        bases=(state,),
        frozen=True,
        namespace={"__module__": state.__module__, "swarm_part": part(lambda s: _SwarmPart(s, swarm))},
    )
