"""Explanations of the terms in the texts of scenes, from "glossary.md"."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cache
from html import escape
from itertools import count
from pathlib import Path

_ENTRY = re.compile(r"^- \*\*(.+?)\*\*: (.+?)(?=\n- |\Z)", re.MULTILINE | re.DOTALL)


@cache
def glossary() -> Mapping[str, str]:
    """Return the meaning of each term, by the term in lower case."""
    text = Path(__file__).with_name("glossary.md").read_text(encoding="utf-8").strip()
    return {
        name.lower(): " ".join(meaning.split()) for names, meaning in _ENTRY.findall(text) for name in names.split(", ")
    }


@cache
def _terms() -> re.Pattern[str]:
    # Match longer terms first: "limit cycles" before "limit cycle".
    longest = sorted(glossary(), key=len, reverse=True)
    return re.compile(rf"\b(?:{'|'.join(map(re.escape, longest))})\b", re.IGNORECASE)


def explainer() -> Callable[[str], str]:
    """Return a function that converts pieces of a text to HTML and explains each term at its first occurrence.

    A term is a button that opens its meaning.  This needs no script, and works with mouse, keyboard and touch.
    """
    known: set[str] = set()
    numbers = count()

    def button(match: re.Match[str]) -> str:
        meaning = glossary()[match[0].lower()]
        if meaning in known:
            return match[0]
        known.add(meaning)
        name = f"term-{next(numbers)}"
        return (
            f'<button type="button" class="term" popovertarget="{name}" title="{escape(meaning)}">{match[0]}</button>'
            f'<span class="meaning" id="{name}" popover>{escape(meaning)}</span>'
        )

    return lambda text: _terms().sub(button, escape(text, quote=False))
