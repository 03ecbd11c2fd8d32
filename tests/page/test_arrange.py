"""Where pictures stand: the arrangement that "arrange.js" finds, by itself."""

from __future__ import annotations

import itertools

import pytest

# arrange() of a place whose captions are `over` high, and 20 over small ones.
ARRANGE = """([width, height, count, over, large]) => hess.arrange({
  width, height, count, gap: 8, caption: Object.assign(() => over, { title: 20, wide: 400 }),
}, large)"""

PLACES = [(964.0, 620.0), (936.0, 850.0), (2500.0, 2010.0), (1900.0, 500.0), (500.0, 1400.0), (700.0, 700.0)]


@pytest.fixture(scope="module")
def arrange(tab):
    tab.fresh()
    return lambda *place: tab.page.evaluate(ARRANGE, list(place))


def assert_within(boxes, width, height):
    """Inside, with their captions, and apart from each other."""
    cells = [(box["x"], box["y"], box["x"] + box["width"], box["y"] + box["caption"] + box["edge"]) for box in boxes]
    for left, top, right, bottom in cells:
        assert -0.5 <= left < right <= width + 0.5
        assert -0.5 <= top < bottom <= height + 0.5
    for one, other in itertools.combinations(cells, 2):
        assert (
            one[2] <= other[0] + 0.5 or other[2] <= one[0] + 0.5 or one[3] <= other[1] + 0.5 or other[3] <= one[1] + 0.5
        )


def largest_in_columns(width, height, count, over):
    """The edge of equal squares with captions, by trying all numbers of columns."""
    return max(
        min((width - 8 * (columns - 1)) / columns, (height - 8 * (rows - 1)) / rows - over)
        for columns in range(1, count + 1)
        for rows in [-(-count // columns)]
    )


def test_the_smallest_picture_is_as_large_as_it_can_be_and_all_is_inside(arrange):
    for (width, height), count in itertools.product(PLACES, range(1, 6)):
        boxes = arrange(width, height, count, 38.0, [])
        assert len(boxes) == count
        assert_within(boxes, width, height)
        smallest = min(box["edge"] for box in boxes)
        assert smallest >= largest_in_columns(width, height, count, 38.0) - 1.0
        assert not any(box["small"] for box in boxes)


def test_an_enlarged_picture_has_its_share_of_the_height_and_the_others_what_is_left(arrange):
    for (width, height), count, large in itertools.product(PLACES[:4], range(2, 6), ([0], [1], [1, 0])):
        boxes = arrange(width, height, count, 38.0, large)
        assert_within(boxes, width, height)
        chosen = [boxes[i]["edge"] for i in large]
        others = [box["edge"] for i, box in enumerate(boxes) if i not in large]
        assert min(chosen) >= max(others, default=0.0)
        if len(large) == 1:
            assert chosen[0] >= 0.8 * min(height, width / 1.3)
            assert all(box["small"] for i, box in enumerate(boxes) if i not in large)
        assert min(others, default=height) > 0.05 * height


def test_of_three_one_is_larger_where_that_costs_the_others_nothing(arrange):
    boxes = arrange(936.0, 850.0, 3, 38.0, [])
    assert boxes[0]["edge"] > boxes[1]["edge"] == boxes[2]["edge"]
    assert boxes[1]["edge"] >= largest_in_columns(936.0, 850.0, 3, 38.0) - 1.0


def test_no_picture_needs_no_place(arrange):
    assert arrange(900.0, 600.0, 0, 38.0, []) == []
