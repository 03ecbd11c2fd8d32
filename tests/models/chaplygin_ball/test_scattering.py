"""θ⁻ → θ⁺ of the Chaplygin ball: the free Suslov problem where 𝒟 → 0, and a plain integrator otherwise."""

from functools import cache
from math import acos, atan2, cos, hypot, pi, sin, sqrt

import numpy as np
from pytest import approx, mark
from scipy.integrate import solve_ivp

import oracle
from hess_mechanics import level
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering, starts
from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import LEVELS, Status
from support.mechanics import scipy_states
from support.refusals import refused
from support.thorough import sample

PHASES = np.linspace(0.0, 2.0 * pi, 128, endpoint=False)
CAPTION = BallBody(1.0, 1.5, 0.7, 1.2, 10.0)

TENSORS = [(3.56, 1.0, 0.0, 0.8), (1.64, 1.0, 0.0, 0.8), (1.0, 1.5, 0.7, 1.2), (3.0, 2.0, -0.4, 0.9)]


def harmonics(result):
    """Return the least-squares fit cos θ⁺ = c0 + c1 cos(φ − φ*) and its residual."""
    columns = np.stack([np.ones_like(result.phis), np.cos(result.phis), np.sin(result.phis)], axis=1)
    values = np.cos(result.theta_plus)
    (c0, c, s), *_ = np.linalg.lstsq(columns, values, rcond=None)
    return c0, hypot(c, s), np.max(np.abs(columns @ (c0, c, s) - values))


@mark.parametrize("tensor", TENSORS)
@mark.parametrize(("theta", "distance", "h"), [(0.4, 1e-7, 1.5), (2.2, -1e-7, 1e6), (1.0, 1e-7, 1e-6)])
def test_without_the_inner_ball_scattering_is_the_rotation_of_the_free_suslov_problem(tensor, theta, distance, h):
    # Γ⁺ = cos χ Γ⁻ + sin χ √(1 − Γ⁻²) cos(φ − φ*), the same at every energy.
    cosine = float(oracle.cos_chi(*tensor))
    for D, slack in ((0.0, 0.0), (1e-5, 2e-4)):
        found = ball_scattering(BallBody(*tensor, D), theta, PHASES, h, distance, "standard")
        assert found.status is Status.OK
        mean, amplitude, rest = harmonics(found)
        error = found.errors.max() + slack
        assert mean == approx(cosine * cos(theta), abs=error)
        assert amplitude == approx(sqrt(1.0 - cosine**2) * sin(theta), abs=error)
        assert rest <= error


@cache
def plainly_scattered(body, theta, phi, h, distance):
    """θ⁺ by SciPy."""
    xi = np.array([body.I23, -body.I13]) / hypot(body.I13, body.I23)
    (state,), _ = starts(Strip(body, h), theta, np.array([phi]), distance)
    end = scipy_states(SYSTEM, state, body.parameters, [400.0], 1e-13, 1e-20)[0]
    return acos(end[2:4] @ xi)


@mark.parametrize("body", [CAPTION, BallBody(2.0, 1.0, -0.3, 0.5, 1.0)])
@mark.parametrize("name", LEVELS)
def test_scattering_agrees_with_a_plain_integrator(body, name):
    theta, phi, h, distance = 1.1, 0.7, 10.0, 1e-6
    theta_plus = plainly_scattered(body, theta, phi, h, distance)
    found = ball_scattering(body, theta, [phi], h, distance, name)
    # From the same state; what the start's own distance does is the matter of the next test.
    assert abs(found.theta_plus[0] - theta_plus) <= max(1e-8, 0.5 * level(name).promise)
    assert found.errors[0] >= abs(found.theta_plus[0] - theta_plus)


BODIES = [
    CAPTION,
    BallBody(1.64, 1.0, 0.0, 0.8, 2.0),
    BallBody(2.0, 1.0, -0.3, 0.5, 0.0),
    BallBody(0.3, 1.5, 3.0, 4.0, 30.0),
]


THETAS, DISTANCES = (0.0, 1.1, 2.9), (1e-2, -1e-3)
SOME_PHASES = np.array([-2.5, 0.0, 0.7, 2.0])


@cache
def long_before(body):
    """By θ⁻ and distance: `starts` and where their motions were long before, by SciPy."""
    found = {
        (theta, distance): starts(Strip(body, 10.0), theta, SOME_PHASES, distance)
        for theta in THETAS
        for distance in DISTANCES
    }
    # All motions at once: SciPy takes as long for forty as for two.
    together = np.concatenate([states for states, _ in found.values()]).T
    run = solve_ivp(
        lambda _, y: np.ravel(SYSTEM.field(y.reshape(5, -1), body.parameters)),
        (0.0, -50.0),
        together.ravel(),
        method="DOP853",
        rtol=1e-11,
        atol=1e-14,
    )
    ends = np.split(run.y[:, -1].reshape(5, -1).T, len(found))
    return {key: (*found[key], end) for key, end in zip(found, ends, strict=True)}


@mark.parametrize("body", sample(BODIES, 2), ids=lambda body: f"D={body.D:g}")
@mark.parametrize("theta", THETAS)
def test_the_start_is_where_motions_of_its_circle_pass_but_for_the_square_of_the_distance(body, theta):
    xi = np.array([body.I23, -body.I13]) / hypot(body.I13, body.I23)
    worst = []
    for distance in DISTANCES:
        away = []
        for state, error, back, phi in zip(*long_before(body)[theta, distance], SOME_PHASES, strict=True):
            assert SYSTEM.integrals(state, body.parameters) == approx({"E": 10.0, "F1": 1.0}, rel=1e-13)
            assert state[0] * -xi[1] + state[1] * xi[0] == approx(distance * (state[:2] @ xi), rel=1e-12)
            across = sin(theta) * cos(phi)
            circle = [cos(theta) * xi[0] - across * xi[1], cos(theta) * xi[1] + across * xi[0], sin(theta) * sin(phi)]
            assert np.linalg.norm(state[2:] - circle) <= 1.5 * abs(distance)
            along, up = back[2:4] @ xi, hypot(back[3] * xi[0] - back[2] * xi[1], back[4])
            away.append(abs(atan2(up, along) - theta))
            assert away[-1] <= error
        worst.append(max(away))
    # A hundred times less at a tenth of the distance, as far as the integrator sees.
    assert worst[1] <= worst[0] / 50 + 1e-9
    assert worst[0] < 1e-4


@mark.parametrize("D", [0.0, 300.0])
def test_where_the_line_is_left_within_a_fraction_of_a_turn_the_errors_say_what_is_known(D):
    # ∫μ beyond double range: no first-order term, and no NaN either.
    body = BallBody(1e-3, 1.0, 800.0, 600.0, D)
    states, errors = starts(Strip(body, 1.0), 1.0, PHASES, 1e-5)
    assert np.all(np.isfinite(states))
    assert np.all((errors > 0.0) & (errors < 1e-2))


def scattered(body=CAPTION, theta=1.0, phis=PHASES, h=10.0, distance=1e-4, **options):
    return ball_scattering(body, theta, phis, h, distance, "standard", **options)


def test_within_the_limit_of_work_the_computation_succeeds():
    assert scattered(most_steps=300_000).cost.steps < 300_000


test_what_cannot_be_or_takes_too_long_is_refused_in_a_sentence = refused(
    (lambda: scattered(theta=-0.1), "0 ≤ θ⁻ ≤ π"),
    (lambda: scattered(distance=0.5), "from 1e-10 to 0.1"),
    (lambda: scattered(h=0.0), "choose h > 0"),
    (lambda: scattered(BallBody(1.0, 1.0, 0.0, 0.0, 1.0)), "I13 or I23"),
    (lambda: scattered(BallBody(1.0, 1.0, 0.1, 0.0, 1.0, 0.0, 0.0, 1.0)), "b1 = b2 = b3 = 0"),
    (lambda: scattered(most_steps=1000), "smaller 𝒟", WorkLimit),
    (
        lambda: scattered(BallBody(1.0, 1.5, 1e-3, 0.0, 300.0), distance=1e-10),
        r"about \de\+\d\d steps: choose larger I13",
        WorkLimit,
    ),
)
