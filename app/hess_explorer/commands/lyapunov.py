"""`hess-explorer lyapunov suslov|ball|euler-poisson`: the largest Lyapunov exponent of a motion, or its spectrum."""

from __future__ import annotations

from functools import partial

import numpy as np

from hess_mechanics import level, lyapunov_exponent, lyapunov_spectrum
from hess_mechanics.dynamics.system import Body
from hess_mechanics.parameters import TIME

from .command import OUTPUT, Command, Options, flag, number
from .motions import MOTIONS, start_of
from .output import Answer, quality, table

__all__ = ["COMMAND"]

_SHOWN = 100
"""Number of running averages in the output, evenly spread over time."""


def _computed(name: str, options: Options) -> Answer:
    body, _ = MOTIONS[name].given(options)
    start, notes = start_of(options)
    if options.spectrum:
        return _spectrum(options, body, start, notes)
    found = lyapunov_exponent(body, start, options.t)
    kept = np.unique(np.linspace(0, found.times.size - 1, _SHOWN).astype(int))
    return Answer(
        {"t": found.times[kept].tolist(), "average": found.rates[kept].tolist()},
        {"exponent": found.value, "spread": found.spread, "no_chaos": found.no_chaos},
        notes,
    )


def _spectrum(options: Options, body: Body, state: tuple[float, ...], notes: list[str]) -> Answer:
    found = lyapunov_spectrum(body, state, options.t, level(options.accuracy))
    dimension, error = found.dimension
    forced = (
        "Volume is conserved, and all but two exponents belong to integrals and the flow: they must form pairs."
        if found.pairs_forced
        else "No known invariant measure forces the exponents to form pairs."
    )
    columns = [f"average {i + 1}" for i in range(found.values.size)]
    return Answer(
        {"t": found.times.tolist(), **dict(zip(columns, found.rates.T.tolist(), strict=True))},
        {
            "exponents": found.values.tolist(),
            "errors": found.errors.tolist(),
            "signs": list(found.signs),
            "sum": float(found.values.sum()),
            "divergence": found.divergence,
            "divergence_error": found.divergence_error,
            "dimension": dimension,
            "dimension_error": error,
            "paired": found.paired,
            "pairs_forced": found.pairs_forced,
            **quality(found),
        },
        [*notes, forced],
    )


COMMAND = Command(
    systems={
        name: Command(
            f"Compute the largest Lyapunov exponent of an orbit of {MOTIONS[name].title} and its running averages, "
            "per unit of time.",
            (
                *MOTIONS[name].options,
                number(TIME, help="averaging time; negative: backward in time"),
                flag(
                    "--spectrum",
                    "compute all exponents from the variational equations, with errors, the mean divergence and the "
                    "Kaplan–Yorke dimension",
                ),
                *OUTPUT,
            ),
            table(partial(_computed, name)),
            f"{MOTIONS[name].example} --t 200",
            MOTIONS[name].title,
        )
        for name in ("suslov", "ball", "euler-poisson")
    }
)
