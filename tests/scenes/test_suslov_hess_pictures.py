"""The torus in space of the Suslov–Hess scene: what it is, and the curves on it."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from support.view import View

SCENE = scenes()["suslov-hess"]
DEFAULTS = SCENE.defaults()
PRESETS = {preset.name: {**DEFAULTS, **preset.values} for preset in SCENE.presets}
a = DEFAULTS["I23"] / DEFAULTS["I22"]


@pytest.mark.parametrize(
    "says, values",
    [
        ("Two limit cycles on the torus.", {}),
        ("No limit cycle on the torus.", {"h": 0.2, "f": 0.5}),
        ("The two cycles have merged.", PRESETS["On the boundary of the Arnold tongue (a = 0.5)"]),
        ("Bifurcation curve: the torus is a circle.", PRESETS["On the bifurcation curve"]),
        ("f = 0: the centre is a circle.", {"h": 0.3, "f": 0.0}),
        ("Separatrix: the centre is the upper equilibrium.", {"h": 1.0, "f": 0.0}),
    ],
)
def test_the_torus_in_space_says_what_it_is_and_its_curves_lie_on_it(says, values):
    values = {**DEFAULTS, **values, "shade": "invariant density"}
    view, h, f = View(SCENE, values), values["h"], values["f"]
    assert view.verdict("surface").startswith(says)
    elliptic = says.startswith("No limit cycle")
    assert ("No density." in view.text["surface"]) is not elliptic
    assert ("re" in view.data["surface"]) is elliptic
    names = [one for one in ("orbit", "stable", "unstable") if view.data.get(f"surface-{one}")]
    assert len(names) == (3 if says.startswith("Two") else 1)
    largest, surface = 2.0 * (h + 1.0), view.data["surface"]
    curves = [view.columns(f"surface-{one}", *"xyz").T for one in names]
    for x, y, z in [*curves, (surface["radius"], 0.0, surface["height"])]:
        square = largest * (np.square(x) + np.square(y))
        rise = largest * np.asarray(z)
        assert rise**2 + f**2 == approx(square * (1.0 - (0.5 * square - h) ** 2), abs=2e-5 * largest)
    # The centre is reached where the caption speaks of it.
    assert bool(surface["radius"][0] < 1e-6) is ("centre" in says)
