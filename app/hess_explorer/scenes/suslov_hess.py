"""The Hess case of the Suslov problem: torus, Poisson sphere, bifurcation diagram, circle map."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework import hess_case
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, torus_charts
from hess_explorer.scenes.framework.hess_case import (
    ProvedStatement,
    limit_cycles,
    map_or_none,
    possible_f,
    possible_I23,
    proved_statement,
)
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import (
    Slider,
    accuracy_level,
    number,
    parameter,
    show_proved_error,
    slider_within,
)
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, hess_solid
from hess_explorer.scenes.framework.trial import COLOUR_UNIT, Trial, boundary_error, colour_error, curve_error
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.scenes.parts.orbits.hess_surface import INVARIANT, HessSurface, shading, surface_picture
from hess_explorer.scenes.parts.orbits.proof import OrbitProof
from hess_explorer.views.layers import CellGrid, Columns
from hess_explorer.views.maps import bifurcation_diagram as diagram
from hess_explorer.views.maps import circle_map as circle
from hess_explorer.views.plane import torus_density, torus_plane
from hess_explorer.views.plane.velocity_plane import picture, round_up
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Circle, Direction, Sphere, parallels
from hess_explorer.views.text import digits
from hess_mechanics import parameters as known
from hess_mechanics.errors import InvalidParameter, Separatrix
from hess_mechanics.numerics.accuracy import DRAFT, Kind, Level
from hess_mechanics.numerics.balls import has_flint
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, curve, curve_point, f_max, reach, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody
from hess_mechanics.suslov_hess.invariant_measure import density_on_torus, invariant_measure
from hess_mechanics.suslov_hess.mode_locking import CELLS, affordable_cells, rotation_number_window, tongue_boundary
from hess_mechanics.suslov_hess.torus import MAX_RETURNS, Track, annulus, pixels_per_unit, start_of_track, track

_ON_BOUNDARY = 48
"""Points of the boundary of the Arnold tongue."""
_PHASES = np.linspace(-math.pi, math.pi, 181)

PRESETS = (
    Preset("Two limit cycles"),
    Preset("No cycle: every orbit winds", h=0.2, f=0.5),
    Preset("Smaller a, 0.1: the two cycles are gone (figure 7)", I22=1.0, I23=0.1),
    Preset("On the boundary of the Arnold tongue (a = 0.5)", I22=1.0, I23=0.5, h=0.5, f=1.01563456028796105),
    Preset("Pendulum, f = 0: multiplier e^(2πa)", h=1.5, f=0.0, I22=1.0, I23=0.3),
    Preset("Oscillation, f → 0: Θ∘Θ = id", h=0.3, f=1e-8),
    Preset("Separatrix: no return", h=1.0, f=0.0),
    Preset("On the bifurcation curve", **dict(zip("hf", curve_point(0.5), strict=True))),
    Preset("Strong contraction, a = 3 (not a rigid body)", I22=0.5, I23=1.5),
)


@dataclass(frozen=True)
class SuslovHess(State):
    """An orbit on a torus M²(h, f), and the bifurcation diagram of all tori."""

    I22: float = parameter(hess_case.I22)
    I23: float = parameter(hess_case.I23)
    b3: float = parameter(hess_case.B3)
    h: float = parameter(known.H_HESS)
    f: float = parameter(known.F_HESS)
    phi0: float = parameter(hess_case.PHI0)
    span: float = number(
        "t",
        40.0,
        (1.0, 200.0),
        1.0,
        bounds=(0.01, 1e5),
        group="Computation",
        label="Time span",
        doc="Duration of the orbit in the body's unit of time; at most 100 returns are computed.",
    )
    certain: str = show_proved_error()
    shade: str = shading()
    accuracy: str = accuracy_level()

    def valid_state(self, notes: list[str]) -> SuslovHess:
        """Return the state with |a| clamped to 100 and f to the region of this h; append notes."""
        return replace(self, I23=possible_I23(self.I22, self.I23, notes), f=possible_f(self.h, self.f, notes))

    def limits(self) -> Mapping[str, Slider]:
        """Return the slider range of f over the region of this h, with round steps."""
        return {"f": slider_within(f_max(self.h))}

    @cached_property
    def body(self) -> HessBody:
        """The body."""
        return HessBody(self.I22, self.I23, self.b3)

    @cached_property
    def turning_points(self) -> TurningPoints | None:
        """The turning points of n3; None on the separatrix."""
        try:
            return turning_points(self.h, self.f)
        except Separatrix:
            return None

    @cached_property
    def map(self) -> CircleMap | None:
        """The circle map; None on the separatrix."""
        return None if self.turning_points is None else map_or_none(self.work, self.body.a, self.h, self.f, self.level)

    @property
    def kind(self) -> str:
        """The kind of the circle map; empty on the separatrix."""
        return "" if self.map is None else self.map.kind

    @cached_property
    def tongue_boundary(self) -> Array:
        """The boundary |t| = 2 of the Arnold tongue, with points (n, 2)."""
        plan = self.plan(Kind.CURVE, steady=True)
        return self.work.need(Task(tongue_boundary, self.body.a, plan.level, plan.side(_ON_BOUNDARY)))

    @cached_property
    def edge(self) -> Array:
        """The bifurcation curve within the diagram, (n, 2)."""
        return self.work.need(Task(curve, diagram.window(self.h).x[1]))

    @cached_property
    def half_width(self) -> float:
        """Half width of the (ω1, ω2)-plane: room for the largest ring of the diagram, halved while that of h fits."""
        largest = math.sqrt(2.0 * (diagram.window(self.h).x[1] + 1.0))
        halvings = math.floor(math.log2(largest / math.sqrt(2.0 * (self.h + 1.0))))
        ring = 1.02 * math.hypot(1.0, self.body.a) * largest * 0.5**halvings
        return round_up(self.body.frequency_unit * max(ring, 2.0 * DRAFT.promise))

    @cached_property
    def track(self) -> Track:
        """The orbit."""
        return self.work.need(self.orbit_task)

    @property
    def orbit_task(self) -> Task[Track]:
        """The task of the orbit."""
        return Task(track, self.body, self.h, self.f, self.phi0, self.span, self.level, self.half_width)

    @cached_property
    def orbit_proof(self) -> OrbitProof:
        """The proved error of the orbit."""
        unit = self.body.frequency_unit
        return OrbitProof(self, self.certain, (unit, unit * math.hypot(1.0, self.body.a)))

    @cached_property
    def cycles(self) -> tuple[Track, Track] | None:
        """The stable and the unstable limit cycle; None without limit cycles."""
        return limit_cycles(self.work, self.body, self.map, self.level, self.half_width)

    @cached_property
    def iterates(self) -> Array | None:
        """φ0 and its iterates under the circle map, up to the end of the orbit; None on the separatrix."""
        if self.map is None:
            return None
        returns = math.ceil(self.track.orbit.times[-1] / self.map.period)
        return self.map.iterate(self.phi0, max(1, returns))

    @cached_property
    def density(self) -> tuple[Array | None, str]:
        """The invariant density on the torus relative to the uniform density, or None; and the reason for None."""
        reason = torus_density.reason_for_no_density(self.map, self.turning_points)
        if reason or self.map is None:
            return None, reason
        try:
            return self.work.need(Task(density_on_torus, self.map, self.level)), ""
        except InvalidParameter as error:
            return None, str(error)

    @cached_property
    def surface(self) -> HessSurface:
        """The torus in space."""
        return HessSurface(self, self.shade == INVARIANT, lambda: (self.track.orbit.states, self.track.times))

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return hess_solid(self.body, self.track)

    def motion(self) -> Motion:
        """Return the motion of the orbit in units b = 1."""
        state, length = start_of_track(self.body, self.h, self.f, self.phi0, self.span)
        weights = pixels_per_unit(self.body, self.half_width)
        return Motion(SYSTEM, tuple(state), (self.body.a, 1.0), length, tuple(weights), 1.0 / self.body.frequency_unit)

    @cached_property
    def proof(self) -> ProvedStatement | None:
        """The proved statement on this torus; None until known, during a drag, and on the separatrix."""
        if self.is_preview or self.map is None:
            return None
        if not has_flint():
            return ProvedStatement("", "Proofs need python-flint: pip install 'hess-explorer[prove]'")
        return self.work.need(Task(proved_statement, self.I22, self.I23, self.h, self.f), preview=None)

    # ---- the pictures ------------------------------------------------------------------------------------------

    def orbit_columns(self) -> Columns:
        """Return the columns of the orbit and of the moving points in the other pictures."""
        found, start = self.track, self.track.phi
        if self.map is not None and self.iterates is not None:
            start = torus_plane.phases_at_returns(found, self.map, self.iterates)
        return torus_plane.track_columns(
            found,
            phi_start=start,
            sigma=torus_density.phases(found, self.map),
            h=np.full(found.n3.size, self.h),
            reach=math.copysign(1.0, self.f) * reach(self.h, found.n3),
        )

    def heights(self) -> list[Circle]:
        """Return the circles that bound n3, and the proved enclosure of γ."""
        ends = (-1.0, 1.0) if self.turning_points is None else self.turning_points.roots[1:]
        return [*parallels(self.body.n3, ends), *self.orbit_proof.circles]

    def colours(self, cells: tuple[int, int], level: Level) -> Task[Array]:
        """Return a task that computes the rotation number over the diagram."""
        axes = diagram.window(self.h)
        return Task(rotation_number_window, self.body.a, axes.x, axes.y, level, cells)

    @cached_property
    def rotation(self) -> CellGrid:
        """The rotation number over the diagram."""
        axes, plan = diagram.window(self.h), self.plan(Kind.COLOURS, steady=True)
        task = self.colours(affordable_cells(self.body.a, plan.grid(CELLS)), plan.level)
        return CellGrid(self.work.need(task), axes.x, axes.y)

    # ---- texts --------------------------------------------------------------------------------------------------

    def quantities(self) -> Iterator[str]:
        """Yield a, b, derived data of the body, the integrals in its units, the period, the proved statement and ζ."""
        body = self.body
        yield f"a = I₂₃/I₂₂ = {digits(body.a)}"
        yield f"b = {digits(body.b)}"
        yield f"I₁₁ = {digits(body.I11)}"
        yield f"b₂ = {digits(body.b2)}"
        yield f"E = I₁₁ b h = {digits(body.I11 * body.b * self.h)}"
        yield f"F₂ = I₁₁ √b f = {digits(body.I11 * body.frequency_unit * self.f)}"
        yield f"A rigid body? {'yes' if body.check.is_body else 'no: |a| ≥ 1'}"
        if body.check.I33 is not None:
            yield f"I₃₃ from {digits(body.check.I33[0])} to {digits(body.check.I33[1])}"
        if self.map is not None:
            yield f"Period of n₃ = {digits(self.map.period / body.frequency_unit)}"
            if self.peek("proof") and self.proof is not None:
                yield self.proof.sentence
            if self.map.kind == "elliptic":
                yield f"ζ of the invariant density = {digits(invariant_measure(self.map).zeta)}"

    def status(self) -> Iterator[str]:
        """Yield the status of the orbit and of the circle map."""
        if self.peek("track"):
            yield from orbit_status(self.track.orbit)
            yield from self.orbit_proof.status()
        if self.map is None:
            yield "circle map: separatrix, no return"
        else:
            yield f"circle map {self.map.cost.steps} steps, error ≤ {self.map.error_estimate:.1e} ({self.map.status})"

    def notes(self) -> Iterator[str]:
        """Yield warnings: not a rigid body, a truncated orbit, an angle that jumps."""
        if not self.body.check.is_body:
            yield self.body.check.sentence
        shown = float(self.track.times[-1]) if self.peek("track") else math.inf
        if shown < self.span * (1 - 1e-9):
            reason = "after that no movement is visible" if self.map is None else f"{MAX_RETURNS} returns"
            yield f"The orbit is shown up to t = {digits(shown)}: {reason}."
        if self.f == 0.0 and self.map is not None and self.h < 1.0:
            yield "At f = 0, h < 1 the angle φ jumps where w = 0: the circle map is its limit f → 0."


_MEASURES: tuple[Trial[SuslovHess], ...] = (
    Trial(
        Kind.MAP,
        ("circle",),
        lambda s, plan: circle_map(s.body.a, s.h, s.f, plan.level).theta(_PHASES),
        lambda s, theta, truth: curve_error(theta, truth, 2.0 * math.pi, period=2.0 * math.pi),
    ),
    Trial(
        Kind.COLOURS,
        ("bifurcation",),
        lambda s, plan: s.colours(affordable_cells(s.body.a, plan.grid(CELLS)), plan.level).compute(),
        lambda s, found, truth: colour_error(found, truth),
        COLOUR_UNIT,
        "cells",
    ),
    Trial(
        Kind.CURVE,
        ("bifurcation",),
        lambda s, plan: tongue_boundary(s.body.a, plan.level, plan.side(_ON_BOUNDARY)),
        lambda s, found, truth: boundary_error(found, truth, diagram.window(s.h)),
    ),
)

SCENE = Scene(
    SuslovHess,
    __file__,
    place=1,
    presets=PRESETS,
    level_trials=_MEASURES,
    charts=Charts(torus_charts(lambda s: (s.body.a, s.h, s.f)), over=("h", "f")),
    swarm=hess_case.torus_swarm(lambda s: (s.body, s.h, s.f, s.phi0, s.map)),
    group="Heavy body",
    essential=("h", "f", "I23", "phi0"),
    handle="bifurcation/here",
    answers=(
        Answer("On the separatrix the body climbs forever and never comes back.", lambda s: s.map is None),
        Answer(
            "On this edge the torus shrinks to a circle: the height of the body is constant.",
            lambda s: torus_plane.is_circle(s.turning_points),
        ),
        Answer(
            "Two loops: every start ends on the green one, except the dashed loop itself.",
            lambda s: s.kind == "hyperbolic",
        ),
        hess_case.CYCLES_MERGE,
        Answer("No loop attracts: every orbit winds around the torus forever."),
    ),
    lead=("bifurcation", "omega", "sphere", "circle"),
    title="The Suslov–Hess case",
    summary="A heavy rigid body with ω₃ = 0 whose motions live on tori: rotation, locking, limit cycles.",
    tracks={"orbit": SuslovHess.orbit_columns, **hess_case.CYCLE_TRACKS},
    angles=("phi", "phi_start", "sigma"),
    views=(
        body_picture(section=True),
        picture(
            lambda s: torus_plane.caption(s.map, s.turning_points),
            lambda s: s.half_width,
            torus_plane.layers(
                lambda s: annulus(s.body, s.h, s.turning_points),
                lambda s: s.half_width,
                proved=lambda s: s.orbit_proof.band,
            ),
        ),
        Sphere(
            caption=lambda s: torus_plane.heights_caption(s.turning_points),
            circles=SuslovHess.heights,
            axis=lambda s: Direction(s.body.n3, "n₃"),
            looks={one: one for one in ("orbit", "stable", "unstable")},
        ),
        Plot(
            name="bifurcation",
            title="Bifurcation diagram",
            axes=("h", "f"),
            caption=lambda s: diagram.caption(s.h, s.f, s.map),
            dot=("h", "reach"),
            point=diagram.REACH,
            x=lambda s: diagram.window(s.h).x,
            y=lambda s: diagram.window(s.h).y,
            on_click=lambda s, x, y: {"h": x, "f": y},
            on_drag="here",
            on_hover=lambda s, h, f: diagram.torus_tooltip(s.body.a, h, f),
            layers=diagram.layers(
                rotation=lambda s: s.rotation,
                boundary=lambda s: s.tongue_boundary,
                curve=lambda s: s.edge,
                here=lambda s: [(s.h, s.f)],
                axes=lambda s: diagram.window(s.h),
            ),
        ),
        circle.picture(
            map=lambda s: s.map,
            iterates=lambda s: s.iterates,
            caption=lambda s: circle.caption(s.map, "" if s.proof is None else s.proof.badge),
            dot=("phi_start", "phi"),
            on_click=lambda s, x, y: {"phi0": x},
        ),
        surface_picture(lambda s: s.surface),
        torus_density.picture(lambda s: s.density),
    ),
)
