"""Sections of any system: a variable passes a value, and one or two other variables are the coordinates.

The remaining variables follow from first integrals with given values, by Newton's method.  Angles of the system count
up to full turns.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hess_mechanics.dynamics.plane_section import AnglePlane, Plane
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.system import ParametrizedSystem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.arguments import as_number, as_pairs
from hess_mechanics.numerics.results import Array, Mask

__all__ = ["VariableSection", "variable_section"]

_STEP = 6e-6
"""Step of central differences, relative to the size of a variable."""
_ITERATIONS = 100
_FAR = 10.0
"""Initial value of Newton's method, of either sign, meant to lie beyond the outermost root, in units of the example's
size."""
_ROUNDING = 1e-13
_NEAR = 1e-12
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class VariableSection(PoincareSection):
    """The section variable = value, crossed with increasing (sense 1) or decreasing (−1) variable.

    Parameters
    ----------
    body : ParametrizedSystem
        The system with values of its parameters.
    variable : str
        The variable that passes the value.
    value : float
        The value.
    coordinates : tuple of str
        One or two other variables.
    dependent_variables : tuple of str
        The variables that follow from the integrals.
    integrals : tuple of (str, float)
        Names and values of the integrals, one for each of `dependent_variables`.
    ranges : tuple of (float, float)
        Range of each coordinate.
    sense : int, default 1
        1 or −1.
    """

    body: ParametrizedSystem
    variable: str
    value: float
    coordinates: tuple[str, ...]
    dependent_variables: tuple[str, ...]
    integrals: tuple[tuple[str, float], ...]
    ranges: tuple[tuple[float, float], ...]
    sense: int = 1

    slowness = 1.0

    @property
    def system(self) -> System:
        """The equations of motion."""
        return self.body.system

    @property
    def parameters(self) -> tuple[float, ...]:
        """Values of the parameters."""
        return self.body.parameters

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return self.coordinates

    @property
    def turns(self) -> tuple[float, ...]:
        """Period of each coordinate, ∞ if it is not an angle."""
        return tuple(_TURN if name in self.system.angles else math.inf for name in self.names)

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        """Range of each coordinate."""
        return self.ranges

    @property
    def surface(self) -> Plane | AnglePlane:
        """The plane variable = value; for an angle all such planes up to full turns."""
        if self.variable in self.system.angles:
            return AnglePlane(self._index(self.variable), self.value, self.sense)
        normal = tuple(float(name == self.variable) for name in self.system.variables)
        return Plane(normal, self.value, self.sense)

    @property
    def constants(self) -> Mapping[str, float]:
        """The parameters, and the values of the integrals."""
        return {**dict(zip(self.system.parameters, self.parameters, strict=True)), **dict(self.integrals)}

    def at_constant(self, name: str, value: float) -> VariableSection:
        """Return the section with another value of one constant.

        Parameters
        ----------
        name : str
            Name of the constant, one of `constants`.
        value : float
            Its new value.

        Returns
        -------
        VariableSection
            The other section.

        Raises
        ------
        InvalidParameter
            If the new value of a parameter is not finite.
        """
        if name in self.system.parameters:
            return replace(self, body=self.system.at(self.parameters, **{name: value}))
        return replace(self, integrals=tuple((own, value if own == name else x) for own, x in self.integrals))

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States of the section.

        Returns
        -------
        ndarray, shape (n, k)
            Coordinates, angles within half a turn of the middle of their range.
        """
        points = states[:, [self._index(name) for name in self.names]]
        turns, middle = np.array(self.turns), np.mean(self.ranges, axis=1)
        return np.asarray(points - np.where(np.isinf(turns), 0.0, _TURN) * np.round((points - middle) / turns))

    def _index(self, name: str) -> int:
        return self.system.variables.index(name)

    def states_at(self, *points: Array) -> tuple[Array, Mask]:
        """Return the states at points of the section.

        Parameters
        ----------
        *points : ndarray
            Coordinates of the points, each of shape (n,).

        Returns
        -------
        states : ndarray, shape (n, d)
            The states; only those of possible points are valid.
        possible : ndarray of bool, shape (n,)
            True for points that motions cross.
        """
        y = np.zeros((len(self.system.variables), np.size(points[0])))
        y[self._index(self.variable)] = self.value
        for name, point in zip(self.names, points, strict=True):
            y[self._index(name)] = point
        unknown, here = [self._index(name) for name in self.dependent_variables], self._index(self.variable)
        example = np.array(self.system.example[0])
        size = max(1.0, float(np.abs(example).max()))
        states = y.copy()
        there = np.zeros(y.shape[1], bool)
        with np.errstate(all="ignore"):
            for start in (np.full(example.size, _FAR * size), np.full(example.size, -_FAR * size), example):
                if there.all():
                    break
                tried = y.copy()
                tried[unknown] = start[unknown][:, None]
                solved = self._solve(tried, unknown)
                rate = np.broadcast_to(self.system.field(list(tried), self.parameters)[here], solved.shape)
                solved &= self.sense * rate > 0.0
                new = solved & ~there
                states[:, new] = tried[:, new]
                there |= solved
        return states.T.copy(), there

    def _solve(self, y: Array, unknown: list[int]) -> Mask:
        """Solve the integrals for the unknown variables of y (d, n); return a mask of the solved states."""
        if not unknown:
            return np.ones(y.shape[1], bool)
        last = np.full((len(unknown), y.shape[1]), np.inf)
        for _ in range(_ITERATIONS):
            # Evaluate all differences in one call: the cost of a call hardly depends on the number of states.
            step = _STEP * np.maximum(1.0, np.abs(y[unknown]))
            moved = np.repeat(y[:, None], 2 * len(unknown) + 1, axis=1)
            for j, i in enumerate(unknown):
                moved[i, 2 * j + 1] += step[j]
                moved[i, 2 * j + 2] -= step[j]
            around = self._off(moved.reshape(len(y), -1)).reshape(len(unknown), -1, y.shape[1])
            off, ahead, behind = around[:, 0], around[:, 1::2], around[:, 2::2]
            slopes = np.moveaxis((ahead - behind) / (2.0 * step), 2, 0)
            singular = ~np.isfinite(slopes).all((1, 2)) | (np.abs(np.linalg.det(slopes)) < 1e-300)
            slopes[singular] = np.eye(len(unknown))
            change = np.linalg.solve(slopes, off.T[:, :, None])[:, :, 0].T
            y[unknown] -= change
            away, size = np.abs(change), np.maximum(1.0, np.abs(y[unknown]))
            # Near a root the changes are round-off, which no longer shrinks.
            if np.all((away <= 1e-15 * size) | ((away <= _NEAR * size) & (away >= 0.5 * last))):
                break
            last = away
        scale = np.array([max(1.0, abs(value)) for _, value in self.integrals])[:, None]
        return np.asarray(np.all(np.abs(self._off(y)) < _ROUNDING * scale, axis=0))

    def _off(self, y: Array) -> Array:
        values: Any = self.system.integrals(list(y), self.parameters)
        return np.array([np.broadcast_to(values[name], y.shape[1:]) - value for name, value in self.integrals])


def variable_section(
    body: ParametrizedSystem,
    integrals: Mapping[str, float],
    surface: tuple[str, float] | None = None,
    coordinates: str | Sequence[str] | None = None,
    window: Sequence[tuple[float, float]] | None = None,
    sense: int = 1,
) -> VariableSection:
    """Return a section of any system, with defaults.

    Parameters
    ----------
    body : ParametrizedSystem
        The system with values of its parameters.
    integrals : mapping of str to float
        Values of first integrals, by the names that the system gives them.
    surface : (str, float), optional
        The variable that passes a value, and this value; an angle passes it up to full turns.  By default the first
        variable, and 0.
    coordinates : str or sequence of str, optional
        The one or two variables that are the coordinates.  By default those on which the rate of the surface's
        variable depends least; the others follow from the integrals.
    window : sequence of (float, float), optional
        Range of each coordinate.  By default (−π, π) for an angle, otherwise (−r, r), where r is 1.5 times the largest
        |component| of the example's state, at least 1.
    sense : {1, -1}, default 1
        Direction in which the variable passes the value: increasing (1) or decreasing (−1).

    Returns
    -------
    VariableSection
        The section.

    Raises
    ------
    InvalidParameter
        If a name is not one of the system, the number of coordinates is not 1 or 2, the number of integrals is not that
        of the remaining variables, or `surface`, `window` or `sense` is invalid.

    Examples
    --------
    >>> from hess_mechanics import System
    >>> from hess_mechanics.dynamics.variable_section import variable_section
    >>> swing = System("swing", lambda y, p: (y[1], -y[0] - y[0] ** 3), "x v",
    ...                integrals=lambda y, p: {"E": y[1] ** 2 / 2 + y[0] ** 2 / 2 + y[0] ** 4 / 4})
    >>> variable_section(swing.at(), {}).names
    ('v',)
    """
    system = body.system
    if len(system.variables) < 2:
        raise InvalidParameter(f"{system.title}: a system of one variable has no section; `solve` gives its motion.")
    if sense not in (1, -1):
        raise InvalidParameter(f"sense = {sense!s:.20}: choose 1 (increasing) or −1 (decreasing).")
    if surface is not None and (isinstance(surface, str) or len(surface) != 2):
        raise InvalidParameter(
            f"surface = {surface!r:.80}: give a variable and a value, such as ({system.variables[0]!r}, 0.0)."
        )
    variable, value = surface or (system.variables[0], 0.0)
    known = system.integrals(*system.example)
    for name, names, what in (
        *((one, (*known,), "integral") for one in integrals),
        (variable, system.variables, "variable"),
    ):
        if name not in names:
            raise InvalidParameter(f"{system.title} has no {what} {name}. Allowed names: {', '.join(names) or 'none'}.")
    rest = [name for name in system.variables if name != variable]
    if coordinates is None:
        controls = _controls(system, body.parameters, variable)
        following = sorted(rest, key=lambda name: -controls[name])[: len(integrals)]
        chosen = tuple(name for name in rest if name not in following)
    else:
        chosen = tuple(coordinates.replace(",", " ").split() if isinstance(coordinates, str) else coordinates)
    solved = tuple(name for name in rest if name not in chosen)
    if not 1 <= len(chosen) <= 2 or not {*chosen} <= {*rest} or len(solved) != len(integrals):
        raise InvalidParameter(
            f"{system.title}: a section has one or two coordinates among {', '.join(rest)}, and an integral for each "
            f"of the other variables. Here the coordinates are {', '.join(chosen) or 'none'}, the others "
            f"{', '.join(solved) or 'none'}, and the integrals {', '.join(integrals) or 'none'}: give `coordinates`, "
            "or values of more or fewer integrals."
        )
    ranges = None if window is None else as_pairs("window", window)
    if ranges is not None and (len(ranges) != len(chosen) or any(low >= high for low, high in ranges)):
        raise InvalidParameter(
            f"window = {ranges!s:.80}: give a lower and a higher number for each of {', '.join(chosen)}."
        )
    reach = max(1.0, 1.5 * max(map(abs, system.example[0])))
    return VariableSection(
        body,
        variable,
        as_number(variable, value),
        chosen,
        solved,
        tuple((name, as_number(name, x)) for name, x in integrals.items()),
        tuple(ranges)
        if ranges is not None
        else tuple((-math.pi, math.pi) if name in system.angles else (-reach, reach) for name in chosen),
        sense,
    )


def _controls(system: System, parameters: tuple[float, ...], variable: str) -> dict[str, float]:
    """Return by how much the rate of a variable changes with each variable, at the example's state."""
    state, here = np.array(system.example[0]), system.variables.index(variable)
    steps = _STEP * np.eye(state.size)
    ahead, behind = (system.rates(shifted, parameters)[:, here] for shifted in (state + steps, state - steps))
    return dict(zip(system.variables, np.abs(ahead - behind).tolist(), strict=True))
