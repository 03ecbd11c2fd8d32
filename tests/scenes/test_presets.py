"""Every example against its record in "presets.json", and the numbers of its captions against what is drawn.

`python tests/manual/make_presets.py` makes the records again.
"""

import json
import re

import numpy as np
import pytest
from pytest import approx

from support import golden
from support.board import flat
from support.view import NUMBER

RECORDS = json.loads(golden.PRESETS.read_text(encoding="utf-8"))


def ends(source, column):
    """Return the least and the largest number of a column."""
    return lambda view: [reduced(flat(view.data[source][column])) for reduced in (min, max)]


def last(source, column):
    return lambda view: flat(view.data[source][column])[-1:]


def heights(view):
    """Return the heights of the circles on the sphere that orbits join."""
    return [height for *_, height, look in view.data["sphere"]["circles"] if look != "muted"]


def points(layer):
    return lambda view: [len(view.points(layer))]


def slope(view):
    """Return how fast the drawn line grows in a period, in natural logarithms."""
    x, y = view.curve("leak-slope")
    return [(y[-1] - y[0]) / (x[-1] - x[0]) * view.result.period * np.log(10.0)]


STATED = [
    ("suslov-hess", "bifurcation", "h = #, f = #", lambda view: view.columns("bifurcation-here", "h", "f")[0]),
    ("suslov", "section", "# points forward", points("first")),
    ("suslov", "section", "forward, # backward", points("second")),
    ("suslov", "exponent", "after t = #.", last("exponent-lambda", "xs")),
    ("quartic", "sphere", "γ₃ between # and #.", ends("data-orbit", "g3")),
    ("quartic", "section", "# points of the orbit in", points("own")),
    ("ball-section", "section", "# points of the orbit in", points("own")),
    ("free-suslov", "Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)", heights),
    ("scattering", "chi", "cos χ = #;", last("chi-chosen", "y")),
    ("scattering", "curve", "θ⁺ from # to #", ends("curve-theta", "ys")),
    ("chaplygin-ball", "sphere", "Γ = # at the start, Γ = # at the end", heights),
    ("chaplygin-ball", "Gamma", "From # to #.", heights),
    ("chaplygin-ball", "curve", "θ⁺ from # to #", ends("curve-ball", "ys")),
    ("hess-leak", "leak", "ln |r·M|: # per period", slope),
    ("bridge", "difference", "up to t = # if", last("difference-held", "xs")),
    ("loxodrome", "angle", "= #;", last("angle-theta", "y")),
    ("rotation-number", "circle", "a = #, h = #, f = #", lambda view: [view.values[name] for name in "ahf"]),
]
"""Scene, picture, words with # for numbers, and the numbers from the columns that are drawn."""


def words(pattern):
    return re.escape(pattern).replace(r"\#", NUMBER).replace(r"\ ", r"\s")


@pytest.mark.chaotic
@pytest.mark.parametrize(
    "scene, preset",
    [pytest.param(*example, id=f"{example[0].name}: {example[1].name}") for example in golden.EXAMPLES],
)
def test_an_example_is_as_recorded_and_its_captions_state_what_is_drawn(scene, preset):
    view = golden.view_of(scene, preset)
    assert [*golden.differences(RECORDS[scene.name][preset.name], golden.record(view))] == []
    for name, picture, pattern, drawn in STATED:
        if name == scene.name and re.search(words(pattern), view.text[picture]):
            assert view.numbers(picture, pattern) == approx(drawn(view), rel=1e-3, abs=1e-3), (picture, pattern)


def test_only_examples_are_recorded():
    recorded = {(name, preset) for name, records in RECORDS.items() for preset in records}
    assert recorded == {(scene.name, preset.name) for scene, preset in golden.EXAMPLES}


@pytest.mark.parametrize("name, picture, pattern", [one[:3] for one in STATED])
def test_each_number_that_is_compared_is_stated_by_an_example(name, picture, pattern):
    stated = [(one["words"][picture] or "").replace("#", "0") for one in RECORDS[name].values()]
    assert any(re.search(words(pattern), text) for text in stated)
