"""Lyapunov exponents against the variational equations, rotation numbers against rotations that are known."""

from math import pi, sqrt

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import systems
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.lyapunov import MAX_RETURNS, Exponent, lyapunov_exponent
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from support.andoyer import GESS1, RIS
from support.lyapunov import finite_exponent

GOLDEN = (sqrt(5.0) - 1.0) / 2.0
CHAOTIC = HeavyBody((1.0, 1.6, 2.1), (0.3, -0.5, 0.7), 6.0), 4.0, 1.0, 0.3, 0.2
"""Body, h, f, l, L/G of a motion that wanders everywhere; in the layers of gess1 orbits stick to islands for long."""
REGULAR = [(RIS, -0.4, 0.0, 2.8, 0.3), (RIS, 0.0, 0.0, 2.8, 0.3), (GESS1, 20.0, 2.0, 1.0, 0.1)]


def state_of(case):
    body, h, f, l, x = case
    return body, AndoyerSection(body, h, f).state_at(l, x)


# ---- Exponents --------------------------------------------------------------------------------------------------


@mark.parametrize("case", [(GESS1, 50.0, 5.0, 0.0, 0.2), (RIS, 2.0, 1.0, 1.0, 0.1), CHAOTIC, *REGULAR])
@mark.parametrize("span", [5.0, -4.0])
def test_the_growth_up_to_a_time_is_that_of_the_variational_equations(case, span):
    body, state = state_of(case)
    found = lyapunov_exponent(body, state, span)
    assert found.times[-1] == approx(abs(span))
    assert found.value == approx(finite_exponent(body, state, span), abs=2e-5)


def test_every_earlier_rate_is_that_of_a_shorter_span():
    body, state = state_of(CHAOTIC)
    long = lyapunov_exponent(body, state, 8.0)
    for i in (3, len(long.times) // 2):
        assert long.rates[i] == approx(finite_exponent(body, state, float(long.times[i])), abs=2e-5)
    later = long.rates[len(long.rates) // 2 :]
    assert long.spread == approx(np.ptp(later))
    assert not long.rates.flags.writeable


@mark.parametrize("case", REGULAR)
def test_of_a_regular_motion_it_falls_as_ln_t_over_t(case):
    body, state = state_of(case)
    times = np.array([100.0, 1000.0, 8000.0])
    found = np.array([lyapunov_exponent(body, state, span).value for span in times])
    # The neighbour goes away in proportion to t: what is left of λ t beside ln t does not grow.
    assert np.all(np.abs(found * times - np.log(times)) < 4.0)
    assert found[-1] < 2e-3


def test_of_a_chaotic_motion_it_is_the_same_after_a_long_time_and_after_twice_that():
    body, state = state_of(CHAOTIC)
    one, other = (lyapunov_exponent(body, state, span) for span in (1500.0, 3000.0))
    assert one.value == approx(other.value, rel=0.05)
    assert one.value > 0.3
    assert one.spread < 0.1 * one.value


def test_beside_an_equilibrium_the_distance_grows_with_its_eigenvalue():
    """The centre of mass above, at rest, a1 = a2: M and γ fall at the rate √(a1 μ|r|), whatever the direction."""
    body = HeavyBody((1.3, 1.3, 0.9), (0.0, 0.0, 1.0), 0.7)
    found = lyapunov_exponent(body, (0.0, 0.0, 0.0, 0.0, 0.0, -1.0), 12.0)
    grown = found.rates * found.times
    third = len(grown) // 3
    slope = (grown[-1] - grown[third]) / (found.times[-1] - found.times[third])
    assert slope == approx(sqrt(1.3 * 0.7), rel=1e-3)


@mark.parametrize("system", systems().values(), ids=systems())
def test_any_system_has_one(system):
    found = lyapunov_exponent(*system.example_motion, 5.0)
    assert np.all(np.isfinite(found.rates))
    assert found.times[-1] == approx(5.0)


@mark.parametrize("span", [1e7, -1e7, 1e300])
def test_too_long_a_span_is_refused(span):
    with raises(WorkLimit, match=f"at most {MAX_RETURNS} are allowed: choose a shorter time span"):
        lyapunov_exponent(*SYSTEM.example_motion, span)


def test_a_very_short_span_has_one_rate():
    assert lyapunov_exponent(*SYSTEM.example_motion, 1e-9).rates.shape == (1,)


# ---- Rotation numbers -------------------------------------------------------------------------------------------


def circle(rho, count, bend=0.0, centre=(0.0, 0.0), first=0.3):
    """Points of a rotation, on an ellipse, with a change of the angle that leaves the rotation number."""
    phi = 2.0 * pi * rho * np.arange(count) + first
    phi = phi + bend * np.sin(phi)
    return np.column_stack([centre[0] + 0.7 * np.cos(phi), centre[1] + 0.2 * np.sin(phi)]), phi


# Next to 0 and ½ the points hardly leave their places on the curve: what is seen of it in 4000 is little.
@mark.parametrize(
    ("rho", "error"),
    [
        (GOLDEN - 1.0, 1e-9),
        (1.0 - GOLDEN, 1e-9),
        (sqrt(2.0) - 1.3, 1e-9),
        (1.0 / pi, 1e-9),
        (-0.4999, 2e-4),
        (0.499, 1e-6),
        (0.001, 1e-5),
    ],
)
@mark.parametrize("bend", [0.0, 0.4])
def test_the_number_of_a_rotation_in_other_coordinates_is_found(rho, error, bend):
    points, phi = circle(rho, 4000, bend, (1.2, -0.4))
    found, spread = rotation_number(points, (1.2, -0.4))
    assert found == approx(rho, abs=error)
    assert spread < 1e-3
    by_angle, _ = rotation_number(np.column_stack([np.angle(np.exp(1j * phi)), np.zeros_like(phi)]))
    assert by_angle == approx(found, abs=error)


def test_half_a_turn_is_half_a_turn_and_not_none():
    points, _ = circle(0.5, 501)
    assert rotation_number(points, (0.0, 0.0)) == (approx(0.5), approx(0.0, abs=1e-12))


@mark.parametrize("steps", [1, 2, 3])
def test_it_is_a_number_of_turns_up_to_whole_ones(steps):
    points, _ = circle(GOLDEN + steps, 2000)
    assert rotation_number(points, (0.0, 0.0))[0] == approx(GOLDEN - 1.0, abs=1e-10)


def test_points_without_order_are_no_closed_curve():
    random = np.random.default_rng(2)
    assert all(rotation_number(random.uniform(-1.0, 1.0, (500, 2)), (0.0, 0.0))[1] > 1e-3 for _ in range(10))


@mark.parametrize("count", [0, 1, 4])
def test_too_few_points_are_refused_in_a_sentence(count):
    with raises(InvalidParameter, match=f"there are {count}: follow it for longer"):
        rotation_number(circle(0.3, count)[0])


def test_a_regular_motion_is_told_from_a_chaotic_one_by_how_its_mean_falls():
    times = np.arange(1.0, 2001.0)
    falling, steady = np.log(1.0 + times) / times, np.full(times.size, 0.02)
    assert Exponent(times, falling, 0.0).is_regular
    assert not Exponent(times, steady, 0.0).is_regular
    # After so short a time nothing tells them apart yet.
    assert Exponent(times[:300], steady[:300], 0.0).is_regular
