"""A section over one of the parameters of its scene."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from hess_explorer.protocol.parameters import Value
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.numerics.accuracy import PRECISE

__all__ = ["Family"]


class Sectioned(Protocol):
    """A state with a section."""

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""


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
