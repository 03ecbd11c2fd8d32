"""Corrected statements: README.md names a test for each; the tests exist and the wrong sentences are gone."""

import re
from functools import cache
from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
README = (TESTS / "README.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in row.strip("|").split("|")]
    for row in re.findall(
        r"^\|.*\|$", README.partition("## Corrected statements")[2].partition("\n## ")[0], re.MULTILINE
    )
][2:]


@cache
def words():
    """Return all texts of the explorer and the library, white space normalized, by file."""
    files = [path for part in ("app", "models") for kind in ("*.md", "*.py") for path in (ROOT / part).rglob(kind)]
    return {path: " ".join(path.read_text(encoding="utf-8").split()) for path in files}


def test_every_test_that_the_readme_names_exists():
    named = re.findall(r"`([\w/]+\.py)::(\w+)`", README)
    assert len(named) > 30
    defined = {
        path: set(re.findall(r"^def (test_\w+)", (TESTS / path).read_text(encoding="utf-8"), re.MULTILINE))
        for path in {path for path, _ in named}
    }
    assert [(path, name) for path, name in named if name not in defined[path]] == []


@pytest.mark.parametrize("row", ROWS, ids=[row[0][:30] for row in ROWS])
def test_a_sentence_that_was_wrong_is_gone_and_what_is_so_has_a_test(row):
    was, so, held = row
    assert so
    assert "::" in held
    for sentence in re.findall(r"“([^”]+)”", was):
        assert [path for path, text in words().items() if sentence in text] == []
