"""The number of rooms and of followers is bounded.

In a module of its own, because the end of a server ends all others of the process.
"""

from hess_explorer.rooms import registry, room
from support.asynchronous import finished
from support.room import Follower, Lecturer, new_code
from support.serving import served


def test_rooms_and_followers_are_bounded(monkeypatch):
    monkeypatch.setattr(registry, "MOST_ROOMS", 2)
    monkeypatch.setattr(room, "MOST_FOLLOWERS", 2)

    async def visit(base):
        lecturers = [await Lecturer.open(base) for _ in range(2)]
        third = await Lecturer.connect(base, new_code(), {"open": True})
        whys = [await third.end()]
        code = lecturers[0].code
        inside = [await Follower.follow(base, code) for _ in range(2)]
        await lecturers[0].until(lambda one: one.followers == 2)
        whys.append(await (await Follower.follow(base, code)).end())
        await inside[0].leave()
        await lecturers[0].until(lambda one: one.followers == 1)
        again = await Follower.follow(base, code)
        await lecturers[0].until(lambda one: one.followers == 2)
        for member in (again, inside[1], *lecturers):
            await member.leave()
        return whys

    with served() as base:
        assert finished(visit(base)) == [
            "1013: There are too many rooms at the moment: try again later.",
            "1013: The room is full.",
        ]
