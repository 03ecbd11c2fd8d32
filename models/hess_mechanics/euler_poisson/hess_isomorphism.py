"""The isomorphism of the Hess manifold of Euler–Poisson with the Suslov–Hess case, and how numerics leave it.

On r1 M1 + r3 M3 = 0 (`g2p6f1`) the Euler–Poisson equations of a body with the Hess condition (`gess-*1`) are closed.
In the axes e2, e3' = r/|r|, e1' = e2 × e3' (`m15.9`, `m15.14`) the matrix A has a1' = a2 twice on its diagonal and b'
off it, M3' = 0 (`m15.10`), and with m = μ|r|

    w = (a1' M2', a1' M1'),  n = (−γ2', −γ1', γ3'),  a = b'/a1',  b = a1' m

turn the equations on the manifold (`gess05`) into the reduced Suslov–Hess equations (`eq01`) without rescaling time;
the map of the axes is a reflection.  (The paper prints other factors of n and b.)  For the Suslov body with
I11 = 1/a1' energy and area integral are the same numbers: E = H, F2 = −F1.

Off the manifold u = (r, M)/|r| obeys u' = −b' M2 u, so close to a motion on the manifold u grows as exp(−∫a w1 dt):
over a period of n3 on the stable limit cycle by the multiplier of the unstable one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit import MAX_STEPS, drift_of, require_finite_states
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.errors import InvalidParameter, NoField, WorkLimit
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.equations import HessBody

__all__ = ["Bridge", "FreeRun", "Growth", "growth_of", "heavy_body", "hess_body", "on_manifold", "run_free"]


def _tilt(body: HeavyBody) -> tuple[float, float]:
    """(sin, cos) of the angle from Ox3 to r, in the (r1, r3)-plane.  Raises `InvalidParameter`, `NoField`."""
    if not body.is_hess:
        raise InvalidParameter(
            "This body is not in the Hess case: choose I2 between I1 and I3, r2 = 0 and "
            "r1² (a3 − a2) = r3² (a2 − a1).")
    length = math.hypot(*body.r)
    if length == 0.0:
        raise NoField("r = 0: the centre of mass is the fixed point, and gives no axis. Choose r other than 0.")
    return body.r[0] / length, body.r[2] / length


def hess_body(body: HeavyBody) -> HessBody:
    """The Suslov body, I11 = 1/a1', whose motions are those of a heavy body on the Hess manifold.

    a = b'/a1' has the sign of r1 r3 (a1 − a3).  Raises `InvalidParameter` outside the Hess case, `NoField` (r = 0).
    """
    s, c = _tilt(body)
    a = s * c * (body.a[0] - body.a[2]) / body.a[1] + 0.0  # no −0.0
    I22 = 1.0 / (body.a[1] * (1.0 + a * a))
    b = body.a[1] * body.mu * math.hypot(*body.r)
    return HessBody(I22, a * I22, -b * I22 * math.hypot(1.0, a))


def heavy_body(body: HessBody, share: float = 0.5) -> HeavyBody:
    """A heavy body in the Hess case, a1' = 1/I11, whose motions on the Hess manifold are those of a Suslov body.

    It has r1, r3 ≥ 0, |r| = 1, μ = b/a1', and a1 > a3 for a > 0.  One of its moments is free, as I33 is in the
    Suslov problem: with a1 = a2 (1 − x), a3 = a2 (1 + a²/x), or a1 and a3 exchanged, it is a rigid body for
    0 < x ≤ (1 − a²)/2; x is `share` times that bound, or times ½ where |a| ≥ 1.
    Raises `InvalidParameter` for a share outside (0, 1].
    """
    require_finite(share=share)
    if not 0.0 < share <= 1.0:
        raise InvalidParameter(f"share = {share:g} does not lie in (0, 1]: choose 0.5 for the middle.")
    squared = body.a * body.a
    x = share * 0.5 * (1.0 - squared if squared < 1.0 else 1.0)
    moments = body.I11 / (1.0 - x), body.I11, body.I11 / (1.0 + squared / x)
    return HeavyBody.hess(moments if body.a <= 0.0 else moments[::-1], body.b * body.I11)


@dataclass(frozen=True)
class Bridge:
    """A heavy body in the Hess case and the Suslov body with the same motions.

    Made by `of_heavy` or `of_suslov`.  States (M, γ) are (…, 6), reduced states (w, n) (…, 5), in the same time.
    """

    heavy: HeavyBody
    hess: HessBody

    @classmethod
    def of_heavy(cls, heavy: HeavyBody) -> Bridge:
        """From Euler–Poisson.  Raises `InvalidParameter`, `NoField`."""
        return cls(heavy, hess_body(heavy))

    @classmethod
    def of_suslov(cls, hess: HessBody) -> Bridge:
        """From the Suslov problem.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return cls(heavy_body(hess), hess)

    def to_reduced(self, states: Array) -> Array:
        """(M, γ) → (w, n), dropping the component M3' off the manifold."""
        M1, M2, M3, g1, g2, g3 = np.moveaxis(np.asarray(states, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([a * M2, a * (c * M1 - s * M3), -g2, s * g3 - c * g1, s * g1 + c * g3], axis=-1)

    def from_reduced(self, reduced: Array) -> Array:
        """The inverse of `to_reduced`, on the Hess manifold."""
        w1, w2, n1, n2, n3 = np.moveaxis(np.asarray(reduced, float), -1, 0)
        s, c = _tilt(self.heavy)
        a = self.heavy.a[1]
        return np.stack([c * w2 / a, w1 / a, -s * w2 / a, s * n3 - c * n2, -n1, c * n3 + s * n2], axis=-1)

    def to_suslov(self, states: Array) -> Array:
        """(M, γ) → (ω1, ω2, γ1, γ2, γ3) of the Suslov problem; shape (..., 5)."""
        return self.hess.from_reduced(self.to_reduced(states))

    def from_suslov(self, states: Array) -> Array:
        """The inverse of `to_suslov`."""
        return self.from_reduced(self.hess.to_reduced(states))

    def distance(self, states: Array, reduced: Array) -> Array:
        """The distance (n,) of states (M, γ) (n, 6) from reduced states (n, 5) with b = 1.

        The largest difference of any component of (w, n), or |a1' M3'|, in units b = 1.
        """
        difference = self.hess.in_units_of_b(self.to_reduced(states)) - reduced
        s, c = _tilt(self.heavy)
        off = self.heavy.a[1] * (s * states[:, 0] + c * states[:, 2]) / self.hess.frequency_unit
        return np.asarray(np.maximum(np.max(np.abs(difference), axis=1), np.abs(off)), float)

    def in_units_of_b(self, H: float, F1: float) -> tuple[float, float]:
        """Energy and area integral of Euler–Poisson → (h, f) in units b = 1.  Raises `NoField`."""
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return a * H / (nu * nu), 0.0 - math.copysign(a, self.hess.b) * F1 / nu

    def from_units_of_b(self, h: float, f: float) -> tuple[float, float]:
        """The inverse of `in_units_of_b`: H = E and F1 = −F2 of the Suslov body."""
        nu, a = self.hess.frequency_unit, self.heavy.a[1]
        return nu * nu * h / a, 0.0 - math.copysign(nu, self.hess.b) * f / a


def _relative(body: HeavyBody, states: Array) -> Array:
    """(r, M)/(|r| max |M|) (n,) of the states (n, 6) of one motion."""
    largest = float(np.max(np.linalg.norm(states[:, :3], axis=1)))
    return np.asarray(states[:, :3] @ np.array(body.r) / (math.hypot(*body.r) * largest or 1.0), float)


@dataclass(frozen=True)
class FreeRun:
    """One orbit of the Euler–Poisson equations, computed once at one level, with the leak off the Hess manifold.

    times : (n,); states : (n, 6); off : (n,), (r, M)/(|r| max |M|); steps : taken; drift : as in `Orbit`.
    """

    level: str
    times: Array
    states: Array
    off: Array
    steps: int
    drift: Mapping[str, float]


def _run(problem: Problem, start: Array, times: Array, level: Level, out: Array) -> int:
    steps = SYSTEM.orbit(start, problem.parameters, times, level.order, level.tolerance, MAX_STEPS, out)
    if steps < 0:
        raise WorkLimit(f"This time span needs more than {MAX_STEPS} steps: choose a shorter one, or a cheaper level.")
    require_finite_states(out)
    return steps


def _ended(body: HeavyBody, problem: Problem, times: Array, states: Array, level: Level, steps: int) -> FreeRun:
    states = states * problem.scale
    drift = drift_of(SYSTEM, states[0], states, np.array(body.parameters))
    return FreeRun(level.name, times, frozen(states), frozen(_relative(body, states)), steps, drift)


def run_free(body: HeavyBody, start: tuple[float, ...], end: float, count: int, level: Level) -> FreeRun:
    """The Euler–Poisson orbit from a state on the Hess manifold, at `count` even times from 0 to `end`, unconstrained.

    It is computed once: `solve` would repeat it with smaller tolerances until the leak is that of round-off.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    times = frozen(np.linspace(0.0, end, count))
    problem = Problem.of(SYSTEM, [start], body.parameters)
    out = np.empty((count, 6))
    steps = _run(problem, problem.states[0], problem.times(times), level, out)
    return _ended(body, problem, times, out, level, steps)


_BEFORE_HELD = 3.0
"""Growth of ln |(r, M)| allowed between two projections."""
_HELD_SAMPLES = 32


def on_manifold(body: HeavyBody, start: tuple[float, ...], end: float, count: int, level: Level) -> FreeRun:
    """`run_free` with M projected onto the Hess manifold so often that the leak cannot grow.

    This integrates the restriction to the manifold (`gess05`) in the variables and with the kernel of Euler–Poisson.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    times = frozen(np.linspace(0.0, end, count))
    problem = Problem.of(SYSTEM, [start], body.parameters)
    scaled = problem.times(times)
    axis = np.array(body.r) / math.hypot(*body.r)
    growth = body.hess_a * _fastest(body, start) * end
    pieces = math.ceil(max((count - 1) / _HELD_SAMPLES, growth / _BEFORE_HELD))
    if pieces > MAX_STEPS:
        raise WorkLimit("The manifold is too unstable to be held over this time span: choose a shorter one.")
    edges = np.linspace(0.0, scaled[-1], pieces + 1)
    first = np.searchsorted(scaled, edges)
    out = np.empty((count, 6))
    state = problem.states[0].copy()
    steps = 0
    for i in range(pieces):
        state[:3] -= (state[:3] @ axis) * axis
        piece = np.append(scaled[first[i] : first[i + 1]], edges[i + 1]) - edges[i]
        states = np.empty((piece.size, 6))
        steps += _run(problem, state, piece, level, states)
        out[first[i] : first[i + 1]] = states[:-1]
        state = states[-1].copy()
    out[first[-1] :] = state
    return _ended(body, problem, times, out, level, steps)


def _fastest(body: HeavyBody, start: tuple[float, ...]) -> float:
    """A bound on |w| of the motion on the manifold from this state."""
    a = body.a[1]
    return math.sqrt(a * a * (start[0] ** 2 + start[1] ** 2 + start[2] ** 2) + 4.0 * a * body.strength)


_STRAIGHT = (3e-14, 1e-3)
"""Range of exponential growth of the leak: below it round-off is still added, above it growth is nonlinear."""


@dataclass(frozen=True)
class Growth:
    """The growth of ln |(r, M)| per period of n3, measured over `periods` periods from the period `first` on."""

    per_period: float
    first: int
    periods: int


def growth_of(run: FreeRun, samples: int) -> Growth | None:
    """The growth of the leak where it is exponential; None where that lasts less than two periods.

    samples : of the run per period of n3.  Least-squares fit of a straight line plus a function of that period: the
    slope of ln |(r, M)| against the number of the period.
    """
    rows = (run.off.size - 1) // samples
    table = np.abs(run.off[: rows * samples].reshape(rows, samples))
    low, high = _STRAIGHT
    over = np.flatnonzero(table.max(axis=1) > high)
    last = int(over[0]) if over.size else rows
    begun = np.flatnonzero(table[:last].min(axis=1) < low)
    first = int(begun[-1]) + 1 if begun.size else 0
    if last - first < 2:
        return None
    count = np.arange(last - first) - 0.5 * (last - first - 1)
    return Growth(float(count @ np.log(table[first:last]).mean(axis=1) / (count @ count)), first, last - first)
