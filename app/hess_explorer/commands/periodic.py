"""`hess-explorer periodic suslov|quartic|ball|euler-poisson|hess`: periodic orbits, their branches and manifolds."""

from __future__ import annotations

from typing import Any

from hess_mechanics import Branch, Manifold, PeriodicOrbit, ReturnMap, continued_orbit, manifold, periodic_orbit

from .arguments import assigned
from .arguments import number as any_number
from .command import Options, option, whole
from .output import Answer, columns
from .sections import command_of_sections

__all__ = ["COMMAND"]


def _computed(section: ReturnMap, options: Options) -> Answer:
    orbit = periodic_orbit(section, options.at, options.period)
    if options.along is not None:
        name, end = options.along
        return _of_branch(continued_orbit(section, orbit, name, end, options.points))
    if options.manifolds is not None:
        return _of_manifolds(
            orbit,
            [
                manifold(section, orbit, options.manifolds, stable=stable, side=side)
                for stable in (False, True)
                for side in (1, -1)
            ],
        )
    return Answer(columns(orbit), _facts(orbit))


def _pair(value: complex) -> list[float]:
    return [value.real, value.imag]


def _facts(orbit: PeriodicOrbit) -> dict[str, Any]:
    return {
        "period": orbit.period,
        "time": float(orbit.time),
        "time_error": float(orbit.time_error),
        "kind": orbit.kind,
        "multipliers": [_pair(complex(one)) for one in orbit.multipliers],
        "multiplier_error": float(orbit.multiplier_error),
        "error_estimate": float(orbit.error_estimate),
        "condition": orbit.condition,
        "iterations": orbit.iterations,
        "symmetric": list(orbit.symmetric),
        "level": orbit.level,
        "status": str(orbit.status),
    }


def _of_branch(branch: Branch) -> Answer:
    found = [
        {
            "kind": one.kind,
            "value": one.value,
            "error": float(one.error),
            "place": one.places[0].tolist(),
            "multipliers": [_pair(complex(value)) for value in one.multipliers],
        }
        for one in branch.bifurcations
    ]
    return Answer(
        columns(branch),
        {
            "period": branch.period,
            "bifurcations": found,
            "ended": branch.ended,
            "error_estimate": branch.error_estimate,
            "level": branch.level,
        },
    )


def _of_manifolds(orbit: PeriodicOrbit, curves: list[Manifold]) -> Answer:
    names = ["manifold", "side", "length", *orbit.names]
    rows = [
        ["stable" if curve.stable else "unstable", curve.side, float(length), *map(float, point)]
        for curve in curves
        for length, point in zip(curve.lengths, curve.points, strict=True)
    ]
    return Answer(
        dict(zip(names, map(list, zip(*rows, strict=True)), strict=True)),
        {
            **_facts(orbit),
            "saddle": orbit.places[0].tolist(),
            "errors": [float(one.error_estimate) for one in curves],
            "ended": [one.ended for one in curves],
            "status": next(
                (status for status in (str(one.status) for one in curves) if status != "ok"), str(orbit.status)
            ),
        },
    )


COMMAND = command_of_sections(
    "Find a periodic orbit of {section} by Newton's method from a point {place}, with its multipliers and type.",
    "initial guess of the search",
    (
        whole("--period", 1, 64, "number of returns (default: detected, up to 12)"),
        option(
            "--along",
            "continue the orbit in a parameter up to this value, through folds, and find bifurcations",
            type=assigned(any_number, "E=2.5"),
            metavar="NAME=TO",
        ),
        option(
            "--manifolds",
            "compute both branches of the stable and the unstable manifold of a saddle, up to this length",
            type=any_number,
            metavar="LENGTH",
        ),
        whole("--points", 2, 2000, "maximum number of points of the branch", 200),
    ),
    {
        "suslov": "--at 1.5,1.2",
        "quartic": "--at 0.9,0.1",
        "ball": "--at 1.5,1.2",
        "euler-poisson": "--at 0,0.2 --period 1 --manifolds 1",
        "hess": "--at 1 --period 1 --along a=0.3 --format csv",
    },
    _computed,
    exclusive=("--along", "--manifolds"),
)
