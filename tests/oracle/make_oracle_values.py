"""Finds anew what `oracle` keeps: `python tests/make_oracle_values.py` (some minutes).

The tests that ask the oracle are run with nothing kept; what took long to answer goes to "oracle_values.json".
"""

import json
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE)]

LONG = 0.2

if __name__ == "__main__":
    import oracle

    oracle.KEPT.clear()
    asking = [str(path) for path in sorted(HERE.parent.rglob("test_*.py")) if "oracle" in path.read_text()]
    pytest.main([*asking, "-n", "0", "-k", "not what_is_kept"])
    lines = (f"{json.dumps(question)}: {json.dumps([seconds, oracle.plain(found)])}"
             for question, (seconds, found) in sorted(oracle.ANSWERED.items()) if seconds >= LONG)
    oracle.KEPT_IN.write_text("{\n" + ",\n".join(lines) + "\n}\n")
