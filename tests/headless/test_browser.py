"""Search order for the browser; a missing browser is always reported."""

import sys

import pytest
from playwright.sync_api import Error

from hess_explorer.headless import browser
from hess_explorer.headless.browser import VARIABLE, BrowserError, find_browser, headless_browser


@pytest.fixture
def machine(monkeypatch):
    """A machine on which exactly the named programs are installed."""
    programs = set()
    monkeypatch.setattr(browser.shutil, "which", lambda name: f"/bin/{name}" if name in programs else None)
    monkeypatch.delenv(VARIABLE, raising=False)
    return programs


def test_order(machine, monkeypatch, tmp_path):
    own = tmp_path / "chrome"
    assert find_browser(str(own)) is None
    own.touch()
    assert find_browser(str(own)) == str(own)
    for name in ("google-chrome", "chromium-headless-shell", "chromium"):
        machine.add(name)
        assert find_browser(str(own)) == f"/bin/{name}"
    machine.add("brave")
    monkeypatch.setenv(VARIABLE, "brave")
    assert find_browser(str(own)) == "/bin/brave"


def test_a_wrong_variable_is_an_error_and_not_passed_over(machine, monkeypatch):
    machine.add("chromium")
    monkeypatch.setenv(VARIABLE, "/nowhere/chrome")
    with pytest.raises(BrowserError, match=f"{VARIABLE} names '/nowhere/chrome'"):
        find_browser("")


def test_no_browser_is_loud(machine, monkeypatch):
    monkeypatch.setattr("playwright.sync_api.sync_playwright", Playwright())
    with (
        pytest.raises(BrowserError, match="No Chromium was found: run `playwright install chromium`"),
        headless_browser(),
    ):
        pass


def test_missing_playwright_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    with pytest.raises(BrowserError, match="pip install playwright"), headless_browser():
        pass


class Playwright:
    """It has no Chromium of its own, and another starts only without a sandbox, or not at all."""

    executable_path = "/nowhere/chrome"

    def __init__(self, complaint=""):
        self.complaint = complaint
        self.sandboxed = []
        self.chromium = self

    def __call__(self):
        return self

    __enter__ = __call__

    def __exit__(self, *_):
        pass

    def launch(self, *, executable_path, args, chromium_sandbox):
        self.sandboxed.append(chromium_sandbox)
        assert not any("swiftshader" in word for word in args)
        if chromium_sandbox or "sandbox" not in self.complaint:
            raise Error(self.complaint)
        return self

    def close(self):
        pass


@pytest.mark.parametrize(("root", "tried"), [(True, [False]), (False, [True, False])])
def test_the_sandbox_is_left_out_only_as_root_or_where_there_is_none(machine, monkeypatch, root, tried):
    machine.add("chromium")
    playwright = Playwright("No usable sandbox!")
    monkeypatch.setattr("playwright.sync_api.sync_playwright", playwright)
    monkeypatch.setattr(browser, "is_root", lambda: root)
    with headless_browser():
        assert playwright.sandboxed == tried


def test_a_browser_that_does_not_start_is_loud(machine, monkeypatch):
    machine.add("chromium")
    monkeypatch.setattr("playwright.sync_api.sync_playwright", Playwright("Crashed\nlong log"))
    with pytest.raises(BrowserError, match=rf"/bin/chromium did not start \(Crashed\).*{VARIABLE}"), headless_browser():
        pass
