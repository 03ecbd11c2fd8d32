"""Write "tests/scenes/presets.json" again: `python tests/manual/make_presets.py` (some minutes).

Every preset is computed four times: as it is, with its starts moved by a few ulps, and both with code for any
processor.  The record has what these runs agree about, and the oracle's values where it has them; it is not written if
the pictures differ from those.
"""

import json
import os
import subprocess
import sys
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

RUNS = [("", ""), ("1", ""), ("", "generic"), ("2", "generic")]
"""Moved start, and the processor for which the kernels are compiled."""
DIGITS = 45


def run():
    """Return the records of all presets, in this process."""
    return {
        scene.name: {preset.name: golden.record(golden.view_of(scene, preset)) for preset in scene.presets}
        for scene in golden.OWN
    }


def started(seed, processor):
    """Start a run in a process of its own, whose cache has no other starts."""
    environment = {**os.environ, **({"NUMBA_CPU_NAME": processor} if processor else {})}
    command = [sys.executable, __file__, f"--moved-start={seed}"]
    return subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True).stdout


def from_the_oracle(view):
    """Return what `golden.known_to_the_oracle` has, by the oracle."""
    found, state = {}, view.result
    motion, known = state.motion(), golden.known_to_the_oracle(view)
    if "turned" in known:
        times = golden.moments(float(view.data["data-orbit"]["t"][-1])) / motion.unit
        states = oracle.orbits_in_long_double(
            motion.system, *([list(map(repr, map(float, one)))] for one in (motion.state, motion.parameters, times))
        )[0]
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


def main():
    """Compute all runs, and write what they agree about."""
    runs = [json.loads(started(*one)) for one in RUNS]
    presets = golden.settled(runs)
    for scene in golden.OWN:
        for preset in scene.presets:
            known = presets[scene.name][preset.name]["oracle"]
            for name, values in from_the_oracle(golden.view_of(scene, preset)).items():
                if known.get(name) is not None:
                    wrong = [*golden.differences(values, known[name], f"{scene.name}, {preset.name}: {name}")]
                    if wrong:
                        sys.exit("\n".join(wrong))
                    known[name] = values
    golden.PRESETS.write_text(golden.as_text(presets), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        seed = sys.argv[1].partition("=")[2]
        with moved_starts(int(seed)) if seed else nullcontext():
            json.dump(run(), sys.stdout)
    else:
        main()
