"""The systems with a section, as options: a body, the values of its integrals, a place; and the return map of these."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .arguments import number, vector
from .bodies import add_ball, add_heavy_body, add_suslov_body, ball_of

if TYPE_CHECKING:
    from hess_mechanics import ReturnMap

__all__ = ["add_systems"]

Options = argparse.Namespace


@dataclass(frozen=True)
class _System:
    """One system.

    where : its section, in words, and its place; place : as options name it; add, made : its options, and their map.
    example : values of them.
    """

    help: str
    where: tuple[str, str]
    place: str
    add: Callable[[argparse.ArgumentParser], None]
    made: Callable[[Options], ReturnMap]
    example: str


def _add_suslov(parser: argparse.ArgumentParser) -> None:
    add_suslov_body(parser)
    parser.add_argument("--E", type=number, required=True, help="energy")
    parser.add_argument("--plane", type=int, choices=(1, 2, 3), default=3, help="k of γ_k = 0 (default 3)")


def _suslov(options: Options) -> ReturnMap:
    from hess_mechanics import SuslovBody, return_map

    return return_map(SuslovBody(*options.I, *options.b), E=options.E, plane=options.plane, accuracy=options.accuracy)


def _add_quartic(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--I", type=vector("I11,I22"), required=True, metavar="I11,I22", help="moments of inertia")
    parser.add_argument("--b3", type=number, required=True, help="field, not 0")
    parser.add_argument("--h", type=number, required=True, help="energy, h > -|b3|")


def _quartic(options: Options) -> ReturnMap:
    from hess_mechanics import QuarticBody, return_map

    I11, I22 = options.I
    return return_map(QuarticBody(I11, I22, options.b3, options.h), accuracy=options.accuracy)


def _add_ball(parser: argparse.ArgumentParser) -> None:
    add_ball(parser)
    parser.add_argument("--h", type=number, required=True, help="energy")


def _ball(options: Options) -> ReturnMap:
    from hess_mechanics import return_map

    return return_map(ball_of(options), h=options.h, accuracy=options.accuracy)


def _add_heavy(parser: argparse.ArgumentParser) -> None:
    add_heavy_body(parser)
    parser.add_argument("--h", type=number, required=True, help="energy")
    parser.add_argument("--f", type=number, required=True, help="area integral (M, γ)")
    parser.add_argument("--sheet", type=int, choices=(0, 1, 2), default=0,
                        help="of the momenta G with this energy, 0 (default): the largest, 1: the second, 2: the third")


def _heavy(options: Options) -> ReturnMap:
    from hess_mechanics import HeavyBody, return_map

    return return_map(HeavyBody(options.A, options.r, options.mu), h=options.h, f=options.f, sheet=options.sheet,
                      accuracy=options.accuracy)


def _add_hess(parser: argparse.ArgumentParser) -> None:
    for name, help_ in (("a", "inertia parameter a = I23/I22"), ("h", "energy, h > -1"), ("f", "area integral")):
        parser.add_argument(f"--{name}", type=number, required=True, help=help_)


def _hess(options: Options) -> ReturnMap:
    from hess_mechanics import HessBody, return_map

    # I22 = 1, and b3 such that b = 1.
    return return_map(HessBody(1.0, options.a, -math.hypot(1.0, options.a)), h=options.h, f=options.f,
                      accuracy=options.accuracy)


_SYSTEMS: Mapping[str, _System] = {
    "suslov": _System("the Suslov problem with gravity", ("the section γ_k = 0 at the energy E", "(ψ, δ)"), "psi,delta",
                      _add_suslov, _suslov, "--I 1.5,1,0,0 --b 0.3,-0.5,1 --E 1.842"),
    "quartic": _System("the Suslov problem with b1 = b2 = 0, as a point in a quartic potential",
                       ("the section along the axis of the region that a point may enter", "(q, p)"), "q,p",
                       _add_quartic, _quartic, "--I 2,1 --b3 1 --h 0.8"),
    "ball": _System("the Chaplygin ball with Suslov's constraint, in a field",
                    ("the section γ3 = 0 at the energy h", "(ψ, δ)"), "psi,delta", _add_ball, _ball,
                    "--I 1,3,0.2,-0.1 --D 5 --b 0.5,0.2,0.8 --h 2"),
    "euler-poisson": _System("a heavy body with a fixed point",
                             ("the Andoyer–Deprit section g = π/2 at H = h, (M, γ) = f", "(l, L/G)"), "l,x",
                             _add_heavy, _heavy, "--A 1,0.625,0.25 --r 0.6,0,0.8 --mu 1 --h 1.5 --f -0.7"),
    "hess": _System("the Suslov–Hess case, on a torus",
                    ("the torus (h, f) of the Suslov–Hess case, units b = 1, where n3 rises through the middle of its "
                     "range,", "φ, the angle of w"), "phi", _add_hess, _hess, "--a 0.7 --h 0.5 --f 0.6"),
}


def add_systems(parser: argparse.ArgumentParser, what: str, examples: Mapping[str, str],
                rest: Callable[[argparse.ArgumentParser, str], None], run: Callable[[Options], None]) -> None:
    """A command for each system, which has `options.prepare(options)`, its return map.

    what : the description, with {section} and {place}; examples : what follows the body in the example of each;
    rest : adds the other options, of a place with these coordinates.
    """
    systems = parser.add_subparsers(required=True, metavar="SYSTEM")
    for name, of in _SYSTEMS.items():
        section, place = of.where
        added = systems.add_parser(
            name, help=of.help, description=what.format(section=section, place=place),
            epilog=f"Example: hess-explorer {parser.prog.split()[-1]} {name} {of.example} {examples[name]}")
        of.add(added)
        rest(added, of.place)
        added.set_defaults(run=run, prepare=of.made)
