"""Computations of every system with a section, each declared once."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import (
    Choice,
    Computation,
    NoValue,
    Number,
    declare,
    largest_difference,
    returning,
)
from hess_mechanics.dynamics.continuation import Branch
from hess_mechanics.dynamics.manifolds import Manifold, manifold
from hess_mechanics.dynamics.motions import Motions, usual, whole
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, Hysteresis
from hess_mechanics.dynamics.periodic import MAX_PERIOD, PeriodicOrbit
from hess_mechanics.dynamics.regime import MotionKind, Regime, dynamics_of, regime
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.parameters import Parameter
from hess_mechanics.return_maps import (
    Basins,
    PlanePoints,
    basins,
    continued_orbit,
    hysteresis,
    orbit_diagram,
    period_doublings,
    periodic_orbit,
    section_orbits,
)

__all__ = ["computations"]

Place = tuple[float, ...]

_UNDECIDED = (MotionKind.UNDECIDED, MotionKind.SETTLING)
_TRANSIENT = whole("transient", "N₀", 300, 0, 20_000, "Crossings skipped.")
_KEPT = whole("kept", "N", 200, 8, 20_000, "Crossings analysed.")
_SHOWN = whole("kept", "N", 64, 1, 20_000, "Crossings shown at each value.")
_AVERAGED = usual(known.SPAN, 200.0, "Time of MEGNO and of the mean divergence.")
_VALUES = whole("values", "n", 50, 2, 20_000, "Number of values of the parameter.")
_MEASURED = _TRANSIENT, _KEPT, _AVERAGED
_BACKWARD = whole("backward", "−t", 0, 0, 1, "1: backward in time, to repellers.")
_REACH = Parameter(
    "length", "s", "Length of the manifold", 1.0, (0.1, 10.0), 0.1, (1e-3, 1e3), "Length at which the branch ends."
)


def _followed(of: Motions) -> tuple[Choice, Parameter, Parameter]:
    """Return the parameter that is followed, and the ends of its range: by default, a little above the energy."""
    assert of.section is not None
    constants = of.section({one.name: one.default for one in of.parameters}).constants
    name = next((one for one in ("E", "h") if one in constants), [*constants][-1])
    low, high = constants[name], constants[name] + 0.1 * max(1.0, abs(constants[name]))
    return (
        Choice("over", "Parameter that is followed.", (*constants,), name),
        Parameter("low", "from", "First value", low, (low - 1.0, low + 1.0), 0.01, (-1e6, 1e6), "Its first value."),
        Parameter("to", "to", "Last value", high, (low - 1.0, high + 1.0), 0.01, (-1e6, 1e6), "Its last value."),
    )


# ---- computations -----------------------------------------------------------------------------------------------


def _section(map_: ReturnMap, place: Place, orbits: int, crossings: int) -> PlanePoints:
    starts = () if orbits else (place,)
    return section_orbits(map_, starts=starts, orbits=orbits or 1, crossings=crossings)


def _periodic(map_: ReturnMap, place: Place, period: int) -> PeriodicOrbit:
    return periodic_orbit(map_, place, period or None)


def _branch(map_: ReturnMap, place: Place, period: int, over: str, to: float, points: int) -> Branch:
    return continued_orbit(map_, _periodic(map_, place, period), over, to, points)


def _manifold(map_: ReturnMap, place: Place, period: int, length: float, stable: int, side: int) -> Manifold:
    return manifold(map_, _periodic(map_, place, period), length, stable=bool(stable), side=side or 1)


def _diagram(
    map_: ReturnMap,
    place: Place,
    over: str,
    low: float,
    to: float,
    values: int,
    transient: int,
    kept: int,
    follow: int,
    backward: int,
) -> Diagram:
    return orbit_diagram(
        map_.inverse() if backward else map_,
        over,
        np.linspace(low, to, values),
        place,
        transient=transient,
        kept=kept,
        follow=bool(follow),
    )


def _hysteresis(
    map_: ReturnMap,
    place: Place,
    over: str,
    low: float,
    to: float,
    values: int,
    transient: int,
    kept: int,
) -> Hysteresis:
    return hysteresis(map_, over, np.linspace(low, to, values), place, transient=transient, kept=kept)


def _doublings(map_: ReturnMap, place: Place, period: int, over: str, to: float, most: int) -> Cascade:
    return period_doublings(map_, _periodic(map_, place, period), over, to, most)


def _basins(
    map_: ReturnMap,
    place: Place,
    across: int,
    up: int,
    x0: float,
    x1: float,
    y0: float,
    y1: float,
    duration: float,
) -> Basins:
    return basins(map_, (across, up), ((x0, y0), (x1, y1)), duration)


# ---- numbers ----------------------------------------------------------------------------------------------------


def _decided(read: Callable[[Regime], float]) -> Callable[[Regime], float]:
    def number(found: Regime) -> float:
        if found.kind in _UNDECIDED:
            raise NoValue(
                f"The motion is {found.kind.words}: MEGNO is {found.megno:.3g} after t = {found.t:.4g}. Choose a "
                "longer time, or skip more crossings."
            )
        return read(found)

    return number


def _first(found: Cascade) -> float:
    if not len(found.values):
        raise NoValue("No period doubles on this range: choose a longer one.")
    return float(found.values[0])


def _away(one: Any, exact: Any) -> float:
    """Return the largest distance of the points of a periodic orbit or a branch from those of a more exact one."""
    return largest_difference(one.places, exact.places)


_OF_MOTION: Mapping[str, Number] = {
    "kind": Number(
        "regime",
        "kind of the motion",
        _decided(lambda r: r.kind),
        named={int(one): one.words for one in MotionKind if one not in _UNDECIDED},
    ),
    "period": Number("N", "period, 0 where none is seen", _decided(lambda r: r.period)),
    "volume": Number(
        "±",
        "change of phase volume about the motion",
        _decided(lambda r: r.volume),
        named={0: "kept", -1: "shrinks", 1: "grows"},
    ),
    "megno": Number("Ȳ", "MEGNO", "megno"),
}


def computations(of: Motions) -> Iterator[Computation]:
    """Yield the computations of the section of a system."""
    assert of.section is not None
    entry = partial(declare, of, returning(of))
    over, low, to = _followed(of)
    example = of.section({one.name: one.default for one in of.parameters})
    returns = whole("period", "N", of.period, 0, MAX_PERIOD, "Number of returns; 0: detected, up to 12.")
    yield entry(
        "periodic-orbit",
        "Periodic orbit",
        periodic_orbit,
        _periodic,
        (returns,),
        {
            "time": Number("T", "period in time", "time", "time", "time_error"),
            "multiplier": Number(
                "|μ|",
                "largest size of a multiplier",
                lambda r: np.abs(r.multipliers).max(),
                error_reader="multiplier_error",
            ),
            "period": Number("N", "number of returns", "period"),
        },
        Kind.ORBIT,
        _away,
    )
    yield entry(
        "branch",
        "Branch of periodic orbits over a parameter",
        continued_orbit,
        _branch,
        (returns, to, whole("points", "n", 200, 2, 2000, "Largest number of points of the branch.")),
        {
            "bifurcations": Number("n", "number of bifurcations", lambda r: len(r.bifurcations)),
            "end": Number("λ", "value of the parameter at the end", lambda r: r.values[-1]),
        },
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.places[-1], exact.places[-1]),
        choices=(over,),
        example={"points": 5.0},
    )
    yield entry(
        "period-doublings",
        "Period doublings over a parameter",
        period_doublings,
        _doublings,
        (returns, to, whole("most", "n", 3, 1, 6, "Largest number of doublings.")),
        {
            "count": Number("n", "number of doublings", lambda r: len(r.values)),
            "first": Number("λ₁", "value of the parameter at the first doubling", _first),
        },
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.values, exact.values),
        choices=(over,),
        example={"most": 1.0},
    )
    yield entry(
        "orbit-diagram",
        "Orbit diagram over a parameter",
        orbit_diagram,
        _diagram,
        (
            low,
            to,
            _VALUES,
            usual(_TRANSIENT, 200.0),
            _SHOWN,
            whole("follow", "f", 1, 0, 1, "1: each value starts where the one before ends; 0: at the place."),
            _BACKWARD,
        ),
        {"period": Number("N", "period at the last value, 0 if none is seen", lambda r: r.periods[-1])},
        Kind.SECTION,
        lambda r, exact: largest_difference(r.periods, exact.periods),
        choices=(over,),
        example={"values": 3.0, "transient": 30.0, "kept": 8.0},
    )
    yield entry(
        "hysteresis",
        "Orbit diagram there and back",
        hysteresis,
        _hysteresis,
        (low, to, _VALUES, usual(_TRANSIENT, 200.0), usual(_KEPT, 64.0, "Crossings shown at each value, 16 or more.")),
        {"intervals": Number("n", "number of intervals over which the ways differ", lambda r: len(r.intervals))},
        Kind.SECTION,
        lambda r, exact: float(r.intervals != exact.intervals),
        choices=(over,),
        example={"values": 3.0, "transient": 30.0, "kept": 16.0},
    )
    yield entry(
        "regime",
        "Kind of the motion",
        regime,
        regime,
        _MEASURED,
        _OF_MOTION,
        Kind.INDICATOR,
        lambda r, exact: float(r.kind is not exact.kind),
        example={"transient": 50.0, "duration": 50.0},
    )
    yield entry(
        "dynamics",
        "Limit sets forward and backward in time",
        dynamics_of,
        dynamics_of,
        _MEASURED,
        {
            "distance": Number("d", "distance of attractor and repeller", "distance", error_reader="distance_error"),
            "shared": Number("s", "fraction of the places that both share", "shared"),
        },
        Kind.INDICATOR,
        lambda r, exact: abs(r.distance - exact.distance),
        example={"transient": 60.0, "kept": 64.0, "duration": 50.0},
    )
    if len(example.names) != 2:
        return
    (x0, x1), (y0, y1) = example.window
    yield entry(
        "section",
        "Poincaré section",
        section_orbits,
        _section,
        (
            whole("orbits", "n", 0, 0, 1000, "Orbits spread evenly over the section; 0: the one from the place."),
            whole("crossings", "N", 200, 1, 10_000, "Crossings of each orbit."),
        ),
        {"points": Number("n", "number of points", lambda r: sum(map(len, r.orbits)))},
        Kind.SECTION,
        _points_away,
        example={"crossings": 20.0},
    )
    yield entry(
        "manifold",
        "Stable or unstable manifold of a saddle",
        manifold,
        _manifold,
        (
            returns,
            _REACH,
            whole("stable", "W", 0, 0, 1, "1: the stable manifold, 0: the unstable one."),
            whole("side", "±", 1, -1, 1, "1: along the direction of the saddle, −1: against it."),
        ),
        {"length": Number("s", "length of the branch", "length", error_reader="error_estimate")},
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.points[-1], exact.points[-1]),
        example={"length": 0.1},
    )
    yield entry(
        "basins",
        "Basins of attraction",
        basins,
        _basins,
        (
            whole("across", "m", 40, 1, 1000, "Number of cells across."),
            whole("up", "n", 30, 1, 1000, "Number of cells up."),
            *(
                Parameter(name, name, f"Window, {name}", value, (low, high), 0.01, (-1e6, 1e6), "Side of the window.")
                for name, value, (low, high) in (
                    ("x0", x0, (x0, x1)),
                    ("x1", x1, (x0, x1)),
                    ("y0", y0, (y0, y1)),
                    ("y1", y1, (y0, y1)),
                )
            ),
            usual(known.SPAN, 1000.0, "Time over which the divergence is averaged."),
        ),
        {"attractors": Number("N", "number of attractors", "attractors")},
        Kind.BASINS,
        lambda r, exact: float(np.mean(r.attractor != exact.attractor)) if _same(r, exact) else math.nan,
        unit="fraction of the cells",
        example={"across": 2.0, "up": 2.0, "duration": 200.0},
    )


def _same(one: Basins, other: Basins) -> bool:
    return one.attractor.shape == other.attractor.shape


def _points_away(one: PlanePoints, exact: PlanePoints) -> float:
    """Return the largest distance of the first twenty points of each orbit; later ones of chaotic orbits differ."""
    pairs = zip(one.orbits, exact.orbits, strict=False)
    return max((largest_difference(a[:20], b[:20]) for a, b in pairs), default=math.nan)
