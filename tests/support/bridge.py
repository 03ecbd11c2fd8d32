"""The leak off the Hess manifold and the bridge, and their units by hand."""

from math import copysign, sqrt

from hess_explorer.scenes import scenes

HELD = "At most # up to t = # if r·M = 0 is imposed; # if not."
LEAK, BRIDGE = scenes()["hess-leak"], scenes()["bridge"]


def torus(values):
    """a, h, f in units b = 1 and the unit of frequency √b, by hand from the moments."""
    a1, a2, a3 = (1.0 / values[name] for name in ("I1", "I2", "I3"))
    # Here r1, r3 > 0: b' has the sign of a1 − a3.
    a = copysign(sqrt((a3 - a2) * (a2 - a1)), a1 - a3) / a2
    b = a2 * values["m"]
    return a, a2 * values["h"] / b, -a2 * values["f"] / sqrt(b), sqrt(b)


def values_of(scene, name):
    preset = next(one for one in scene.presets if one.name == name)
    return {**scene.defaults(), **preset.values}


UNSTABLE = [preset.name for preset in LEAK.presets if preset.values.get("h", 50.0) not in (5.0, 0.3)]
STABLE = [preset.name for preset in LEAK.presets if preset.name not in UNSTABLE]
