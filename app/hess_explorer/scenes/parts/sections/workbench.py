"""States of a scene with a section: what they show of it, and the orbit that starts there."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from hess_explorer.scenes.framework.cells import DENSITY
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.periodic_search import Closed
from hess_explorer.scenes.framework.scene import Motion, State
from hess_explorer.scenes.parts.sections.density import Density
from hess_explorer.scenes.parts.sections.indicator import MEGNO, Indicator
from hess_explorer.scenes.parts.sections.orbit import Orbit
from hess_explorer.scenes.parts.sections.periodic_orbit import PeriodicOrbit
from hess_mechanics.numerics.results import Array

__all__ = ["SectionState", "shown_in_section"]


class SectionState(State):
    """A state with an orbit from its section, or with the periodic orbit in place of it."""

    periodic_orbit: part[PeriodicOrbit]
    orbit: part[Orbit]

    @property
    def closed(self) -> Closed | None:
        """The periodic orbit, if known."""
        return self.periodic_orbit.closed

    @property
    def start(self) -> Start:
        """The initial state of the orbit on show."""
        return self.periodic_orbit.start

    @property
    def lasts(self) -> float:
        """The length of the orbit in time."""
        return self.periodic_orbit.lasts

    def motion(self) -> Motion | None:
        """Return the orbit on show."""
        return self.orbit.motion()


def shown_in_section(
    kinds: int = 0, kind_of: Callable[[Any, Array], Array] | None = None
) -> tuple[part[Density], part[Indicator], part[PeriodicOrbit]]:
    """Return the density, the cells of MEGNO and the periodic orbit of the `section` of a state.

    kinds, kind_of(state, states) : as of `Density`.
    """
    return (
        part(
            lambda s: Density(
                s.section, s.indicator == DENSITY and s.section.alone, kinds, kind_of and partial(kind_of, s)
            )
        ),
        part(lambda s: Indicator(s.section, s.indicator == MEGNO and s.section.alone)),
        part(lambda s: PeriodicOrbit(s.section, s.periodic, s.reach, s.span)),
    )
