"""Computations that belong to one problem."""

from __future__ import annotations

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import Computation, Many, NoValue, Number, largest_difference
from hess_mechanics.errors import OutsideRegion, Separatrix
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from hess_mechanics.suslov_hess.rotation_number import values_at

__all__ = ["COMPUTATIONS"]

# ---- Suslov–Hess: tori (a, h, f) --------------------------------------------------------------------------------

_TORUS = (known.A_HESS, known.H_PLANE, known.F_HESS)


def _circle_map(accuracy: Level, a: float, h: float, f: float, phi: float) -> CircleMap:
    return circle_map(a, h, f, accuracy)


def _tori(accuracy: Level, a: Array, h: Array, f: Array, phi: Array) -> Many:
    found = values_at(a, h, f, accuracy)
    # (h, f) = (1, 0) is the separatrix; all other impossible tori lie outside of the region.
    separatrix = ~found.possible & (np.hypot(h - 1.0, f) < 1e-6)
    numbers = {"rotation-number": found.rho, "trace": found.trace, "locked": found.locked.astype(float)}
    return Many(
        {name: np.where(found.possible, values, np.nan) for name, values in numbers.items()},
        {Separatrix: separatrix, OutsideRegion: ~found.possible & ~separatrix},
    )


def _cycle(found: CircleMap, number: int) -> FixedPoint:
    if len(found.fixed_points) != 2:
        raise NoValue(f"The circle map is {found.kind}: it has no two limit cycles.")
    return found.fixed_points[number]


COMPUTATIONS: tuple[Computation, ...] = (
    Computation(
        "circle-map",
        "Circle map Θ(φ) of a Suslov–Hess torus",
        circle_map,
        _circle_map,
        (*_TORUS, known.CIRCLE_PHASE),
        {
            "rotation-number": Number(
                "ρ", "rotation number", lambda r: r.rotation_number, "turns per return", turn=1.0
            ),
            "trace": Number("|t|", "|trace| of the map as a matrix of SU(1,1)", lambda r: r.trace),
            "locked": Number(
                "locked",
                "mode locking",
                lambda r: float(len(r.fixed_points) == 2),
                named={0: "no limit cycle", 1: "two limit cycles"},
            ),
            "period": Number("T", "time of a return", lambda r: r.period, "time"),
            "stable": Number("φ*", "angle of the stable limit cycle", lambda r: _cycle(r, 0).phi, "rad"),
            "unstable": Number("φ*", "angle of the unstable limit cycle", lambda r: _cycle(r, 1).phi, "rad"),
            "log-multiplier": Number(
                "ln μ", "logarithm of the stable cycle's multiplier", lambda r: _cycle(r, 0).log_multiplier
            ),
        },
        Kind.MAP,
        lambda r, exact: largest_difference(r.graph[1], exact.graph[1]),
        unit="rad",
        example={"a": 0.5, "h": 1.5, "f": 0.6},
        source="eq0003",
        many=_tori,
    ),
)
