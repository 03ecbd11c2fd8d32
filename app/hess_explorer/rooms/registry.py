"""The rooms of one process."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.rooms.room import Room

MAX_ROOMS = 20


class Rooms:
    """The rooms of one process, by code; used only in the thread of the event loop.

    Parameters
    ----------
    lessons : mapping
        Available lessons by name.
    """

    def __init__(self, lessons: Mapping[str, Lesson]) -> None:
        self._lessons = lessons
        self._rooms: dict[str, Room] = {}
        # The event loop keeps no strong references to its tasks.
        self._running: set[asyncio.Task[None]] = set()

    def find(self, code: str) -> Room | None:
        """Return the room with a code; None if there is none."""
        return self._rooms.get(code)

    @property
    def is_full(self) -> bool:
        """True if no other room can be opened."""
        return len(self._rooms) >= MAX_ROOMS

    def open(self, code: str) -> Room:
        """Open and return a room, which is removed when it ends."""
        room = self._rooms[code] = Room(self._lessons)
        task = asyncio.get_running_loop().create_task(room.run())
        self._running.add(task)

        def gone(task: asyncio.Task[None]) -> None:
            self._running.discard(task)
            del self._rooms[code]

        task.add_done_callback(gone)
        return room

    def metrics(self) -> dict[str, int]:
        """Return the number of rooms and of followers."""
        return {"rooms": len(self._rooms), "followers": sum(room.followers for room in self._rooms.values())}
