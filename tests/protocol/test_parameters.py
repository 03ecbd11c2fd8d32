"""The link: each key is validated by itself; and the states that a scene admits."""

import math
from urllib.parse import parse_qsl, quote, urlencode

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hess_explorer.page.opening import THEME, opening, query_of
from hess_explorer.protocol.specs import (
    CLIENT,
    MAX_QUERY,
    VERSION,
    ChoiceSpec,
    Formula,
    Names,
    NumberSpec,
    Points,
    decode,
    encode,
    points_text,
)
from hess_explorer.scenes import scenes
from hess_mechanics import f_max
from support.thorough import examples

SCENES = scenes()
SCENE = SCENES["suslov-hess"]
SPECS = (*SCENE.specs, *CLIENT, THEME)
NUMBERS = [spec for spec in SPECS if isinstance(spec, NumberSpec)]

every_key = pytest.mark.parametrize("spec", SPECS, ids=[spec.name for spec in SPECS])
every_number = pytest.mark.parametrize("spec", NUMBERS, ids=[spec.name for spec in NUMBERS])


def admissible(spec):
    if isinstance(spec, NumberSpec):
        return st.floats(spec.bounds[0], spec.bounds[1])
    if isinstance(spec, Formula):
        return st.sampled_from(["", "g1", "0.5*g1^2 - g3"])
    return st.sampled_from(spec.options) if isinstance(spec, ChoiceSpec) else texts_of(spec)


def texts_of(places):
    """Texts that name points of a picture."""
    pair = st.tuples(
        *(st.floats(low, high, allow_subnormal=False) for low, high in zip(places.low, places.high, strict=True))
    )
    return st.lists(pair, max_size=places.most).map(points_text)


def states(specs):
    return st.fixed_dictionaries({spec.name: admissible(spec) for spec in specs})


def is_admissible(spec, value):
    if isinstance(spec, ChoiceSpec):
        return value in spec.options
    if isinstance(spec, Points | Formula):
        return spec.read(value) == (value, None)
    return isinstance(value, float) and spec.bounds[0] <= value <= spec.bounds[1]


@given(st.sampled_from(list(SCENES)), states(SPECS))
def test_what_is_encoded_is_decoded_unchanged_and_without_a_note(name, values):
    query = encode(name, values)
    assert decode(query, SPECS) == decode(f"?{query}", SPECS) == (values, [])
    assert parse_qsl(query)[:2] == [("v", VERSION), ("scene", name)]
    assert len(query) <= MAX_QUERY


DEFAULTS = {spec.name: spec.default for spec in SPECS}


def test_a_page_names_keys_that_its_link_has_twice_or_that_nobody_knows():
    query = query_of({"hh": [b"1"], "H": [b"2"], "#scene": [b""], "h": [b"1", b"1.5"], "lesson": [b""]})
    opened = opening(query)
    twice, unknown = opened.notes
    assert twice == "The link contains 'h' more than once: the last value is used."
    assert unknown == "The scene suslov-hess has no parameter 'hh', 'H', '#scene': ignored."
    assert opened.values["h"] == 1.5


@given(
    st.one_of(
        st.text(max_size=300),
        st.binary(max_size=300).map(quote),
        st.lists(st.tuples(st.sampled_from([*DEFAULTS, "v", "x"]), st.text(max_size=20)), max_size=30).map(
            lambda pairs: "&".join(f"{key}={text}" for key, text in pairs)
        ),
        st.integers(0, 2 * MAX_QUERY).map(lambda length: "&" * length),
        st.integers(0, MAX_QUERY).map(lambda count: "&".join(f"k{i}={i}" for i in range(count))),
    )
)
def test_no_text_whatever_raises_or_gives_an_inadmissible_value(query):
    values, notes = decode(query, SPECS)
    assert list(values) == list(DEFAULTS)
    for spec in SPECS:
        assert is_admissible(spec, values[spec.name]), (spec.name, values[spec.name])
    assert len(notes) <= len(SPECS) + 1
    assert all(notes)


@every_number
@given(value=st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_out_of_range_becomes_the_nearest_one_in_range(spec, value):
    admitted, note = spec.read(value)
    nearest = sorted((spec.bounds[0], value, spec.bounds[1]))[1]
    assert admitted == nearest
    assert (note is None) == (spec.bounds[0] <= value <= spec.bounds[1])
    assert spec.read(admitted) == (admitted, None)
    assert decode(f"{spec.name}={quote(repr(value))}", SPECS)[0][spec.name] == nearest


def test_a_link_that_is_too_long_is_not_read_at_all():
    longest = "h=2.5&x=".ljust(MAX_QUERY, "7")
    assert decode(longest, SPECS) == ({**DEFAULTS, "h": 2.5}, [])
    values, (note,) = decode(longest + "7", SPECS)
    assert values == DEFAULTS
    assert str(MAX_QUERY) in note


@every_key
@given(text=st.text("<>\"'&;=/()xyz§", min_size=3, max_size=20))
def test_a_note_never_repeats_what_the_link_said(spec, text):
    for key in (spec.name, "v"):
        _, notes = decode(urlencode({key: text}), SPECS)
        assert len(notes) == 1
        assert text not in notes[0]


# A scene that looks into another one has its parameters.
@pytest.mark.parametrize("scene", [one for one in SCENES.values() if one.origin is None], ids=lambda one: one.name)
@settings(max_examples=examples(5))
@given(data=st.data())
def test_what_a_scene_admits_it_admits_again_unchanged(scene, data):
    values = data.draw(states(scene.specs))
    admitted, _ = scene.admit(values)
    assert list(admitted) == [spec.name for spec in scene.specs]
    for spec in scene.specs:
        assert is_admissible(spec, admitted[spec.name])
    assert scene.admit(admitted) == (admitted, [])


# Also energies that no slider has: everything that may be typed.
energies = st.one_of(
    st.floats(-1 + 1e-9, 4.0),
    st.floats(-8.9, 0.0).map(lambda e: -1 + 10.0**e),
    st.floats(0.0, 6.0).map(lambda e: 10.0**e),
)


@given(energies, st.one_of(st.floats(-1e4, 1e4), st.floats(-1.1, 1.1)))
def test_f_is_inside_the_region_and_changed_only_where_it_must_be(h, f):
    edge = f_max(h)
    admitted, notes = SCENE.admit({**SCENE.defaults(), "h": h, "f": f})
    assert admitted["h"] == h
    # Otherwise it stands at the edge, on its own side.
    assert admitted["f"] == (f if abs(f) < edge * (1 - 1e-15) else pytest.approx(math.copysign(edge, f), rel=2e-15))
    assert bool(notes) == (admitted["f"] != f)


@given(energies, st.floats(0.0, 1.0))
def test_every_position_of_the_f_slider_is_possible(h, share):
    values = {**SCENE.defaults(), "h": h}
    low, high, step = SCENE.limits(values)["f"]
    # As a browser counts: steps from the lower end.
    position = low + round(share * (high - low) / step) * step
    for f in (low, high, min(position, high)):
        admitted, notes = SCENE.admit({**values, "f": f})
        assert (admitted["f"], notes) == (f, [])
    assert low == -high
    # And it leaves out no more than a step at either end.
    assert f_max(h) - high < step * (1 + 1e-9)
    assert 100 <= 2 * high / step <= 2001


@pytest.mark.parametrize(
    ("text", "value", "noted"),
    [
        ("sphere,sphere,omega", "sphere,omega", False),
        ("sphere,sphere,omega,circle", "sphere,omega", True),
        ("<b>", "", True),
    ],
)
def test_names_in_a_link_are_of_the_list_each_once_and_no_more_than_may_be(text, value, noted):
    spec = Names("large", "Enlarged pictures", SCENE.pictures, most=2)
    found, notes = decode(urlencode({"large": text}), (spec,))
    assert found == {"large": value}
    assert len(notes) == noted
