"""Motions of known kind, labelled by theorems or integrations (`make_labelled_motions.py`), and their return maps."""

import json
import math
from pathlib import Path

from hess_mechanics import BallBody, HeavyBody, HessBody, QuarticBody, SuslovBody, return_map

MOTIONS = json.loads(Path(__file__).with_name("labelled_motions.json").read_text())


def returns_of(motion):
    """The return map of a row, whose parameters are named like the options of the command `regime`."""
    parameters = motion["parameters"]
    match motion["system"]:
        case "suslov":
            return return_map(SuslovBody(*parameters["I"], *parameters["b"]), E=parameters["E"])
        case "quartic":
            return return_map(QuarticBody(*parameters["I"], parameters["b3"], parameters["h"]))
        case "ball":
            return return_map(BallBody(*parameters["I"], parameters["D"], *parameters["b"]), E=parameters["h"])
        case "euler-poisson":
            body = HeavyBody(tuple(parameters["A"]), tuple(parameters["r"]), parameters["mu"])
            return return_map(body, h=parameters["h"], f=parameters["f"])
    a = parameters["a"]
    return return_map(HessBody(1.0, a, -math.hypot(1.0, a)), h=parameters["h"], f=parameters["f"])
