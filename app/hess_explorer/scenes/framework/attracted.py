"""What two scenes share that show where the orbits of a section settle over a parameter, and one of these orbits."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.protocol.parameters import Values, places, written
from hess_explorer.scenes.framework.continued import Continued
from hess_explorer.scenes.framework.one_orbit import Start
from hess_explorer.scenes.framework.over_parameter import edges, picture
from hess_explorer.scenes.framework.solid_body import constrained_body
from hess_explorer.scenes.framework.windows import Window, tidy_window, window_of
from hess_explorer.views import branch, layered_section, periodic, theme
from hess_explorer.views.graph import about_0, over_time
from hess_explorer.views.layers import Axes, levels, points
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import along_the_orbit
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.orbit_diagram import Cascade
from hess_mechanics.dynamics.parameter_diagram import AtState, Sets, at_state, sets_of
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Computation
from hess_mechanics.numerics.results import Array, SectionCrossings, frozen
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.rigid_body.reversal import rate, reversals

__all__ = ["Attracted", "pictures"]

_MANY = 24
"""Places that are drawn large, as dots would hardly be seen."""
_WINDOW = ((-math.pi, 0.0), (math.pi, math.pi))


class _Equator(PoincareSection, Protocol):
    """A section γ3 = 0 in (ψ, δ)."""

    def __hash__(self) -> int: ...

    def somewhere(self) -> tuple[float, ...] | None:
        """A state of it; None where no motion crosses."""

    def impossible(self, window: Window) -> Array:
        """Cells (1, n) over the window: 1 where the energy does not allow ψ."""


class Attracted(Continued):
    """A section γ3 = 0 of a `body` with ω3 = 0, and the `orbit` from a place of it; see `one_orbit.OneOrbit`.

    The scene declares the parameters that stand here without a value.
    """

    span: float
    long: float
    chosen: str

    @property
    @abstractmethod
    def section(self) -> _Equator:
        """The section.  Raises `ModelError`."""

    def admitted(self, notes: list[str]) -> Any:
        """A window that is one and lies in the diagram, a place, edges in their order."""
        first, last = edges(self.first, self.last)
        state = replace(self._scene, first=first, last=last, chosen=self.chosen or type(self).chosen,
                        window=tidy_window(self.window))
        (x0, _), (x1, _) = window_of(state.window, state.full)
        return state if x0 < last and x1 > first else replace(state, window="")

    @cached_property
    def place(self) -> tuple[float, float]:
        """Where the orbit on show starts; where nothing moves at the chosen place, at another one.

        Raises `OutsideRegion`.
        """
        (chosen,) = places(self.chosen)[-1:]
        if self.section.states_at(*np.array(chosen)[:, None])[1][0]:
            return chosen
        other = self.section.somewhere()
        if other is None:
            raise OutsideRegion("No motion of this energy crosses γ₃ = 0: choose a larger h.")
        x, y = self.section.places_of(np.array([other]))[0]
        return float(x), float(y)

    @cached_property
    def start(self) -> Start:
        """Its state; that of the periodic orbit, where its branch is shown."""
        if self.closed is not None:
            return self.closed.state
        return tuple(map(float, self.section.states_at(*np.array(self.place)[:, None])[0][0]))

    @property
    def _scene(self) -> Any:
        """With its body and its orbit, whose types only the scene knows."""
        return self

    # ---- the state ----------------------------------------------------------------------------------------------

    @cached_property
    def sets(self) -> Sets | None:
        """Attractor and repeller of the orbit on show."""
        few = (60, 120) if self.dragging else (500, 1500)
        return self.work.soon(sets_of, self.section, self.place, *few, self.plan(Computation.SECTION).level)

    @cached_property
    def kind(self) -> AtState | None:
        """What kind of motion and of dynamics this is, when it is known."""
        if self.dragging:
            return None
        t = self.plan(Computation.EXPONENT).share * self.long
        return self.work.later(at_state, self.section, self.place, 500, 1500, t, self.plan(Computation.SECTION).level)

    @cached_property
    def turned(self) -> SectionCrossings:
        """The moments of reversal of the orbit on show."""
        return self.work.get(reversals, self._scene.body, self.start, self.span, self.level)

    @cached_property
    def turning(self) -> Array:
        """(ω, γ) along it (n,)."""
        return rate(self._scene.orbit.states)

    # ---- what the mouse does ------------------------------------------------------------------------------------

    def start_here(self, x: float, y: float) -> Values:
        """A click in the section: the orbit from there."""
        return {"chosen": written([(x, min(max(y, 1e-6), math.pi - 1e-6))])}

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_section(self) -> str:
        found = self.kind
        if found is None:
            return self.awaited()
        motion = found.regime
        kind = f"period {motion.period}" if motion.period else motion.kind.words
        if found.dynamics is None:
            return f"Motion: {kind}. Attractor and repeller: not compared, as the orbit leaves."
        if found.dynamics.verdict == "not told apart":
            return (f"Motion: {kind}. Attractor and repeller: not told apart.\n"
                    f"|mean div| < {digits(motion.bound, 1)}")
        if motion.volume_kept:
            return f"Motion: {kind}. Conservative: volume is kept."
        return (f"Motion: {kind}. Looks {found.dynamics.verdict}.\n"
                f"div = {digits(motion.divergence, 2)} ± {digits(motion.divergence_error, 1)}, sets "
                f"{digits(found.dynamics.distance, 2)} ± {digits(found.dynamics.distance_error, 1)} apart")

    def _about_turning(self) -> str:
        times = self.turned.times
        if not len(times):
            return "The body does not turn round in this time."
        many = "once" if len(times) == 1 else f"{len(times)} times"
        return (f"It turns round {many}, at first at t = {digits(float(times[0]), 6)}, "
                f"to {digits(self.turned.error_estimate, 1)}.")

    def status(self) -> Iterator[str]:
        """The orbit, the doublings."""
        found = self.known("cascade")
        if isinstance(found, Cascade) and found.values.size:
            yield f"doublings to {digits(found.error_estimate, 1)}"
        yield from super().status()
        yield from self._scene._orbit_status()

    def derived(self) -> Iterator[str]:
        """The energy, the place on show, the bifurcations of the branch."""
        yield f"E = {digits(self._scene.E, 6)}"
        yield f"chosen: ψ = {digits(self.place[0])}, δ = {digits(self.place[1])}"
        yield from super().derived()
        yield check_body(*self._scene.body.parameters[:4]).sentence


def _of(sets: Sets | None, which: str) -> Array:
    return frozen(np.empty((0, 2))) if sets is None else np.asarray(getattr(sets, which))


def _few(found: Array) -> Array | None:
    """Places (2, m) that would hardly be seen as dots; None of more."""
    _, first = np.unique(np.round(found, 4), axis=0, return_index=True)
    return found[first].T if 0 < len(first) <= _MANY else None


def pictures(state: type[Attracted], ball: bool = False) -> tuple[Any, ...]:
    """The diagram with its branch, the body, its section, its turning, and its Poisson sphere folded."""
    return (
        picture(state, branch.layers(lambda s: s.continued, lambda s: s.side, lambda s: s.turn), state.about),
        constrained_body(ball=ball),
        Plot(name="section", title="Its section γ₃ = 0, growing", caption=state._about_section,
             axes=("ψ", "δ"), x=(-math.pi, math.pi), y=(0.0, math.pi), on_click=state.start_here,
             layers=(*layered_section.layers(
                 lambda s: _of(s.sets, "attractor"), lambda s: _of(s.sets, "repeller"), lambda s: np.empty((0, 2)),
                 chosen=lambda s: [s.place], window=lambda s: _WINDOW,
                 impossible=lambda s: s.section.impossible(_WINDOW),
                 labels=("attractor", "repeller")),
                 points("few", lambda s: _few(_of(s.sets, "attractor")), color=theme.ORBIT, size=9),
                 *periodic.places(lambda s: None if s.closed is None else s.closed.orbit),
                 points("few-repelling", lambda s: _few(_of(s.sets, "repeller")), color=theme.UNSTABLE, size=9))),
        Plot(name="reversal", title="Turning about the vertical, (ω, γ)", caption=state._about_turning,
             axes=("t", "(ω, γ)"), dot=("t", "turning"), first=Axes((0.0, 60.0), (-2.0, 2.0)),
             x=lambda s: (0.0, s.span), y=lambda s: about_0(s.turning, 1e-6),
             layers=(levels("levels", lambda s: [0.0]),
                     over_time("turning", lambda s: (s.orbit.times, s.turning), color=theme.ORBIT,
                               label="(ω, γ) of the chosen orbit"),
                     points("moments", lambda s: (s.turned.times, np.zeros(len(s.turned.times))), color=theme.UNSTABLE,
                            size=11, hollow=True, edge_width=2.5, label="moments of reversal"))),
        replace(along_the_orbit(lambda s: s.r, lambda s: s.proved_around), folded="Show the Poisson sphere"),
    )
