"""Proofs of random tori against 40-digit maps: `python tests/manual/random_proofs.py 10000 --seed 1`.

The tori have decimals of three to six digits; |a| ≤ 3, h up to 50, f over the whole region and close to 0.  Prints what
is decided, the longest proof, and every contradiction, of which there may be none.  About 0.2 s of a core for each.
"""

import argparse
import random
import sys
import time
from collections import Counter
from fractions import Fraction
from pathlib import Path

import mpmath

sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_mechanics import f_max, prove  # noqa: E402
from oracle.circle_maps import maps_by_three_orbits  # noqa: E402

TOGETHER = 50


def torus(rng):
    a, h = rng.uniform(-1, 1) * rng.choice([1, 3]), rng.uniform(-0.95, rng.choice([3, 50]))
    f = rng.uniform(-1, 1) * f_max(h) * rng.choice([1, 1, 0.05])
    return (f"{a:.3f}", f"{h:.3f}", f"{f:.6f}") if abs(f) > 1e-3 else torus(rng)


if __name__ == "__main__":
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("count", type=int)
    words.add_argument("--seed", type=int, default=1)
    options = words.parse_args()
    rng, found, longest, wrong = random.Random(options.seed), Counter(), 0.0, 0
    for begin in range(0, options.count, TOGETHER):
        tori = [torus(rng) for _ in range(min(TOGETHER, options.count - begin))]
        for one, known in zip(tori, maps_by_three_orbits(tori, 45), strict=True):
            start = time.process_time()
            proof = prove(*one)
            longest = max(longest, time.process_time() - start)
            with mpmath.workdps(60):
                held = Fraction(mpmath.nstr(abs(2 * mpmath.re(known.A)), 50))
            slack = Fraction(1, 10**17) * max(1, held)
            inside = proof.trace.low - slack <= held <= proof.trace.high + slack
            right = proof.statement in ("undecided", "two cycles" if held > 2 else "no cycle")
            found[proof.statement] += 1
            if not (inside and right):
                wrong += 1
                print("contradicted:", one, proof.statement, float(held), flush=True)
        print(f"{sum(found.values())}: {dict(found)}, contradicted {wrong}, longest proof {longest:.2f} s", flush=True)
    sys.exit(wrong > 0)
