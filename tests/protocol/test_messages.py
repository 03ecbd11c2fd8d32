"""Messages: any JSON is parsed into valid types and bounds; a frame holds the complete response."""

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hess_explorer.protocol.messages import (
    PictureBox,
    PicturePoint,
    Request,
    Response,
    StateResponse,
    StepChoice,
    parse,
)
from support.wire import read_frame

KEYS = [field.name for field in dataclasses.fields(Request)]
scalars = st.one_of(
    st.none(), st.booleans(), st.integers(), st.sampled_from([10**400, -(10**400)]), st.floats(), st.text()
)
anything = st.recursive(
    scalars, lambda part: st.lists(part, max_size=5) | st.dictionaries(st.text(), part, max_size=4), max_leaves=8
)


def numbers_of(request):
    if isinstance(request.picked, PictureBox):
        yield from request.picked.corners
    for point in (request.picked, request.hover):
        if isinstance(point, PicturePoint):
            yield from (point.x, point.y)


@given(st.one_of(anything, st.dictionaries(st.sampled_from([*KEYS, "nobody"]), anything)))
def test_whatever_comes_is_parsed_into_its_types(message):
    request = parse(message)
    if not isinstance(request, Request):
        assert not isinstance(message, dict)
        return
    assert all(isinstance(one, float) and math.isfinite(one) for one in numbers_of(request))
    for value in (request.values or {}).values():
        assert type(value) in (float, str)
    for texts in ((request.expressions or {}).values(), request.hidden or ()):
        assert all(isinstance(text, str) for text in texts)
    for name in ("restore", "scene", "near", "preset", "lesson"):
        assert isinstance(getattr(request, name), str | None)
    for name in ("reset", "clear", "stop", "held"):
        assert getattr(request, name) is (message.get(name) is True)


def test_each_field_of_a_request_is_read():
    plain = {"requested": 3, **dict.fromkeys(("reset", "clear", "stop", "held"), True)}
    plain |= {name: name for name in ("restore", "scene", "near", "preset", "lesson")}
    read = {
        "values": {"h": 2, "accuracy": "draft", "huge": 10**400},
        "expressions": {"f": "pi/3", "h": 3},
        "picked": ["section", 1, 2.5, 3, 4],
        "hover": ["circle", 0, -1],
        "step": ["introduction", 2, True],
        "hidden": ["sphere", 3],
        "nobody": 1,
    }
    assert parse(plain | read) == Request(
        **plain,
        values={"h": 2.0, "accuracy": "draft", "huge": pytest.approx(math.nan, nan_ok=True)},
        expressions={"f": "pi/3"},
        picked=PictureBox("section", (1.0, 2.5, 3.0, 4.0)),
        hover=PicturePoint("circle", 0.0, -1.0),
        step=StepChoice("introduction", 2, True),
        hidden=["sphere"],
    )
    # Empty and missing have different meanings.
    assert parse({"values": {}, "hidden": []}) == Request(values={}, hidden=[])
    # Only true is true.
    assert parse({"held": 1}) == parse({}) == Request()


@given(st.binary(), st.booleans())
def test_a_frame_holds_what_is_told_and_nothing_else(block, has_state):
    state = StateResponse(2, 1, "h=1", {"texts": {"status": "é"}}, "suslov", (1, 3)) if has_state else None
    told, read_block = read_frame(Response('{"name": "suslov"}', "", state, block).encode())
    assert read_block == block
    assert told["scene"] == {"name": "suslov"}
    assert told.keys() == {"scene", *(["state"] if state else [])}
    if state:
        assert told["state"] == {**dataclasses.asdict(state), "progress": [1, 3]}


@pytest.mark.parametrize(
    "place",
    [(math.inf, 1.0), (1.0, math.nan), (0.0, 1.0, 2.0, -math.inf), (10**400, 0.0), *([0.5] * n for n in (0, 3, 5))],
)
def test_a_click_or_box_of_other_numbers_than_two_or_four_finite_ones_is_none(place):
    assert parse({"requested": 1, "picked": ["section", *place]}).picked is None
