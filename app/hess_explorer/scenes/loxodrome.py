"""The loxodromic pendulum: a heavy body in the Hess case with area integral 0."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, torus_charts
from hess_explorer.scenes.framework.inertia import limits_of_moments
from hess_explorer.scenes.framework.scene import Motion, Preset, Scene, State
from hess_explorer.scenes.framework.sliders import Slider, accuracy_level, parameter, time_span
from hess_explorer.scenes.framework.solid_body import CIRCULAR_SECTION
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import CENTRE_OF_MASS, Columns, Sign, column, line
from hess_explorer.views.plane.velocity_plane import pixels_per_unit
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.body import BodyInSpace, Curve, Rod, Shape
from hess_explorer.views.space.poisson_sphere import Circle, Mark
from hess_explorer.views.text import digits, range_text, vector
from hess_mechanics import parameters as known
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicMotion, LoxodromicPendulum, loxodromic_motion
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.equations import SYSTEM

_TO_THE_POLE = 0.02
"""Distance from the poles at which the drawing ends, as the loxodrome never reaches them."""
_MOST_TURNS = 30.0
_SAMPLES = 2000

PRESETS = (
    Preset("High energy: the whole loxodrome (body of figure 13)"),
    Preset("Almost round: many turns", I1=1.0, I2=1.03, I3=1.06, energy=2.0, l=0.1, span=150.0),
    Preset("Low energy: a segment of the loxodrome", energy=0.3, l=1.1),
    Preset("Separatrix: to the top in infinite time", energy=1.0, l=0.6),
    Preset("Small swings", energy=-0.9, l=1.2),
    Preset("The body of figure 11, f = 0", I1=1.0, I2=0.625, I3=0.375, m=9.975, energy=5.0, l=2.9, span=5.0),
)


@dataclass(frozen=True)
class Loxodrome(State):
    """A motion of a loxodromic pendulum."""

    I1: float = parameter(known.I1)
    I2: float = parameter(known.I2, 1.5, doc="Middle principal moment, which must lie between I₁ and I₃.")
    I3: float = parameter(known.I3, 2.0)
    # Only positive values: the pendulum does not depend on the sign of μ|r|.
    m: float = parameter(
        known.MU_R,
        0.7071,
        softbounds=(0.05, 20.0),
        step=0.05,
        bounds=(1e-3, 1e3),
        doc="Sets the units of energy and time; the direction of r follows from the moments.",
    )
    energy: float = parameter(known.H_PENDULUM)
    l: float = parameter(known.L_PENDULUM)
    span: float = time_span(30.0, 200.0, what="the motion")
    accuracy: str = accuracy_level()

    @property
    def moments(self) -> tuple[float, float, float]:
        """The principal moments of inertia."""
        return self.I1, self.I2, self.I3

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges that keep the order of the moments."""
        return limits_of_moments(*self.moments)

    @cached_property
    def pendulum(self) -> LoxodromicPendulum:
        """The pendulum.  Raises `InvalidParameter`, `NotPositiveDefinite`, `OutsideRegion`."""
        return LoxodromicPendulum(HeavyBody.hess(self.moments, self.m), self.energy, self.l)

    @cached_property
    def pendulum_motion(self) -> LoxodromicMotion:
        """The motion shown by all pictures."""
        return self.work.need(Task(loxodromic_motion, self.pendulum, self.span, self.level))

    def motion(self) -> Motion:
        """Return the reduced motion in units b = 1."""
        p = self.pendulum
        return Motion(
            SYSTEM,
            tuple(p.start[:5]),
            (p.a, 1.0),
            p.length(self.span),
            pixels_per_unit(math.sqrt(2.0 * (p.h + 1.0))),
            1.0 / p.frequency_unit,
        )

    def shape(self) -> Shape | None:
        """Return the gyration ellipsoid; None if this is not a rigid body."""
        heavy = self.pendulum.body
        return Shape(np.eye(3), 1.0 / np.array(heavy.a), np.array(heavy.r)) if heavy.check.is_body else None

    def rods(self, label: str = "") -> list[Rod]:
        """Return rods along the middle axis and to the centre of mass."""
        return [Rod((0.0, 1.0, 0.0), "orbit", label), Rod(self.pendulum.body.r, "mass")]

    def loxodrome(self) -> Array:
        """Return the loxodrome without its last windings about the poles, (n, 3)."""
        return self.pendulum.middle_axis_at(np.linspace(*self.pendulum.windings(_TO_THE_POLE, _MOST_TURNS), _SAMPLES))

    def track(self) -> Columns:
        """Return the height of the centre of mass and l over time."""
        return {
            "t": column(self.pendulum_motion.times),
            "height": column(-self.pendulum_motion.centre[:, 0]),
            "l": column(self.pendulum_motion.l),
        }

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_body(self) -> Caption:
        check_note = "" if self.pendulum.body.check.is_body else "Not a rigid body, so no ellipsoid. "
        return Caption(
            "The centre of mass swings in a plane.",
            f"{check_note}Largest distance from the vertical plane: {digits(self.pendulum_motion.plane_distance, 1)}.",
        )

    def _about_space(self) -> Caption:
        p, l = self.pendulum, self.pendulum_motion.l
        if p.h < 1.0:
            low, high = sorted(map(float, p.l_at(np.array([-p.amplitude, p.amplitude]))))
            return Caption("The middle axis oscillates along a loxodrome.", f"l {range_text(low, high)}.")
        if p.h == 1.0:
            top = float(p.l_at(np.array([math.pi]))[0])
            return Caption(
                "The middle axis follows the loxodrome once.", f"l from {digits(l[0])} towards {digits(top)}."
            )
        return Caption("The middle axis follows the whole loxodrome.", f"l {range_text(l[0], l[-1])}.")

    def _about_angle(self) -> Caption:
        measured, theta = self.pendulum_motion.angles[1], self.pendulum.angle
        error = f"; the track agrees within {digits(np.max(np.abs(measured - theta)), 1)}" if measured.size else ""
        return Caption("The angle θ is constant.", f"θ = arcsin(1/√(1+a²)) = {digits(theta)}{error}.")

    def _about_height(self) -> Caption:
        p = self.pendulum
        if p.h < 1.0:
            return Caption(
                "The body swings.", f"α = ±{digits(p.amplitude)} at most; the height reaches h = {digits(p.h)}."
            )
        if p.h == 1.0:
            return Caption("The body approaches the top forever.", "The height tends to 1.")
        turns = abs(float(self.pendulum_motion.swing[-1])) / (2.0 * math.pi)
        return Caption("The body rotates.", f"{digits(turns)} turns in this time.")

    def quantities(self) -> Iterator[str]:
        """Yield a, the angle of the loxodrome and the derived data of the body."""
        p, heavy = self.pendulum, self.pendulum.body
        yield f"a = ±√((a₃−a₂)(a₂−a₁))/a₂ = {digits(p.a)}"
        yield f"θ = {digits(p.angle)} = {digits(math.degrees(p.angle))}°"
        yield f"r = {vector(heavy.r)}"
        yield f"H = h μ|r| = {digits(p.h * heavy.mu)}"
        yield f"Unit of time = {digits(1.0 / p.frequency_unit)}"
        yield f"l(0) = {digits(p.l)}"
        yield f"A rigid body? {'yes' if heavy.check.is_body else 'no'}"
        yield f"In the full equations ln|(M, r)| grows by 2π|a| = {digits(2.0 * math.pi * abs(p.a))} per turn"

    def status(self) -> Iterator[str]:
        """Yield the status of the attitude and of its orbit."""
        yield from orbit_status(self.pendulum_motion.orbit)
        yield f"γ, e orthonormalised, defect {digits(self.pendulum_motion.attitude.defect, 1)}"

    def notes(self) -> Iterator[str]:
        """Yield warnings: not a rigid body, a truncated motion."""
        if not self.pendulum.body.check.is_body:
            yield self.pendulum.body.check.sentence
        if self.pendulum_motion.times[-1] < self.span * (1 - 1e-9):
            end = digits(float(self.pendulum_motion.times[-1]))
            yield f"The motion is shown up to t = {end}: after that no movement is visible."


SCENE = Scene(
    Loxodrome,
    __file__,
    place=14,
    presets=PRESETS,
    charts=Charts(torus_charts(lambda s: (s.pendulum.a, s.pendulum.h, 0.0)), over=("energy", "I2")),
    group="Euler–Poisson",
    essential=("energy", "l", "I2"),
    answers=(
        Answer(
            "Gravity swings the body: its middle axis goes to and fro on a loxodrome.", lambda s: s.pendulum.h < 1.0
        ),
        Answer("The body climbs towards the top forever.", lambda s: s.pendulum.h == 1.0),
        Answer("The body turns over and over: its middle axis runs along the whole loxodrome."),
    ),
    title="Loxodromic pendulum",
    summary="A heavy body whose centre of mass swings in a plane while its middle axis runs along a loxodrome.",
    tracks={"orbit": Loxodrome.track},
    views=(
        BodyInSpace(
            name="body",
            title="The body in space",
            caption=Loxodrome._about_body,
            without_grid=True,
            shape=Loxodrome.shape,
            motion=lambda s: (s.pendulum_motion.attitude, s.pendulum_motion.times),
            rods=Loxodrome.rods,
            curves=lambda s: [Curve(s.pendulum_motion.centre, "stable", 2.0)],
            trail=lambda s: (0.0, 1.0, 0.0),
            mass=lambda s: np.array(s.pendulum.body.r),
            signs=(CIRCULAR_SECTION,),
        ),
        BodyInSpace(
            name="space",
            title="Sphere fixed in space",
            caption=Loxodrome._about_space,
            attitude="body",
            rods=lambda s: s.rods("2"),
            curves=lambda s: [
                Curve(s.loxodrome(), "muted", 2.0),
                Curve(s.pendulum_motion.middle, "orbit", 4.0),
                Curve(s.pendulum_motion.centre, "stable", 2.0),
            ],
            circles=(Circle((1.0, 0.0, 0.0), 0.0, "limit"),),
            marks=(Mark((1.0, 0.0, 0.0), "muted", "e"), Mark((-1.0, 0.0, 0.0), "muted", "−e")),
            signs=(
                Sign("loxodrome", "line", f"border-top: 2px solid {theme.MUTED}"),
                Sign("middle axis and its track", "line", f"border-top: 4px solid {theme.ORBIT}"),
                CENTRE_OF_MASS,
            ),
        ),
        Plot(
            name="angle",
            title="Angles θ and l",
            caption=Loxodrome._about_angle,
            axes=("t", "θ, l"),
            x=lambda s: (0.0, s.span),
            y=(0.0, math.pi),
            dot=("t", "l"),
            layers=(
                line(
                    "l", lambda s: (s.pendulum_motion.times, s.pendulum_motion.l), color=theme.MAP, label="l", tag="l"
                ),
                line("theta", lambda s: s.pendulum_motion.angles, color=theme.ORBIT, label="θ", tag="θ"),
                line(
                    "promised",
                    lambda s: ((0.0, s.pendulum_motion.times[-1]), (s.pendulum.angle,) * 2),
                    color=theme.MUTED,
                    dash="dotted",
                ),
            ),
        ),
        Plot(
            name="height",
            title="Centre-of-mass height",
            caption=Loxodrome._about_height,
            axes=("t", "height"),
            x=lambda s: (0.0, s.span),
            y=(-1.05, 1.05),
            dot=("t", "height"),
            layers=(
                line(
                    "orbit",
                    track="orbit",
                    columns=("t", "height"),
                    color=theme.STABLE,
                    label="height of the centre of mass",
                ),
            ),
        ),
    ),
)
