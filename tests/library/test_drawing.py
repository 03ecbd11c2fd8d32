"""Results of the mechanics as HoloViews objects."""

import pytest

from hess_mechanics import systems, tube
from hess_mechanics.errors import InvalidParameter


def test_a_result_without_a_curve_says_where_its_numbers_are():
    with pytest.raises(InvalidParameter, match=r"A Tube has no curve to draw: use `to_xarray\(\)` for its numbers"):
        tube(*systems()["suslov"].example_motion, [0.5]).plot()
