"""The quantities that can be swept, as data.  A new quantity is a new entry with a function that computes it.

`one_by_one` turns a function of one cell into a function of many cells.  Quantities with a vectorized function
(`values_at`) call it directly.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, partial

import numpy as np

from hess_explorer.sweep.errors import NoValue
from hess_explorer.sweep.motions import MOTIONS, SUSLOV_ENERGY, suslov_section
from hess_explorer.sweep.quantity import Cell, CellArrays, CellResults, Outcome, Quantity, one_by_one, usual
from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.chaplygin_ball.scattering import ball_scattering
from hess_mechanics.dynamics.basins import attractors
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import PLANS, Kind, Level
from hess_mechanics.parameters import Parameter
from hess_mechanics.suslov.equations import SuslovBody, unit_vector
from hess_mechanics.suslov.kharlamova import PlaneBody, arc
from hess_mechanics.suslov.scattering import Scattering, cos_chi, scattering
from hess_mechanics.suslov_hess.circle_map import circle_map
from hess_mechanics.suslov_hess.mode_locking import critical_a
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at

__all__ = ["QUANTITIES", "quantity"]

# ---- parameters -------------------------------------------------------------------------------------------------

_GIVEN = ("a", "h", "f")
_TORUS = (known.A_HESS, known.H_PLANE, known.F_HESS)
_TENSOR = tuple(usual(one, value) for one, value in zip(known.TENSOR, (2.0, 1.0, 0.3, 0.5), strict=True))
_D = usual(known.D, 1.0)
_CIRCLE = (usual(known.THETA, 1.0), usual(known.CIRCLE_PHASE, 0.0))
_PLANE_BODY = tuple(
    usual(one, value) for one, value in zip((*known.TENSOR[:2], *known.FIELD[:2]), (1.3, 0.8, 0.5, -0.2), strict=True)
)
_PLANE_START = tuple(
    usual(one, value) for one, value in zip((*known.OMEGA, *known.GAMMA), (1.0, -0.5, 0.0, 0.6, 0.8), strict=True)
)
_DISTANCE = Parameter(
    "distance", "δ", "Distance of the start", 1e-3, (-0.1, 0.1), 1e-3, (-0.1, 0.1), "Distance of the start from N^u."
)

# ---- Suslov–Hess: tori (a, h, f) --------------------------------------------------------------------------------


def _of_tori(value: Callable[[TorusValues], np.ndarray], cells: CellArrays, level: Level) -> CellResults:
    found = values_at(cells["a"], cells["h"], cells["f"], level)
    # (h, f) = (1, 0) is the separatrix; all other impossible tori lie outside of the region.
    separatrix = np.hypot(cells["h"] - 1.0, cells["f"]) < 1e-6
    status = np.where(found.possible, Outcome.OK, np.where(separatrix, Outcome.SEPARATRIX, Outcome.OUTSIDE_REGION))
    return CellResults(
        np.where(found.possible, value(found), np.nan), np.full(status.size, np.nan), status.astype(np.uint8)
    )


def _limit_cycles(level: Level, a: float, h: float, f: float) -> Cell:
    found = circle_map(a, h, f, level)
    if len(found.fixed_points) != 2:
        raise NoValue(f"The circle map is {found.kind}: it has no two limit cycles.")
    stable, unstable = found.fixed_points
    return Cell((stable.phi, unstable.phi, stable.log_multiplier), found.error_estimate, found.status)


def _critical_a(level: Level, h: float, f: float) -> Cell:
    return Cell(critical_a(h, f, level))


# ---- free Suslov problem ----------------------------------------------------------------------------------------


@lru_cache(maxsize=256)
def _scattered(body: SuslovBody, level: Level) -> Scattering:
    """Return the cached scattering of a body; many cells of a sweep over angles share it."""
    return scattering(body, level)


def _theta_plus(level: Level, theta: float, phi: float, **tensor: float) -> Cell:
    found = _scattered(SuslovBody(**tensor), level)
    return Cell(float(found.theta_plus(theta, phi)), found.error_estimate, found.status)


def _cos_chi(level: Level, **tensor: float) -> Cell:
    return Cell(cos_chi(SuslovBody(**tensor)))


# ---- periods ----------------------------------------------------------------------------------------------------


def _start(w1: float, w2: float, g1: float, g2: float, g3: float) -> tuple[float, ...]:
    gamma, _ = unit_vector((g1, g2, g3))
    return w1, w2, *gamma


def _period(level: Level, I11: float, I22: float, b1: float, b2: float, **start: float) -> Cell:
    found = arc(PlaneBody(I11, I22, b1, b2), _start(**start))
    if found.kind != "periodic":
        raise NoValue(
            "This motion rests on the equator and has no period."
            if found.kind == "fixed"
            else "This motion tends to a fixed point on the equator and has no period."
        )
    return Cell(found.period)


def _ball_period(level: Level, I11: float, I22: float, b1: float, b2: float, D: float, **start: float) -> Cell:
    found = period(BallBody(I11, I22, 0.0, 0.0, D, b1, b2, 0.0), _start(**start), level)
    return Cell(found.value, found.error_estimate, found.status)


# ---- Chaplygin ball ---------------------------------------------------------------------------------------------


def _ball_theta_plus(level: Level, theta: float, phi: float, distance: float, **body: float) -> Cell:
    found = ball_scattering(BallBody(**body), theta, [phi], 1.0, distance, level)
    return Cell(float(found.theta_plus[0]), float(found.errors[0]), found.status)


# ---- Suslov problem with gravity --------------------------------------------------------------------------------


def _attractors(level: Level, t: float, **values: float) -> Cell:
    plan = PLANS[Kind.BASINS][level.name]
    return Cell(float(attractors(suslov_section(values), t, plan.level).count))


# ---- the table --------------------------------------------------------------------------------------------------

_TABLE: tuple[Quantity, ...] = (
    Quantity(
        "rotation-number",
        "ρ",
        "Rotation number of Suslov–Hess tori",
        "turns per return",
        "Rotation number of the circle map of the torus (h, f).",
        _TORUS,
        partial(_of_tori, lambda found: found.rho),
        turn=1.0,
        needed=_GIVEN,
    ),
    Quantity(
        "trace",
        "|t|",
        "Trace of the circle map of Suslov–Hess tori",
        "1",
        "|trace| of the circle map as a matrix of SU(1,1): above 2 it has two limit cycles.",
        _TORUS,
        partial(_of_tori, lambda found: found.trace),
        needed=_GIVEN,
    ),
    Quantity(
        "locked",
        "locked",
        "Mode locking of Suslov–Hess tori",
        "1",
        "1 where the circle map has two limit cycles, 0 elsewhere.",
        _TORUS,
        partial(_of_tori, lambda found: found.locked.astype(float)),
        needed=_GIVEN,
        named={"": {0: "no limit cycle", 1: "two limit cycles"}},
    ),
    Quantity(
        "limit-cycles",
        "φ*",
        "Limit cycles of Suslov–Hess tori",
        "rad, the last 1",
        "Angles of the stable and of the unstable limit cycle, and the logarithm of the multiplier of the stable one.",
        _TORUS,
        one_by_one(_limit_cycles, 3),
        ("stable", "unstable", "log_multiplier"),
        error="of Θ and of the trace",
        needed=_GIVEN,
    ),
    Quantity(
        "critical-a",
        "a*",
        "Birth of the limit cycles of Suslov–Hess tori",
        "1",
        "The a at which the limit cycles of the torus (h, f) appear, |trace| = 2.",
        _TORUS[1:],
        one_by_one(_critical_a),
        needed=_GIVEN[1:],
    ),
    Quantity(
        "theta-plus",
        "θ⁺",
        "Scattering of the free Suslov problem",
        "rad",
        "Angle of the circle that a motion joins after it has left the circle θ⁻ with the phase φ.",
        (*_TENSOR, *_CIRCLE),
        one_by_one(_theta_plus),
        error="of cos θ⁺",
    ),
    Quantity(
        "cos-chi",
        "cos χ",
        "Angle of scattering of the free Suslov problem",
        "1",
        "cos χ in closed form: cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*).",
        _TENSOR,
        one_by_one(_cos_chi),
    ),
    Quantity(
        "ball-theta-plus",
        "θ⁺",
        "Scattering of the Chaplygin ball",
        "rad",
        "Angle of the circle that a motion joins after it has left the circle θ⁻ with the phase φ, without a field.",
        (*_TENSOR, _D, *_CIRCLE, _DISTANCE),
        one_by_one(_ball_theta_plus),
        error="of θ⁺",
    ),
    Quantity(
        "period",
        "T",
        "Period with b₃ = 0 on a principal axis",
        "time",
        "Period of the motion with I₁₃ = I₂₃ = 0 and b₃ = 0, by arithmetic-geometric means (Kharlamova's case).",
        (*_PLANE_BODY, *_PLANE_START),
        one_by_one(_period),
    ),
    Quantity(
        "ball-period",
        "T",
        "Period of the Chaplygin ball with b₃ = 0",
        "time",
        "Twice the time between the first two crossings of γ₃ = 0, with I₁₃ = I₂₃ = 0 and b₃ = 0.",
        (*_PLANE_BODY, _D, *_PLANE_START),
        one_by_one(_ball_period),
        error="of T",
    ),
    Quantity(
        "attractors",
        "N",
        "Number of attractors: Suslov problem with gravity",
        "1",
        "Sets that orbits of a section approach, with a mean divergence that is negative by three times its error.",
        (
            *SUSLOV_ENERGY,
            usual(known.SPAN, 1000.0, "Time over which the divergence is averaged."),
        ),
        one_by_one(_attractors),
    ),
    *MOTIONS,
)

QUANTITIES: Mapping[str, Quantity] = {one.name: one for one in _TABLE}
"""All quantities by name."""


def quantity(name: str) -> Quantity:
    """Return the quantity of this name.  Raises `InvalidParameter`, which lists the names."""
    try:
        return QUANTITIES[name]
    except (KeyError, TypeError):
        raise InvalidParameter(f"There is no quantity {name!r}; choose from {', '.join(QUANTITIES)}.") from None
