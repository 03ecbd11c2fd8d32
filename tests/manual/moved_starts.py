"""Run the tests of chaotic motions with moved starts, on several code paths, and print which of them fail.

    python tests/manual/moved_starts.py  (ten moved starts on each code path of this processor)
    python tests/manual/moved_starts.py --paths host generic --seeds 3 4 -- tests/scenes

A code path is a processor for which the kernels are compiled, by the name that LLVM has for it.
"""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from llvmlite.binding import get_host_cpu_features

from support.measured import table

ROOT = Path(__file__).resolve().parents[2]
HASWELL = {"avx2", "fma", "bmi", "bmi2", "lzcnt", "movbe"}
NEEDED = {
    "host": set(),
    "generic": set(),
    "haswell": HASWELL,
    "skylake-avx512": HASWELL | {"adx", "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"},
    "znver3": HASWELL | {"adx", "sha", "vaes", "vpclmulqdq"},
}
"""Instructions that the compiled code of each path may contain, beyond those of every processor."""


def run(path, seed, options):
    """Return the summary of pytest, and the names of the tests that failed."""
    environment = {**os.environ, **({} if path == "host" else {"NUMBA_CPU_NAME": path})}
    command = [sys.executable, "-m", "pytest", "-m", "chaotic", "--moved-start", str(seed), "--tb=short", *options]
    ended = subprocess.run(command, cwd=ROOT, env=environment, text=True, stdout=subprocess.PIPE, check=False)
    failed = re.findall(r"^(?:FAILED|ERROR) (\S+)", ended.stdout, re.MULTILINE)
    summary = ended.stdout.rstrip().rpartition("\n")[2]
    if ended.returncode:
        print(ended.stdout, file=sys.stderr)
    return summary, failed or ([f"pytest ended with {ended.returncode}"] if ended.returncode else [])


def main():
    """Print a table of the runs, and one of the tests that failed.  Exits with 1 if any failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--paths", nargs="+", choices=NEEDED, default=list(NEEDED))
    parser.add_argument("--seeds", nargs="+", type=int, default=range(1, 11))
    parser.add_argument("options", nargs="*", help="for pytest, after --")
    given = parser.parse_args()
    features = {name for name, there in get_host_cpu_features().items() if there}
    failures = {}
    print(table(["code path", "moved start", "result"], []))
    for path in given.paths:
        missing = NEEDED[path] - features
        if missing:
            print(f"| {path} | – | not run: this processor has no {', '.join(sorted(missing))} |")
            continue
        for seed in given.seeds:
            summary, failed = run(path, seed, given.options)
            print(f"| {path} | {seed} | {summary} |", flush=True)
            for name in failed:
                failures.setdefault(name, []).append(f"{path} {seed}")
    print()
    print(table(["test", "failed"], [[name, ", ".join(where)] for name, where in failures.items()]))
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
