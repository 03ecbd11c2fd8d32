"""Scattering of the free Suslov problem: from the circle θ⁻ and the phase φ to the circle θ⁺."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework import free_body
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, ChartSource, tensor_of
from hess_explorer.scenes.framework.circle_left import CIRCLES, DIGITS, PHI, sphere
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import Slider, accuracy_level, parameter
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, constrained_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.trial import Trial, curve_error
from hess_explorer.scenes.framework.work import drift_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import curves, levels, ring
from hess_explorer.views.maps import scattering_map as square
from hess_explorer.views.plane.velocity_plane import pixels_per_unit, velocity_columns
from hess_explorer.views.text import digits as in_digits
from hess_explorer.views.text import vector
from hess_mechanics import parameters as known
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.numerics.accuracy import Kind, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov import scattering as model
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.free import Equilibria, FreeMotion, equilibria_of_unit_rate, sampled_motion

_CELLS, _FEW_CELLS = (240, 120), (120, 60)
"""Cells of the map; fewer while a slider is dragged."""
_PHASES = np.linspace(-math.pi, math.pi, 361)
_MOST_DIGITS = 12.0
_RADIUS = 0.5 * PIXELS

PRESETS = (
    Preset("I₁₁ = 3.56, θ⁻ = π/2 (figure 4)"),
    Preset("k = 1: complete reversal, the curve is flat", k=1.0, theta=1.0),
    Preset("k = 3: complete reversal again", k=3.0, I23=0.4, theta=1.0),
    Preset("k = 2, small θ⁻", theta=0.3),
    Preset("k² < 0: I₁₁ below I₂₂", k=-1.5, I23=0.3, theta=1.2),
    Preset("I₁₃ ≠ 0", I13=0.3, I23=0.5, k=1.7, theta=1.2),
)


@dataclass(frozen=True)
class ScatteringState(State):
    """The rotation that determines the scattering map, and the orbit of the chosen phase."""

    I22: float = parameter(free_body.I22)
    I13: float = parameter(free_body.I13)
    I23: float = parameter(free_body.I23, 0.8)
    k: float = parameter(
        known.K_DRIVES_I11,
        2.0,
        doc="I₁₁ = I₂₂ + k|k| (I₁₃² + I₂₃²)/I₂₂. With I₁₃ = 0 and k odd all orbits are reversed: θ⁺ = π − θ⁻.",
    )
    theta: float = parameter(known.THETA, math.pi / 2)
    phi: float = parameter(PHI, label="Phase φ of the orbit shown")
    digits: float = parameter(
        DIGITS,
        5.30103,
        softbounds=(1.0, 12.0),
        bounds=(0.5, 300.0),
        doc="Distance of the start from the unstable point: δ = 10^−digits of |ω|. A change only shifts the phase.",
    )
    accuracy: str = accuracy_level()

    def limits(self) -> Mapping[str, Slider]:
        """Return the slider range of k, with I11 > 0."""
        return free_body.limits_of_k(self.I22, self.I13, self.I23)

    def valid_state(self, notes: list[str]) -> ScatteringState:
        """Return the state with a distance of at least 1e-12 if I13 I23 ≠ 0, where ω(0) is rounded; append a note."""
        if self.I13 * self.I23 == 0.0 or self.digits <= _MOST_DIGITS:
            return self
        notes.append(f"With I₁₃I₂₃ ≠ 0 rounding limits δ to at least 1e−{_MOST_DIGITS:g}: it was set to this limit.")
        return replace(self, digits=_MOST_DIGITS)

    @cached_property
    def body(self) -> SuslovBody:
        """The body.  Raises `NotPositiveDefinite`, `InvalidParameter`."""
        return free_body.free_body(self.k, self.I22, self.I13, self.I23)

    @property
    def distance(self) -> float:
        """The distance δ of ω(0) from the line of equilibria, relative to |ω|."""
        return float(10.0**-self.digits)

    @cached_property
    def points(self) -> Equilibria:
        """The equilibria at the energy with ω0 = 1; without a field the energy sets only the unit of time."""
        return equilibria_of_unit_rate(self.body)

    @cached_property
    def start(self) -> tuple[tuple[float, float], tuple[float, float, float]]:
        """The initial ω and γ of the orbit.  Raises `InvalidParameter`, `WorkLimit`."""
        return model.start(self.body, self.points.h, self.theta, self.phi, self.distance)

    @property
    def span(self) -> float:
        """The duration of the orbit, with the passage in the middle, until γ settles."""
        return 2.0 * math.log(10.0) * self.digits + 8.0

    @cached_property
    def map(self) -> model.Scattering:
        """The rotation from the chosen start."""
        return self.work.need(Task(model.scattering, self.body, self.level, 1, self.distance))

    @cached_property
    def limit(self) -> model.Scattering:
        """The rotation for δ → 0."""
        return self.work.need(Task(model.scattering, self.body, self.level))

    @cached_property
    def curve(self) -> Array:
        """θ⁺ over the phases."""
        return self.map.theta_plus(self.theta, _PHASES)

    @cached_property
    def theta_plus(self) -> float:
        """θ⁺ of the orbit."""
        return float(self.map.theta_plus(self.theta, self.phi))

    @cached_property
    def orbit(self) -> FreeMotion:
        """The orbit of the chosen phase."""
        return self.work.need(Task(sampled_motion, self.body, *self.start, self.span, (1.0, _RADIUS), self.level))

    @property
    def k_axis(self) -> tuple[int, int]:
        """The range of k in the picture of cos χ."""
        return min(0, math.floor(self.k)), max(7, math.ceil(self.k))

    @cached_property
    def orders(self) -> Array:
        """The curve of cos χ over k, (n, 2)."""
        return self.work.need(Task(model.cos_chi_over, *self.k_axis, self.I22, self.I13, self.I23))

    def motion(self) -> Motion:
        """Return the orbit as a motion of the general system."""
        omega, gamma = self.start
        return Motion(SYSTEM, (*omega, *gamma), self.body.parameters, self.span, pixels_per_unit(_RADIUS))

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit)

    # ---- the pictures ------------------------------------------------------------------------------------------

    def grid(self) -> Array:
        """Return θ⁺ over a grid of phases and circles θ⁻."""
        cells = _FEW_CELLS if self.is_preview else self.plan(Kind.MAP).grid(_CELLS)
        return self.work.need(Task(model.theta_plus_grid, self.map, *cells))

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_curve(self) -> Caption:
        return Caption(numbers=f"θ⁻ = {in_digits(self.theta)}: {square.range_text(self.curve)} (dotted: θ⁻, π − θ⁻).")

    def _about_map(self) -> Caption:
        return Caption(
            "One rotation gives the whole map.",
            f"The rotation turns ξ by χ = {in_digits(math.acos(self.limit.cos_chi))}.",
        )

    def _about_sphere(self) -> Caption:
        phi, before, after = map(in_digits, (self.phi, self.theta, self.theta_plus))
        return Caption(numbers=f"φ = {phi}: from θ⁻ = {before} to θ⁺ = {after}.")

    def quantities(self) -> Iterator[str]:
        """Yield I11 and k², the rotation and the start."""
        yield from free_body.derived_quantities(self.k, self.body)
        yield f"cos χ = {in_digits(self.limit.cos_chi, 6)}"
        yield f"φ* = {in_digits(self.map.phi_star)}"
        yield f"δ = {in_digits(self.distance, 3)}"
        yield f"ξ = {vector(self.points.xi)}"
        yield "Time in units of 1/ω₀; θ⁺ does not depend on the energy"

    def status(self) -> Iterator[str]:
        """Yield the status of the rotation and of the orbit."""
        found = self.map
        yield (
            f"{found.level}: rotation {found.cost.steps} Taylor steps, error ≤ {found.error_estimate:.1e} "
            f"({found.status})"
        )
        if self.peek("orbit"):
            yield f"orbit {self.orbit.times.size} points, error ≤ {self.orbit.error_estimate:.1e}"
            yield from drift_status([self.orbit.drift])

    def notes(self) -> Iterator[str]:
        """Yield a warning if the start is rounded."""
        if self.I13 * self.I23 != 0.0 and self.digits > 8.0:
            yield (
                "With I₁₃I₂₃ ≠ 0 the start of the orbit is rounded to 1e−16, which shifts its passage in time and "
                f"changes Γ⁺ by up to 1e−{16.0 - self.digits:.0f}."
            )


def _map(s: ScatteringState, plan: Plan) -> Array:
    found = model.scattering(s.body, plan.level, 1, s.distance)
    model.theta_plus_grid(found, *plan.grid(_CELLS))
    return found.theta_plus(s.theta, _PHASES)


_MAP: Trial[ScatteringState] = Trial(
    Kind.MAP,
    ("curve", "map"),
    _map,
    lambda s, found, truth: curve_error(found, truth, math.pi),
)

SCENE = Scene(
    ScatteringState,
    __file__,
    place=4,
    presets=PRESETS,
    level_trials=(_MAP,),
    charts=Charts(
        (
            ChartSource("scattering", lambda s: {**tensor_of(s.body), "theta": s.theta, "phi": s.phi}),
            ChartSource("cos-chi", lambda s: tensor_of(s.body)),
        ),
        over=("k", "I23"),
    ),
    group="Free body",
    essential=("k", "I23", "theta", "phi"),
    handle="phi",
    answers=(
        Answer(
            "A complete reversal: for this body the phase φ does not matter.",
            lambda s: model.cos_chi(s.body) < -1.0 + 1e-12,
        ),
        Answer("The same approach with another phase can leave at another angle: θ⁺ depends on φ."),
    ),
    lead=("curve",),
    title="Scattering",
    summary="No field: the circle that γ leaves and its phase determine the circle that it joins.",
    swarm=turned_swarm(),
    tracks={"orbit": lambda s: velocity_columns(s.orbit.times, s.orbit.omega, s.orbit.gamma)},
    views=(
        body_picture(field=False),
        square.phase_plot(
            ScatteringState._about_curve,
            layers=(
                levels("levels", lambda s: (s.theta, math.pi - s.theta)),
                curves(
                    "theta",
                    lambda s: [np.column_stack([_PHASES, s.curve])],
                    color=theme.ORBIT,
                    label="θ⁺(φ); orbit",
                    tag="θ⁺(φ)",
                ),
                ring("chosen", lambda s: [(s.phi, s.theta_plus)], size=18.0, label="chosen orbit", tag="chosen orbit"),
            ),
        ),
        square.square_plot(ScatteringState._about_map, ScatteringState.grid, lambda s: (s.phi, s.theta)),
        sphere(
            ScatteringState._about_sphere,
            xi=lambda s: s.points.xi,
            left=lambda s: s.theta,
            joined=lambda s: math.cos(s.theta_plus),
            signs=CIRCLES,
        ),
        square.order_plot(
            lambda s: s.k_axis,
            lambda s: s.orders,
            lambda s: (s.k, s.limit.cos_chi),
            closed=lambda s: model.cos_chi(s.body),
        ),
    ),
)
