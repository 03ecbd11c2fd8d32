"""`hess-explorer regime SYSTEM`: of what kind a motion is, and whether dynamics are dissipative or mixed."""

from __future__ import annotations

from typing import Any

from hess_mechanics import Dynamics, Regime, ReturnMap, dynamics_of, regime
from hess_mechanics.parameters import TIME

from .command import Options, flag, number, whole
from .output import Answer, columns
from .sections import command_of_sections

__all__ = ["COMMAND"]


def _computed(section: ReturnMap, options: Options) -> Answer:
    asked = {"transient": options.transient, "kept": options.crossings, "t": options.t}
    if options.dynamics:
        both = dynamics_of(section, options.at, **asked)
        return Answer(columns(both), {**_facts(both.motion), **_compared(both)})
    found = regime(section, options.at, **asked)
    return Answer(columns(found), _facts(found))


def _facts(found: Regime) -> dict[str, Any]:
    return {
        "kind": found.kind.words,
        "period": found.period,
        "integrable": found.integrable,
        "MEGNO": found.megno,
        "K": found.k,
        "t": found.t,
        "volume": found.volume,
        "divergence": found.divergence,
        "divergence_error": found.divergence_error,
        "sentence": found.sentence,
        "level": found.level,
    }


def _compared(both: Dynamics) -> dict[str, Any]:
    return {
        "verdict": both.verdict,
        "dynamics": both.sentence,
        "distance": both.distance,
        "distance_error": both.distance_error,
        "shared": both.shared,
    }


COMMAND = command_of_sections(
    "The kind of the motion of {section} from a place {place}, after a transient: fixed point, periodic, "
    "quasi-periodic, chaotic or undecided, by its crossings, MEGNO and the 0-1 test; and whether phase volume about it "
    "shrinks.  With --dynamics, to what it comes forward and backward in time, and how far apart that is. All of it is "
    "seen, with errors, not proved.",
    "where the motion starts",
    (
        whole("--transient", 0, 20_000, "crossings left out", 300),
        whole(
            "--crossings",
            8,
            20_000,
            "crossings looked at, up to 64 times as many where they do not decide; a period "
            "is seen of which they have three",
            200,
        ),
        number(
            TIME,
            200.0,
            help="the time over which MEGNO and the divergence are averaged; at least 30 returns, up to "
            "64 times as long where it does not decide",
        ),
        flag("--dynamics", "compare what it comes to forward and backward in time"),
    ),
    {
        "suslov": "--at 1.5,1.2",
        "quartic": "--at 0.9,0.1",
        "ball": "--at 1.5,1.2 --transient 500 --t 400",
        "euler-poisson": "--at 0,0.2",
        "hess": "--at 1 --dynamics --transient 60 --crossings 64 --t 50",
    },
    _computed,
)
