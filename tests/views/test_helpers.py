"""Layers and words that several scenes share."""

from itertools import product
from math import pi, remainder

import numpy as np
import pytest
from matplotlib.path import Path

from hess_explorer.views.layers import Axes
from hess_explorer.views.plane import section_plane
from hess_explorer.views.text import digits, range_text, with_error
from hess_mechanics.parameters import plain


def test_a_range_that_is_one_number_is_said_to_be_that():
    assert range_text(-1.0, 2.5) == "from −1 to 2.5"
    assert range_text(0.14159, 0.1416) == "= 0.1416"


def test_a_number_is_written_as_one_writes_it():
    written = {100.0: "100", 99.96: "100", 1234.0: "1200", -98765.4: "−99000", 1e6: "1e6", 2.5e-7: "2.5e−7", 0.5: "0.5"}
    assert {value: digits(value, 2) for value in written} == written
    for value, count in product(-np.geomspace(1e-4, 9e5, 200), range(1, 9)):
        assert "e" not in plain(value, count)
        assert float(plain(value, count)) == float(f"{value:.{count - 1}e}")


def test_a_value_has_the_decimals_of_its_error():
    assert with_error(0.09772, 0.0241) == "0.098 ± 0.024"
    assert with_error(-0.00001, 0.00996) == "0.0000 ± 0.0100"
    assert with_error(0.5, 0.0) == "0.5 ± 0"
    assert with_error(123.456, 1e-30) == "123 ± 1e−30"
    assert with_error(123.456, 20.0) == "123 ± 20"


@pytest.mark.parametrize("middle", [-3.0, 0.2, 3.0])
def test_a_band_of_angles_is_grey_also_where_it_goes_round(middle):
    axes = Axes((-pi, pi), (0.0, 1.0))
    parts = [curve for (curve,) in section_plane.band(middle, 0.5, 2.0 * pi, axes)]
    for angle in np.linspace(-pi, pi, 101):
        expected = abs(remainder(angle - middle, 2.0 * pi)) < 0.5
        assert any(Path(part).contains_point((angle, 0.5)) for part in parts) == expected
