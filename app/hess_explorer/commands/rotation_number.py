"""`hess-explorer rotation-number`: ρ of the Suslov–Hess torus over its parameters."""

from __future__ import annotations

import argparse

from . import CommandError
from .arguments import samples
from .output import add_options, computing, write

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "rotation-number", help="the rotation number of Suslov–Hess tori over a, h, f",
        description="Rotation number ρ (turns per return) and |trace| of the circle map for every combination of the "
                    "values of a, h and f, units b = 1; locked: whether it has two limit cycles; possible: whether "
                    "there is such a torus (else the other three are null, in CSV empty).",
        epilog="Example: hess-explorer rotation-number --a 0.5 --h -0.9:2:30 --f 0.6 --format csv")
    for name, help_ in (("a", "inertia parameter a = I23/I22"), ("h", "energy, h > -1"), ("f", "area integral")):
        parser.add_argument(f"--{name}", type=samples, required=True, metavar="VALUES",
                            help=f"{help_}: a number, a list 1,2,3 or lo:hi:n")
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        import numpy as np

        from hess_mechanics import level
        from hess_mechanics.suslov_hess.rotation_number import MAX_POINTS, values_at

        accuracy = level(options.accuracy)
        count = len(options.a) * len(options.h) * len(options.f)
        if count > MAX_POINTS:
            raise CommandError(f"These are {count} tori; at most {MAX_POINTS} are allowed: choose fewer values.")
        a, h, f = (axis.ravel() for axis in np.meshgrid(options.a, options.h, options.f, indexing="ij"))
        found = values_at(a, h, f, accuracy)
    possible = found.possible.tolist()
    values = {"rotation_number": found.rho, "trace": np.minimum(found.trace, 1e308), "locked": found.locked}
    series = {"a": a.tolist(), "h": h.tolist(), "f": f.tolist(),
              **{name: [value if there else None for value, there in zip(column.tolist(), possible, strict=True)]
                 for name, column in values.items()},
              "possible": possible}
    write(options, series, tuple(series), {"level": accuracy.name}, notes=())
