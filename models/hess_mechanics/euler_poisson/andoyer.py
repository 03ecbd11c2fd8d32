"""Andoyer–Deprit variables of the Euler–Poisson equations, and the section g = π/2 (figures 11, 13 and 14).

G = |M|, L = M3, (M, γ) = f, x = L/G, s = √(1 − x²); M = G (s sin l, s cos l, x), and

    γ = (f/G) M/G + √(1 − f²/G²) (sin g · v − cos g · u),   v = (cos l, −sin l, 0),   u = (−x sin l, −x cos l, s).

The plane g = π/2 is G²γ3 − f M3 = 0 where (γ, v) > 0; as G²γ3 − f M3 = −G² √(1 − f²/G²) s cos g, motions cross it
upwards while g grows.  On the plane the energy is, with m = μr,

    h = ½ K G² − (f/G) P − √(1 − f²/G²) Q,   K = s² (a1 sin²l + a2 cos²l) + a3 x²,
    P = s (m1 sin l + m2 cos l) + m3 x,   Q = m1 cos l − m2 sin l.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.section import MAX_STEPS, Points, section_points
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson.andoyer_kernels import cross
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody, field
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.parallel import THREADS
from hess_mechanics.numerics.results import Array, Mask, frozen
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = [
    "AndoyerPlane", "AndoyerSection", "andoyer_points", "coordinates", "hess_circle", "hess_curve", "possible",
    "relation", "seeds", "state_at", "states_at",
]


@dataclass(frozen=True)
class AndoyerPlane:
    """The section g = π/2, ġ > 0, of motions with (M, γ) = f."""

    f: float
    sense: int = 1

    def scaled(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """See `section.Surface`.  Raises `InvalidParameter` for systems other than Euler–Poisson."""
        if system is not SYSTEM:
            raise InvalidParameter("Andoyer–Deprit variables are those of the Euler–Poisson equations.")
        return cross, np.array([self.f / problem.scale[0]]), 0.0


def _factors(body: HeavyBody, l: Array, x: Array) -> tuple[Array, Array, Array]:
    """K, P, Q of the energy on the plane, see the module."""
    a1, a2, a3 = body.a
    m1, m2, m3 = (body.mu * r for r in body.r)
    s = np.sqrt(np.maximum(0.0, 1.0 - x * x))
    sin, cos = np.sin(l), np.cos(l)
    return (s * s * (a1 * sin**2 + a2 * cos**2) + a3 * x * x, s * (m1 * sin + m2 * cos) + m3 * x, m1 * cos - m2 * sin)


_SCAN = 96
_ROUGH = 24
_CELLS = (96, 64)


def _scan(body: HeavyBody, h: float, f: float, l: Array, x: Array, count: int = _SCAN) -> tuple[Array, Array, Array]:
    """G (n, m) from the largest possible down to |f|, the energy minus h there, and K, P, Q (3, n)."""
    factors = np.stack(_factors(body, l, x))
    K, P, Q = factors[:, :, None]
    # The potential is at least −|m|, so above this G the energy exceeds h.
    top = np.sqrt(np.maximum(0.0, 2.0 * (h + body.strength) / K))
    smallest = abs(f) if f else 0.0
    share = np.linspace(0.0, 1.0, count) ** 2
    top = np.maximum(top, smallest)
    G = np.maximum(smallest, top + (smallest - top) * share)
    return G, _energy(G, f, K, P, Q) - h, factors


def _energy(G: Array, f: float, K: Array, P: Array, Q: Array) -> Array:
    ratio = f / G if f != 0.0 else np.zeros_like(G)
    energy: Array = 0.5 * K * G * G - ratio * P - np.sqrt(np.maximum(0.0, 1.0 - ratio * ratio)) * Q
    return energy


def momenta(body: HeavyBody, h: float, f: float, l: Array, x: Array) -> Array:
    """The largest G ≥ |f| (n,) with the energy h at points l, x (n,) of the plane; NaN where there is none.

    Raises `InvalidParameter`.
    """
    require_finite(h=h, f=f)
    l, x = np.array(l, float, ndmin=1), np.array(x, float, ndmin=1)
    if not (np.all(np.isfinite(l)) and np.all(np.abs(x) <= 1.0)):
        raise InvalidParameter("On the section l is an angle and x = L/G lies between −1 and 1.")
    G, excess, (K, P, Q) = _scan(body, h, f, l, x)
    if f == 0.0:
        return np.asarray(np.sqrt(np.where(h + Q >= 0.0, 2.0 * (h + Q) / K, np.nan)), float)
    below = excess <= 0.0
    found = below.any(axis=1) & (excess[:, 0] >= -1e-12 * (abs(h) + body.strength))
    first = np.maximum(np.argmax(below, axis=1), 1)
    rows = np.arange(l.size)
    high, low = G[rows, first - 1], G[rows, first]
    for _ in range(60):
        middle = 0.5 * (high + low)
        above = _energy(middle, f, K, P, Q) > h
        high, low = np.where(above, middle, high), np.where(above, low, middle)
    return np.asarray(np.where(found, 0.5 * (high + low), np.nan), float)


def possible(body: HeavyBody, h: float, f: float, l: Array, x: Array) -> Mask:
    """Whether some G ≥ |f| has an energy of at most h at l, x (n,), accurate enough for a picture."""
    return np.asarray(np.min(_scan(body, h, f, l, x, _ROUGH)[1], axis=1) <= 0.0)


def states_at(body: HeavyBody, h: float, f: float, l: Array, x: Array) -> tuple[Array, Array, Mask]:
    """States (n, 6) of the section at l, x = L/G (n,), G (n,), and whether g grows through π/2 there (n,).

    G is NaN where no G ≥ |f| has this energy.  Raises `InvalidParameter`.
    """
    G = momenta(body, h, f, l, x)
    safe = np.where(G > 0.0, G, 1.0)
    s, c = np.sqrt(np.maximum(0.0, 1.0 - x * x)), f / safe
    across = np.sqrt(np.maximum(0.0, 1.0 - c * c))
    sin, cos = np.sin(l), np.cos(l)
    y = np.stack([
        safe * s * sin, safe * s * cos, safe * x, c * s * sin + across * cos, c * s * cos - across * sin, c * x])
    rates = np.stack(field(list(y), body.parameters))
    growth = 2.0 * np.sum(y[:3] * rates[:3], axis=0) * y[5] + safe * safe * rates[5] - f * rates[2]
    return y.T, np.where(G > 0.0, G, np.nan), (G > 0.0) & (growth > 0.0)


def state_at(body: HeavyBody, h: float, f: float, l: float, x: float) -> tuple[float, ...]:
    """The state (6,) of the section at (l, x = L/G).

    Raises `InvalidParameter` where no real G ≥ |f| has this energy, or g does not grow through π/2.
    """
    states, G, growing = states_at(body, h, f, np.array([l], float), np.array([x], float))
    if not math.isfinite(G[0]):
        raise InvalidParameter(
            f"At l = {l:.6g}, L/G = {x:.6g} no real G ≥ |f| has the energy h = {h:.6g}: choose a larger h, or another "
            "point.")
    if not growing[0]:
        raise InvalidParameter(
            f"At l = {l:.6g}, L/G = {x:.6g} the angle g does not grow through π/2: choose another point.")
    return tuple(map(float, states[0]))


def coordinates(states: Array) -> Array:
    """(l, L/G) (n, 2) of states (n, 6)."""
    G = np.sqrt(np.sum(states[:, :3] ** 2, axis=1))
    return np.column_stack([np.arctan2(states[:, 0], states[:, 1]), states[:, 2] / np.maximum(G, 1e-300)])


def relation(body: HeavyBody, states: Array) -> Array:
    """r1 M1 + r3 M3 (n,) of states (n, 6); in the Hess case its sign is invariant (`g2p6f1`)."""
    return body.r[0] * states[:, 0] + body.r[2] * states[:, 2]


def hess_curve(body: HeavyBody, l: Array) -> Array:
    """L/G (n,) at l (n,) on the Hess manifold: r1 s sin l + r3 x = 0."""
    r1, _, r3 = body.r
    across = r1 * np.sin(l)
    return np.asarray(-across / np.maximum(np.hypot(r3, across), 1e-300), float)


def hess_circle(body: HeavyBody) -> Array:
    """(l, L/G), (241, 2), of M all the way round across r: also where r lies along an axis, and l hardly changes."""
    turn = np.linspace(-math.pi, math.pi, 241)
    return coordinates(np.column_stack([body.r[2] * np.sin(turn), np.cos(turn), -body.r[0] * np.sin(turn)]))


def seeds(body: HeavyBody, h: float, f: float, window: Sequence[float], count: int) -> list[tuple[float, ...]]:
    """At most `count` states of the section, spread evenly over the possible part of `window` (l0, l1, x0, x1)."""
    l0, l1, x0, x1 = window
    # A low-discrepancy sequence: each of its beginnings fills the window evenly (Roberts, 2018).
    n = np.arange(1.0, 4 * count + 1)
    l = l0 + (l1 - l0) * ((0.5 + 0.7548776662466927 * n) % 1.0)
    x = x0 + (x1 - x0) * ((0.5 + 0.5698402909980532 * n) % 1.0)
    states, _, growing = states_at(body, h, f, l, x)
    return [tuple(map(float, state)) for state in states[growing][:count]]


_TURNS = 40.0
"""Time allowed per crossing, in units of 1/ν; few orbits take longer."""


def time_for(body: HeavyBody, h: float, f: float, crossings: int) -> float:
    """A time in which orbits with the energy h usually cross the plane `crossings` times."""
    speed = math.sqrt(2.0 * max(body.a) * max(h + body.strength, 1e-300))
    return crossings * _TURNS * math.sqrt(max(body.a) / min(body.a)) / speed


def andoyer_points(body: HeavyBody, h: float, f: float, starts: Sequence[Sequence[float]], crossings: int, level: Level,
                   threads: int = THREADS, most_steps: int = MAX_STEPS) -> Points:
    """The first crossings of g = π/2 by each orbit, as in `section_points`.  Raises `InvalidParameter`, `WorkLimit`."""
    return section_points(SYSTEM, starts, body.parameters, AndoyerPlane(f), time_for(body, h, f, crossings), level,
                          crossings, threads, most_steps)


Window = tuple[tuple[float, float], tuple[float, float]]
"""(l0, x0), (l1, x1)."""


@dataclass(frozen=True)
class AndoyerSection:
    """The section g = π/2 of a body at H = h, F1 = f.  Its methods raise `InvalidParameter`."""

    body: HeavyBody
    h: float
    f: float

    def states_at(self, l: Array, x: Array) -> tuple[Array, Mask]:
        """The states (n, 6) at (l, L/G) (n,), and whether motions cross the section there (n,)."""
        states, _, growing = states_at(self.body, self.h, self.f, l, x)
        return states, growing

    def places_of(self, states: Array) -> Array:
        """(l, L/G) (n, 2) of states (n, 6)."""
        return coordinates(states)

    def spread(self, window: Window, count: int) -> tuple[tuple[float, ...], ...]:
        """At most `count` states, spread evenly over what is possible of the window."""
        (l0, x0), (l1, x1) = window
        return tuple(seeds(self.body, self.h, self.f, (l0, l1, x0, x1), count)) if count else ()

    def impossible(self, window: Window) -> Array:
        """Cells (m, n) over the window: 1 where no motion has this energy."""
        (l0, x0), (l1, x1) = window
        m, n = _CELLS
        l, x = np.meshgrid(l0 + (np.arange(m) + 0.5) * (l1 - l0) / m, x0 + (np.arange(n) + 0.5) * (x1 - x0) / n)
        inside = possible(self.body, self.h, self.f, l.ravel(), np.clip(x.ravel(), -1.0, 1.0))
        return frozen(1.0 - inside.reshape(n, m).astype(float))
