"""The rows of `test_extremes` for sections of the Suslov problem, and for the rotation number over a, h, f."""

import math
from functools import cache

import mpmath
import numpy as np

import oracle
from hess_mechanics import SuslovBody, f_max, level, section
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.section import SuslovSection
from hess_mechanics.suslov_hess.rotation_number import values_at

__all__ = ["rows"]

WHOLE = ((-math.pi, 0.0), (math.pi, math.pi))


def body_of(b=1.0, I11=1.5, I22=3.0, I13=0.4, I23=0.4):
    return SuslovBody(I11, I22, I13, I23, -0.5 * b, -0.5 * b, 0.7 * b)


def crossings(Row, name, body, k, E, count=3, sense=1, **options):
    """Return a row for the first crossings: distance from a Taylor series, and of the series from the plane."""
    start = SuslovSection(body, E, k).spread(WHOLE, 1)[0]
    nu = float(SYSTEM.frequency(np.array(start), np.array(body.parameters)))
    truth = oracle.Along(SYSTEM, start, body.parameters, 30)

    def error(grade):
        found = section(body, start, SuslovSection(body, E, k).surface, sense * 400.0 / nu, level(grade), count)
        if not found.times.size:
            return 1.0
        states = truth.at(found.times.tolist()).astype(float)
        apart = np.abs(found.states - states) / np.array([nu, nu, 1.0, 1.0, 1.0])
        return float(max(apart.max(), np.max(np.abs(states[:, k + 1]))))

    return Row(f"Suslov section: {name}", "Taylor series, 30 digits, at their times", error, **options)


def rotation(Row, name, a, h, f, half_trace, against, **options):
    """Return a row for ρ, the trace (its logarithm beyond 700) and locking; half_trace() is an mpmath number."""
    once = cache(half_trace)

    def error(grade):
        found, half = values_at(a, h, f, level(grade)), abs(once())
        locked = half > 1
        rho = -float(mpmath.acos(min(half, mpmath.mpf(1))) / mpmath.pi)
        if mpmath.log(2 * half) > 700:
            apart = 0.0 if math.isinf(found.trace[0]) or found.trace[0] > 1e300 else 1.0
        else:
            apart = abs(float((found.trace[0] - 2 * half) / max(1, 2 * half)))
        # Where the maps turn by more than half a turn only the trace says which.
        turned = abs(math.cos(math.pi * found.rho[0]) - math.cos(math.pi * rho))
        return max(apart, turned, float(found.locked[0] != locked), float(not found.possible[0]))

    return Row(f"rotation number: {name}", against, error, **options)


def on_the_curve(a, n):
    with mpmath.workdps(40):
        return mpmath.re(oracle.map_on_the_curve(mpmath.mpf(a), mpmath.mpf(n)).A)


def without_a(h, f):
    with mpmath.workdps(40):
        return mpmath.re(oracle.map_without_a(h, f).A)


def by_orbits(a, h, f):
    with mpmath.workdps(40):
        return mpmath.re(oracle.map_by_three_orbits(a, h, f, 40).A)


def by_cycle(a, h, f):
    _, log_trace = oracle.stable_cycle(a, h, f)
    return mpmath.exp(log_trace) / 2


def rows(Row):
    """The rows."""
    plain, strong, weak = body_of(), body_of(1e6), body_of(1e-6)
    flat = SuslovBody(1.5, 3.0, 0.4, 0.4, -0.5, -0.5, 0.0)
    n = 0.4
    h_n = (1.0 - 3.0 * n * n) / (2.0 * n)
    f_n = f_max(h_n)
    return [
        crossings(Row, "γ3 = 0, E at the bottom + 1e-9", flat, 3, SuslovSection(flat, 0.0, 3).lowest_energy + 1e-9),
        crossings(Row, "γ3 = 0, E = 1e6", plain, 3, 1e6),
        crossings(Row, "γ3 = 0, b = 1e6", strong, 3, 0.3e6),
        crossings(Row, "γ3 = 0, b = 1e-6", weak, 3, 0.3e-6),
        crossings(Row, "γ3 = 0, b = 0", body_of(0.0), 3, 1.0),
        crossings(Row, "γ3 = 0, I11/I22 = 1e6", body_of(I11=1e6, I22=1.0), 3, 1.0),
        crossings(Row, "γ3 = 0, I11/I22 = 1e-6", body_of(I11=1e-6, I22=1.0, I13=1e-3), 3, 1.0),
        crossings(Row, "γ3 = 0, I13 = I23 = 0", body_of(I13=0.0, I23=0.0), 3, 0.3),
        crossings(Row, "γ1 = 0", plain, 1, 0.3, 2),
        crossings(Row, "γ2 = 0", plain, 2, 0.3, 2),
        crossings(Row, "γ3 = 0, backward", plain, 3, 0.3, sense=-1),
        rotation(Row, "a = 0", 0.0, 0.5, 0.5, lambda: without_a(0.5, 0.5), "closed form, Π(n, m)"),
        rotation(Row, "a = 0, h = 1e6", 0.0, 1e6, 1.0, lambda: without_a(1e6, 1.0), "closed form, Π(n, m)"),
        rotation(
            Row,
            "a = 100, h = 1.5",
            100.0,
            1.5,
            0.6,
            lambda: by_cycle(100.0, 1.5, 0.6),
            "the cycle, Fourier collocation",
        ),
        rotation(
            Row, "a = 100, f at its edge", 100.0, h_n, f_n, lambda: on_the_curve(100.0, n), "closed form, on the curve"
        ),
        rotation(Row, "f at its edge", 0.5, h_n, f_n, lambda: on_the_curve(0.5, n), "closed form, on the curve"),
        rotation(
            Row,
            "h = −1 + 1e-9",
            0.5,
            -1.0 + 1e-9,
            0.5 * f_max(-1.0 + 1e-9),
            lambda: by_orbits(0.5, -1.0 + 1e-9, 0.5 * f_max(-1.0 + 1e-9)),
            "three orbits, 40 digits",
        ),
        rotation(
            Row,
            "h = 1 + 1e-6, f = 1e-6",
            0.5,
            1.0 + 1e-6,
            1e-6,
            lambda: by_orbits(0.5, 1.0 + 1e-6, 1e-6),
            "three orbits, 40 digits",
        ),
    ]
