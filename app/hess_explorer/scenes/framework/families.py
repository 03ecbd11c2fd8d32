"""A section over one parameter of its scene, and the start of a branch of periodic orbits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Value
from hess_explorer.scenes.framework.part import HasSection
from hess_explorer.scenes.framework.periodic_search import ClosedOrbit, NotFound, Point, find_orbit
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.numerics.accuracy import PRECISE


@dataclass(frozen=True)
class Family:
    """A scene's section and its return map over one parameter.

    Attributes
    ----------
    state : callable
        Class of the scene's states.
    name, symbol : str
        Name and symbol of the parameter.
    others : tuple
        Names and values of all other parameters of the section.
    """

    state: Callable[..., HasSection]
    name: str
    symbol: str
    others: tuple[tuple[str, Value], ...]

    @classmethod
    def of(cls, state: HasSection, name: str, symbol: str, names: tuple[str, ...]) -> Family:
        """Return the family that contains a state.

        Parameters
        ----------
        state : HasSection
            The state.
        name, symbol : str
            Name and symbol of the parameter.
        names : tuple of str
            Names of all parameters of the section.
        """
        return cls(type(state), name, symbol, tuple((one, getattr(state, one)) for one in names if one != name))

    def __call__(self, value: float) -> PoincareSection:
        """Return the section at a value of the parameter.  Raises `ModelError`."""
        return self.state(**dict(self.others), **{self.name: value}).poincare

    def map_at(self, value: float) -> ReturnMap:
        """Return the return map at a value of the parameter.  Raises `ModelError`."""
        return ReturnMap(self(value), PRECISE)


@dataclass(frozen=True)
class BranchStart:
    """Start of a branch of periodic orbits.

    Attributes
    ----------
    family : Family
        The section over the parameter.
    value : float
        Value of the parameter at the start.
    point : tuple of float
        Point in the section near the periodic orbit.
    period : int or None
        Period of the orbit; None for any up to 12.
    ends : (float, float)
        Range of the parameter, which contains `value`.
    """

    family: Family
    value: float
    point: Point
    period: int | None
    ends: tuple[float, float]

    @property
    def search(self) -> Task[ClosedOrbit | NotFound]:
        """The task that searches for the orbit at the start.  Raises `ModelError`."""
        return Task(find_orbit, self.family.map_at(self.value), self.point, self.period, False)
