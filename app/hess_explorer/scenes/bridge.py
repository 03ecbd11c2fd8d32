"""The bridge: one motion of the Suslov–Hess case and its translation to Euler–Poisson, side by side."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework import hess_case
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, torus_charts
from hess_explorer.scenes.framework.hess_case import HeavyHess
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import (
    Slider,
    accuracy_level,
    choice,
    number,
    parameter,
    slider_within,
    time_span,
)
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, heavy_solid, hess_solid
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.chart import LG_OF_0, lg, lg_axis
from hess_explorer.views.graphs.graph import time_graph
from hess_explorer.views.layers import Columns
from hess_explorer.views.maps import circle_map as circle
from hess_explorer.views.plane import andoyer, torus_plane
from hess_explorer.views.plane.velocity_plane import picture, round_up
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, range_text
from hess_mechanics import parameters as known
from hess_mechanics.euler_poisson.andoyer import coordinates, hess_circle
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge, largest_distance, share_of
from hess_mechanics.euler_poisson.hess_manifold import SuslovDistance, difference
from hess_mechanics.numerics.accuracy import DRAFT
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, f_max, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.torus import MAX_RETURNS, Track, annulus, track

SUSLOV, HEAVY = "Suslov–Hess", "Euler–Poisson"
_IN_A_PERIOD = 40
_MOST_PERIODS = 200
_IN_A_DRAG = 30
"""Largest number of periods over which the difference is computed: at rest, and while a slider is held."""
_MOST_GROWTH = 3000.0
"""Bound on the growth of ln |r·M| over the computed time, because the cost grows with |a|."""
_BOTTOM = -1.0 + 1e-9

PRESETS = (
    Preset("Figure 11, given in Euler–Poisson", given=HEAVY),
    Preset("Two limit cycles, given in Suslov–Hess", given=SUSLOV, h=1.5, f=0.6),
    Preset("No cycles, given in Suslov–Hess", given=SUSLOV, h=0.2, f=0.5),
    Preset("f = 0: loxodromic pendulum", given=HEAVY, h=20.0, f=0.0),
    Preset("f = 0: oscillation below the separatrix", given=HEAVY, h=5.0, f=0.0),
    Preset("Body of figure 14, f = 1", given=HEAVY, **hess_case.RIS, h=2.0, f=1.0),
)


def _without_round_off(value: float) -> float:
    """Round a number that was translated there and back: 5.000000000000001 becomes 5."""
    short = float(f"{value:.12g}")
    return short if math.isclose(short, value, rel_tol=1e-14) else value


@dataclass(frozen=True)
class BothSides(State):
    """A motion of the Suslov–Hess case and the same motion of Euler–Poisson."""

    given: str = choice(
        "Given in",
        (SUSLOV, HEAVY),
        HEAVY,
        group="State",
        doc="Side whose parameters and integrals the sliders set; the other sliders show the other body. A "
        "change of sides keeps the motion.",
    )
    I22: float = parameter(hess_case.I22)
    I23: float = parameter(hess_case.I23)
    b3: float = parameter(hess_case.B3)
    I1: float = parameter(known.I1)
    I2: float = parameter(known.I2)
    I3: float = parameter(known.I3)
    m: float = parameter(known.MU_R)
    h: float = parameter(
        known.H_HEAVY, doc="Energy of the given side: in units b = 1 for Suslov–Hess, H itself for Euler–Poisson."
    )
    f: float = parameter(
        known.F_HEAVY, doc="Area integral of the given side: in units b = 1 for Suslov–Hess, (M, γ) for Euler–Poisson."
    )
    phi0: float = parameter(hess_case.PHI0)
    share: float = number(
        "x",
        0.5,
        (0.01, 1.0),
        0.01,
        bounds=(1e-6, 1.0),
        label="Free moment, x",
        doc="Third moment of Euler–Poisson, which Suslov–Hess does not determine; x = 1 is a flat body if |a| < 1.",
    )
    span: float = time_span(50.0, 200.0, most=1e5, what="the motion of both sides")
    accuracy: str = accuracy_level()

    @cached_property
    def heavy(self) -> HeavyHess:
        """The Euler–Poisson motion of the parameters, for states given on that side."""
        return HeavyHess((self.I1, self.I2, self.I3), self.m, self.h, self.f)

    def valid_state(self, notes: list[str]) -> BothSides:
        """Clamp the parameters of the given side to a valid motion; append a note for each change."""
        if self.given == HEAVY:
            return self.with_values(self.heavy.corrections(notes))
        h = max(self.h, _BOTTOM)
        if self.h < _BOTTOM:
            notes.append("In units b = 1 the energy must exceed −1: h was set to its lowest value.")
        return replace(
            self, h=h, I23=hess_case.possible_I23(self.I22, self.I23, notes), f=hess_case.possible_f(h, self.f, notes)
        )

    def limits(self) -> Mapping[str, Slider]:
        """Return the slider ranges of the given side."""
        if self.given == HEAVY:
            return self.heavy.limits()
        f = {"f": slider_within(f_max(self.h))} if self.h > -1.0 else {}
        return {"h": (-0.99, max(4.0, self.h), 0.01), **f}

    def idle_values(self) -> Mapping[str, float]:
        """Return the parameters of the other side, translated from those of the given side.  Raises `ModelError`."""
        hess, heavy = self.bridge.hess, self.bridge.heavy
        if self.given == HEAVY:
            body = {"I22": hess.I22, "I23": hess.I23, "b3": hess.b3, "share": share_of(heavy)}
        else:
            body = {"m": heavy.mu, **{name: 1.0 / a for name, a in zip(("I1", "I2", "I3"), heavy.a, strict=True)}}
        return {name: _without_round_off(value) for name, value in body.items()}

    def meanings(self) -> Mapping[str, str]:
        """Return the meaning of h and f on the given side."""
        return dict.fromkeys("hf", (known.H_HEAVY if self.given == HEAVY else known.H_HESS).meaning)

    def adjustments(self, before: BothSides) -> Values:
        """Return the parameters of the same motion after a change of the given side.  Raises `ModelError`."""
        others = super().adjustments(before)
        if self.given == before.given:
            return others
        bridge = before.bridge
        translate = bridge.in_units_of_b if before.given == HEAVY else bridge.from_units_of_b
        h, f = map(_without_round_off, translate(before.h, before.f))
        shown = before.idle_values()
        # Units b = 1 hide the sign of b, and the slider of b₃ < 0 implies b > 0: for μ < 0 the vertical is reversed.
        return {**others, **shown, **({"b3": -abs(shown["b3"])} if "b3" in shown else {}), "h": h, "f": f}

    @cached_property
    def bridge(self) -> Bridge:
        """The Suslov body and the equivalent heavy body.  Raises `ModelError`."""
        if self.given == HEAVY:
            return self.heavy.bridge
        return Bridge.of_suslov(HessBody(self.I22, self.I23, self.b3), self.share)

    @cached_property
    def turning_points(self) -> TurningPoints:
        """The turning points of n3, with h and f in units b = 1.  Raises `ModelError`."""
        return self.heavy.turning_points if self.given == HEAVY else turning_points(self.h, self.f)

    @cached_property
    def map(self) -> CircleMap:
        """The circle map of the torus."""
        return self.work.need(
            Task(circle_map, self.bridge.hess.a, self.turning_points.h, self.turning_points.f, self.level)
        )

    @property
    def period(self) -> float:
        """The period of n3 in the body's own time unit."""
        return self.map.period / self.bridge.hess.frequency_unit

    def ring(self) -> tuple[Array, Array]:
        """Return the inner and the outer ellipse that bound ω."""
        return annulus(self.bridge.hess, self.map.h, self.turning_points)

    @cached_property
    def half_width(self) -> float:
        """Half width of the (ω1, ω2)-plane, with room for the ring and for the error at the level `draft`."""
        ring = 1.1 * float(np.max(np.abs(self.ring()[1])))
        return round_up(max(ring, 2.0 * DRAFT.promise * self.bridge.hess.frequency_unit))

    @cached_property
    def track(self) -> Track:
        """The orbit on the Suslov side."""
        return self.work.need(
            Task(
                track,
                self.bridge.hess,
                self.turning_points.h,
                self.turning_points.f,
                self.phi0,
                self.span,
                self.level,
                self.half_width,
            )
        )

    @cached_property
    def cycles(self) -> tuple[Track, Track] | None:
        """The stable and the unstable limit cycle; None without limit cycles."""
        return hess_case.limit_cycles(self.work, self.bridge.hess, self.map, self.level, self.half_width)

    @cached_property
    def iterates(self) -> Array:
        """φ0 and its iterates under the circle map, up to the end of the orbit, at most `MAX_RETURNS` of them."""
        returns = max(1, math.ceil(self.span * self.bridge.hess.frequency_unit / self.map.period))
        return self.map.iterate(self.phi0, min(returns, MAX_RETURNS))

    @cached_property
    def heavy_states(self) -> Array:
        """The states (n, 6) of the same motion in Euler–Poisson variables."""
        return self.bridge.from_suslov(np.hstack([self.track.omega, self.track.gamma]))

    @cached_property
    def andoyer(self) -> Array:
        """The Andoyer–Deprit variables (l, L/G) along the motion."""
        return coordinates(self.heavy_states)

    @cached_property
    def solids(self) -> tuple[Solid, Solid]:
        """Both bodies along the motion."""
        return (
            hess_solid(self.bridge.hess, self.track),
            heavy_solid(self.bridge.heavy, self.track.times, self.heavy_states),
        )

    @cached_property
    def difference(self) -> SuslovDistance:
        """The difference between the two sides, each integrated independently."""
        most = min(
            _IN_A_DRAG if self.is_preview else _MOST_PERIODS,
            _MOST_GROWTH / (1.0 + 2.0 * math.pi * abs(self.bridge.hess.a)),
        )
        end = min(self.span, most * self.period)
        start = tuple(self.turning_points.state_at_lower_turn(self.phi0).tolist())
        count = max(64, math.ceil(end / self.period * _IN_A_PERIOD)) + 1
        return self.work.need(Task(difference, self.bridge, start, end, count))

    def motion(self) -> Motion:
        """Return the reduced motion, common to both sides."""
        length = min(self.span * self.bridge.hess.frequency_unit, MAX_RETURNS * self.turning_points.period)
        return hess_case.reduced_motion(self.bridge.hess, self.turning_points, self.phi0, length)

    def orbit_columns(self) -> Columns:
        """Return the columns of the orbit and of the moving points in the other pictures."""
        found = self.track
        start = torus_plane.phases_at_returns(found, self.map, self.iterates)
        seen = self.peek("difference")
        apart = (
            np.full(found.times.size, LG_OF_0)
            if seen is None
            else np.interp(found.times, seen.times, lg(seen.constrained))
        )
        l, x = self.andoyer.T
        return torus_plane.track_columns(found, phi_start=start, l=l, x=x, apart=apart)

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_torus(self) -> Caption:
        h, f = digits(self.map.h), digits(self.map.f)
        width = range_text(self.turning_points.initial_rho, self.turning_points.final_rho)
        return Caption(numbers=f"h = {h}, f = {f} in units b = 1; |w| {width}.")

    def _about_andoyer(self) -> Caption:
        H, F1 = self.bridge.from_units_of_b(self.map.h, self.map.f)
        return Caption("The Hess relation holds along the orbit.", f"H = {digits(H)}, F₁ = {digits(F1)}.")

    def _about_difference(self) -> Caption:
        held, free = (digits(float(one.max()), 2) for one in (self.difference.constrained, self.difference.free))
        end = digits(float(self.difference.times[-1]))
        return Caption(numbers=f"At most {held} up to t = {end} if r·M = 0 is imposed; {free} if not.")

    def quantities(self) -> Iterator[str]:
        """Yield the data of both bodies and their common integrals."""
        hess, heavy, theta = self.bridge.hess, self.bridge.heavy, self.map
        H, F1 = self.bridge.from_units_of_b(theta.h, theta.f)
        frequency = 2.0 * math.pi / self.period
        bodies = ("yes" if one.check.is_body else "no" for one in (hess, heavy))
        yield f"Suslov: I₁₁ = {digits(hess.I11)}, I₂₂ = {digits(hess.I22)}, I₂₃ = {digits(hess.I23)}"
        yield f"b₂ = {digits(hess.b2)}, b₃ = {digits(hess.b3)}"
        yield (
            f"Euler–Poisson: I = ({', '.join(digits(1.0 / a) for a in heavy.a)}), "
            f"μ|r| = {digits(math.copysign(heavy.strength, heavy.mu))}"
        )
        yield f"r/|r| = ({digits(heavy.r[0])}, 0, {digits(heavy.r[2])})"
        yield f"a = I₂₃/I₂₂ = b′/a₁′ = {digits(hess.a)}"
        yield f"b = a₁′μ|r| = {digits(hess.b)}"
        yield f"E = H = {digits(H)}"
        yield f"−F₂ = F₁ = {digits(F1)}"
        yield f"In units b = 1: h = {digits(theta.h)}, f = {digits(theta.f)}"
        yield f"Period of n₃ = {digits(self.period)}, the same on both sides"
        yield f"Frequencies {digits(frequency)}, {digits(frequency * theta.rotation_number)}"
        yield "Rigid bodies? Suslov: {}; Euler–Poisson: {}".format(*bodies)

    def status(self) -> Iterator[str]:
        """Yield the status of the orbit and of the difference."""
        if self.peek("track"):
            yield from orbit_status(self.track.orbit)
        if self.peek("difference"):
            yield f"difference at reference, error of the Suslov side ≤ {digits(self.difference.error, 2)}"

    def notes(self) -> Iterator[str]:
        """Yield warnings: not a rigid body, a truncated orbit, growing round-off on the torus."""
        if not self.bridge.hess.check.is_body:
            yield self.bridge.hess.check.sentence
        shown = float(self.track.times[-1]) if self.peek("track") else math.inf
        if shown < self.span * (1.0 - 1e-9):
            yield f"The orbit is drawn up to t = {digits(shown)}: {MAX_RETURNS} returns."
        if self.peek("difference") and self.difference.error > hess_case.UNSURE:
            yield hess_case.NEAR_UNSTABLE_CYCLE


SCENE = Scene(
    BothSides,
    __file__,
    place=13,
    presets=PRESETS,
    charts=Charts(torus_charts(lambda s: (s.bridge.hess.a, s.turning_points.h, s.turning_points.f)), over=("h", "f")),
    group="Euler–Poisson",
    essential=("h", "f", "phi0"),
    answers=(Answer("Two bodies, one motion: a change of variables maps the heavy top to the body on wheels."),),
    title="Bridge: Suslov and Euler–Poisson",
    summary="The Suslov–Hess case and the Hess case of Euler–Poisson are one system: two orbits and their difference.",
    swarm=hess_case.torus_swarm(lambda s: (s.bridge.hess, s.turning_points.h, s.turning_points.f, s.phi0, s.map)),
    tracks={"orbit": BothSides.orbit_columns, **hess_case.CYCLE_TRACKS},
    angles=("phi", "phi_start", "l"),
    views=(
        body_picture(lambda s: s.solids[0], section=True, title="The body of Suslov–Hess"),
        body_picture(
            lambda s: s.solids[1], name="heavy", title="The body of Euler–Poisson", wheels=False, section=True
        ),
        picture(
            BothSides._about_torus,
            lambda s: s.half_width,
            title="Suslov–Hess: the torus, (ω₁, ω₂)",
            layers=torus_plane.layers(BothSides.ring, half_width=lambda s: s.half_width),
        ),
        Plot(
            name="difference",
            title="Difference along the orbit",
            caption=BothSides._about_difference,
            axes=("t", "lg |difference|"),
            x=lambda s: (0.0, float(s.difference.times[-1])),
            y=lambda s: lg_axis(largest_distance(s.map.h)),
            dot=("t", "apart"),
            layers=(
                time_graph(
                    "free",
                    lambda s: (s.difference.times, lg(s.difference.free)),
                    color=theme.MAP,
                    dash="dotdash",
                    label="difference, without correction",
                    tag="without correction",
                ),
                time_graph(
                    "held",
                    lambda s: (s.difference.times, lg(s.difference.constrained)),
                    color=theme.ORBIT,
                    label="difference, with r·M = 0 imposed",
                    tag="r·M = 0 imposed",
                ),
            ),
        ),
        replace(
            circle.picture(
                map=lambda s: s.map,
                iterates=lambda s: s.iterates,
                caption=lambda s: circle.caption(s.map),
                title="Circle map of both systems",
                dot=("phi_start", "phi"),
                on_click=lambda s, x, y: {"phi0": x},
            ),
            button="Show the circle map",
        ),
        replace(
            andoyer.picture(
                "Euler–Poisson: (l, L/G)",
                BothSides._about_andoyer,
                relation=lambda s: hess_circle(s.bridge.heavy),
                orbit=lambda s: s.andoyer,
            ),
            button="Show (l, L/G)",
        ),
    ),
)
