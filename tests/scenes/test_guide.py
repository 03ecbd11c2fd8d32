"""The guide "A scene": its example is a whole scene, and every part that it names is there."""

from __future__ import annotations

import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

import hess_explorer
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.stage import Stage
from support.captions import texts_in
from support.wire import read

PACKAGE = Path(hess_explorer.__file__).parent
GUIDE = (PACKAGE / "docs/guides/scene.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """The scene of the example."""
    file = tmp_path_factory.mktemp("scenes") / "simple.py"
    (source,) = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    assert sum(bool(line.strip()) for line in source.splitlines()) <= 60
    file.write_text(source, encoding="utf-8")
    spec = spec_from_file_location("simple_scene", file)
    sys.modules[spec.name] = module_from_spec(spec)
    spec.loader.exec_module(sys.modules[spec.name])
    yield sys.modules[spec.name].SCENE
    del sys.modules[spec.name]


def shown(scene, values):
    wire = Wire()
    state = scene.compute(values, scene.pictures, False)
    report = Stage(scene, wire).show(state, hold_axes=False)
    tree, block = wire.pack()
    return (
        state,
        report,
        tree,
        {
            name: {key: read(column, block) for key, column in columns.items()}
            for name, columns in tree["sources"].items()
        },
    )


def test_the_example_shows_a_section_and_an_orbit(scene):
    state, report, tree, data = shown(scene, scene.defaults())
    assert "crossings of the chosen orbit" in texts_in(tree)["section"]
    assert len(data["section-own"]["x"]) == 200
    # Among others, of which thirty crossings come first.
    assert len(data["section-others"]["x"]) > 300
    assert report.todo
    assert data["data-orbit"]["t"][-1] == pytest.approx(40.0)
    # The orbit starts where the section says, and is one of its energy.
    assert state.poincare.places_of(state.orbit.path.states[:1])[0] == pytest.approx((1.0, 1.2))
    assert max(state.orbit.path.drift.values()) < 1e-6


def test_a_click_in_its_section_starts_the_orbit_there(scene):
    state = scene.compute(scene.defaults(), ("section",), False)
    (picture,) = (view for view in scene.views if view.name == "section")
    moved, notes = scene.admit({**scene.defaults(), **picture.on_click(state, 0.5, 2.0)})
    assert notes == []
    there = scene.compute(moved, ("section",), False)
    assert there.section.aim == pytest.approx((0.5, 2.0))


def test_each_part_is_in_the_table_of_the_guide():
    files = {file.stem for file in (PACKAGE / "scenes" / "parts").glob("*.py")} - {"__init__"}
    assert files <= set(re.findall(r"`(\w+)\.\w+`", GUIDE))
