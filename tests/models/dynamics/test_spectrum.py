"""All exponents and MEGNO: known spectra, the divergence of random bodies, exponents that are 0."""

import math

import numpy as np
from pytest import approx, mark, raises
from scipy.integrate import simpson

from hess_mechanics import System, lyapunov_exponent, lyapunov_spectrum, megno, solve, systems
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.spectrum import Exponent, kaplan_yorke
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import REFERENCE
from support.andoyer import GESS1
from support.deviations import deviations
from support.moved import from_moved_starts
from support.thorough import examples

SUSLOV = systems()["suslov"]
TURNING = SUSLOV.at((1.5, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)), (0.5, 1.2, 0.6, 0.0, 0.8)
"""A rotation at a constant rate."""
TOP = HeavyBody((1.0, 1.6, 2.1), (0.3, -0.5, 0.7), 6.0)
CHAOTIC = TOP, AndoyerSection(TOP, 4.0, 1.0).state_at(0.3, 0.2)
"""A motion that wanders everywhere; in the layers of gess1 orbits stick to islands for long."""


LORENZ = System(
    "lorenz of a test",
    lambda y, p: (p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - p[3] * y[1], y[0] * y[1] - p[2] * y[2]),
    "x y z",
    {"sigma": 10.0, "rho": 28.0, "beta": 8.0 / 3.0, "c": 1.0},
    example=(1.0, 2.0, 20.0),
)
"""The field of Lorenz 1963, whose exponents are 0.9056, 0, −14.572 (Sprott 2003)."""


def are_mostly(found, signs):
    """Return whether the signs of exponents, which an error can blur, are these for more than two fifths of motions."""
    return deviations(np.array([one.signs == signs for one in found]), 0.4) > 5.0


@mark.chaotic
def test_of_lorenz_they_are_those_of_the_literature():
    found = from_moved_starts(lambda: lyapunov_spectrum(*LORENZ.example_motion, 2000.0), 32)
    values, known = np.array([one.values for one in found]), np.array([0.9056, 0.0, -14.572])
    for i, error in enumerate((1e-4, 0.0, 1e-3)):
        assert abs(deviations(values[:, i], known[i], error)) < 5.0
        assert deviations(np.abs(values[:, i] - known[i]), 0.025, of_each=True) < -5.0
        # Each is right within its error.
        assert deviations([(one.values[i] - known[i]) ** 2 / one.errors[i] ** 2 for one in found], 4.0) < -5.0
    assert deviations([one.error_estimate for one in found], 0.03) < -5.0
    alone = from_moved_starts(lambda: lyapunov_exponent(*LORENZ.example_motion, 2000.0).value)
    assert abs(deviations(alone, known[0], 1e-4)) < 5.0
    # The divergence is the same everywhere.
    assert found[0].divergence == approx(-10.0 - 1.0 - 8.0 / 3.0, abs=1e-11)
    assert values.sum(axis=1) == approx(found[0].divergence, abs=1e-7)
    assert are_mostly(found, ("+", "0", "-"))
    dimensions, errors = np.transpose([one.dimension for one in found])
    assert abs(deviations(dimensions, 2.0621, 1e-4)) < 5.0
    assert deviations(errors, 2e-3) < -5.0


@mark.parametrize(
    ("p", "start", "time", "within"),
    [
        ((0.5, 3.0, 0.4, 0.2), (0.0, 0.0, 0.0), 300.0, 1e-12),
        # It comes to rest: there the rate is lost in round-off, and long before the end it is 0.
        ((0.5, 0.1, 0.5, 0.6), (4.0, -2.0, 1.0), 500.0, 1e-9),
    ],
)
def test_at_rest_they_are_the_eigenvalues_there(p, start, time, within):
    found = lyapunov_spectrum(LORENZ.at(p), start, time, REFERENCE)
    sigma, rho, beta, c = p
    middle, half = -0.5 * (sigma + c), math.sqrt(0.25 * (sigma - c) ** 2 + sigma * rho)
    exact = sorted((middle + half, middle - half, -beta), reverse=True)
    assert found.values == approx(exact, abs=within)
    assert found.divergence == approx(-(sigma + c + beta), abs=within)
    assert found.signs == tuple("+" if one > 0.0 else "-" for one in exact)
    # The growth of a neighbour in a direction of its own is off by a constant over the time.
    assert lyapunov_exponent(LORENZ.at(p), start, time, REFERENCE).value == approx(exact[0], abs=3.0 / time)


def test_their_sum_is_the_mean_divergence_of_random_bodies():
    draw = np.random.default_rng(16)
    for _ in range(examples(15)):
        p = (*draw.uniform(0.5, 3.0, 2), *draw.uniform(-0.7, 0.7, 2), *draw.uniform(-1.0, 1.0, 3))
        gamma = draw.normal(size=3)
        start = (*draw.uniform(-1.5, 1.5, 2), *(gamma / np.linalg.norm(gamma)))
        found = lyapunov_spectrum(SUSLOV.at(p), start, 60.0)
        # div ẏ = I23 ω1/I22 − I13 ω2/I11 along the orbit: no variational equation.
        states = solve(SUSLOV.at(p), start, np.linspace(0.0, 60.0, 6001)).states
        mean = simpson((p[3] * states[:, 0] / p[1] - p[2] * states[:, 1] / p[0])[1200:], dx=0.01) / 48.0
        assert found.values.sum() == approx(mean, abs=1e-6)
        assert found.divergence == approx(mean, abs=1e-6)


@mark.chaotic
def test_where_a_measure_forces_pairs_they_are_pairs_and_the_sum_is_0():
    found = from_moved_starts(lambda: lyapunov_spectrum(*CHAOTIC, 1000.0), 32)
    assert are_mostly(found, ("+", "0", "0", "0", "0", "-"))
    for one in found:
        assert one.divergence == 0.0
        assert one.values.sum() == approx(0.0, abs=1e-9)
        assert np.all(np.abs(one.values + one.values[::-1]) <= 3.0 * np.hypot(one.errors, one.errors[::-1]))
        assert one.dimension[0] == 3.0
    # Sums of pairs are far below the errors, which are those of the exponents.
    together = [abs(one.values[0] + one.values[-1]) / one.errors[0] for one in found]
    assert deviations(together, 1.0, of_each=True) < -5.0


def test_a_regular_motion_has_zeros_only_within_errors_that_know_its_growth_like_t():
    found = lyapunov_spectrum(*TURNING, 500.0)
    assert found.signs == ("0",) * 5
    assert found.error_estimate < 0.02
    assert found.divergence == 0.0


def test_a_dimension_is_that_of_kaplan_and_yorke():
    none = np.zeros(3)
    assert kaplan_yorke(np.array([0.0, -1.0, -2.0]), none, -3.0) == (1.0, 0.0)
    assert kaplan_yorke(np.array([-1.0, -2.0]), none[:2], -3.0)[0] == 0.0
    assert kaplan_yorke(np.array([1.0, 0.0, -1.0]), none, 0.0)[0] == 3.0
    dimension, error = kaplan_yorke(np.array([1.0, -4.0, -5.0]), np.array([0.1, 0.4, 0.0]), -8.0)
    assert (dimension, error) == (1.25, approx(math.hypot(0.1, 0.25 * 0.4) / 4.0))
    dimension, error = kaplan_yorke(np.array([1.0, 0.0, -4.0]), np.array([0.1, 0.0, 0.4]), -3.0, 0.1)
    assert (dimension, error) == (2.25, approx(math.hypot(0.1, 0.75 * 0.4) / 4.0))


def test_the_growth_of_a_regular_motion_falls_as_ln_t_over_t():
    times = np.array([100.0, 1000.0, 8000.0])
    motion = GESS1, AndoyerSection(GESS1, 20.0, 2.0).state_at(1.0, 0.1)
    found = np.array([lyapunov_exponent(*motion, span).value for span in times])
    # The neighbour goes away in proportion to t: what is left of λ t beside ln t does not grow.
    assert np.all(np.abs(found * times - np.log(times)) < 4.0)
    assert found[-1] < 2e-3


def test_a_regular_motion_is_told_from_a_chaotic_one_by_how_its_mean_falls():
    times = np.arange(1.0, 2001.0)
    falling, steady = np.log(1.0 + times) / times, np.full(times.size, 0.02)
    assert Exponent(times, falling, 0.0).is_regular
    assert not Exponent(times, steady, 0.0).is_regular
    # After so short a time nothing tells them apart yet.
    assert Exponent(times[:300], steady[:300], 0.0).is_regular


# ---- MEGNO ------------------------------------------------------------------------------------------------------


def test_megno_of_uniform_growth_is_known():
    # δ ∝ e^(λt): Y = λt, Ȳ = λt/2.  The centre of mass above, at rest: λ² = a1 μ.
    above = megno(HeavyBody((1.3, 1.3, 0.9), (0.0, 0.0, 1.0), 0.7), [(0.0, 0.0, 0.0, 0.0, 0.0, -1.0)], 100.0)
    assert above.values[0] == approx(math.sqrt(1.3 * 0.7) * 100.0 / 2.0, rel=1e-2)
    # A rotation at a constant rate parts from a faster one in proportion to t: Y → 2.
    body, start = TURNING
    assert megno(body, [start], 4000.0).values[0] == approx(2.0, abs=0.1)


@mark.chaotic
def test_chaotic_motions_are_recurrent_and_dissipative():
    """Lorenz: λ = 0.906, so Ȳ comes to about 45; fifty motions are none like another."""
    draw = np.random.default_rng(7)
    starts = np.array([1.0, 2.0, 20.0]) + draw.uniform(-1.0, 1.0, (examples(8), 3))
    found = megno(LORENZ.at(), starts, 100.0)
    assert found.chaotic.all()
    assert set(found.no_chaos) == {""}
    assert found.divergence == approx(-10.0 - 1.0 - 8.0 / 3.0, abs=1e-9)
    assert np.all(np.abs(found.divergence + 10.0 + 1.0 + 8.0 / 3.0) <= 3.0 * found.divergence_error)
    assert found.dissipative.all()


# ---- refusals ---------------------------------------------------------------------------------------------------

EXTREME = SUSLOV.at((1.0, 2.5, 0.6, 8.23e230, -1.0, -0.5, 0.7)), (0.5, 1.2, 0.6, 0.0, 0.8)
"""I23² is beyond double range: of the motion no digit is left."""


@mark.parametrize(
    "find", [lyapunov_exponent, lyapunov_spectrum, lambda body, y, span: complete(megno(body, [y], span))]
)
def test_what_has_no_exponents_is_refused(find):
    for motion, span, error, words in (
        (SUSLOV.example_motion, 0.0, InvalidParameter, "must be finite and at least"),
        (SUSLOV.example_motion, 1e300, WorkLimit, "time|too long"),
        # A round-off of 1e-16 over that is beyond double range.
        (SUSLOV.example_motion, -5e-324, InvalidParameter, "at least 1e-290: choose one such as 100"),
        (EXTREME, 50.0, WorkLimit, r"exceeds the range of double precision.* less extreme parameters"),
    ):
        with raises(error, match=words):
            find(*motion, span)
