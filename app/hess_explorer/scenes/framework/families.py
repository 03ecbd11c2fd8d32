"""A section over one of the parameters of its scene, and where the branch of a periodic orbit begins on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.protocol.parameters import Value
from hess_explorer.scenes.framework.part import Sectioned
from hess_explorer.scenes.framework.periodic_search import Closed, Missed, Place, sought
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.numerics.accuracy import PRECISE

__all__ = ["Begin", "Family"]


@dataclass(frozen=True)
class Family:
    """A scene's section, and its return map, over one of its parameters.

    state : of the scene; name, symbol : of the parameter; others : what else the section depends on, by name.
    """

    state: Callable[..., Sectioned]
    name: str
    symbol: str
    others: tuple[tuple[str, Value], ...]

    @classmethod
    def of(cls, state: Sectioned, name: str, symbol: str, names: tuple[str, ...]) -> Family:
        """About a state; names : of all that the section depends on."""
        return cls(type(state), name, symbol, tuple((one, getattr(state, one)) for one in names if one != name))

    def __call__(self, value: float) -> PoincareSection:
        """The section at a value of the parameter.  Raises `ModelError`."""
        return self.state(**dict(self.others), **{self.name: value}).poincare

    def map_at(self, value: float) -> ReturnMap:
        """The return map there.  Raises `ModelError`."""
        return ReturnMap(self(value), PRECISE)


@dataclass(frozen=True)
class Begin:
    """Where a branch begins: the value of the parameter, the place and the period, and the ends of the range."""

    family: Family
    value: float
    place: Place
    period: int | None
    ends: tuple[float, float]

    @property
    def map(self) -> ReturnMap:
        """The return map there.  Raises `ModelError`."""
        return self.family.map_at(self.value)

    @property
    def search(self) -> Task:
        """What finds the orbit there.  Raises `ModelError`."""
        return Task(sought, (self.map, self.place, self.period, False))

    def orbit(self) -> Closed | Missed:
        """Return the orbit there.  Raises `ModelError`."""
        found: Closed | Missed = CACHE.get(self.search.function, *self.search.arguments)[0]
        return found
