"""`hess-explorer levels`: what each level of accuracy means."""

from __future__ import annotations

from .command import Command, Options
from .output import show

__all__ = ["COMMAND"]


def _run(options: Options) -> None:
    from hess_mechanics.numerics.accuracy import levels_table

    (_, *names), *rows = levels_table()
    lines = []
    for kind, *cells in rows:
        lines += [kind, *(f"  {name:<10} {cell}" for name, cell in zip(names, cells, strict=True))]
    show("\n".join([*lines, ""]).encode())


COMMAND = Command("Print what each level of accuracy promises and computes, for each kind of computation.", (), _run)
