"""`python tests/benchmarks/benchmark_peers.py`: the whole benchmark, into the README and the picture about it."""

import sys
from pathlib import Path

from hess_explorer.benchmark.threads import one_each

if __name__ == "__main__":
    # The libraries listen to this only when they are first imported.
    one_each()
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.benchmark.picture import draw
from hess_explorer.benchmark.report import as_text
from hess_explorer.benchmark.run import run
from support.measured import write_measured

ROOT = Path(__file__).resolve().parents[2]
WORKS = ("A", "A2", "B", "B2", "C", "D")
TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)


def main():
    """Measure for some minutes, then write."""
    report = run(WORKS, TARGETS, False, lambda text: print(f"{text} …", file=sys.stderr, flush=True))
    write_measured(ROOT / "app" / "hess_explorer" / "benchmark" / "README.md", as_text(report))
    (ROOT / ".github" / "pictures" / "work-precision.svg").write_bytes(draw(report, ".svg"))


if __name__ == "__main__":
    main()
