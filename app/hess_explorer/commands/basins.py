"""`hess-explorer basins`: basins of attraction in a section of the Suslov problem."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hess_mechanics import basins
from hess_mechanics.parameters import E

from . import CommandError
from .command import OUTPUT, Command, Options, number, option, vector
from .motions import SUSLOV, check_of, suslov_of
from .output import Answer, body_facts, table

__all__ = ["COMMAND"]

_MOST_CELLS = 100_000


def _computed(options: Options) -> Answer:
    m, n = _cells(options.cells)
    psi0, psi1, delta0, delta1 = options.window
    body = suslov_of(options)
    found = basins(
        body,
        options.E,
        plane=options.k,
        cells=(m, n),
        window=((psi0, delta0), (psi1, delta1)),
        accuracy=options.accuracy,
    )
    psi, delta = np.meshgrid(found.psi, found.delta)
    numbers = found.attractor.astype(int).ravel()
    reached = (numbers >= 0).tolist()
    series: dict[str, list[Any]] = {"psi": psi.ravel().tolist(), "delta": delta.ravel().tolist()}
    for name, values in (("attractor", numbers), ("crossings", found.crossings.ravel())):
        series[name] = [int(value) if there else None for value, there in zip(values.tolist(), reached, strict=True)]
    return Answer(
        series,
        {
            "cells": [m, n],
            "counts": [int(np.sum(numbers == one)) for one in range(found.attractors)],
            "level": found.level,
            "divergence": [one.mean for one in found.divergence],
            "divergence error": [one.error for one in found.divergence],
            "attractors": found.attractors,
            **body_facts(check_of(body)),
        },
        _notes(body.I13 == 0.0 == body.I23, found.attractors),
    )


def _notes(kept: bool, attractors: int) -> list[str]:
    if kept:
        return ["With I13 = I23 = 0 phase volume is conserved: there are no attractors."]
    return [] if attractors else ["No attractor: no mean divergence is negative beyond its error."]


def _cells(given: tuple[float, ...]) -> tuple[int, int]:
    m, n = given
    if not (m == int(m) >= 1 and n == int(n) >= 1 and m * n <= _MOST_CELLS):
        raise CommandError(
            f"--cells must be two whole numbers with a product of at most {_MOST_CELLS}: write them like 40,30."
        )
    return int(m), int(n)


COMMAND = Command(
    "Compute basins of attraction in the section γ_k = 0 (upward crossings) of the Suslov problem with gravity at the "
    "energy E.  Coordinates: ψ is the angle of γ in its plane, δ from 0 to π the angle of ω from the direction that "
    "leaves γ_k constant.  For the orbit from the centre of each cell the output has the attractor that it reaches, 0, "
    "1, …, and the number of crossings until then.  The sets that orbits approach are found from 256 orbits over the "
    "section.  A set is an attractor if the mean divergence on it is negative by three times its error.  A value is "
    "empty or null if no motion has this energy, or if no attractor is reached in 240 crossings.",
    (
        *SUSLOV,
        number(E, help="energy"),
        option("--k", "the section is γ_k = 0 (default 3)", type=int, choices=(1, 2, 3), default=3),
        vector(
            "--window",
            "psi0,psi1,delta0,delta1",
            "angles in radians (default: the whole section)",
            (-math.pi, math.pi, 0.0, math.pi),
        ),
        vector("--cells", "across,up", "number of cells in ψ and δ (default 40,30)", (40.0, 30.0)),
        *OUTPUT,
    ),
    table(_computed),
    "--I 1.5,1,0.4,0 --b 0.3,-0.5,1 --E 0.68 --k 2 --cells 8,6 --accuracy draft --format csv",
)
