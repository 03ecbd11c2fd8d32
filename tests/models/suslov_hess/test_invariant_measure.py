"""The smooth invariant measure of a torus without limit cycles, against iteration, SciPy and long motions."""

from math import atan2, pi, remainder

import numpy as np
from pytest import approx, mark

from hess_mechanics import circle_map, level, solve, systems, turning_points
from hess_mechanics.suslov_hess.invariant_measure import (
    density_on_torus,
    invariant_measure,
    zeta_at,
)
from support.mechanics import angle_between
from support.refusals import refused

HESS = systems()["hess"]
REFERENCE = level("reference")
every_torus = mark.parametrize(("a", "h", "f"), [(0.5, 0.5, 0.5), (-0.6, -0.5, -0.3)])
PHASES = np.linspace(-3.1, 3.1, 41)


def seen_from(phi, zeta):
    """The hyperbolic direction ψ of the angle φ of the circle from a point ζ of the disk."""
    z = np.exp(1j * np.asarray(phi))
    return np.angle((z - zeta) / (1.0 - np.conj(zeta) * z))


# ---- on the circle ----------------------------------------------------------------------------------------------


@every_torus
def test_in_the_angle_of_the_measure_the_map_is_a_rotation(a, h, f):
    theta = circle_map(a, h, f, REFERENCE)
    measure = invariant_measure(theta)
    assert abs(measure.zeta) < 1.0
    turned = seen_from(theta.theta(PHASES), measure.zeta) - seen_from(PHASES, measure.zeta)
    assert angle_between(turned, 2.0 * pi * theta.rotation_number) <= 1e-10
    # The density is the slope of that angle.
    step = 1e-5
    around = (seen_from(PHASES + sign * step, measure.zeta) for sign in (1, -1))
    slope = np.angle(np.exp(1j * np.subtract(*around))) / (2.0 * step)
    assert slope / (2.0 * pi) == approx(measure.density(PHASES), rel=1e-7)


# ---- on the torus -----------------------------------------------------------------------------------------------


@every_torus
def test_the_unrolled_density_is_normalised_and_carried_along_by_the_flow(a, h, f):
    theta, turning = circle_map(a, h, f, REFERENCE), turning_points(h, f)
    density = density_on_torus(theta, REFERENCE, (64, 128))
    assert density.shape == (128, 64)
    # The mean of a smooth periodic function over equidistant points is exact.
    assert density.mean(axis=0) == approx(1.0, abs=1e-6)
    # Neighbours at σ = 0 are carried to the middle of a column: density there times how far they have spread.
    step = 1e-5
    for column in (3, 40):
        sigma = -pi + (column + 0.5) / 64 * 2.0 * pi
        s = sigma % (2.0 * pi) / (2.0 * pi) * turning.period
        for phi in (-2.0, 0.4, 1.7):
            ends = [
                solve(HESS.at((a, 1.0)), turning.state_at_lower_turn(phi + sign * step), [s], REFERENCE).states[0]
                for sign in (-1, 1)
            ]
            low, high = (atan2(state[0], state[1]) for state in ends)
            slope = remainder(high - low, 2.0 * pi) / (2.0 * step)
            row = ((low + pi) / (2.0 * pi) * 128 - 0.5) % 128
            # Between the centres of cells, by the trigonometric polynomial through them.
            there = np.fft.rfft(density[:, column]) * np.exp(2j * pi * np.arange(65) * row / 128)
            value = (there[0].real + 2.0 * there[1:-1].real.sum() + there[-1].real) / 128
            before = 2.0 * pi * float(invariant_measure(theta).density([phi])[0])
            assert value * slope == approx(before, rel=2e-4)


test_where_nothing_can_be_drawn_it_is_said_why = refused(
    (lambda: invariant_measure(circle_map(0.5, 1.5, 0.6, REFERENCE)), "choose a torus with .trace. < 2"),
    (lambda: density_on_torus(circle_map(0.5, 0.3, 0.0, REFERENCE), REFERENCE), "Choose another f"),
    # w underflows.
    (lambda: zeta_at(circle_map(0.0, 0.0, 5e-324, REFERENCE), [0.0, 1.0], REFERENCE), "Choose another f"),
    (lambda: density_on_torus(circle_map(4.0, 0.9, 0.0, REFERENCE), REFERENCE), "choose a smaller .a."),
)
