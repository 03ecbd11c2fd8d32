"""`hess-explorer orbit-diagram SYSTEM`: the attractors of a section over a parameter."""

from __future__ import annotations

from typing import Any

from hess_mechanics import Cascade, Diagram, ModelError, ReturnMap, orbit_diagram, period_doublings, periodic_orbit
from hess_mechanics.dynamics.orbit_diagram import COMPARED, doubling_seen, hysteresis

from .arguments import assigned, values
from .command import Options, flag, option, whole
from .output import Answer
from .sections import command_of_sections

__all__ = ["COMMAND"]


def _computed(section: ReturnMap, options: Options) -> Answer:
    name, over = options.over

    def followed(of: ReturnMap, values: list[float], at: Any) -> Diagram:
        return orbit_diagram(
            of, name, values, at, transient=options.transient, kept=options.crossings, follow=not options.anew
        )

    there = followed(section, over, options.at)
    ways = {"there": there}
    if options.back:
        known = [end.tolist() for end, some in zip(there.ends, there.places, strict=True) if len(some)]
        ways["back"] = followed(section, over[::-1], options.at if options.anew or not known else known[-1])
    if options.backward:
        ways["backward"] = followed(section.inverse(), over, options.at)
    other = hysteresis(section.turns, there, ways["back"]) if options.back else ()
    located = _located(section, there, options.doublings) if options.doublings else None
    rows = [
        (way, value, int(period), bool(settled), *place)
        for way, one in ways.items()
        for value, period, settled, places in zip(
            one.values.tolist(), one.periods, one.settled, one.places, strict=True
        )
        for place in places.tolist()
    ]
    names = ("way", name, "period", "settled", *section.names)
    return Answer(
        {column: [row[i] for row in rows] for i, column in enumerate(names)},
        {
            "gaps": {
                way: [value for value, some in zip(one.values.tolist(), one.places, strict=True) if not len(some)]
                for way, one in ways.items()
            },
            **({"hysteresis": [list(one) for one in other]} if options.back else {}),
            **({} if located is None else _doublings(located)),
            "level": there.level,
        },
        _notes(options, there, located),
    )


def _located(section: ReturnMap, there: Diagram, most: int) -> Cascade | str | None:
    """Return the period doublings from the first visible one on, an error message, or None if none is visible."""
    seen = doubling_seen([there])
    if seen is None:
        return None
    value, places, end = seen
    at = section.moved(there.parameter, value)
    try:
        orbit = periodic_orbit(at, places[-1].tolist(), len(places))
        return period_doublings(at, orbit, there.parameter, end, most)
    except ModelError as error:
        return str(error)


def _doublings(found: Cascade | str) -> dict[str, Any]:
    if isinstance(found, str):
        return {}
    ratios = [[float(ratio), float(error)] for ratio, error in zip(found.ratios, found.ratio_errors, strict=True)]
    return {
        "doublings": [
            {"value": float(value), "error": float(error), "period": int(period), "place": places[0].tolist()}
            for value, error, period, places in zip(
                found.values, found.errors, found.periods, found.places, strict=True
            )
        ],
        "ratios": ratios,
        "limit": found.limit,
        "ended": found.ended,
    }


def _notes(options: Options, there: Diagram, located: Cascade | str | None) -> list[str]:
    notes = ["Volume is conserved: each value shows one orbit, not an attractor."] if there.conservative.all() else []
    if options.back and options.crossings < COMPARED:
        notes.append(f"Hysteresis is detected only with at least {COMPARED} crossings.")
    if options.doublings and located is None:
        notes.append("No period doubles between neighbouring values.")
    if isinstance(located, str):
        notes.append(f"A period doubling was seen but could not be located: {located}")
    return notes


COMMAND = command_of_sections(
    "Compute the orbit diagram of {section}.  The orbit starts from the point {place}; at each further value of the "
    "parameter it continues from its last point.  The output has its points after the transient, and their period, 0 "
    "if it exceeds 64 or does not exist.",
    "starting point of the orbit",
    (
        option(
            "--over",
            "the parameter and its values, in this order: a range, or a list NAME=1,2,3",
            type=assigned(values, "E=1:2:50"),
            required=True,
            metavar="NAME=LO:HI:N",
        ),
        whole("--transient", 0, 20_000, "number of crossings to skip at each value", 200),
        whole("--crossings", 1, 20_000, "number of crossings to show at each value", 64),
        flag("--anew", "restart from --at at each value"),
        flag("--back", "traverse the values backwards as well, and report hysteresis"),
        flag("--backward", "also integrate backward in time, to repellers"),
        whole("--doublings", 0, 6, "number of period doublings to locate by Newton's method", 0),
    ),
    {
        "suslov": "--at 1.5,1.2 --over I13=0:0.4:9 --crossings 24",
        "quartic": "--at 0.9,0.1 --over h=0.7:0.9:5",
        "ball": "--at 1.5,1.2 --over I13=0.1:0.3:5 --crossings 24",
        "euler-poisson": "--at 0,0.2 --over h=1.4:1.6:3",
        "hess": "--at 1 --over a=0.3:0.7:9 --back --backward --format csv",
    },
    _computed,
)
