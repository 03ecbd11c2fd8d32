"""`hess-explorer lyapunov suslov|euler-poisson`: the largest Lyapunov exponent of one motion (S1, S11)."""

from __future__ import annotations

import argparse

from .arguments import number, vector
from .output import add_options, computing, write

__all__ = ["add"]

_SHOWN = 100
"""Of the running averages, evenly spread."""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    lyapunov = commands.add_parser("lyapunov", help="the largest Lyapunov exponent of one motion")
    systems = lyapunov.add_subparsers(required=True, metavar="SYSTEM")

    suslov = systems.add_parser(
        "suslov", help="the Suslov problem with gravity",
        description="Largest Lyapunov exponent of an orbit of the Suslov problem with gravity, and its running "
                    "averages.",
        epilog="Example: hess-explorer lyapunov suslov --I 1,2.5,0.6,0.6 --b=-1,-0.5,0.7 --omega 0.5,1.2 "
               "--gamma 0.6,0,0.8 --t 2000")
    suslov.add_argument("--I", type=vector("I11,I22,I13,I23"), required=True, metavar="I11,I22,I13,I23",
                        help="inertia tensor (I12 = 0)")
    suslov.add_argument("--b", type=vector("b1,b2,b3"), default=(0.0, 0.0, 0.0), metavar="b1,b2,b3",
                        help="field (default 0,0,0)")
    suslov.add_argument("--omega", type=vector("w1,w2"), required=True, metavar="w1,w2",
                        help="angular velocity at t = 0")
    _add_rest(suslov)
    suslov.set_defaults(run=_run, prepare=_suslov)

    heavy = systems.add_parser(
        "euler-poisson", help="a heavy body with a fixed point",
        description="Largest Lyapunov exponent of an orbit of the Euler–Poisson equations, and its running averages.",
        epilog="Example: hess-explorer lyapunov euler-poisson --A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 "
               "--M 1.3,-2,0.7 --gamma 0.3,0.4,0.87 --t 200")
    heavy.add_argument("--A", type=vector("a1,a2,a3"), required=True, metavar="a1,a2,a3",
                       help="inverses of the principal moments of inertia")
    heavy.add_argument("--r", type=vector("r1,r2,r3"), required=True, metavar="r1,r2,r3", help="centre of mass")
    heavy.add_argument("--mu", type=number, required=True, help="weight; the potential is −μ(r, γ)")
    heavy.add_argument("--M", type=vector("M1,M2,M3"), required=True, metavar="M1,M2,M3",
                       help="angular momentum at t = 0")
    _add_rest(heavy)
    heavy.set_defaults(run=_run, prepare=_heavy)


def _add_rest(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--gamma", type=vector("g1,g2,g3"), required=True, metavar="g1,g2,g3",
                        help="the vertical at t = 0; brought to length 1")
    parser.add_argument("--t", type=number, required=True, help="time of the average; backward where it is negative")
    add_options(parser)


def _suslov(options: argparse.Namespace) -> tuple[str, tuple[float, ...], tuple[float, ...]]:
    from models import SuslovBody

    return "suslov", options.omega, SuslovBody(*options.I, *options.b).parameters


def _heavy(options: argparse.Namespace) -> tuple[str, tuple[float, ...], tuple[float, ...]]:
    from models.euler_poisson import HeavyBody

    return "euler-poisson", options.M, HeavyBody(options.A, options.r, options.mu).parameters


def _run(options: argparse.Namespace) -> None:
    with computing():
        import numpy as np

        from models import systems, unit_vector
        from models.lyapunov import largest_exponent

        name, first, parameters = options.prepare(options)
        gamma, note = unit_vector(options.gamma)
        found = largest_exponent(systems()[name], (*first, *gamma), parameters, options.t)
        kept = np.unique(np.linspace(0, found.times.size - 1, _SHOWN).astype(int))
    facts = {"exponent": found.value, "spread": found.spread}
    write(options, {"t": found.times[kept].tolist(), "average": found.rates[kept].tolist()}, ("t", "average"), facts,
          [note] if note else [])
