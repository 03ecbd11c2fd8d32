"""Quantities of motions: exponents, dimension, MEGNO, crossings, kinds.

A motion of any system is given by the parameters of the body and the initial state.  A motion on a section is given by
the values of the integrals and the coordinates of its first point.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from hess_explorer.sweep.errors import NoValue
from hess_explorer.sweep.quantity import Cell, Quantity, one_by_one, usual, whole
from hess_mechanics import parameters as known
from hess_mechanics.chaplygin_ball import section as of_ball
from hess_mechanics.chaplygin_ball.equations import SYSTEM as BALL
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.dynamics.basins import contraction
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.lyapunov import lyapunov_exponent
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.regime import MotionKind, regime
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.dynamics.section import Plane, section
from hess_mechanics.dynamics.spectrum import lyapunov_spectrum
from hess_mechanics.dynamics.system import Body, System, systems
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson import andoyer
from hess_mechanics.euler_poisson.equations import SYSTEM as HEAVY
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.parameters import Parameter
from hess_mechanics.suslov import section as of_suslov
from hess_mechanics.suslov.equations import SYSTEM as SUSLOV
from hess_mechanics.suslov.equations import SuslovBody, unit_vector

__all__ = ["MOTIONS", "SUSLOV_ENERGY", "suslov_section"]

Start = tuple[float, ...]
Values = Mapping[str, float]


@dataclass(frozen=True)
class _Motions:
    """Motions of a system, by their parameters.

    name : suffix of the quantities' names; parameters : those of the body and the start; start : returns body and
    initial state from their values, raises `ModelError`; section : returns the section on which all motions start;
    place : names of its coordinates.  Without a section the motions start anywhere.
    """

    name: str
    title: str
    system: System
    parameters: tuple[Parameter, ...]
    start: Callable[[Values], tuple[Body, Start]]
    section: Callable[[Values], PoincareSection] | None = None
    place: tuple[str, ...] = ()


# ---- initial states ---------------------------------------------------------------------------------------------


_OF_SYSTEMS: Mapping[str, Parameter] = {
    one.name: one
    for one in (
        *known.TENSOR,
        *known.FIELD,
        known.D,
        *known.INVERSE_MOMENTS,
        *known.CENTRE,
        known.MU,
        known.A_HESS,
        known.B_HESS,
        known.C1,
        known.C2,
        known.CUBIC,
        known.QUARTIC,
        *known.OMEGA,
        *known.GAMMA,
        *known.MOMENTUM,
        *known.REDUCED_GAMMA,
    )
}
"""Parameters and variables of the systems, by name."""


def _anywhere(system: System) -> _Motions:
    """Return motions that start at any state, by default at that of the system's example."""
    variables = {**_OF_SYSTEMS, **({one.name: one for one in known.REDUCED_OMEGA} if system.name == "hess" else {})}
    start = (usual(variables[name], value) for name, value in zip(system.arguments, system.example[0], strict=True))
    return _Motions(system.name, system.title, system, (*_body(system), *start), partial(_given, system))


def _given(system: System, values: Values) -> tuple[Body, Start]:
    """Return body and state; the vertical, the last three variables of every state, is normalised."""
    *first, g1, g2, g3 = (values[name] for name in system.arguments)
    gamma, _ = unit_vector((g1, g2, g3))
    return system.at([values[name] for name in system.parameters]), (*first, *gamma)


def _body(system: System) -> tuple[Parameter, ...]:
    """Return the parameters of a system, with the values of its example as defaults."""
    return tuple(
        usual(_OF_SYSTEMS[name], value) for name, value in zip(system.parameters, system.example[1], strict=True)
    )


SUSLOV_ENERGY = (*_body(SUSLOV), known.H_SUSLOV, whole("k", "k", 3, 1, 3, "The section is γ_k = 0, γ_k growing."))
"""The parameters of a section of the Suslov problem."""


def suslov_section(values: Values) -> of_suslov.SuslovSection:
    """Return the section γ_k = 0 at the energy h above the minimum.  Raises `InvalidParameter` if it is unreachable."""
    body = SuslovBody(*(values[name] for name in SUSLOV.parameters))
    made = of_suslov.SuslovSection(body, values["h"] - math.hypot(body.b1, body.b2, body.b3), int(values["k"]))
    if made.lowest_energy >= made.E:
        raise InvalidParameter(f"No motion with h = {values['h']:g} reaches γ{made.k} = 0: choose a larger h.")
    return made


def _on_suslov(values: Values) -> tuple[Body, Start]:
    of = suslov_section(values)
    return of.body, of.state_at(values["psi"], values["delta"])


def _ball_section(values: Values) -> of_ball.BallSection:
    body = BallBody(*(values[name] for name in BALL.parameters))
    return of_ball.BallSection(body, values["h"] - math.hypot(body.b1, body.b2))


def _on_ball(values: Values) -> tuple[Body, Start]:
    of = _ball_section(values)
    return of.body, of_ball.state_at(of.body, of.h, values["psi"], values["delta"])


def _heavy_section(values: Values) -> andoyer.AndoyerSection:
    a1, a2, a3, r1, r2, r3, mu = (values[name] for name in HEAVY.parameters)
    return andoyer.AndoyerSection(
        HeavyBody((a1, a2, a3), (r1, r2, r3), mu), values["h"], values["f"], int(values["sheet"])
    )


def _on_heavy(values: Values) -> tuple[Body, Start]:
    of = _heavy_section(values)
    return of.body, of.state_at(values["l"], values["x"])


_ON_SECTIONS = (
    _Motions(
        "suslov-section",
        "Suslov problem, a point of a section",
        SUSLOV,
        (*SUSLOV_ENERGY, known.PSI, known.DELTA),
        _on_suslov,
        suslov_section,
        ("psi", "delta"),
    ),
    _Motions(
        "ball-section",
        "Chaplygin ball, a point of a section",
        BALL,
        (*_body(BALL), known.H_BALL, known.PSI, known.DELTA),
        _on_ball,
        _ball_section,
        ("psi", "delta"),
    ),
    _Motions(
        "euler-poisson-section",
        "Euler–Poisson, a point of the Andoyer–Deprit section",
        HEAVY,
        (*_body(HEAVY), usual(known.H_HEAVY, 2.0), usual(known.F_HEAVY, 0.5), known.L, known.X, known.SHEET),
        _on_heavy,
        _heavy_section,
        ("l", "x"),
    ),
)

_OFFSET = Parameter(
    "offset",
    "c",
    "Offset of the plane",
    0.0,
    (-1.0, 1.0),
    0.01,
    (-1e3, 1e3),
    "The value of that variable on the plane.",
)

# ---- quantities -------------------------------------------------------------------------------------------------


def _lyapunov(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    found = lyapunov_exponent(*of.start(values), t, level)
    return Cell(found.value, found.spread)


def _spectrum(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    found = lyapunov_spectrum(*of.start(values), t, level)
    return Cell(tuple(found.values.tolist()), found.error_estimate)


def _dimension(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    return Cell(*lyapunov_spectrum(*of.start(values), t, level).dimension)


def _megno(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    body, state = of.start(values)
    return Cell(float(complete(megno(body, [state], t, level, threads=1)).values[0]))


def _crossings(
    of: _Motions, level: Level, variable: float, offset: float, sense: float, t: float, **values: float
) -> Cell:
    plane = Plane(tuple(float(i + 1 == variable) for i in range(len(of.system.variables))), offset, int(sense))
    found = section(*of.start(values), plane, t, level)
    return Cell(float(len(found.times)), found.error_estimate, found.status)


def _returns(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    assert of.section is not None
    found = section(*of.start(values), of.section(values).surface, t, level)
    return Cell(float(len(found.times)), found.error_estimate, found.status)


def _divergence(of: _Motions, level: Level, t: float, **values: float) -> Cell:
    body, state = of.start(values)
    found = contraction(SuslovBody(*body.parameters), state, t)
    return Cell(found.mean, found.error)


def _quantities(of: _Motions) -> tuple[Quantity, ...]:
    size = len(of.system.variables)
    long = usual(known.SPAN, 500.0, "Time over which to average.")
    counted = usual(known.SPAN, 100.0, "Time up to which crossings are counted.")

    def one(
        name: str,
        symbol: str,
        title: str,
        units: str,
        doc: str,
        function: Callable[..., Cell],
        *parameters: Parameter,
        parts: tuple[str, ...] = (),
        error: str = "",
    ) -> Quantity:
        return Quantity(
            f"{name}-{of.name}",
            symbol,
            f"{title}: {of.title}",
            units,
            doc,
            (*of.parameters, *parameters),
            one_by_one(partial(function, of), len(parts)),
            parts,
            error,
        )

    found = [
        one(
            "lyapunov",
            "λ",
            "Largest Lyapunov exponent",
            "1/time",
            "Mean rate at which nearby orbits separate over the time t (Benettin, Galgani, Strelcyn 1976).",
            _lyapunov,
            long,
            error="range of the running average in its second half",
        ),
        one(
            "spectrum",
            "λᵢ",
            "All Lyapunov exponents",
            "1/time",
            "Mean growth rates of a frame of tangent vectors over the last four fifths of the time t, the largest "
            "first.",
            _spectrum,
            long,
            parts=tuple(str(i + 1) for i in range(size)),
            error="largest of their errors, from 12 stretches of time",
        ),
        one(
            "dimension",
            "D",
            "Kaplan–Yorke dimension",
            "1",
            "Dimension of the set that the motion fills at fixed integrals, from all exponents over the time t.",
            _dimension,
            long,
            error="from those of the exponents",
        ),
        one(
            "megno",
            "Ȳ",
            "MEGNO",
            "1",
            "Mean exponential growth of nearby orbits: 2 at the most on regular motions, λt/2 on chaotic ones.",
            _megno,
            usual(known.SPAN, 200.0),
        ),
    ]
    if of.section is None:
        found.append(
            one(
                "crossings",
                "n",
                "Crossings of a plane",
                "1",
                "How often the motion crosses the plane y_variable = offset up to the time t.",
                _crossings,
                whole("variable", "i", size, 1, size, "Which of the variables, counted from 1."),
                _OFFSET,
                whole("sense", "s", 1, -1, 1, "1: crossed from below, −1: from above, 0: both."),
                counted,
                error="of the states at the crossings",
            )
        )
    else:
        found.append(
            one(
                "crossings",
                "n",
                "Returns to the section",
                "1",
                "How often the motion returns to the section up to the time t.",
                _returns,
                counted,
                error="of the states at the crossings",
            )
        )
    if of.system is SUSLOV:
        found.append(
            one(
                "divergence",
                "⟨div ẏ⟩",
                "Mean divergence",
                "1/time",
                "Mean of div ẏ over the later two thirds of the time t: negative where phase volume shrinks.",
                _divergence,
                usual(known.SPAN, 1000.0),
                error="standard error of the mean, from 12 stretches of time",
            )
        )
    return tuple(found)


_UNDECIDED = (MotionKind.UNDECIDED, MotionKind.SETTLING)


def _regime(of: _Motions, level: Level, transient: float, kept: float, t: float, **values: float) -> Cell:
    assert of.section is not None
    place = tuple(values[name] for name in of.place)
    found = regime(ReturnMap(of.section(values), level), place, int(transient), int(kept), t)
    if found.kind in _UNDECIDED:
        raise NoValue(
            f"The motion is {found.kind.words}: MEGNO is {found.megno:.3g} after t = {found.t:.4g}. Choose a "
            "longer time, or skip more crossings."
        )
    return Cell((float(found.kind), float(found.period), float(found.volume)))


def _regimes(of: _Motions) -> Quantity:
    """Return the quantity that classifies the motion from a point of a section."""
    return Quantity(
        f"regime-{of.name}",
        "regime",
        f"Kind of the motion: {of.title}",
        "1",
        "Kind: 0 not seen to return, 1 fixed point, 2 periodic, 3 quasi-periodic, 4 chaotic, 6 regular without a "
        "period up to 256; period, 0 where none is seen; volume: −1 shrinks about the motion, 1 grows, 0 neither to "
        "three times the error. What is undecided has no value.",
        (
            *of.parameters,
            whole("transient", "N₀", 300, 0, 20_000, "Crossings skipped."),
            whole("kept", "N", 200, 8, 20_000, "Crossings analysed."),
            usual(known.SPAN, 200.0, "Time of MEGNO and of the mean divergence."),
        ),
        one_by_one(partial(_regime, of), 3),
        ("kind", "period", "volume"),
        named={
            "kind": {int(one): one.words for one in MotionKind if one not in _UNDECIDED},
            "volume": {0: "kept", -1: "shrinks", 1: "grows"},
        },
    )


_OF_THE_PAPER = [system for system in systems().values() if system.labels]
"""Systems whose parameters have descriptions; for others, a function of one's own is swept."""
MOTIONS: tuple[Quantity, ...] = (
    *(one for of in (*map(_anywhere, _OF_THE_PAPER), *_ON_SECTIONS) for one in _quantities(of)),
    *map(_regimes, _ON_SECTIONS),
)
"""Quantities of every system of the paper, then of every section."""
