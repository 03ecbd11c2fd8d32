"""The handlers of Bokeh's server that the explorer replaces by its own.

They stand in `bokeh.server.urls.per_app_patterns`, a list that Bokeh documents and Panel changes in the same way.
"""

from __future__ import annotations

from collections.abc import Sequence

from bokeh.server.urls import per_app_patterns
from panel.io.server import DocHandler, WSHandler

from hess_explorer.server.headers import GuardedDocument
from hess_explorer.server.websockets import PanelSocket

__all__ = ["HandlerMissing", "replace_handlers"]


class HandlerMissing(RuntimeError):
    """A handler to replace is not there: this Panel or Bokeh is none that the explorer was tried with."""


def replace_handlers(embedders: Sequence[str]) -> None:
    """Serve documents with the explorer's headers and Panel's websocket with its limits, from the next server on.

    Parameters
    ----------
    embedders : hosts that may show parts of the page, "*" any, none at all: nobody.

    Raises
    ------
    HandlerMissing : Panel's own are not found, so that the page would be served without headers or limits.
    """
    GuardedDocument.embedders = tuple(embedders) or ("'none'",)
    for theirs, ours in ((DocHandler, GuardedDocument), (WSHandler, PanelSocket)):
        at = next((i for i, route in enumerate(per_app_patterns) if issubclass(route[1], theirs)), None)
        if at is None:
            raise HandlerMissing(
                f"Bokeh's server has no {theirs.__name__} of Panel to replace, so the page would be served without its "
                "limits and security headers: install the versions of panel and bokeh that hess-explorer asks for."
            )
        per_app_patterns[at] = (per_app_patterns[at][0], ours)
