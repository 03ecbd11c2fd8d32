"""Attractors of a section γ₃ = 0 over a parameter, and one orbit; base of two scenes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values, points_text
from hess_explorer.scenes.framework.charted import Charts, ChartSource, parameters_of
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.periodic_search import NONE, ClosedOrbit
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, constrained_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.windows import box_window
from hess_explorer.scenes.parts.diagrams.controls import (
    BACKWARD,
    BOUNDS,
    COORDINATES,
    FALLING,
    RISING,
    DiagramControls,
)
from hess_explorer.scenes.parts.diagrams.diagram_density import DiagramDensity
from hess_explorer.scenes.parts.diagrams.growing_diagram import DiagramBranch, OrbitDiagram
from hess_explorer.scenes.parts.orbits.proof import OrbitProof
from hess_explorer.scenes.parts.orbits.regime import OrbitRegime, distinct_points
from hess_explorer.scenes.parts.sections import BodyOrbit
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import axis_about_0, time_graph
from hess_explorer.views.layers import Axes, curves, dots, levels, names, points
from hess_explorer.views.maps import branch
from hess_explorer.views.picture import Picture
from hess_explorer.views.plane import density, layered_section, periodic
from hess_explorer.views.plane.velocity_plane import half_width_for, orbit_columns, pixels_per_unit
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import centre_of_mass, orbit_sphere
from hess_explorer.views.text import digits
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.dynamics.orbit_diagram import Cascade
from hess_mechanics.dynamics.periodic import PeriodicOrbit
from hess_mechanics.numerics.results import Array, SectionCrossings
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.rigid_body.reversal import rate, reversals
from hess_mechanics.suslov.equations import SuslovBody

_WINDOW = ((-math.pi, 0.0), (math.pi, math.pi))
_TOP, _LINE = 0.06, 0.07
"""Distance of the first name of a doubling from the top, and of one name from the next, in heights of the picture."""


@dataclass(frozen=True)
class DiagramState(DiagramControls):
    """Attractors of a section over one parameter, and one orbit at the current value of that parameter."""

    @property
    def body(self) -> SuslovBody | BallBody:
        """The body.  Raises `ModelError`."""
        return self.poincare.body

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels per unit of each variable, with room for all motions of this energy."""
        I11, I22, *_, b1, b2, b3 = self.body.parameters
        highest = self.poincare.E + math.hypot(b1, b2, b3)
        return pixels_per_unit(half_width_for(math.sqrt(2.0 * highest / min(I11, I22))))

    @property
    def start(self) -> Start:
        """The initial state (d,) of the orbit, on the periodic orbit if its branch is shown."""
        return self.diagram.start if self.closed_orbit is None else self.closed_orbit.state

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The periodic orbit; None if none is requested or known."""
        return None if self.branch == NONE else self.continuation.closed_orbit

    @property
    def duration(self) -> float:
        """The duration of the orbit."""
        return self.span

    def motion(self) -> Motion:
        """Return the motion of the orbit."""
        return self.orbit.motion()

    diagram = part(OrbitDiagram)
    density = part(lambda s: DiagramDensity(s.diagram))
    continuation = part(lambda s: DiagramBranch(s.diagram, s.branch))
    orbit = part(BodyOrbit)
    proof = part(lambda s: OrbitProof(s.orbit, s.certain))
    regime = part(lambda s: OrbitRegime(s.diagram, s.long))

    # ---- the pictures -------------------------------------------------------------------------------------------

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit.path)

    @cached_property
    def reversals(self) -> SectionCrossings:
        """The crossings of 0 by the rotation about the vertical, at which it reverses."""
        return self.work.need(Task(reversals, self.body, self.start, self.span, self.level))

    @cached_property
    def vertical_rate(self) -> Array:
        """The rotation about the vertical, (ω, γ), along the orbit (n,)."""
        return rate(self.orbit.path.states)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameter value and the orbit at (x, y): of the branch if it is near, otherwise of the diagram."""
        found = self.continuation.orbit_at(x, y)
        if found is None:
            return self.diagram.choose(x, y)
        value, point, period = found
        return {self.diagram.name: value, "chosen": points_text([point]), "branch": f"period {period}"}

    def start_at(self, x: float, y: float) -> Values:
        """Return the parameter values of an orbit that starts at a point of the section."""
        return {"chosen": points_text([(x, min(max(y, 1e-6), math.pi - 1e-6))])}

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_diagram(self) -> Caption:
        if self.branch == NONE:
            return self.diagram.caption(self.density.phrase)
        found = self.continuation.caption
        return replace(found, numbers=f"{self.density.phrase}{found.numbers}".rstrip())

    def _about_turning(self) -> Caption:
        times = self.reversals.times
        if not len(times):
            return Caption("The rotation does not reverse.")
        many = "once" if len(times) == 1 else f"{len(times)} times"
        first, error = digits(float(times[0])), digits(self.reversals.error_estimate, 1)
        return Caption(f"The rotation reverses {many}.", f"First at t = {first} ± {error}.")

    def quantities(self) -> list[str]:
        """Return the energy, the chosen point, the bifurcations of the branch and the check of the body."""
        psi, delta = map(digits, self.diagram.point)
        return [
            f"E = {digits(self.poincare.E)}",
            f"chosen: ψ = {psi}, δ = {delta}",
            *super().quantities(),
            check_body(*self.body.parameters[:4]).sentence,
        ]


S = TypeVar("S", bound=DiagramState)


def _upright(values: Iterable[float], axes: Axes) -> list[Array]:
    return [np.array([[x, axes.y[0]], [x, axes.y[1]]]) for x in values]


def _flip_values(s: DiagramState, axes: Axes) -> list[tuple[float, float, str]]:
    located, (low, high) = s.diagram.cascade, axes.y
    if not isinstance(located, Cascade):
        return []
    # Stack the labels, because the doublings accumulate and labels at one height would overlap.
    heights = high - (high - low) * (_TOP + _LINE * np.arange(len(located.values)))
    return [
        (float(x), float(y), f"{m}→{2 * m}: {digits(float(x))}")
        for x, y, m in zip(located.values, heights, located.periods, strict=True)
        if axes.x[0] < x < axes.x[1]
    ]


def diagram_scene(
    state: type[S], module: str, presets: tuple[Preset, ...], section: ChartSource, ball: bool = False, **words: Any
) -> Scene[S]:
    """Return the scene of an orbit diagram.

    Parameters
    ----------
    state : type
        Class of its states.
    module : str
        File that declares the scene.
    presets : tuple of Preset
        Named states.
    section : ChartSource
        Charted computation: the regime of the motions in the section.
    ball : bool
        True for a ball, which is drawn instead of a body.
    **words
        Other arguments of `Scene`.
    """
    return Scene(
        state,
        module,
        presets=presets,
        charts=Charts((section,), over=("h", "I13")),
        swarm=turned_swarm(),
        tracks={"orbit": lambda s: orbit_columns(s.orbit.path, turning=s.vertical_rate)},
        views=_pictures(state, ball),
        **words,
    )


def regime_in(section: str, **more: float) -> ChartSource:
    """Return the charted regime of the motion in a section of the catalogue; `more` are further arguments."""

    def arguments(s: DiagramState) -> Mapping[str, float]:
        psi, delta = s.diagram.point
        return {**parameters_of(s.body), "h": s.h, "psi": psi, "delta": delta, **more}

    return ChartSource(f"regime {section}", arguments)


def _pictures(state: type[DiagramState], ball: bool) -> tuple[Picture[Any], ...]:
    """Return the pictures: diagram with branch, body, section, reversal, and a Poisson sphere with a button."""

    def closed(s: DiagramState) -> list[PeriodicOrbit]:
        return [] if s.closed_orbit is None else [s.closed_orbit.orbit]

    def dotted(way: str) -> Callable[[DiagramState], Array | None]:
        return lambda s: None if s.density.tones else s.diagram.points(way)

    return (
        Plot[DiagramState](
            name="diagram",
            title="Orbit diagram",
            caption=DiagramState._about_diagram,
            on_hover=lambda s, x, y: s.continuation.tooltip(x, y),
            on_click=DiagramState.choose,
            axes=lambda s: (s.along, s.shown),
            first=Axes((state.first, state.last), (-math.pi, math.pi)),
            x=lambda s: (s.diagram.frame[0][0], s.diagram.frame[1][0]),
            y=lambda s: s.diagram.height,
            on_box=lambda s, corners: box_window(corners, BOUNDS),
            layers=(
                *density.layers(
                    lambda s: s.density.tones,
                    lambda s: s.diagram.frame,
                    (
                        "backward in time",
                        "forward, parameter falling, where different",
                        "forward in time, few to many points",
                    ),
                    (theme.UNSTABLE, theme.MAP, theme.ORBIT),
                ),
                curves(
                    "flips",
                    data_in_axes=lambda s, axes: _upright(s.diagram.flips, axes),
                    color=theme.STABLE,
                    width=1.5,
                    dash="dashed",
                    label="period doubling",
                ),
                dots("backward", dotted(BACKWARD), color=theme.UNSTABLE, size=3, label="backward in time"),
                dots("falling", dotted(FALLING), color=theme.MAP, size=5, label="forward, parameter falling"),
                dots("rising", dotted(RISING), color=theme.ORBIT, size=3, label="forward, parameter rising"),
                curves(
                    "here",
                    data_in_axes=lambda s, axes: _upright([s.diagram.value], axes),
                    color=theme.INK,
                    width=1.5,
                    label="current state",
                    tag="current state",
                ),
                *branch.layers(lambda s: s.continuation),
                names("flip-values", data_in_axes=_flip_values, size=13, on_paper=True),
            ),
        ),
        body_picture(ball=ball),
        Plot[DiagramState](
            name="section",
            title="Section γ₃ = 0 (upward crossings)",
            caption=lambda s: s.regime.caption,
            axes=COORDINATES,
            x=(-math.pi, math.pi),
            y=(0.0, math.pi),
            on_click=DiagramState.start_at,
            starts=True,
            layers=(
                *layered_section.layers(
                    lambda s: s.regime.sets[0],
                    lambda s: s.regime.sets[1],
                    lambda s: [],
                    chosen=lambda s: [s.diagram.point],
                    window=lambda s: _WINDOW,
                    forbidden_cells=lambda s: s.poincare.forbidden_cells(_WINDOW),
                    labels=("attractor", "repeller"),
                ),
                points("few", lambda s: distinct_points(s.regime.sets[0]), color=theme.ORBIT, size=9),
                *periodic.orbit_points(closed),
                points("few-repelling", lambda s: distinct_points(s.regime.sets[1]), color=theme.UNSTABLE, size=9),
            ),
        ),
        Plot[DiagramState](
            name="reversal",
            title="Rotation about the vertical, (ω, γ)",
            caption=DiagramState._about_turning,
            axes=("t", "(ω, γ)"),
            dot=("t", "turning"),
            first=Axes((0.0, 60.0), (-2.0, 2.0)),
            x=lambda s: (0.0, s.span),
            y=lambda s: axis_about_0(s.vertical_rate, 1e-6),
            layers=(
                levels("levels", lambda s: [0.0]),
                time_graph(
                    "turning",
                    lambda s: (s.orbit.path.times, s.vertical_rate),
                    color=theme.ORBIT,
                    label="(ω, γ) of the chosen orbit",
                ),
                points(
                    "moments",
                    lambda s: (s.reversals.times, np.zeros(len(s.reversals.times))),
                    color=theme.UNSTABLE,
                    size=11,
                    hollow=True,
                    edge_width=2.5,
                    label="moments of reversal",
                ),
            ),
        ),
        replace(
            orbit_sphere(lambda s: centre_of_mass(s.body.parameters[-3:]), lambda s: s.proof.circles),
            button="Show the Poisson sphere",
        ),
    )
