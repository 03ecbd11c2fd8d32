"""The scene "bridge" in a browser: the sliders of the side that is not given."""

import pytest
from pytest import approx

from support.bridge import BRIDGE
from support.page import brought


@pytest.fixture
def bridge(tab):
    yield brought(tab, BRIDGE)
    tab.assert_quiet()


def test_the_sliders_of_the_side_that_is_not_given_are_disabled_and_show_it(bridge):
    sides = {"Euler–Poisson": ("I1", "I2", "I3", "m"), "Suslov–Hess": ("I22", "I23", "b3", "share")}

    def disabled():
        names = [name for names in sides.values() for name in names] + ["h", "phi0"]
        found = {name for name in names if bridge.slider(name).is_disabled()}
        assert found == {name for name in names if bridge.box(name).is_disabled()}
        # Slider and box each say why.
        said = bridge.page.locator(".number :disabled").evaluate_all("items => items.map((item) => item.title)")
        assert len(said) == 2 * len(found)
        assert all(title.startswith("Disabled: ") for title in said)
        return found

    assert disabled() == set(sides["Suslov–Hess"])
    # By hand, from (3.7): I22 = I2/(1 + a²), a = −1/2, b3 = −μ|r|/√(1 + a²); six digits, the box has no room for more.
    assert [bridge.box(name).input_value() for name in sides["Suslov–Hess"]] == ["0.5", "-0.25", "-8.92191", "1"]
    bridge.change(bridge.choose, "given", "Suslov–Hess")
    assert disabled() == set(sides["Euler–Poisson"])
    assert [bridge.shown(name)[0] for name in sides["Euler–Poisson"]] == [1.0, 0.625, 0.375, 9.975]
    assert bridge.shown("h")[0] == approx(50.0 / 9.975)
    bridge.change(lambda: bridge.slide(I22=0.7))
    assert bridge.shown("I2")[0] == approx(0.7 + 0.25**2 / 0.7, rel=1e-5)
