"""`hess-explorer basins`: basins of attraction in a section of the Suslov problem."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hess_mechanics import basins
from hess_mechanics.parameters import E

from . import CommandError
from .command import OUTPUT, Command, Options, number, option, vector, whole
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
        crossings=options.crossings,
        accuracy=options.accuracy,
    )
    on_each, known = found.divergence, found.group >= 0.0
    psi, delta = np.meshgrid(found.psi, found.delta)
    series: dict[str, list[Any]] = {"psi": psi.ravel().tolist(), "delta": delta.ravel().tolist()}
    for name, kind, column in (("mean", float, found.mean), ("group", int, found.group)):
        series[name] = [
            kind(value) if there else None
            for value, there in zip(column.ravel().tolist(), known.ravel().tolist(), strict=True)
        ]
    counts = np.bincount(found.group[known].astype(int), minlength=len(on_each)).tolist()
    return Answer(
        series,
        {
            "cells": [m, n],
            "counts": counts,
            "level": found.level,
            "divergence": [one.mean for one in on_each],
            "divergence error": [one.error for one in on_each],
            "attractors": found.attractors,
            **body_facts(check_of(body)),
        },
        _notes(body.I13 == 0.0 == body.I23, found.attractors),
    )


def _notes(kept: bool, attractors: int) -> list[str]:
    if kept:
        return ["With I13 = I23 = 0 phase volume is conserved: there are no attractors."]
    return [] if attractors else ["No attractor: the mean divergence of no group is negative beyond its error."]


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
    "leaves γ_k constant.  For the orbit from the centre of each cell the output has the mean of ω1 over the last "
    "third of its crossings, and the group of that mean: 0, 1, … if the means form separate clusters, else 0.  A group "
    "is an attractor if the mean divergence on one of its motions is negative by three times its error.  A value is "
    "empty or null if no motion has this energy, or if the orbit stops crossing.",
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
        whole("--crossings", 100, 10_000, "number of crossings of each orbit", 300),
        *OUTPUT,
    ),
    table(_computed),
    "--I 1.5,1,0.4,0 --b 0.3,-0.5,1 --E 0.68 --k 2 --cells 8,6 --crossings 150 --accuracy draft --format csv",
)
