"""Double-double integration of an orbit, the reference against which errors of the levels are measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import as_times, require_finite_states, require_steps
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Complex, as_read_only

__all__ = ["DoubleDoubleOrbit", "double_double_orbit"]

_MOST_STEPS = 100_000
_AT_ONCE = 20
"""Number of output times computed between two calls of `check_limit`."""


@dataclass(frozen=True)
class DoubleDoubleOrbit:
    """An orbit computed with 31 digits; instability reduces their number over time.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times.
    pairs : ndarray of complex, shape (n, d)
        The states; the pair of doubles high and low, whose sum is the number, is stored as high + i low.
    scale : ndarray, shape (d,)
        Units of the variables in which the states are O(1).
    """

    times: Array
    pairs: Complex
    scale: Array

    @property
    def states(self) -> Array:
        """The states, rounded to doubles, shape (n, d)."""
        return as_read_only(self.pairs.real.copy())

    def errors_of(self, states: Array) -> Array:
        """Return the errors of computed states, without rounding the truth first.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            Computed states at the same times.

        Returns
        -------
        ndarray, shape (n, d)
            |states − truth| of each component.
        """
        return np.abs((states - self.pairs.real) - self.pairs.imag)


def double_double_orbit(
    body: Body, start: Sequence[float] | Array, times: Sequence[float] | Array
) -> DoubleDoubleOrbit:
    """Return the orbit of a body from an initial state in double-double arithmetic, with 31 digits.

    The integrator is a Taylor series of order 36 in pairs of doubles (`numerics.double_double_kernels`), about 40 µs
    per step.  State and parameters are not rescaled, and the time only by a power of two, which is exact.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state at time 0.
    times : array_like, shape (n,)
        Times, in units T, monotonic from 0 forward or backward.

    Returns
    -------
    DoubleDoubleOrbit
        The orbit.

    Raises
    ------
    InvalidParameter
        If a number is not finite, the times are not monotonic, or the motion exceeds the range of doubles.
    WorkLimit
        If the motion needs more than 100 000 steps or stops, or there are more than 200 000 times.

    Examples
    --------
    >>> from hess_mechanics import level, solve, systems
    >>> from hess_mechanics.dynamics.double_double import double_double_orbit
    >>> suslov = systems()["suslov"]
    >>> orbit = solve(*suslov.example_motion, [0.0, 1.0, 2.0], level("precise"))
    >>> truth = double_double_orbit(*suslov.example_motion, orbit.times)
    >>> bool(truth.errors_of(orbit.states).max() < orbit.error_estimate)
    True
    """
    t = as_times(times)
    problem = Problem.of(body, [start])
    unit = math.ldexp(1.0, -round(math.log2(problem.nu)))
    p = np.asarray(body.parameters, complex)
    out = np.empty((t.size, problem.scale.size), complex)
    here, begun, left = np.array(start, complex), 0.0, _MOST_STEPS
    for first in range(0, t.size, _AT_ONCE):
        check_limit()
        part = slice(first, first + _AT_ONCE)
        steps = body.system.double_double(here, begun, p, problem.scale, unit, t[part], left, out[part])
        require_steps(
            steps, f"With 31 digits this motion stops, or needs over {_MOST_STEPS} steps: choose a shorter time span."
        )
        require_finite_states(out[part].real)
        here, begun, left = out[part][-1].copy(), float(t[part][-1]), left - steps
    return DoubleDoubleOrbit(as_read_only(t), as_read_only(out), as_read_only(problem.scale))
