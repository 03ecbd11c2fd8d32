"""A section with very many points draws only those that a picture can distinguish."""

import numpy as np

from hess_explorer.views.plane.layered_section import thin_out


def test_fifty_thousand_points_are_all_drawn():
    points = np.random.default_rng(1).uniform((-3, -1), (3, 1), (50_000, 2))
    assert np.array_equal(thin_out(points, ((-3.0, -1.0), (3.0, 1.0))), points)


def test_of_more_there_is_one_in_each_cell_and_no_cell_is_missed():
    # Dense along a curve, sparse elsewhere; some outside of the window.
    random = np.random.default_rng(2)
    window = (-0.5, 0.25), (0.1, 0.26)
    low, size = np.array(window[0]), np.subtract(window[1], window[0])
    s = random.uniform(0.0, 1.0, 100_000)
    curve = np.column_stack([s, 0.5 + 0.4 * np.sin(7.0 * s)])
    points = low + size * np.concatenate([curve, random.uniform(-0.2, 1.2, (2_000, 2))])
    found = thin_out(points, window)
    assert len(found) < 10_000
    assert {*map(tuple, found.tolist())} <= {*map(tuple, points.tolist())}
    # Wherever there is a point, one is drawn within the diagonal of a cell.
    share, seen = (points - low) / size, (found - low) / size
    within = share[((share >= 0.0) & (share < 1.0)).all(axis=1)]
    for place in within[random.integers(0, len(within), 500)]:
        assert np.abs(seen - place).max(axis=1).min() <= 1.0 / 384.0 + 1e-5
    assert ((seen > -1e-5) & (seen < 1.0 + 1e-5)).all()
    assert thin_out(np.full((60_000, 2), 5.0), window).shape == (0, 2)
