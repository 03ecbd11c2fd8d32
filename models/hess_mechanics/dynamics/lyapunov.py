"""Largest Lyapunov exponent of an orbit, from its distance to a neighbour that is renormalised periodically.

The method of Benettin, Galgani and Strelcyn (1976).  The neighbour starts in a fixed direction that no symmetry singles
out.  For all exponents see `dynamics.spectrum`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import (
    MAX_STEPS,
    checked_span,
    end_of,
    require_finite_neighbours,
    require_finite_rates,
    require_finite_states,
    require_steps,
)
from hess_mechanics.dynamics.spectrum import no_chaos
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Accuracy, Kind, plan
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.parameters import plain

__all__ = ["Exponent", "lyapunov_exponent"]

MAX_RETURNS = 200_000
_DISTANCE = 1e-7
"""Distance of the neighbour, in units in which the state is O(1): small enough for linear growth, large compared with
round-off."""
_INTERVAL = 2.0
"""Time between renormalisations, in units of 1/ν."""


@dataclass(frozen=True)
class Exponent(Result):
    """Running estimates of the largest Lyapunov exponent.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times at which the neighbour was renormalised.
    rates : ndarray, shape (n,)
        Mean growth rate up to each time; the last one is the estimate.
    spread : float
        Range of the rates over the second half of the time.
    no_chaos : str
        Why the motion is not chaotic, whatever the estimate is, see `Megno`; empty if there is no such reason.
    """

    times: Array
    rates: Array
    spread: float
    no_chaos: str = ""

    @property
    def value(self) -> float:
        """The estimate, per unit of time."""
        return float(self.rates[-1])

    def labels(self) -> Labels:
        """Return the mean growth rates, labelled with time.

        Returns
        -------
        Labels
            The rates over the times.
        """
        return Labels(
            {"t": (("t",), self.times)},
            {"rate": (("t",), self.rates)},
            {"t": "T", "rate": "1/T"},
            {"exponent": self.value, "spread": self.spread, "no chaos": self.no_chaos},
        )

    @property
    def is_regular(self) -> bool:
        """True if the rate is below 2 ln(n)/t, as for a regular motion, whose neighbours part linearly."""
        return self.value < 2.0 * math.log(max(math.e, self.times.size)) / float(self.times[-1])


def lyapunov_exponent(body: Body, state: Sequence[float], span: float, level: Accuracy = STANDARD) -> Exponent:
    """Return the largest Lyapunov exponent of an orbit.

    Parameters
    ----------
    body : Body
        The body.
    state : array_like, shape (d,)
        Initial state.
    span : float
        Time span, in units of the problem; negative for backward in time.
    level : str or Level, default "standard"
        Accuracy level.  A named level means its `Plan` for exponents, with smaller tolerances than for orbits, because
        the neighbour is only 1e-7 away.

    Returns
    -------
    Exponent
        The running estimates, per unit of time.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the time span is too long.

    References
    ----------
    G. Benettin, L. Galgani, J.-M. Strelcyn, Kolmogorov entropy and numerical experiments, Phys. Rev. A 14
    (1976).

    Examples
    --------
    >>> from hess_mechanics import lyapunov_exponent, systems
    >>> suslov = systems()["suslov"]
    >>> float(lyapunov_exponent(*suslov.example_motion, 50.0).times[-1])
    50.0
    """
    level = plan(Kind.EXPONENT, level).level
    span = checked_span(span, "a Lyapunov exponent")
    problem = Problem.of(body, [state])
    returns = abs(span) / _INTERVAL * problem.nu
    if not returns <= MAX_RETURNS:
        raise WorkLimit(
            f"This takes {plain(returns, 3)} returns of the neighbour, at most {MAX_RETURNS} are allowed: choose "
            "a shorter time span."
        )
    count = max(1, math.ceil(returns))
    interval = np.array([span * problem.nu / count])
    longest = body.system.longest_step(level, span * problem.nu)
    direction = np.cos(1.0 + np.arange(problem.scale.size) ** 2)
    y = problem.states[0].copy()
    neighbour = y + _DISTANCE * direction / np.linalg.norm(direction)
    ends = np.empty((2, 1, y.size))
    growth, along = np.empty(count), np.empty((count, y.size))
    steps = 0
    for i in range(count):
        for start, end in zip((y, neighbour), ends, strict=True):
            left = MAX_STEPS - steps
            taken, _ = body.system.orbit(
                start, problem.parameters, interval, level.order, level.tolerance, longest, left, end
            )
            too_long = f"This exponent needs more than {MAX_STEPS} steps: choose a shorter time span."
            require_steps(taken, too_long, lambda: end_of(problem, problem.states[0], span * problem.nu))
            steps += taken
        require_finite_states(ends[0])
        along[i] = y = ends[0, 0].copy()
        away = ends[1, 0] - y
        # Unlike NumPy's norm this neither overflows nor becomes 0 on the way.
        distance = math.hypot(*away.tolist())
        require_finite_neighbours(np.array(distance))
        if distance == 0.0:
            raise InvalidParameter(
                "A nearby orbit merges with the motion in double precision, and has "
                "no rate: choose less extreme parameters, or take all exponents, which need no "
                "distance."
            )
        growth[i] = math.log(distance / _DISTANCE)
        neighbour = y + away * (_DISTANCE / distance)
    times = np.abs(span) * np.arange(1, count + 1) / count
    rates = np.cumsum(growth) / times
    require_finite_rates(rates)
    later = rates[count // 2 :]
    reason = no_chaos(body, problem, problem.states[0], along, span * problem.nu, level, True)
    return Exponent(frozen(times), frozen(rates), float(later.max() - later.min()), reason)
