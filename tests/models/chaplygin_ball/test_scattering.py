"""θ⁻ → θ⁺ of the Chaplygin ball: the free Suslov problem where 𝒟 → 0, and a plain integrator otherwise."""

from itertools import product
from math import acos, cos, hypot, pi, sin, sqrt

import numpy as np
from pytest import approx, mark

import oracle
from hess_mechanics import level
from hess_mechanics.chaplygin_ball.ball_scattering import ball_scattering, starts
from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import LEVELS, Status
from support.mechanics import followed, scipy_states
from support.refusals import refused
from support.thorough import sample

PHASES = np.linspace(0.0, 2.0 * pi, 128, endpoint=False)
CAPTION = BallBody(1.0, 1.5, 0.7, 1.2, 10.0)

TENSORS = [(1.64, 1.0, 0.0, 0.8), (1.0, 1.5, 0.7, 1.2), (3.0, 2.0, -0.4, 0.9)]


def harmonics(result):
    """Return the least-squares fit cos θ⁺ = c0 + c1 cos(φ − φ*) and its residual."""
    columns = np.stack([np.ones_like(result.phis), np.cos(result.phis), np.sin(result.phis)], axis=1)
    values = np.cos(result.theta_plus)
    (c0, c, s), *_ = np.linalg.lstsq(columns, values, rcond=None)
    return c0, hypot(c, s), np.max(np.abs(columns @ (c0, c, s) - values))


@mark.parametrize("tensor", sample(TENSORS, 2))
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


@mark.parametrize("body", [CAPTION, BallBody(2.0, 1.0, -0.3, 0.5, 1.0)])
def test_scattering_agrees_with_a_plain_integrator(body):
    theta, phi, h, distance = 1.1, 0.7, 10.0, 1e-6
    xi = np.array([body.I23, -body.I13]) / hypot(body.I13, body.I23)
    (state,), _ = starts(Strip(body, h), theta, np.array([phi]), distance)
    end = scipy_states(SYSTEM, state, body.parameters, [400.0], 1e-13, 1e-20)[0]
    for name in LEVELS:
        found = ball_scattering(body, theta, [phi], h, distance, name)
        # From the same state; what the start's own distance does is the matter of the next test.
        error = abs(found.theta_plus[0] - acos(end[2:4] @ xi))
        assert error <= max(1e-8, 0.5 * level(name).promise)
        assert error <= found.errors[0]


BODIES = [
    CAPTION,
    BallBody(1.64, 1.0, 0.0, 0.8, 2.0),
    BallBody(0.3, 1.5, 3.0, 4.0, 30.0),
]


@mark.parametrize("body", sample(BODIES, 2), ids=lambda body: f"D={body.D:g}")
def test_the_start_is_where_motions_of_its_circle_pass_but_for_the_square_of_the_distance(body):
    cases = list(product((0.0, 1.1, 2.9), (1e-2, -1e-3)))
    phis = np.array([-2.5, 0.0, 0.7, 2.0])
    found = [starts(Strip(body, 10.0), theta, phis, distance) for theta, distance in cases]
    states, errors = (np.concatenate(one) for one in zip(*found, strict=True))
    theta, distance = np.repeat(cases, len(phis), axis=0).T
    phi = np.tile(phis, len(cases))
    assert SYSTEM.integrals(states.T, body.parameters)["E"] == approx(10.0, rel=1e-13)
    xi, eta = np.array([[body.I23, -body.I13, 0.0], [body.I13, body.I23, 0.0]]) / hypot(body.I13, body.I23)
    assert states[:, :2] @ eta[:2] == approx(distance * (states[:, :2] @ xi[:2]), rel=1e-12)
    circle = np.column_stack([np.cos(theta), np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)])
    axes = np.array([xi, eta, (0.0, 0.0, 1.0)])
    assert np.all(np.linalg.norm(states[:, 2:] - circle @ axes, axis=1) <= 1.5 * np.abs(distance))
    # Long before, by SciPy, all motions at once: it takes as long for forty as for two.
    (before,) = followed(
        lambda _, y: np.ravel(SYSTEM.field(y.reshape(5, -1), body.parameters)), states.T.ravel(), [-50.0], atol=1e-14
    )
    along, across, up = axes @ before.reshape(5, -1)[2:]
    away = np.abs(np.arctan2(np.hypot(across, up), along) - theta)
    assert np.all(away <= errors)
    # A hundred times less at a tenth of the distance, as far as the integrator sees.
    far, near = away.reshape(3, 2, -1).max(axis=2).T
    assert np.all(near <= far / 50 + 1e-9)
    assert far.max() < 1e-4


@mark.parametrize("D", [0.0, 300.0])
def test_where_the_line_is_left_within_a_fraction_of_a_turn_the_errors_say_what_is_known(D):
    # ∫μ beyond double range: no first-order term, and no NaN either.
    body = BallBody(1e-3, 1.0, 800.0, 600.0, D)
    states, errors = starts(Strip(body, 1.0), 1.0, PHASES, 1e-5)
    assert np.all(np.isfinite(states))
    assert np.all((errors > 0.0) & (errors < 1e-2))


def scattered(body=CAPTION, theta=1.0, distance=1e-4, **options):
    return ball_scattering(body, theta, PHASES, 10.0, distance, "standard", **options)


test_what_cannot_be_or_takes_too_long_is_refused_in_a_sentence = refused(
    (lambda: scattered(theta=-0.1), "0 ≤ θ⁻ ≤ π"),
    (lambda: scattered(distance=0.5), "from 1e-10 to 0.1"),
    (lambda: scattered(max_steps=1000), "smaller 𝒟", WorkLimit),
    (
        lambda: scattered(BallBody(1.0, 1.5, 1e-3, 0.0, 300.0), distance=1e-10),
        r"about \de\+\d\d steps: choose fewer phases",
        WorkLimit,
    ),
)
