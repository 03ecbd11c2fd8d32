"""Clouds: orbits in decimals, volumes in closed form, densities.  Liouville's equation: `test_equations`."""

from math import cos, sin, sqrt

import numpy as np
from pytest import approx, mark
from scipy.stats import kstest, ttest_ind

import oracle
from hess_mechanics import level, systems
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import (
    cloud_of,
    divergence,
    frame_times,
    occupation,
    patch,
    shell,
)
from hess_mechanics.chaplygin_ball.phase_cloud_density import clouds, sides
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import LEVELS, Status
from support.ball import divergence as divergence_of
from support.ball import energy_of, rates
from support.mechanics import differences
from support.refusals import refused

BALL = systems()["ball"]
FREE = BallBody(2.0, 1.5, 0.5, 0.7, 0.0)
HEAVY = BallBody(1.0, 1.5, 0.7, 1.2, 3.0)
PRINCIPAL = BallBody(1.0, 1.5, 0.0, 0.0, 3.0, 0.4, -0.3, 1.0)
GENERAL = BallBody(1.0, 1.5, 0.7, 1.2, 3.0, 0.4, -0.3, 1.0)


@mark.parametrize("body", [FREE, HEAVY, PRINCIPAL, GENERAL])
def test_the_divergence_is_the_sum_of_the_exact_slopes(body):
    for y in np.array([[0.5, -0.75, 0.6, 0.0, 0.8], [-2.0, 1.25, 2 / 3, -1 / 3, 2 / 3]]):
        assert float(divergence(body, y[:2], y[2:])) == approx(divergence_of(body, y), rel=1e-14, abs=1e-15)


# ---- volumes ----------------------------------------------------------------------------------------------------


def growth_in_closed_form(body, states, t):
    """s(t)/s(0) for 𝒟 = 0: s ~ sech u, u = ω0 t + u0, div v = −ω0 tanh u."""
    w1, w2, *_ = states.T
    J2 = body.I13**2 + body.I23**2
    w = (body.I22 * body.I13**2 + body.I11 * body.I23**2) / J2
    rate = np.sqrt(J2 * w * (body.I11 * w1**2 + body.I22 * w2**2)) / (body.I11 * body.I22)
    u = np.arctanh((body.I13 * w2 / body.I11 - body.I23 * w1 / body.I22) / rate)
    return np.cosh(u) / np.cosh(u + rate * t), rate


# ---- orbits -----------------------------------------------------------------------------------------------------


@mark.parametrize("name", ["draft", "reference"])
@mark.parametrize(("body", "sense"), [(FREE, -1.0), (HEAVY, 1.0)], ids=["Suslov", "ball"])
def test_points_are_carried_along_the_orbits_within_the_promise(body, sense, name):
    states = shell(body, 2.0, 0.3, 33)
    times = sense * np.array([0.0, 0.5, 3.0, 7.0])
    found = cloud_of(body, states, times, name)
    nu = sqrt(2.0 * 2.6 / min(body.I11, body.I22))
    for i in (0, 16, 32):
        exact = np.array(oracle.orbit_in_decimals(BALL, list(states[i]), body.parameters, list(times), 40), float)
        s = np.array([body.I13, body.I23]) @ exact[:, :2].T
        assert np.max(np.abs(found.omega[i] - exact[:, :2])) < level(name).promise * nu
        assert np.max(np.abs(found.gamma[i] - exact[:, 2:])) < level(name).promise
        assert np.max(np.abs(found.log_s[i] - np.log(np.abs(s)))) < level(name).promise
        assert np.all(np.sign(s) == found.signs[i])
    assert found.status in (Status.OK, Status.FLOOR)
    assert found.error_estimate <= level(name).promise


def test_s_keeps_its_digits_where_doubles_would_have_lost_it():
    states = shell(FREE, 2.0, 0.1, 64)
    found = cloud_of(FREE, states, np.array([0.0, 250.0]), "precise")
    exact, _ = growth_in_closed_form(FREE, states, 250.0)
    assert np.all(found.log_s[:, 1] < -150.0)
    # The errors of the rate grow with time.
    assert found.log_growth[:, 1] == approx(np.log(exact), abs=1e-9)


# ---- points and densities ---------------------------------------------------------------------------------------


@mark.parametrize("body", [FREE, HEAVY], ids=["Suslov", "ball"])
def test_a_shell_is_evenly_filled(body):
    count, h, spread = 20_000, 2.0, 0.2
    states = shell(body, h, spread, count)
    E = energy_of(vars(body), states)
    assert np.all((h * (1 - spread) < E) & (h * (1 + spread) > E))
    assert np.linalg.norm(states[:, 2:], axis=1) == approx(np.ones(count), abs=1e-14)
    # Points of a box, evenly spread, of which those in the shell are kept.
    random = np.random.default_rng(5)
    most = sqrt(2 * h * (1 + spread) / min(body.I11, body.I22))
    gamma = random.normal(size=(400_000, 3))
    gamma /= np.linalg.norm(gamma, axis=1)[:, None]
    box = np.column_stack([random.uniform(-most, most, (len(gamma), 2)), gamma])
    kept = box[np.abs(energy_of(vars(body), box) - h) < h * spread]

    def moments(points):
        w1, w2, g1, g2, g3 = points.T
        return [w2 * g3, w1 * w2 * g1 * g2, w1**2 * g1**2, *points.T**2, energy_of(vars(body), points)]

    compared = ttest_ind(moments(states), moments(kept), axis=1, equal_var=False)
    assert np.abs(compared.statistic).max() < 4.5


def test_a_patch_is_evenly_filled():
    body, spread, angle = HEAVY, 0.4, 2.0
    states = patch(body, 2.0, angle, spread, 20_000)
    speed = sqrt(2.0 / energy_of(vars(body), [cos(angle), sin(angle), 0.0, 0.0, 1.0]))
    out = (states[:, :2] - speed * np.array([cos(angle), sin(angle)])) / (spread * speed)
    radius2 = (out**2).sum(axis=1)
    assert radius2.max() < 1.0
    for even in (radius2, (1.0 - states[:, 4]) / (1.0 - cos(spread))):
        assert kstest(even, "uniform").pvalue > 1e-4
    assert np.abs(out.mean(axis=0)).max() < 0.02


def test_on_the_average_over_time_the_density_is_the_invariant_one():
    states = shell(FREE, 2.0, 0.1, 5000)
    times = np.linspace(0.0, 40.0, 161)
    found = cloud_of(FREE, states, times, "standard")
    edges = np.arange(-40.0, 2.0, 1.0)
    share = occupation(found, edges)
    _, rate = growth_in_closed_form(FREE, states, 0.0)
    # Over ln|s| the density 1/|s| is even; each point spends 1/ω0 per unit, of 40.
    passed = (edges[:-1] > -18.0) & (edges[1:] < -4.0)
    assert share[passed] == approx(np.full(passed.sum(), np.mean(1.0 / rate) / 40.0), rel=5e-3)
    assert share.sum() * 1.0 == approx(1.0, abs=1e-3)


ODD = BallBody(1.64, 1.0, 0.0, 0.8, 0.0)
"""I11 I22 = I22² + k² I23² with k = 1, I13 = 0: F2 of the paper's (2.13) is an integral."""


def F2_by_hand(omega, gamma):
    return 1.64 * gamma[..., 0] * omega[..., 0] + (gamma[..., 1] + 0.8 * gamma[..., 2]) * omega[..., 1]


def test_a_density_that_vanishes_where_F2_does_is_invariant_and_nothing_crosses_that():
    # div(|F2| v/|s|) = 0 off F2 s = 0, by central differences.
    def flow(y):
        return np.array(rates(vars(ODD))(0.0, y)) * abs(F2_by_hand(y[:2], y[2:]) / (0.8 * y[1]))

    for y in np.random.default_rng(4).normal(size=(20, 5)):
        terms = np.diag(differences(flow, y, 1e-5))
        assert abs(terms.sum()) < 1e-7 * np.abs(terms).max()
    found = cloud_of(ODD, shell(ODD, 2.0, 0.1, 2000), np.linspace(0.0, 14.0, 29), "standard")
    values = F2_by_hand(found.omega, found.gamma)
    assert sides(found) == (np.sum(values[:, 0] > 1e-5), np.sum(values[:, 0] < -1e-5), 0)
    away = values[np.abs(values[:, 0]) > 1e-4]
    assert np.all(away[:, -1] * away[:, 0] > 0.0)


@mark.parametrize("end", [6.0, -6.0])
def test_the_entropy_gains_the_mean_of_the_logarithm(end):
    """−∫ρ ln ρ by its definition, of a density carried along: each point's is s(0)/s(t) times its first one."""
    found = cloud_of(FREE, shell(FREE, 2.0, 0.1, 2000), np.linspace(0.0, end, 13), "standard")
    first = 0.3
    density = first * np.exp(found.log_s[:, :1] - found.log_s)
    entropy = -np.log(density).mean(axis=0)
    assert entropy - entropy[0] == approx(found.log_growth.mean(axis=0), abs=1e-12)
    # Liouville's equation gives its rate: the mean divergence.
    slope = np.gradient(entropy, found.times)
    assert slope[2:-2] == approx(found.divergence.mean(axis=0)[2:-2], rel=0.1, abs=0.02)
    # The cloud gathers either way, as the scene says.
    assert entropy[-1] < entropy[0] - 1.0


def test_frames_are_close_enough_and_not_too_many():
    states = shell(FREE, 2.0, 0.1, 10_000)
    times = frame_times(FREE, states, 14.0)
    assert (times[0], times[-1]) == (0.0, 14.0)
    assert 5 * times.size * len(states) * 4 <= 6_000_000
    assert (times[1] - times[0]) * np.hypot(*states[:, :2].T).max() < 1.0


@mark.parametrize(("h", "t"), [(2.0, 0.0), (2.0, 5e-324), (5e-324, 1.0)])
def test_a_cloud_that_stands_still_has_the_density_of_its_start(h, t):
    """The share of time per unit of ln|s| of points that do not move is infinite."""
    found = clouds(FREE, h, None, 0.1, 50, t, None, "draft")
    assert np.all(found.cloud.log_growth == 0.0)
    assert (found.density.height, found.density.first.tolist()) == (np.inf, found.density.last.tolist())


# ---- refusals ---------------------------------------------------------------------------------------------------


START, ONE, DRAFT = np.array([0.8, -0.3, 0.48, 0.6, 0.64]), np.array([1.0]), LEVELS["draft"]


test_what_cannot_be_is_refused_with_a_sentence = refused(
    (lambda: cloud_of(BallBody(2.0, 1.0, 0.0, 0.0, 1.0), START[None], ONE, DRAFT), "I13 or I23"),
    (lambda: cloud_of(HEAVY, np.repeat(START[None], 10000, 0), 3000.0 * ONE, DRAFT), "choose", WorkLimit),
    (lambda: shell(FREE, 0.0, 0.1, 10), "h > 0"),
    (lambda: frame_times(FREE, shell(FREE, 2.0, 0.1, 10_000), 100.0), r"below [0-9.]+", WorkLimit),
)
