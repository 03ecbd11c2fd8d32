"""`hess-explorer bench`: speed beside other integrators, measured by the scripts in tests/benchmarks."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

from . import CommandError

__all__ = ["add"]

_TESTS = Path(__file__).resolve().parents[3] / "tests"


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser("bench", help="speed beside other integrators, at the same measured error")
    if not (_TESTS / "benchmarks" / "bench.py").is_file():
        parser.set_defaults(run=_refuse)
        return
    if str(_TESTS) not in sys.path:
        sys.path.append(str(_TESTS))
    import_module("benchmarks.bench").declare(parser)


def _refuse(options: argparse.Namespace) -> None:
    raise CommandError("The benchmark is not part of the package: in the folder of the sources, pip install -e "
                       "'.[bench]' and run the command again.")
