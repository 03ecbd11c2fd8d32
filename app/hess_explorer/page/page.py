"""The page: menu of scenes and controls beside, pictures in a row, player, status, words."""

from __future__ import annotations

import logging
from typing import Any
from urllib.parse import urlencode

import panel as pn
import panel_material_ui as pmui
from panel.util import edit_readonly

from hess_explorer.page.components import Controls, Pictures, Player, Progress, Prose, Ready, SceneMenu, Text
from hess_explorer.page.session import Session
from hess_explorer.protocol.parameters import CLIENT, Choice, decode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

__all__ = ["page"]

logger = logging.getLogger("hess_explorer")

THEME = Choice("theme", "Theme", ("light", "dark"), "light")

# The system's font: the fourteen files of another one would come before the first picture.
FONT = "system-ui, sans-serif"

WIDE: dict[str, Any] = {"sizing_mode": "stretch_width"}


def page() -> Any:
    """A new page for one session, in the state that its URL describes."""
    try:
        return _page(_query())
    # Whatever it is, a user sees a sentence and the log the rest.
    except Exception:
        logger.exception("the page could not be built")
        return pn.pane.Str("The page could not be built. Open it without the part of its address after “?”.")


def _query() -> str:
    """The query of the request that opened this session."""
    context = pn.state.curdoc.session_context if pn.state.curdoc else None
    arguments = getattr(getattr(context, "request", None), "arguments", None) or {}
    return urlencode([(name, given[0].decode("utf-8", "replace")) for name, given in arguments.items() if given])


def _page(query: str) -> pmui.Page:
    choice = Choice("scene", "Scene", tuple(scenes()), next(iter(scenes())))
    chosen, _ = decode(query, (choice,))
    scene = scenes()[str(chosen["scene"])]
    # A scene's own notes on the link; that of another version is among them.
    state, notes = decode(query, (choice, *scene.specs, *CLIENT, THEME))
    client = {spec.name: float(state.pop(spec.name)) for spec in CLIENT}
    client["speed"] = min(Player.SPEEDS, key=lambda speed: abs(speed - client["speed"]))
    dark = state.pop("theme") == "dark"

    ready = Ready(client={name: repr(value) for name, value in client.items()}, width=0, height=0, margin=0)
    result = pmui.Page(
        meta_name="Hess Explorer",
        meta_description=scene.summary,
        dark_theme=dark,
        theme_config={"typography": {"fontFamily": FONT}},
        sidebar=[
            SceneMenu(scenes=[_entry(one) for one in scenes().values()], **WIDE),
            Controls(**WIDE),
            Text(key="derived", look="derived", tag="div", margin=(8, 8), **WIDE),
        ],
        sidebar_width=300,
        sidebar_resizable=False,  # its handle has a name but no role
        main=[
            Pictures(**WIDE),
            Prose(part="legend", margin=(0, 8), **WIDE),
            Player(css_classes=["dock"], margin=(0, 8), **WIDE),
            Text(key="status", look="status", live=True, margin=(4, 8, 0, 8), **WIDE),
            Text(key="notes", look="notes", live=True, margin=(0, 8, 4, 8), **WIDE),
            Prose(part="words", margin=(0, 8), **WIDE),
            Progress(css_classes=["floating"], width=0, height=0, margin=0),
            Text(key="busy", look="busy", live=True, css_classes=["floating"], width=0, height=0, margin=0),
            ready,
        ],
        sx={
            "& .MuiLinearProgress-root": {"display": "none"},  # has no name, and `data-ready` says the same
            # On a phone a title of three lines would cover the first caption.
            "@media (max-width: 799px)": {"& .MuiAppBar-root .MuiTypography-root": {"fontSize": "1.05rem"}},
        },
    )

    def entered(scene: Scene[Any]) -> None:
        result.title = f"Hess Explorer · {scene.title}"

    session = Session(ready, entered, scene, state, notes)
    pn.state.on_session_destroyed(lambda _: session.background.stop())
    # The page's own busy flag is sent with every event and makes Panel walk through all models each
    # time (100 ms); `data-ready` says the same.
    with edit_readonly(result):
        result.busy = False
    return result


def _entry(scene: Scene[Any]) -> dict[str, str | None]:
    """What the menu of scenes says of one."""
    return {"name": scene.name, "title": scene.title, "summary": scene.summary, "picture": scene.thumbnail,
            "origin": scene.origin}
