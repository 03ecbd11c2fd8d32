"""A closed session leaves nothing behind."""

import asyncio
import gc
import threading
import time
import weakref
from contextlib import suppress

import panel as pn
import pytest
from tornado.httpclient import AsyncHTTPClient

from hess_explorer.page import connection
from hess_explorer.protocol.messages import ALIVE
from support.asynchronous import finished, wait_until
from support.serving import served
from support.visitor import Closed, Socket, Visitor


def test_a_session_that_is_left_is_freed_and_nothing_watches_for_it(monkeypatch):
    """Panel's pages follow its global state: that must not hold them."""
    opened = []

    class Recorded(connection.Session):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            opened.append(weakref.ref(self))

    def freed():
        gc.collect()
        return not any(one() for one in opened)

    monkeypatch.setattr(connection, "Session", Recorded)
    watchers = pn.state.param.watchers
    before = len(watchers.get("busy", {}).get("value", ()))

    async def visit(base):
        for _ in range(3):
            visitor = await Visitor.open(base)
            await visitor.ask(values={"h": 1.25})
            assert "h=1.25" in visitor.state["query"]
            await visitor.leave()
        # A session without a websocket computes nothing.
        await AsyncHTTPClient().fetch(base)

    with served(unused_session_lifetime_milliseconds=500, check_unused_sessions_milliseconds=50) as base:
        finished(visit(base))
        wait_until(freed)
    assert len(opened) == 3
    assert len(watchers.get("busy", {}).get("value", ())) == before


def test_a_page_hears_that_the_server_is_alive_while_its_state_is_computed(monkeypatch):
    computed = threading.Event()

    class Slow(connection.Session):
        def answer(self, request):
            if request.requested == 1:
                assert computed.wait(60.0)
            return super().answer(request)

    monkeypatch.setattr(connection, "Session", Slow)

    async def visit(base):
        visitor = await Visitor.open(base)
        await visitor.say({"requested": 1, "values": {"h": 1.25}})
        for _ in range(2):
            await visitor.say(ALIVE)
            assert await visitor.states.read(10.0) == ""
        computed.set()
        await visitor.hear()
        await visitor.leave()
        return visitor.state["query"]

    with served() as base:
        assert "h=1.25" in finished(visit(base))


def test_who_finds_no_room_reads_why_and_finds_it_when_another_has_left():
    async def visit(base):
        inside = [await Visitor.open(base) for _ in range(2)]
        with pytest.raises(Closed, match=r"this server can have at most 2 open pages"):
            await Visitor.open(base)
        # Nor is there a session without a page.
        stray = await Socket.to(base, "states")
        assert await stray.end() == "1013: The explorer is full: try again in a minute."
        # Connected sessions are served as before.
        assert "h=1.25" in (await inside[1].ask(values={"h": 1.25}))["query"]
        await inside[0].leave()
        end, found = time.monotonic() + 60.0, None
        while found is None:
            assert time.monotonic() < end, "nobody has made room"
            with suppress(Closed):
                found = await Visitor.open(base)
            await asyncio.sleep(0.1)
        assert "h=1.5" in (await found.ask(values={"h": 1.5}))["query"]
        for visitor in (found, inside[1]):
            await visitor.leave()

    with served(sessions=2, unused_session_lifetime_milliseconds=500, check_unused_sessions_milliseconds=50) as base:
        finished(visit(base))
