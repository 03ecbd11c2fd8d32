"""Sentences on the page have at most 25 words: the words of the scenes and the lessons."""

import re
from pathlib import Path

import pytest

APP = Path(__file__).resolve().parents[2] / "app/hess_explorer"
TEXTS = [*sorted(APP.glob("scenes/*.md")), *sorted(APP.glob("lessons/*.md"))]
LONGEST = 25


def sentences(text):
    """Return the sentences of a Markdown text; a formula counts as one word, and a displayed one ends its sentence."""
    text = re.sub(r"^---\n.*?\n---\n|```.*?```|<!--.*?-->|^\|[^\n]*$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^#[^\n]*$|\$\$.+?\$\$", "\n\n", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", re.sub(r"\$.+?\$", "F", text, flags=re.DOTALL))
    blocks = re.split(r"\n\s*\n|\n(?=\s*(?:[-*] |\d+\. ))", text)
    return [
        " ".join(sentence.split())
        for block in blocks
        for sentence in re.split(r"(?<=[.?!])[”*]*\s+|(?<=[:;])\s+(?=[A-Z“*])", block)
    ]


@pytest.mark.parametrize("path", TEXTS, ids=[path.name for path in TEXTS])
def test_sentences_are_short(path):
    found = [one for one in sentences(path.read_text(encoding="utf-8")) if len(re.findall(r"\S*\w\S*", one)) > LONGEST]
    assert found == []
