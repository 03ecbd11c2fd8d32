"""`hess-explorer lyapunov suslov|ball|euler-poisson`: the largest Lyapunov exponent of one motion, or all of them."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from .bodies import add_ball, add_end, add_heavy_body, add_start, add_suslov_body, ball_of
from .output import add_options, computing, quality, write

if TYPE_CHECKING:
    from hess_mechanics import System

__all__ = ["add"]

_SHOWN = 100
"""Running averages in the answer, evenly spread over the time."""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    lyapunov = commands.add_parser("lyapunov", help="the largest Lyapunov exponent of one motion, or all")
    systems = lyapunov.add_subparsers(required=True, metavar="SYSTEM")

    suslov = systems.add_parser(
        "suslov", help="the Suslov problem with gravity",
        description="Largest Lyapunov exponent of an orbit of the Suslov problem with gravity, and its running "
                    "averages.",
        epilog="Example: hess-explorer lyapunov suslov --I 1,2.5,0.6,0.6 --b=-1,-0.5,0.7 --omega 0.5,1.2 "
               "--gamma 0.6,0,0.8 --t 2000")
    add_suslov_body(suslov)
    add_start(suslov)
    _add_rest(suslov)
    suslov.set_defaults(run=_run, prepare=_suslov)

    ball = systems.add_parser(
        "ball", help="the Chaplygin ball with Suslov's constraint",
        description="Largest Lyapunov exponent of an orbit of the Chaplygin ball with Suslov's constraint (Îω̇ = (γ × "
                    "b + Iω × ω)₁₂, γ̇ = γ × ω), and its running averages, per unit of time.",
        epilog="Example: hess-explorer lyapunov ball --I 1,4,0,0 --D 2 --b 0.3,0,1 --omega 0.5,0.9 --gamma 0.6,0,0.8 "
               "--t 500")
    add_ball(ball)
    add_start(ball)
    _add_rest(ball)
    ball.set_defaults(run=_run, prepare=_ball)

    heavy = systems.add_parser(
        "euler-poisson", help="a heavy body with a fixed point",
        description="Largest Lyapunov exponent of an orbit of the Euler–Poisson equations, and its running averages.",
        epilog="Example: hess-explorer lyapunov euler-poisson --A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 "
               "--M 1.3,-2,0.7 --gamma 0.3,0.4,0.87 --t 200")
    add_heavy_body(heavy)
    add_start(heavy, "M1,M2,M3", option="--M", what="angular momentum")
    _add_rest(heavy)
    heavy.set_defaults(run=_run, prepare=_heavy)


def _add_rest(parser: argparse.ArgumentParser) -> None:
    add_end(parser, "time over which to average")
    parser.add_argument("--spectrum", action="store_true",
                        help="all exponents by the variational equations, with errors, the mean divergence and the "
                             "Kaplan–Yorke dimension")
    add_options(parser)


def _suslov(options: argparse.Namespace) -> tuple[str, tuple[float, ...], tuple[float, ...]]:
    from hess_mechanics import SuslovBody

    return "suslov", options.omega, SuslovBody(*options.I, *options.b).parameters


def _ball(options: argparse.Namespace) -> tuple[str, tuple[float, ...], tuple[float, ...]]:
    return "ball", options.omega, ball_of(options).parameters


def _heavy(options: argparse.Namespace) -> tuple[str, tuple[float, ...], tuple[float, ...]]:
    from hess_mechanics.euler_poisson.equations import HeavyBody

    return "euler-poisson", options.omega, HeavyBody(options.A, options.r, options.mu).parameters


def _run(options: argparse.Namespace) -> None:
    with computing():
        import numpy as np

        from hess_mechanics import systems, unit_vector
        from hess_mechanics.dynamics.lyapunov import lyapunov_exponent

        name, first, parameters = options.prepare(options)
        gamma, note = unit_vector(options.gamma)
        if options.spectrum:
            return _spectrum(options, systems()[name], (*first, *gamma), parameters, [note] if note else [])
        found = lyapunov_exponent(systems()[name].at(parameters), (*first, *gamma), options.t)
        kept = np.unique(np.linspace(0, found.times.size - 1, _SHOWN).astype(int))
    facts = {"exponent": found.value, "spread": found.spread}
    write(options, {"t": found.times[kept].tolist(), "average": found.rates[kept].tolist()}, ("t", "average"), facts,
          [note] if note else [])


def _spectrum(options: argparse.Namespace, system: System, state: tuple[float, ...], parameters: tuple[float, ...],
              notes: list[str]) -> None:
    from hess_mechanics import level, lyapunov_spectrum

    found = lyapunov_spectrum(system.at(parameters), state, options.t, level(options.accuracy))
    dimension, error = found.dimension
    forced = ("Volume is kept, and all but two exponents are those of integrals and the motion: they must be pairs."
              if found.pairs_forced else "No measure that is known forces them to be pairs.")
    columns = [f"average {i + 1}" for i in range(found.values.size)]
    write(options, {"t": found.times.tolist(), **dict(zip(columns, found.rates.T.tolist(), strict=True))},
          ("t", *columns),
          {"exponents": found.values.tolist(), "errors": found.errors.tolist(), "signs": list(found.signs),
           "sum": float(found.values.sum()), "divergence": found.divergence,
           "divergence_error": found.divergence_error, "dimension": dimension, "dimension_error": error,
           "paired": found.paired, "pairs_forced": found.pairs_forced, **quality(found)}, [*notes, forced])
