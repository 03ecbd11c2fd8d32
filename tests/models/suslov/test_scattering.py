"""The scattering of the free Suslov problem: values, closed forms, phases, orbits, refusals."""

from math import atan2, cos, hypot, pi

import numpy as np
from pytest import approx, mark

from hess_mechanics import SuslovBody, solve
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.suslov.free import equilibria, passage
from hess_mechanics.suslov.scattering import cos_chi, scattering, start
from support.mechanics import PROMISE, angle_between
from support.refusals import refused

GENERIC = SuslovBody(2.0, 1.0, 0.3, 0.5)
every_arc = mark.parametrize("arc", [1, -1])

# 40-digit Taylor series; the general ones have 14 digits.
REFERENCE = [
    ((3.56, 1.0, 0.0, 0.8), -0.8484094045578246168641),
    ((2.44, 1.0, 0.0, 0.5), -0.9902583607917886898757),
    ((1.64, 1.0, 0.0, 0.8), -1.0),
    ((1.0, 1.5, 0.7, 1.2), -0.47889450360074),
    ((2.0, 1.0, 0.3, 0.5), -0.95659283876095),
    ((3.0, 2.0, -0.4, 0.9), -0.98973299253727),
]


@mark.parametrize(("tensor", "exact"), REFERENCE)
def test_cos_chi_is_that_of_the_reference(tensor, exact):
    assert cos_chi(SuslovBody(*tensor)) == approx(exact, abs=5e-14)


def test_the_closed_form_of_every_tensor_agrees_with_the_integration():
    # Derived from the monodromy, and computed by Taylor series: nothing is shared but K, κ and c.
    rng = np.random.default_rng(6)
    wrong = total = 0
    for _ in range(100):
        body = SuslovBody(*10.0 ** rng.uniform(-1, 1, 2), *(10.0 ** rng.uniform(-1, 1, 2) * rng.choice([-1, 1], 2)))
        exact = cos_chi(body)
        for name in LEVELS:
            found = scattering(body, name, int(rng.choice([-1, 1])))
            error = abs(found.cos_chi - exact)
            assert error <= 2 * PROMISE[name]
            assert found.cos_chi**2 + found.sin_chi**2 == approx(1.0, abs=2 * PROMISE[name])
            total += 1
            wrong += error > found.error_estimate
    assert wrong <= 0.01 * total


# ---- θ⁺ against orbits ------------------------------------------------------------------------------------------


@mark.parametrize(
    ("body", "distance", "arc"),
    [(GENERIC, 0.2, -1), (GENERIC, 1e-5, 1), (SuslovBody(1.0, 1.5, 0.7, 0.0), 1e-5, -1)],
)
def test_the_start_leads_to_the_predicted_circle(body, distance, arc):
    # By the general solver, which knows nothing of the passage.
    found = scattering(body, "reference", arc, distance)
    for theta, phi in ((1.0, 0.7), (pi / 2, -2.5), (2.9, 3.0)):
        omega, gamma = start(body, 1.7, theta, phi, distance, arc)
        assert body.I11 * omega[0] ** 2 / 2 + body.I22 * omega[1] ** 2 / 2 == approx(1.7, rel=1e-14)
        points = equilibria(body, 1.7)
        eta = np.array([body.I13, body.I23]) / hypot(body.I13, body.I23)
        assert arc * np.dot(omega, eta) == approx(distance * points.speed, rel=1e-10)
        span = 2.0 * abs(passage(body, omega).u0) + 35.0
        end = solve(body, [*omega, *gamma], [span / points.rate], "reference")
        Gamma = float(end.states[0, 2:] @ points.xi)
        # If I13 I23 ≠ 0 the double next to ω(0) has another passage, by 1e-16/1e-5.
        assert cos(found.theta_plus(theta, phi)) == approx(Gamma, abs=1e-10)
        # ω and γ at the start are what was asked for.
        assert float(np.dot(gamma, points.xi)) == approx(cos(theta), abs=1e-15)
        azimuth = atan2(gamma[2], gamma[0] * eta[0] + gamma[1] * eta[1])
        assert angle_between(azimuth, phi) < 1e-14


@every_arc
def test_a_small_distance_only_shifts_the_phase(arc):
    phi = np.linspace(-3, 3, 20)
    asymptotic = scattering(GENERIC, "reference", arc)
    for distance in (1e-7, 1e-12, 1e-200):
        near = scattering(GENERIC, "reference", arc, distance)
        shift = near.phi_star - asymptotic.phi_star
        assert near.theta_plus(1.1, phi + shift) == approx(asymptotic.theta_plus(1.1, phi), abs=10 * distance + 1e-12)


@every_arc
def test_the_matrix_gives_the_harmonic_formula(arc):
    found = scattering(GENERIC, "reference", arc)
    theta, phi = np.linspace(0, pi, 31)[:, None], np.linspace(-7, 7, 41)[None, :]
    expected = found.cos_chi * np.cos(theta) + found.sin_chi * np.sin(theta) * np.cos(phi - found.phi_star)
    image = found.theta_plus(theta, phi)
    assert np.all((image >= 0) & (image <= pi))
    assert np.cos(image) == approx(expected, abs=1e-14)
    # θ⁺ next to 0: the arc cosine would leave 8 digits.
    chi = atan2(found.sin_chi, found.cos_chi)
    for small in (1e-9, 1e-12):
        assert found.theta_plus(chi + small, found.phi_star) == approx(small, abs=1e-14)


# ---- refusals ---------------------------------------------------------------------------------------------------


test_refusals = refused(
    (lambda: scattering(SuslovBody(2.0, 1.0, 0.0, 1e-06), "draft"), "choose a larger I13 or I23", WorkLimit),
    (lambda: scattering(GENERIC, "draft", 0), "choose 1 or −1"),
    (lambda: scattering(GENERIC, "draft", 1, 1.23), "choose one above 0 and up to 1.227"),
    (lambda: start(GENERIC, 0.0, 1.0, 0.0, 1e-05), "choose h > 0"),
    (lambda: cos_chi(SuslovBody(2.0, 1.0, 0.0, 0.0)), "no ξ"),
)
