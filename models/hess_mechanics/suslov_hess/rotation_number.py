"""Rotation number of the Suslov–Hess torus over its parameters (a, h, f), and of a perturbed map that is not Möbius.

`circle_map` uses the lift Θ(φ) = φ + 2ζ + 2 arg(1 + (β/α) e^{−iφ}), where ζ is the lift of arg α.  With a harmonic that
no Möbius map has,

    Θ_ε(φ) = Θ(φ + ε sin 3φ),  3|ε| < 1,

is still one-to-one, but locks at other rational numbers too.  This answers the open problem at the end of the paper's
appendix for these tori.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.measured import SAFETY
from hess_mechanics.numerics.results import Array, Mask, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import f_max, f_max_of_energies, h_min
from hess_mechanics.suslov_hess.circle_map import (
    check_a,
    circle_map,
    discriminants,
    matrices,
    neighbours,
    rotation_numbers_of,
)
from hess_mechanics.suslov_hess.mode_locking import critical_a_of_tori, tongue_boundary

__all__ = [
    "PLANES",
    "TURNS",
    "ParameterLine",
    "PeriodicTorus",
    "Torus",
    "TorusValues",
    "concatenate",
    "parameter_at",
    "periodic_torus",
    "perturbations_along",
    "perturbed_rotation",
    "plateaus",
    "possible_part",
    "return_error",
    "rotation_errors",
    "rows",
    "rows_error",
    "tongue_curve",
    "values_along",
    "values_at",
]

PLANES = ("h, f", "h, a", "f, a")
"""Planes of parameters: horizontal axis, vertical axis."""

MAX_POINTS = 1_000_000
TURNS = 1500
"""Number of returns of a perturbed map over which ρ is averaged."""
_TERM = 3
"""The harmonic that breaks the Möbius form."""
_NEAR_SEPARATRIX = 1e-9
_MARGIN = 0.03


@dataclass(frozen=True)
class Torus:
    """Parameters of one torus, in units b = 1.

    Parameters
    ----------
    a : float
        Inertia parameter a = I23/I22, |a| ≤ 1e6.
    h : float
        Energy; motion needs h > −1.
    f : float
        Area integral; motion needs |f| ≤ f_max(h).
    """

    a: float
    h: float
    f: float

    def with_values(self, **values: float) -> Torus:
        """Return the torus with some parameters replaced.

        Parameters
        ----------
        **values : float
            New values of a, h or f, by name.

        Returns
        -------
        Torus
            The new torus.
        """
        return Torus(**{**vars(self), **values})

    def range_of(self, name: str) -> tuple[float, float]:
        """Return the range of a parameter for which motion is possible, given the others.

        Parameters
        ----------
        name : str
            Name of the parameter, "a", "h" or "f".

        Returns
        -------
        (float, float)
            Lower and upper bound; ±∞ where there is no limit, (0, 0) for f if h ≤ −1.

        Raises
        ------
        InvalidParameter
            If the h that bounds f, or the f that bounds h, is too large or not finite.
        """
        if name == "h":
            return h_min(self.f), math.inf
        last = math.inf if name == "a" else f_max(self.h) if self.h > -1.0 else 0.0
        return -last, last


@dataclass(frozen=True)
class ParameterLine:
    """Tori on a line in the space of parameters, along which one parameter varies.

    Parameters
    ----------
    name : str
        Name of the parameter that varies, "a", "h" or "f".
    torus : Torus
        A torus with the values of the other parameters.
    low, high : float
        Ends of the line, in units b = 1.
    """

    name: str
    torus: Torus
    low: float
    high: float

    @property
    def ends(self) -> tuple[float, float]:
        """The two ends of the line, (low, high)."""
        return self.low, self.high

    def value_of(self, torus: Torus) -> float:
        """Return the value of the varying parameter for a torus.

        Parameters
        ----------
        torus : Torus
            The torus.

        Returns
        -------
        float
            The value.
        """
        return float(vars(torus)[self.name])

    def values(self, count: int) -> Array:
        """Return equidistant values of the varying parameter, both ends included.

        Parameters
        ----------
        count : int
            Number of values.

        Returns
        -------
        ndarray, shape (count,)
            The values.
        """
        return np.linspace(self.low, self.high, count)

    def tori(self, values: Array | float) -> dict[str, Any]:
        """Return all parameters of tori of the line.

        Parameters
        ----------
        values : float or ndarray, shape (n,)
            Values of the varying parameter.

        Returns
        -------
        dict
            Parameters a, h and f, by name.
        """
        return {**vars(self.torus), self.name: values}


def possible_part(line: ParameterLine) -> ParameterLine:
    """Return the part of a line where motion is possible, widened at each end by 3 % but not beyond the line.

    Parameters
    ----------
    line : ParameterLine
        The line.

    Returns
    -------
    ParameterLine
        The shorter line; the whole line if no motion is possible on it.  A line along h never goes below −1 + 1e-9.
    """
    first, last = line.torus.range_of(line.name)
    low, high = max(line.low, first), min(line.high, last)
    room = _MARGIN * (high - low)
    bottom = -1.0 + 1e-9 if line.name == "h" else -math.inf
    if room <= 0.0:
        return replace(line, low=max(bottom, line.low))
    return replace(line, low=max(bottom, line.low, first - room), high=min(line.high, last + room))


@dataclass(frozen=True)
class TorusValues(Result):
    """Values at n tori; NaN (False for `locked`) where there is no torus.

    Attributes
    ----------
    rho : ndarray of float, shape (n,)
        Rotation number in turns per return.
    trace : ndarray of float, shape (n,)
        |t| = |2 Re α|; ∞ beyond the range of doubles.
    locked : ndarray of bool, shape (n,)
        True if the map locks.
    possible : ndarray of bool, shape (n,)
        True if there is a torus; False outside the region and within 1e-9 of the separatrix (1, 0).
    """

    rho: Array
    trace: Array
    locked: Mask
    possible: Mask

    def labels(self) -> Labels:
        """Return all values with names and units, over the index of the torus.

        Returns
        -------
        Labels
            Rotation number, trace, locking and possibility.
        """
        named = {"ρ": self.rho, "trace": self.trace, "locked": self.locked, "possible": self.possible}
        return Labels({}, {name: (("torus",), values) for name, values in named.items()}, {"ρ": "turns", "trace": "1"})


@dataclass(frozen=True)
class PeriodicTorus:
    """A torus with a rational rotation number p/q.

    Attributes
    ----------
    torus : Torus
        Its parameters.
    defect : float
        Largest |Θ^q(φ) − φ|, in radians; of the size of round-off if every orbit closes, large if the map locks.
    """

    torus: Torus
    defect: float


def _together(*numbers: Array | float) -> Iterator[Array]:
    """Yield the arguments broadcast to arrays of equal shape."""
    try:
        return (np.ascontiguousarray(x, float) for x in np.broadcast_arrays(*np.atleast_1d(*numbers)))
    except ValueError as error:
        raise InvalidParameter(f"a, h and f must be numbers or arrays of one shape: {error}.") from error


def values_at(a: Array | float, h: Array | float, f: Array | float, accuracy: Accuracy) -> TorusValues:
    """Return rotation number, trace and locking of tori.

    Parameters
    ----------
    a, h, f : float or array_like, shape (n,)
        Parameters in units b = 1; arrays are broadcast against each other.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    TorusValues
        The values, NaN where there is no torus.

    Raises
    ------
    InvalidParameter
        If a value is not finite, |a| or |h| is too large, or the arrays do not broadcast.
    WorkLimit
        If there are more than a million tori, the arrays have two or more axes, or a torus needs too many steps.
    """
    level = as_level(accuracy)
    a, h, f = _together(a, h, f)
    if a.ndim != 1 or a.size > MAX_POINTS:
        raise WorkLimit(f"At most {MAX_POINTS} tori, in flat arrays, are allowed: flatten them or choose fewer points.")
    if not (np.all(np.isfinite(f)) and np.all(np.abs(h) <= 1e12)):
        raise InvalidParameter("An h or f is not finite, or |h| exceeds 1e12: choose finite h and f, and |h| ≤ 1e12.")
    check_a(float(np.max(np.abs(a), initial=0.0)))
    energies, back = np.unique(h, return_inverse=True)
    edge = np.where(energies > -1.0, f_max_of_energies(np.maximum(energies, -1.0)), -1.0)[back]
    possible = (np.abs(f) <= edge) & (np.hypot(h - 1.0, f) > _NEAR_SEPARATRIX)
    rows = np.zeros((a.size, 6))
    rows[possible] = matrices(a[possible], h[possible], np.abs(f[possible]), level)
    discriminant = discriminants(rows)
    rho = np.where(possible, np.where(f < 0.0, -1.0, 1.0) * rotation_numbers_of(rows), np.nan)
    with np.errstate(over="ignore"):
        trace = np.where(possible, 2.0 * np.abs(rows[:, 0]) * np.exp(np.minimum(rows[:, 3], 710.0)), np.nan)
    return TorusValues(
        as_read_only(rho), as_read_only(trace), as_read_only(possible & (discriminant > 0.0)), as_read_only(possible)
    )


def rotation_errors(a: Array | float, h: Array | float, f: Array | float, accuracy: Accuracy) -> Array:
    """Return estimated errors of the rotation numbers of `values_at`.

    They compare ρ with that of the `neighbours` at a hundredth of the tolerance.

    Parameters
    ----------
    a, h, f : float or array_like, shape (n,)
        Parameters in units b = 1; arrays are broadcast against each other.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    ndarray, shape (n,)
        Errors in turns per return; NaN if there is no torus.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    level = as_level(accuracy)
    energies, fs = np.broadcast_arrays(*np.atleast_1d(h, f))
    aside = neighbours(energies, fs, f_max_of_energies(np.maximum(energies, -1.0)))
    coarse, fine = values_at(a, h, f, level).rho, values_at(a, *aside, level.tighter()).rho
    return as_read_only(SAFETY * np.abs(coarse - fine) + 4e-16)


def tongue_curve(plane: str, torus: Torus, window: Sequence[float], accuracy: Accuracy, points: int = 48) -> Array:
    """Return the boundary |t| = 2 of the Arnold tongue ρ = 0, in a plane of parameters through a torus.

    t = 2 Re α is the trace of the circle map.

    Parameters
    ----------
    plane : str
        One of `PLANES`.
    torus : Torus
        The torus.
    window : sequence of float
        Range x0, x1 of the horizontal axis, not used in the plane "h, f"; further numbers are ignored.
    accuracy : str or Level
        Accuracy level.
    points : int, default 48
        Number of points.

    Returns
    -------
    ndarray, shape (n, 2)
        Points of the boundary: in the plane "h, f" those of `tongue_boundary`, f ≥ 0; otherwise the points (h, a) or
        (f, a) with 0 < a < 20, fewer than `points` where there is no such a.

    Raises
    ------
    InvalidParameter
        If a parameter is out of range.
    WorkLimit
        If a torus needs too many steps.
    """
    x0, x1 = window[:2]
    if plane == "h, f":
        return tongue_boundary(torus.a, accuracy, points)
    x = _abscissas(plane, torus, x0, x1, points)
    h, f = np.broadcast_arrays(x, torus.f) if plane == "h, a" else np.broadcast_arrays(torus.h, x)
    curve = np.column_stack([x, critical_a_of_tori(h, np.abs(f), accuracy, 20.0)])
    return as_read_only(curve[np.isfinite(curve[:, 1])])


def _abscissas(plane: str, torus: Torus, x0: float, x1: float, points: int) -> Array:
    """Return values between x0 and x1 where motion is possible; values of f are denser near 0, where a(f) is steep."""
    first, last = torus.range_of(plane[0])
    if plane == "h, a":
        low = max(x0, first + 1e-9)
        return np.linspace(low, x1, points) if low < x1 else np.empty(0)
    ends = np.clip([x0, x1], first * (1.0 - 1e-9), last * (1.0 - 1e-9))
    first, last = np.copysign(np.sqrt(np.abs(ends)), ends).tolist()
    roots = np.linspace(first, last, points)
    return np.asarray(roots * np.abs(roots))


def perturbed_rotation(
    a: Array | float, h: Array | float, f: Array | float, epsilon: float, accuracy: Accuracy, count: int = TURNS
) -> Array:
    """Return the rotation numbers of the perturbed maps Θ_ε(φ) = Θ(φ + ε sin 3φ) of tori, by weighted averages.

    Motion must be possible on all tori, and (h, f) must not be the separatrix (1, 0); this is not checked.

    Parameters
    ----------
    a, h, f : float or array_like, shape (n,)
        Parameters in units b = 1; arrays are broadcast against each other.
    epsilon : float
        Strength ε of the perturbation, |ε| < 1/3.
    accuracy : str or Level
        Accuracy level.
    count : int, default TURNS
        Number of returns over which ρ is averaged.

    Returns
    -------
    ndarray, shape (n,)
        Rotation numbers in turns per return.

    Raises
    ------
    InvalidParameter
        If |ε| ≥ 1/3, ε is not finite, or the arrays do not broadcast.
    WorkLimit
        If a torus needs too many steps.
    """
    level = as_level(accuracy)
    require_finite(epsilon=epsilon)
    if _TERM * abs(epsilon) >= 1.0:
        raise InvalidParameter(
            f"ε = {epsilon:g} folds the circle map, which then has no rotation number: choose |ε| < 1/3."
        )
    a, h, f = _together(a, h, f)
    sign = np.where(f < 0.0, -1.0, 1.0)
    re, im, im_beta, _, zeta, _ = matrices(a, h, np.abs(f), level).T
    ratio = 1j * im_beta / (re + 1j * im)
    phi = np.zeros(re.size)
    t = (np.arange(count) + 0.5) / count
    weights = np.exp(-1.0 / (t * (1.0 - t)))
    total = np.zeros(re.size)
    for weight in weights / weights.sum():
        # Θ of −f is the mirror image φ → π − φ of Θ, in which ε changes sign.
        first = sign * epsilon * np.sin(_TERM * phi)
        turn = first + 2.0 * zeta + 2.0 * np.angle(1.0 + ratio * np.exp(-1j * (phi + first)))
        total += weight * turn
        phi = np.remainder(phi + turn, 2.0 * math.pi)
    return as_read_only(sign * total / (2.0 * math.pi))


def parameter_at(rho: float, line: ParameterLine, accuracy: Accuracy) -> float | None:
    """Return a value of the parameter of a line at which ρ has a given value.

    Parameters
    ----------
    rho : float
        Rotation number, in turns per return.
    line : ParameterLine
        The line.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    float or None
        The first such value; None if ρ does not pass through `rho` between any two neighbours of 121 equidistant tori.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    x, values = line.values(121), values_along(line, 121, accuracy)
    excess = values.rho - rho
    both = values.possible[1:] & values.possible[:-1]
    # The jump of ρ from −½ to ½ is not a root.
    changes = np.flatnonzero(both & (excess[1:] * excess[:-1] <= 0.0) & (np.abs(np.diff(values.rho)) < 0.25))
    if not changes.size:
        return None
    from scipy.optimize import brentq  # Imported here because the import takes 0.3 s.

    i = int(changes[0])
    first, last = x[i : i + 2].tolist()

    def difference(value: float) -> float:
        return float(values_at(**line.tori(value), accuracy=accuracy).rho[0]) - rho

    if difference(first) * difference(last) > 0.0:
        return None
    return float(brentq(difference, first, last, xtol=1e-15, rtol=1e-15))


def return_error(torus: Torus, q: int, accuracy: Accuracy) -> float:
    """Return the largest |Θ^q(φ) − φ| over 64 phases, which is round-off if every orbit closes after q returns.

    Parameters
    ----------
    torus : Torus
        The torus.
    q : int
        Number of returns, positive.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    float
        The error, in radians, 0 to π.

    Raises
    ------
    OutsideRegion, Separatrix, InvalidParameter, WorkLimit
        As `circle_map`.
    """
    theta = circle_map(torus.a, torus.h, torus.f, accuracy)
    phi = np.linspace(-math.pi, math.pi, 64, endpoint=False)
    image = phi
    for _ in range(q):
        image = theta.theta(image)
    return float(np.max(np.abs(np.angle(np.exp(1j * (image - phi))))))


def rows(
    plane: str, torus: Torus, window: Window, cells: tuple[int, int], first: int, last: int, accuracy: Accuracy
) -> TorusValues:
    """Return the values of the tori at the centres of some rows of cells, in a window of a plane of parameters.

    Parameters
    ----------
    plane : str
        One of `PLANES`.
    torus : Torus
        Torus with the value of the third parameter.
    window : ((float, float), (float, float))
        Ranges of the horizontal and the vertical axis.
    cells : (int, int)
        Number of cells across and up, (m, n).
    first, last : int
        The rows are first, …, last − 1.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    TorusValues
        Values row after row, (last − first) × m of each.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    return values_at(**_tori(plane, torus, window, cells, slice(first, last)), accuracy=accuracy)


def _tori(plane: str, torus: Torus, window: Window, cells: tuple[int, int], own: slice) -> dict[str, Array]:
    """Return the parameters of the tori at the centres of cells, for some of their rows."""
    names = plane.split(", ")
    x, y = (centres(*window[i], cells[i]) for i in (0, 1))
    X, Y = np.meshgrid(x, y[own])
    return {**vars(torus), names[0]: X.ravel(), names[1]: Y.ravel()}


def rows_error(plane: str, torus: Torus, window: Window, accuracy: Accuracy) -> float:
    """Return the 99 % quantile of the estimated error of ρ over a window, from 30 × 20 cells.

    Parameters
    ----------
    plane : str
        One of `PLANES`.
    torus : Torus
        Torus with the value of the third parameter.
    window : ((float, float), (float, float))
        Ranges of the horizontal and the vertical axis.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    float
        The error in turns per return; 0 if no torus is possible.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    errors = rotation_errors(**_tori(plane, torus, window, (30, 20), slice(None)), accuracy=accuracy)
    known = errors[np.isfinite(errors)]
    return float(np.quantile(known, 0.99)) if known.size else 0.0


def concatenate(parts: Sequence[TorusValues]) -> TorusValues:
    """Concatenate the values of successive rows of a map.

    Parameters
    ----------
    parts : sequence of TorusValues
        Values of successive rows.

    Returns
    -------
    TorusValues
        All values, in this order.
    """
    return TorusValues(
        *(
            as_read_only(np.concatenate([getattr(part, name) for part in parts]))
            for name in ("rho", "trace", "locked", "possible")
        )
    )


def values_along(line: ParameterLine, count: int, accuracy: Accuracy) -> TorusValues:
    """Return the values of equidistant tori of a line.

    Parameters
    ----------
    line : ParameterLine
        The line.
    count : int
        Number of tori.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    TorusValues
        The values, in the order of the parameter.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    return values_at(**line.tori(line.values(count)), accuracy=accuracy)


def perturbations_along(
    line: ParameterLine, count: int, epsilon: float, accuracy: Accuracy, turns: int = TURNS
) -> Array:
    """Return the perturbed rotation numbers of equidistant tori of a line.

    Parameters
    ----------
    line : ParameterLine
        The line.
    count : int
        Number of tori.
    epsilon : float
        Strength ε of the perturbation, |ε| < 1/3.
    accuracy : str or Level
        Accuracy level.
    turns : int, default TURNS
        Number of returns over which ρ is averaged.

    Returns
    -------
    ndarray, shape (count,)
        Rotation numbers in turns per return; NaN if there is no torus.

    Raises
    ------
    InvalidParameter
        If |ε| ≥ 1/3, or as `values_at`.
    WorkLimit
        As `values_at`.
    """
    x, possible = line.values(count), values_along(line, count, accuracy).possible
    out = np.full(count, np.nan)
    if possible.any():
        out[possible] = perturbed_rotation(**line.tori(x[possible]), epsilon=epsilon, accuracy=accuracy, count=turns)
    return as_read_only(out)


def periodic_torus(rho: Fraction, line: ParameterLine, accuracy: Accuracy) -> PeriodicTorus | None:
    """Return a torus of a line that has a given rational rotation number.

    Parameters
    ----------
    rho : Fraction
        Rotation number, in turns per return.
    line : ParameterLine
        The line.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    PeriodicTorus or None
        The torus with its defect; None if none is found.

    Raises
    ------
    InvalidParameter
        As `values_at`.
    WorkLimit
        As `values_at`.
    """
    value = parameter_at(float(rho), line, accuracy)
    if value is None:
        return None
    torus = Torus(**line.tori(value))
    return PeriodicTorus(torus, return_error(torus, rho.denominator, accuracy))


def plateaus(rho: Array, possible: Mask) -> list[Fraction]:
    """Return the rationals at which a curve of rotation numbers has plateaus, the steps of a devil's staircase.

    Parameters
    ----------
    rho : ndarray, shape (n,)
        Rotation numbers along a line, in turns per return.
    possible : ndarray of bool, shape (n,)
        True where motion is possible.

    Returns
    -------
    list of Fraction
        Values that two neighbours share to 1e-6, with denominators up to 12, sorted by denominator, then by value.
    """
    level = np.flatnonzero(possible[1:] & possible[:-1] & (np.abs(np.diff(rho)) < 1e-6))
    steps = [(Fraction(float(rho[i])).limit_denominator(12), float(rho[i])) for i in level]
    near = {step for step, value in steps if abs(float(step) - value) < 1e-5}
    return sorted(near, key=lambda step: (step.denominator, step))
