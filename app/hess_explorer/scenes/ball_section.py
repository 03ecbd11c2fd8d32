"""The Chaplygin ball with a field: the section γ3 = 0 at one energy, and one orbit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.parameters import choice, number
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sections import Crossings, Start, joined
from hess_explorer.views import scattering_map as square
from hess_explorer.views import section_plane
from hess_explorer.views.layers import Axes, Columns
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import Sphere, centre_of_mass
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import nice_above, orbit_alone, velocity_columns
from hess_mechanics.chaplygin_ball.energy_surface import lowest_energy
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.section import ball_section, coordinates, forbidden_band, seeds, state_at
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.section import Points, occupied_cells
from hess_mechanics.dynamics.system import System
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, STANDARD
from hess_mechanics.numerics.results import Array

_ORBITS = 20
_CELLS = 32
_MOST_STEPS = 15_000
_ABOVE = 1e-3

_PLAIN = {"I13": 0.0, "I23": 0.0}
PRESETS = (
    Preset("Mixed: curves and a sea, I₁₃ = I₂₃ = 0"),
    Preset("Regular: I₁₁ = I₂₂, b ∥ e₃", **_PLAIN, I11=1.0, I22=1.0, D=3.0, b1=0.0, b3=1.0, h=1.5),
    Preset("Every orbit closes: b₃ = 0", **_PLAIN, I11=1.0, I22=2.0, D=1.0, b1=1.0, b2=0.5, b3=0.0, h=2.618, psi=2.0),
    Preset("A sea nearly everywhere", **_PLAIN, I11=1.0, I22=4.0, D=2.0, b1=0.3, b3=1.0, h=0.8),
    Preset("Strange attractor, I₁₃ ≠ 0", I11=1.5, I22=3.0, I13=-0.3, I23=0.0, D=1.0, b1=1.0, b2=-0.7, b3=0.7, h=2.72,
           psi=2.5, count=600.0, drop="the later half"),
    Preset("A wider one, I₁₃I₂₃ ≠ 0", I11=1.5, I22=3.0, I13=-0.1, I23=0.4, D=4.0, b1=-0.8, b2=-0.3, b3=-0.7, h=1.0,
           psi=0.4, count=600.0, drop="the later half"),
)


@dataclass(frozen=True)
class BallSection(Crossings):
    """The orbit from one place of the section, among others of its energy."""

    I11: float = number("I₁₁", 1.0, (0.2, 5.0), 0.01, bounds=(1e-2, 1e2), label="Inertia I₁₁",
                        doc="Moment of inertia about the first body axis.")
    I22: float = number("I₂₂", 3.0, (0.2, 5.0), 0.01, bounds=(1e-2, 1e2), label="Inertia I₂₂",
                        doc="Moment of inertia about the second body axis.")
    I13: float = number("I₁₃", 0.0, (-1.0, 1.0), 0.01, bounds=(-20.0, 20.0), label="Inertia I₁₃",
                        doc="Product of inertia; with I₁₃ = I₂₃ = 0 the flow keeps volume.")
    I23: float = number("I₂₃", 0.0, (-1.0, 1.0), 0.01, bounds=(-20.0, 20.0), label="Inertia I₂₃",
                        doc="Product of inertia.")
    D: float = number("𝒟", 5.0, (0.0, 10.0), 0.05, bounds=(0.0, 1e2), label="Ball inside, 𝒟",
                      doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside.")
    b1: float = number("b₁", 0.5, (-1.0, 1.0), 0.01, bounds=(-1e2, 1e2), label="Centre of mass b₁",
                       doc="b = −mg r, r the centre of mass.")
    b2: float = number("b₂", 0.0, (-1.0, 1.0), 0.01, bounds=(-1e2, 1e2), label="Centre of mass b₂", doc="b = −mg r.")
    b3: float = number("b₃", 0.8, (-1.0, 1.0), 0.01, bounds=(-1e2, 1e2), label="Centre of mass b₃",
                       doc="b = −mg r; b₃ = 0: every orbit closes.")
    h: float = number("h", 2.0, (0.05, 5.0), 0.01, bounds=(1e-3, 1e3), label="Energy above the plane's lowest",
                      doc="E = h − √(b₁²+b₂²): every h > 0 has motions through γ₃ = 0.")
    psi: float = number("ψ", 1.0, (-3.14, 3.14), 0.01, bounds=(-math.pi, math.pi), label="Start: ψ, direction of γ",
                        doc="On the section γ = (cos ψ, sin ψ, 0). A click in the section chooses ψ and δ.")
    delta: float = number("δ", 1.5, (0.01, 3.13), 0.01, bounds=(1e-6, math.pi - 1e-6), label="Start: δ, from γ to ω",
                          doc="On the section ω points at the angle δ from γ.")
    count: float = number("n", 200.0, (50.0, 600.0), 10.0, bounds=(1.0, 1e3), label="Crossings of each orbit",
                          doc="Points for each orbit.")
    span: float = number("t", 40.0, (1.0, 200.0), 1.0, bounds=(0.01, 1e4), label="Time span",
                         doc="How long the chosen orbit is followed.")
    drop: str = choice("Points shown", ("all", "the later half"), "all", doc="The later half shows what attracts.")
    accuracy: str = choice(
        "Accuracy", tuple(LEVELS), "standard",
        doc="Of the orbit. Points of the section are right on their integrals; chaos moves them along.")

    system: ClassVar[System] = SYSTEM

    def admitted(self, notes: list[str]) -> BallSection:
        """ψ outside the band that the energy forbids."""
        if self.band is None:
            return self
        middle, half = self.band
        away = math.remainder(self.psi - middle, 2.0 * math.pi)
        if abs(away) >= half + _ABOVE:
            return self
        psi = math.remainder(middle + math.copysign(min(half + 2.0 * _ABOVE, math.pi), away), 2.0 * math.pi)
        state = replace(self, psi=max(-math.pi, min(math.pi, psi)))
        notes.append(f"With this energy γ cannot point at ψ = {digits(self.psi)} on the plane: "
                     f"ψ is {digits(state.psi)} now.")
        return state

    @cached_property
    def body(self) -> BallBody:
        """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D, self.b1, self.b2, self.b3)

    @property
    def E(self) -> float:
        """The energy."""
        return self.h - math.hypot(self.b1, self.b2)

    @cached_property
    def band(self) -> tuple[float, float] | None:
        """The middle and half width of the band of ψ that the energy forbids; None where it forbids nothing."""
        return forbidden_band(self.body, self.E)

    @cached_property
    def start(self) -> Start:
        """The state at (ψ, δ) of the section."""
        return state_at(self.body, self.E, self.psi, self.delta)

    @cached_property
    def weights(self) -> tuple[float, ...]:
        """From the variables to the pictures, as large as the orbit will be drawn."""
        return self.work.get(_weights, self.body, self.start, self.span)

    def crossing(self, crossings: int) -> tuple[Task, Task]:
        """What finds so many crossings of the orbit on show, and of the others."""
        return (Task(_own, (self.body, self.E, self.start, crossings)), Task(_others, (self.body, self.E, crossings)))

    def places_of(self, points: Points) -> Array:
        """(ψ, δ) of all these points, or of the later half of them."""
        longest = max(map(len, points.states), default=0)
        first = longest // 2 if self.drop != "all" else 0
        return joined(coordinates(states[first:]) for states in points.states)

    def track(self) -> Columns:
        """The orbit on show."""
        states = self.orbit.states
        return velocity_columns(self.orbit.times, states[:, :2], states[:, 2:])

    def forbidden(self, axes: Axes) -> list[list[Array]]:
        """The band of ψ that the energy forbids, over the whole height, also where it goes round."""
        if self.band is None or self.own is None:
            return []
        (middle, half), (low, high) = self.band, axes.y
        band = np.array([[-half, low], [half, low], [half, high], [-half, high]])
        return [[band + np.array([middle + turn, 0.0])] for turn in (-2.0 * math.pi, 0.0, 2.0 * math.pi)]

    def returns(self) -> Array | None:
        """ψ and the next ψ: which returns belong together only the chosen orbit tells."""
        return None if self.own is None else np.column_stack([self.own[:-1, 0], self.own[1:, 0]])

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_section(self) -> str:
        if self.own is None:
            return "Left out: it would take too many steps."
        volume = "the flow keeps volume" if self.I13 == self.I23 == 0.0 else "volume is not kept"
        visited = occupied_cells(self.own, _CELLS)
        return f"The chosen orbit: {len(self.own)} points in {visited} of {_CELLS**2} cells; {volume}."

    def _about_returns(self) -> str:
        return ("Left out: it would take too many steps." if self.own is None else
                "ψ and the next ψ: a point if closed, a curve if regular, a cloud in chaos.")

    def _about_sphere(self) -> str:
        field = "; r: the centre of mass." if any(self.body.parameters[5:]) else "; no field, b = 0."
        return f"The vertical γ along the chosen orbit{field}"

    def derived(self) -> Iterator[str]:
        """Energies, and where the orbit starts."""
        w1, w2, *gamma = self.start
        yield f"E = {digits(self.E, 6)}"
        yield f"lowest energy −|b| = {digits(lowest_energy(self.body), 6)}"
        yield f"ω(0) = ({digits(w1)}, {digits(w2)})"
        yield f"γ(0) = ({', '.join(map(digits, gamma))})"


def _half_width(omega: Array) -> float:
    """Room for these ω (n, 2)."""
    return nice_above(1.05 * max(1e-9, float(np.hypot(*omega.T).max())))


def _weights(body: BallBody, start: Start, span: float) -> tuple[float, ...]:
    coarse = solve(SYSTEM, start, body.parameters, np.linspace(0.0, span, 129), DRAFT)
    radius = 0.5 * PIXELS
    w = radius / _half_width(coarse.states[:, :2])
    return (w, w, radius, radius, radius)


def _others(body: BallBody, E: float, crossings: int) -> Points:
    return ball_section(body, E, seeds(body, E, _ORBITS), crossings, STANDARD, _MOST_STEPS)


def _own(body: BallBody, E: float, start: Start, crossings: int) -> Points:
    return ball_section(body, E, [start], crossings, STANDARD, _MOST_STEPS)


SCENE = Scene(
    BallSection, __file__, place=10, presets=PRESETS,
    title="Ball with a field",
    summary="The ball in a field: a section at one energy shows curves, seas and, with I₁₃ or I₂₃, attractors.",
    tracks={"orbit": BallSection.track},
    views=(
        Plot(name="section", title="Section: γ₃ grows through 0", caption=BallSection._about_section,
             axes=("ψ", "δ"), x=square.AZIMUTH, y=square.POLAR, ticks=square.AZIMUTH_TICKS,
             y_ticks=square.POLAR_TICKS, message=lambda s: s.reason,
             on_click=lambda s, x, y: {"psi": x, "delta": y},
             layers=section_plane.layers(
                 lambda s: s.own, others=lambda s: s.others, forbidden=BallSection.forbidden,
                 start=lambda s: [] if s.own is None else [(s.psi, s.delta)])),
        Plot(name="returns", title="First return", caption=BallSection._about_returns,
             axes=("ψ", "ψ at the next crossing"), x=square.AZIMUTH, y=square.AZIMUTH, ticks=square.AZIMUTH_TICKS,
             message=lambda s: s.reason, layers=section_plane.layers(BallSection.returns)),
        orbit_alone(lambda s: _half_width(s.orbit.states[:, :2]), energy=lambda s: s.E, label="chosen orbit"),
        Sphere(caption=BallSection._about_sphere, looks={"orbit": "orbit"},
               axis=lambda s: centre_of_mass((s.b1, s.b2, s.b3))),
    ),
)
