"""Serve the page from a separate process and take screenshots of it."""

from __future__ import annotations

import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from hess_explorer.headless.browser import BrowserError, headless_browser, wait_ready
from hess_explorer.server.liveness import is_alive
from hess_mechanics.errors import ModelError

_PROGRAM = ("-m", "hess_explorer")
_START_SECONDS = 60
_LOAD_SECONDS = 120
"""Timeout of the first page load, during which the server may have to compile."""


class ServerError(ModelError):
    """The server did not start; the message contains the reason, or says how to see it."""


def free_port() -> int:
    """Return a TCP port of this machine that is not in use."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def wait_alive(process: subprocess.Popen[bytes], port: int, log: Path) -> None:
    """Wait until the server of a process responds.  Raises `ServerError` with the last line of its log."""
    deadline = time.monotonic() + _START_SECONDS
    while not is_alive("127.0.0.1", port):
        if process.poll() is not None or time.monotonic() > deadline:
            lines = log.read_text(errors="replace").strip().splitlines()
            reason = lines[-1] if lines else "its log is empty"
            raise ServerError(f"The server did not start ({reason}): run `hess-explorer serve` to see the reason.")
        time.sleep(0.1)


@contextmanager
def server_process(
    log: Path, program: Sequence[str] = _PROGRAM, options: Sequence[str] = ()
) -> Iterator[tuple[subprocess.Popen[bytes], str]]:
    """Run `hess-explorer serve` in a separate process on a free port; yield the process and its base URL.

    Parameters
    ----------
    log : Path
        File for the output of the process.
    program : sequence of str
        Arguments of Python that start the command line.
    options : sequence of str
        Further options of `serve`.

    Yields
    ------
    process : subprocess.Popen
        The process; it is terminated afterwards.
    url : str
        Base URL of the page, without a slash at the end.

    Raises
    ------
    ServerError
        If the server ends, or does not respond within 60 s.
    """
    port = free_port()
    command = [sys.executable, *program, "serve", "--port", str(port), "--no-browser", *options]
    # `-m` searches the current folder first, so start in this package, where no other module shadows it.
    with (
        log.open("wb") as out,
        subprocess.Popen(
            command, cwd=Path(__file__).resolve().parents[1], stdout=out, stderr=subprocess.STDOUT
        ) as process,
    ):
        try:
            wait_alive(process, port, log)
            yield process, f"http://127.0.0.1:{port}"
        finally:
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def screenshot(query: str, size: tuple[int, int]) -> bytes:
    """Return a screenshot of the page as PNG.

    Parameters
    ----------
    query : str
        Query of the state, URL-encoded.
    size : (int, int)
        Width and height of the viewport in pixels.

    Returns
    -------
    bytes
        The PNG file.

    Raises
    ------
    ServerError
        If the server does not start.
    BrowserError
        If there is no browser, or the page cannot be drawn.
    """
    # Start the browser first, so that a missing browser is reported without waiting for the server.
    with headless_browser() as browser, tempfile.TemporaryDirectory() as folder:
        from playwright.sync_api import Error

        with server_process(Path(folder) / "server.log") as (_, base):
            page = browser.new_page(viewport={"width": size[0], "height": size[1]}, reduced_motion="reduce")
            try:
                page.goto(f"{base}/?{query}", timeout=1000 * _LOAD_SECONDS)
                wait_ready(page)
                return page.screenshot()
            except Error as error:
                why = error.message.splitlines()[0]
                raise BrowserError(f"The browser could not draw the page ({why}): try again.") from error
