"""Clients of a room without a browser: a lecturer, and followers."""

import json
import random
import time
from contextlib import asynccontextmanager

from support.visitor import Socket
from support.wire import read_frame


def new_code():
    """Return a code that probably no room has."""
    return "".join(random.choices("23456789ABCDEFGHJKMNPQRSTUVWXYZ", k=6))


class Member(Socket):
    """One websocket of a room."""

    @classmethod
    async def connect(cls, base, code, first, **options):
        """Connect to the room and send the first message; options : those of `Socket.to`."""
        member = await cls.to(base, f"rooms/{code}", **options)
        await member.say(first)
        return member


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
    states = 0

    @classmethod
    async def follow(cls, base, code, name=None, **options):
        """Join a room."""
        return await cls.connect(base, code, {"follow": name or new_code() + new_code()}, **options)

    async def hear(self, timeout=30.0):
        """Read the next frame."""
        told, _ = read_frame(await self.read(timeout))
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


@asynccontextmanager
async def lecture(base, *names):
    """Yield the lecturer of a new room and a follower for each name; all leave at the end."""
    lecturer = await Lecturer.open(base)
    followers = [await Follower.follow(base, lecturer.code, name) for name in names]
    yield lecturer, *followers
    for member in (*followers, lecturer):
        await member.leave()
