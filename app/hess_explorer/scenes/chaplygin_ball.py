"""The Chaplygin ball with Suslov's constraint and no field: the strip, Nˢ and Nᵘ, scattering."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, ChartSource, motion_charts, tensor_of
from hess_explorer.scenes.framework.circle_left import DIGITS, PHI, Gamma_picture, sphere
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import accuracy_level, parameter, show_proved_error, time_span
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, constrained_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.trial import Trial, curve_error
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.scenes.parts.orbits.proof import OrbitProof
from hess_explorer.scenes.parts.sections import BodyOrbit
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import arrows, curves, levels, names, region, ring
from hess_explorer.views.maps import scattering_map as square
from hess_explorer.views.plane import velocity_plane as plane
from hess_explorer.views.text import digits as in_digits
from hess_explorer.views.text import vector
from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball import ball_scattering as model
from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.strip_orbits import StripOrbit, largest_distance, strip_orbits
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, REFERENCE, Kind, Level
from hess_mechanics.numerics.results import Array

_ORBITS, _FEW_ORBITS = 18, 8
_PHASES, _FEW_PHASES = 65, 33
"""The smaller numbers serve while a slider is dragged and until the full result is known."""
_MOST_STEPS = 1.2e6
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)

PRESETS = (
    Preset("Projections of trajectories, 𝒟 = 10, h = 10, not a rigid body (figure 10)"),
    Preset("𝒟 = 0: the free Suslov problem (not a rigid body)", D=0.0, span=15.0),
    Preset("𝒟 = 0.5: close to the free Suslov problem (not a rigid body)", D=0.5, span=15.0),
    Preset(
        "𝒟 = 2, I₁₃ = 0, k = 1: no complete reversal", I11=1.64, I22=1.0, I13=0.0, I23=0.8, D=2.0, theta=1.0, span=30.0
    ),
    Preset(
        "𝒟 = 0, I₁₃ = 0, k = 1: complete reversal", I11=1.64, I22=1.0, I13=0.0, I23=0.8, D=0.0, theta=1.0, span=15.0
    ),
)


@dataclass(frozen=True)
class ChaplyginBall(State):
    """A chosen orbit, many orbits across the strip, and the scattering map of the phases."""

    I11: float = parameter(known.I11, 1.0)
    I22: float = parameter(known.I22)
    I13: float = parameter(known.I13, 0.7, doc="Product of inertia; with I₂₃ it sets the line I₁₃ω₁ + I₂₃ω₂ = 0.")
    I23: float = parameter(known.I23, 1.2, doc="Product of inertia; I₁₃ and I₂₃ must not both be 0.")
    D: float = parameter(known.D)
    h: float = parameter(known.H_FREE_BALL)
    theta: float = parameter(known.THETA)
    phi: float = parameter(PHI)
    digits: float = parameter(DIGITS)
    span: float = time_span(60.0, 400.0, what="the chosen orbit")
    certain: str = show_proved_error()
    accuracy: str = accuracy_level()

    @cached_property
    def body(self) -> BallBody:
        """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D)

    @cached_property
    def strip(self) -> Strip:
        """The strip of admissible ω."""
        return Strip(self.body, self.h)

    @property
    def distance(self) -> float:
        """The distance δ of ω(0) from Nᵘ, relative to |ω|."""
        return float(10.0**-self.digits)

    @cached_property
    def half_width(self) -> float:
        """Half width of the (ω1, ω2)-plane, with room for the ellipse σ1."""
        return plane.round_up(1.1 * float(self.strip.outer.max()))

    @cached_property
    def start(self) -> tuple[float, ...]:
        """The initial state of the chosen orbit."""
        return model.start(self.body, self.h, self.theta, self.phi, self.distance)

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels per unit of each variable."""
        return plane.pixels_per_unit(self.half_width)

    @property
    def duration(self) -> float:
        """The duration of the orbit."""
        return self.span

    @cached_property
    def orbit(self) -> BodyOrbit:
        """The chosen orbit."""
        return BodyOrbit(self)

    @cached_property
    def proof(self) -> OrbitProof:
        """The proved error of the orbit."""
        return OrbitProof(self.orbit, self.certain)

    def motion(self) -> Motion:
        """Return the motion of the chosen orbit."""
        return self.orbit.motion()

    @cached_property
    def solid(self) -> Solid:
        """The ball along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit.path)

    @cached_property
    def Gamma(self) -> Array:
        """(ξ, γ) along the orbit."""
        return self.orbit.path.states[:, 2:] @ self.strip.xi

    def strip_orbits(self, count: int, level: Level) -> Task[tuple[StripOrbit, ...]]:
        """Return a task that computes `count` orbits across the strip, at E = 1."""
        return Task(strip_orbits, self.body, count, level)

    def phases(self, count: int, level: Level) -> Task[model.BallScattering]:
        """Return a task that computes θ⁺ of `count` phases.  The task raises `WorkLimit`."""
        return Task(model.all_phases, self.body, self.theta, count, self.distance, level, _MOST_STEPS)

    @cached_property
    def all_orbits(self) -> tuple[StripOrbit, ...]:
        """The orbits across the strip."""
        plan = self.plan(Kind.CURVE)
        found: tuple[StripOrbit, ...] = self.work.need(
            self.strip_orbits(plan.side(_ORBITS), plan.level), preview=self.strip_orbits(_FEW_ORBITS, DRAFT)
        )
        return tuple((math.sqrt(self.h) * track, index) for track, index in found)

    @cached_property
    def map_or_reason(self) -> tuple[model.BallScattering | None, str]:
        """The scattering map θ⁺(φ) and an empty string; or None and a reason, if it takes too many steps."""
        plan = self.plan(Kind.MAP)
        whole = plan.side(_PHASES)
        try:
            return self.work.need(
                self.phases(whole, plan.level), preview=self.phases(min(whole, _FEW_PHASES), DRAFT)
            ), ""
        except WorkLimit as error:
            return None, f"The scattering map is omitted: {error}"

    @property
    def map(self) -> model.BallScattering | None:
        """The scattering map θ⁺(φ); None if it takes too many steps."""
        return self.map_or_reason[0]

    def free(self) -> list[Array]:
        """Return the curve θ⁺(φ) for 𝒟 = 0 at the phases of the map; empty without a map."""
        if self.map is None:
            return []
        phis = self.map.phis
        return [
            np.column_stack(
                [
                    phis,
                    self.work.need(
                        Task(model.free_theta_plus, self.body, self.theta, self.distance, tuple(phis.tolist()))
                    ),
                ]
            )
        ]

    def ellipse_names(self) -> list[tuple[float, float, str]]:
        """Return the labels of σ2 and σ1, in a quadrant without the line of equilibria."""
        angle = [(0.25 if self.I13 * self.I23 >= 0.0 else 0.75) * math.pi]
        places = plane.label_points(self.strip.sigma2(angle)[0], self.strip.sigma1(angle)[0], self.half_width)
        return [(float(x), float(y), name) for (x, y), name in zip(places, ("σ₂", "σ₁"), strict=True)]

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_sphere(self) -> Caption:
        left, last = in_digits(math.cos(self.theta)), in_digits(self.Gamma[-1])
        verdict = "The orbit ends on its initial circle." if left == last else "The orbit passes to another circle."
        return Caption(verdict, f"Γ = {left} at the start, Γ = {last} at the end.")

    def _about_curve(self) -> Caption:
        if self.map is None:
            return Caption("Omitted: too many steps.")
        return Caption(
            numbers=f"θ⁻ = {in_digits(self.theta)}: {square.range_text(self.map.theta_plus)}; dashed: 𝒟 = 0."
        )

    def _about_Gamma(self) -> Caption:
        first, last = math.cos(self.theta), float(self.Gamma[-1])
        shown = in_digits(first), in_digits(last)
        if shown[0] == shown[1]:
            return Caption("Γ ends at its initial value.", f"Γ = {shown[0]}.")
        return Caption(f"Γ is {'larger' if last > first else 'smaller'} at the end.", f"From {shown[0]} to {shown[1]}.")

    def quantities(self) -> Iterator[str]:
        """Yield the dimensions of the strip, its axis ξ and the distance δ."""
        most, least = (tuple(map(in_digits, axes)) for axes in (self.strip.outer, self.strip.inner))
        slowest, fastest = (in_digits(float(np.hypot(*end))) for end in self.strip.unstable)
        yield f"σ₁: |ω₁| ≤ {most[0]}, |ω₂| ≤ {most[1]}"
        yield f"σ₂: |ω₁| ≥ {least[0]} at ω₂ = 0, |ω₂| ≥ {least[1]} at ω₁ = 0"
        yield f"|ω| on Nˢ and Nᵘ from {slowest} to {fastest}"
        yield f"ξ = {vector(self.strip.xi)}"
        yield f"δ = {in_digits(self.distance, 3)}"

    def status(self) -> Iterator[str]:
        """Yield the status of the chosen orbit and of the map."""
        if self.orbit.has_result("path"):
            yield from orbit_status(self.orbit.path)
            yield from self.proof.status()
        if self.peek("map_or_reason") and self.map is not None:
            yield f"{self.map.phis.size} phases, error ≤ {float(self.map.errors.max()):.1e}"

    def notes(self) -> Iterator[str]:
        """Yield the reason for a missing map."""
        if self.peek("map_or_reason") and self.map_or_reason[1]:
            yield self.map_or_reason[1]


_EXACT = replace(REFERENCE, promise=1e-2 * REFERENCE.promise)
"""Level of the exact map.  A smaller promise lengthens the followed motion; the order is the same at all levels."""
_MEASURES: tuple[Trial[ChaplyginBall], ...] = (
    Trial(
        Kind.MAP,
        ("curve",),
        lambda s, plan: (
            s.phases(plan.side(_PHASES), _EXACT if plan.level.is_perturbed else plan.level).compute().theta_plus
        ),
        lambda s, found, truth: curve_error(found, truth, math.pi),
        shared_setting="cells",
    ),
    Trial(
        Kind.CURVE,
        ("omega",),
        lambda s, plan: s.strip_orbits(plan.side(_ORBITS), plan.level).compute(),
        lambda s, found, truth: math.sqrt(s.h) * 0.5 * PIXELS / s.half_width * largest_distance(found, truth),
        shared_setting="cells",
    ),
)


SCENE = Scene(
    ChaplyginBall,
    __file__,
    place=9,
    presets=PRESETS,
    level_trials=_MEASURES,
    charts=Charts(
        (
            ChartSource(
                "ball-scattering",
                lambda s: {**tensor_of(s.body), "D": s.D, "theta": s.theta, "phi": s.phi, "distance": s.distance},
            ),
            *motion_charts(SYSTEM, lambda s: s.start),
        ),
        over=("phi", "theta"),
    ),
    group="Ball",
    essential=("D", "h", "theta", "phi"),
    handle="phi",
    answers=(Answer("Motions off both half-lines go from Nᵘ to a uniform rotation on Nˢ."),),
    lead=("curve",),
    title="Chaplygin ball",
    summary="A ball rolls inside the body: orbits go from Nᵘ to Nˢ in a strip between two ellipses.",
    swarm=turned_swarm(),
    tracks={"orbit": lambda s: plane.orbit_columns(s.orbit.path, Gamma=s.Gamma)},
    views=(
        body_picture(ball=True, field=False),
        plane.picture(
            lambda s: Caption("Orbits go from Nᵘ to Nˢ.", "Every orbit lies in the strip between σ₂ and σ₁."),
            lambda s: s.half_width,
            layers=(
                region(
                    "forbidden",
                    lambda s: plane.ring_complement(s.strip.sigma2(_ANGLES), s.strip.sigma1(_ANGLES), s.half_width),
                    edge=theme.MUTED,
                    label="impossible",
                    tag="impossible",
                    is_overlay=True,
                ),
                names("names", ChaplyginBall.ellipse_names),
                plane.arcs(lambda s: [track for track, _ in s.all_orbits if len(track) > 1]),
                *plane.half_lines(
                    lambda s, _: s.strip.stable,
                    lambda s, _: s.strip.unstable,
                    ("Nˢ, limit circle for t → ∞", "Nᵘ, limit circle for t → −∞"),
                ),
                plane.band(lambda s: s.proof.band),
                plane.orbit("orbits; the chosen one bold"),
                # Place the arrows evenly over the strip: all orbits are slow near their middles, where arrows would
                # cluster.
                arrows("arrows", lambda s: plane.arrows_at(s.all_orbits), color=theme.ORBIT, alpha=0.8),
            ),
        ),
        sphere(
            ChaplyginBall._about_sphere,
            xi=lambda s: s.strip.xi,
            left=lambda s: s.theta,
            joined=lambda s: float(np.clip(s.Gamma[-1], -1.0, 1.0)),
        ),
        square.phase_plot(
            ChaplyginBall._about_curve,
            message=lambda s: s.map_or_reason[1],
            layers=(
                levels("levels", lambda s: [] if s.map is None else [s.theta, math.pi - s.theta]),
                curves("free", lambda s: s.free(), color=theme.MAP, dash="dashed", label="𝒟 = 0", tag="𝒟 = 0"),
                curves("ball", lambda s: [] if s.map is None else [s.map.curve], color=theme.ORBIT, tag="θ⁺"),
                ring(
                    "chosen",
                    lambda s: [] if s.map is None else [(s.phi, s.map.theta_plus_at(s.phi))],
                    size=18.0,
                    tag="chosen orbit",
                ),
            ),
        ),
        Gamma_picture(
            ChaplyginBall._about_Gamma,
            lambda s: [math.cos(s.theta), s.Gamma[-1]],
            lambda s: (s.orbit.path.times, s.Gamma),
        ),
    ),
)
