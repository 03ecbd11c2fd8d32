"""Copy Python: the copied code computes exactly the exported data, bit by bit."""

import nbformat
import pytest
from nbclient import NotebookClient

from hess_explorer import SceneState
from hess_explorer.export.code import code
from hess_explorer.export.columns import columns_of
from hess_explorer.export.notebook import notebook
from hess_explorer.export.picture_data import address, picture_data
from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes
from support.thorough import sample

OWN = [
    (scene.name, number) for scene in scenes().values() if scene.origin is None for number in range(len(scene.presets))
]


FEW = {"orbits": 4.0, "count": 20.0, "long": 50.0, "steps": 20.0, "periodic": "none"}
"""Few orbits and crossings, for speed."""


def ran(lines):
    names = {}
    exec(compile(lines, "<copied>", "exec"), names)
    return names["data"]


def same_bits(a, b):
    return a.dtype == b.dtype and a.tobytes() == b.tobytes()


def link_of(name, number):
    scene = scenes()[name]
    values = {**scene.defaults(), **scene.example(scene.presets[number]), "accuracy": "draft"}
    return encode(name, {**values, **{key: value for key, value in FEW.items() if key in values}})


@pytest.mark.parametrize("name, number", sample(OWN, 6))
def test_the_lines_leave_what_is_exported_of_every_picture_of_every_preset(name, number, monkeypatch):
    drawn = []
    # Drawing has tests of its own, and takes as long as all the rest.
    monkeypatch.setattr(SceneState, "plot", lambda self, picture: drawn.append(picture))
    link = link_of(name, number)
    # A chart takes a second and more; its turn is below.
    views = [view for view in scenes()[name].views if view.name != "chart"]
    for view in views:
        expected = columns_of(picture_data(link, view.name))
        data = ran(code(address(link, view.name)))
        assert data.facts == expected.facts
        assert data.keys() == expected.keys()
        assert all(same_bits(data[column], expected[column]) for column in expected)
    assert drawn == [view.name for view in views]


def test_the_lines_are_few_and_name_every_parameter():
    lines = code(address("scene=suslov&starts=0.5,1&b1=-0.25", "section"))
    assert len(lines.splitlines()) < 14
    assert max(map(len, lines.splitlines()[2:])) <= 110
    given = lines.split("hess.state(")[1]
    names = [spec.name for spec in scenes()["suslov"].specs if spec.name != "window" and spec.name[:5] != "chart"]
    assert all(f"{name}=" in given for name in names)
    assert "starts=[(0.5,1.0)]" in given
    assert "b1=-0.25" in given


@pytest.mark.thorough
def test_a_notebook_runs_from_its_first_cell_to_its_last():
    found = address("h=1.2&f=0.3&accuracy=draft", "circle")
    book = nbformat.reads(notebook(found), as_version=4)
    nbformat.validate(book)
    assert found.link in book.cells[0].source
    NotebookClient(book, timeout=120).execute()
    kinds = [
        kind
        for cell in book.cells
        if cell.cell_type == "code"
        for output in cell.outputs
        for kind in output.get("data", {})
    ]
    assert "application/vnd.holoviews_exec.v0+json" in kinds
