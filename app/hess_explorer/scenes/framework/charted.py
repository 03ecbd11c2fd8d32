"""Numbers of the catalogue for the charts of a scene, with their arguments in a state."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hess_explorer.compute.cells import evaluate
from hess_mechanics import catalogue
from hess_mechanics.catalogue import Computation
from hess_mechanics.dynamics.system import Body, System
from hess_mechanics.numerics.accuracy import DRAFT

Arguments = Mapping[str, float]
Numbers = Mapping[str, tuple["ChartSource", str]]
"""Source and name of each number, by the option of the menu."""


@dataclass(frozen=True, eq=False)
class ChartSource:
    """A computation whose numbers can be charted.

    Attributes
    ----------
    key : str
        Key of the computation.
    arguments : callable
        `arguments(state)` returns the arguments that differ from the defaults; it may raise `ModelError`.
    computations : mapping of str to Computation
        The computations by key; empty for those of the catalogue.
    """

    key: str
    arguments: Callable[[Any], Arguments]
    computations: Mapping[str, Computation] = field(default_factory=dict)

    @property
    def computation(self) -> Computation:
        """The computation."""
        return (self.computations or catalogue.catalogue())[self.key]

    def values(self, state: Any) -> Mapping[str, Any]:
        """Return all arguments in a state.  Raises `ModelError`, also if an argument is out of range."""
        return self.computation.values(self.arguments(state))


@dataclass(frozen=True)
class Charts:
    """The numbers of a chart, and its initial sides.

    Attributes
    ----------
    sources : tuple of ChartSource
        The computations.
    over : (str, str)
        The initial horizontal and vertical side: names of parameters, or symbols of parameters or coordinates.
    point : (str, (str, str))
        Name of a parameter with points, and the symbols of their coordinates, which are possible sides; by default
        none.
    """

    sources: tuple[ChartSource, ...]
    over: tuple[str, str]
    point: tuple[str, tuple[str, str]] = ("", ("", ""))

    @property
    def numbers(self) -> Numbers:
        """The numbers of all computations by name; of numbers with the same name, the last."""
        return {name: (one, name) for one in self.sources for name in one.computation.numbers}

    def load(self, state: Any) -> None:
        """Compute every number once to compile or load its kernels.  Raises `ModelError`."""
        for one in self.sources:
            columns = {name: np.array([value]) for name, value in one.values(state).items()}
            evaluate(one.computation, (*one.computation.numbers,), columns, DRAFT)


def torus_charts(torus: Callable[[Any], tuple[float, float, float]]) -> tuple[ChartSource, ...]:
    """Return the charted computations of a Suslov–Hess torus; `torus(state)` returns (a, h, f) in units b = 1."""
    return (
        ChartSource("circle-map", lambda s: dict(zip("ahf", torus(s), strict=True))),
        ChartSource("critical-a", lambda s: dict(zip("hf", torus(s)[1:], strict=True))),
    )


def tensor_of(body: Any) -> Arguments:
    """Return the inertia tensor of a body as arguments I11, I22, I13 and I23."""
    return {name: getattr(body, name) for name in ("I11", "I22", "I13", "I23")}


def parameters_of(body: Body) -> Arguments:
    """Return the parameters of a body by name."""
    return dict(zip(body.system.parameters, body.parameters, strict=True))


def motion_charts(
    system: System,
    start: Callable[[Any], tuple[float, ...]],
    time: Callable[[Any], float] | None = None,
    computations: Mapping[str, Computation] | None = None,
) -> tuple[ChartSource, ...]:
    """Return the chart sources of MEGNO, Lyapunov exponents and crossings of the current motion of a system.

    Parameters
    ----------
    system : System
        The system; the property `body` of the scene's states is a body of it.
    start : callable
        `start(state)` returns the initial state (d,); it may raise `ModelError`.
    time : callable, optional
        `time(state)` returns the averaging time of the exponents; by default that of the computations.
    computations : mapping of str to Computation, optional
        The computations by key; by default the catalogue.
    """
    computations = computations or {}

    def motion(s: Any) -> Arguments:
        return {**parameters_of(s.body), **dict(zip(system.arguments, start(s), strict=True))}

    def averaged(s: Any) -> Arguments:
        return motion(s) if time is None else {**motion(s), "duration": time(s)}

    return (
        ChartSource(f"megno {system.name}", motion, computations),
        ChartSource(f"lyapunov {system.name}", averaged, computations),
        ChartSource(f"spectrum {system.name}", averaged, computations),
        ChartSource(f"crossings {system.name}", motion, computations),
    )
