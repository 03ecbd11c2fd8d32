"""A method in the benchmark: one way to integrate the test problems, at settings from coarse to fine."""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata

OURS = "Hess Explorer"
"""The method that the others are compared with."""


@dataclass(frozen=True)
class Method:
    """One participant.

    name, version : as they are shown.
    ladders(work) : settings (names, orders, tolerances) from coarse to fine, each of which costs more than the last.
    prepare(work, setting) : compile, and return the run, which does the work from its initial data.
    """

    name: str
    version: str
    ladders: Callable
    prepare: Callable


def short(x):
    """Return a finite error or tolerance to two digits, as "3.2e-7" or "3e-6"."""
    # NumPy's own short form leaves the point of 3.04e-6 behind: "3.e-6".
    mantissa, _, exponent = f"{x:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def named(setting):
    """The setting as a text: "18, 1e-11"."""
    return ", ".join(short(part) if isinstance(part, float) else str(part) for part in setting)


def half_decades(coarsest, finest):
    """10^−coarsest, …, 10^−finest, two a decade."""
    return tuple(float(f"{10 ** (-k / 2):.1e}") for k in range(2 * coarsest, 2 * finest + 1))


def version(distribution):
    """The installed version, or that there is none."""
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return "from its source folder"
