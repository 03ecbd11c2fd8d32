"""Strange attractors of the Suslov problem, found by looking: `python tests/benchmarks/search_strange_attractors.py`.

Random bodies and starts; kept is where the largest exponent is positive and the mean divergence negative, beyond their
errors, over a short and then over a ten times longer time.  What it prints is seen, not proved.
"""

from __future__ import annotations

import argparse

import numpy as np

from hess_mechanics import level, lyapunov_spectrum, systems


def main() -> None:
    """Search and print state, parameters, exponents, errors and the dimension."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1500)
    parser.add_argument("--seed", type=int, default=3)
    options = parser.parse_args()
    suslov, draw = systems()["suslov"], np.random.default_rng(options.seed)
    for _ in range(options.count):
        p = np.round([*draw.uniform(0.5, 4.0, 2), *draw.uniform(-1.2, 1.2, 2), *draw.uniform(-3.0, 3.0, 3)], 1).tolist()
        state = (*np.round(draw.uniform(-3.0, 3.0, 2), 1).tolist(), 0.6, 0.0, 0.8)
        found = lyapunov_spectrum(suslov.at(p), state, 400.0, level("draft"))
        if found.values[0] > 0.03 and found.divergence < -5.0 * found.divergence_error - 0.02:
            found = lyapunov_spectrum(suslov.at(p), state, 4000.0)
            if found.signs[0] == "+" and found.divergence < -3.0 * found.divergence_error:
                print(state, p, found.values.round(4), found.errors.round(4), "D =", found.dimension, flush=True)


if __name__ == "__main__":
    main()
