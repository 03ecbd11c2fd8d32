"""Singular measures: a cloud of phase points attracted to an invariant manifold, and its density."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.framework.sliders import ONE_TURN, accuracy_level, choice, number, parameter, time_span
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import with_margin
from hess_explorer.views.layers import Columns, Range, column
from hess_explorer.views.plot import Plot
from hess_explorer.views.space import cloud
from hess_explorer.views.space.poisson_sphere import Direction, Sphere
from hess_explorer.views.text import digits, range_text, vector
from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud_density import Clouds, clouds
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.results import Array

_FEW = 1000
"""Number of points while a slider is dragged and until the full cloud is known."""

# Each example sets all choices that affect it, because other choices keep their values.
_CHOICES: Values = {"start": "energy shell", "direction": "forward", "beside": "nothing", "along": "divergence"}
_PATCH: Values = {"start": "small patch", "direction": "forward", "along": "volume"}

PRESETS = (
    Preset("Free Suslov problem: 1/|s| on average", **_CHOICES),
    Preset("Backward: onto the unstable half", **{**_CHOICES, "direction": "backward"}),
    Preset("A small patch and its volume", **_PATCH, beside="nothing"),
    Preset("Beside: on a principal axis, volume is preserved", **_PATCH, beside="principal axis"),
    Preset("A density that vanishes: |F₂|/|s| on F₂ = 0", **_CHOICES, I11=1.64, I22=1.0, I13=0.0, I23=0.8),
    Preset(
        "Chaplygin ball, 𝒟 = 3: γ gathers too (not a rigid body)",
        **_CHOICES,
        I11=1.0,
        I22=1.5,
        I13=0.7,
        I23=1.2,
        D=3.0,
        h=3.0,
        span=11.0,
    ),
)


@dataclass(frozen=True)
class SingularMeasures(State):
    """One or two clouds of phase points over time."""

    I11: float = parameter(known.I11, 2.0)
    I22: float = parameter(known.I22)
    I13: float = parameter(
        known.I13, 0.5, doc="Product of inertia; with I₂₃ it sets the manifold s = I₁₃ω₁ + I₂₃ω₂ = 0."
    )
    I23: float = parameter(known.I23, 0.7, doc="Product of inertia; I₁₃ and I₂₃ must not both be 0.")
    D: float = parameter(
        known.D, 0.0, doc="0: free Suslov problem; otherwise the Chaplygin ball, whose inner ball has this 𝒟."
    )
    h: float = parameter(known.H_FREE_BALL, 2.0, doc="Energy of the middle of the cloud; without a field h > 0.")
    spread: float = number(
        "δ",
        0.1,
        (0.01, 0.5),
        0.01,
        bounds=(1e-3, 0.9),
        label="Spread δ",
        doc="Shell: E = h(1 ± δ). Patch: radius of its disc of ω, in |ω|, and of its cap of γ, in radians.",
    )
    angle: float = number(
        "φ",
        -0.3,
        (-3.14, 3.14),
        0.01,
        bounds=ONE_TURN,
        label="Direction φ of the patch",
        doc="Angle of the patch in the plane of ω₁ and ω₂, in radians. Click the plane to set it.",
    )
    span: float = time_span(14.0, 40.0, step=0.5, what="the cloud")
    b3: float = parameter(
        known.B3,
        1.0,
        label="Field b₃ of the second cloud",
        group="State",
        doc="Only the second cloud has a field: without one, ω would be constant for I₁₃ = I₂₃ = 0.",
    )
    start: str = choice(
        "Cloud",
        ("energy shell", "small patch"),
        "energy shell",
        group="State",
        doc="All states with about the energy h, or those near one state; evenly spread over the phase volume.",
    )
    direction: str = choice(
        "Time",
        ("forward", "backward"),
        "forward",
        group="State",
        doc="Forward, the cloud approaches the stable half of s = 0; backward, the unstable half.",
    )
    beside: str = choice(
        "Beside",
        ("nothing", "principal axis"),
        "nothing",
        group="State",
        doc="The same points with I₁₃ = I₂₃ = 0 and the field b₃, in another colour.",
    )
    along: str = choice(
        "Picture over time",
        ("divergence", "volume"),
        "divergence",
        doc="The divergence div v at the points, or the logarithm of small volumes around them.",
    )
    points: str = choice("Points", ("1000", "10000"), "10000", doc="Number of points of both clouds together.")
    accuracy: str = accuracy_level()

    def idle_values(self) -> Mapping[str, float]:
        """Return the parameters without effect: φ without a patch, b₃ without a second cloud."""
        return {
            **({} if self.start == "small patch" else {"angle": self.angle}),
            **({} if self.beside == "principal axis" else {"b3": self.b3}),
        }

    @cached_property
    def body(self) -> BallBody:
        """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D)

    @cached_property
    def strip(self) -> Strip:
        """The strip of admissible ω."""
        return Strip(self.body, self.h)

    def task(self, count: int, level: Level) -> Task[Clouds]:
        """Return a task that moves `count` points."""
        angle = self.angle if self.start == "small patch" else None
        span = -self.span if self.direction == "backward" else self.span
        field = self.b3 if self.beside == "principal axis" else None
        return Task(clouds, self.body, self.h, angle, self.spread, count, span, field, level)

    @cached_property
    def clouds(self) -> Clouds:
        """The moving clouds."""
        plan = self.plan(Kind.CLOUD)
        count = plan.part(int(self.points), _FEW)
        return self.work.need(self.task(count, plan.level), preview=self.task(min(count, _FEW), plan.level))

    @cached_property
    def times(self) -> Array:
        """Times of the player, (m,)."""
        return np.abs(self.clouds.cloud.times)

    @property
    def statistics(self) -> Array:
        """Mean, minimum and maximum of the quantity in the fourth picture, (3, m)."""
        course = self.clouds.history
        return course.divergence if self.along == "divergence" else course.log_growth

    @property
    def heights(self) -> Range:
        """The vertical axis of the fourth picture."""
        return with_margin(np.append(self.statistics, 0.0), 0.08)

    def track(self) -> Columns:
        """Return the times of the clouds and the mean of the fourth picture."""
        return {"t": column(self.times), "mean": column(self.statistics[0])}

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_velocity(self) -> Caption:
        return cloud.ends_caption(self.clouds)

    def _about_sphere(self) -> Caption:
        first, last = (float(((self.clouds.cloud.gamma[:, i] @ self.strip.xi) ** 2).mean()) for i in (0, -1))
        return Caption("γ of the points of the cloud.", f"Mean of (γ, ξ)² {range_text(first, last, 3)}.")

    def _about_density(self) -> Caption:
        s, mean = self.clouds.density.upper_quarter
        height = digits(self.clouds.density.height, 3)
        return Caption(
            "Time average and invariant density.",
            f"At |s| = {digits(s, 2)}: {digits(mean, 3)}/|s|; invariant density: {height}/|s|.",
        )

    def _about_history(self) -> Caption:
        return cloud.history_caption(self.clouds, of_patch=self.along == "volume" and self.start == "small patch")

    def quantities(self) -> Iterator[str]:
        """Yield the system, its invariant density and the change of phase-space volume."""
        course = self.clouds.history
        yield f"System: {'Chaplygin ball, b = 0' if self.D else 'free Suslov problem'}"
        yield "Invariant density: 1/|I₁₃ω₁ + I₂₃ω₂|"
        yield f"ξ = {vector(self.strip.xi)}"
        yield f"mean of div v: {digits(course.divergence[0, 0], 3)} → {digits(course.divergence[0, -1], 3)}"
        yield f"mean of ln s(t)/s(0): {digits(course.log_growth[0, -1])}"
        if self.start == "small patch":
            yield f"V(t)/V(0) = {digits(course.volume[-1], 4)}"
        if self.clouds.sides is not None:
            yield "F₂ > 0 at {} points, F₂ < 0 at {}; its sign changes at {}".format(*self.clouds.sides)
        if self.clouds.other is not None:
            yield f"Second cloud: I₁₃ = I₂₃ = 0, b₃ = {digits(self.b3)}, div v = 0"

    def status(self) -> Iterator[str]:
        """Yield the size, cost and error of the clouds."""
        return cloud.status_of(self.clouds)


_CLOUD: Trial[SingularMeasures] = Trial(
    Kind.CLOUD,
    (),
    lambda s, plan: s.task(plan.part(int(s.points), _FEW), plan.level).compute(),
    lambda s, found, truth: cloud.largest_distance(found, truth),
    shared_setting="share",
)

SCENE = Scene(
    SingularMeasures,
    __file__,
    place=16,
    presets=PRESETS,
    level_trials=(_CLOUD,),
    group="Free body",
    essential=("h", "I23", "D", "spread"),
    answers=(Answer("The cloud leaves one half of a line and gathers at the other, though no energy is lost."),),
    title="Singular measures",
    summary="10 000 phase points approach an invariant manifold on which an invariant density is infinite.",
    tracks={"orbit": SingularMeasures.track},
    views=(
        cloud.CloudPlane(
            name="omega",
            title="Angular velocity (ω₁, ω₂)",
            caption=SingularMeasures._about_velocity,
            clouds=lambda s: s.clouds,
            strip=lambda s: s.strip,
            b3=lambda s: s.b3,
            density="density-now",
            half_width=lambda s: cloud.half_width(s.clouds),
            on_click=lambda s, x, y: {"start": "small patch", "angle": math.atan2(y, x)},
            starts=True,
        ),
        Sphere(
            caption=SingularMeasures._about_sphere, looks={}, clouds="omega", axis=lambda s: Direction(s.strip.xi, "ξ")
        ),
        Plot(
            name="density",
            title="Density against |s|",
            caption=SingularMeasures._about_density,
            log="xy",
            axes=("|s| = |I₁₃ω₁ + I₂₃ω₂|", "share of points per |s|"),
            y_tick_count=5,
            source_pictures=("omega",),
            x=lambda s: cloud.density_axes(s.clouds).x,
            y=lambda s: cloud.density_axes(s.clouds).y,
            layers=cloud.density_layers(lambda s: s.clouds.density),
        ),
        Plot(
            name="divergence",
            caption=SingularMeasures._about_history,
            axes=("t", "div v, or ln s(t)/s(0)"),
            title=lambda s: f"{'Divergence' if s.along == 'divergence' else 'Small volumes'} along the orbits",
            x=lambda s: (0.0, float(s.times[-1])),
            y=lambda s: s.heights,
            dot=("t", "mean"),
            layers=cloud.history_layers(
                lambda s: s.times, lambda s: s.statistics, beside=lambda s: s.clouds.other is not None
            ),
        ),
    ),
)
