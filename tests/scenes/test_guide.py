"""The guide "A scene": its example is a whole scene, and every part that it names is there."""

import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest
from pytest import approx

import hess_explorer
from support.view import View

PACKAGE = Path(hess_explorer.__file__).parent
GUIDE = (PACKAGE / "docs/guides/scene.md").read_text(encoding="utf-8")


def test_the_scene_of_one_call_has_the_pictures_asked_for():
    source, _ = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    found = {}
    exec(source, found)
    assert found["SCENE"].pictures == ("x-z", "t-x", "exponent")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """The scene of the example."""
    file = tmp_path_factory.mktemp("scenes") / "simple.py"
    _, source = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    assert sum(bool(line.strip()) for line in source.splitlines()) <= 60
    file.write_text(source, encoding="utf-8")
    spec = spec_from_file_location("simple_scene", file)
    sys.modules[spec.name] = module_from_spec(spec)
    spec.loader.exec_module(sys.modules[spec.name])
    yield sys.modules[spec.name].SCENE
    del sys.modules[spec.name]


def test_the_example_shows_a_section_and_an_orbit(scene):
    view = View(scene, {}, whole=False)
    assert "crossings of the chosen orbit" in view.text["section"]
    assert len(view.points("own")) == 200
    # Among others, of which thirty crossings come first.
    assert len(view.points("others")) > 300
    assert view.report.todo
    assert view.data["data-orbit"]["t"][-1] == approx(40.0)
    # The orbit starts where the section says, and is one of its energy.
    path = view.result.orbit.path
    assert view.result.poincare.points_of(path.states[:1])[0] == approx((1.0, 1.2))
    assert max(path.drift.values()) < 1e-6


def test_a_click_in_its_section_starts_the_orbit_there(scene):
    moved = View(scene, View(scene, {}, whole=False).stage.pick("section", 0.5, 2.0), whole=False)
    assert moved.result.section.start_point == approx((0.5, 2.0))


def test_each_part_is_in_the_table_of_the_guide():
    files = {file.stem for file in (PACKAGE / "scenes" / "parts").rglob("*.py")} - {"__init__"}
    assert files <= set(re.findall(r"`(\w+)\.\w+`", GUIDE))
