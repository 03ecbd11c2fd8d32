"""Return maps of sections in their own coordinates, with derivatives from the variational equations.

A section of a system at fixed values of its integrals has one or two coordinates x, a state Y(x) at each point, and an
inverse x(Y).  The map is P(x) = x(Y′), where Y′ is the next crossing of the orbit from Y(x).  With the transition
matrix V up to this crossing, the field f and the gradient n of the surface at Y′,

    DP = ∂x/∂Y (1 − f nᵀ/(n·f)) V ∂Y/∂x.

∂Y/∂x is tangent to the levels of the integrals, which V preserves.  It and ∂x/∂Y are derivatives of closed formulas and
are computed by differences of sixth order, accurate to about 1e-13.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product
from typing import Protocol

import numpy as np

from hess_mechanics.dynamics.cells import Window, even_points
from hess_mechanics.dynamics.orbit import MAX_STEPS, end_error, end_of, require_finite_states, require_steps
from hess_mechanics.dynamics.periodic import difference
from hess_mechanics.dynamics.plane_section import SectionPoints, Surface, section_points
from hess_mechanics.dynamics.symmetry import Mirror, sign_symmetries
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.dynamics.variation import return_derivative
from hess_mechanics.errors import InvalidParameter, NoReturn, OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_integer, as_number
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.parameters import plain

__all__ = ["PoincareSection", "ReturnMap", "section_crossings"]

_LONGEST = 400.0
"""Time limit for a return in Newton's method, which tries many points; in units of 1/ν times the slowness of the
section."""
_WAIT = 2000.0
"""Time limit for the next crossing of a single orbit, in the same units."""
_AROUND = 2.0 ** np.arange(-10.0, 1.0)
"""Distances from a point beyond the edge, in units of the promise, at which a point inside is looked for."""
_MOST = 1_000_000
"""Largest number of returns."""
_PIECE = 50
"""Crossings per call of the kernel."""
_STEP = 2e-3
_SHIFTS = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
_WEIGHTS = np.array([-1.0, 9.0, -45.0, 45.0, -9.0, 1.0]) / 60.0
"""Weights of the differences of sixth order."""
_AGREE = 1e-14
"""Round-off of the differences times the step: differences with a step and with a quarter of it agree to this."""
_TRIED = (4, 200, 4000)
"""Points tried for each state of a section: motions may cross it in a small part only."""
_TURNS = 120.0
_TOO_LONG = f"The return to the section needs more than {MAX_STEPS} steps: choose another point, or a cheaper level."
_AT_ONCE = 1e-8
"""A crossing before this time, in units of 1/ν, is the start itself."""


_Search = Callable[[Array, int, float], tuple[int, Array, Array]]


class PoincareSection(Protocol):
    """A section of a system at fixed values of its integrals, in coordinates that cover it; it is a `Body` too."""

    @property
    def system(self) -> System:
        """The equations of motion."""

    @property
    def parameters(self) -> tuple[float, ...]:
        """Values of the parameters of the equations."""

    def __hash__(self) -> int:
        """Return a hash: sections are values and serve as cache keys."""
        return object.__hash__(self)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""

    @property
    def turns(self) -> tuple[float, ...]:
        """Period of each coordinate, ∞ if it is not an angle."""

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        """Range of each coordinate."""

    @property
    def surface(self) -> Surface:
        """The surface in state space."""

    @property
    def slowness(self) -> float:
        """Factor of the time limits in units of 1/ν, ≥ 1: how much slower than ν the motions of this body may be."""

    @property
    def constants(self) -> Mapping[str, float]:
        """Parameters and values of the integrals that can be changed, by name."""

    @property
    def integrable(self) -> str:
        """Name of the integrable case to which the body belongs exactly; empty if none is known."""
        return ""

    @property
    def measure(self) -> str:
        """Smooth measure that all motions of the section preserve by a theorem, in words; empty if none is known."""
        return ""

    def at_constant(self, name: str, value: float) -> PoincareSection:
        """Return the section at another value of a constant.

        Parameters
        ----------
        name : str
            Name of the constant, one of `constants`.
        value : float
            Its new value.

        Returns
        -------
        PoincareSection
            The other section.

        Raises
        ------
        ModelError
            If there is no section at this value.
        """

    @property
    def states_at(self) -> Callable[..., tuple[Array, Mask]]:
        """Function of coordinates, arrays (n,), that returns states (n, d) and a mask (n,) of possible points."""

    def state_at(self, *point: float) -> tuple[float, ...]:
        """Return the state at a point of the section.

        Parameters
        ----------
        *point : float
            Coordinates of the point.

        Returns
        -------
        tuple of float
            State with d components.

        Raises
        ------
        OutsideRegion
            If no motion crosses the section there.
        """
        states, there = self.states_at(*np.array(point, float)[:, None])
        if not there[0]:
            where = ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.names, point, strict=True))
            raise OutsideRegion(f"No motion crosses the section at {where}: choose another point, or a larger energy.")
        return tuple(states[0].tolist())

    def spread(self, count: int, window: Window | None = None) -> tuple[tuple[float, ...], ...]:
        """Return states that are spread evenly over the part of a window that motions cross.

        Parameters
        ----------
        count : int
            Number of states.
        window : ((float, float), (float, float)), optional
            Lower left and upper right corner of the window.  By default the whole section.

        Returns
        -------
        tuple of tuple of float
            The states; fewer, perhaps none, if that part is tiny.
        """
        low, high = np.array(self.window).T[..., None] if window is None else np.array(window)[..., None]
        for tried in _TRIED:
            shares = even_points(tried * count, 0.5)[: len(self.names)]
            states, there = self.states_at(*(low + (high - low) * shares))
            if np.count_nonzero(there) >= count:
                break
        return tuple(map(tuple, states[there][:count].tolist()))

    def points_of(self, states: Array) -> Array:
        """Return the points of the section at which given states lie.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States of the section.

        Returns
        -------
        ndarray, shape (n, k)
            Coordinates of the points.
        """

    def is_on(self, states: Array) -> Mask:
        """Return True for states on this sheet of the section; for all of them if there is a single sheet.

        Parameters
        ----------
        states : ndarray, shape (n, d)
            States of the section.

        Returns
        -------
        ndarray of bool, shape (n,)
            True for states on this sheet.
        """
        return np.ones(len(states), bool)


def section_crossings(
    section: PoincareSection,
    starts: Sequence[Sequence[float]] | Array,
    crossings: int,
    accuracy: Accuracy,
    backward: bool = False,
    longest: float | None = None,
    turns: float = _TURNS,
    **limits: int,
) -> SectionPoints:
    """Return the crossings of a section by several orbits, with a time limit per crossing, see `section_points`.

    Parameters
    ----------
    section : PoincareSection
        The section.
    starts : array_like, shape (n, d)
        Initial states.
    crossings : int
        Largest number of crossings of each orbit, 1 to 100 000.
    accuracy : str or Level
        Accuracy level.
    backward : bool, default False
        Follow the orbits backward in time.
    longest : float, optional
        Mean time limit per crossing, positive, in units of the problem.  By default that of `turns`, which few orbits
        exceed.
    turns : float, default 120
        The same limit in units of 1/ν times the slowness of the section.
    **limits : int
        Arguments `threads` and `max_steps` of `section_points`.

    Returns
    -------
    SectionPoints
        The crossings.

    Raises
    ------
    InvalidParameter
        As `section_points`.
    WorkLimit
        As `section_points`.
    """
    end = crossings * (turns * section.slowness / Problem.of(section, starts).nu if longest is None else longest)
    return section_points(section, starts, section.surface, -end if backward else end, accuracy, crossings, **limits)


@dataclass(frozen=True)
class ReturnMap:
    """The return map of a Poincaré section, as `return_map` returns it.

    Parameters
    ----------
    section : PoincareSection
        The section.
    accuracy : Level
        Accuracy level.
    backward : bool, default False
        Map backward in time instead of forward.
    longest : float, optional
        Longest time of a return, positive, in units of the problem.  By default 2000/ν times the slowness of the
        section in `orbit`, `wait` and `time_of`, and 400/ν times it in the methods that Newton's method calls.
    """

    section: PoincareSection
    accuracy: Level
    backward: bool = False
    longest: float | None = None

    @property
    def turns(self) -> tuple[float, ...]:
        """Period of each coordinate, ∞ if it is not an angle."""
        return self.section.turns

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return self.section.names

    @property
    def promise(self) -> float:
        """Largest error that the accuracy level promises, in units in which the states are O(1)."""
        return self.accuracy.promise

    @property
    def level(self) -> str:
        """Name of the accuracy level."""
        return self.accuracy.name

    @property
    def is_floor(self) -> bool:
        """True at the finest accuracy level."""
        return self.accuracy.is_floor

    def tighter(self) -> ReturnMap:
        """Return the same map at a level with a hundredth of the tolerance, see `Level.tighter`.

        Returns
        -------
        ReturnMap
            The more accurate map.
        """
        return replace(self, accuracy=self.accuracy.tighter())

    def inverse(self) -> ReturnMap:
        """Return the inverse map, backward in time.

        Returns
        -------
        ReturnMap
            The inverse.
        """
        return replace(self, backward=not self.backward)

    def at_constant(self, name: str, value: float) -> ReturnMap:
        """Return the map at another value of a constant of the section.

        Parameters
        ----------
        name : str
            Name of the constant, one of `section.constants`.
        value : float
            New value, in the unit of the constant.

        Returns
        -------
        ReturnMap
            The map at this value.

        Raises
        ------
        InvalidParameter
            If there is no such constant, or the value is not a finite number.
        ModelError
            If there is no section at this value.
        """
        self.constant(name)
        return replace(self, section=self.section.at_constant(name, as_number(name, value)))

    def constant(self, name: str) -> float:
        """Return the value of a constant of the section.

        Parameters
        ----------
        name : str
            Name of the constant.

        Returns
        -------
        float
            Its value.

        Raises
        ------
        InvalidParameter
            If there is no such constant; the message lists all of them.
        """
        if not isinstance(name, str) or name not in self.section.constants:
            raise InvalidParameter(
                f"{name} is not a constant here. Allowed names: {', '.join(self.section.constants) or 'none'}."
            )
        return self.section.constants[name]

    def state_at(self, point: Array) -> Array:
        """Return the state at a point of the section.

        A point that lies beyond the edge by less than the promise of the level gets the state of a point inside.

        Parameters
        ----------
        point : array_like, shape (k,) or (m, k)
            Coordinates of the point, or of several points.

        Returns
        -------
        ndarray, shape (d,) or (m, d)
            The state, or those of all points.

        Raises
        ------
        InvalidParameter
            If a point does not have k numbers.
        OutsideRegion
            If no motion crosses the section at a point.
        """
        points = self._points(point)
        states, there = self.section.states_at(*np.atleast_2d(points).T)
        for i in np.flatnonzero(~there):
            # The error of a computed point may put it beyond the edge: take the nearest of some points around it.
            ways = np.array([*product((0.0, -1.0, 1.0), repeat=len(self.names))])
            around = np.multiply.outer(self.promise * _AROUND, ways).reshape(-1, len(self.names))
            near, inside = self.section.states_at(*(np.atleast_2d(points)[i] + around).T)
            states[i] = near[np.argmax(inside)] if inside.any() else self.section.state_at(*np.atleast_2d(points)[i])
        return np.asarray(states if points.ndim > 1 else states[0])

    def image(self, point: Array) -> Array:
        """Return the image of a point: the next crossing.

        Parameters
        ----------
        point : array_like, shape (k,) or (m, k)
            Coordinates of the point, or of several points.

        Returns
        -------
        ndarray, shape (k,) or (m, k)
            Coordinates of the image, or of all images.

        Raises
        ------
        InvalidParameter
            If a point does not have k numbers.
        NoReturn
            If the orbit does not return within the time limit, or returns on another sheet.
        OutsideRegion
            If no motion crosses the section at a point.
        WorkLimit
            If the return needs too many steps, or the motion ends.
        """
        return self.iterate(point, 1)

    def iterate(self, point: Array, count: int) -> Array:
        """Return the image of a point after a number of returns.

        Parameters
        ----------
        point : array_like, shape (k,) or (m, k)
            Coordinates of the point, or of several points.
        count : int
            Number of returns, 0 to 1 000 000; with 0 the image is the point itself.

        Returns
        -------
        ndarray, shape (k,) or (m, k)
            Coordinates of the image, or of all images.

        Raises
        ------
        InvalidParameter
            If a point does not have k numbers, or `count` is out of range.
        NoReturn
            If the orbit does not return within `count` times the time limit, or returns on another sheet.
        OutsideRegion
            If no motion crosses the section at a point.
        WorkLimit
            If the returns need too many steps, or the motion ends.
        """
        points, count = self._points(point), as_integer("count", count, 0, _MOST)
        if count == 0:
            return points
        problem, _, states = self._crossings(self.state_at(np.atleast_2d(points)), count, _LONGEST)
        return np.asarray(self.section.points_of(states * problem.scale)).reshape(points.shape)

    def orbit(self, point: Array, count: int) -> Array:
        """Return the next crossings of the orbit from a point.

        The orbit is projected back to the levels of the integrals after every 50 crossings, so it can have any length.

        Parameters
        ----------
        point : array_like, shape (k,)
            Coordinates of the point.
        count : int
            Number of crossings, 0 to 1 000 000, including those on other sheets.

        Returns
        -------
        ndarray, shape (n, k)
            Coordinates of the crossings on this sheet.  n < `count` if some lie on other sheets, or if none of the next
            50 is found on this sheet within the time `wait`.

        Raises
        ------
        InvalidParameter
            If the point does not have k numbers, or `count` is out of range.
        OutsideRegion
            If no motion crosses the section at the point.
        WorkLimit
            If the crossings need too many steps, or the motion ends.
        """
        section = self.section
        parts = [np.empty((0, len(self.turns)))]
        left = as_integer("count", count, 0, _MOST)
        problem, search = self._search(np.atleast_2d(self.state_at(point)))
        start = problem.states[0]
        while left > 0:
            check_limit()
            target = min(left, _PIECE)
            number, times, states = search(start, target + 1, self._limit(problem, _WAIT))
            require_steps(
                number,
                f"{target} returns need more than {MAX_STEPS} steps here: choose another point, or a cheaper level.",
                partial(end_error, problem, number, times[-1], states[-1], MAX_STEPS),
            )
            first = int(number > 0 and abs(times[0]) < _AT_ONCE)
            states = states[first : min(number, first + target)] * problem.scale
            require_finite_states(states)
            on = np.flatnonzero(section.is_on(states))
            if not on.size:
                break
            points = np.asarray(section.points_of(states[on]))
            # A point beyond the edge is inaccurate: restart before such a point; if the first point is one, use a
            # smaller tolerance.
            inside = section.states_at(*points.T)[1]
            on = on[: len(on) if inside.all() else max(1, int(np.argmin(inside)))]
            again = not inside[0] and not self.is_floor
            parts.append(self.tighter().orbit(point, 1) if again else points[: on.size])
            # If the last crossings are on another sheet, the next call repeats them.
            left -= int(on[-1]) + 1
            if not len(parts[-1]):
                break
            point = parts[-1][-1]
            start = self.state_at(point) / problem.scale
        return np.concatenate(parts)

    def wait(self, point: Array) -> float:
        """Return the time limit of `orbit` for the next crossing from a point.

        Parameters
        ----------
        point : array_like, shape (k,)
            Coordinates of the point.

        Returns
        -------
        float
            Time, positive, in units of the problem.

        Raises
        ------
        InvalidParameter
            If the point does not have k numbers.
        OutsideRegion
            If no motion crosses the section at the point.
        """
        problem = Problem.of(self.section, np.atleast_2d(self.state_at(point)))
        return self._limit(problem, _WAIT) * self.section.slowness / problem.nu

    def time_of(self, point: Array, count: int = 1) -> float:
        """Return the time that several returns from a point take.

        Parameters
        ----------
        point : array_like, shape (k,) or (m, k)
            Coordinates of the point, or of several points whose times are added.
        count : int, default 1
            Number of returns, at least 1.

        Returns
        -------
        float
            Time, in units of the problem; negative for a map backward in time.

        Raises
        ------
        NoReturn
            If the returns take longer than `count` times `wait`, or the last one is on another sheet.
        OutsideRegion
            If no motion crosses the section at a point.
        WorkLimit
            If the returns need too many steps, or the motion ends.
        """
        problem, times, _ = self._crossings(np.atleast_2d(self.state_at(point)), count, _WAIT)
        return float(times.sum() / problem.nu)

    def with_derivative(self, point: Array) -> tuple[Array, Array]:
        """Return the image of a point and the derivative of the map there.

        Parameters
        ----------
        point : array_like, shape (k,) or (m, k)
            Coordinates of the point, or of several points.

        Returns
        -------
        image : ndarray, shape (k,) or (m, k)
            Coordinates of the image, or of all images.
        derivative : ndarray, shape (k, k) or (m, k, k)
            DP at the point, or at all points.

        Raises
        ------
        InvalidParameter
            If a point does not have k numbers, or an orbit is tangent to the surface where it returns.
        NoReturn
            If an orbit does not return within the time limit, or returns on another sheet.
        OutsideRegion
            If no motion crosses the section at a point, or a point is too close to the edge of the section.
        WorkLimit
            If a return needs too many steps, or a motion ends.
        """
        points = self._points(point)
        several = np.atleast_2d(points)
        problem, times, ends = self._crossings(self.state_at(several), 1, _LONGEST)
        section, scale = self.section, problem.scale
        states = ends * scale
        flow, frame = self._flow(problem, times)
        onto = return_derivative(
            scale[:, None] * flow,
            scale * problem.nu * section.system.rates(ends, problem.parameters),
            np.array([section.surface.gradient(state) for state in states]),
        )
        moved = onto @ frame.swapaxes(1, 2) @ (self._tangents(several) / scale).swapaxes(1, 2)
        images = np.asarray(section.points_of(states))
        derivatives = self._in_plane(states, images, moved.swapaxes(1, 2))
        return images.reshape(points.shape), derivatives.reshape(*points.shape, points.shape[-1])

    def _points(self, point: Array) -> Array:
        """Return coordinates as an array (k,) or (m, k).  Raises `InvalidParameter`."""
        try:
            points = np.atleast_1d(np.asarray(point, float))
        except (TypeError, ValueError, OverflowError):
            points = np.empty(0)
        if points.ndim > 2 or points.shape[-1] != len(self.names):
            raise InvalidParameter(
                f"{point!s:.80} is not a point of the section: give {len(self.names)} numbers, {', '.join(self.names)}."
            )
        return points

    def _limit(self, problem: Problem, default: float) -> float:
        """Return `longest`, or else the default time limit of a return, in units of 1/ν times the slowness."""
        return default if self.longest is None else self.longest * problem.nu / self.section.slowness

    def _flow(self, problem: Problem, times: Array) -> tuple[Array, Array]:
        """Return the derivatives of the flow along d − 1 orthonormal directions, and these directions, (m, d, d − 1).

        The direction of motion is left out: the derivative of the return takes it to 0.
        """
        system, accuracy = self.section.system, self.accuracy
        m, d = problem.states.shape
        rates = system.rates(problem.states, problem.parameters)[:, :, None]
        frames = np.linalg.qr(np.concatenate([rates, np.broadcast_to(np.eye(d), (m, d, d))], axis=2))[0][:, :, 1:]
        derivatives = np.empty((m, d, d - 1))
        state, growth, volume = np.empty((1, d)), np.empty((1, d - 1)), np.empty(1)
        for i in range(m):
            steps = system.transverse_variation(
                problem.states[i],
                np.ascontiguousarray(frames[i]),
                problem.parameters,
                times[i : i + 1],
                accuracy.order,
                accuracy.tolerance,
                MAX_STEPS,
                math.inf,
                state,
                derivatives[i : i + 1],
                growth,
                volume,
            )
            require_steps(steps, _TOO_LONG, partial(end_of, problem, problem.states[i], times[i]))
        require_finite_states(derivatives)
        return derivatives, frames

    def _search(self, starts: Array) -> tuple[Problem, _Search]:
        """Return the scaled problem, and the search for the crossings of one of its orbits.

        search(start, target, longest) returns the number of crossings found within a time limit, or a negative code if
        the motion cannot be followed, with their times and states in scaled units.
        """
        section, accuracy = self.section, self.accuracy
        problem = Problem.of(section, starts)
        problem = problem.perturb() if accuracy.is_perturbed else problem
        surface = section.surface
        cross, normal, offset = surface.crossing_kernel(section.system, problem)
        direction = section.slowness * (-1.0 if self.backward else 1.0)

        def search(start: Array, target: int, longest: float) -> tuple[int, Array, Array]:
            times, states = np.empty(target), np.empty((target, problem.scale.size))
            number, _ = cross(
                start,
                problem.parameters,
                normal,
                offset,
                surface.sense,
                longest * direction,
                accuracy.order,
                accuracy.tolerance,
                section.system.longest_step(accuracy, longest),
                MAX_STEPS,
                times,
                states,
            )
            return number, times, states

        return problem, search

    def _crossings(self, starts: Array, count: int, longest: float) -> tuple[Problem, Array, Array]:
        """Return the scaled problem, and times (m,) and states (m, d) of the crossing number `count` of each orbit."""
        problem, search = self._search(starts)
        longest = self._limit(problem, longest)
        times, states = np.empty(len(starts)), np.empty_like(problem.states)
        for i, start in enumerate(problem.states):
            check_limit()
            target = count
            while True:
                number, all_times, all_states = search(start, target, longest * count)
                # Round-off may put the start a little before a curved surface, which it then crosses at once.
                if not (number and target == count and abs(all_times[0]) < _AT_ONCE):
                    break
                target += 1
            end = partial(end_error, problem, number, all_times[-1], all_states[-1], MAX_STEPS)
            require_steps(number, _TOO_LONG, end)
            if number < target:
                limit = longest * count * self.section.slowness / problem.nu
                raise NoReturn(
                    f"From here the motion did not return to the section {_times(count)} within t = "
                    f"{plain(limit, 4)}: choose another point, or a larger `longest`."
                )
            times[i], states[i] = all_times[-1], all_states[-1]
        require_finite_states(states)
        if not np.all(self.section.is_on(states * problem.scale)):
            raise NoReturn("From here the motion returns on another sheet of the section: choose another point.")
        return problem, times, states

    def _tangents(self, points: Array) -> Array:
        """Return ∂Y/∂x (m, k, d) at points (m, k).  Raises `OutsideRegion` at the very edge of the section."""
        m, k = points.shape
        tangents = np.empty((m, k, len(self.section.system.variables)))
        left, step = np.arange(m), _STEP
        while left.size:
            sizes = np.array([step, 0.25 * step])
            shifts = sizes[:, None, None, None] * _SHIFTS[:, None, None] * np.eye(k)
            states, there = self.section.states_at(*(points[left, None, None, None] + shifts).reshape(-1, k).T)
            whole = np.asarray(there.reshape(left.size, -1).all(axis=1))
            inside = states.reshape(left.size, *shifts.shape[:3], -1)[whole]
            both = np.einsum("nswkd,w->nskd", inside, _WEIGHTS) / sizes[:, None, None]
            # Close to the edge, where states vary like a square root, the step has to be shorter.
            size = np.abs(both).max(axis=(1, 2, 3), initial=1.0)
            agree = np.abs(both[:, 0] - both[:, 1]).max(axis=(1, 2), initial=0.0) <= _AGREE / step * size
            whole[whole] = done = agree | (step < 1e-5)
            tangents[left[whole]] = both[done, 0]
            left, step = left[~whole], 0.25 * step
            if left.size and step < 1e-6:
                raise OutsideRegion("This point is too close to the edge of the section: choose another one.")
        return tangents

    def _in_plane(self, states: Array, points: Array, away: Array) -> Array:
        """Return ∂x/∂Y at states (m, d) along directions (m, k, d); column j belongs to direction j."""
        # Scale the steps by the state, whose components differ in size.
        unit = _STEP * np.abs(states).max(axis=1, initial=1.0)[:, None, None]
        sizes = np.maximum(np.linalg.norm(away, axis=2, keepdims=True), 1e-300)
        shifted = states[:, None] + _SHIFTS[:, None, None, None] * unit * away / sizes
        near = self.section.points_of(shifted.reshape(-1, states.shape[1])).reshape(_SHIFTS.size, *away.shape[:2], -1)
        moved = difference(self.turns, near, points[:, None])
        return np.asarray((np.tensordot(_WEIGHTS, moved, 1) / unit * sizes).swapaxes(1, 2))

    @cached_property
    def preserves_volume(self) -> bool:
        """True if the divergence of the field is 0 everywhere, so that nothing attracts where motions are bounded.

        It is tested at three states in general position.
        """
        system, p = self.section.system, self.section.parameters
        d = len(system.variables)
        states = np.cos(1.0 + np.arange(3 * d).reshape(3, d) ** 2)
        size = max(1.0, float(np.abs(system.rates(states, p)).max()))
        return bool(np.abs(system.divergence(states, p)).max() <= 1e-12 * size)

    @cached_property
    def mirrors(self) -> tuple[Mirror, ...]:
        """Symmetries that map motions through the section to such motions, and reversors of the section to itself.

        They are tested at one point; empty if no motion crosses the section.
        """
        for state in self.section.spread(1):
            point = self.section.points_of(np.array([state]))[0]
            known = sign_symmetries(self.section.system, self.section.parameters)
            return tuple(one for one in known if self.mirror_image(one, point) is not None)
        return ()

    def mirror_image(self, mirror: Mirror, point: Array) -> Array | None:
        """Return the mirror image of a point, or where the motion through the image crosses the section next.

        The image of a reversor must lie on the section itself.

        Parameters
        ----------
        mirror : Mirror
            A symmetry of the system.
        point : array_like, shape (k,)
            Coordinates of the point.

        Returns
        -------
        ndarray, shape (k,), or None
            Coordinates of the image; None if the motion through it does not cross the section.

        Raises
        ------
        OutsideRegion
            If no motion crosses the section at the point.
        """
        state = mirror.image(self.state_at(point))
        image = np.asarray(self.section.points_of(state[None])[0])
        states, there = self.section.states_at(*(np.array([x]) for x in image))
        size = max(1.0, float(np.abs(state).max()))
        turns = [
            2.0 * math.pi if name in self.section.system.angles else math.inf for name in self.section.system.variables
        ]
        if there[0] and float(np.abs(difference(turns, states[0], state)).max()) < 1e-9 * size:
            return image
        if mirror.reverses:
            return None
        try:
            problem, _, ends = self._crossings(state[None], 1, _LONGEST)
        except (NoReturn, WorkLimit):
            return None
        return np.asarray(self.section.points_of(ends * problem.scale)[0])

    def symmetries_of(self, points: Array, near: float = 1e-7) -> Sequence[str]:
        """Return the symmetries of an orbit.

        Parameters
        ----------
        points : ndarray, shape (m, k)
            Points of the orbit.
        near : float, default 1e-7
            Distance within which the image of a point counts as a point of the orbit; 1000 times the promise of the
            level if that is larger.

        Returns
        -------
        tuple of str
            Names of the `mirrors` that map the orbit to itself.
        """
        names = []
        for mirror in self.mirrors:
            images = [self.mirror_image(mirror, point) for point in points]
            if all(
                image is not None
                and np.abs(difference(self.turns, points, image)).max(axis=1).min() < max(near, 1e3 * self.promise)
                for image in images
            ):
                names.append(mirror.name)
        return tuple(names)


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"
