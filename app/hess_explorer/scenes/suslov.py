"""The Suslov problem with gravity: sections forward and backward in time, exponent, divergence, basins."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Value
from hess_explorer.scenes.framework.basins import BASINS, Basins
from hess_explorer.scenes.framework.charted import Charted, Placed, exponents, motion_of
from hess_explorer.scenes.framework.filled_window import EXPONENT, SECTION, TURN, OrbitBatch, filled_window
from hess_explorer.scenes.framework.heavy_suslov import HeavySuslov
from hess_explorer.scenes.framework.indicator import INDICATOR, colouring
from hess_explorer.scenes.framework.inertia import Tensor
from hess_explorer.scenes.framework.one_orbit import Start
from hess_explorer.scenes.framework.parameters import (
    accuracy_level,
    choice,
    exponent_time,
    like,
    number,
    orbits_spread,
    places,
    points_of_each,
    time_span,
)
from hess_explorer.scenes.framework.periodic import length_of_manifolds, plain, which
from hess_explorer.scenes.framework.proved_orbit import proved_error_shown
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.solid_body import ConstrainedBody, constrained_body
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views import conformal_time, layered_section, theme
from hess_explorer.views.graph import over_time, settled_range, thinned
from hess_explorer.views.layers import Axes, levels
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import along_the_orbit
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import orbit_alone, orbit_columns
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL
from hess_mechanics.dynamics.section import occupied_cells
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import Computation, Level, cheapest
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.principal_axis import Conformal, conformal
from hess_mechanics.suslov.section import MeanDivergence, SuslovSection, lowest_energy, mean_divergence, suslov_points

_MOST_STEPS = 100_000
_CELLS = 32
_BOUNDS = ((-TURN, 0.0), (TURN, TURN))
_PLANES = {"γ₃ = 0": 3, "γ₁ = 0": 1, "γ₂ = 0": 2}
_BOTH = "forward and backward in time"


def _body(I11: float, I22: float, I13: float, I23: float, b1: float, b2: float, b3: float, E: float
          ) -> dict[str, Value]:
    return {"I11": I11, "I22": I22, "I13": I13, "I23": I23, "b1": b1, "b2": b2, "b3": b3,
            "h": round(E + math.hypot(b1, b2, b3), 6), "plane": "γ₃ = 0"}


PRESETS = (*map(plain, (
    Preset("A chaotic sea", plane="γ₃ = 0", colours=_BOTH, drop="all"),
    Preset("Regular orbits (not a rigid body)", **_body(1.5, 4.0, 0.0, 0.8, 0.0, 1.0, 0.7, -0.521),
           colours=_BOTH, drop="all", starts="-1.5,1"),
    Preset("Strange attractor (not a rigid body)", **_body(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7, 0.681),
           colours="forward only", count=600.0, drop="the later half", long=3000.0),
    Preset("Two attractors, and their basins", **_body(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0, 1.842), colours="basins",
           count=400.0, drop="the later half"),
    Preset("Reversal: what attracts, and what repels (not a rigid body)",
           **_body(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3, 1.743), colours=_BOTH, count=100.0, drop="all"),
    Preset("On a principal axis, I₁₃ = I₂₃ = 0: volume is kept", **_body(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8, 0.7),
           colours="forward only", drop="all", starts="0,1.5"),
)),)


@dataclass(frozen=True)
class Suslov(HeavySuslov, Basins, ConstrainedBody):
    """A section of one body at one energy, filled with orbits forward and backward in time."""

    I22: float = like(Tensor, "I22", 3.0)
    h: float = number("h", 1.0, (0.01, 6.0), 0.01, bounds=(1e-6, 1e6), label="Energy above the bottom, h",
                      doc="E + |b|, the energy above its smallest possible value.")
    plane: str = choice("Section", tuple(_PLANES), "γ₃ = 0",
                        doc="The plane is crossed while that component of γ grows.")
    colours: str = choice("Show", (_BOTH, "forward only", "basins"), _BOTH,
                          doc="Basins: to which group of motions, or attractor, each point of the section leads.")
    drop: str = choice("Points shown", ("all", "the later half"), "all", doc="The later half shows what attracts.")
    periodic: str = which()
    indicator: str = colouring()
    orbits: float = orbits_spread(40.0, 120.0, 300.0)
    count: float = points_of_each(200.0)
    reach: float = length_of_manifolds()
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    long: float = exponent_time(1000.0, 5000.0, 2e4, "the Lyapunov exponent and the divergence are")
    certain: str = proved_error_shown()
    accuracy: str = accuracy_level()
    starts: str = places("The places of the chosen orbits", 12, *_BOUNDS, "1,1")
    window: str = places("The window of the section", 2, *_BOUNDS)

    names: ClassVar[tuple[str, str]] = ("ψ", "δ")
    excuse: ClassVar[str] = "no motion has this energy"
    full: ClassVar[Window] = ((-math.pi, 0.0), (math.pi, math.pi))
    bounds: ClassVar[Window] = _BOUNDS
    held: ClassVar[tuple[int, int]] = (12, 40)

    def admitted(self, notes: list[str]) -> Suslov:
        """A window that is one, at least one start, an energy that reaches the plane."""
        state = super().admitted(notes)
        bottom = lowest_energy(self.body, _PLANES[self.plane]) + math.hypot(self.b1, self.b2, self.b3)
        if self.h <= bottom * (1.0 + 1e-9):
            state = replace(state, h=bottom * 1.01 + 1e-6)
            notes.append(
                f"Motions reach {self.plane} only for h > {digits(bottom)}: h is {digits(state.h)} now.")
        return state

    @property
    def asked(self) -> bool:
        """Whether basins are to be shown."""
        return self.colours == "basins"

    @cached_property
    def section(self) -> SuslovSection:
        """The section."""
        return SuslovSection(self.body, self.E, _PLANES[self.plane])

    @property
    def orbit_level(self) -> Level:
        """Near the bottom the motion is small beside the velocities of which a level promises a part."""
        share = self.half_width / float(SYSTEM.frequency(np.array(self.start), np.array(self.body.parameters)))
        return max(self.level, cheapest(HALF_A_PIXEL * share), key=lambda rung: rung.order)

    # ---- the section --------------------------------------------------------------------------------------------

    def piece(self, starts: tuple[Start, ...], crossings: int, forward: bool, level: Level) -> Task:
        """What follows these orbits."""
        return Task(_piece, (self.section, starts, crossings, forward, level))

    @property
    def impossible_here(self) -> str:
        """What is said where nothing is possible in the window."""
        return (f"Nothing is possible in this window with the energy E = {self.E:.6g}: choose a larger h, or press "
                "Clear for the whole section.")

    @property
    def ways(self) -> tuple[bool, ...]:
        """Whether orbits are followed forward in time, or both forward and backward."""
        return (True, False) if self.colours == _BOTH else (True,)

    def shown(self, orbit: Array) -> Array:
        """All points of an orbit, or the later half of them."""
        return orbit if self.drop == "all" else _later(orbit)

    @cached_property
    def later(self) -> Array:
        """The later halves of the forward orbits, which show what attracts."""
        return joined(map(_later, self.kind(True)))

    @cached_property
    def course(self) -> MeanDivergence | None:
        """The mean divergence along the orbit on show, when it is known; not while a slider is held."""
        return None if self.dragging or self.looking or self.closed is not None else self.work.later(
            mean_divergence, self.body, self.start, self.plan(Computation.EXPONENT).share * self.long)

    # ---- the other pictures -------------------------------------------------------------------------------------

    @property
    def rates(self) -> tuple[tuple[Array, Array], ...]:
        """Times and values of the exponent and of the mean divergence, when both are known.

        Those of a periodic orbit are its own.
        """
        if self.growth is not None:
            return tuple((np.array([0.0, self.long]), np.full(2, rate)) for rate in self.growth)
        exponent, course = self.exponent, self.course
        return () if exponent is None or course is None else (
            (exponent.times, exponent.rates), (course.times, course.mean))

    def rate(self, i: int) -> tuple[Array, Array] | None:
        """The curve of the exponent (0), or of the mean divergence (1)."""
        return thinned(*self.rates[i]) if self.rates else None

    @cached_property
    def _conformal(self) -> tuple[Conformal | None, str]:
        """The orbit on show in its two times, or why there is none."""
        if self.I13 != 0.0 or self.I23 != 0.0:
            return None, "Only for I₁₃ = I₂₃ = 0, as in the example “On a principal axis”."
        try:
            return self.work.get(conformal, self.body, self.start, self.lasts, self.orbit_level), ""
        except WorkLimit as error:
            return None, str(error)

    # ---- words --------------------------------------------------------------------------------------------------

    def _section_title(self) -> str:
        return f"Section {self.plane}, growing" if self.basin is None else f"Section {self.plane}: basins"

    def _about_section(self) -> str:
        if self.about_closed or self.about_indicator:
            return self.about_closed or self.about_indicator
        if self.basin is not None:
            return self.about_basins(self.basin)
        backward = f", {len(self.second)} backward" if len(self.second) else ""
        return (f"{len(self.first)} points forward{backward}; the later forward ones lie in "
                f"{occupied_cells(self.later, _CELLS)} of {_CELLS**2} cells.")

    def _about_rates(self) -> str:
        if self.growth is not None:
            across, divergence = map(digits, self.growth)
            return f"Next to the periodic orbit: ln|μ₁|/T = {across}, div = ln|μ₁μ₂|/T = {divergence}."
        exponent, course = self.exponent, self.course
        if exponent is None or course is None:
            return self.awaited("They are")
        return (f"λ = {digits(exponent.value, 3)} ± {digits(exponent.spread, 2)}, "
                f"div = {digits(float(course.mean[-1]), 3)} after t = {digits(float(course.times[-1]))}.")

    def derived(self) -> Iterator[str]:
        """The energy, the start of the orbit on show, whether this is a rigid body."""
        yield f"E = {digits(self.E, 6)}"
        yield f"chosen: {self.at(self.chosen)}"
        yield from super().derived()
        yield check_body(self.I11, self.I22, self.I13, self.I23).sentence


def _later(orbit: Array) -> Array:
    return orbit[len(orbit) // 2 :]


def _piece(section: SuslovSection, starts: tuple[Start, ...], crossings: int, forward: bool,
           level: Level) -> OrbitBatch:
    points = suslov_points(section.body, section.k, starts, crossings, forward, level, threads=1,
                           most_steps=_MOST_STEPS)
    return OrbitBatch(tuple(frozen(section.places_of(states)) for states in points.states), (forward,) * len(starts),
                      points.drift)


SCENE = Scene(
    Suslov, __file__, place=5, presets=PRESETS, measures=(SECTION, INDICATOR, EXPONENT, BASINS), charts=(
        *exponents(SYSTEM.name, lambda s: s.start_asked_for, ("section",), time=lambda s: s.long),
        Charted("divergence-suslov", lambda s: {**motion_of(s.body, s.start_asked_for), "t": s.long}),
        Charted("attractors", lambda s: {
            **dict(zip(SYSTEM.parameters, s.body.parameters, strict=True)), "h": s.h, "k": s.section.k})),
    placed=Placed("starts", Suslov.names),
    group="Heavy body", essential=("h", "I13", "I23", "b3"),
    title="Suslov problem with gravity",
    summary="Regular orbits, seas, strange attractors: sections forward and backward in time.",
    tracks={"orbit": lambda s: orbit_columns(s.orbit)},
    views=(
        filled_window(title=Suslov._section_title, caption=Suslov._about_section, scene=Suslov,
                      labels=("forward in time", "backward"),
                      under=(layered_section.basins(lambda s: s.basin, lambda s: s.frame),)),
        constrained_body(),
        Plot(name="exponent", title="Lyapunov exponent and divergence", caption=Suslov._about_rates,
             axes=("t", "λ"), first=Axes((0.0, 1000.0), (-0.2, 0.2)), x=lambda s: (0.0, s.long),
             y=lambda s: settled_range([y for _, y in s.rates]) if s.rates else None,
             layers=(levels("levels", lambda s: [0.0] if s.rates else []),
                     over_time("divergence", lambda s: s.rate(1), color=theme.MAP, dash="dashed",
                               label="mean divergence"),
                     over_time("lambda", lambda s: s.rate(0), color=theme.ORBIT, label="exponent λ"))),
        along_the_orbit(lambda s: s.r, lambda s: s.proved_around),
        replace(orbit_alone(lambda s: s.half_width, energy=lambda s: s.E, proved=lambda s: s.proved_band),
                folded="Show the angular velocity"),
        conformal_time.picture(lambda s: s._conformal[0], lambda s: s._conformal[1], lambda s: s.lasts),
    ),
)
