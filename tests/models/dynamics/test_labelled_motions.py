"""Kinds found by `regime` for motions labelled by theorems or integrations; see `oracle/make_labelled_motions.py`."""

import json
import math
from functools import cache
from pathlib import Path

import pytest

from hess_mechanics import BallBody, HeavyBody, HessBody, QuarticBody, SuslovBody, regime, return_map
from support.thorough import sample

MOTIONS = json.loads((Path(__file__).parents[2] / "oracle" / "labelled_motions.json").read_text())
TRIED = sample(MOTIONS, 8)

UNDECIDED = {"UNDECIDED", "NO_RETURN", "SETTLING"}
"""Kinds that claim nothing, by their names."""


def section(system, parameters):
    """Return the return map of a row, whose parameters are named like the options of the command `regime`."""
    match system:
        case "suslov":
            return return_map(SuslovBody(*parameters["I"], *parameters["b"]), E=parameters["E"])
        case "quartic":
            return return_map(QuarticBody(*parameters["I"], parameters["b3"], parameters["h"]))
        case "ball":
            return return_map(BallBody(*parameters["I"], parameters["D"], *parameters["b"]), h=parameters["h"])
        case "euler-poisson":
            body = HeavyBody(tuple(parameters["A"]), tuple(parameters["r"]), parameters["mu"])
            return return_map(body, h=parameters["h"], f=parameters["f"])
    a = parameters["a"]
    return return_map(HessBody(1.0, a, -math.hypot(1.0, a)), h=parameters["h"], f=parameters["f"])


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
    result = regime(section(motion["system"], motion["parameters"]), motion["place"])
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
