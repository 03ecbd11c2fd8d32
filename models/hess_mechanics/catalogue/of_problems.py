"""Computations that belong to one problem."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import Computation, NoValue, Number, Scalar, VectorizedResult, real
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.chaplygin_ball.phase_cloud_density import density, history
from hess_mechanics.computations import cloud
from hess_mechanics.dynamics.motions import integer, with_default
from hess_mechanics.errors import OutsideRegion, Separatrix
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.arguments import unit_vector
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.kharlamova import PlaneBody, arc
from hess_mechanics.suslov.scattering import cos_chi, scattering
from hess_mechanics.suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from hess_mechanics.suslov_hess.mode_locking import critical_a
from hess_mechanics.suslov_hess.rotation_number import values_at

__all__ = ["COMPUTATIONS"]

# ---- Suslov–Hess: tori (a, h, f) --------------------------------------------------------------------------------

_ANGLES = np.linspace(-math.pi, math.pi, 64, endpoint=False)
_TORUS = (known.A_HESS, known.H_PLANE, known.F_HESS)


def _circle_map(accuracy: Level, a: float, h: float, f: float, phi: float) -> Scalar:
    theta = circle_map(a, h, f, accuracy)
    return Scalar(float(theta.theta([phi])[0]), theta.error_estimate, theta)


def _tori(accuracy: Level, a: Array, h: Array, f: Array, phi: Array) -> VectorizedResult:
    tori = values_at(a, h, f, accuracy)
    # (h, f) = (1, 0) is the separatrix; all other impossible tori lie outside the region.
    separatrix = ~tori.possible & (np.hypot(h - 1.0, f) < 1e-6)
    numbers = {"rotation-number": tori.rho, "trace": tori.trace, "locked": tori.locked.astype(float)}
    return (
        {name: np.where(tori.possible, values, np.nan) for name, values in numbers.items()},
        {Separatrix: separatrix, OutsideRegion: ~tori.possible & ~separatrix},
    )


def _cycle(theta: CircleMap, number: int) -> FixedPoint:
    if len(theta.fixed_points) != 2:
        raise NoValue(
            f"The circle map is {theta.kind}: the torus has no pair of limit cycles. Choose a torus with |trace| > 2."
        )
    return theta.fixed_points[number]


# ---- free Suslov problem, free Chaplygin ball -----------------------------------------------------------------------


def _usual(of: Iterable[Parameter], *defaults: float) -> tuple[Parameter, ...]:
    return tuple(map(with_default, of, defaults))


_TENSOR = _usual(known.TENSOR, 2.0, 1.0, 0.3, 0.5)
_CIRCLE = (with_default(known.THETA, 1.0), with_default(known.CIRCLE_PHASE, 0.0))
_INNER = with_default(known.D, 1.0)


# Cache the result, because many cells of a sweep over angles share a body.
_cached_scattering = lru_cache(maxsize=256)(scattering)


def _scattering(accuracy: Level, theta: float, phi: float, arc: int, distance: float, **tensor: float) -> Scalar:
    result = _cached_scattering(SuslovBody(**tensor), accuracy, arc, distance or None)
    return Scalar(float(result.theta_plus(theta, phi)), result.error_estimate, result)


# ---- clouds of phase points -----------------------------------------------------------------------------------------

_CLOUD = (
    *_TENSOR,
    with_default(known.D, 0.0),
    with_default(known.H_FREE_BALL, 2.0),
    real("spread", "δ", 0.1, 1e-9, 0.999, "E = h(1 ± δ), or the radius of the patch."),
    integer(
        "patch", "p", 0, 0, 1, "1: start from a patch about the ω at the angle, with γ = e3; 0: from the whole shell."
    ),
    with_default(known.CIRCLE_PHASE, 0.5, "Angle of ω at the patch, in radians."),
    integer("count", "n", 1000, 1, 20_000, "Number of points."),
    with_default(known.TIME, 10.0),
)
_SMALL = {"count": 50.0, "duration": 2.0}


def _cloud(
    accuracy: Level, D: float, h: float, spread: float, patch: int, phi: float, count: int, duration: float, **I: float
) -> Cloud:
    angle = phi if patch else None
    return cloud(BallBody(**I, D=D), h, duration, count=count, spread=spread, angle=angle, accuracy=accuracy)


# ---- periods --------------------------------------------------------------------------------------------------------

_PLANE_BODY = _usual((*known.TENSOR[:2], *known.FIELD[:2]), 1.3, 0.8, 0.5, -0.2)
_PLANE_START = _usual((*known.OMEGA, *known.GAMMA), 1.0, -0.5, 0.0, 0.6, 0.8)


def _state(w1: float, w2: float, g1: float, g2: float, g3: float) -> tuple[float, ...]:
    gamma, _ = unit_vector((g1, g2, g3))
    return w1, w2, *gamma


def _plane_period(accuracy: Level, I11: float, I22: float, b1: float, b2: float, **start: float) -> float:
    result = arc(PlaneBody(I11, I22, b1, b2), _state(**start))
    if result.kind != "periodic":
        raise NoValue(
            "This motion rests at a fixed point on the equator, or tends to one, and has no period: choose another "
            "start."
        )
    return result.period


COMPUTATIONS: tuple[Computation, ...] = (
    Computation(
        "circle-map",
        "Circle map Θ(φ) of a Suslov–Hess torus",
        circle_map,
        (*_TORUS, with_default(known.CIRCLE_PHASE, 0.5, "Angle φ whose image is computed, in radians.")),
        {
            "rotation-number": Number("ρ", "rotation number", "of.rotation_number", "turns per return", turn=1.0),
            "trace": Number("|t|", "|trace| of the map as a matrix of SU(1,1)", "of.trace"),
            "locked": Number(
                "locked",
                "mode locking",
                lambda r: len(r.of.fixed_points) == 2,
                categories={0: "no limit cycle", 1: "two limit cycles"},
            ),
            "period": Number("T", "time of a return", "of.period", "time"),
            "image": Number("Θ", "angle Θ(φ) after a return", unit="rad", error_reader="error"),
            "stable": Number("φ*", "angle of the stable limit cycle", lambda r: _cycle(r.of, 0).phi, "rad"),
            "unstable": Number("φ*", "angle of the unstable limit cycle", lambda r: _cycle(r.of, 1).phi, "rad"),
            "log-multiplier": Number(
                "ln μ", "logarithm of the stable cycle's multiplier", lambda r: _cycle(r.of, 0).log_multiplier
            ),
        },
        Kind.MAP,
        # Compare angles up to full turns.
        lambda r, exact: np.abs(np.angle(np.exp(1j * (r.of.theta(_ANGLES) - exact.of.theta(_ANGLES))))).max(),
        _circle_map,
        unit="rad",
        example={"a": 0.5, "h": 1.5, "f": 0.6},
        source="eq0003",
        vectorized=_tori,
    ),
    Computation(
        "critical-a",
        "Birth of the limit cycles of a Suslov–Hess torus",
        critical_a,
        _TORUS[1:],
        {"critical-a": Number("a*", "a at which the limit cycles appear, |trace| = 2")},
        Kind.ORBIT,
        example={"h": 1.5, "f": 0.3},
    ),
    Computation(
        "scattering",
        "Scattering of the free Suslov problem",
        scattering,
        (
            *_TENSOR,
            *_CIRCLE,
            integer("arc", "σ", 1, -1, 1, "Sign of I13ω1 + I23ω2 along the motion, 1 or −1."),
            real(
                "distance",
                "δ",
                0.0,
                0.0,
                1.0,
                "Phases are taken where ω across ξ is this fraction of |ω⁻|; 0: phases for t → −∞.",
            ),
        ),
        {
            "theta-plus": Number("θ⁺", "angle of the circle that a motion joins", unit="rad", error_reader="error"),
            "cos-chi": Number("cos χ", "cosine of the angle of scattering, computed", "of.cos_chi"),
        },
        Kind.MAP,
        call=_scattering,
        unit="rad",
        source="fig0111",
    ),
    Computation(
        "cos-chi",
        "Angle of scattering of the free Suslov problem, in closed form",
        cos_chi,
        _TENSOR,
        {"cos-chi": Number("cos χ", "cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*)")},
        Kind.MAP,
        call=lambda accuracy, **tensor: cos_chi(SuslovBody(**tensor)),
    ),
    Computation(
        "ball-scattering",
        "Scattering of the Chaplygin ball",
        ball_scattering,
        (*_TENSOR, _INNER, *_CIRCLE, real("distance", "δ", 1e-3, -0.1, 0.1, "Distance of the start from N^u.")),
        {
            "theta-plus": Number(
                "θ⁺",
                "angle of the circle that a motion joins",
                lambda r: r.theta_plus[0],
                "rad",
                lambda r: r.errors[0],
            )
        },
        Kind.MAP,
        call=lambda accuracy, theta, phi, distance, **body: ball_scattering(
            BallBody(**body), theta, [phi], 1.0, distance, accuracy
        ),
        unit="rad",
    ),
    Computation(
        "period",
        "Period with b₃ = 0 on a principal axis, in closed form",
        arc,
        (*_PLANE_BODY, *_PLANE_START),
        {"period": Number("T", "period, by arithmetic-geometric means (Kharlamova's case)", unit="time")},
        Kind.ORBIT,
        call=_plane_period,
        unit="time",
    ),
    Computation(
        "ball-period",
        "Period of the Chaplygin ball with b₃ = 0",
        period,
        (*_PLANE_BODY, _INNER, *_PLANE_START),
        {
            "period": Number(
                "T",
                "twice the time between the first two crossings of γ₃ = 0",
                unit="time",
                error_reader="error_estimate",
            )
        },
        Kind.ORBIT,
        call=lambda accuracy, I11, I22, b1, b2, D, **start: period(
            BallBody(I11, I22, 0.0, 0.0, D, b1, b2, 0.0), _state(**start), accuracy
        ),
        unit="time",
    ),
    Computation(
        "cloud",
        "Cloud of phase points without a field",
        cloud,
        _CLOUD,
        {"volume": Number("V", "volume relative to that at t = 0", lambda r: r.volume[-1])},
        Kind.CLOUD,
        "log_s",
        _cloud,
        example=_SMALL,
    ),
    Computation(
        "cloud-history",
        "Volume and growth of a cloud of phase points over time",
        history,
        _CLOUD,
        {"growth": Number("ln s/s₀", "mean growth of small volumes", lambda r: r.log_growth[0, -1])},
        Kind.CLOUD,
        "log_growth",
        lambda **values: history(_cloud(**values)),
        example=_SMALL,
    ),
    Computation(
        "cloud-density",
        "Density of a cloud of phase points over ln|s|",
        density,
        _CLOUD,
        {"height": Number("h", "mean density in the bins that all points pass", "height")},
        Kind.CLOUD,
        call=lambda **values: density(_cloud(**values)),
        example=_SMALL,
    ),
)
