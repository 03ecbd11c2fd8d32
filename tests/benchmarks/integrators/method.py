"""A method in the benchmark: one way to integrate the test problems, at settings from coarse to fine."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from typing import Protocol

from .works import Array, Workload

__all__ = [
    "OURS",
    "Ladder",
    "Method",
    "Prepare",
    "Run",
    "Setting",
    "half_decades",
    "named",
    "short",
    "version",
]

OURS = "Hess Explorer"
"""The method that the others are compared with."""

Setting = tuple[str | int | float, ...]
"""What distinguishes two runs of a method: names, orders, tolerances."""
Ladder = tuple[Setting, ...]
"""Settings from coarse to fine: each costs more than the one before."""
Run = Callable[[], Array]
"""Does the work again from its initial data; whatever does not depend on the data has been prepared."""


class Prepare(Protocol):
    """prepare(work, setting, threads) → run.  Compiles, so that no run does."""

    def __call__(self, work: Workload, setting: Setting, threads: int = 1) -> Run:
        """The prepared run."""


@dataclass(frozen=True)
class Method:
    """One participant.

    name, version : as they are shown; ladders(work) : its settings; prepare : see `Prepare`.
    without : the works it does not do, and why; threaded : the works for which `prepare` heeds `threads`.
    """

    name: str
    version: str
    ladders: Callable[[Workload], Sequence[Ladder]]
    prepare: Prepare
    without: Mapping[str, str] = field(default_factory=dict)
    threaded: frozenset[str] = frozenset()


def short(x: float) -> str:
    """Return a finite error or tolerance to two digits, as "3.2e-7" or "3e-6"."""
    # NumPy's own short form leaves the point of 3.04e-6 behind: "3.e-6".
    mantissa, _, exponent = f"{x:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def named(setting: Setting) -> str:
    """The setting as a text: "18, 1e-11"."""
    return ", ".join(short(part) if isinstance(part, float) else str(part) for part in setting)


def half_decades(coarsest: int, finest: int) -> tuple[float, ...]:
    """10^−coarsest, …, 10^−finest, two a decade."""
    return tuple(float(f"{10 ** (-k / 2):.1e}") for k in range(2 * coarsest, 2 * finest + 1))


def version(distribution: str) -> str:
    """The installed version, or that there is none."""
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return "from its source folder"
