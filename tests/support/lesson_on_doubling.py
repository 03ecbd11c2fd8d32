"""The numbers in the lesson "Period doubling to a strange attractor, and its mirror repeller", computed."""

import math
from dataclasses import replace
from functools import cache

import numpy as np

from hess_explorer.lessons import package_lessons
from hess_explorer.protocol.specs import places
from hess_explorer.scenes import scenes
from hess_explorer.scenes.parts.orbits.regime import sets_of
from hess_mechanics import ReturnMap, level, lyapunov_spectrum, period_doublings, periodic_orbit, return_map

NAME = "period-doubling-and-a-mirror-repeller"


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
    values = package_lessons()[NAME].steps[0].at.values
    body, E = heavy_body(values)
    map_ = return_map(body, E=E)
    orbit = periodic_orbit(map_, places(values["chosen"])[-1], 1)
    return period_doublings(map_, orbit, "I23", 0.2, 6)


@cache
def cascade_of_the_ball():
    """The doublings of the ball over 𝒟, from period 2."""
    scene = scenes()["ball-diagram"]
    state = scene.of({**scene.defaults(), "D": 1.7})
    settled, _ = sets_of(ReturnMap(state.poincare, level("standard")), state.diagram.place, 500, 2)
    map_ = return_map(state.body, h=state.h)
    return period_doublings(map_, periodic_orbit(map_, settled[0], 2), "D", 1.34, 4)


@cache
def feigenbaum():
    """Feigenbaum's δ from superstable orbits of r x (1 − x): where the orbit of 1/2 closes after 2ⁿ steps."""

    def closing(r, n):
        x, slope = 0.5, 0.0
        for _ in range(2**n):
            x, slope = r * x * (1.0 - x), x * (1.0 - x) + r * (1.0 - 2.0 * x) * slope
        return x - 0.5, slope

    found, delta = [2.0, 1.0 + math.sqrt(5.0)], 4.7
    for n in range(2, 11):
        r = found[-1] + (found[-1] - found[-2]) / delta
        for _ in range(12):
            value, slope = closing(r, n)
            r -= value / slope
        found.append(r)
        delta = (found[-2] - found[-3]) / (found[-1] - found[-2])
    return delta


def tenfold(_step):
    """Return the exponents of many orbits over the time of the picture, and their times of a tenfold growth."""
    values = next(
        step for step in package_lessons()[NAME].steps if step.title == "Measure the chaos"
    ).prediction.then.values
    section = return_map(heavy_body(values)[0], E=heavy_body(values)[1]).section
    starts = section.spread(16)
    found = np.array([lyapunov_spectrum(section.body, start, 2.0 * values["long"]).values[0] for start in starts])
    return found, (math.log(10.0) / found, 5.0)


def a_third(_step):
    """Return the number of points of an orbit that closes after three steps, of r x (1 − x)."""
    x = [0.5]
    for _ in range(900):
        x.append(3.8319 * x[-1] * (1.0 - x[-1]))
    return (len(set(np.round(x[-90:], 6))),)


def end(_step):
    """Return Feigenbaum's δ, and where a geometric series with this ratio ends after the fourth doubling."""
    last = cascade().values[:4]
    return feigenbaum(), float(last[-1] + (last[-1] - last[-2]) / (feigenbaum() - 1.0))


def sets_at(values, **changes):
    """Attractor and repeller of a state of "Orbit diagram"."""
    state = scenes()["orbit-diagram"].of({**values, **changes})
    return sets_of(ReturnMap(state.poincare, level("standard")), state.diagram.place, 500, 1500)


def points_of(place):
    """The number of places to which the section of a state settles."""
    return len(np.unique(np.round(sets_at(place.values)[0], 4), axis=0))


def first_cascade(_step):
    """Return the parameters of period doublings, the period before each, and the ratios of their distances."""
    found = cascade()
    return *found.values[:4], *found.periods[:4], *found.ratios[:2]


def multipliers(_step):
    """Return the multiplier that is not the other one's inverse where the period doubles first."""
    body, E = heavy_body(package_lessons()[NAME].steps[0].at.values)
    map_ = return_map(replace(body, I23=float(cascade().values[0])), E=E)
    return (min(periodic_orbit(map_, tuple(cascade().places[0][0]), 1).multipliers.real),)


ROWS = {
    "Its **period** is 1.": lambda s: (points_of(s.at),),
    "closes after three crossings": a_third,
    "Three points": a_third,
    "It was −0.1. We set it to 0, and": lambda s: (s.at.values["I23"], s.prediction.then.values["I23"]),
    "There are two.": lambda s: (points_of(s.prediction.then),),
    "line means period 1. It splits: from there on the period is 2.": lambda s: cascade().periods[:2],
    "passes −1: the": multipliers,
    "the motion of period 1 does": lambda s: cascade().periods[:1],
    "$I_{23}$ = −0.0498, 0.0873, 0.1282 and 0.1376, for the periods 1, 2, 4 and 8. The distances between "
    "them shrink by the factors 3.357 and 4.328": first_cascade,
    "such factors tend to 4.669": lambda s: (feigenbaum(),),
    "If the factor is 4.669 from here on, the remaining distances add up like a geometric series. The end is at about "
    "$I_{23}$ = 0.1402": end,
    "It is about 0.04, so a distance grows tenfold in some 60 units": tenfold,
    "doubles from 2 to 4, 8 and 16, and": lambda s: cascade_of_the_ball().periods,
    "The factors here are 5.032 and 4.676": lambda s: cascade_of_the_ball().ratios,
    "The number 4.669 again": lambda s: (feigenbaum(),),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
