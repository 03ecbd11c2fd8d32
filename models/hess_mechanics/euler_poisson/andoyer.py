"""Andoyer–Deprit variables of the Euler–Poisson equations, and the section g = π/2 (figures 11, 13 and 14).

G = |M|, L = M3, (M, γ) = f, x = L/G, s = √(1 − x²); M = G (s sin l, s cos l, x), and

    γ = (f/G) M/G + √(1 − f²/G²) (sin g · v − cos g · u),   v = (cos l, −sin l, 0),   u = (−x sin l, −x cos l, s).

The plane g = π/2 is G²γ3 − f M3 = 0 with (γ, v) > 0; as G²γ3 − f M3 = −G² √(1 − f²/G²) s cos g, motions cross it
upwards while g increases.  On the plane the energy is, with m = μr,

    h = ½ K G² − (f/G) P − √(1 − f²/G²) Q,   K = s² (a1 sin²l + a2 cos²l) + a3 x²,
    P = s (m1 sin l + m2 cos l) + m3 x,   Q = m1 cos l − m2 sin l.

For f ≠ 0 this has up to three roots G ≥ |f|: with cos α = |f|/G, h = ½ K f² (1 + tan²α) − sgn(f) P cos α − Q sin α.
So the section is covered by up to three sheets, numbered from 0 in the order of decreasing G.  The third sheet needs
f P < 0 and Q < 0; if there are only two, a state is on the second exactly if ∂h/∂G < 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics import parameters as known
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.motions import body_parameters, section_motions, with_default
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson.andoyer_kernels import cross, least_excess, roots_into
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody, field
from hess_mechanics.numerics.results import Array, Mask, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = [
    "SECTION",
    "SHEETS",
    "AndoyerPlane",
    "AndoyerSection",
    "coordinates",
    "hess_circle",
    "hess_curve",
    "relation",
]


Sheets = NDArray[np.int64]


@dataclass(frozen=True)
class AndoyerPlane:
    """The surface g = π/2 of motions with (M, γ) = f, by default crossed while g increases.

    Parameters
    ----------
    f : float
        Area integral (M, γ), any finite number, in units I/T.
    sense : {1, -1, 0}, default 1
        Crossings that count: with increasing g (1), with decreasing g (−1), or both (0).

    References
    ----------
    Figures 11, 13 and 14.

    Examples
    --------
    >>> from hess_mechanics import AndoyerPlane, HeavyBody, section
    >>> body = HeavyBody.hess((1.0, 1.5, 2.0), 3.0)
    >>> start = (1.0, 0.5, 0.3, 0.6, 0.0, 0.8)
    >>> result = section(body, start, AndoyerPlane(f=0.84), 20.0, "standard")
    >>> len(result.times)
    5
    """

    f: float
    sense: int = 1

    def gradient(self, state: Array) -> Array:
        """Return the gradient of G²γ3 − f M3.

        Parameters
        ----------
        state : ndarray of float, shape (6,)
            State (M1, M2, M3, γ1, γ2, γ3).

        Returns
        -------
        ndarray of float, shape (6,)
            Derivatives with respect to the state.
        """
        M, g3 = state[:3], state[5]
        return np.array([*(2.0 * g3 * M[:2]), 2.0 * g3 * M[2] - self.f, 0.0, 0.0, M @ M])

    def crossing_kernel(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """Return the kernel of the surface with its constants in the units of a problem, see `plane_section.Surface`.

        Parameters
        ----------
        system : System
            The Euler–Poisson system.
        problem : Problem
            Initial states and parameters in scaled units.

        Returns
        -------
        kernel : callable
            Kernel that finds the crossings.
        normal : ndarray of float, shape (1,)
            The scaled f.
        offset : float
            Always 0.

        Raises
        ------
        InvalidParameter
            If the system is not that of the Euler–Poisson equations.
        """
        if system is not SYSTEM:
            raise InvalidParameter(f"{system.title} has no Andoyer–Deprit variables: give a HeavyBody.")
        return cross, np.array([self.f / problem.scale[0]]), 0.0


_SCAN = 64
_ROUGH = 24
_CELLS = (96, 64)
SHEETS = 3
"""Largest possible number of sheets: as a function of α, see the module, the energy has at most two extrema."""


def coordinates(states: Array) -> Array:
    """Return the Andoyer–Deprit coordinates (l, L/G) of states.

    Parameters
    ----------
    states : ndarray, shape (n, 6)
        States (M1, M2, M3, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (n, 2)
        Angle l in radians, −π to π, and L/G from −1 to 1; L/G = 0 for M = 0.
    """
    G = np.sqrt(np.sum(states[:, :3] ** 2, axis=1))
    return np.column_stack([np.arctan2(states[:, 0], states[:, 1]), states[:, 2] / np.maximum(G, 1e-300)])


def relation(body: HeavyBody, states: Array) -> Array:
    """Return r1 M1 + r3 M3 of states; in the Hess case its sign is invariant (`g2p6f1`).

    Parameters
    ----------
    body : HeavyBody
        The body.
    states : ndarray, shape (n, 6)
        States (M1, M2, M3, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (n,)
        Values of r1 M1 + r3 M3.
    """
    return body.r[0] * states[:, 0] + body.r[2] * states[:, 2]


def hess_curve(body: HeavyBody, l: Array) -> Array:
    """Return L/G on the Hess manifold, where r1 s sin l + r3 L/G = 0 with s = √(1 − (L/G)²).

    Parameters
    ----------
    body : HeavyBody
        The body, r3 ≥ 0.
    l : ndarray, shape (n,)
        Angles l, in radians.

    Returns
    -------
    ndarray, shape (n,)
        Values of L/G, −1 to 1.
    """
    r1, _, r3 = body.r
    across = r1 * np.sin(l)
    return np.asarray(-across / np.maximum(np.hypot(r3, across), 1e-300), float)


def hess_circle(body: HeavyBody) -> Array:
    """Return the coordinates of a full circle of M normal to r, also for r along Ox1, where l is 0 or ±π.

    Parameters
    ----------
    body : HeavyBody
        The body, r2 = 0.

    Returns
    -------
    ndarray, shape (241, 2)
        Points (l, L/G); l in radians.
    """
    turn = np.linspace(-math.pi, math.pi, 241)
    return coordinates(np.column_stack([body.r[2] * np.sin(turn), np.cos(turn), -body.r[0] * np.sin(turn)]))


@dataclass(frozen=True)
class AndoyerSection(PoincareSection):
    """One sheet of the section g = π/2 of a body at H = h, F1 = f.

    Parameters
    ----------
    body : HeavyBody
        The body.
    h : float
        Energy H, any finite number.
    f : float
        Area integral F1, any finite number.
    sheet : int, default 0
        Number of the sheet, 0 to 2, in the order of decreasing G.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the sheet is out of range.
    """

    body: HeavyBody
    h: float
    f: float
    sheet: int = 0

    names: ClassVar[tuple[str, str]] = ("l", "L/G")
    turns: ClassVar[tuple[float, float]] = (2.0 * math.pi, math.inf)
    window: ClassVar[tuple[tuple[float, float], ...]] = ((-math.pi, math.pi), (-1.0, 1.0))
    system: ClassVar[System] = SYSTEM

    def __post_init__(self) -> None:
        require_finite(h=self.h, f=self.f)
        if self.sheet not in range(SHEETS):
            raise InvalidParameter(f"The section has no sheet {self.sheet}: choose one from 0 to {SHEETS - 1}.")

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters of the body."""
        return self.body.parameters

    @property
    def surface(self) -> AndoyerPlane:
        """The surface g = π/2 for this area integral."""
        return AndoyerPlane(self.f)

    @property
    def slowness(self) -> float:
        """The square root of the ratio of the largest to the smallest moment of inertia."""
        return math.sqrt(max(self.body.a) / min(self.body.a))

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters of the body, h and f."""
        return {**dict(zip(SYSTEM.parameters, self.parameters, strict=True)), "h": self.h, "f": self.f}

    @property
    def integrable(self) -> str:
        """The name of the integrable case at this f, see `HeavyBody.integrable_at`; empty if there is none."""
        return self.body.integrable_at(self.f)

    def at_constant(self, name: str, value: float) -> AndoyerSection:
        """Return the section with another value of one constant.

        Parameters
        ----------
        name : str
            Name of the constant, one of `constants`.
        value : float
            Its new value.

        Returns
        -------
        AndoyerSection
            The other section.

        Raises
        ------
        InvalidParameter
            If the value is not finite, or the moments are too different.
        NotPositiveDefinite
            If an inverse moment is not positive.
        """
        return _section({**self.constants, "sheet": self.sheet, name: value})

    def _factors(self, l: Array, x: Array) -> tuple[Array, Array, Array]:
        """Return K, P, Q of the energy, see the module."""
        a1, a2, a3 = self.body.a
        m1, m2, m3 = (self.body.mu * r for r in self.body.r)
        s = np.sqrt(np.maximum(0.0, 1.0 - x * x))
        sin, cos = np.sin(l), np.cos(l)
        K = s * s * (a1 * sin**2 + a2 * cos**2) + a3 * x * x
        return K, s * (m1 * sin + m2 * cos) + m3 * x, m1 * cos - m2 * sin

    def roots(self, l: Array, x: Array) -> Array:
        """Return all momenta G ≥ |f| with the energy of the section at given points.

        Parameters
        ----------
        l : ndarray, shape (n,)
            Angles l, in radians.
        x : ndarray, shape (n,)
            Values of L/G, −1 to 1.

        Returns
        -------
        ndarray, shape (n, 3)
            Values of G in decreasing order, followed by NaN.

        Raises
        ------
        InvalidParameter
            If a value is not finite or L/G is out of range.
        """
        l, x = np.array(l, float, ndmin=1), np.array(x, float, ndmin=1)
        if not (np.all(np.isfinite(l)) and np.all(np.abs(x) <= 1.0)):
            raise InvalidParameter("An l is not finite or an L/G is beyond ±1: give finite angles l, and −1 ≤ L/G ≤ 1.")
        out = np.full((l.size, SHEETS), np.nan)
        K, P, Q = self._factors(l, x)
        if self.f == 0.0:
            out[:, 0] = np.sqrt(np.where(self.h + Q >= 0.0, 2.0 * (self.h + Q) / K, np.nan))
        else:
            roots_into(float(self.h), float(self.f), self.body.strength, K, P, Q, _SCAN, out)
        return out

    def states_at(self, l: Array, x: Array) -> tuple[Array, Mask]:
        """Return the states at points of the section.

        Parameters
        ----------
        l : ndarray, shape (n,)
            Angles l, in radians.
        x : ndarray, shape (n,)
            Values of L/G, −1 to 1.

        Returns
        -------
        states : ndarray, shape (n, 6)
            States (M1, M2, M3, γ1, γ2, γ3).
        possible : ndarray of bool, shape (n,)
            True for points where motions cross this sheet; the other states mean nothing.

        Raises
        ------
        InvalidParameter
            If a value is not finite or L/G is out of range.
        """
        G = self.roots(l, x)[:, self.sheet]
        safe = np.where(G > 0.0, G, 1.0)
        s, c = np.sqrt(np.maximum(0.0, 1.0 - x * x)), self.f / safe
        across = np.sqrt(np.maximum(0.0, 1.0 - c * c))
        sin, cos = np.sin(l), np.cos(l)
        y = np.stack(
            [safe * s * sin, safe * s * cos, safe * x, c * s * sin + across * cos, c * s * cos - across * sin, c * x]
        )
        rates = np.stack(field(list(y), self.parameters))
        growth = 2.0 * np.sum(y[:3] * rates[:3], axis=0) * y[5] + safe * safe * rates[5] - self.f * rates[2]
        return y.T, (G > 0.0) & (growth > 0.0)

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie, on any sheet.

        Parameters
        ----------
        states : ndarray, shape (n, 6)
            States of the section.

        Returns
        -------
        ndarray, shape (n, 2)
            Angle l in radians, and L/G.
        """
        return coordinates(states)

    def sheet_of(self, states: Array) -> Sheets:
        """Return the sheet of each state: the number of larger roots G at its (l, L/G).

        Parameters
        ----------
        states : ndarray, shape (n, 6)
            States of the section.

        Returns
        -------
        ndarray of int, shape (n,)
            Sheets, 0 to 2.
        """
        f, (l, x) = self.f, coordinates(states).T
        G = np.sqrt(np.sum(states[:, :3] ** 2, axis=1))
        K, P, Q = self._factors(l, x)
        ratio = f / np.maximum(G, 1e-300)
        across = np.sqrt(np.maximum(0.0, 1.0 - ratio * ratio))
        sheets = np.where((K * G * G + ratio * P) * across < ratio * ratio * Q, 1, 0)
        # On the third sheet ∂h/∂G > 0 as on the first, with ∂h/∂G < 0 for some larger α = arccos |f|/G.  This
        # requires K f² tan α/cos²α < √(P² + Q²).
        steep = K * G**3 * across < abs(f) * np.hypot(P, Q)
        unsure = np.flatnonzero((sheets == 0) & (f * P < 0.0) & (Q < 0.0) & steep) if f else np.empty(0, int)
        if unsure.size:
            larger = self.roots(l[unsure], x[unsure]) > G[unsure, None] * (1.0 + 1e-9)
            sheets[unsure] = np.where(larger.sum(axis=1) == 2, 2, 0)
        return sheets

    def is_on(self, states: Array) -> Mask:
        """Return True for states on this sheet.

        Parameters
        ----------
        states : ndarray, shape (n, 6)
            States of the section.

        Returns
        -------
        ndarray of bool, shape (n,)
            True for the states on this sheet.
        """
        return np.asarray(self.sheet_of(states) == self.sheet)

    def possible(self, l: Array, x: Array) -> Mask:
        """Return True where some G ≥ |f| has an energy of at most h, as exactly as a plot needs.

        Parameters
        ----------
        l : ndarray, shape (n,)
            Angles l, in radians.
        x : ndarray, shape (n,)
            Values of L/G, −1 to 1.

        Returns
        -------
        ndarray of bool, shape (n,)
            True for possible points.
        """
        least = np.empty(l.size)
        least_excess(float(self.h), float(self.f), self.body.strength, *self._factors(l, x), _ROUGH, least)
        return np.asarray(least <= 0.0)

    def forbidden_cells(self, window: Window) -> Array:
        """Return the forbidden region of a window, as cells.

        Parameters
        ----------
        window : ((float, float), (float, float))
            Lower left and upper right corner (l, L/G) of the window.

        Returns
        -------
        ndarray, shape (64, 96)
            1 where this sheet has no motion of this energy, otherwise 0; rows have increasing L/G.
        """
        (l0, x0), (l1, x1) = window
        m, n = _CELLS
        grid = np.meshgrid(centres(l0, l1, m), centres(x0, x1, n))
        l, x = grid[0].ravel(), np.clip(grid[1].ravel(), -1.0, 1.0)
        inside = self.states_at(l, x)[1] if self.sheet else self.possible(l, x)
        return as_read_only(1.0 - inside.reshape(n, m).astype(float))


def _section(values: Mapping[str, float]) -> AndoyerSection:
    a1, a2, a3, r1, r2, r3, mu = (values[name] for name in SYSTEM.parameters)
    body = HeavyBody((a1, a2, a3), (r1, r2, r3), mu)
    return AndoyerSection(body, values["h"], values["f"], int(values["sheet"]))


SECTION = section_motions(
    "euler-poisson-section",
    "Euler–Poisson, a point of the Andoyer–Deprit section",
    (
        *body_parameters(SYSTEM, 1.0, 0.625, 0.25, 0.6, 0.0, 0.8, 1.0),
        with_default(known.H_HEAVY, 1.5),
        with_default(known.F_HEAVY, -0.7),
        known.SHEET,
    ),
    (known.L, known.X),
    _section,
    SYSTEM,
)
"""Motions from the section g = π/2."""
