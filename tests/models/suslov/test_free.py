"""The Suslov problem without a field: closed form of ω, rotation of γ, limit circles, refusals."""

from math import sqrt

import numpy as np
from pytest import approx, mark

from hess_mechanics import SuslovBody, solve, systems
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.suslov.free import arcs, equilibria, free_motion, passage, sample_times
from support.mechanics import PROMISE
from support.refusals import refused

SUSLOV = systems()["suslov"]
FIGURE = SuslovBody(2.44, 1.0, 0.0, 0.5)
GENERIC = SuslovBody(2.0, 1.0, 0.3, 0.5)
UP = (0.6, 0.0, 0.8)


def test_motions_agree_with_the_general_solver_and_their_error_estimates_are_on_the_safe_side():
    rng = np.random.default_rng(4)
    cases = []
    for _ in range(100):
        body = SuslovBody(*10.0 ** rng.uniform(-1, 1, 2), *(10.0 ** rng.uniform(-1, 1, 2) * rng.choice([-1, 1], 2)))
        omega, gamma = rng.normal(size=2), rng.normal(size=3)
        gamma /= np.linalg.norm(gamma)
        times = np.sort(rng.uniform(0.0, 30.0, 5)) * rng.choice([-1, 1]) / passage(body, omega).rate
        exact = free_motion(body, omega, gamma, times, "reference")
        general = solve(body, (*omega, *gamma), times, "reference").states
        assert np.hstack([exact.omega / np.abs(omega).max(), exact.gamma]) == approx(
            general / np.repeat([np.abs(omega).max(), 1.0], [2, 3]), abs=1e-10
        )
        for name in ("draft", "standard", "precise"):
            found = free_motion(body, omega, gamma, times, name)
            error = np.max(np.abs(found.gamma - exact.gamma))
            assert error <= PROMISE[name] or found.status is not Status.OK
            cases.append((error, found.error_estimate))
    errors, estimates = np.array(cases).T
    assert np.mean(errors <= estimates) >= 0.99
    assert np.mean(estimates <= 1000 * np.maximum(errors, 1e-13)) >= 0.5


def test_a_moment_of_time_costs_nothing_however_long():
    near, far = (free_motion(GENERIC, (0.8, -0.2), UP, [t], "reference") for t in (40.0, 4e8))
    assert far.cost.steps <= near.cost.steps
    assert far.Gamma[0] == approx(near.limits[1], abs=1e-12)
    # 1e9 radians are known to 1e-7, and the estimate says so.
    assert 1e-8 < far.error_estimate < 1e-4
    assert far.status is Status.FLOOR


# ---- what it says about the picture -----------------------------------------------------------------------------


@mark.parametrize("omega", [(0.8, -0.2), (-1.0, 0.1)])
def test_limit_circles_are_where_the_motion_comes_from_and_goes(omega):
    rate = passage(GENERIC, omega).rate
    past, future = (free_motion(GENERIC, omega, UP, [t / rate], "reference") for t in (-35.0, 35.0))
    assert past.limits == approx(future.limits, abs=1e-13)
    assert (past.Gamma[0], future.Gamma[0]) == approx(past.limits, abs=1e-12)
    points = equilibria(GENERIC, GENERIC.I11 * omega[0] ** 2 / 2 + GENERIC.I22 * omega[1] ** 2 / 2)
    assert past.omega[0] == approx(points.unstable, abs=1e-12)
    assert future.omega[0] == approx(points.stable, abs=1e-12)


def test_fixed_points_are_those_of_the_corrected_formula():
    # biz138 with I22 in place of the second I23: I11 I23² + I22 I13² = 2·0.25 + 0.09 = 0.59.
    found = equilibria(GENERIC, 1.3)
    size = sqrt(2.6 / 0.59)
    assert found.stable == approx([-0.5 * size, 0.3 * size], rel=1e-14)
    assert found.unstable == approx([0.5 * size, -0.3 * size], rel=1e-14)
    assert found.rate == approx(sqrt(2 * 0.59 * 1.3) / 2, rel=1e-14)
    y = [*found.stable, *UP]
    assert SUSLOV.field(y, GENERIC.parameters)[:2] == approx((0.0, 0.0), abs=1e-15)
    # Stable: the eigenvalue of biz132 along the ellipse there is −ω0.
    w1, w2 = found.stable
    assert (-0.3 * w2 / 2 + 0.5 * w1) == approx(-found.rate, rel=1e-14)


def test_arcs_run_from_the_unstable_to_the_stable_point():
    points = equilibria(GENERIC, 1.3)
    for arc, sigma in zip(arcs(GENERIC, 1.3, 61), (1, -1), strict=True):
        assert arc[[0, -1]] == approx(np.array([points.unstable, points.stable]), abs=1e-14)
        assert arc[:, 0] ** 2 + arc[:, 1] ** 2 / 2 == approx(np.full(61, 1.3), rel=1e-14)
        assert np.all(sigma * arc[1:-1] @ (0.3, 0.5) > 0)
        assert passage(GENERIC, arc[20]).arc == sigma


# ---- samples ----------------------------------------------------------------------------------------------------


@mark.parametrize("span", [30.0, -30.0])
def test_samples_follow_the_curve(span):
    omega = (0.3, -0.4)
    times = sample_times(GENERIC, omega, span, (100.0, 300.0), 0.25, 6000)
    assert times[0] == 0.0
    assert times[-1] == span
    assert np.all(np.diff(times) * span > 0)
    assert times.size < 3000
    half = np.empty(2 * times.size - 1)
    half[::2], half[1::2] = times, 0.5 * (times[1:] + times[:-1])
    found = free_motion(GENERIC, omega, UP, half, "precise")
    for path, pixels in ((found.omega, 100.0), (found.gamma, 300.0)):
        chord = 0.5 * (path[:-2:2] + path[2::2])
        assert pixels * np.max(np.linalg.norm(path[1:-1:2] - chord, axis=1)) < 0.3


def test_a_motion_that_hardly_moves_is_sampled_from_its_beginning_to_its_end():
    body, span = SuslovBody(1.0, 1.0, 1.0, 1.0), 1.0
    times = sample_times(body, (0.0, 3.5e-145), span, (100.0, 300.0), 0.25, 6000)
    assert times == approx(np.linspace(0.0, span, 17))


def at_time(body, omega, time=1.0):
    return free_motion(body, omega, UP, [time], "standard")


test_what_is_no_free_motion_is_refused = refused(
    (lambda: at_time(SuslovBody(2.0, 1.0, 0.3, 0.5, b3=1.0), (1.0, 1.0)), "field.*Set b1 = b2 = b3 = 0"),
    (lambda: at_time(SuslovBody(2.0, 1.0, 0.0, 0.0), (1.0, 1.0)), "Choose a nonzero I13 or I23"),
    (lambda: at_time(GENERIC, (0.0, 0.0)), "at rest.*h = 0.*nonzero"),
    (lambda: at_time(FIGURE, (2.0, 0.0)), "line of equilibria.*turns about ξ for ever.*Move ω off"),
    (lambda: at_time(GENERIC, (1e308, 1e308)), "double precision"),
    (lambda: at_time(SuslovBody(2.0, 1.0, 0.0, 1e-5), (1.0, 0.5)), "larger I13 or I23", WorkLimit),
)
