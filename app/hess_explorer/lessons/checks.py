"""Checks of a lesson's Markdown: unsupported elements are reported with their lines instead of being shown as text."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from markdown_it.token import Token

from hess_explorer.lessons.images import ImageError, Images
from hess_explorer.lessons.lesson import LessonError
from hess_explorer.lessons.markdown import BadFormula, formula, strict_parser

__all__ = ["problems_in"]

_SHOWN = 40
_MATH = {"math_inline": False, "math_inline_double": True, "math_block": True, "math_block_label": True}
_NO_FORMULA = "write it in LaTeX between dollars, and a dollar itself as \\$."
# Signs of Markdown that other programs understand, in text whose escaped signs are taken out → what to do.
_FOREIGN = (
    (r"\$", "a dollar stands alone: close the formula without a space inside, or write \\$."),
    (r"\[\^[^\]\s]+\]", "footnotes are not read here: write the note into the text."),
    (r"\]\[[^\]]+\]|!\[", "this link or image leads nowhere: write [text](target) or ![text](file.png)."),
    (r"~~\S", "~~ is not read here: leave it out."),
    (r"^\[[ xX]\]\s", "boxes to tick are not read here: leave out [ ]."),
)


def problems_in(text: str, line: int, images: Images, follow: Callable[[str, int], object]) -> Iterator[LessonError]:
    """Yield the mistakes in a Markdown text.

    Parameters
    ----------
    text : str
        The Markdown.
    line : int
        Line of the file at which it begins.
    images : Images
        Gets the images of the text.
    follow : callable
        Called with each link to a state of the page and its line.

    Yields
    ------
    LessonError
        A mistake, with its line.
    """
    env: dict[str, dict[str, dict[str, list[int]]]] = {}
    for token in strict_parser().parse(text, env):
        at = line + (token.map[0] if token.map else 0)
        yield from _problems_of(token, at, images, follow)
    for name, found in env.get("references", {}).items():
        if name.startswith("^"):
            yield LessonError(_FOREIGN[1][1], line + found["map"][0])


def _problems_of(token: Token, at: int, images: Images, follow: Callable[[str, int], object]) -> Iterator[LessonError]:
    if token.type == "inline":
        plain = "".join(map(_plain, token.children or ()))
        for pattern, why in _FOREIGN:
            for found in re.finditer(pattern, plain):
                yield LessonError(why, at + plain[: found.start()].count("\n"))
        for child in token.children or ():
            yield from _problems_of(child, at, images, follow)
            at += _plain(child).count("\n")
    elif token.type.startswith("html"):
        yield LessonError(f"{_short(token.content)} is HTML, which is not read here: write it in Markdown.", at)
    elif token.type in _MATH:
        try:
            formula(token.content, {"display_mode": _MATH[token.type]})
        except BadFormula as error:
            for why, place in error.mistakes or ((_NO_FORMULA, 0),):
                line = at + token.content[:place].count("\n")
                yield LessonError(f"the formula {_short(token.content.strip())} cannot be set: {why}", line)
    elif token.type == "image":
        yield from _problems_of_image(str(token.attrs["src"]), token.content, at, images)
    elif token.type == "link_open":
        yield from _problems_of_link(str(token.attrs["href"]), at, follow)


def _plain(token: Token) -> str:
    """Return the text of a token as far as signs of Markdown may be left in it; a formula as its empty lines."""
    if token.type in ("softbreak", "hardbreak"):
        return "\n"
    return token.content if token.type == "text" else "\0" + "\n" * token.content.count("\n")


def _problems_of_image(target: str, words: str, at: int, images: Images) -> Iterator[LessonError]:
    if not words.strip():
        yield LessonError("the image has no words for those who do not see it: ![A wheel](wheel.png).", at)
    try:
        images.add(target)
    except ImageError as error:
        yield LessonError(f"{_short(target)}: {error}", at)


def _problems_of_link(target: str, at: int, follow: Callable[[str, int], object]) -> Iterator[LessonError]:
    if target.startswith("?"):
        follow(target, at)
    elif not re.match(r"https?://[^/]", target, re.IGNORECASE):
        yield LessonError(
            f"the link to {_short(target)} leads nowhere: write https://…, or ?scene=… for a state of the page.", at
        )


def _short(text: str) -> str:
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "…").replace("\\\\", "\\")
