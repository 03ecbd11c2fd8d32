"""The number of rooms and of followers is bounded.

In a module of its own, because the end of a server ends all others of the process.
"""

from hess_explorer.rooms import registry, room
from support.asynchronous import finished
from support.room import Follower, Lecturer, lecture, new_code
from support.serving import served


def test_rooms_and_followers_are_bounded(monkeypatch):
    monkeypatch.setattr(registry, "MAX_ROOMS", 2)
    monkeypatch.setattr(room, "MAX_FOLLOWERS", 2)

    async def visit(base):
        async with lecture(base), lecture(base, "first-phone", "second-phone") as (lecturer, one, _):
            third = await Lecturer.connect(base, new_code(), {"open": True})
            assert await third.end() == "1013: There are too many rooms at the moment: try again later."
            await lecturer.until(lambda one: one.followers == 2)
            late = await Follower.follow(base, lecturer.code)
            assert await late.end() == "1013: The room is full."
            await one.leave()
            await lecturer.until(lambda one: one.followers == 1)
            again = await Follower.follow(base, lecturer.code)
            await lecturer.until(lambda one: one.followers == 2)
            await again.leave()

    with served() as base:
        finished(visit(base))
