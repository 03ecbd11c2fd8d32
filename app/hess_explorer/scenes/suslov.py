"""The Suslov problem with gravity: sections forward and backward in time, exponent, divergence, basins."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, ChartSource, motion_charts, parameters_of
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import TURN, choice, parameter, points, time_span
from hess_explorer.scenes.framework.solid_body import body_picture
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.parts.orbits.exponent import exponent_trial
from hess_explorer.scenes.parts.sections import (
    PLAIN,
    BodyOrbit,
    Clicks,
    FilledState,
    Section,
    filled_picture,
    filled_section,
    periodic_layers,
    section_trials,
    start_on,
)
from hess_explorer.scenes.parts.sections.basins import SectionBasins, basins_trial
from hess_explorer.scenes.parts.sections.divergence import Divergence, divergence_picture
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs import conformal_time
from hess_explorer.views.plane import layered_section
from hess_explorer.views.plane.velocity_plane import (
    chosen_orbit,
    orbit_alone,
    orbit_columns,
    pixels_per_unit,
    round_up,
)
from hess_explorer.views.space.poisson_sphere import centre_of_mass, orbit_sphere
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.cells import occupied_cells
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import Level, cheapest
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
_LATE, _FORWARD = "the later half", "forward only"

_REGULAR = parameters_of(SuslovBody(1.5, 4.0, 0.0, 0.8, 0.0, 1.0, 0.7))
_STRANGE = parameters_of(SuslovBody(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7))
_TWO = parameters_of(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0))
_REVERSAL = parameters_of(SuslovBody(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3))
_PRINCIPAL = parameters_of(SuslovBody(1.5, 1.0, 0.0, 0.0, 0.4, -0.3, 0.8))
PRESETS = (
    Preset("A chaotic sea", **PLAIN, plane="γ₃ = 0"),
    Preset("Regular orbits (not a rigid body)", **_REGULAR, h=0.699656, starts="-1.5,1"),
    Preset(
        "Strange attractor (not a rigid body)",
        **_STRANGE,
        h=2.000091,
        colours=_FORWARD,
        count=600.0,
        drop=_LATE,
        long=3000.0,
    ),
    Preset("Two attractors, and their basins", **_TWO, h=2.999584, colours="basins", count=400.0, drop=_LATE),
    # Nearly all points lie at the two fixed points, so a density would show little.
    Preset(
        "Reversal: attractor and repeller (not a rigid body)", **_REVERSAL, h=2.999981, count=100.0, indicator="nothing"
    ),
    Preset(
        "On a principal axis, I₁₃ = I₂₃ = 0: volume is preserved",
        **_PRINCIPAL,
        h=1.643398,
        colours=_FORWARD,
        starts="0,1.5",
    ),
)


@dataclass(frozen=True)
class Suslov(FilledState):
    """A section of a body at one energy, with orbits forward and backward in time."""

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
        (_BOTH, _FORWARD, "basins"),
        _BOTH,
        doc="Basins: the attractor to which each point of the section leads, and how soon.",
    )
    drop: str = choice(
        "Points shown",
        ("all", _LATE),
        "all",
        doc="The later half omits the transient: it shows the attractor, or backward in time the repeller.",
    )
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    starts: str = points("The points of the chosen orbits", 12, *_BOUNDS, "1,1")
    window: str = points("The window of the section", 2, *_BOUNDS)

    def valid_state(self, notes: list[str]) -> Suslov:
        """Return a state with a valid window, a start, and an energy that reaches the section; append notes."""
        state = super().valid_state(notes)
        bottom = self.poincare.lowest_energy + math.hypot(self.b1, self.b2, self.b3)
        if self.h <= bottom * (1.0 + 1e-9):
            state = replace(state, h=bottom * 1.01 + 1e-6)
            notes.append(f"Motions reach {self.plane} only for h > {digits(bottom)}: h was set to {digits(state.h)}.")
        return state

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
        return round_up(1.05 * math.sqrt(2.0 * self.h / min(self.I11, self.I22)))

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels per unit of each variable."""
        return pixels_per_unit(self.half_width)

    def orbit_level(self) -> Level:
        """Return the level of accuracy of the orbit.

        Near the lowest energy the motion is small compared with the velocity scale of a level's promise.
        """
        share = self.half_width / float(SYSTEM.frequency(np.array(self.start), np.array(self.body.parameters)))
        return max(self.level, cheapest(HALF_A_PIXEL * share), key=lambda rung: rung.order)

    # ---- the parts ----------------------------------------------------------------------------------------------

    @part
    def section(self) -> Section:
        """The section."""
        ways = (True, False) if self.colours == _BOTH else (True,)
        return filled_section(
            self, 12, directions=ways, second_half_only=self.drop == _LATE, is_exclusive=self.colours != "basins"
        )

    clicks = part(lambda s: Clicks(s, "no motion has this energy"))
    orbit = part(lambda s: BodyOrbit(s, s.orbit_level))
    exponent = part(Divergence)
    basins = part(lambda s: SectionBasins(s, s.section))

    @cached_property
    def _conformal(self) -> tuple[Conformal | None, str]:
        """The orbit in real and in conformal time and an empty string; or None and the reason."""
        if self.I13 != 0.0 or self.I23 != 0.0:
            return None, "Needs I₁₃ = I₂₃ = 0, as in the example “On a principal axis”."
        try:
            return self.work.need(Task(conformal, self.body, self.start, self.duration, self.orbit_level())), ""
        except WorkLimit as error:
            return None, str(error)

    def _section_title(self) -> str:
        return f"Section {self.plane}{' (upward crossings)' if self.basins.arrivals is None else ': basins'}"

    def _about_section(self) -> Caption:
        special = self.section_caption or self.basins.caption
        if special is not None:
            return special
        first, second = self.section.points(), self.section.points(False)
        if not self.orbits:
            return Caption(numbers=f"{len(self.section.chosen_points)} points of chosen orbits.")
        backward = f", {len(second)} backward" if len(second) else ""
        # The second halves of the forward orbits show the attractors.
        later = self.section.points(second_half_only=True)
        counted = self.density.phrase or f"{len(first)} points forward{backward}; "
        cells = occupied_cells(later, self.poincare.window, _CELLS)
        return Caption(numbers=f"{counted}late forward points occupy {cells} of {_CELLS**2} cells.")

    def quantities(self) -> Iterator[str]:
        """Yield the energy, the start of the orbit and the check of the body."""
        yield f"E = {digits(self.E)}"
        yield from super().quantities()
        yield check_body(self.I11, self.I22, self.I13, self.I23).sentence


SCENE = Scene(
    Suslov,
    __file__,
    place=5,
    presets=PRESETS,
    level_trials=(*section_trials(orbits=40.0), exponent_trial(), basins_trial()),
    charts=Charts(
        (
            *motion_charts(SYSTEM, lambda s: start_on(s.poincare, s.starts), time=lambda s: s.long),
            ChartSource(
                "basins suslov-section",
                # One cell is enough, because attractors belong to the whole section.
                lambda s: {**parameters_of(s.body), "h": s.h, "k": s.poincare.k, "across": 1.0, "up": 1.0},
            ),
        ),
        over=_NAMES,
        point=("starts", _NAMES),
    ),
    group="Heavy body",
    essential=("h", "I13", "I23", "b3"),
    answers=(
        Answer("Each colour marks the starts that end on one attractor.", lambda s: s.colours == "basins"),
        Answer(
            "On a principal axis volume is preserved: nothing attracts, in either direction of time.",
            lambda s: s.I13 == s.I23 == 0.0,
        ),
        Answer("Each dot is one return: dots on a curve look regular, a cloud of dots looks chaotic."),
    ),
    title="Suslov problem with gravity",
    summary="Regular orbits, seas, strange attractors: sections forward and backward in time.",
    swarm=turned_swarm(),
    tracks={"orbit": lambda s: orbit_columns(s.orbit.path)},
    views=(
        filled_picture(
            ((-math.pi, 0.0), (math.pi, math.pi)),
            axes=_NAMES,
            title=Suslov._section_title,
            caption=Suslov._about_section,
            labels=("forward in time", "backward"),
            under=(layered_section.basins(lambda s: s.basins.arrivals, lambda s: s.section.frame),),
            over=periodic_layers(lambda s: s.basins),
        ),
        body_picture(),
        divergence_picture(),
        orbit_sphere(
            lambda s: centre_of_mass((s.b1, s.b2, s.b3)), lambda s: s.proof.circles, lambda s: s.clicks.colour
        ),
        replace(
            orbit_alone(
                lambda s: s.half_width,
                lambda s: s.E,
                lambda s: s.proof.band,
                orbits=chosen_orbit(lambda s: s.orbit.path.states[:, :2], lambda s: s.clicks.colour),
            ),
            button="Show the angular velocity",
        ),
        conformal_time.picture(lambda s: s._conformal[0], lambda s: s._conformal[1], lambda s: s.duration),
    ),
)
