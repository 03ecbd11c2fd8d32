"""`hess-explorer orbit suslov|ball|hess|euler-poisson`: states of one motion at given times."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from .arguments import number, samples
from .bodies import add_ball, add_heavy_body, add_start, add_suslov_body, ball_of
from .output import add_options, computing, quality, whether_body, write

if TYPE_CHECKING:
    from hess_mechanics import BodyCheck

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    orbit = commands.add_parser("orbit", help="states of one motion at given times")
    systems = orbit.add_subparsers(required=True, metavar="SYSTEM")

    suslov = systems.add_parser(
        "suslov", help="the Suslov problem with gravity", description="Orbit of the Suslov problem with gravity.",
        epilog="Example: hess-explorer orbit suslov --I 2,1,0.3,0.5 --b 0.3,-0.5,1 --omega 0.8,-0.4 "
               "--gamma 0.3,0.2,0.93 --t 10,50")
    add_suslov_body(suslov)
    _add_motion(suslov, "w1,w2", "g1,g2,g3")
    suslov.set_defaults(run=_run, system="suslov", parameters=_suslov_parameters)

    ball = systems.add_parser(
        "ball", help="the Chaplygin ball with Suslov's constraint",
        description="Orbit of the Chaplygin ball with Suslov's constraint.",
        epilog="Example: hess-explorer orbit ball --I 1,1.5,0.7,1.2 --D 10 --omega=-1.2,0.8 --gamma 0.3,0.5,0.8 "
               "--t 5,20")
    add_ball(ball)
    _add_motion(ball, "w1,w2", "g1,g2,g3")
    ball.set_defaults(run=_run, system="ball", parameters=_ball_parameters)

    hess = systems.add_parser(
        "hess", help="the Suslov–Hess case, reduced",
        description="Orbit of the Suslov–Hess case in its reduced variables (w1, w2, n1, n2, n3).",
        epilog="Example: hess-explorer orbit hess --a 0.5 --b 1 --omega 0.7,1.1 --gamma 0.2,0.5,0.7 --t 10,50")
    hess.add_argument("--a", type=number, required=True, help="inertia parameter a = I23/I22")
    hess.add_argument("--b", type=number, required=True, help="field")
    _add_motion(hess, "w1,w2", "n1,n2,n3")
    hess.set_defaults(run=_run, system="hess", parameters=_hess_parameters)

    heavy = systems.add_parser(
        "euler-poisson", help="the Euler–Poisson equations",
        description="Orbit of a heavy rigid body with a fixed point in its principal axes, H = ½(M, AM) − μ(r, γ).",
        epilog="Example: hess-explorer orbit euler-poisson --A 1,1.6,2.5 --r 3,0,4 --mu 1.995 --M 1.3,-2,0.7 "
               "--gamma 0.3,0.4,0.87 --t 5,20")
    add_heavy_body(heavy)
    _add_motion(heavy, "M1,M2,M3", "g1,g2,g3", "--M", "angular momentum")
    heavy.set_defaults(run=_run, system="euler-poisson", parameters=_heavy_parameters)


def _add_motion(parser: argparse.ArgumentParser, *start: str) -> None:
    add_start(parser, *start)
    parser.add_argument("--t", type=samples, required=True, metavar="TIMES",
                        help="times away from 0, 10,50 or lo:hi:n")
    add_options(parser)


def _suslov_parameters(options: argparse.Namespace) -> tuple[tuple[float, ...], BodyCheck]:
    from hess_mechanics import SuslovBody, check_body

    return SuslovBody(*options.I, *options.b).parameters, check_body(*options.I)


def _ball_parameters(options: argparse.Namespace) -> tuple[tuple[float, ...], BodyCheck]:
    from hess_mechanics import check_body

    return ball_of(options).parameters, check_body(*options.I)


def _hess_parameters(options: argparse.Namespace) -> tuple[tuple[float, ...], BodyCheck]:
    from hess_mechanics import HessBody

    # (a, b) do not fix the scale of the inertia, and whether a body has it does not depend on the scale: I22 = 1.
    return (options.a, options.b), HessBody(I22=1.0, I23=options.a, b3=0.0).check


def _heavy_parameters(options: argparse.Namespace) -> tuple[tuple[float, ...], BodyCheck]:
    from hess_mechanics.euler_poisson.equations import HeavyBody

    body = HeavyBody(options.A, options.r, options.mu)
    return body.parameters, body.check


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import level, solve, systems, unit_vector

        system = systems()[options.system]
        parameters, body = options.parameters(options)
        gamma, note = unit_vector(options.gamma)
        result = solve(system.at(parameters), (*options.omega, *gamma), options.t, level(options.accuracy))
    facts = {
        "variables": list(system.variables),
        **quality(result),
        **whether_body(body),
    }
    write(options, {"t": result.times.tolist(), "y": result.states.tolist()}, ("t", *system.variables), facts,
          notes=[*result.notes, *([note] if note else [])])
