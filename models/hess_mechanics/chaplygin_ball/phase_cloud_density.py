"""Evolution of a cloud of phase points: its density over |s|, and the growth of small volumes about its points.

With I13 = I23 = 0 and a field volume is conserved: a second cloud from the same points shows the difference.

An invariant density times an integral of motion is an invariant density too (proposition 1).  With 𝒟 = 0 and F2 that
is |F2|/|s|, which vanishes on F2 = 0: no motion crosses that surface.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud, cloud_of, frame_times, histogram, occupation, patch, shell
from hess_mechanics.dynamics.ensemble import complete, ensemble
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, Ensemble, as_read_only
from hess_mechanics.suslov.additional_integral import integral_of
from hess_mechanics.suslov.equations import SuslovBody

__all__ = ["BIN", "SMALLEST", "CloudHistory", "Clouds", "Density", "clouds", "density", "history", "sides"]

BIN = 0.25
"""Width of a bin of ln|s|."""
SMALLEST = math.log(1e-30)
"""Smallest ln|s| that is counted: a smaller |s| cannot be plotted in single precision."""


@dataclass(frozen=True)
class CloudHistory(Result):
    """Growth of a cloud over time; the result of `history`.

    Attributes
    ----------
    times : ndarray, shape (m,)
        Times.
    divergence : ndarray, shape (3, m)
        Mean, minimum and maximum of div v over the points, in 1/T.
    log_growth : ndarray, shape (3, m)
        Mean, minimum and maximum of ln s(t)/s(0).
    volume : ndarray, shape (m,)
        Volume relative to that at the first time, see `Cloud`.
    """

    times: Array
    divergence: Array
    log_growth: Array
    volume: Array

    def labels(self) -> Labels:
        """Return volume, growth and divergence over t.

        Returns
        -------
        Labels
            The variables over the times.
        """
        along = ("t",)
        parts = {
            f"{what} {name}": (along, values[i])
            for what, values in (("growth", self.log_growth), ("divergence", self.divergence))
            for i, name in enumerate(("mean", "least", "largest"))
        }
        return Labels({"t": (along, self.times)}, {"volume": (along, self.volume), **parts}, {"t": "T"})


@dataclass(frozen=True)
class Density(Result):
    """Density of a cloud over ln|s|; the result of `density`.

    Attributes
    ----------
    log_s : ndarray, shape (k,)
        Centres of the bins of ln|s|.
    first : ndarray, shape (k,)
        Share of the points per unit of ln|s| at the start.
    last : ndarray, shape (k,)
        The same at the end.
    mean : ndarray, shape (k,)
        The same, averaged over time.
    height : float
        Mean density in bins that all points pass, from the change of ln|s| (median of the points) in the last quarter
        of the times; ∞ if it does not change.
    """

    log_s: Array
    first: Array
    last: Array
    mean: Array
    height: float

    def labels(self) -> Labels:
        """Return the three densities over ln|s|.

        Returns
        -------
        Labels
            The densities over the bins.
        """
        along = ("ln|s|",)
        parts = {"first": self.first, "last": self.last, "mean": self.mean}
        return Labels({"ln|s|": (along, self.log_s)}, {name: (along, values) for name, values in parts.items()})

    @property
    def upper_quarter(self) -> tuple[float, float]:
        """The |s| at the upper quarter of the range of ln|s|, which most points pass, and the mean density there."""
        i = 3 * self.log_s.size // 4
        return math.exp(float(self.log_s[i])), float(self.mean[i])


def sides(cloud: Cloud) -> tuple[int, int, int] | None:
    """Return the numbers of points on both sides of F2 = 0, and of points that change sides.

    Points whose F2 is 0 to round-off are not counted.

    Parameters
    ----------
    cloud : Cloud
        The cloud.

    Returns
    -------
    tuple of three ints, or None
        Points that start with F2 > 0, with F2 < 0, and that change the sign later; None if no F2 is known, because 𝒟 ≠
        0 or `eq834` does not hold.
    """
    body = cloud.body
    integral = integral_of(SuslovBody(body.I11, body.I22, body.I13, body.I23)) if body.D == 0.0 else None
    if integral is None:
        return None
    values = integral(cloud.omega, cloud.gamma)
    first = values[:, 0]
    off = np.abs(first) > max(1e-12, 10.0 * cloud.error_estimate) * np.abs(values).max()
    changed = off & np.any(values * np.sign(first)[:, None] < 0.0, axis=1)
    return int(np.sum(off & (first > 0.0))), int(np.sum(off & (first < 0.0))), int(changed.sum())


@dataclass(frozen=True)
class Clouds:
    """A cloud and its evolution; the result of `clouds`.

    Attributes
    ----------
    cloud : Cloud
        The cloud.
    history : CloudHistory
        Its growth over time.
    density : Density
        Its density over ln|s|.
    sides : (int, int, int), optional
        Numbers of points by the sign of F2, see `sides`; None if no F2 is known.
    other : Ensemble, optional
        The second cloud, of the body with I13 = I23 = 0 and a field; None if it is not requested.
    """

    cloud: Cloud
    history: CloudHistory
    density: Density
    sides: tuple[int, int, int] | None
    other: Ensemble | None

    @property
    def largest_speed(self) -> float:
        """The largest |ω| of all points, in rad/T."""
        fastest = float(np.sqrt((self.cloud.omega**2).sum(axis=2).max()))
        if self.other is None:
            return fastest
        return max(fastest, float(np.sqrt((self.other.states[..., :2] ** 2).sum(axis=2).max())))


def history(cloud: Cloud) -> CloudHistory:
    """Return the history of a cloud at all of its times.

    Parameters
    ----------
    cloud : Cloud
        The cloud, see `cloud`.

    Returns
    -------
    CloudHistory
        Volume, growth and divergence over the times.

    Examples
    --------
    >>> from hess_mechanics import BallBody, cloud, history
    >>> float(history(cloud(BallBody(2.0, 1.0, 0.3, 0.5, 0.0), 2.0, 1.0, count=20)).volume[0].round(6))
    1.0
    """

    def of(values: Array) -> Array:
        return as_read_only(np.stack([values.mean(axis=0), values.min(axis=0), values.max(axis=0)]))

    return CloudHistory(
        as_read_only(cloud.times), of(cloud.divergence), of(cloud.log_growth), as_read_only(cloud.volume)
    )


def density(cloud: Cloud) -> Density:
    """Return the density of a cloud over ln|s|.

    The bins have the width `BIN` and reach from the smallest |s|, but not below `SMALLEST`, to the largest.

    Parameters
    ----------
    cloud : Cloud
        The cloud.

    Returns
    -------
    Density
        Densities at the start, at the end and averaged over time.

    Examples
    --------
    >>> from hess_mechanics import BallBody, cloud, density
    >>> result = density(cloud(BallBody(2.0, 1.0, 0.3, 0.5, 0.0), 2.0, 1.0, count=20))
    >>> bool(abs(result.last.sum() * (result.log_s[1] - result.log_s[0]) - 1.0) < 1e-12)
    True
    """
    low = max(SMALLEST, float(cloud.log_s.min()))
    first = math.floor(low / BIN)
    edges = BIN * np.arange(first, max(first + 1, math.floor(float(cloud.log_s.max()) / BIN) + 1) + 1, dtype=float)
    # In the end ln|s| decreases at a constant rate, which gives the share of time per unit of ln|s|.
    last = cloud.times.size - 1
    late = 3 * cloud.times.size // 4
    change = float(np.median(np.abs(cloud.log_s[:, -1] - cloud.log_s[:, late])))
    return Density(
        as_read_only(0.5 * (edges[1:] + edges[:-1])),
        histogram(cloud, 0, edges),
        histogram(cloud, -1, edges),
        occupation(cloud, edges),
        (last - late) / last / change if change else math.inf,
    )


def clouds(
    body: BallBody,
    h: float,
    angle: float | None,
    spread: float,
    count: int,
    duration: float,
    field: float | None,
    accuracy: Accuracy,
) -> Clouds:
    """Return a cloud that starts in a `patch` or a `shell`, its evolution, and optionally a second cloud with a field.

    Parameters
    ----------
    body : BallBody
        The ball.
    h : float
        Energy, h > 0.
    angle : float or None
        Angle of the centre of the patch, in radians; None for a shell.
    spread : float
        Spread of the points, above 0 and below 1, see `patch` and `shell`.
    count : int
        Number of points of both clouds together; with a second cloud each has half of them, rounded down.
    duration : float
        Time; negative: backward.
    field : float or None
        Component b3 of the second cloud, which has I13 = I23 = 0; None for no second cloud.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Clouds
        The clouds.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If the motions need too many steps.
    """
    one = count if field is None else count // 2
    states = shell(body, h, spread, one) if angle is None else patch(body, h, angle, spread, one)
    times = frame_times(body, states, duration, abs(field or 0.0))
    cloud, other = cloud_of(body, states, times, accuracy), None
    if field is not None:
        principal = BallBody(body.I11, body.I22, 0.0, 0.0, body.D, 0.0, 0.0, field)
        other = complete(ensemble(principal, states, times, accuracy))
    return Clouds(cloud, history(cloud), density(cloud), sides(cloud), other)
