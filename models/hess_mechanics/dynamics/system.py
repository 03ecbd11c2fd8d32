"""What every system of equations offers, and the registry that finds them.

A system is one module of this package with a `SYSTEM`.  Its field and integrals are written
in plain arithmetic, so that floats, arrays, symbols and multiple-precision numbers all pass
through them; its kernels are compiled from the same field as a `Quadratic`.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["Problem", "System", "systems"]


@dataclass(frozen=True)
class System:
    """One system of differential equations ẏ = f(y, p).

    name, title : identifier and words; labels : the paper's equations.
    variables, parameters : the names of the components of y and p.
    field(y, p), integrals(y, p) : plain arithmetic on sequences.
    frequency(y, p) : a bound ν on every |ω|, of y (d,) or (d, n); time is measured in 1/ν when integrating.
    rescale(y, p, ν) : states (d,) or (d, n) and parameters in units of time 1/ν.
    unit(p) : what the leading variables, angular velocities or momenta, are divided by besides ν.
    orbit, ensemble, cross : the compiled kernels, see `taylor.orbit_integrator`,
        `lanes.ensemble_integrator`, `crossings.crossing_finder`.
    example : a state and parameters to try.
    """

    name: str
    title: str
    labels: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    field: Callable[[Sequence[Any], Sequence[Any]], tuple[Any, ...]]
    integrals: Callable[[Sequence[Any], Sequence[Any]], Mapping[str, Any]]
    frequency: Callable[[Array, Array], Array | float]
    rescale: Callable[[Array, Array, float], tuple[Array, Array]]
    orbit: Callable[..., int]
    ensemble: Callable[..., int]
    cross: Callable[..., tuple[int, int]]
    example: tuple[tuple[float, ...], tuple[float, ...]]
    unit: Callable[[Array], float] = lambda p: 1.0

    @property
    def angular_velocities(self) -> int:
        """How many leading variables are angular velocities or momenta, and scale with 1/time."""
        return sum(name.startswith(("ω", "w", "M")) for name in self.variables)


@cache
def systems() -> dict[str, System]:
    """Every module of `hess_mechanics` that defines a `SYSTEM`, by name."""
    package = importlib.import_module("hess_mechanics")
    found = {}
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        system = getattr(importlib.import_module(module.name), "SYSTEM", None)
        if isinstance(system, System):
            found[system.name] = system
    return found


@dataclass(frozen=True)
class Problem:
    """Initial states of a system in units in which they are O(1).

    states : (n, d); parameters : (q,); nu : the unit of time is 1/ν; scale : (d,), what the states are
    to be multiplied with to be in the user's units.
    """

    states: Array
    parameters: Array
    nu: float
    scale: Array

    @classmethod
    def of(cls, system: System, states: Sequence[Sequence[float]] | Array, parameters: Sequence[float]) -> Problem:
        """Check states (n, d) and parameters and scale them.  Raises `InvalidParameter`."""
        given, p = np.array(states, float, ndmin=2), np.asarray(parameters, float)
        for shape, names in ((given.shape[1:], system.variables), (p.shape, system.parameters)):
            if shape != (len(names),):
                raise InvalidParameter(f"{system.title} takes {len(names)} numbers here: {', '.join(names)}.")
        if not (np.all(np.isfinite(given)) and np.all(np.isfinite(p))):
            raise InvalidParameter("Every component of the state and every parameter must be a finite number.")
        with np.errstate(over="ignore"):
            nu = float(np.max(system.frequency(given.T, p), initial=0.0)) or 1.0
        if not np.isfinite(nu):
            raise InvalidParameter("The motion is too fast for double precision: choose less extreme parameters.")
        scale = np.ones(len(system.variables))
        scale[: system.angular_velocities] = nu * system.unit(p)
        states, parameters = system.rescale(given.T, p, nu)
        return cls(np.ascontiguousarray(states.T), parameters, nu, scale)

    def times(self, t: Array) -> Array:
        """The times (m,) in units of 1/ν; ∞ where that leaves double range, which no budget of steps reaches."""
        with np.errstate(over="ignore"):
            return t * self.nu
