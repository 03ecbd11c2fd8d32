"""`hess-explorer period`: the period of a motion with b3 = 0 on a principal axis."""

from __future__ import annotations

import argparse

from .arguments import vector
from .bodies import add_inner_ball, add_start
from .output import add_options, computing, quality, write

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "period", help="the period of a motion with I13 = I23 = 0 and b3 = 0",
        description="With I13 = I23 = 0 and b3 = 0 the reflection γ3 → −γ3, t → −t maps motions to motions, so one "
                    "that crosses the equator γ3 = 0 twice is periodic: T is twice the time between the crossings, "
                    "for the Suslov problem (𝒟 = 0; Kharlamova's case) and for the Chaplygin ball with Suslov's "
                    "constraint.  period_closed_form, for 𝒟 = 0 only: 2 ∫dτ/√P(τ) by arithmetic-geometric means, P(τ) "
                    "= 1 − γ1² − γ2² a quartic in the time τ, dτ = γ3 dt.  Times are in the units of ω and b.",
        epilog="Example: hess-explorer period --I 1.3,0.8 --b 0.5,-0.2 --omega 1,-0.5 --gamma 0,0.6,0.8")
    parser.add_argument("--I", type=vector("I11,I22"), required=True, metavar="I11,I22", help="moments of inertia")
    parser.add_argument("--b", type=vector("b1,b2"), default=(0.0, 0.0), metavar="b1,b2", help="field (default 0,0)")
    add_inner_ball(parser)
    add_start(parser)
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import BallBody, PlaneBody, level, unit_vector
        from hess_mechanics.chaplygin_ball.integrable_cases import period
        from hess_mechanics.errors import InvalidParameter
        from hess_mechanics.suslov.kharlamova import arc

        accuracy = level(options.accuracy)
        gamma, note = unit_vector(options.gamma)
        start = (*options.omega, *gamma)
        ball = BallBody(*(*options.I, 0.0, 0.0, options.D, *options.b, 0.0))
        closed = arc(PlaneBody(*options.I, *options.b), start) if options.D == 0.0 else None
        if closed is not None and closed.kind != "periodic":
            what = "rests on the equator" if closed.kind == "fixed" else "tends to a fixed point on the equator"
            raise InvalidParameter(f"This motion {what} and has no period: choose another start.")
        found = period(ball, start, accuracy)
    facts = {"start": list(start), "period": found.value,
             "period_closed_form": None if closed is None else closed.period, **quality(found)}
    write(options, {"crossing": list(found.crossings)}, ("crossing",), facts, [note] if note else [])
