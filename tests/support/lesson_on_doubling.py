"""The numbers in the lesson "Period doubling to a strange attractor, and its mirror repeller", computed."""

import math
from functools import cache

import numpy as np

from hess_explorer.lessons import shipped
from hess_explorer.protocol.parameters import places
from hess_explorer.scenes import scenes
from hess_mechanics import level, lyapunov_spectrum, period_doublings, periodic_orbit, return_map
from hess_mechanics.dynamics.parameter_diagram import doublings, sets_of
from support.deviations import deviations

NAME = "period-doubling-and-a-mirror-repeller"


def heavy_body(values):
    """Body and energy E of a state of "Orbit diagram" or "Suslov problem with gravity"."""
    state = scenes()["orbit-diagram"].of(
        scenes()["orbit-diagram"].defaults()
        | {name: values[name] for name in ("I11", "I22", "I13", "I23", "b1", "b2", "b3", "h")}
    )
    return state.body, state.E


@cache
def cascade():
    """The doublings of the first body of the lesson over I23."""
    values = shipped()[NAME].steps[0].at.values
    body, E = heavy_body(values)
    map_ = return_map(body, E=E)
    orbit = periodic_orbit(map_, places(values["chosen"])[-1], 1)
    return period_doublings(map_, orbit, "I23", 0.2, 4)


@cache
def cascade_of_the_ball():
    """The doublings of the ball over 𝒟, from period 2."""
    scene = scenes()["ball-diagram"]
    state = scene.of({**scene.defaults(), "D": 1.7})
    settled = sets_of(state.poincare, state.diagram.place, 500, 2, level("standard")).attractor
    return doublings(state.diagram.family, "D", 1.7, tuple(map(tuple, settled.tolist())), 1.34, 4)


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
    """0 and the numbers said of chaos, if the exponent is near 0.04: of many orbits over the time of the picture."""
    values = next(step for step in shipped()[NAME].steps if step.title == "Measure the chaos").prediction.then.values
    section = return_map(heavy_body(values)[0], E=heavy_body(values)[1]).section
    starts = section.spread(section.window, 16)
    found = [lyapunov_spectrum(section.body, start, 2.0 * values["long"]).values[0] for start in starts]
    assert deviations(found, 0.035) > 5.0 > -5.0 > deviations(found, 0.045)
    units = np.log(10.0) / np.array(found)
    assert deviations(units, 55.0) > 5.0 > -5.0 > deviations(units, 65.0)
    return 0.0, 0.04, 60.0


def end(_step):
    """Feigenbaum's δ, and where a geometric series with this ratio ends."""
    last = cascade().values
    return feigenbaum(), float(last[-1] + (last[-1] - last[-2]) / (feigenbaum() - 1.0))


def sets_at(values, **changes):
    """Attractor and repeller of a state of "Orbit diagram"."""
    state = scenes()["orbit-diagram"].of({**values, **changes})
    return sets_of(state.poincare, state.diagram.place, 500, 1500, level("standard"))


def points_of(place):
    """The number of places to which the section of a state settles."""
    return len(np.unique(np.round(sets_at(place.values).attractor, 4), axis=0))


def first_cascade(_step):
    """Return the parameters of the period doublings, the period before each, and the ratios of their distances."""
    found = cascade()
    return *found.values.tolist(), *map(float, found.periods), *found.ratios.tolist()


def I23(step):
    return (step.at.values["I23"],)


ROWS = {
    "$\\gamma_3=0$": lambda s: (0.0,),
    "Its **period**\nis 1.": lambda s: (points_of(s.at),),
    "closes after three crossings": lambda s: (3.0,),
    "Three points": lambda s: (3.0,),
    "It was −0.1. We set it to 0, and": lambda s: (s.at.values["I23"], s.prediction.then.values["I23"]),
    "There are two.": lambda s: (points_of(s.prediction.then),),
    # The ends of the first cascade: the period before and after the first doubling.
    "line means period 1. It splits: from there on the period is 2.": lambda s: (
        cascade().periods[0],
        2 * cascade().periods[0],
    ),
    # By definition of a doubling; a test below has the multipliers.
    "passes −1: the": lambda s: (-1.0,),
    "the motion of period 1 does": lambda s: (cascade().periods[0],),
    "$I_{23}$ = −0.0498, 0.0873, 0.1282 and 0.1376, for the periods 1, 2, 4 and 8. The distances between\n"
    "them shrink by the factors 3.357 and 4.328": first_cascade,
    "such factors tend to 4.669, whatever": lambda s: (feigenbaum(),),
    "If the factor is 4.669 from here on, the remaining distances add up like a geometric series. The end is at about\n"
    "$I_{23}$ = 0.1402": end,
    "Now $I_{23}$ = 0.2": I23,
    "it tends to 0: along": lambda s: (0.0,),
    "with $I_{23}$ = 0.2. On": I23,
    "greater than 0. It is about 0.04, so a distance grows tenfold in some 60 units": tenfold,
    "doubles from 2 to 4, 8 and 16, and": lambda s: (*map(float, cascade_of_the_ball().periods[:1]), 4.0, 8.0, 16.0),
    "The factors here are 5.032 and 4.676": lambda s: tuple(cascade_of_the_ball().ratios.tolist()),
    "The number 4.669 again": lambda s: (feigenbaum(),),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
