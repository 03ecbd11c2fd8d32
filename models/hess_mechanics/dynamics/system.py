"""What every system of equations offers, and the registry that finds them.

A system is one module of this package with a `SYSTEM`.  Its field and integrals are written in plain arithmetic, so
that floats, arrays, symbols and multiple-precision numbers all pass through them; its kernels are derived from the
field.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from threading import RLock
from typing import Any, Protocol

import numpy as np

from hess_mechanics.errors import InvalidParameter, ModelError, WrongScaling
from hess_mechanics.numerics.batch_kernels import ensemble_integrator, one_by_one
from hess_mechanics.numerics.doubled_kernels import doubled_integrator
from hess_mechanics.numerics.events_kernels import PLANE, SurfaceKernels, crossing_finder
from hess_mechanics.numerics.jit import derived_kernel, inner
from hess_mechanics.numerics.measured import nearby
from hess_mechanics.numerics.results import Array
from hess_mechanics.numerics.taylor_kernels import orbit_integrator
from hess_mechanics.numerics.tracing import Field, Recursion, trace
from hess_mechanics.numerics.variation_kernels import Variation, variation, variation_integrator

__all__ = ["Body", "ParametrizedSystem", "Problem", "System", "in_units_of_time", "systems"]


_DERIVING = RLock()
"""Threads that want the same kernel get the same one: it is compiled once."""
_SEED, _CHECKS, _ROUNDING = 1, 4, 1e-9
"""Of the check that a system scales: random parameters are drawn so many times, with some states each."""


def in_units_of_time(first: int, velocities: int = 2) -> Callable[[Array, Array, float], tuple[Array, Array]]:
    """`System.rescale` where y begins with so many velocities, and the parameters from `first` on are a field."""

    def rescale(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
        y, p = y.copy(), p.copy()
        y[:velocities] /= nu
        p[first:] /= nu * nu
        return y, p

    return rescale


@dataclass(frozen=True)
class System:
    """One system of differential equations ẏ = f(y, p).

    name, title : identifier and words.
    source, labels : the paper's equations: as numbered in print, and their labels in its LaTeX source.
    variables, parameters : the names of the components of y and p.
    angular_velocities : how many of the leading variables scale with 1/time, as angular velocities and momenta do; 0
        where none does.  Names say nothing about that.
    field(y, p), integrals(y, p) : plain arithmetic on sequences; the field is traced, see `numerics.tracing`.
    frequency(y, p) : a bound ν on every |ω|, of y (d,) or (d, n); time is measured in 1/ν when integrating.
    rescale(y, p, ν) : states (d,) or (d, n) and parameters in units of time 1/ν.  It divides the angular velocities by
        ν and `unit`, leaves the other variables, and scales the parameters so that the motion stays the same.
    example : a state and parameters to try.
    unit(p) : what the leading variables, angular velocities or momenta, are divided by besides ν.
    tolerance(y, p, order, asked) : the tolerance for an orbit from y, where its series needs a smaller one than was
        asked for.  It is compiled: numbers and arrays only.

    Raises
    ------
    WrongScaling : `rescale`, `angular_velocities` and `unit` do not fit the field; this is checked at random points.

    >>> from hess_mechanics import System, solve
    >>> from hess_mechanics.dynamics.system import in_units_of_time
    >>> pendulum = System(  # ẇ = −k sin θ, θ̇ = w, with s = sin θ, c = cos θ
    ...     name="pendulum", title="A pendulum", source="", labels=(), variables=("w", "s", "c"), parameters=("k",),
    ...     angular_velocities=1,
    ...     field=lambda y, p: (-p[0] * y[1], y[0] * y[2], -y[0] * y[1]),
    ...     integrals=lambda y, p: {"H": y[0] ** 2 / 2 - p[0] * y[2]},
    ...     frequency=lambda y, p: (y[0] ** 2 + 4 * p[0]) ** 0.5,
    ...     rescale=in_units_of_time(first=0, velocities=1),
    ...     example=((0.5, 0.0, 1.0), (9.81,)))
    >>> str(solve(*pendulum.example_motion, [1.0], "precise").status)
    'ok'
    """

    name: str
    title: str
    source: str
    labels: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    angular_velocities: int
    field: Field
    integrals: Callable[[Sequence[Any], Sequence[Any]], Mapping[str, Any]]
    frequency: Callable[[Array, Array], Array | float]
    rescale: Callable[[Array, Array, float], tuple[Array, Array]]
    example: tuple[tuple[float, ...], tuple[float, ...]]
    unit: Callable[[Array], float] = lambda p: 1.0
    tolerance: Callable[[Array, Array, int, float], float] | None = None

    def __post_init__(self) -> None:
        if not 0 <= self.angular_velocities <= len(self.variables):
            raise WrongScaling(
                f"{self.title}: angular_velocities counts the leading variables that scale with 1/time, "
                f"so it is from 0 to {len(self.variables)}."
            )
        self._check_scaling()

    def _check_scaling(self) -> None:
        """Compare states and rates at random points with those that `rescale` leads to.  Raises `WrongScaling`."""
        draw = np.random.default_rng(_SEED)
        state, parameters = (np.array(values, float) for values in self.example)
        for _ in range(_CHECKS):
            # Near the example, where the equations are defined, but with no component left at 0; and not as many as
            # there are variables, which a `rescale` of a single state would take for one.
            shape = state.size + 1, state.size
            states = state * draw.uniform(0.5, 2.0, shape) + draw.uniform(-0.5, 0.5, shape)
            p = np.where(parameters == 0.0, 1.0, parameters) * draw.uniform(0.5, 2.0, parameters.size)
            try:
                problem = Problem.of(self.at(p.tolist()), states)
            except ModelError:
                continue  # no motion there
            except ValueError as error:
                raise WrongScaling(
                    f"{self.title}: `rescale` and `frequency` take states (d,) and (d, n): {error}."
                ) from error
            for y, scaled in zip(states, problem.states, strict=True):
                self._compare(y, p, scaled, problem)

    def _compare(self, y: Array, p: Array, scaled: Array, problem: Problem) -> None:
        rates = self._rates(y, p), self._rates(scaled, problem.parameters)
        if rates[0] is None or rates[1] is None:
            return  # the trace of the field says what is wrong with it
        expected = np.concatenate([y, rates[0]])
        found = np.concatenate([problem.scale * scaled, problem.scale * problem.nu * rates[1]])
        names = [*self.variables, *(f"d{name}/dt" for name in self.variables)]
        for name, one, other in zip(names, expected, found, strict=True):
            if abs(one - other) > _ROUNDING * float(np.max(np.abs(expected))):
                leading = ", ".join(self.variables[: self.angular_velocities]) or "none"
                raise WrongScaling(
                    f"{self.title}: in units of time 1/ν, ν = {problem.nu:.4g}, {name} becomes "
                    f"{other:.4g} and should stay {one:.4g}. Correct `rescale`, or "
                    "`angular_velocities`, which counts the leading variables that scale with 1/time "
                    f"(now: {leading})."
                )

    def _rates(self, y: Array, p: Array) -> Array | None:
        """Return the field (d,) in floats; None where it has no d finite values."""
        try:
            with np.errstate(all="ignore"):
                found = np.array(self.field(y.tolist(), p.tolist()), float)
        except (TypeError, ValueError, ArithmeticError, LookupError):
            return None
        return found if found.shape == y.shape and np.all(np.isfinite(found)) else None

    @cached_property
    def recursion(self) -> Recursion:
        """The Taylor recursion of the field.  Raises `NotTraceable`."""
        return trace(self.field, len(self.variables), len(self.parameters))

    @cached_property
    def orbit(self) -> Callable[..., int]:
        """The kernel of one orbit, see `taylor_kernels.orbit_integrator`."""
        return self._kernel("orbit", "y, p, times, order, tolerance, max_steps, out", orbit_integrator)

    @cached_property
    def ensemble(self) -> Callable[..., int]:
        """The kernel of many orbits, see `batch_kernels.ensemble_integrator`."""
        if self.recursion.is_quadratic and self.tolerance is None:
            return self._kernel("ensemble", "states, p, times, order, tolerance, max_steps, out", ensemble_integrator)
        orbit = self.orbit
        return self._kernel(
            "ensemble", "states, p, times, order, tolerance, max_steps, out", lambda _: one_by_one(orbit), adjusts=False
        )

    @cached_property
    def cross(self) -> Callable[..., tuple[int, int]]:
        """The kernel of the crossings of a plane by one orbit, see `events_kernels.crossing_finder`."""
        return self.crosses("cross", PLANE)

    def crosses(self, task: str, surface: SurfaceKernels) -> Callable[..., tuple[int, int]]:
        """The same of another surface, made anew by each call; task : its name among the kernels of the system."""
        return self._kernel(
            task,
            "y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states",
            lambda recursion: crossing_finder(recursion, surface),
        )

    @cached_property
    def doubled(self) -> Callable[..., int]:
        """The kernel of one orbit with 31 digits, see `doubled_kernels.doubled_integrator`."""
        return self._kernel(
            "doubled", "state, start, p, scale, unit, times, max_steps, out", doubled_integrator, adjusts=False
        )

    @cached_property
    def variation(self) -> Variation:
        """The field with its Jacobian.  Raises `NotTraceable`."""
        return variation(self.field, len(self.variables), len(self.parameters))

    @cached_property
    def vary(self) -> Callable[..., int]:
        """The kernel of one orbit and all its neighbours, see `variation_kernels.variation_integrator`."""
        return self._vary("vary", len(self.variables))

    @cached_property
    def vary_others(self) -> Callable[..., int]:
        """The kernel of one orbit and all its neighbours but the one ahead of it, whose way is known."""
        return self._vary("vary_others", len(self.variables) - 1, ahead=True)

    @cached_property
    def vary_one(self) -> Callable[..., int]:
        """The kernel of one orbit and one neighbour."""
        return self._vary("vary_one", 1)

    def _vary(self, task: str, columns: int, ahead: bool = False) -> Callable[..., int]:
        return self._kernel(
            task,
            "y, frame, p, times, order, tolerance, max_steps, limit, states, frames, growth, divergence",
            lambda _: variation_integrator(self.variation, columns, ahead),
        )

    def _kernel(
        self, task: str, arguments: str, make: Callable[[Recursion], Callable[..., Any]], adjusts: bool = True
    ) -> Callable[..., Any]:
        """The compiled `make(recursion)`; adjusts : whether it has to ask for the tolerance of its orbit."""
        with _DERIVING:
            name = f"{re.sub(r'[^0-9A-Za-z]', '_', self.name)}_{task}"
            names = {"run": make(self.recursion)}
            passed = arguments
            if adjusts and self.tolerance is not None:
                names["adjusted"] = inner(self.tolerance)
                passed = arguments.replace("tolerance", "adjusted(y, p, order, tolerance)")
            # The comment tells one system's file from another's, and whoever reads it what is computed.
            derived = "".join(f"# {line}".rstrip() + "\n" for line in self.recursion.source.splitlines())
            source = (
                f"# The {task} of the system {self.name!r}, derived from its field.  The Taylor recursion:\n#\n"
                f"{derived}\n\ndef {name}({arguments}):\n    return run({passed})\n"
            )
            return derived_kernel(name, source, self.field.__module__, **names)

    def at(self, parameters: Sequence[float] | Array) -> ParametrizedSystem:
        """Return the system with these values of its parameters: a `Body`."""
        return ParametrizedSystem(self, tuple(parameters))

    @property
    def example_motion(self) -> tuple[ParametrizedSystem, tuple[float, ...]]:
        """The example as a body and a state, the first two arguments of `solve`, `megno`, `tube` …"""
        state, parameters = self.example
        return self.at(parameters), state

    @property
    def arguments(self) -> tuple[str, ...]:
        """The variables by names that are easily typed, as commands and sweeps take them: ω1 is w1, γ1 is g1."""
        return tuple(name.replace("ω", "w").replace("γ", "g") for name in self.variables)


class Body(Protocol):
    """Anything that moves: the equations of motion and the values of their parameters.

    >>> from hess_mechanics import SuslovBody
    >>> body = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)
    >>> body.system.title, len(body.parameters) == len(body.system.parameters)
    ('Suslov problem with gravity', True)
    """

    @property
    def system(self) -> System:
        """The equations of motion."""

    @property
    def parameters(self) -> tuple[float, ...]:
        """The values of their parameters."""

    def __hash__(self) -> int:
        """Bodies do not change, so they can be parts of cache keys."""
        return hash((self.system, self.parameters))


@dataclass(frozen=True)
class ParametrizedSystem:
    """A system with values of its parameters, as `System.at` makes it."""

    system: System
    parameters: tuple[float, ...]


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
    def of(cls, body: Body, states: Sequence[Sequence[float] | Array] | Array) -> Problem:
        """Check a body and states (n, d), and scale them.  Raises `InvalidParameter`."""
        if not (isinstance(getattr(body, "system", None), System) and hasattr(body, "parameters")):
            raise InvalidParameter(
                f"{body!r} is no body that moves: give a SuslovBody, a PlaneBody, a QuarticBody, "
                "a BallBody or a HeavyBody."
            )
        system = body.system
        try:
            given, p = np.array(states, float, ndmin=2), np.asarray(body.parameters, float)
        except (TypeError, ValueError):
            raise InvalidParameter(
                f"{system.title}: a state is {len(system.variables)} numbers, "
                f"{', '.join(system.variables)}; write them like 1.5 or -2e-3."
            ) from None
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
        with np.errstate(over="ignore"):
            scale[: system.angular_velocities] = nu * system.unit(p)
        with np.errstate(all="ignore"):
            scaled, p = system.rescale(given.T, p, nu)
        if not all(np.all(np.isfinite(one)) for one in (scaled, p, scale)):
            raise InvalidParameter(
                "In units in which the state is of size 1 these numbers leave the range of double "
                "precision: choose less extreme parameters."
            )
        return cls(np.ascontiguousarray(scaled.T), p, nu, scale)

    def nearby(self) -> Problem:
        """Return the same problem from starts that differ by roundings, see `measured.nearby`."""
        return replace(self, states=nearby(self.states))

    def times(self, t: Array) -> Array:
        """The times (m,) in units of 1/ν; ∞ where that leaves double range, which no budget of steps reaches."""
        with np.errstate(over="ignore"):
            return t * self.nu
