"""`python tests/benchmarks/benchmark_trade.py`: what each level costs in all scenes; ten lines of it: app/README.md."""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.benchmark.machine import describe
from hess_explorer.benchmark.trade import as_text, costliest, names, trade
from support.measured import write_measured

ROOT = Path(__file__).resolve().parents[2]


def main():
    """Measure for two minutes, print all, write ten lines."""
    rows = [*trade(names(), 3, lambda text: print(f"{text} …", file=sys.stderr, flush=True))]
    print(as_text(rows))
    facts = describe()
    head = f"{facts['date']}, {facts['processor']}, {facts['cores']} cores, Python {facts['python']}."
    write_measured(ROOT / "app" / "README.md", f"{head}\n\n{as_text(costliest(rows, 10))}")


if __name__ == "__main__":
    main()
