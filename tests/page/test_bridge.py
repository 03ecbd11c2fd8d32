"""The scene "bridge" in a browser: the sliders of the side that is not given."""

import pytest
from pytest import approx


@pytest.mark.parametrize("scene", ["bridge"])
def test_the_sliders_of_the_side_that_is_not_given_are_disabled_and_show_it(explorer):
    sides = {"Euler–Poisson": ("I1", "I2", "I3", "m"), "Suslov–Hess": ("I22", "I23", "b3", "share")}

    def disabled():
        names = [name for names in sides.values() for name in names] + ["h", "phi0"]
        found = {name for name in names if explorer.slider(name).is_disabled()}
        assert found == {name for name in names if explorer.box(name).is_disabled()}
        return found

    assert disabled() == set(sides["Suslov–Hess"])
    # I22 = I2/(1 + a²) with a = −1/2, by (3.7).
    assert explorer.box("I22").input_value() == "0.5"
    explorer.change(explorer.choose, "given", "Suslov–Hess")
    assert disabled() == set(sides["Euler–Poisson"])
    explorer.move(I22=0.7)
    assert explorer.shown("I2")[0] == approx(0.7 + 0.25**2 / 0.7, rel=1e-5)
