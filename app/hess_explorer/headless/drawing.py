"""Draw pictures with the offline page in a headless browser."""

from __future__ import annotations

import atexit
import base64
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import ExitStack, contextmanager
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING, Any, TypeVar

from hess_explorer.export.figure import PageImage, densities
from hess_explorer.export.formats import WIDTHS
from hess_explorer.export.picture_data import PictureData
from hess_explorer.headless.browser import BrowserError, headless_browser, wait_ready
from hess_explorer.offline.html import module_address
from hess_explorer.offline.pages import state_page
from hess_explorer.scenes import add, scenes

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, JSHandle

T = TypeVar("T")

_VIEWPORT = 900
"""Width and height of the window, with room for the plot of a film."""
_SECONDS = 120


class _Studio:
    """The browser of this process, which starts with the first picture and draws all of them.

    It has its own thread, because Playwright refuses to run in the event loop of a notebook.
    """

    def __init__(self) -> None:
        self._jobs: SimpleQueue[tuple[Future[Any], Callable[[Browser], Any]] | None] = SimpleQueue()
        self._thread = Thread(target=self._work, name="browser", daemon=True)
        self._thread.start()
        atexit.register(self._close)

    def run(self, act: Callable[[Browser], T]) -> T:
        """Run `act(browser)` in the thread of the browser and return its result.  Raises `BrowserError`."""
        future: Future[T] = Future()
        self._jobs.put((future, act))
        return future.result()

    def _close(self) -> None:
        self._jobs.put(None)
        self._thread.join()

    def _work(self) -> None:
        browser: Browser | None = None
        with ExitStack() as running:
            while (job := self._jobs.get()) is not None:
                future, act = job
                try:
                    if browser is None or not browser.is_connected():
                        running.close()
                        browser = running.enter_context(headless_browser())
                    future.set_result(act(browser))
                except BaseException as error:
                    future.set_exception(error)


@cache
def _studio() -> _Studio:
    return _Studio()


def _in_browser(act: Callable[[Browser], T]) -> T:
    """Return `act(browser)`, with errors of Playwright converted to `BrowserError`."""

    def act_or_say(browser: Browser) -> T:
        from playwright.sync_api import Error

        try:
            return act(browser)
        except Error as error:
            why = error.message.splitlines()[0]
            raise BrowserError(f"The browser could not draw the picture ({why}): try again.") from error

    return _studio().run(act_or_say)


@contextmanager
def page_of(data: PictureData) -> Iterator[Callable[[str, Any], Any]]:
    """Open the page of a picture, and yield a function that draws it at the time and view of its link.

    Parameters
    ----------
    data : PictureData
        The picture.

    Yields
    ------
    callable
        draw(name, argument) returns the result of the function of that name in `drawing` of "offline/file.js".

    Raises
    ------
    BrowserError
        If there is no browser, or the picture cannot be drawn.
    ModelError
        If the state cannot be computed.
    """
    if scenes().get(data.scene.name) is not data.scene:
        add(data.scene, data.scene.name)
    # The densities of this picture are computed from the frames of the cloud pictures.
    _, page = state_page(data.link, [data.picture.name, *(cloud.name for cloud, _ in densities(data))])
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "page.html"
        file.write_bytes(page)
        context, modules = _in_browser(lambda browser: _open(browser, file.as_uri()))
        call = "({ drawing }, [name, argument]) => drawing[name](argument)"
        try:
            yield lambda name, argument: _in_browser(lambda _: modules.evaluate(call, [name, argument]))
        finally:
            _in_browser(lambda _: context.close())


def _open(browser: Browser, address: str) -> tuple[BrowserContext, JSHandle]:
    """Open the page of a file, wait until it has drawn its state, and return its window and module exports."""
    context = browser.new_context(
        viewport={"width": _VIEWPORT, "height": _VIEWPORT},
        color_scheme="light",
        reduced_motion="reduce",
        offline=True,
        # `wait_ready` evaluates a script, which the Content-Security-Policy would block.
        bypass_csp=True,
    )
    try:
        page = context.new_page()
        page.goto(address, timeout=1000 * _SECONDS)
        wait_ready(page)
        return context, page.evaluate_handle("address => import(address)", module_address())
    except BaseException:
        context.close()
        raise


def bytes_of(address: str) -> bytes:
    """Return the contents of a data URL."""
    return base64.b64decode(address.partition(",")[2])


def png_of(data: PictureData, width: float = 85.0, black: bool = False) -> bytes:
    """Return a picture as a PNG file of 300 dots per inch.

    Parameters
    ----------
    data : PictureData
        The picture, not a plot.
    width : float
        Width in millimetres, within `WIDTHS`.
    black : bool
        True for black on white instead of the colours of the page.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If the width is not supported.
    BrowserError
        If there is no browser, or the picture cannot be drawn.
    ModelError
        If the state cannot be computed.
    """
    WIDTHS.require("A figure", width, "mm wide")
    with page_of(data) as draw:
        return bytes_of(draw("pictureUrl", [data.picture.name, width, black, data.texts]))


def page_image(data: PictureData, width: float = 85.0, black: bool = False) -> PageImage:
    """Return the image and the texts of a picture; parameters and errors as in `png_of`."""
    WIDTHS.require("A figure", width, "mm wide")
    with page_of(data) as draw:
        found = draw("imageAndTexts", [data.picture.name, width, black])
    return PageImage(bytes_of(found["image"]), found["texts"], found["edge"])
