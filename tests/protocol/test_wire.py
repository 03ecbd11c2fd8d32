"""The wire: packed data can be read back exactly, and nothing is sent twice."""

import json

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from hess_explorer.protocol.wire import Wire
from support.thorough import examples
from support.wire import read


def unpack(wire):
    """Return the columns by source after a round trip through JSON, and the block."""
    tree, block = wire.pack()
    assert isinstance(block, bytes)
    tree = json.loads(json.dumps(tree, allow_nan=False))
    assert set(tree) == {"sources", "ranges", "texts", "captions", "controls"}
    columns = {
        source: {name: read(column, block) for name, column in columns.items()}
        for source, columns in tree["sources"].items()
    }
    return columns, block


def size_of(item):
    """The number of elements of all arrays in nested lists."""
    if isinstance(item, list):
        return sum(map(size_of, item))
    return item.size if isinstance(item, np.ndarray) else 0


def same(left, right):
    """Equal shapes of lists, and equal single-precision numbers at their ends."""
    if isinstance(left, np.ndarray):
        return isinstance(right, np.ndarray) and np.array_equal(left.astype("<f4"), right, equal_nan=True)
    if isinstance(left, list):
        return isinstance(right, list) and len(left) == len(right) and all(map(same, left, right))
    return type(left) is type(right) and left == right


vectors = arrays.arrays(
    st.sampled_from([np.float32, np.float64]),
    st.integers(0, 40),
    elements=st.floats(-1e6, 1e6, width=32),
    fill=st.nothing(),
)
plain = st.one_of(st.floats(-1e6, 1e6), st.integers(-1000, 1000), st.text(max_size=8))
trees = st.recursive(st.one_of(vectors, plain), lambda part: st.lists(part, max_size=3), max_leaves=6)
columns = st.one_of(vectors, trees)
sources = st.dictionaries(st.text(max_size=8), st.dictionaries(st.text(max_size=8), columns, max_size=4), max_size=4)


@settings(max_examples=examples(5))
@given(sources)
def test_the_browser_reads_the_columns_that_were_put_and_each_array_is_sent_once(put):
    wire = Wire()
    for source, given_columns in put.items():
        wire.put(source, given_columns)
    found, block = unpack(wire)
    assert len(block) == 4 * sum(size_of([*columns.values()]) for columns in put.values())
    assert set(found) == set(put)
    for source, given_columns in put.items():
        assert set(found[source]) == set(given_columns)
        for name, column in given_columns.items():
            assert same(column, found[source][name]), (source, name)


@given(st.tuples(*[st.floats(-1e300, 1e300)] * 4))
def test_axes_arrive_in_double_precision_and_the_last_ones_count(ends):
    wire = Wire()
    wire.put_ranges("omega", (0.0, 1.0), (0.0, 1.0))
    wire.put_ranges("omega", ends[:2], ends[2:])
    tree = json.loads(json.dumps(wire.pack()[0], allow_nan=False))
    assert tree["ranges"] == {"omega": list(ends)}


def test_what_was_packed_is_not_sent_again_and_is_not_changed_by_what_comes():
    wire = Wire()
    wire.put("orbit", {"x": np.arange(5.0)})
    wire.put_ranges("omega", (0.0, 1.0), (0.0, 1.0))
    wire.set_text("status", "first")
    wire.caption("omega", {"title": "Orbit", "verdict": "", "numbers": "h = 1"})
    wire.show_number("h", 1.0, (0.0, 2.0, 0.1))
    wire.show_choice("accuracy", "draft")
    tree, _ = wire.pack()
    assert wire.pack() == ({"sources": {}, "ranges": {}, "texts": {}, "captions": {}, "controls": {}}, b"")
    wire.set_text("status", "second")
    assert tree["texts"] == {"status": "first"}
    assert tree["controls"]["h"] == [1.0, 0.0, 2.0, 0.1]
    # A disabled number is sent with the flag True.
    wire.show_number("h", 2.0, (0.0, 2.0, 0.1), idle=True)
    assert wire.pack()[0]["controls"] == {"h": [2.0, 0.0, 2.0, 0.1, True]}


def test_arrays_of_any_layout_arrive_in_order():
    grid = np.arange(12.0).reshape(3, 4)
    wire = Wire()
    wire.put("grid", {"columns": grid.T, "back": grid[::-1, 1], "big-endian": np.arange(3.0).astype(">f8")})
    found, _ = unpack(wire)
    assert found["grid"]["columns"].tolist() == [[0, 4, 8], [1, 5, 9], [2, 6, 10], [3, 7, 11]]
    assert found["grid"]["back"].tolist() == [9, 5, 1]
    assert found["grid"]["big-endian"].tolist() == [0, 1, 2]
