"""How far kernels are from the processor: `python tests/benchmarks/benchmark_limits.py` rewrites limits.md.

Operations are counted from the recursion that generates a kernel; a multiplication with its addition counts two.  The
limit is a loop of independent multiplications and additions, in as many vector registers as every processor has.
"""

import math
import re
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numba
import numpy as np

from benchmarks.benchmark_growth import seconds as seconds_of
from benchmarks.integrators.explorer import METHOD
from benchmarks.integrators.machine import conditions
from benchmarks.integrators.works import works
from hess_mechanics import systems
from support.measured import table, write_measured

FILE = Path(__file__).parent / "limits.md"
SETTINGS = {"A": (16, 3.2e-11), "A2": (22, 3.2e-13), "B2": (22, 1e-14), "D": (20, 1e-10)}
NUMBERS = 56
"""Independent numbers of the loop: 14 vectors of four."""
ROUNDS = 20_000


def limit():
    """Return the operations a second that one core reaches."""
    each = range(NUMBERS)
    names = {}
    exec(
        f"""
def run(out, s, t):
    {"; ".join(f"a{i} = out[{i}]" for i in each)}
    for _ in range({ROUNDS}):
        {"; ".join(f"a{i} = a{i} * s + t" for i in each)}
    {"; ".join(f"out[{i}] = a{i}" for i in each)}
""",
        names,
    )
    run, out = numba.njit(fastmath={"contract"})(names["run"]), np.ones(NUMBERS)
    return 2 * NUMBERS * ROUNDS / seconds_of(lambda: run(out, 0.5, 0.25))


def operations(recursion, order, halved):
    """Return the operations of the series of one step, and of its sum.

    halved : True if the kernel adds the products of a square once.
    """
    in_rates = len(re.findall(r" [-+*/] ", recursion.source))
    products = sum(0.5 if halved and a == b else 1.0 for a, b in recursion.pairs)
    return order * (order + 1) * products + order * in_rates + 2 * order * recursion.variables


def steps_of(work, order, tolerance):
    """Return the steps of all orbits of a work."""
    suslov, parameters = systems()["suslov"], np.array(work.parameters)
    out = np.empty((1, 5))
    arguments = parameters, work.times[-1:], order, tolerance, math.inf, 10**6, out
    return sum(suslov.orbit(start, *arguments)[0] for start in work.initial)


def main():
    """Measure for some seconds, print a table, write it."""
    peak, rows, recursion = limit(), [], systems()["suslov"].recursion
    for name, (order, tolerance) in SETTINGS.items():
        work = works()[name]
        seconds = seconds_of(METHOD.prepare(work, (order, tolerance), 1))
        steps = steps_of(work, order, tolerance)
        samples = work.times.size if name == "A" else 0
        count = steps * operations(recursion, order, name == "B2") + samples * 2 * order * recursion.variables
        rows.append(
            (
                f"{name}: {work.title}",
                f"{order}",
                f"{steps:,}",
                f"{1e9 * seconds / steps:.0f} ns",
                f"{count / steps:,.0f}",
                f"{1e-9 * count / seconds:.1f}",
                f"{100 * count / seconds / peak:.0f} %",
            )
        )
    head = ["work", "order", "steps", "a step", "operations a step", "10⁹ a second", "of the limit"]
    found = table(head, rows)
    print(found)
    write_measured(FILE, f"{conditions()}. The limit of a core: {1e-9 * peak:.1f}·10⁹ operations a second.\n\n{found}")


if __name__ == "__main__":
    main()
