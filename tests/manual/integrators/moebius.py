"""Work C for all methods: one linear integration over half a period gives Θ at every angle.

The method is that of `hess_mechanics.suslov_hess.circle_map`.  The peers are given the first state and
the half period; this project computes them in every run.
"""

import math

import numpy as np

from hess_mechanics import turning_points


def field(y, half_a):
    """(w1, w2, n1, n2, n3) of `eq01` at a = 0 with A = (5, 6) and B = (7, 8), in plain arithmetic; b = 1."""
    w1, w2, n1, n2, n3, a_re, a_im, b_re, b_im = y
    return (
        -n2,
        n1,
        -n3 * w2,
        n3 * w1,
        n1 * w2 - n2 * w1,
        -half_a * (w2 * b_im + w1 * b_re),
        -half_a * (w2 * b_re - w1 * b_im),
        -half_a * (w2 * a_im + w1 * a_re),
        -half_a * (w2 * a_re - w1 * a_im),
    )


def start(work):
    """The state (9,) at the lower turning point of n3, where A = 1 and B = 0."""
    turning = turning_points(work.h, work.f)
    n2 = math.copysign(math.sqrt(turning.sine_squared), work.f)
    return np.array([0.0, math.sqrt(turning.w_squared), 0.0, n2, turning.roots[1], 1.0, 0.0, 0.0, 0.0])


def half_period(work):
    """The time to the upper turning point."""
    return 0.5 * turning_points(work.h, work.f).period


def theta_of_matrix(alpha, im_beta, phi, z):
    """Θ(φ) modulo 2π of the matrix with β = i Im β; φ and z = e^{iφ} (n,)."""
    numerator = alpha * z
    numerator += 1j * im_beta
    # The denominator of the map is conj(numerator)·z.
    theta = np.arctan2(numerator.imag, numerator.real)
    theta *= 2.0
    theta -= phi
    return theta


def theta_after(phi):
    """Θ(φ) modulo 2π as a function of the state (9,) at the upper turning point."""
    z = np.exp(1j * phi)

    def theta(y):
        w1, w2, _, _, _, a_re, a_im, b_re, b_im = y.tolist()
        chi = 0.5 * math.atan2(w1, w2)
        turn = complex(math.cos(chi), math.sin(chi))
        A, B = complex(a_re, a_im) * turn, complex(b_re, b_im) * turn
        return theta_of_matrix(A * A - B.conjugate() ** 2, 2.0 * (A * B).imag, phi, z)

    return theta
