"""Convert the Markdown of a lesson to HTML: formulas become MathML; HTML and unknown images are shown as text."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any
from xml.etree import ElementTree

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.common.utils import escapeHtml
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

# Matches an inline formula with the punctuation after it, between which a browser would break the line.
_STOPS = re.compile(r'(<span class="math inline">.*?</span>)([.,;:!?)]+)', re.DOTALL)
_ELEMENT = re.compile(r"\{http://www\.w3\.org/1998/Math/MathML\}(m[a-z]+)")
_CHILDREN = {"mfrac": 2, "mroot": 2, "msub": 2, "msup": 2, "munder": 2, "mover": 2, "msubsup": 3, "munderover": 3}
LAYER, DRAGGED = re.compile(r"()([\w-]+/[\w-]+)"), re.compile(r"(drag:)(\w+)")
"""Target of a link to a layer of a picture, and of a number that can be dragged."""
_COMMAND = re.compile(r"\\(?:[A-Za-z]+|.)")


class BadFormula(ValueError):
    """The formula cannot be converted, or contains more than MathML; the message contains a remedy."""


def formula(latex: str, options: Mapping[str, Any]) -> str:
    """Return a formula as MathML.

    Parameters
    ----------
    latex : str
        The formula.
    options : mapping of str
        "display_mode": True for a formula on a line of its own.

    Returns
    -------
    str
        The MathML.

    Raises
    ------
    BadFormula
        If the formula cannot be converted, or the result has elements other than MathML: the library does not escape
        text.
    """
    try:
        found: str = convert(latex, display="block" if options["display_mode"] else "inline")
        parts = list(ElementTree.fromstring(found).iter())
    # The library raises exceptions of many types.
    except Exception as error:
        raise BadFormula("write it in LaTeX between dollars, and a dollar itself as \\$.") from error
    for part in parts:
        name = _ELEMENT.fullmatch(part.tag)
        if not name or "href" in part.attrib:
            raise BadFormula("only formulas are read here: leave out the HTML.")
        # The library converts an unknown command to text.
        if unknown := _COMMAND.search(part.text or ""):
            raise BadFormula(f"{unknown[0]} is not a known command: use another one.")
        if len(part) != _CHILDREN.get(name[1], len(part)):
            raise BadFormula("the argument of a command is missing: add it in braces.")
    return found


@cache
def parser() -> MarkdownIt:
    """Return a parser for CommonMark with tables, formulas and front matter; HTML is text."""
    found = _with_plugins(MarkdownIt("commonmark", {"html": False}))
    # The plugin renders an inline $$…$$ as a <div>, which would end the paragraph.
    found.add_render_rule("math_inline_double", _display_formula)
    found.add_render_rule("image", _image)
    found.add_render_rule("link_open", _link)
    return found


@cache
def strict_parser() -> MarkdownIt:
    """Return a parser that recognizes elements that `parser` shows as text: HTML, any link, unescaped signs."""
    found = _with_plugins(MarkdownIt("commonmark", {"html": True})).disable("text_join")
    found.validateLink = lambda url: True  # type: ignore[method-assign]
    return found


def _with_plugins(parser: MarkdownIt) -> MarkdownIt:
    parser.enable("table").use(front_matter_plugin)
    return parser.use(dollarmath_plugin, renderer=formula, allow_space=False, double_inline=True)


def _display_formula(_: object, tokens: Sequence[Token], i: int, *rest: object) -> str:
    return f'<span class="math">{formula(tokens[i].content, {"display_mode": True})}</span>'


def _image(_: object, tokens: Sequence[Token], i: int, options: object, env: Mapping[str, Any]) -> str:
    words = escapeHtml(tokens[i].content)
    url = env["images"].get(tokens[i].attrs["src"])
    return words if url is None else f'<img src="{url}" alt="{words}">'


def _link(renderer: Any, tokens: Sequence[Token], i: int, options: Any, env: Any) -> str:
    """Render the start of a link: a new tab for other hosts, a button for a layer or a number to drag."""
    target = str(tokens[i].attrs["href"])
    if found := LAYER.fullmatch(target) or DRAGGED.fullmatch(target):
        end = next(token for token in tokens[i:] if token.type == "link_close")
        tokens[i].tag = end.tag = "button"
        tokens[i].attrs = {"class": "drag" if found[1] else "names", "value": found[2]}
    elif not target.startswith("?"):
        tokens[i].attrSet("target", "_blank")
        tokens[i].attrSet("rel", "noopener")
    html: str = renderer.renderToken(tokens, i, options, env)
    return html


def to_html(text: str, images: Mapping[str, str] | None = None, inline: bool = False) -> str:
    """Return Markdown as HTML.

    Parameters
    ----------
    text : str
        The Markdown.
    images : mapping, optional
        URLs of the images by their targets; an image without one is shown as its alternative text.
    inline : bool
        True for text without paragraphs.

    Returns
    -------
    str
        The HTML.

    Raises
    ------
    BadFormula
        If a formula cannot be converted; `checks.problems_in` finds it first.
    """
    env = {"images": images or {}}
    html: str = parser().renderInline(text, env) if inline else parser().render(text, env)
    return _STOPS.sub(r'<span class="unbroken">\1\2</span>', html)
