"""Convert the Markdown of a lesson to HTML: embedded HTML is escaped, formulas become MathML, images are disabled."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from typing import Any
from xml.etree import ElementTree

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from hess_explorer.lessons.lesson import LessonError

__all__ = ["parser", "to_html"]

_ELEMENT = re.compile(r"\{http://www\.w3\.org/1998/Math/MathML\}m[a-z]+")
_SHOWN = 40


class _BadFormula(ValueError):
    """The formula cannot be converted, or contains more than MathML."""


def _formula(latex: str, options: dict[str, Any]) -> str:
    """Return a formula as MathML; only elements of MathML are accepted, because the library does not escape text."""
    try:
        found: str = convert(latex, display="block" if options["display_mode"] else "inline")
        parts = list(ElementTree.fromstring(found).iter())
    # The library raises errors of many types.
    except Exception as error:
        raise _BadFormula(latex) from error
    if not all(_ELEMENT.fullmatch(part.tag) and "href" not in part.attrib for part in parts):
        raise _BadFormula(latex)
    return found


@cache
def parser() -> MarkdownIt:
    """Return a parser for CommonMark with tables, formulas and front matter."""
    found = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
    found.use(front_matter_plugin).use(dollarmath_plugin, renderer=_formula, allow_space=False, double_inline=True)
    # The plugin renders a displayed formula in a line as a <div>, which would end the paragraph.
    found.add_render_rule("math_inline_double", _displayed)
    return found


def _displayed(_: object, tokens: Sequence[Token], i: int, *rest: object) -> str:
    return f'<span class="math">{_formula(tokens[i].content, {"display_mode": True})}</span>'


def to_html(text: str, line: int = 1, inline: bool = False) -> str:
    """Return Markdown as HTML.

    Parameters
    ----------
    text : str
        The Markdown.
    line : int
        Line of the file at which the text begins, for error messages.
    inline : bool
        True for text without paragraphs.

    Returns
    -------
    str
        The HTML.

    Raises
    ------
    LessonError
        If a formula cannot be converted.
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
