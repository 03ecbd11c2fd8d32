"""The scene "ball with a field" in a browser: the search for a periodic orbit."""

import numpy as np
import pytest
from pytest import approx

from support.ball import (
    SECTION,
    angles,
    first_returns,
)
from support.page import brought
from support.painted import track


@pytest.fixture
def field(tab):
    yield brought(tab, SECTION)
    tab.assert_quiet()


def start_of(values):
    """The exact start of the chosen orbit, of which the browser has single precision."""
    return SECTION.compute(values, ("sphere",), False).orbit.path.states[0]


def points(explorer, source):
    data = explorer.data(source)
    return np.column_stack([data["x"], data["y"]])


@pytest.mark.thorough
def test_a_choice_finds_the_periodic_orbit_next_to_the_start_and_undo_leaves_it(field):
    page = field.page

    def found(source):
        page.wait_for_function(f"(hess.source('section-{source}')?.data.x ?? []).length > 0")
        return points(field, f"section-{source}")

    field.change(field.choose, "periodic", "period 1")
    saddle = found("repels")
    page.wait_for_function("(hess.source('section-stable-manifold')?.data.xs ?? []).length > 1")
    assert "\nPeriod 1, saddle. Multipliers μ = 2.19, 0.4566, to " in field.caption("section")
    assert "4 of 4 branches of its manifolds are 5 long" in field.text("derived")
    # Its orbit is that in the other pictures, and closes.
    values = {**SECTION.defaults(), "psi": float(saddle[0, 0]), "delta": float(saddle[0, 1])}
    assert angles(first_returns(values, start_of(values), 1)) == approx(saddle, abs=1e-4)
    assert track(field)[-1] == approx(track(field)[0], abs=1e-4)
    field.wait_url(periodic="period 1")
    field.change(page.locator(".param-undo").click)
    assert field.chosen("periodic") != "period 1"
