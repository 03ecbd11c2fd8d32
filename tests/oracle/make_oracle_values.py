"""Finds anew what the oracle keeps: `python tests/oracle/make_oracle_values.py` (some minutes).

The tests that ask the oracle are run with nothing kept; what took long to answer goes to "oracle_values.json".
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

    kept.KEPT.clear()
    asking = [str(path) for path in sorted(TESTS.rglob("test_*.py")) if "oracle" in path.read_text()]
    pytest.main([*asking, "-n", "0", "-k", "not what_is_kept"])
    lines = (f"{json.dumps(question)}: {json.dumps([seconds, kept.plain(found)])}"
             for question, (seconds, found) in sorted(kept.ANSWERED.items()) if seconds >= LONG)
    kept.KEPT_IN.write_text("{\n" + ",\n".join(lines) + "\n}\n")
