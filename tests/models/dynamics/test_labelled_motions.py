"""Kinds found by `regime` for motions labelled by theorems or integrations; see `oracle/make_labelled_motions.py`."""

from functools import cache

import pytest

from hess_mechanics import regime
from oracle.labelled import MOTIONS, returns_of
from support.thorough import sample

TRIED = sample(MOTIONS, 8)

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
    (motion,) = (one for one in MOTIONS if one["name"] == name)
    result = regime(returns_of(motion), motion["place"])
    return result.kind.name, result.period


@pytest.mark.parametrize("motion", TRIED, ids=lambda motion: motion["name"])
def test_the_kind_of_a_known_motion_is_right_or_undecided(motion):
    kind, period = found(motion["name"])
    assert verdict(motion, kind, period) != "wrong", (
        f"{kind}, period {period}: it is {motion['kind']}, period {motion['period']} {motion['theorem']}"
    )


def test_at_most_a_tenth_of_the_known_motions_is_undecided():
    undecided = [one["name"] for one in TRIED if verdict(one, *found(one["name"])) == "undecided"]
    assert len(undecided) <= 0.1 * len(TRIED), undecided
