"""Constraint axis on a principal axis, b1 = b2 = 0: a point in a quartic potential, its section, and the body."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, motion_charts
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import Slider, number, parameter, slider_within, time_span
from hess_explorer.scenes.framework.solid_body import body_picture
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.parts.sections import (
    PLAIN,
    Section,
    SectionBranch,
    SectionState,
    branch_picture,
    coordinate_of_branch,
    end_of_branch,
    parameter_of_branch,
    section_layers,
    section_picture,
    section_trials,
)
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes
from hess_explorer.views.plane import plane_domain, section_plane
from hess_explorer.views.plane.velocity_plane import round_up, symmetric_range
from hess_explorer.views.space.poisson_sphere import Sphere, centre_of_mass, parallels
from hess_explorer.views.text import digits, variation_text, vector
from hess_mechanics.dynamics.cells import occupied_cells
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import B3, H_QUARTIC, I22, RATIO
from hess_mechanics.suslov import quartic as model
from hess_mechanics.suslov.equations import SYSTEM

_CELLS = 32
_NAMES = ("q", "p")
_ALONG = {"h": "h", "I₁₁/I₂₂": "ratio", "b₃": "b3"}
_P_AXIS = symmetric_range(1.05)
_HEIGHTS = (-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75)
"""Values of γ3 on the equipotentials."""

PRESETS = (
    Preset("Mixed: in the sea", **PLAIN),
    Preset("Mixed: on a curve", Q1=0.2, Q2=1.9, beta=0.0),
    Preset("Integrable: I₁₁ = I₂₂", ratio=1.0, h=0.6),
    Preset("Integrable, in a ring: h > |b₃|", ratio=1.0, h=1.5, Q1=1.8, Q2=0.0),
    Preset("Regular: nearly round", ratio=1.05, h=0.6),
    Preset("A sea nearly everywhere", ratio=3.0, h=1.2, Q1=0.9, Q2=1.2),
    Preset("In a ring: bouncing at one end", ratio=1.5, h=3.0, Q1=0.3, Q2=3.0, beta=1.571, span=60.0),
    Preset("A pitchfork, over h", Q1=0.0, Q2=0.266, beta=0.0, periodic="period 1", over="h", low=0.6, high=0.95),
)


@dataclass(frozen=True)
class Quartic(SectionState):
    """The orbit of a point in the potential, among others of the same energy."""

    # Narrower bounds than in other scenes: beyond them a section takes too many Taylor steps.
    I22: float = parameter(I22, 1.0, softbounds=(0.2, 3.0), bounds=(1e-2, 1e2))
    ratio: float = parameter(RATIO)
    b3: float = parameter(B3, 1.0, bounds=(-1e2, 1e2), doc="b = −mg r with b₁ = b₂ = 0; b₃ must not be 0.")
    h: float = parameter(H_QUARTIC)
    Q1: float = number(
        "q₁",
        0.6,
        (-2.0, 2.0),
        0.01,
        bounds=(-1e30, 1e30),
        label="Start q₁ = I₂₂ω₂/b₃",
        doc="Start of the orbit; click the plane to choose it.",
    )
    Q2: float = number(
        "q₂",
        0.3,
        (-2.0, 2.0),
        0.01,
        bounds=(-1e30, 1e30),
        label="Start q₂ = −I₁₁ω₁/b₃",
        doc="Start of the orbit; click the plane to choose it.",
    )
    beta: float = number(
        "β",
        1.0,
        (-3.14, 3.14),
        0.01,
        bounds=(-math.pi, math.pi),
        label="Start: direction β",
        doc="Initial direction of the point: q̇ = −p, |p| = √(1 − γ₃²). Click the section to set q₁, q₂ and β.",
    )
    over: str = parameter_of_branch(tuple(_ALONG))
    low: float = end_of_branch("from")
    high: float = end_of_branch("to")
    upwards: str = coordinate_of_branch(_NAMES)
    span: float = time_span(40.0, 200.0, most=1e3, what="the chosen orbit")

    def valid_state(self, notes: list[str]) -> Quartic:
        """Return the state with a forbidden start moved to the edge of the region; append a note."""
        q = self.body.nearest_possible((self.Q1, self.Q2))
        if q != (self.Q1, self.Q2):
            notes.append(f"With this energy the start is impossible: it was moved to the edge, q = {vector(q)}.")
        return self.with_values({"Q1": q[0], "Q2": q[1]})

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges: h above −|b3|, q over the region."""
        low, top, step = slider_within(abs(self.body.b3))
        return {
            "h": (0.9 * low, 4.0 * top, step),
            **dict(zip(("Q1", "Q2"), map(slider_within, self.body.axes), strict=True)),
        }

    @cached_property
    def body(self) -> model.QuarticBody:
        """The body at its energy.  Raises `NoField`, `OutsideRegion`, `InvalidParameter`, `NotPositiveDefinite`."""
        return model.QuarticBody(self.ratio * self.I22, self.I22, self.b3, self.h)

    @cached_property
    def poincare(self) -> model.QuarticSection:
        """The section, along the longer axis of the region."""
        return model.QuarticSection(self.body)

    @cached_property
    def chosen_start(self) -> Start:
        """The state (d,) at q with direction β."""
        return model.state_at(self.body, (self.Q1, self.Q2), self.beta)

    @property
    def half_width(self) -> float:
        """Half width of the plane of q."""
        return round_up(1.05 * max(self.body.axes))

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels per unit of each variable."""
        return self.body.pixels_per_unit(self.half_width)

    # ---- the parts ----------------------------------------------------------------------------------------------

    section = part(
        lambda s: Section(
            s,
            max_steps=40_000,
            default_window=s.section_window,
        )
    )
    branch = part(lambda s: SectionBranch(s, s.periodic_orbit, _ALONG, ("I22",)))

    # ---- the pictures -------------------------------------------------------------------------------------------

    def section_window(self) -> Window:
        """Return the window of the section, with room for all q and p."""
        (q0, q1), (p0, p1) = symmetric_range(round_up(1.05 * self.body.major_semi_axis)), _P_AXIS
        return (q0, p0), (q1, p1)

    @cached_property
    def momentum(self) -> Array:
        """q1p2 − q2p1 along the orbit (n,)."""
        return model.angular_momentum(self.body, self.orbit.path.states)

    def start_point(self) -> tuple[float, float]:
        """Return the q at which the orbit starts."""
        if self.closed_orbit is None:
            return self.Q1, self.Q2
        (q,), _ = self.body.to_plane(np.array([self.start]))
        return float(q[0]), float(q[1])

    def forbidden(self, axes: Axes) -> list[list[Array]]:
        """Return the forbidden region of the section; empty if the section is omitted."""
        reach = 4.0 * max(axes.x[1], self.body.major_semi_axis)
        return (
            []
            if self.section.known_orbits.reason
            else section_plane.exterior(self.body.section_boundaries(), reach, 4.0)
        )

    def start_at(self, x: float, y: float) -> Values:
        """Return the start and direction at a point of the section; empty if no motion crosses it there."""
        try:
            return dict(zip(("Q1", "Q2", "beta"), model.start_on_section(self.body, x, y), strict=True))
        except ModelError:
            return {}

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_domain(self) -> Caption:
        first, second = map(digits, self.body.axes)
        if self.body.hole == 0.0:
            return Caption("Motion in a region without a hole.", f"Semi-axes {first} and {second}.")
        hole = f"hole (grey) {digits(self.body.hole)} times as large"
        return Caption("Motion in a ring.", f"Semi-axes {first} and {second}, {hole}.")

    def _about_section(self) -> Caption:
        if self.section_caption is not None:
            return self.section_caption
        if self.section.known_orbits.reason:
            return Caption(numbers=self.section.known_orbits.reason)
        visited = occupied_cells(self.section.chosen_points, self.poincare.window, _CELLS)
        counted = self.density.phrase or f"{len(self.section.chosen_points)} points of the "
        return Caption(numbers=f"{counted}orbit in {visited} of {_CELLS * _CELLS} cells.")

    def _about_sphere(self) -> Caption:
        return Caption(
            "The motion of the body.", f"γ = (p₁, p₂, γ₃), γ₃ {variation_text(self.orbit.path.states[:, 4])}."
        )

    def quantities(self) -> Iterator[str]:
        """Yield the moment of inertia, the energy, the start and the error of H = ½."""
        yield f"I₁₁ = {digits(self.body.I11)}"
        yield from super().quantities()
        yield f"h/|b₃| = {digits(self.h / abs(self.b3))}"
        yield f"Start: γ₃ = {digits(self.start[4])}"
        yield f"ω(0) = {vector(self.start[:2])}"
        if self.orbit.has_result("path"):
            yield f"H = ½ within {digits(model.level_error(self.body, self.orbit.path.states), 1)}"
        yield "Integrable" if self.body.integrable else "Not integrable"
        yield "div v = 0: the standard measure"


SCENE = Scene(
    Quartic,
    __file__,
    place=7,
    presets=PRESETS,
    level_trials=section_trials(),
    charts=Charts(motion_charts(SYSTEM, lambda s: s.chosen_start), over=("h", "beta")),
    group="Heavy body",
    essential=("ratio", "h", "Q1", "Q2"),
    answers=(Answer("Each dot is one return: dots on a curve look regular, a cloud of dots looks chaotic."),),
    lead=("section",),
    title="Principal axis, b₁ = b₂ = 0",
    summary="The body as a point in a quartic potential: integrable for I₁₁ = I₂₂, else curves and seas in a section.",
    swarm=turned_swarm(lambda s, states: dict(zip(("q1", "q2"), s.body.to_plane(states)[0].T, strict=True))),
    tracks={
        "orbit": lambda s: plane_domain.plane_columns(
            s.orbit.path, s.body.to_plane(s.orbit.path.states)[0], momentum=s.momentum
        )
    },
    views=(
        body_picture(),
        plane_domain.picture(
            "Point in the potential γ₃²/2",
            Quartic._about_domain,
            lambda s: s.half_width,
            names=("Q1", "Q2"),
            layers=(
                *plane_domain.background_layers(
                    lambda s: s.body.ellipse(), lambda s: s.body.holes(), lambda s: s.body.equipotentials(_HEIGHTS)
                ),
                *plane_domain.orbit(Quartic.start_point, label="start"),
            ),
        ),
        section_picture(
            title=lambda s: "Section {} = 0 (upward crossings)".format("q₂" if s.body.minor_axis else "q₁"),
            caption=Quartic._about_section,
            axes=_NAMES,
            y=_P_AXIS,
            layers=section_layers(forbidden=Quartic.forbidden),
        ),
        Sphere(
            caption=Quartic._about_sphere,
            looks={"orbit": "orbit"},
            axis=lambda s: centre_of_mass((0.0, 0.0, s.b3)),
            circles=lambda s: [*parallels((0.0, 0.0, 1.0), [s.body.E / s.body.b3]), *s.proof.circles],
        ),
        plane_domain.momentum_picture(
            lambda s: (s.orbit.path.times, s.momentum),
            least=lambda s: 1e-3 * max(s.body.axes),
            is_integral=lambda s: s.body.integrable,
        ),
        branch_picture(),
    ),
)
