"""Every number in a shipped lesson is computed again: a number in the text without a row here fails."""

import math
import re
import sys

import numpy as np
import pytest

from hess_explorer.lessons import shipped
from hess_mechanics import HeavyBody, SuslovBody, circle_map, level, scattering
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.scattering import ball_scattering
from hess_mechanics.euler_poisson.hess_isomorphism import hess_body
from hess_mechanics.suslov.additional_integral import I11_at
from support import lesson_on_constraints, lesson_on_doubling, lesson_on_evidence

PRECISE = level("precise")
WORDS = {
    word: float(value)
    for value, word in enumerate(
        ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"], 2
    )
}
# Indices and powers are no claims.
NUMBER = re.compile(rf"(?<![\w.^_])(?<!_\{{)−?\d+(?:\.\d+)?(?:·10⁻⁸)?|\b(?:{'|'.join(WORDS)})\b", re.IGNORECASE)


def value_of(number):
    plain = number.lower().replace("−", "-").replace("·10⁻⁸", "e-8")
    return WORDS.get(plain) or float(plain)


def is_rounded(number, exact):
    """Return whether a number equals the exact value rounded to the same number of digits."""
    digits = number.replace("·10⁻⁸", "")
    unit = 10.0 ** -len(digits.partition(".")[2]) * (1e-8 if digits != number else 1.0)
    return abs(value_of(number) - exact) <= 0.5 * unit * (1 + 1e-9)


def torus(values):
    return circle_map(values["I23"] / values["I22"], values["h"], values["f"], PRECISE)


def here(step):
    return torus(step.at.values)


def then(step):
    return step.prediction.then.values


def of(*names):
    return lambda step: tuple(step.at.values[name] for name in names)


def a_of(step):
    return step.at.values["I23"] / step.at.values["I22"]


def born(step):
    """The energy at which the trace is 2, by bisection."""
    a, f, low, high = a_of(step), step.at.values["f"], step.animation.start, step.animation.end
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if circle_map(a, middle, f, PRECISE).trace > 2.0 else (middle, high)
    return high


def suslov(values):
    return SuslovBody(
        I11_at(values["k"], values["I22"], values["I13"], values["I23"]), values["I22"], values["I13"], values["I23"]
    )


def turned(values):
    """The angle χ through which the passage turns ξ, in degrees."""
    return math.degrees(math.acos(scattering(suslov(values), PRECISE).cos_chi))


def outgoing(step):
    found = scattering(suslov(step.at.values), PRECISE).theta_plus(step.at.values["theta"], np.linspace(0, 7, 20001))
    return float(found.min()), float(found.max())


def on_the_wall(step):
    """The circle map of the Hess manifold of a heavy body."""
    one = step.at.values
    body = hess_body(HeavyBody.hess((one["I1"], one["I2"], one["I3"]), one["m"]))
    a1 = 1.0 / one["I2"]
    return circle_map(body.a, a1 * one["h"] / body.b, a1 * one["f"] / math.sqrt(body.b), PRECISE)


def lost_after(step):
    return math.ceil(-math.log(1e-16) / on_the_wall(step).fixed_points[1].log_multiplier)


LIMITS = {
    "−0.3959 turns": lambda s: (here(s).rotation_number,),
    "If the trace is less than 2 in absolute value": lambda s: (2.0,),
    "If it is more than\n2, there are exactly two fixed points": lambda s: (
        2.0,
        len(circle_map(a_of(s), 1.5, 0.6, PRECISE).fixed_points),
    ),
    "Here the trace is 1.0187": lambda s: (here(s).trace,),
    "from 0.5 to 1.5 and": lambda s: (s.at.values["h"], then(s)["h"]),
    "φ = −2.187, it is 0.232": lambda s: (
        torus(then(s)).fixed_points[0].phi,
        torus(then(s)).fixed_points[0].multiplier,
    ),
    "multipliers is 1:": lambda s: (math.exp(sum(one.log_multiplier for one in here(s).fixed_points)),),
    "from 0.5 to 1.5, with $f$ held at 0.6": lambda s: (s.animation.start, s.animation.end, s.at.values["f"]),
    "At h = 1.076 the curve touches, and the trace is 2": lambda s: (
        born(s),
        circle_map(a_of(s), born(s), s.at.values["f"], PRECISE).trace,
    ),
    "locked at 0, and there are two cycles": lambda s: (here(s).rotation_number, len(here(s).fixed_points)),
    "On it the trace is 2.": lambda s: (2.0,),
    "$n_3=a/\\sqrt{1+a^2}$": lambda s: (1.0,),
    # The trace on the bifurcation curve, 2cos(π√(n²(1+a²)−a²)/√(1+3n²)), is 2 where n²(1+a²) = a².
    "$a$ is 0.2917, so that is $n_3$ = 0.28, at the\nenergy h = 1.366": lambda s: (
        a_of(s),
        a_of(s) / math.hypot(1.0, a_of(s)),
        (1 - 2 * a_of(s) ** 2) / (2 * a_of(s) * math.hypot(1.0, a_of(s))),
    ),
    "Here it is 0.3. We": lambda s: (a_of(s),),
    "where $f=0$ and $h>1$ there are always cycles": lambda s: (0.0, 1.0),
    "At $a=0$ the constraint": lambda s: (0.0,),
    "Put $f=0$,": of("f"),
    "$e^{2\\pi a}$ exactly": lambda s: (here(s).fixed_points[1].log_multiplier / (math.pi * a_of(s)),),
    "For $a$ = 0.3 that is 6.586": lambda s: (a_of(s), here(s).fixed_points[1].multiplier),
    "as long as $h>1$?": lambda s: (1.0,),
    "to and fro, at h = 0.3": of("h"),
    "in the limit $f\\to 0$, where the trace tends to 0.": lambda s: (0.0, here(s).trace),
    "after two swings": lambda s: (2.0,),
    "only one step was seen, at 0": lambda s: (circle_map(0.5, 1.5, 0.6, PRECISE).rotation_number,),
    "Where the trace is less than 2, the": lambda s: (2.0,),
    "With $a$ = 3 the contraction is fierce: one swing leaves 1.5·10⁻⁸": lambda s: (
        a_of(s),
        here(s).fixed_points[0].multiplier,
    ),
    "means $|a|<1$": lambda s: (1.0,),
    "real body, at $f=0$, is less than $e^{2\\pi}$, about 535": lambda s: (
        0.0,
        circle_map(1.0, 1.5, 1e-9, PRECISE).fixed_points[1].log_multiplier / math.pi,
        math.exp(2.0 * math.pi),
    ),
    "the trace is less than 2 there is": lambda s: (2.0,),
    "only plateau is at 0": lambda s: (here(s).rotation_number,),
}
SCATTERING = {
    "constraint $\\omega_3=0$": lambda s: (0.0,),
    "Here $k=1$": of("k"),
    "so that $k=2$": lambda s: (then(s)["k"],),
    "\\sqrt{1-(\\Gamma^-)^2}": lambda s: (1.0,),
    "between 1.013 and 2.129": outgoing,
    "$\\chi$ = 148.0°": lambda s: (turned(s.at.values),),
    "from $\\theta^-=1$ instead of the equator, at the phase 2": lambda s: (then(s)["theta"], then(s)["phi"]),
    "exactly, $\\chi=180°$": lambda s: (turned({**s.at.values, "k": 1.0}),),
    "while $k$ goes from 2 to 3": lambda s: (s.animation.start, s.animation.end),
    "With $I_{13}=0$ there": of("I13"),
    "$$\\cos\\chi=\\frac{2\\cos^2(\\pi k/2)}{\\cosh^2(\\pi I_{22}/2I_{23})}-1 .$$": lambda s: (2.0, 2.0, 2.0, 1.0),
    "and $\\cos\\chi=-1$. These": lambda s: (abs(scattering(suslov({**s.at.values, "k": 3.0}), PRECISE).cos_chi),),
    "For $I_{13}=0$ it depends on two numbers": lambda s: (s.at.values["I13"], 2.0),
    "with $k$ held at 2?": of("k"),
    "$\\cos\\chi\\to-1$: complete": lambda s: (1.0,),
    "With $I_{23}$ = 0.4 the\nangle is already 175.5°": lambda s: (0.4, turned({**s.at.values, "I23": 0.4})),
    "$\\mathcal{D}=0$ it is the top that we know, and $k=1$": lambda s: (
        0.0,
        s.at.values["I22"] * (s.at.values["I11"] - s.at.values["I22"]) / s.at.values["I23"] ** 2,
    ),
    "With $\\mathcal{D}=2$": of("D"),
}
LAYERS = {
    "Here it is $r_1M_1+r_3M_3=0$": lambda s: (0.0,),
    "with $a_i=1/I_i$": lambda s: (1.0,),
    "turned away by 0.02": of("away"),
    "surface $r_1M_1+r_3M_3=0$ is no longer invariant": lambda s: (0.0,),
    "beyond 2 there are two limit cycles. Here the number\n$|a|$ is 0.5 and the trace is 4.904": lambda s: (
        2.0,
        len(on_the_wall(s).fixed_points),
        abs(on_the_wall(s).a),
        on_the_wall(s).trace,
    ),
    "a factor of 22.0": lambda s: (on_the_wall(s).fixed_points[1].multiplier,),
    "The computer keeps about 16 digits": lambda s: (round(-math.log10(sys.float_info.epsilon)),),
    "The logarithm of 10¹⁶ is 36.8, and the exponent is 3.091": lambda s: (
        10.0,
        math.log(1e16),
        on_the_wall(s).fixed_points[1].log_multiplier,
    ),
    "gone after 12": lambda s: (lost_after(s),),
    "the energy is 5 instead of 50, and $f$ is 0.8": lambda s: (s.at.values["h"], 50.0, s.at.values["f"]),
    "Less than 2; it is 1.124. There": lambda s: (2.0, on_the_wall(s).trace),
    "over 60 returns": of("returns"),
    "For $f=0$ the centre": of("f"),
    "one turn is $2\\pi|a|$, whatever the energy above the separatrix: for this body 3.1416": lambda s: (
        2.0,
        on_the_wall(s).fixed_points[1].log_multiplier,
    ),
    "By $e^{2\\pi|a|}$, which is 23.14": lambda s: (2.0, on_the_wall(s).fixed_points[1].multiplier),
}
ROWS = {
    "limit-cycles-and-locking": LIMITS,
    "scattering-by-a-nonholonomic-top": SCATTERING,
    "two-chaotic-layers-that-never-mix": LAYERS,
    "what-a-nonholonomic-constraint-does": lesson_on_constraints.ROWS,
    lesson_on_doubling.NAME: lesson_on_doubling.ROWS,
    lesson_on_evidence.NAME: lesson_on_evidence.ROWS,
}
# The name of the problem's constraint is no claim of its own.
ALWAYS = {"$\\omega_3=0$": lambda s: (0.0,)}


def texts(step):
    return step.title, step.text, step.question, step.answer


@pytest.mark.chaotic
@pytest.mark.parametrize("name", ROWS)
def test_every_number_of_a_lesson_is_what_it_is_computed_to_be(name):
    rows, used, wrong = ROWS[name] | ALWAYS, set(), []
    for step in shipped()[name].steps:
        for text in texts(step):
            said = set()
            for phrase, computed in rows.items():
                for place in re.finditer(re.escape(phrase), text):
                    used.add(phrase)
                    numbers = list(NUMBER.finditer(phrase))
                    exact = computed(step)
                    if len(numbers) != len(exact) or not all(
                        is_rounded(found[0], value) for found, value in zip(numbers, exact, strict=True)
                    ):
                        wrong.append(f"{step.title}: {phrase!r} is {exact}")
                    said.update(place.start() + found.start() for found in numbers)
            wrong += [
                f"{step.title}: nothing computes {found[0]!r} in {text[max(0, found.start() - 30) :][:60]!r}"
                for found in NUMBER.finditer(text)
                if found.start() not in said
            ]
    assert not wrong, "\n".join(wrong)
    assert not set(ROWS[name]) - used


def test_all_lessons_are_here():
    assert set(ROWS) == set(shipped())


# Statements of the lessons in words.


def test_for_f_0_the_map_is_the_same_at_every_energy_over_the_separatrix():
    phases = np.linspace(-3.0, 3.0, 41)
    first, *others = (circle_map(0.3, h, 0.0, PRECISE).theta(phases) for h in (1.2, 1.5, 3.0, 20.0))
    for other in others:
        np.testing.assert_allclose(np.exp(1j * other), np.exp(1j * first), atol=1e-10)


def test_the_ball_of_the_scattering_lesson_gives_no_single_cosine():
    values = shipped()["scattering-by-a-nonholonomic-top"].steps[-1].at.values
    assert values["D"] == 2.0
    phases = np.linspace(-math.pi, math.pi, 16, endpoint=False)

    def beside_a_cosine(D):
        body = BallBody(values["I11"], values["I22"], values["I13"], values["I23"], D)
        found = ball_scattering(body, values["theta"], phases, values["h"], 1e-4, level("draft"))
        return np.abs(np.fft.rfft(np.cos(found.theta_plus)))[2:].max() / phases.size

    assert beside_a_cosine(2.0) > 1e-3
    assert beside_a_cosine(0.0) < 1e-5
