"""Computations of every system with a section, each declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import Choice, Computation, NoValue, Number, largest_difference, real
from hess_mechanics.dynamics.manifolds import manifold
from hess_mechanics.dynamics.motions import integer, with_default
from hess_mechanics.dynamics.orbit_diagram import Cascade
from hess_mechanics.dynamics.periodic import MAX_PERIOD, PeriodicOrbit
from hess_mechanics.dynamics.regime import MotionKind, Regime, dynamics_of, regime
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.return_maps import (
    PlanePoints,
    basins,
    continued_orbit,
    orbit_diagram,
    period_doublings,
    periodic_orbit,
    section_orbits,
)

__all__ = ["computations"]

Point = tuple[float, ...]

_UNDECIDED = (MotionKind.UNDECIDED, MotionKind.SETTLING)
_TRANSIENT = integer("transient", "N₀", 300, 0, 20_000, "Number of crossings to skip.")
_CROSSINGS = integer("crossings", "N", 200, 8, 20_000, "Number of crossings to analyse.")
_REGIME_PARAMETERS = (
    _TRANSIENT,
    _CROSSINGS,
    with_default(known.SPAN, 200.0, "Averaging time of MEGNO and of the mean divergence."),
)


# ---- functions of a point of a section ------------------------------------------------------------------------------


def _periodic(map_: ReturnMap, point: Point, period: int) -> PeriodicOrbit:
    return periodic_orbit(map_, point, period or None)


def _from_orbit(function: Callable[..., Any]) -> Callable[..., Any]:
    """Convert a function of a map and a periodic orbit to a function of a map and a point."""
    return lambda map_, point, period, **more: function(map_, _periodic(map_, point, period), **more)


def _along(function: Callable[..., Any]) -> Callable[..., Any]:
    """Convert a function over any values of a parameter to a function over evenly spaced values."""
    return lambda map_, point, parameter, low, to, values, **more: function(
        map_, parameter, np.linspace(low, to, values), point, **more
    )


# ---- numbers ----------------------------------------------------------------------------------------------------


def _reader_of(name: str) -> Callable[[Regime], float]:
    def number(motion: Regime) -> float:
        if motion.kind in _UNDECIDED:
            raise NoValue(
                f"The motion is {motion.kind.words}: MEGNO is {motion.megno:.3g} after t = {motion.duration:.4g}. "
                "Choose a longer time, or skip more crossings."
            )
        return float(getattr(motion, name))

    return number


def _first(cascade: Cascade) -> float:
    if not len(cascade.values):
        raise NoValue("No period doubling was found in this range: choose a larger range.")
    return float(cascade.values[0])


_OF_MOTION: Mapping[str, Number] = {
    "kind": Number(
        "regime",
        "kind of the motion",
        _reader_of("kind"),
        categories={int(one): one.words for one in MotionKind if one not in _UNDECIDED},
    ),
    "period": Number("N", "period, 0 where none is seen", _reader_of("period")),
    "volume": Number(
        "±",
        "change of phase volume about the motion",
        _reader_of("volume"),
        categories={0: "constant", -1: "shrinks", 1: "grows"},
    ),
    "megno": Number("Ȳ", "MEGNO", "megno"),
}


def computations(example: PoincareSection, period: int) -> Iterator[Computation]:
    """Yield the computations of a kind of section; those of a plane only if the section has two coordinates.

    Parameters
    ----------
    example : PoincareSection
        One of these sections, which gives the default values of its constants.
    period : int
        Number of returns of the periodic orbit in the examples; 0 to detect it.

    Yields
    ------
    Computation
        A computation, still without the parameters of the section and its point, see `declared.declare`.
    """
    constants = example.constants
    # The default lies a little above the energy.
    name = next((one for one in ("E", "h") if one in constants), [*constants][-1])
    over = (Choice("parameter", "Parameter to vary.", (*constants,), name),)
    value = constants[name]
    to = real("to", "to", value + 0.1 * max(1.0, abs(value)), -1e6, 1e6, "Last value of the parameter.")
    ends = real("low", "from", value, -1e6, 1e6, "First value of the parameter."), to
    values = integer("values", "n", 50, 2, 20_000, "Number of values of the parameter.")
    transient = with_default(_TRANSIENT, 200.0)
    returns = integer("period", "N", period, 0, MAX_PERIOD, "Number of returns; 0: detected automatically, up to 12.")
    yield Computation(
        "periodic-orbit",
        "Periodic orbit",
        periodic_orbit,
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
        "points",
        _periodic,
    )
    yield Computation(
        "branch",
        "Branch of periodic orbits over a parameter",
        continued_orbit,
        (returns, to, integer("points", "n", 200, 2, 2000, "Largest number of points of the branch.")),
        {
            "bifurcations": Number("n", "number of bifurcations", lambda r: len(r.bifurcations)),
            "end": Number("λ", "value of the parameter at the end", lambda r: r.values[-1]),
        },
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.points[-1], exact.points[-1]),
        _from_orbit(continued_orbit),
        choices=over,
        example={"points": 5.0},
    )
    yield Computation(
        "period-doublings",
        "Period doublings over a parameter",
        period_doublings,
        (returns, to, integer("most", "n", 3, 1, 6, "Largest number of doublings.")),
        {
            "count": Number("n", "number of doublings", lambda r: len(r.values)),
            "first": Number("λ₁", "value of the parameter at the first doubling", _first),
        },
        Kind.ORBIT,
        "values",
        _from_orbit(period_doublings),
        choices=over,
        example={"most": 1.0},
    )
    yield Computation(
        "orbit-diagram",
        "Orbit diagram over a parameter",
        orbit_diagram,
        (
            *ends,
            values,
            transient,
            integer("crossings", "N", 64, 1, 20_000, "Crossings shown at each value."),
            integer(
                "follow", "f", 1, 0, 1, "1: each value starts where the previous one ends; 0: at the chosen point."
            ),
            integer("backward", "−t", 0, 0, 1, "1: backward in time, to repellers."),
        ),
        {"period": Number("N", "period at the last value, 0 if none is seen", lambda r: r.periods[-1])},
        Kind.SECTION,
        "periods",
        lambda map_, point, backward, **more: _along(orbit_diagram)(
            map_.inverse() if backward else map_, point, **more
        ),
        choices=over,
        example={"values": 3.0, "transient": 30.0, "crossings": 8.0},
    )
    yield Computation(
        "regime",
        "Kind of the motion",
        regime,
        _REGIME_PARAMETERS,
        _OF_MOTION,
        Kind.INDICATOR,
        lambda r, exact: float(r.kind is not exact.kind),
        example={"transient": 50.0, "duration": 50.0},
    )
    yield Computation(
        "dynamics",
        "Limit sets forward and backward in time",
        dynamics_of,
        _REGIME_PARAMETERS,
        {
            "distance": Number(
                "d", "distance between attractor and repeller", "distance", error_reader="distance_error"
            ),
            "shared": Number("s", "fraction of the points common to both sets", "overlap"),
        },
        Kind.INDICATOR,
        example={"transient": 60.0, "crossings": 64.0, "duration": 50.0},
    )
    if len(example.names) != 2:
        return
    (x0, x1), (y0, y1) = example.window
    yield Computation(
        "section",
        "Poincaré section",
        section_orbits,
        (
            integer("orbits", "n", 0, 0, 1000, "Orbits spread evenly over the section; 0: the one from the point."),
            integer("crossings", "N", 200, 1, 10_000, "Crossings of each orbit."),
        ),
        {"points": Number("n", "number of points", lambda r: sum(map(len, r.orbits)))},
        Kind.SECTION,
        _points_away,
        lambda map_, point, orbits, crossings: section_orbits(
            map_, starts=() if orbits else (point,), orbits=orbits or 1, crossings=crossings
        ),
        example={"crossings": 20.0},
    )
    yield Computation(
        "manifold",
        "Stable or unstable manifold of a saddle",
        manifold,
        (
            returns,
            real("length", "s", 1.0, 1e-3, 1e3, "Length at which the branch ends."),
            integer("stable", "W", 0, 0, 1, "1: the stable manifold, 0: the unstable one."),
            integer("side", "±", 1, -1, 1, "1: along the direction of the saddle, −1: against it."),
        ),
        {"length": Number("s", "length of the branch", "length", error_reader="error_estimate")},
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.points[-1], exact.points[-1]),
        _from_orbit(manifold),
        example={"length": 0.1},
    )
    yield Computation(
        "basins",
        "Basins of attraction",
        basins,
        (
            integer("across", "m", 40, 1, 1000, "Number of cells across."),
            integer("up", "n", 30, 1, 1000, "Number of cells up."),
            *(
                real(name, name, value, -1e6, 1e6, "Edge of the window.")
                for name, value in (("x0", x0), ("x1", x1), ("y0", y0), ("y1", y1))
            ),
            with_default(known.SPAN, 1000.0, "Time over which the divergence is averaged."),
        ),
        {"attractors": Number("N", "number of attractors", "attractors")},
        Kind.BASINS,
        lambda r, exact: float(np.mean(r.attractor != exact.attractor)),
        lambda map_, point, across, up, x0, x1, y0, y1, duration: basins(
            map_, (across, up), ((x0, y0), (x1, y1)), duration
        ),
        unit="fraction of the cells",
        example={"across": 2.0, "up": 2.0, "duration": 200.0},
    )


def _points_away(one: PlanePoints, exact: PlanePoints) -> float:
    """Return the largest difference over the first twenty points of each orbit; chaos separates later points."""
    pairs = zip(one.orbits, exact.orbits, strict=False)
    return max((largest_difference(a[:20], b[:20]) for a, b in pairs), default=np.nan)
