"""One room: a lecturer, followers, and their guesses."""

from __future__ import annotations

import asyncio
import hmac
import json
import secrets
import time
from collections.abc import Mapping
from contextlib import suppress
from typing import Protocol

from hess_explorer.lessons.lesson import Lesson, Prediction
from hess_explorer.rooms.drawing import Frames, RoomDrawing, step_of
from hess_explorer.rooms.messages import Guess, Show

PERIOD = 0.5
"""Minimum interval between two states in seconds."""
GRACE = 60.0
"""Seconds that a room waits for a lecturer whose page was closed or reloaded."""
LONGEST = 3 * 3600.0
"""Maximum age of a room in seconds."""
MAX_FOLLOWERS = 500
AT_ONCE, PAUSE = 10, 0.005
"""Number of followers to which a state is sent at once, and the pause in seconds before the next ones.

During a pause the event loop processes the lecturer's own requests.
"""

ENDED = 4001, "The lecture has ended."
REPLACED = 4002, "This room is led from another page now."
"""Codes and reasons of close frames; codes from 4000 on belong to the application."""


class Member(Protocol):
    """The websocket of a lecturer or follower."""

    def put(self, kind: str, message: str | bytes) -> None:
        """Send a message, which replaces a waiting message of the same kind."""

    def close(self, code: int, reason: str) -> None:
        """Close the websocket."""


class Room:
    """A room, from the first message of its lecturer until it ends; used only in the thread of the event loop.

    Parameters
    ----------
    lessons : mapping
        Available lessons by name.

    Attributes
    ----------
    key : str
        Random key, which identifies the lecturer.
    """

    def __init__(self, lessons: Mapping[str, Lesson]) -> None:
        self.key = secrets.token_urlsafe(32)
        self._lessons = lessons
        self._drawing = RoomDrawing(lessons)
        self._made = self._left = time.monotonic()
        self._lead: Member | None = None
        self._followers: dict[Member, str] = {}
        self._guesses: dict[str, tuple[tuple[float, float], ...]] = {}
        self._show: Show | None = None
        self._is_drawn = True
        self._frames: Frames | None = None
        self._counts: tuple[int, int] | None = None
        self._news = asyncio.Event()
        self._is_over = False

    @property
    def followers(self) -> int:
        """Number of followers."""
        return len(self._followers)

    def is_lecturer_key(self, key: str) -> bool:
        """Return whether this is the key of the lecturer, in a time that does not depend on the key."""
        return hmac.compare_digest(self.key.encode(), key.encode("utf-8", "replace"))

    def lead(self, member: Member) -> None:
        """Make a websocket the lecturer's, in place of an earlier websocket."""
        if self._lead is not None:
            self._lead.close(*REPLACED)
        self._lead, self._counts = member, None
        self._news.set()

    def follow(self, member: Member, name: str) -> bool:
        """Add a follower and send it the last state, if any; return False if the room is full."""
        if len(self._followers) >= MAX_FOLLOWERS:
            return False
        self._followers[member] = name
        if self._frames is not None:
            self._send(member, self._frames, with_scene=True)
        self._news.set()
        return True

    def leave(self, member: Member) -> None:
        """Remove a websocket that has closed."""
        if member is self._lead:
            self._lead, self._left = None, time.monotonic()
        elif self._followers.pop(member, None) is not None:
            self._news.set()

    def show(self, member: Member, show: Show) -> None:
        """Show a state to all followers, if the lecturer sends it; send the lecturer the guesses that it reveals."""
        if member is not self._lead or show == self._show:
            return
        before, self._show = self._show, show
        if before is None or (before.lesson, before.step) != (show.lesson, show.step):
            self._guesses.clear()
        elif self._prediction is not None and show.revealed and not before.revealed:
            member.put("cloud", json.dumps({"cloud": [*self._guesses.values()]}))
        self._is_drawn = False
        self._news.set()

    def guess(self, member: Member, guess: Guess) -> None:
        """Store the guess of a follower, in place of an earlier one, until the prediction is revealed.

        A guess at a point is the last clicked point.
        """
        name, asked, show = self._followers.get(member), self._prediction, self._show
        if name is None or asked is None or show is None or show.revealed or guess.step != show.step:
            return
        if name in self._guesses or len(self._guesses) < MAX_FOLLOWERS:
            self._guesses[name] = guess.points[-1:] if asked.kind == "point" else guess.points
            self._news.set()

    def end(self, member: Member) -> None:
        """End the room, if the lecturer requests it."""
        if member is self._lead:
            self._is_over = True
            self._news.set()

    @property
    def _prediction(self) -> Prediction | None:
        """The prediction of the current step; None without a prediction."""
        step = step_of(self._lessons, self._show) if self._show is not None else None
        return step.prediction if step is not None else None

    async def run(self) -> None:
        """Draw and send states until the room ends."""
        try:
            while not self._has_ended():
                with suppress(TimeoutError):
                    await asyncio.wait_for(self._news.wait(), PERIOD)
                self._news.clear()
                begun = time.monotonic()
                await self._draw()
                self._tell_lead()
                await asyncio.sleep(max(0.0, begun + PERIOD - time.monotonic()))
        finally:
            self._drawing.end()
            for member in [*self._followers, *([self._lead] if self._lead is not None else [])]:
                member.close(*ENDED)
            self._followers.clear()
            self._guesses.clear()

    def _has_ended(self) -> bool:
        now = time.monotonic()
        return self._is_over or now - self._made > LONGEST or (self._lead is None and now - self._left > GRACE)

    async def _draw(self) -> None:
        if self._show is None or (self._is_drawn and not self._drawing.has_updates):
            return
        self._is_drawn = True
        frames = await self._drawing.draw(self._show)
        if frames is None:
            return
        is_new = self._frames is None or frames.scene != self._frames.scene
        self._frames = frames
        followers = [*self._followers]
        for first in range(0, len(followers), AT_ONCE):
            for member in followers[first : first + AT_ONCE]:
                self._send(member, frames, with_scene=is_new)
            await asyncio.sleep(PAUSE)

    def _send(self, member: Member, frames: Frames, *, with_scene: bool) -> None:
        if with_scene:
            member.put("scene", frames.scene)
        member.put("state", frames.state)

    def _tell_lead(self) -> None:
        told = len(self._followers), len(self._guesses)
        if self._lead is not None and told != self._counts:
            self._counts = told
            self._lead.put("counts", json.dumps({"followers": told[0], "guesses": told[1]}))
