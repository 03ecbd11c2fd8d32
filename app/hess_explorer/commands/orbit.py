"""`hess-explorer orbit suslov|ball|hess|euler-poisson`: states of one motion at given times."""

from __future__ import annotations

from functools import partial

from hess_mechanics import level, solve
from hess_mechanics.parameters import TIME

from .command import OUTPUT, Command, Options, samples
from .motions import LIMITS, MOTIONS, limits_of, start_of
from .output import Answer, body_facts, quality, table

__all__ = ["COMMAND", "TIMES"]

TIMES = samples(TIME, "times away from 0")


def _computed(name: str, options: Options) -> Answer:
    body, check = MOTIONS[name].given(options)
    start, notes = start_of(options)
    result = solve(body, start, options.t, level(options.accuracy), **limits_of(options))
    return Answer(
        {"t": result.times.tolist(), "y": result.states.tolist()},
        {"variables": list(body.system.variables), **quality(result), **body_facts(check)},
        notes,
        ("t", *body.system.variables),
    )


COMMAND = Command(
    systems={
        name: Command(
            f"Compute an orbit of {of.title}.",
            (*of.options, TIMES, *LIMITS, *OUTPUT),
            table(partial(_computed, name)),
            f"{of.example} --t 10,50",
            of.title,
        )
        for name, of in MOTIONS.items()
    }
)
