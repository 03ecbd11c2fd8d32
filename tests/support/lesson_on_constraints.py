"""The numbers in the lesson "What a nonholonomic constraint does", computed."""

import math

import numpy as np

from hess_mechanics import SuslovBody
from hess_mechanics.suslov import free
from hess_mechanics.suslov.additional_integral import I11_at


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


def about_the_third_axis(step):
    """The turns about the first and the second axis, and the turn about the third that they are together."""
    # Turns about axes of the body are multiplied from the right.
    whole = turn(0, 90.0) @ turn(1, 90.0) @ turn(0, -90.0)
    assert np.allclose(whole[:, 2], (0.0, 0.0, 1.0), atol=1e-15)
    return 90.0, 90.0, 90.0, math.degrees(math.atan2(whole[1, 0], whole[0, 0]))


def started(step):
    return step.prediction.then.values["w1"], step.prediction.then.values["w2"]


def rate_at_the_end(step):
    """The slope of the logarithm of small volumes at the stable rotation: the divergence there."""
    values = step.at.values
    w1, w2 = free.equilibria(cloud_body(values), values["h"]).stable
    return (values["I23"] * w1 / values["I22"] - values["I13"] * w2 / values["I11"],)


ROWS = {
    "about its first axis by 90°, about its second by 90°, and about its first back by 90°. Altogether it has turned\n"
    "by 90° about": about_the_third_axis,
    "So far $I_{13}$ was 0": lambda s: (s.at.values["I13"],),
    "with $I_{13}$ = 0.2 and $I_{23}$ = 0.3": lambda s: tuple(s.prediction.then.values[one] for one in ("I13", "I23")),
    "$\\omega_1$ = 2.2 and\n$\\omega_2$ = −1.4": started,
    "in each time\n$1/\\omega_0$": lambda s: (1.0,),
    "$\\omega_0$ is 0.896": lambda s: (free.passage(free_body(s.prediction.then.values), started(s)).rate,),
    "the slope is\n−0.78": rate_at_the_end,
    "line of uniform rotations is $I_{13}\\omega_1+I_{23}\\omega_2=0$": lambda s: (0.0,),
    "height $\\Gamma$ = −0.44": lambda s: (s.at.values["Gamma"],),
    "it is 1.5 now, and we shall set it to 1.": lambda s: (s.at.values["k"], s.prediction.then.values["k"]),
    "For $k=1$ there": lambda s: (s.prediction.then.values["k"],),
    "For\n$k$ = 1.5 none": lambda s: (s.at.values["k"],),
    "$I_{13}=I_{23}=0$": lambda s: (0.0,),
    "It is 0 everywhere": lambda s: (0.0,),
    "for $k$ = 1.5.": lambda s: (1.5,),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
