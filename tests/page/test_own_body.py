"""*Your own body*: a potential is typed, compiled in the background, and goes into the link."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics import solve
from support.page import brought

SCENE = scenes()["own-body"]


@pytest.fixture
def explorer(tab):
    yield brought(tab, SCENE)
    tab.assert_quiet()


def assert_shown(explorer, **values):
    """Assert that the orbit in the picture is that of the body with these values."""
    state = SCENE.of({**SCENE.defaults(), **values})
    shown = {name: np.array(explorer.data("data-orbit")[name]) for name in ("t", "ω1", "ω2")}
    exact = solve(state.body, state.start, shown["t"][1:], "precise").states
    assert exact[:, 0] == approx(shown["ω1"][1:], abs=1e-4)
    assert exact[:, 1] == approx(shown["ω2"][1:], abs=1e-4)


def test_a_typed_potential_is_shown_and_goes_into_the_link(explorer):
    assert_shown(explorer)
    explorer.change(explorer.type, "U", "g3^2/2 - g1*g2")
    explorer.picture("omega").get_by_text("From t = 0").wait_for()
    assert_shown(explorer, U="g3^2/2 - g1*g2")
    assert explorer.wait_url(U="g3^2/2 - g1*g2")["scene"] == "own-body"
    # Other numbers need no compilation.
    explorer.change(explorer.type, "U", "0.3*g3^2 - 2*g1*g2")
    assert_shown(explorer, U="0.3*g3^2 - 2*g1*g2")


def test_a_formula_that_cannot_be_read_says_why_stays_to_be_corrected_and_changes_nothing(explorer):
    explorer.change(explorer.type, "U", "g3 +")
    assert "This is no polynomial: use numbers, g1, g2, g3" in explorer.text("notes")
    assert explorer.box("U").input_value() == "g3 +"
    assert_shown(explorer)
    explorer.change(explorer.type, "U", "g3 - 2*g1")
    assert explorer.text("notes") == ""
    assert_shown(explorer, U="g3 - 2*g1")


def test_without_a_constraint_its_vector_has_no_effect_and_a_drive_does_work(explorer):
    explorer.change(explorer.choose, "constraint", "none")
    assert explorer.box("a1").is_disabled()
    assert_shown(explorer, constraint="none")
    explorer.change(explorer.choose, "preset", "Driven Suslov body")
    explorer.picture("energy").get_by_text("The drive does work.").wait_for()
    assert not explorer.box("frequency").is_disabled()
    error = explorer.caption("energy").partition("≤ ")[2].rstrip(".").replace("−", "-")
    assert float(error) < 1e-5
    # Its rotor is along the axis about which the constraint lets nothing turn.
    explorer.change(explorer.choose, "constraint", "(a, ω) = 0")
    explorer.picture("energy").get_by_text("The drive does no work.").wait_for()
