"""A user-defined body: inertia, potential, constraint, gyrostatic momentum and drive."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.formulas import drive, polynomial
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.periodic_search import NotPeriodic
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.framework.sliders import (
    ONE_TURN,
    accuracy_level,
    choice,
    exponent_time,
    formula,
    number,
    parameter,
    time_span,
)
from hess_explorer.scenes.parts.orbits.exponent import OrbitExponent, exponent_picture, exponent_trial
from hess_explorer.scenes.parts.sections import BodyOrbit
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import time_graph, with_margin
from hess_explorer.views.layers import Columns, Range, line
from hess_explorer.views.plane import section_plane
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Sphere, gamma_columns
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.plane_section import section
from hess_mechanics.dynamics.system import System
from hess_mechanics.numerics.results import Array, SectionCrossings
from hess_mechanics.parameters import I11, I13, I22, I23, MAX_STEP, Group
from hess_mechanics.rigid_body.own_body import OwnBody, Polynomial

_MOST_CROSSINGS = 2000
_NO_WORK = 1e-10
"""Work that is only round-off, relative to the largest change of the energy, at least 1."""
_CONSTRAINED, _FREE = "(a, ω) = 0", "none"


def _component(symbol: str, label: str, default: float, doc: str, group: Group = "Computation") -> Any:
    bounds = (-1e3, 1e3)
    return number(
        symbol, default, (-2.0, 2.0), 0.01, bounds=bounds, label=label, doc=doc, group=group, meaning="own body"
    )


def _velocity(symbol: str, default: float, group: Group = "State") -> Any:
    return number(
        symbol,
        default,
        (-5.0, 5.0),
        0.01,
        bounds=(-1e3, 1e3),
        label=f"Velocity {symbol}",
        doc="Angular velocity at t = 0; the component that the constraint forbids is removed.",
        group=group,
        meaning="own body",
    )


@dataclass(frozen=True)
class OwnBodyState(State):
    """A motion of a user-defined body."""

    U: str = formula("Potential U(γ)", "g3 - 0.5*g1", polynomial, doc="A polynomial in g1, g2, g3, like 0.5*g1^2 - g3.")
    p: str = formula(
        "Drive p(t)",
        "cos(W*t)",
        drive,
        doc="A sum of cos(n*W*t) and sin(n*W*t), like cos(W*t) + 0.5*sin(2*W*t); W is Ω.",
        group="Computation",
    )
    constraint: str = choice(
        "Constraint",
        (_CONSTRAINED, _FREE),
        _CONSTRAINED,
        doc="The constraint (a, ω) = 0, or none.",
        group="Body",
    )
    I11: float = parameter(I11, 2.0)
    I22: float = parameter(I22, 1.5)
    I33: float = number(
        "I₃₃",
        1.2,
        (0.2, 5.0),
        0.01,
        bounds=(1e-3, 1e3),
        label="Inertia I₃₃",
        doc="Third moment of inertia.",
        group="Body",
    )
    I12: float = _component("I₁₂", "Inertia I₁₂", 0.0, "Product of inertia.")
    I13: float = parameter(I13, 0.3)
    I23: float = parameter(I23, 0.2)
    a1: float = _component("a₁", "Constraint a₁", 0.0, "First component of a.")
    a2: float = _component("a₂", "Constraint a₂", 0.0, "Second component of a.")
    a3: float = _component("a₃", "Constraint a₃", 1.0, "Third component of a.")
    k1: float = _component("k₁", "Rotor k₁", 0.0, "Gyrostatic momentum, first component.")
    k2: float = _component("k₂", "Rotor k₂", 0.0, "Gyrostatic momentum, second component.")
    k3: float = _component("k₃", "Rotor k₃", 0.0, "Gyrostatic momentum, third component.", "Body")
    d1: float = _component("d₁", "Drive d₁", 0.0, "The gyrostatic momentum is k + d p(t).")
    d2: float = _component("d₂", "Drive d₂", 0.0, "The gyrostatic momentum is k + d p(t).")
    d3: float = _component("d₃", "Drive d₃", 0.0, "The gyrostatic momentum is k + d p(t).", "Body")
    frequency: float = number(
        "Ω",
        1.0,
        (0.0, 5.0),
        0.01,
        bounds=(0.0, 100.0),
        label="Frequency Ω",
        doc="Angular frequency of the drive.",
        group="Computation",
    )
    w1: float = _velocity("ω₁(0)", 0.5)
    w2: float = _velocity("ω₂(0)", 1.0)
    w3: float = _velocity("ω₃(0)", 0.0, "Computation")
    azimuth: float = number(
        "φ",
        0.0,
        ONE_TURN,
        0.01,
        bounds=ONE_TURN,
        label="Azimuth of γ",
        doc="Azimuth of the vertical, in the plane of axes 1 and 2.",
        group="Computation",
        meaning="own body",
    )
    height: float = number(
        "γ₃(0)",
        0.6,
        (-1.0, 1.0),
        0.01,
        bounds=(-1.0, 1.0),
        label="Height γ₃",
        doc="Third component of the vertical.",
        meaning="own body",
    )
    lasts: float = time_span(40.0, 300.0)
    long: float = exponent_time(500.0, 5000.0, 2e4, "the exponent is")
    max_step: float = parameter(MAX_STEP)
    accuracy: str = accuracy_level()

    @property
    def duration(self) -> float:
        """The duration of the orbit."""
        return self.lasts

    @cached_property
    def body(self) -> OwnBody:
        """The body.  Raises `ModelError`."""
        potential, shape = (
            Polynomial(tuple(found), tuple(found.values())) for found in (polynomial(self.U), drive(self.p))
        )
        return OwnBody(
            (self.I11, self.I22, self.I33, self.I12, self.I13, self.I23),
            potential,
            (self.a1, self.a2, self.a3) if self.constraint == _CONSTRAINED else None,
            (self.k1, self.k2, self.k3),
            (self.d1, self.d2, self.d3),
            self.frequency,
            shape,
        )

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels of the pictures per unit of each variable."""
        return (100.0, 100.0, 100.0, 250.0, 250.0, 250.0, *((1.0, 1.0, 100.0) if self.body.is_driven else ()))

    @property
    def start(self) -> Start:
        """The initial state."""
        around = math.sqrt(max(0.0, 1.0 - self.height**2))
        gamma = around * math.cos(self.azimuth), around * math.sin(self.azimuth), self.height
        return self.body.start((self.w1, self.w2, self.w3), gamma)

    @cached_property
    def is_compiled(self) -> bool:
        """True if equations of this form are compiled."""
        # `newest_results` requests the compilation even during a drag, unlike `need`.
        return self.work.newest_results([[Task(_compile, self.body.system)]])[0] is not None

    @property
    def periodic_orbit(self) -> NotPeriodic:
        """Placeholder for scenes without a periodic orbit; it delays the exponent until the equations are compiled."""
        return NotPeriodic(is_searching=not self.is_compiled)

    orbit = part(lambda s: BodyOrbit(s, max_step=s.max_step))
    exponent = part(OrbitExponent)

    @property
    def track(self) -> Columns | None:
        """The track of the orbit; None until the equations are compiled."""
        if not self.is_compiled:
            return None
        states = self.orbit.path.states
        return {**self.orbit.columns, **gamma_columns(states[:, 3:6])}

    @cached_property
    def energies(self) -> tuple[Array, Array, Array] | None:
        """Times, changes of the energy, and work of the drive, (n,) each; None until the equations are compiled."""
        if not self.is_compiled:
            return None
        path, body = self.orbit.path, self.body
        kept = np.array(next(iter(body.system.integrals([*path.states.T], body.parameters).values())))
        work = path.states[:, 8] if body.is_driven else np.zeros(path.times.size)
        return path.times, kept + work - kept[0], work

    @cached_property
    def crossings(self) -> SectionCrossings | None:
        """The crossings of the motion with the section, up to the averaging time; None until known."""
        if not self.is_compiled or self.is_preview:
            return None
        return self.work.need(
            Task(section, self.body, self.start, self.body.surface, self.long, self.level, _MOST_CROSSINGS),
            preview=None,
        )

    def idle_values(self) -> Mapping[str, float]:
        """Return the parameters without effect: the constraint of a free body, the frequency without a drive."""
        found = {} if self.constraint == _CONSTRAINED else {"a1": 0.0, "a2": 0.0, "a3": 0.0}
        return found if any((self.d1, self.d2, self.d3)) else {**found, "frequency": self.frequency}

    def quantities(self) -> Iterator[str]:
        """Yield the conserved quantities, and whether this is a rigid body."""
        yield f"conserved: {', '.join(self.body.system.integrals(*self.body.system.example))}"
        yield self.body.check.sentence


def _compile(system: System) -> bool:
    """Compile the equations by integrating the example of the system."""
    solve(*system.example_motion, [0.1], "draft")
    return True


def _caption(s: OwnBodyState) -> Caption:
    if not s.is_compiled:
        return Caption("Compiling the equations.", "This takes some seconds, once.")
    return Caption(numbers=f"From t = 0 to t = {digits(s.lasts)}.")


def _room(name: str) -> Any:
    return lambda s: None if s.track is None else with_margin(s.track[name], 0.06, 1e-2)


def _energy_caption(s: OwnBodyState) -> Caption:
    if s.energies is None:
        return _caption(s)
    _, change, work = s.energies
    if s.body.is_driven:
        off = float(np.abs(change - work).max())
        # A rotor along the axis of the constraint does no work, so W vanishes up to round-off.
        verb = "does" if np.abs(work).max() > _NO_WORK * max(1.0, np.abs(change).max()) else "does no"
        return Caption(f"The drive {verb} work.", f"max |E − E₀ − W| = {digits(off, 1)}.")
    return Caption("The energy is conserved.", f"max |E − E₀| = {digits(float(np.abs(change).max()), 1)}.")


def _section_caption(s: OwnBodyState) -> Caption:
    if not s.is_compiled or s.crossings is None:
        return _caption(s) if not s.is_compiled else Caption(s.pending_caption())
    where = "One point per period of the drive." if s.body.is_driven and s.frequency else "Upward crossings of γ₃ = 0."
    return Caption(where, f"{len(s.crossings.times)} crossings up to t = {digits(s.long)}.")


def _crossing_points(s: OwnBodyState) -> Array | None:
    return None if s.crossings is None else s.crossings.states[:, :2]


def _crossed_range(i: int) -> Any:
    def of(s: OwnBodyState) -> Range | None:
        found = _crossing_points(s)
        return None if found is None or not len(found) else with_margin(found[:, i], 0.06, 1e-2)

    return of


def _no_crossing(s: OwnBodyState) -> str:
    found = _crossing_points(s)
    return "" if found is None or len(found) else "No crossing: choose another motion or a longer time of the exponent."


def _energy_range(s: OwnBodyState) -> Range | None:
    return None if s.energies is None else with_margin(np.concatenate(s.energies[1:]), 0.1, 1e-3)


def _graph(i: int) -> Any:
    return lambda s: None if s.energies is None else (s.energies[0], s.energies[i])


PRESETS = (
    Preset("Suslov problem with an oblique field"),
    Preset("Suslov gyrostat", U="", k1=0.3, k2=0.2, k3=0.8, I13=0.5, I23=0.0),
    Preset("Driven Suslov body", U="", d3=1.0, frequency=1.3, I13=0.3, I23=0.4, w1=1.0, w2=0.2, lasts=100.0),
    Preset("Oblique constraint", a1=0.5, a2=-0.3, U="g3"),
    Preset("Euler top", U="", constraint=_FREE, I11=3.0, I22=2.0, I33=1.0, I13=0.0, I23=0.0, w1=0.05, w2=1.5, w3=0.05),
    Preset(
        "Kovalevskaya top",
        U="g1",
        constraint=_FREE,
        I11=2.0,
        I22=2.0,
        I33=1.0,
        I13=0.0,
        I23=0.0,
        w1=0.5,
        w2=0.3,
        w3=1.0,
    ),
    Preset("A quartic potential", U="g1^4 + g2^4 - g3^2", I13=0.0, I23=0.0),
)
"""The third one is a Suslov body with a rotor whose speed changes periodically."""

SCENE = Scene(
    OwnBodyState,
    __file__,
    place=25,
    group="Your own",
    presets=PRESETS,
    essential=("U", "I13", "k3", "d3"),
    handle="I13",
    answers=(Answer("Type a potential and press Enter: all pictures show the motion of your own body."),),
    title="Your own body",
    summary="Type a potential; choose inertia, constraint, rotor and drive. Equations are derived, checked and solved.",
    tracks={"orbit": lambda s: s.track},
    level_trials=(exponent_trial(),),
    views=(
        Plot[OwnBodyState](
            name="omega",
            title="Angular velocity",
            caption=_caption,
            axes=("ω₁", "ω₂"),
            x=_room("ω1"),
            y=_room("ω2"),
            dot=("ω1", "ω2"),
            layers=(
                line(
                    "orbit",
                    track="orbit",
                    columns=("ω1", "ω2"),
                    color=theme.ORBIT,
                    width=2.5,
                    label="orbit",
                    tag="orbit",
                ),
            ),
        ),
        Sphere[OwnBodyState](looks={"orbit": "orbit"}, caption=lambda s: Caption("The vertical γ along the orbit.")),
        Plot[OwnBodyState](
            name="energy",
            title="Energy",
            caption=_energy_caption,
            axes=("t", "E − E₀"),
            x=lambda s: (0.0, s.lasts),
            y=_energy_range,
            layers=(
                time_graph("work", _graph(2), color=theme.MAP, dash="dashed", label="work W of the drive"),
                time_graph("change", _graph(1), color=theme.ORBIT, label="change of the energy"),
            ),
        ),
        exponent_picture(),
        Plot[OwnBodyState](
            name="section",
            title="Poincaré section",
            caption=_section_caption,
            axes=("ω₁", "ω₂"),
            x=_crossed_range(0),
            y=_crossed_range(1),
            message=_no_crossing,
            layers=section_plane.layers(_crossing_points),
        ),
    ),
)
