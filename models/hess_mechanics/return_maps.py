"""Return maps of Poincaré sections: their orbits, periodic orbits, manifolds and orbit diagrams.

`return_map(body, …)` returns the return map of a section at fixed values of the integrals; the other functions take it
as their first argument, and their results have `.to_pandas()`, `.to_xarray()` and `.plot()`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.dynamics.attraction import arrivals
from hess_mechanics.dynamics.basins import Contraction, SectionOrbits, attractors
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.continuation import Branch, branch_from
from hess_mechanics.dynamics.megno_map import corners, labels_of_cells, require_plane
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, diagram_over
from hess_mechanics.dynamics.periodic import MAX_PERIOD, PeriodicOrbit, find_periodic, units_of
from hess_mechanics.dynamics.plane_section import labels_of_orbits
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap, section_crossings
from hess_mechanics.dynamics.system import ParametrizedSystem
from hess_mechanics.dynamics.variable_section import variable_section
from hess_mechanics.errors import InvalidParameter, OutsideRegion, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import Accuracy, Kind, plan
from hess_mechanics.numerics.arguments import as_cells, as_integer, as_level, as_number, as_pairs, as_point
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import run_in_threads
from hess_mechanics.numerics.results import Array, angle_facts, as_read_only
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.quartic import QuarticBody, QuarticSection
from hess_mechanics.suslov.suslov_section import AngleSection, SuslovSection
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.torus_section import TorusSection

__all__ = [
    "Basins",
    "PlanePoints",
    "basins",
    "continued_orbit",
    "orbit_diagram",
    "period_doublings",
    "periodic_orbit",
    "return_map",
    "section_orbits",
]

SectionedBody = SuslovBody | QuarticBody | BallBody | HeavyBody | HessBody | ParametrizedSystem
_MOST_POINTS = 1_000_000
_MOST_ORBITS, _MOST_CROSSINGS = 1000, 10_000


@dataclass(frozen=True)
class PlanePoints(Result):
    """Crossings of many orbits with a section, in the plane of the section.

    Attributes
    ----------
    names : tuple of str
        Names of the two coordinates.
    orbits : tuple of ndarray, shape (n, 2)
        Crossings of each orbit, in the order in which they occur; fewer than requested if it ends or stays away.
    facts : dict
        Accuracy level, largest drift of each integral, number of steps, the reason for each orbit that ends early, and
        for each angle the remark that its values lie within one turn.
    """

    names: tuple[str, str]
    orbits: tuple[Array, ...]
    facts: dict[str, float | str]

    def labels(self) -> Labels:
        """Return the coordinates of all points, labelled with the number of the orbit.

        Returns
        -------
        Labels
            Both coordinates over the points.
        """
        return labels_of_orbits(self.names, self.orbits, "point", units_of(self.names), self.facts)


def return_map(
    body: SectionedBody,
    *,
    E: float | None = None,
    h: float | None = None,
    f: float | None = None,
    plane: int = 3,
    sheet: int = 0,
    integrals: Mapping[str, float] | None = None,
    surface: tuple[str, float] | None = None,
    coordinates: str | Sequence[str] | None = None,
    window: Sequence[tuple[float, float]] | None = None,
    sense: int = 1,
    backward: bool = False,
    longest: float | None = None,
    accuracy: Accuracy = "precise",
) -> ReturnMap:
    """Return the return map of a Poincaré section of a body at fixed values of its integrals.

    Each kind of body has its own section:

    - `SuslovBody`: the plane γ_k = 0 at the energy `E`, or `h` above the lowest, coordinates (ψ, δ).
    - `BallBody`: the plane γ_k = 0 at the energy `E`, or `h` above the lowest of the plane, coordinates (ψ, δ).
    - `HeavyBody`: the Andoyer–Deprit section at `h` and `f`, coordinates (l, L/G).
    - `HessBody`: a circle on the torus (`h`, `f`) in units b = 1, coordinate φ.
    - `QuarticBody`: the section of the plane motion at the body's own energy, coordinates (q, p).
    - Any other system, `System.at`: a variable passes a value, and one or two others are the coordinates.
      The other variables follow from `integrals`, of which `E`, `h` and `f` are short forms.

    `plane`, `sheet` and the arguments for any other system have no effect on bodies to which they do not apply.

    Parameters
    ----------
    body : SuslovBody, BallBody, HeavyBody, HessBody, QuarticBody or ParametrizedSystem
        The body.
    E : float, optional
        Energy of a `SuslovBody` or `BallBody`, in units I/T².
    h : float, optional
        Energy of a `SuslovBody` or `BallBody` above the lowest, instead of `E`, positive; energy integral of a
        `HeavyBody`, in units I/T², or of a `HessBody` in units b = 1, h > −1.
    f : float, optional
        Area integral of a `HeavyBody`, in units I/T, or of a `HessBody` in units b = 1.
    plane : int, default 3
        Index k of the plane γ_k = 0 of a `SuslovBody` or `BallBody`: 1, 2 or 3.
    sheet : int, default 0
        Sheet of the section of a `HeavyBody`, 0 to 2; the largest momentum G is on sheet 0.
    integrals : mapping of str to float, optional
        Values of first integrals of any other system, by name.
    surface : (str, float), optional
        The variable of any other system that passes a value.  By default the first, through 0.
    coordinates : str or sequence of str, optional
        Coordinates of the section of any other system, one or two of its variables.  By default those on which the
        rate of the surface's variable depends least.
    window : sequence of (float, float), optional
        Range of each of these coordinates.  By default (−π, π) for an angle, otherwise a symmetric range that contains
        the example of the system.
    sense : {1, -1}, default 1
        Direction in which the variable of `surface` passes its value: increasing (1) or decreasing (−1).
    backward : bool, default False
        Map backward in time, as `ReturnMap.inverse` does.
    longest : float, optional
        Longest time to wait for a return, positive, in units T.  The default is enough for most motions.
    accuracy : str or Level, default "precise"
        Accuracy level.

    Returns
    -------
    ReturnMap
        The return map.

    Raises
    ------
    InvalidParameter
        If an integral is missing or does not apply to this kind of body, or if a value is out of range.
    OutsideRegion
        If no motion of a `SuslovBody` or `BallBody` at this energy reaches the section.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, return_map
    >>> P = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842)
    >>> P.image((0.3, 1.2)).shape, P.names
    ((2,), ('ψ', 'δ'))
    """
    values: dict[str, float | None] = {"E": E, "h": h, "f": f}
    section: PoincareSection
    if isinstance(body, SuslovBody | BallBody):
        energy = "E" if h is None else "h"
        kind: type[AngleSection] = SuslovSection if isinstance(body, SuslovBody) else BallSection
        section = kind(body, 0.0, as_integer("plane", plane, 1, 3)).at_constant(energy, *_values_of(values, energy))
        section.require_reached()
    elif isinstance(body, HeavyBody):
        at = _values_of(values, "h", "f")
        section = AndoyerSection(body, at[0], at[1], as_integer("sheet", sheet, 0, 2))
    elif isinstance(body, ParametrizedSystem):
        given = {name: value for name, value in values.items() if value is not None}
        section = variable_section(body, {**given, **(integrals or {})}, surface, coordinates, window, sense)
    elif isinstance(body, QuarticBody):
        _values_of(values)
        section = QuarticSection(body)
    else:
        section = TorusSection(body.a, *_values_of(values, "h", "f"))
    if longest is not None and not longest > 0.0:
        raise InvalidParameter(
            f"The longest time to wait for a return, longest = {longest:g}: choose a positive number."
        )
    return ReturnMap(section, as_level(accuracy), backward, longest)


def section_orbits(
    map_: ReturnMap, *, starts: Sequence[Sequence[float]] = (), orbits: int = 20, crossings: int = 200
) -> PlanePoints:
    """Return the crossings of many orbits with a section.

    Each orbit is integrated once, without an error estimate.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of a section with two coordinates; also sets the direction of time, the longest time to wait for a
        return, and the accuracy level.
    starts : sequence of (float, float), optional
        Points of the section where the orbits start.
    orbits : int, default 20
        Number of orbits, spread evenly over the section, if no `starts` are given; 1 to 1000, and fewer where motions
        cross only a tiny part of the section.
    crossings : int, default 200
        Largest number of crossings per orbit, 1 to 10 000.

    Returns
    -------
    PlanePoints
        The crossings of each orbit.

    Raises
    ------
    InvalidParameter
        If the section has only one coordinate, a start is not a point of it, or a number is out of range.
    OutsideRegion
        If no motion crosses the section at a start, or anywhere.
    WorkLimit
        If an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, return_map, section_orbits
    >>> P = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842, accuracy="standard")
    >>> section_orbits(P, orbits=4, crossings=30).to_xarray().sizes["point"]
    120
    """
    section = map_.section
    require_plane(section)
    count = as_integer("crossings", crossings, 1, _MOST_CROSSINGS)
    states = (
        np.array([map_.state_at(np.array(one)) for one in as_pairs("starts", starts)])
        if len(starts)
        else np.array(section.spread(as_integer("orbits", orbits, 1, _MOST_ORBITS)))
    )
    if not len(states):
        raise OutsideRegion("No motion crosses the section here: choose a larger energy.")
    level = plan(Kind.SECTION, map_.accuracy).level
    points = section_crossings(section, states, count, level, map_.backward, map_.longest)
    x, y = section.names
    return PlanePoints(
        (x, y),
        tuple(section.points_of(one) for one in points.states),
        {
            "level": map_.level,
            **points.facts,
            **{f"orbit {i}": reason for i, reason in enumerate(points.reasons) if reason},
            **angle_facts(
                (name for name, turn in zip(section.names, section.turns, strict=True) if math.isfinite(turn)),
                counts=False,
            ),
        },
    )


def periodic_orbit(map_: ReturnMap, start: Sequence[float], period: int | None = None) -> PeriodicOrbit:
    """Return the periodic orbit that Newton's method finds from a point of a section.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    start : sequence of float, shape (d,)
        Point of the section where the search starts.
    period : int, optional
        Period, as a number of returns, 1 to 64.  By default the periods up to 12 at which the orbit comes back closest
        are tried.

    Returns
    -------
    PeriodicOrbit
        The orbit with its multipliers, type, symmetries and error.

    Raises
    ------
    InvalidParameter
        If the point does not have finite coordinates, or the period is out of range.
    NotConverged
        If Newton's method finds no orbit, or no orbit of this period.

    Examples
    --------
    >>> from hess_mechanics import HessBody, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> periodic_orbit(P, (-2.0,)).kind  # the stable limit cycle
    'stable node'
    """
    orbit = find_periodic(map_, start, None if period is None else as_integer("period", period, 1, MAX_PERIOD))
    return replace(orbit, symmetric=tuple(map_.symmetries_of(orbit.points)))


def continued_orbit(map_: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, points: int = 200) -> Branch:
    """Continue a periodic orbit of a section in a parameter, and locate its bifurcations.

    Pseudo-arclength continuation, which passes folds.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    orbit : PeriodicOrbit
        A periodic orbit of this map.
    parameter : str
        Name of the parameter, one of `map_.section.constants`.
    to : float
        Value of the parameter towards which the branch starts, in the unit of the parameter.  The branch ends where the
        parameter leaves the range between its current value and this one.
    points : int, default 200
        Largest number of points of the branch, 2 to 2000.

    Returns
    -------
    Branch
        The branch, from the parameter's current value on.

    Raises
    ------
    InvalidParameter
        If there is no such parameter, a number is out of range, or `to` is the current value.
    NotConverged
        If the branch cannot start, because the orbit is not a periodic orbit of this map, is at a bifurcation, or
        belongs to a family.
    WorkLimit
        If an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import HessBody, continued_orbit, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> branch = continued_orbit(P, periodic_orbit(P, (-2.0,)), "h", 1.6, points=5)
    >>> branch.kinds[0], len(branch.bifurcations)
    ('stable node', 0)
    """
    branch = branch_from(
        partial(map_.at_constant, parameter),
        orbit,
        parameter,
        map_.constant(parameter),
        to,
        as_integer("points", points, 2, 2000),
    )
    along = zip(branch.values.tolist(), branch.points, strict=True)
    times = [abs(map_.at_constant(parameter, value).time_of(at)) for value, at in along]
    return replace(branch, times=as_read_only(np.array(times)))


def orbit_diagram(
    map_: ReturnMap,
    parameter: str,
    values: Sequence[float] | Array,
    start: Sequence[float],
    *,
    transient: int = 200,
    crossings: int = 64,
    follow: bool = True,
) -> Diagram:
    """Return the orbit diagram of a section: the points where an orbit settles, over a parameter.

    Use `map_.inverse()` for repellers.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    parameter : str
        Name of the parameter, one of `map_.section.constants`.
    values : array_like, shape (n,)
        Values of the parameter, 1 to 2000, in the order in which they are visited; values that go up and down again
        show hysteresis.
    start : sequence of float, shape (d,)
        Point of the section where the orbit starts.
    transient : int, default 200
        Largest number of crossings discarded at each value, 0 to 20 000; fewer if the orbit approaches a periodic one
        sooner.
    crossings : int, default 64
        Crossings shown at each value, 1 to 20 000.
    follow : bool, default True
        Start each value from the last point of the one before, or from `start` if that fails.  Otherwise each value
        starts from `start`.

    Returns
    -------
    Diagram
        The points and the period at each value; no points at a value without a body or a return.

    Raises
    ------
    InvalidParameter
        If there is no such parameter, or a number is out of range.
    OutsideRegion
        If no value has points, and no motion crosses the section at `start` for the first value.
    WorkLimit
        If the diagram has more than 1 000 000 points, `transient` + `crossings` exceeds 20 000, or an orbit needs too
        many steps.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, orbit_diagram, return_map
    >>> P = return_map(SuslovBody(1.0, 2.25, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681, accuracy="standard")
    >>> orbit_diagram(P, "I22", [2.11, 2.2], (0.8, 1.9)).periods.tolist()  # it doubles at 2.126
    [1, 2]
    """
    map_.constant(parameter)
    point = as_point(map_.names, start)
    transient, crossings = as_integer("transient", transient, 0, 20_000), as_integer("crossings", crossings, 1, 20_000)
    if len(np.atleast_1d(values)) * crossings > _MOST_POINTS:
        raise WorkLimit(
            f"These are more than {_MOST_POINTS} points of an orbit diagram: choose fewer values or crossings."
        )
    diagram = diagram_over(partial(map_.at_constant, parameter), parameter, values, point, transient, crossings, follow)
    if not any(map(len, diagram.points)):
        # No value has a motion: raise the error of the first value.
        map_.at_constant(parameter, float(diagram.values[0])).state_at(np.array(point))
    return diagram


def period_doublings(map_: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, most: int = 6) -> Cascade:
    """Return the cascade of period doublings of a periodic orbit, over a parameter.

    Each doubling is the value of the parameter at which the orbit of that period has the multiplier −1.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    orbit : PeriodicOrbit
        A periodic orbit of this map.
    parameter : str
        Name of the parameter, one of `map_.section.constants`.
    to : float
        Value towards which the parameter changes, from its current value; in the unit of the parameter.
    most : int, default 6
        Largest number of doublings, 1 to 6.

    Returns
    -------
    Cascade
        The doublings in order, none if there is no doubling; `end_reason` says why there are no more.

    Raises
    ------
    InvalidParameter
        If there is no such parameter, a number is out of range, or `to` is the current value.
    NotConverged
        If the first branch cannot start, because the orbit is not a periodic orbit of this map, is at a bifurcation, or
        belongs to a family.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, period_doublings, periodic_orbit, return_map
    >>> P = return_map(SuslovBody(1.0, 2.11, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681)
    >>> result = period_doublings(P, periodic_orbit(P, (0.83, 1.89), 1), "I22", 2.4, most=1)
    >>> result.periods.tolist(), round(float(result.values[0]), 3)
    ([1], 2.126)
    """
    return cascade(
        partial(map_.at_constant, parameter),
        parameter,
        orbit,
        map_.constant(parameter),
        to,
        as_integer("most", most, 1, 6),
    )


@dataclass(frozen=True)
class Basins(Result):
    """Basins of attraction on a section.

    Attributes
    ----------
    names : tuple of str
        Names of the two coordinates.
    x, y : ndarray, shape (m,) and (n,)
        Centres of the cells.
    attractor : ndarray of int, shape (n, m)
        Attractor 0, 1, … that the orbit from the centre of each cell reaches; −1 where no motion crosses the section,
        −2 where no attractor is reached in 240 crossings.
    crossings : ndarray, shape (n, m)
        Crossings until the attractor is reached; NaN where none is.
    divergence : tuple of Contraction
        Mean divergence on each set that orbits approach, an attractor or not, in 1/T.
    attractors : int
        Number of attractors.
    level : str
        Name of the accuracy level.
    """

    names: tuple[str, str]
    x: Array
    y: Array
    attractor: Array
    crossings: Array
    divergence: tuple[Contraction, ...]
    attractors: int
    level: str

    def labels(self) -> Labels:
        """Return the attractor and the crossings, labelled with both coordinates.

        Returns
        -------
        Labels
            Both arrays over the cells.
        """
        divergence = {f"divergence {i}": f"{one.mean:.6g} ± {one.error:.2g}" for i, one in enumerate(self.divergence)}
        arrays = {"attractor": self.attractor, "crossings": self.crossings}
        facts = {"attractors": self.attractors, **divergence, "level": self.level}
        return labels_of_cells(self.names, self.x, self.y, arrays, facts)


def basins(
    map_: ReturnMap, cells: tuple[int, int] = (16, 12), window: Window | None = None, duration: float = 1000.0
) -> Basins:
    """Return the basins of attraction on a section, computed on up to eight cores.

    The sets that orbits approach are found from 256 orbits over the section.  A set is an attractor if the mean
    divergence on it is negative by more than three times its error.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of a section with two coordinates.  The levels "standard", "precise" and "reference" are coarser here
        than for orbits.  Orbits are followed forward in time even if the map is backward, and `longest` is not used.
    cells : (int, int), default (16, 12)
        Number of cells across and up, at most 100 000 together.
    window : ((float, float), (float, float)), optional
        Corners (x0, y0) and (x1, y1) of the window, lower left and upper right.  By default the whole section.
    duration : float, default 1000
        Time for which an orbit on each set is followed, positive, in units T; the divergence is averaged over its last
        two thirds.

    Returns
    -------
    Basins
        The attractor of each cell, and the divergence on each set that orbits approach.

    Raises
    ------
    InvalidParameter
        If the section has only one coordinate, or a number is out of range.
    WorkLimit
        If an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, basins, return_map
    >>> P = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842, accuracy="draft")
    >>> basins(P, cells=(6, 4)).attractors
    2
    """
    section, level = map_.section, plan(Kind.BASINS, map_.accuracy).level
    (x0, y0), (x1, y1) = corners(section, window)
    m, n = as_cells(cells)
    there = attractors(section, as_number("duration", duration), level)
    x, y = centres(x0, x1, m), centres(y0, y1, n)
    number, crossings = np.empty((n, m)), np.empty((n, m))

    def row(i: int) -> None:
        ends = arrivals(SectionOrbits(section, level), there.sets, x, np.full(m, y[i]))
        number[i], crossings[i] = ends.number, ends.crossings

    run_in_threads(row, n)
    crossings[number < 0.0] = np.nan
    across, up = section.names
    return Basins(
        (across, up),
        as_read_only(x),
        as_read_only(y),
        as_read_only(number.astype(int)),
        as_read_only(crossings),
        there.contractions,
        there.count,
        level.name,
    )


def _values_of(values: dict[str, float | None], *names: str) -> list[float]:
    """Return the values of these integrals; no other integral may be given.  Raises `InvalidParameter`."""
    lost = [name for name in names if values[name] is None]
    if lost:
        raise InvalidParameter(f"The section of this body needs {' and '.join(names)}: give {lost[0]}.")
    extra = [name for name, value in values.items() if value is not None and name not in names]
    if extra:
        raise InvalidParameter(
            f"The section of this body takes {' and '.join(names) or 'its own energy'} and no {extra[0]}: leave it out."
        )
    return [as_number(name, values[name]) for name in names]
