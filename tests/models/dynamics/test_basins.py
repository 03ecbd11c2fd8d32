"""Volume contraction, by SciPy from the written-out equations."""

import numpy as np
from pytest import approx, mark
from scipy.integrate import solve_ivp

from hess_mechanics import SuslovBody
from hess_mechanics.dynamics.basins import Contraction, contraction
from hess_mechanics.suslov.section import SuslovSection
from support.deviations import deviations
from support.diagrams import spread
from support.suslov import divergence, field

STRANGE = SuslovBody(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7), 0.681
TWO = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842
# A chaotic sea whose motions are their own mirror images backward in time; and a body that keeps volume.
SEA = SuslovBody(1.5, 3.0, 0.4, 0.4, -0.5, -0.5, 0.7), 0.005
KEPT = SuslovBody(1.5, 3.0, 0.0, 0.0, -0.5, 0.6, 0.7), 0.95


def starts(body, E, count=3):
    states, _ = SuslovSection(body, E, 3).states_at(*spread(SuslovSection(body, E, 3), count).T)
    return states


def test_the_mean_divergence_is_that_of_scipy():
    body, E = TWO
    # It is linear, since the field is quadratic.
    slopes = [divergence(body, one) for one in np.eye(5)]

    def rates(_, y):
        y = y[:5].tolist()
        return [*field(body, y), float(np.dot(slopes, y))]

    for start in starts(body, E):
        assert np.dot(slopes, start) == approx(divergence(body, start), abs=1e-14)
        found = contraction(body, start.tolist(), 600.0)
        run = solve_ivp(rates, (0.0, 600.0), [*start, 0.0], "DOP853", [200.0, 600.0], rtol=1e-9, atol=1e-10)
        assert found.mean == approx((run.y[5, 1] - run.y[5, 0]) / 400.0, abs=4.0 * found.error + 1e-4)


@mark.chaotic
@mark.parametrize(
    ("body", "E", "attracts"),
    [(*STRANGE, True), (*TWO, True), (*SEA, False), (*KEPT, False)],
    ids=["strange", "two", "sea", "volume kept"],
)
def test_an_attractor_is_claimed_where_volume_shrinks_and_only_there(body, E, attracts):
    found = [contraction(body, start.tolist(), 1000.0) for start in starts(body, E, 36)]
    if body == KEPT[0]:
        assert not any(one.attracts for one in found)
        return
    # An attractor is claimed below −3; where a motion has come to rest the error is next to nothing.
    scores = np.clip([one.mean / one.error for one in found], -10.0, 10.0)
    assert np.sign(deviations(scores, -3.0)) == (-1.0 if attracts else 1.0)
    assert abs(deviations(scores, -3.0)) > 5.0
    assert deviations(np.array([one.attracts is attracts for one in found]), 0.5) > 5.0


def test_where_volume_is_kept_the_mean_is_0():
    body, E = KEPT
    assert contraction(body, starts(body, E)[0].tolist(), 200.0) == Contraction(0.0, 0.0)
