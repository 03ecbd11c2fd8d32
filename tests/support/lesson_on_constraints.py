"""The numbers in the lesson "What a nonholonomic constraint does", computed."""

import math

import numpy as np
from scipy.optimize import brentq

from hess_mechanics import SuslovBody
from hess_mechanics.suslov import free
from hess_mechanics.suslov.additional_integral import I11_at

NAME = "what-a-nonholonomic-constraint-does"


def free_body(values):
    """The body of the scene "Free Suslov problem"."""
    I22, I13, I23 = (values[name] for name in ("I22", "I13", "I23"))
    return SuslovBody(I11_at(values["k"], I22, I13, I23), I22, I13, I23)


def cloud_body(values):
    """The body of the scene "Singular measures"."""
    return SuslovBody(values["I11"], values["I22"], values["I13"], values["I23"])


def turn(axis, degrees):
    """The rotation (3, 3) about an axis."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found, angle = np.eye(3), math.radians(degrees)
    found[i, i] = found[j, j] = math.cos(angle)
    found[j, i], found[i, j] = math.sin(angle), -math.sin(angle)
    return found


def about_the_third_axis(_step):
    """Return the turns about the first and the second axis, and the turn about the third that they are together."""
    # Turns about axes of the body are multiplied from the right.  The first takes the second axis to the third.
    right = brentq(lambda degrees: turn(0, degrees)[1, 1], 45.0, 135.0)
    whole = turn(0, right) @ turn(1, right) @ turn(0, -right)
    assert np.allclose(whole[:, 2], (0.0, 0.0, 1.0), atol=1e-12)
    return right, right, right, math.degrees(math.atan2(whole[1, 0], whole[0, 0]))


def started(step):
    return step.prediction.then.values["w1"], step.prediction.then.values["w2"]


def rate_at_the_end(step):
    """The slope of the logarithm of small volumes at the stable rotation: the divergence there."""
    values = step.at.values
    w1, w2 = free.equilibria(cloud_body(values), values["h"]).stable
    return (values["I23"] * w1 / values["I22"] - values["I13"] * w2 / values["I11"],)


ROWS = {
    "about its first axis by 90°, about its second by 90°, and about its first back by 90°. Altogether it has turned "
    "by 90° about": about_the_third_axis,
    "$\\omega_0$ is 0.896": lambda s: (free.passage(free_body(s.prediction.then.values), started(s)).rate,),
    "the slope is −0.78": rate_at_the_end,
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
