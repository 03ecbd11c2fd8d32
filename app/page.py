"""The page: controls beside, pictures in a row, player, status, words."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any
from urllib.parse import urlencode

import panel as pn
import panel_material_ui as pmui
from panel.util import edit_readonly

from app.components import STATIC, Player, Ready, SceneMenu, Text
from app.controls import Controls, ExampleMenu
from app.scenes import scenes
from app.scenes.base import Picture, Scene, Stage
from app.session import Session
from app.state import CLIENT, Choice, Values, decode
from app.words import with_formulas

__all__ = ["page"]

logger = logging.getLogger("hess_explorer")

THEME = Choice("theme", "Theme", ("light", "dark"), "light")

PAGE_CSS = (STATIC / "page.css").read_text(encoding="utf-8")

# The system's font: the fourteen files of another one would come before the first picture.
FONT = "system-ui, sans-serif"

WIDE: dict[str, Any] = {"sizing_mode": "stretch_width"}


def page() -> Any:
    """A new page for one session, in the state that its URL describes."""
    try:
        return _page(_query())
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
    menu = SceneMenu(scenes=[_entry(one) for one in scenes().values()], shown=scene.name, **WIDE)
    controls_column, main_column = pn.Column(**WIDE), pn.Column(**WIDE)
    result = pmui.Page(
        meta_name="Hess Explorer",
        meta_description=scene.summary,
        dark_theme=dark,
        theme_config={"typography": {"fontFamily": FONT}},
        sidebar=[menu, controls_column],
        sidebar_width=300,
        sidebar_resizable=False,  # its handle has a name but no role
        main=[main_column, ready],
        sx={"& .MuiLinearProgress-root": {"display": "none"}},  # has no name, and `data-ready` says the same
    )

    def build(scene: Scene, values: Values, change: Callable[[Values], None]) -> tuple[Stage, Callable[[Values], None]]:
        stage = scene.stage()
        stage.look_from(client["az"], client["el"])
        controls = Controls(scene.specs, values, scene.limits(values), change)
        examples = ExampleMenu(scene, change)
        controls_column.objects = [
            examples.root, *controls.roots, _buttons(),
            Text(key="derived", look="derived", tag="div", margin=(8, 8), **WIDE),
        ]
        main_column.objects = _main(scene, stage, client)
        menu.shown = scene.name
        result.title = f"Hess Explorer · {scene.title}"

        def show_menus(values: Values) -> None:
            controls.show(values)
            examples.show(values)

        return stage, show_menus

    Session(ready, build, scene, state, notes)
    # The page's own busy flag is sent with every event and makes Panel walk through all models each
    # time (100 ms); `data-ready` says the same.
    with edit_readonly(result):
        result.busy = False
    return result


def _entry(scene: Scene) -> dict[str, str | None]:
    """What the menu of scenes says of one."""
    return {"name": scene.name, "title": scene.title, "summary": scene.summary, "picture": scene.thumbnail,
            "origin": scene.origin}


def _buttons() -> pn.Row:
    """What they do is in "ready.js": a reset goes with the request for its state, the link is the browser's."""
    return pn.Row(
        pmui.Button(label="Reset", variant="outlined", size="small", css_classes=["param-reset"]),
        pmui.Button(label="Copy link", variant="outlined", size="small", css_classes=["param-link"]),
        margin=(8, 4),
    )


def _main(scene: Scene, stage: Stage, client: dict[str, float]) -> list[Any]:
    """The pictures, their legend, the player, the status line, the words."""
    player = Player(
        t=client["t"], speed=client["speed"], angles=list(stage.angles),
        dots={name: list(columns) for name, columns in stage.dots.items()}, margin=(0, 8), **WIDE,
    )
    return [
        pn.Column(*map(_cell, stage.pictures), css_classes=["pictures"], stylesheets=[PAGE_CSS], **WIDE),
        pn.pane.HTML(scene.legend, stylesheets=[PAGE_CSS], margin=(0, 8), **WIDE),
        pn.Column(player, css_classes=["dock"], stylesheets=[PAGE_CSS], **WIDE),
        pn.Column(
            Text(key="status", look="status", live=True, **WIDE),
            Text(key="notes", look="notes", live=True, **WIDE),
            margin=(4, 8), **WIDE,
        ),
        pn.pane.Markdown(
            with_formulas(scene.words), css_classes=["words"], stylesheets=[PAGE_CSS], margin=(0, 8), **WIDE),
    ]


def _cell(picture: Picture) -> pn.Column:
    root = picture.root
    body = root if isinstance(root, pn.viewable.Viewable) else pn.pane.Bokeh(root, margin=0, **WIDE)
    classes = ["picture", f"picture-{picture.name}"]
    return pn.Column(picture.caption, body, css_classes=classes, stylesheets=[PAGE_CSS], **WIDE)
