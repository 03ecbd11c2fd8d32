"""Statements of the lesson on period doubling, computed."""

import numpy as np
import pytest

from hess_explorer.lessons import package_lessons
from hess_explorer.scenes import scenes
from support.deviations import deviations
from support.diagrams import nearest, settled
from support.lesson_on_doubling import NAME, end

STEPS = {step.title: step for step in package_lessons()[NAME].steps}


@pytest.mark.chaotic
def test_beyond_the_end_no_short_period_is_left_and_other_starts_come_to_the_same_set():
    assert STEPS["The repeller"].state.values["I23"] == STEPS["Beyond the doublings"].state.values["I23"] > end(None)[1]
    section = scenes()["orbit-diagram"].of(STEPS["The repeller"].state.values).poincare
    orbits = settled(section, 24, 200)
    # The farthest places of each orbit from those of all others, one in a hundred.
    off = [
        np.quantile(nearest(own, np.concatenate([*orbits[:i], *orbits[i + 1 :]])), 0.99) for i, own in enumerate(orbits)
    ]
    assert deviations(off, 0.01) < -5.0
    for period in range(1, 65):
        farthest = np.abs(orbits[:, period:] - orbits[:, :-period]).max(axis=(1, 2))
        assert deviations(farthest, 0.05) > 5.0
