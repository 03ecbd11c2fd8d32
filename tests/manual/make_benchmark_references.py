"""Make tests/manual/integrators/references.npz: `python tests/manual/make_benchmark_references.py` (an hour).

The oracle computes everything twice, with other digits and so with other orders and steps; both must agree to 1e-30.
"""

import decimal
import sys
from decimal import Decimal
from functools import reduce
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np

import oracle
from hess_mechanics import systems
from manual.integrators.works import BODY, DENSE, END, LONG_END, REFERENCES

SUSLOV = systems()["suslov"]
SAMPLES = 200
SCAN = 16  # sub-points of a step at which the sign of γ3 is looked at
RUNS = 42, 51
# The orbit up to t = 2000 is unstable, and takes many steps.
LONG_RUNS = 70, 84


def value(c, s):
    """Σ c[k] s^k."""
    return reduce(lambda total, one: total * s + one, reversed(c))


def steps(state, until, digits):
    """Yield (t, length of the step, series of each variable) in decimals of the current context."""
    y, p = (oracle.as_decimals(list(some))[:, None] for some in (state, BODY))
    t, order = Decimal(0), round(1.15 * digits)
    while t < until:
        c = oracle.coefficients(SUSLOV.field, y, p, order)[:, :, 0]
        # The last two terms come out below the last digit.
        longest = min((Decimal(10) ** -digits / abs(c[:, k]).max()) ** (1 / Decimal(k)) for k in (order - 1, order))
        step = min(longest, until - t)
        yield t, step, c
        y = np.array([[value(row, step)] for row in c])
        t += step


def long_orbit(state, times, digits):
    """Return the states at increasing times, and those at which γ3 grows through 0 until the last of them."""
    states, crossings, left = [], [], [Decimal(float(t)) for t in times]
    with decimal.localcontext(prec=digits):
        for t, step, c in steps(state, left[-1], digits):
            while left and left[0] <= t + step:
                s = left.pop(0) - t
                states.append([value(row, s) for row in c])
            places = [step * i / SCAN for i in range(SCAN + 1)]
            heights = [value(c[4], s) for s in places]
            slope = [k * one for k, one in enumerate(c[4])][1:]
            for i in range(SCAN):
                if heights[i] < 0 <= heights[i + 1]:
                    s = (places[i] + places[i + 1]) / 2
                    for _ in range(12):
                        s -= value(c[4], s) / value(slope, s)
                    if not places[i] <= s <= places[i + 1]:
                        raise ArithmeticError("Newton's method left the interval of a crossing.")
                    crossings.append([*(value(row, s) for row in c[:4]), Decimal(0)])
    return np.array(states), np.array(crossings)


def ends(initial, digits):
    """Return the end states of B2."""
    found = [oracle.orbit_in_decimals(SUSLOV, start.tolist(), BODY, END.tolist(), digits)[0] for start in initial]
    return np.array(found)


def initial_states():
    """Return the initial states of A (A2, D) and B2, which are stored: sines and roots differ between machines."""
    gamma = np.array([0.3, 0.2, 0.93])
    # B2: normal ω, γ uniform on the sphere.
    random = np.random.default_rng(1)
    omega, sphere = random.standard_normal((512, 2)), random.standard_normal((512, 3))
    return {
        "A_initial": np.array([[0.8, -0.4, *gamma / np.linalg.norm(gamma)]]),
        "B2_initial": np.hstack([omega, sphere / np.linalg.norm(sphere, axis=1, keepdims=True)]),
    }


def compute(initial, rows, digits, long):
    """Return all results, with these digits."""
    states, crossings = long_orbit(initial["A_initial"][0], [*DENSE[rows], *LONG_END], long)
    return {
        "A": states[:-1],
        "A2": states[-1:],
        "D": crossings,
        "B2": ends(initial["B2_initial"], digits),
    }


def main():
    """Compute everything twice, compare, store."""
    initial = initial_states()
    inside = np.random.default_rng(0).choice(DENSE.size - 1, SAMPLES - 1, replace=False)
    rows = np.sort(np.append(inside, DENSE.size - 1))
    first, second = (compute(initial, rows, *digits) for digits in zip(RUNS, LONG_RUNS, strict=True))
    for name, one in first.items():
        if one.shape != second[name].shape or np.abs(one - second[name]).max() > 1e-30:
            raise ArithmeticError(f"The two computations of {name} differ.")
    found = {name: one.astype(float) for name, one in first.items()}
    np.savez_compressed(REFERENCES, A_rows=rows.astype(np.int16), **initial, **found)
    print(f"{REFERENCES}: {REFERENCES.stat().st_size} bytes, {len(found['D'])} crossings")


if __name__ == "__main__":
    main()
