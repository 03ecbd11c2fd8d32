"""Write "tests/scenes/presets.json" again: `python tests/manual/make_presets.py` (some minutes).

Every preset is computed five times: as it is, with its starts moved by a few ulps, and both with code for any
processor.  The record has what these runs agree about, and the oracle's values where it has them; it is not written if
the pictures differ from those.
"""

import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from contextlib import nullcontext
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]
    # As the tests have it.
    os.environ["HESS_EXPLORER_POINTS"] = "2e4"

import numpy as np

import oracle
from support import golden
from support.moved import moved_starts

RUNS = [(0, ""), (1, ""), (2, ""), (0, "generic"), (3, "generic")]
"""Moved start, 0 for none, and the processor for which the kernels are compiled."""
DIGITS = 45
SEEN = {"sphere", "circle", "curve"}
"""Pictures of orbits, circle maps and scattering."""


def run():
    """Return the records of all examples by scene, in this process."""
    found = defaultdict(dict)
    for scene, preset in golden.EXAMPLES:
        found[scene.name][preset.name] = golden.record(golden.view_of(scene, preset))
    return found


def started(seed, processor):
    """Return the records of a run in a process of its own, whose cache has no other starts."""
    environment = {**os.environ, **({"NUMBA_CPU_NAME": processor} if processor else {})}
    command = [sys.executable, __file__, "--moved-start", str(seed)]
    return json.loads(subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True).stdout)


def from_the_oracle(view):
    """Return what `golden.known_to_the_oracle` has, by the oracle."""
    found, state, known = {}, view.result, golden.known_to_the_oracle(view)
    if "turned" in known:
        motion = state.motion()
        times = golden.moments(float(view.data["data-orbit"]["t"][-1])) / motion.unit
        given = ([[repr(float(one)) for one in numbers]] for numbers in (motion.start, motion.parameters, times))
        states = oracle.orbits_in_long_double(motion.system, *given)[0]
        found["turned"] = golden.cosines(states[:, -3:].astype(float))
    if "trace" in known:
        map_ = state.map
        closed = map_.f == 0.0 and oracle.map_of_vanishing_f(map_.a, map_.h)
        exact = closed or oracle.map_by_three_orbits(map_.a, map_.h, map_.f, DIGITS)
        found["trace"] = golden.counted([np.exp(exact.log_trace)], 1)
    if "cos χ" in known:
        body = state.body
        found["cos χ"] = golden.counted([oracle.cos_chi(body.I11, body.I22, body.I13, body.I23)], 1)
    return found


def with_the_oracle(presets):
    """Put the oracle's values into the records; exit if one is not within a pixel of what is drawn."""
    for scene, preset in golden.EXAMPLES:
        known = presets[scene.name][preset.name]["oracle"]
        for name, values in from_the_oracle(golden.view_of(scene, preset, SEEN & set(scene.pictures))).items():
            # A chaotic motion has none.
            if known.get(name) is not None and None not in known[name]:
                if wrong := [*golden.differences(values, known[name], f"{scene.name}, {preset.name}: {name}")]:
                    sys.exit("\n".join(wrong))
                known[name] = values
    return presets


def main():
    """Write what all runs agree about, or print one run as JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--moved-start", type=int, metavar="SEED", help="only print one run; 0 moves nothing")
    seed = parser.parse_args().moved_start
    if seed is None:
        presets = with_the_oracle(golden.settled([started(*one) for one in RUNS]))
        golden.PRESETS.write_text(golden.as_text(presets), encoding="utf-8")
    else:
        with moved_starts(seed) if seed else nullcontext():
            json.dump(run(), sys.stdout)


if __name__ == "__main__":
    main()
