"""A headless Chromium for the tests, installed where there is none."""

import platform
import subprocess
import sys
from contextlib import ExitStack, contextmanager

from hess_explorer.headless.browser import VARIABLE, BrowserError, headless_browser, is_root

_INSTALL_SECONDS = 900


@contextmanager
def launched_or_installed():
    """Return a running headless browser; one is installed if there is none.  Raises `BrowserError`."""
    with ExitStack() as stack:
        try:
            running = stack.enter_context(headless_browser())
        except BrowserError:
            install_browser()
            running = stack.enter_context(headless_browser())
        yield running


def _is_debian():
    try:
        return platform.freedesktop_os_release().get("ID") == "debian"
    except OSError:
        return False


def install_browser():
    """Install a Chromium from Debian (as root there) or through Playwright.  Raises `BrowserError`."""
    if is_root() and _is_debian():
        commands = [
            ["apt-get", "update"],
            ["apt-get", "install", "-y", "--no-install-recommends", "chromium-headless-shell"],
        ]
    else:
        commands = [[sys.executable, "-m", "playwright", "install", "--with-deps", "chromium"]]
    for command in commands:
        try:
            subprocess.run(command, check=True, stdin=subprocess.DEVNULL, timeout=_INSTALL_SECONDS)
        except (OSError, subprocess.SubprocessError) as error:
            raise BrowserError(
                f"No Chromium was found and `{' '.join(command)}` failed ({error}): "
                f"install Chromium and name it in {VARIABLE}."
            ) from error
