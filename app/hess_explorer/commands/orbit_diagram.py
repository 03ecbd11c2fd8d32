"""`hess-explorer orbit-diagram SYSTEM`: where an orbit of a section settles over a parameter."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from .arguments import integer, samples, shown, vector
from .output import add_options, computing, write
from .sections import add_systems

if TYPE_CHECKING:
    from hess_mechanics import Cascade, Diagram, ReturnMap

__all__ = ["add"]


def _axis(text: str) -> tuple[str, list[float]]:
    """The type of NAME=LO:HI:N."""
    name, is_there, values = text.partition("=")
    if not (name and is_there and values):
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a parameter and its values; write it like E=1:2:50")
    return name, samples(values)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    add_systems(
        commands.add_parser("orbit-diagram", help="where an orbit of a section settles over a parameter"),
        "Where the orbit of {section} from a place {place} settles at each value of a parameter, from where it was at "
        "the value before: its places, and the period with which they repeat, 0 where none up to 64 is seen.",
        {"suslov": "--at 1.5,1.2 --over I13=0:0.4:9 --crossings 24", "quartic": "--at 0.9,0.1 --over h=0.7:0.9:5",
         "ball": "--at 1.5,1.2 --over I13=0.1:0.3:5 --crossings 24", "euler-poisson": "--at 0,0.2 --over h=1.4:1.6:3",
         "hess": "--at 1 --over a=0.3:0.7:9 --back --backward --format csv"}, _add_rest, _run)


def _add_rest(parser: argparse.ArgumentParser, place: str) -> None:
    parser.add_argument("--at", type=vector(place), required=True, metavar=place, help="where the orbit starts")
    parser.add_argument("--over", type=_axis, required=True, metavar="NAME=LO:HI:N",
                        help="the parameter and its values, in this order; or a list, NAME=1,2,3")
    parser.add_argument("--transient", type=integer(0, 20_000), default=200, metavar="N",
                        help="crossings left out at each value (default 200)")
    parser.add_argument("--crossings", type=integer(1, 20_000), default=64, metavar="N",
                        help="crossings shown of each value (default 64)")
    parser.add_argument("--anew", action="store_true", help="start anew from --at at each value")
    parser.add_argument("--back", action="store_true",
                        help="go back over the values as well, and say where that is another way (hysteresis)")
    parser.add_argument("--backward", action="store_true", help="backward in time as well, to repellers")
    parser.add_argument("--doublings", type=integer(0, 6), default=0, metavar="N",
                        help="locate so many period doublings by Newton's method, from the first that is seen "
                             "(default 0)")
    add_options(parser)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import orbit_diagram
        from hess_mechanics.dynamics.orbit_diagram import hysteresis

        section: ReturnMap = options.prepare(options)
        name, values = options.over

        def followed(of: ReturnMap, values: list[float], at: Any) -> Diagram:
            return orbit_diagram(of, name, values, at, transient=options.transient, kept=options.crossings,
                                 follow=not options.anew)

        there = followed(section, values, options.at)
        ways = {"there": there}
        if options.back:
            known = [end.tolist() for end, some in zip(there.ends, there.places, strict=True) if len(some)]
            ways["back"] = followed(section, values[::-1], options.at if options.anew or not known else known[-1])
        if options.backward:
            ways["backward"] = followed(section.inverse(), values, options.at)
        other = hysteresis(section.turns, there, ways["back"]) if options.back else ()
        located = _located(section, there, options.doublings) if options.doublings else None
    rows = [(way, value, int(period), bool(settled), *place)
            for way, one in ways.items()
            for value, period, settled, places in zip(one.values.tolist(), one.periods, one.settled, one.places,
                                                      strict=True) for place in places.tolist()]
    names = ("way", name, "period", "settled", *section.names)
    write(options, {column: [row[i] for row in rows] for i, column in enumerate(names)}, names, {
        "gaps": {way: [value for value, some in zip(one.values.tolist(), one.places, strict=True) if not len(some)]
                 for way, one in ways.items()},
        **({"hysteresis": [list(one) for one in other]} if options.back else {}),
        **({} if located is None else _doublings(located)), "level": there.level},
        _notes(options, there, located))


def _located(section: ReturnMap, there: Diagram, most: int) -> Cascade | str | None:
    """The doublings from the first that is seen, one way or the other; why there are none; None where none is seen."""
    from hess_mechanics import ModelError, period_doublings, periodic_orbit
    from hess_mechanics.dynamics.orbit_diagram import doubling_seen

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
    return {"doublings": [
        {"value": float(value), "error": float(error), "period": int(period), "place": places[0].tolist()}
        for value, error, period, places in zip(found.values, found.errors, found.periods, found.places, strict=True)],
        "ratios": ratios, "limit": found.limit, "ended": found.ended}


def _notes(options: argparse.Namespace, there: Diagram, located: Cascade | str | None) -> list[str]:
    from hess_mechanics.dynamics.orbit_diagram import COMPARED

    notes = ["Volume is kept: each value shows one orbit, and nothing attracts."] if there.conservative.all() else []
    if options.back and options.crossings < COMPARED:
        notes.append(f"Whether the way back is another one is told from {COMPARED} crossings on.")
    if options.doublings and located is None:
        notes.append("No period doubles between neighbouring values here.")
    if isinstance(located, str):
        notes.append(f"The doubling that is seen was not located: {located}")
    return notes
