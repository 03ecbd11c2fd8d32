"""Find and start a headless Chromium, and wait until the page is ready."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from hess_mechanics.errors import ModelError

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserType, Page

VARIABLE = "HESS_EXPLORER_BROWSER"
_COMMANDS = ("chromium", "chromium-headless-shell", "google-chrome")
_POLLING_MS = 10
# Prevent third-party requests of the browser, whatever the defaults of Playwright.
_QUIET = ("--disable-background-networking", "--disable-component-update", "--disable-domain-reliability", "--no-pings")


class BrowserError(ModelError):
    """No usable browser was found, or it could not draw; the message contains a remedy."""


def find_browser(playwright_own: str) -> str | None:
    """Return the path of a Chromium, or None.

    The search order is the environment variable `VARIABLE`, the commands on PATH, Playwright's own browser.

    Parameters
    ----------
    playwright_own : str
        Path of Playwright's own browser, which may not exist.

    Returns
    -------
    str or None
        Path of the program; None if no Chromium is found.

    Raises
    ------
    BrowserError
        If the environment variable names a program that does not exist.
    """
    chosen = os.environ.get(VARIABLE)
    if chosen:
        path = shutil.which(chosen)
        if path is None:
            raise BrowserError(f"{VARIABLE} names {chosen!r}, which is not a program: correct or unset it.")
        return path
    for command in _COMMANDS:
        path = shutil.which(command)
        if path is not None:
            return path
    return playwright_own if Path(playwright_own).exists() else None


def is_root() -> bool:
    """Return True if this process runs as root."""
    return hasattr(os, "geteuid") and os.geteuid() == 0


@contextmanager
def headless_browser() -> Iterator[Browser]:
    """Yield a running headless browser.  Raises `BrowserError` if there is none or it does not start."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError as error:
        raise BrowserError("This needs Playwright: install it with `pip install playwright`.") from error
    with sync_playwright() as playwright:
        path = find_browser(playwright.chromium.executable_path)
        if path is None:
            raise BrowserError(
                f"No Chromium was found: run `playwright install chromium`, or set {VARIABLE} to its path."
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
            # Some containers and kernels forbid user namespaces.  The page is local and trusted.
            return _launch(chromium, path, sandbox=False)
        why = error.message.splitlines()[0]
        raise BrowserError(f"{path} did not start ({why}): set {VARIABLE} to another browser.") from error


def wait_ready(page: Page, after: int = -1, seconds: float = 120) -> None:
    """Wait until the page has drawn a state with a number above `after`.

    The root element of the page has data-ready="true" when all requested data are drawn; data-state is the number of
    states drawn so far.  Raises Playwright's TimeoutError after `seconds`.
    """
    page.wait_for_function(
        "after => { const d = document.documentElement.dataset;"
        " return d.ready === 'true' && Number(d.state ?? 0) > after; }",
        # Polling on animation frames, the default, would make the browser render while the server computes.
        arg=after,
        timeout=1000 * seconds,
        polling=_POLLING_MS,
    )
