"""The scenes "leak off the Hess manifold" and "bridge": both sides, their bounds and their notes."""

from math import copysign, sqrt

import numpy as np
import pytest
from pytest import approx

from support.board import Browser
from support.bridge import BRIDGE, LEAK
from support.view import View

# ---- the leak ----------------------------------------------------------------------------------------------------


def test_energy_and_area_integral_are_kept_inside_what_is_possible():
    view = View(LEAK, {"h": -500.0, "f": 3.0}, noted=True)
    assert view.values["h"] == approx(-9.975)
    assert abs(view.values["f"]) < 1e-4
    assert len(view.notes) == 2
    view = View(LEAK, {"h": 9.975, "f": -8.0}, noted=True)
    # At h = 1 in units b = 1 the curve `Geq3` has n = 1/3 and f = (1 − n²)/√n.
    edge = 8.0 / 9.0 * sqrt(3.0) * sqrt(9.975 * 0.625)
    assert view.values["f"] == approx(-edge, rel=1e-9)
    assert LEAK.limits(view.values)["f"][1] == approx(edge, rel=0.01)


# ---- the bridge --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "values", [*(preset.values for preset in BRIDGE.presets), {"m": -5.0, "h": 3.0, "f": 0.5}], ids=str
)
def test_a_change_of_sides_keeps_the_motion_and_one_back_the_values(values):
    browser = Browser(BRIDGE, {**BRIDGE.defaults(), **values})
    browser.ask(hidden=[])
    body = {"Suslov–Hess": ("I22", "I23", "b3", "share"), "Euler–Poisson": ("I1", "I2", "I3", "m")}
    given = browser.controls["given"]
    (other,) = body.keys() - {given}
    reversed_, seen = values.get("m", 1.0) < 0.0, []
    for side, hidden in ((given, other), (other, given), (given, other)):
        before = dict(browser.controls)
        browser.ask(values={"given": side})
        # Those of the other side are disabled, and none else.
        assert {name for name, one in browser.controls.items() if one[4:] == [True]} == set(body[hidden])
        # The newly enabled controls show the same values as before; for b < 0 the vertical is reversed.
        for name in body[side]:
            wanted = before[name][0]
            if reversed_ and seen and name in ("m", "b3"):
                wanted = copysign(wanted, 1.0 if name == "m" else -1.0)
            assert browser.controls[name][0] == approx(wanted, rel=1e-12), name
        orbit = browser.data["data-orbit"]
        curves = [np.interp(np.linspace(0.0, 10.0, 60), orbit["t"], orbit[name]) for name in ("omega1", "omega2", "x")]
        seen.append((browser.texts["omega"], browser.texts["circle"], np.array(curves)))
        assert browser.texts["notes"].startswith("The orbit is drawn") or browser.texts["notes"] == ""
    for *texts, curves in seen[1:]:
        assert texts == [*seen[0][:2]]
        assert np.all(np.abs(curves - seen[0][2]) <= 2e-3 * np.ptp(seen[0][2], axis=1, keepdims=True))
    if not reversed_:
        # √½ comes back without its last digit.
        known = [one.values for one in BRIDGE.presets if one.name == browser.controls["preset"]]
        assert known == [values] or "m" in values
        for name in (*body[given], "h", "f", "phi0"):
            assert browser.session.values[name] == approx({**BRIDGE.defaults(), **values}[name], rel=1e-14)


def test_what_is_said_with_the_side_is_not_translated():
    browser = Browser(BRIDGE)
    browser.ask(values={"given": "Suslov–Hess", "h": 6.0, "I22": 0.7})
    values = browser.session.values
    assert (values["h"], values["I22"]) == (6.0, 0.7)
    assert (values["I23"], values["f"]) == (-0.25, approx(-5.0 * sqrt(1.6 / 9.975), rel=1e-14))
    # An example says all that it is.
    browser.ask(preset="Two limit cycles, given in Suslov–Hess")
    assert browser.session.values["I22"] == 0.96
    browser.ask(preset="Figure 11, given in Euler–Poisson")
    assert browser.controls["preset"] == "Figure 11, given in Euler–Poisson"
    # If there is no motion, nothing can be carried over, and nothing is hidden.
    browser.ask(values={"I2": 2.0})
    assert {len(one) for one in browser.controls.values() if not isinstance(one, str)} == {4}
    browser.ask(values={"given": "Suslov–Hess", "I22": 1.0, "h": 1.0, "f": 0.5})
    assert browser.session.values["I22"] == 1.0


def test_each_side_keeps_its_own_bounds():
    below = View(BRIDGE, {"given": "Suslov–Hess", "h": -5.0, "f": 0.0}, noted=True)
    assert below.values["h"] == approx(-1.0)
    assert below.notes[0].startswith("In units b = 1")
    inside = View(BRIDGE, {"given": "Suslov–Hess", "h": 1.0, "f": 8.0}, noted=True)
    assert inside.values["f"] == approx(8.0 / 9.0 * sqrt(3.0), rel=1e-9)
    for values in (below.values, inside.values, BRIDGE.defaults()):
        for low, high, step in BRIDGE.limits(values).values():
            assert low < high
            assert 0.0 < step < high - low


def test_next_to_the_unstable_cycle_the_page_says_that_any_round_off_grows():
    phi = next(preset.values["phi0"] for preset in LEAK.presets if "unstable" in preset.name)
    for scene in (LEAK, BRIDGE):
        for values in ({"phi0": phi}, {}):
            notes = " ".join(View(scene, values).report.notes)
            assert ("next to the unstable cycle" in notes) == bool(values)
    assert phi == approx(View(LEAK, {}, seen=()).result.map.fixed_points[1].phi, abs=1e-5)
