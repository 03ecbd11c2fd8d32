"""Systems of equations of motion, and the registry of all systems.

A system is a module of this package with a `SYSTEM`.  Its field and integrals are plain arithmetic, so that they accept
floats, arrays, symbols and multiple-precision numbers; its kernels are derived from the field.
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
"""Lock around the derivation of kernels, so that threads compile each kernel once."""
_SEED, _CHECKS, _ROUNDING = 1, 4, 1e-9
"""The check of scaling: seed of the random numbers, draws of parameters, and relative rounding error."""


def in_units_of_time(first: int, velocities: int = 2) -> Callable[[Array, Array, float], tuple[Array, Array]]:
    """Return a `System.rescale` for a state that begins with velocities and parameters that end with a field.

    Parameters
    ----------
    first : int
        Index of the first parameter that belongs to the field, which scales with 1/time².
    velocities : int, default 2
        Number of leading variables that scale with 1/time.

    Returns
    -------
    callable
        The function rescale(y, p, nu).
    """

    def rescale(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
        y, p = y.copy(), p.copy()
        y[:velocities] /= nu
        p[first:] /= nu * nu
        return y, p

    return rescale


@dataclass(frozen=True)
class System:
    """A system of differential equations ẏ = f(y, p).

    Parameters
    ----------
    name : str
        Identifier.
    title : str
        Name in words.
    source : str
        Equation numbers in the paper.
    labels : tuple of str
        Labels of these equations in the paper's LaTeX source.
    variables : tuple of str
        Names of the d components of y.
    parameters : tuple of str
        Names of the q components of p.
    angular_velocities : int
        Number of leading variables that scale with 1/time, as angular velocities and momenta do.
    field : callable
        The rates field(y, p), in plain arithmetic on sequences; it is traced, see `numerics.tracing`.
    integrals : callable
        First integrals by name, integrals(y, p), in plain arithmetic on sequences.
    frequency : callable
        A bound ν of every |ω|, frequency(y, p), for y of shape (d,) or (d, n).  Orbits are integrated in units of time
        1/ν.
    rescale : callable
        States and parameters in units of time 1/ν, rescale(y, p, nu), for y of shape (d,) or (d, n).  It divides the
        leading variables by ν and `unit`, leaves the others, and scales p so that the motion stays the same.
    example : (tuple of float, tuple of float)
        A state and parameters to try.
    unit : callable, optional
        Scale unit(p) of the leading variables besides ν.  By default 1.
    tolerance : callable, optional
        Tolerance for an orbit from y whose series needs a smaller one, tolerance(y, p, order, asked).  It is compiled.

    Raises
    ------
    WrongScaling
        If `rescale`, `angular_velocities` and `unit` do not fit the field.  This is checked at random points.

    Examples
    --------
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
        """Compare states and rates at random points before and after `rescale`.  Raises `WrongScaling`."""
        draw = np.random.default_rng(_SEED)
        state, parameters = (np.array(values, float) for values in self.example)
        for _ in range(_CHECKS):
            # Near the example, where the equations are defined, with no component equal to 0; and d + 1 states, because
            # a `rescale` for a single state would mistake d states for one.
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
            return  # tracing the field reports the error
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
        """Return the field (d,) in floats; None if it does not have d finite values."""
        try:
            with np.errstate(all="ignore"):
                found = np.array(self.field(y.tolist(), p.tolist()), float)
        except (TypeError, ValueError, ArithmeticError, LookupError):
            return None
        return found if found.shape == y.shape and np.all(np.isfinite(found)) else None

    @cached_property
    def recursion(self) -> Recursion:
        """Taylor recursion of the field.  Raises `NotTraceable`."""
        return trace(self.field, len(self.variables), len(self.parameters))

    @cached_property
    def orbit(self) -> Callable[..., int]:
        """Kernel that integrates one orbit, see `taylor_kernels.orbit_integrator`."""
        return self._kernel("orbit", "y, p, times, order, tolerance, max_steps, out", orbit_integrator)

    @cached_property
    def ensemble(self) -> Callable[..., int]:
        """Kernel that integrates many orbits, see `batch_kernels.ensemble_integrator`."""
        if self.recursion.is_quadratic and self.tolerance is None:
            return self._kernel("ensemble", "states, p, times, order, tolerance, max_steps, out", ensemble_integrator)
        orbit = self.orbit
        return self._kernel(
            "ensemble", "states, p, times, order, tolerance, max_steps, out", lambda _: one_by_one(orbit), adjusts=False
        )

    @cached_property
    def cross(self) -> Callable[..., tuple[int, int]]:
        """Kernel that finds the crossings of a plane by one orbit, see `events_kernels.crossing_finder`."""
        return self.crosses("cross", PLANE)

    def crosses(self, task: str, surface: SurfaceKernels) -> Callable[..., tuple[int, int]]:
        """Return a kernel that finds the crossings of a surface by one orbit.

        Each call derives the kernel anew.

        Parameters
        ----------
        task : str
            Name of the kernel among the kernels of this system.
        surface : SurfaceKernels
            Compiled functions of the surface.

        Returns
        -------
        callable
            The kernel, see `events_kernels.crossing_finder`.
        """
        return self._kernel(
            task,
            "y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states",
            lambda recursion: crossing_finder(recursion, surface),
        )

    @cached_property
    def doubled(self) -> Callable[..., int]:
        """Kernel that integrates one orbit with 31 digits, see `doubled_kernels.doubled_integrator`."""
        return self._kernel(
            "doubled", "state, start, p, scale, unit, times, max_steps, out", doubled_integrator, adjusts=False
        )

    @cached_property
    def variation(self) -> Variation:
        """The field with its Jacobian.  Raises `NotTraceable`."""
        return variation(self.field, len(self.variables), len(self.parameters))

    @cached_property
    def vary(self) -> Callable[..., int]:
        """Kernel of one orbit with its full variational equations, see `variation_kernels.variation_integrator`."""
        return self._vary("vary", len(self.variables))

    @cached_property
    def vary_others(self) -> Callable[..., int]:
        """Kernel of one orbit with its variational equations, without the column along the motion."""
        return self._vary("vary_others", len(self.variables) - 1, ahead=True)

    @cached_property
    def vary_one(self) -> Callable[..., int]:
        """Kernel of one orbit with a single column of its variational equations."""
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
        """Return the compiled `make(recursion)`; if `adjusts`, it applies the `tolerance` of the system first."""
        with _DERIVING:
            name = f"{re.sub(r'[^0-9A-Za-z]', '_', self.name)}_{task}"
            names = {"run": make(self.recursion)}
            passed = arguments
            if adjusts and self.tolerance is not None:
                names["adjusted"] = inner(self.tolerance)
                passed = arguments.replace("tolerance", "adjusted(y, p, order, tolerance)")
            # The comment makes the file unique to this system, and documents it.
            derived = "".join(f"# {line}".rstrip() + "\n" for line in self.recursion.source.splitlines())
            source = (
                f"# The {task} of the system {self.name!r}, derived from its field.  The Taylor recursion:\n#\n"
                f"{derived}\n\ndef {name}({arguments}):\n    return run({passed})\n"
            )
            return derived_kernel(name, source, self.field.__module__, **names)

    def at(self, parameters: Sequence[float] | Array) -> ParametrizedSystem:
        """Return the system with values of its parameters.

        Parameters
        ----------
        parameters : sequence of float, shape (q,)
            Values of the parameters.

        Returns
        -------
        ParametrizedSystem
            A `Body`.
        """
        return ParametrizedSystem(self, tuple(parameters))

    @property
    def example_motion(self) -> tuple[ParametrizedSystem, tuple[float, ...]]:
        """The example as a body and a state, the first two arguments of `solve`, `megno`, `tube` and others."""
        state, parameters = self.example
        return self.at(parameters), state

    @property
    def arguments(self) -> tuple[str, ...]:
        """Names of the variables in ASCII, as commands and sweeps take them: w1 for ω1, g1 for γ1."""
        return tuple(name.replace("ω", "w").replace("γ", "g") for name in self.variables)


class Body(Protocol):
    """Interface of anything that moves: equations of motion and values of their parameters.

    Examples
    --------
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
        """Values of the parameters of the equations, in their order."""

    def __hash__(self) -> int:
        """Return a hash: bodies are immutable, so they can be parts of cache keys."""
        return hash((self.system, self.parameters))


@dataclass(frozen=True)
class ParametrizedSystem:
    """A system with values of its parameters, as returned by `System.at`.

    Parameters
    ----------
    system : System
        The equations of motion.
    parameters : tuple of float, shape (q,)
        Values of the parameters.
    """

    system: System
    parameters: tuple[float, ...]


@cache
def systems() -> dict[str, System]:
    """Return all systems of the package.

    Returns
    -------
    dict of str to System
        The `SYSTEM` of every module that defines one, by name.

    Examples
    --------
    >>> from hess_mechanics import systems
    >>> "suslov" in systems()
    True
    """
    package = importlib.import_module("hess_mechanics")
    found = {}
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        system = getattr(importlib.import_module(module.name), "SYSTEM", None)
        if isinstance(system, System):
            found[system.name] = system
    return found


@dataclass(frozen=True)
class Problem:
    """Initial states of a system, in units in which they are O(1).

    Attributes
    ----------
    states : ndarray, shape (n, d)
        Initial states.
    parameters : ndarray, shape (q,)
        Parameters of the system.
    nu : float
        The unit of time is 1/ν.
    scale : ndarray, shape (d,)
        Factors that turn these states into the user's units.
    """

    states: Array
    parameters: Array
    nu: float
    scale: Array

    @classmethod
    def of(cls, body: Body, states: Sequence[Sequence[float] | Array] | Array) -> Problem:
        """Validate a body and states (n, d), and scale them.  Raises `InvalidParameter`."""
        if not (isinstance(getattr(body, "system", None), System) and hasattr(body, "parameters")):
            raise InvalidParameter(
                f"{body!r} is not a body with equations of motion: give a SuslovBody, a PlaneBody, a QuarticBody, "
                "a BallBody or a HeavyBody."
            )
        system = body.system
        try:
            given, p = np.array(states, float, ndmin=2), np.asarray(body.parameters, float)
        except (TypeError, ValueError):
            raise InvalidParameter(
                f"{system.title}: a state consists of {len(system.variables)} numbers, "
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
                "In units in which the state is of size 1 these numbers exceed the range of double "
                "precision: choose less extreme parameters."
            )
        return cls(np.ascontiguousarray(scaled.T), p, nu, scale)

    def nearby(self) -> Problem:
        """Return the same problem with starts that differ by roundings, see `measured.nearby`."""
        return replace(self, states=nearby(self.states))

    def times(self, t: Array) -> Array:
        """Return the times (m,) in units of 1/ν; on overflow ∞, which no step limit reaches."""
        with np.errstate(over="ignore"):
            return t * self.nu
