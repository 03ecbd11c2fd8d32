"""Andoyer–Deprit variables of the Euler–Poisson equations, and the section g = π/2 (figures 11, 13 and 14).

G = |M|, L = M3, (M, γ) = f, x = L/G, s = √(1 − x²); M = G (s sin l, s cos l, x), and

    γ = (f/G) M/G + √(1 − f²/G²) (sin g · v − cos g · u),   v = (cos l, −sin l, 0),   u = (−x sin l, −x cos l, s).

The plane g = π/2 is G²γ3 − f M3 = 0 where (γ, v) > 0; as G²γ3 − f M3 = −G² √(1 − f²/G²) s cos g, motions cross it
upwards while g grows.  On the plane the energy is, with m = μr,

    h = ½ K G² − (f/G) P − √(1 − f²/G²) Q,   K = s² (a1 sin²l + a2 cos²l) + a3 x²,
    P = s (m1 sin l + m2 cos l) + m3 x,   Q = m1 cos l − m2 sin l.

For f ≠ 0 this has up to three roots G ≥ |f|: with cos α = |f|/G, h = ½ K f² (1 + tan²α) − sgn(f) P cos α − Q sin α.
So the section is covered by up to three sheets, numbered from 0, that of the largest root, in the order of falling G.
The third needs f P < 0 and Q < 0; where there are only two, a state is on the second exactly where ∂h/∂G < 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.section import MAX_STEPS, SectionPoints, section_points
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson.andoyer_kernels import cross, least_excess, roots_into
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody, field
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.parallel import THREADS
from hess_mechanics.numerics.results import Array, Mask, frozen
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = [
    "SHEETS",
    "AndoyerPlane",
    "AndoyerSection",
    "andoyer_points",
    "coordinates",
    "hess_circle",
    "hess_curve",
    "possible",
    "relation",
    "roots",
    "seeds",
    "sheet_of",
    "state_at",
    "states_at",
]


Sheets = NDArray[np.int64]


@dataclass(frozen=True)
class AndoyerPlane:
    """The section g = π/2, ġ > 0, of motions with (M, γ) = f."""

    f: float
    sense: int = 1

    def gradient(self, state: Array) -> Array:
        """Of G²γ3 − f M3 (6,)."""
        M, g3 = state[:3], state[5]
        return np.array([*(2.0 * g3 * M[:2]), 2.0 * g3 * M[2] - self.f, 0.0, 0.0, M @ M])

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


_SCAN = 64
_ROUGH = 24
_CELLS = (96, 64)


SHEETS = 3
"""More there cannot be: as a function of α, see the module, the energy turns round twice at most."""
_ORDINALS = ("largest", "second", "third")


def _check_places(h: float, f: float, l: Array, x: Array) -> tuple[Array, Array]:
    require_finite(h=h, f=f)
    l, x = np.array(l, float, ndmin=1), np.array(x, float, ndmin=1)
    if not (np.all(np.isfinite(l)) and np.all(np.abs(x) <= 1.0)):
        raise InvalidParameter("On the section l is an angle and x = L/G lies between −1 and 1.")
    return l, x


def roots(body: HeavyBody, h: float, f: float, l: Array, x: Array) -> Array:
    """All G ≥ |f| with the energy h at points l, x (n,) of the plane, falling; shape (n, SHEETS), NaN where fewer.

    Raises `InvalidParameter`.
    """
    l, x = _check_places(h, f, l, x)
    out = np.full((l.size, SHEETS), np.nan)
    if f == 0.0:
        K, _, Q = _factors(body, l, x)
        out[:, 0] = np.sqrt(np.where(h + Q >= 0.0, 2.0 * (h + Q) / K, np.nan))
        return out
    roots_into(float(h), float(f), body.strength, *_factors(body, l, x), _SCAN, out)
    return out


def momenta(body: HeavyBody, h: float, f: float, l: Array, x: Array, sheet: int = 0) -> Array:
    """The G (n,) of that sheet with the energy h at points l, x (n,) of the plane; NaN where there is none.

    Raises `InvalidParameter`.
    """
    if sheet not in range(SHEETS):
        raise InvalidParameter(f"The section has at most {SHEETS} sheets: choose one from 0 to {SHEETS - 1}.")
    return roots(body, h, f, l, x)[:, sheet]


def sheet_of(body: HeavyBody, h: float, f: float, states: Array) -> Sheets:
    """On which sheet states (n, 6) of the section are, (n,): how many roots G at their (l, L/G) are larger."""
    l, x = coordinates(states).T
    G = np.sqrt(np.sum(states[:, :3] ** 2, axis=1))
    K, P, Q = _factors(body, l, x)
    ratio = f / np.maximum(G, 1e-300)
    across = np.sqrt(np.maximum(0.0, 1.0 - ratio * ratio))
    found = np.where((K * G * G + ratio * P) * across < ratio * ratio * Q, 1, 0)
    # The third sheet rises as the first does, and falls for some larger α = arccos |f|/G: only where
    # K f² tan α/cos²α < √(P² + Q²).
    steep = K * G**3 * across < abs(f) * np.hypot(P, Q)
    unsure = np.flatnonzero((found == 0) & (f * P < 0.0) & (Q < 0.0) & steep) if f else np.empty(0, int)
    if unsure.size:
        larger = roots(body, h, f, l[unsure], x[unsure]) > G[unsure, None] * (1.0 + 1e-9)
        found[unsure] = np.where(larger.sum(axis=1) == 2, 2, 0)
    return found


def possible(body: HeavyBody, h: float, f: float, l: Array, x: Array) -> Mask:
    """Whether some G ≥ |f| has an energy of at most h at l, x (n,), accurate enough for a picture."""
    least = np.empty(l.size)
    least_excess(float(h), float(f), body.strength, *_factors(body, l, x), _ROUGH, least)
    return np.asarray(least <= 0.0)


def states_at(body: HeavyBody, h: float, f: float, l: Array, x: Array, sheet: int = 0) -> tuple[Array, Array, Mask]:
    """States (n, 6) of a sheet at l, x = L/G (n,), G (n,), and whether g grows through π/2 there (n,).

    G is NaN where that sheet has no G ≥ |f| of this energy.  Raises `InvalidParameter`.
    """
    G = momenta(body, h, f, l, x, sheet)
    safe = np.where(G > 0.0, G, 1.0)
    s, c = np.sqrt(np.maximum(0.0, 1.0 - x * x)), f / safe
    across = np.sqrt(np.maximum(0.0, 1.0 - c * c))
    sin, cos = np.sin(l), np.cos(l)
    y = np.stack(
        [safe * s * sin, safe * s * cos, safe * x, c * s * sin + across * cos, c * s * cos - across * sin, c * x]
    )
    rates = np.stack(field(list(y), body.parameters))
    growth = 2.0 * np.sum(y[:3] * rates[:3], axis=0) * y[5] + safe * safe * rates[5] - f * rates[2]
    return y.T, np.where(G > 0.0, G, np.nan), (G > 0.0) & (growth > 0.0)


def state_at(body: HeavyBody, h: float, f: float, l: float, x: float, sheet: int = 0) -> tuple[float, ...]:
    """The state (6,) of a sheet of the section at (l, x = L/G).

    Raises `InvalidParameter` where that sheet has no real G ≥ |f| of this energy, or g does not grow through π/2.
    """
    states, G, growing = states_at(body, h, f, np.array([l], float), np.array([x], float), sheet)
    if sheet and not math.isfinite(G[0]):
        raise InvalidParameter(
            f"At l = {l:.6g}, L/G = {x:.6g} there is no {_ORDINALS[sheet]} root G ≥ |f| with the energy h = {h:.6g}: "
            "choose the largest one, sheet 0, or another point."
        )
    if not math.isfinite(G[0]):
        raise InvalidParameter(
            f"At l = {l:.6g}, L/G = {x:.6g} no real G ≥ |f| has the energy h = {h:.6g}: choose a larger h, or another "
            "point."
        )
    if not growing[0]:
        raise InvalidParameter(
            f"At l = {l:.6g}, L/G = {x:.6g} the angle g does not grow through π/2: choose another point."
        )
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


_TRIED = (4, 200, 200)
"""Places tried for each seed of a sheet: where the second exists, g hardly ever grows on it."""


def seeds(
    body: HeavyBody, h: float, f: float, window: Sequence[float], count: int, sheet: int = 0
) -> list[tuple[float, ...]]:
    """At most `count` states of a sheet, spread evenly over the possible part of `window` (l0, l1, x0, x1)."""
    l0, l1, x0, x1 = window
    # A low-discrepancy sequence: each of its beginnings fills the window evenly (Roberts, 2018).
    n = np.arange(1.0, _TRIED[sheet] * count + 1)
    l = l0 + (l1 - l0) * ((0.5 + 0.7548776662466927 * n) % 1.0)
    x = x0 + (x1 - x0) * ((0.5 + 0.5698402909980532 * n) % 1.0)
    states, _, growing = states_at(body, h, f, l, x, sheet)
    return [tuple(map(float, state)) for state in states[growing][:count]]


_TURNS = 40.0
"""Time allowed per crossing, in units of 1/ν; few orbits take longer."""


def time_for(body: HeavyBody, h: float, f: float, crossings: int) -> float:
    """A time in which orbits with the energy h usually cross the plane `crossings` times."""
    speed = math.sqrt(2.0 * max(body.a) * max(h + body.strength, 1e-300))
    return crossings * _TURNS * math.sqrt(max(body.a) / min(body.a)) / speed


def andoyer_points(
    body: HeavyBody,
    h: float,
    f: float,
    starts: Sequence[Sequence[float]],
    crossings: int,
    level: Accuracy,
    threads: int = THREADS,
    most_steps: int = MAX_STEPS,
) -> SectionPoints:
    """The first crossings of g = π/2 by each orbit, as in `section_points`.  Raises `InvalidParameter`, `WorkLimit`."""
    return section_points(
        body, starts, AndoyerPlane(f), time_for(body, h, f, crossings), level, crossings, threads, most_steps
    )


@dataclass(frozen=True)
class AndoyerSection(PoincareSection):
    """One sheet of the section g = π/2 of a body at H = h, F1 = f.  Its methods raise `InvalidParameter`."""

    body: HeavyBody
    h: float
    f: float
    sheet: int = 0

    names: ClassVar[tuple[str, str]] = ("l", "L/G")
    turns: ClassVar[tuple[float, float]] = (2.0 * math.pi, math.inf)
    window: ClassVar[tuple[tuple[float, float], ...]] = ((-math.pi, math.pi), (-1.0, 1.0))
    system: ClassVar[System] = SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """Of the body."""
        return self.body.parameters

    @property
    def surface(self) -> AndoyerPlane:
        """g = π/2 at this area integral."""
        return AndoyerPlane(self.f)

    @property
    def slowness(self) -> float:
        """√ of the ratio of the moments of inertia."""
        return math.sqrt(max(self.body.a) / min(self.body.a))

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters of the body, h and f."""
        return {**dict(zip(SYSTEM.parameters, self.parameters, strict=True)), "h": self.h, "f": self.f}

    @property
    def integrable(self) -> str:
        """The integrable case of the body, see `HeavyBody.integrable_at`."""
        return self.body.integrable_at(self.f)

    def moved(self, name: str, value: float) -> AndoyerSection:
        """With another value of a constant."""
        if name in ("h", "f"):
            return replace(self, h=value) if name == "h" else replace(self, f=value)
        p = tuple(
            value if one == name else other for one, other in zip(SYSTEM.parameters, self.parameters, strict=True)
        )
        return replace(self, body=HeavyBody((p[0], p[1], p[2]), (p[3], p[4], p[5]), p[6]))

    def states_at(self, l: Array, x: Array) -> tuple[Array, Mask]:
        """The states (n, 6) at (l, L/G) (n,), and whether motions cross this sheet there (n,)."""
        states, _, growing = states_at(self.body, self.h, self.f, l, x, self.sheet)
        return states, growing

    def places_of(self, states: Array) -> Array:
        """(l, L/G) (n, 2) of states (n, 6), on whichever sheet."""
        return coordinates(states)

    def is_on(self, states: Array) -> Mask:
        """Whether states (n, 6) of the section are on this sheet, (n,)."""
        return np.asarray(sheet_of(self.body, self.h, self.f, states) == self.sheet)

    def spread(self, window: Window, count: int) -> tuple[tuple[float, ...], ...]:
        """At most `count` states of this sheet, spread evenly over what is possible of the window."""
        (l0, x0), (l1, x1) = window
        return tuple(seeds(self.body, self.h, self.f, (l0, l1, x0, x1), count, self.sheet)) if count else ()

    def impossible(self, window: Window) -> Array:
        """Cells (m, n) over the window: 1 where this sheet has no motion of this energy."""
        (l0, x0), (l1, x1) = window
        m, n = _CELLS
        grid = np.meshgrid(centres(l0, l1, m), centres(x0, x1, n))
        l, x = grid[0].ravel(), np.clip(grid[1].ravel(), -1.0, 1.0)
        inside = self.states_at(l, x)[1] if self.sheet else possible(self.body, self.h, self.f, l, x)
        return frozen(1.0 - inside.reshape(n, m).astype(float))
