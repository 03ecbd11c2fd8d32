"""Systems with a section: their options (body, integrals, a point of the section) and their return maps."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from hess_mechanics import HessBody, QuarticBody, ReturnMap, return_map
from hess_mechanics.parameters import B3, F_HEAVY, H_HEAVY, H_QUARTIC, TENSOR, E
from hess_mechanics.return_maps import SectionedBody

from .circle_map import TORUS
from .command import OUTPUT, Command, Option, Options, number, option, vector
from .motions import BALL, HEAVY, SUSLOV, ball_of, heavy_of, suslov_of
from .output import Answer, table

__all__ = ["command_of_sections"]


@dataclass(frozen=True)
class _System:
    """A system with a section.

    Attributes
    ----------
    purpose : short description; where : its section and the coordinates of a point, in words; place : names of these
    coordinates; options : its options; body : returns the body of the options; values : names of the options that
    determine the section; example : values of the options.
    """

    purpose: str
    where: tuple[str, str]
    place: str
    options: tuple[Option, ...]
    body: Callable[[Options], SectionedBody]
    values: tuple[str, ...]
    example: str


def _quartic(options: Options) -> QuarticBody:
    return QuarticBody(*(*options.I, options.b3, options.h))


def _hess(options: Options) -> HessBody:
    # I22 = 1, and b3 chosen so that b = 1.
    return HessBody(1.0, options.a, -math.hypot(1.0, options.a))


_SYSTEMS: Mapping[str, _System] = {
    "suslov": _System(
        "the Suslov problem with gravity",
        ("the section γ_k = 0 at the energy E", "(ψ, δ)"),
        "psi,delta",
        (
            *SUSLOV,
            number(E, help="energy"),
            option("--plane", "k of γ_k = 0 (default 3)", type=int, choices=(1, 2, 3), default=3),
        ),
        suslov_of,
        ("E", "plane"),
        "--I 1.5,1,0,0 --b 0.3,-0.5,1 --E 1.842",
    ),
    "quartic": _System(
        "the Suslov problem with b1 = b2 = 0, as a point in a quartic potential",
        ("the section along the axis of the accessible region", "(q, p)"),
        "q,p",
        (
            vector("--I", TENSOR[:2], "moments of inertia"),
            number(B3, help="field, not 0"),
            number(H_QUARTIC, help="energy, h > -|b3|"),
        ),
        _quartic,
        (),
        "--I 2,1 --b3 1 --h 0.8",
    ),
    "ball": _System(
        "the Chaplygin ball with Suslov's constraint, in a field",
        ("the section γ3 = 0 at the energy h", "(ψ, δ)"),
        "psi,delta",
        (*BALL, number(E, name="--h", help="energy")),
        ball_of,
        ("h",),
        "--I 1,3,0.2,-0.1 --D 5 --b 0.5,0.2,0.8 --h 2",
    ),
    "euler-poisson": _System(
        "a heavy body with a fixed point",
        ("the Andoyer–Deprit section g = π/2 at H = h, (M, γ) = f", "(l, L/G)"),
        "l,x",
        (
            *HEAVY,
            number(H_HEAVY, help="energy"),
            number(F_HEAVY, help="area integral (M, γ)"),
            option(
                "--sheet",
                "branch of the momentum G at this energy: 0 (default) the largest, 1 the second, 2 the third",
                type=int,
                choices=(0, 1, 2),
                default=0,
            ),
        ),
        heavy_of,
        ("h", "f", "sheet"),
        "--A 1,0.625,0.25 --r 0.6,0,0.8 --mu 1 --h 1.5 --f -0.7",
    ),
    "hess": _System(
        "the Suslov–Hess case, on a torus",
        (
            "the torus (h, f) of the Suslov–Hess case, units b = 1, at upward crossings of the midpoint of n3,",
            "φ, the angle of w",
        ),
        "phi",
        TORUS,
        _hess,
        ("h", "f"),
        "--a 0.7 --h 0.5 --f 0.6",
    ),
}


def command_of_sections(
    what: str,
    at: str,
    options: Sequence[Option],
    examples: Mapping[str, str],
    compute: Callable[[ReturnMap, Options], Answer],
    exclusive: Sequence[str] = (),
) -> Command:
    """Return a command with a subcommand for each system.

    Parameters
    ----------
    what : str
        Description, with the fields {section} and {place}.
    at : str
        Help text of the option --at, a point of the section.
    options : sequence of Option
        Further options, in addition to those of the system.
    examples : mapping
        Arguments of the example by system, after those of the body.
    compute : callable
        Returns the answer for a return map and the options.
    exclusive : sequence of str
        Names of mutually exclusive options.
    """

    def run(system: _System, options: Options) -> Answer:
        values = {name: getattr(options, name) for name in system.values}
        return compute(return_map(system.body(options), accuracy=options.accuracy, **values), options)

    return Command(
        systems={
            name: Command(
                what.format(section=of.where[0], place=of.where[1]),
                (*of.options, vector("--at", of.place, at), *options, *OUTPUT),
                table(partial(run, of)),
                f"{of.example} {examples[name]}",
                of.purpose,
                exclusive=exclusive,
            )
            for name, of in _SYSTEMS.items()
        }
    )
