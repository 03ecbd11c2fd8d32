"""What a picture shows, as a file to take away: for the dialog *Export*."""

from __future__ import annotations

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlencode

import numpy as np
from tornado.web import RequestHandler

from hess_explorer.compute.budget import Abandoned, limited
from hess_explorer.export.file import content
from hess_explorer.export.shown import shown
from hess_explorer.protocol.parameters import MAX_QUERY, Choice, Number, decode
from hess_mechanics.errors import ModelError

__all__ = ["Export"]

_TYPES = {"csv": "text/csv; charset=utf-8", "json": "application/json", "png": "image/png",
          "svg": "image/svg+xml; charset=utf-8", "pdf": "application/pdf"}
_SPECS = (Choice("format", "Format", tuple(_TYPES), "csv"), Choice("black", "Black", ("0", "1"), "0"),
          Number("width", "width", "Width", 85.0, (20.0, 400.0), 5.0, (20.0, 400.0)))

# One file at a time: those who look at pages come first.
_pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="export")
_MOST = 20
"""So many may wait."""


class Export(RequestHandler):
    """GET /export?<state>&picture=NAME&format=…&width=MM&black=1: the file, or a sentence why there is none."""

    waiting = 0

    def initialize(self) -> None:
        """Nobody has left yet."""
        self._left = threading.Event()

    def on_connection_close(self) -> None:
        """What nobody waits for any more is not computed to the end."""
        self._left.set()

    async def get(self) -> None:
        """Answer with the file; 400 and a sentence for what cannot be computed or drawn, 503 where too many wait."""
        self.set_header("X-Content-Type-Options", "nosniff")
        if len(self.request.query) > MAX_QUERY:
            self._refuse(400, f"The link is longer than {MAX_QUERY} characters: export from a state of fewer clicks.")
            return
        if Export.waiting >= _MOST:
            self._refuse(503, "Too many files are being made at the moment: try again in a minute.")
            return
        Export.waiting += 1
        try:
            name, kind, data = await asyncio.get_running_loop().run_in_executor(_pool, self._file)
        except Abandoned:
            return
        except ModelError as error:
            self._refuse(400, str(error))
            return
        finally:
            Export.waiting -= 1
        self.set_header("Content-Type", _TYPES[kind])
        self.set_header("Content-Disposition", f'attachment; filename="{name}.{kind}"')
        self.finish(data)

    def _file(self) -> tuple[str, str, bytes]:
        """Name, format and bytes of what is asked for.  Raises `ModelError`, `Abandoned`."""
        read, _ = decode(self.request.query, _SPECS)
        given = {name: self.get_query_argument(name) for name in self.request.query_arguments}
        picture, kind = given.pop("picture", ""), str(read["format"])
        with limited(self._left), np.errstate(all="ignore"):
            found = shown(urlencode(given), picture)
            data = content(found, kind, float(read["width"]), read["black"] == "1")
        return f"{found.scene.name}-{found.picture.name}", kind, data

    def _refuse(self, status: int, sentence: str) -> None:
        self.set_status(status)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(sentence)
