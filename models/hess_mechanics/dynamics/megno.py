"""MEGNO, the mean exponential growth factor of nearby orbits (Cincotta and Simó 2000), a fast indicator of chaos.

    Y(t) = (2/t) ∫₀ᵗ s d ln|δ(s)|,   Ȳ(t) = (1/t) ∫₀ᵗ Y ds,   δ from the variational equations.

Ȳ tends to 2 on quasi-periodic motions, to at most 2 on motions that come to a stable rest or cycle, and grows as λt/2
on chaotic ones.  It also grows on unstable motions that rest, escape or close and are not chaotic (`Megno.no_chaos`).
The values are the same for every system and need a single neighbour.  SALI would need two, and falls to 0 on the
closed curves of a section, where neighbours have one direction only, as on chaotic motions.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.birkhoff import batch_error, volume_sign, window_rates
from hess_mechanics.dynamics.orbit import as_duration, require_finite_rates
from hess_mechanics.dynamics.spectrum import no_chaos
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.dynamics.variation import LONGEST, generic_direction, tangent
from hess_mechanics.errors import InvalidParameter, MotionEnds, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import THREADS, run_in_threads
from hess_mechanics.numerics.results import Array, Cost, Mask, as_read_only
from hess_mechanics.parameters import plain

__all__ = ["CHAOTIC", "REGULAR", "Megno", "longest_duration", "megno"]

CHAOTIC = 3.0
"""Ȳ above this is chaotic: regular motions come to 2 from either side within 0.5."""
REGULAR = 2.5
"""Ȳ below this is regular; between the two limits the motion is undecided."""
_SAMPLES = 2400
"""A hundredth of the largest number of samples of ln|δ|, of which there is at least one per time 1/ν."""
_LONGEST = _SAMPLES * 100
"""Longest time span, in units of 1/ν."""
_FEW = 8
"""Largest number of motions that are searched for a return; those of a map start beside unstable periodic orbits."""
_SHARE = 4


@dataclass(frozen=True)
class Megno(Result):
    """MEGNO of several motions; the result of `megno`.

    Attributes
    ----------
    duration : float
        Time of each motion, positive, in units T.
    values : ndarray, shape (n,)
        Ȳ of each motion; NaN if it ends before `duration`.
    divergence, divergence_error : ndarray, shape (n,)
        Weighted mean of div ẏ over the last four fifths of the time, with the opposite sign for a motion backward in
        time, so that negative values always mean shrinking phase volume; and its standard error; both in 1/T.
    windows : ndarray, shape (n, 4)
        The same mean, and those over the first, middle and last half of that time.
    no_chaos : tuple of str
        For each motion why it is not chaotic, whatever Ȳ is: it rests, escapes or closes, or its phase space has at
        most two dimensions besides its integrals; empty where there is no such reason.  Whether a motion closes is
        tested only where Ȳ > 3, and only for up to eight motions.
    ends : ndarray, shape (n,)
        Time up to which each motion was followed, positive, in units T; NaN if it is not known.
    reasons : tuple of str
        Why each motion ends before `duration`, with the place of its end; empty for one that does not.
    level : str
        Name of the accuracy level.
    cost : Cost
        Steps and time.
    """

    duration: float
    values: Array
    divergence: Array
    divergence_error: Array
    windows: Array
    no_chaos: tuple[str, ...]
    ends: Array
    reasons: tuple[str, ...]
    level: str
    cost: Cost

    @property
    def chaotic(self) -> Mask:
        """True for each motion with Ȳ > 3, unless `no_chaos` gives a reason; shape (n,)."""
        return np.asarray((self.values > CHAOTIC) & ~np.array(self.no_chaos, bool))

    @property
    def dissipative(self) -> Mask:
        """True for each motion about which phase volume shrinks by more than three standard errors; shape (n,)."""
        return volume_sign(self.divergence, self.divergence_error) < 0

    def labels(self) -> Labels:
        """Return Ȳ, divergence, end and reasons of each motion.

        Returns
        -------
        Labels
            Ȳ, the divergence and its error, `no_chaos`, the ends and the reasons over the motions.
        """
        return Labels(
            {},
            {
                "MEGNO": (("motion",), self.values),
                "divergence": (("motion",), self.divergence),
                "divergence error": (("motion",), self.divergence_error),
                "no chaos": (("motion",), np.array(self.no_chaos)),
                "end": (("motion",), self.ends),
                "reason": (("motion",), np.array(self.reasons)),
            },
            {"end": "T", "MEGNO": "1", "divergence": "1/T", "divergence error": "1/T"},
            {"t": self.duration, "level": self.level, "steps": self.cost.steps},
        )


def longest_duration(body: Body, start: Sequence[float] | Array) -> float:
    """Return a time span that MEGNO accepts for motions that start near a state.

    It is two thirds of the limit at this state, because ν differs between neighbouring states.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        The state.

    Returns
    -------
    float
        The time span, positive, in units T.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    """
    return _LONGEST / (1.5 * Problem.of(body, [start]).nu)


def megno(
    body: Body,
    states: Sequence[Sequence[float]] | Array,
    duration: float,
    accuracy: Accuracy = STANDARD,
    threads: int = THREADS,
) -> Megno:
    """Return MEGNO of several motions, computed on all cores.

    Parameters
    ----------
    body : Body
        The body.
    states : array_like, shape (n, d)
        Initial states.
    duration : float
        Time span, nonzero, in units T; negative for backward in time.
    accuracy : str or Level, default "standard"
        Accuracy level.
    threads : int, optional
        Number of threads.  By default one per core, at most eight.

    Returns
    -------
    Megno
        Ȳ and the mean divergence of each motion; NaN and a reason for a motion that cannot be followed, see
        `ensemble.complete`.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the time span is 0.
    WorkLimit
        If the time span is longer than 240 000/ν.

    References
    ----------
    P. M. Cincotta, C. Simó, Simple tools to study global dynamics in non-axisymmetric galactic potentials,
    Astron. Astrophys. Suppl. Ser. 147 (2000).

    Examples
    --------
    >>> from hess_mechanics import megno, systems
    >>> suslov = systems()["suslov"]
    >>> body, state = suslov.example_motion
    >>> megno(body, [state], 100.0).values.shape
    (1,)
    """
    level = as_level(accuracy)
    as_duration(duration, "an indicator")
    begun = time.perf_counter()
    problem = Problem.of(body, states)
    if abs(duration) * problem.nu > _LONGEST:
        raise WorkLimit(
            f"t = {plain(abs(duration), 4)} is too long for MEGNO: choose at most {plain(_LONGEST / problem.nu, 4)}."
        )
    count, size = problem.states.shape
    # Sample at least once per 1/ν, in twelve stretches after the first fifth.
    samples = 60 * max(4, math.ceil(abs(duration) * problem.nu / 60))
    t = duration * problem.nu * np.arange(1, samples + 1) / samples
    first = samples // 5
    direction = generic_direction(size)
    numbers, steps, no_chaos_because = np.empty((6, count)), np.zeros(count, int), [""] * count
    ends, reasons = np.full(count, abs(duration)), [""] * count

    def one(i: int) -> None:
        try:
            follow(i)
        except (WorkLimit, InvalidParameter) as error:
            # One failed motion must not stop the others.
            numbers[:, i], reasons[i] = math.nan, str(error)
            ends[i] = abs(error.time) if isinstance(error, MotionEnds) else math.nan

    def follow(i: int) -> None:
        start = problem.states[i]
        along = tangent(problem, start, direction, t, level, LONGEST)
        steps[i] = along.steps
        length = np.concatenate([[0.0], along.lengths[:, 0]])
        # ∫ s dL = tL − ∫ L ds, with sums in place of integrals and the sample spacing as unit of time.
        number = np.arange(1, samples + 1)
        below = np.cumsum(0.5 * (length[1:] + length[:-1]))
        y = 2.0 * (length[1:] - below / number)
        times = np.abs(t[first - 1 :]) / problem.nu
        volume = along.volume[first - 1 :]
        windows = window_rates(volume, times)
        # Add the error of the steps, the scatter of stretches, and the remainder on tori, which the scatter does not
        # show.
        floor = (level.tolerance + 1e-15) * steps[i] / abs(duration)
        scatter = batch_error(volume[:, None], times)[1][0]
        numbers[:, i] = y.mean(), *windows, max(scatter, float(np.abs(windows[1:] - windows[0]).max())) + floor
        require_finite_rates(numbers[:, i])
        grows = count <= _FEW and bool(y.mean() > CHAOTIC)
        no_chaos_because[i] = no_chaos(problem, start, along.states, float(t[-1]), level, grows)

    run_in_threads(one, count, threads, _SHARE)
    return Megno(
        abs(duration),
        as_read_only(numbers[0].copy()),
        as_read_only(numbers[1].copy()),
        as_read_only(numbers[5].copy()),
        as_read_only(numbers[1:5].T.copy()),
        tuple(no_chaos_because),
        as_read_only(ends),
        tuple(reasons),
        level.name,
        Cost(int(steps.sum()), (time.perf_counter() - begun) * 1e3),
    )
