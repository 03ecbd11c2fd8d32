"""`hess-explorer period`: the period of a motion with b3 = 0 on a principal axis."""

from __future__ import annotations

from hess_mechanics import BallBody, PlaneBody, level
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.parameters import FIELD, TENSOR
from hess_mechanics.suslov.kharlamova import arc

from .command import OUTPUT, Command, Options, vector
from .motions import INNER_BALL, START, start_of
from .output import Answer, quality, table

__all__ = ["COMMAND"]


def _computed(options: Options) -> Answer:
    accuracy = level(options.accuracy)
    start, notes = start_of(options)
    ball = BallBody(*(*options.I, 0.0, 0.0, options.D, *options.b, 0.0))
    closed = arc(PlaneBody(*options.I, *options.b), start) if options.D == 0.0 else None
    if closed is not None and closed.kind != "periodic":
        what = "rests on the equator" if closed.kind == "fixed" else "tends to a fixed point on the equator"
        raise InvalidParameter(f"This motion {what}, so it has no period: choose another start.")
    found = period(ball, start, accuracy)
    return Answer(
        {"crossing": list(found.crossings)},
        {
            "start": list(start),
            "period": found.value,
            "period_closed_form": None if closed is None else closed.period,
            **quality(found),
        },
        notes,
    )


COMMAND = Command(
    "Compute the period of a motion with I13 = I23 = 0 and b3 = 0, of the Suslov problem (𝒟 = 0; Kharlamova's case) or "
    "of the Chaplygin ball with Suslov's constraint.  The reflection γ3 → −γ3, t → −t maps motions to motions, so a "
    "motion that crosses the equator γ3 = 0 twice is periodic; its period is twice the time between the crossings.  "
    "period_closed_form, only for 𝒟 = 0: 2 ∫dτ/√P(τ) by arithmetic-geometric means, with the quartic P(τ) = 1 − γ1² − "
    "γ2² in the time τ, dτ = γ3 dt.  Times are in the units of ω and b.",
    (
        vector("--I", TENSOR[:2], "moments of inertia"),
        vector("--b", FIELD[:2], "field (default 0,0)", (0.0, 0.0)),
        INNER_BALL,
        *START,
        *OUTPUT,
    ),
    table(_computed),
    "--I 1.3,0.8 --b 0.5,-0.2 --omega 1,-0.5 --gamma 0,0.6,0.8",
)
