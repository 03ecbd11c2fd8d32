"""Between the page's component and its session, so that nothing is computed in the thread that serves."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any, Generic, TypeVar, cast

import panel as pn
from panel.io.document import unlocked

from hess_explorer.compute.turns import Turns
from hess_explorer.page.components import Ready

__all__ = ["Desk"]


T = TypeVar("T", str, bytes)


class _Told(Generic[T]):
    """An attribute of the component: what is set goes to the page on the thread that serves."""

    def __set_name__(self, owner: type[Desk], name: str) -> None:
        self._name = name

    def __get__(self, desk: Desk, owner: type[Desk]) -> T:
        return cast(T, getattr(desk.ready, self._name))

    def __set__(self, desk: Desk, value: T) -> None:
        desk.said[self._name] = value


class Desk:
    """Stands for the component before the session: messages come one by one, in the session's own turn.

    Without a document that is served, as in a script, everything is done at once.
    """

    scene, lesson, state, block = _Told[str](), _Told[str](), _Told[str](), _Told[bytes]()
    chart, cells = _Told[str](), _Told[bytes]()

    def __init__(self, ready: Ready) -> None:
        # One answer tells each thing once.
        self.said: dict[str, Any] = {}
        self.ready = ready
        document = pn.state.curdoc
        self._served = document if document is not None and document.session_context is not None else None
        self._turns = Turns()
        self._handlers: list[Callable[[Any], object]] = []
        ready.on_msg(lambda event: self._receive(event.data))

    def begin(self, work: Callable[[], object]) -> None:
        """Do this first, once the page stands in the browser."""
        if self._served is not None:
            # What is told before, Panel forgets; and who asks for a link only has nothing computed.
            pn.state.onload(lambda: self._take(work))
        else:
            work()
            self._tell_all()

    def on_msg(self, handle: Callable[[Any], object]) -> None:
        """By this the session, and whoever else, takes a message."""
        self._handlers.append(handle)

    def end(self) -> None:
        """The page is gone."""
        self._turns.end()

    def _receive(self, message: Any) -> None:
        work = partial(self._handle, message)
        if self._served is not None:
            self._take(work)
        else:
            work()
            self._tell_all()

    def _handle(self, message: Any) -> None:
        for handle in self._handlers:
            handle(SimpleNamespace(data=message))

    def _take(self, work: Callable[[], object]) -> None:
        self._turns.take(partial(self._work, work))

    def _work(self, work: Callable[[], object]) -> None:
        try:
            work()
        finally:
            said, self.said = self.said, {}
            if said and self._served is not None:
                self._served.add_next_tick_callback(partial(self._tell, said))

    def _tell_all(self) -> None:
        said, self.said = self.said, {}
        self._tell(said)

    def _tell(self, said: dict[str, Any]) -> None:
        # All of one answer at once; outside `unlocked` Panel would wait for the next turn of the loop.
        with unlocked():
            self.ready.param.update(**said)
