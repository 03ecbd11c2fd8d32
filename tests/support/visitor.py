"""Clients without a browser: `Socket`, one websocket, and `Visitor`, a page that requests states."""

import asyncio
import html
import itertools
import json
import re

from bokeh.protocol import Protocol
from bokeh.protocol.receiver import Receiver
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

from support.wire import read_frame

_numbers = itertools.count(1)


class Closed(Exception):
    """Raised when the server has closed the connection or has no page to show; the message gives the reason."""


class Socket:
    """A websocket: what is said, what is read, and how it ends."""

    def __init__(self, connection):
        self._connection, self._has_ended = connection, False

    @classmethod
    async def to(cls, base, path, headers=None, trusted=None, **given):
        """Connect to a path of a server."""
        url, headers = f"ws{base.removeprefix('http')}/{path}", {"Origin": base, **(headers or {})}
        request = HTTPRequest(url, headers=headers, connect_timeout=60.0, ssl_options=trusted)
        return cls(await websocket_connect(request, max_message_size=2**28, **given))

    async def say(self, message):
        """Send a message; text is sent as it is."""
        frame = message if isinstance(message, str | bytes) else json.dumps(message)
        await self._connection.write_message(frame, binary=isinstance(frame, bytes))

    async def read(self, timeout=60.0):
        """Return the next frame.  Raises `Closed`."""
        frame = await asyncio.wait_for(self._connection.read_message(), timeout)
        if frame is None:
            self._has_ended = True
            raise Closed(f"{self._connection.close_code}: {self._connection.close_reason}")
        return frame

    async def end(self, timeout=60.0):
        """Return the reason for which the server closes the websocket."""
        try:
            while True:
                await self.read(timeout)
        except Closed as why:
            self._connection.close()
            return str(why)

    async def leave(self):
        """Close the websocket, as a closed tab does."""
        self._connection.close()
        # That something has ended is read once.
        while not self._has_ended:
            self._has_ended = await self._connection.read_message() is None


def _nodes(item):
    """All mappings in a decoded JSON text."""
    if isinstance(item, dict):
        yield item
        item = list(item.values())
    if isinstance(item, list):
        for one in item:
            yield from _nodes(one)


class Visitor:
    """One page: `await Visitor.open(base, query)`, then `await visitor.ask(values={…})`.

    It has two websockets, as in a browser: Panel's, by which it gets the document, and that of states.
    """

    def __init__(self, panel):
        self.panel, self.states, self.state = panel, None, None
        self._receiver, self._asked = Receiver(Protocol()), 0

    @classmethod
    async def open(cls, base, query="", origin=None, timeout=60.0, pause=0.0, headers=None, trusted=None):
        """Open the page of a query, and return it once its first state has arrived.

        origin : of the page that opens the websocket; pause : seconds before it does; headers : of both requests;
        trusted : whose certificates count, by https.
        """
        answer = await AsyncHTTPClient().fetch(
            HTTPRequest(f"{base}/?{query}", request_timeout=timeout, headers=headers, ssl_options=trusted)
        )
        token = re.search(r'"token":"([^"]+)"', html.unescape(answer.body.decode()))
        assert token is not None, answer.body[:500]
        await asyncio.sleep(pause)
        both = {"headers": {"Origin": origin or base, **(headers or {})}, "trusted": trusted}
        found = cls(await Socket.to(base, "ws", subprotocols=["bokeh", token[1]], **both))
        try:
            await found.hear_of_panel("ACK", timeout)
            await found.say_to_panel("PULL-DOC-REQ", {})
            found.document = (await found.hear_of_panel("PULL-DOC-REPLY", timeout)).content
            data = [node.get("attributes", {}).get("data") for node in _nodes(found.document["doc"])]
            if not any(isinstance(one, dict) and "client" in one.get("attributes", {}) for one in data):
                raise Closed(f"nothing here asks for states: {found.document['doc']}")
            # As a browser says when it stands.
            ready = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}
            await found.say_to_panel(
                "PATCH-DOC", {"events": [{"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": ready}]}
            )
            found.states = await Socket.to(base, f"states?{query}", **both)
            while found.state is None:
                await found.hear(timeout)
        except BaseException:
            await found.leave()
            raise
        return found

    async def say_to_panel(self, kind, content):
        """Send a message of Bokeh's protocol."""
        header = {"msgid": f"visitor-{next(_numbers)}", "msgtype": kind}
        for part in (header, {}, content):
            await self.panel.say(part)

    async def hear_of_panel(self, kind, timeout=60.0):
        """Return the next message of this kind."""
        while True:
            message = await self._receiver.consume(await self.panel.read(timeout))
            if message is not None and message.msgtype == "ERROR":
                raise Closed(message.content.get("text", ""))
            if message is not None and message.msgtype == kind:
                return message

    async def end(self, timeout=60.0):
        """Return the last messages of both websockets."""
        return [await self.states.end(timeout), await self.panel.end(timeout)]

    async def hear(self, timeout=60.0):
        """Return the next response, by name."""
        told, _ = read_frame(await self.states.read(timeout))
        self.state = told.get("state", self.state)
        return told

    async def say(self, data):
        """Send any message."""
        await self.states.say(data)

    async def ask(self, timeout=60.0, **message):
        """Send a message and return the state in the response."""
        self._asked += 1
        asked = self._asked
        await self.say({"requested": asked, "held": False, "values": {}, **message})
        while self.state["answers"] != asked:
            await self.hear(timeout)
        return self.state

    async def leave(self):
        """Close both websockets, as a closed tab does."""
        for socket in filter(None, (self.states, self.panel)):
            await socket.leave()
