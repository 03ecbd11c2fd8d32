"""The scene "ball with a field" in a browser: the search for a periodic orbit."""

import pytest
from pytest import approx

from support.ball import (
    SECTION,
)
from support.page import brought
from support.painted import track


@pytest.fixture
def field(tab):
    yield brought(tab, SECTION)
    tab.assert_quiet()


@pytest.mark.thorough
def test_a_choice_finds_the_periodic_orbit_next_to_the_start_and_undo_leaves_it(field):
    page = field.page
    field.change(field.choose, "periodic", "period 1")
    page.wait_for_function("(hess.source('section-repels')?.data.x ?? []).length > 0")
    page.wait_for_function("(hess.source('section-stable-manifold')?.data.xs ?? []).length > 1")
    assert "\nPeriod 1, saddle. Multipliers μ = 2.19, 0.4566, to " in field.caption("section")
    assert "4 of 4 branches of its manifolds are 5 long" in field.text("derived")
    # Its orbit is that in the other pictures, and closes.
    assert track(field)[-1] == approx(track(field)[0], abs=1e-4)
    field.wait_url(periodic="period 1")
    field.change(page.locator(".param-undo").click)
    assert field.chosen("periodic") != "period 1"
