"""How cost grows: `python tests/benchmarks/benchmark_growth.py` rewrites growth.md and its picture.

One core.  A slope is that of the logarithm of the least time over that of the size, fitted over the upper half of the
sizes, where what every call costs no longer counts.
"""

import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np
from matplotlib.figure import Figure

from benchmarks.benchmark_change import Page
from benchmarks.integrators.machine import conditions
from hess_explorer.scenes import scenes
from hess_explorer.sweep import sweep
from hess_mechanics import Plane, ensemble, level, section, solve, systems
from support.measured import table, write_measured

FOLDER = Path(__file__).parent
PICTURE = FOLDER.parents[1] / ".github" / "pictures" / "growth.svg"
LEAST_SECONDS = 0.2
"""For which each size is repeated."""

HESS, SUSLOV = systems()["hess"], systems()["suslov"]


@dataclass(frozen=True)
class Growth:
    """A cost that should grow as the power `expected` of a size.

    prepare(size) returns the function that is timed.
    """

    title: str
    size: str
    sizes: tuple[int, ...]
    expected: float
    prepare: Callable[[int], Callable[[], object]]


def of_span(span):
    return lambda: solve(*HESS.example_motion, [0.0, float(span)], "precise")


def of_samples(samples):
    times = np.linspace(0.0, 100.0, samples)
    return lambda: solve(*HESS.example_motion, times, "precise")


def of_order(order):
    """The order for whose tolerance it is best, e^(2 − 2N) (Jorba and Zou, 2005)."""
    body, state = HESS.example_motion
    times, out = np.array([1000.0]), np.empty((1, len(state)))
    start, parameters = np.array(state, float), np.array(body.parameters, float)
    return lambda: HESS.orbit(start, parameters, times, order, math.exp(2.0 - 2.0 * order), math.inf, 10**6, out)


def of_orbits(orbits):
    body, state = HESS.example_motion
    # Copies of one orbit, so that all cost the same.
    states = np.array([state] * orbits, float)
    return lambda: ensemble(body, states, [0.0, 20.0], "standard", threads=1)


def of_crossings(crossings):
    body, state = SUSLOV.example_motion
    plane = Plane((0.0, 0.0, 0.0, 0.0, 1.0))
    return lambda: section(body, state, plane, 1e5, level("draft"), crossings)


def of_cells(cells):
    side = math.isqrt(cells)
    over = {"h": (0.2, 2.0, side), "f": (0.01, 1.0, side)}
    return lambda: sweep("circle-map", over=over, a=0.5)


def of_pages(pages):
    scene = scenes()["suslov-hess"]
    every = [Page(scene, seed) for seed in range(pages)]

    def change():
        for page in every:
            page.change()

    return change


GROWTHS = (
    Growth("one orbit, time span", "T", (100, 300, 1000, 3000, 10_000), 1.0, of_span),
    Growth("one orbit, times of the result", "n", (100, 1000, 10_000, 100_000), 1.0, of_samples),
    Growth("one orbit, order of its series", "N", (8, 12, 16, 24, 32), 2.0, of_order),
    Growth("ensemble, orbits", "n", (16, 64, 256, 1024, 4096), 1.0, of_orbits),
    Growth("section, crossings", "n", (30, 100, 300, 1000, 3000), 1.0, of_crossings),
    Growth("chart of rotation numbers, cells", "n", (400, 2500, 10_000, 40_000, 160_000), 1.0, of_cells),
    Growth("pages that change once", "n", (10, 30, 100, 300), 1.0, of_pages),
)


def seconds(function):
    """Return the least CPU time of this thread in repeated calls."""
    function()
    least, begun = math.inf, time.perf_counter()
    while time.perf_counter() - begun < LEAST_SECONDS:
        before = time.thread_time_ns()
        function()
        least = min(least, time.thread_time_ns() - before)
    return 1e-9 * least


def slope(sizes, times):
    """Return the slope of the upper half of the sizes."""
    half = len(sizes) // 2
    return float(np.polyfit(np.log(sizes[half:]), np.log(times[half:]), 1)[0])


def draw(measured):
    """Write the picture: measured times, and the expected power through the last of them."""
    columns = 4
    figure = Figure(figsize=(4.0 * columns, 7.0), layout="constrained")
    panels = figure.subplots(-(-len(measured) // columns), columns).ravel()
    for panel, (growth, times) in zip(panels, measured, strict=False):
        sizes = np.array(growth.sizes, float)
        panel.loglog(sizes, 1e3 * np.array(times), "o-", label=f"measured: {slope(sizes, times):.2f}")
        power = 1e3 * times[-1] * (sizes / sizes[-1]) ** growth.expected
        panel.loglog(sizes, power, "--", color="0.5", label=f"expected: {growth.expected:g}")
        panel.set(title=growth.title, xlabel=growth.size, ylabel="ms")
        panel.legend()
        panel.grid(alpha=0.3)
    for panel in panels[len(measured) :]:
        panel.set_axis_off()
    figure.savefig(PICTURE)


def main():
    """Measure all for about a minute, print a table, write it and the picture."""
    measured = [(growth, [seconds(growth.prepare(size)) for size in growth.sizes]) for growth in GROWTHS]
    rows = [
        (
            growth.title,
            f"{growth.sizes[0]:,} … {growth.sizes[-1]:,}",
            f"{1e3 * times[0]:.3g} … {1e3 * times[-1]:.3g} ms",
            f"{slope(growth.sizes, times):.2f}",
            f"{growth.expected:g}",
        )
        for growth, times in measured
    ]
    found = table(["what", "sizes", "time", "slope", "expected"], rows)
    print(found)
    write_measured(FOLDER / "growth.md", f"{conditions()}.\n\n{found}")
    draw(measured)


if __name__ == "__main__":
    main()
