"""Rooms: followers see what the lecturer shows, guess, sleep and return, and cannot steer."""

import asyncio
import time
from contextlib import suppress

import pytest
from tornado.httpclient import HTTPClientError
from tornado.websocket import WebSocketClosedError

from hess_explorer.lessons import package_lessons
from hess_explorer.protocol.messages import ALIVE
from hess_explorer.protocol.specs import encode
from hess_explorer.rooms import room
from hess_explorer.scenes import scenes
from hess_explorer.server.room_socket import Outbox
from support.asynchronous import awaited
from support.room import Follower, Lecturer, lecture

ENDED = "4001: The lecture has ended."
NO_MESSAGE = "1007: This is not a message of a room."

LESSON, STEP = next(
    (one, i) for one in package_lessons().values() for i, step in enumerate(one.steps, 1) if step.prediction
)


def query(h):
    return f"scene=suslov-hess&h={h}"


def shows(text):
    return lambda follower: text in follower.state["query"]


@awaited
async def test_followers_see_the_last_state_of_the_lecturer_whenever_they_come(base):
    async with lecture(base, "early-phone") as (lecturer, early):
        await lecturer.show(query(1.25), picture="omega")
        await early.until(shows("h=1.25"))
        late = await Follower.follow(base, lecturer.code)
        await late.until(shows("h=1.25"))
        for one in (early, late):
            assert one.scene["name"] == one.state["scene"] == "suslov-hess/omega"
            assert [picture["name"] for picture in one.scene["pictures"]] == ["omega"]
            assert one.told["scene"] == scenes()["suslov-hess"].title
        # Another picture of the same state, and another scene.
        await lecturer.show(query(1.25), picture="circle")
        await early.until(lambda one: one.state["scene"] == "suslov-hess/circle")
        assert [picture["name"] for picture in early.scene["pictures"]] == ["circle"]
        await lecturer.show("scene=loxodrome")
        await early.until(shows("scene=loxodrome"))
        await lecturer.until(lambda one: one.followers == 2)
        await late.leave()
        await lecturer.until(lambda one: one.followers == 1)
        # All members hear that the server is alive.
        for one in (lecturer, early):
            await one.say(ALIVE)
            assert await one.read() == ""


@awaited
async def test_of_many_states_at_most_two_a_second_are_sent_and_always_the_last_one(base):
    async with lecture(base, "first-phone") as (lecturer, follower):
        await lecturer.show(query(1.0), picture="omega")
        await follower.until(shows("h=1"))
        before, begun = follower.states, time.monotonic()
        for i in range(10):
            await lecturer.show(query(round(1.0 + 0.01 * (i + 1), 2)), picture="omega")
            await asyncio.sleep(0.11)
        await follower.until(shows("h=1.1&"))
        assert 2 <= follower.states - before <= 2 * (time.monotonic() - begun) + 1


@awaited
async def test_guesses_are_counted_once_for_each_page_and_shown_to_the_lecturer_when_revealed(base):
    step, other = LESSON.steps[STEP - 1 : STEP + 1]
    at, then, following = (encode(one.scene, one.values) for one in (step.state, step.prediction.outcome, other.state))

    def guess(x, step=STEP):
        return {"guess": [[x, 0.5]], "step": step}

    async with lecture(base, "first-phone", "second-phone") as (lecturer, one, two):
        await lecturer.show(at, LESSON.name, STEP)
        for follower in (one, two):
            await follower.until(lambda one: one.told["step"] is not None)
        await one.say(guess(0.0))
        await lecturer.until(lambda one: one.guesses == 1)
        # It sleeps, returns, and guesses again.
        await one.leave()
        await lecturer.until(lambda one: one.followers == 1)
        assert lecturer.guesses == 1
        again = await Follower.follow(base, lecturer.code, "first-phone")
        await again.until(lambda one: one.told["step"] is not None)
        await again.say(guess(0.25))
        await two.say(guess(0.75))
        # A guess at another step came too late.
        await two.say(guess(7.0, STEP + 1))
        await lecturer.until(lambda one: one.guesses == 2)
        await lecturer.show(then, LESSON.name, STEP, revealed=True)
        await lecturer.until(lambda one: one.cloud is not None)
        await again.until(lambda one: one.told["revealed"])
        # No more guesses, and none is kept for the next step.
        await two.say(guess(0.0))
        await lecturer.show(following, LESSON.name, STEP + 1)
        await lecturer.until(lambda one: one.guesses == 0)
        assert sorted(lecturer.cloud) == [[[0.25, 0.5]], [[0.75, 0.5]]]
        await again.leave()


@awaited
async def test_who_has_not_the_key_cannot_lead_and_followers_cannot_steer(base):
    async with lecture(base, "first-phone") as (lecturer, follower):
        assert len(lecturer.key) >= 40
        await lecturer.show(query(1.25), picture="omega")
        await follower.until(shows("h=1.25"))
        for key in ("", lecturer.key[:-1], lecturer.key + "x", "é"):
            forged = await Lecturer.connect(base, lecturer.code, {"lead": key})
            assert await forged.end() == "4005: This room belongs to another page."
        taken = await Lecturer.connect(base, lecturer.code, {"open": True})
        assert await taken.end() == "4003: There is a room with this code."
        await Lecturer.show(follower, query(2.0))
        await follower.say({"end": True})
        late = await Follower.follow(base, lecturer.code)
        await late.until(shows("h=1.25"))
        before = follower.states
        await lecturer.show(query(1.5))
        await follower.until(shows("h=1.5"))
        assert follower.states == before + 1
        # A follower cannot become the lecturer later either.
        await follower.say({"lead": lecturer.key})
        assert await follower.end() == NO_MESSAGE
        await late.leave()


@awaited
async def test_a_room_outlives_a_reload_of_its_lecturer_and_ends_with_the_lecture(base, monkeypatch):
    monkeypatch.setattr(room, "GRACE", 1.0)
    async with lecture(base, "first-phone") as (lecturer, follower):
        await lecturer.leave()
        again = await lecturer.again(base)
        await again.until(lambda one: one.followers == 1)
        await asyncio.sleep(1.3)
        await again.show(query(1.5))
        await follower.until(shows("h=1.5"))
        # From another tab: there is one lecturer.
        other = await lecturer.again(base)
        assert await again.end() == "4002: This room is led from another page now."
        # The page is closed and does not come back.
        begun = time.monotonic()
        await other.leave()
        assert await follower.end() == ENDED
        assert 1.0 <= time.monotonic() - begun < 10.0
        late = await Follower.follow(base, lecturer.code)
        assert await late.end() == "4004: There is no such room: its lecture has ended, or the code is wrong."
    ended = await Lecturer.open(base)
    await ended.say({"end": True})
    assert await ended.end() == ENDED


@awaited
async def test_floods_and_nonsense_are_cut_off_and_the_others_go_on(base):
    async with lecture(base, "good-phone", "flooding-phone") as (lecturer, good, flood):
        # The server may close the socket while the rest is still being sent.
        with suppress(WebSocketClosedError):
            for _ in range(100):
                await flood.say({"guess": [[0.0, 0.0]], "step": 1})
        fast = "1008: More than 10 messages per second: wait for each response before you send again."
        assert await flood.end() == fast
        for first in ("{", b"\xff", "[" * 4000, '{"guess": [[0, 0]], "step": 1}'):
            assert await (await Follower.connect(base, lecturer.code, first)).end() == NO_MESSAGE
        for wrong, why in (
            ("x" * 9000, "1009: A message may have at most 8 KB: send a smaller one."),
            ({"guess": [[0.0, 0.0]] * 41, "step": 1}, NO_MESSAGE),
            ({"guess": [[0.0, "x"]], "step": 1}, NO_MESSAGE),
            ('{"guess": [[NaN, 0.0]], "step": 1}', NO_MESSAGE),
        ):
            one = await Follower.follow(base, lecturer.code)
            await one.say(wrong)
            assert await one.end() == why
        await lecturer.show(query(1.75))
        await good.until(shows("h=1.75"))
        with pytest.raises(HTTPClientError, match="404"):
            await Follower.follow(base, "nosuch")
        with pytest.raises(HTTPClientError, match="403"):
            await Follower.follow(base, lecturer.code, headers={"Origin": "http://evil.example"})


@awaited
async def test_to_a_follower_who_reads_nothing_only_the_newest_state_waits():
    """Otherwise the states that it has not read would fill the memory."""
    taken, sent = [], []

    class Slow:
        def write_message(self, message, binary):
            sent.append((message, binary))
            taken.append(asyncio.get_running_loop().create_future())
            return taken[-1]

    outbox = Outbox(Slow())
    for scene, states in (("A", "ab"), ("B", "cd")):
        outbox.put("scene", scene)
        for state in states:
            outbox.put("state", state.encode())
            await asyncio.sleep(0)
    assert sent == [("A", False)]
    while len(sent) < 3:
        taken[-1].set_result(None)
        await asyncio.sleep(0)
        await asyncio.sleep(0)
    # The description comes before the state that needs it.
    assert sent == [("A", False), ("B", False), (b"d", True)]
