"""MEGNO, the 0–1 test and averages on motions whose kind is known: at rest, escaping, in bands, on circles."""

import math

import numpy as np
from pytest import mark

from hess_mechanics import HeavyBody, System, lyapunov_exponent, megno
from hess_mechanics.dynamics.birkhoff import ensemble_mean, irregularity, window_rates
from hess_mechanics.dynamics.zero_one import zero_one_of_bands, zero_one_test
from support.thorough import examples

PENDULUM = System("pendulum of a test", lambda y, p: (y[1], -np.sin(y[0])), "x v", (), angles="x").at(())
SADDLE = System("saddle beside an oscillator", lambda y, p: (y[1], y[0], y[3], -p[0] * y[2]), "x v q p", {"k": 1.0}).at(
    (1.0,)
)
TOP = HeavyBody((1.3, 1.3, 0.9), (0.0, 0.0, 1.0), 0.7)
"""A top with its centre of mass on e3, which rests above the point of support."""


@mark.parametrize(
    ("body", "state", "t", "reason"),
    [
        (PENDULUM, (math.pi, 0.0), 50.0, "two dimensions"),
        (TOP, (0.0, 0.0, 0.0, 0.0, 0.0, -1.0), 50.0, "rests"),
        (SADDLE, (1.0, 0.0, 1.0, 0.0), 20.0, "escapes"),
        # The oscillator alone, whose neighbours leave along the saddle.
        (SADDLE, (0.0, 0.0, 1.0, 0.0), 20.0, "periodic"),
        # It comes to rest along the stable direction, to an error that grows to 1e-7.
        (SADDLE, (1.0, -1.0, 0.0, 0.0), 20.0, "rests"),
    ],
)
def test_motions_that_rest_close_or_escape_are_not_chaotic_however_their_neighbours_part(body, state, t, reason):
    found, exponent = megno(body, [state], t), lyapunov_exponent(body, state, t)
    # Neighbours part like e^(λt), and Ȳ grows like λt/2.
    assert found.values[0] > 3.0
    assert not found.chaotic[0]
    assert reason in found.no_chaos[0]
    assert not exponent.is_regular
    assert exponent.no_chaos == found.no_chaos[0]


def logistic(r, x, count):
    """Crossings x ↦ r x(1 − x) after a transient, (count, 1), and their exponent from the derivative."""
    for _ in range(2000):
        x = r * x * (1.0 - x)
    orbit = np.empty(count)
    for i in range(count):
        orbit[i] = x = r * x * (1.0 - x)
    return orbit[:, None], float(np.log(np.abs(r * (1.0 - 2.0 * orbit))).mean())


def test_chaos_in_narrow_bands_is_seen_in_every_nth_crossing_and_is_no_curve():
    """Beyond the limit of the doublings, r = 3.56994567, the attractor has 32, 16, 8, 4 and 2 bands."""
    draw, seen = np.random.default_rng(8), 0
    while seen < examples(10):
        orbit, exponent = logistic(draw.uniform(3.5701, 3.65), draw.uniform(0.1, 0.9), 12_800)
        # Between the chaotic values of r there are windows of periodic ones.
        if exponent > 0.01:
            seen += 1
            assert zero_one_of_bands(orbit[:, 0]) > 0.8
            assert irregularity((math.inf,), orbit, 1e-9) > 3e-3
    # Of all crossings of 32 bands it is blind.
    assert zero_one_test(logistic(3.5702, 0.3, 12_800)[0][:, 0]) < 0.5


@mark.parametrize("rho", [0.5 * (math.sqrt(5.0) - 1.0), math.sqrt(2.0) - 1.0, 0.1234567 * math.sqrt(3.0)])
def test_a_curve_is_one_and_a_long_period_is_not(rho):
    theta = 2.0 * math.pi * rho * np.arange(3200)
    places = np.column_stack([theta + 0.4 * np.sin(theta), np.exp(np.cos(theta))])
    assert irregularity((2.0 * math.pi, math.inf), places, 1e-9) < 3e-3
    assert zero_one_of_bands(places[:, 1]) < 0.8
    period = 2.0 * math.pi * np.arange(3200) * round(rho * 128) / 128
    assert irregularity((2.0 * math.pi,), period[:, None], 1e-9) == math.inf


def test_the_error_of_a_mean_knows_the_remainder_that_all_orbits_share():
    """∫(cos t + c) dt at equal phases: orbits that differ by nothing but 1e-9 share what is left of the cosine."""
    times = np.linspace(40.0, 200.0, 961)
    for omega in np.random.default_rng(9).uniform(0.05, 2.0, examples(40)):
        sums = [np.sin(omega * times + phase) / omega + 0.3 * times for phase in 0.7 + 1e-9 * np.arange(8)]
        mean, error = ensemble_mean(np.array([window_rates(one, times) for one in sums]))
        assert abs(mean - 0.3) <= 3.0 * error + 1e-9
        if omega > 1.0:
            assert error < 1e-2


def test_the_error_of_a_mean_of_noise_holds_in_997_of_1000_cases():
    draw, times, count, off = np.random.default_rng(10), np.linspace(0.0, 100.0, 1001), examples(300), []
    for _ in range(count):
        walks = np.cumsum(np.pad(draw.normal(size=(8, 1000)), ((0, 0), (1, 0))), axis=1)
        mean, error = ensemble_mean(np.array([window_rates(one, times) for one in walks]))
        off.append(abs(mean) > 3.0 * error)
    # 0.27 % are expected, at most; five standard deviations of a binomial more are allowed.
    assert np.sum(off) <= 0.0027 * count + 5.0 * math.sqrt(0.0027 * count)
