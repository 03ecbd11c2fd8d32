"""`hess-explorer cloud`: a cloud of phase points without a field, and how its volume and density change."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import CommandError
from .arguments import integer, number
from .bodies import add_end, add_free_body, add_inner_ball
from .output import add_options, computing, quality, whether_body, write

if TYPE_CHECKING:
    from hess_mechanics.chaplygin_ball.phase_cloud_density import Clouds

__all__ = ["add"]

_MOST = 100_000


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "cloud", help="a cloud of phase points without a field, its volume and density",
        description="Phase points of the Chaplygin ball with Suslov's constraint without a field (the free Suslov "
                    "problem for 𝒟 = 0), evenly spread over the states with E = h(1 ± δ), or about one state.  With s "
                    "= I13ω1 + I23ω2, 1/|s| is the density of an invariant measure: small volumes grow by s(t)/s(0).  "
                    "Tables: course (t, the volume of the cloud relative to that at t = 0, and mean, least and "
                    "largest of ln s(t)/s(0)), density (shares of the points per unit of ln|s| at the start, at the "
                    "end and in the mean over the time), points (the states at the last time, and their ln|s|).",
        epilog="Example: hess-explorer cloud --I 2,1,0.5,0.7 --h 2 --count 500 --t 10 --table density --format csv")
    add_free_body(parser)
    add_inner_ball(parser)
    parser.add_argument("--h", type=number, required=True, help="energy in the middle of the cloud, h > 0")
    parser.add_argument("--spread", type=number, default=0.1, help="δ, between 0 and 1 (default 0.1)")
    parser.add_argument("--angle", type=number,
                        help="a small patch about the ω at this angle, in radians, with γ = e3; δ is its radius "
                             "(default: the whole energy shell)")
    parser.add_argument("--count", type=integer(1, _MOST), default=1000, metavar="N",
                        help="how many points (default 1000)")
    add_end(parser)
    parser.add_argument("--table", choices=("course", "density", "points"), default="course",
                        help="what the table is (default: course)")
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    if options.t == 0.0:
        raise CommandError("In no time a cloud does not move: choose --t other than 0.")
    with computing():
        from hess_mechanics import BallBody, check_body, level
        from hess_mechanics.chaplygin_ball.phase_cloud_density import clouds

        accuracy = level(options.accuracy)
        body = BallBody(*(*options.I, options.D))
        found = clouds(body, options.h, options.angle, options.spread, options.count, options.t, None, accuracy)
        series = {"course": _course, "density": _density, "points": _points}[options.table](found)
        check = check_body(*options.I)
    facts = {"count": options.count, "final_time": float(found.cloud.times[-1]), **quality(found.cloud),
             **whether_body(check)}
    write(options, series, tuple(series), facts, notes=())


def _course(found: Clouds) -> Mapping[str, list[Any]]:
    mean, least, largest = found.course.log_growth.tolist()
    return {"t": found.cloud.times.tolist(), "volume": found.course.volume.tolist(), "growth_mean": mean,
            "growth_least": least, "growth_largest": largest}


def _density(found: Clouds) -> Mapping[str, list[Any]]:
    density = found.density
    return {"log_s": density.log_s.tolist(), "first": density.first.tolist(), "last": density.last.tolist(),
            "mean": density.mean.tolist()}


def _points(found: Clouds) -> Mapping[str, list[Any]]:
    cloud = found.cloud
    columns = {"ω1": cloud.omega[:, -1, 0], "ω2": cloud.omega[:, -1, 1], "log_s": cloud.log_s[:, -1],
               **{f"γ{i + 1}": cloud.gamma[:, -1, i] for i in range(3)}}
    return {name: column.tolist() for name, column in columns.items()}
