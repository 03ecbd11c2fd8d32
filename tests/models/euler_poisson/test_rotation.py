"""Rotation numbers along a line of the section: which orbits have one, and which do not go round."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hess_mechanics.euler_poisson.andoyer import AndoyerSection, andoyer_points, coordinates
from hess_mechanics.euler_poisson.rotation import RESOLVED, on_line, rotation_along
from hess_mechanics.numerics.accuracy import STANDARD
from support.andoyer import RIS


def circle(turn, count=400, centre=(0.0, 0.0), radius=0.3):
    """Points that go round a circle by so many turns each."""
    angle = 2.0 * math.pi * turn * np.arange(count) + 0.2
    return np.column_stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)])


def rotating(turn, count=400):
    """Points of a curve that goes round in l."""
    angle = 2.0 * math.pi * turn * np.arange(count)
    return np.column_stack([np.angle(np.exp(1j * (angle + 0.4 * np.sin(angle)))), 0.3 * np.cos(angle)])


GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0


def test_a_closed_curve_that_does_not_go_round_has_no_number():
    ends = ((0.0, -0.5), (0.0, 0.5))
    orbits = [circle(GOLDEN / 3.0, radius=radius) for radius in (0.1, 0.3)] + [rotating(0.3 * GOLDEN)]
    found = rotation_along(ends, [0.1, 0.2, 0.3], orbits, about_first=False, count=10)
    assert found.standing == 2
    assert found.numbers == pytest.approx([0.3 * GOLDEN], abs=1e-6)
    assert found.places == pytest.approx([-0.2])
    # About a centre inside, the same circle has one; about one outside, none.
    inside = rotation_along(((0.0, 0.0), (1.0, 0.0)), [0.3], [circle(GOLDEN / 3.0)], about_first=True, count=10)
    assert (inside.standing, inside.numbers) == (0, pytest.approx([GOLDEN / 3.0], abs=1e-6))
    outside = rotation_along(((0.5, 0.0), (1.0, 0.0)), [0.3], [circle(GOLDEN / 3.0)], about_first=True, count=10)
    assert (outside.standing, outside.numbers.size) == (1, 0)


@pytest.mark.parametrize(("h", "f"), [(0.0, 0.0), (-0.4, 0.0)])
def test_in_gess_ris1_a_and_b_the_curves_through_the_line_do_not_go_round(h, f):
    section = AndoyerSection(RIS, h, f)
    line = ((2.8, -1.0), (2.8, 1.0))
    starts = on_line(section, line, 24)
    orbits = andoyer_points(RIS, h, f, [state for _, state in starts], 1000, STANDARD).states
    places = [coordinates(states) for states in orbits]
    found = rotation_along(line, [share for share, _ in starts], places, about_first=False, count=24)
    assert found.standing >= 8
    assert np.all(np.abs(found.numbers) > RESOLVED)
    # Of those without a number the points stay in a part of the circle of l.
    gaps = []
    for (share, _), points in zip(starts, places, strict=True):
        l = np.sort(points[:, 0])
        gap = max(np.max(np.diff(l)), 2.0 * math.pi - (l[-1] - l[0]))
        if not np.any(np.isclose(found.places, -1.0 + 2.0 * share)):
            gaps.append(gap)
    assert len(gaps) >= found.standing
    assert np.median(gaps) > 0.5
