"""`hess-explorer cloud`: volume and density of a cloud of phase points without a field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hess_mechanics import BallBody, level
from hess_mechanics.chaplygin_ball.phase_cloud_density import Clouds, clouds
from hess_mechanics.parameters import CIRCLE_PHASE, H_FREE_BALL, TIME

from . import CommandError
from .arguments import number as any_number
from .command import OUTPUT, Command, Options, number, option, whole
from .motions import FREE_TENSOR, INNER_BALL, check_of
from .output import Answer, body_facts, quality, table

__all__ = ["COMMAND"]


def _computed(options: Options) -> Answer:
    if options.t == 0.0:
        raise CommandError("A cloud needs time to move: choose --t other than 0.")
    body = BallBody(*(*options.I, options.D))
    found = clouds(
        body, options.h, options.angle, options.spread, options.count, options.t, None, level(options.accuracy)
    )
    return Answer(
        _TABLES[options.table](found),
        {
            "count": options.count,
            "final_time": float(found.cloud.times[-1]),
            **quality(found.cloud),
            **body_facts(check_of(body)),
        },
    )


def _course(found: Clouds) -> Mapping[str, list[Any]]:
    mean, least, largest = found.course.log_growth.tolist()
    return {
        "t": found.cloud.times.tolist(),
        "volume": found.course.volume.tolist(),
        "growth_mean": mean,
        "growth_least": least,
        "growth_largest": largest,
    }


def _density(found: Clouds) -> Mapping[str, list[Any]]:
    density = found.density
    return {
        "log_s": density.log_s.tolist(),
        "first": density.first.tolist(),
        "last": density.last.tolist(),
        "mean": density.mean.tolist(),
    }


def _points(found: Clouds) -> Mapping[str, list[Any]]:
    cloud = found.cloud
    columns = {
        "ω1": cloud.omega[:, -1, 0],
        "ω2": cloud.omega[:, -1, 1],
        "log_s": cloud.log_s[:, -1],
        **{f"γ{i + 1}": cloud.gamma[:, -1, i] for i in range(3)},
    }
    return {name: column.tolist() for name, column in columns.items()}


_TABLES = {"course": _course, "density": _density, "points": _points}

COMMAND = Command(
    "Compute a cloud of phase points of the Chaplygin ball with Suslov's constraint without a field (the free Suslov "
    "problem for 𝒟 = 0), spread evenly over the states with E = h(1 ± δ), or around one state.  With s = I13ω1 + "
    "I23ω2, 1/|s| is the density of an invariant measure, so small volumes grow by s(t)/s(0).  Tables: course (time, "
    "volume of the cloud relative to t = 0, mean, minimum and maximum of ln s(t)/s(0)), density (fraction of the "
    "points per unit of ln|s| at the start, at the end and averaged over time), points (the states at the last time "
    "and their ln|s|).",
    (
        FREE_TENSOR,
        INNER_BALL,
        number(H_FREE_BALL, help="energy at the centre of the cloud, h > 0"),
        option("--spread", "δ, between 0 and 1 (default 0.1)", type=any_number, default=0.1),
        number(
            CIRCLE_PHASE,
            name="--angle",
            help="angle of ω in radians: start from a small patch around this ω with γ = e3 and radius δ (default: the "
            "whole energy shell)",
            required=False,
        ),
        whole("--count", 1, 100_000, "number of points", 1000),
        number(TIME),
        option("--table", "contents of the table (default: course)", choices=tuple(_TABLES), default="course"),
        *OUTPUT,
    ),
    table(_computed),
    "--I 2,1,0.5,0.7 --h 2 --count 500 --t 10 --table density --format csv",
)
