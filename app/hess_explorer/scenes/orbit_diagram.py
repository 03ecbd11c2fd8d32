"""Orbit diagrams of the Suslov problem with gravity: attractors and repellers over a parameter, and reversal."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import Value, Values, places, written
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.scenes.framework.continued import Continued
from hess_explorer.scenes.framework.heavy_suslov import HeavySuslov
from hess_explorer.scenes.framework.inertia import CentreOfMass, Tensor
from hess_explorer.scenes.framework.one_orbit import OneOrbit, Start
from hess_explorer.scenes.framework.over_parameter import BOUNDS, picture
from hess_explorer.scenes.framework.parameters import accuracy_level, exponent_time, like, number, time_span
from hess_explorer.scenes.framework.parameters import places as chosen_places
from hess_explorer.scenes.framework.proved_orbit import proved_error_shown
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.solid_body import ConstrainedBody, constrained_body
from hess_explorer.scenes.framework.windows import tidy_window, window_of
from hess_explorer.views import branch, layered_section, periodic, theme
from hess_explorer.views.graph import about_0, over_time
from hess_explorer.views.layers import Axes, levels, points
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import along_the_orbit
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import orbit_columns
from hess_mechanics.dynamics.orbit_diagram import Cascade
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.results import Array, Section, frozen
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.parameter_diagram import (
    AtState,
    Sets,
    at_state,
    sets_of,
)
from hess_mechanics.suslov.reversal import rate, reversals
from hess_mechanics.suslov.section import SuslovSection

_MANY = 24
"""Places that are drawn large, as dots would hardly be seen."""


def _body(I11: float, I22: float, I13: float, I23: float, b1: float, b2: float, b3: float, h: float
          ) -> dict[str, Value]:
    return {"I11": I11, "I22": I22, "I13": I13, "I23": I23, "b1": b1, "b2": b2, "b3": b3, "h": h}


PRESETS = (
    Preset("Period doubling along I₂₃", along="I₂₃"),
    Preset("Apart: a strange attractor and its repeller", along="h", first=2.0, last=2.6),
    Preset("Touching: a strange attractor and its repeller", **_body(2.7, 1.4, -0.2, 0.8, -0.4, 1.9, -1.4, 4.6),
           along="h", first=4.2, last=5.0, chosen="-0.5986,1.6433"),
    Preset("A torus breaks up: an invariant curve, then chaos", **_body(1.5, 1.0, -0.2605, 0.4, 1.1, -1.6, 1.8, 4.2),
           along="I₁₃", first=-0.261, last=-0.247, window="-0.261,0.5;-0.247,2.2", chosen="1.2,1.45",
           branch="period 1"),
    Preset("A spiral: back to a saddle-focus", **_body(0.7, 2.8, 0.2, 0.2, 1.0, -1.8, -1.2, 5.015931), along="h",
           first=4.9, last=5.1, chosen="-2.62543193,3.13213405"),
    Preset("Apart: permanent rotations, and reversal", **_body(1.0, 2.5, 0.4, -0.1, -0.9, 0.8, -0.1, 2.2),
           along="I₁₃", first=0.2, last=0.6, chosen="-2.01067,0.01001", span=60.0),
    Preset("Equal: a sea that keeps no volume", **_body(1.5, 1.7, 0.1, -0.3, -1.7, 1.0, 2.0, 1.9), along="h",
           first=1.7, last=2.1, chosen="-1.0063,1.1872"),
    Preset("Equal: volume is kept", **_body(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8, 1.643398), along="h", first=1.0,
           last=3.0, chosen="1,1"),
)
"""All of them are rigid bodies for some I₃₃, found by `tests/benchmarks/search_regimes.py`."""


@dataclass(frozen=True)
class OrbitDiagram(Continued, HeavySuslov, OneOrbit, ConstrainedBody):
    """Where orbits of a section settle over one parameter, and the orbit on show at the value that this one has."""

    I11: float = like(Tensor, "I11", 1.1)
    I22: float = like(Tensor, "I22", 2.9)
    I13: float = like(Tensor, "I13", -0.9)
    I23: float = like(Tensor, "I23", 0.2)
    b1: float = like(CentreOfMass, "b1", -1.7)
    b2: float = like(CentreOfMass, "b2", -1.6)
    b3: float = like(CentreOfMass, "b3", 1.2)
    h: float = number("h", 2.3, (0.01, 6.0), 0.01, bounds=(1e-6, 1e6), label="Energy above the bottom, h",
                      doc="E + |b|, the energy above its smallest possible value.")
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    long: float = exponent_time(4000.0, 5000.0, 2e4, "the mean divergence is")
    certain: str = proved_error_shown()
    accuracy: str = accuracy_level()
    chosen: str = chosen_places("The place of the chosen orbit", 1, *BOUNDS, "0.7248,1.8925")

    def admitted(self, notes: list[str]) -> OrbitDiagram:
        """A window that is one and lies in the diagram, a place, edges in their order."""
        first, last = sorted((self.first, self.last))
        if first == last:
            last = first + 1.0
        state = replace(self, first=first, last=last, chosen=self.chosen or type(self).chosen,
                        window=tidy_window(self.window))
        (x0, _), (x1, _) = window_of(state.window, state.full)
        return state if x0 < last and x1 > first else replace(state, window="")

    @cached_property
    def section(self) -> SuslovSection:
        """The section γ3 = 0."""
        return SuslovSection(self.body, self.E, 3)

    @cached_property
    def place(self) -> tuple[float, float]:
        """Where the orbit on show starts; where nothing moves at the chosen place, at another one.

        Raises `OutsideRegion`.
        """
        (chosen,) = places(self.chosen)[-1:]
        if self.section.states_at(*np.array(chosen)[:, None])[1][0]:
            return chosen
        others = self.section.spread(((-math.pi, 0.0), (math.pi, math.pi)), 1)
        if not others:
            raise OutsideRegion("No motion of this energy crosses γ₃ = 0: choose a larger h.")
        x, y = self.section.places_of(np.array(others))[0]
        return float(x), float(y)

    @cached_property
    def start(self) -> Start:
        """Its state; that of the periodic orbit, where its branch is shown."""
        if self.closed is not None:
            return self.closed.state
        return tuple(map(float, self.section.states_at(*np.array(self.place)[:, None])[0][0]))

    # ---- the state ----------------------------------------------------------------------------------------------

    @cached_property
    def sets(self) -> Sets | None:
        """Attractor and repeller of the orbit on show."""
        few = (60, 120) if self.dragging else (500, 1500)
        return self.work.soon(sets_of, self.section, self.place, *few, self.plan(Kind.SECTION).level)

    @cached_property
    def kind(self) -> AtState | None:
        """What kind of motion and of dynamics this is, when it is known."""
        if self.dragging:
            return None
        t = self.plan(Kind.EXPONENT).share * self.long
        return self.work.later(_at_state, self.section, self.place, 500, 1500, t, self.plan(Kind.SECTION).level)

    @cached_property
    def turned(self) -> Section:
        """The moments of reversal of the orbit on show."""
        return self.work.get(reversals, self.body, self.start, self.span, self.level)

    @cached_property
    def turning(self) -> Array:
        """(ω, γ) along it (n,)."""
        return rate(self.orbit.states)

    # ---- what the mouse does ------------------------------------------------------------------------------------

    def start_here(self, x: float, y: float) -> Values:
        """A click in the section: the orbit from there."""
        return {"chosen": written([(x, min(max(y, 1e-6), math.pi - 1e-6))])}

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_section(self) -> str:
        found = self.kind
        if found is None:
            return self.awaited()
        kind = found.regime.kind.words if not found.regime.period else f"period {found.regime.period}"
        if found.dynamics is None:
            return f"The motion: {kind}. Attractor and repeller are not told apart here."
        apart = found.dynamics.apart
        return (f"Motion: {kind}, div = {digits(found.regime.divergence, 2)} ± "
                f"{digits(found.regime.divergence_error, 1)}. Seen: {found.dynamics.verdict}, "
                f"{digits(apart.distance, 2)} ± {digits(max(apart.error, apart.grain), 1)} apart.")

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
        yield from self._orbit_status()

    def derived(self) -> Iterator[str]:
        """The energy, the place on show, the bifurcations of the branch."""
        yield f"E = {digits(self.section.E, 6)}"
        yield f"chosen: ψ = {digits(self.place[0])}, δ = {digits(self.place[1])}"
        yield from super().derived()
        yield check_body(self.I11, self.I22, self.I13, self.I23).sentence


def _at_state(section: SuslovSection, place: tuple[float, float], transient: int, kept: int, t: float, level: Level
              ) -> AtState:
    """`at_state` of the sets that the picture shows, which are computed once."""
    sets = CACHE.get(sets_of, section, place, transient, kept, level)[0]
    return at_state(section, place, sets, transient, kept, t, level)


def _of(sets: Sets | None, which: str) -> Array:
    return frozen(np.empty((0, 2))) if sets is None else np.asarray(getattr(sets, which))


def _few(found: Array) -> Array | None:
    """Places (2, m) that would hardly be seen as dots; None of more."""
    kept = np.unique(np.round(found, 4), axis=0)
    return kept.T if 0 < len(kept) <= _MANY else None


SCENE = Scene(
    OrbitDiagram, __file__, place=15, presets=PRESETS, group="Heavy body",
    charts=(Charted("regime-suslov-section", lambda s: {
        **dict(zip(SYSTEM.parameters, s.body.parameters, strict=True)), "h": s.h, "k": s.section.k, "psi": s.place[0],
        "delta": s.place[1]}, pictures=("diagram", "section")),),
    essential=("h", "first", "last", "I13"), handle="h",
    title="Orbit diagram",
    summary="Attractors and repellers over a parameter: doublings, hysteresis, reversal.",
    tracks={"orbit": lambda s: orbit_columns(s.orbit, turning=s.turning)},
    views=(
        picture(OrbitDiagram, branch.layers(lambda s: s.continued, lambda s: s.side, lambda s: s.turn),
                OrbitDiagram.about),
        constrained_body(),
        Plot(name="section", title="Its section γ₃ = 0, growing", caption=OrbitDiagram._about_section,
             axes=("ψ", "δ"), x=(-math.pi, math.pi), y=(0.0, math.pi), on_click=OrbitDiagram.start_here,
             layers=(*layered_section.layers(
                 lambda s: _of(s.sets, "attractor"), lambda s: _of(s.sets, "repeller"), lambda s: np.empty((0, 2)),
                 chosen=lambda s: [s.place], window=lambda s: ((-math.pi, 0.0), (math.pi, math.pi)),
                 impossible=lambda s: s.section.impossible(((-math.pi, 0.0), (math.pi, math.pi))),
                 labels=("attractor", "repeller")),
                 points("few", lambda s: _few(_of(s.sets, "attractor")), color=theme.ORBIT, size=9),
                 *periodic.places(lambda s: None if s.closed is None else s.closed.orbit),
                 points("few-repelling", lambda s: _few(_of(s.sets, "repeller")), color=theme.UNSTABLE, size=9))),
        Plot(name="reversal", title="Turning about the vertical, (ω, γ)", caption=OrbitDiagram._about_turning,
             axes=("t", "(ω, γ)"), dot=("t", "turning"), first=Axes((0.0, 60.0), (-2.0, 2.0)),
             x=lambda s: (0.0, s.span), y=lambda s: about_0(s.turning, 1e-6),
             layers=(levels("levels", lambda s: [0.0]),
                     over_time("turning", lambda s: (s.orbit.times, s.turning), color=theme.ORBIT,
                               label="(ω, γ) of the chosen orbit"),
                     points("moments", lambda s: (s.turned.times, np.zeros(len(s.turned.times))), color=theme.UNSTABLE,
                            size=11, hollow=True, edge_width=2.5, label="moments of reversal"))),
        replace(along_the_orbit(lambda s: s.r, lambda s: s.proved_around), folded="Show the Poisson sphere"),
    ),
)
