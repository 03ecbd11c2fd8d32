"""Crossings of sections at extreme parameters, against Taylor series at the same times."""

import mpmath
import numpy as np
from pytest import mark, param

import oracle
from hess_mechanics import HeavyBody, SuslovBody, section
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.suslov.suslov_section import SuslovSection
from support.andoyer import GESS1
from support.extremes import BARRIER, UPRIGHT, assert_promised, off


def suslov(E, k=3, I11=1.5, I22=3.0, I13=0.4, I23=0.4, b3=0.7):
    found = SuslovSection(SuslovBody(I11, I22, I13, I23, -0.5, -0.5, b3), E, k)
    return found, found.spread(1)[0], lambda states: states[:, k + 1]


def andoyer(h, f, place):
    def height(states):
        """G²γ3 − f M3, which vanishes at g = ±π/2, as a time."""
        G2 = np.sum(states[:, :3] ** 2, axis=1)
        return (G2 * states[:, 5] - f * states[:, 2]) / G2

    found = AndoyerSection(GESS1, h, f)
    return found, found.state_at(*place), height


LOWEST = suslov(0.0, b3=0.0)[0].lowest_energy
CROSSINGS = [
    param(suslov(LOWEST + 1e-9, b3=0.0), 1, 3, id="E at the bottom + 1e-9"),
    param(suslov(1e6), 1, 3, id="E = 1e6"),
    param(suslov(1.0, I11=1e6, I22=1.0), 1, 3, id="I11/I22 = 1e6"),
    param(suslov(0.3, k=1), 1, 2, id="γ1 = 0"),
    param(suslov(0.3), -1, 3, id="backward"),
    param(andoyer(50.0, 5.0, (0.7, BARRIER + 1e-9)), 1, 3, id="1e-9 off the Hess curve"),
    param(andoyer(50.0, 1e-9, (0.3, 0.4)), 1, 5, id="f = 1e-9"),
    param(andoyer(1e6, 5.0, (0.3, 0.4)), 1, 5, id="h = 1e6"),
]


@mark.parametrize(("case", "direction", "count"), CROSSINGS)
def test_crossings_are_on_the_orbit_and_on_the_plane(case, direction, count):
    where, start, height = case
    problem = Problem.of(where.body, [start])
    unit = problem.nu if len(start) == 5 else problem.scale[0]

    def crossings(name):
        found = section(where.body, start, where.surface, direction * 400.0 / problem.nu, name, count)
        assert found.times.size == count
        return found

    times = crossings("reference").times.tolist()
    exact = oracle.orbit_in_decimals(where.system, start, where.parameters, times, 36)
    rates = [where.system.field(y, where.parameters) for y in exact.astype(float).tolist()]

    def error(name):
        found = crossings(name)
        # The orbit is straight between the times of a level and those of `reference`, but for the square of that.
        there = exact + oracle.as_decimals((found.times - times)[:, None] * rates)
        return max(off(found.states, there, unit), np.max(np.abs(height(there.astype(float)))))

    assert_promised(error)


@mark.parametrize(
    ("body", "h", "f", "place"),
    [
        param(UPRIGHT, -0.7 + 1e-9, 1e-10, (0.3, 1.0 - 1e-9), id="h at the bottom"),
        param(GESS1, 50.0, 5.0, (-2.0, 1.0), id="x = 1"),
        param(HeavyBody.hess((1e6, 1.0, 1e-6), 9.975), 50.0, 1e-3, (0.82, 0.0236), id="moments 1e6, 1, 1e-6"),
    ],
)
def test_a_state_of_the_section_has_its_integrals(body, h, f, place):
    """With 40 digits, relative to the size of their terms."""
    state = AndoyerSection(body, h, f).state_at(*place)
    with mpmath.workdps(40):
        (*M, g1, g2, g3), dot = map(mpmath.mpf, state), mpmath.fdot
        gamma, G = (g1, g2, g3), mpmath.norm(M)
        energy = dot(body.a, [m * m for m in M]) / 2 - body.mu * dot(body.r, gamma)
        area, across = dot(M, gamma), (G**2 * g3 - f * M[2]) / G**2
        assert abs(energy - h) < 1e-12 * (abs(h) + body.strength)
        assert abs(area - f) < 1e-12 * G
        assert max(abs(across), abs(dot(gamma, gamma) - 1)) < 1e-12
