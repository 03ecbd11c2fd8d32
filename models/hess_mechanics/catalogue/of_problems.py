"""Computations that belong to one problem."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import (
    Computation,
    Many,
    NoValue,
    Number,
    Numbers,
    largest_difference,
    number_of,
)
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.chaplygin_ball.phase_cloud_density import CloudHistory, Density, course, density
from hess_mechanics.computations import cloud
from hess_mechanics.dynamics.motions import usual, whole
from hess_mechanics.errors import OutsideRegion, Separatrix
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.arguments import unit_vector
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.kharlamova import PlaneBody, arc
from hess_mechanics.suslov.scattering import Scattering, cos_chi, scattering
from hess_mechanics.suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from hess_mechanics.suslov_hess.mode_locking import critical_a
from hess_mechanics.suslov_hess.rotation_number import values_at

__all__ = ["COMPUTATIONS"]

# ---- Suslov–Hess: tori (a, h, f) --------------------------------------------------------------------------------

_ANGLES = np.linspace(-math.pi, math.pi, 64, endpoint=False)
_TORUS = (known.A_HESS, known.H_PLANE, known.F_HESS)


def _circle_map(accuracy: Level, a: float, h: float, f: float, phi: float) -> Numbers:
    found = circle_map(a, h, f, accuracy)
    return Numbers({"image": float(found.theta([phi])[0])}, {"image": found.error_estimate}, found)


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


def _critical_a(accuracy: Level, h: float, f: float) -> Numbers:
    return Numbers({"a": critical_a(h, f, accuracy)})


# ---- free Suslov problem, free Chaplygin ball -----------------------------------------------------------------------

_TENSOR = tuple(usual(one, value) for one, value in zip(known.TENSOR, (2.0, 1.0, 0.3, 0.5), strict=True))
_CIRCLE = (usual(known.THETA, 1.0), usual(known.CIRCLE_PHASE, 0.0))
_ARC = whole("arc", "σ", 1, -1, 1, "Sign of I13ω1 + I23ω2 along the motion, 1 or −1.")
_START = Parameter(
    "distance",
    "δ",
    "Distance of the start",
    0.0,
    (0.0, 0.5),
    0.01,
    (0.0, 1.0),
    "Phases belong to the place where ω across ξ is this fraction of |ω⁻|; 0: phases for t → −∞.",
)
_DISTANCE = Parameter(
    "distance", "δ", "Distance of the start", 1e-3, (-0.1, 0.1), 1e-3, (-0.1, 0.1), "Distance of the start from N^u."
)
_INNER = usual(known.D, 1.0)


# Many cells of a sweep over angles share a body.
@lru_cache(maxsize=256)
def _scattered(body: SuslovBody, accuracy: Level, arc: int, distance: float) -> Scattering:
    return scattering(body, accuracy, arc, distance or None)


def _scattering(accuracy: Level, theta: float, phi: float, arc: int, distance: float, **tensor: float) -> Numbers:
    found = _scattered(SuslovBody(**tensor), accuracy, arc, distance)
    return Numbers(
        {"theta-plus": float(found.theta_plus(theta, phi)), "sin-chi": found.sin_chi},
        {"theta-plus": found.error_estimate},
        found,
    )


def _cos_chi(accuracy: Level, **tensor: float) -> Numbers:
    return Numbers({"cos-chi": cos_chi(SuslovBody(**tensor))})


def _ball_scattering(accuracy: Level, theta: float, phi: float, distance: float, **body: float) -> Numbers:
    found = ball_scattering(BallBody(**body), theta, [phi], 1.0, distance, accuracy)
    return Numbers({"theta-plus": float(found.theta_plus[0])}, {"theta-plus": float(found.errors[0])}, found)


# ---- clouds of phase points -----------------------------------------------------------------------------------------

_CLOUD = (
    *_TENSOR,
    usual(known.D, 0.0),
    usual(known.H_FREE_BALL, 2.0),
    Parameter(
        "spread", "δ", "Spread", 0.1, (0.01, 0.9), 0.01, (1e-9, 1.0), "E = h(1 ± δ), or the radius of the patch."
    ),
    whole(
        "patch", "p", 0, 0, 1, "1: start from a patch about the ω at the angle, with γ = e3; 0: from the whole shell."
    ),
    usual(known.CIRCLE_PHASE, 0.5, "Angle of ω at the patch, in radians."),
    whole("count", "n", 1000, 1, 20_000, "Number of points."),
    usual(known.TIME, 10.0),
)


def _cloud(
    accuracy: Level, D: float, h: float, spread: float, patch: int, phi: float, count: int, duration: float, **I: float
) -> Cloud:
    angle = phi if patch else None
    return cloud(BallBody(**I, D=D), h, duration, count=count, spread=spread, angle=angle, accuracy=accuracy)


def _history(accuracy: Level, **values: Any) -> CloudHistory:
    return course(_cloud(accuracy, **values))


def _density(accuracy: Level, **values: Any) -> Density:
    return density(_cloud(accuracy, **values))


# ---- periods --------------------------------------------------------------------------------------------------------

_PLANE_BODY = tuple(
    usual(one, value) for one, value in zip((*known.TENSOR[:2], *known.FIELD[:2]), (1.3, 0.8, 0.5, -0.2), strict=True)
)
_PLANE_START = tuple(
    usual(one, value) for one, value in zip((*known.OMEGA, *known.GAMMA), (1.0, -0.5, 0.0, 0.6, 0.8), strict=True)
)


def _state(w1: float, w2: float, g1: float, g2: float, g3: float) -> tuple[float, ...]:
    gamma, _ = unit_vector((g1, g2, g3))
    return w1, w2, *gamma


def _plane_period(accuracy: Level, I11: float, I22: float, b1: float, b2: float, **start: float) -> Numbers:
    found = arc(PlaneBody(I11, I22, b1, b2), _state(**start))
    if found.kind != "periodic":
        raise NoValue(
            "This motion rests on the equator and has no period: choose another start."
            if found.kind == "fixed"
            else "This motion tends to a fixed point on the equator and has no period: choose another start."
        )
    return Numbers({"period": found.period})


def _ball_period(accuracy: Level, I11: float, I22: float, b1: float, b2: float, D: float, **start: float) -> Numbers:
    found = period(BallBody(I11, I22, 0.0, 0.0, D, b1, b2, 0.0), _state(**start), accuracy)
    return Numbers({"period": found.value}, {"period": found.error_estimate}, found)


def _apart(name: str) -> Callable[[Numbers, Numbers], float]:
    """Return the distance of a number from that of a more exact result."""
    return lambda one, exact: abs(one.values[name] - exact.values[name])


COMPUTATIONS: tuple[Computation, ...] = (
    Computation(
        "circle-map",
        "Circle map Θ(φ) of a Suslov–Hess torus",
        circle_map,
        _circle_map,
        (*_TORUS, usual(known.CIRCLE_PHASE, 0.5, "Angle φ whose image is computed, in radians.")),
        {
            "rotation-number": Number("ρ", "rotation number", "of.rotation_number", "turns per return", turn=1.0),
            "trace": Number("|t|", "|trace| of the map as a matrix of SU(1,1)", "of.trace"),
            "locked": Number(
                "locked",
                "mode locking",
                lambda r: len(r.of.fixed_points) == 2,
                named={0: "no limit cycle", 1: "two limit cycles"},
            ),
            "period": Number("T", "time of a return", "of.period", "time"),
            "image": number_of("image", "Θ", "angle Θ(φ) after a return", "rad", error=True),
            "stable": Number("φ*", "angle of the stable limit cycle", lambda r: _cycle(r.of, 0).phi, "rad"),
            "unstable": Number("φ*", "angle of the unstable limit cycle", lambda r: _cycle(r.of, 1).phi, "rad"),
            "log-multiplier": Number(
                "ln μ", "logarithm of the stable cycle's multiplier", lambda r: _cycle(r.of, 0).log_multiplier
            ),
        },
        Kind.MAP,
        lambda r, exact: largest_difference(r.of.theta(_ANGLES), exact.of.theta(_ANGLES), 2.0 * math.pi),
        unit="rad",
        example={"a": 0.5, "h": 1.5, "f": 0.6},
        source="eq0003",
        many=_tori,
    ),
    Computation(
        "critical-a",
        "Birth of the limit cycles of a Suslov–Hess torus",
        critical_a,
        _critical_a,
        _TORUS[1:],
        {"a": number_of("a", "a*", "a at which the limit cycles appear, |trace| = 2")},
        Kind.ORBIT,
        _apart("a"),
        example={"h": 1.5, "f": 0.3},
    ),
    Computation(
        "scattering",
        "Scattering of the free Suslov problem",
        scattering,
        _scattering,
        (*_TENSOR, *_CIRCLE, _ARC, _START),
        {
            "theta-plus": number_of("theta-plus", "θ⁺", "angle of the circle that a motion joins", "rad", error=True),
            "cos-chi": Number("cos χ", "angle of scattering, computed", "of.cos_chi"),
        },
        Kind.MAP,
        _apart("theta-plus"),
        unit="rad",
        source="fig0111",
    ),
    Computation(
        "cos-chi",
        "Angle of scattering of the free Suslov problem, in closed form",
        cos_chi,
        _cos_chi,
        _TENSOR,
        {"cos-chi": number_of("cos-chi", "cos χ", "cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*)")},
        Kind.MAP,
        _apart("cos-chi"),
    ),
    Computation(
        "ball-scattering",
        "Scattering of the Chaplygin ball",
        ball_scattering,
        _ball_scattering,
        (*_TENSOR, _INNER, *_CIRCLE, _DISTANCE),
        {"theta-plus": number_of("theta-plus", "θ⁺", "angle of the circle that a motion joins", "rad", error=True)},
        Kind.MAP,
        _apart("theta-plus"),
        unit="rad",
    ),
    Computation(
        "period",
        "Period with b₃ = 0 on a principal axis, in closed form",
        arc,
        _plane_period,
        (*_PLANE_BODY, *_PLANE_START),
        {"period": number_of("period", "T", "period, by arithmetic-geometric means (Kharlamova's case)", "time")},
        Kind.ORBIT,
        _apart("period"),
        unit="time",
    ),
    Computation(
        "ball-period",
        "Period of the Chaplygin ball with b₃ = 0",
        period,
        _ball_period,
        (*_PLANE_BODY, _INNER, *_PLANE_START),
        {
            "period": number_of(
                "period", "T", "twice the time between the first two crossings of γ₃ = 0", "time", error=True
            )
        },
        Kind.ORBIT,
        _apart("period"),
        unit="time",
    ),
    Computation(
        "cloud",
        "Cloud of phase points without a field",
        cloud,
        _cloud,
        _CLOUD,
        {"volume": Number("V", "volume relative to that at t = 0", lambda r: r.volume[-1])},
        Kind.CLOUD,
        lambda r, exact: largest_difference(r.log_s, exact.log_s),
        example={"count": 50.0, "duration": 2.0},
    ),
    Computation(
        "cloud-history",
        "Volume and growth of a cloud of phase points over time",
        course,
        _history,
        _CLOUD,
        {"growth": Number("ln s/s₀", "mean growth of small volumes", lambda r: r.log_growth[0, -1])},
        Kind.CLOUD,
        lambda r, exact: largest_difference(r.log_growth, exact.log_growth),
        example={"count": 50.0, "duration": 2.0},
    ),
    Computation(
        "cloud-density",
        "Density of a cloud of phase points over ln|s|",
        density,
        _density,
        _CLOUD,
        {"height": Number("h", "mean density in the bins that all points pass", "height")},
        Kind.CLOUD,
        lambda r, exact: abs(r.height - exact.height),
        example={"count": 50.0, "duration": 2.0},
    ),
)
