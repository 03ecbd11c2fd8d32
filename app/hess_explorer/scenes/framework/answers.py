"""The sentence above the pictures, which says what a state shows, for a second-year student."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

S = TypeVar("S")


@dataclass(frozen=True)
class Answer(Generic[S]):
    """A sentence on the states for which it holds.

    Parameters
    ----------
    sentence : str
        At most 90 characters, which fit on a line.
    condition : callable
        `condition(state)` returns True if the sentence holds, by a closed form or a result that the pictures need; by
        default always.
    """

    sentence: str
    condition: Callable[[S], bool] = lambda _: True
