"""Computations of every system with a motion, each declared once."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import Computation, Number, declare, largest_difference, moving
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.megno import Megno, megno
from hess_mechanics.dynamics.motions import Motions, usual, whole
from hess_mechanics.dynamics.orbit import MAX_SAMPLES, MAX_STEPS, solve
from hess_mechanics.dynamics.plane_section import MAX_CROSSINGS, Plane, section
from hess_mechanics.dynamics.spectrum import Exponent, Spectrum, lyapunov_exponent, lyapunov_spectrum
from hess_mechanics.dynamics.system import Body
from hess_mechanics.dynamics.tube import WORK_PER_SECOND, ProvedOrbit, Tube, proved_orbit, tube
from hess_mechanics.numerics.accuracy import Kind, Level
from hess_mechanics.numerics.results import Orbit, SectionCrossings
from hess_mechanics.parameters import Parameter

__all__ = ["computations"]

State = tuple[float, ...]

_LONG = usual(known.SPAN, 500.0, "Time over which to average.")
_STEPS = (
    known.MAX_STEP,
    whole("max_steps", "N", MAX_STEPS, 1, 10**12, "Largest number of steps of all runs together."),
)
_TIMES = (usual(known.TIME, 50.0), whole("samples", "n", 500, 2, MAX_SAMPLES, "Evenly spaced times in the table."))
_DIGITS = whole("digits", "n", 18, 1, 100, "Number of digits that determines the width of the intervals.")
_SECONDS = Parameter(
    "seconds",
    "s",
    "Work limit",
    4.0,
    (1.0, 60.0),
    1.0,
    (1e-3, 1e6),
    "Work limit in seconds of an ordinary core; it is counted and not timed, so the result is the same everywhere.",
    "Computation",
)
_RIGHT_TO = Parameter(
    "right_to",
    "ε",
    "Largest error of an orbit that is right",
    1e-6,
    (1e-12, 1e-2),
    1e-6,
    (1e-300, 1e3),
    "Largest error of an orbit that is right.",
    "Computation",
)


def _limits(max_step: float, max_steps: int) -> dict[str, Any]:
    return {"max_step": max_step or None, "max_steps": max_steps}


def _orbit(body: Body, state: State, accuracy: Level, duration: float, samples: int, **steps: Any) -> Orbit:
    return solve(body, state, duration, accuracy, samples, **_limits(**steps))


def _crossings(
    body: Body,
    state: State,
    accuracy: Level,
    offset: float,
    sense: int,
    crossings: int,
    duration: float,
    max_step: float,
    max_steps: int,
    **normal: float,
) -> SectionCrossings:
    plane = Plane(tuple(normal[f"n_{i + 1}"] for i in range(len(normal))), offset, sense)
    return section(body, state, plane, duration, accuracy, crossings, **_limits(max_step, max_steps))


def _exponent(body: Body, state: State, accuracy: Level, duration: float) -> Exponent:
    return lyapunov_exponent(body, state, duration, accuracy)


def _spectrum(body: Body, state: State, accuracy: Level, duration: float) -> Spectrum:
    return lyapunov_spectrum(body, state, duration, accuracy)


def _megno(body: Body, state: State, accuracy: Level, duration: float) -> Megno:
    # One thread: the cells of a sweep share the cores.
    return complete(megno(body, [state], duration, accuracy, threads=1))


def _tube(
    body: Body, state: State, accuracy: Level, duration: float, samples: int, digits: int, seconds: float
) -> Tube:
    times = np.linspace(0.0, duration, samples)[1:]
    return tube(body, state, times, digits, seconds * WORK_PER_SECOND)


def _proved(
    body: Body,
    state: State,
    accuracy: Level,
    duration: float,
    samples: int,
    digits: int,
    seconds: float,
    right_to: float,
) -> ProvedOrbit:
    times = np.linspace(0.0, duration, samples)[1:]
    return proved_orbit(body, state, times, accuracy, right_to, digits, seconds * WORK_PER_SECOND)


def _normal(of: Motions) -> tuple[Parameter, ...]:
    """Return the components of the normal of a plane among the states; by default the last variable but one is 0."""
    names = of.system.variables
    return tuple(
        Parameter(
            f"n_{i + 1}",
            f"n({name})",
            f"Normal, {name}",
            float(i == max(0, len(names) - 2)),
            (-1.0, 1.0),
            0.1,
            (-1e3, 1e3),
            f"Component of the normal of the plane along {name}.",
        )
        for i, name in enumerate(names)
    )


_PLANE = (
    Parameter("offset", "c", "Offset of the plane", 0.0, (-1.0, 1.0), 0.01, (-1e3, 1e3), "Value of (n, y) on it."),
    whole("sense", "s", 1, -1, 1, "1: crossed from below, −1: from above, 0: both."),
    whole("crossings", "N", MAX_CROSSINGS, 1, MAX_CROSSINGS, "Largest number of crossings."),
    usual(known.TIME, 100.0, "Time up to which crossings are counted; negative: backward."),
)


def _times_differ(one: Any, exact: Any) -> float:
    return largest_difference(one.times, exact.times)


def computations(of: Motions) -> Iterator[Computation]:
    """Yield the computations of the motions of a system."""
    entry = partial(declare, of, moving(of))
    yield entry(
        "orbit",
        "Orbit",
        solve,
        _orbit,
        (*_TIMES, *_STEPS),
        {
            **{
                name: Number(symbol, f"{symbol} at the last time", partial(_last, i), error_reader="error_estimate")
                for i, (name, symbol) in enumerate(zip(of.system.arguments, of.system.variables, strict=True))
            },
            "drift": Number("Δ", "largest drift of an integral", lambda r: max(r.drift.values(), default=0.0)),
            "error": Number("ε", "estimated error", "error_estimate"),
        },
        Kind.ORBIT,
        lambda r, exact: largest_difference(r.states, exact.states),
        example={"duration": 10.0, "samples": 11.0},
    )
    yield entry(
        "crossings",
        "Crossings of a plane",
        section,
        _crossings,
        (*_normal(of), *_PLANE, *_STEPS),
        {
            "count": Number(
                "n", "how often the motion crosses the plane", lambda r: len(r.times), error_reader="error_estimate"
            )
        },
        Kind.SECTION,
        _times_differ,
        unit="time",
        example={"duration": 20.0},
    )
    yield entry(
        "lyapunov",
        "Largest Lyapunov exponent",
        lyapunov_exponent,
        _exponent,
        (_LONG,),
        {"exponent": Number("λ", "largest Lyapunov exponent", "value", "1/time", "spread")},
        Kind.EXPONENT,
        lambda r, exact: abs(r.value - exact.value),
        unit="1/time",
        example={"duration": 50.0},
    )
    yield entry(
        "spectrum",
        "Lyapunov exponents",
        lyapunov_spectrum,
        _spectrum,
        (_LONG,),
        {
            **{
                f"exponent-{i + 1}": Number(
                    f"λ{i + 1}", f"Lyapunov exponent {i + 1}", partial(_rate, i), "1/time", partial(_rate_error, i)
                )
                for i in range(len(of.system.variables))
            },
            "dimension": Number("D", "Kaplan–Yorke dimension", lambda r: r.dimension[0], "1", lambda r: r.dimension[1]),
            "divergence": Number("⟨div ẏ⟩", "mean divergence", "divergence", "1/time", "divergence_error"),
        },
        Kind.EXPONENT,
        lambda r, exact: largest_difference(r.values, exact.values),
        unit="1/time",
        example={"duration": 50.0},
    )
    yield entry(
        "megno",
        "MEGNO",
        megno,
        _megno,
        (usual(known.SPAN, 200.0),),
        {
            "megno": Number("Ȳ", "MEGNO", lambda r: r.values[0]),
            "divergence": Number(
                "⟨div ẏ⟩",
                "mean divergence",
                lambda r: r.divergence[0],
                "1/time",
                lambda r: r.divergence_error[0],
            ),
        },
        Kind.INDICATOR,
        lambda r, exact: largest_difference(r.values, exact.values),
        example={"duration": 50.0},
    )
    exact_times = (usual(known.TIME, 2.0), whole("samples", "n", 5, 2, MAX_SAMPLES, "Evenly spaced times, with 0."))
    yield entry(
        "tube",
        "Proved intervals that contain the motion",
        tube,
        _tube,
        (*exact_times, _DIGITS, _SECONDS),
        {
            "width": Number("w", "largest width of an interval", "width"),
            "end": Number("t", "last enclosed time", lambda r: r.times[-1] if r.times.size else 0.0, "time"),
        },
        Kind.ORBIT,
        lambda r, exact: r.width,
        group="prove",
        example={"duration": 1.0, "samples": 3.0},
    )
    yield entry(
        "proved-orbit",
        "Orbit with a proved error",
        proved_orbit,
        _proved,
        (*exact_times, _RIGHT_TO, _DIGITS, _SECONDS),
        {
            "error": Number("ε", "upper end of the proved largest error", "largest"),
            "right-until": Number("t", "last time at which the orbit is right", "right_until", "time"),
        },
        Kind.ORBIT,
        lambda r, exact: r.largest,
        group="prove",
        example={"duration": 1.0, "samples": 3.0},
    )


def _last(i: int, orbit: Orbit) -> float:
    return float(orbit.states[-1, i])


def _rate(i: int, spectrum: Spectrum) -> float:
    return float(spectrum.values[i])


def _rate_error(i: int, spectrum: Spectrum) -> float:
    return float(spectrum.errors[i])
