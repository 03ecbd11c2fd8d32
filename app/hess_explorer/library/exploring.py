"""Embed a scene of the explorer in a notebook and read its current state."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import weakref
from html import escape
from types import TracebackType
from typing import Any

from hess_explorer.headless.screenshot import ServerError, free_port
from hess_explorer.library.state import SceneState, from_link, state
from hess_explorer.server.parent import end_with_stdin
from hess_explorer.server.serving import serve

_START_SECONDS = 120.0
"""Timeout of the start, which compiles the first time."""
_PAGES = 20
"""Maximum number of pages, for a notebook that is open in several windows."""
_HUB = "JUPYTERHUB_SERVICE_PREFIX"
_CHILD = "from hess_explorer.library.exploring import serve_alone; serve_alone(int(__import__('sys').argv[1]))"


class Exploration:
    """A page of the explorer with its own server, created by `explore`.

    A notebook displays the page.  The server stops when this object is closed or garbage collected, at the end of its
    `with` block, and when the Python process exits.

    Attributes
    ----------
    url : str
        Address of the page.  It works in any browser on this machine; on JupyterHub, Binder and Colab, in the browser
        of the notebook.  On JupyterHub and Binder, which need jupyter-server-proxy, it is a path without a host.
    """

    def __init__(self, first: SceneState, height: int) -> None:
        self._height = height
        self._link = first.link
        self._ready = threading.Event()
        port = free_port()
        self.url = f"{_address(port)}{first.link}"
        # The server is a separate process, so that the page and the cells of the notebook do not block each other.
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
            raise ServerError("The explorer did not start: run `hess-explorer serve` in a terminal to see the reason.")

    @property
    def state(self) -> SceneState:
        """The current state of the page; the initial state until a browser has opened the page."""
        return from_link(self._link, lenient=True)

    def close(self) -> None:
        """Stop the server.  The page stays visible but no longer responds."""
        self._end()

    def _receive(self, word: str, text: str) -> None:
        """Handle a message of the server: "ready", "ended", or "state" with the query of the current state."""
        if word == "state":
            self._link = f"?{text}"
        # Set the event on "ended" as well, so that the constructor stops waiting.
        self._ready.set()

    def _repr_html_(self) -> str:
        """Return the embedded page and a link to the full page."""
        here = escape(self.url)
        return (
            f'<iframe src="{here}&amp;embed=1" width="100%" height="{self._height}" style="border: 0" '
            f'allowfullscreen></iframe><a href="{here}" target="_blank">Open the whole page</a>'
        )

    def __enter__(self) -> Exploration:
        """Return this object; the server stops at the end of the block."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def explore(scene: str = "suslov-hess", /, *, height: int = 640, **parameters: Any) -> Exploration:
    """Show a scene in a notebook that runs on this machine, on JupyterHub, Binder or Colab.

    Parameters
    ----------
    scene : str
        Name of the scene, as in a link.
    height : int
        Height of the embedded page in pixels.
    **parameters
        Parameters of the scene, as in `state`.

    Returns
    -------
    Exploration
        The page; its `state` is the current state of the page.

    Raises
    ------
    InvalidParameter
        If a name or a value is not allowed.
    ServerError
        If the server cannot be started.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> hess.explore("suslov-hess", energy=1.2)
    Traceback (most recent call last):
    hess_mechanics.errors.InvalidParameter: The scene suslov-hess has no parameter 'energy': choose one of I22, ...
    """
    return Exploration(state(scene, **parameters), height)


def _address(port: int) -> str:
    """Return the address of a server of this notebook for the browser, with a slash at the end."""
    # JupyterHub and Binder set this prefix of the user's server.
    hub = os.environ.get(_HUB)
    if hub is not None:
        return f"{hub}proxy/{port}/"
    colab = sys.modules.get("google.colab.output")
    if colab is not None:
        return str(colab.eval_js(f"google.colab.kernel.proxyPort({port})")).rstrip("/") + "/"
    return f"http://127.0.0.1:{port}/"


def _origins() -> tuple[str, ...]:
    """Return the allowed origins: any behind a proxy, because the proxy checks them."""
    return ("*",) if _HUB in os.environ or "COLAB_RELEASE_TAG" in os.environ else ()


def serve_alone(port: int) -> None:
    """Run the server of an `Exploration` until standard input ends, and print its messages as JSON lines [word, text].

    Parameters
    ----------
    port : int
        TCP port on 127.0.0.1.
    """

    def tell(word: str, text: str = "") -> None:
        print(json.dumps([word, text]), flush=True)

    threading.Thread(target=end_with_stdin, daemon=True).start()
    serve(
        port,
        "127.0.0.1",
        False,
        _origins(),
        lambda: tell("ready"),
        sessions=_PAGES,
        follow=lambda query: tell("state", query),
    )


def _listen(child: subprocess.Popen[str], of: weakref.ref[Exploration]) -> None:
    assert child.stdout is not None
    for line in child.stdout:
        exploration = of()
        if exploration is not None:
            exploration._receive(*json.loads(line))
        del exploration
    exploration = of()
    if exploration is not None:
        exploration._receive("ended", "")


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
