"""`python tests/manual/benchmark_sweep.py`: what a sweep costs beside a bare loop, in a store, and on two workers.

It rewrites the table of app/hess_explorer/sweep/README.md; `--quick` prints a trial.
"""

import math
import os
import sys
import tempfile
import time
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np

from hess_explorer.sweep import sweep
from hess_mechanics import level
from hess_mechanics.catalogue import find
from hess_mechanics.suslov_hess.rotation_number import values_at
from manual.integrators.machine import conditions
from support.measured import write_measured

README = Path(__file__).resolve().parents[2] / "app" / "hess_explorer" / "sweep" / "README.md"
QUICK = "--quick" in sys.argv
ROUNDS = 1 if QUICK else 3


def tori():
    """ρ over tori, and the loop by hand: fifty rows at a time."""
    over = {"h": (0.2, 2.0, 316), "f": (0.01, 1.0, 316)}

    def by_hand():
        h, f = (np.linspace(*places) for places in over.values())
        for first in range(0, len(h), 50):
            rows = np.meshgrid(h[first : first + 50], f, indexing="ij")
            values_at(0.5, *(x.ravel() for x in rows), level("precise"))

    return "ρ", ("circle-map", over), {"a": 0.5}, by_hand


def motions():
    """λ of motions, and the loop by hand: one by one."""
    over = {"w1": (0.2, 1.4, 8 if QUICK else 40), "I22": (1.0, 2.0, 6 if QUICK else 30)}
    what, fixed = find("lyapunov suslov"), {"duration": 500.0}

    def by_hand():
        w1, moments = (np.linspace(*places).tolist() for places in over.values())
        for one in w1:
            for moment in moments:
                what.compute({"w1": one, "I22": moment, **fixed}, "draft")

    return "λ", ("lyapunov suslov", over), {"level": "draft", **fixed}, by_hand


def timed(function):
    """Return the elapsed seconds."""
    begun = time.perf_counter()
    function()
    return time.perf_counter() - begun


def rows(symbol, what, fixed, by_hand):
    """Return the lines of the table: minima of all rounds."""
    ways = {
        "in memory": {},
        "in a store": {"store": "one"},
        "in a store, by two workers": {"store": "two", "workers": 2},
    }
    seconds = dict.fromkeys(ways, math.inf)
    hand = math.inf
    # They compile the kernels, and import what a store needs.
    by_hand()
    sweep("circle-map", {"h": [0.5]})
    for _ in range(ROUNDS):
        hand = min(hand, timed(by_hand))
        for way, options in ways.items():
            with tempfile.TemporaryDirectory() as folder:
                own = {**options, "store": Path(folder) / options["store"]} if "store" in options else options
                seconds[way] = min(seconds[way], timed(lambda own=own: sweep(*what, **fixed, **own)))
    cells = math.prod(places[2] for places in what[1].values())
    yield f"| {symbol} of {cells} cells by hand | {hand:.2f} s | {1e6 * hand / cells:.3g} µs | |"
    for way, one in seconds.items():
        yield f"| – `sweep` {way} | {one:.2f} s | {1e6 * one / cells:.3g} µs | {one / hand:.2f} |"


def main():
    """Measure for some minutes."""
    load = os.getloadavg()[0]
    lines = [
        f"{conditions()}; load before: {load:.1f}.",
        "",
        "| what | time | a cell | beside by hand |",
        "|---|---|---|---|",
        *(line for case in (tori(), motions()) for line in rows(*case)),
    ]
    text = "\n".join(lines)
    print(text)
    if not QUICK:
        write_measured(README, text)


if __name__ == "__main__":
    main()
