"""Descriptions of scenes for the browser, each sent once: empty pictures, controls and texts."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token

from hess_explorer.lessons import suggestions
from hess_explorer.lessons.reading import without_suggestions
from hess_explorer.page.glossary import explainer
from hess_explorer.page.lesson_description import steps
from hess_explorer.protocol.specs import ChoiceSpec, ControlSpec, NumberSpec
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.swarm import SWARM
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import with_formulas
from hess_explorer.views.theme import SHADES
from hess_mechanics.parameters import GROUPS


@cache
def describe(name: str) -> str:
    """Return the description of a scene as JSON, which all sessions share."""
    scene = scenes()[name]
    # "Speed and accuracy" has the parameters of a scene, but does not show its swarm.
    groups = [*GROUPS, *(["Swarm"] if SWARM in scene.tracks else []), "Chart"]
    text = json.dumps(
        {
            "name": scene.name,
            "title": scene.title,
            "pictures": [{**view.describe(), "folded": view.button or None} for view in scene.views],
            "controls": [
                _control(spec) for spec in scene.specs if isinstance(spec, ControlSpec) and spec.group in groups
            ],
            "essential": list(scene.essential),
            "handle": _handle(scene),
            "moves": scene.moves,
            "lead": list(scene.lead or scene.open_pictures[:1]),
            "groups": groups,
            "drawn": not all(isinstance(spec, ControlSpec) for spec in scene.specs),
            "presets": [preset.name for preset in scene.presets],
            "legend": scene.legend,
            "words": _html(scene),
            "tries": steps(suggestions().get(scene.name)),
            "tracks": [f"data-{name}" for name in scene.tracks],
            "dots": {source: list(columns) for source, columns in scene.dots.items()},
            "angles": list(scene.angles),
            "shades": SHADES,
        }
    )
    # Model ids count up in each process, and a page may hold the descriptions of several processes.
    return re.sub(r'"p(\d+)"', rf'"{name}-\1"', text)


def _handle(scene: Scene[Any]) -> dict[str, Any] | None:
    """Return the suggested first drag: a control, or a layer of a picture; None without either."""
    picture, _, layer = scene.handle.partition("/")
    if not layer:
        name = scene.handle or next(iter(scene.essential), "")
        return {"control": name} if name else None
    view = next(view for view in scene.views if view.name == picture and isinstance(view, Plot))
    found = next(one for one in view.layers if one.name == layer)
    return {"picture": picture, "source": view.source_of(found), "columns": list(found.columns)}


def _html(scene: Scene[Any]) -> str:
    """Return the text of a scene as HTML, with inline drawings in the colours of the page."""

    def drawing(_: object, tokens: Sequence[Token], i: int, *rest: object) -> str:
        return scene.drawing(str(tokens[i].attrs["src"]))

    markdown = MarkdownIt().enable("table")
    markdown.add_render_rule("image", drawing)
    explain = explainer()
    markdown.add_render_rule("text", lambda _, tokens, i, *rest: explain(tokens[i].content))
    html: str = markdown.render(with_formulas(scene.words if scene.origin else without_suggestions(scene.words)))
    return html


def _control(spec: ControlSpec) -> dict[str, Any]:
    common = {"name": spec.name, "label": spec.label, "help": spec.doc, "group": spec.group}
    if isinstance(spec, NumberSpec):
        return {"kind": "number", "symbol": spec.symbol, "range": list(spec.softbounds), **common}
    if isinstance(spec, ChoiceSpec):
        return {"kind": "choice", "options": list(spec.options), **common}
    return {"kind": "formula", **common}


def without_gestures(picture: Mapping[str, Any]) -> dict[str, Any]:
    """Return the description of an open picture without the gestures that change the state.

    Parameters
    ----------
    picture : mapping
        An element of "pictures" in the description of a scene.

    Returns
    -------
    dict
        The changed description.
    """
    picks: dict[str, Any] = {"picks": [], "handle": None} if "picks" in picture else {}
    return {**picture, "folded": None, "hands": "", **picks}
