"""The page served by a separate process, and screenshots of it."""

from __future__ import annotations

import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from hess_explorer.headless.browser import BrowserError, launched, wait_ready
from hess_explorer.server.liveness import is_alive

__all__ = ["ServerError", "free_port", "screenshot", "server_process", "wait_alive"]

_PROGRAM = ("-m", "hess_explorer")
_START_SECONDS = 60
_LOAD_SECONDS = 120
"""A first start compiles while the page loads, and a busy machine takes its time for that."""


class ServerError(RuntimeError):
    """The server or the page did not get ready; the message says why."""


def free_port() -> int:
    """One of this machine that nobody listens to."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def wait_alive(process: subprocess.Popen[bytes], port: int, log: Path) -> None:
    """Wait until the server of this process answers.  Raises `ServerError` with the last line of its log."""
    deadline = time.monotonic() + _START_SECONDS
    while not is_alive("127.0.0.1", port):
        if process.poll() is not None or time.monotonic() > deadline:
            said = log.read_text(errors="replace").strip().splitlines()
            raise ServerError(f"The server did not start ({said[-1] if said else 'silent'}).")
        time.sleep(0.1)


@contextmanager
def server_process(
    log: Path, program: Sequence[str] = _PROGRAM, options: Sequence[str] = ()
) -> Iterator[tuple[subprocess.Popen[bytes], str]]:
    """`hess-explorer serve` in a separate process on a free port: the process and its base URL.  Raises `ServerError`.

    log : file for all its output; program : arguments of Python that start the command line; options : of `serve`.
    """
    port = free_port()
    command = [sys.executable, *program, "serve", "--port", str(port), "--no-browser", *options]
    # `-m` looks in the current folder first: start in this package, where nothing can shadow it.
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


def screenshot(query: str, size: tuple[int, int], *, dark: bool = False) -> bytes:
    """The page in the state of this (encoded) query, as PNG.  Raises `ServerError`, `BrowserError`."""
    # The browser first: a missing one is reported without waiting for the server.
    with launched() as browser, tempfile.TemporaryDirectory() as folder:
        from playwright.sync_api import Error

        with server_process(Path(folder) / "server.log") as (_, base):
            page = browser.new_page(
                viewport={"width": size[0], "height": size[1]},
                color_scheme="dark" if dark else "light",
                reduced_motion="reduce",
            )
            try:
                page.goto(f"{base}/?{query}", timeout=1000 * _LOAD_SECONDS)
                wait_ready(page)
                return page.screenshot()
            except Error as error:
                raise BrowserError(f"The page could not be drawn: {error.message.splitlines()[0]}") from error
