"""How many sessions one process serves: memory for each is what a server has least of."""

from __future__ import annotations

import panel as pn

__all__ = ["Capacity"]


class Capacity:
    """Counts the sessions that are there; called in the thread that serves."""

    def __init__(self, most: int) -> None:
        self.most = most
        self.there = 0

    def take(self) -> bool:
        """Whether there is room for the session that is being opened; it is counted until it is gone."""
        if self.there >= self.most:
            return False
        self.there += 1
        pn.state.on_session_destroyed(self._gone)
        return True

    def _gone(self, context: object) -> None:
        self.there -= 1

    @property
    def sentence(self) -> str:
        """For who finds none."""
        return (
            f"The explorer is full: as many pages are open as this server has room for ({self.most}). Try again in "
            "a minute, or install the explorer on your own machine."
        )
