"""Compute the oracle's stored results again: `python tests/oracle/make_oracle_values.py` (some minutes).

The tests that ask the oracle are run with nothing kept; what took long to answer goes to "oracle_values.json".
With files of tests as arguments only these are run, and what is missing is added.
"""

import json
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
LONG = 0.2

if __name__ == "__main__":
    sys.path[:0] = [str(TESTS)]
    from oracle import kept

    asking = sys.argv[1:]
    if not asking:
        kept.KEPT.clear()
        asking = [str(path) for path in sorted(TESTS.rglob("test_*.py")) if "oracle" in path.read_text()]
    # The oracle is imported before pytest could rewrite its asserts.
    quiet = ["-W", "ignore::pytest.PytestAssertRewriteWarning"]
    if pytest.main([*asking, "-n", "0", "-k", "not what_is_kept", *quiet]):
        sys.exit("A test failed: nothing is changed.")
    answers = kept.KEPT | kept.ANSWERED
    lines = (
        f"{json.dumps(question)}: {json.dumps([seconds, kept.plain(found)])}"
        for question, (seconds, found) in sorted(answers.items())
        if seconds >= LONG
    )
    kept.KEPT_IN.write_text("{\n" + ",\n".join(lines) + "\n}\n")
