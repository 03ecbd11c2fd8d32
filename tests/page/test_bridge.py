"""The scenes "leak off the Hess manifold" and "bridge" in a browser: examples, a slider, a click, a link, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from support.bridge import BRIDGE, HELD, LEAK, STABLE, exact_growth, growth_at, torus
from support.page import brought, chosen, said
from support.painted import assert_painted
from support.pointer import click_on
from support.thorough import sample


@pytest.fixture
def leak(tab):
    yield brought(tab, LEAK)
    tab.assert_quiet()


@pytest.fixture
def bridge(tab):
    yield brought(tab, BRIDGE)
    tab.assert_quiet()


@pytest.mark.parametrize("preset", sample(LEAK.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_the_leak_is_drawn_with_the_rate_of_its_caption(leak, preset):
    values = chosen(leak, LEAK, preset)
    assert leak.chosen("preset") == preset.name
    (curve,) = leak.data("leak-own")["ys"]
    if preset.name in STABLE:
        (largest,) = said(leak, "leak", "Stable: no cycles, no growth. After 60 periods |r·M| ≤ #.")
        assert max(curve) == pytest.approx(math.log10(largest), abs=0.05)
        assert largest < 3e-14
    else:
        measured, _, exact = said(leak, "leak", "ln |r·M|: # per period, measured over # periods; exact #.")
        expected = 2.0 * math.pi * abs(torus(values)[0]) if values["f"] == 0.0 else exact_growth(preset.name)
        assert (measured, exact) == (pytest.approx(expected, rel=1e-4), pytest.approx(expected, rel=1e-5))
        assert curve[-1] > -4.0
    assert_painted(leak, LEAK)


@pytest.mark.parametrize("preset", BRIDGE.presets, ids=lambda preset: preset.name)
def test_an_example_of_the_bridge_is_drawn_with_a_difference_of_round_off(bridge, preset):
    # The side on which it is given is part of an example.
    chosen(bridge, BRIDGE, preset)
    assert bridge.chosen("preset") == preset.name
    assert bridge.chosen("given") == preset.values["given"]
    held, end, _ = said(bridge, "difference", HELD)
    assert end == 50.0
    assert held <= 1e-11
    (curve,) = bridge.data("difference-held")["ys"]
    assert max(curve) == pytest.approx(math.log10(held), abs=0.05)
    assert_painted(bridge, BRIDGE)


def test_a_slider_changes_the_rate_and_a_refusal_empties_the_pictures(leak):
    leak.change(lambda: leak.slide(h=80.0))
    assert leak.shown("h")[0] == 80.0
    *_, exact = said(leak, "leak", "ln |r·M|: # per period, measured over # periods; exact #.")
    assert exact == pytest.approx(growth_at({**LEAK.defaults(), "h": 80.0}), rel=1e-5)
    leak.change(leak.type, "I2", "2")
    for picture in LEAK.pictures:
        assert "I2 = 2 must lie between I1 = 1 and I3 = 0.375" in leak.caption(picture)
    assert leak.data("leak-own")["ys"] == []
    assert leak.data("data-orbit")["t"] == []
    leak.change(leak.type, "I2", "0.625")
    assert_painted(leak, LEAK)


def test_the_moving_points_go_along_the_exact_motion_in_every_picture(leak):
    leak.set_time(4.0)
    orbit = {name: np.array(column) for name, column in leak.data("data-orbit").items()}
    for picture, x, y in (("leak", "t", "lg"), ("difference", "t", "apart"), ("andoyer", "l", "x")):
        point = leak.data(f"{picture}-point")
        expected = [np.interp(4.0, orbit["t"], orbit[name]) for name in (x, y)]
        assert (point["x"][0], point["y"][0]) == pytest.approx(expected, abs=0.02), picture


def test_a_click_in_the_circle_map_starts_the_motion_at_that_phase(bridge):
    bridge.unfold("circle")
    before = bridge.data("data-orbit")["omega1"][0]
    unit = click_on(bridge, "circle", -0.8, 1.0)
    assert bridge.shown("phi0")[0] == pytest.approx(-0.8, abs=2.0 * unit[0])
    orbit = bridge.data("data-orbit")
    assert math.atan2(orbit["omega1"][0], orbit["omega2"][0] / math.hypot(1.0, 0.5)) == pytest.approx(-0.8, abs=0.02)
    assert orbit["omega1"][0] != before


def test_the_sliders_of_the_side_that_is_not_given_are_disabled_and_show_it(bridge):
    sides = {"Euler–Poisson": ("I1", "I2", "I3", "m"), "Suslov–Hess": ("I22", "I23", "b3", "share")}

    def disabled():
        names = [name for names in sides.values() for name in names] + ["h", "phi0"]
        found = {name for name in names if bridge.slider(name).is_disabled()}
        assert found == {name for name in names if bridge.box(name).is_disabled()}
        # Slider, box and the button that moves them each say why.
        said = bridge.page.locator(".number :disabled").evaluate_all("items => items.map((item) => item.title)")
        assert len(said) == 3 * len(found)
        assert all(title.startswith("Disabled: ") for title in said)
        return found

    assert disabled() == set(sides["Suslov–Hess"])
    # By hand, from (3.7): I22 = I2/(1 + a²), a = −1/2, b3 = −μ|r|/√(1 + a²); six digits, the box has no room for more.
    assert [bridge.box(name).input_value() for name in sides["Suslov–Hess"]] == ["0.5", "-0.25", "-8.92191", "1"]
    before = bridge.data("data-orbit")
    bridge.change(bridge.choose, "given", "Suslov–Hess")
    assert disabled() == set(sides["Euler–Poisson"])
    assert bridge.slider("I22").is_enabled()
    assert [bridge.shown(name)[0] for name in sides["Euler–Poisson"]] == [1.0, 0.625, 0.375, 9.975]
    assert bridge.shown("h")[0] == pytest.approx(50.0 / 9.975)
    after = bridge.data("data-orbit")
    for name in ("omega1", "omega2", "l", "x"):
        at = np.linspace(0.0, 5.0, 50)
        curves = [np.interp(at, one["t"], one[name]) for one in (before, after)]
        assert curves[0] == pytest.approx(curves[1], abs=1e-2)
    # The Tab key passes them over, and they say why.
    bridge.slider("h").focus()
    reached = set()
    for _ in range(60):
        bridge.page.keyboard.press("Tab")
        reached.add(
            bridge.page.evaluate("""() => {
          let item = document.activeElement
          while (item?.shadowRoot?.activeElement) item = item.shadowRoot.activeElement
          return item?.closest(".number")?.className.split("param-")[1] ?? ""
        }""")
        )
    assert set(sides["Suslov–Hess"]) <= reached
    assert not reached.intersection(sides["Euler–Poisson"])
    assert bridge.slider("I2").get_attribute("aria-description").startswith("Disabled: no effect")
    assert not bridge.slider("I22").get_attribute("aria-description").startswith("Disabled")
    bridge.change(lambda: bridge.slide(I22=0.7))
    assert bridge.shown("I2")[0] == pytest.approx(0.7 + 0.25**2 / 0.7, rel=1e-5)
    bridge.change(bridge.choose, "given", "Euler–Poisson")
    assert disabled() == set(sides["Suslov–Hess"])
    assert bridge.shown("I2")[0] == pytest.approx(0.7 + 0.25**2 / 0.7, rel=1e-14)


def test_moments_and_energy_stay_from_one_scene_to_the_next(leak):
    leak.change(lambda: leak.slide(h=60.0, I3=0.4))
    leak.enter("bridge")
    assert (leak.shown("h")[0], leak.shown("I3")[0]) == (60.0, 0.4)
    leak.unfold("andoyer")
    assert leak.caption("andoyer").startswith(
        "Euler–Poisson: (l, L/G)\nThe Hess relation holds along the orbit. H = 60,"
    )
    assert_painted(leak, BRIDGE)
