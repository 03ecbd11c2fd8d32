"""The rows of `test_extremes` for sections of the Suslov problem, and for the rotation number over a, h, f."""

from functools import cache
from math import cos, isinf, pi

import mpmath
import numpy as np

import oracle
from hess_mechanics import SuslovBody, f_max, section
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.suslov_section import SuslovSection
from hess_mechanics.suslov_hess.rotation_number import values_at


def body_of(I11=1.5, I22=3.0, I13=0.4, I23=0.4):
    return SuslovBody(I11, I22, I13, I23, -0.5, -0.5, 0.7)


def crossings(Row, name, body, k, E, count=3, sense=1, **options):
    """Return a row for the first crossings: distance from a Taylor series, and of the series from the plane."""
    start = SuslovSection(body, E, k).spread(1)[0]
    nu = float(SYSTEM.frequency(np.array(start), np.array(body.parameters)))
    truth = oracle.Along(SYSTEM, start, body.parameters, 30)

    def error(grade):
        found = section(body, start, SuslovSection(body, E, k).surface, sense * 400.0 / nu, grade, count)
        if not found.times.size:
            return 1.0
        states = truth.at(found.times.tolist()).astype(float)
        apart = np.abs(found.states - states) / np.array([nu, nu, 1.0, 1.0, 1.0])
        return float(max(apart.max(), np.max(np.abs(states[:, k + 1]))))

    return Row(f"Suslov section: {name}", "Taylor series, 30 digits, at their times", error, **options)


def rotation(Row, name, torus, truth, against, **options):
    """Return a row for ρ, the trace (its logarithm beyond 700) and locking; truth() is the circle map."""
    once = cache(truth)

    def error(grade):
        with mpmath.workdps(40):
            half = abs(mpmath.re(once().A))
        found, locked = values_at(*torus, grade), half > 1
        rho = -float(mpmath.acos(min(half, mpmath.mpf(1))) / mpmath.pi)
        if mpmath.log(2 * half) > 700:
            apart = 0.0 if isinf(found.trace[0]) or found.trace[0] > 1e300 else 1.0
        else:
            apart = abs(float((found.trace[0] - 2 * half) / max(1, 2 * half)))
        # Where the maps turn by more than half a turn only the trace says which.
        turned = abs(cos(pi * found.rho[0]) - cos(pi * rho))
        return max(apart, turned, float(found.locked[0] != locked), float(not found.possible[0]))

    return Row(f"rotation number: {name}", against, error, **options)


def by_orbits(Row, name, torus):
    return rotation(Row, name, torus, lambda: oracle.map_by_three_orbits(*torus, 40), "three orbits, 40 digits")


def without_a(Row, name, h, f):
    return rotation(Row, name, (0.0, h, f), lambda: oracle.map_without_a(h, f), "closed form, Π(n, m)")


def on_the_curve(Row, name, a, n=0.4):
    h = (1.0 - 3.0 * n * n) / (2.0 * n)
    return rotation(Row, name, (a, h, f_max(h)), lambda: oracle.map_on_the_curve(a, n), "closed form, on the curve")


def by_cycle(Row, name, torus):
    def truth():
        return oracle.MoebiusMap(mpmath.exp(oracle.stable_cycle(*torus)[1]) / 2, 0)

    return rotation(Row, name, torus, truth, "the cycle, Fourier collocation")


def rows(Row):
    """The rows."""
    plain = body_of()
    flat = SuslovBody(1.5, 3.0, 0.4, 0.4, -0.5, -0.5, 0.0)
    return [
        crossings(Row, "γ3 = 0, E at the bottom + 1e-9", flat, 3, SuslovSection(flat, 0.0, 3).lowest_energy + 1e-9),
        crossings(Row, "γ3 = 0, E = 1e6", plain, 3, 1e6),
        crossings(Row, "γ3 = 0, I11/I22 = 1e6", body_of(I11=1e6, I22=1.0), 3, 1.0),
        crossings(Row, "γ3 = 0, I13 = I23 = 0", body_of(I13=0.0, I23=0.0), 3, 0.3),
        crossings(Row, "γ1 = 0", plain, 1, 0.3, 2),
        crossings(Row, "γ3 = 0, backward", plain, 3, 0.3, sense=-1),
        without_a(Row, "a = 0", 0.5, 0.5),
        by_cycle(Row, "a = 100, h = 1.5", (100.0, 1.5, 0.6)),
        on_the_curve(Row, "a = 100, f at its edge", 100.0),
        by_orbits(Row, "h = −1 + 1e-9", (0.5, -1.0 + 1e-9, 0.5 * f_max(-1.0 + 1e-9))),
        by_orbits(Row, "h = 1 + 1e-6, f = 1e-6", (0.5, 1.0 + 1e-6, 1e-6)),
    ]
