"""`hess-explorer bench`: compare the speed with other integrators, with the scripts in tests/benchmarks."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

from . import CommandError
from .command import Command, Parser

__all__ = ["COMMAND"]

_TESTS = Path(__file__).resolve().parents[3] / "tests"


class _SourceCommand(Command):
    """The command defined in tests/benchmarks/bench.py, which only a source checkout has."""

    def parser(self, prog: str) -> Parser:
        """Return the parser of its arguments.  Raises `CommandError` without the sources."""
        if not (_TESTS / "benchmarks" / "bench.py").is_file():
            raise CommandError(
                "The benchmark measures with scripts of the source tree, which an installed package does not contain: "
                "in a source checkout, run pip install -e '.[bench]', then hess-explorer bench."
            )
        if str(_TESTS) not in sys.path:
            sys.path.append(str(_TESTS))
        command: Command = import_module("benchmarks.bench").COMMAND
        return command.parser(prog)


COMMAND = _SourceCommand("", (), lambda _: None)
