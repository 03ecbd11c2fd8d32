"""Check the Markdown of a lesson: report unsupported elements with their lines, instead of showing them as text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from markdown_it.token import Token

from hess_explorer.lessons.images import ImageError, Images
from hess_explorer.lessons.lesson import LessonError
from hess_explorer.lessons.markdown import DRAGGED, LAYER, BadFormula, formula, strict_parser
from hess_explorer.lessons.settings import require_layer, require_number, state_of_link
from hess_explorer.scenes.framework.scene import Scene

_MOST_SHOWN = 40
_MATH = {"math_inline": False, "math_inline_double": True, "math_block": True, "math_block_label": True}


def problems_in(text: str, line: int, images: Images, scene: Scene[Any] | None) -> Iterator[LessonError]:
    """Yield the mistakes in a Markdown text that begins at a line.

    Parameters
    ----------
    text : str
        The Markdown.
    line : int
        Line of its first line in the file, from 1.
    images : Images
        Receives the images of the text.
    scene : Scene or None
        The scene whose pictures the text names; None if the step has no valid state.

    Yields
    ------
    LessonError
        A mistake with its line in the file.
    """
    for token in strict_parser().parse(text):
        yield from _problems_of(token, line + (token.map[0] if token.map else 0), images, scene)


def _problems_of(token: Token, at: int, images: Images, scene: Scene[Any] | None) -> Iterator[LessonError]:
    for child in token.children or () if token.type == "inline" else ():
        yield from _problems_of(child, at, images, scene)
        at += child.content.count("\n") + (child.type in ("softbreak", "hardbreak"))
    try:
        _check(token, at, images, scene)
    except ImageError as error:
        yield LessonError(f"{_short(str(token.attrs['src']))}: {error}", at)
    except BadFormula as error:
        yield LessonError(f"the formula {_short(token.content.strip())} cannot be set: {error}", at)
    except LessonError as error:
        yield error


def _check(token: Token, at: int, images: Images, scene: Scene[Any] | None) -> None:
    """Raise an error if the page cannot show a token."""
    if token.type == "text" and "$" in token.content:
        raise LessonError(
            "a dollar sign has no counterpart: close the formula without a space inside, or write \\$.", at
        )
    if token.type.startswith("html"):
        raise LessonError(f"{_short(token.content)} is HTML, which is not read here: write it in Markdown.", at)
    if token.type in _MATH:
        formula(token.content, {"display_mode": _MATH[token.type]})
    elif token.type == "image":
        if not token.content.strip():
            raise LessonError("the image has no alternative text: write one, like ![A wheel](wheel.png).", at)
        images.add(str(token.attrs["src"]))
    elif token.type == "link_open":
        target = str(token.attrs["href"])
        if target.startswith("?"):
            state_of_link(target, at)
        elif LAYER.fullmatch(target):
            if scene is not None:
                require_layer(target, scene, at)
        elif number := DRAGGED.fullmatch(target):
            if scene is not None:
                require_number(number[2], scene, at)
        elif not re.match(r"https?://[^/]", target, re.IGNORECASE):
            ways = "https://…, ?scene=… for a state of the page, picture/layer, or drag:NAME for a number"
            raise LessonError(f"the link to {_short(target)} has an unknown target: write {ways}.", at)


def _short(text: str) -> str:
    return repr(text if len(text) <= _MOST_SHOWN else text[:_MOST_SHOWN] + "…").replace("\\\\", "\\")
