"""A visitor without a browser: opens the page over HTTP and the websocket, as a browser does, and asks for states."""

from __future__ import annotations

import asyncio
import html
import itertools
import json
import re

from bokeh.protocol import Protocol
from bokeh.protocol.receiver import Receiver
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

__all__ = ["Closed", "Visitor"]

_numbers = itertools.count(1)


class Closed(Exception):
    """The server has ended the connection, or has no page to show; the message says why."""


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
    """One page: `await Visitor.open(base, query)`, then `await visitor.ask(values={…})`."""

    def __init__(self, socket, origin):
        self._socket, self.origin = socket, origin
        self._receiver = Receiver(Protocol())
        self._asked = 0
        self._ended = False
        self.state = None
        self.bytes = 0

    @classmethod
    async def open(cls, base, query="", origin=None, timeout=60.0, pause=0.0, headers=None, trusted=None):
        """The page of a query, when its first state is there.

        origin : of the page that opens the websocket; pause : seconds before it does; headers : of both requests;
        trusted : whose certificates count, by https.
        """
        answer = await AsyncHTTPClient().fetch(HTTPRequest(
            f"{base}/?{query}", request_timeout=timeout, headers=headers, ssl_options=trusted))
        token = re.search(r'"token":"([^"]+)"', html.unescape(answer.body.decode()))
        assert token is not None, answer.body[:500]
        await asyncio.sleep(pause)
        headers = {"Origin": origin or base, **(headers or {})}
        request = HTTPRequest(f"ws{base.removeprefix('http')}/ws", headers=headers,
                              connect_timeout=timeout, ssl_options=trusted)
        socket = await websocket_connect(request, subprotocols=["bokeh", token[1]], max_message_size=2**28)
        found = cls(socket, origin or base)
        await found._next("ACK", timeout)
        await found._send("PULL-DOC-REQ", {})
        reply = await found._next("PULL-DOC-REPLY", timeout)
        found.document = reply.content
        try:
            found._read(reply)
        except Closed:
            await found.leave()
            raise
        # Panel sends nothing before.
        await found._trigger("document_ready", {})
        while found.state is None:
            found._take(await found._next("PATCH-DOC", timeout))
        return found

    def _read(self, message):
        for node in _nodes(message.content["doc"]):
            data = node.get("attributes", {}).get("data")
            if isinstance(data, dict) and "client" in data.get("attributes", {}):
                self._model, self._data = node["id"], data["id"]
                if data["attributes"].get("state"):
                    self.state = json.loads(data["attributes"]["state"])
                return
        raise Closed(f"nothing here asks for states: {message.content['doc']}")

    async def _send(self, kind, content):
        header = {"msgid": f"visitor-{next(_numbers)}", "msgtype": kind}
        for part in (header, {}, content):
            await self._socket.write_message(json.dumps(part))

    async def _next(self, kind, timeout):
        while True:
            fragment = await asyncio.wait_for(self._socket.read_message(), timeout)
            if fragment is None:
                self._ended = True
                raise Closed(f"{self._socket.close_code}: {self._socket.close_reason}")
            self.bytes += len(fragment)
            message = await self._receiver.consume(fragment)
            if message is not None and message.msgtype == "ERROR":
                raise Closed(message.content.get("text", ""))
            if message is not None and message.msgtype == kind:
                return message

    def _take(self, message):
        for event in message.content["events"]:
            if event.get("attr") == "state" and event.get("model", {}).get("id") == self._data:
                self.state = json.loads(event["new"])

    async def _trigger(self, name, values):
        event = {"type": "event", "name": name, "values": {"type": "map", "entries": [*values.items()]}}
        await self._send("PATCH-DOC", {"events": [{"kind": "MessageSent", "msg_type": "bokeh_event",
                                                   "msg_data": event}]})

    async def say(self, data):
        """Send a message, whatever it is."""
        await self._trigger("data_event", {"model": {"id": self._model}, "data": data})

    async def ask(self, timeout=60.0, **message):
        """The state that answers this message."""
        self._asked += 1
        asked = self._asked
        await self.say({"requested": asked, "held": False, "values": {}, **message})
        while self.state["answers"] != asked:
            self._take(await self._next("PATCH-DOC", timeout))
        return self.state

    async def whole(self, timeout=60.0):
        """The state when nothing of it is missing any more."""
        while self.state["progress"] is not None:
            await self.ask(timeout)
        return self.state

    async def leave(self):
        """Close the websocket, as a tab that is closed does."""
        self._socket.close()
        # That something has ended is read once.
        while not self._ended and await self._socket.read_message() is not None:
            pass
