"""`hess-explorer section euler-poisson|suslov|ball`: the crossings of a surface by one motion."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from .arguments import integer, number, vector
from .bodies import add_ball, add_end, add_heavy_body, add_start, add_suslov_body, ball_of
from .output import add_options, computing, quality, whether_body, write

if TYPE_CHECKING:
    from hess_mechanics import BodyCheck, SectionCrossings

__all__ = ["add"]


def _count(text: str) -> int:
    """The type of a number of crossings."""
    from hess_mechanics.dynamics.section import MAX_CROSSINGS

    return integer(1, MAX_CROSSINGS)(text)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    section = commands.add_parser("section", help="the points of a Poincaré section")
    systems = section.add_subparsers(required=True, metavar="SYSTEM")

    heavy = systems.add_parser(
        "euler-poisson", help="a heavy body with a fixed point, in Andoyer–Deprit variables",
        description="Points (l, x = L/G) where the angle g of a heavy rigid body grows through π/2, with the energy h "
                    "and the area integral f.",
        epilog="Example: hess-explorer section euler-poisson --A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 "
               "--h 50 --f 5 --start 0,0.2 --crossings 20")
    add_heavy_body(heavy)
    heavy.add_argument("--h", type=number, required=True, help="energy")
    heavy.add_argument("--f", type=number, required=True, help="area integral (M, γ); the section needs G ≥ |f|")
    heavy.add_argument("--start", type=vector("l,x"), required=True, metavar="l,x", help="the first point")
    heavy.add_argument("--t", type=number, help="the last time; negative: backward (default: what this many crossings "
                                                "usually need)")
    _add_count(heavy)
    heavy.set_defaults(run=_run_heavy)

    suslov = systems.add_parser(
        "suslov", help="the Suslov problem with gravity, any plane",
        description="Crossings of the plane n1 ω1 + n2 ω2 + n3 γ1 + n4 γ2 + n5 γ3 = offset by an orbit of the Suslov "
                    "problem with gravity.",
        epilog="Example: hess-explorer section suslov --I 2,1,0.3,0.5 --b 0.3,-0.5,1 --omega 0.8,-0.4 "
               "--gamma 0.6,0,0.8 --plane 0,0,0,1,0 --t 50")
    add_suslov_body(suslov)
    add_start(suslov)
    _add_plane(suslov, None)
    suslov.set_defaults(run=_run_plane, prepare=_suslov)

    ball = systems.add_parser(
        "ball", help="the Chaplygin ball with Suslov's constraint, any plane",
        description="Crossings of the plane n1 ω1 + n2 ω2 + n3 γ1 + n4 γ2 + n5 γ3 = offset, γ3 = 0 unless another one "
                    "is given, by an orbit of the Chaplygin ball with Suslov's constraint.",
        epilog="Example: hess-explorer section ball --I 1,3,0,0 --D 5 --b 0.5,0,0.8 --omega 0.6,1.1 --gamma 0.6,0.8,0 "
               "--t 100")
    add_ball(ball)
    add_start(ball)
    _add_plane(ball, (0.0, 0.0, 0.0, 0.0, 1.0))
    ball.set_defaults(run=_run_plane, prepare=_ball)


def _add_plane(parser: argparse.ArgumentParser, usual: tuple[float, ...] | None) -> None:
    parser.add_argument("--plane", type=vector("n1,n2,n3,n4,n5"), required=usual is None, default=usual,
                        metavar="n1,n2,n3,n4,n5",
                        help="the normal of the plane" + ("" if usual is None else " (default 0,0,0,0,1)"))
    parser.add_argument("--offset", type=number, default=0.0, help="offset of the plane along its normal (default 0)")
    parser.add_argument("--sense", type=int, choices=(-1, 0, 1), default=1,
                        help="1 (default): crossed from below as time grows, -1: from above, 0: both")
    add_end(parser)
    _add_count(parser)


def _add_count(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--crossings", type=_count, default=100, metavar="N", help="at most this many (default 100)")
    add_options(parser)


def _run_heavy(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import level, section
        from hess_mechanics.euler_poisson.andoyer import AndoyerPlane, coordinates, state_at, time_for
        from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody

        accuracy = level(options.accuracy)
        body = HeavyBody(options.A, options.r, options.mu)
        start = state_at(body, options.h, options.f, *options.start)
        end = time_for(body, options.h, options.f, options.crossings) if options.t is None else options.t
        result = section(body, start, AndoyerPlane(options.f), end, accuracy, options.crossings)
        l, x = coordinates(result.states).T
    series = {"t": result.times.tolist(), "l": l.tolist(), "x": x.tolist(),
              "M": result.states[:, :3].tolist(), "gamma": result.states[:, 3:].tolist()}
    write(options, series, ("t", "l", "x", *SYSTEM.variables), _facts(result, start, body.check),
          _fewer(result, options.crossings, end))


def _suslov(options: argparse.Namespace) -> tuple[str, tuple[float, ...]]:
    from hess_mechanics import SuslovBody

    return "suslov", SuslovBody(*options.I, *options.b).parameters


def _ball(options: argparse.Namespace) -> tuple[str, tuple[float, ...]]:
    return "ball", ball_of(options).parameters


def _run_plane(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import Plane, check_body, level, section, systems, unit_vector

        accuracy = level(options.accuracy)
        name, parameters = options.prepare(options)
        system = systems()[name]
        gamma, note = unit_vector(options.gamma)
        start = (*options.omega, *gamma)
        plane = Plane(options.plane, options.offset, options.sense)
        result = section(system.at(parameters), start, plane, options.t, accuracy, options.crossings)
        check = check_body(*options.I)
    write(options, {"t": result.times.tolist(), "y": result.states.tolist()}, ("t", *system.variables),
          {"variables": list(system.variables), **_facts(result, start, check)},
          [*_fewer(result, options.crossings, options.t), *([note] if note else [])])


def _facts(result: SectionCrossings, start: tuple[float, ...], body: BodyCheck) -> Mapping[str, Any]:
    return {
        "start": list(start),
        **quality(result),
        **whether_body(body),
    }


def _fewer(result: SectionCrossings, asked: int, end: float) -> list[str]:
    """A note if the time ended before all crossings were found."""
    found = len(result.times)
    return [f"Up to t = {end:.6g} there are {found} of {asked} crossings."] if found < asked else []
