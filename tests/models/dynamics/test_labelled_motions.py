"""Kinds found by `regime` for motions labelled by theorems or integrations; see `oracle/make_labelled_motions.py`."""

from functools import cache

import numpy as np
import pytest

from hess_mechanics import regime
from oracle.labelled import MOTIONS, returns_of
from support.moved import from_moved_starts
from support.thorough import sample

TRIED = sample(MOTIONS, 24)
UNDECIDED = {"UNDECIDED", "NO_RETURN", "SETTLING"}
"""Kinds that claim nothing, by their names."""


def verdict(motion, kind, period):
    """Return "right", "undecided" or "wrong" for the name of a kind and a period that were found."""
    label, known = motion["kind"], motion["period"]
    if kind in UNDECIDED:
        # The transient is not over after the crossings that are left out: this is then the whole truth.
        return "right" if kind == "SETTLING" and motion["settling"] else "undecided"
    if label == "LONG_PERIOD":
        # Either the period itself, or that none of those that were tried is one.
        return "right" if kind == "NO_PERIOD" or (kind, period) == ("PERIODIC", known) else "wrong"
    return "right" if kind == label and (kind != "PERIODIC" or period == known) else "wrong"


@cache
def found(name):
    """Names of kinds with periods: of a chaotic motion for several starts that differ by a few ulps."""
    (motion,) = (one for one in MOTIONS if one["name"] == name)
    count = 4 if motion["kind"] == "CHAOTIC" else 1
    results = from_moved_starts(lambda: regime(returns_of(motion), motion["place"]), count)
    return [(result.kind.name, result.period) for result in results]


@pytest.mark.chaotic
@pytest.mark.parametrize("motion", TRIED, ids=lambda motion: motion["name"])
def test_the_kind_of_a_known_motion_is_right_or_undecided(motion):
    for kind, period in found(motion["name"]):
        assert verdict(motion, kind, period) != "wrong", (
            f"{kind}, period {period}: it is {motion['kind']}, period {motion['period']} {motion['theorem']}"
        )


@pytest.mark.chaotic
def test_at_most_a_tenth_of_the_known_motions_is_undecided():
    undecided = {one["name"]: np.mean([verdict(one, *of) == "undecided" for of in found(one["name"])]) for one in TRIED}
    assert sum(undecided.values()) <= 0.1 * len(TRIED), undecided
