"""States with a section, its orbits, and results about them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

from hess_explorer.protocol.specs import Value, Values, points_text
from hess_explorer.scenes.framework.cells import DENSITY
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.periodic_search import NONE, ClosedOrbit
from hess_explorer.scenes.framework.scene import Motion, State
from hess_explorer.scenes.framework.sliders import accuracy_level, exponent_time, show_proved_error, time_span
from hess_explorer.scenes.framework.solid_body import Solid, constrained_solid
from hess_explorer.scenes.parts.orbits.exponent import OrbitExponent
from hess_explorer.scenes.parts.orbits.proof import OrbitProof
from hess_explorer.scenes.parts.sections.clicks import orbits_spread, points_of_each
from hess_explorer.scenes.parts.sections.density import SectionDensity
from hess_explorer.scenes.parts.sections.indicator import MEGNO, Indicator, colouring
from hess_explorer.scenes.parts.sections.orbit import BodyOrbit
from hess_explorer.scenes.parts.sections.periodic_orbit import (
    SectionPeriodicOrbit,
    choice_of_orbit,
    length_of_manifolds,
)
from hess_explorer.scenes.parts.sections.section import Section, crossings_of_each, start_on
from hess_explorer.views.caption import Caption
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import Body

PLAIN: dict[str, Value] = {"periodic": NONE, "indicator": DENSITY}
"""Choices of the first preset; every other example then sets them too, see `Scene.example`."""


@dataclass(frozen=True)
class SectionState(State, ABC):
    """A state with an orbit that starts in a section, or a periodic orbit in its place, among other orbits.

    A scene adds its parameters, `poincare`, `body` if it is not the section, and `weights`, the pixels per unit of each
    variable.  The orbit starts at the parameter `place`, or at another state `chosen_start`.
    """

    periodic: str = choice_of_orbit()
    indicator: str = colouring()
    count: float = crossings_of_each()
    reach: float = length_of_manifolds()
    span: float = time_span(40.0, 200.0, what="the chosen orbit")
    certain: str = show_proved_error()
    accuracy: str = accuracy_level()
    place: str = ""
    window: str = ""

    @property
    @abstractmethod
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def body(self) -> Body:
        """The equations and their parameters.  Raises `ModelError`."""
        return self.poincare

    @property
    def chosen_start(self) -> Start:
        """The chosen initial state.  Raises `ModelError`."""
        return start_on(self.poincare, self.place)

    section = part(Section)
    density = part(lambda s: SectionDensity(s.section, s.shows_density))
    megno = part(lambda s: Indicator(s.section, s.indicator == MEGNO and s.section.is_exclusive))
    periodic_orbit = part(lambda s: SectionPeriodicOrbit(s.section, s.periodic, s.reach))
    orbit = part(BodyOrbit)
    proof = part(lambda s: OrbitProof(s.orbit, s.certain))

    @property
    def shows_density(self) -> bool:
        """True if the density is shown: it is chosen, and the window shows nothing else."""
        return self.indicator == DENSITY and self.section.is_exclusive

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The periodic orbit; None if none is requested or known."""
        return self.periodic_orbit.closed_orbit

    @property
    def start(self) -> Start:
        """The initial state (d,) of the orbit: on the periodic orbit if it is known, otherwise the chosen one."""
        return self.chosen_start if self.closed_orbit is None else self.closed_orbit.state

    @property
    def duration(self) -> float:
        """The duration of the orbit: one period of the periodic orbit if it is known, otherwise the time span."""
        return self.span if self.closed_orbit is None else self.closed_orbit.time

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit; by default a body of the Suslov problem with e = e3, or a ball."""
        return constrained_solid(self.work, self.body, self.orbit.path)

    def motion(self) -> Motion | None:
        """Return the motion of the orbit."""
        return self.orbit.motion()

    def start_at(self, x: float, y: float) -> Values:
        """Return the parameters of an orbit that starts at a point of the section."""
        return {"place": points_text([(x, y)])}

    @property
    def section_caption(self) -> Caption | None:
        """The caption of a section with a periodic orbit or MEGNO; None without them."""
        return self.periodic_orbit.caption or self.megno.caption


@dataclass(frozen=True)
class FilledState(SectionState):
    """A state with a section whose window is filled with orbits; clicks start further orbits."""

    orbits: float = orbits_spread(40.0, 120.0, 300.0)
    count: float = points_of_each(200.0)
    long: float = exponent_time(1000.0, 5000.0, 2e4, "the Lyapunov exponent and the divergence are")
    starts: str = ""

    exponent = part(OrbitExponent)

    @property
    def chosen_start(self) -> Start:
        """The last chosen initial state.  Raises `ModelError`."""
        return self.section.starts[-1]
