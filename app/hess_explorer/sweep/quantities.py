"""The quantities that can be swept, as data: to add one is to add an entry, with the function that computes a cell.

`one_by_one` makes of a function of one cell one of many.  Those that the mechanics compute at many places at once
(`values_at`) are called so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial

import numpy as np

from hess_explorer.sweep.errors import NoValue
from hess_explorer.sweep.quantity import Cell, Cells, Found, Outcome, Parameter, Quantity, one_by_one
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.chaplygin_ball.scattering import ball_scattering
from hess_mechanics.dynamics.lyapunov import largest_exponent
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.section import Plane, section
from hess_mechanics.dynamics.spectrum import spectrum
from hess_mechanics.dynamics.system import System, systems
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import PLANS, Kind, Level
from hess_mechanics.suslov.basins import contraction, count_attractors
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody, unit_vector
from hess_mechanics.suslov.kharlamova import PlaneBody, arc
from hess_mechanics.suslov.scattering import Scattering, cos_chi, scattering
from hess_mechanics.suslov.section import SuslovSection, lowest_energy, state_at
from hess_mechanics.suslov_hess.circle_map import circle_map
from hess_mechanics.suslov_hess.mode_locking import critical_a
from hess_mechanics.suslov_hess.rotation_number import TorusValues, values_at

__all__ = ["QUANTITIES", "quantity"]

_WIDE = 1e6

# ---- parameters -------------------------------------------------------------------------------------------------


def _number(name: str, symbol: str, default: float | None, doc: str, low: float = -_WIDE, high: float = _WIDE,
            units: str = "1") -> Parameter:
    return Parameter(name, symbol, default, low, high, doc, units)


def _whole(name: str, symbol: str, default: float, low: float, high: float, doc: str) -> Parameter:
    return Parameter(name, symbol, default, low, high, doc, whole=True)


_H = _number("h", "h", None, "energy, units b = 1; motions have h > −1")
_F = _number("f", "f", None, "area integral, units b = 1; |f| ≤ f_max(h)")
_A = _number("a", "a", None, "inertia parameter a = I23/I22")
_TENSOR = (_number("I11", "I₁₁", 2.0, "moment of inertia, > 0"), _number("I22", "I₂₂", 1.0, "moment of inertia, > 0"),
           _number("I13", "I₁₃", 0.3, "product of inertia"), _number("I23", "I₂₃", 0.5, "product of inertia"))
_FIELD = tuple(_number(f"b{i}", f"b{sub}", value, "field, b = −mg r")
               for i, sub, value in ((1, "₁", 0.3), (2, "₂", -0.5), (3, "₃", 1.0)))
_D = _number("D", "𝒟", 1.0, "moment of inertia of the ball inside times (R/R_s)², ≥ 0", 0.0)
_THETA = _number("theta", "θ⁻", 1.0, "angle of the circle from ξ that motions come from", 0.0, math.pi, "rad")
_PHI = _number("phi", "φ", 0.0, "phase on that circle", units="rad")
_PLANE_BODY = (
    _number("I11", "I₁₁", 1.3, "moment of inertia, > 0"), _number("I22", "I₂₂", 0.8, "moment of inertia, > 0"),
    _number("b1", "b₁", 0.5, "field, b = −mg r"), _number("b2", "b₂", -0.2, "field, b = −mg r"))
_PLANE_START = (
    _number("w1", "ω₁", 1.0, "angular velocity at t = 0"), _number("w2", "ω₂", -0.5, "angular velocity at t = 0"),
    *(_number(f"g{i}", f"γ{sub}", value, "vertical at t = 0; normalised")
      for i, sub, value in ((1, "₁", 0.0), (2, "₂", 0.6), (3, "₃", 0.8))))
_ENERGY = (
    *_TENSOR, *_FIELD,
    _number("h", "h", 1.0, "energy above the bottom, E + |b|", 0.0),
    _whole("k", "k", 3, 1, 3, "the section is γ_k = 0, γ_k growing"))
_PLACE = (
    _number("psi", "ψ", 1.0, "angle of γ in the plane of the section, at t = 0", units="rad"),
    _number("delta", "δ", 1.0, "angle of ω from the direction that keeps γ_k, at t = 0", 0.0, math.pi, "rad"))


def _time(default: float, doc: str) -> Parameter:
    return _number("t", "t", default, doc, 1e-3, _WIDE)


# ---- Suslov–Hess: tori (a, h, f) --------------------------------------------------------------------------------


def _of_tori(value: Callable[[TorusValues], np.ndarray], cells: Cells, level: Level) -> Found:
    found = values_at(cells["a"], cells["h"], cells["f"], level)
    # Where no motion is possible within the region, it is on the separatrix.
    separatrix = np.hypot(cells["h"] - 1.0, cells["f"]) < 1e-6
    status = np.where(found.possible, Outcome.OK, np.where(separatrix, Outcome.SEPARATRIX, Outcome.OUTSIDE_REGION))
    return Found(np.where(found.possible, value(found), np.nan), np.full(status.size, np.nan), status.astype(np.uint8))


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
    """Many cells of a sweep over angles have the same body."""
    return scattering(body, level)


def _theta_plus(level: Level, I11: float, I22: float, I13: float, I23: float, theta: float, phi: float) -> Cell:
    found = _scattered(SuslovBody(I11, I22, I13, I23), level)
    return Cell(float(found.theta_plus(theta, phi)), found.error_estimate, found.status)


def _cos_chi(level: Level, I11: float, I22: float, I13: float, I23: float) -> Cell:
    return Cell(cos_chi(SuslovBody(I11, I22, I13, I23)))


# ---- periods ----------------------------------------------------------------------------------------------------


def _period(level: Level, I11: float, I22: float, b1: float, b2: float, w1: float, w2: float, g1: float, g2: float,
            g3: float) -> Cell:
    gamma, _ = unit_vector((g1, g2, g3))
    found = arc(PlaneBody(I11, I22, b1, b2), (w1, w2, *gamma))
    if found.kind != "periodic":
        raise NoValue("This motion rests on the equator and has no period." if found.kind == "fixed" else
                      "This motion tends to a fixed point on the equator and has no period.")
    return Cell(found.period)


def _ball_period(level: Level, I11: float, I22: float, b1: float, b2: float, D: float, w1: float, w2: float, g1: float,
                 g2: float, g3: float) -> Cell:
    gamma, _ = unit_vector((g1, g2, g3))
    found = period(BallBody(I11, I22, 0.0, 0.0, D, b1, b2, 0.0), (w1, w2, *gamma), level)
    return Cell(found.value, found.error_estimate, found.status)


# ---- Chaplygin ball ---------------------------------------------------------------------------------------------


def _ball_theta_plus(level: Level, I11: float, I22: float, I13: float, I23: float, D: float, theta: float, phi: float,
                     distance: float) -> Cell:
    found = ball_scattering(BallBody(I11, I22, I13, I23, D), theta, [phi], 1.0, distance, level)
    return Cell(float(found.theta_plus[0]), float(found.errors[0]), found.status)


# ---- any system -------------------------------------------------------------------------------------------------


def _motion(system: System) -> tuple[Parameter, ...]:
    """Parameters and initial state of a system; by default those of its example."""
    state, values = system.example
    return (*(_number(name, name, value, "parameter of the system") for name, value in
              zip(system.parameters, values, strict=True)),
            *(_number(argument, name, value, f"{name} at t = 0" + ("; normalised" if i >= len(state) - 3 else ""))
              for i, (argument, name, value) in enumerate(zip(system.arguments, system.variables, state, strict=True))))


def _start(system: System, values: Mapping[str, float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """State and parameters; the vertical, which every state ends with, is normalised."""
    *first, g1, g2, g3 = (values[name] for name in system.arguments)
    gamma, _ = unit_vector((g1, g2, g3))
    return (*first, *gamma), tuple(values[name] for name in system.parameters)


def _exponent_level(level: Level) -> Level:
    return PLANS[Kind.EXPONENT][level.name].level


def _lyapunov(system: System, level: Level, t: float, **values: float) -> Cell:
    found = largest_exponent(system, *_start(system, values), t, _exponent_level(level))
    return Cell(found.value, found.spread)


def _spectrum(system: System, level: Level, t: float, **values: float) -> Cell:
    found = spectrum(system, *_start(system, values), t, level)
    return Cell(tuple(found.values.tolist()), found.error_estimate)


def _dimension(system: System, level: Level, t: float, **values: float) -> Cell:
    return Cell(*spectrum(system, *_start(system, values), t, level).dimension)


def _megno(system: System, level: Level, t: float, **values: float) -> Cell:
    state, p = _start(system, values)
    return Cell(float(megno(system, [state], p, t, level, threads=1).values[0]))


def _crossings(system: System, level: Level, variable: float, offset: float, sense: float, t: float,
               **values: float) -> Cell:
    plane = Plane(tuple(float(i + 1 == variable) for i in range(len(system.variables))), offset, int(sense))
    found = section(system, *_start(system, values), plane, t, level)
    return Cell(float(len(found.times)), found.error_estimate, found.status)


def _for_system(system: System) -> tuple[Quantity, ...]:
    """λ, all exponents, D, MEGNO and the number of crossings, for a motion of this system."""
    motion = _motion(system)
    size = len(system.variables)
    return (
        Quantity(f"lyapunov-{system.name}", "λ", f"Largest Lyapunov exponent: {system.title}", "1/time",
                 "Mean rate at which neighbours part over the time t (Benettin, Galgani, Strelcyn 1976).",
                 (*motion, _time(500.0, "time over which to average")),
                 one_by_one(partial(_lyapunov, system)), error="range of the running average in its second half"),
        Quantity(f"spectrum-{system.name}", "λᵢ", f"All Lyapunov exponents: {system.title}", "1/time",
                 "Mean rates at which a frame of neighbours grows over the last four fifths of the time t, the largest "
                 "first, by the variational equations.",
                 (*motion, _time(500.0, "time over which to average")),
                 one_by_one(partial(_spectrum, system), size), tuple(str(i + 1) for i in range(size)),
                 error="largest of their errors, from 12 stretches of time"),
        Quantity(f"dimension-{system.name}", "D", f"Kaplan–Yorke dimension: {system.title}", "1",
                 "Of what the motion fills on its level of the integrals, from all exponents over the time t.",
                 (*motion, _time(500.0, "time over which to average")), one_by_one(partial(_dimension, system)),
                 error="from those of the exponents"),
        Quantity(f"megno-{system.name}", "Ȳ", f"MEGNO: {system.title}", "1",
                 "Mean exponential growth of nearby orbits: 2 at the most on regular motions, λt/2 on chaotic ones.",
                 (*motion, _time(200.0, "time")), one_by_one(partial(_megno, system))),
        Quantity(f"crossings-{system.name}", "n", f"Crossings of a plane: {system.title}", "1",
                 "How often the motion crosses the plane y_variable = offset up to the time t.",
                 (*motion, _whole("variable", "i", size, 1, size, "which of the variables, counted from 1"),
                  _number("offset", "c", 0.0, "its value on the plane"),
                  _whole("sense", "s", 1, -1, 1, "1: crossed from below, −1: from above, 0: both"),
                  _time(100.0, "time up to which crossings are counted")),
                 one_by_one(partial(_crossings, system)), error="of the states at the crossings"),
    )


# ---- Suslov problem with gravity --------------------------------------------------------------------------------

_Body = tuple[float, float, float, float, float, float, float]


def _contraction(level: Level, t: float, **values: float) -> Cell:
    start, p = _start(SYSTEM, values)
    found = contraction(SuslovBody(*p), start, t)
    return Cell(found.mean, found.error)


def _at_energy(k: float, h: float, I11: float, I22: float, I13: float, I23: float, b1: float, b2: float, b3: float
               ) -> SuslovSection:
    """The section of a body at this energy above the bottom, if a motion reaches it.  Raises `InvalidParameter`."""
    made = SuslovSection(SuslovBody(I11, I22, I13, I23, b1, b2, b3), h - math.hypot(b1, b2, b3), int(k))
    if lowest_energy(made.body, made.k) >= made.E:
        raise InvalidParameter(f"No motion with h = {h:g} reaches γ{made.k} = 0: choose a larger h.")
    return made


def _lyapunov_at_energy(level: Level, psi: float, delta: float, t: float, **values: float) -> Cell:
    of = _at_energy(**values)
    found = largest_exponent(SYSTEM, state_at(of.body, of.E, of.k, psi, delta), of.body.parameters, t,
                             _exponent_level(level))
    return Cell(found.value, found.spread)


def _contraction_at_energy(level: Level, psi: float, delta: float, t: float, **values: float) -> Cell:
    of = _at_energy(**values)
    found = contraction(of.body, state_at(of.body, of.E, of.k, psi, delta), t)
    return Cell(found.mean, found.error)


def _attractors(level: Level, across: float, up: float, crossings: float, t: float, **values: float) -> Cell:
    plan = PLANS[Kind.BASINS][level.name]
    return Cell(float(count_attractors(_at_energy(**values), (int(across), int(up)), int(crossings), t, plan.level)))


# ---- the table --------------------------------------------------------------------------------------------------

_BATCHES = "standard error of the mean, from 12 stretches of time"
_DIVERGENCE = "Mean of div ẏ over the later two thirds of the time t: negative where phase volume shrinks."

_TABLE: tuple[Quantity, ...] = (
    Quantity("rotation-number", "ρ", "Rotation number of Suslov–Hess tori", "turns per return",
             "Rotation number of the circle map of the torus (h, f).", (_A, _H, _F),
             partial(_of_tori, lambda found: found.rho), turn=1.0),
    Quantity("trace", "|t|", "Trace of the circle map of Suslov–Hess tori", "1",
             "|trace| of the circle map as a matrix of SU(1,1): above 2 it has two limit cycles.", (_A, _H, _F),
             partial(_of_tori, lambda found: found.trace)),
    Quantity("locked", "locked", "Mode locking of Suslov–Hess tori", "1",
             "1 where the circle map has two limit cycles, 0 elsewhere.", (_A, _H, _F),
             partial(_of_tori, lambda found: found.locked.astype(float))),
    Quantity("limit-cycles", "φ*", "Limit cycles of Suslov–Hess tori", "rad, the last 1",
             "Angles of the stable and of the unstable limit cycle, and the logarithm of the multiplier of the stable "
             "one.", (_A, _H, _F), one_by_one(_limit_cycles, 3), ("stable", "unstable", "log_multiplier"),
             error="of Θ and of the trace"),
    Quantity("critical-a", "a*", "Birth of the limit cycles of Suslov–Hess tori", "1",
             "The a at which the limit cycles of the torus (h, f) appear, |trace| = 2.", (_H, _F),
             one_by_one(_critical_a)),
    Quantity("theta-plus", "θ⁺", "Scattering of the free Suslov problem", "rad",
             "Angle of the circle that the motion from the circle θ⁻ with the phase φ goes to.",
             (*_TENSOR, _THETA, _PHI), one_by_one(_theta_plus), error="of cos θ⁺"),
    Quantity("cos-chi", "cos χ", "Angle of scattering of the free Suslov problem", "1",
             "cos χ in closed form: cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*).", _TENSOR, one_by_one(_cos_chi)),
    Quantity("ball-theta-plus", "θ⁺", "Scattering of the Chaplygin ball", "rad",
             "Angle of the circle that the motion from the circle θ⁻ with the phase φ goes to, without a field.",
             (*_TENSOR, _D, _THETA, _PHI, _number("distance", "δ", 1e-3, "of the start from N^u", -0.1, 0.1)),
             one_by_one(_ball_theta_plus), error="of θ⁺"),
    Quantity("period", "T", "Period with b₃ = 0 on a principal axis", "time",
             "Period of the motion with I₁₃ = I₂₃ = 0 and b₃ = 0, by arithmetic-geometric means (Kharlamova's case).",
             (*_PLANE_BODY, *_PLANE_START), one_by_one(_period)),
    Quantity("ball-period", "T", "Period of the Chaplygin ball with b₃ = 0", "time",
             "Twice the time between the first two crossings of γ₃ = 0, with I₁₃ = I₂₃ = 0 and b₃ = 0.",
             (*_PLANE_BODY, _D, *_PLANE_START), one_by_one(_ball_period), error="of T"),
    Quantity("divergence-suslov", "⟨div ẏ⟩", "Mean divergence: Suslov problem with gravity", "1/time", _DIVERGENCE,
             (*_motion(SYSTEM), _time(1000.0, "time")), one_by_one(_contraction), error=_BATCHES),
    Quantity("divergence-at-energy", "⟨div ẏ⟩", "Mean divergence: Suslov problem, a place of a section", "1/time",
             _DIVERGENCE, (*_ENERGY, *_PLACE, _time(1000.0, "time")), one_by_one(_contraction_at_energy),
             error=_BATCHES),
    Quantity("lyapunov-at-energy", "λ", "Largest Lyapunov exponent: Suslov problem, a place of a section", "1/time",
             "Mean rate at which neighbours part over the time t, from a place (ψ, δ) of the section γ_k = 0.",
             (*_ENERGY, *_PLACE, _time(500.0, "time over which to average")), one_by_one(_lyapunov_at_energy),
             error="range of the running average in its second half"),
    Quantity("attractors", "N", "Number of attractors: Suslov problem with gravity", "1",
             "Groups of motions of a section whose mean divergence is negative by three times its error.",
             (*_ENERGY, _whole("across", "m", 8, 2, 400, "orbits across the section"),
              _whole("up", "n", 6, 2, 400, "orbits up the section"),
              _whole("crossings", "N", 150, 100, 10_000, "of each orbit"),
              _time(1000.0, "time over which the divergence is averaged")), one_by_one(_attractors)),
    *(one for system in systems().values() for one in _for_system(system)),
)

QUANTITIES: Mapping[str, Quantity] = {one.name: one for one in _TABLE}
"""By name."""


def quantity(name: str) -> Quantity:
    """The quantity of this name.  Raises `InvalidParameter`, which lists the names."""
    try:
        return QUANTITIES[name]
    except (KeyError, TypeError):
        raise InvalidParameter(f"There is no quantity {name!r}; choose from {', '.join(QUANTITIES)}.") from None
