"""The numbers in the lesson "How do we know?", computed."""

import math

import numpy as np

from hess_explorer.lessons import package_lessons
from hess_explorer.scenes import scenes
from hess_mechanics import lyapunov_spectrum
from hess_mechanics.dynamics import work_precision
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.suslov import free
from support.deviations import deviations
from support.lesson_on_constraints import free_body
from support.lessons_on_tori import crossings, threshold
from support.moved import from_moved_starts
from support.numbers import DIGITS

NAME = "how-do-we-know"
STEPS = {step.title: step for step in package_lessons()[NAME].steps}


def moved_growth(values, of):
    """Decimal logarithms of the late "errors" or "pixels" of each level, from sixteen starts moved by a few ulps."""
    found = from_moved_starts(lambda: getattr(growth(values), of))
    return {name: [math.log10(one[name][-20:].max()) for one in found] for name in LEVELS}


def growth(values):
    """Errors and drifts of the motion of a state of "Speed and accuracy", at every level."""
    scene = next(one for one in scenes().values() if one.origin and set(values) == {spec.name for spec in one.specs})
    motion = scene.of(values).precision.limited_motion
    return work_precision.growth(*motion.arguments, motion.weights, 400)


def bought_by_a_digit(_step):
    """Return the time that a digit buys, the digits of a double, and whether no level is right to a pixel at a time."""
    state = scenes()["orbit-diagram"].of(STEPS["What is a picture of chaos worth?"].state.values)
    section = state.poincare
    starts = section.spread(16)
    units = math.log(10.0) / np.array([lyapunov_spectrum(state.body, start, 8000.0).values[0] for start in starts])

    def lost(time):
        found = moved_growth(STEPS["Chaos magnifies errors"].prediction.outcome.values | {"span": time}, "pixels")
        return all(deviations(one, 0.0) > 5.0 for one in found.values())

    return (units, 2.0), DIGITS, lost


def passage(step):
    """ω(t) of the state that is revealed."""
    values = step.prediction.outcome.values
    return free.passage(free_body(values), (values["w1"], values["w2"]))


def left(step):
    """Return the logarithm of the distance from the line that ω1 has to make up, this distance, and the time."""
    found, values = passage(step), step.prediction.outcome.values
    assert found.rate == 1.0
    return -math.log(values["w2"]), 1.0 / values["w2"], -found.u0 / found.rate


def hardly_moves(time):
    """Return whether the motion that is revealed differs by less than a pixel from a uniform rotation up to a time."""
    values = STEPS["A rotation that seems to be stable"].prediction.outcome.values
    return values["w2"] * math.exp(time) < 1e-3 * values["w1"]


def two(step):
    return (crossings(step.state.values),)


ROWS = {
    "For this body that is about 16 units. With its 16 digits the computer is lost before $t$ = 240": (
        bought_by_a_digit
    ),
    "up to $t$ = 400 and sees": lambda s: (hardly_moves,),
    "$e^{691}$ is $10^{300}$: the body leaves at $t$ = 692.6": left,
    "exactly two": two,
    "if it exceeds 2, there are two. The interval lies above 2": lambda s: (*threshold(s), *two(s), *threshold(s)),
}
"""A phrase of the lesson → the numbers in it, computed from the step."""
