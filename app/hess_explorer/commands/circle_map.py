"""`hess-explorer circle-map`: the circle map Θ of one Suslov–Hess torus."""

from __future__ import annotations

import argparse

from .arguments import number, samples
from .output import add_options, computing, quality, write

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "circle-map", help="the circle map of a Suslov–Hess torus (h, f)",
        description="The circle map Θ(φ) of the torus (h, f), units b = 1, on the section n3 = lower turning point, "
                    "w = |w|(sin φ, cos φ): trace, kind, rotation number, period, fixed points (the stable one "
                    "first) with their multipliers, and Θ at the given angles.  log_trace and log_multipliers give "
                    "their logarithms, for numbers beyond double precision.",
        epilog="Example: hess-explorer circle-map --h 1.5 --f 0.6 --a 0.5 --phi 0,1,2 --accuracy reference")
    parser.add_argument("--h", type=number, required=True, help="energy, h > -1")
    parser.add_argument("--f", type=number, required=True, help="area integral, |f| ≤ f_max(h)")
    parser.add_argument("--a", type=number, required=True, help="inertia parameter a = I23/I22")
    parser.add_argument("--phi", type=samples, default=[], metavar="LIST",
                        help="angles in radians, 0,1,2 or lo:hi:n (default: none)")
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import circle_map, level

        result = circle_map(options.a, options.h, options.f, level(options.accuracy))
        theta = result.theta(options.phi).tolist()
    facts = {
        "h": result.h, "f": result.f, "a": result.a,
        "trace": result.trace,
        "log_trace": result.log_trace,
        "kind": result.kind,
        "rotation_number": result.rotation_number,
        "period": result.period,
        "fixed_points": [point.phi for point in result.fixed_points],
        "multipliers": [point.multiplier for point in result.fixed_points],
        "log_multipliers": [point.log_multiplier for point in result.fixed_points],
        **quality(result),
    }
    write(options, {"phi": options.phi, "theta": theta}, ("phi", "theta"), facts, notes=())
