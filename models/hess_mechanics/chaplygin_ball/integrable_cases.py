"""Two cases with I13 = I23 = 0 in which the ball with a field is regular, for every 𝒟; the paper asks for such cases.

Then `eq29` is Îω̇ = (γ × ∂U/∂γ)_(1,2), γ̇ = γ × ω, with Î as in `equations`, even in γ3, and U = (b, γ) here.

1. U = U(γ1, γ2), so b3 = 0: every orbit that crosses the equator γ3 = 0 twice is periodic.
   Proof.  The torque (−γ3 ∂U/∂γ2, γ3 ∂U/∂γ1), γ̇1 = −γ3ω2 and γ̇2 = γ3ω1 are odd in γ3, and γ̇3 = γ1ω2 − γ2ω1 is even.
   So if y(t) is a motion, R y(−t) is one too, where R is the reflection γ3 → −γ3 (a reversor).  Let y cross the equator
   at t0 and t1.  R fixes y(t0) and y(t1), and the motion through a state is unique: y(t) = R y(2t0 − t) = R y(2t1 − t).
   Hence y(t + 2(t1 − t0)) = y(t), and the return to the section γ3 = 0 is the identity wherever it exists.  ∎
   Some orbits do not cross it twice: they touch it or tend to fixed points, as `suslov.kharlamova` shows for 𝒟 = 0.

2. I11 = I22 and U = U(γ3), so b ∥ e3: F2 = ω1γ1 + ω2γ2 is an integral besides E and F1.
   Proof.  The torque U'(γ3) (γ2, −γ1) is normal to γ' = (γ1, γ2), so Î = (I11 + 𝒟γ²) E − 𝒟γ'γ'ᵀ maps ω̇ ∥ torque to a
   multiple of it, and (ω̇, γ') = 0; and (ω, γ̇') = −γ3ω1ω2 + γ3ω2ω1 = 0.  ∎
   The standard measure is conserved for I13 = I23 = 0, so the system is integrable by the Euler–Jacobi theorem.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.dynamics.plane_section import Plane, section
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, Accuracy, Status
from hess_mechanics.numerics.arguments import as_a, as_level, as_point
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Cost, facts_of

__all__ = ["Period", "area_integral", "has_area_integral", "is_reversible", "period"]

_EITHER_WAY = Plane((0.0, 0.0, 0.0, 0.0, 1.0), sense=0)
_TOUCHES = 1e-9
"""Largest |γ̇3|/ν of a crossing that is round-off: the orbit rests on the equator, or touches it."""
_TURNS = 300.0
"""Time limit for two crossings, in units of the slowest rotation of a ball with this energy."""


def is_reversible(body: BallBody) -> bool:
    """Return True if the reflection γ3 → −γ3 reverses the motions: I13 = I23 = 0 and b3 = 0.

    Parameters
    ----------
    body : BallBody
        The ball.

    Returns
    -------
    bool
        True if it is reversible in this sense.
    """
    return body.I13 == body.I23 == body.b3 == 0.0


def has_area_integral(body: BallBody) -> bool:
    """Return True if F2 = ω1γ1 + ω2γ2 is an integral by symmetry: I13 = I23 = 0, I11 = I22 and b ∥ e3.

    Parameters
    ----------
    body : BallBody
        The ball.

    Returns
    -------
    bool
        True if it has this integral.
    """
    return body.I13 == body.I23 == body.b1 == body.b2 == 0.0 and body.I11 == body.I22


def area_integral(states: Array) -> Array:
    """Return F2 = ω1γ1 + ω2γ2 of states.

    Parameters
    ----------
    states : ndarray, shape (..., 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (...,)
        Values of F2.
    """
    return np.asarray(states[..., 0] * states[..., 2] + states[..., 1] * states[..., 3])


@dataclass(frozen=True)
class Period(Result):
    """Period of one orbit; the result of `period`.

    Attributes
    ----------
    value : float
        The period, positive, in units T.
    crossings : tuple of two floats
        The first two times at which the orbit crosses the equator.
    level : str
        Name of the accuracy level.
    status : Status
        State of the computation, see `Status`.
    error_estimate : float
        Estimated error of the period, ≥ 0.
    cost : Cost
        Steps and time of the computation.
    """

    value: float
    crossings: tuple[float, float]
    level: str
    status: Status
    error_estimate: float
    cost: Cost

    def labels(self) -> Labels:
        """Return the times of both crossings with names and units.

        Returns
        -------
        Labels
            The times; the period is a fact.
        """
        return Labels(
            {}, {"t": (("crossing",), np.array(self.crossings))}, {"t": "T"}, {"period": self.value, **facts_of(self)}
        )


def period(body: BallBody, start: Sequence[float], accuracy: Accuracy = "precise") -> Period:
    """Return the period of an orbit of the reversible ball, I13 = I23 = 0 and b3 = 0.

    Parameters
    ----------
    body : BallBody
        Ball with I13 = I23 = 0 and b3 = 0.
    start : sequence of five floats
        Initial state (ω1, ω2, γ1, γ2, γ3).
    accuracy : str or Level, optional
        Accuracy level or its name, see `level`.

    Returns
    -------
    Period
        The period in `value`, its error in `error_estimate`, and the first two times of `crossings` of the equator.

    Raises
    ------
    InvalidParameter
        If the body is not reversible, or the orbit does not cross the equator γ3 = 0 twice within the time limit.
    WorkLimit
        If the orbit needs too many steps.

    Notes
    -----
    The period is twice the time between the first two crossings of the equator, see
    `hess_mechanics.chaplygin_ball.integrable_cases`.  Its error is four times that of these times.

    References
    ----------
    `eq29`.  The theorem is not in the paper.

    Examples
    --------
    >>> from hess_mechanics import BallBody, period
    >>> body = BallBody(1.3, 0.8, 0.0, 0.0, 0.0, 0.5, -0.2, 0.0)
    >>> round(period(body, (1.0, -0.5, 0.0, 0.6, 0.8)).value, 6)
    4.872249
    """
    level = as_level(accuracy)
    if not is_reversible(as_a(BallBody, body)):
        raise InvalidParameter("The period needs the symmetry of I13 = I23 = 0 and b3 = 0: set these to 0.")
    p, given = np.array(body.parameters), np.array(as_point(SYSTEM.variables, start))
    moment = max(body.I11, body.I22) + body.D
    least = min(body.I11, body.I22)
    nu = float(SYSTEM.frequency(given, p)) or 1.0
    end = _TURNS * math.sqrt(moment / least) / nu
    # The promise of a section is that of its states; here it also covers the time in units 1/ν.
    for each in (level, *(one for one in LEVELS.values() if one.promise < level.promise)):
        crossings = section(body, given, _EITHER_WAY, end, each, crossings=2)
        error = 4.0 * crossings.time_error
        if error * nu <= level.promise:
            break
    speeds = np.abs(SYSTEM.field(list(crossings.states.T), body.parameters)[4]) if len(crossings.times) else np.zeros(1)
    if len(crossings.times) < 2 or np.min(speeds) <= _TOUCHES * nu:
        raise InvalidParameter(
            f"Up to t = {end:.6g} this orbit does not cross the equator γ3 = 0 twice: choose another start."
        )
    first, second = crossings.times.tolist()
    status = Status.OK if error * nu <= level.promise else each.status(math.inf)
    return Period(2.0 * (second - first), (first, second), level.name, status, error, crossings.cost)
