"""Descriptions of scenes and lessons for the browser: empty pictures, controls and texts, sent once each."""

from __future__ import annotations

import dataclasses
import json
import threading
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token

from hess_explorer.lessons import tries
from hess_explorer.lessons.lesson import Lesson, LessonStep
from hess_explorer.lessons.markdown import to_html
from hess_explorer.lessons.reading import without_tries
from hess_explorer.page.glossary import explained
from hess_explorer.protocol.parameters import Choice, Controlled, Number
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.sweep.chart import sides_of_places, swept
from hess_explorer.sweep.quantities import quantity
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import with_formulas
from hess_explorer.views.theme import SHADES
from hess_mechanics.parameters import GROUPS

__all__ = ["describe", "describe_lesson", "without_gestures"]


_one_at_a_time = threading.Lock()


def describe(name: str) -> str:
    """Return the description of a scene as JSON, which all sessions share."""
    # The options of HoloViews are global.
    with _one_at_a_time:
        return _describe(name)


@cache
def _describe(name: str) -> str:
    scene = scenes()[name]
    return json.dumps(
        {
            "name": scene.name,
            "title": scene.title,
            "pictures": [{**view.describe(), "folded": view.folded or None} for view in scene.views],
            "controls": [_control(spec) for spec in scene.specs if isinstance(spec, Controlled)],
            "essential": list(scene.essential),
            "handle": _handle(scene),
            "moves": scene.moves,
            "opening": scene.opening or scene.open_pictures[0],
            "groups": list(GROUPS),
            "drawn": not all(isinstance(spec, Controlled) for spec in scene.specs),
            "charts": [_chart(scene, charted) for charted in scene.charts],
            "sides": sides_of_places(scene),
            "presets": [preset.name for preset in scene.presets],
            "legend": scene.legend,
            "words": _html(scene),
            "tries": _steps(tries().get(scene.name)),
            "tracks": [f"data-{name}" for name in scene.tracks],
            "dots": {source: list(columns) for source, columns in scene.dots.items()},
            "angles": list(scene.angles),
            "shades": SHADES,
        }
    )


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


def _handle(scene: Scene[Any]) -> dict[str, Any] | None:
    """Return the handle that a newcomer should drag: a control, or a layer of a picture."""
    picture, _, layer = scene.handle.partition("/")
    if not layer:
        name = scene.handle or next(iter(scene.essential), "")
        return {"control": name} if name else None
    view = next(view for view in scene.views if view.name == picture and isinstance(view, Plot))
    found = next(one for one in view.layers if one.name == layer)
    return {"picture": picture, "source": view.source_of(found), "columns": list(found.columns)}


def _chart(scene: Scene[Any], charted: Charted[Any]) -> dict[str, Any]:
    """Return the description of a quantity that can be charted, with its parameters and pictures."""
    what = quantity(charted.quantity)
    return {
        "quantity": what.name,
        "symbol": what.symbol,
        "title": what.title,
        "units": what.units,
        "help": what.doc,
        "turn": what.turn,
        "parts": list(what.parts),
        "names": [list(what.named.get(part, {}).items()) for part in what.parts or ("",)],
        "over": list(swept(scene.name, what.name)),
        "pictures": list(charted.pictures),
    }


def _html(scene: Scene[Any]) -> str:
    """Return the text of a scene as HTML with inline drawings, which take the colours of the page."""

    def drawing(_: object, tokens: Sequence[Token], i: int, *rest: object) -> str:
        return scene.drawing(str(tokens[i].attrs["src"]))

    markdown = MarkdownIt().enable("table")
    markdown.add_render_rule("image", drawing)
    explain = explained()
    markdown.add_render_rule("text", lambda _, tokens, i, *rest: explain(tokens[i].content))
    html: str = markdown.render(with_formulas(scene.words if scene.origin else without_tries(scene.words)))
    return html


def _control(spec: Controlled) -> dict[str, Any]:
    common = {"name": spec.name, "label": spec.label, "help": spec.doc, "group": spec.group}
    if isinstance(spec, Number):
        return {"kind": "number", "symbol": spec.symbol, "range": list(spec.softbounds), **common}
    if isinstance(spec, Choice):
        return {"kind": "choice", "options": list(spec.options), **common}
    return {"kind": "formula", **common}


@cache
def describe_lesson(lesson: Lesson) -> str:
    """Return the description of a lesson as JSON, which all sessions share."""
    return json.dumps({"name": lesson.name, "title": lesson.title, "minutes": lesson.minutes, "steps": _steps(lesson)})


def _steps(lesson: Lesson | None) -> list[dict[str, Any]]:
    return [_step(step, lesson.images) for step in lesson.steps] if lesson else []


def _step(step: LessonStep, images: Mapping[str, str]) -> dict[str, Any]:
    found: dict[str, Any] = {
        "title": to_html(step.title, inline=True),
        "text": to_html(step.text, images),
        "scene": step.at.scene,
        "look": step.look,
        "question": to_html(step.question, images),
        "answer": to_html(step.answer, images),
        "controls": step.controls,
    }
    if step.animation:
        found["animation"] = dataclasses.asdict(step.animation)
    if step.hide:
        found["hide"] = {"picture": step.hide.picture, "source": step.hide.source}
    if step.prediction:
        guess = step.prediction
        found["prediction"] = {
            "picture": guess.picture,
            "source": guess.source,
            "columns": guess.columns,
            "what": guess.what,
        }
    return found
