"""Wrong statements: the tests that "wrong_statements.toml" names exist, and the forbidden words are gone."""

import re
import tomllib
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
STATEMENTS = tomllib.loads((TESTS / "wrong_statements.toml").read_text("utf-8"))["statement"]


def is_defined(test):
    path, _, name = test.partition("::")
    return re.search(rf"^def {name}\(", (TESTS / path).read_text("utf-8"), re.MULTILINE)


def test_every_correction_has_tests():
    assert all(one["wrong"] and one["correct"] and one["tests"] for one in STATEMENTS)
    assert [test for one in STATEMENTS for test in one["tests"] if not is_defined(test)] == []


def test_no_forbidden_words_return():
    forbidden = [words for one in STATEMENTS for words in one.get("forbidden", [])]
    assert forbidden
    for part in ("app", "models"):
        for path in (path for kind in ("*.md", "*.py") for path in (TESTS.parent / part).rglob(kind)):
            text = " ".join(path.read_text("utf-8").split())
            assert [words for words in forbidden if words in text] == [], path
