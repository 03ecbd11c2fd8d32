"""A headless Chromium: found, started, and waited for until the page is ready."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserType, Page

__all__ = ["BrowserError", "find_browser", "is_root", "launched", "wait_ready"]

VARIABLE = "HESS_EXPLORER_BROWSER"
_COMMANDS = ("chromium", "chromium-headless-shell", "google-chrome")
_POLLING_MS = 10
# No third-party requests by the browser itself.  Most are Playwright's defaults; here they are a promise.
_QUIET = ("--disable-background-networking", "--disable-component-update", "--disable-domain-reliability", "--no-pings")


class BrowserError(RuntimeError):
    """No usable browser; the message tells the user what to do."""


def find_browser(playwright_own: str) -> str | None:
    """Path of a Chromium: from the environment variable, on PATH, or Playwright's own; None if there is none.

    Raises `BrowserError` if the environment variable names a file that is not there.
    """
    chosen = os.environ.get(VARIABLE)
    if chosen:
        path = shutil.which(chosen)
        if path is None:
            raise BrowserError(f"{VARIABLE} names {chosen!r}, which is not a program: correct it or remove it.")
        return path
    for command in _COMMANDS:
        path = shutil.which(command)
        if path is not None:
            return path
    return playwright_own if Path(playwright_own).exists() else None


def is_root() -> bool:
    """Return whether this process runs as root."""
    return hasattr(os, "geteuid") and os.geteuid() == 0


@contextmanager
def launched() -> Iterator[Browser]:
    """A running headless browser; Raises `BrowserError`."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError as error:
        raise BrowserError("This needs Playwright: install it with `pip install playwright`.") from error
    with sync_playwright() as playwright:
        path = find_browser(playwright.chromium.executable_path)
        if path is None:
            raise BrowserError(
                f"No Chromium was found: install one (`playwright install chromium`) or name it in {VARIABLE}."
            )
        # Chromium refuses to run as root with its sandbox.
        browser = _launch(playwright.chromium, path, sandbox=not is_root())
        try:
            yield browser
        finally:
            browser.close()


def _launch(chromium: BrowserType, path: str, *, sandbox: bool) -> Browser:
    from playwright.sync_api import Error

    try:
        return chromium.launch(executable_path=path, args=_QUIET, chromium_sandbox=sandbox)
    except Error as error:
        if sandbox and "sandbox" in error.message.lower():
            # Some containers and kernels forbid user namespaces.  The page is our own, from this machine.
            return _launch(chromium, path, sandbox=False)
        why = error.message.splitlines()[0]
        raise BrowserError(f"{path} did not start ({why}); choose another in {VARIABLE}.") from error


def wait_ready(page: Page, after: int = -1, seconds: float = 120) -> None:
    """Wait until the page has drawn a state with a number above `after`.

    The page keeps both on its root element: data-ready="true" when everything asked for is drawn, data-state
    counts the states drawn.  Raises Playwright's TimeoutError.
    """
    page.wait_for_function(
        "after => { const d = document.documentElement.dataset;"
        " return d.ready === 'true' && Number(d.state ?? 0) > after; }",
        # Asked with every frame, as is usual, the browser would make frames for as long as the server computes.
        arg=after,
        timeout=1000 * seconds,
        polling=_POLLING_MS,
    )
