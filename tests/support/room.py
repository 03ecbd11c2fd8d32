"""Clients of a room without a browser: a lecturer, and followers."""

import asyncio
import json
import random
import time

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from support.visitor import Closed
from support.wire import read_frame


def new_code():
    """Return a code that probably no room has."""
    return "".join(random.choices("23456789ABCDEFGHJKMNPQRSTUVWXYZ", k=6))


class Member:
    """One websocket of a room."""

    def __init__(self, socket):
        self._socket = socket

    @classmethod
    async def connect(cls, base, code, first, origin=None, **options):
        """Connect to the room and send the first message; origin : of the page that opens the websocket."""
        url, headers = f"ws{base.removeprefix('http')}/rooms/{code}", {"Origin": origin or base}
        request = HTTPRequest(url, headers=headers, connect_timeout=60.0, **options)
        member = cls(await websocket_connect(request, max_message_size=2**26))
        await member.say(first)
        return member

    async def say(self, message):
        """Send a message; text is sent as it is."""
        frame = message if isinstance(message, str | bytes) else json.dumps(message)
        await self._socket.write_message(frame, binary=isinstance(frame, bytes))

    async def read(self, timeout=30.0):
        """Return the next frame."""
        frame = await asyncio.wait_for(self._socket.read_message(), timeout)
        if frame is None:
            raise Closed(f"{self._socket.close_code}: {self._socket.close_reason}")
        return frame

    async def end(self, timeout=30.0):
        """Return the reason for which the server closes the websocket."""
        try:
            while True:
                await self.read(timeout)
        except Closed as why:
            self._socket.close()
            return str(why)

    async def leave(self):
        """Close the websocket, as a closed tab does."""
        self._socket.close()
        while await self._socket.read_message() is not None:
            pass


class Lecturer(Member):
    """The lecturer of a room."""

    followers = guesses = 0
    cloud = None

    @classmethod
    async def open(cls, base, code=None, **options):
        """Open a room."""
        code = code or new_code()
        found = await cls.connect(base, code, {"open": True}, **options)
        found.code, found.key = code, (await found.hear())["key"]
        return found

    async def again(self, base):
        """Return the lecturer of the same room after a reload of the page."""
        found = await type(self).connect(base, self.code, {"lead": self.key})
        found.code, found.key = self.code, self.key
        return found

    async def hear(self, timeout=30.0):
        """Return the next message."""
        told = json.loads(await self.read(timeout))
        for name in ("followers", "guesses", "cloud"):
            setattr(self, name, told.get(name, getattr(self, name)))
        return told

    async def until(self, condition, timeout=30.0):
        """Read messages until a condition holds."""
        ends = time.monotonic() + timeout
        while not condition(self):
            await self.hear(ends - time.monotonic())

    async def show(self, query, lesson="", step=0, *, revealed=False, picture=""):
        """Show a state."""
        shown = {"query": query, "lesson": lesson, "step": step, "revealed": revealed, "picture": picture}
        await self.say({"show": shown})


class Follower(Member):
    """A follower of a room: the last description, state, and what is told beside it."""

    scene = state = told = None
    states = bytes = 0

    @classmethod
    async def follow(cls, base, code, name=None, **options):
        """Join a room."""
        return await cls.connect(base, code, {"follow": name or new_code() + new_code()}, **options)

    async def hear(self, timeout=30.0):
        """Read the next frame."""
        frame = await self.read(timeout)
        self.bytes += len(frame)
        told, _ = read_frame(frame)
        self.scene = told.get("scene", self.scene)
        if "state" in told:
            self.state, self.told = told["state"], told["show"]
            self.states += 1
        return told

    async def until(self, condition, timeout=30.0):
        """Read frames until a condition holds."""
        ends = time.monotonic() + timeout
        while self.state is None or not condition(self):
            await self.hear(ends - time.monotonic())
        return self
