"""Limit the number of sessions of one process, because each takes memory."""

from __future__ import annotations

import panel as pn

__all__ = ["Capacity"]


class Capacity:
    """Counts the open sessions; used only in the thread of the event loop."""

    def __init__(self, most: int) -> None:
        self.most = most
        self.there = 0

    def take(self) -> bool:
        """Count the session that is being opened until it is destroyed; return False if the server is full."""
        if self.there >= self.most:
            return False
        self.there += 1
        pn.state.on_session_destroyed(self._gone)
        return True

    def _gone(self, context: object) -> None:
        self.there -= 1

    @property
    def sentence(self) -> str:
        """The message for users who find the server full."""
        return (
            f"The explorer is full: this server can have at most {self.most} open pages. Try again in a minute, or "
            "install the explorer on your own machine."
        )
