"""Computations of every system with a motion, each declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from hess_mechanics import parameters as known
from hess_mechanics.catalogue.declared import Computation, Number, real
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.motions import integer, with_default
from hess_mechanics.dynamics.orbit import MAX_SAMPLES, MAX_STEPS, solve
from hess_mechanics.dynamics.plane_section import MAX_CROSSINGS, Plane, section
from hess_mechanics.dynamics.spectrum import lyapunov_exponent, lyapunov_spectrum
from hess_mechanics.dynamics.system import Body, System
from hess_mechanics.dynamics.tube import WORK_PER_SECOND, proved_orbit, tube
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import SectionCrossings

__all__ = ["computations"]

State = tuple[float, ...]

_LONG = with_default(known.SPAN, 500.0, "Time over which to average.")
_STEPS = (
    known.MAX_STEP,
    integer("max_steps", "N", MAX_STEPS, 1, 10**12, "Largest number of steps of all runs together."),
)
_TUBE_PARAMETERS = (
    with_default(known.TIME, 2.0),
    integer("samples", "n", 5, 2, MAX_SAMPLES, "Number of evenly spaced times, including 0."),
    integer("digits", "n", 18, 1, 100, "Accuracy of the intervals, in decimal digits."),
    real(
        "seconds",
        "s",
        4.0,
        1e-3,
        1e6,
        "Work limit in seconds of an ordinary core; it is counted and not timed, so the result is the same everywhere.",
    ),
)


def _at(name: str, *i: int) -> Callable[[Any], float]:
    """Return a function that reads an entry of an array of a result."""
    return lambda result: getattr(result, name)[i]


def _crossings(body: Body, start: State, offset: float, sense: int, max_step: float, **more: Any) -> SectionCrossings:
    normal = tuple(more.pop(f"n_{i + 1}") for i in range(len(start)))
    return section(body, start, Plane(normal, offset, sense), max_step=max_step or None, **more)


def _enclosure(
    function: Callable[..., Any], body: Body, start: State, duration: float, samples: int, seconds: float, **more: Any
) -> Any:
    times = np.linspace(0.0, duration, samples)[1:]
    return function(body, start, times, most_work=seconds * WORK_PER_SECOND, **more)


def computations(system: System) -> Iterator[Computation]:
    """Yield the computations of the motions of a system.

    Parameters
    ----------
    system : System
        The system.

    Yields
    ------
    Computation
        A computation, still without the parameters of the system and the initial state, see `declared.declare`.
    """
    names = system.variables
    yield Computation(
        "orbit",
        "Orbit",
        solve,
        (
            with_default(known.TIME, 50.0),
            integer("samples", "n", 500, 2, MAX_SAMPLES, "Number of evenly spaced times."),
            *_STEPS,
        ),
        {
            **{
                name: Number(
                    symbol,
                    f"{symbol} at the last time",
                    _at("states", -1, i),
                    error_reader="error_estimate",
                )
                for i, (name, symbol) in enumerate(zip(system.arguments, names, strict=True))
            },
            "drift": Number("Δ", "largest drift of an integral", lambda r: max(r.drift.values(), default=0.0)),
            "error": Number("ε", "estimated error", "error_estimate"),
        },
        Kind.ORBIT,
        "states",
        lambda body, start, duration, max_step, **more: solve(body, start, duration, max_step=max_step or None, **more),
        example={"duration": 10.0, "samples": 11.0},
    )
    yield Computation(
        "crossings",
        "Crossings of a plane",
        section,
        (
            *(
                real(
                    f"n_{i + 1}",
                    f"n({name})",
                    float(i == max(0, len(names) - 2)),
                    -1e3,
                    1e3,
                    f"Component of the normal of the plane along {name}.",
                )
                for i, name in enumerate(names)
            ),
            real("offset", "c", 0.0, -1e3, 1e3, "Value of (n, y) on the plane."),
            integer("sense", "s", 1, -1, 1, "1: crossed from below, −1: from above, 0: both."),
            integer("crossings", "N", MAX_CROSSINGS, 1, MAX_CROSSINGS, "Largest number of crossings."),
            with_default(known.TIME, 100.0, "Time up to which crossings are counted; negative: backward."),
            *_STEPS,
        ),
        {"crossings": Number("n", "number of crossings of the plane", lambda r: len(r.times))},
        Kind.SECTION,
        "times",
        _crossings,
        unit="time",
        example={"duration": 20.0},
    )
    yield Computation(
        "lyapunov",
        "Largest Lyapunov exponent",
        lyapunov_exponent,
        (_LONG,),
        {"lyapunov": Number("λ", "largest Lyapunov exponent", "value", "1/time", "spread")},
        Kind.EXPONENT,
        unit="1/time",
        example={"duration": 50.0},
    )
    yield Computation(
        "spectrum",
        "Lyapunov exponents",
        lyapunov_spectrum,
        (_LONG,),
        {
            **{
                f"exponent-{i + 1}": Number(
                    f"λ{i + 1}",
                    f"Lyapunov exponent {i + 1}",
                    _at("values", i),
                    "1/time",
                    _at("errors", i),
                )
                for i in range(len(names))
            },
            "dimension": Number("D", "Kaplan–Yorke dimension", lambda r: r.dimension[0], "1", lambda r: r.dimension[1]),
            "divergence": Number("⟨div ẏ⟩", "mean divergence", "divergence", "1/time", "divergence_error"),
        },
        Kind.EXPONENT,
        "values",
        unit="1/time",
        example={"duration": 50.0},
    )
    yield Computation(
        "megno",
        "MEGNO",
        megno,
        (with_default(known.SPAN, 200.0),),
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
        "values",
        # Use one thread, because the cells of a sweep share the cores.
        lambda body, start, **more: complete(megno(body, [start], threads=1, **more)),
        example={"duration": 50.0},
    )
    yield Computation(
        "tube",
        "Proved intervals that contain the motion",
        tube,
        _TUBE_PARAMETERS,
        {
            "width": Number("w", "largest width of an interval", "width"),
            "end": Number("t", "last enclosed time", lambda r: r.times[-1] if r.times.size else 0.0, "time"),
        },
        Kind.ORBIT,
        lambda r, exact: r.width,
        lambda *start, accuracy, **more: _enclosure(tube, *start, **more),
        group="prove",
        example={"duration": 1.0, "samples": 3.0},
    )
    yield Computation(
        "proved-orbit",
        "Orbit with a proved error",
        proved_orbit,
        (
            *_TUBE_PARAMETERS,
            real("right_to", "ε", 1e-6, 1e-300, 1e3, "Largest error of a state that counts as correct."),
        ),
        {
            "error": Number("ε", "proved upper bound on the error", "largest"),
            "right-until": Number("t", "last time up to which the orbit is correct", "valid_until", "time"),
        },
        Kind.ORBIT,
        lambda r, exact: r.largest,
        partial(_enclosure, proved_orbit),
        group="prove",
        example={"duration": 1.0, "samples": 3.0},
    )
