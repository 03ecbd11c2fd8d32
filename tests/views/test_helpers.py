"""Layers and words that several scenes share."""

from math import pi, remainder
from types import SimpleNamespace

import numpy as np
import pytest

from hess_explorer.scenes.framework import work
from hess_explorer.views.layers import Axes
from hess_explorer.views.plane import section_plane
from hess_explorer.views.text import digits, range_text, with_error
from hess_mechanics.parameters import plain


def test_a_range_that_is_one_number_is_said_to_be_that():
    assert range_text(-1.0, 2.5) == "from −1 to 2.5"
    assert range_text(0.14159, 0.1416) == "= 0.1416"
    assert range_text(0.14159, 0.1416, 6) == "from 0.14159 to 0.1416"
    assert range_text(0.0, 0.0) == "= 0"


def test_a_number_is_written_as_one_writes_it():
    written = {100.0: "100", 99.96: "100", 1234.0: "1200", -98765.4: "−99000", 1e6: "1e6", 2.5e-7: "2.5e−7", 0.5: "0.5"}
    assert {value: digits(value, 2) for value in written} == written
    for value in np.geomspace(1e-4, 9e5, 200):
        for count in range(1, 9):
            for sign in (1.0, -1.0):
                text = plain(sign * value, count)
                assert "e" not in text
                assert float(text) == float(f"{sign * value:.{count - 1}e}")


def test_a_value_has_the_decimals_of_its_error():
    assert with_error(0.09772, 0.0241) == "0.098 ± 0.024"
    assert with_error(-0.00001, 0.00996) == "0.0000 ± 0.0100"
    assert with_error(-0.0069312, 0.000301) == "−0.00693 ± 0.00030"
    assert with_error(0.5, 0.0) == "0.5 ± 0"
    assert with_error(123.456, 1e-30) == "123 ± 1e−30"
    assert with_error(123.456, 20.0) == "123 ± 20"


def test_time_for_compiling_is_said_apart(monkeypatch):
    now, compiling = [100.0], [0.0]
    monkeypatch.setattr(work, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    monkeypatch.setattr(work, "seconds_compiling", lambda: compiling[0])
    one = work.Work()
    now[0] += 0.004
    assert one.summary() == "standard, right to 1e−6 · 4 ms"
    # All but 2 ms of the elapsed time was compilation.
    compiling[0] = 10.54
    now[0] += 10.542
    assert one.summary() == "standard, right to 1e−6 · 6 ms"
    assert one.ended() == "10.5 s to compile, once · 6.0 ms, cached"


def inside(point, curve):
    """Return whether a point lies in a convex closed curve (n, 2)."""
    steps, to_it = np.roll(curve, -1, axis=0) - curve, np.asarray(point) - curve
    turns = steps[:, 0] * to_it[:, 1] - steps[:, 1] * to_it[:, 0]
    return bool(np.all(turns > 0.0) or np.all(turns < 0.0))


@pytest.mark.parametrize("middle", [-3.0, 0.2, 3.0])
def test_a_band_of_angles_is_grey_also_where_it_goes_round(middle):
    axes = Axes((-pi, pi), (0.0, 1.0))
    parts = [curve for (curve,) in section_plane.band(middle, 0.5, 2.0 * pi, axes)]
    for angle in np.linspace(-pi, pi, 101):
        expected = abs(remainder(angle - middle, 2.0 * pi)) < 0.5
        assert any(inside((angle, 0.5), part) for part in parts) == expected
