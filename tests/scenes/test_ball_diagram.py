"""The orbit diagrams of the ball in a field: periods near a doubling."""

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from hess_mechanics import ReturnMap, level
from hess_mechanics.dynamics.orbit_diagram import period_of

SCENE = scenes()["ball-diagram"]


@pytest.mark.parametrize("D, period", [(1.4, 8), (1.43, 4), (1.59, 2)])
def test_near_a_doubling_the_period_is_that_of_its_side(D, period):
    # A perturbation of the orbit decays slowly and alternates sides, which made its period look doubled, or infinite.
    state = SCENE.compute({**SCENE.defaults(), "D": D}, (), True)
    map_ = ReturnMap(state.poincare, level("standard"))
    assert period_of(map_.turns, map_.orbit(np.array(state.diagram.point), 700)[500:], map_.promise) == (period, True)
