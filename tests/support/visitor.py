"""Client without a browser: opens the page over HTTP and websocket, as a browser does, and requests states."""

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


def _nodes(item):
    """All mappings in a decoded JSON text."""
    waiting = [item]
    while waiting:
        one = waiting.pop()
        if isinstance(one, dict):
            yield one
            waiting += one.values()
        elif isinstance(one, list):
            waiting += one


class Visitor:
    """One page: `await Visitor.open(base, query)`, then `await visitor.ask(values={…})`.

    It has two websockets, as in a browser: Panel's, by which it gets the document, and that of states.
    """

    def __init__(self, socket, origin):
        self._socket, self.origin = socket, origin
        self._receiver = Receiver(Protocol())
        self._states = None
        self._ended = []
        self._asked = 0
        self.state = None
        self.bytes = 0

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
        headers = {"Origin": origin or base, **(headers or {})}

        async def connect(path, **given):
            request = HTTPRequest(
                f"ws{base.removeprefix('http')}/{path}", headers=headers, connect_timeout=timeout, ssl_options=trusted
            )
            return await websocket_connect(request, max_message_size=2**28, **given)

        found = cls(await connect("ws", subprotocols=["bokeh", token[1]]), origin or base)
        try:
            await found._next("ACK", timeout)
            await found.say_to_panel("PULL-DOC-REQ", {})
            found.document = (await found._next("PULL-DOC-REPLY", timeout)).content
            found._look()
            # As a browser says when it stands.
            ready = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}
            await found.say_to_panel(
                "PATCH-DOC", {"events": [{"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": ready}]}
            )
            found._states = await connect(f"states?{query}")
            while found.state is None:
                await found.hear(timeout)
        except BaseException:
            await found.leave()
            raise
        return found

    def _look(self):
        """Raise `Closed` unless this is a page whose client requests states."""
        for node in _nodes(self.document["doc"]):
            data = node.get("attributes", {}).get("data")
            if isinstance(data, dict) and "client" in data.get("attributes", {}):
                return
        raise Closed(f"nothing here asks for states: {self.document['doc']}")

    async def say_to_panel(self, kind, content):
        """Send a message of Bokeh's protocol."""
        header = {"msgid": f"visitor-{next(_numbers)}", "msgtype": kind}
        for part in (header, {}, content):
            await self._socket.write_message(json.dumps(part))

    async def _read(self, socket, timeout):
        fragment = await asyncio.wait_for(socket.read_message(), timeout)
        if fragment is None:
            self._ended.append(socket)
            raise Closed(f"{socket.close_code}: {socket.close_reason}")
        self.bytes += len(fragment)
        return fragment

    async def end(self, timeout=60.0):
        """Return the last messages of both websockets."""
        heard = []
        for socket in (self._states, self._socket):
            try:
                while True:
                    await self._read(socket, timeout)
            except Closed as why:
                heard.append(str(why))
        return heard

    async def _next(self, kind, timeout):
        while True:
            message = await self._receiver.consume(await self._read(self._socket, timeout))
            if message is not None and message.msgtype == "ERROR":
                raise Closed(message.content.get("text", ""))
            if message is not None and message.msgtype == kind:
                return message

    async def hear(self, timeout=60.0):
        """Return the next response, by name."""
        told, _ = read_frame(await self._read(self._states, timeout))
        self.state = told.get("state", self.state)
        return told

    async def say(self, data):
        """Send any message."""
        await self._states.write_message(json.dumps(data))

    async def ask(self, timeout=60.0, **message):
        """Send a message and return the state in the response."""
        self._asked += 1
        asked = self._asked
        await self.say({"requested": asked, "held": False, "values": {}, **message})
        while self.state["answers"] != asked:
            await self.hear(timeout)
        return self.state

    async def whole(self, timeout=60.0):
        """Wait for all pending results, and return the complete state."""
        while self.state["progress"] is not None:
            await self.ask(timeout)
        return self.state

    async def leave(self):
        """Close both websockets, as a closed tab does."""
        both = [socket for socket in (self._states, self._socket) if socket is not None]
        for socket in both:
            socket.close()
        for socket in both:
            # That something has ended is read once.
            while socket not in self._ended and await socket.read_message() is not None:
                pass
