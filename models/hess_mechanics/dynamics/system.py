"""Systems of equations of motion, and the registry of all systems.

Each system of this package is the `SYSTEM` of a module.  Its field and integrals are plain arithmetic, so that they
accept floats, arrays, symbols and multiple-precision numbers; its kernels are derived from the field.
"""

from __future__ import annotations

import importlib
import math
import pkgutil
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.metadata import entry_points
from threading import RLock
from types import ModuleType
from typing import Any, Protocol

import numpy as np

from hess_mechanics.errors import InvalidParameter, ModelError, WrongScaling
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.batch_kernels import ensemble_integrator, sequential_integrator
from hess_mechanics.numerics.double_double_kernels import double_double_integrator
from hess_mechanics.numerics.events_kernels import ANGLE, SurfaceKernels, crossing_finder, plane
from hess_mechanics.numerics.expressions import Node
from hess_mechanics.numerics.field_values import Undefined, values_at, values_with_rounding
from hess_mechanics.numerics.jit import derived_kernel, inner, with_compile_notice
from hess_mechanics.numerics.measured import perturb
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.results import Array
from hess_mechanics.numerics.step_kernels import LONGEST
from hess_mechanics.numerics.taylor_kernels import orbit_integrator
from hess_mechanics.numerics.tracing import Field, check, divergence, expressions, trace
from hess_mechanics.numerics.variation_kernels import Variation, products, variation, variation_integrator
from hess_mechanics.parameters import plain

__all__ = ["Body", "ParametrizedSystem", "Problem", "System", "declarations", "in_units_of_time", "systems"]


Integrals = Callable[[Sequence[Any], Sequence[Any]], Mapping[str, Any]]
Frequency = Callable[[Array, Array], Array | float]
Rescale = Callable[[Array, Array, float], tuple[Array, Array]]
Unit = Callable[[Array], float]
Tolerance = Callable[[Array, Array, int, float], float]
"""Functions of a system, see `System`."""
Kernel = Callable[..., Any]
"""A compiled function, see the module that makes it."""

_CANCELS = 64.0 * 2.0**-52
"""Round-off of a rate, relative to the state and the rates, above which a moved start does not show it."""
_SAMPLES = 8
"""Number of states at which the round-off of rates is measured."""
_DERIVING = RLock()
"""Lock around the derivation of kernels, so that threads compile each kernel once."""
_SEED, _CHECKS, _ROUNDING = 1, 4, 1e-9
"""Checks at random points: seed of the random numbers, number of draws, and largest relative difference."""
_COMPILE = 3.0, 0.2
"""Seconds that a kernel takes to compile, and those for each product in its source.  Measured on one core: 9 s for an
orbit in 30 variables with 32 products, 49 s for a spectrum with 213, 268 s for one with 1424."""


def in_units_of_time(first: int, velocities: int = 2) -> Rescale:
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


def _none(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    return {}


def _own_unit(y: Array, p: Array) -> Array | float:
    return np.ones(np.shape(y)[1:])


def _as_it_is(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
    return y.copy(), p.copy()


def _plain(p: Array) -> float:
    return 1.0


def _names(system: str, what: str, given: str | Iterable[str]) -> tuple[str, ...]:
    """Return the names in a text or a sequence.  Raises `InvalidParameter`."""
    parts = given.replace(",", " ").split() if isinstance(given, str) else given
    names = tuple(parts) if np.iterable(parts) else (parts,)
    if not all(isinstance(name, str) and name for name in names) or (what == "variables" and not names):
        raise InvalidParameter(f'{system}: `{what}` must be names, such as "x y" or ("x", "y").')
    return names


def _numbers(what: str, names: tuple[str, ...], values: Any) -> tuple[float, ...]:
    """Return one finite number for each name.  Raises `InvalidParameter`."""
    try:
        numbers = tuple(float(x) for x in (values if np.iterable(values) else (values,)))
    except (TypeError, ValueError, OverflowError):
        numbers = (math.nan,)
    if len(numbers) != len(names) or not all(map(math.isfinite, numbers)):
        raise InvalidParameter(f"{what} must be finite numbers, {len(names)} of them: {', '.join(names) or 'none'}.")
    return numbers


@dataclass(frozen=True, init=False, repr=False)
class System:
    """A system of differential equations ẏ = f(y, p).

    Name, field and variables are enough; all other parameters have defaults.

    Parameters
    ----------
    name : str
        Identifier.
    field : callable
        The rates field(y, p), in plain arithmetic on sequences; it is traced, see `numerics.tracing`.
    variables : str or sequence of str
        Names of the d components of y: a text such as "x y px py", or a sequence.
    parameters : str, sequence of str or mapping of str to float, default none
        Names of the q components of p.  A mapping also gives values, which become those of the example.
    example : (sequence of float, sequence of float) or sequence of float, optional
        A state and parameters to try, or the state alone.  By default 0.1, 0.2, … for the state; for the parameters the
        values of the mapping, or 1.
    title : str, optional
        Name in words.  By default the name.
    source : str, optional
        Equation numbers in the paper, or another citation.
    labels : sequence of str, optional
        Labels of these equations in the paper's LaTeX source.
    integrals : callable, optional
        First integrals by name, integrals(y, p), in plain arithmetic on sequences.
    frequency : callable, optional
        An upper bound ν on every |ω|, frequency(y, p), for y of shape (d,) or (d, n).  Orbits are integrated in units
        of time 1/ν.  Without it and `rescale`, the user's own units are used: choose them so that states are O(1).
    rescale : callable, optional
        States and parameters in units of time 1/ν, rescale(y, p, nu), for y of shape (d,) or (d, n).  It divides the
        leading variables by ν and `unit`, leaves the others, and scales p so that the motion stays the same.
    angular_velocities : int, default 0
        Number of leading variables that scale with 1/time, as angular velocities and momenta do.
    unit : callable, optional
        Scale unit(p) of the leading variables besides ν.  By default 1.
    tolerance : callable, optional
        Function tolerance(y, p, order, default) that replaces the tolerance `default` of a level for an orbit from y,
        if its series needs a smaller one.  It is compiled.
    angles : str or sequence of str, default none
        Names of variables that are angles in radians: the field is the same after a full turn, and sections count them
        up to full turns.

    Raises
    ------
    InvalidParameter
        If names, example, integrals or angles do not fit the field.
    NotTraceable
        If the field cannot be traced.
    WrongScaling
        If `rescale`, `frequency`, `angular_velocities` and `unit` do not fit the field.  This is checked at random
        points.

    Examples
    --------
    >>> from hess_mechanics import System, solve
    >>> lorenz = System(
    ...     "lorenz", lambda y, p: (p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]),
    ...     variables="x y z", parameters={"sigma": 10.0, "rho": 28.0, "beta": 8 / 3})
    >>> str(solve(lorenz.at(rho=24.0), (1.0, 1.0, 20.0), [1.0], "precise").status)
    'ok'
    """

    name: str
    field: Field
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    example: tuple[tuple[float, ...], tuple[float, ...]]
    title: str
    source: str
    labels: tuple[str, ...]
    integrals: Integrals
    frequency: Frequency
    rescale: Rescale
    angular_velocities: int
    unit: Unit
    tolerance: Tolerance | None
    angles: tuple[str, ...]

    def __init__(
        self,
        name: str,
        field: Field,
        variables: str | Sequence[str],
        parameters: str | Sequence[str] | Mapping[str, float] = (),
        example: Sequence[float] | tuple[Sequence[float], Sequence[float]] | None = None,
        title: str = "",
        source: str = "",
        labels: Sequence[str] = (),
        integrals: Integrals = _none,
        frequency: Frequency = _own_unit,
        rescale: Rescale = _as_it_is,
        angular_velocities: int = 0,
        unit: Unit = _plain,
        tolerance: Tolerance | None = None,
        angles: str | Sequence[str] = (),
    ) -> None:
        if not isinstance(name, str) or not name:
            raise InvalidParameter(f'{name!r} is not the name of a system: give a text such as "henon-heiles".')
        vars(self).update(
            name=name,
            title=title or name,
            field=field,
            variables=_names(name, "variables", variables),
            parameters=_names(name, "parameters", parameters),
            source=source,
            labels=_names(name, "labels", labels),
            integrals=integrals,
            frequency=frequency,
            rescale=rescale,
            angular_velocities=angular_velocities,
            unit=unit,
            tolerance=tolerance,
            angles=_names(name, "angles", angles),
        )
        values = tuple(parameters.values()) if isinstance(parameters, Mapping) else (1.0,) * len(self.parameters)
        vars(self).update(example=self._checked_example(example, values))
        self._check_field()
        self._check_scaling()
        self._check_angles()

    def __repr__(self) -> str:
        """Return the name; a field has no representation of its own."""
        return f"System({self.name!r})"

    def _checked_example(self, example: Any, values: Sequence[float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the example, completed by defaults.  Raises `InvalidParameter`."""
        pair = tuple((i + 1) / 10 for i in range(len(self.variables))) if example is None else example
        is_pair = isinstance(pair, Sequence) and len(pair) == 2 and np.iterable(pair[0])
        state, p = pair if is_pair else (pair, values)
        return (
            _numbers(f"{self.title}: the state of the example", self.variables, state),
            _numbers(f"{self.title}: the parameters", self.parameters, p),
        )

    def _check_field(self) -> None:
        """Check the names, the functions, and the integrals of the example.

        Raises `InvalidParameter`, or `NotTraceable` if the field cannot be traced.
        """
        if len({*self.variables, *self.parameters}) < len(self.variables) + len(self.parameters):
            raise InvalidParameter(
                f"{self.title}: a name occurs twice among variables and parameters: rename one of them."
            )
        for what in ("field", "integrals", "frequency", "rescale", "unit"):
            if not callable(getattr(self, what)):
                raise InvalidParameter(f"{self.title}: `{what}` must be a function, see the parameters of `System`.")
        check(self.field, len(self.variables), len(self.parameters))
        try:
            integrals = dict(self.integrals(*self.example))
        except (TypeError, ValueError, LookupError, ArithmeticError) as error:
            raise InvalidParameter(
                f'{self.title}: `integrals` must return first integrals by name, such as {{"E": …}}: {error}.'
            ) from error
        if not all(isinstance(key, str) and np.ndim(value) == 0 for key, value in integrals.items()):
            raise InvalidParameter(f"{self.title}: `integrals` must return one number for each name, for one state.")

    def _check_scaling(self) -> None:
        """Compare states and rates at random points before and after `rescale`.  Raises `WrongScaling`."""
        d = len(self.variables)
        if self.angular_velocities not in range(d + 1):
            raise WrongScaling(
                f"{self.title}: angular_velocities counts the leading variables that scale with 1/time, "
                f"so choose it from 0 to {d}."
            )
        given = self.frequency is not _own_unit, self.rescale is not _as_it_is
        if given[0] != given[1] or (self.angular_velocities and not given[1]):
            raise WrongScaling(
                f"{self.title}: `frequency` and `rescale` belong together, and `angular_velocities` to both: give "
                "`frequency` and `rescale`, or none of the three."
            )
        draw = np.random.default_rng(_SEED)
        state, parameters = (np.array(values, float) for values in self.example)
        for _ in range(_CHECKS):
            # Draw states near the example, where the equations are defined.  Use d + 1 of them, because a `rescale`
            # written for one state (d,) would accept d states (d, d).
            shape = state.size + 1, state.size
            states = state * draw.uniform(0.5, 2.0, shape) + draw.uniform(-0.5, 0.5, shape)
            p = np.where(parameters == 0.0, 1.0, parameters) * draw.uniform(0.5, 2.0, parameters.size)
            try:
                problem = Problem.of(self.at(p.tolist()), states)
            except ModelError:
                continue  # No motion is possible at this state.
            except ValueError as error:
                raise WrongScaling(
                    f"{self.title}: `rescale` and `frequency` take states (d,) and (d, n): {error}."
                ) from error
            for y, scaled in zip(states, problem.states, strict=True):
                self._compare(y, p, scaled, problem)

    def _check_angles(self) -> None:
        """Compare the rates at the example with those after full turns.  Raises `InvalidParameter`."""
        state, parameters = (np.array(values, float) for values in self.example)
        for name in self.angles:
            if name not in self.variables[self.angular_velocities :]:
                raise InvalidParameter(f"{self.title}: the angle {name} must be a variable that is not a velocity.")
            after = state + 2.0 * math.pi * (np.array(self.variables) == name)
            one, other = self._rates(state, parameters), self._rates(after, parameters)
            if not np.allclose(one, other, rtol=_ROUNDING, atol=_ROUNDING):
                raise InvalidParameter(f"{self.title}: {name} is not an angle: a full turn changes the field.")

    def _compare(self, y: Array, p: Array, scaled: Array, problem: Problem) -> None:
        expected = np.concatenate([y, self._rates(y, p)])
        rates = self._rates(scaled, problem.parameters)
        actual = np.concatenate([problem.scale * scaled, problem.scale * problem.nu * rates])
        names = [*self.variables, *(f"d{name}/dt" for name in self.variables)]
        for name, one, other in zip(names, expected, actual, strict=True):
            # Where a rate is NaN, the comparison is False and nothing is raised.
            if abs(one - other) > _ROUNDING * float(np.max(np.abs(expected))):
                leading = ", ".join(self.variables[: self.angular_velocities]) or "none"
                raise WrongScaling(
                    f"{self.title}: in units of time 1/ν, ν = {plain(problem.nu, 4)}, {name} becomes "
                    f"{plain(other, 4)} and should stay {plain(one, 4)}. Correct `rescale`, or `angular_velocities`, "
                    f"which counts the leading variables that scale with 1/time (now: {leading})."
                )

    def _rates(self, y: Array, p: Array) -> Array:
        """Return the field (d,) in floats; NaN where it is not finite, or everywhere if it raises an error."""
        try:
            with np.errstate(all="ignore"):
                rates = np.array(self.field(y.tolist(), p.tolist()), float)
        except (TypeError, ValueError, ArithmeticError, LookupError):
            return np.full(y.shape, math.nan)
        return np.where(np.isfinite(rates), rates, math.nan)

    def rates(self, states: Array, parameters: Sequence[float] | Array) -> Array:
        """Return the rates f(y, p) at states.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States.
        parameters : sequence of float, shape (q,)
            Values of the parameters.

        Returns
        -------
        ndarray, shape (n, d)
            The rates.
        """
        rates = np.empty(states.shape)
        for i, rate in enumerate(self.field(list(states.T), np.asarray(parameters).tolist())):
            # A rate may be a plain number instead of an expression.
            rates[:, i] = rate
        return rates

    @cached_property
    def recursion(self) -> Recursion:
        """Taylor recursion of the field.

        Raises
        ------
        NotTraceable
            If the field cannot be traced.
        """
        return trace(self.field, len(self.variables), len(self.parameters))

    def longest_step(self, level: Level, duration: float, max_step: float = math.inf) -> float:
        """Return the longest step of a run.

        Parameters
        ----------
        level : Level
            Level of the run, see `Level.longest_step`.
        duration : float
            Duration of the motion, of either sign, in units of 1/ν.
        max_step : float, default ∞
            A smaller limit, positive, in units of 1/ν.

        Returns
        -------
        float
            The longest step, positive, in units of 1/ν: at most `max_step` and |duration|, or a hundredth of |duration|
            for a field with functions.
        """
        part = LONGEST if self.recursion.functions else 1.0
        return level.longest_step(min(max_step, part * abs(duration)))

    @cached_property
    def expressions(self) -> list[Node]:
        """The rates of the variables, then those of the functions, as recorded expressions, see `field_values`."""
        return expressions(self.field, len(self.variables), len(self.parameters))

    def rates_with_rounding(self, y: Array, parameters: Array) -> tuple[Array, Array]:
        """Return the rates at a state with upper bounds on their round-off.

        Parameters
        ----------
        y : ndarray, shape (d,)
            The state.
        parameters : ndarray, shape (q,)
            Parameters of the system.

        Returns
        -------
        rates : ndarray, shape (d,)
            The rates.
        bounds : ndarray, shape (d,)
            Upper bounds on their round-off.

        Raises
        ------
        Undefined
            If an operation of the field has no finite result at the state.
        """
        names = self.variables, self.parameters
        pairs = values_with_rounding(self.expressions, names, y.tolist(), parameters.tolist())
        values, errors = np.array(pairs[: y.size]).T
        return values, errors

    def rounding(self, states: Array, parameters: Array) -> Array | None:
        """Return the mean round-off errors of the rates at states, without those that a perturbed start reveals.

        A rate that is the difference of much larger numbers is wrong by more than a rounding of itself or of the state.
        A system with `rescale` is integrated in units in which all terms are O(1), so none of its rates cancels.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States of a motion, of which a few are used.
        parameters : ndarray, shape (q,)
            Parameters of the system.

        Returns
        -------
        ndarray, shape (d,), or None
            Mean round-off of each rate; None if no rate cancels.
        """
        if self.rescale is not _as_it_is:
            return None
        sizes = [np.zeros(len(self.variables))]
        for y in states[:: max(1, len(states) // _SAMPLES)]:
            with suppress(Undefined):  # Skip a sample at a removable zero of a divisor.
                values, errors = self.rates_with_rounding(y, parameters)
                size = max(np.abs(y).max(), np.abs(values).max())
                sizes.append(np.where(errors > _CANCELS * size, errors, 0.0))
        mean = np.asarray(np.sum(sizes, axis=0) / max(1, len(sizes) - 1))
        return mean if mean.any() else None

    @cached_property
    def _divergence(self) -> Node:
        return divergence(self.field, len(self.variables), len(self.parameters))

    def divergence(self, states: Array, parameters: Sequence[float]) -> Array:
        """Return the divergence of the field, the relative growth rate of phase volume, in 1/T.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States.
        parameters : sequence of float, shape (q,)
            Values of the parameters.

        Returns
        -------
        ndarray, shape (n,)
            The divergence, exactly 0 where the derivatives of the field cancel.
        """
        return values_at(self._divergence, list(states.T), parameters)

    @cached_property
    def with_rounding(self) -> System:
        """The same system with a constant added to each rate, its round-off error, given by a further parameter.

        Its orbits show how much the round-off of the rates matters.
        """
        d, q = len(self.variables), len(self.parameters)
        return System(
            f"{self.name} with rounding",
            lambda y, p: tuple(rate + p[q + i] for i, rate in enumerate(self.field(y, p[:q]))),
            self.variables,
            (*self.parameters, *(f"rounding of d{name}/dt" for name in self.variables)),
            (self.example[0], (*self.example[1], *(0.0,) * d)),
        )

    @cached_property
    def orbit(self) -> Callable[..., tuple[int, float]]:
        """Kernel that integrates one orbit, see `taylor_kernels.orbit_integrator`."""
        return self._kernel("orbit", "y, p, times, order, tolerance, longest, max_steps, out", orbit_integrator)

    @cached_property
    def ensemble(self) -> Kernel:
        """Kernel that integrates many orbits, see `batch_kernels.ensemble_integrator`."""
        arguments = "states, p, times, order, tolerance, longest, max_steps, out, steps, ends"
        if self.recursion.is_quadratic and not self.recursion.functions and self.tolerance is None:
            return self._kernel("ensemble", arguments, ensemble_integrator)
        orbit = self.orbit
        return self._kernel("ensemble", arguments, lambda _: sequential_integrator(orbit), adjusts=False)

    @cached_property
    def crossing(self) -> Kernel:
        """Kernel that finds the crossings of a plane by one orbit, see `events_kernels.crossing_finder`."""
        return self.surface_kernel("cross", plane(len(self.variables)))

    @cached_property
    def angle_crossing(self) -> Kernel:
        """Kernel that finds where a variable equals a value up to full turns, see `events_kernels.ANGLE`."""
        return self.surface_kernel("angle_crossing", ANGLE)

    def surface_kernel(self, task: str, surface: SurfaceKernels) -> Kernel:
        """Return a kernel that finds the crossings of a surface by one orbit.

        Each call derives the kernel again.

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
            "y, p, normal, offset, sense, end, order, tolerance, longest, max_steps, times, states",
            lambda recursion: crossing_finder(recursion, surface),
        )

    @cached_property
    def double_double(self) -> Kernel:
        """Kernel that integrates one orbit with 31 digits, see `double_double_kernels.double_double_integrator`."""
        return self._kernel(
            "double_double",
            "state, start, p, scale, unit, times, max_steps, out",
            double_double_integrator,
            adjusts=False,
        )

    @cached_property
    def variation(self) -> Variation:
        """The field with its Jacobian.

        Raises
        ------
        NotTraceable
            If the field cannot be traced.
        """
        return variation(self.field, len(self.variables), len(self.parameters))

    @cached_property
    def full_variation(self) -> Kernel:
        """Kernel of one orbit with its full variational equations, see `variation_kernels.variation_integrator`."""
        return self._vary("vary", len(self.variables))

    @cached_property
    def transverse_variation(self) -> Kernel:
        """Kernel of one orbit with d − 1 columns of its variational equations, without the one along the motion."""
        return self._vary("transverse_variation", len(self.variables) - 1, ahead=True)

    @cached_property
    def tangent_variation(self) -> Kernel:
        """Kernel of one orbit with a single column of its variational equations."""
        return self._vary("tangent_variation", 1)

    def _vary(self, task: str, columns: int, ahead: bool = False) -> Kernel:
        return self._kernel(
            task,
            "y, frame, p, times, order, tolerance, max_steps, limit, states, frames, growth, divergence",
            lambda _: variation_integrator(self.variation, columns, ahead),
            products(self.variation, columns),
        )

    def _kernel(
        self,
        task: str,
        arguments: str,
        make: Callable[[Recursion], Kernel],
        written: int | None = None,
        adjusts: bool = True,
    ) -> Kernel:
        """Return the compiled `make(recursion)`; if `adjusts`, it applies the `tolerance` of the system first.

        written : number of products in the source, by default those of the recursion.
        """
        with _DERIVING:
            name = f"{re.sub(r'^(?=[0-9])|[^0-9A-Za-z]', '_', self.name)}_{task}"
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
            # Code run by `exec` without a `__name__` has no module.
            module = getattr(self.field, "__module__", None) or __name__
            compiled = derived_kernel(name, source, module, **names)
            # Kernels of this package are compiled at its first start, which has its own message.
            if module.startswith("hess_mechanics."):
                return compiled
            count = len(self.recursion.pairs) if written is None else written
            return with_compile_notice(compiled, f"the kernel {task} of {self.name}", _COMPILE[0] + _COMPILE[1] * count)

    def at(self, parameters: Sequence[float] | Array | None = None, **values: float) -> ParametrizedSystem:
        """Return the system with values of its parameters.

        Parameters
        ----------
        parameters : sequence of float, shape (q,), optional
            Values of the parameters.  By default those of the example.
        **values : float
            Values of single parameters by name, any finite numbers, which replace those of `parameters`.

        Returns
        -------
        ParametrizedSystem
            A `Body`.

        Raises
        ------
        InvalidParameter
            If there is no parameter of a name, or `parameters` are not q finite numbers.
        """
        what, names = f"{self.title}: the parameters", self.parameters
        given = _numbers(what, names, self.example[1] if parameters is None else parameters)
        for name in values:
            if name not in names:
                raise InvalidParameter(
                    f"{self.title} has no parameter {name}. Allowed names: {', '.join(names) or 'none'}."
                )
        return ParametrizedSystem(self, _numbers(what, names, (dict(zip(names, given, strict=True)) | values).values()))

    @property
    def example_motion(self) -> tuple[ParametrizedSystem, tuple[float, ...]]:
        """The example as a body and a state, the first two arguments of `solve`, `megno`, `tube` and others."""
        state, parameters = self.example
        return self.at(parameters), state

    @property
    def arguments(self) -> tuple[str, ...]:
        """Names of the variables with w for ω and g for γ, as commands and sweeps take them: w1 for ω1, g1 for γ1."""
        return tuple(name.replace("ω", "w").replace("γ", "g") for name in self.variables)


class Body(Protocol):
    """Interface of a moving body: equations of motion and values of their parameters.

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
def _modules() -> tuple[ModuleType, ...]:
    package = importlib.import_module("hess_mechanics")
    names = (module.name for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."))
    return tuple(importlib.import_module(name) for name in names)


def declarations(name: str) -> list[object]:
    """Return the objects that the modules of the package hold under a name.

    Parameters
    ----------
    name : str
        The name, such as "SYSTEM".

    Returns
    -------
    list of object
        One object for each module that has this name.
    """
    return [getattr(module, name) for module in _modules() if hasattr(module, name)]


@cache
def systems() -> dict[str, System]:
    """Return all systems of this package and of packages that extend it.

    Returns
    -------
    dict of str to System
        By name, the `SYSTEM` of every module that defines one, and the systems of other packages, which are entry
        points of the group `hess_mechanics.systems`.

    Raises
    ------
    InvalidParameter
        If an entry point is not a `System`, or the name of its system is taken.

    Examples
    --------
    >>> from hess_mechanics import systems
    >>> "suslov" in systems()
    True
    """
    known = {one.name: one for one in declarations("SYSTEM") if isinstance(one, System)}
    for brought in entry_points(group="hess_mechanics.systems"):
        system = brought.load()
        if not isinstance(system, System) or system.name in known:
            raise InvalidParameter(
                f"{brought.value} provides {system!r}: provide a System whose name no other system has."
            )
        known[system.name] = system
    return known


@dataclass(frozen=True)
class Problem:
    """Initial states of a system, in units in which they are O(1).

    Attributes
    ----------
    system : System
        The equations of motion.
    states : ndarray, shape (n, d)
        Initial states, in scaled units.
    parameters : ndarray, shape (q,)
        Parameters of the system, in scaled units.
    nu : float
        Angular velocity ν > 0, in 1/T; the scaled unit of time is 1/ν.
    scale : ndarray, shape (d,)
        Factors that convert scaled states to the user's units.
    """

    system: System
    states: Array
    parameters: Array
    nu: float
    scale: Array

    @classmethod
    def of(cls, body: Body, states: Sequence[Sequence[float] | Array] | Array) -> Problem:
        """Return the scaled problem of a body and initial states, which are validated.

        Parameters
        ----------
        body : Body
            The body.
        states : array_like, shape (n, d) or (d,)
            Initial states, or a single one, in the user's units.

        Returns
        -------
        Problem
            The scaled problem.

        Raises
        ------
        InvalidParameter
            If the body has no equations of motion, the states or parameters do not fit them, a number is not finite, or
            the scaled numbers overflow.
        """
        if not (isinstance(getattr(body, "system", None), System) and hasattr(body, "parameters")):
            raise InvalidParameter(
                f"{body!r:.80} is not a body with equations of motion: give a SuslovBody, a PlaneBody, a QuarticBody, "
                "a BallBody or a HeavyBody, or a System with its parameters, system.at(…)."
            )
        system = body.system
        given, p = np.array(states, float, ndmin=2), np.asarray(body.parameters, float)
        for shape, names in ((given.shape[1:], system.variables), (p.shape, system.parameters)):
            if shape != (len(names),):
                raise InvalidParameter(
                    f"{system.title}: the shape {shape} does not fit: give {len(names)} numbers, {', '.join(names)}."
                )
        if not (np.all(np.isfinite(given)) and np.all(np.isfinite(p))):
            raise InvalidParameter("A component of the state or a parameter is not finite: give finite numbers.")
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
        return cls(system, np.ascontiguousarray(scaled.T), p, nu, scale)

    def perturb(self) -> Problem:
        """Return the same problem with starts that differ by roundings, see `measured.perturb`.

        Returns
        -------
        Problem
            The other problem.
        """
        return replace(self, states=perturb(self.states))

    def with_rounding(self, motion: Array) -> Problem:
        """Return the problem with round-off errors added to its rates, if rates cancel along a motion.

        Parameters
        ----------
        motion : ndarray, shape (n, d)
            States of the motion, in scaled units.

        Returns
        -------
        Problem
            The other problem; the same one if no rate cancels.
        """
        rounding = self.system.rounding(motion, self.parameters)
        if rounding is None:
            return self
        return replace(self, system=self.system.with_rounding, parameters=np.concatenate((self.parameters, rounding)))

    def times(self, t: Array) -> Array:
        """Return times in units of 1/ν.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Times, in the user's unit.

        Returns
        -------
        ndarray, shape (m,)
            Scaled times; on overflow ∞, which no step limit reaches.
        """
        with np.errstate(over="ignore"):
            return t * self.nu
