"""The sentence above the pictures, which says what a state shows, for a second-year student."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

S = TypeVar("S")


@dataclass(frozen=True)
class Answer(Generic[S]):
    """Sentence above the pictures, for the states that satisfy a condition.

    Parameters
    ----------
    sentence : str
        At most 90 characters, which fit on a line.
    condition : callable
        `condition(state)` returns True if the sentence is true of the state; by default always.  It has to be cheap: a
        closed form, or a result that the pictures compute anyway.  It may raise `ModelError`.
    """

    sentence: str
    condition: Callable[[S], bool] = lambda _: True
