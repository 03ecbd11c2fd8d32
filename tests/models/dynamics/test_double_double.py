"""Orbits with 31 digits against decimal arithmetic with more digits."""

import decimal
import sys
from decimal import Decimal
from itertools import product

import mpmath
import numpy as np
import pytest

import oracle
from hess_mechanics import solve, systems
from hess_mechanics.dynamics.double_double import double_double_orbit
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.pairs_kernels import DOUBLE_DOUBLE_FUNCTIONS
from support.thorough import sample

SYSTEMS = systems()
TIMES = [0.0, 1.0, 5.0, 20.0]


def away(found, exact):
    """The largest difference of each component from decimals (n, d), in units in which states are O(1)."""
    with decimal.localcontext(prec=60):
        both = [
            [abs(Decimal(z.real) + Decimal(z.imag) - x) for z, x in zip(*rows, strict=True)]
            for rows in zip(found.pairs.tolist(), exact, strict=True)
        ]
    return float(np.max(np.array(both, float) / found.scale))


@pytest.mark.parametrize(("name", "direction"), sample(product(SYSTEMS, (1, -1)), 2))
def test_an_orbit_has_all_but_two_of_the_digits_of_a_pair_and_shows_the_error_of_another(name, direction):
    state, parameters = SYSTEMS[name].example
    motion, times = SYSTEMS[name].example_motion, [direction * t for t in TIMES]
    exact = oracle.orbit_in_decimals(SYSTEMS[name], state, parameters, times, digits=45)
    found = double_double_orbit(*motion, times)
    assert away(found, exact) < 1e-29
    orbit = solve(*motion, times, "reference")
    errors = found.errors_of(orbit.states)
    assert np.max(errors) == pytest.approx(np.max(oracle.distances(orbit.states, exact)), rel=1e-9)
    # In doubles the truth itself would be off by as much as that.
    assert 0.0 < np.max(errors) < 1e-12


@pytest.mark.parametrize(
    ("state", "parameters", "times"),
    [
        ((8e3, -4e3, 0.6, 0.0, 0.8), (2.0, 1.0, 0.3, 0.5, 3e7, -5e7, 1e8), [0.0, 1e-4, 5e-4, 2e-3]),
        ((0.0, 0.0, 0.6, -0.8, 0.0), (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0), TIMES),
    ],
    ids=["fast", "from rest"],
)
def test_no_unit_of_time_costs_digits(state, parameters, times):
    exact = oracle.orbit_in_decimals(SYSTEMS["suslov"], state, parameters, times, digits=45)
    assert away(double_double_orbit(SYSTEMS["suslov"].at(parameters), state, times), exact) < 1e-29


def test_many_times_are_those_of_one_orbit():
    """Times are worked on in parts, which begin where the one before has ended."""
    system, times = SYSTEMS["suslov"], np.linspace(0.0, 10.0, 101)
    many, few = (double_double_orbit(*system.example_motion, some) for some in (times, times[[0, 33, 100]]))
    assert np.abs((many.pairs[[0, 33, 100]] - few.pairs).imag).max() < 1e-29
    assert np.array_equal(many.states[[0, 33, 100]], few.states)


def test_what_cannot_be_followed_is_refused(monkeypatch):
    monkeypatch.setattr(sys.modules["hess_mechanics.dynamics.double_double"], "_MOST_STEPS", 1000)
    system = SYSTEMS["suslov"]
    with pytest.raises(WorkLimit, match="choose a shorter time span"):
        double_double_orbit(*system.example_motion, [1e6])
    with pytest.raises(InvalidParameter):
        double_double_orbit(system.at(), (np.nan,) * 5, [1.0])


@pytest.mark.parametrize("name", sample(DOUBLE_DOUBLE_FUNCTIONS, 3))
def test_functions_of_pairs_have_31_digits(name):
    draw = np.random.default_rng(5)
    for _ in range(20):
        x = draw.uniform(0.01, 0.99) if name in ("acos", "asin") else abs(3.0 * draw.normal())
        pairs = [complex(x, x * draw.uniform(-1e-17, 1e-17))]
        if name in ("atan2", "pow"):
            pairs.append(complex(draw.normal(), 0.0))
        found = DOUBLE_DOUBLE_FUNCTIONS[name](*pairs)
        with mpmath.workdps(40):
            exact = getattr(mpmath, name.replace("pow", "power"))(*(mpmath.mpf(z.real) + z.imag for z in pairs))
            off = abs(mpmath.mpf(found.real) + found.imag - exact) / max(1, abs(exact))
        assert off < 1e-28 if name == "tan" else off < 2e-31
