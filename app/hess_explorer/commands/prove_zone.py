"""`hess-explorer prove-zone`: prove for cells of (h, f) that their tori have two limit cycles, or none."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from typing import Any

from hess_mechanics import LockZone, lock_zone
from hess_mechanics.numerics.balls import flint
from hess_mechanics.parameters import H_PLANE
from hess_mechanics.suslov_hess.lock_zone import refined, region_area

from .arguments import number as any_number
from .command import OUT, Command, Options, number, option, whole
from .output import text

__all__ = ["COMMAND"]

_ROUND = 100
"""Number of proofs between two checks of the decided fraction of the area."""
_MEANS = (
    "alpha = (1 - n1^2)/(n1 + n2)^2, beta = (1 - n2^2)/(n1 + n2)^2 with the turning points n1 <= n2 of n3; "
    "h = (alpha + beta - 1) s/2, f = sqrt(2 alpha beta) s^(3/2), s = 2/sqrt((1 + alpha + beta)^2 - 4 alpha beta)"
    "; a statement covers the tori of a cell with alpha > beta or exchanged; alpha = beta is the edge, without a torus"
)


def _computed(options: Options) -> str:
    zone = lock_zone(options.a, options.h_end, 0)
    begun, progress = time.perf_counter(), []
    while zone.tried < options.cells and zone.decided < options.share:
        before = zone.tried
        zone = refined(zone, min(_ROUND, options.cells - zone.tried))
        if zone.tried == before:
            break
        progress.append(
            {"cells": zone.tried, "seconds": round(time.perf_counter() - begun, 2), "decided": round(zone.decided, 6)}
        )
    return "\n".join(_FORMATS[options.format](zone, progress))


def _words(zone: LockZone, progress: list[dict[str, Any]]) -> Iterator[str]:
    area = region_area(zone.h_end)
    shares = {statement: 100.0 * part / area for statement, part in zone.areas.items()}
    yield f"Proved for a = {float(zone.a):g}, as fractions of the area of possible (h, f) up to h = {zone.h_end:g}:"
    yield f"exactly two limit cycles on {shares['two cycles']:.2f} %, none on {shares['no cycle']:.2f} %;"
    yield f"undecided: {shares['undecided']:.2f} %, along the boundary."
    for row in progress:
        yield f"after {row['cells']} proofs, {row['seconds']:.1f} s: {100.0 * row['decided']:.2f} % decided"
    yield (
        "The proofs hold for the equations with exactly this a, provided that the ball arithmetic of Arb is correct; "
        "areas are computed without proof."
    )


def _json(zone: LockZone, progress: list[dict[str, Any]]) -> Iterator[str]:
    library = flint()
    cells = [{"alpha": list(cell.alpha), "beta": list(cell.beta), "statement": cell.statement} for cell in zone.cells]
    yield json.dumps(
        {
            "format": "Suslov–Hess lock zone, 1",
            "a": str(zone.a),
            "h_end": zone.h_end,
            "means": _MEANS,
            "decided": zone.decided,
            "areas": zone.areas,
            "progress": progress,
            "cells": cells,
            "versions": {"python-flint": library.__version__, "flint": library.__FLINT_VERSION__},
        },
        ensure_ascii=False,
        allow_nan=False,
    )


def _csv(zone: LockZone, progress: list[dict[str, Any]]) -> Iterator[str]:
    yield "alpha_low,alpha_high,beta_low,beta_high,statement"
    for cell in zone.cells:
        yield ",".join([*(repr(x) for x in (*cell.alpha, *cell.beta)), cell.statement])


_FORMATS = {"text": _words, "json": _json, "csv": _csv}

COMMAND = Command(
    "Prove by ball arithmetic for cells of the bifurcation diagram (h, f), units b = 1, f > 0, that every torus of a "
    "cell has exactly two limit cycles, or none.  The largest undecided cell is split first, so that the undecided "
    "cells approach the boundary.  A cell is a rectangle in coordinates α, β of a torus (the JSON output defines "
    "them), whose ends are exact doubles.  If a cell touches the edge |f| = f_max(h), its statement covers only its "
    "tori; there are none on the edge.  Areas are computed without proof.  Requires: pip install "
    "'hess-explorer[prove]'.",
    (
        option(
            "--a", "inertia parameter a = I23/I22, |a| ≤ 3; exact: 0.1, -2e-3 or 1/3", required=True, metavar="NUMBER"
        ),
        number(H_PLANE, 4.0, name="--h-end", help="largest energy h"),
        whole("--cells", 1, 100_000, "maximum number of proofs, about 15 ms each", 400),
        option(
            "--share",
            "stop when this fraction of the area is decided; checked after every 100 proofs",
            type=any_number,
            default=1.0,
            metavar="S",
        ),
        option(
            "--format",
            "text (default): fractions of the area; json: all cells and the progress; csv: all cells",
            choices=tuple(_FORMATS),
            default="text",
        ),
        OUT,
    ),
    text(_computed),
    "--a 0.5 --cells 50 --format json",
)
