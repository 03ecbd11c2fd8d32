"""What return maps of sections tell, asked for by a body and words: periodic orbits, manifolds, diagrams, regimes.

A return map is that of a section of a body at fixed values of its integrals, `return_map(body, …)`.  Results can be
handed on: `.to_pandas()`, `.to_xarray()`, `.plot()`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.section import BallSection
from hess_mechanics.dynamics import megno_map as cells_of
from hess_mechanics.dynamics import orbit_diagram as diagrams
from hess_mechanics.dynamics import regime as regimes
from hess_mechanics.dynamics.cells import Window
from hess_mechanics.dynamics.continuation import Branch, continued
from hess_mechanics.dynamics.manifolds import Manifold, grown
from hess_mechanics.dynamics.megno_map import MegnoMap
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram
from hess_mechanics.dynamics.periodic import PeriodicOrbit, find_periodic
from hess_mechanics.dynamics.regime import Dynamics, Regime
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_a, as_cells, as_level, as_number, as_place, as_whole
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.quartic import QuarticBody, QuarticSection
from hess_mechanics.suslov.section import SuslovSection, require_reached
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.section import TorusSection

__all__ = [
    "continued_orbit", "dynamics_of", "manifold", "megno_map", "orbit_diagram", "period_doublings", "periodic_orbit",
    "regime", "return_map",
]

Body = SuslovBody | QuarticBody | BallBody | HeavyBody | HessBody
_MOST_PLACES = 1_000_000


def return_map(body: Body, *, E: float | None = None, h: float | None = None, f: float | None = None,
               plane: int = 3, sheet: int = 0, accuracy: Accuracy = "precise") -> ReturnMap:
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


def periodic_orbit(section: ReturnMap, at: Sequence[float], period: int | None = None) -> PeriodicOrbit:
    """The periodic orbit of a `return_map` that Newton's method finds from a place, with multipliers and type.

    period : the least number of returns; None: found, up to 12.
    Raises `InvalidParameter`, `NotConverged`.

    >>> from hess_mechanics import HessBody, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> periodic_orbit(P, (-2.0,)).kind  # the stable limit cycle
    'stable node'
    """
    found = find_periodic(section, at, None if period is None else as_whole("period", period, 1, 64))
    return replace(found, symmetric=tuple(section.symmetries_of(found.places)))


def continued_orbit(section: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, points: int = 200) -> Branch:
    """The branch of a periodic orbit of a `return_map` over a parameter of it, from its own value towards `to`.

    parameter : one of `section.sheet.constants`.  Folds are passed; bifurcations are found and named.
    Raises `InvalidParameter`, `NotConverged`, `WorkLimit`.

    >>> from hess_mechanics import HessBody, continued_orbit, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> branch = continued_orbit(P, periodic_orbit(P, (-2.0,)), "h", 1.6, points=5)
    >>> branch.kinds[0], len(branch.bifurcations)
    ('stable node', 0)
    """
    return continued(lambda value: section.moved(parameter, value), orbit, parameter, section.constant(parameter),
                     as_number("to", to), as_whole("points", points, 2, 2000),
                     lambda map_, places: map_.symmetries_of(places) if isinstance(map_, ReturnMap) else ())


def manifold(section: ReturnMap, saddle: PeriodicOrbit, length: float, *, stable: bool = False, side: int = 1,
             place: int = 0, sagitta: float = 1e-3, longest: float = 0.1) -> Manifold:
    """A branch of the unstable or stable manifold of a saddle of a `return_map`, up to a length.

    side : 1 or −1, along its direction or against it; place : from which of the places of the saddle; sagitta : the
    largest distance from the polyline; longest : of its chords.  Raises `InvalidParameter`, `WorkLimit`, `NoReturn`.

    >>> from hess_mechanics import HeavyBody, manifold, periodic_orbit, return_map
    >>> P = return_map(HeavyBody.hess((1.0, 1.6, 4.0), 1.0), h=1.5, f=-0.76)
    >>> saddle = periodic_orbit(P, (-2.84, 0.288), 1)
    >>> manifold(P, saddle, 0.5).length >= 0.5
    True
    """
    return grown(section, saddle, as_number("length", length), stable, side, place, as_number("sagitta", sagitta),
                 as_number("longest", longest))


def megno_map(section: ReturnMap, cells: tuple[int, int] = (16, 12), window: Window | None = None, t: float = 200.0
              ) -> MegnoMap:
    """MEGNO of the motions from the cells of the section of a `return_map` after the time t, on all cores.

    cells : across and up; window : (x0, y0), (x1, y1), by default all of the section.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import QuarticBody, megno_map, return_map
    >>> found = megno_map(return_map(QuarticBody(2.0, 1.0, 1.0, 0.8), accuracy="standard"), cells=(6, 4), t=50.0)
    >>> found.values.shape, found.names
    ((4, 6), ('q', 'p'))
    """
    _of_a_plane(section)
    sides = section.sheet.window
    corners = tuple(zip(*sides, strict=True)) if window is None else window
    (x0, y0), (x1, y1) = (as_place(section.names, corner) for corner in corners)
    # An angle may begin where it likes.
    inside = all(math.isfinite(turn) or (low <= a and b <= high) for turn, (low, high), a, b in zip(
        section.turns, sides, (x0, y0), (x1, y1), strict=True))
    if not (x0 < x1 and y0 < y1 and inside):
        across, up = (f"{low:.6g} to {high:.6g}" for low, high in sides)
        raise InvalidParameter("A window is (x0, y0), (x1, y1) with x0 < x1, y0 < y1: here "
                               f"{section.names[0]} goes from {across}, {section.names[1]} from {up}.")
    return cells_of.over_section(section.sheet, ((x0, y0), (x1, y1)), as_cells(cells), as_number("t", t),
                                 section.accuracy)


def orbit_diagram(section: ReturnMap, parameter: str, values: Sequence[float] | Array, at: Sequence[float], *,
                  transient: int = 200, kept: int = 64, follow: bool = True) -> Diagram:
    """Where an orbit of a `return_map` settles over a parameter of it, at each of the values (n,), in their order.

    at : where it starts.  transient, kept : crossings that are left out, and shown, at each value.
    follow : it goes on from where it was at the value before; else it starts anew at each.
    Backward in time, where repellers are: of `section.inverse()`.  Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, orbit_diagram, return_map
    >>> P = return_map(SuslovBody(1.0, 2.25, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681, accuracy="standard")
    >>> orbit_diagram(P, "I22", [2.11, 2.2], (0.8, 1.9)).periods.tolist()  # it doubles at 2.126
    [1, 2]
    """
    section.constant(parameter)
    place = as_place(section.names, at)
    transient, kept = as_whole("transient", transient, 0, 20_000), as_whole("kept", kept, 1, 20_000)
    if len(np.atleast_1d(values)) * kept > _MOST_PLACES:
        raise WorkLimit(f"An orbit diagram has at most {_MOST_PLACES} places: choose fewer values, or crossings kept.")
    return diagrams.orbit_diagram(lambda value: section.moved(parameter, value), parameter, values, place, transient,
                                  kept, follow)


def period_doublings(section: ReturnMap, orbit: PeriodicOrbit, parameter: str, to: float, most: int = 6) -> Cascade:
    """The doublings of the period of an orbit of a `return_map`, over a parameter from its own value towards `to`.

    Each is where the orbit of that period has the multiplier −1.  Raises `InvalidParameter`, `NotConverged`.

    >>> from hess_mechanics import SuslovBody, period_doublings, periodic_orbit, return_map
    >>> P = return_map(SuslovBody(1.0, 2.11, 0.6, 0.6, -1.0, -0.5, 0.7), E=0.681)
    >>> found = period_doublings(P, periodic_orbit(P, (0.83, 1.89), 1), "I22", 2.4, most=1)
    >>> found.periods.tolist(), round(float(found.values[0]), 3)
    ([1], 2.126)
    """
    return diagrams.cascade(lambda value: section.moved(parameter, value), parameter, orbit,
                            section.constant(parameter), as_number("to", to), as_whole("most", most, 1, 6))


def regime(section: ReturnMap, at: Sequence[float], *, transient: int = 300, kept: int = 200, t: float = 200.0
           ) -> Regime:
    """The kind of the motion from a place of the section of a `return_map`, after so many crossings left out.

    kept : crossings that are looked at; t : the time over which MEGNO and the divergence are averaged.
    Raises `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import HessBody, regime, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> regime(P, (0.3,), t=100.0).kind.words  # it comes to the stable limit cycle
    'fixed point'
    """
    return regimes.regime(section, as_place(section.names, at), as_whole("transient", transient, 0, 20_000),
                          as_whole("kept", kept, 1, 20_000), as_number("t", t))


def dynamics_of(section: ReturnMap, at: Sequence[float], *, transient: int = 500, kept: int = 2000, t: float = 1000.0
                ) -> Dynamics:
    """To what the orbit from a place comes forward and backward in time: conservative, dissipative or mixed.

    Told by the distance of the two sets, with its error, and by the mean divergence over the time t.
    Raises `InvalidParameter`, `OutsideRegion`, `NoReturn`, `WorkLimit`.

    >>> from hess_mechanics import HessBody, dynamics_of, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> dynamics_of(P, (0.3,), transient=60, kept=64, t=100.0).verdict  # a stable cycle, and an unstable one
    'dissipative'
    """
    return regimes.dynamics_of(section, as_place(section.names, at), as_whole("transient", transient, 0, 50_000),
                               as_whole("kept", kept, 8, 50_000), as_number("t", t))


def _of_a_plane(section: ReturnMap) -> None:
    if len(section.names) != 2:
        raise InvalidParameter(f"The section of this body has the coordinate {section.names[0]} alone: there is no "
                               "plane to fill with cells.")


def _given(asked: dict[str, float | None], *names: str) -> list[float]:
    """The numbers of these names; those that the section does not have must not be given."""
    lost = [name for name in names if asked[name] is None]
    if lost:
        raise InvalidParameter(f"The section of this body lies at given {' and '.join(names)}: give {lost[0]}.")
    extra = [name for name, value in asked.items() if value is not None and name not in names]
    if extra:
        raise InvalidParameter(f"The section of this body takes {' and '.join(names) or 'its own energy'} and no "
                               f"{extra[0]}: leave it out.")
    return [as_number(name, asked[name]) for name in names]
