"""`hess-explorer levels`: print the levels of accuracy."""

from __future__ import annotations

from .command import Command, Options
from .output import show


def _run(options: Options) -> None:
    from hess_mechanics.numerics.accuracy import levels_table

    show("".join(f"{' | '.join(row)}\n" for row in levels_table()).encode())


COMMAND = Command("Print what each level of accuracy promises and computes, for each kind of computation.", (), _run)
