"""Error estimates held against proofs: `python tests/benchmarks/error_estimates_proved.py 200 --seed 1`.

Random motions of all systems; each is computed at every level, and enclosed by its tube, whose width is far below any
error of doubles.  Prints how often an estimate was below what the error certainly is, of which there may be none, and
how far estimates are above it.
"""

import argparse
import random
import sys
import time
from collections import defaultdict

import numpy as np

from hess_mechanics import LEVELS, level, proved_error, solve, systems, tube

MOST_WORK = 4e6


def motion(rng, system):
    """The example of a system with each number changed by up to 30 %, and a time of 1 to 5."""
    state, parameters = ([x * rng.uniform(0.7, 1.3) for x in numbers] for numbers in system.example)
    size = np.linalg.norm(state[-3:])
    return [*state[:-3], *(float(x / size) for x in state[-3:])], parameters, rng.uniform(1, 5) * rng.choice([1, -1])


if __name__ == "__main__":
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("count", type=int)
    words.add_argument("--seed", type=int, default=1)
    options = words.parse_args()
    rng, known = random.Random(options.seed), [*systems().values()]
    ratios, below, short, begun = defaultdict(list), 0, 0, time.process_time()
    for i in range(options.count):
        system = known[i % len(known)]
        state, parameters, end = motion(rng, system)
        times = np.linspace(0.0, end, 9)
        found = tube(system.at(parameters), state, times, most_work=MOST_WORK)
        short += not found.complete
        for name in LEVELS:
            orbit = solve(system.at(parameters), state, found.times, level(name))
            low, _ = proved_error(orbit, found)
            ratios[name].append(orbit.error_estimate / max(low, 1e-17))
            if orbit.error_estimate < low:
                below += 1
                print("below:", system.name, name, state, parameters, end, orbit.error_estimate, low, flush=True)
        if (i + 1) % 10 == 0 or i + 1 == options.count:
            said = "; ".join(
                f"{name} {np.median(some):.2f} times (from {min(some):.2f} to {max(some):.1f})"
                for name, some in ratios.items()
            )
            print(
                f"{i + 1} motions, {short} not to their end, {time.process_time() - begun:.0f} s; estimates below "
                f"the proved error: {below}; above it by, median: {said}",
                flush=True,
            )
    sys.exit(below > 0)
