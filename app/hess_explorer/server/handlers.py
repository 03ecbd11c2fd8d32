"""Replace some handlers of Bokeh's server.

They are in the list `bokeh.server.urls.per_app_patterns`, which is documented by Bokeh and also changed by Panel.
"""

from __future__ import annotations

from collections.abc import Sequence

from bokeh.server.urls import per_app_patterns
from panel.io.server import DocHandler, WSHandler

from hess_explorer.server.headers import GuardedDocument
from hess_explorer.server.websockets import PanelSocket
from hess_mechanics.errors import ModelError


class HandlerMissing(ModelError):
    """A handler was not found, because the installed version of Panel or Bokeh is not supported."""


def replace_handlers(embedders: Sequence[str]) -> None:
    """Install the explorer's document headers and websocket limits for servers that are created afterwards.

    Parameters
    ----------
    embedders : sequence of str
        Hosts that may embed parts of the page; "*" allows all hosts, an empty sequence none.

    Raises
    ------
    HandlerMissing
        If Panel's handlers are not found.
    """
    GuardedDocument.embedders = tuple(embedders) or ("'none'",)
    for theirs, ours in ((DocHandler, GuardedDocument), (WSHandler, PanelSocket)):
        at = next((i for i, route in enumerate(per_app_patterns) if issubclass(route[1], theirs)), None)
        if at is None:
            raise HandlerMissing(
                f"Bokeh's server has no {theirs.__name__} of Panel to replace, so the page would be served without its "
                "limits and security headers: install the versions of panel and bokeh that hess-explorer requires."
            )
        per_app_patterns[at] = (per_app_patterns[at][0], ours)
