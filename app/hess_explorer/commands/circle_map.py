"""`hess-explorer circle-map`: the circle map Θ of one Suslov–Hess torus."""

from __future__ import annotations

from hess_mechanics import circle_map, level
from hess_mechanics.parameters import A_HESS, CIRCLE_PHASE, F_HESS, H_PLANE

from .command import OUTPUT, Command, Options, number, samples
from .output import Answer, quality, table

__all__ = ["COMMAND", "TORUS"]

TORUS = (
    number(H_PLANE, help="energy, h > -1"),
    number(F_HESS, help="area integral, |f| ≤ f_max(h)"),
    number(A_HESS, help="inertia parameter a = I23/I22"),
)
"""Options of a torus (h, f) for the parameter a, in units b = 1."""


def _computed(options: Options) -> Answer:
    result = circle_map(options.a, options.h, options.f, level(options.accuracy))
    return Answer(
        {"phi": options.phi, "theta": result.theta(options.phi).tolist()},
        {
            "h": result.h,
            "f": result.f,
            "a": result.a,
            "trace": result.trace,
            "log_trace": result.log_trace,
            "kind": result.kind,
            "rotation_number": result.rotation_number,
            "period": result.period,
            "fixed_points": [point.phi for point in result.fixed_points],
            "multipliers": [point.multiplier for point in result.fixed_points],
            "log_multipliers": [point.log_multiplier for point in result.fixed_points],
            **quality(result),
        },
    )


COMMAND = Command(
    "Compute the circle map Θ(φ) of the torus (h, f) in units b = 1, on the section at the lower turning point of n3, "
    "with w = |w|(sin φ, cos φ).  The output has the trace, kind, rotation number, period, fixed points (the stable "
    "one first) with their multipliers, and Θ at the given angles.  log_trace and log_multipliers are logarithms, for "
    "numbers that exceed double precision.",
    (*TORUS, samples(CIRCLE_PHASE, "angles in radians (default: none)", []), *OUTPUT),
    table(_computed),
    "--h 1.5 --f 0.6 --a 0.5 --phi 0,1,2 --accuracy reference",
)
