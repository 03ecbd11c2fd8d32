"""All mistakes of a lesson file, not only the first."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from hess_explorer.lessons.lesson import LessonError

__all__ = ["Problems"]

T = TypeVar("T")
P = ParamSpec("P")


class Problems:
    """Collects the mistakes of a file while it is read on.

    found : the mistakes in the order in which they were found.
    """

    def __init__(self) -> None:
        self.found: list[LessonError] = []

    def add(self, message: str, line: int) -> None:
        """Add the mistake in a line."""
        self.found.append(LessonError(message, line))

    def attempt(self, instead: T, read: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T:
        """Return what `read` returns, or keep its `LessonError` and return `instead`."""
        try:
            return read(*arguments, **named)
        except LessonError as error:
            self.found.append(error)
            return instead

    def raise_first(self) -> None:
        """Raise the first mistake, if there is one."""
        if self.found:
            raise self.found[0]
