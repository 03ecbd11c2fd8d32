"""Rotation numbers of orbits with known ones: explicit rotations, seen in another angle."""

import math

import numpy as np
import pytest

from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.errors import InvalidParameter


def turning(rho, count=2000):
    """An orbit on a closed curve about (1, 2), seen from which it turns unevenly."""
    theta = 2.0 * math.pi * rho * np.arange(count) + 0.3
    angle = theta + 0.5 * np.sin(theta)
    return np.column_stack([1.0 + (2.0 + np.cos(angle)) * np.cos(angle), 2.0 + (2.0 + np.cos(angle)) * np.sin(angle)])


# Near one half the turns of single points fall on both sides of the cut.
@pytest.mark.parametrize("rho", [0.1, 0.3819660112501051, 0.4987654321, -0.4991234567, -0.2360679774997897])
def test_it_is_the_number_of_turns_that_a_point_makes(rho):
    found, apart = rotation_number(turning(rho), (1.0, 2.0))
    assert found == pytest.approx(rho, abs=1e-9)
    assert apart < 1e-9
    angles = np.unwrap(np.arctan2(*(turning(rho) - [1.0, 2.0]).T[::-1]))
    assert rotation_number(angles[:, None])[0] == pytest.approx(rho, abs=1e-9)


def test_an_orbit_that_changes_its_pace_has_halves_that_differ_by_that():
    angles = np.cumsum(np.repeat([0.5, 0.7], 1000))
    assert rotation_number(angles[:, None])[1] == pytest.approx(0.2 / (2.0 * math.pi), rel=1e-2)


def test_too_few_points_are_refused():
    with pytest.raises(InvalidParameter, match="there are 4: follow it for longer"):
        rotation_number(turning(0.1, 4))
