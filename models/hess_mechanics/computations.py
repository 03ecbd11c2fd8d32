"""What the scenes compute, asked for by a body and words: orbits, exponents, sections, basins, clouds, periods.

A body is any of those of this package: `SuslovBody`, `HessBody`, `BallBody`, `HeavyBody`.  `accuracy` is the name of a
level: "draft", "standard", "precise" or "reference".  Results can be handed on: `.to_pandas()`, `.to_xarray()`,
`.plot()`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Integral, Real
from typing import Any, Protocol, TypeVar

import numpy as np

from hess_mechanics.chaplygin_ball import integrable_cases, phase_cloud_density
from hess_mechanics.chaplygin_ball import section as ball
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.dynamics.continuation import Branch, continued
from hess_mechanics.dynamics.lyapunov import Exponent, largest_exponent
from hess_mechanics.dynamics.manifolds import Manifold, grown
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.periodic import PeriodicOrbit, find_periodic, place_units
from hess_mechanics.dynamics.return_map import ReturnMap, Sheet
from hess_mechanics.dynamics.section import Points
from hess_mechanics.dynamics.spectrum import Spectrum, spectrum
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, andoyer_points
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.rotation import Ends, Rotation, on_line, rotation_along
from hess_mechanics.numerics.accuracy import Kind, Level, level, plan
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.suslov.basins import Contraction, contraction_at, groups_of_cells, middle_cells
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.quartic import QuarticBody, QuarticSection
from hess_mechanics.suslov.section import SuslovSection, lowest_energy, suslov_points
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at
from hess_mechanics.suslov_hess.section import TorusSection

__all__ = [
    "Basins", "MegnoMap", "PlanePoints", "andoyer_section", "ball_section", "basins", "cloud", "continued_orbit",
    "lyapunov_exponent", "lyapunov_spectrum", "manifold", "megno_map", "orbit", "period", "periodic_orbit",
    "return_map", "rotation_along_line", "rotation_numbers", "suslov_section",
]

Window = tuple[tuple[float, float], tuple[float, float]]
_MOST_ORBITS, _MOST_CROSSINGS, _MOST_CELLS = 1000, 10_000, 100_000
_LONG = 1000.0
"""Time over which the divergence of one motion of each group is averaged."""


class Body(Protocol):
    """What moves: its equations, and their parameters."""

    @property
    def system(self) -> System:
        """The equations of motion."""

    @property
    def parameters(self) -> tuple[float, ...]:
        """Their parameters."""


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
        return Labels({"orbit": (("point",), number)},
                      {name: (("point",), points[:, i]) for i, name in enumerate(self.names)},
                      place_units(self.names), self.facts)


@dataclass(frozen=True)
class Basins(Result):
    """To which group of motions each cell of a section leads.

    psi (m,), delta (n,) : the middles of the cells; mean (n, m) : of ω1 in the long run, NaN where no motion is;
    group (n, m) : the number of the group, −1 where no motion is; divergence : of one motion of each group.
    """

    psi: Array
    delta: Array
    mean: Array
    group: Array
    divergence: tuple[Contraction, ...]
    level: str

    @property
    def attractors(self) -> int:
        """How many of the groups attract."""
        return sum(one.attracts for one in self.divergence)

    def labels(self) -> Labels:
        """Mean and group over δ and ψ."""
        return Labels({"δ": (("δ",), self.delta), "ψ": (("ψ",), self.psi)},
                      {"mean": (("δ", "ψ"), self.mean), "group": (("δ", "ψ"), self.group)},
                      {"δ": "rad", "ψ": "rad", "mean": "rad/T"},
                      {"groups": len(self.divergence), "attractors": self.attractors, "level": self.level})


@dataclass(frozen=True)
class MegnoMap(Result):
    """Regular, chaotic, attracted: MEGNO over the cells of a section.

    psi (m,), delta (n,) : the middles of the cells; values (n, m) : Ȳ after the time t, NaN where no motion is;
    kind (n, m) : 0 regular, 1 chaotic, and 2 more where volume shrinks beyond its error; −1 where no motion is.
    """

    psi: Array
    delta: Array
    values: Array
    kind: Array
    t: float
    level: str

    def labels(self) -> Labels:
        """MEGNO and kind over δ and ψ."""
        return Labels({"δ": (("δ",), self.delta), "ψ": (("ψ",), self.psi)},
                      {"MEGNO": (("δ", "ψ"), self.values), "kind": (("δ", "ψ"), self.kind)},
                      {"δ": "rad", "ψ": "rad", "MEGNO": "1"}, {"t": self.t, "level": self.level})


def orbit(body: Body, state: Sequence[float], t: float | Sequence[float] | Array, accuracy: str = "precise",
          samples: int = 500) -> Orbit:
    """The orbit of a body from a state, at the times t, or at so many samples from 0 to the time t.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, orbit
    >>> found = orbit(SuslovBody(2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0), (0.8, -0.4, 0.6, 0.0, 0.8), t=10.0)
    >>> found.states.shape, str(found.status), found.variables
    ((500, 5), 'ok', ('ω1', 'ω2', 'γ1', 'γ2', 'γ3'))
    """
    times: Any = np.linspace(0.0, _number("t", t), _whole("samples", samples, 2, 200_000)) if np.ndim(t) == 0 else t
    moving = _moving(body)
    return solve(moving.system, state, moving.parameters, times, level(accuracy))


def lyapunov_exponent(body: Body, state: Sequence[float], t: float, accuracy: str = "standard") -> Exponent:
    """The largest Lyapunov exponent of the orbit from a state, averaged over the time t; backwards for t < 0.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, lyapunov_exponent
    >>> found = lyapunov_exponent(SuslovBody(1.5, 1.0, 0.0, 0.0), (0.5, 1.2, 0.6, 0.0, 0.8), t=200.0)
    >>> found.is_regular
    True
    """
    moving = _moving(body)
    return largest_exponent(moving.system, state, moving.parameters, _number("t", t),
                            plan(Kind.EXPONENT, accuracy).level)


def lyapunov_spectrum(body: Body, state: Sequence[float], t: float, accuracy: str = "standard") -> Spectrum:
    """All Lyapunov exponents of the orbit from a state, with errors, over the time t; backwards for t < 0.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, lyapunov_spectrum
    >>> found = lyapunov_spectrum(SuslovBody(1.7, 3.0, 0.3, 0.1, -2.0, -2.1, 2.6), (0.8, 1.3, 0.6, 0.0, 0.8), t=2000.0)
    >>> found.signs, bool(2.0 < found.dimension[0] < 3.0)
    (('+', '0', '0', '0', '-'), True)
    """
    moving = _moving(body)
    return spectrum(moving.system, state, moving.parameters, _number("t", t), level(accuracy))


def andoyer_section(body: HeavyBody, h: float, f: float, *, starts: Sequence[tuple[float, float]] = (),
                    orbits: int = 20, crossings: int = 200, sheet: int = 0, accuracy: str = "standard") -> PlanePoints:
    """The Andoyer–Deprit section g = π/2 of a heavy body at H = h, (M, γ) = f: points (l, L/G).

    starts : places (l, L/G) of orbits; else so many `orbits` are spread over the section.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import HeavyBody, andoyer_section
    >>> found = andoyer_section(HeavyBody.hess((1.0, 1.5, 2.0), 1.0), 2.0, 0.5, orbits=3, crossings=50)
    >>> len(found.orbits), found.names
    (3, ('l', 'L/G'))
    """
    section = AndoyerSection(_a(HeavyBody, body), _number("h", h), _number("f", f), _whole("sheet", sheet, 0, 2))
    states = _starts(section, starts, orbits, ((-math.pi, -1.0), (math.pi, 1.0)), "this energy and area integral")
    found = andoyer_points(body, h, f, states, _whole("crossings", crossings, 1, _MOST_CROSSINGS),
                           plan(Kind.SECTION, accuracy).level)
    return _in_plane(found, section, ("l", "L/G"), accuracy)


def suslov_section(body: SuslovBody, E: float, *, plane: int = 3, starts: Sequence[tuple[float, float]] = (),
                   orbits: int = 20, crossings: int = 200, forward: bool = True, accuracy: str = "standard"
                   ) -> PlanePoints:
    """The section γ_k = 0, k = `plane`, of the Suslov problem with gravity at the energy E: points (ψ, δ).

    starts : places (ψ, δ) of orbits; else so many `orbits` are spread over the section.
    Raises `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, suslov_section
    >>> body = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)
    >>> suslov_section(body, 1.842, orbits=4, crossings=30).to_xarray().sizes["point"]
    120
    """
    section = SuslovSection(_a(SuslovBody, body), _number("E", E), _whole("plane", plane, 1, 3))
    _require_energy(section)
    states = _starts(section, starts, orbits, ((-math.pi, 0.0), (math.pi, math.pi)), "this energy")
    found = suslov_points(body, plane, states, _whole("crossings", crossings, 1, _MOST_CROSSINGS), forward,
                          plan(Kind.SECTION, accuracy).level)
    return _in_plane(found, section, ("ψ", "δ"), accuracy)


def ball_section(body: BallBody, h: float, *, starts: Sequence[tuple[float, float]] = (), orbits: int = 20,
                 crossings: int = 200, accuracy: str = "standard") -> PlanePoints:
    """The section γ3 = 0 of the Chaplygin ball in a field, at the energy h: points (ψ, δ).

    starts : places (ψ, δ) of orbits; else so many `orbits` are spread over the section.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import BallBody, ball_section
    >>> found = ball_section(BallBody(1.0, 3.0, 0.0, 0.0, 5.0, 0.5, 0.0, 0.8), 2.0, orbits=3, crossings=20)
    >>> found.to_pandas().shape
    (60, 3)
    """
    _a(BallBody, body)
    _number("h", h)
    states = ([ball.state_at(body, h, *place) for place in _pairs("starts", starts)] if len(starts) else
              ball.seeds(body, h, _whole("orbits", orbits, 1, _MOST_ORBITS)))
    found = ball.ball_section(body, h, states, _whole("crossings", crossings, 1, _MOST_CROSSINGS),
                              plan(Kind.SECTION, accuracy).level)
    return PlanePoints(("ψ", "δ"), tuple(map(ball.coordinates, found.states)), _facts(found, accuracy))


def basins(body: SuslovBody, E: float, *, plane: int = 3, cells: tuple[int, int] = (16, 12),
           window: Window = ((-math.pi, 0.0), (math.pi, math.pi)), crossings: int = 150,
           accuracy: str | Level = "standard") -> Basins:
    """To which group of motions the cells of a section of the Suslov problem lead, and which groups attract.

    cells : across ψ and up δ; window : (ψ0, δ0), (ψ1, δ1); crossings : how far each orbit is followed.
    accuracy : what a level of that name means here, coarser than elsewhere; or a level as it is.
    Raises `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, basins
    >>> basins(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842, cells=(6, 4), accuracy="draft").group.shape
    (4, 6)
    """
    section = SuslovSection(_a(SuslovBody, body), _number("E", E), _whole("plane", plane, 1, 3))
    _require_energy(section)
    m, n = _cells(cells)
    (x0, y0), (x1, y1) = _window(window)
    ends, chosen = np.empty((n, m)), accuracy if isinstance(accuracy, Level) else plan(
        Kind.BASINS, accuracy).level

    def row(i: int) -> None:
        ends[i] = section.ends(window, (m, n), i, crossings, level=chosen)

    share(row, n)
    group = groups_of_cells(ends)
    on_each = tuple(contraction_at(section, window, (m, n), *cell, _LONG) for cell in middle_cells(ends, group))
    return Basins(frozen(x0 + (np.arange(m) + 0.5) * (x1 - x0) / m), frozen(y0 + (np.arange(n) + 0.5) * (y1 - y0) / n),
                  frozen(np.where(np.isfinite(ends), ends, np.nan)), frozen(group), on_each, chosen.name)


def megno_map(body: SuslovBody, E: float, *, plane: int = 3, cells: tuple[int, int] = (16, 12),
              window: Window = ((-math.pi, 0.0), (math.pi, math.pi)), t: float = 200.0, accuracy: str = "standard"
              ) -> MegnoMap:
    """MEGNO of the motions from the cells of a section of the Suslov problem after the time t, on all cores.

    cells : across ψ and up δ; window : (ψ0, δ0), (ψ1, δ1).  Raises `InvalidParameter`, `OutsideRegion`, `WorkLimit`.

    >>> from hess_mechanics import SuslovBody, megno_map
    >>> megno_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842, cells=(6, 4), t=50.0).values.shape
    (4, 6)
    """
    section = SuslovSection(_a(SuslovBody, body), _number("E", E), _whole("plane", plane, 1, 3))
    _require_energy(section)
    m, n = _cells(cells)
    (x0, y0), (x1, y1) = _window(window)
    middles = [section.cells_of_row(window, (m, n), i) for i in range(n)]
    possible = np.array([there for _, there in middles])
    found = megno(body.system, np.array([states for states, _ in middles])[possible], body.parameters,
                  _number("t", t), level(accuracy))
    values, kind = np.full((n, m), np.nan), np.full((n, m), -1)
    values[possible] = found.values
    kind[possible] = found.chaotic + 2 * found.attracted
    psi, delta = x0 + (np.arange(m) + 0.5) * (x1 - x0) / m, y0 + (np.arange(n) + 0.5) * (y1 - y0) / n
    return MegnoMap(frozen(psi), frozen(delta), frozen(values), frozen(kind), found.t, accuracy)


def cloud(body: BallBody, h: float, t: float, *, count: int = 1000, spread: float = 0.1, angle: float | None = None,
          accuracy: str = "standard") -> Cloud:
    """A cloud of phase points of the ball without a field, about the energy h, followed to the time t.

    spread : of the energies, or the radius of a patch about the ω at an `angle` with γ = e3.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import BallBody, cloud
    >>> cloud(BallBody(2.0, 1.0, 0.5, 0.7, 0.0), 2.0, 5.0, count=50, accuracy="draft").omega.shape[0]
    50
    """
    found = phase_cloud_density.clouds(_a(BallBody, body), _number("h", h), angle, _number("spread", spread),
                                       _whole("count", count, 1, 20_000), _number("t", t), None, level(accuracy))
    return found.cloud


def period(body: BallBody, state: Sequence[float], accuracy: str = "precise") -> integrable_cases.Period:
    """The period of an orbit of the ball with I13 = I23 = 0, b3 = 0, where every orbit across the equator closes.

    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import BallBody, period
    >>> period(BallBody(1.3, 0.8, 0.0, 0.0, 0.0, 0.5, -0.2, 0.0), (1.0, -0.5, 0.0, 0.6, 0.8)).value > 0
    True
    """
    return integrable_cases.period(_a(BallBody, body), state, level(accuracy))


def rotation_numbers(a: float | Array, h: float | Array, f: float | Array, accuracy: str = "precise") -> TorusValues:
    """Rotation number, trace and locking of the tori (a, h, f) of the Suslov–Hess case, numbers or arrays (n,).

    Raises `InvalidParameter`, `WorkLimit`.

    >>> import numpy as np
    >>> from hess_mechanics import rotation_numbers
    >>> rotation_numbers(0.5, np.array([0.2, 1.5]), 0.6).locked.tolist()
    [False, True]
    """
    for name, values in (("a", a), ("h", h), ("f", f)):
        try:
            np.asarray(values, float)
        except (TypeError, ValueError):
            raise InvalidParameter(f"{name} = {values!r} is not a number, nor several; write it like 1.5 or "
                                   "[1.5, 2.0].") from None
    return values_at(a, h, f, level(accuracy))


def rotation_along_line(body: HeavyBody, h: float, f: float, ends: Ends, *, count: int = 24, crossings: int = 300,
                        about_first: bool = False, accuracy: str = "standard") -> Rotation:
    """Rotation numbers of orbits that start on a line of the Andoyer–Deprit section, between places (l, L/G).

    about_first : turns are counted about the first end of the line; else by the angle l.
    Raises `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import HeavyBody, rotation_along_line
    >>> body = HeavyBody.hess((1.0, 1.5, 2.0), 0.01)
    >>> rotation_along_line(body, 2.0, 0.5, ((0.0, 0.85), (0.0, 0.95)), count=4).to_xarray()["ρ"].attrs["units"]
    'turns'
    """
    section = AndoyerSection(_a(HeavyBody, body), _number("h", h), _number("f", f))
    first, last = _pairs("ends", ends)
    started = on_line(section, (first, last), _whole("count", count, 1, _MOST_ORBITS))
    if not started:
        raise OutsideRegion("Nowhere on this line does a motion cross the section: choose another line, or a larger h.")
    chosen = plan(Kind.ROTATION, accuracy)
    found = andoyer_points(body, h, f, [state for _, state in started], _whole("crossings", crossings, 20, 10_000),
                           chosen.level)
    return rotation_along((first, last), [one for one, _ in started], [section.places_of(one) for one in found.states],
                          about_first, count, chosen.promise)


def return_map(body: Body | HessBody, *, E: float | None = None, h: float | None = None, f: float | None = None,
               plane: int = 3, sheet: int = 0, accuracy: str = "precise") -> ReturnMap:
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
    found: Sheet
    if isinstance(body, SuslovBody):
        at = _given(asked, "E")
        _require_energy(found := SuslovSection(body, at[0], _whole("plane", plane, 1, 3)))
    elif isinstance(body, BallBody):
        found = ball.BallSection(body, *_given(asked, "h"))
    elif isinstance(body, HeavyBody):
        at = _given(asked, "h", "f")
        found = AndoyerSection(body, at[0], at[1], _whole("sheet", sheet, 0, 2))
    elif isinstance(body, QuarticBody):
        _given(asked)
        found = QuarticSection(body)
    else:
        found = TorusSection(_a(HessBody, body).a, *_given(asked, "h", "f"))
    return ReturnMap(found, level(accuracy))


def periodic_orbit(section: ReturnMap, at: Sequence[float], period: int | None = None) -> PeriodicOrbit:
    """The periodic orbit of a `return_map` that Newton's method finds from a place, with multipliers and type.

    period : the least number of returns; None: found, up to 12.
    Raises `InvalidParameter`, `NotConverged`.

    >>> from hess_mechanics import HessBody, periodic_orbit, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> periodic_orbit(P, (-2.0,)).kind  # the stable limit cycle
    'stable node'
    """
    found = find_periodic(section, at, None if period is None else _whole("period", period, 1, 64))
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
    if parameter not in section.sheet.constants:
        raise InvalidParameter(f"There is no {parameter} here to change: choose one of "
                               f"{', '.join(section.sheet.constants)}.")
    return continued(lambda value: section.moved(parameter, value), orbit, parameter,
                     section.sheet.constants[parameter], _number("to", to), _whole("points", points, 2, 2000),
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
    return grown(section, saddle, _number("length", length), stable, side, place, _number("sagitta", sagitta),
                 _number("longest", longest))


def _given(asked: dict[str, float | None], *names: str) -> list[float]:
    """The numbers of these names; those that the section does not have must not be given."""
    lost = [name for name in names if asked[name] is None]
    if lost:
        raise InvalidParameter(f"The section of this body lies at given {' and '.join(names)}: give {lost[0]}.")
    extra = [name for name, value in asked.items() if value is not None and name not in names]
    if extra:
        raise InvalidParameter(f"The section of this body takes {' and '.join(names) or 'its own energy'} and no "
                               f"{extra[0]}: leave it out.")
    return [_number(name, asked[name]) for name in names]


def _cells(cells: tuple[int, int]) -> tuple[int, int]:
    m, n = (_whole("cells", side, 1, _MOST_CELLS) for side in cells)
    if m * n > _MOST_CELLS:
        raise InvalidParameter(f"These are {m * n} cells; at most {_MOST_CELLS} are allowed: choose fewer.")
    return m, n


def _window(window: Window) -> Window:
    (x0, y0), (x1, y1) = window
    if not (x0 < x1 and 0.0 <= y0 < y1 <= math.pi):
        raise InvalidParameter("The window is ψ0 < ψ1 and 0 ≤ δ0 < δ1 ≤ π: choose such angles.")
    return window


def _starts(section: AndoyerSection | SuslovSection, places: Sequence[tuple[float, float]], orbits: int,
            window: Window, there: str) -> Sequence[Sequence[float]]:
    """The states at these places of a section, or of so many orbits spread over it."""
    if not len(places):
        states = section.spread(window, _whole("orbits", orbits, 1, _MOST_ORBITS))
        if not states:
            raise OutsideRegion(f"No motion with {there} crosses the section: choose a larger energy.")
        return states
    pairs = np.array(_pairs("starts", places))
    found, possible = section.states_at(pairs[:, 0], pairs[:, 1])
    if not possible.all():
        x, y = pairs[np.flatnonzero(~possible)[0]]
        raise OutsideRegion(f"No motion with {there} crosses the section at ({x:g}, {y:g}): choose another place.")
    return [tuple(map(float, state)) for state in found]


def _require_energy(section: SuslovSection) -> None:
    lowest = lowest_energy(section.body, section.k)
    if lowest >= section.E:
        raise OutsideRegion(f"No motion with E = {section.E:g} reaches γ{section.k} = 0: choose E above {lowest:.6g}.")


def _in_plane(found: Points, section: AndoyerSection | SuslovSection, names: tuple[str, str], accuracy: str
              ) -> PlanePoints:
    return PlanePoints(names, tuple(section.places_of(states) for states in found.states), _facts(found, accuracy))


def _facts(found: Points, accuracy: str) -> dict[str, float | str]:
    drifts: dict[str, float | str] = {f"drift of {name}": value for name, value in found.drift.items()}
    return {"level": accuracy, **drifts, "steps": found.cost.steps}


T = TypeVar("T")


def _moving(body: Body) -> Body:
    """What was given, if it moves.  Raises `InvalidParameter`."""
    if not (isinstance(getattr(body, "system", None), System) and hasattr(body, "parameters")):
        raise InvalidParameter(f"{body!r} is no body that moves: give a SuslovBody, a PlaneBody, a QuarticBody, "
                               "a BallBody or a HeavyBody.")
    return body


def _a(kind: type[T], body: object) -> T:
    if not isinstance(body, kind):
        raise InvalidParameter(f"{body!r} is no {kind.__name__}: give the body as hess_mechanics.{kind.__name__}(…).")
    return body


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidParameter(f"{name} = {value!r} is not a number; write it like 1.5 or -2e-3.")
    if not math.isfinite(value):
        raise InvalidParameter(f"{name} is not a finite number; write one like 1.5 or -2e-3.")
    return float(value)


def _whole(name: str, value: Any, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
        raise InvalidParameter(f"{name} = {value!r} is not a whole number from {low} to {high}.")
    return int(value)


def _pairs(name: str, places: Any) -> list[tuple[float, float]]:
    try:
        return [(_number(name, x), _number(name, y)) for x, y in places]
    except (TypeError, ValueError) as error:
        if isinstance(error, InvalidParameter):
            raise
        raise InvalidParameter(
            f"{name} = {places!r} are no places; write them like [(0.0, 0.5), (1.0, 0.2)].") from None
