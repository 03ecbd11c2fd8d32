"""The table of app/README.md with the parts of the paper: it is complete, and the page has everything it names."""

import re

import pytest

from hess_mechanics import check_body
from support.readme import SCENES, named, table

ROWS = table("The paper, part by part")


def test_every_proposition_remark_theorem_and_open_question_is_in_the_table_once():
    parts = [part for part, *_ in ROWS]
    for kind, count in (("Proposition", 7), ("Remark", 7), ("Theorem", 1)):
        found = [int(number) for part in parts for number in re.findall(rf"{kind} (\d+)", part)]
        assert found == list(range(1, count + 1)), kind
    assert sum(part.startswith("Open") for part in parts) == 2
    assert {"Closing remark", "Introduction", "Section 2.1, case 3"} <= set(parts)


@pytest.mark.parametrize("row", ROWS, ids=[row[0][:40] for row in ROWS])
def test_what_a_row_names_is_on_the_page(row):
    part, _, said, where = row
    assert part
    assert said
    places = [one.split("/") for one in re.findall(r"`([^`]+)`", where)]
    assert places
    mentioned = [SCENES[name] for name, *_ in places]
    assert all(picture in SCENES[name].pictures for name, *pictures in places for picture in pictures)
    for title in re.findall(r"\*([^*]+)\*", where):
        examples = [one for scene in {one.name: one for one in mentioned}.values() for one in scene.presets]
        assert len(named(examples, title)) == 1, title
    headings = {heading for scene in mentioned for heading in re.findall(r"^#+ (.+)$", scene.words, re.MULTILINE)}
    assert set(re.findall(r"“([^”]+)”", where)) <= headings


def check_of(state):
    """Return whether a state's body is a rigid body; None if the scene has no body of its own."""
    for one in (
        getattr(state, "body", None),
        getattr(getattr(state, "bridge", None), "heavy", None),
        getattr(getattr(state, "pendulum", None), "body", None),
    ):
        if hasattr(one, "check"):
            return one.check.is_body
        if hasattr(one, "I11"):
            return check_body(one.I11, one.I22, getattr(one, "I13", 0.0), getattr(one, "I23", 0.0)).is_body
    return None


EXAMPLES = [(scene, preset) for scene in SCENES.values() for preset in scene.presets]


@pytest.mark.parametrize(("scene", "preset"), EXAMPLES, ids=[f"{scene.name}: {one.name}" for scene, one in EXAMPLES])
def test_an_example_says_whether_its_body_is_none(scene, preset):
    is_body = check_of(scene.of({**scene.defaults(), **preset.values}))
    assert (is_body is None) == (scene.name == "rotation-number")
    assert (is_body is False) == ("not a rigid body" in preset.name)
