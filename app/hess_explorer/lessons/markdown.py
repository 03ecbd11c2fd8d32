"""Markdown of a lesson: HTML in it is shown as text, formulas are MathML, pictures from elsewhere are not asked for."""

from __future__ import annotations

import re
from functools import cache
from typing import Any
from xml.etree import ElementTree

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from hess_explorer.lessons.lesson import LessonError

__all__ = ["parser", "to_html"]

_ELEMENT = re.compile(r"\{http://www\.w3\.org/1998/Math/MathML\}m[a-z]+")
_SHOWN = 40


class _BadFormula(ValueError):
    """Not set, or more than a formula."""


def _formula(latex: str, options: dict[str, Any]) -> str:
    """MathML.  Text in a formula is not escaped by the library: so nothing but elements of MathML comes out of here."""
    try:
        found: str = convert(latex, display="block" if options["display_mode"] else "inline")
        parts = list(ElementTree.fromstring(found).iter())
    # The library has errors of many types.
    except Exception as error:
        raise _BadFormula(latex) from error
    if not all(_ELEMENT.fullmatch(part.tag) and "href" not in part.attrib for part in parts):
        raise _BadFormula(latex)
    return found


@cache
def parser() -> MarkdownIt:
    """CommonMark with tables, formulas and front matter."""
    found = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
    return found.use(front_matter_plugin).use(dollarmath_plugin, renderer=_formula, allow_space=False)


def to_html(text: str, line: int = 1, inline: bool = False) -> str:
    """HTML of Markdown that begins in this line, without paragraphs if `inline`.

    Raises `LessonError` for a formula that cannot be set.
    """
    try:
        html: str = parser().renderInline(text) if inline else parser().render(text)
    except _BadFormula as error:
        formula = str(error)
        shown = formula if len(formula) <= _SHOWN else formula[:_SHOWN] + "…"
        raise LessonError(
            f"the formula {shown!r} cannot be set: write it in LaTeX between dollars, and a dollar itself as \\$.",
            line + text[: max(0, text.find(formula))].count("\n"),
        ) from error
    return html
