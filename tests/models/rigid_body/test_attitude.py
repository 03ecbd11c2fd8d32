"""Attitude of a body: orthonormal, and against SciPy's rotations; the loxodromic pendulum against closed forms."""

from math import asin, cos, sqrt

import numpy as np
from pytest import approx, mark
from scipy.spatial.transform import Rotation

from hess_mechanics import level, solve
from hess_mechanics.errors import ModelError, OutsideRegion
from hess_mechanics.euler_poisson import equations as euler_poisson
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicPendulum, loxodromic_motion
from hess_mechanics.rigid_body.attitude import Attitude, orthonormal
from hess_mechanics.suslov_hess import equations as hess
from hess_mechanics.suslov_hess.equations import WITH_ATTITUDE, HessBody
from support.mechanics import followed
from support.refusals import refused

START = np.array([0.3, 0.9, 0.6, 0.0, 0.8])
P = (0.75, 1.0)


def turned(velocity, field, start, times):
    """Rotation matrices body → space, (n, 3, 3), from the quaternion that follows ω, by SciPy alone."""
    d = len(start)

    def rates(_, y):
        x, q = y[:d], Rotation.from_quat(y[d:])
        w = q.apply(velocity(x))  # in space: q̇ = ½ ω q
        u, s = y[d : d + 3], y[d + 3]
        return [*field(x), *(0.5 * (s * w + np.cross(w, u))), -0.5 * w @ u]

    found = followed(rates, [*start, 0.0, 0.0, 0.0, 1.0], times, 3e-14, 1e-15)
    return found[:, :d], Rotation.from_quat(found[:, d:]).as_matrix()


# --- The attitude ------------------------------------------------------------------------------------


@mark.parametrize("name", ["draft", "reference"])
def test_the_axes_are_orthonormal_to_round_off_and_agree_with_a_quaternion(name):
    orbit = solve(WITH_ATTITUDE.at(P), [*START, 0.0, 1.0, 0.0], np.linspace(0.0, 12.0, 300), name)
    found = Attitude(orbit.times, *orthonormal(orbit.states[:, 2:5], orbit.states[:, 5:]))
    estimate = orbit.error_estimate
    products = found.axes @ found.axes.transpose(0, 2, 1)
    assert np.max(np.abs(products - np.eye(3))) < 2e-15
    assert np.max(np.abs(np.linalg.det(found.axes) - 1.0)) < 4e-15
    _, turn = turned(lambda x: np.array([x[0], x[1], -P[0] * x[1]]), lambda x: hess.field(x, P), START, found.times)
    error = np.max(np.abs(found.axes - found.axes[0] @ turn))
    promise = max(level(name).promise, 1e-12) * 4.0  # in units in which the fastest ω is 1
    assert error < promise
    assert error < 10.0 * max(estimate, 3e-13)
    assert found.defect < 2.0 * max(estimate, 1e-15)
    assert found.in_space(np.array([0.2, 0.5, -0.7])) == approx(found.axes @ [0.2, 0.5, -0.7], abs=1e-15)


# --- The body of the Suslov–Hess case ----------------------------------------------------------------


def test_the_section_across_the_centre_of_mass_is_a_circle_whatever_I33():
    body = HessBody(0.96, 0.28, -1.0)
    for I33 in (0.2, 1.7):
        assert np.linalg.inv(body.tensor(I33))[:2, :2] == approx(np.eye(2) / body.I11, abs=1e-14)
    # The centre of mass, opposite to b, lies along n3.
    assert body.turn @ (0.0, -body.b2, -body.b3) == approx([0.0, 0.0, body.b * body.I11], abs=1e-14)


# --- The loxodromic pendulum -------------------------------------------------------------------------


def pendulum(I=(1.0, 1.5, 2.0), h=1.5, l=0.4, mu=0.7):
    return LoxodromicPendulum(HeavyBody.hess(I, mu), h, l)


@mark.parametrize(("I", "h"), [((1.0, 1.5, 2.0), -0.9), ((2.0, 1.5, 1.0), 1.0), ((1.0, 1.02, 1.3), 12.0)])
def test_the_angle_of_the_track_is_that_of_the_paper(I, h):
    one = pendulum(I, h, 1.2)
    a1, a2, a3 = (1.0 / moment for moment in I)
    promised = asin(a2 / sqrt(a2 * (a1 + a3) - a1 * a3))  # klas-gess-3
    assert one.angle == approx(promised, rel=1e-14)
    found = loxodromic_motion(one, 12.0, "reference")
    times, theta = found.angles
    assert times.size > 20
    assert np.max(np.abs(theta - promised)) < 1e-9


def test_what_is_drawn_solves_the_equations_of_euler_and_poisson():
    one = pendulum(h=0.6, l=0.9, mu=1.3)
    found = loxodromic_motion(one, 6.0, "reference")
    a, r = np.array(one.body.a), np.array(one.body.r)
    gamma = found.attitude.axes[0, 0]
    K = sqrt(2.0 * (one.h + 1.0) * one.body.mu / a[1])
    M = K * found.attitude.axes[0, 1]  # e along M
    assert M @ r == approx(0.0, abs=1e-14)  # the Hess relation
    assert M[1] == approx(K * cos(one.l), abs=1e-14)
    states, turn = turned(
        lambda y: a * y[:3], lambda y: euler_poisson.field(y, one.body.parameters), [*M, *gamma], found.times
    )
    assert found.attitude.axes == approx(found.attitude.axes[0] @ turn, abs=3e-11)
    assert found.attitude.axes[:, 0] == approx(states[:, 3:], abs=3e-11)
    # M keeps its direction in space.
    assert np.cross(states[:, :3], found.attitude.axes[:, 1]) == approx(0.0, abs=3e-11)


def test_the_logarithm_of_the_printed_formula_needs_a_dot():
    # klas-gess-4: ln tan(l/2) = ±a13 K as printed would change sign with K at a turning point; its rate does.
    one = pendulum(h=0.3, l=1.1)
    found = loxodromic_motion(one, 10.0, "reference")
    value = np.log(np.tan(0.5 * found.l))
    K = np.hypot(*found.orbit.states[:, :2].T)
    assert np.ptp(value - value[0] - one.a * found.swing) < 1e-12
    assert np.ptp(np.abs(value) - abs(one.a) * K) > 0.3


test_what_is_no_loxodromic_pendulum_is_refused_in_a_sentence = refused(
    (lambda: pendulum(h=-1.0), "choose h > −1", OutsideRegion),
    (lambda: pendulum(l=0.0), "choose 0 < l < π"),
    (lambda: LoxodromicPendulum(HeavyBody.hess((1.0, 1.5, 2.0), 1.0, 0.1), 1.5, 0.4), "Hess"),
    (lambda: loxodromic_motion(pendulum(), 1e9, "draft"), "shorter", ModelError),
)
