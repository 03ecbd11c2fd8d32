"""`hess-explorer periodic suslov|quartic|ball|euler-poisson|hess`: periodic orbits, their branches and manifolds."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from .arguments import integer, number, shown, vector
from .output import add_options, computing, write
from .sections import add_systems

if TYPE_CHECKING:
    from hess_mechanics import Branch, Manifold, PeriodicOrbit

__all__ = ["add"]


def _end(text: str) -> tuple[str, float]:
    """The type of NAME=TO."""
    name, is_there, end = text.partition("=")
    if not (name and is_there):
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a parameter and its last value; write it like E=2.5")
    return name, number(end)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    add_systems(
        commands.add_parser("periodic", help="periodic orbits of a section, their branches and manifolds"),
        "A periodic orbit of {section} found by Newton's method from a place {place}, with its multipliers and type.",
        {"suslov": "--at 1.5,1.2", "quartic": "--at 0.9,0.1", "ball": "--at 1.5,1.2",
         "euler-poisson": "--at 0,0.2 --period 1 --manifolds 1",
         "hess": "--at 1 --period 1 --along a=0.3 --format csv"}, _add_search, _run)


def _add_search(parser: argparse.ArgumentParser, place: str) -> None:
    parser.add_argument("--at", type=vector(place), required=True, metavar=place, help="where the search begins")
    parser.add_argument("--period", type=integer(1, 64), metavar="M", help="returns (default: found, up to 12)")
    besides = parser.add_mutually_exclusive_group()
    besides.add_argument("--along", type=_end, metavar="NAME=TO",
                         help="the branch of the orbit over a parameter, from its value here, through folds, with "
                              "the bifurcations on it")
    besides.add_argument("--manifolds", type=number, metavar="LENGTH",
                         help="both branches of the stable and of the unstable manifold of a saddle, so long")
    parser.add_argument("--points", type=integer(2, 2000), default=200, metavar="N",
                        help="of the branch, at most (default 200)")
    add_options(parser)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import continued_orbit, manifold, periodic_orbit

        section = options.prepare(options)
        orbit = periodic_orbit(section, options.at, options.period)
        branch, curves = None, None
        if options.along is not None:
            name, end = options.along
            branch = continued_orbit(section, orbit, name, end, options.points)
        if options.manifolds is not None:
            curves = [manifold(section, orbit, options.manifolds, stable=stable, side=side)
                      for stable in (False, True) for side in (1, -1)]
    if branch is not None:
        _write_branch(options, branch)
    elif curves is not None:
        _write_manifolds(options, orbit, curves)
    else:
        series = {"return": list(range(orbit.period)),
                  **{name: orbit.places[:, i].tolist() for i, name in enumerate(orbit.names)}}
        write(options, series, tuple(series), _facts(orbit), notes=())


def _pair(value: complex) -> list[float]:
    return [value.real, value.imag]


def _facts(orbit: PeriodicOrbit) -> dict[str, Any]:
    return {
        "period": orbit.period, "kind": orbit.kind,
        "multipliers": [_pair(complex(one)) for one in orbit.multipliers],
        "multiplier_error": float(orbit.multiplier_error), "error_estimate": float(orbit.error_estimate),
        "condition": orbit.condition, "iterations": orbit.iterations, "symmetric": list(orbit.symmetric),
        "level": orbit.level, "status": str(orbit.status)}


def _write_branch(options: argparse.Namespace, branch: Branch) -> None:
    series: dict[str, Any] = {branch.parameter: branch.values.tolist(),
                              **{name: branch.places[:, 0, i].tolist() for i, name in enumerate(branch.names)}}
    for i in range(branch.multipliers.shape[1]):
        series[f"real{i + 1}"] = branch.multipliers[:, i].real.tolist()
        series[f"imag{i + 1}"] = branch.multipliers[:, i].imag.tolist()
    series |= {"kind": list(branch.kinds), "error": branch.errors.tolist()}
    found = [{"kind": one.kind, "value": one.value, "error": float(one.error), "place": one.places[0].tolist(),
              "multipliers": [_pair(complex(value)) for value in one.multipliers]} for one in branch.bifurcations]
    write(options, series, tuple(series), {
        "period": branch.period, "bifurcations": found, "ended": branch.ended,
        "error_estimate": branch.error_estimate, "level": branch.level}, notes=())


def _write_manifolds(options: argparse.Namespace, orbit: PeriodicOrbit, curves: list[Manifold]) -> None:
    names = ["manifold", "side", "length", *orbit.names]
    rows = [["stable" if curve.stable else "unstable", curve.side, float(length), *map(float, point)]
            for curve in curves for length, point in zip(curve.lengths, curve.points, strict=True)]
    write(options, dict(zip(names, map(list, zip(*rows, strict=True)), strict=True)), names, {
        **_facts(orbit), "saddle": orbit.places[0].tolist(), "errors": [float(one.error_estimate) for one in curves],
        "ended": [one.ended for one in curves],
        "status": next((status for status in (str(one.status) for one in curves) if status != "ok"), str(orbit.status)),
    }, notes=())
