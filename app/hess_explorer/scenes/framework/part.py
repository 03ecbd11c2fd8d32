"""Parts of a scene: each is one result with its texts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, Protocol, Self, TypeVar

from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.work import Work
from hess_mechanics.dynamics.return_map import PoincareSection

__all__ = ["Host", "Part", "Sectioned", "Start", "part"]

Start = tuple[float, ...]
"""The initial state of a motion."""


class Host(Protocol):
    """The state or part that a part belongs to."""

    @property
    def work(self) -> Work:
        """The computation of the state on show."""


class Sectioned(Host, Protocol):
    """A host with a section."""

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""


H_co = TypeVar("H_co", bound=Host, covariant=True)


@dataclass(frozen=True, eq=False)
class Part(Generic[H_co]):
    """One result of a scene with its texts; the state declares it with `@part`.

    Attributes
    ----------
    host : H_co
        The state or part that it belongs to.  Each class of parts declares in a `Protocol` the members of the host that
        it needs.  Results are cached properties, computed when a picture in sight needs them.
    """

    host: H_co

    @property
    def work(self) -> Work:
        """The computation of the state on show."""
        return self.host.work

    def has_result(self, name: str) -> bool:
        """Return whether a picture in sight has computed this cached property; texts never compute one."""
        return name in vars(self)

    def corrections(self, notes: list[str]) -> Values:
        """Return the parameters that have to change for a valid state; append a note for each change."""
        return {}

    def idle(self) -> Mapping[str, float]:
        """Return the numbers without effect in this state, with the values that their disabled controls show."""
        return {}

    def means(self) -> Mapping[str, str]:
        """Return the meanings, as `Number.means`, of the numbers whose meaning depends on a choice."""
        return {}

    def adjustments(self, before: Self) -> Values:
        """Return the parameter changes that keep the motion continuous after a different choice."""
        return {}

    def quantities(self) -> Iterable[str]:
        """Return quantities that follow from the parameters, a line each."""
        return ()

    def status(self) -> Iterable[str]:
        """Return entries of the status line: size, cost and errors of the results."""
        return ()

    def notes(self) -> Iterable[str]:
        """Return the notes on this state."""
        return ()


P = TypeVar("P", bound=Part[Host])


class part(cached_property[P]):  # noqa: N801 — used as a decorator, like cached_property
    """Declare a part of a state; its texts appear in the order of the declarations."""
