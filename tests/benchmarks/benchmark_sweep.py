"""`python tests/benchmarks/benchmark_sweep.py`: what a sweep costs beside a bare loop, on two cores, and on a thousand.

It rewrites the table of app/hess_explorer/sweep/README.md; `--quick` prints a trial.
"""

import math
import os
import pickle
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np
from distributed import Client

from hess_explorer.benchmark.machine import describe
from hess_explorer.sweep import QUANTITIES, sweep, work, workers
from hess_explorer.sweep.grid import Grid
from hess_explorer.sweep.result import Store
from hess_mechanics import level, systems
from hess_mechanics.dynamics.lyapunov import largest_exponent
from hess_mechanics.numerics.accuracy import PLANS, Kind
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.measured import write_measured

README = Path(__file__).resolve().parents[2] / "app" / "hess_explorer" / "sweep" / "README.md"
QUICK = "--quick" in sys.argv
REPEATS = 2
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
            rows = np.meshgrid(h[first:first + 50], f, indexing="ij")
            found[first:first + 50] = values_at(0.5, *(x.ravel() for x in rows), level("precise")).rho.reshape(-1, side)
        return found

    return "rotation-number", over, {"a": 0.5}, "precise", by_hand


def motions(side):
    """λ of side × side motions, and the loop by hand: one by one."""
    over = {"w1": (0.2, 1.4, side), "I22": (1.0, 2.0, side)}
    suslov, exact = systems()["suslov"], PLANS[Kind.EXPONENT]["draft"].level
    state, p = suslov.example

    def by_hand():
        places = [np.linspace(*places).tolist() for places in over.values()]
        return np.array([[largest_exponent(suslov, (w1, *state[1:]), (p[0], I22, *p[2:]), TIME, exact).value
                          for I22 in places[1]] for w1 in places[0]])

    return "lyapunov-suslov", over, {"t": TIME}, "draft", by_hand


@contextmanager
def folder():
    """For a store, gone afterwards."""
    with tempfile.TemporaryDirectory() as place:
        yield Path(place) / "sweep.zarr"


def raced(functions, clock):
    """The least seconds of each, by this clock, in turn."""
    best = [math.inf] * len(functions)
    for _ in range(REPEATS):
        for i, function in enumerate(functions):
            begun = clock()
            function()
            best[i] = min(best[i], clock() - begun)
    return best


def tell(text):
    """What is measured now."""
    print(f"{time.strftime('%X')} {text} …", file=sys.stderr, flush=True)


def beside_a_loop(case):
    """Seconds of the processor: by hand, in memory, in a store."""
    name, over, fixed, accuracy, by_hand = case
    tell(f"{name} beside a loop")
    found = sweep(name, over, level=accuracy, **fixed)[name.replace("-", "_")].values
    assert np.array_equal(found, by_hand(), equal_nan=True)

    def stored():
        with folder() as place:
            sweep(name, over, level=accuracy, store=place, **fixed)

    return raced([by_hand, lambda: sweep(name, over, level=accuracy, **fixed), stored], time.process_time)


def on_two(case, address):
    """Seconds by the clock: the loop by hand; into a store, a sweep of one thread, and one on the cluster.

    And of the processor, that the last one takes in all processes together: the clock says little where others use the
    machine.
    """
    name, over, fixed, accuracy, by_hand = case
    tell(f"{name} on two workers")

    def swept(who):
        with folder() as place:
            sweep(name, over, level=accuracy, store=place, workers=who, **fixed)

    def spent():
        with Client(address, set_as_default=False) as client:
            return time.process_time() + sum(client.run(time.process_time).values())

    swept(address)
    together = math.inf
    for _ in range(REPEATS):
        before = spent()
        swept(address)
        together = min(together, spent() - before)
    return *raced([by_hand, lambda: swept(None), lambda: swept(address)], time.perf_counter), together


def rates(address):
    """Pieces a second without work, and MB a second of results, into memory and into a store."""
    numbers = 250_000

    # Sent to the workers as they are: no module of theirs has them.
    def nothing(piece):
        shape = tuple(part.size for part in piece.axes.values())
        return work.Done(np.zeros(shape), np.zeros(shape), np.ones(shape, np.uint8))

    def noise(piece):
        shape = tuple(part.size for part in piece.axes.values())
        random = np.random.default_rng(0)
        return work.Done(random.random(shape), random.random(shape), np.ones(shape, np.uint8))

    what = QUANTITIES["rotation-number"]

    def timed(compute, pieces, side, keep):
        tell(f"{pieces} pieces of {side} cells")
        grid = Grid.of(what, {"h": (0.2, 2.0, pieces), "f": np.linspace(0.01, 1.0, side)}, {"a": 0.5}, 10**10)
        boxes = list(grid.boxes((1, side)))
        work_ = ((box, work.Piece(what.name, "draft", work.version(), grid.pieces(box), grid.fixed)) for box in boxes)
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
    empty, _ = timed(nothing, count, 1, keep=False)
    kept, looked = timed(nothing, count, 1, keep=True)
    memory, _ = timed(noise, large, numbers, keep=False)
    stored, _ = timed(noise, large, numbers, keep=True)
    size = numbers * 17 / 1e6
    return {"pieces": 1.0 / empty, "kept": 1.0 / kept, "looked": 1.0 / looked, "memory": size / memory,
            "stored": size / stored}


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
    return (f"| {what.symbol} | {cost * 1e6:.3g} µs | {work_ / 3600:.3g} core hours | {pieces} of {piece:.3g} s "
            f"| {bytes_ / 1e9:.3g} GB | {span(times['work'])} | {span(times['pieces'])} | {span(times['bytes'])} "
            f"| {slowest} |")


def span(seconds):
    """As people say it."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


def main():
    """Measure for some minutes."""
    cases = [tori(250 if QUICK else 1400), motions(8 if QUICK else 70)]
    load = os.getloadavg()[0]
    single = [beside_a_loop(case) for case in cases]
    begun = time.perf_counter()
    with workers.local_cluster(2) as address:
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=120)
        start = time.perf_counter() - begun
        pairs = [on_two(case, address) for case in cases]
        found = rates(address)
    facts = describe()
    lines = [f"{facts['date']}, {facts['processor']}, {facts['cores']} cores, Python {facts['python']}; load before: "
             f"{load:.1f}.", "", "| what | measured | asked |", "|---|---|---|"]
    costs = []
    for case, (hand, memory, store), (alone, one, two, together) in zip(cases, single, pairs, strict=True):
        what = QUANTITIES[case[0]]
        cells = math.prod(places[2] for places in case[1].values())
        costs.append((case[0], hand / cells))
        lines += [
            f"| {what.symbol} of {cells} cells by hand: seconds of the processor, for a cell | {hand:.2f} s, "
            f"{1e6 * hand / cells:.3g} µs | |",
            f"| – `sweep` beside it: in memory, in a store | {100 * (memory / hand - 1):+.1f} %, "
            f"{100 * (store / hand - 1):+.1f} % | ≤ 5 % |",
            f"| – by the clock: by hand, one thread, two workers that run already | {alone:.2f} s, {one:.2f} s, "
            f"{two:.2f} s | |",
            f"| – two workers beside one thread, beside the loop by hand | {one / two:.2f} ×, {alone / two:.2f} × "
            "| ≥ 1.8 × |",
            f"| – of the processor, both workers, scheduler and client: so on two idle cores at most "
            f"| {together:.2f} s, {2 * hand / together:.2f} × | ≥ 1.8 × |"]
    grid = Grid.of(QUANTITIES["rotation-number"], cases[0][1], {"a": 0.5}, 10**10)
    piece = work.Piece("rotation-number", "precise", work.version(), grid.pieces(((0, 500), (0, 500))), grid.fixed)
    lines += [
        f"| two workers of this machine: until they are there | {start:.1f} s | |",
        f"| a piece of 500 × 500 cells: sent, returned | {len(pickle.dumps(piece)) / 1e3:.1f} kB, "
        f"{250_000 * 17 / 1e6:.2f} MB | |",
        f"| pieces without work through scheduler and client, and into a store | {found['pieces']:.0f}, "
        f"{found['kept']:.0f} a second | |",
        f"| results through the client, into a store | {found['memory']:.0f}, {found['stored']:.0f} MB a second | |",
        f"| pieces of a store looked through before it goes on | {found['looked']:.0f} a second | |",
        "", f"On paper, from these: {' × '.join(map(str, CHART))} cells on {CORES} cores.", "",
        "| what | a cell | work | pieces | kept | work ÷ 1000 | scheduler and client | one writer | slowest |",
        "|---|---|---|---|---|---|---|---|---|", *(on_paper(name, cost, found) for name, cost in costs)]
    text = "\n".join(lines)
    print(text)
    if not QUICK:
        write_measured(README, text)


if __name__ == "__main__":
    main()
