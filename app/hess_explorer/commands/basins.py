"""`hess-explorer basins`: where the orbits of the Suslov problem from the cells of a section end."""

from __future__ import annotations

import argparse
import math
from typing import Any

from . import CommandError
from .arguments import integer, number, vector
from .bodies import add_suslov_body
from .output import add_options, computing, whether_body, write

__all__ = ["add"]

_MOST_CELLS = 100_000
_FEWEST, _MOST = 100, 10_000


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "basins", help="where the orbits from the cells of a section of the Suslov problem end",
        description="The section γ_k = 0, γ_k growing, of the Suslov problem with gravity at the energy E, ψ the "
                    "angle of γ in its plane and δ between 0 and π that of ω from the direction that keeps γ_k.  For "
                    "the orbit from the middle of each cell: the mean of ω1 over the last third of its crossings, and "
                    "the group of that mean: 0, 1, … where the means lie far apart, else all 0.  A group is an "
                    "attractor where the mean divergence on a motion of it is negative by three times its error.  "
                    "Empty or null where no motion has this energy, or the orbit stops crossing.",
        epilog="Example: hess-explorer basins --I 1.5,1,0.4,0 --b 0.3,-0.5,1 --E 0.68 --k 2 --cells 8,6 --crossings "
               "150 --accuracy draft --format csv")
    add_suslov_body(parser)
    parser.add_argument("--E", type=number, required=True, help="energy")
    parser.add_argument("--k", type=int, choices=(1, 2, 3), default=3, help="the section is γ_k = 0 (default 3)")
    parser.add_argument("--window", type=vector("psi0,psi1,delta0,delta1"), default=(-math.pi, math.pi, 0.0, math.pi),
                        metavar="psi0,psi1,delta0,delta1", help="angles in radians (default: the whole section)")
    parser.add_argument("--cells", type=vector("across,up"), default=(40.0, 30.0), metavar="across,up",
                        help="cells of the window (default 40,30)")
    parser.add_argument("--crossings", type=integer(_FEWEST, _MOST), default=300, metavar="N",
                        help="of each orbit (default 300)")
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    m, n = _cells(options.cells)
    psi0, psi1, delta0, delta1 = options.window
    with computing():
        import numpy as np

        from hess_mechanics import SuslovBody, basins, check_body

        found = basins(SuslovBody(*options.I, *options.b), options.E, plane=options.k, cells=(m, n),
                       window=((psi0, delta0), (psi1, delta1)), crossings=options.crossings,
                       accuracy=options.accuracy)
        check = check_body(*options.I)
    cells, on_each, known = found.group, found.divergence, found.group >= 0.0
    psi, delta = np.meshgrid(found.psi, found.delta)
    series: dict[str, list[Any]] = {"psi": psi.ravel().tolist(), "delta": delta.ravel().tolist()}
    for name, kind, column in (("mean", float, found.mean), ("group", int, cells)):
        series[name] = [kind(value) if there else None
                        for value, there in zip(column.ravel().tolist(), known.ravel().tolist(), strict=True)]
    counts = np.bincount(cells[known].astype(int), minlength=len(on_each)).tolist()
    write(options, series, tuple(series), {
        "cells": [m, n], "counts": counts, "level": found.level,
        "divergence": [one.mean for one in on_each], "divergence error": [one.error for one in on_each],
        "attractors": found.attractors, **whether_body(check)},
        _notes(options.I[2] == 0.0 == options.I[3], found.attractors))


def _notes(kept: bool, attractors: int) -> list[str]:
    if kept:
        return ["With I13 = I23 = 0 phase volume is kept: nothing attracts here."]
    return [] if attractors else ["On no group is the mean divergence negative beyond its error: no attractor is seen."]


def _cells(given: tuple[float, ...]) -> tuple[int, int]:
    m, n = given
    if not (m == int(m) >= 1 and n == int(n) >= 1 and m * n <= _MOST_CELLS):
        raise CommandError(f"Cells are two whole numbers, at most {_MOST_CELLS} together: write them like 40,30.")
    return int(m), int(n)
