"""The scene "free Suslov problem" in a browser: the moving points."""

from __future__ import annotations

import math

import pytest

from support.free_suslov import (
    FREE,
    gamma_at,
    integrate,
)
from support.page import brought, wait_frames
from support.painted import yellow


@pytest.fixture
def free(tab):
    yield brought(tab, FREE)
    tab.assert_quiet()


def test_play_moves_the_points_along_the_motion(free):
    free.change(lambda: free.slide(w2=0.5))
    values = {**FREE.defaults(), "w2": 0.5}
    before = yellow(free)
    free.play_until(0.7)
    wait_frames(free)
    t = free.time
    gamma = gamma_at(values, math.acos(values["Gamma"]), values["phi"])
    (exact,) = integrate(values, (2.0, 0.5), gamma, [t])

    def place(picture):
        point = free.data(f"{picture}-point")
        return point["x"][0], point["y"][0]

    # Between two samples it runs straight, a quarter of a pixel from the curve at most.
    assert place("omega") == pytest.approx(tuple(exact[:2]), abs=8e-3)
    # ξ = e1.
    assert place("gamma1") == place("Gamma") == pytest.approx((t, exact[2]), abs=4e-3)
    assert yellow(free) != before
    free.change(free.choose, "across", "phase")
    assert place("gamma1") == pytest.approx((math.atan2(exact[4], exact[3]), exact[2]), abs=2e-2)
