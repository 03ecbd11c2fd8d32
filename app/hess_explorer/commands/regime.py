"""`hess-explorer regime SYSTEM`: classify a motion, and distinguish dissipative from mixed dynamics."""

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
        "measure": found.measure,
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
    "Classify the motion of {section} from a point {place} after a transient: fixed point, periodic, quasi-periodic, "
    "chaotic or undecided, from its crossings, Newton's method, MEGNO and the 0-1 test; and report whether phase "
    "volume around it shrinks.  With --dynamics, compare the limit sets forward and backward in time.  The results "
    "are numerical, with error estimates, not proved.",
    "starting point of the motion",
    (
        whole("--transient", 0, 20_000, "number of crossings to skip", 300),
        whole(
            "--crossings",
            8,
            20_000,
            "number of crossings to analyse, up to 64 times as many if they do not decide; a period must repeat three "
            "times to be detected",
            200,
        ),
        number(
            TIME,
            200.0,
            help="averaging time of MEGNO and the divergence; at least 30 returns, up to 64 times as long if it does "
            "not decide",
        ),
        flag("--dynamics", "compare the limit sets forward and backward in time"),
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
