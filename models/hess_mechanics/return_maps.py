"""Return maps of Poincaré sections: their orbits, periodic orbits, manifolds, orbit diagrams.

A return map is that of a section of a body at fixed values of its integrals, `return_map(body, …)`.  Results can be
handed on: `.to_pandas()`, `.to_xarray()`, `.plot()`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.section import BallSection
from hess_mechanics.dynamics.cells import evenly
from hess_mechanics.dynamics.continuation import Branch, continued
from hess_mechanics.dynamics.manifolds import Manifold, grown
from hess_mechanics.dynamics.megno_map import require_plane
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, diagram_over
from hess_mechanics.dynamics.periodic import MAX_PERIOD, PeriodicOrbit, find_periodic, place_units
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.dynamics.section import section_points
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.errors import InvalidParameter, OutsideRegion, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import Accuracy, Computation, plan
from hess_mechanics.numerics.arguments import as_a, as_level, as_number, as_pairs, as_place, as_whole
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.quartic import QuarticBody, QuarticSection
from hess_mechanics.suslov.section import SuslovSection, require_reached
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.section import TorusSection

__all__ = [
    "PlanePoints",
    "continued_orbit",
    "manifold",
    "orbit_diagram",
    "period_doublings",
    "periodic_orbit",
    "return_map",
    "section_orbits",
]

SectionedBody = SuslovBody | QuarticBody | BallBody | HeavyBody | HessBody
_MOST_PLACES = 1_000_000
_MOST_ORBITS, _MOST_CROSSINGS = 1000, 10_000
_TURNS = 120.0
"""Time allowed per crossing, in units of 1/ν times the slowness of the section; few orbits take longer."""
_TRIED = (8, 200)
"""Places looked at for each orbit: where motions cross a small part of a section only, more of them."""


@dataclass(frozen=True)
class PlanePoints(Result):
    """Points of a section in its plane.

    names : of the axes; orbits : the points (n, 2) of each orbit, as they are passed; facts : of the whole.
    """

    names: tuple[str, str]
    orbits: tuple[Array, ...]
    facts: dict[str, float | str]

    def labels(self) -> Labels:
        """Both coordinates of all points, with the number of the orbit."""
        number = np.repeat(np.arange(len(self.orbits)), [len(one) for one in self.orbits])
        points = np.concatenate([np.empty((0, 2)), *self.orbits])
        return Labels(
            {"orbit": (("point",), number)},
            {name: (("point",), points[:, i]) for i, name in enumerate(self.names)},
            place_units(self.names),
            self.facts,
        )


def return_map(
    body: SectionedBody,
    *,
    E: float | None = None,
    h: float | None = None,
    f: float | None = None,
    plane: int = 3,
    sheet: int = 0,
    accuracy: Accuracy = "precise",
) -> ReturnMap:
    """The return map of a section of a body at fixed values of its integrals.

    A `SuslovBody` takes E and the plane γ_k = 0, k = `plane`, places (ψ, δ); a `BallBody` h, places (ψ, δ); a
    `HeavyBody` h, f and a sheet, places (l, L/G); a `HessBody` h and f of a torus, units b = 1, places (φ,); a
    `QuarticBody` has its energy already, places (q, p).
    Raises `InvalidParameter`.

    >>> from hess_mechanics import SuslovBody, return_map
    >>> P = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842)
    >>> P.image((0.3, 1.2)).shape, P.names
    ((2,), ('ψ', 'δ'))
    """
    asked: dict[str, float | None] = {"E": E, "h": h, "f": f}
    found: PoincareSection
    if isinstance(body, SuslovBody):
        at = _given(asked, "E")
        require_reached(found := SuslovSection(body, at[0], as_whole("plane", plane, 1, 3)))
    elif isinstance(body, BallBody):
        found = BallSection(body, *_given(asked, "h"))
    elif isinstance(body, HeavyBody):
        at = _given(asked, "h", "f")
        found = AndoyerSection(body, at[0], at[1], as_whole("sheet", sheet, 0, 2))
    elif isinstance(body, QuarticBody):
        _given(asked)
        found = QuarticSection(body)
    else:
        found = TorusSection(as_a(HessBody, body).a, *_given(asked, "h", "f"))
    return ReturnMap(found, as_level(accuracy))


def section_orbits(
    map_: ReturnMap, *, starts: Sequence[Sequence[float]] = (), orbits: int = 20, crossings: int = 200
) -> PlanePoints:
    """Return the crossings of many orbits with the section of a `return_map`, each computed once.

    Parameters
    ----------
    map_ : its section, direction of time and level of accuracy.
    starts : places of the section where the orbits start.
    orbits : how many are spread over the section where no `starts` are given.
    crossings : of each orbit.

    Raises
    ------
    `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, return_map, section_orbits
    >>> P = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842, accuracy="standard")
    >>> section_orbits(P, orbits=4, crossings=30).to_xarray().sizes["point"]
    120
    """
    section = map_.section
    require_plane(section)
    count = as_whole("crossings", crossings, 1, _MOST_CROSSINGS)
    states = (
        np.array([map_.state_at(np.array(one)) for one in as_pairs("starts", starts)])
        if len(starts)
        else _spread(section, as_whole("orbits", orbits, 1, _MOST_ORBITS))
    )
    end = _TURNS * count * section.slowness / Problem.of(section, states).nu
    found = section_points(
        section,
        states,
        section.surface,
        -end if map_.backward else end,
        plan(Computation.SECTION, map_.accuracy).level,
        count,
    )
    x, y = section.names
    return PlanePoints(
        (x, y),
        tuple(section.places_of(one) for one in found.states),
        {
            "level": map_.level,
            **{f"drift of {name}": value for name, value in found.drift.items()},
            "steps": found.cost.steps,
        },
    )


def _spread(section: PoincareSection, orbits: int) -> Array:
    """Return the states of as many orbits as possible, evenly over the window of a section.  Raises `OutsideRegion`."""
    low, high = np.array(section.window).T[:, :, None]
    for tried in _TRIED:
        states, there = section.states_at(*(low + evenly(tried * orbits) * (high - low)))
        if np.count_nonzero(there) >= orbits:
            break
    if not there.any():
        raise OutsideRegion("No motion crosses the section here: choose a larger energy.")
    return np.asarray(states[there][:orbits])


def periodic_orbit(map_: ReturnMap, at: Sequence[float], period: int | None = None) -> PeriodicOrbit:
    """The periodic orbit of a `return_map` that Newton's method finds from a place, with multipliers and type.

    period : the least number of returns; None: found, up to 12.
    Raises `InvalidParameter`, `NotConverged`.

    >>> from hess_mechanics import HessBody, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> periodic_orbit(P, (-2.0,)).kind  # the stable limit cycle
    'stable node'
    """
    found = find_periodic(map_, at, None if period is None else as_whole("period", period, 1, MAX_PERIOD))
    return replace(found, symmetric=tuple(map_.symmetries_of(found.places)))


def continued_orbit(map_: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, points: int = 200) -> Branch:
    """The branch of a periodic orbit of a `return_map` over a parameter of it, from its own value towards `to`.

    parameter : one of `map_.section.constants`.  Folds are passed; bifurcations are found and named.
    Raises `InvalidParameter`, `NotConverged`, `WorkLimit`.

    >>> from hess_mechanics import HessBody, continued_orbit, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> branch = continued_orbit(P, periodic_orbit(P, (-2.0,)), "h", 1.6, points=5)
    >>> branch.kinds[0], len(branch.bifurcations)
    ('stable node', 0)
    """
    return continued(
        lambda value: map_.moved(parameter, value),
        orbit,
        parameter,
        map_.constant(parameter),
        as_number("to", to),
        as_whole("points", points, 2, 2000),
        lambda one, places: one.symmetries_of(places) if isinstance(one, ReturnMap) else (),
    )


def manifold(
    map_: ReturnMap,
    saddle: PeriodicOrbit,
    length: float,
    *,
    stable: bool = False,
    side: int = 1,
    place: int = 0,
    sagitta: float = 1e-3,
    longest: float = 0.1,
) -> Manifold:
    """A branch of the unstable or stable manifold of a saddle of a `return_map`, up to a length.

    side : 1 or −1, along its direction or against it; place : from which of the places of the saddle; sagitta : the
    largest distance from the polyline; longest : of its chords.  Raises `InvalidParameter`, `WorkLimit`, `NoReturn`.

    >>> from hess_mechanics import HeavyBody, manifold, periodic_orbit, return_map
    >>> P = return_map(HeavyBody.hess((1.0, 1.6, 4.0), 1.0), h=1.5, f=-0.76)
    >>> saddle = periodic_orbit(P, (-2.84, 0.288), 1)
    >>> manifold(P, saddle, 0.5).length >= 0.5
    True
    """
    return grown(
        map_,
        saddle,
        as_number("length", length),
        stable,
        side,
        place,
        as_number("sagitta", sagitta),
        as_number("longest", longest),
    )


def orbit_diagram(
    map_: ReturnMap,
    parameter: str,
    values: Sequence[float] | Array,
    at: Sequence[float],
    *,
    transient: int = 200,
    kept: int = 64,
    follow: bool = True,
) -> Diagram:
    """Where an orbit of a `return_map` settles over a parameter of it, at each of the values (n,), in their order.

    at : where it starts.  transient, kept : crossings that are left out, and shown, at each value.
    follow : it goes on from where it was at the value before; else it starts anew at each.
    Backward in time, where repellers are: of `map_.inverse()`.  Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, orbit_diagram, return_map
    >>> P = return_map(SuslovBody(1.0, 2.25, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681, accuracy="standard")
    >>> orbit_diagram(P, "I22", [2.11, 2.2], (0.8, 1.9)).periods.tolist()  # it doubles at 2.126
    [1, 2]
    """
    map_.constant(parameter)
    place = as_place(map_.names, at)
    transient, kept = as_whole("transient", transient, 0, 20_000), as_whole("kept", kept, 1, 20_000)
    if len(np.atleast_1d(values)) * kept > _MOST_PLACES:
        raise WorkLimit(f"An orbit diagram has at most {_MOST_PLACES} places: choose fewer values, or crossings kept.")
    return diagram_over(lambda value: map_.moved(parameter, value), parameter, values, place, transient, kept, follow)


def period_doublings(map_: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, most: int = 6) -> Cascade:
    """The doublings of the period of an orbit of a `return_map`, over a parameter from its own value towards `to`.

    Each is where the orbit of that period has the multiplier −1.  Raises `InvalidParameter`, `NotConverged`.

    >>> from hess_mechanics import SuslovBody, period_doublings, periodic_orbit, return_map
    >>> P = return_map(SuslovBody(1.0, 2.11, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681)
    >>> found = period_doublings(P, periodic_orbit(P, (0.83, 1.89), 1), "I22", 2.4, most=1)
    >>> found.periods.tolist(), round(float(found.values[0]), 3)
    ([1], 2.126)
    """
    return cascade(
        lambda value: map_.moved(parameter, value),
        parameter,
        orbit,
        map_.constant(parameter),
        as_number("to", to),
        as_whole("most", most, 1, 6),
    )


def _given(asked: dict[str, float | None], *names: str) -> list[float]:
    """The numbers of these names; those that the section does not have must not be given."""
    lost = [name for name in names if asked[name] is None]
    if lost:
        raise InvalidParameter(f"The section of this body lies at given {' and '.join(names)}: give {lost[0]}.")
    extra = [name for name, value in asked.items() if value is not None and name not in names]
    if extra:
        raise InvalidParameter(
            f"The section of this body takes {' and '.join(names) or 'its own energy'} and no {extra[0]}: leave it out."
        )
    return [as_number(name, asked[name]) for name in names]
