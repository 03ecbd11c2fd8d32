"""Lyapunov exponents against differences of motions."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics.dynamics.orbit import MAX_SAMPLES
from hess_mechanics.dynamics.spectrum import Exponent, lyapunov_exponent
from hess_mechanics.errors import WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from support.andoyer import GESS1, RIS
from support.deviations import deviations, mean_of
from support.mechanics import scipy_states
from support.moved import from_moved_starts
from support.thorough import sample

_STEP = 1e-7


def finite_exponent(body, state, span):
    """Return the exponent from central differences of motions of hh01 by SciPy.

    Directions and lengths are in units of the largest velocity ν = √(2 max(a)(T + 2μ|r|)) and of M = I ω.
    """
    a = np.array(body.a)
    kinetic = 0.5 * np.sum(a * np.array(state[:3]) ** 2)
    unit = math.sqrt(2.0 * a.max() * (kinetic + 2.0 * body.strength)) / a.min()
    scale = np.array([unit, unit, unit, 1.0, 1.0, 1.0])
    direction = np.cos(1.0 + np.arange(6) ** 2)
    direction *= scale / np.linalg.norm(direction)
    ahead, behind = (
        scipy_states(body.system, state + step * direction, body.parameters, [span])[0] for step in (_STEP, -_STEP)
    )
    return math.log(np.linalg.norm((ahead - behind) / scale) / (2.0 * _STEP)) / abs(span)


CHAOTIC = HeavyBody((1.0, 1.6, 2.1), (0.3, -0.5, 0.7), 6.0), 4.0, 1.0, 0.3, 0.2
"""Body, h, f, l, L/G of a motion that wanders everywhere; in the layers of gess1 orbits stick to islands for long."""
REGULAR = [(RIS, -0.4, 0.0, 2.8, 0.3), (RIS, 0.0, 0.0, 2.8, 0.3), (GESS1, 20.0, 2.0, 1.0, 0.1)]


def state_of(case):
    body, h, f, l, x = case
    return body, AndoyerSection(body, h, f).state_at(l, x)


@mark.parametrize("case", [(GESS1, 50.0, 5.0, 0.0, 0.2), (RIS, 2.0, 1.0, 1.0, 0.1), CHAOTIC, *REGULAR])
@mark.parametrize("span", [5.0, -4.0])
def test_the_growth_up_to_a_time_is_that_of_differences(case, span):
    body, state = state_of(case)
    found = lyapunov_exponent(body, state, span)
    assert found.times[-1] == approx(abs(span))
    assert found.value == approx(finite_exponent(body, state, span), abs=2e-5)
    assert found.spread == approx(np.ptp(found.rates[len(found.rates) // 2 :]))


@mark.parametrize("case", sample(REGULAR, 2))
def test_of_a_regular_motion_it_falls_as_ln_t_over_t(case):
    body, state = state_of(case)
    times = np.array([100.0, 1000.0, 8000.0])
    found = np.array([lyapunov_exponent(body, state, span).value for span in times])
    # The neighbour goes away in proportion to t: what is left of λ t beside ln t does not grow.
    assert np.all(np.abs(found * times - np.log(times)) < 4.0)
    assert found[-1] < 2e-3


@mark.chaotic
def test_of_a_chaotic_motion_it_is_the_same_after_a_long_time_and_after_twice_that():
    body, state = state_of(CHAOTIC)
    one, other = (
        from_moved_starts(lambda span=span: lyapunov_exponent(body, state, span), 12) for span in (1000.0, 2000.0)
    )
    values = [found.value for found in one]
    assert abs(deviations(values, *mean_of([found.value for found in other]))) < 5.0
    assert deviations(values, 0.3, of_each=True) > 5.0
    assert deviations([found.spread / found.value for found in one], 0.1) < -5.0


@mark.parametrize("span", [1e7, -1e7, 1e300])
def test_too_long_a_span_is_refused(span):
    with raises(WorkLimit, match=f"at most {MAX_SAMPLES} are allowed: choose a shorter time span"):
        lyapunov_exponent(*SYSTEM.example_motion, span)


def test_a_very_short_span_has_one_rate():
    assert lyapunov_exponent(*SYSTEM.example_motion, 1e-9).rates.shape == (1,)


def test_a_regular_motion_is_told_from_a_chaotic_one_by_how_its_mean_falls():
    times = np.arange(1.0, 2001.0)
    falling, steady = np.log(1.0 + times) / times, np.full(times.size, 0.02)
    assert Exponent(times, falling, 0.0).is_regular
    assert not Exponent(times, steady, 0.0).is_regular
    # After so short a time nothing tells them apart yet.
    assert Exponent(times[:300], steady[:300], 0.0).is_regular
