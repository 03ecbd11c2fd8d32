"""Examples of all scenes in a browser."""

import pytest

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.periodic_search import NONE
from support.painted import assert_drawn, assert_painted
from support.thorough import sample

SCENES = scenes()
SLOW = {"orbit-diagram", "ball-diagram"}
# The examples at the end differ most from the first state.
EXAMPLES = [
    pytest.param(scene, preset, id=f"{name}-{preset.name}", marks=[pytest.mark.thorough] * (name in SLOW))
    for name, scene in SCENES.items()
    # The clouds of "singular-measures", too large to be compared, have tests of their own.
    if scene.origin is None and name != "singular-measures"
    # Periodic orbits take longest.
    for preset in sample([one for one in scene.presets[::-1] if one.values.get("periodic", NONE) == NONE], 1)
]


@pytest.mark.parametrize("scene, preset", sample(EXAMPLES, 2))
def test_an_example_is_drawn_as_the_scene_computes_it(tab, scene, preset):
    explorer = tab.fresh(scene.name)
    explorer.change(explorer.choose, "preset", preset.name)
    values = {**scene.defaults(), **preset.values}
    assert explorer.chosen("preset") == preset.name
    if "indicator" in values:
        # The points, of which the density is made in stages.
        explorer.change(explorer.choose, "indicator", "nothing")
        values = {**values, "indicator": "nothing"}
    view = assert_drawn(explorer, scene.name, values)
    for picture in scene.open_pictures:
        assert explorer.caption(picture).split() == view.text[picture].split(), picture
    assert_painted(explorer, scene)
