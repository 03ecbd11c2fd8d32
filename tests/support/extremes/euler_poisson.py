"""The rows of `test_extremes` for the Euler–Poisson equations and their Andoyer–Deprit section."""

import math
from functools import cache

import mpmath
import numpy as np

import oracle
from hess_mechanics import section, solve
from hess_mechanics.euler_poisson.andoyer import AndoyerPlane, AndoyerSection, hess_curve
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody

GESS1 = HeavyBody.hess((1.0, 0.625, 0.375), 9.975)
GAMMA = (0.36, 0.48, 0.8)
START = (1.3, -2.0, 0.7, *GAMMA)
UPRIGHT = HeavyBody((1.0, 1.6, 2.1), (0.0, 0.0, 1.0), 0.7)


def unit_of(body, state):
    """The momentum that counts as O(1): I_max √(2 a_max (T + 2μ|r|))."""
    a = np.array(body.a)
    kinetic = 0.5 * np.sum(a * np.array(state[:3]) ** 2)
    return math.sqrt(2.0 * a.max() * (kinetic + 2.0 * body.strength)) / a.min()


def an_orbit(Row, name, body, state, times, truth=None, against=None, digits=40, **options):
    @cache
    def once():
        return truth() if truth else oracle.orbit_in_decimals(SYSTEM, state, body.parameters, times, digits)

    def error(grade):
        found = solve(body, state, times, grade).states
        apart = oracle.distances(found, once())
        return float(max(np.max(apart[:, :3]) / unit_of(body, state), np.max(apart[:, 3:])))

    return Row(f"euler-poisson: {name}", against or f"Taylor series, {digits} digits", error, **options)


def crossings(Row, name, body, h, f, place, count, **options):
    """l and L/G of the first crossings, in units of 1, from a Taylor series with 40 digits at the same times.

    And how far g is from π/2 there, as a time.
    """
    state = AndoyerSection(body, h, f).state_at(*place)
    truth = oracle.Along(SYSTEM, state, body.parameters, 40)

    def error(grade):
        found = section(body, state, AndoyerPlane(f), 1e4, grade, count)
        exact = truth.at(found.times.tolist())
        apart = oracle.distances(found.states, exact)
        M, gamma = exact[:, :3].astype(float), exact[:, 3:].astype(float)
        G = np.linalg.norm(M, axis=1)
        across = np.abs(G**2 * gamma[:, 2] - f * M[:, 2]) / G**2
        return float(max(np.max(apart[:, :3]) / unit_of(body, state), np.max(apart[:, 3:]), np.max(across)))

    return Row(f"section g = π/2: {name}", "Taylor series, 40 digits", error, **options)


def a_state(Row, name, body, h, f, place, **options):
    """Energy, area integral and plane of the state at a place, with 40 digits, relative to the size of their terms."""

    def error(_):
        state = AndoyerSection(body, h, f).state_at(*place)
        with mpmath.workdps(40):
            M, gamma = [mpmath.mpf(x) for x in state[:3]], [mpmath.mpf(x) for x in state[3:]]
            kinetic = sum(mpmath.mpf(a) * m * m for a, m in zip(body.a, M, strict=True)) / 2
            energy = kinetic - mpmath.mpf(body.mu) * sum(mpmath.mpf(r) * g for r, g in zip(body.r, gamma, strict=True))
            G = mpmath.sqrt(sum(m * m for m in M))
            area = sum(m * g for m, g in zip(M, gamma, strict=True))
            across = (G**2 * gamma[2] - mpmath.mpf(f) * M[2]) / G**2
            return float(
                max(
                    abs(energy - h) / (abs(h) + body.strength),
                    abs(area - f) / G,
                    abs(across),
                    abs(sum(g * g for g in gamma) - 1),
                )
            )

    return Row(f"state on g = π/2: {name}", "its integrals, 40 digits", error, **options)


def rows(Row):
    """The rows."""

    def orbit(name, body, state, times, **options):
        return an_orbit(Row, name, body, state, times, **options)

    def hess(*moments):
        return HeavyBody.hess(moments, 9.975)

    l = 0.7
    barrier = float(hess_curve(GESS1, np.array([l]))[0])
    near = tuple(AndoyerSection(GESS1, 50.0, 5.0).state_at(l, barrier + small) for small in (1e-9, -1e-12))
    grows = "what rounds the start grows twenty-fold in each period of n3"
    return [
        orbit("gess1", GESS1, START, [1.0, 5.0]),
        orbit("1e-9 above the Hess manifold", GESS1, near[0], [0.5, 2.0], floor=1e-11, because=grows),
        orbit("h at the bottom + 1e-10", UPRIGHT, (1e-5, -5e-6, 0.0, 0.0, 0.0, 1.0), [1.0, 30.0]),
        orbit(
            "at rest above",
            UPRIGHT,
            (0.0, 0.0, 0.0, 0.0, 0.0, -1.0),
            [1e4],
            truth=lambda: np.array([[0.0, 0.0, 0.0, 0.0, 0.0, -1.0]]),
            against="equilibrium",
        ),
        orbit("moments 1, 1 − 1e-9, 1 − 2e-9", hess(1.0, 1.0 - 1e-9, 1.0 - 2e-9), START, [1.0, 5.0]),
        orbit("moments 1e6, 1, 1e-6", hess(1e6, 1.0, 1e-6), (1e3, 1.0, 1e-4, *GAMMA), [1e-5, 3e-4]),
        orbit("r = 0", HeavyBody((1.0, 1.6, 2.1), (0.0, 0.0, 0.0), 1.0), START, [1.0, 20.0]),
        orbit("μ|r| = 1e6", HeavyBody.hess((1.0, 0.625, 0.375), 1e6), START, [1e-3, 1e-2]),
        orbit("G = |f|, M along the vertical", GESS1, (1.8, 2.4, 4.0, *GAMMA), [1.0, 4.0]),
        crossings(Row, "1e-9 off the Hess curve", GESS1, 50.0, 5.0, (l, barrier + 1e-9), 3),
        crossings(Row, "f = 1e-9", GESS1, 50.0, 1e-9, (0.3, 0.4), 5),
        crossings(Row, "x = 0.999999", GESS1, 50.0, 5.0, (-2.0, 0.999999), 3),
        crossings(Row, "h = 1e6", GESS1, 1e6, 5.0, (0.3, 0.4), 5),
        a_state(Row, "h at the bottom", UPRIGHT, -0.7 + 1e-9, 1e-10, (0.3, 1.0 - 1e-9), levels=("any",)),
        a_state(Row, "x = 1", GESS1, 50.0, 5.0, (-2.0, 1.0), levels=("any",)),
        a_state(Row, "moments 1e6, 1, 1e-6", hess(1e6, 1.0, 1e-6), 50.0, 1e-3, (0.82, 0.0236), levels=("any",)),
    ]
