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


@pytest.mark.parametrize("name, number", sample(OWN, 6))
def test_the_lines_leave_what_is_exported_of_every_picture_of_every_preset(name, number, monkeypatch):
    drawn = []
    # Drawing has tests of its own, and takes as long as all the rest.
    monkeypatch.setattr(SceneState, "plot", lambda self, picture: drawn.append(picture))
    scene = scenes()[name]
    values = {**scene.defaults(), **scene.example(scene.presets[number]), "accuracy": "draft"}
    link = encode(name, {**values, **{key: value for key, value in FEW.items() if key in values}})
    # A chart takes a second and more.
    pictures = [picture for picture in scene.pictures if picture != "chart"]
    for picture in pictures:
        expected, names = columns_of(picture_data(link, picture)), {}
        exec(compile(code(address(link, picture)), "<copied>", "exec"), names)
        data = names["data"]
        assert data.facts == expected.facts
        assert data.keys() == expected.keys()
        for column in expected:
            assert (data[column].dtype, data[column].tobytes()) == (expected[column].dtype, expected[column].tobytes())
    assert drawn == pictures


@pytest.mark.thorough
def test_a_notebook_runs_from_its_first_cell_to_its_last():
    found = address("h=1.2&f=0.3&accuracy=draft", "circle")
    book = nbformat.reads(notebook(found), as_version=4)
    nbformat.validate(book)
    assert found.link in book.cells[0].source
    NotebookClient(book, timeout=120).execute()
    outputs = [output for cell in book.cells for output in cell.get("outputs", [])]
    assert any("application/vnd.holoviews_exec.v0+json" in one.get("data", {}) for one in outputs)
