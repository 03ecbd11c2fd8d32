"""`hess-explorer section euler-poisson|suslov|ball`: the Poincaré section of one motion."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from hess_mechanics import BodyCheck, Plane, SectionCrossings, level, section
from hess_mechanics.dynamics.section import MAX_CROSSINGS
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import SYSTEM as HEAVY_SYSTEM
from hess_mechanics.parameters import F_HEAVY, H_HEAVY, TIME, L, X

from .arguments import number as any_number
from .command import OUTPUT, Command, Options, number, option, vector, whole
from .motions import HEAVY, LIMITS, MOTIONS, check_of, heavy_of, limits_of, start_of
from .output import Answer, body_facts, quality, table

__all__ = ["COMMAND"]

_COUNT = whole("--crossings", 1, MAX_CROSSINGS, "maximum number of crossings", 100)


def _of_heavy(options: Options) -> Answer:
    accuracy, body = level(options.accuracy), heavy_of(options)
    plane = AndoyerSection(body, options.h, options.f)
    start = plane.state_at(*options.start)
    end = plane.time_for(options.crossings) if options.t is None else options.t
    result = section(body, start, plane.surface, end, accuracy, options.crossings, **limits_of(options))
    l, x = plane.places_of(result.states).T
    return Answer(
        {
            "t": result.times.tolist(),
            "l": l.tolist(),
            "x": x.tolist(),
            "M": result.states[:, :3].tolist(),
            "gamma": result.states[:, 3:].tolist(),
        },
        _facts(result, start, check_of(body)),
        _fewer(result, options.crossings, end),
        ("t", "l", "x", *HEAVY_SYSTEM.variables),
    )


def _of_plane(name: str, options: Options) -> Answer:
    accuracy = level(options.accuracy)
    body, check = MOTIONS[name].given(options)
    start, notes = start_of(options)
    plane = Plane(options.plane, options.offset, options.sense)
    result = section(body, start, plane, options.t, accuracy, options.crossings, **limits_of(options))
    return Answer(
        {"t": result.times.tolist(), "y": result.states.tolist()},
        {"variables": list(body.system.variables), **_facts(result, start, check)},
        [*_fewer(result, options.crossings, options.t), *notes],
        ("t", *body.system.variables),
    )


def _facts(result: SectionCrossings, start: tuple[float, ...], body: BodyCheck) -> Mapping[str, Any]:
    return {"start": list(start), **quality(result), **body_facts(body)}


def _fewer(result: SectionCrossings, asked: int, end: float) -> list[str]:
    """Return a note if there are fewer crossings than requested."""
    found = len(result.times)
    return [f"There are only {found} of {asked} crossings up to t = {end:.6g}."] if found < asked else []


def _plane(name: str, usual: tuple[float, ...] | None, example: str) -> Command:
    of = MOTIONS[name]
    return Command(
        "Compute the crossings of the plane n1 ω1 + n2 ω2 + n3 γ1 + n4 γ2 + n5 γ3 = offset"
        f"{', by default γ3 = 0,' if usual else ''} by an orbit of {of.title}.",
        (
            *of.options,
            vector("--plane", "n1,n2,n3,n4,n5", f"normal of the plane{' (default 0,0,0,0,1)' if usual else ''}", usual),
            option("--offset", "offset of the plane along its normal (default 0)", type=any_number, default=0.0),
            option(
                "--sense",
                "direction of the crossings: 1 upward (default), -1 downward, 0 both",
                type=int,
                choices=(-1, 0, 1),
                default=1,
            ),
            number(TIME),
            _COUNT,
            *LIMITS,
            *OUTPUT,
        ),
        table(partial(_of_plane, name)),
        f"{of.example} {example}",
        f"{of.title}, any plane",
    )


COMMAND = Command(
    systems={
        "euler-poisson": Command(
            "Compute the points (l, x = L/G) at which the angle g of a heavy rigid body crosses π/2 upwards, for the "
            "energy h and the area integral f.",
            (
                *HEAVY,
                number(H_HEAVY, help="energy"),
                number(F_HEAVY, help="area integral (M, γ); the section needs G ≥ |f|"),
                vector("--start", (L, X), "first point"),
                number(
                    TIME,
                    help="last time; negative: backward in time (default: enough for the number of crossings)",
                    required=False,
                ),
                _COUNT,
                *LIMITS,
                *OUTPUT,
            ),
            table(_of_heavy),
            "--A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 --h 50 --f 5 --start 0,0.2 --crossings 20",
            "a heavy body with a fixed point, in Andoyer–Deprit variables",
        ),
        "suslov": _plane("suslov", None, "--plane 0,0,0,0,1 --t 50"),
        "ball": _plane("ball", (0.0, 0.0, 0.0, 0.0, 1.0), "--t 100"),
    }
)
