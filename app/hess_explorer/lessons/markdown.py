"""Convert the Markdown of a lesson to HTML: formulas become MathML; HTML and unknown images are shown as text."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any
from xml.etree import ElementTree

from latex2mathml.commands import CONVERSION_MAP, LOCAL_FONTS, MATH_NON_FONT_COMMANDS
from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.common.utils import escapeHtml
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

__all__ = ["BadFormula", "formula", "parser", "strict_parser", "to_html"]

# A formula in a line and the stops after it, between which a browser would break the line.
_STOPS = re.compile(r'(<span class="math inline">.*?</span>)([.,;:!?)]+)', re.DOTALL)
_ELEMENT = re.compile(r"\{http://www\.w3\.org/1998/Math/MathML\}(m[a-z]+)")
_CHILDREN = {"mfrac": 2, "mroot": 2, "msub": 2, "msup": 2, "munder": 2, "mover": 2, "msubsup": 3, "munderover": 3}
_COMMAND = re.compile(r"\\(?:[A-Za-z]+|.)")
# Fonts and environments, whose arguments the library shows although it does not know them.
_ARGUMENT = re.compile(r"\\math[a-z]+|\\begin\s*\{([^}]*)\}")


class BadFormula(ValueError):
    """The formula cannot be converted, or contains more than MathML.

    mistakes : what is wrong, each with its place in the text; empty if that is not known.
    """

    def __init__(self, latex: str, mistakes: Sequence[tuple[str, int]] = ()) -> None:
        self.mistakes = mistakes
        super().__init__(latex)


def formula(latex: str, options: Mapping[str, Any]) -> str:
    """Return a formula as MathML; only elements of MathML are accepted, because the library does not escape text."""
    mistakes = [*_unbalanced(latex)]
    try:
        found: str = convert(latex, display="block" if options["display_mode"] else "inline")
        parts = list(ElementTree.fromstring(found).iter())
    # The library raises errors of many types.
    except Exception as error:
        raise BadFormula(latex, mistakes) from error
    names = [_ELEMENT.fullmatch(part.tag) for part in parts]
    if not all(name and "href" not in part.attrib for name, part in zip(names, parts, strict=True)):
        raise BadFormula(latex)
    # The library shows a command that it does not know as text.
    shown = {one for part in parts for one in _COMMAND.findall(part.text or "")}
    mistakes += [
        (f"{one[0]} is not a known command.", one.start()) for one in _COMMAND.finditer(latex) if one[0] in shown
    ]
    mistakes += [
        (f"{one[0]} is not known.", one.start())
        for one in _ARGUMENT.finditer(latex)
        if not {f"\\{one[1]}", one[0]} & {*CONVERSION_MAP, *LOCAL_FONTS, *MATH_NON_FONT_COMMANDS}
    ]
    if not mistakes and any(
        name and len(part) != _CHILDREN.get(name[1], len(part)) for name, part in zip(names, parts, strict=True)
    ):
        mistakes.append(("the argument of a command is missing.", 0))
    if mistakes:
        raise BadFormula(latex, mistakes)
    return found


def _unbalanced(latex: str) -> Iterator[tuple[str, int]]:
    """Yield the braces without a partner, which the library adds by itself."""
    opened: list[int] = []
    for one in re.finditer(r"\\.|[{}]", latex):
        if one[0] == "{":
            opened.append(one.start())
        elif one[0] == "}" and opened:
            opened.pop()
        elif one[0] == "}":
            yield "} has no { before it.", one.start()
    yield from (("{ is not closed.", at) for at in opened)


@cache
def parser() -> MarkdownIt:
    """Return a parser for CommonMark with tables, formulas and front matter; HTML is text."""
    found = _with_plugins(MarkdownIt("commonmark", {"html": False}))
    # The plugin renders a displayed formula in a line as a <div>, which would end the paragraph.
    found.add_render_rule("math_inline_double", _displayed)
    found.add_render_rule("image", _image)
    found.add_render_rule("link_open", _link)
    return found


@cache
def strict_parser() -> MarkdownIt:
    """Return a parser that finds what `parser` shows as text: HTML, links of any kind, signs without a backslash."""
    found = _with_plugins(MarkdownIt("commonmark", {"html": True})).disable("text_join")
    found.validateLink = lambda url: True  # type: ignore[method-assign]
    return found


def _with_plugins(found: MarkdownIt) -> MarkdownIt:
    found.enable("table").use(front_matter_plugin)
    return found.use(dollarmath_plugin, renderer=formula, allow_space=False, double_inline=True)


def _displayed(_: object, tokens: Sequence[Token], i: int, *rest: object) -> str:
    return f'<span class="math">{formula(tokens[i].content, {"display_mode": True})}</span>'


def _image(_: object, tokens: Sequence[Token], i: int, options: object, env: Mapping[str, Any]) -> str:
    words = escapeHtml(tokens[i].content)
    url = env["images"].get(tokens[i].attrs["src"])
    return words if url is None else f'<img src="{url}" alt="{words}">'


def _link(renderer: Any, tokens: Sequence[Token], i: int, options: Any, env: Any) -> str:
    """Open pages of other hosts apart, so that the lesson stays."""
    if not str(tokens[i].attrs["href"]).startswith("?"):
        tokens[i].attrSet("target", "_blank")
        tokens[i].attrSet("rel", "noopener")
    found: str = renderer.renderToken(tokens, i, options, env)
    return found


def to_html(text: str, images: Mapping[str, str] | None = None, inline: bool = False) -> str:
    """Return Markdown as HTML.

    Parameters
    ----------
    text : str
        The Markdown.
    images : mapping, optional
        URLs of the images by their targets; an image without one is shown as its words.
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
