"""Extreme inputs: the result meets the level's error bound, or says that it does not.

One row for each extreme.  `python tests/models/test_extremes.py` prints what was measured as a table.
"""

import re
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import copysign, cos, exp, hypot, pi, sin, sqrt
from pathlib import Path

import mpmath
import numpy as np
import pytest

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import oracle
from hess_mechanics import (
    HessBody,
    SuslovBody,
    circle_map,
    curve_point,
    f_max,
    lock_boundary,
    solve,
    systems,
)
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.suslov.free import free_motion
from hess_mechanics.suslov.scattering import scattering
from hess_mechanics.suslov_hess.torus import track
from support.extremes import ball as extremes_ball
from support.extremes import euler_poisson as extremes_euler_poisson
from support.extremes import special_motions
from support.extremes import suslov as extremes_suslov
from support.extremes.unstable import FIRST, unstable_starts
from support.measured import write_measured
from support.mechanics import PROMISE, apart
from support.thorough import examples

HESS, SUSLOV = systems()["hess"], systems()["suslov"]
ANY = ("any",)
PHASES = np.linspace(-3.0, 3.1, 14)


@dataclass(frozen=True)
class Row:
    """error(level) is the true error `against` an independent result; it must not exceed bound(level).

    `floor` replaces a smaller promise at `precise` and `reference`; `because` says what puts it there.  Where no double
    can hold the answer, a result that says so is right too: `admitted(level)`.
    """

    name: str
    against: str
    error: Callable
    floor: float = 1e-12
    because: str = ""
    levels: tuple[str, ...] = tuple(PROMISE)
    admitted: Callable = lambda grade: False

    def bound(self, name):
        return PROMISE[name] if name in ("draft", "standard") else max(PROMISE.get(name, 0.0), self.floor)


# ---- how each kind of result is measured ------------------------------------------------------------------------


def trace_error(found, log_trace):
    """Relative where the trace exceeds 1; of its logarithm where it exceeds double range."""
    if log_trace > 700:
        return abs(found.log_trace / log_trace - 1)
    trace = exp(log_trace)
    return abs(found.trace - trace) / max(1.0, trace)


def map_error(found, truth):
    """In Θ on its graph (where it is steep an error of Θ is one of φ), the trace, and the rotation number.

    A limit cycle where there is none, or none where there is one, is an error of 1.
    """
    exact = [truth.theta(phi) for phi in PHASES]
    steepness = np.maximum(1.0, [truth.slope(phi) for phi in PHASES])
    half = exp(min(truth.log_trace, 1.0)) / 2
    # An elliptic map turns by arccos(t/2), whichever whole turns are added; −½ < ρ ≤ 0 for f > 0.
    rotation = abs(abs(cos(pi * found.rotation_number)) - min(1.0, half))
    wrong_kind = float(abs(half - 1) > 1e-3 and (found.kind == "hyperbolic") != (half > 1))
    return float(
        max(
            np.max(apart(found.theta(PHASES), exact) / steepness),
            trace_error(found, truth.log_trace),
            rotation,
            wrong_kind,
        )
    )


def a_map(name, a, h, f, truth, against, **options):
    once = cache(truth)
    return Row(f"Θ: {name}", against, lambda grade: map_error(circle_map(a, h, f, grade), once()), **options)


def says_so(a, h, f, error):
    """Assert that the status is not OK and that the estimate covers this error, or that no digit is known."""

    def admitted(grade):
        found = circle_map(a, h, f, grade)
        return found.status is not Status.OK and found.error_estimate >= min(0.1, error / 10)

    return admitted


def by_orbits(name, a, h, f, digits=40, **options):
    return a_map(
        name, a, h, f, lambda: oracle.map_by_three_orbits(a, h, f, digits), f"three orbits, {digits} digits", **options
    )


def vanishing(name, a, h, f, **options):
    return a_map(name, a, h, f, lambda: oracle.map_of_vanishing_f(a, h, f), "closed form, f → 0", **options)


def without_a(name, h, f, **options):
    return a_map(name, 0.0, h, f, lambda: oracle.map_without_a(h, f), "closed form, Π(n, m)", **options)


def by_cycle(name, a, h, f, **options):
    once = cache(lambda: oracle.stable_cycle(a, h, f))

    def error(grade):
        found, (phi, log_trace) = circle_map(a, h, f, grade), once()
        stable, unstable = found.fixed_points
        # Everything but a neighbourhood of the unstable cycle, too small for a double, falls onto the stable one.
        fallen = apart(found.theta([0.0, 1.0, -1.0, 3.0]), phi)
        return float(
            max(
                apart(stable.phi, phi),
                apart(unstable.phi, -phi),
                np.max(fallen),
                trace_error(found, log_trace),
                abs(unstable.log_multiplier / (2 * log_trace) - 1),
            )
        )

    return Row(f"Θ: {name}", "the cycle, Fourier collocation", error, **options)


def orbit_error(found, exact, speed=None):
    """In units in which the state is O(1): an angular velocity relative to the fastest of the motion."""
    apart = oracle.distances(found, exact)
    speed = speed or max(np.max(np.abs(np.asarray(exact[:, :2], float))), 1e-300)
    return float(max(np.max(apart[:, :2]) / speed, np.max(apart[:, 2:])))


def an_orbit(name, system, state, parameters, times, truth=None, digits=36, against=None, speed=None, **options):
    @cache
    def once():
        return truth() if truth else oracle.orbit_in_decimals(system, state, parameters, times, digits)

    body = system.at(parameters)
    return Row(
        f"{system.name}: {name}",
        against or f"Taylor series, {digits} digits",
        lambda grade: orbit_error(solve(body, state, times, grade).states, once(), speed),
        **options,
    )


def a_pendulum(name, a, h, phi, times, b=1.0, **options):
    """An orbit with f = 0 from n3 = 1; the times are in units of 1/√b."""
    root, fast = sqrt(b), 2 * sqrt((h + 1) / 2)
    units = np.array([root, root, 1, 1, 1])
    start = np.array([fast * sin(phi), fast * cos(phi), 0.0, 0.0, 1.0]) * units
    return an_orbit(
        name,
        HESS,
        start,
        (a, b),
        np.asarray(times) / root,
        truth=lambda: oracle.pendulum(a, h, phi, times) * units,
        against="closed form, loxodromic pendulum",
        **options,
    )


def at_rest(name, system, top, parameters, **options):
    state = (0.0, 0.0, 0.0, 0.0, top)
    return an_orbit(
        name, system, state, parameters, [top * 1e6], truth=lambda: np.array([state]), against="equilibrium", **options
    )


def in_the_body(body, states):
    """`eq01` in units b = 1 → `Biz131`: the units (b < 0 turns the vertical over), then the rotation by arctan a."""
    unit, r = sqrt(abs(body.b)), hypot(1.0, body.a)
    w1, w2 = unit * states[:, 0], unit * states[:, 1] * r
    n1, n2, n3 = copysign(1.0, body.b) * states[:, 2:].T
    return np.column_stack([w1, w2, n1, (n2 - body.a * n3) / r, (n3 + body.a * n2) / r])


def on_a_torus(name, body, h, phi, span, **options):
    """`track` on the torus f = 0, from n3 = −1 (on the separatrix from n3 = 1)."""

    def error(grade):
        found = track(body, h, 0.0, phi, span / sqrt(abs(body.b)), grade, 4.0)
        times = found.orbit.times[::40]
        start = 0 if h == 1 else -mpmath.ellipk(2 / (mpmath.mpf(h) + 1)) * mpmath.sqrt(2 / (mpmath.mpf(h) + 1))
        exact = in_the_body(body, oracle.pendulum(body.a, h, phi, times, since=start))
        return orbit_error(np.hstack([found.omega, found.gamma])[::40], exact)

    return Row(f"track: {name}", "closed form, loxodromic pendulum", error, **options)


def free(name, tensor, omega, times):
    """A motion without a field, from γ = UP."""
    body = SuslovBody(*tensor)
    once = cache(lambda: oracle.orbit_in_decimals(SUSLOV, [*omega, *UP], body.parameters, times, 30))

    def error(grade):
        found = free_motion(body, omega, UP, times, grade)
        return orbit_error(np.hstack([found.omega, found.gamma]), once())

    return Row(f"free Suslov: {name}", "Taylor series of `Biz131`, 30 digits", error)


def the_angle(name, tensor):
    """cos χ on both arcs, against its closed form with 40 digits."""

    def error(grade):
        exact = oracle.cos_chi(*tensor)
        return max(abs(scattering(SuslovBody(*tensor), grade, arc).cos_chi - exact) for arc in (1, -1))

    return Row(f"scattering, cos χ: {name}", "closed form", error)


def on_the_lock_boundary(name, a, **options):
    """Return the error in h, relative to h + 1, of the boundary's midpoint: the trace is 2 on the boundary."""

    def error(grade):
        h, f = lock_boundary(a, grade, points=7)[3]
        step = 1e-6 * (h + 1)
        traces = [exp(oracle.map_by_three_orbits(a, x, f, 40).log_trace) for x in (h, h + step)]
        return abs((traces[0] - 2) / (traces[1] - traces[0])) * 1e-6

    return Row(f"lock boundary: {name}", "three orbits, 40 digits", error, levels=("draft", "reference"), **options)


# ---- the rows ---------------------------------------------------------------------------------------------------

GENERIC = (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0)
START = (0.8, -0.4, 0.6, 0.0, 0.8)
UP = (0.6, 0.0, 0.8)
FIGURE_3, SLANTING = (2.44, 1.0, 0.0, 0.5), (2.0, 1.0, 0.3, 0.5)
HESS_START = (0.3, 0.9, 0.6, 0.0, 0.8)
GRAZING = (2.0, 0.0, 5e-7, 0.0, 1.0)  # h = 1, f = 1e-6
BOTTOM = -1 + 1e-12
HEAVY, LIGHT = (1e6, 1.0, 0.3, 200.0), (1.0, 1e-6, 3e-7, 5e-4)  # bodies, within a factor 2 of not being one

DEPTH = "f_max − f = 1e-12 f: its last place moves the turning points by 5e-11"
SADDLE = "the saddle amplifies the rounding of the start by e^t"
CLOSE = "of h − 1 = 2e-9 a double keeps 7 digits, and with it of the time that the passage takes"


def with_field(tensor):
    return (*tensor, 0.3, -0.5, 1.0)


ROWS = [
    # f
    vanishing("f = 1e-300, h = 1.5", 0.5, 1.5, 1e-300),
    vanishing(
        "f = 1e-100, h = 1",
        0.5,
        1.0,
        1e-100,
        admitted=says_so(0.5, 1.0, 1e-100, 3.0),
        because="the last place of h is f times 1e84",
    ),
    by_orbits("f = 1e-12, h = 1.5", 0.5, 1.5, 1e-12, digits=60),
    by_orbits("f = f_max (1 − 1e-12), h = 0.3", 0.5, 0.3, f_max(0.3) * (1 - 1e-12), floor=1e-10, because=DEPTH),
    a_map(
        "f = f_max, n3 = 0.4",
        0.5,
        curve_point(0.4)[0],
        f_max(curve_point(0.4)[0]),
        lambda: oracle.map_on_the_curve(0.5, 0.4),
        "closed form, on the curve",
        floor=1e-7,
        because="the last place of f moves the turning points by 1e-8",
    ),
    # h
    vanishing("h = −1 + 1e-12, f = 0", 0.5, BOTTOM, 0.0),
    by_orbits("h = −1 + 1e-12, f = f_max/2", 0.5, BOTTOM, 0.5 * f_max(BOTTOM)),
    vanishing("h = 1 + 1e-12, f = 0", 0.5, 1 + 1e-12, 0.0),
    by_orbits("h = 1 + 1e-12, f = 1e-12", 0.5, 1 + 1e-12, 1e-12, digits=60),
    by_orbits("h = 1 − 1e-9, f = −1e-3", 0.5, 1 - 1e-9, -1e-3),
    by_orbits("h = 1e8, f = 0.9 f_max", 0.5, 1e8, 0.9 * f_max(1e8)),
    # a
    without_a("a = 0", 1.5, 0.6),
    without_a("a = 0, h = 1 + 1e-9, f = 1e-9", 1 + 1e-9, 1e-9),
    by_orbits(
        "a = 10, h = 0.3, f = 1e-12",
        10.0,
        0.3,
        1e-12,
        digits=75,
        admitted=says_so(10.0, 0.3, 1e-12, 1e-7),
        floor=1e-7,
        because="|α| = 7e7 cancels to a trace of 6e-4",
    ),
    vanishing(
        "a = 50, h = 0.3, f = 0",
        50.0,
        0.3,
        0.0,
        admitted=says_so(50.0, 0.3, 0.0, 1.0),
        because="|α| = 1e40 cancels to a trace of 0",
    ),
    by_cycle("a = 50, h = 1e8, f = 1e4", 50.0, 1e8, 1e4),
    by_cycle("a = 1e4, h = 1.5, f = 0.6", 1e4, 1.5, 0.6),
    # orbits of eq01
    a_pendulum("f = 0, h = 0.3", 0.5, 0.3, 0.4, [1.0, 5.0, 20.0]),
    a_pendulum("separatrix, h = 1 exactly", 0.5, 1.0, pi / 2, [1.0, 5.0, 10.0]),
    an_orbit(
        "separatrix, h = 1, φ = 0.4",
        HESS,
        (2 * sin(0.4), 2 * cos(0.4), 0.0, 0.0, 1.0),
        (0.5, 1.0),
        [1.0, 5.0, 10.0],
        floor=1e-11,
        because=SADDLE,
    ),
    an_orbit(
        "separatrix grazed, h = 1 + 2e-9",
        HESS,
        (2 + 1e-9, 0.0, 0.0, 0.0, 1.0),
        (0.5, 1.0),
        [1.0, 12.0, 24.0],
        floor=1e-6,
        because=CLOSE,
    ),
    an_orbit(
        "separatrix grazed, h = 1, f = 1e-6", HESS, GRAZING, (0.5, 1.0), [1.0, 8.0, 16.0], floor=1e-9, because=SADDLE
    ),
    a_pendulum("h = −1 + 1e-12", 0.5, BOTTOM, 0.4, [1.0, 10.0, 100.0], speed=1.0),  # the unit of ω is √b, not 1e-6
    a_pendulum("h = 1e8", 0.5, 1e8, 0.4, [1e-5, 1e-4, 1e-2]),
    a_pendulum(
        "b = 1e-6, t = 1e6",
        0.5,
        0.3,
        0.4,
        [1e2, 1e3],
        b=1e-6,
        floor=1e-11,
        because="the last place of the start changes the period, 1e3/2π times over",
    ),
    a_pendulum("a = 1e4", 1e4, 1.5, 0.4, [0.001, 0.01, 0.1]),
    an_orbit("a = 0", HESS, HESS_START, (0.0, 1.0), [1.0, 5.0, 20.0]),
    an_orbit("n = (0, 0, −1)", HESS, (0.6, 1.2, 0.0, 0.0, -1.0), (0.75, 1.0), [1.0, 5.0, 10.0]),
    at_rest("at rest, n3 = 1, t = 1e6", HESS, 1.0, (0.75, 1.0)),
    # orbits of Biz131
    an_orbit("I11/I22 = 1e6", SUSLOV, (1e-3, 1.0, 0.6, 0.0, 0.8), with_field(HEAVY), [1.0, 10.0]),
    # ω2 may come to √(2E/I22) = 1000: that is the unit in which the state is O(1).
    an_orbit(
        "I11/I22 = 1e6, all energy in ω1",
        SUSLOV,
        (1.0, 0.0, 0.6, 0.0, 0.8),
        with_field(HEAVY),
        [0.1, 1.0],
        speed=1000.0,
    ),
    an_orbit("I22 = 1e-6", SUSLOV, (0.1, 10.0, 0.6, 0.0, 0.8), with_field(LIGHT), [0.001, 0.02]),
    an_orbit(
        "I13 = I23 = 0, b = 0, t = 1e4",
        SUSLOV,
        START,
        (2.0, 1.0, 0, 0, 0, 0, 0),
        [1.0, 100.0, 1e4],
        truth=lambda: oracle.steady_rotation(START[:2], START[2:], [1.0, 100.0, 1e4]),
        against="closed form, rotation",
    ),
    an_orbit("ω = 0", SUSLOV, (0.0, 0.0, 0.6, -0.8, 0.0), GENERIC, [1.0, 5.0, 20.0]),
    an_orbit("backward", SUSLOV, START, GENERIC, [-1.0, -5.0, -20.0]),
    # bodies of the Hess case on their tori
    on_a_torus("b3 = −1e6", HessBody(1.0, 0.5, -1e6), 1.7, 0.4, 20.0),
    on_a_torus("h = 1, f = 0, from the top", HessBody(1.0, 0.5, -1.0), 1.0, 0.4, 10.0, floor=1e-11, because=SADDLE),
    # motions without a field
    free("1e-300 off the line", FIGURE_3, (2.0, 1e-300), [1.0, 690.0, 692.0, 740.0]),
    free("1e-16 off a slanting line", SLANTING, (0.5, -0.3 + 1e-16), [1.0, 100.0, 130.0, 160.0]),
    free("I11/I22 = 1e6", (1e6, 1.0, 0.3, 0.5), (1e-3, 1.0), [1.0, 10.0]),
    free("I13, I23 = 0.01", (1.0, 1.0, 0.006, 0.008), (0.7, 0.7), [1.0, 100.0, 300.0]),
    the_angle("I11/I22 = 1e6", (1e6, 1.0, 0.0, 1.0)),
    the_angle("I23 = 3e-4, slanting", (2.0, 1.0, 2e-4, 3e-4)),
    the_angle("I13, I23 = 1e6", (1.0, 2.0, 1e6, -1e6)),
    on_the_lock_boundary("a = 1e-3", 1e-3),
    on_the_lock_boundary("a = 1e4", 1e4, floor=3e-8, because="h + 1 = 1e-8: of that the double h keeps 8 digits"),
    *extremes_ball.rows(an_orbit),
    *extremes_euler_poisson.rows(Row),
    *extremes_suslov.rows(Row),
    *special_motions.rows(Row),
]


# ---- tests ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("row", "name"), [pytest.param(row, name, id=f"{row.name} [{name}]") for row in ROWS for name in row.levels]
)
def test_an_extreme_case_is_right_within_the_promise_of_its_level(row, name):
    error = row.error(name)
    assert error <= row.bound(name) or row.admitted(name)


@pytest.fixture(scope="module", params=FIRST)
def unstable(request):
    """A system with starts at unstable equilibria and next to them, and where these motions truly are."""
    system = systems()[request.param]
    return system, [
        (*start, oracle.orbit_in_decimals(system, *map(list, start), 30))
        for start in unstable_starts(system, examples(12))
    ]


@pytest.mark.parametrize("name", PROMISE)
def test_next_to_an_unstable_equilibrium_no_error_is_more_than_its_estimate_says(unstable, name):
    """A run makes the same roundings as a more exact one there: with these as only difference 1e5 times too little."""
    system, starts = unstable
    found = [solve(system.at(p), y, t, name) for y, p, t, _ in starts]
    true = np.array(
        [np.max(oracle.distances(orbit.states, exact)) for orbit, (*_, exact) in zip(found, starts, strict=True)]
    )
    said = np.array([orbit.error_estimate for orbit in found])
    assert np.max(true / said) < 3.0
    # No false alarm: a start is moved by six roundings and more, and at the floor the largest of three runs counts.
    # With one processor's instructions the median of these twelve ratios was 104.
    assert np.median(said / np.maximum(true, 1e-16)) < 300.0


def much_slower(ratio):
    """State and parameters of a motion with all energy in ω1, which changes by 1/ratio: the unit of time is √ratio
    times too short."""
    return (1.0, 0.5, 0.6, 0.0, 0.8), with_field((ratio, 1.0, 0.3, 0.5))


@pytest.mark.parametrize("name", PROMISE)
@pytest.mark.parametrize("ratio", [1e12, 0.99e20])
def test_a_motion_much_slower_than_its_energy_allows_is_right(ratio, name):
    state, parameters = much_slower(ratio)
    found = solve(SUSLOV.at(parameters), state, [1.0, 5.0], name)
    exact = oracle.orbit_in_decimals(SUSLOV, state, parameters, [1.0, 5.0], digits=25)
    assert orbit_error(found.states, exact) <= PROMISE[name]


@pytest.mark.parametrize("ratio", [1.01e20, 1e300])
def test_moments_so_different_that_the_unit_of_time_says_nothing_are_refused(ratio):
    state, parameters = much_slower(ratio)
    with pytest.raises(InvalidParameter, match=re.escape("choose a ratio below 1e+20.")):
        solve(SUSLOV.at(parameters), state, [1.0, 5.0])


def main():
    """Write the measured rows as a table, with a column for each level."""
    lines = [
        "| extreme case | checked against | draft | standard | precise | reference |",
        "|---|---|---|---|---|---|",
    ]
    for row in ROWS:
        shown = []
        for column in PROMISE:
            key = "any" if row.levels == ANY else column
            error = row.error(key) if key in row.levels else None
            mark = "" if error is None or error <= row.bound(key) else " admitted" if row.admitted(key) else " ✗"
            shown.append("" if error is None else f"{error:.0e}{mark}")
        escaped = row.name.replace("|", r"\|")
        lines.append(f"| {escaped}{' ¹' if row.because else ''} | {row.against} | {' | '.join(shown)} |")
    lines += ["", *(f"¹ {row.name}: {row.because}.  " for row in ROWS if row.because)]
    write_measured(Path(__file__).with_name("README.md"), "\n".join(lines))


if __name__ == "__main__":
    main()
