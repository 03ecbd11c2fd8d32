"""The numbers in the lesson "What a nonholonomic constraint does", computed."""

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


def started(step):
    return step.prediction.outcome.values["w1"], step.prediction.outcome.values["w2"]


def rate_at_the_end(step):
    """The slope of the logarithm of small volumes at the stable rotation: the divergence there."""
    values = step.state.values
    w1, w2 = free.equilibria(cloud_body(values), values["h"]).stable
    return (values["I23"] * w1 / values["I22"] - values["I13"] * w2 / values["I11"],)


ROWS = {
    "$\\omega_0$ is 0.896": lambda s: (free.passage(free_body(s.prediction.outcome.values), started(s)).rate,),
    "the slope is −0.78": rate_at_the_end,
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
