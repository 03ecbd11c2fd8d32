"""Request handler of the *Export* dialog: a picture, or a whole state, as a file."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, ClassVar
from urllib.parse import urlencode

import numpy as np
from tornado.iostream import StreamClosedError
from tornado.web import RequestHandler

from hess_explorer.compute.budget import ClientGone, time_budget
from hess_explorer.export.formats import FORMATS, SERVED_SECONDS, WIDTHS, FileRequest, formats_of
from hess_explorer.export.notebook import PROGRAMS
from hess_explorer.export.picture_data import address, compute
from hess_explorer.offline.pages import page_family, state_page
from hess_explorer.protocol.specs import MAX_QUERY, ChoiceSpec, NumberSpec, decode
from hess_explorer.scenes import scenes
from hess_explorer.server.home import home_of
from hess_explorer.server.refusal import refuse
from hess_explorer.server.slow_file import slow_file
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter, ModelError

_SPECS = (
    ChoiceSpec("format", "Format", tuple(FORMATS), "csv"),
    ChoiceSpec("black", "Black", ("0", "1"), "0"),
    NumberSpec("width", "width", "Width", FileRequest.width, WIDTHS, 5.0, WIDTHS),
    NumberSpec("seconds", "seconds", "Seconds", FileRequest.seconds, SERVED_SECONDS, 1.0, SERVED_SECONDS),
    ChoiceSpec("loop", "Loop", ("", "light", "dark"), ""),
    ChoiceSpec("grid", "Grid", ("0", "1"), "0"),
)

# Draw one file and one slow file at a time, so that open pages have priority.
_files = ThreadPoolExecutor(max_workers=1, thread_name_prefix="export")
_one_slow = asyncio.Lock()
_MOST = {False: 20, True: 5}
"""Maximum number of waiting requests by whether the file is slow."""
_MOST_STATES = 400
"""Maximum number of states of a page with sliders."""
_SECONDS = 10.0
"""CPU time limit in seconds of a file that is not slow."""


def _needs_browser(name: str, picture: str, kind: str) -> bool:
    """Return whether a browser draws the file: a film, or a figure of a picture other than a plot."""
    scene = scenes().get(name, next(iter(scenes().values())))
    view = next((view for view in scene.views if view.name == picture), scene.views[0])
    return kind in formats_of("film") or (kind in formats_of("figure") and not isinstance(view, Plot))


class Export(RequestHandler):
    """GET /export?<state>&picture=NAME&format=…&width=MM&black=1&seconds=S&loop=dark: the file, or an error message.

    The formats py and ipynb are Python code that computes the picture, as a script and as a notebook.  For HTML,
    `picture` and `vary`, the sliders that move in the page, may be lists with commas, and grid=1 asks for all
    combinations.  A slow file, which is a page with sliders or drawn by a browser, is preceded by lines that report its
    progress: "queued", "3/250" after the third of 250 frames or states, and finally "file 12345" with the number of
    bytes that follow, or "why" and an error message.

    Attributes
    ----------
    waiting : dict of bool to int
        Number of unanswered requests for files that are not slow and for slow files, in this process.
    """

    waiting: ClassVar[dict[bool, int]] = {False: 0, True: 0}
    _task: asyncio.Task[Any] | None = None

    def initialize(self) -> None:
        """Create the event that cancels a computation."""
        self._left = threading.Event()

    def on_connection_close(self) -> None:
        """Cancel the export, because the client has disconnected."""
        self._left.set()
        if self._task is not None:
            self._task.cancel()

    async def get(self) -> None:
        """Respond with the file; with 400 and a message if it cannot be created, with 503 if too many requests wait.

        A slow file that fails after its first line of progress ends with a line "why" instead.
        """
        self._task = asyncio.current_task()
        self.set_header("X-Content-Type-Options", "nosniff")
        if len(self.request.query) > MAX_QUERY:
            refuse(self, 400, f"The link is longer than {MAX_QUERY} characters: export a state with fewer points.")
            return
        given = {name: self.get_query_argument(name) for name in self.request.query_arguments}
        read, _ = decode(self.request.query, _SPECS)
        own = {spec.name for spec in _SPECS} | {"picture", "vary"}
        query, picture = urlencode([one for one in given.items() if one[0] not in own]), given.get("picture", "")
        sliders = given["vary"].split(",") if read["format"] in formats_of("state") and given.get("vary") else []
        is_slow = bool(sliders) or _needs_browser(given.get("scene", ""), picture, str(read["format"]))
        if self.waiting[is_slow] >= _MOST[is_slow]:
            refuse(self, 503, "The server is making too many files at the moment: try again in a minute.")
            return
        self.waiting[is_slow] += 1
        try:
            if is_slow:
                await self._answer_slowly(query, picture, read, sliders)
            else:
                request = FileRequest(str(read["format"]), float(read["width"]), read["black"] == "1")
                name, data = await asyncio.get_running_loop().run_in_executor(
                    _files, self._file, query, picture, request
                )
                self.set_header("Content-Type", FORMATS[request.kind].media)
                self.set_header("Content-Disposition", f'attachment; filename="{name}.{request.kind}"')
                self.finish(data)
        except (ClientGone, StreamClosedError, asyncio.CancelledError):
            return
        except ModelError as error:
            refuse(self, 400, str(error))
        finally:
            self.waiting[is_slow] -= 1

    def _file(self, query: str, picture: str, request: FileRequest) -> tuple[str, bytes]:
        """Return name and contents of the file.  Raises `ModelError`, `ClientGone`."""
        if request.kind == "html":
            with time_budget(self._left, _SECONDS), np.errstate(all="ignore"):
                pictures = picture.split(",") if picture else ()
                return state_page(query, pictures, home=home_of(self.request), lenient=True)
        where = address(query, picture, lenient=True)
        name = f"{where.scene.name}-{where.picture.name}"
        if request.kind in PROGRAMS:
            return name, PROGRAMS[request.kind](where).encode()
        # Imported here, because no page needs HoloViews.
        from hess_explorer.export.figure import as_file

        with time_budget(self._left, _SECONDS), np.errstate(all="ignore"):
            return name, as_file(compute(where), request)

    async def _answer_slowly(self, query: str, picture: str, read: dict[str, Any], sliders: Sequence[str]) -> None:
        """Send lines that report the progress, then the file.  Raises `ModelError` if it cannot be created."""
        grid = bool(sliders) and read["grid"] == "1"
        # Reject an impossible file immediately, before it waits in the queue.
        await asyncio.get_running_loop().run_in_executor(_files, self._check_slow, query, picture, sliders, grid)
        options = {
            "state": query,
            "picture": picture,
            "format": read["format"],
            "width": f"{read['width']:g}",
            "seconds": f"{read['seconds']:g}",
            "loop": read["loop"],
            "page": home_of(self.request),
        }
        words = [
            *(f"--{name}={value}" for name, value in options.items() if value),
            *(f"--vary={slider}" for slider in sliders),
            *(["--black"] if read["black"] == "1" else []),
            *(["--grid"] if grid else []),
            "--lenient",
        ]
        self.set_header("Content-Type", "application/octet-stream")
        self._say("queued")
        async with _one_slow:
            try:
                data = await slow_file(words, self._say)
            except ModelError as error:
                self._say(f"why {error}")
            else:
                self._say(f"file {len(data)}")
                self.finish(data)

    def _say(self, line: str) -> None:
        self.write(f"{line}\n")
        self.flush()

    def _check_slow(self, query: str, picture: str, sliders: Sequence[str], grid: bool) -> None:
        """Raise `InvalidParameter` if the query, a picture or a slider is invalid, or there are too many states."""
        if not sliders:
            address(query, picture, lenient=True)
            return
        count = len(page_family(query, sliders, grid=grid, lenient=True).points)
        if count > _MOST_STATES:
            raise InvalidParameter(
                f"These are {count} states; the server computes at most {_MOST_STATES}: choose fewer values, or use "
                "the command."
            )
