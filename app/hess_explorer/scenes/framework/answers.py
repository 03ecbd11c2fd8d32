"""The sentence above the pictures: what one sees in a state, for a second-year student."""

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
    sentence : at most 90 characters, which fit on a line.
    when(state) : whether it holds, by a closed form or a result that the pictures need anyway; always by default.
    """

    sentence: str
    when: Callable[[S], bool] = lambda _: True
