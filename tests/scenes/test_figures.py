"""The table of the paper's figures in app/README.md: every example in it is there, and draws the figure.

The values of the captions stand here as the paper prints them, its misprints corrected.
"""

import math
import re

import numpy as np
from pytest import approx

from support.free_suslov import gamma_at, tensor_of
from support.readme import SCENES, named, table

ROWS = table("The figures of the paper")
LABELS = [
    "fig02",
    "fig0112",
    "fig0222",
    "fig0111",
    "",
    "fig04",
    "fig_07",
    "fig05",
    "fig05Sy",
    "fig6-sy",
    "gess1.pcx",
    "gess2.pcx",
    "gess-ris1",
    "gess-ris2",
]
"""Labels of the figures in the source, in order; the scheme of the ellipsoid has none."""


def example(scene, name):
    """The only one of that name; where it ends in … it may go on."""
    found = named(scene.presets, name)
    assert len(found) == 1, (scene.name, name)
    return found[0]


def examples(row):
    """The scene of a row, and its examples."""
    scene = SCENES[row[2]]
    return scene, [example(scene, name) for name in re.findall(r"\*([^*]+)\*", row[3])]


def values_of(number):
    """Return the values of all examples of a figure."""
    scene, found = examples(ROWS[number - 1])
    return [{**scene.defaults(), **one.values} for one in found]


def test_the_table_has_the_14_figures_in_the_order_of_the_source():
    assert [int(row[0]) for row in ROWS] == list(range(1, 15))
    assert [row[1].strip("`") for row in ROWS] == LABELS
    assert all(examples(row)[1] for row in ROWS)


def test_every_example_that_names_its_figure_stands_in_its_row():
    named = 0
    for scene in SCENES.values():
        for one in scene.presets:
            found = re.search(r"\(figure (\d+)\)$|^Figure (\d+) [a-h]:", one.name)
            if found:
                named += 1
                row = ROWS[int(found[1] or found[2]) - 1]
                assert (scene.name, one) in [(row[2], other) for other in examples(row)[1]], one.name
    assert named > 20


def test_the_values_are_those_of_the_captions():
    (first,) = values_of(1)
    assert (first["I13"] > 0.0, first["I23"] < 0.0) == (True, True)
    for values in values_of(2):
        assert tensor_of(values) == approx((2.44, 1.0, 0.0, 0.5))
        assert (values["w1"], values["w2"]) == (2.0, 1e-4)
        gamma = np.array([0.5, 0.26, 0.83])
        assert gamma_at(values, math.acos(values["Gamma"]), values["phi"]) == approx(
            gamma / np.linalg.norm(gamma), abs=5e-5
        )
    assert [(one["w1"], one["w2"]) for one in values_of(3)] == [(2.0, 1e-3)] * 3 + [(3.0, -2.001)] * 2
    *upright, slanting, printed = (
        [gamma_at(one, math.acos(one["Gamma"]), one[name]) for name in ("phi", "phi2")] for one in values_of(3)
    )
    for found in upright:
        for start, given in zip(found, ((-0.44, 0.28, 0.85), (-0.44, 0.72, 0.53)), strict=True):
            assert start == approx(given / np.linalg.norm(given), abs=3e-3)
    # Both on one circle to all digits that are printed, one of them corrected, as −0.49 is off that circle.
    assert slanting == [approx(given, abs=0.0051) for given in ((-0.88, -0.48, 0.0), (-0.39, 0.26, 0.88))]
    given = (-0.49, 0.26, 0.88)
    assert printed[0] == approx(given / np.linalg.norm(given), abs=1e-4)
    (fourth,) = values_of(4)
    assert (*tensor_of(fourth), fourth["theta"]) == approx((3.56, 1.0, 0.0, 0.8, 0.5 * math.pi))
    for number in (8, 9, 10):
        (ball,) = values_of(number)
        assert [ball[name] for name in ("I11", "I22", "I13", "I23", "D", "h")] == [1.0, 1.5, 0.7, 1.2, 10.0, 10.0]
    for number in (11, 12):
        (gess,) = values_of(number)
        assert [gess[name] for name in ("I1", "I2", "I3", "h", "f")] == [1.0, 0.625, 0.375, 50.0, 5.0]
        # μ (3, 0, 4).
        body = SCENES["euler-poisson"].of(gess).body
        assert body.mu * np.array(body.r) == approx([1.995 * 3.0, 0.0, 1.995 * 4.0])
    for number, f in ((13, 0.0), (14, 1.0)):
        for ris in values_of(number):
            assert ris["f"] == f
            body = SCENES["euler-poisson"].of(ris).body
            # H = ½(M1² + ⅔ M2² + ½ M3²) + γ1/√3 + γ3/√6.
            assert body.a == approx((1.0, 2.0 / 3.0, 0.5))
            assert -body.mu * np.array(body.r) == approx([1.0 / math.sqrt(3.0), 0.0, 1.0 / math.sqrt(6.0)])
