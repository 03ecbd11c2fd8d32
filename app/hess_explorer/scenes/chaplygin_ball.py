"""The Chaplygin ball with Suslov's constraint and no field: the strip, Nˢ and Nᵘ, scattering."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.parameters import accuracy_level, number
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import scattering_map as square
from hess_explorer.views import theme
from hess_explorer.views import velocity_plane as plane
from hess_explorer.views.layers import Columns, arrows, curves, levels, line, region, ring
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import Circle, Direction, Sphere, ends
from hess_explorer.views.text import digits as in_digits
from hess_mechanics.chaplygin_ball import scattering as model
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.strip_orbits import StripOrbit, strip_orbits
from hess_mechanics.dynamics.sampling import PIXELS, sampled_orbit
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, STANDARD, Level
from hess_mechanics.numerics.results import Array, Orbit

_ORBITS, _FEW_ORBITS = 18, 8
_PHASES, _FEW_PHASES = 65, 33
"""Few: while a slider is dragged, and until the others are known."""
_MOST_STEPS = 1.2e6
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)

PRESETS = (
    Preset("Projections of trajectories, 𝒟 = 10, h = 10 (figure)"),
    Preset("𝒟 = 0: the free Suslov problem", D=0.0, span=15.0),
    Preset("𝒟 = 0.5, close to it", D=0.5, span=15.0),
    Preset("𝒟 = 2, I₁₃ = 0, k = 1: no longer flat", I11=1.64, I22=1.0, I13=0.0, I23=0.8, D=2.0, theta=1.0, span=30.0),
    Preset("𝒟 = 0, I₁₃ = 0, k = 1: complete reversal", I11=1.64, I22=1.0, I13=0.0, I23=0.8, D=0.0, theta=1.0,
           span=15.0),
)


@dataclass(frozen=True)
class ChaplyginBall(State):
    """The chosen orbit, many over the strip, and the map of the phases."""

    I11: float = number("I₁₁", 1.0, (0.2, 5.0), 0.01, bounds=(1e-3, 1e3), label="Inertia I₁₁",
                        doc="Moment of inertia about the first body axis.")
    I22: float = number("I₂₂", 1.5, (0.2, 5.0), 0.01, bounds=(1e-3, 1e3), label="Inertia I₂₂",
                        doc="Moment of inertia about the second body axis.")
    I13: float = number("I₁₃", 0.7, (-2.0, 2.0), 0.01, bounds=(-1e3, 1e3), label="Inertia I₁₃",
                        doc="Product of inertia; with I₂₃ it sets the line I₁₃ω₁ + I₂₃ω₂ = 0.")
    I23: float = number("I₂₃", 1.2, (-2.0, 2.0), 0.01, bounds=(-1e3, 1e3), label="Inertia I₂₃",
                        doc="Product of inertia; not 0 together with I₁₃.")
    D: float = number("𝒟", 10.0, (0.0, 20.0), 0.05, bounds=(0.0, 300.0), label="Ball inside, 𝒟",
                      doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside; 0 is the free Suslov problem.")
    h: float = number("h", 10.0, (0.1, 20.0), 0.1, bounds=(1e-6, 1e6), label="Energy h",
                      doc="E = h > 0: every such energy is possible. It sets the size of the strip and the unit of "
                          "time.")
    theta: float = number("θ⁻", 1.2, (0.0, 3.14), 0.01, bounds=(0.0, math.pi), label="Angle θ⁻ of the circle left",
                          doc="The angle between ξ and γ at the start of the chosen orbit.")
    phi: float = number("φ", 0.5, (-3.14, 3.14), 0.01, bounds=(-math.pi, math.pi), label="Phase φ of the chosen orbit",
                        doc="Where on that circle γ starts, in radians.")
    digits: float = number("−lg δ", 4.0, (2.0, 8.0), 0.05, bounds=(2.0, 10.0), label="Distance δ of the start, digits",
                           doc="The chosen orbit starts δ = 10^−digits of |ω| away from Nᵘ.")
    span: float = number("t", 60.0, (1.0, 400.0), 1.0, bounds=(0.01, 1e4), label="Time span",
                         doc="How long the chosen orbit is followed.")
    accuracy: str = accuracy_level()

    @cached_property
    def body(self) -> BallBody:
        """Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D)

    @cached_property
    def strip(self) -> Strip:
        """Where ω may be."""
        return Strip(self.body, self.h)

    @cached_property
    def xi(self) -> Array:
        """ξ (3,).  Raises `InvalidParameter`."""
        return np.append(line_of_rest(self.body)[0], 0.0)

    @property
    def distance(self) -> float:
        """δ."""
        return float(10.0**-self.digits)

    @cached_property
    def half_width(self) -> float:
        """Of the frame of the (ω1, ω2)-plane: room for σ1."""
        return plane.nice_above(1.1 * math.sqrt(2.0 * self.h / min(self.I11, self.I22)))

    def motion(self) -> Motion:
        """The chosen orbit."""
        radius = 0.5 * PIXELS
        w = radius / self.half_width
        start = model.start(self.body, self.h, self.theta, self.phi, self.distance)
        return Motion(SYSTEM, start, self.body.parameters, self.span, (w, w, radius, radius, radius))

    @cached_property
    def orbit(self) -> Orbit:
        """The chosen orbit."""
        one = self.motion()
        return self.work.get(sampled_orbit, SYSTEM, one.state, one.parameters, one.span, one.weights, self.level)

    @cached_property
    def Gamma(self) -> Array:
        """(ξ, γ) along it."""
        return self.orbit.states[:, 2:] @ self.xi

    @cached_property
    def crowd(self) -> tuple[StripOrbit, ...]:
        """Orbits over the strip."""
        found: tuple[StripOrbit, ...] = self.work.sooner(
            Task(strip_orbits, (self.body, _ORBITS)), Task(strip_orbits, (self.body, _FEW_ORBITS)))
        return tuple((math.sqrt(self.h) * track, place) for track, place in found)

    @cached_property
    def map_or_reason(self) -> tuple[model.BallScattering | None, str]:
        """θ⁺ over the phases; None where it would take too long, and why."""
        def phases(count: int, level: Level) -> Task:
            phis = tuple(np.linspace(-math.pi, math.pi, count).tolist())
            return Task(model.ball_scattering,
                        (self.body, self.theta, phis, 1.0, self.distance, level, _MOST_STEPS))

        try:
            level = min(self.level, STANDARD, key=lambda one: one.order)
            return self.work.sooner(phases(_PHASES, level), phases(_FEW_PHASES, DRAFT)), ""
        except WorkLimit as error:
            return None, f"The map of the phases is left out: {error}"

    @property
    def map(self) -> model.BallScattering | None:
        """θ⁺ over the phases."""
        return self.map_or_reason[0]

    # ---- what the pictures show --------------------------------------------------------------------------------

    def free(self) -> list[Array]:
        """θ⁺ for 𝒟 = 0 over the phases."""
        if self.map is None:
            return []
        phis = self.map.phis
        return [np.column_stack([phis, self.work.get(
            model.free_theta_plus, self.body, self.theta, self.distance, tuple(phis.tolist()))])]

    def chosen(self) -> list[tuple[float, float]]:
        """The chosen orbit on the curve."""
        return [] if self.map is None else [
            (self.phi, float(np.interp(self.phi, self.map.phis, self.map.theta_plus)))]

    def orbit_columns(self) -> Columns:
        """The chosen orbit."""
        return plane.velocity_columns(self.orbit.times, self.orbit.states[:, :2], self.orbit.states[:, 2:],
                                      Gamma=self.Gamma)

    def circles(self) -> list[Circle]:
        """The circle that is left and the one that is joined."""
        return [Circle(self.xi, math.cos(self.theta), "unstable"),
                Circle(self.xi, float(np.clip(self.Gamma[-1], -1.0, 1.0)), "stable")]

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_sphere(self) -> str:
        return (f"From Γ = {in_digits(math.cos(self.theta))} (the circle left) to Γ = {in_digits(self.Gamma[-1])} "
                "at the end.")

    def _about_curve(self) -> str:
        if self.map is None:
            return "Left out: it would take too many steps."
        return f"θ⁻ = {in_digits(self.theta)}: {square.spread(self.map.theta_plus)}; dashed: 𝒟 = 0."

    def _about_Gamma(self) -> str:
        return f"From {in_digits(math.cos(self.theta))} to {in_digits(self.Gamma[-1])}."

    def derived(self) -> Iterator[str]:
        """The strip, its line, the start."""
        outer_ends, inner_ends = (ellipse([0.0, math.pi / 2]) for ellipse in (self.strip.sigma1, self.strip.sigma2))
        inner, outer = (float(np.hypot(*end)) for end in self.strip.unstable)
        yield f"σ₁: |ω₁| ≤ {in_digits(outer_ends[0, 0])}, |ω₂| ≤ {in_digits(outer_ends[1, 1])}"
        yield (f"σ₂: |ω₁| ≥ {in_digits(inner_ends[0, 0])} at ω₂ = 0, |ω₂| ≥ {in_digits(inner_ends[1, 1])} at "
               "ω₁ = 0")
        yield f"|ω| on Nˢ and Nᵘ from {in_digits(inner)} to {in_digits(outer)}"
        yield f"ξ = ({in_digits(self.xi[0])}, {in_digits(self.xi[1])}, 0)"
        yield f"δ = {in_digits(self.distance, 3)}"

    def status(self) -> Iterator[str]:
        """The chosen orbit and the map."""
        if self.known("orbit"):
            yield from orbit_status(self.orbit)
        if self.known("map_or_reason") and self.map is not None:
            yield f"{self.map.phis.size} phases, error ≤ {float(self.map.errors.max()):.1e}"

    def notes(self) -> Iterator[str]:
        """Why there is no map."""
        if self.known("map_or_reason") and self.map_or_reason[1]:
            yield self.map_or_reason[1]


SCENE = Scene(
    ChaplyginBall, __file__, place=9, presets=PRESETS,
    title="Chaplygin ball",
    summary="A ball rolls inside the body: every orbit crosses a strip between two ellipses, from Nᵘ to Nˢ.",
    tracks={"orbit": ChaplyginBall.orbit_columns},
    views=(
        Plot(
            name="omega", title="Angular velocity (ω₁, ω₂)", axes=("ω₁", "ω₂"), dot=("omega1", "omega2"),
            caption=lambda s: "Every orbit crosses the strip between σ₂ and σ₁ from Nᵘ to Nˢ.",
            x=lambda s: plane.centred(s.half_width), y=lambda s: plane.centred(s.half_width),
            layers=(
                region("forbidden", lambda s: plane.ring_outside(
                    s.strip.sigma2(_ANGLES), s.strip.sigma1(_ANGLES), s.half_width),
                    edge=theme.MUTED, label="impossible", moving=True),
                plane.arcs(lambda s: [track for track, _ in s.crowd if len(track) > 1]),
                *plane.halves(lambda s, _: s.strip.stable, lambda s, _: s.strip.unstable,
                              ("Nˢ, circle joined", "Nᵘ, circle left")),
                line("orbit", track="orbit", columns=("omega1", "omega2"), color=theme.ORBIT, width=2.5,
                     label="orbits; the chosen one bold"),
                # Not in the middle of each, where all of them are slow, but where the strip is covered evenly.
                arrows("arrows", lambda s: plane.arrows_at(s.crowd), color=theme.ORBIT, alpha=0.8))),
        Sphere(
            caption=ChaplyginBall._about_sphere, looks={"orbit": "orbit"}, axis=lambda s: Direction(s.xi, "ξ"),
            circles=ChaplyginBall.circles, marks=lambda s: ends(s.xi)),
        Plot(
            name="curve", title="θ⁺ against the phase φ", caption=ChaplyginBall._about_curve, axes=("φ", "θ⁺"),
            x=square.AZIMUTH, y=square.POLAR, ticks=square.AZIMUTH_TICKS, y_ticks=square.POLAR_TICKS,
            message=lambda s: s.map_or_reason[1], on_click=lambda s, x, y: {"phi": x}, on_drag=True,
            layers=(
                levels("levels", lambda s: [] if s.map is None else [s.theta, math.pi - s.theta]),
                curves("free", ChaplyginBall.free, color=theme.MAP, dash="dashed", label="θ⁺ for 𝒟 = 0"),
                curves("ball", lambda s: [] if s.map is None else [np.column_stack([s.map.phis, s.map.theta_plus])],
                       color=theme.ORBIT),
                ring("chosen", ChaplyginBall.chosen, size=18.0))),
        Plot(
            name="Gamma", title="Γ = (ξ, γ) against time", caption=ChaplyginBall._about_Gamma, axes=("t", "Γ"),
            x=lambda s: (0.0, s.span), y=(-1.05, 1.05), dot=("t", "Gamma"),
            layers=(levels("levels", lambda s: [math.cos(s.theta), s.Gamma[-1]]),
                    curves("first", lambda s: [np.column_stack([s.orbit.times, s.Gamma])], color=theme.ORBIT))),
    ),
)
