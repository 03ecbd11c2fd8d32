"""Leak off the Hess manifold: growth of r·M, which should stay 0, and the exact motion for comparison."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, torus_charts
from hess_explorer.scenes.framework.hess_case import NEAR_UNSTABLE_CYCLE, PHI0, RIS, UNSURE, HeavyHess, reduced_motion
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import Slider, accuracy_level, number, parameter
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, heavy_solid
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.chart import LG_OF_0, lg, lg_axis
from hess_explorer.views.graphs.leak import distances
from hess_explorer.views.layers import Columns, Range, column, curves
from hess_explorer.views.plane import andoyer
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Circle, Direction, Sphere, gamma_columns, parallels
from hess_explorer.views.text import digits, range_text
from hess_mechanics import parameters as known
from hess_mechanics.euler_poisson import hess_manifold as mechanics
from hess_mechanics.euler_poisson.andoyer import hess_circle
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge, largest_distance
from hess_mechanics.numerics.accuracy import REFERENCE, level
from hess_mechanics.numerics.results import Array, Orbit
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map

_IN_A_PERIOD = 96
_RANGE = (LG_OF_0, 0.5)

PRESETS = (
    Preset("Figure 11: h = 50, f = 5"),
    Preset("No cycles: stable to first order", h=5.0, f=0.8, returns=60.0),
    Preset("f = 0: loxodromic pendulum, multiplier e^(2πa)", h=20.0, f=0.0),
    Preset("From the unstable cycle", phi0=-1.7044856772778523, returns=30.0),
    Preset("Body of figure 14, f = 1, h = 2", **RIS, h=2.0, f=1.0, returns=30.0),
    Preset("Body of figure 14, f = 1, h = 0.3", **RIS, h=0.3, f=1.0, returns=60.0),
)


@dataclass(frozen=True)
class HessLeak(State):
    """A motion integrated without correction, at the chosen and the reference level, and the exact motion.

    A drag does not change the level of accuracy, because the leak depends on it.
    """

    I1: float = parameter(known.I1)
    I2: float = parameter(known.I2)
    I3: float = parameter(known.I3)
    m: float = parameter(known.MU_R)
    h: float = parameter(known.H_HEAVY)
    f: float = parameter(known.F_HEAVY)
    phi0: float = parameter(
        PHI0, doc="Phase of the start on the torus, at the lowest position of the centre of mass, in radians."
    )
    returns: float = number(
        "N",
        20.0,
        (5.0, 60.0),
        1.0,
        bounds=(1.0, 200.0),
        group="Computation",
        label="Periods",
        doc="Number of periods of n₃ computed.",
    )
    accuracy: str = accuracy_level()

    @cached_property
    def hess(self) -> HeavyHess:
        """The motion on the Hess manifold."""
        return HeavyHess((self.I1, self.I2, self.I3), self.m, self.h, self.f)

    def valid_state(self, notes: list[str]) -> HessLeak:
        """Return the state with h clamped to its minimum and f to the region of this h; append notes."""
        return self.with_values(self.hess.corrections(notes))

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges over the possible values."""
        return self.hess.limits()

    @property
    def bridge(self) -> Bridge:
        """The heavy body and the equivalent Suslov body.  Raises `InvalidParameter`, `NoField`."""
        return self.hess.bridge

    @cached_property
    def map(self) -> CircleMap:
        """The circle map, with the multipliers of the cycles."""
        return self.work.need(
            Task(circle_map, self.bridge.hess.a, self.hess.turning_points.h, self.hess.turning_points.f, REFERENCE)
        )

    @property
    def period(self) -> float:
        """The period of n3 in the body's own time unit."""
        return self.map.period / self.bridge.hess.frequency_unit

    @property
    def _periods(self) -> int:
        return round(self.returns)

    @cached_property
    def exact(self) -> Orbit:
        """The orbit of the reduced system, in units b = 1."""
        start = tuple(self.hess.turning_points.state_at_lower_turn(self.phi0).tolist())
        return self.work.need(
            Task(
                mechanics.exact_motion,
                self.bridge.hess.a,
                start,
                self._periods * self.map.period,
                self._periods * _IN_A_PERIOD + 1,
            )
        )

    @cached_property
    def states(self) -> Array:
        """The states (n, 6) of the exact motion in Euler–Poisson variables."""
        return self.bridge.from_reduced(self.bridge.hess.from_units_of_b(self.exact.states))

    @cached_property
    def leaks(self) -> dict[str, mechanics.Leak]:
        """The orbits without correction: "own" at the chosen level, and "reference"."""
        end = float(self.exact.times[-1]) / self.bridge.hess.frequency_unit
        asked = (self.bridge.heavy, tuple(self.states[0].tolist()), end, self.exact.times.size)
        runs = {
            name: self.work.need(Task(mechanics.run_free, *asked, rung))
            for name, rung in (("own", level(self.work.level_name)), ("reference", REFERENCE))
        }
        return {name: mechanics.Leak(self.bridge, run, self.exact, _IN_A_PERIOD) for name, run in runs.items()}

    @property
    def run(self) -> mechanics.FreeRun:
        """The orbit without correction at the chosen level."""
        return self.leaks["own"].run

    def motion(self) -> Motion:
        """Return the exact motion of the reduced system."""
        return reduced_motion(
            self.bridge.hess, self.hess.turning_points, self.phi0, self._periods * self.hess.turning_points.period
        )

    @cached_property
    def solid(self) -> Solid:
        """The body along the exact motion."""
        return heavy_solid(self.bridge.heavy, self.run.times, self.states)

    # ---- the pictures ------------------------------------------------------------------------------------------

    def times(self) -> Range:
        """Return the range of the time axis."""
        return 0.0, float(self.run.times[-1])

    def run_columns(self) -> Columns:
        """Return the columns of the orbit without correction."""
        apart = lg(self.leaks["own"].distance)
        return {"t": column(self.run.times), "apart": column(apart), **gamma_columns(self.run.states[:, 3:])}

    def exact_columns(self) -> Columns:
        """Return the columns of the exact motion and of the moving points in the graphs."""
        l, x = self.run.andoyer.T
        return {
            **self.run_columns(),
            "lg": column(lg(np.abs(self.run.offset))),
            "l": column(l),
            "x": column(x),
            **gamma_columns(self.states[:, 3:]),
        }

    def heights(self) -> list[Circle]:
        """Return the circles that bound n3."""
        r, sign = self.bridge.heavy.r, math.copysign(1.0, self.bridge.hess.b)
        return parallels(r, [sign * n3 for n3 in self.hess.turning_points.roots[1:]])

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_leak(self) -> Caption:
        exact, growth = digits(mechanics.exact_growth(self.map)), self.leaks["own"].growth
        if self.map.kind != "hyperbolic":
            merged, largest = self.map.fixed_points, digits(float(np.max(np.abs(self.run.offset))), 2)
            return Caption(
                "Tongue boundary: |r·M| grows like t²." if merged else "No cycles: no growth to first order.",
                f"In {self._periods} periods |r·M| ≤ {largest}.",
            )
        if growth is None:
            return Caption("The growth is too short to measure.", f"Exact growth {exact} per period.")
        measured = digits(growth.per_period)
        return Caption(
            "r·M grows exponentially.",
            f"ln |r·M|: {measured} per period, measured over {growth.periods} periods; exact {exact}.",
        )

    def _about_difference(self) -> Caption:
        largest = digits(float(self.leaks["own"].distance.max()), 2)
        return Caption(numbers=f"{self.run.level}: at most {largest} (units b = 1).")

    def _about_side(self) -> Caption:
        sign, stays = self.leaks["own"].side
        if sign == 0:
            return Caption("The Hess relation holds to round-off.")
        layer = f"The orbit enters the layer r·M {'>' if sign > 0 else '<'} 0."
        return Caption(layer, "The orbit stays in this layer." if stays else "The orbit changes layer later.")

    def _about_sphere(self) -> Caption:
        return Caption(
            "γ of the exact and the leaking orbit.", f"n₃ {range_text(*self.hess.turning_points.roots[1:])}."
        )

    def quantities(self) -> Iterator[str]:
        """Yield the reduced body and torus, the exact growth and the measured growth."""
        growth = mechanics.exact_growth(self.map)
        yield f"a = b′/a₁′ = {digits(self.bridge.hess.a)}"
        yield f"b = a₁′μ|r| = {digits(self.bridge.hess.b)}"
        yield f"In units b = 1: h = {digits(self.map.h)}, f = {digits(self.map.f)}"
        yield f"Period of n₃ = {digits(self.period)}"
        yield f"|trace| = {digits(self.map.trace, 6)}: {self.map.kind}"
        if self.map.fixed_points:
            yield f"ln(multiplier) = ±{digits(growth, 5)}"
            yield f"Rate = {digits(growth / self.period)} per unit of time"
        if "leak" in self.visible and self.map.kind == "hyperbolic":
            yield from (
                f"Measured, {leak.run.level}: {digits(leak.growth.per_period, 5)} per period"
                for leak in self.leaks.values()
                if leak.growth is not None
            )
        yield f"A rigid body? {'yes' if self.bridge.heavy.check.is_body else 'no'}"

    def status(self) -> Iterator[str]:
        """Yield the status of the chosen and the exact orbit."""
        if self.peek("leaks"):
            chosen, exact = self.run, self.exact
            yield f"{chosen.level}: orbit {chosen.times.size} points, {chosen.steps} Taylor steps, computed once"
            yield "drift " + " ".join(f"{name} {digits(drift, 1)}" for name, drift in chosen.drift.items())
            yield f"exact motion error ≤ {digits(exact.error_estimate, 2)} ({exact.status})"

    def notes(self) -> Iterator[str]:
        """Yield warnings: not a rigid body, growing round-off on the torus."""
        if not self.bridge.heavy.check.is_body:
            yield self.bridge.heavy.check.sentence
        if self.peek("exact") and self.exact.error_estimate > UNSURE:
            yield NEAR_UNSTABLE_CYCLE


SCENE = Scene(
    HessLeak,
    __file__,
    place=12,
    presets=PRESETS,
    charts=Charts(
        torus_charts(lambda s: (s.bridge.hess.a, s.hess.turning_points.h, s.hess.turning_points.f)), over=("h", "f")
    ),
    group="Euler–Poisson",
    essential=("h", "f", "phi0", "returns"),
    answers=(Answer("The exact motion never leaves its surface; round-off can make the computed one leave."),),
    title="Leak off the Hess manifold",
    summary="An orbit on the Hess manifold of Euler–Poisson leaves it by round-off alone, at the rate of the cycle.",
    tracks={"orbit": HessLeak.exact_columns, "second": HessLeak.run_columns},
    angles=("l",),
    views=(
        body_picture(wheels=False, section=True),
        Plot(
            name="leak",
            title="r·M against time",
            caption=HessLeak._about_leak,
            axes=("t", "lg |r·M|"),
            x=HessLeak.times,
            y=_RANGE,
            dot=("t", "lg"),
            layers=(
                *distances(lambda s: s.leaks, lambda leak: np.abs(leak.run.offset)),
                curves(
                    "slope",
                    lambda s: s.leaks["own"].straight_line(mechanics.exact_growth(s.map), _RANGE),
                    color=theme.MUTED,
                    dash="dashed",
                    label="slope ln(multiplier) per period",
                ),
            ),
        ),
        andoyer.picture(
            "Andoyer variables (l, L/G)",
            HessLeak._about_side,
            relation=lambda s: hess_circle(s.bridge.heavy),
            orbit=lambda s: s.run.andoyer,
            color=theme.MAP,
        ),
        Sphere(
            caption=HessLeak._about_sphere,
            looks={"orbit": "orbit", "second": "second"},
            axis=lambda s: Direction(s.bridge.heavy.r, "r"),
            circles=HessLeak.heights,
        ),
        Plot(
            name="difference",
            title="Distance from the exact motion",
            caption=HessLeak._about_difference,
            button="Show the distance from the exact motion",
            axes=("t", "lg |difference|"),
            x=HessLeak.times,
            y=lambda s: lg_axis(largest_distance(s.map.h)),
            dot=("t", "apart"),
            layers=distances(lambda s: s.leaks, lambda leak: leak.distance),
        ),
    ),
)
