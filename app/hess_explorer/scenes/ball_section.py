"""The Chaplygin ball with a field: the section γ3 = 0 at one energy, and one orbit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework import ball_parameters as ball
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, motion_charts, parameters_of
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import choice, number, parameter
from hess_explorer.scenes.framework.solid_body import body_picture
from hess_explorer.scenes.framework.swarm import turned_swarm
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
from hess_explorer.views.graphs.graph import ANGLE, ANGLE_TICKS
from hess_explorer.views.layers import Axes
from hess_explorer.views.maps import scattering_map as square
from hess_explorer.views.plane import section_plane
from hess_explorer.views.plane.velocity_plane import half_width_for, orbit, orbit_alone, orbit_columns, pixels_per_unit
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Direction, centre_of_mass, orbit_sphere
from hess_explorer.views.text import digits, vector
from hess_mechanics.chaplygin_ball import ball_section as mechanics
from hess_mechanics.chaplygin_ball.ball_section import largest_speed, nearest_possible_psi
from hess_mechanics.chaplygin_ball.energy_surface import lowest_energy
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import area_integral, has_area_integral, is_reversible
from hess_mechanics.dynamics.cells import occupied_cells
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import H_BALL

_CELLS = 32
_MOST_STEPS = 15_000
_NAMES = ("ψ", "δ")

_DOUBLES = parameters_of(BallBody(1.5, 3.0, -0.3, 0.0, 1.0, 1.0, -0.7, 0.7))
_WIDER = parameters_of(BallBody(1.5, 3.0, -0.1, 0.4, 4.0, -0.8, -0.3, -0.7))
_LATE = "the later half"
PRESETS = (
    Preset("Mixed: curves and a sea, I₁₃ = I₂₃ = 0", **PLAIN),
    Preset("Regular: I₁₁ = I₂₂, b ∥ e₃", I11=1.0, I22=1.0, D=3.0, b1=0.0, b3=1.0, h=1.5),
    Preset("Returning orbits close: b₃ = 0", I11=1.0, I22=2.0, D=1.0, b1=1.0, b2=0.5, b3=0.0, h=2.618, psi=0.5),
    Preset("A sea nearly everywhere", I11=1.0, I22=4.0, D=2.0, b1=0.3, b3=1.0, h=0.8),
    Preset("Strange attractor, I₁₃ ≠ 0", **_DOUBLES, h=2.72, psi=2.5, count=600.0, drop=_LATE),
    Preset("A wider strange attractor, I₁₃I₂₃ ≠ 0", **_WIDER, h=1.0, psi=0.4, count=600.0, drop=_LATE),
    Preset(
        "Period doubling along a branch, over I₁₃",
        **_DOUBLES,
        h=2.72,
        psi=-2.7834,
        delta=1.0275,
        reach=2.0,
        drop=_LATE,
        periodic="period 1",
        over="I₁₃",
        low=-0.55,
        high=-0.05,
    ),
)


@dataclass(frozen=True)
class BallSectionState(SectionState):
    """One orbit, chosen in the section, among others of the same energy."""

    I11: float = parameter(ball.I11)
    I22: float = parameter(ball.I22)
    I13: float = parameter(ball.I13)
    I23: float = parameter(ball.I23)
    D: float = parameter(ball.D)
    b1: float = parameter(ball.B1)
    b2: float = parameter(ball.B2)
    b3: float = parameter(ball.B3)
    h: float = parameter(H_BALL)
    psi: float = number(
        "ψ",
        1.0,
        (-3.14, 3.14),
        0.01,
        bounds=(-math.pi, math.pi),
        label="Start: ψ, direction of γ",
        doc="On the section γ = (cos ψ, sin ψ, 0). Click the section to set ψ and δ.",
    )
    delta: float = number(
        "δ",
        1.5,
        (0.01, 3.13),
        0.01,
        bounds=(1e-6, math.pi - 1e-6),
        label="Start: δ, from γ to ω",
        doc="On the section ω points at the angle δ from γ.",
    )
    over: str = parameter_of_branch(tuple(ball.PARAMETERS))
    low: float = end_of_branch("from")
    high: float = end_of_branch("to")
    upwards: str = coordinate_of_branch(_NAMES)
    drop: str = choice(
        "Points shown",
        ("all", _LATE),
        "all",
        doc="The later half omits the transient: it shows the attractor, or backward in time the repeller.",
    )

    # ---- the motion ---------------------------------------------------------------------------------------------

    @cached_property
    def body(self) -> BallBody:
        """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D, self.b1, self.b2, self.b3)

    @property
    def E(self) -> float:
        """The energy."""
        return self.h - math.hypot(self.b1, self.b2)

    def valid_state(self, notes: list[str]) -> BallSectionState:
        """Return the state with ψ moved out of the forbidden band; append a note."""
        psi = self.psi if self.band is None else nearest_possible_psi(self.band, self.psi)
        if psi != self.psi:
            notes.append(
                f"With this energy no motion crosses the section at ψ = {digits(self.psi)}: ψ was set to {digits(psi)}."
            )
        return self.with_values({"psi": psi})

    @cached_property
    def band(self) -> tuple[float, float] | None:
        """The centre and half width of the forbidden band of ψ; None if every ψ is possible."""
        return self.poincare.forbidden

    @cached_property
    def poincare(self) -> mechanics.BallSection:
        """The section γ3 = 0 in (ψ, δ)."""
        return mechanics.BallSection(self.body, self.E)

    @cached_property
    def chosen_start(self) -> tuple[float, ...]:
        """The state (5,) at (ψ, δ) of the section."""
        return self.poincare.state_at(self.psi, self.delta)

    @cached_property
    def weights(self) -> tuple[float, ...]:
        """Pixels per unit of each variable, fitted to the orbit."""
        return pixels_per_unit(
            half_width_for(self.work.need(Task(largest_speed, self.body, self.start, self.duration)))
        )

    # ---- the parts ----------------------------------------------------------------------------------------------

    section = part(
        lambda s: Section(
            s,
            max_steps=_MOST_STEPS,
            second_half_only=s.drop == _LATE,
        )
    )
    branch = part(lambda s: SectionBranch(s, s.periodic_orbit, ball.PARAMETERS))

    # ---- the pictures -------------------------------------------------------------------------------------------

    @property
    def r(self) -> Direction | None:
        """The direction of the centre of mass; None without a field."""
        return centre_of_mass((self.b1, self.b2, self.b3))

    def start_at(self, x: float, y: float) -> Values:
        """Return the parameter values of an orbit that starts at (ψ, δ)."""
        return {"psi": x, "delta": y}

    def half_width(self) -> float:
        """Return half the width of the (ω1, ω2)-plane."""
        return half_width_for(float(np.hypot(*self.orbit.path.states[:, :2].T).max()))

    def forbidden(self, axes: Axes) -> list[list[Array]]:
        """Return the forbidden band of ψ as rectangles; empty if every ψ is possible or the section is omitted."""
        if self.band is None or self.section.known_orbits.reason:
            return []
        return section_plane.band(*self.band, 2.0 * math.pi, axes)

    def returns(self) -> Array | None:
        """Return pairs (ψ, next ψ) of consecutive crossings of the periodic orbit, or else of the chosen one, (n, 2).

        None if the section is omitted and there is no periodic orbit.
        """
        closed = self.closed_orbit
        if closed is not None:
            psi = closed.orbit.points[:, 0]
            return np.column_stack([psi, np.roll(psi, -1)])
        psi = self.section.chosen_points[:, 0]
        return None if self.section.known_orbits.reason else np.column_stack([psi[:-1], psi[1:]])

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_section(self) -> Caption:
        if self.section_caption is not None:
            return self.section_caption
        if self.section.known_orbits.reason:
            return Caption("Omitted: too many steps.")
        volume = "The flow preserves volume." if self.I13 == self.I23 == 0.0 else "The flow does not preserve volume."
        visited = occupied_cells(self.section.chosen_points, self.poincare.window, _CELLS)
        counted = self.density.phrase or f"{len(self.section.chosen_points)} points of the "
        return Caption(volume, f"{counted}orbit in {visited} of {_CELLS**2} cells.")

    def _about_returns(self) -> Caption:
        if self.section.known_orbits.reason:
            return Caption("Omitted: too many steps.")
        if is_reversible(self.body):
            return Caption(
                "A single point: every returning orbit is periodic.", "Proved by the symmetry γ₃ → −γ₃, t → −t."
            )
        if self.closed_orbit is not None:
            return Caption("ψ of each crossing against the next ψ.", f"Period {self.closed_orbit.orbit.period}.")
        if has_area_integral(self.body):
            return Caption("A curve, because of an additional integral.", "ω₁γ₁ + ω₂γ₂ is constant.")
        return Caption("ψ of each crossing against the next ψ.")

    def quantities(self) -> Iterator[str]:
        """Yield the energies and the start of the orbit."""
        yield f"E = {digits(self.E)}"
        yield from super().quantities()
        yield f"lowest energy −|b| = {digits(lowest_energy(self.body))}"
        yield f"ω(0) = {vector(self.start[:2])}"
        yield f"γ(0) = {vector(self.start[2:])}"
        if has_area_integral(self.body):
            yield f"ω₁γ₁ + ω₂γ₂ = {digits(float(area_integral(np.array(self.start))))}, an integral"


SCENE = Scene(
    BallSectionState,
    __file__,
    place=10,
    presets=PRESETS,
    level_trials=section_trials(),
    charts=Charts(motion_charts(SYSTEM, lambda s: s.chosen_start), over=("psi", "delta")),
    group="Ball",
    essential=("h", "I13", "D", "psi"),
    handle="psi",
    answers=(
        Answer("A symmetry makes every returning orbit periodic.", lambda s: is_reversible(s.body)),
        Answer("Each dot is one return: dots on a curve look regular, a cloud of dots looks chaotic."),
    ),
    lead=("section",),
    title="Ball with a field",
    summary="The ball in a field: a section at one energy shows curves, seas and, with I₁₃ or I₂₃, attractors.",
    swarm=turned_swarm(),
    tracks={"orbit": lambda s: orbit_columns(s.orbit.path)},
    views=(
        body_picture(ball=True),
        section_picture(
            title="Section γ₃ = 0 (upward crossings)",
            caption=BallSectionState._about_section,
            axes=_NAMES,
            x=ANGLE,
            y=square.POLAR,
            ticks=ANGLE_TICKS,
            y_ticks=square.POLAR_TICKS,
            layers=section_layers(
                forbidden=BallSectionState.forbidden,
                start=lambda s: [(s.psi, s.delta)] if s.section.known_orbits.chosen_batches else [],
            ),
        ),
        orbit_alone(
            BallSectionState.half_width, lambda s: s.E, lambda s: s.proof.band, orbits=(orbit("chosen orbit"),)
        ),
        orbit_sphere(lambda s: s.r, lambda s: s.proof.circles),
        Plot(
            name="returns",
            title="First return",
            button="Show the first return",
            caption=BallSectionState._about_returns,
            axes=("ψ", "ψ at the next crossing"),
            x=ANGLE,
            y=ANGLE,
            ticks=ANGLE_TICKS,
            message=lambda s: s.section.known_orbits.reason,
            layers=section_plane.layers(BallSectionState.returns),
        ),
        branch_picture(),
    ),
)
