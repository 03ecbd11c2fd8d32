"""What every system of equations offers, and the registry that finds them.

A system is one module of this package with a `SYSTEM`.  Its field and integrals are written
in plain arithmetic, so that floats, arrays, symbols and multiple-precision numbers all pass
through them; its kernel is the compiled Taylor series of the same field.
"""

from __future__ import annotations

import importlib
import pkgutil
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from .accuracy import Level, Status
from .errors import InvalidParameter, WorkLimit
from .results import Array, Cost, Orbit, frozen
from .taylor import STEP_LIMIT_REACHED

__all__ = ["MAX_SAMPLES", "MAX_STEPS", "System", "solve", "systems"]

MAX_STEPS = 1_000_000
MAX_SAMPLES = 200_000


@dataclass(frozen=True)
class System:
    """One system of differential equations ẏ = f(y, p).

    name, title : identifier and words; labels : the paper's equations.
    variables, parameters : the names of the components of y and p.
    field(y, p), integrals(y, p) : plain arithmetic on sequences.
    frequency(y, p) : a bound ν on every |ω|; time is measured in 1/ν when integrating.
    rescale(y, p, ν) : state and parameters in units of time 1/ν.
    kernel(y, p, times, order, tolerance, max_steps, out) → steps : the compiled series.
    example : a state and parameters to try.
    """

    name: str
    title: str
    labels: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    field: Callable[[Sequence[Any], Sequence[Any]], tuple[Any, ...]]
    integrals: Callable[[Sequence[Any], Sequence[Any]], Mapping[str, Any]]
    frequency: Callable[[Array, Array], float]
    rescale: Callable[[Array, Array, float], tuple[Array, Array]]
    kernel: Callable[..., int]
    example: tuple[tuple[float, ...], tuple[float, ...]]

    @property
    def angular_velocities(self) -> int:
        """How many leading variables are angular velocities, and scale with 1/time."""
        return sum(name.startswith(("ω", "w")) for name in self.variables)


@cache
def systems() -> dict[str, System]:
    """Every module of this package that defines a `SYSTEM`, by name."""
    package = __name__.rpartition(".")[0]
    found = {}
    for module in pkgutil.iter_modules(importlib.import_module(package).__path__):
        system = getattr(importlib.import_module(f"{package}.{module.name}"), "SYSTEM", None)
        if isinstance(system, System):
            found[system.name] = system
    return found


def _check_times(times: Array) -> None:
    if times.ndim != 1 or times.size == 0 or not np.all(np.isfinite(times)):
        raise InvalidParameter("The times must be one or more finite numbers.")
    if times.size > MAX_SAMPLES:
        raise WorkLimit(f"{times.size} times were asked for; at most {MAX_SAMPLES} are allowed.")
    before = np.concatenate(([0.0], times[:-1]))
    if np.any(times < before) and np.any(times > before):
        raise InvalidParameter("The times must run away from 0, all forward or all backward.")


def _run(system: System, y: Array, p: Array, times: Array, level: Level, max_steps: int) -> tuple[Array, int]:
    out = np.empty((times.size, y.size))
    steps = system.kernel(y, p, times, level.order, level.tolerance, max_steps, out)
    if steps == STEP_LIMIT_REACHED:
        raise WorkLimit(
            f"This time span needs more than {MAX_STEPS} steps: choose a shorter one, or a cheaper level."
        )
    if not np.all(np.isfinite(out)):
        raise InvalidParameter("The motion left the range of double precision: choose less extreme parameters.")
    return out, steps


def solve(system: System, state: Sequence[float], parameters: Sequence[float],
          times: Sequence[float] | Array, level: Level) -> Orbit:
    """The orbit at the given times, with an error measured and not assumed.

    The motion is computed twice, the second time with steps a hundred times more exact; the
    difference is the error estimate of the first.  If that exceeds the level's promise the
    second run takes its place and is measured in turn, down to the floor of double precision.
    Raises `InvalidParameter` (not finite, times out of order), `WorkLimit`.
    """
    start = time.perf_counter()
    y, p = np.asarray(state, float), np.asarray(parameters, float)
    t = np.array(times, dtype=float, ndmin=1)
    _check_times(t)
    for given, names in ((y, system.variables), (p, system.parameters)):
        if given.shape != (len(names),):
            raise InvalidParameter(f"{system.title} takes {len(names)} numbers here: {', '.join(names)}.")
    if not (np.all(np.isfinite(y)) and np.all(np.isfinite(p))):
        raise InvalidParameter("Every component of the state and every parameter must be a finite number.")
    with np.errstate(over="ignore"):
        nu = system.frequency(y, p)
        scaled_times = t * (nu or 1.0)
    if not np.isfinite(nu):
        raise InvalidParameter("The motion is too fast for double precision: choose less extreme parameters.")
    nu = nu or 1.0
    scale = np.ones(y.size)
    scale[: system.angular_velocities] = nu
    y1, p1 = system.rescale(y, p, nu)

    current = level
    coarse, total = _run(system, y1, p1, scaled_times, current, MAX_STEPS)
    while True:
        tighter = current.tightened()
        fine, steps = _run(system, y1, p1, scaled_times, tighter, MAX_STEPS - total)
        total += steps
        # Two runs at the floor differ by their round-off, which says less of the true error.
        safety = 4.0 if current.is_floor else 1.25
        difference = np.abs(coarse - fine)
        error = safety * float(difference.max()) + 2e-16
        if error <= level.promise or current.is_floor:
            break
        current, coarse = tighter, fine
    if error <= level.promise:
        status = Status.OK
    else:
        status = Status.FLOOR if level.is_floor else Status.PROMISE_NOT_MET

    states = coarse * scale
    initial = system.integrals(y, p)
    along = system.integrals(states.T, p)
    drift = {
        name: float(np.max(np.abs(along[name] - value))) / max(1.0, abs(float(value)))
        for name, value in initial.items()
    }
    wall_ms = (time.perf_counter() - start) * 1e3
    absolute = safety * float((difference * scale).max()) + 2e-16 * max(1.0, nu)
    return Orbit(system.name, level.name, frozen(t), frozen(states), status, absolute, drift,
                 Cost(total, wall_ms))
