"""Compare with other integrators at equal error: `python tests/manual/bench.py [--works A D] [--write]`."""

import argparse
import os
import sys
from importlib import import_module
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]
    # NumPy's libraries read this when they are first imported.
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", MKL_NUM_THREADS="1")

from manual.integrators import explorer
from manual.integrators.measure import report
from manual.integrators.works import works
from manual.timing import conditions
from support.measured import write_measured

PEERS = {"heyoka": "heyoka_peer", "SciPy": "scipy_peer"}
README = Path(__file__).with_name("integrators") / "README.md"


def participants():
    """Return this project's method and those of the installed peers."""
    methods = [explorer.METHOD]
    for name, module in PEERS.items():
        try:
            methods.append(import_module(f"manual.integrators.{module}").METHOD)
        except ImportError as error:
            print(f"{name} is left out: {error}", file=sys.stderr)
    return methods


def main(words=None):
    """Measure for some minutes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--works", nargs="+", choices=works(), default=list(works()))
    parser.add_argument("--targets", nargs="+", type=float, default=[1e-3, 1e-6, 1e-9, 1e-12], help="largest errors")
    parser.add_argument("--write", action="store_true", help="keep the table in integrators/README.md")
    options = parser.parse_args(words)
    methods = participants()
    versions = ", ".join(f"{method.name} {method.version}" for method in methods)
    text = (
        f"{conditions()}, {versions}.\n\n{report([works()[name] for name in options.works], methods, options.targets)}"
    )
    print(text)
    if options.write:
        write_measured(README, text)


if __name__ == "__main__":
    main()
