"""`python tests/manual/benchmark_peers.py`: the whole benchmark, into the README and the picture about it."""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]
    from manual.integrators.threads import one_each

    # The libraries listen to this only when they are first imported.
    one_each()

from manual.bench import TARGETS, WORKS
from manual.integrators.picture import draw
from manual.integrators.report import as_text
from manual.integrators.run import run
from support.measured import write_measured

ROOT = Path(__file__).resolve().parents[2]


def main():
    """Measure for some minutes, then write."""
    report = run(WORKS, TARGETS, False, lambda text: print(f"{text} …", file=sys.stderr, flush=True))
    write_measured(Path(__file__).parent / "integrators" / "README.md", as_text(report))
    (ROOT / ".github" / "pictures" / "work-precision.svg").write_bytes(draw(report, ".svg"))


if __name__ == "__main__":
    main()
