"""Parts of a scene: each computes one result and its texts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, Protocol, Self, TypeVar

from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.work import Work
from hess_mechanics.dynamics.return_map import PoincareSection

Start = tuple[float, ...]
"""The initial state (d,) of a motion."""


class Host(Protocol):
    """The state or part that a part belongs to."""

    @property
    def work(self) -> Work:
        """The computation of the current state."""


class HasSection(Host, Protocol):
    """A host with a section."""

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""


H_co = TypeVar("H_co", bound=Host, covariant=True)


@dataclass(frozen=True, eq=False)
class Part(Generic[H_co]):
    """One result of a scene with its texts; a state declares it with `@part`.

    Results are cached properties, computed when a visible picture needs them.

    Attributes
    ----------
    host : Host
        The state or part that it belongs to.  Each class of parts declares the required members of the host in a
        `Protocol`.
    """

    host: H_co

    @property
    def work(self) -> Work:
        """The computation of the current state."""
        return self.host.work

    def has_result(self, name: str) -> bool:
        """Return whether this cached property is computed already.  Texts use it, because they start no computation."""
        return name in vars(self)

    def corrections(self, notes: list[str]) -> Values:
        """Return the parameter changes that make the state valid; append a note for each of them."""
        return {}

    def idle_values(self) -> Mapping[str, float]:
        """Return the parameters without effect in this state, with the values shown by their disabled controls.

        May raise `ModelError`.
        """
        return {}

    def meanings(self) -> Mapping[str, str]:
        """Return the meanings, as `NumberSpec.meaning`, of the parameters whose meaning depends on a choice."""
        return {}

    def adjustments(self, before: Self) -> Values:
        """Return the parameter changes that keep the motion continuous after a different choice.

        `before` is the same part of the previous state.  May raise `ModelError`.
        """
        return {}

    def quantities(self) -> Iterable[str]:
        """Return derived quantities, one line each."""
        return ()

    def status(self) -> Iterable[str]:
        """Return entries of the status line: size, cost and error of the results."""
        return ()

    def notes(self) -> Iterable[str]:
        """Return the notes on this state."""
        return ()


P = TypeVar("P", bound=Part[Host])


class part(cached_property[P]):  # noqa: N801 — used as a decorator, like cached_property
    """Decorator that declares a part of a state; texts appear in the order of the declarations."""
