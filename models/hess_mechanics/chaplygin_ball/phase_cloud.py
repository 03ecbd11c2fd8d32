"""Singular invariant measures: clouds of phase points of the ball with Suslov's constraint, and their density.

With s = I13ω1 + I23ω2 and h = Î⁻¹(−ω2, ω1) the motion without a field (`eq29`; the free Suslov problem for 𝒟 = 0) is
ω̇ = s h, and

    div v = I13h1 + I23h2 = ṡ/s.

So 1/|s| is the density of an invariant measure, infinite on s = 0 (proposition 2), and solves Liouville's equation
along every motion: a volume of the phase space (ω1, ω2, γ) grows by s(t)/s(0), a density by s(0)/s(t).  With
I13 = I23 = 0, field or not, div v = 0.

With ξ = (I23, −I13)/J, η = (I13, I23)/J, J² = I13² + I23², the motion is integrated in x = (ω, ξ) and y = (ω, η) = s/J,

    ẋ = J y (h, ξ),  ẏ = J y (h, η),

so that s, a factor, keeps its relative accuracy however small it becomes.  Î⁻¹ is applied as in `equations`.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_mechanics.chaplygin_ball.energy_surface import line_of_rest
from hess_mechanics.chaplygin_ball.equations import BallBody, determinant, inverse_times, kinetic_energy
from hess_mechanics.chaplygin_ball.phase_cloud_kernels import integrate
from hess_mechanics.dynamics.ensemble import integrate_many
from hess_mechanics.dynamics.orbit import as_times, require_finite_states, require_steps
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import SAFETY, perturb
from hess_mechanics.numerics.parallel import THREADS
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Cost, as_read_only, facts_of, unit_of
from hess_mechanics.parameters import plain
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = ["Cloud", "cloud_of", "divergence", "frame_times", "histogram", "occupation", "patch", "shell"]

_CLOSEST = 1e-300
"""Smallest |s|: below it doubles lose digits."""
_CHECKED, _CLOSE, _FEWEST_CLOSE = 16, 64, 4
"""One point in 16 is computed twice, for the error estimate; so is one in 64, but at least 4, of those closest to
s = 0, whose s is so small at the start that the error of a step is large beside it."""
_MOST_NUMBERS = 1_500_000
"""Largest number of values in all frames: 6 MB in single precision."""
_LEAST_FRAMES = 9
_TURN, _CHANGE = 0.9, 0.55
"""Change of γ, in radians, and of ln|s| between two frames: cubic interpolation is then accurate to a pixel."""
_MOST_STEPS, _LEAST_STEPS = 6_000_000, 100
"""Limit on the steps of all points together, a few seconds; and smallest limit for one point."""
_SPARSE = 1.5
"""Factor by which the frame spacing may grow with an error below two pixels."""


@dataclass(frozen=True)
class Cloud(Result):
    """Cloud of n phase points of a ball at m times, without a field.

    Attributes
    ----------
    body : BallBody
        The ball.
    times : ndarray, shape (m,)
        Times.
    along : ndarray, shape (n, m)
        Component x = (ω, ξ) along the line of equilibria, in rad/T.
    log_s : ndarray, shape (n, m)
        ln|s|, s = I13ω1 + I23ω2.
    signs : ndarray, shape (n,)
        Sign of s of each point, which is constant: 1 or −1.
    gamma : ndarray, shape (n, m, 3)
        Vertical γ.
    level : str
        Name of the accuracy level.
    status : Status
        State of the computation, see `Status`.
    error_estimate : float
        Largest estimated error of x/ν, ln|s| and γ, with ν an upper bound on |ω|.
    cost : Cost
        Steps and time of the computation.
    """

    body: BallBody
    times: Array
    along: Array
    log_s: Array
    signs: Array
    gamma: Array
    level: str
    status: Status
    error_estimate: float
    cost: Cost

    @cached_property
    def omega(self) -> Array:
        """Angular velocity (ω1, ω2), shape (n, m, 2), in rad/T."""
        J, (n1, n2) = _direction(self.body)
        across = self.signs[:, None] * np.exp(self.log_s) / J
        return as_read_only(np.stack([n2 * self.along + n1 * across, n2 * across - n1 * self.along], axis=-1))

    @cached_property
    def divergence(self) -> Array:
        """Divergence div v at every point, shape (n, m), in 1/T."""
        return as_read_only(divergence(self.body, self.omega, self.gamma))

    def labels(self) -> Labels:
        """Return ω, γ and ln|s| of each point over t, with names, units and coordinates.

        Returns
        -------
        Labels
            The variables over points and times.
        """
        dims = ("point", "t")
        named = {
            "ω1": self.omega[..., 0],
            "ω2": self.omega[..., 1],
            **{f"γ{i + 1}": self.gamma[..., i] for i in range(3)},
            "ln|s|": self.log_s,
        }
        return Labels(
            {"t": (("t",), self.times)},
            {name: (dims, values) for name, values in named.items()},
            {"t": "T", **{name: unit_of(name) for name in named}},
            facts_of(self),
        )

    @property
    def log_growth(self) -> Array:
        """Logarithm of the growth of small volumes, ln s(t)/s(0), shape (n, m); that of the density is its negative."""
        return self.log_s - self.log_s[:, :1]

    @property
    def volume(self) -> Array:
        """Volume of the cloud relative to that at the first time, shape (m,), for points that start evenly spread."""
        relative: Array = np.exp(self.log_growth).mean(axis=0)
        return relative


def _direction(body: BallBody) -> tuple[float, Array]:
    """Return J and η = (I13, I23)/J."""
    return math.hypot(body.I13, body.I23), line_of_rest(body)[1]


def divergence(body: BallBody, omega: Array, gamma: Array) -> Array:
    """Return the divergence div v = (I13, I23) Î⁻¹ (−ω2, ω1) of the equations of motion, also with a field.

    Parameters
    ----------
    body : BallBody
        The ball.
    omega : ndarray, shape (..., 2)
        Angular velocities (ω1, ω2), in rad/T.
    gamma : ndarray, shape (..., 3)
        Verticals γ of length 1.

    Returns
    -------
    ndarray, shape (...,)
        Divergence, in 1/T.
    """
    torque = -omega[..., 1], omega[..., 0]
    h1, h2 = inverse_times(torque, np.moveaxis(gamma, -1, 0), body.I11, body.I22, body.D)
    return np.asarray(body.I13 * h1 + body.I23 * h2, float)


def _require_cloud(h: float, spread: float, count: int) -> None:
    require_finite(h=h, spread=spread)
    if not h > 0.0:
        raise InvalidParameter(f"h = {h:g}, but without a field the energy is positive: choose h > 0.")
    if not 0.0 < spread < 1.0:
        raise InvalidParameter(f"The cloud's spread is {spread:g}: choose it between 0 and 1.")
    if count < 1:
        raise InvalidParameter(f"A cloud of {count} points is empty: choose at least one.")


def shell(body: BallBody, h: float, spread: float, count: int) -> Array:
    """Return states that are uniform in the phase volume h(1 − spread) < E < h(1 + spread), F1 = 1, for b = 0.

    The volume dω1 dω2 dA(γ) is dE dθ dA/√det Î with ω = √(2E) Î^(−1/2) (cos θ, sin θ), so γ is accepted with a
    probability ∝ 1/√det Î.  Every call returns the same points.

    Parameters
    ----------
    body : BallBody
        The ball.
    h : float
        Energy, h > 0.
    spread : float
        Relative half width of the range of energies, above 0 and below 1.
    count : int
        Number of states, positive.

    Returns
    -------
    ndarray, shape (count, 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    """
    _require_cloud(h, spread, count)
    random = np.random.default_rng(1)
    # det Î is linear in γ1², γ2², γ3², so its minimum is at an axis.
    smallest = body.I11 * body.I22 + body.D * min(body.I11, body.I22)
    gammas: list[Array] = []
    while sum(map(len, gammas)) < count:
        z, angle = random.uniform(-1.0, 1.0, 2 * count), random.uniform(0.0, 2.0 * math.pi, 2 * count)
        radius = np.sqrt(1.0 - z * z)
        some = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
        gammas.append(some[random.random(2 * count) ** 2 * determinant(some.T, body.parameters) < smallest])
    gamma = np.concatenate(gammas)[:count]
    g1, g2, _ = gamma.T
    A11, A12, det = body.I11 + body.D * (1.0 - g1**2), -body.D * g1 * g2, determinant(gamma.T, body.parameters)
    speed = np.sqrt(2.0 * h * random.uniform(1.0 - spread, 1.0 + spread, count))
    theta = random.uniform(0.0, 2.0 * math.pi, count)
    w2 = speed * np.sin(theta) * np.sqrt(A11 / det)
    return np.column_stack([(speed * np.cos(theta) * np.sqrt(A11) - A12 * w2) / A11, w2, gamma])


def patch(body: BallBody, h: float, angle: float, spread: float, count: int) -> Array:
    """Return states that are uniform in a disc of ω and a cap of γ about e3.

    The centre of the disc has the energy h with γ = e3.  Every call returns the same points.

    Parameters
    ----------
    body : BallBody
        The ball.
    h : float
        Energy of the centre, h > 0.
    angle : float
        Angle of the centre in the (ω1, ω2) plane, in radians.
    spread : float
        Radius of the disc, in units of |ω| at its centre, and of the cap, in radians; above 0 and below 1.
    count : int
        Number of states, positive.

    Returns
    -------
    ndarray, shape (count, 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    """
    _require_cloud(h, spread, count)
    require_finite(angle=angle)
    random = np.random.default_rng(1)
    direction = np.array([math.cos(angle), math.sin(angle)])
    speed = math.sqrt(2.0 * h / ((body.I11 + body.D) * direction[0] ** 2 + (body.I22 + body.D) * direction[1] ** 2))
    turn, size = random.uniform(0.0, 2.0 * math.pi, count), spread * np.sqrt(random.random(count))
    omega = speed * (direction + size[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]))
    z, turn = random.uniform(math.cos(spread), 1.0, count), random.uniform(0.0, 2.0 * math.pi, count)
    radius = np.sqrt(1.0 - z * z)
    return np.column_stack([omega, radius * np.cos(turn), radius * np.sin(turn), z])


def _twice_energy(body: BallBody, states: Array) -> float:
    return 2.0 * float(kinetic_energy(states.T, body.parameters).max())


def frame_times(body: BallBody, states: Array, duration: float, field: float = 0.0) -> Array:
    """Return equidistant times for the frames of a cloud, close enough for cubic interpolation.

    The error of cubic interpolation of γ over a time Δ is |d⁴γ/dt⁴| Δ⁴/384, about r|ω|⁴Δ⁴/384 with r = sin(γ, ω), for
    which 2E ≥ (min(I11, I22) + 𝒟r²) ω².  ω changes at the rate div v.

    Parameters
    ----------
    body : BallBody
        The ball.
    states : ndarray, shape (n, 5)
        Initial states of the cloud.
    duration : float
        Time; negative: backward.
    field : float, default 0.0
        Strength |b| of the field of a second cloud from the same points.

    Returns
    -------
    ndarray, shape (m,)
        Times from 0 to `duration`, both included.

    Raises
    ------
    InvalidParameter
        If the energy is not positive.
    WorkLimit
        If the duration needs more frames than allowed.
    """
    twice, least = _twice_energy(body, states) + 4.0 * abs(field), min(body.I11, body.I22)
    r = min(1.0, math.sqrt(least / (3.0 * body.D))) if body.D else 1.0
    turning = math.sqrt(twice / (least + body.D * r * r)) * r**0.25
    about = shell(body, 0.5 * twice, 0.01, 256)
    rate = float(np.abs(divergence(body, about[:, :2], about[:, 2:])).max())
    frames = abs(duration) * max(turning / _TURN, rate / _CHANGE) + 1.0
    most = max(_LEAST_FRAMES, _MOST_NUMBERS // (5 * len(states)))
    if not frames <= _SPARSE * most:
        longest = abs(duration) * _SPARSE * most / frames
        raise WorkLimit(
            f"In this time the cloud moves too fast for {most} frames: choose a time span below {plain(longest, 2)} or "
            "so, or fewer points."
        )
    return np.linspace(0.0, duration, max(_LEAST_FRAMES, min(most, math.ceil(frames))))


def _run(states: Array, p: Array, times: Array, level: Level, max_steps: int) -> tuple[Array, int]:
    longest = level.longest_step(float(times[-1]))
    out, each, _ = integrate_many(integrate, states, p, times, level, longest, max_steps, THREADS)
    require_steps(
        int(each.min(initial=0)),
        f"Points of this cloud need more than {max_steps} steps each: choose a shorter time span, a smaller 𝒟 or fewer "
        "points.",
    )
    require_finite_states(out)
    if not np.all(np.abs(out[..., 1]) > _CLOSEST):
        raise WorkLimit(
            "The cloud comes closer to the line I13ω1 + I23ω2 = 0 than double precision can resolve: choose a "
            "shorter time span."
        )
    out[..., 1] = np.log(np.abs(out[..., 1]))
    return out, int(each.sum())


def cloud_of(body: BallBody, states: Array, times: Array, accuracy: Accuracy) -> Cloud:
    """Return the cloud of given phase points at given times, with b = 0.

    The error of every sixteenth point, and of those that start closest to s = 0, is estimated by a second run with a
    hundredth of the tolerance from a start moved by `perturb`.  If it exceeds the promise of the level, all points are
    recomputed with that tolerance, down to the floor of double precision.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0 and I13 or I23 nonzero.
    states : ndarray, shape (n, 5)
        Initial states (ω1, ω2, γ1, γ2, γ3), off the line I13ω1 + I23ω2 = 0.
    times : ndarray, shape (m,)
        Times in order, all ≥ 0 or all ≤ 0.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Cloud
        The cloud.

    Raises
    ------
    InvalidParameter
        If the ball has a field, I13 = I23 = 0, a point has s = 0, or the times are not in order.
    WorkLimit
        If the motions need too many steps, or come too close to s = 0.
    """
    level = as_level(accuracy)
    start = time.perf_counter()
    if any(body.parameters[5:]):
        raise InvalidParameter("1/|I13ω1 + I23ω2| is an invariant density only without a field: set b1 = b2 = b3 = 0.")
    J, (n1, n2) = _direction(body)
    t = as_times(times)
    nu = math.sqrt(_twice_energy(body, states) / min(body.I11, body.I22)) or 1.0  # An upper bound on |ω| of all points.
    first = np.column_stack([states[:, :2] @ [[n2, n1], [-n1, n2]] / nu, states[:, 2:]])
    if not np.all(first[:, 1]):
        raise InvalidParameter(
            "A point of the cloud lies on I13ω1 + I23ω2 = 0, where 1/|I13ω1 + I23ω2| is infinite: choose another point."
        )
    max_steps = max(_LEAST_STEPS, _MOST_STEPS // len(first))
    p = np.array([body.I11, body.I22, J, n1, n2, body.D])
    closest = np.argsort(np.abs(first[:, 1]))[: max(_FEWEST_CLOSE, len(first) // _CLOSE)]
    checked = np.union1d(np.arange(0, len(first), _CHECKED), closest)
    out, total = _run(first, p, t * nu, level, max_steps)
    current = level
    while True:
        check_limit()
        finer = current.tighter()
        fine, steps = _run(perturb(first[checked]), p, t * nu, finer, 2 * max_steps)
        total += steps
        error = SAFETY * float(np.abs(out[checked] - fine).max()) + 2e-16
        if error <= level.promise or current.is_floor:
            break
        current = finer
        out, steps = _run(first, p, t * nu, current, max_steps)
        total += steps
    return Cloud(
        body,
        as_read_only(t),
        as_read_only(out[..., 0] * nu),
        as_read_only(out[..., 1] + math.log(J * nu)),
        as_read_only(np.sign(first[:, 1])),
        as_read_only(out[..., 2:]),
        level.name,
        level.status(error),
        error,
        Cost(total, (time.perf_counter() - start) * 1e3),
    )


_PARTS = 2


def _shares(log_s: Array, edges: Array) -> Array:
    width = float(edges[1] - edges[0])
    bins = np.floor((log_s.ravel() - edges[0]) / width).astype(int)
    counts = np.bincount(bins[(bins >= 0) & (bins < edges.size - 1)], minlength=edges.size - 1)
    return as_read_only(counts / (log_s.size * width))


def histogram(cloud: Cloud, frame: int, edges: Array) -> Array:
    """Return the density of points over ln|s| in one frame.

    Parameters
    ----------
    cloud : Cloud
        The cloud.
    frame : int
        Index of the time.
    edges : ndarray, shape (k + 1,)
        Equidistant values of ln|s|.

    Returns
    -------
    ndarray, shape (k,)
        Share of the points in each bin, per unit of ln|s|.
    """
    return _shares(cloud.log_s[:, frame], edges)


def occupation(cloud: Cloud, edges: Array) -> Array:
    """Return the density of points over ln|s|, averaged over time.

    Parameters
    ----------
    cloud : Cloud
        Cloud at evenly spaced times.
    edges : ndarray, shape (k + 1,)
        Equidistant values of ln|s|.

    Returns
    -------
    ndarray, shape (k,)
        Share of the time that the cloud spends in each bin, per unit of ln|s|.
    """
    before, after = cloud.log_s[:, :-1, None], cloud.log_s[:, 1:, None]
    return _shares(before + (after - before) * ((np.arange(_PARTS) + 0.5) / _PARTS), edges)
