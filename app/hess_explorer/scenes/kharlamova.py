"""Constraint axis e on a principal axis, b3 = 0 (Kharlamova's case): parabolas in an ellipse, and the equator."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, ChartSource
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import (
    ONE_TURN,
    Slider,
    accuracy_level,
    choice,
    number,
    parameter,
    slider_within,
    time_span,
)
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, constrained_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs import period_graph
from hess_explorer.views.graphs.graph import pieces
from hess_explorer.views.graphs.period_graph import has_periods, period_axis
from hess_explorer.views.layers import Columns, Layer, curves, points, ring
from hess_explorer.views.plane import plane_domain, plane_potential
from hess_explorer.views.plane.plane_domain import plane_columns
from hess_explorer.views.plane.velocity_plane import round_up
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import EQUATOR, Direction, Mark, Sphere, centre_of_mass, levels_about
from hess_explorer.views.text import digits, vector
from hess_mechanics import parameters as known
from hess_mechanics.numerics.results import Array, Orbit
from hess_mechanics.suslov import kharlamova as mechanics
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.kharlamova import Arc, PlaneBody
from hess_mechanics.suslov.plane_potential import MOST_SAMPLES, POTENTIALS, PlaneMotion, PotentialBody, motion_from
from hess_mechanics.suslov.principal_axis import divergence

# Values of the equipotentials, in units of the potential's largest value.
_LEVELS = (-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75)
_ROUND = {"I11": 1.0, "I22": 1.0, "b1": 1.0, "b2": 0.0}
PRESETS = (
    Preset("Periodic: an arc of a parabola, back and forth"),
    Preset("Periodic: a straight line, b = 0", b1=0.0, b2=0.0),
    Preset("Periodic: from rest, along the force", p=0.0),
    Preset("Periodic: two orbits on one parabola", **_ROUND, q1=0.5, q2=-0.55, p=1.12, alpha=1.107),
    Preset("Fixed point on the equator, unstable", **_ROUND, q1=0.0, q2=-1.0, p=0.5, alpha=0.0),
    Preset("Fixed point, stable by its spin", **_ROUND, q1=0.0, q2=-1.0, p=1.5, alpha=0.0),
    # (γ1, γ2) = (1 − τ²/2, τ/2) touches the circle at τ = 0; the start is at τ = 1.
    Preset(
        "Asymptotic: touches the equator from inside",
        **_ROUND,
        q1=0.5,
        q2=-0.5,
        p=math.sqrt(1.25),
        alpha=math.atan2(1.0, 0.5),
        span=15.0,
    ),
    Preset(
        "Near the asymptotic orbit: a long period",
        **_ROUND,
        q1=0.5,
        q2=-0.5,
        p=math.sqrt(1.25),
        alpha=1.1072,
        span=40.0,
    ),
)


@dataclass(frozen=True)
class Kharlamova(State):
    """An orbit on its arc of a parabola, and the periods in all directions from its start."""

    # The bounds are narrower than in other scenes.
    I11: float = parameter(known.I11, bounds=(1e-2, 1e2))
    I22: float = parameter(known.I22, 1.0, bounds=(1e-2, 1e2))
    b1: float = parameter(
        known.B1,
        0.4,
        softbounds=(-2.0, 2.0),
        bounds=(-1e2, 1e2),
        doc="b = −mg r, where r is the centre of mass; here b₃ = 0.",
    )
    b2: float = parameter(
        known.B2,
        0.7,
        softbounds=(-2.0, 2.0),
        bounds=(-1e2, 1e2),
        doc="b = −mg r; orbits are straight lines for b₁ = b₂ = 0.",
    )
    q1: float = number(
        "q₁",
        0.3,
        (-1.22, 1.22),
        0.01,
        bounds=(-10.0, 10.0),
        label="Start q₁ = √I₁₁ γ₂",
        doc="Start of the orbit, on the half γ₃ ≥ 0 of the sphere; click the plane to choose it.",
    )
    q2: float = number(
        "q₂",
        -0.2,
        (-1.0, 1.0),
        0.01,
        bounds=(-10.0, 10.0),
        label="Start q₂ = −√I₂₂ γ₁",
        doc="Start of the orbit; click the plane to choose it.",
    )
    p: float = number(
        "|p|", 1.0, (0.0, 4.0), 0.01, bounds=(0.0, 1e3), label="Start |p|", doc="p = (√I₁₁ ω₁, √I₂₂ ω₂), at the start."
    )
    alpha: float = number(
        "α",
        0.5,
        (-3.14, 3.14),
        0.01,
        bounds=ONE_TURN,
        label="Start: direction α",
        doc="Direction of p = |p| (cos α, sin α) at the start; click the graph of T to choose it.",
    )
    span: float = time_span(20.0, 100.0)
    potential: str = choice(
        "Another potential",
        tuple(POTENTIALS),
        "Hénon–Heiles",
        doc="U(γ₁, γ₂) of the picture “Potential”, in place of (b, γ). Quadratic: integrable.",
    )
    accuracy: str = accuracy_level()

    def valid_state(self, notes: list[str]) -> Kharlamova:
        """Return the state with a start outside the domain moved to its edge; append a note."""
        r1, r2 = self.body.axes
        size = math.hypot(self.q1 / r1, self.q2 / r2)
        if size <= 1.0 + 1e-13:
            return self
        state = replace(self, q1=self.q1 / size, q2=self.q2 / size)
        notes.append(
            f"The start is outside the ellipse: it was moved to its edge, q = ({digits(state.q1)}, {digits(state.q2)})."
        )
        return state

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges of q over the ellipse."""
        return dict(zip(("q1", "q2"), map(slider_within, self.body.axes), strict=True))

    @cached_property
    def body(self) -> PlaneBody:
        """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return PlaneBody(self.I11, self.I22, self.b1, self.b2)

    @cached_property
    def start(self) -> tuple[float, ...]:
        """The initial state (ω, γ).  Raises `InvalidParameter`."""
        p = (self.p * math.cos(self.alpha), self.p * math.sin(self.alpha))
        return mechanics.state_at(self.body, (self.q1, self.q2), p)

    @cached_property
    def h(self) -> float:
        """The energy."""
        return self.body.energy(self.start)

    @cached_property
    def arc(self) -> Arc:
        """The arc of the parabola that the orbit covers."""
        return self.work.need(Task(mechanics.arc, self.body, self.start))

    @cached_property
    def samples(self) -> tuple[Orbit, Array]:
        """The orbit, and the states (m, 5) of the mirror image of its past."""
        return self.work.need(Task(mechanics.sampled_orbit, self.body, self.start, self.span, self.level))

    @property
    def orbit(self) -> Orbit:
        """The orbit."""
        return self.samples[0]

    @cached_property
    def closure_error(self) -> float:
        """The distance of a periodic orbit from its start after one period."""
        return self.work.need(Task(mechanics.closure_error, self.body, self.start, self.arc.period, self.level))

    @cached_property
    def periods(self) -> Array:
        """Initial directions α in radians and periods T, (n, 2)."""
        return self.work.need(Task(mechanics.periods_by_direction, self.body, (self.q1, self.q2), self.p))

    @cached_property
    def other_body(self) -> PotentialBody:
        """The same body in the other potential."""
        return PotentialBody(self.I11, self.I22, *POTENTIALS[self.potential])

    @cached_property
    def other_motion(self) -> PlaneMotion:
        """The motion from the same start in the other potential."""
        return self.work.need(Task(motion_from, self.other_body, self.start, self.span, self.level))

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit)

    def motion(self) -> Motion:
        """Return the motion of the orbit."""
        return Motion(SYSTEM, self.start, self.body.parameters, self.span, self.body.pixels_per_unit(self.h))

    # ---- the pictures ------------------------------------------------------------------------------------------

    def orbit_columns(self) -> Columns:
        """Return the columns of the orbit and of its mirror image, which the second moving point follows."""
        orbit, mirror = self.samples
        q, mirror_q = (self.body.to_plane(states)[0] for states in (orbit.states, mirror))
        tau, mirror_tau = (mechanics.rescaled_time(self.arc, states) for states in (orbit.states, mirror))
        return plane_columns(
            orbit,
            q,
            mirror_q1=mirror_q[:, 0],
            mirror_q2=mirror_q[:, 1],
            tau=tau,
            mirror_tau=mirror_tau,
            mirror_g3=mirror[:, 4],
        )

    def half_width(self) -> float:
        """Return the half width of the picture of the domain."""
        return round_up(1.08 * max(self.body.axes))

    def fixed_points(self, kind: float) -> list[Array]:
        """Return the parts of the domain's edge with fixed points, stable (kind 1) or unstable (kind −1)."""
        boundary, kinds = self.work.need(Task(mechanics.fixed_point_kinds, self.body, self.h))
        return pieces(boundary, kinds == kind)

    def path(self) -> list[Array]:
        """Return the parabola, extended beyond the domain; empty for a fixed point."""
        low, high = self.arc.ends
        more = 0.5 * self.arc.length
        return (
            [] if self.arc.kind == "fixed" else [self.body.q_of(self.arc.u(np.linspace(low - more, high + more, 181)))]
        )

    def force(self) -> Direction | None:
        """Return the direction of the centre of mass; None without a field."""
        return centre_of_mass((self.b1, self.b2, 0.0))

    def marks(self) -> list[Mark]:
        """Return the points at which the orbit crosses the equator, touches it or stays on it."""
        if self.arc.kind != "fixed":
            return [
                Mark((*u, 0.0), "unstable" if tau == self.arc.touch else "muted")
                for tau, u in zip(self.arc.tau, self.arc.u(np.array(self.arc.tau)), strict=True)
            ]
        return [Mark(self.start[2:], "stable" if self.arc.stable else "unstable")] if self.start[4] == 0.0 else []

    def tau_axis(self) -> tuple[float, float]:
        """Return an axis of τ with room for both arcs."""
        middle, half = 0.5 * sum(self.arc.ends), round_up(0.6 * self.arc.length)
        return middle - half, middle + half

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_domain(self) -> Caption:
        if self.arc.kind == "fixed":
            stable = {True: "A stable fixed point.", False: "An unstable fixed point.", None: "A fixed point."}
            where = "On the equator." if self.start[4] == 0.0 else "No field and no motion."
            return Caption(stable[self.arc.stable], where)
        if self.arc.kind == "asymptotic":
            return Caption("Asymptotic to an unstable fixed point.", "The arc touches the edge from inside there.")
        shape = "arc of a parabola" if np.any(self.arc.a) else "straight line"
        return Caption(f"Periodic: {shape}, back and forth.", f"T = {digits(self.arc.period)}.")

    def _about_sphere(self) -> Caption:
        if self.arc.kind == "fixed":
            return Caption("γ is constant.", "γ̇₃ = γ₁ω₂ − γ₂ω₁ = 0 and γ₃ = 0." if self.arc.rate > 0.0 else "")
        first, second = map(digits, self.arc.crossing_speeds)
        if self.arc.kind == "asymptotic":
            last = second if self.arc.touch == self.arc.tau[0] else first
            return Caption("The equator is crossed once.", f"|γ̇₃| = {last}.")
        return Caption("Two equator crossings per period.", f"|γ̇₃| = {first} and {second}.")

    def _about_curve(self) -> Caption:
        if self.arc.kind == "fixed":
            return Caption("τ is constant.", "dτ = γ₃ dt = 0." if self.arc.rate > 0.0 else "Nothing depends on τ.")
        verdict = "γ₃² = P(τ) between two zeros."
        zeros = "Zeros {} and {}".format(*map(digits, self.arc.tau))
        if self.arc.kind == "asymptotic":
            return Caption(verdict, f"{zeros}; the zero {digits(self.arc.touch or 0.0)} is double.")
        return Caption(verdict, f"{zeros}; dτ = γ₃ dt, ∮dτ/γ₃ = T.")

    def _about_period(self) -> Caption:
        if self.arc.kind == "fixed":
            return Caption("Periods in all directions from this start.")
        if self.arc.kind == "asymptotic":
            return Caption("T = ∞ in this direction.", "∫dτ/γ₃ diverges.")
        return Caption(
            f"T = {digits(self.arc.period)} in this direction.",
            f"After T the orbit returns to its start within {digits(self.closure_error, 1)}.",
        )

    def quantities(self) -> Iterator[str]:
        """Yield the energy, start, force, period and divergence."""
        yield f"E = {digits(self.h)}"
        yield f"Start: γ₃ = {digits(self.start[4])}"
        yield f"Force = {vector((-self.b2 / self.body.axes[0], self.b1 / self.body.axes[1]))}"
        if self.arc.kind == "periodic":
            yield f"T = {digits(self.arc.period)}"
            yield f"Distance from the start after T: {digits(self.closure_error, 1)}"
        else:
            yield "T = ∞" if self.arc.kind == "asymptotic" else "A fixed point"
        if self.peek("samples"):
            largest = float(np.abs(divergence([*self.orbit.states.T], self.body.parameters)).max())
            yield f"div v = {digits(largest)} on the orbit: the standard measure"
        yield "In τ: Hamiltonian, measure γ₃ dω dγ"

    def status(self) -> Iterator[str]:
        """Yield the status of the orbit."""
        if self.peek("samples"):
            yield from orbit_status(self.orbit)

    def notes(self) -> Iterator[str]:
        """Yield a warning if the orbit is too long to draw in detail."""
        if self.peek("samples") and self.orbit.times.size >= MOST_SAMPLES:
            yield f"This long motion is drawn with only {MOST_SAMPLES} points: choose a shorter time span for details."


_MIRROR: Layer[Kharlamova] = points(
    "mirror", color=theme.MAP, edge=theme.INK, edge_width=1.5, size=11, label="mirror image, t → −t"
)

SCENE = Scene(
    Kharlamova,
    __file__,
    place=6,
    presets=PRESETS,
    charts=Charts(
        (
            ChartSource(
                "period",
                lambda s: {
                    "I11": s.I11,
                    "I22": s.I22,
                    "b1": s.b1,
                    "b2": s.b2,
                    **dict(zip(SYSTEM.arguments, s.start, strict=True)),
                },
            ),
        ),
        over=("p", "alpha"),
    ),
    group="Heavy body",
    essential=("q1", "q2", "p", "alpha"),
    handle="alpha",
    answers=(
        Answer("A fixed point: the body turns evenly about the vertical, or rests.", lambda s: s.arc.kind == "fixed"),
        Answer(
            "In this direction the motion takes forever: it tends to an unstable fixed point.",
            lambda s: s.arc.kind == "asymptotic",
        ),
        Answer("Nearly every motion runs along an arc and back, and repeats itself after one period."),
    ),
    lead=("period",),
    title="Principal axis, b₃ = 0",
    summary="Parabolas in an ellipse: all orbits are periodic, except those that touch the equator from inside.",
    swarm=turned_swarm(lambda s, states: dict(zip(("q1", "q2"), s.body.to_plane(states)[0].T, strict=True))),
    tracks={"orbit": Kharlamova.orbit_columns},
    views=(
        body_picture(),
        plane_domain.picture(
            "Domain of (q₁, q₂)",
            Kharlamova._about_domain,
            Kharlamova.half_width,
            names=("q1", "q2"),
            dots={"mirror": ("mirror_q1", "mirror_q2")},
            layers=(
                *plane_domain.background_layers(
                    edge=lambda s: s.work.need(Task(mechanics.fixed_point_kinds, s.body, s.h))[0],
                    forbidden=lambda s: mechanics.forbidden(s.body, s.h),
                    levels=lambda s: mechanics.equipotentials(s.body, _LEVELS),
                ),
                curves("path", Kharlamova.path, color=theme.ORBIT, width=1.5, dash="dotted", alpha=0.7),
                curves(
                    "stable",
                    lambda s: s.fixed_points(1.0),
                    color=theme.STABLE,
                    width=3,
                    label="stable fixed points",
                    tag="stable",
                ),
                curves(
                    "unstable",
                    lambda s: s.fixed_points(-1.0),
                    color=theme.UNSTABLE,
                    width=3,
                    dash="dashed",
                    label="unstable fixed points",
                    tag="unstable",
                ),
                *plane_domain.orbit(start=lambda s: (s.q1, s.q2)),
                _MIRROR,
            ),
        ),
        Sphere(
            caption=Kharlamova._about_sphere,
            looks={"orbit": "orbit"},
            marks=Kharlamova.marks,
            axis=Kharlamova.force,
            circles=lambda s: [EQUATOR, *levels_about(s.force(), _LEVELS)],
        ),
        Plot(
            name="period",
            title="Period T against direction α",
            caption=Kharlamova._about_period,
            axes=("α", "T"),
            x=(-math.pi, math.pi),
            y=lambda s: period_axis(s.periods, s.arc.period),
            on_click=lambda s, x, y: {"alpha": x},
            on_drag="chosen",
            message=lambda s: "" if has_periods(s.periods) else "No motion, so no period.",
            layers=period_graph.layers(
                lambda s: s.periods, here=lambda s: None if s.arc.kind == "fixed" else (s.alpha, s.arc.period)
            ),
        ),
        plane_potential.picture(
            lambda s: s.potential, lambda s: s.other_body, lambda s: s.other_motion, Kharlamova.half_width
        ),
        Plot(
            name="curve",
            title="γ₃ against τ",
            button="Show γ₃ against τ",
            axes=("τ", "γ₃"),
            caption=Kharlamova._about_curve,
            x=Kharlamova.tau_axis,
            y=(-1.1, 1.1),
            dot=("tau", "g3"),
            dots={"mirror": ("mirror_tau", "mirror_g3")},
            layers=(
                curves(
                    "other",
                    lambda s: [s.arc.oval(s.arc.other)] if s.arc.other else [],
                    color=theme.MUTED,
                    dash="dashed",
                ),
                curves("own", lambda s: [s.arc.oval(s.arc.tau)], color=theme.ORBIT, tag="orbit"),
                ring("chosen", lambda s: [(0.0, s.start[4])], size=18),
                _MIRROR,
            ),
        ),
    ),
)
