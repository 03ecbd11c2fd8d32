"""θ⁻ → θ⁺ of the Chaplygin ball: the free Suslov problem where 𝒟 → 0, and a plain integrator otherwise."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models import level
from models.accuracy import LEVELS, Status
from models.ball_scattering import ball_scattering
from models.chaplygin_ball import SYSTEM, BallBody
from models.errors import InvalidParameter

PHASES = np.linspace(0.0, 2.0 * math.pi, 128, endpoint=False)
CAPTION = BallBody(1.0, 1.5, 0.7, 1.2, 10.0)

# (I11, I22, I13, I23) and cos χ of the free Suslov problem, computed independently with 40 digits.
ROTATIONS = [
    ((3.56, 1.0, 0.0, 0.8), -0.8484094045578246168641),
    ((2.44, 1.0, 0.0, 0.5), -0.9902583607917886898757),
    ((0.8, 1.0, 0.0, 0.5), -0.9305335004052719694923),
    ((1.64, 1.0, 0.0, 0.8), -1.0),
    ((1.0, 1.5, 0.7, 1.2), -0.47889450360074),
    ((2.0, 1.0, 0.3, 0.5), -0.95659283876095),
    ((3.0, 2.0, -0.4, 0.9), -0.98973299253727),
]


def harmonics(result):
    """cos θ⁺ = c0 + c1 cos(φ − φ*) and what of it is left, by least squares."""
    columns = np.stack([np.ones_like(result.phis), np.cos(result.phis), np.sin(result.phis)], axis=1)
    values = np.cos(result.theta_plus)
    (c0, c, s), *_ = np.linalg.lstsq(columns, values, rcond=None)
    return c0, math.hypot(c, s), np.max(np.abs(columns @ (c0, c, s) - values))


@pytest.mark.parametrize(("tensor", "cosine"), ROTATIONS)
@pytest.mark.parametrize("theta", [0.4, 1.0, 2.2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_without_the_inner_ball_scattering_is_the_rotation_of_the_free_suslov_problem(tensor, cosine, theta, side):
    # Γ⁺ = cos χ Γ⁻ + sin χ √(1 − Γ⁻²) cos(φ − φ*), the same at every energy.
    for D, slack in ((0.0, 0.0), (1e-5, 2e-4)):
        found = ball_scattering(BallBody(*tensor, D), theta, PHASES, 1.5, side * 1e-7, level("standard"))
        assert found.status is Status.OK
        mean, amplitude, rest = harmonics(found)
        error = found.errors.max() + slack
        assert mean == pytest.approx(cosine * math.cos(theta), abs=error)
        assert amplitude == pytest.approx(math.sqrt(1.0 - cosine**2) * math.sin(theta), abs=error)
        assert rest <= error


def test_what_the_inner_ball_does_falls_with_it():
    rests = []
    for D in (1e-1, 1e-2, 1e-3):
        body = BallBody(1.0, 1.5, 0.7, 1.2, D)
        rests.append(harmonics(ball_scattering(body, 1.0, PHASES, 1.5, 1e-7, level("standard")))[2])
    assert rests[0] > 5 * rests[1] > 25 * rests[2] > 0.0


@pytest.mark.parametrize("body", [CAPTION, BallBody(2.0, 1.0, -0.3, 0.5, 1.0)])
@pytest.mark.parametrize("name", LEVELS)
def test_scattering_agrees_with_a_plain_integrator(body, name):
    theta, phi, h, distance = 1.1, 0.7, 10.0, 1e-6
    length = math.hypot(body.I13, body.I23)
    xi, eta = (np.array([body.I23, -body.I13, 0.0]) / length, np.array([body.I13, body.I23, 0.0]) / length)
    gamma = math.cos(theta) * xi + math.sin(theta) * (math.cos(phi) * eta + math.sin(phi) * np.eye(3)[2])
    direction = (xi + distance * eta)[:2]
    kinetic = SYSTEM.integrals((*direction, *gamma), body.parameters)["E"]
    state = np.array([*(direction * math.sqrt(h / kinetic)), *gamma])
    run = solve_ivp(lambda _, y: SYSTEM.field(y, body.parameters), (0.0, 400.0), state, method="DOP853", rtol=1e-13,
                    atol=1e-20)
    theta_plus = math.acos(run.y[2:, -1] @ xi)
    found = ball_scattering(body, theta, [phi], h, distance, level(name))
    # From the same state; what the start's own distance does is the matter of the next test.
    assert abs(found.theta_plus[0] - theta_plus) <= max(1e-8, 0.5 * level(name).promise)
    assert found.errors[0] >= abs(found.theta_plus[0] - theta_plus)


def test_the_true_circle_of_the_start_is_within_the_error():
    theta, distance = 1.1, 1e-4
    found = ball_scattering(CAPTION, theta, PHASES[::16], 10.0, distance, level("draft"))
    length = math.hypot(CAPTION.I13, CAPTION.I23)
    xi, eta = np.array([CAPTION.I23, -CAPTION.I13]) / length, np.array([CAPTION.I13, CAPTION.I23]) / length
    for phi, error in zip(found.phis, found.errors, strict=True):
        across = math.sin(theta) * math.cos(phi)
        gamma = [*(math.cos(theta) * xi + across * eta), math.sin(theta) * math.sin(phi)]
        direction = xi + distance * eta
        kinetic = SYSTEM.integrals((*direction, *gamma), CAPTION.parameters)["E"]
        state = [*(direction * math.sqrt(10.0 / kinetic)), *gamma]
        back = solve_ivp(lambda _, y: SYSTEM.field(y, CAPTION.parameters), (0.0, -60.0), state, method="DOP853",
                         rtol=1e-11, atol=1e-14).y[:, -1]
        assert abs(math.acos(back[2:4] @ xi) - theta) <= error


def test_errors_fall_with_the_distance_until_it_is_rounded():
    errors = [ball_scattering(CAPTION, 1.0, PHASES[:16], 10.0, distance, level("reference")).errors.max()
              for distance in (1e-2, 1e-4, 1e-6, 1e-10, 1e-12)]
    assert errors[0] > 10 * errors[1] > 100 * errors[2]
    assert errors[2] < errors[3] < errors[4]
    draft = ball_scattering(CAPTION, 1.0, PHASES, 10.0, 1e-7, level("draft"))
    exact = ball_scattering(CAPTION, 1.0, PHASES, 10.0, 1e-7, level("reference"))
    assert np.max(np.abs(draft.theta_plus - exact.theta_plus)) <= draft.errors.max() < 1e-3
    assert draft.status is Status.OK


@pytest.mark.parametrize("theta", [0.0, math.pi])
def test_the_ends_of_the_axis_have_one_image(theta):
    found = ball_scattering(CAPTION, theta, PHASES, 10.0, 1e-7, level("standard"))
    assert np.ptp(found.theta_plus) <= 2 * found.errors.max()


def test_results_are_read_only_and_share_nothing_with_the_caller():
    phases = np.array([0.0, 1.0])
    found = ball_scattering(CAPTION, 1.0, phases, 10.0, 1e-6, level("draft"))
    phases[0] = 5.0
    assert found.phis[0] == 0.0
    for array in (found.phis, found.theta_plus, found.errors):
        assert not array.flags.writeable
    assert found.cost.steps > 0


@pytest.mark.parametrize(("change", "match"), [
    ({"theta": -0.1}, "0 ≤ θ⁻ ≤ π"), ({"theta": math.nan}, "theta_minus"), ({"distance": 0.0}, "from 1e-15 to 0.1"),
    ({"distance": 0.5}, "from 1e-15 to 0.1"), ({"h": 0.0}, "choose h > 0"), ({"phis": []}, "phases"),
    ({"phis": [math.inf]}, "phases"), ({"body": BallBody(1.0, 1.0, 0.0, 0.0, 1.0)}, "I13 or I23"),
    ({"body": BallBody(1.0, 1.0, 0.1, 0.0, 1.0, 0.0, 0.0, 1.0)}, "b1 = b2 = b3 = 0"),
])
def test_what_cannot_be_is_refused_in_a_sentence(change, match):
    given = {"body": CAPTION, "theta": 1.0, "phis": [0.0], "h": 10.0, "distance": 1e-6} | change
    with pytest.raises(InvalidParameter, match=match):
        ball_scattering(*given.values(), level("draft"))
