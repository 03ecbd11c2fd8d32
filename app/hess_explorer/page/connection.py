"""The server side of one page: its requests wait in a queue, so that the event loop never computes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, partial

from hess_explorer.compute.pool import RequestQueue
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.opening import opening
from hess_explorer.page.session import Session
from hess_explorer.protocol.messages import Request, Response, parse


class Connection:
    """Processes the requests of a page one by one, starting with the state of its query.

    Parameters
    ----------
    query : str
        Query of the page's URL.
    lessons : sequence of Lesson
        Lessons in addition to those of the package, see `opening`.
    send : callable
        Sends a frame to the page; called from any thread.
    follow : callable or None
        Called with the query of each state that the page shows.
    """

    def __init__(
        self,
        query: str,
        lessons: Sequence[Lesson],
        send: Callable[[bytes], object],
        follow: Callable[[str], None] | None,
    ) -> None:
        self._query, self._lessons = query, lessons
        self._send, self._follow = send, follow
        self._queue = RequestQueue()
        self._queue.put(partial(self._answer, Request(requested=0)))

    def receive(self, message: object) -> None:
        """Queue the request in decoded, untrusted JSON; ignore JSON that is not an object."""
        request = parse(message)
        if request is not None:
            self._queue.put(partial(self._answer, request))

    def end(self) -> None:
        """Drop the waiting requests, and stop the running one and the background work."""
        self._queue.end()
        if "_session" in vars(self):
            self._session.background.stop()

    @cached_property
    def _session(self) -> Session:
        opened = opening(self._query, self._lessons)
        return Session(opened.scene, opened.values, opened.notes, opened.lessons, opened.pictures)

    def _answer(self, request: Request) -> None:
        self._tell(self._session.answer(request))
        # A new page needs the cores to paint its first state; its next request starts the tasks.
        if not self._session.is_new:
            self._session.start_tasks()

    def _tell(self, answer: Response) -> None:
        if answer.state is not None and self._follow is not None:
            self._follow(answer.state.query)
        frame = answer.encode()
        if frame:
            self._send(frame)
