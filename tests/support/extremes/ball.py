"""The rows of `test_extremes` for the Chaplygin ball."""

import math

import mpmath
import numpy as np

import oracle
from hess_mechanics import level, solve
from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.scattering import ball_scattering

__all__ = ["rows"]

TENSOR = (2.0, 1.0, 0.3, 0.5)
FIELD = np.array([0.3, -0.5, 1.0])
OMEGA, GAMMA = (0.8, -0.4), (0.6, 0.0, 0.8)
START = (*OMEGA, *GAMMA)
PHASES = np.linspace(0.0, 2.0 * math.pi, 32, endpoint=False)


def with_field(D, b=1.0, tensor=TENSOR):
    return (*tensor, D, *(b * FIELD))


def free(D, tensor=TENSOR):
    return (*tensor, D, 0.0, 0.0, 0.0)


def off_the_line(I23, small, times):
    """States (n, 5) of the motion from ω = (1, small), γ = GAMMA, with I11 = 2, I22 = 1, I13 = 0, 𝒟 = 1.

    While ω2 < 1e-17 γ turns uniformly about e1, and ω2 grows at the rate λ of its place: a closed form but for the
    integral of λ over one turn.
    """
    with mpmath.workdps(40):
        g1, r = mpmath.mpf(GAMMA[0]), mpmath.mpf(GAMMA[2])

        def rate(t):
            g2, g3 = r * mpmath.sin(t), r * mpmath.cos(t)
            J1, J2 = 2 + g2**2 + g3**2, 1 + g1**2 + g3**2
            return I23 * J1 / (J1 * J2 - (g1 * g2) ** 2)

        turn = 2 * mpmath.pi
        growth = mpmath.quad(rate, [turn * k / 8 for k in range(9)])
        turns = max(0, int(mpmath.log(mpmath.mpf("1e-17") / abs(small)) / growth))
        begun, w2 = turns * turn, mpmath.mpf(small) * mpmath.exp(turns * growth)
        early = [[1.0, 0.0, GAMMA[0], float(r * mpmath.sin(t)), float(r * mpmath.cos(t))] for t in times if t < begun]
        late = [float(t - begun) for t in times if t >= begun]
    passage = oracle.orbit_in_decimals(
        SYSTEM, (1.0, float(w2), *GAMMA), (2.0, 1.0, 0.0, I23, 1.0, 0.0, 0.0, 0.0), late, digits=50
    )
    return np.vstack([np.reshape(early, (-1, 5)), passage.astype(float)])


def harmonics_error(body, theta, h, distance, cosine, name):
    """Return the distance of θ⁺ from cos θ⁺ = cos χ cos θ + sin χ sin θ cos(φ − φ*), minimized over φ*."""
    found = ball_scattering(body, theta, PHASES, h, distance, level(name))
    values = np.cos(found.theta_plus)
    mean, wave = values.mean(), 2.0 * np.mean(values * np.exp(-1j * PHASES))
    amplitude = math.sqrt(1.0 - cosine**2) * math.sin(theta)
    rest = values - mean - (wave * np.exp(1j * PHASES)).real
    return float(max(abs(mean - cosine * math.cos(theta)), abs(abs(wave) - amplitude), np.max(np.abs(rest))))


def in_the_strip(Row, name, body, h, span, **options):
    """Return the distance of |ω|² from the strip, and of E from h, relative to h."""

    def error(name):
        states = Strip(body, h).spread(6)
        worst = 0.0
        for state in states:
            y = solve(body, state, np.linspace(0.0, span, 60), level(name)).states
            squares, moments = y[:, :2] ** 2, np.array([body.I11, body.I22])
            outer, inner = np.max(squares @ moments) / (2 * h), np.min(squares @ (moments + body.D)) / (2 * h)
            energy = SYSTEM.integrals(y.T, body.parameters)["E"] / h
            worst = max(worst, outer - 1, 1 - inner, np.max(np.abs(energy - 1)))
        return float(worst)

    return Row(f"ball, strip: {name}", "σ1, σ2 and E = h", error, **options)


def rows(Row, an_orbit, drift):
    """The rows."""

    def ball(name, state, parameters, times, **options):
        return an_orbit(name, SYSTEM, state, parameters, times, **options)

    def near(name, I23, small, times):
        return ball(
            name,
            (1.0, small, *GAMMA),
            (2.0, 1.0, 0.0, I23, 1.0, 0.0, 0.0, 0.0),
            times,
            truth=lambda: off_the_line(I23, small, times),
            against="closed form, then Taylor series, 50 digits",
        )

    # cos χ of the free Suslov problem, by an independent computation with 40 digits.
    def theta_plus(name, theta=1.0, h=10.0, distance=1e-7, tensor=(1.0, 1.5, 0.7, 1.2), cosine=-0.47889450360074):
        return Row(
            f"ball, θ⁺: {name}",
            "closed form of the free Suslov problem",
            lambda name: harmonics_error(BallBody(*tensor, 0.0), theta, h, distance, cosine, name),
            floor=1e-9,
            because="the distance 1e-7 is rounded to 1e-16, which changes the phase by 1e-9",
        )

    return [
        ball("𝒟 = 0", START, with_field(0.0), [1.0, 5.0, 20.0]),
        ball("𝒟 = 1e-6", START, with_field(1e-6), [1.0, 5.0, 20.0]),
        ball("𝒟 = 1e6", START, with_field(1e6), [1.0, 5.0, 20.0]),
        ball("𝒟 = 1e6, no field", START, free(1e6), [1.0, 5.0, 20.0]),
        ball("𝒟 = 1e6, γ along ω", (*OMEGA, 2 / math.sqrt(5.0), -1 / math.sqrt(5.0), 0.0), free(1e6), [1.0, 5.0]),
        # The energy allows ω = √(2E/I22) = 880 for γ along ω: that is the unit in which the state is O(1).
        ball("𝒟 = 1e6, γ3 = 0", (*OMEGA, 0.6, 0.8, 0.0), with_field(1e6), [1.0, 5.0], speed=880.0),
        near("1e-300 off the line", 1.0, 1e-300, [1.0, 1085.0, 1100.0]),
        near("1e-12 off the line", 1.0, 1e-12, [1.0, 43.0, 60.0]),
        ball("on the line", (1.0, 0.0, *GAMMA), (2.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0), [1.0, 20.0]),
        ball("I11/I22 = 1e6", (1e-3, 1.0, *GAMMA), with_field(2.0, tensor=(1e6, 1.0, 0.3, 0.5)), [1.0, 5.0]),
        ball("I11/I22 = 1e-6", (0.1, 1.0, *GAMMA), with_field(2.0, tensor=(1e-6, 1.0, 1e-3, 0.5)), [0.01, 0.2]),
        ball("I22 = 1e-6, 𝒟 = 1e-6", (0.1, 1.0, *GAMMA), with_field(1e-6, 1.0, (1.0, 1e-6, 0.5, 1e-3)), [1e-3, 0.02]),
        ball("I13 = I23 = 0", START, with_field(2.0, tensor=(2.0, 1.0, 0.0, 0.0)), [1.0, 5.0, 20.0]),
        ball("backward", START, with_field(2.0), [-1.0, -5.0, -20.0]),
        ball("γ = (0, 0, 1)", (*OMEGA, 0.0, 0.0, 1.0), with_field(2.0), [1.0, 5.0, 20.0]),
        ball("γ3 = 0", (*OMEGA, 0.6, -0.8, 0.0), with_field(2.0), [1.0, 5.0, 20.0]),
        ball("ω = 0", (0.0, 0.0, *GAMMA), with_field(2.0), [1.0, 5.0, 20.0]),
        ball("ω = 1e-300", (1e-300, 1e-300, *GAMMA), with_field(2.0), [1.0, 5.0]),
        ball("b = 1e6", (800.0, -400.0, *GAMMA), with_field(2.0, 1e6), [0.001, 0.02]),
        ball("b = 1e-6", (8e-4, -4e-4, *GAMMA), with_field(2.0, 1e-6), [1e3, 2e4]),
        ball("ω = 1e6", (0.8e6, -0.4e6, *GAMMA), free(2.0), [1e-6, 1e-4]),
        ball("ω = 1e-6", (0.8e-6, -0.4e-6, *GAMMA), free(2.0), [1e6, 1e8]),
        ball("t = 1e-6", START, with_field(2.0), [1e-6]),
        ball("t = 300, no field", START, free(2.0), [300.0]),
        drift("t = 3e4", SYSTEM, START, with_field(2.0), 3e4, floor=1e-11),
        drift("t = −1e3, 𝒟 = 1e6", SYSTEM, START, with_field(1e6), -1e3, floor=1e-11),
        in_the_strip(Row, "𝒟 = 1e6", BallBody(2.0, 1.0, 0.3, 0.5, 1e6), 1.0, 20.0),
        in_the_strip(Row, "𝒟 = 1e-6", BallBody(2.0, 1.0, 0.3, 0.5, 1e-6), 1.0, 20.0),
        in_the_strip(Row, "h = 1e6", BallBody(2.0, 1.0, 0.3, 0.5, 2.0), 1e6, 0.02),
        in_the_strip(Row, "h = 1e-6", BallBody(2.0, 1.0, 0.3, 0.5, 2.0), 1e-6, 2e4),
        theta_plus("𝒟 = 0"),
        theta_plus("𝒟 = 0, θ⁻ = 0", theta=0.0),
        theta_plus("𝒟 = 0, θ⁻ = π, δ = −1e-7", theta=math.pi, distance=-1e-7),
        theta_plus("𝒟 = 0, complete reversal", tensor=(1.64, 1.0, 0.0, 0.8), cosine=-1.0),
        theta_plus("𝒟 = 0, h = 1e6", h=1e6),
        theta_plus("𝒟 = 0, h = 1e-6", h=1e-6),
    ]
