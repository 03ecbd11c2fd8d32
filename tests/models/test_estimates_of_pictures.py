"""Error estimates of sections, exponents, basins, rotation numbers and clouds against the true errors.

As for orbits, an estimate is right if the true error is at most ten times as large, in 99 of 100 random cases. The
position of the hundredth crossing of a chaotic orbit cannot be guaranteed: the estimate gives the number of correct
crossings of each orbit instead. Truths are closed forms, circle maps by other methods, or runs at `reference` that
are known to be a thousand times as exact.
"""

from functools import cache
from math import inf, pi

import numpy as np
from pytest import fixture, mark

from hess_mechanics import f_max
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import cloud_of, shell
from hess_mechanics.dynamics.basin_boundary import ambiguity, coarsest_cells
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.dynamics.shadowing import (
    count_correct_crossings,
    distances_to_curve,
    errors_in_pixels,
    lower_median,
)
from hess_mechanics.dynamics.spectrum import lyapunov_exponent
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.numerics.accuracy import PLANS, REFERENCE, Kind
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.suslov_section import SuslovSection
from hess_mechanics.suslov_hess.mode_locking import tongue_boundary
from hess_mechanics.suslov_hess.rotation_number import Torus, rotation_errors, rows, rows_error, values_at
from support.deviations import deviations

BELOW_THE_FLOOR = ("draft", "standard", "precise")
every_level_below_the_floor = mark.parametrize("name", BELOW_THE_FLOOR)


def within_a_factor_of_ten(errors, estimates):
    assert len(errors) >= 100
    return np.mean(np.asarray(errors) <= 10.0 * np.asarray(estimates)) >= 0.99


def random_body(random):
    return SuslovBody(*random.uniform(0.5, 3.0, 2), *random.uniform(-0.5, 0.5, 2), *random.normal(size=3))


# ---- sections ---------------------------------------------------------------------------------------------------

PIXELS, PERIODS = (300.0 / pi, 600.0 / pi), (2.0 * pi, inf)


def places(body, starts, level):
    where = SuslovSection(body, 0.0, 3)
    return [*map(where.points_of, section_crossings(where, starts, 60, level, threads=1).states)]


@fixture(scope="module")
def followed():
    """900 orbits of random bodies: crossings at each level and at its tightened one, and the true ones."""
    random = np.random.default_rng(20160801)
    rows = {name: ([], []) for name in BELOW_THE_FLOOR}
    truth = []
    for _ in range(300):
        body = random_body(random)
        starts = SuslovSection(body, random.uniform(0.2, 2.0), 3).spread(3)
        exact = places(body, starts, REFERENCE)
        truth += exact
        for name, runs in rows.items():
            level = PLANS[Kind.SECTION][name].level
            for run, one in zip(runs, (level, level.tighter()), strict=True):
                run.extend(places(body, starts, one))
    return rows, truth


@mark.chaotic
@every_level_below_the_floor
def test_up_to_the_crossing_that_is_named_an_orbit_is_where_it_is_drawn(followed, name):
    rows, truth = followed
    own, tight = rows[name]
    counts = count_correct_crossings(own, tight, PIXELS, PERIODS)
    worst = [
        errors_in_pixels(one[:count], exact[:count], PIXELS, PERIODS).max(initial=0.0)
        for one, exact, count in zip(own, truth, counts, strict=True)
    ]
    assert within_a_factor_of_ten(worst, np.full(len(worst), 0.5))
    # The estimate is not merely cautious: for most lost orbits it is within one crossing of the true one.
    true_counts = np.array(count_correct_crossings(own, truth, PIXELS, PERIODS))
    lost = true_counts < np.array([min(map(len, pair)) for pair in zip(own, truth, strict=True)])
    assert lost.sum() > 100
    assert deviations(np.abs(np.array(counts) - true_counts)[lost] <= 1, 0.5) > 5.0


def test_the_count_ends_with_the_first_point_that_is_wrong():
    exact = np.zeros((5, 2))
    wrong = np.array([[0.0, 0.0], [0.4, 0.0], [0.3, 0.5], [0.0, 0.0], [0.0, 0.0]])
    assert count_correct_crossings([wrong, exact, exact[:3]], [exact] * 3, (1.0, 1.0)) == (2, 5, 3)
    assert lower_median((9, 2, 5)) == 5
    assert lower_median((9, 2)) == 2
    assert lower_median(()) is None


# ---- exponents --------------------------------------------------------------------------------------------------


@fixture(scope="module")
def exponents():
    """100 random motions, regular and chaotic: over 200/ν, over five times that; in units of ν."""
    random = np.random.default_rng(7)
    level, rows = PLANS[Kind.EXPONENT]["draft"].level, []
    for _ in range(100):
        body, gamma = random_body(random), random.normal(size=3)
        state = (*random.normal(size=2), *gamma / np.linalg.norm(gamma))
        nu = Problem.of(body, [state]).nu
        short, long = (lyapunov_exponent(body, state, time / nu, level) for time in (200.0, 1000.0))
        rows.append((short.value / nu, short.spread / nu, long.value / nu))
    return np.array(rows).T


@mark.chaotic
def test_the_spread_of_an_exponent_is_its_error(exponents):
    value, spread, later = exponents
    assert within_a_factor_of_ten(np.abs(value - later), spread)
    assert deviations(np.abs(value - later) / spread, 10.0, of_each=True) < -5.0
    assert np.median(np.abs(value - later) / spread) > 0.1


# ---- basins -----------------------------------------------------------------------------------------------------


def basins_of_discs(random, m, n):
    """Cells (n, m), 1 inside one of some random discs and 0 outside, and the same with twice as many cells."""
    discs = np.column_stack([random.uniform(0.0, 1.0, (3, 2)), random.uniform(0.1, 0.4, 3)])
    for finer in (1, 2):
        x, y = np.meshgrid(*((np.arange(finer * count) + 0.5) / (finer * count) for count in (m, n)))
        yield np.any([np.hypot(x - a, y - b) < r for a, b, r in discs], axis=0).astype(float)


@mark.parametrize("name", ["draft", "standard"])
def test_the_boundary_tells_how_many_cells_a_finer_run_changes(name):
    random = np.random.default_rng(11)
    changed, estimates = [], []
    for _ in range(100):
        coarse, fine = basins_of_discs(random, *PLANS[Kind.BASINS][name].grid((36, 24)))
        changed.append(np.mean(np.kron(coarse, np.ones((2, 2))) != fine))
        estimates.append(ambiguity(coarse))
    assert within_a_factor_of_ten(changed, estimates)
    assert 0.5 < np.median(np.array(changed) / np.array(estimates)) < 2.0


def test_one_basin_alone_has_no_boundary():
    assert ambiguity(np.zeros((24, 36))) == 0.0
    assert ambiguity(np.array([[0.0, 1.0]])) == 0.125
    # Undivided cells count as one.
    coarse, fine = basins_of_discs(np.random.default_rng(2), 36, 24)
    assert np.array_equal(coarsest_cells(np.kron(coarse, np.ones((4, 4)))), coarse)
    assert coarsest_cells(fine) is fine


# ---- rotation numbers -------------------------------------------------------------------------------------------


@fixture(scope="module")
def tori():
    """100 random tori (a, h, f) whose map is elliptic, not within 1e-2 of locking, with ρ at the floor."""
    random = np.random.default_rng(13)
    a, h = random.uniform(0.05, 1.0, 700), random.uniform(-0.9, 3.0, 700)
    f = random.uniform(0.05, 0.95, 700) * np.array([f_max(one) for one in h])
    exact = values_at(a, h, f, REFERENCE)
    kept = np.flatnonzero(exact.trace < 1.99)[:100]
    assert kept.size == 100
    return a[kept], h[kept], f[kept], exact.rho[kept]


@every_level_below_the_floor
def test_a_rotation_number_of_a_grid_is_as_exact_as_it_says(tori, name):
    *where, exact = tori
    plan = PLANS[Kind.GRID][name]
    errors = np.abs(values_at(*where, plan.level).rho - exact)
    assert within_a_factor_of_ten(errors, rotation_errors(*where, plan.level))
    assert np.mean(errors <= plan.promise) >= 0.99


def test_the_error_of_a_map_of_rotation_numbers_is_that_of_nearly_all_its_cells():
    window, torus = ((-1.0, 4.0), (-3.0, 3.0)), Torus(0.5, 0.0, 0.0)
    for name in BELOW_THE_FLOOR:
        level = PLANS[Kind.GRID][name].level
        found, exact = (rows("h, f", torus, window, (60, 40), 0, 40, one).rho for one in (level, REFERENCE))
        away = np.abs(found - exact)[np.isfinite(exact)]
        estimate = rows_error("h, f", torus, window, level)
        assert np.mean(away <= 10.0 * estimate) >= 0.99
        assert np.quantile(away, 0.99) > 1e-3 * estimate
    # No motion exists below h = −1.
    assert rows_error("h, f", torus, ((-3.0, -2.0), (0.0, 1.0)), level) == 0.0


# ---- boundaries -------------------------------------------------------------------------------------------------


true_boundary = cache(lambda a: tongue_boundary(a, REFERENCE, 1500))


@mark.parametrize("name", PLANS[Kind.CURVE])
@mark.parametrize("a", [0.1, 1.0])
def test_the_boundary_of_the_lock_zone_lies_within_the_promised_pixels(a, name):
    plan = PLANS[Kind.CURVE][name]
    exact = true_boundary(a)
    points = plan.side(48)
    scale = 600.0 / np.array([max(4.0, exact[:, 0].max()) + 1.0, 2.0 * max(3.0, exact[:, 1].max())])
    line, curve = tongue_boundary(a, plan.level, points) * scale, exact * scale
    assert distances_to_curve(curve, line).max() <= plan.promise


# ---- clouds -----------------------------------------------------------------------------------------------------


@fixture(scope="module")
def clouds():
    """Bodies, states and times of 100 random clouds, and where these truly are."""
    random, found = np.random.default_rng(17), []
    for _ in range(100):
        body = BallBody(*random.uniform(0.5, 3.0, 2), *random.uniform(0.2, 1.0, 2), random.choice([0.0, 1.0, 5.0]))
        states = shell(body, random.uniform(0.5, 4.0), 0.1, 96)
        times = np.linspace(0.0, random.uniform(2.0, 10.0), 9)
        found.append((body, states, times, cloud_of(body, states, times, REFERENCE)))
    return found


@every_level_below_the_floor
def test_a_cloud_is_as_exact_as_the_points_that_are_computed_twice_say(clouds, name):
    level = PLANS[Kind.CLOUD][name].level
    errors, estimates = [], []
    for body, states, times, exact in clouds:
        found = cloud_of(body, states, times, level)
        fastest = float(np.abs(exact.omega).max())
        units = {"log_s": 1.0, "gamma": 1.0, "along": fastest}
        errors.append(max(np.abs(getattr(found, one) - getattr(exact, one)).max() / units[one] for one in units))
        estimates.append(found.error_estimate)
    assert within_a_factor_of_ten(errors, estimates)
    # A few points may exceed the estimate slightly.
    assert np.mean(np.array(errors) <= 3.0 * PLANS[Kind.CLOUD][name].promise) >= 0.99
