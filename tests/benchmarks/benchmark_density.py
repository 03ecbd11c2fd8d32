"""Measure the density of the sections: `python tests/benchmarks/benchmark_density.py`; it asserts nothing.

For each scene: the time to the first counted crossings and to a million of them on two threads, from the state of a
slider at rest and with nothing cached; the memory of the counts; the numbers sent with each picture.
"""

import statistics
import sys
import time
from concurrent.futures import ThreadPoolExecutor

from hess_explorer.compute.cache import CACHE
from hess_explorer.scenes import scenes

STATES = {"suslov": "h", "ball-section": "h", "quartic": "h", "euler-poisson": "h"}
TIMES = 5


def measured(name, value):
    """Return the seconds to the first crossings, to all, of CPU and of shading; crossings; bytes kept and sent."""
    scene = scenes()[name]
    values = {**scene.defaults(), STATES[name]: value}
    begun, used = time.perf_counter(), time.process_time()
    tasks = scene.compute(values, (), False).density
    tasks._found  # noqa: B018 — requests the stages
    first = None
    with ThreadPoolExecutor(2) as pool:
        found = [pool.submit(CACHE.get, task.function, *task.arguments) for task in tasks.work.todo]
        for one in found:
            one.result()
            first = first or time.perf_counter() - begun
    whole, used = time.perf_counter() - begun, time.process_time() - used
    result = scene.compute(values, (), False).density
    begun = time.perf_counter()
    shown = result.tones
    shading = time.perf_counter() - begun
    held = sum(one.result()[0].counts.nbytes for one in found)
    return first, whole, used, shading, result.points, held, sum(4 * one.size for one in shown)


def main():
    """Print a row for each scene: medians over some values of a slider."""
    print("| scene | first crossings | all | CPU | shading | crossings | a CPU second | kept | sent |")
    print("|---" * 9 + "|")
    for name in sys.argv[1:] or STATES:
        default = scenes()[name].defaults()[STATES[name]]
        measured(name, default)  # compiles the kernels
        rows = [measured(name, default * (1.0 + 1e-3 * (i + 1))) for i in range(TIMES)]
        first, whole, used, shading, points, held, sent = (
            statistics.median(column) for column in zip(*rows, strict=True)
        )
        print(
            f"| {name} | {1e3 * first:.0f} ms | {whole:.2f} s | {used:.2f} s | {1e3 * shading:.0f} ms | {points:,} "
            f"| {points / used:,.0f} | {held / 1e6:.0f} MB | {sent / 1e6:.1f} MB |"
        )


if __name__ == "__main__":
    main()
