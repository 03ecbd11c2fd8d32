"""Cascades, hysteresis, attractors and repellers of the Suslov problem, found by looking.

`python tests/benchmarks/search_regimes.py diagrams|sets --count 300 --seed 1` draws random bodies and a
parameter, and prints what it sees: of a cascade the doublings that Newton's method then locates, of two sets how far
apart they are.  The presets of the scene "Orbit diagram" were found so.  What it prints is seen, not proved.
"""

from __future__ import annotations

import argparse
import math
import time

import numpy as np

from hess_mechanics import ModelError, SuslovBody, level
from hess_mechanics.dynamics.orbit_diagram import cascade, hysteresis, orbit_diagram
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.dynamics.regime import dynamics_of
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.suslov.section import SuslovSection

NAMES = ("I11", "I22", "I13", "I23", "E")


def drawn(draw: np.random.Generator) -> ReturnMap:
    """The section γ3 = 0 of a random body at a random energy."""
    p = np.round([*draw.uniform(0.5, 3.0, 2), *draw.uniform(-1.0, 1.0, 2), *draw.uniform(-2.0, 2.0, 3)], 1).tolist()
    above = round(float(draw.uniform(0.5, 6.0)), 1)
    return ReturnMap(SuslovSection(SuslovBody(*p), round(above - math.hypot(*p[4:]), 3), 3), level("draft"))


def start_of(map_: ReturnMap, draw: np.random.Generator) -> np.ndarray:
    """A random place where motions cross."""
    for _ in range(100):
        place = np.array([draw.uniform(-math.pi, math.pi), draw.uniform(0.2, 2.9)])
        if map_.sheet.states_at(*place[:, None])[1][0]:
            return place
    raise OutsideRegion("No motion of this energy reaches the section.")


def looked_at(map_: ReturnMap, name: str, draw: np.random.Generator) -> None:
    """Follow an orbit along a parameter there and back; print doublings and hysteresis."""
    here, exact = map_.sheet.constants[name], ReturnMap(map_.sheet, level("precise"))
    values = here + np.linspace(-0.5, 0.5, 61)
    start = start_of(map_, draw)
    there = orbit_diagram(lambda v: map_.moved(name, v), name, values, start, 300, 64)
    periods = there.periods.tolist()
    seen = [k for k in range(len(values) - 1) if periods[k] and periods[k + 1] == 2 * periods[k]] + [
        -k for k in range(1, len(values)) if periods[k] and periods[k - 1] == 2 * periods[k]]
    chaos = sum(not p and len(one) > 0 for p, one in zip(periods, there.places, strict=True))
    for signed in seen:
        step, k = (1, signed) if signed > 0 else (-1, -signed)
        beyond = periods[k::step]
        if 4 * periods[k] not in beyond:
            continue
        try:
            orbit = find_periodic(exact.moved(name, values[k]), there.places[k][-periods[k]:], periods[k])
            found = cascade(lambda v: exact.moved(name, v), name, orbit, values[k], values[k] + 0.3 * step, 5)
        except ModelError as error:
            print("   ", error)
            continue
        print("CASCADE", name, map_.sheet.constants, "from", values[k], there.ends[k], found.periods, found.values,
              found.errors, "ratios", found.ratios, found.ended, flush=True)
    back = orbit_diagram(lambda v: map_.moved(name, v), name, values[::-1], there.ends[-1], 300, 64)
    both = hysteresis(map_.turns, there, back)
    wide = [one for one in both if one[1] - one[0] > 0.05]
    if wide:
        print("HYSTERESIS", name, map_.sheet.constants, start, wide, "periods", periods, back.periods[::-1].tolist(),
              "chaotic values", chaos, flush=True)


def main() -> None:
    """Search and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("diagrams", "sets"))
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=600.0)
    options = parser.parse_args()
    draw = np.random.default_rng(options.seed)
    begun = time.monotonic()
    for _ in range(options.count):
        if time.monotonic() - begun > options.seconds:
            break
        map_ = drawn(draw)
        try:
            if options.what == "sets":
                place = start_of(map_, draw)
                found = dynamics_of(map_, place, 500, 2000)
                print(found.verdict, found.apart, f"{found.divergence:.4f} ± {found.divergence_error:.4f}",
                      map_.sheet.constants, place, flush=True)
            else:
                looked_at(map_, str(draw.choice(NAMES)), draw)
        except ModelError as error:
            print("   ", error, flush=True)


if __name__ == "__main__":
    main()
