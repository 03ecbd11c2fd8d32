"""`hess-explorer rotation-number`: the rotation number of Suslov–Hess tori over their parameters."""

from __future__ import annotations

import numpy as np

from hess_mechanics import level
from hess_mechanics.parameters import A_HESS, F_HESS, H_PLANE
from hess_mechanics.suslov_hess.rotation_number import MAX_POINTS, values_at

from . import CommandError
from .command import OUTPUT, Command, Options, samples
from .output import Answer, table

__all__ = ["COMMAND"]


def _computed(options: Options) -> Answer:
    accuracy = level(options.accuracy)
    count = len(options.a) * len(options.h) * len(options.f)
    if count > MAX_POINTS:
        raise CommandError(f"The values give {count} tori, but at most {MAX_POINTS} are allowed: choose fewer values.")
    a, h, f = (axis.ravel() for axis in np.meshgrid(options.a, options.h, options.f, indexing="ij"))
    found = values_at(a, h, f, accuracy)
    possible = found.possible.tolist()
    values = {"rotation_number": found.rho, "trace": np.minimum(found.trace, 1e308), "locked": found.locked}
    return Answer(
        {
            "a": a.tolist(),
            "h": h.tolist(),
            "f": f.tolist(),
            **{
                name: [value if there else None for value, there in zip(column.tolist(), possible, strict=True)]
                for name, column in values.items()
            },
            "possible": possible,
        },
        {"level": accuracy.name},
    )


COMMAND = Command(
    "Compute the rotation number ρ (turns per return) and |trace| of the circle map for every combination of values of "
    "a, h and f, in units b = 1.  locked: true if the torus has two limit cycles; possible: true if the torus "
    "exists, otherwise the other three values are null (empty in CSV).",
    (
        samples(A_HESS, "inertia parameter a = I23/I22"),
        samples(H_PLANE, "energy, h > -1"),
        samples(F_HESS, "area integral"),
        *OUTPUT,
    ),
    table(_computed),
    "--a 0.5 --h -0.9:2:30 --f 0.6 --format csv",
)
