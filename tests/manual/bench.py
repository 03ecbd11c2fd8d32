"""Time for a given error, beside heyoka and SciPy: `python tests/manual/bench.py` rewrites integrators/README.md.

Each method solves a work at settings from coarse to fine; the cheapest one that keeps the error is timed in turn with
those of the other methods.  `--references` computes the stored results again, in decimals (an hour).
"""

import argparse
import math
import os
import sys
import time
from dataclasses import dataclass
from functools import cache, partial
from importlib import metadata
from itertools import takewhile
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]
    # NumPy's libraries read this when they are first imported.
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", MKL_NUM_THREADS="1")

import numba
import numpy as np
from scipy.integrate import solve_ivp

import oracle
from hess_mechanics import systems
from manual.timing import in_turn, report

SUSLOV = systems()["suslov"]
BODY = (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0)
"""I11, I22, I13, I23, b1, b2, b3."""
FOLDER = Path(__file__).with_name("integrators")
TARGETS = 1e-3, 1e-6, 1e-9, 1e-12
SLOW, BUDGET = 3.0, 20.0
"""Seconds: a slower run ends its ladder; all settings of a method in a work take no longer."""
MOST_STEPS, MOST_CROSSINGS = 1_000_000, 1000


@dataclass(frozen=True, eq=False)
class Work:
    """Motions from initial states (n, 5), at these times or until the last one; their exact results in some rows."""

    name: str
    initial: np.ndarray
    times: np.ndarray
    exact: np.ndarray
    rows: object = ...

    def error(self, found):
        """Return the largest error; ∞ for a result of another shape."""
        same = found[self.rows].shape == self.exact.shape
        off = np.abs(found[self.rows] - self.exact) if same else np.array(math.inf)
        return float(np.nan_to_num(off, nan=math.inf).max())


@cache
def works():
    """Return the works by name, with the stored results."""
    with np.load(FOLDER / "references.npz") as file:
        stored = dict(file)
    start = stored["A_initial"]
    found = (
        Work("A", start, np.linspace(0.0, 200.0, 4000), stored["A"], stored["A_rows"]),
        Work("B", stored["B_initial"], np.array([60.0]), stored["B"]),
        Work("D", start, np.array([2000.0]), stored["D"]),
    )
    return {work.name: work for work in found}


# ---- methods: ladders of (setting, run), from coarse to fine ------------------------------------------------------


def half_decades(coarsest, finest):
    return [float(f"{10 ** (-k / 2):.1e}") for k in range(2 * coarsest, 2 * finest + 1)]


def explorer(work):
    """Yield the Taylor series of this project, a ladder for each order."""
    p, start, states = np.array(BODY), work.initial[0], np.empty((MOST_CROSSINGS, 5))
    orbit, ends = np.empty((work.times.size, 5)), np.empty((len(work.initial), 1, 5))
    steps, times = np.empty(len(ends), np.int64), np.empty(max(len(ends), MOST_CROSSINGS))

    def run(order, tolerance):
        limits = order, tolerance, math.inf, MOST_STEPS
        if work.name == "A":
            if SUSLOV.orbit(start, p, work.times, *limits, orbit)[0] < 0:
                orbit.fill(math.nan)
            return orbit
        if work.name == "B":
            SUSLOV.ensemble(work.initial, p, work.times, *limits, ends, steps, times[: len(ends)])
            ends[steps < 0] = math.nan
            return ends[:, 0]
        found, _ = SUSLOV.crossing(start, p, np.eye(5)[4], 0.0, 1, work.times[0], *limits, times, states)
        return states[: max(found, 0)]

    for order in range(8, 25, 2):
        yield [(f"{order}, {tolerance:.0e}", partial(run, order, tolerance)) for tolerance in half_decades(2, 17)]


def heyoka(work):
    """Yield heyoka's Taylor series: adaptive, in batches for an ensemble, with its events for crossings."""
    import heyoka as peer

    variables = peer.make_vars("w1", "w2", "g1", "g2", "g3")
    # Numbers instead of parameters: factors 0 and 1 fall out.
    equations = list(zip(variables, SUSLOV.field(variables, BODY), strict=True))
    found = []

    def passed(integrator, at, _):
        integrator.update_d_output(at)
        found.append(integrator.d_output.copy())

    def made(**options):
        if work.name == "D":
            options["nt_events"] = [peer.nt_event(variables[4], passed, direction=peer.event_direction.positive)]
        return peer.taylor_adaptive(equations, work.initial[0], **options)

    def single(integrator):
        found.clear()
        integrator.time, integrator.state[:] = 0.0, work.initial[0]
        if work.name == "A":
            return integrator.propagate_grid(work.times)[-1]
        integrator.propagate_until(work.times[0])
        return np.array(found)

    def ensemble(integrator, lanes):
        for first in range(0, len(work.initial), lanes):
            integrator.set_time(0.0)
            integrator.state[:] = work.initial[first : first + lanes].T
            integrator.propagate_until(work.times[0])
            found.append(integrator.state.T.copy())
        states = np.concatenate(found)
        found.clear()
        return states

    for accurate in (False, True):
        ladder = half_decades(15, 18) if accurate else half_decades(2, 18)
        options = [{"tol": tolerance, "high_accuracy": accurate} for tolerance in ladder]
        if work.name == "B":
            # Twice the recommended width is often faster still.
            for lanes in (peer.recommended_simd_size(), 2 * peer.recommended_simd_size()):
                block = work.initial[:lanes].T.copy()
                batches = (peer.taylor_adaptive_batch(equations, block, **one) for one in options)
                yield [("", partial(ensemble, batch, lanes)) for batch in batches]
        else:
            yield [("", partial(single, made(**one))) for one in options]


def scipy(work):
    """Yield solve_ivp with a right-hand side compiled by Numba; an ensemble is one large system."""
    rates = numba.njit(error_model="numpy", fastmath={"contract"})(SUSLOV.field)

    @numba.njit
    def right_hand_side(t, y):
        dy = np.empty_like(y)
        for i in range(0, y.size, 5):
            dy[i : i + 5] = np.array(rates((y[i], y[i + 1], y[i + 2], y[i + 3], y[i + 4]), BODY))
        return dy

    def height(t, y):
        return float(y[4])

    height.direction = 1.0
    start, span = work.initial.ravel(), (0.0, work.times[-1])

    def run(name, tolerance):
        both = {"rtol": tolerance, "atol": tolerance}
        if work.name == "D":
            return solve_ivp(right_hand_side, span, start, name, events=height, **both).y_events[0]
        return solve_ivp(right_hand_side, span, start, name, work.times, **both).y.T.reshape(-1, 5)

    for name in ("DOP853", "LSODA"):
        # solve_ivp takes no relative tolerance below 2.2e-14.
        yield [("", partial(run, name, 10.0**-k)) for k in range(3, 14)]


METHODS = {"hess-explorer": explorer, "heyoka": heyoka, "scipy": scipy}

# ---- measuring ------------------------------------------------------------------------------------------------------


def climb(work, ladder):
    """Yield (seconds, error, setting, run) of each setting, until a run is slow."""
    for setting, run in ladder:
        result, seconds = run(), []
        for _ in range(2):
            begun = time.perf_counter()
            run()
            seconds.append(time.perf_counter() - begun)
        yield min(seconds), work.error(result), setting, run
        if min(seconds) > SLOW:
            return


def samples(work, method):
    """Return the samples of all ladders, for as long as there is time."""
    ends = time.monotonic() + BUDGET
    ladders = takewhile(lambda _: time.monotonic() < ends, method(work))
    return [sample for ladder in ladders for sample in climb(work, ladder)]


def rows(work, methods, targets=TARGETS):
    """Yield the rows of the table: milliseconds for each target, and their ratio to this project's."""
    found = [samples(work, method) for method in methods]
    for target in targets:
        good = [[sample for sample in own if sample[1] <= target] for own in found]
        best = [min(own, key=lambda sample: sample[0], default=None) for own in good]
        seconds = iter(in_turn([sample[3] for sample in best if sample]))
        times = [1e3 * next(seconds) if sample else math.nan for sample in best]
        cells = [f"{ms:.3g} ({ms / times[0]:.2g} ×)" if sample else "–" for ms, sample in zip(times, best, strict=True)]
        if best[0]:
            cells[0] = f"{times[0]:.3g} ({best[0][1]:.1e}; {best[0][2]})"
        yield [work.name, f"{target:.0e}", *cells]


def installed():
    """Return the methods whose packages are installed, by name."""
    found = {}
    for name, method in METHODS.items():
        try:
            found[f"{name} {metadata.version(name)}"] = method
        except metadata.PackageNotFoundError as error:
            print(f"{name} is left out: {error}", file=sys.stderr)
    return found


# ---- exact results --------------------------------------------------------------------------------------------------


def exact(work, digits, rows=...):
    """Return the results of a work in decimals, all or these rows."""
    if work.name == "B":
        starts = work.initial[rows].tolist()
        return np.array([oracle.orbit_in_decimals(SUSLOV, one, BODY, work.times.tolist(), digits)[0] for one in starts])
    times = work.times[work.rows][rows]
    if work.name == "D":
        times, states = np.empty(MOST_CROSSINGS), np.empty((MOST_CROSSINGS, 5))
        limits = 20, 1e-16, math.inf, MOST_STEPS
        count, _ = SUSLOV.crossing(
            work.initial[0], np.array(BODY), np.eye(5)[4], 0.0, 1, 2000.0, *limits, times, states
        )
        times = times[:count][rows]
    found = oracle.orbit_in_decimals(SUSLOV, work.initial[0].tolist(), BODY, times.tolist(), digits)
    if work.name == "D":
        # A double is off by so little that what is left after one step of Newton's method is below its last digit.
        slopes = np.array([SUSLOV.field(one.tolist(), oracle.as_decimals(BODY).tolist()) for one in found])
        found = found - slopes * (found[:, 4:] / slopes[:, 4:])
    return found


def compute_references():
    """Compute all results twice, with other digits and so other orders and steps, compare and store them."""
    with np.load(FOLDER / "references.npz") as file:
        stored = dict(file)
    for work in works().values():
        # Up to t = 2000 the motion is unstable, and loses digits.
        first, second = (exact(work, digits) for digits in ((70, 84) if work.name == "D" else (42, 51)))
        if np.abs(first - second).max() > 1e-30:
            raise ArithmeticError(f"The two computations of {work.name} differ.")
        stored[work.name] = first.astype(float)
    np.savez_compressed(FOLDER / "references.npz", **stored)


def main():
    """Measure for some minutes."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--references", action="store_true", help="only compute the stored results again")
    if parser.parse_args().references:
        compute_references()
        return
    methods = installed()
    found = [row for work in works().values() for row in rows(work, methods.values())]
    report(["work", "error", *methods], found, FOLDER / "README.md")


if __name__ == "__main__":
    main()
