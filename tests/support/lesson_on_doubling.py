"""The numbers in the lesson "Period doubling to a strange attractor, and its mirror repeller", computed."""

from dataclasses import replace
from functools import cache

import numpy as np

from hess_explorer.lessons import package_lessons
from hess_explorer.protocol.specs import points_of
from hess_explorer.scenes import scenes
from hess_explorer.scenes.parts.orbits.regime import sets_of
from hess_mechanics import ReturnMap, level, period_doublings, periodic_orbit, return_map

NAME = "period-doubling-and-a-mirror-repeller"
FEIGENBAUM = 4.669201609102990


def heavy_body(values):
    """Body and energy E of a state of "Orbit diagram" or "Suslov problem with gravity"."""
    state = scenes()["orbit-diagram"].of(
        scenes()["orbit-diagram"].defaults()
        | {name: values[name] for name in ("I11", "I22", "I13", "I23", "b1", "b2", "b3", "h")}
    )
    return state.body, state.poincare.E


@cache
def cascade():
    """The doublings of the first body of the lesson over I23."""
    values = package_lessons()[NAME].steps[0].state.values
    body, E = heavy_body(values)
    map_ = return_map(body, E=E)
    orbit = periodic_orbit(map_, points_of(values["chosen"])[-1], 1)
    return period_doublings(map_, orbit, "I23", 0.2, 6)


@cache
def cascade_of_the_ball():
    """The doublings of the ball over 𝒟, from period 2."""
    scene = scenes()["ball-diagram"]
    state = scene.of({**scene.defaults(), "D": 1.7})
    settled, _ = sets_of(ReturnMap(state.poincare, level("standard")), state.diagram.point, 500, 2)
    map_ = return_map(state.body, h=state.h)
    return period_doublings(map_, periodic_orbit(map_, settled[0], 2), "D", 1.34, 4)


def end(_step):
    """Return Feigenbaum's δ, and where a geometric series with this ratio ends after the fourth doubling."""
    last = cascade().values[:4]
    return FEIGENBAUM, float(last[-1] + (last[-1] - last[-2]) / (FEIGENBAUM - 1.0))


def sets_at(values, **changes):
    """Attractor and repeller of a state of "Orbit diagram"."""
    state = scenes()["orbit-diagram"].of({**values, **changes})
    return sets_of(ReturnMap(state.poincare, level("standard")), state.diagram.point, 500, 1500)


def number_of_points(step):
    """The number of points to which the section of a state settles."""
    return len(np.unique(np.round(sets_at(step.values)[0], 4), axis=0))


def first_cascade(_step):
    """Return the parameters of period doublings, the period before each, and the ratios of their distances."""
    found = cascade()
    return *found.values[:4], *found.periods[:4], *found.ratios[:2]


def multipliers(_step):
    """Return the multiplier that is not the other one's inverse where the period doubles first."""
    body, E = heavy_body(package_lessons()[NAME].steps[0].state.values)
    map_ = return_map(replace(body, I23=float(cascade().values[0])), E=E)
    return (min(periodic_orbit(map_, tuple(cascade().points[0][0]), 1).multipliers.real),)


ROWS = {
    "Its **period** is 1.": lambda s: (number_of_points(s.state),),
    "There are two.": lambda s: (number_of_points(s.prediction.outcome),),
    "line means period 1. It splits: from there on the period is 2.": lambda s: cascade().periods[:2],
    "passes −1: the": multipliers,
    "the motion of period 1 no longer": lambda s: cascade().periods[:1],
    "$I_{23}$ = −0.0498, 0.0873, 0.1282 and 0.1376, for the periods 1, 2, 4 and 8. The distances between "
    "them shrink by the factors 3.357 and 4.328": first_cascade,
    "such factors tend to 4.669": lambda s: (FEIGENBAUM,),
    "If the factor is 4.669 from here on, the remaining distances add up like a geometric series. The end is at about "
    "$I_{23}$ = 0.1402": end,
    "doubles from 2 to 4, 8 and 16, and": lambda s: cascade_of_the_ball().periods,
    "The factors here are 5.032 and 4.676": lambda s: cascade_of_the_ball().ratios,
    "About 4.669 again": lambda s: (FEIGENBAUM,),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
