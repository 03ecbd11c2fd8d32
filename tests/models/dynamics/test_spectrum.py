"""All exponents and MEGNO: known spectra, the divergence of random bodies, exponents that are 0."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import System, lyapunov_exponent, lyapunov_spectrum, megno, systems
from hess_mechanics.dynamics.basins import mean_divergence
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.spectrum import kaplan_yorke
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.numerics.accuracy import DRAFT, REFERENCE
from hess_mechanics.suslov.equations import SuslovBody
from support.deviations import deviations, mean_of
from support.moved import from_moved_starts
from support.thorough import examples

SUSLOV = systems()["suslov"]
STRANGE = (0.8, 1.3, 0.6, 0.0, 0.8), (1.7, 3.0, 0.3, 0.1, -2.0, -2.1, 2.6)
"""State and parameters on a strange attractor, found in a search of random bodies."""
CHAOTIC = HeavyBody((1.0, 1.6, 2.1), (0.3, -0.5, 0.7), 6.0)
CHAOTIC_START = AndoyerSection(CHAOTIC, 4.0, 1.0).state_at(0.3, 0.2)


def a_system(name, field, variables, parameters, example):
    """A system of its own, in units of time as given."""
    return System(
        name,
        field,
        variables,
        parameters,
        example=example,
        angular_velocities=0,
        frequency=lambda y, p: np.ones_like(y[0]),
        rescale=lambda y, p, nu: (y, p),
    )


ALONE = a_system("one variable of a test", lambda y, p: (p[0] - p[1] * y[0],), "x", {"c": 0.3, "k": 0.7}, (4.0,))
LORENZ = a_system(
    "lorenz of a test",
    lambda y, p: (p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - p[3] * y[1], y[0] * y[1] - p[2] * y[2]),
    "x y z",
    {"sigma": 10.0, "rho": 28.0, "beta": 8.0 / 3.0, "c": 1.0},
    (1.0, 2.0, 20.0),
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
    # The divergence is the same everywhere.
    assert found[0].divergence == approx(-10.0 - 1.0 - 8.0 / 3.0, abs=1e-11)
    assert values.sum(axis=1) == approx(found[0].divergence, abs=1e-7)
    assert are_mostly(found, ("+", "0", "-"))
    dimensions, errors = np.transpose([one.dimension for one in found])
    assert abs(deviations(dimensions, 2.0621, 1e-4)) < 5.0
    assert deviations(errors, 2e-3) < -5.0


def eigenvalues_at_rest(sigma, rho, beta, c):
    """Those of the field of Lorenz at x = y = z = 0, the largest first."""
    middle, half = -0.5 * (sigma + c), math.sqrt(0.25 * (sigma - c) ** 2 + sigma * rho)
    return sorted((middle + half, middle - half, -beta), reverse=True)


def test_of_a_motion_at_rest_they_are_the_eigenvalues_there():
    p = 0.5, 3.0, 0.4, 0.2
    found = lyapunov_spectrum(LORENZ.at(p), (0.0, 0.0, 0.0), 300.0, REFERENCE)
    first, second, third = eigenvalues_at_rest(*p)
    assert found.values == approx([first, second, third], abs=1e-12)
    assert found.error_estimate < 1e-11
    assert found.divergence == approx(-1.1, abs=1e-13)
    assert found.signs == ("+", "-", "-")
    assert found.dimension[0] == approx(2.0 - (first + second) / third, abs=1e-10)


def test_of_a_motion_that_comes_to_rest_they_are_the_eigenvalues_there():
    # Near rest the rate is lost in round-off, and long before the end it is 0.
    p = 0.5, 0.1, 0.5, 0.6
    found = lyapunov_spectrum(LORENZ.at(p), (4.0, -2.0, 1.0), 500.0, REFERENCE)
    assert found.values == approx(eigenvalues_at_rest(*p), abs=1e-9)
    assert found.values.sum() == approx(found.divergence, abs=1e-10)
    assert found.signs == ("-", "-", "-")


def test_their_sum_is_the_mean_divergence_of_random_bodies():
    draw = np.random.default_rng(16)
    for _ in range(examples(15)):
        p = (*draw.uniform(0.5, 3.0, 2), *draw.uniform(-0.7, 0.7, 2), *draw.uniform(-1.0, 1.0, 3))
        gamma = draw.normal(size=3)
        start = (*draw.uniform(-1.5, 1.5, 2), *(gamma / np.linalg.norm(gamma)))
        found = lyapunov_spectrum(SUSLOV.at(p), start, 60.0, DRAFT)
        # By SciPy-like sums of div ẏ = I23 ω1/I22 − I13 ω2/I11 along the orbit: no variational equation.
        course = mean_divergence(SuslovBody(*map(float, p)), start, 60.0)
        since = len(course.times) // 5
        mean = (course.mean[-1] * 60.0 - course.mean[since - 1] * 12.0) / 48.0
        assert found.values.sum() == approx(mean, abs=1e-3)
        assert abs(found.values.sum() - mean) < 3.0 * (found.errors.sum() + found.divergence_error)
        assert found.values.sum() == approx(found.divergence, abs=1e-4)  # a draft's steps


@mark.chaotic
def test_of_a_strange_attractor_three_are_0_and_it_has_a_dimension_between_two_and_three():
    body = SUSLOV.at(STRANGE[1])
    found = from_moved_starts(lambda: lyapunov_spectrum(body, STRANGE[0], 3000.0), 32)
    twins = from_moved_starts(lambda: lyapunov_exponent(body, STRANGE[0], 3000.0).value)
    assert abs(deviations([one.values[0] for one in found], *mean_of(twins))) < 5.0
    # Those of the motion, of E and of γ².
    assert are_mostly(found, ("+", "0", "0", "0", "-"))
    assert deviations([one.divergence / one.divergence_error for one in found], -3.0) < -5.0
    for one in found:
        # The sum of the first two, the divergence without the last one, over the last one.
        assert one.dimension[0] == approx(2.0 + (one.divergence - one.values[-1]) / -one.values[-1], abs=1e-12)
    dimensions, errors = np.transpose([one.dimension for one in found])
    assert deviations(dimensions, 2.0, of_each=True) > 5.0 > -5.0 > deviations(dimensions, 3.0, of_each=True)
    assert deviations(errors, 0.2) < -5.0


@mark.chaotic
def test_where_a_measure_forces_pairs_they_are_pairs_and_the_sum_is_0():
    found = from_moved_starts(lambda: lyapunov_spectrum(CHAOTIC, CHAOTIC_START, 1000.0), 32)
    assert are_mostly(found, ("+", "0", "0", "0", "0", "-"))
    for one in found:
        assert one.divergence == 0.0
        assert one.values.sum() == approx(0.0, abs=1e-9)
        assert np.all(np.abs(one.values + one.values[::-1]) <= 3.0 * np.hypot(one.errors, one.errors[::-1]))
        assert one.dimension[0] == 3.0
    # Sums of pairs are far below the errors, which are those of the exponents.
    together = [abs(one.values[0] + one.values[-1]) / one.errors[0] for one in found]
    assert deviations(together, 1.0, of_each=True) < -5.0
    # I13 = I23 = 0 keeps the volume too, but says so by numbers only.
    body = SUSLOV.at((1.7, 3.0, 0.0, 0.0, -2.0, -2.1, 2.6))
    conservative = lyapunov_spectrum(body, STRANGE[0], 100.0, DRAFT)
    assert conservative.divergence == 0.0


def test_a_regular_motion_has_zeros_only_within_errors_that_know_its_growth_like_t():
    body = SUSLOV.at((1.5, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    found = lyapunov_spectrum(body, (0.5, 1.2, 0.6, 0.0, 0.8), 500.0)
    assert found.signs == ("0",) * 5
    assert found.zeros == 5
    assert found.error_estimate < 0.02


def test_a_dimension_is_that_of_kaplan_and_yorke():
    none = np.zeros(3)
    assert kaplan_yorke(np.array([0.0, -1.0, -2.0]), none, -3.0) == (1.0, 0.0)
    assert kaplan_yorke(np.array([-1.0, -2.0]), none[:2], -3.0)[0] == 0.0
    assert kaplan_yorke(np.array([1.0, 0.0, -1.0]), none, 0.0)[0] == 3.0
    dimension, error = kaplan_yorke(np.array([1.0, -4.0, -5.0]), np.array([0.1, 0.4, 0.0]), -8.0)
    assert (dimension, error) == (1.25, approx(math.hypot(0.1, 0.25 * 0.4) / 4.0))
    dimension, error = kaplan_yorke(np.array([1.0, 0.0, -4.0]), np.array([0.1, 0.0, 0.4]), -3.0, 0.1)
    assert (dimension, error) == (2.25, approx(math.hypot(0.1, 0.75 * 0.4) / 4.0))
    assert kaplan_yorke(np.array([]), np.array([]), 0.0) == (0.0, 0.0)


@mark.parametrize(
    ("span", "error", "words"),
    [
        (0.0, InvalidParameter, "must be a finite nonzero number"),
        (1e300, WorkLimit, "time"),
        # A round-off of 1e-16 over that is beyond double range.
        (-5e-324, InvalidParameter, "of 1e-290 or more: choose one like 100"),
    ],
)
@mark.parametrize("find", [lyapunov_spectrum, lyapunov_exponent, lambda body, y, span: megno(body, [y], span)])
def test_a_span_that_is_none_or_too_long_is_refused(find, span, error, words):
    with raises(error, match=words):
        find(*SUSLOV.example_motion, span)


EXTREME = {
    "ball": ((1.0, 4.0, 1.37e179, 0.0, 2.0, 0.3, 0.0, 1.0), (0.5, 0.9, 0.6, 0.0, 0.8)),
    "suslov": ((1.0, 2.5, 0.6, 8.23e230, -1.0, -0.5, 0.7), (0.5, 1.2, 0.6, 0.0, 0.8)),
}
"""I13² or I23² is beyond double range: of the motion no digit is left."""


@mark.parametrize("name", EXTREME)
@mark.parametrize(
    "find",
    [
        lyapunov_exponent,
        lambda *given: lyapunov_spectrum(*given, DRAFT),
        lambda body, y, t: complete(megno(body, [y], t, DRAFT, 1)),
    ],
)
def test_of_a_motion_beyond_double_range_there_is_a_sentence_and_no_number(find, name):
    parameters, state = EXTREME[name]
    with raises(WorkLimit, match=r"exceeds the range of double precision.* less extreme parameters"):
        find(systems()[name].at(parameters), state, 50.0)


# ---- MEGNO ------------------------------------------------------------------------------------------------------


def test_megno_of_uniform_growth_is_known():
    # δ ∝ e^(λt): Y = λt, Ȳ = λt/2.  The centre of mass above, at rest: λ² = a1 μ.
    above = megno(HeavyBody((1.3, 1.3, 0.9), (0.0, 0.0, 1.0), 0.7), [(0.0, 0.0, 0.0, 0.0, 0.0, -1.0)], 100.0)
    assert above.values[0] == approx(math.sqrt(1.3 * 0.7) * 100.0 / 2.0, rel=1e-2)
    # A rotation at a constant rate parts from a faster one in proportion to t: Y → 2.
    turning = SUSLOV.at((1.5, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert megno(turning, [(0.5, 1.2, 0.6, 0.0, 0.8)], 4000.0).values[0] == approx(2.0, abs=0.1)
