"""Every picture of every scene as tables and as a figure."""

import io
import json
import math

import numpy as np
import pytest
from PIL import Image

from hess_explorer.export.columns import columns_of
from hess_explorer.export.formats import FileRequest
from hess_explorer.export.picture_data import address, picture_data
from hess_explorer.export.table import as_csv, as_json
from hess_explorer.headless.file import content
from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes
from support.exported import read
from support.thorough import sample
from support.view import values_of

PICTURES = [
    (name, picture)
    for name, scene in scenes().items()
    if scene.origin is None
    for picture in scene.pictures
    # One chart is enough: each takes a second and more.
    if picture != "chart" or name == "suslov-hess"
]
ELSEWHERE = {("suslov", "conformal"): "On a principal axis"}
"""Pictures that are empty at first, and the examples that fill them."""


@pytest.mark.usefixtures("browser")
@pytest.mark.parametrize("scene, picture", sample(PICTURES, 8))
def test_every_picture_has_tables_and_a_figure(scene, picture):
    wanted = ELSEWHERE.get((scene, picture))
    example = values_of(scenes()[scene], wanted) if wanted else {}
    values = {**scenes()[scene].defaults(), **example, "accuracy": "draft"}
    found = picture_data(encode(scene, values), picture)
    assert_numbers(found, values)
    drawn = Image.open(io.BytesIO(content(found, FileRequest("png", 40.0))))
    assert found.metadata_text in drawn.info["Description"]
    ink = np.asarray(drawn.convert("L")) < 200
    # Something inside the frame: the plain frame with its ticks and names is on the outer fifth.
    inner = ink[ink.shape[0] // 5 : -ink.shape[0] // 5, ink.shape[1] // 5 : -ink.shape[1] // 5]
    assert inner.mean() > 0.002


def assert_numbers(found, values):
    """Assert that the tables hold finite numbers and the metadata, with a link that restores the state."""
    facts, table = read(as_csv(found))
    whole = json.loads(as_json(found), parse_constant=pytest.fail)
    assert {"link", "parameters", "status", "program", "caption"} <= facts.keys() & whole.keys()
    assert facts["parameters"] == whole["parameters"] == values
    assert address(facts["link"], found.picture.name).values == values
    assert facts["status"][0] == "accuracy: draft"
    numbers = [float(value) for row in table for name, value in row.items() if value and name not in ("layer", "text")]
    assert len(numbers) > 10 or whole["caption"]
    assert all(map(math.isfinite, numbers))
    assert {row["layer"] for row in table} <= whole["layers"].keys()
    # All digits, and nothing where there is no number.
    for name, column in columns_of(found).columns.items():
        if column.dtype.kind == "f":
            assert [row[name] and float(row[name]) for row in table] == [x if np.isfinite(x) else "" for x in column]
