"""`python tests/manual/benchmark_trade.py`: what each level costs in all scenes.

The table of all kinds of computation goes to app/README.md, with the ten scenes and kinds that take longest, and to the
words of "Speed and accuracy".
"""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from manual.integrators.machine import conditions
from manual.integrators.trade import Failed, as_text, by_kind, costliest, heading, line_of, names, trade
from support.measured import write_measured

ROOT = Path(__file__).resolve().parents[2]
WORDS = ROOT / "app" / "hess_explorer" / "scenes"


def main():
    """Measure for two minutes, print all, write the tables."""
    print(heading(), end="", flush=True)
    rows = []
    for row in trade(names(), 3, lambda text: print(f"{text} …", file=sys.stderr, flush=True)):
        print(line_of(row), end="", flush=True)
        if isinstance(row, Failed):
            sys.exit(f"{row.name}, {row.kind}: {row.why}")
        rows.append(row)
    table, head = by_kind(rows), f"{conditions()}."
    print(f"\n{table}")
    write_measured(ROOT / "app" / "README.md", f"{head}\n\n{table}\n{as_text(costliest(rows, 10))}")
    for file in (WORDS / "speed_accuracy.md", WORDS / "speed_accuracy_of_maps.md"):
        write_measured(file, f"{head}\n\n{table}")


if __name__ == "__main__":
    main()
