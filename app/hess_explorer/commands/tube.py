"""`hess-explorer tube SYSTEM`: proved intervals that contain one motion, and the proved error of an orbit."""

from __future__ import annotations

import json

from hess_mechanics import LEVELS, Tube, level, proved_error, right_until, solve, systems, tube
from hess_mechanics.dynamics.tube import WORK_PER_SECOND
from hess_mechanics.errors import InvalidParameter, WorkLimit

from .arguments import number, numbers
from .command import OUT, Command, Options, option, whole
from .orbit import TIMES
from .output import text

__all__ = ["COMMAND"]


def _shorter(found: Tube, end: float, seconds: float) -> str:
    """Return the reason why a tube ends before its last time, with a remedy."""
    there = f"Enclosed only up to t = {found.times[-1]:g} of {end:g}" if found.times.size else "No time is enclosed"
    if found.spent:
        return (
            f"{there}: the work limit of {seconds:g} s is reached. Reduce --digits or the time, or increase --seconds."
        )
    return f"{there}: the next step cannot be enclosed. Reduce --digits or the time, or choose less extreme parameters."


def _computed(options: Options) -> str:
    known = systems()
    if options.system not in known:
        raise InvalidParameter(f"There is no system {options.system[:40]!r}: choose one of {', '.join(known)}.")
    if not options.seconds > 0.0:
        raise InvalidParameter(f"--seconds {options.seconds:g} is not positive: choose a number above 0.")
    system = known[options.system]
    body = system.at(options.parameters)
    found = tube(body, options.start, options.t, options.digits, options.seconds * WORK_PER_SECOND)
    notes = [] if found.complete else [_shorter(found, options.t[-1], options.seconds)]
    if not found.times.size:
        raise WorkLimit(notes[0])
    orbit = solve(body, options.start, found.times, level(options.accuracy))
    judged = {
        "accuracy": options.accuracy,
        "error_estimate": orbit.error_estimate,
        "proved_error": list(proved_error(orbit, found)),
        "right_to": options.right_to,
        "right_until": right_until(orbit, found, options.right_to),
    }
    return json.dumps(
        {
            "system": system.name,
            "variables": list(system.variables),
            "start": list(options.start),
            "parameters": list(options.parameters),
            "complete": found.complete,
            "tube": [
                {"t": t, "state": [list(one.decimals(options.digits + 3)) for one in state]}
                for t, state in zip(found.times.tolist(), found.states, strict=True)
            ],
            "orbit": judged,
            "steps": found.steps,
            "bits": found.bits,
            "seconds": round(found.seconds, 3),
            "notes": notes,
        },
        ensure_ascii=False,
        allow_nan=False,
        indent=1,
    )


COMMAND = Command(
    "Enclose one motion of any system by ball arithmetic.  At each time the output has intervals that contain the true "
    "state, provided that the ball arithmetic of Arb is correct; start and parameters are exact doubles.  The output "
    "also has the proved error of the orbit that `hess-explorer orbit` computes, and the last time at which it is "
    "right.  Requires: pip install 'hess-explorer[prove]'.",
    (
        option("system", "suslov, ball, hess, euler-poisson or plane-potential", metavar="SYSTEM"),
        option(
            "--start",
            "state at t = 0, in the order of the system's variables",
            required=True,
            type=numbers,
            metavar="NUMBERS",
        ),
        option(
            "--parameters", "parameters, in the order of the system", required=True, type=numbers, metavar="NUMBERS"
        ),
        TIMES,
        whole("--digits", 1, 100, "number of digits that determines the width of the intervals", 18),
        option(
            "--accuracy",
            "accuracy of the orbit to check (default: standard)",
            choices=tuple(LEVELS),
            default="standard",
        ),
        option(
            "--right-to",
            "largest error of an orbit that is right (default: 1e-6)",
            type=number,
            default=1e-6,
            metavar="ERROR",
        ),
        option(
            "--seconds",
            "work limit in seconds of an ordinary core; it is counted rather than timed, so the result does not depend "
            "on the machine (default: 4)",
            type=number,
            default=4.0,
            metavar="S",
        ),
        OUT,
    ),
    text(_computed),
    "hess --start 0.3,0.9,0.6,0,0.8 --parameters 0.75,1 --t 0:2:5",
)
