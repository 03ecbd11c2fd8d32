"""The Suslov problem with gravity: sections forward and backward in time, exponent, divergence, basins."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Value
from hess_explorer.scenes.framework.charted import Charted, Charts, of_motion, parameters_of
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import (
    TURN,
    accuracy_level,
    choice,
    exponent_time,
    parameter,
    places,
    time_span,
)
from hess_explorer.scenes.framework.solid_body import Solid, constrained_solid, solid_body
from hess_explorer.scenes.parts.orbits.exponent import Exponent, exponent_trial
from hess_explorer.scenes.parts.orbits.proof import Proof, proved_error_shown
from hess_explorer.scenes.parts.sections import (
    Clicks,
    Orbit,
    SectionState,
    colouring,
    filled,
    filled_picture,
    length_of_manifolds,
    orbits_spread,
    periodic_layers,
    plain,
    points_of_each,
    section_trials,
    shown_in_section,
    which,
)
from hess_explorer.scenes.parts.sections.basins import Basins, basins_trial
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs import conformal_time
from hess_explorer.views.graphs.graph import over_time, settled_range, thinned
from hess_explorer.views.layers import Axes, levels
from hess_explorer.views.plane import layered_section
from hess_explorer.views.plane.section_plane import joined
from hess_explorer.views.plane.velocity_plane import nice_above, orbit_alone, orbit_columns, pixels_per_unit
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import along_the_orbit, centre_of_mass
from hess_explorer.views.text import digits, with_error
from hess_mechanics.dynamics.basins import MeanDivergence, mean_divergence
from hess_mechanics.dynamics.cells import occupied_cells
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import Kind, Level, cheapest
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import B1, B2, B3, H_SUSLOV, I11, I13, I22, I23
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.principal_axis import Conformal, conformal
from hess_mechanics.suslov.suslov_section import SuslovSection

_CELLS = 32
_NAMES = ("ψ", "δ")
_BOUNDS = ((-TURN, 0.0), (TURN, TURN))
_PLANES = {"γ₃ = 0": 3, "γ₁ = 0": 1, "γ₂ = 0": 2}
_BOTH = "forward and backward in time"


def _body(*parameters: float, E: float) -> dict[str, Value]:
    """Return the parameters of `SYSTEM` by name, and h for an energy."""
    values: dict[str, Value] = dict(zip(SYSTEM.parameters, parameters, strict=True))
    return {**values, "h": round(E + math.hypot(*parameters[-3:]), 6), "plane": "γ₃ = 0"}


PRESETS = (
    *map(
        plain,
        (
            Preset("A chaotic sea", plane="γ₃ = 0", colours=_BOTH, drop="all"),
            Preset(
                "Regular orbits (not a rigid body)",
                **_body(1.5, 4.0, 0.0, 0.8, 0.0, 1.0, 0.7, E=-0.521),
                colours=_BOTH,
                drop="all",
                starts="-1.5,1",
            ),
            Preset(
                "Strange attractor (not a rigid body)",
                **_body(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7, E=0.681),
                colours="forward only",
                count=600.0,
                drop="the later half",
                long=3000.0,
            ),
            Preset(
                "Two attractors, and their basins",
                **_body(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0, E=1.842),
                colours="basins",
                count=400.0,
                drop="the later half",
            ),
            Preset(
                "Reversal: attractor and repeller (not a rigid body)",
                **_body(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3, E=1.743),
                colours=_BOTH,
                count=100.0,
                drop="all",
                # All points but a few lie at the two fixed points.
                indicator="nothing",
            ),
            Preset(
                "On a principal axis, I₁₃ = I₂₃ = 0: volume is preserved",
                **_body(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8, E=0.7),
                colours="forward only",
                drop="all",
                starts="0,1.5",
            ),
        ),
    ),
)


@dataclass(frozen=True)
class Suslov(SectionState):
    """A section of one body at one energy, filled with orbits forward and backward in time."""

    I11: float = parameter(I11)
    I22: float = parameter(I22, 3.0)
    I13: float = parameter(I13)
    I23: float = parameter(I23)
    b1: float = parameter(B1)
    b2: float = parameter(B2)
    b3: float = parameter(B3)
    h: float = parameter(H_SUSLOV)
    plane: str = choice(
        "Section", tuple(_PLANES), "γ₃ = 0", doc="Component of γ that is 0 on the section (upward crossings)."
    )
    colours: str = choice(
        "Show",
        (_BOTH, "forward only", "basins"),
        _BOTH,
        doc="Basins: the attractor to which each point of the section leads, and how soon.",
    )
    drop: str = choice("Points shown", ("all", "the later half"), "all", doc="The later half shows the attractor.")
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

    def admitted(self, notes: list[str]) -> Suslov:
        """Return a state with a valid window, at least one start, and an energy that reaches the plane."""
        state = super().admitted(notes)
        bottom = self.poincare.lowest_energy + math.hypot(self.b1, self.b2, self.b3)
        if self.h <= bottom * (1.0 + 1e-9):
            state = replace(state, h=bottom * 1.01 + 1e-6)
            notes.append(f"Motions reach {self.plane} only for h > {digits(bottom)}: h was set to {digits(state.h)}.")
        return state

    # ---- the motion ---------------------------------------------------------------------------------------------

    @cached_property
    def body(self) -> SuslovBody:
        """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return SuslovBody(self.I11, self.I22, self.I13, self.I23, self.b1, self.b2, self.b3)

    @property
    def E(self) -> float:
        """The energy."""
        return self.h - math.hypot(self.b1, self.b2, self.b3)

    @cached_property
    def poincare(self) -> SuslovSection:
        """The section in (ψ, δ)."""
        return SuslovSection(self.body, self.E, _PLANES[self.plane])

    @property
    def half_width(self) -> float:
        """Half width of the (ω1, ω2)-plane, with room for all motions of this energy."""
        return nice_above(1.05 * math.sqrt(2.0 * self.h / min(self.I11, self.I22)))

    @property
    def weights(self) -> tuple[float, ...]:
        """Scale of each variable in pixels per unit."""
        return pixels_per_unit(self.half_width)

    def orbit_level(self) -> Level:
        """Return the level of the orbit on show.

        Near the lowest energy the motion is small compared with the velocity scale of a level's promise.
        """
        share = self.half_width / float(SYSTEM.frequency(np.array(self.start), np.array(self.body.parameters)))
        return max(self.level, cheapest(HALF_A_PIXEL * share), key=lambda rung: rung.order)

    # ---- the parts ----------------------------------------------------------------------------------------------

    section = part(
        lambda s: filled(
            s,
            12,
            ways=(True, False) if s.colours == _BOTH else (True,),
            later=s.drop != "all",
            bounds=_BOUNDS,
            alone=s.colours != "basins",
        )
    )
    clicks = part(lambda s: Clicks(s, "no motion has this energy", _BOUNDS))
    density, megno, periodic_orbit = shown_in_section()
    orbit = part(lambda s: Orbit(s, s.orbit_level))
    proof = part(lambda s: Proof(s.orbit, s.certain))
    exponent = part(Exponent)
    basins = part(lambda s: Basins(s, s.section))

    @property
    def impossible_here(self) -> str:
        """The message for a window that no motion reaches."""
        return (
            f"Nothing is possible in this window with the energy E = {self.E:.6g}: choose a larger h, or press "
            "Clear for the whole section."
        )

    @cached_property
    def course(self) -> MeanDivergence | None:
        """The mean divergence along the orbit on show; None until known and while a slider is held."""
        return (
            None
            if self.exponent.later
            else self.work.need(
                Task(mean_divergence, self.body, self.start, self.plan(Kind.EXPONENT).share * self.long), preview=None
            )
        )

    # ---- the other pictures -------------------------------------------------------------------------------------

    @property
    def rates(self) -> tuple[tuple[Array, Array], ...]:
        """Times and values of the exponent and of the mean divergence, once both are known.

        For a periodic orbit they come from its multipliers.
        """
        if self.exponent.growth is not None:
            return tuple((np.array([0.0, self.long]), np.full(2, rate)) for rate in self.exponent.growth)
        exponent, course = self.exponent.found, self.course
        return (
            ()
            if exponent is None or course is None
            else ((exponent.times, exponent.rates), (course.times, course.mean))
        )

    def rate(self, i: int) -> tuple[Array, Array] | None:
        """Return the curve of the exponent (0), or of the mean divergence (1)."""
        return thinned(*self.rates[i]) if self.rates else None

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit.path)

    @cached_property
    def _conformal(self) -> tuple[Conformal | None, str]:
        """The orbit on show in both times, or None and the reason."""
        if self.I13 != 0.0 or self.I23 != 0.0:
            return None, "Only for I₁₃ = I₂₃ = 0, as in the example “On a principal axis”."
        try:
            return self.work.need(Task(conformal, self.body, self.start, self.lasts, self.orbit_level())), ""
        except WorkLimit as error:
            return None, str(error)

    # ---- words --------------------------------------------------------------------------------------------------

    def _section_title(self) -> str:
        return f"Section {self.plane}{' (upward crossings)' if self.basins.found is None else ': basins'}"

    def _about_section(self) -> Caption:
        special = self.periodic_orbit.caption or self.megno.caption or self.basins.caption
        if special is not None:
            return special
        first, second = self.section.points(), self.section.points(False)
        if not self.orbits:
            return Caption(numbers=f"{len(self.section.own)} points of chosen orbits.")
        backward = f", {len(second)} backward" if len(second) else ""
        # The later halves of the forward orbits show the attractors.
        later = joined(orbit[len(orbit) // 2 :] for orbit in self.section.kind())
        counted = self.density.said or f"{len(first)} points forward{backward}; "
        cells = occupied_cells(later, self.poincare.window, _CELLS)
        return Caption(numbers=f"{counted}late forward points occupy {cells} of {_CELLS**2} cells.")

    def _about_rates(self) -> Caption:
        if self.exponent.growth is not None:
            across, divergence = map(digits, self.exponent.growth)
            return Caption(
                "From the multipliers of the periodic orbit.", f"ln|μ₁|/T = {across}, div = ln|μ₁μ₂|/T = {divergence}."
            )
        exponent, course = self.exponent.found, self.course
        if exponent is None or course is None:
            return Caption(self.awaited())
        end = digits(float(course.times[-1]))
        return Caption(
            numbers=f"λ = {with_error(exponent.value, exponent.spread)}, "
            f"div = {digits(float(course.mean[-1]), 3)} after t = {end}.",
        )

    def derived(self) -> Iterator[str]:
        """Yield the energy, the start of the orbit on show and the check of the body."""
        yield f"E = {digits(self.E)}"
        yield self.clicks.sentence
        yield from super().derived()
        yield check_body(self.I11, self.I22, self.I13, self.I23).sentence


SCENE = Scene(
    Suslov,
    __file__,
    place=5,
    presets=PRESETS,
    measures=(
        *section_trials(orbits=40.0),
        exponent_trial(),
        basins_trial(),
    ),
    charts=Charts(
        (
            *of_motion(SYSTEM, lambda s: s.clicks.asked_start, time=lambda s: s.long),
            Charted(
                "basins suslov-section",
                ("attractors",),
                # Attractors belong to the whole section: one cell is enough.
                lambda s: {**parameters_of(s.body), "h": s.h, "k": s.poincare.k, "across": 1.0, "up": 1.0},
            ),
        ),
        over=_NAMES,
        placed=("starts", _NAMES),
    ),
    group="Heavy body",
    essential=("h", "I13", "I23", "b3"),
    title="Suslov problem with gravity",
    summary="Regular orbits, seas, strange attractors: sections forward and backward in time.",
    tracks={"orbit": lambda s: orbit_columns(s.orbit.path)},
    views=(
        filled_picture(
            ((-math.pi, 0.0), (math.pi, math.pi)),
            axes=_NAMES,
            title=Suslov._section_title,
            caption=Suslov._about_section,
            labels=("forward in time", "backward"),
            under=(layered_section.basins(lambda s: s.basins.found, lambda s: s.section.frame),),
            over=periodic_layers(lambda s: s.basins),
        ),
        solid_body(),
        Plot(
            name="exponent",
            title="Lyapunov exponent and divergence",
            caption=Suslov._about_rates,
            axes=("t", "λ"),
            first=Axes((0.0, 1000.0), (-0.2, 0.2)),
            x=lambda s: (0.0, s.long),
            y=lambda s: settled_range([y for _, y in s.rates]) if s.rates else None,
            layers=(
                levels("levels", lambda s: [0.0] if s.rates else []),
                over_time(
                    "divergence",
                    lambda s: s.rate(1),
                    color=theme.MAP,
                    dash="dashed",
                    label="mean divergence",
                    tag="divergence",
                ),
                over_time("lambda", lambda s: s.rate(0), color=theme.ORBIT, label="exponent λ", tag="λ"),
            ),
        ),
        along_the_orbit(lambda s: centre_of_mass((s.b1, s.b2, s.b3)), lambda s: s.proof.around),
        replace(
            orbit_alone(lambda s: s.half_width, energy=lambda s: s.E, proved=lambda s: s.proof.band),
            folded="Show the angular velocity",
        ),
        conformal_time.picture(lambda s: s._conformal[0], lambda s: s._conformal[1], lambda s: s.lasts),
    ),
)
