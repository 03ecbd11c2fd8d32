"""The states of a scene for any system of differential equations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Value, Values, points_text
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.periodic_search import ClosedOrbit, NotPeriodic
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.sliders import accuracy_level, exponent_time, parameter, time_span
from hess_explorer.scenes.framework.windows import box_window
from hess_explorer.scenes.parts.orbits.exponent import OrbitExponent
from hess_explorer.scenes.parts.sections import (
    MEGNO,
    BodyOrbit,
    Indicator,
    Section,
    SectionPeriodicOrbit,
    choice_of_orbit,
    crossings_of_each,
    length_of_manifolds,
    start_on,
)
from hess_explorer.views.caption import Caption
from hess_explorer.views.picture import Corners
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.system import ParametrizedSystem, System
from hess_mechanics.dynamics.variable_section import VariableSection, variable_section
from hess_mechanics.parameters import MAX_STEP

_PIXELS = 300.0
"""Size of an orbit in a picture, in pixels."""


@dataclass(frozen=True)
class OwnState(State):
    """A motion of a system; each scene adds the system's parameters, `p_…`, and initial values, `y_…`, as fields.

    A scene with a section also adds its `window` and the `indicator` under its points.

    Attributes
    ----------
    system : System
        The system.
    angles : tuple of str
        Variables that are angles, in radians.
    surface : (str, float) or None
        Variable of the section and its value there; None for the default of `variable_section`.
    coordinates : (str, str) or None
        Coordinates of the section; None for the default of `variable_section`.
    ranges : tuple of (float, float) or None
        Range of each coordinate; None for the default of `variable_section`.
    """

    span: float = time_span(30.0, 300.0)
    long: float = exponent_time(500.0, 5000.0, 2e4, "the exponent is")
    count: float = crossings_of_each()
    max_step: float = parameter(MAX_STEP)
    accuracy: str = accuracy_level()

    system: ClassVar[System]
    angles: ClassVar[tuple[str, ...]] = ()
    surface: ClassVar[tuple[str, float] | None] = None
    coordinates: ClassVar[tuple[str, str] | None] = None
    ranges: ClassVar[tuple[tuple[float, float], ...] | None] = None
    window: ClassVar[str] = ""
    indicator: ClassVar[str] = ""

    @cached_property
    def body(self) -> ParametrizedSystem:
        """The system with the values of its parameters."""
        return self.system.at([getattr(self, f"p_{name}") for name in self.system.parameters])

    @property
    def chosen_start(self) -> Start:
        """The chosen initial state (d,)."""
        return tuple(getattr(self, f"y_{name}") for name in self.system.variables)

    @property
    def start(self) -> Start:
        """The initial state of the current orbit."""
        return self.chosen_start

    @property
    def duration(self) -> float:
        """The time span of the current orbit."""
        return self.span

    @cached_property
    def weights(self) -> tuple[float, ...]:
        """Pixels of the pictures per unit of each variable."""
        return self.work.need(Task(_pixels, self.system))

    @property
    def periodic_orbit(self) -> NotPeriodic | SectionPeriodicOrbit:
        """The placeholder for a periodic orbit, because this scene does not search for periodic orbits."""
        return NotPeriodic()

    orbit = part(lambda s: BodyOrbit(s, max_step=s.max_step))
    exponent = part(OrbitExponent)

    def levels(self) -> dict[str, float]:
        """Return the levels of the section: the first d − 3 integrals by name, with their values along the motion."""
        known = self.system.integrals(self.chosen_start, self.body.parameters)
        needed = len(self.system.variables) - 3
        return {name: float(value) for name, value in [*known.items()][:needed]}

    @cached_property
    def poincare(self) -> VariableSection:
        """The section at `levels`.  Raises `InvalidParameter`."""
        return variable_section(self.body, self.levels(), self.surface, self.coordinates, self.ranges)

    section = part(Section)
    megno = part(lambda s: Indicator(s.section, s.indicator == MEGNO))

    @property
    def section_caption(self) -> Caption | None:
        """The caption of a section with MEGNO; None without it."""
        return self.megno.caption

    def box_window(self, corners: Corners) -> Values:
        """Return the window that a box in the section selects."""
        (x0, x1), (y0, y1) = self.poincare.window
        return box_window(corners, ((x0, y0), (x1, y1)))

    def start_at(self, x: float, y: float) -> Values:
        """Return the initial values at a point of the section; empty if no motion crosses it there."""
        states, there = self.poincare.states_at(np.array([x]), np.array([y]))
        named = zip(self.system.variables, states[0].tolist(), strict=True)
        values: dict[str, Value] = {f"y_{name}": value for name, value in named}
        return values if there[0] else {}


@dataclass(frozen=True)
class LevelState(OwnState):
    """A motion from a point of a section; each scene adds the levels of integrals, `i_…`, and the `place`.

    Attributes
    ----------
    integrals : tuple of str
        Names of the integrals with a level.
    """

    periodic: str = choice_of_orbit()
    reach: float = length_of_manifolds()

    integrals: ClassVar[tuple[str, ...]] = ()
    place: ClassVar[str] = ""

    @cached_property
    def chosen_start(self) -> Start:
        """The state (d,) at the point.  Raises `OutsideRegion`."""
        return start_on(self.poincare, self.place)

    @property
    def start(self) -> Start:
        """The initial state of the current orbit."""
        return self.chosen_start if self.closed_orbit is None else self.closed_orbit.state

    @property
    def duration(self) -> float:
        """The time span of the current orbit."""
        return self.span if self.closed_orbit is None else self.closed_orbit.time

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The periodic orbit; None if none is requested or known."""
        return self.periodic_orbit.closed_orbit

    periodic_orbit = part(lambda s: SectionPeriodicOrbit(s.section, s.periodic, s.reach))

    @property
    def section_caption(self) -> Caption | None:
        """The caption of a section with a periodic orbit or MEGNO; None without them."""
        return self.periodic_orbit.caption or self.megno.caption

    def levels(self) -> dict[str, float]:
        """Return the chosen levels of the integrals."""
        return {name: getattr(self, f"i_{name}") for name in self.integrals}

    def start_at(self, x: float, y: float) -> Values:
        """Return the point as the start of the motion."""
        return {"place": points_text([(x, y)])}


def _pixels(system: System) -> tuple[float, ...]:
    """Return the pixels per unit of each variable at which the example of the system fills a picture."""
    states = solve(*system.example_motion, np.linspace(0.0, 30.0, 200), "draft").states
    return tuple((_PIXELS / np.maximum(np.ptp(states, axis=0), 1e-3)).tolist())
