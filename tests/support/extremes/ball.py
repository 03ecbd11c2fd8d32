"""The rows of `test_extremes` for the Chaplygin ball."""

import mpmath
import numpy as np

import oracle
from hess_mechanics.chaplygin_ball.equations import SYSTEM

TENSOR = (2.0, 1.0, 0.3, 0.5)
FIELD = np.array([0.3, -0.5, 1.0])
OMEGA, GAMMA = (0.8, -0.4), (0.6, 0.0, 0.8)
START = (*OMEGA, *GAMMA)


def with_field(D, b=1.0, tensor=TENSOR):
    return (*tensor, D, *(b * FIELD))


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


def rows(an_orbit):
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

    return [
        ball("𝒟 = 1e-6", START, with_field(1e-6), [1.0, 5.0, 20.0]),
        ball("𝒟 = 1e6", START, with_field(1e6), [1.0, 5.0, 20.0]),
        # The energy allows ω = √(2E/I22) = 880 for γ along ω: that is the unit in which the state is O(1).
        ball("𝒟 = 1e6, γ3 = 0", (*OMEGA, 0.6, 0.8, 0.0), with_field(1e6), [1.0, 5.0], speed=880.0),
        near("1e-300 off the line", 1.0, 1e-300, [1.0, 1085.0, 1100.0]),
        ball("on the line", (1.0, 0.0, *GAMMA), (2.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0), [1.0, 20.0]),
        ball("I11/I22 = 1e6", (1e-3, 1.0, *GAMMA), with_field(2.0, tensor=(1e6, 1.0, 0.3, 0.5)), [1.0, 5.0]),
        ball("I22 = 1e-6, 𝒟 = 1e-6", (0.1, 1.0, *GAMMA), with_field(1e-6, 1.0, (1.0, 1e-6, 0.5, 1e-3)), [1e-3, 0.02]),
        ball("ω = 0", (0.0, 0.0, *GAMMA), with_field(2.0), [1.0, 5.0, 20.0]),
        ball("b = 1e6", (800.0, -400.0, *GAMMA), with_field(2.0, 1e6), [0.001, 0.02]),
    ]
