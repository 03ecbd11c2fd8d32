"""Largest Lyapunov exponent of an orbit, from the growth of a tangent vector that is renormalised when it is long.

The method of Benettin, Galgani and Strelcyn (1976).  The vector starts in a fixed direction that no symmetry singles
out.  For all exponents see `dynamics.spectrum`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import MAX_SAMPLES, checked_span, require_finite_rates
from hess_mechanics.dynamics.spectrum import no_chaos
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.dynamics.variation import LONGEST, one_direction, tangent
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Accuracy, Kind, plan
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.parameters import plain

__all__ = ["Exponent", "lyapunov_exponent"]

_INTERVAL = 2.0
"""Time between samples, in units of 1/ν."""


@dataclass(frozen=True)
class Exponent(Result):
    """Running estimates of the largest Lyapunov exponent.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times.
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


def lyapunov_exponent(body: Body, start: Sequence[float], duration: float, accuracy: Accuracy = STANDARD) -> Exponent:
    """Return the largest Lyapunov exponent of an orbit.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state.
    duration : float
        Time span, in units of the problem; negative for backward in time.
    accuracy : str or Level, default "standard"
        Accuracy level.  A named level means its `Plan` for exponents.

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
    level = plan(Kind.EXPONENT, accuracy).level
    span = checked_span(duration, "a Lyapunov exponent")
    problem = Problem.of(body, [start])
    samples = abs(span) / _INTERVAL * problem.nu
    if not samples <= MAX_SAMPLES:
        raise WorkLimit(
            f"This takes {plain(samples, 3)} samples of the growth, at most {MAX_SAMPLES} are allowed: choose a "
            "shorter time span."
        )
    count = max(1, math.ceil(samples))
    times = span * np.arange(1, count + 1) / count
    state = problem.states[0]
    found = tangent(problem, state, one_direction(state.size), problem.times(times), level, LONGEST)
    rates = found.lengths[:, 0] / np.abs(times)
    require_finite_rates(rates)
    later = rates[count // 2 :]
    reason = no_chaos(problem, state, found.states, span * problem.nu, level, True)
    return Exponent(frozen(np.abs(times)), frozen(rates), float(later.max() - later.min()), reason)
