"""Results of the mechanics as HoloViews objects."""

import numpy as np
import pytest

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.labelled import Labels, Result


class Cube(Result):
    """Numbers over three coordinates."""

    def labels(self):
        coords = {name: ((name,), np.arange(2.0)) for name in "abc"}
        return Labels(coords, {"value": (("a", "b", "c"), np.zeros((2, 2, 2)))})


def test_a_result_without_a_curve_says_where_its_numbers_are():
    with pytest.raises(InvalidParameter, match=r"A Cube has no curve to draw: use `to_xarray\(\)` for its numbers"):
        Cube().plot()
