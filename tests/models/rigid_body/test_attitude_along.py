"""The attitude from the samples of an orbit, against SciPy's rotation of the same motion."""

import numpy as np
from pytest import approx, mark
from scipy.spatial.transform import Rotation

from hess_mechanics.chaplygin_ball import equations as ball
from hess_mechanics.dynamics.sampling import sampled_orbit
from hess_mechanics.euler_poisson import equations as heavy
from hess_mechanics.rigid_body.attitude import TURN, attitude_along
from hess_mechanics.suslov import equations as suslov
from support.mechanics import followed

A = (1.0, 1.6, 8 / 3)
GAMMA = np.array([0.3, 0.2, 0.93]) / np.linalg.norm([0.3, 0.2, 0.93])
MOTIONS = {
    "suslov": (suslov.SYSTEM, (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0), (0.8, -0.4, *GAMMA), lambda y: (y[0], y[1], 0.0)),
    "ball": (ball.SYSTEM, (1.4, 0.8, 0.1, 0.3, 2.0, 0.2, -0.5, 0.7), (0.8, -0.4, *GAMMA), lambda y: (y[0], y[1], 0.0)),
    "heavy": (heavy.SYSTEM, (*A, 0.6, 0.0, 0.8, 0.5), (0.9, 0.5, -0.7, *GAMMA), lambda y: np.multiply(A, y[:3])),
}


def samples(system, parameters, start, omega):
    """Return times, angular velocities and verticals of the samples that the pictures use."""
    weights = (100.0,) * (len(start) - 3) + (300.0,) * 3
    orbit = sampled_orbit(system.at(parameters), start, 40.0, weights, "standard")
    return orbit.times, np.array([omega(y) for y in orbit.states]), orbit.states[:, -3:]


@mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_it_is_right_to_a_quarter_of_a_pixel_for_as_long_as_an_orbit_is_shown(motion):
    system, parameters, start, omega = motion
    found = attitude_along(*samples(*motion))
    n = len(start)

    def rates(_, y):
        return [*system.field(y[:n], parameters), *np.cross(y[n:], omega(y))]

    exact = followed(rates, [*start, *found.axes[0, 1]], found.times)
    assert (found.times[0], found.times[-1]) == (0.0, approx(40.0, abs=1e-12))
    # Half of the largest picture, in radii of the sphere, is some 250 pixels.
    assert np.max(np.abs(found.axes[:, :2].reshape(-1, 6) - exact[:, n - 3 :])) < 1e-3
    assert np.cross(found.axes[:, 0], found.axes[:, 1]) == approx(found.axes[:, 2], abs=1e-14)
    assert found.defect < 1e-3
    # Neighbours are so close that the chord between them is the rotation.
    steps = Rotation.from_matrix(found.axes[1:] @ found.axes[:-1].transpose(0, 2, 1)).magnitude()
    assert steps.max() < 1.05 * TURN
    assert len(found.times) < 1.1 * np.sum(steps) / TURN + 2.0


def test_a_steady_spin_about_the_vertical_is_followed_though_nothing_else_moves():
    omega = np.tile([0.0, 0.0, 3.0], (5, 1))
    found = attitude_along(np.linspace(0.0, 8.0, 5), omega, np.tile([0.0, 0.0, 1.0], (5, 1)))
    # Seen from the body, what is fixed in space turns backward.
    back = Rotation.from_rotvec(np.outer(found.times, [0.0, 0.0, -3.0]))
    assert found.axes[:, 1] == approx(back.as_matrix() @ found.axes[0, 1], abs=1e-12)
    assert abs(len(found.times) - 241) <= 1
    assert found.defect < 1e-15


def test_samples_too_far_apart_are_told_by_their_defect():
    assert attitude_along(*(one[::40] for one in samples(*MOTIONS["heavy"]))).defect > 0.05
