"""Volume contraction, by SciPy from the written-out equations."""

import numpy as np
from pytest import approx

from hess_mechanics import SuslovBody
from hess_mechanics.dynamics.basins import Contraction, contraction
from hess_mechanics.suslov.suslov_section import SuslovSection
from support.diagrams import spread
from support.mechanics import followed
from support.suslov import divergence, field

TWO = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), 1.842
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
        (early, late) = followed(rates, [*start, 0.0], [200.0, 600.0], 1e-9, 1e-10)[:, 5]
        assert found.mean == approx((late - early) / 400.0, abs=4.0 * found.error + 1e-4)


def test_where_volume_is_kept_the_mean_is_0():
    body, E = KEPT
    assert contraction(body, starts(body, E)[0].tolist(), 200.0) == Contraction(0.0, 0.0)
