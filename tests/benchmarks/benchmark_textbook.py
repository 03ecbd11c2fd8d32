"""`python tests/benchmarks/benchmark_textbook.py`: twelve textbook systems beside heyoka, into the README about it.

Both integrate to the end of the time span, with several orders and tolerances.  The time of a code is that of its
fastest setting with an error of at most `TARGET`, measured in turns; the truth is heyoka's at its smallest tolerance.
"""

import math
import sys
import time
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import heyoka
import numpy as np

from benchmarks.integrators.machine import conditions
from support.measured import table, write_measured
from support.textbook import TEXTBOOK

TARGET = 1e-9
"""Largest error of a component, relative to the largest component of the state if that exceeds 1."""
_TOLERANCES = [10.0**-k for k in range(8, 17)]
_ORDERS = (12, 16, 20, 24)
_ROUNDS, _TURN = 7, 0.01


def theirs(system, span, tolerance, **options):
    """A run of heyoka; parameters are numbers, so that factors 0 and 1 fall out."""
    y = heyoka.make_vars(*[f"y{i}" for i in range(len(system.variables))])
    start, p = system.example
    rates = [rate + heyoka.expression(0.0) for rate in system.field(y, p)]
    integrator = heyoka.taylor_adaptive(list(zip(y, rates, strict=True)), list(start), tol=tolerance, **options)

    def run():
        integrator.time = 0.0
        integrator.state[:] = start
        integrator.propagate_until(span)
        return integrator.state.copy()

    return run


def ours(system, span, tolerance, order):
    """A run of the kernel of one orbit."""
    start, p = (np.array(values, float) for values in system.example)
    times, out = np.array([span]), np.empty((1, start.size))

    def run():
        system.orbit(start, p, times, order, tolerance, math.inf, 1_000_000, out)
        return out[0].copy()

    return run


def seconds(run, least):
    """The shortest time of a run, of all runs within `least` seconds."""
    found, until = [], time.perf_counter() + least
    while not found or time.perf_counter() < until:
        begun = time.perf_counter()
        run()
        found.append(time.perf_counter() - begun)
    return min(found)


def cheapest(runs, truth):
    """The fastest run with an error of at most `TARGET`."""
    size = TARGET * max(1.0, float(np.abs(truth).max()))
    right = [run for run in runs if np.abs(run() - truth).max() <= size]
    return min(right, key=lambda run: seconds(run, _TURN))


def row(name):
    """Measure one system: both times in microseconds, and their ratio."""
    system, span = TEXTBOOK[name]
    truth = theirs(system, span, 1e-18, high_accuracy=True)()
    runs = (
        cheapest([ours(system, span, tolerance, order) for tolerance in _TOLERANCES for order in _ORDERS], truth),
        cheapest([theirs(system, span, tolerance) for tolerance in _TOLERANCES], truth),
    )
    one, other = np.min([[seconds(run, _TURN) for run in runs] for _ in range(_ROUNDS)], axis=0) * 1e6
    return name, one, other, other / one


def main():
    """Measure for some minutes, then write."""
    rows = []
    for name in TEXTBOOK:
        rows.append(row(name))
        print("{}: {:.0f} µs, heyoka {:.0f} µs, ratio {:.2f}".format(*rows[-1]), file=sys.stderr, flush=True)
    ahead = sum(ratio >= 1.0 for *_, ratio in rows)
    cells = [(name, f"{one:.0f} µs", f"{other:.0f} µs", f"{ratio:.2f}") for name, one, other, ratio in rows]
    text = (
        f"{conditions()}, heyoka {heyoka.__version__}.\n\nFaster than heyoka or as fast: {ahead} of {len(rows)}.\n\n"
        + table(["system", "this project", "heyoka", "ratio"], cells)
    )
    write_measured(Path(__file__).parent / "textbook.md", text)


if __name__ == "__main__":
    main()
