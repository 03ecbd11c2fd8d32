"""A scene of the explorer in a notebook, and the state that the hand has reached there."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import weakref
from html import escape
from types import TracebackType
from typing import Any

from hess_explorer.headless.screenshot import ServerError, free_port
from hess_explorer.library.state import SceneState, from_link, state
from hess_explorer.server.serving import serve
from hess_explorer.server.shutdown import end_with_stdin

__all__ = ["Exploration", "explore", "serve_alone"]

_START_SECONDS = 120.0
"""A first start compiles."""
_PAGES = 20
"""A notebook that is open several times shows so many."""
_CHILD = "from hess_explorer.library.exploring import serve_alone; serve_alone(int(__import__('sys').argv[1]))"


class Exploration:
    """A page of the explorer with a server of its own, which ends with this process; made by `explore`.

    A notebook shows it; `url` opens it in any browser on this machine, `state` is what it shows now.
    """

    def __init__(self, first: SceneState, height: int) -> None:
        self._height = height
        self._reached = first.link
        self._ready = threading.Event()
        port = free_port()
        self.url = f"http://127.0.0.1:{port}/{first.link}"
        # A process of its own: what a cell computes does not keep the page waiting, nor what the page does a cell.
        self._child = subprocess.Popen(
            [sys.executable, "-c", _CHILD, str(port)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self._end = weakref.finalize(self, _end, self._child)
        threading.Thread(target=_listen, args=(self._child, weakref.ref(self)), daemon=True).start()
        if not self._ready.wait(_START_SECONDS) or self._child.poll() is not None:
            self.close()
            raise ServerError("The explorer did not start: try `hess-explorer serve` in a terminal, which says why.")

    @property
    def state(self) -> SceneState:
        """What the page shows now, as `from_link` gives it; the first state until it is looked at."""
        return from_link(self._reached, lenient=True)

    def close(self) -> None:
        """End its server: the page stays as it is, and nothing can be changed there any more."""
        self._end()

    def told(self, word: str, text: str) -> None:
        """Its server has said something: that it is "ready", or the query of the "state" on show."""
        if word == "state":
            self._reached = f"?{text}"
        # Also when it has ended: who waits must not wait for longer.
        self._ready.set()

    def _repr_html_(self) -> str:
        """The pictures with the controls that matter, and a link to the whole page."""
        here = escape(self.url)
        return (
            f'<iframe src="{here}&amp;embed=1" width="100%" height="{self._height}" style="border: 0" '
            f'allowfullscreen></iframe><a href="{here}" target="_blank">Open the whole page</a>'
        )

    def __enter__(self) -> Exploration:
        """For as long as a block of code."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def explore(scene: str = "suslov-hess", /, *, height: int = 640, **parameters: Any) -> Exploration:
    """Show a scene in a notebook on this machine, in the state of these parameters; height : in pixels.

    `.state` of the result is the state that the hand has reached.  Raises `InvalidParameter` as `state` does, and
    `ServerError` where no server can be started.

    >>> import hess_explorer as hess
    >>> hess.explore("suslov-hess", energy=1.2)
    Traceback (most recent call last):
    hess_mechanics.errors.InvalidParameter: The scene suslov-hess has no parameter 'energy': choose one of I22, ...
    """
    return Exploration(state(scene, **parameters), height)


def serve_alone(port: int) -> None:
    """The server of an `Exploration`: a line of JSON, [word, text], for all that it has to say."""

    def tell(word: str, text: str = "") -> None:
        print(json.dumps([word, text]), flush=True)

    threading.Thread(target=end_with_stdin, daemon=True).start()
    serve(
        port, "127.0.0.1", False, (), lambda: tell("ready"), sessions=_PAGES, follow=lambda query: tell("state", query)
    )


def _listen(child: subprocess.Popen[str], of: weakref.ref[Exploration]) -> None:
    assert child.stdout is not None
    for line in child.stdout:
        exploration = of()
        if exploration is not None:
            exploration.told(*json.loads(line))
        del exploration
    exploration = of()
    if exploration is not None:
        exploration.told("ended", "")


def _end(child: subprocess.Popen[str]) -> None:
    child.terminate()
    try:
        child.wait(10.0)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()
    for pipe in (child.stdin, child.stdout):
        if pipe is not None:
            pipe.close()
