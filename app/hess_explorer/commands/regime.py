"""`hess-explorer regime SYSTEM`: of what kind a motion is, and whether dynamics are dissipative or mixed."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from .arguments import integer, number, vector
from .output import add_options, computing, write
from .sections import add_systems

if TYPE_CHECKING:
    from hess_mechanics import Dynamics, Regime

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    add_systems(
        commands.add_parser("regime", help="of what kind a motion is: periodic, quasi-periodic, chaotic"),
        "The kind of the motion of {section} from a place {place}, after a transient: fixed point, periodic, "
        "quasi-periodic, chaotic or undecided, by its crossings, MEGNO and the 0-1 test; and whether phase volume "
        "about it shrinks.  With --dynamics, to what it comes forward and backward in time, and how far apart that is. "
        "All of it is seen, with errors, not proved.",
        {"suslov": "--at 1.5,1.2", "quartic": "--at 0.9,0.1", "ball": "--at 1.5,1.2 --transient 500 --t 400",
         "euler-poisson": "--at 0,0.2", "hess": "--at 1 --dynamics --transient 60 --crossings 64 --t 50"},
        _add_rest, _run)


def _add_rest(parser: argparse.ArgumentParser, place: str) -> None:
    parser.add_argument("--at", type=vector(place), required=True, metavar=place, help="where the motion starts")
    parser.add_argument("--transient", type=integer(0, 20_000), default=300, metavar="N",
                        help="crossings left out (default 300)")
    parser.add_argument("--crossings", type=integer(8, 20_000), default=200, metavar="N",
                        help="crossings looked at, up to 64 times as many where they do not decide; a period is seen "
                             "of which they have three (default 200)")
    parser.add_argument("--t", type=number, default=200.0,
                        help="the time over which MEGNO and the divergence are averaged; at least 30 returns, up to 64 "
                             "times as long where it does not decide (default 200)")
    parser.add_argument("--dynamics", action="store_true",
                        help="compare what it comes to forward and backward in time")
    add_options(parser)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import dynamics_of, regime

        section = options.prepare(options)
        asked = {"transient": options.transient, "kept": options.crossings, "t": options.t}
        both = dynamics_of(section, options.at, **asked) if options.dynamics else None
        found = regime(section, options.at, **asked) if both is None else both.motion
    facts = _facts(found)
    if both is None:
        series = {name: found.places[:, i].tolist() for i, name in enumerate(found.names)}
    else:
        facts |= _compared(both)
        sets = {"attractor": both.attractor, "repeller": both.repeller}
        series = {"set": [name for name, places in sets.items() for _ in places],
                  **{name: [x for places in sets.values() for x in places[:, i].tolist()]
                     for i, name in enumerate(found.names)}}
    write(options, series, tuple(series), facts, notes=())


def _facts(found: Regime) -> dict[str, Any]:
    return {"kind": found.kind.words, "period": found.period, "integrable": found.integrable, "MEGNO": found.megno,
            "K": found.k, "t": found.t, "volume": found.volume, "divergence": found.divergence,
            "divergence_error": found.divergence_error, "sentence": found.sentence, "level": found.level}


def _compared(both: Dynamics) -> dict[str, Any]:
    return {"verdict": both.verdict, "dynamics": both.sentence, "distance": both.distance,
            "distance_error": both.distance_error, "shared": both.shared}
