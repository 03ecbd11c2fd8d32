"""Cost of a sweep beside a bare loop, in a store, and on two workers: `python tests/manual/benchmark_sweep.py`.

It prints the table of tests/manual/sweep.md, and keeps it there.
"""

import math
import shutil
import sys
import tempfile
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np

from hess_explorer.sweep import sweep
from hess_mechanics import level
from hess_mechanics.catalogue import find
from hess_mechanics.suslov_hess.rotation_number import values_at
from manual.timing import in_turn, report

README = Path(__file__).with_name("sweep.md")
TORI = {"h": (0.2, 2.0, 316), "f": (0.01, 1.0, 316)}
MOTIONS = {"w1": (0.2, 1.4, 40), "I22": (1.0, 2.0, 30)}


def tori_by_hand():
    """Compute ρ of all tori, fifty rows at a time."""
    h, f = (np.linspace(*places) for places in TORI.values())
    for first in range(0, len(h), 50):
        rows = np.meshgrid(h[first : first + 50], f, indexing="ij")
        values_at(0.5, *(x.ravel() for x in rows), level("precise"))


def motions_by_hand():
    """Compute λ of all motions, one by one."""
    what = find("lyapunov suslov")
    w1, moments = (np.linspace(*places).tolist() for places in MOTIONS.values())
    for one in w1:
        for moment in moments:
            what.compute({"w1": one, "I22": moment, "duration": 500.0}, "draft")


def rows(title, by_hand, name, over, **fixed):
    """Return the rows of one sweep."""
    cells = math.prod(places[2] for places in over.values())
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"

        def stored(**options):
            # A store that is there would be resumed.
            shutil.rmtree(store, ignore_errors=True)
            sweep(name, over, store=store, **fixed, **options)

        ways = {
            f"{title} of {cells} cells in a loop": by_hand,
            "– `sweep` in memory": lambda: sweep(name, over, **fixed),
            "– `sweep` in a store": stored,
            "– `sweep` in a store, by two workers": lambda: stored(workers=2),
        }
        seconds = in_turn(ways.values(), turns=3)
    return [[way, f"{one:.2f} s", f"{one / seconds[0]:.2f}"] for way, one in zip(ways, seconds, strict=True)]


def main():
    """Measure for some minutes."""
    lines = rows("ρ", tori_by_hand, "circle-map", TORI, a=0.5)
    lines += rows("λ", motions_by_hand, "lyapunov suslov", MOTIONS, accuracy="draft", duration=500.0)
    report(["what", "time", "ratio to the loop"], lines, README)


if __name__ == "__main__":
    main()
