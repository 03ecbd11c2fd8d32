"""Scenes in a browser: examples, refusals, and moving points."""

import pytest

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.periodic_search import NONE
from support.page import chosen, flat
from support.painted import SOURCES, assert_drawn, assert_painted
from support.thorough import sample

SCENES = scenes()
SLOW = {"orbit-diagram", "ball-diagram"}
# The examples at the end differ most from the first state.
EXAMPLES = [
    pytest.param(scene, preset, id=f"{name}-{preset.name}", marks=[pytest.mark.thorough] * (name in SLOW))
    for name, scene in SCENES.items()
    # The clouds of "singular-measures", too large to be compared, have tests of their own.
    if scene.origin is None and name != "singular-measures"
    # Periodic orbits, which take longest, are for "test_ball".
    for preset in sample([one for one in scene.presets[::-1] if one.values.get("periodic", NONE) == NONE], 1)
]


@pytest.mark.parametrize("scene, preset", sample(EXAMPLES, 2))
def test_an_example_is_drawn_as_the_scene_computes_it(tab, scene, preset):
    explorer = tab.fresh(scene.name)
    values = chosen(explorer, scene, preset)
    assert explorer.chosen("preset") == preset.name
    if "indicator" in values:
        # The points, of which the density is made in stages.
        explorer.change(explorer.choose, "indicator", "nothing")
        values = {**values, "indicator": "nothing"}
    view = assert_drawn(explorer, scene.name, values)
    for picture in scene.open_pictures:
        assert explorer.caption(picture).split() == view.text[picture].split(), picture
    assert_painted(explorer, scene)


@pytest.mark.parametrize("scene", ["chaplygin-ball"])
def test_a_refusal_is_said_in_every_picture_and_nothing_stale_stays(explorer, scene):
    for name in ("I13", "I23"):
        explorer.change(explorer.type, name, "0")
    whole = explorer.text("status").split(" · ")[0]
    assert whole.startswith("I13 = I23 = 0: there is no line of equilibria.")
    assert explorer.text("derived") == ""
    assert {explorer.caption(picture) for picture in SCENES[scene].pictures} == {whole}
    for source in explorer.page.evaluate(SOURCES):
        found = flat(explorer.data(source))
        if source.endswith("-message"):
            assert " ".join(x for x in found if isinstance(x, str)).split() == whole.split(), source
        else:
            # Names of axes are blanks.
            assert set(found) <= {" "}, source
    explorer.change(explorer.page.locator(".param-reset").click)
    assert_painted(explorer, SCENES[scene])
