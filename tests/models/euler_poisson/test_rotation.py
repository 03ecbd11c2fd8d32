"""Rotation numbers along a line of the section: orbits that have one, and orbits that do not rotate."""

from math import pi, sqrt

import numpy as np
from pytest import approx

from hess_mechanics.euler_poisson.rotation import rotation_along


def circle(turn, radius=0.3):
    """Return points that rotate on a circle by this many turns each."""
    angle = 2.0 * pi * turn * np.arange(400) + 0.2
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def rotating(turn):
    """Points of a curve that goes round in l."""
    angle = 2.0 * pi * turn * np.arange(400)
    return np.column_stack([np.angle(np.exp(1j * (angle + 0.4 * np.sin(angle)))), 0.3 * np.cos(angle)])


GOLDEN = (sqrt(5.0) - 1.0) / 2.0


def test_a_closed_curve_that_does_not_go_round_has_no_number():
    ends = ((0.0, -0.5), (0.0, 0.5))
    orbits = [circle(GOLDEN / 3.0, radius=radius) for radius in (0.1, 0.3)] + [rotating(0.3 * GOLDEN)]
    found = rotation_along(ends, [0.1, 0.2, 0.3], orbits, about_first=False, count=10)
    assert found.librations == approx([-0.4, -0.3])
    assert found.chaotic_intervals.size == 0
    assert found.numbers == approx([0.3 * GOLDEN], abs=1e-6)
    assert found.points == approx([-0.2])
    # About a centre inside, the same circle has one.
    inside = rotation_along(((0.0, 0.0), (1.0, 0.0)), [0.3], [circle(GOLDEN / 3.0)], about_first=True, count=10)
    assert (inside.librations.size, inside.numbers) == (0, approx([GOLDEN / 3.0], abs=1e-6))


def test_numbers_on_both_sides_of_a_half_are_one_curve_and_what_is_far_apart_stays():
    ends = ((0.0, -0.5), (0.0, 0.5))

    def numbers(*turns):
        shares = (np.arange(len(turns)) + 0.5) / len(turns)
        found = rotation_along(ends, shares, [rotating(turn) for turn in turns], about_first=False, count=len(turns))
        return found.numbers, len(found.rho)

    # ½ + x and −½ + x are the same rotation: side by side they lie about −½, or about ½, and make one curve.
    near, parts = numbers(0.4131, 0.4507, 0.4853, -0.4913)
    assert (near, parts) == (approx([0.4131, 0.4507, 0.4853, 0.5087], abs=1e-5), 1)
    far, parts = numbers(0.3507, 0.0131, -0.3153, 0.4513)
    assert (far, parts) == (approx([0.3507, 0.0131, -0.3153, 0.4513], abs=1e-5), 2)
