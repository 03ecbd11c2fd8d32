"""`hess-explorer bench`: speed beside other integrators, measured by the scripts in tests/benchmarks."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

from . import CommandError
from .command import Command

__all__ = ["COMMAND"]

_TESTS = Path(__file__).resolve().parents[3] / "tests"


class _OfTheSources(Command):
    """The command that stands in tests/benchmarks/bench.py."""

    def declare(self, parser: argparse.ArgumentParser) -> None:
        """Declare its options.  Raises `CommandError` without the sources."""
        if not (_TESTS / "benchmarks" / "bench.py").is_file():
            raise CommandError(
                "The benchmark is not part of the package: in the folder of the sources, pip install -e "
                "'.[bench]' and run the command again."
            )
        if str(_TESTS) not in sys.path:
            sys.path.append(str(_TESTS))
        import_module("benchmarks.bench").COMMAND.declare(parser)


COMMAND = _OfTheSources()
