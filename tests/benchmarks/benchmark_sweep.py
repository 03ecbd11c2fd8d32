"""`python tests/benchmarks/benchmark_sweep.py`: what a sweep costs beside a bare loop, on two cores, and on a thousand.

It rewrites the table of app/hess_explorer/sweep/README.md; `--quick` prints a trial.
"""

import math
import os
import pickle
import statistics
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np
from distributed import Client

from benchmarks.integrators.machine import conditions
from hess_explorer.sweep import QUANTITIES, sweep, work, workers
from hess_explorer.sweep.grid import SweepGrid
from hess_explorer.sweep.store import Store
from hess_mechanics import level, systems
from hess_mechanics.dynamics.lyapunov import lyapunov_exponent
from hess_mechanics.numerics.accuracy import PLANS, Kind
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.cluster import local_cluster
from support.measured import write_measured

README = Path(__file__).resolve().parents[2] / "app" / "hess_explorer" / "sweep" / "README.md"
QUICK = "--quick" in sys.argv
ROUNDS = 1 if QUICK else 5
PAIRS = 1 if QUICK else 2
TIME = 200.0
CHART = (4000, 4000, 64)
CORES = 1000


def tori(side):
    """ρ over side × side tori, and the loop by hand: fifty rows at a time."""
    over = {"h": (0.2, 2.0, side), "f": (0.01, 1.0, side)}

    def by_hand():
        h, f = (np.linspace(*places) for places in over.values())
        found = np.empty((side, side))
        for first in range(0, side, 50):
            rows = np.meshgrid(h[first : first + 50], f, indexing="ij")
            found[first : first + 50] = values_at(0.5, *(x.ravel() for x in rows), level("precise")).rho.reshape(
                -1, side
            )
        return found

    return "rotation-number", over, {"a": 0.5}, "precise", by_hand


def motions(side):
    """λ of side × side motions, and the loop by hand: one by one."""
    over = {"w1": (0.2, 1.4, side), "I22": (1.0, 2.0, side)}
    suslov, exact = systems()["suslov"], PLANS[Kind.EXPONENT]["draft"].level
    state, p = suslov.example

    def by_hand():
        places = [np.linspace(*places).tolist() for places in over.values()]
        return np.array(
            [
                [
                    lyapunov_exponent(suslov.at((p[0], I22, *p[2:])), (w1, *state[1:]), TIME, exact).value
                    for I22 in places[1]
                ]
                for w1 in places[0]
            ]
        )

    return "lyapunov-suslov", over, {"t": TIME}, "draft", by_hand


@contextmanager
def folder():
    """Yield a temporary folder for a store."""
    with tempfile.TemporaryDirectory() as place:
        yield Path(place) / "sweep.zarr"


def timed(function, clock):
    """Return the elapsed seconds by this clock."""
    begun = clock()
    function()
    return clock() - begun


def together():
    """Return the CPU seconds of this process and of its finished children."""
    own = os.times()
    return own.user + own.system + own.children_user + own.children_system


def tell(text):
    """Print the current step to stderr."""
    print(f"{time.strftime('%X')} {text} …", file=sys.stderr, flush=True)


def beside_a_loop(case):
    """Seconds of the processor by hand, the least; in memory and in a store as shares of the same round, medians.

    A processor that others use too is slower at times: what is compared is computed one right after the other.
    """
    name, over, fixed, accuracy, by_hand = case
    tell(f"{name} beside a loop")
    found = sweep(name, over, level=accuracy, **fixed)[name.replace("-", "_")].values
    assert np.array_equal(found, by_hand(), equal_nan=True)

    def stored():
        with folder() as place:
            sweep(name, over, level=accuracy, store=place, **fixed)

    rounds = [
        [
            timed(one, time.process_time)
            for one in (by_hand, lambda: sweep(name, over, level=accuracy, **fixed), by_hand, stored)
        ]
        for _ in range(ROUNDS)
    ]
    return (
        min(min(first, second) for first, _, second, _ in rounds),
        statistics.median(memory / first for first, memory, _, _ in rounds),
        statistics.median(store / second for _, _, second, store in rounds),
    )


def on_two(case, address):
    """Seconds by the clock, into a store: one thread, two processes with their start, two workers of a cluster.

    The last: of the processor, that the two processes and this one take together.
    """
    name, over, fixed, accuracy, _ = case
    tell(f"{name} on two workers")

    def swept(who):
        with folder() as place:
            sweep(name, over, level=accuracy, store=place, workers=who, **fixed)

    swept(address)
    rounds = []
    for _ in range(PAIRS):
        alone = timed(lambda: swept(None), time.perf_counter)
        spent = together()
        two = timed(lambda: swept(2), time.perf_counter)
        spent = together() - spent
        rounds.append((alone, two, timed(lambda: swept(address), time.perf_counter), spent))
    return [min(column) for column in zip(*rounds, strict=True)]


def pieces_of_processes():
    """Seconds until two processes are there, and pieces without work through them, a second."""
    tell("processes")
    grid = SweepGrid.of(QUANTITIES["rotation-number"], {"h": (0.5, 1.5, 2000)}, {"a": 0.5, "f": 0.1}, 10**6)
    pieces = [
        (box, work.Chunk("rotation-number", "draft", work.version(), grid.pieces(box), grid.fixed))
        for box in grid.boxes((1,))
    ]
    begun = time.perf_counter()
    with workers.crew(2, lambda: False) as hands:
        run = hands.run(iter(pieces), lambda: False)
        for _ in range(4):
            next(run)
        there = time.perf_counter()
        assert sum(1 for _ in run) == len(pieces) - 4
        return there - begun, (len(pieces) - 4) / (time.perf_counter() - there)


def rates(address):
    """Pieces a second without work, and MB a second of results, into memory and into a store."""
    numbers = 250_000

    # Sent to the workers as they are: no module of theirs has them.
    def nothing(piece):
        shape = tuple(part.size for part in piece.axes.values())
        return work.ChunkResult(np.zeros(shape), (), np.ones(shape, np.uint8))

    def noise(piece):
        shape = tuple(part.size for part in piece.axes.values())
        random = np.random.default_rng(0)
        return work.ChunkResult(random.random(shape), (), np.ones(shape, np.uint8))

    what = QUANTITIES["rotation-number"]

    def passed(compute, pieces, side, keep):
        tell(f"{pieces} pieces of {side} cells")
        grid = SweepGrid.of(what, {"h": (0.2, 2.0, pieces), "f": np.linspace(0.01, 1.0, side)}, {"a": 0.5}, 10**10)
        boxes = list(grid.boxes((1, side)))
        work_ = ((box, work.Chunk(what.name, "draft", work.version(), grid.pieces(box), grid.fixed)) for box in boxes)
        before = workers.compute, workers._COUNT_AGAIN
        workers.compute, workers._COUNT_AGAIN = compute, math.inf
        try:
            with folder() as place, workers.crew(address, lambda: False) as hands:
                # As many pieces on the way as so many workers have.
                hands.size = CORES
                store = Store.create(place, what, grid, "draft", (1, side)) if keep else None
                begun = time.perf_counter()
                for box, done in hands.run(work_, lambda: False):
                    if store is not None:
                        store.write(box, done)
                seconds = time.perf_counter() - begun
                looked = time.perf_counter()
                if store is not None:
                    assert all(store.has(box) for box in boxes)
                return seconds / pieces, (time.perf_counter() - looked) / pieces
        finally:
            workers.compute, workers._COUNT_AGAIN = before

    count, large = (600, 20) if QUICK else (1500, 50)
    empty, _ = passed(nothing, count, 1, keep=False)
    kept, looked = passed(nothing, count, 1, keep=True)
    memory, _ = passed(noise, large, numbers, keep=False)
    stored, _ = passed(noise, large, numbers, keep=True)
    size = numbers * 9 / 1e6
    return {
        "pieces": 1.0 / empty,
        "kept": 1.0 / kept,
        "looked": 1.0 / looked,
        "memory": size / memory,
        "stored": size / stored,
    }


def on_paper(name, cost, found):
    """A row of the table: a chart of `CHART` cells on `CORES` cores, from what was measured on two."""
    from hess_explorer.sweep.run import seconds_of_a_piece

    what = QUANTITIES[name]
    cells = math.prod(CHART)
    bytes_ = cells * (9 + (8 if what.error else 0))
    work_ = cost * cells
    piece = min(seconds_of_a_piece(work_, CORES), cost * 1_000_000)
    pieces = math.ceil(work_ / piece)
    times = {"work": work_ / CORES, "pieces": pieces / found["kept"], "bytes": bytes_ / 1e6 / found["stored"]}
    slowest = max(times, key=times.get)
    return (
        f"| {what.symbol} | {cost * 1e6:.3g} µs | {work_ / 3600:.3g} core hours | {pieces} of {piece:.3g} s "
        f"| {bytes_ / 1e9:.3g} GB | {span(times['work'])} | {span(times['pieces'])} | {span(times['bytes'])} "
        f"| {slowest} |"
    )


def span(seconds):
    """Format a duration for people."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


def main():
    """Measure for some minutes."""
    cases = [tori(250 if QUICK else 1000), motions(8 if QUICK else 40)]
    long = [tori(400 if QUICK else 3000), motions(16 if QUICK else 120)]
    load = os.getloadavg()[0]
    single = [beside_a_loop(case) for case in cases]
    there, through = pieces_of_processes()
    with local_cluster(2) as address:
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=120)
        pairs = [on_two(case, address) for case in long]
        found = rates(address)
    lines = [
        f"{conditions()}; load before: {load:.1f}.",
        "",
        "| what | measured | asked |",
        "|---|---|---|",
    ]
    costs = []
    for case, larger, (hand, memory, store), (one, two, dask, spent) in zip(cases, long, single, pairs, strict=True):
        what = QUANTITIES[case[0]]
        cells, many = (math.prod(places[2] for places in each[1].values()) for each in (case, larger))
        costs.append((case[0], hand / cells))
        lines += [
            f"| {what.symbol} of {cells} cells by hand: seconds of the processor, for a cell | {hand:.2f} s, "
            f"{1e6 * hand / cells:.3g} µs | |",
            f"| – `sweep` beside it: in memory, in a store | {100 * (memory - 1):+.1f} %, {100 * (store - 1):+.1f} % "
            "| ≤ 5 % |",
            f"| – {many} cells into a store, by the clock: one thread, two processes with their start, two workers of "
            f"a cluster that run already | {one:.2f} s, {two:.2f} s, {dask:.2f} s | |",
            f"| – two processes, two workers beside one thread | {one / two:.2f} ×, {one / dask:.2f} × | ≥ 1.8 × |",
            f"| – of the processor, both processes and this one | {spent:.2f} s | |",
        ]
    grid = SweepGrid.of(QUANTITIES["rotation-number"], cases[0][1], {"a": 0.5}, 10**10)
    piece = work.Chunk("rotation-number", "precise", work.version(), grid.pieces(((0, 500), (0, 500))), grid.fixed)
    lines += [
        f"| two processes: until they have computed the first pieces | {there:.1f} s | |",
        f"| pieces of one cell through them | {through:.0f} a second | |",
        f"| a piece of 500 × 500 cells: sent, returned | {len(pickle.dumps(piece)) / 1e3:.1f} kB, "
        f"{250_000 * 9 / 1e6:.2f} MB | |",
        f"| pieces without work through scheduler and client of a cluster, and into a store | {found['pieces']:.0f}, "
        f"{found['kept']:.0f} a second | |",
        f"| results through the client, into a store | {found['memory']:.0f}, {found['stored']:.0f} MB a second | |",
        f"| pieces of a store looked through before it goes on | {found['looked']:.0f} a second | |",
        "",
        f"On paper, from these: {' × '.join(map(str, CHART))} cells on {CORES} cores.",
        "",
        "| what | a cell | work | pieces | kept | work ÷ 1000 | scheduler and client | one writer | slowest |",
        "|---|---|---|---|---|---|---|---|---|",
        *(on_paper(name, cost, found) for name, cost in costs),
    ]
    text = "\n".join(lines)
    print(text)
    if not QUICK:
        write_measured(README, text)


if __name__ == "__main__":
    main()
