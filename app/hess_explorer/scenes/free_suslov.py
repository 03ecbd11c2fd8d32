"""The free Suslov problem: passages from the unstable to the stable half of a line of equilibria."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework import free_body
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, ChartSource, tensor_of
from hess_explorer.scenes.framework.circle_left import Gamma_picture
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import ONE_TURN, Slider, accuracy_level, choice, parameter, time_span
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, constrained_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import branches, time_graph
from hess_explorer.views.layers import Columns, Sign, arrows, curves, line, text
from hess_explorer.views.plane import velocity_plane as plane
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Circle, Direction, Sphere, ends
from hess_explorer.views.text import digits, vector
from hess_mechanics import parameters as known
from hess_mechanics.dynamics.sampling import MOST_SAMPLES, PIXELS
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov import free
from hess_mechanics.suslov.additional_integral import AdditionalIntegral, integral_of
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody

_LEVELS = (0.25, 0.6, 1.6)
"""Energies of the other ellipses, relative to the energy of the orbit."""
_ON_THE_WAY = 4
"""Number of F2 circles between the two limit circles: more would hide the orbits."""
_ROOM_BELOW = (-1.25, 1.05)
"""Range of the axis of γ₁, with room at the bottom for the name of the other axis."""

# The caption of the figure gives tan φ = 0.85/0.28 and 0.53/0.72.
_ON_CIRCLE: Values = {"w1": 2.0, "w2": 1e-3, "Gamma": -0.44, "phi": 1.2526, "phi2": 0.6346}
_OBLIQUE: Values = {"I13": 0.2, "I23": 0.3, "k": 1.2, "w1": 3.0, "w2": -2.001}


def _portrait(I13: float, I23: float) -> Values:
    """Return a start near the unstable half line with direction (I23, −I13)."""
    return {
        "I13": I13,
        "I23": I23,
        "k": 1.0,
        "w1": math.copysign(1.4, I23),
        "w2": math.copysign(0.9, -I13),
        "Gamma": 0.7,
        "phi": 0.5,
        "span": 20.0,
    }


PRESETS = (
    Preset("γ₁(t): I₁₁ = 2.44, I₂₃ = 0.5 (figure 2)", across="time"),
    Preset("γ₁(φ): the same orbit (figure 2)", across="phase"),
    Preset("Γ(t), k = 1: F₂ exists, Γ⁺ = −Γ⁻ (figure 3)", **_ON_CIRCLE, k=1.0),
    Preset("Γ(t), k = 3: F₂ exists, Γ⁺ = −Γ⁻ (figure 3)", **_ON_CIRCLE, k=3.0),
    Preset("Γ(t), k = 1.5: two phases, two circles (figure 3)", **_ON_CIRCLE, k=1.5),
    Preset(
        "Γ(t), I₁₃ ≠ 0: two phases, two circles (figure 3)", **_OBLIQUE, Gamma=-0.4687, phi=math.pi, phi2=math.pi / 2
    ),
    Preset(
        "Second orbit as printed, γ₁(0) = −0.49: another circle (figure 3)",
        **_OBLIQUE,
        Gamma=-0.5306,
        phi=1.6337,
        phi2=math.pi,
    ),
    Preset("Portrait, I₁₃ > 0, I₂₃ < 0 (figure 1)", **_portrait(0.2, -0.25)),
    Preset("Portrait, I₁₃ > 0, I₂₃ > 0", **_portrait(0.2, 0.25)),
    Preset("Portrait, I₁₃ < 0, I₂₃ < 0", **_portrait(-0.2, -0.25)),
    Preset("Portrait, I₁₃ < 0, I₂₃ > 0", **_portrait(-0.2, 0.25)),
    Preset("Started 1e-300 from the line", w2=1e-300, span=750.0),
)


@dataclass(frozen=True)
class FreeSuslov(State):
    """Two orbits that start on the same circle of γ."""

    I22: float = parameter(free_body.I22)
    I13: float = parameter(free_body.I13)
    I23: float = parameter(free_body.I23)
    k: float = parameter(known.K_DRIVES_I11)
    w1: float = parameter(known.W1, 2.0)
    w2: float = parameter(
        known.W2, 1e-4, doc="Value at t = 0. The start may be as close as 1e-300 to the line of equilibria."
    )
    Gamma: float = parameter(known.GAMMA_CIRCLE)
    phi: float = parameter(known.CIRCLE_PHASE, 1.2672, label="Phase φ(0)", bounds=ONE_TURN)
    phi2: float = parameter(
        known.CIRCLE_PHASE,
        -0.6,
        symbol="φ′",
        label="Phase of the second orbit",
        bounds=ONE_TURN,
        doc="The second orbit has the same ω and leaves the same circle, rotated along the circle by φ′ − φ.",
    )
    span: float = time_span(30.0, 100.0, most=1e5)
    across: str = choice("γ₁ against", ("time", "phase"), "time", doc="Horizontal axis of the picture of γ₁: t or φ.")
    accuracy: str = accuracy_level()

    def limits(self) -> Mapping[str, Slider]:
        """Return the slider range of k, with I11 > 0."""
        return free_body.limits_of_k(self.I22, self.I13, self.I23)

    @cached_property
    def body(self) -> SuslovBody:
        """The body.  Raises `NotPositiveDefinite`, `InvalidParameter`."""
        return free_body.free_body(self.k, self.I22, self.I13, self.I23)

    @property
    def omega(self) -> tuple[float, float]:
        """The initial angular velocity (ω1, ω2)."""
        return self.w1, self.w2

    @cached_property
    def passage(self) -> free.Passage:
        """The passage of ω through its initial value.  Raises `InvalidParameter`, `WorkLimit`."""
        return free.passage(self.body, self.omega)

    @cached_property
    def h(self) -> float:
        """The energy.  Raises `InvalidParameter`, `WorkLimit`; messages name ω, because the energy has no control."""
        h = 0.5 * (self.body.I11 * self.w1**2 + self.body.I22 * self.w2**2) if self.passage.rate else 0.0
        if h == 0.0:
            raise InvalidParameter("|ω| is so small that the energy is 0 in double precision: choose a larger ω.")
        return h

    @cached_property
    def points(self) -> free.Equilibria:
        """The equilibria with the energy of the orbit."""
        return free.equilibria(self.body, self.h)

    @cached_property
    def arcs(self) -> tuple[Array, Array]:
        """The two arcs from the unstable to the stable equilibrium."""
        return free.arcs(self.body, self.h)

    @cached_property
    def half_width(self) -> float:
        """Half width of the (ω1, ω2)-plane."""
        return plane.round_up(1.3 * math.sqrt(2.0 * self.h / min(self.body.I11, self.body.I22)))

    @cached_property
    def gamma(self) -> tuple[float, float, float]:
        """The initial vertical."""
        return self.points.gamma(self.Gamma, self.phi)

    def _motion(self, gamma: tuple[float, float, float]) -> free.FreeMotion:
        radius = 0.5 * PIXELS
        return self.work.need(
            Task(
                free.sampled_motion,
                self.body,
                self.omega,
                gamma,
                self.span,
                (radius / self.half_width, radius),
                self.level,
            )
        )

    @cached_property
    def orbit(self) -> free.FreeMotion:
        """The chosen orbit."""
        return self._motion(self.gamma)

    @cached_property
    def second(self) -> free.FreeMotion:
        """The second orbit."""
        return self._motion(
            self.work.need(
                Task(free.rotation_along_circle, self.body, self.omega, self.gamma, self.phi2 - self.phi, self.level)
            )
        )

    @cached_property
    def F2(self) -> tuple[AdditionalIntegral, float] | None:
        """The additional integral and its value on the orbit; None if none is known."""
        found = integral_of(self.body)
        return None if found is None else (found, float(found(np.array(self.omega), np.array(self.gamma))))

    def motion(self) -> Motion:
        """Return the orbit as a motion of the general system."""
        return Motion(
            SYSTEM, (*self.omega, *self.gamma), self.body.parameters, self.span, plane.pixels_per_unit(self.half_width)
        )

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return constrained_solid(self.work, self.body, self.orbit)

    # ---- the pictures ------------------------------------------------------------------------------------------

    def orbit_columns(self) -> Columns:
        """Return the columns of the orbit and of the moving points in the other pictures."""
        found = self.orbit
        return plane.velocity_columns(
            found.times,
            found.omega,
            found.gamma,
            Gamma=found.Gamma,
            across=found.phase if self.across == "phase" else found.times,
        )

    def ellipses(self) -> list[Array]:
        """Return the arcs at some other energies."""
        return [math.sqrt(share) * arc for share in _LEVELS for arc in self.arcs]

    def circles(self) -> list[Circle]:
        """Return the initial and final limit circles, and the level of F2 between them."""
        xi, limits = self.points.xi, self.orbit.limits
        found = [
            Circle(xi, limits[0], "unstable"),
            Circle(xi, limits[1], "stable"),
            Circle(xi, self.second.limits[1], "stable"),
        ]
        if self.F2 is not None:
            integral, f = self.F2
            arc = self.arcs[0 if self.passage.arc > 0 else 1]
            on_the_way = arc[np.linspace(0, len(arc) - 1, _ON_THE_WAY + 2).astype(int)[1:-1]]
            found += [Circle(*integral.circle(omega, f), "muted") for omega in on_the_way]
        return found

    def gamma1(self, one: free.FreeMotion) -> list[Array]:
        """Return γ1 of an orbit over time or phase."""
        if self.across == "phase":
            return branches(one.phase, one.gamma[:, 0], 2.0 * math.pi)
        return [np.column_stack([one.times, one.gamma[:, 0]])]

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_velocity(self) -> Caption:
        return Caption(
            "ω goes from the unstable to the stable point.",
            f"Rate ω₀ = {digits(self.points.rate)}, E = {digits(self.h)}.",
        )

    def _about_sphere(self) -> Caption:
        came, went, other = map(digits, (*self.orbit.limits, self.second.limits[1]))
        if self.F2 is None:
            return Caption("Both orbits leave one circle about ξ.", f"From Γ⁻ = {came} to Γ⁺ = {went} and {other}.")
        return Caption(
            "Both orbits go from C⁻ to C⁺.", f"F₂ = {digits(self.F2[1])}; Γ = {came} on C⁻, Γ = {went} on C⁺."
        )

    def _about_gamma1(self) -> Caption:
        return Caption(
            "In the end γ rotates uniformly about ξ.", f"At {digits(self.points.speed)} radians per unit of time."
        )

    def _about_Gamma(self) -> Caption:
        came, went, other = map(digits, (*self.orbit.limits, self.second.limits[1]))
        return Caption("Γ tends to a constant.", f"From Γ⁻ = {came} to Γ⁺ = {went} and {other} (dotted).")

    def quantities(self) -> Iterator[str]:
        """Yield I11 and k², the energy, the rate, the directions and F2."""
        points = self.points
        yield from free_body.derived_quantities(self.k, self.body)
        yield f"E = {digits(self.h)}"
        yield f"ω₀ = {digits(points.rate)}"
        yield f"|ω±| = {digits(points.speed)}"
        yield f"ξ = {vector(points.xi)}"
        if self.F2 is None:
            yield "F₂: none known (known for odd k ≤ 15 if I₁₃ = 0 or I₂₃ = 0)"
        else:
            integral, f = self.F2
            yield f"F₂, degree {integral.k} in ω: f = {digits(f)}"
            yield f"F₂ at the fixed points: ±{digits(abs(integral.at_fixed_points(self.h)))}"

    def status(self) -> Iterator[str]:
        """Yield the status of the orbit."""
        if self.peek("orbit"):
            yield from orbit_status(self.orbit)

    def notes(self) -> Iterator[str]:
        """Yield warnings: a curve with too few points, a passage after the time span."""
        if self.peek("orbit") and self.orbit.times.size >= MOST_SAMPLES:
            yield f"This long motion is drawn with only {MOST_SAMPLES} points: choose a shorter time span for details."
        needed = -self.passage.u0 / self.points.rate
        if needed > self.span:
            yield f"The passage comes at t = {digits(needed)}: choose a longer time span to see it."


SCENE = Scene(
    FreeSuslov,
    __file__,
    place=2,
    presets=PRESETS,
    charts=Charts((ChartSource("cos-chi", lambda s: tensor_of(s.body)),), over=("k", "I23")),
    group="Free body",
    essential=("k", "I23", "Gamma", "phi"),
    answers=(
        Answer("A complete reversal: γ leaves one circle and ends on its mirror image.", lambda s: s.F2 is not None),
        Answer("No friction, yet at this energy every start but the orange one ends at the green point."),
    ),
    title="Free Suslov problem",
    summary="No field: ω passes from an unstable to a stable state; γ leaves one circle and joins another.",
    swarm=turned_swarm(),
    tracks={
        "orbit": FreeSuslov.orbit_columns,
        "second": lambda s: plane.velocity_columns(None, s.second.omega, s.second.gamma),
    },
    angles=("across",),
    views=(
        plane.picture(
            FreeSuslov._about_velocity,
            lambda s: s.half_width,
            on_click=lambda s, x, y: {"w1": x, "w2": y},
            layers=(
                *plane.energy_levels(FreeSuslov.ellipses, lambda s: s.half_width, "energy levels; level of F₂"),
                plane.arcs(lambda s: s.arcs),
                *plane.half_lines(
                    lambda s, axes: plane.half_line(s.points.stable, s.half_width, axes),
                    lambda s, axes: plane.half_line(s.points.unstable, s.half_width, axes),
                    ("stable half, limit circle for t → ∞", "unstable half, limit circle for t → −∞"),
                ),
                line(
                    "second",
                    track="second",
                    columns=("omega1", "omega2"),
                    color=theme.MAP,
                    dash="dotdash",
                    label="second orbit",
                    tag="second orbit",
                ),
                plane.orbit("orbit"),
                arrows("arrows", lambda s: plane.arrows_on(s.arcs, s.half_width), color=theme.ORBIT, alpha=0.8),
                *plane.equilibria(lambda s: s.points.stable, lambda s: s.points.unstable),
            ),
        ),
        body_picture(field=False),
        Sphere(
            caption=FreeSuslov._about_sphere,
            looks={"orbit": "orbit", "second": "second"},
            axis=lambda s: Direction(s.points.xi, "ξ"),
            circles=FreeSuslov.circles,
            marks=lambda s: ends(s.points.xi),
            signs=(Sign("fixed points Γ = ±1", "dot", f"background: {theme.MUTED}"),),
        ),
        Plot(
            name="gamma1",
            caption=FreeSuslov._about_gamma1,
            axes=(" ", "γ₁"),
            dot=("across", "g1"),
            title=lambda s: f"γ₁ against {'phase φ about ξ' if s.across == 'phase' else 'time'}",
            x=lambda s: plane.symmetric_range(math.pi) if s.across == "phase" else (0.0, s.span),
            y=_ROOM_BELOW,
            layers=(
                curves("second", lambda s: s.gamma1(s.second), color=theme.MAP, dash="dotdash", tag="second orbit"),
                curves("first", lambda s: s.gamma1(s.orbit), color=theme.ORBIT, tag="orbit"),
                text("across", lambda s: "φ" if s.across == "phase" else "t"),
            ),
        ),
        Gamma_picture(
            FreeSuslov._about_Gamma,
            lambda s: [*s.orbit.limits, s.second.limits[1]],
            lambda s: (s.orbit.times, s.orbit.Gamma),
            time_graph(
                "second",
                lambda s: (s.second.times, s.second.Gamma),
                color=theme.MAP,
                dash="dotdash",
                tag="second orbit",
            ),
        ),
    ),
)
