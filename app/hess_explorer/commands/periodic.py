"""`hess-explorer periodic suslov|quartic|ball|euler-poisson|hess`: periodic orbits, their branches and manifolds."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from .arguments import integer, number, shown, vector
from .bodies import add_ball, add_heavy_body, add_suslov_body, ball_of
from .output import add_options, computing, write

if TYPE_CHECKING:
    from hess_mechanics import Branch, Manifold, PeriodicOrbit, ReturnMap

__all__ = ["add"]


def _end(text: str) -> tuple[str, float]:
    """The type of NAME=TO."""
    name, is_there, end = text.partition("=")
    if not (name and is_there):
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a parameter and its last value; write it like E=2.5")
    return name, number(end)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    periodic = commands.add_parser("periodic", help="periodic orbits of a section, their branches and manifolds")
    systems = periodic.add_subparsers(required=True, metavar="SYSTEM")

    suslov = systems.add_parser(
        "suslov", help="the Suslov problem with gravity",
        description="A periodic orbit of the section γ_k = 0 at the energy E, found by Newton's method from a place "
                    "(ψ, δ), with its multipliers and type.",
        epilog="Example: hess-explorer periodic suslov --I 1.5,1,0,0 --b 0.3,-0.5,1 --E 1.842 --at 1.5,1.2")
    add_suslov_body(suslov)
    suslov.add_argument("--E", type=number, required=True, help="energy")
    suslov.add_argument("--plane", type=int, choices=(1, 2, 3), default=3, help="k of γ_k = 0 (default 3)")
    _add_search(suslov, "psi,delta")
    suslov.set_defaults(run=_run, prepare=_suslov)

    quartic = systems.add_parser(
        "quartic", help="the Suslov problem with b1 = b2 = 0, as a point in a quartic potential",
        description="A periodic orbit of the section of the axis of the region that a point may enter, found by "
                    "Newton's method from a place (q, p) of it, with its multipliers and type.",
        epilog="Example: hess-explorer periodic quartic --I 2,1 --b3 1 --h 0.8 --at 0.9,0.1")
    quartic.add_argument("--I", type=vector("I11,I22"), required=True, metavar="I11,I22", help="moments of inertia")
    quartic.add_argument("--b3", type=number, required=True, help="field, not 0")
    quartic.add_argument("--h", type=number, required=True, help="energy, h > -|b3|")
    _add_search(quartic, "q,p")
    quartic.set_defaults(run=_run, prepare=_quartic)

    ball = systems.add_parser(
        "ball", help="the Chaplygin ball with Suslov's constraint, in a field",
        description="A periodic orbit of the section γ3 = 0 at the energy h, found by Newton's method from a place "
                    "(ψ, δ), with its multipliers and type.",
        epilog="Example: hess-explorer periodic ball --I 1,3,0.2,-0.1 --D 5 --b 0.5,0.2,0.8 --h 2 --at 1.5,1.2")
    add_ball(ball)
    ball.add_argument("--h", type=number, required=True, help="energy")
    _add_search(ball, "psi,delta")
    ball.set_defaults(run=_run, prepare=_ball)

    heavy = systems.add_parser(
        "euler-poisson", help="a heavy body with a fixed point",
        description="A periodic orbit of the Andoyer–Deprit section g = π/2 at H = h, (M, γ) = f, found by Newton's "
                    "method from a place (l, L/G), with its multipliers and type.",
        epilog="Example: hess-explorer periodic euler-poisson --A 1,0.625,0.25 --r 0.6,0,0.8 --mu 1 --h 1.5 --f -0.7 "
               "--at 0,0.2 --period 1 --manifolds 1")
    add_heavy_body(heavy)
    heavy.add_argument("--h", type=number, required=True, help="energy")
    heavy.add_argument("--f", type=number, required=True, help="area integral (M, γ)")
    heavy.add_argument("--sheet", type=int, choices=(0, 1, 2), default=0,
                       help="of the momenta G with this energy, 0 (default): the largest, 1: the second, 2: the third")
    _add_search(heavy, "l,x")
    heavy.set_defaults(run=_run, prepare=_heavy)

    hess = systems.add_parser(
        "hess", help="the Suslov–Hess case, on a torus",
        description="A limit cycle of the torus (h, f) of the Suslov–Hess case, units b = 1, found by Newton's method "
                    "from an angle φ of w, where n3 rises through the middle of its range.",
        epilog="Example: hess-explorer periodic hess --a 0.7 --h 0.5 --f 0.6 --at 1 --period 1 --along a=0.3 "
               "--format csv")
    for name, help_ in (("a", "inertia parameter a = I23/I22"), ("h", "energy, h > -1"), ("f", "area integral")):
        hess.add_argument(f"--{name}", type=number, required=True, help=help_)
    _add_search(hess, "phi")
    hess.set_defaults(run=_run, prepare=_hess)


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


def _suslov(options: argparse.Namespace) -> ReturnMap:
    from hess_mechanics import SuslovBody, return_map

    return return_map(SuslovBody(*options.I, *options.b), E=options.E, plane=options.plane, accuracy=options.accuracy)


def _quartic(options: argparse.Namespace) -> ReturnMap:
    from hess_mechanics import QuarticBody, return_map

    I11, I22 = options.I
    return return_map(QuarticBody(I11, I22, options.b3, options.h), accuracy=options.accuracy)


def _ball(options: argparse.Namespace) -> ReturnMap:
    from hess_mechanics import return_map

    return return_map(ball_of(options), h=options.h, accuracy=options.accuracy)


def _heavy(options: argparse.Namespace) -> ReturnMap:
    from hess_mechanics import HeavyBody, return_map

    return return_map(HeavyBody(options.A, options.r, options.mu), h=options.h, f=options.f, sheet=options.sheet,
                      accuracy=options.accuracy)


def _hess(options: argparse.Namespace) -> ReturnMap:
    import math

    from hess_mechanics import HessBody, return_map

    # I22 = 1, and b3 such that b = 1.
    return return_map(HessBody(1.0, options.a, -math.hypot(1.0, options.a)), h=options.h, f=options.f,
                      accuracy=options.accuracy)


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
        "ended": [one.ended for one in curves]}, notes=())
