"""Rate limits of one visitor, and the message when they are exceeded."""

import asyncio
from contextlib import suppress

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPClientError
from tornado.websocket import WebSocketClosedError

from hess_explorer.protocol.specs import MAX_QUERY
from hess_explorer.server import limits
from hess_explorer.server.export import Export
from hess_explorer.server.headers import QUERY_LIMIT
from hess_explorer.server.limits import MESSAGE_LIMIT
from hess_explorer.server.websockets import StateSocket
from support.asynchronous import awaited, finished
from support.visitor import Visitor

LARGE = "1009: A message may have at most 256 KB: send a smaller one."
FAST = "1008: More than 2 messages per second: wait for each response before you send again."


@awaited
async def test_who_sends_too_much_reads_why_and_others_are_served(base, monkeypatch):
    # However slow the machine is that sends.
    monkeypatch.setattr(limits, "RATE", 2.0)
    monkeypatch.setattr(limits, "BURST", 50.0)
    large, fast, panel, other = visitors = [await Visitor.open(base) for _ in range(4)]
    await large.say("x" * (MESSAGE_LIMIT + 1))
    for _ in range(100):
        for said in (fast.say(17), panel.say_to_panel("PULL-DOC-REQ", {})):
            # It may be closed before the last message.
            with suppress(WebSocketClosedError):
                await said
    assert [await socket.end() for socket in (large.states, fast.states, panel.panel)] == [LARGE, FAST, FAST]
    assert "h=1.25" in (await other.ask(values={"h": 1.25}))["query"]
    for visitor in visitors:
        await visitor.leave()


@awaited
async def test_what_is_no_json_ends_the_websocket_with_a_sentence_and_whatever_is_json_is_answered(base):
    # The last one is JSON, but of no depth that Python reads.
    for frame in ("{", b"\xff\xfe", "[" * 100_000 + "]" * 100_000):
        visitor = await Visitor.open(base)
        await visitor.say(frame)
        assert await visitor.states.end() == "1007: A message must be a text frame of JSON."
        await visitor.leave()
    visitor = await Visitor.open(base)
    for data in (17, None, [], '"x"', {"requested": "no number"}):
        await visitor.say(data)
    assert "h=1.25" in (await visitor.ask(values={"h": 1.25}))["query"]
    await visitor.leave()


def answer(base, path, **options):
    """Return the status and text of a response, including refusals."""

    async def fetch():
        try:
            return await AsyncHTTPClient().fetch(f"{base}/{path}", **options)
        except HTTPClientError as refused:
            return refused.response

    found = finished(fetch())
    return found.code, found.body.decode()


def test_a_link_that_is_too_long_is_refused_with_a_sentence(base):
    async def visit(length):
        visitor = await Visitor.open(base, "h=1.2&" + "x" * (length - 6))
        await visitor.leave()
        return visitor.state

    assert answer(base, "?" + "x" * (QUERY_LIMIT + 1)) == (
        414,
        "The link is longer than 8000 characters; links of the explorer have at most 2000: open the page "
        "without the part of its address after “?”.",
    )
    # Up to there the page opens.
    for length in (MAX_QUERY + 100, QUERY_LIMIT):
        state = finished(visit(length))
        assert "longer than 2000 characters: it was ignored" in state["tree"]["texts"]["notes"]


def test_of_too_many_files_at_once_the_last_are_refused_with_a_sentence(base, monkeypatch):
    monkeypatch.setitem(Export.waiting, False, 20)
    assert answer(base, "export?picture=circle") == (
        503,
        "The server is making too many files at the moment: try again in a minute.",
    )
    monkeypatch.setitem(Export.waiting, False, 19)
    code, table = answer(base, "export?picture=circle&accuracy=draft")
    assert (code, table[:1]) == (200, "#")
    assert answer(base, "export?picture=" + "x" * MAX_QUERY)[0] == 400


@awaited
async def test_of_who_reads_no_answers_nothing_more_is_taken(base, monkeypatch):
    """Otherwise unread responses would fill the memory."""
    unread = []

    def write(socket, frame, binary, send=StateSocket.write_message):
        send(socket, frame, binary)
        # Done once the system has taken it all.
        unread.append((asyncio.get_running_loop(), asyncio.Future()))
        return unread[-1][1]

    monkeypatch.setattr(StateSocket, "write_message", write)
    visitor = await Visitor.open(base)
    await visitor.say({"requested": 1, "values": {"h": 1.25}})
    with pytest.raises(TimeoutError):
        await visitor.hear(1.0)
    loop, taken = unread[0]
    loop.call_soon_threadsafe(taken.set_result, None)
    while visitor.state["answers"] != 1:
        await visitor.hear()
    await visitor.leave()
    assert "h=1.25" in visitor.state["query"]
    assert len(unread) == 2
