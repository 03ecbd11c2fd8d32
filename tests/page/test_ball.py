"""The scene "ball with a field" in a browser: the search for a periodic orbit."""

import pytest
from pytest import approx

from support.ball import (
    SECTION,
)
from support.painted import track


@pytest.fixture
def scene():
    return SECTION.name


@pytest.mark.thorough
def test_a_choice_finds_the_periodic_orbit_next_to_the_start_and_undo_leaves_it(explorer):
    page = explorer.page
    explorer.change(explorer.choose, "periodic", "period 1")
    page.wait_for_function("(hess.source('section-repels')?.data.x ?? []).length > 0")
    page.wait_for_function("(hess.source('section-stable-manifold')?.data.xs ?? []).length > 1")
    assert "\nPeriod 1, saddle. Multipliers μ = 2.19, 0.4566, to " in explorer.caption("section")
    assert "4 of 4 branches of its manifolds are 5 long" in explorer.text("derived")
    # Its orbit is that in the other pictures, and closes.
    assert track(explorer)[-1] == approx(track(explorer)[0], abs=1e-4)
    explorer.wait_url(periodic="period 1")
    explorer.change(page.locator(".param-undo").click)
    assert explorer.chosen("periodic") != "period 1"
