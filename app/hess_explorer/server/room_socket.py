"""The websocket of a room: one lecturer shows states, many followers receive them and send guesses."""

from __future__ import annotations

import asyncio
import json
from contextlib import suppress

from tornado.websocket import WebSocketClosedError, WebSocketHandler

from hess_explorer.protocol.messages import ALIVE
from hess_explorer.rooms.messages import End, Follow, Guess, Lead, Open, Show, parse
from hess_explorer.rooms.registry import Rooms
from hess_explorer.rooms.room import Room
from hess_explorer.server.hosts import is_allowed_origin
from hess_explorer.server.limits import OPEN_SOCKETS, RateLimit

SIZE, RATE, BURST = 8 * 1024, 10.0, 30.0
"""Maximum size of a message in bytes, messages per second, and burst size in messages."""

# Close codes of the application, see "page/room_socket.js".
TAKEN = 4003, "There is a room with this code."
UNKNOWN = 4004, "There is no such room: its lecture has ended, or the code is wrong."
FORGED = 4005, "This room belongs to another page."
SEVERAL = 4006, "Rooms need a server of one process: start the explorer without --workers."
FULL = 1013, "The room is full."
NO_ROOM_LEFT = 1013, "There are too many rooms at the moment: try again later."
NO_MESSAGE = 1007, "This is not a message of a room."


class Outbox:
    """Messages to one websocket; while one is being sent, only the newest of each kind waits."""

    def __init__(self, socket: WebSocketHandler) -> None:
        self._socket = socket
        self._waiting: dict[str, str | bytes] = {}
        self._sending: asyncio.Task[None] | None = None

    def put(self, kind: str, message: str | bytes) -> None:
        """Send a message after all others; it replaces a waiting message of the same kind."""
        self._waiting.pop(kind, None)
        self._waiting[kind] = message
        if self._sending is None or self._sending.done():
            self._sending = asyncio.get_running_loop().create_task(self._send())

    async def _send(self) -> None:
        with suppress(WebSocketClosedError):
            while self._waiting:
                message = self._waiting.pop(next(iter(self._waiting)))
                await self._socket.write_message(message, binary=isinstance(message, bytes))


class RoomSocket(WebSocketHandler):
    """The websocket of a lecturer or follower, at the URL of its room.

    Messages are those of `hess_explorer.rooms.messages`.  The first one determines the role of the websocket.
    """

    # A phone that stops responding loses its place; it reconnects when it wakes up.
    ping_interval = 25.0
    ping_timeout = 20.0

    def initialize(self, rooms: Rooms, workers: int) -> None:
        """Store the rooms of this process, and the number of processes of the server."""
        self._rooms, self._workers = rooms, workers
        self._code = ""
        self._room: Room | None = None
        self._outbox = Outbox(self)

    def check_origin(self, origin: str) -> bool:
        """Return whether the origin is allowed."""
        return is_allowed_origin(self, origin)

    def open(self, code: str) -> None:
        """Register this websocket as open; its first message determines its role."""
        OPEN_SOCKETS.add(self)
        self.set_nodelay(True)
        self._code, self._limit = code, RateLimit(rate=RATE, burst=BURST, size=SIZE)

    def put(self, kind: str, message: str | bytes) -> None:
        """Send a message; it replaces a waiting one of the same kind."""
        self._outbox.put(kind, message)

    def on_message(self, message: str | bytes) -> None:
        """Process a message within the limits; close the websocket after an invalid or unexpected message."""
        if not self._limit.accepts(self, message):
            return
        try:
            told = json.loads(message)
        except (ValueError, RecursionError):
            told = None
        if told == ALIVE:
            self.put("alive", "")
            return
        match parse(told), self._room:
            case (Open() | Lead() | Follow()) as wish, None:
                self._enter(wish)
            case Show() as show, Room() as room:
                room.show(self, show)
            case Guess() as guess, Room() as room:
                room.guess(self, guess)
            case End(), Room() as room:
                room.end(self)
            case _:
                self.close(*NO_MESSAGE)

    def _enter(self, wish: Open | Lead | Follow) -> None:
        room = self._rooms.find(self._code)
        match wish:
            case _ if self._workers > 1:
                # With several processes, a follower may have reached another one than the lecturer.
                self.close(*SEVERAL)
            case Open() if room is not None:
                self.close(*TAKEN)
            case Open() if self._rooms.is_full:
                self.close(*NO_ROOM_LEFT)
            case Open():
                room = self._rooms.open(self._code)
                room.lead(self)
                self.put("key", json.dumps({"key": room.key}))
                self._room = room
            case _ if room is None:
                self.close(*UNKNOWN)
            case Lead(key) if room.is_lecturer_key(key):
                room.lead(self)
                self._room = room
            case Lead():
                self.close(*FORGED)
            case Follow(name):
                if room.follow(self, name):
                    self._room = room
                else:
                    self.close(*FULL)

    def on_close(self) -> None:
        """Leave the room."""
        OPEN_SOCKETS.discard(self)
        if self._room is not None:
            self._room.leave(self)
            self._room = None
