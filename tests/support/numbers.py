"""The numbers that stand in a text, and whether computed values are what it says."""

import re
import sys
from fractions import Fraction
from math import log10

import numpy as np

from hess_explorer.lessons import package_lessons
from hess_explorer.scenes import scenes
from support.deviations import deviations

_WORDS = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"]
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_LETTERS = {"omega": "ω", "theta": "θ", "Gamma": "Γ", "varepsilon": "ε", "mathcal{D}": "𝒟", "^-": "⁻"}
_PLAIN = r"\d+(?:\.\d+|(?: 000)+)?"
_POWER = r"10(?:\^\{?(-?\d+)\}?|([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))"
NUMBER = re.compile(
    rf"(?:(?<![\w.^_])(?<!_\{{)|(?<=\\pm))[−-]?"
    rf"(?:(?:{_PLAIN}(?:\\cdot|·))?{_POWER}|{_PLAIN}(?:e-\d+|/\d+)?)(?:\\pm[\d.]*\d(?![\di.]))?"
    rf"|\b(?:{'|'.join(_WORDS[2:])})\b",
    re.IGNORECASE,
)
_NO_CLAIM = re.compile(
    r"""
    <!--\ (?:measured|levels).*?<!--\ end | ```.*?``` | `[^`]*` | \]\([^)]*\)  # tested tables, fences, code, links
    | \A---.*?^--- | ^\#.*?$ | (?<![*^])\*[^*]+\*(?!\*)              # titles, and names of examples and controls
    | (?:^\ *|\ and\ )\d\.\ | (?:\(?20\d\d\)|\bin\ 20\d\d\b)           # items of a list, years
    | \(\d(?:\.\d+)?\)                                              # equations, items in a line
    | \b(?:section|figure|case|remark|picture|proposition)s?\ [\d.]+(?:\ and\ \d+)?
    """,
    re.VERBOSE | re.MULTILINE | re.DOTALL | re.IGNORECASE,
)
_FORMULA = re.compile(r"\$\$.*?\$\$|\$[^$]*\$", re.DOTALL)

DIGITS, DOUBLED = -log10(sys.float_info.epsilon), int(2 * sys.float_info.mant_dig * log10(2.0))
"""The digits of a double, 15.7, and of two together."""


def of(*names):
    """Return the function that reads parameters of a step."""
    return lambda step: tuple(step.at.values[name] for name in names)


def elsewhere(lesson, title, *names):
    """Return parameters of another step of a lesson."""
    return of(*names)(next(step for step in package_lessons()[lesson].steps if step.title == title))


def claims(text):
    """Return the matches of `NUMBER` in a text that a test has to compute.

    No claims are names and titles, references, years, code, links, indices and exponents; 0, ±1 and the word two, which
    are conditions, norms, units and pairs; and the whole numbers in a formula, but for a side of an equation.
    """
    text = _NO_CLAIM.sub(lambda found: re.sub(r"\S", " ", found[0]), text)
    formulas = [found.span() for found in _FORMULA.finditer(text) if re.search("[a-z]", found[0], re.IGNORECASE)]
    inside = {i for span in formulas for i in range(*span)}

    def is_claim(found):
        side = text[: found.start()].endswith("=") and text[found.end()] in "$,°"
        result = side or "." in found[0] or "10^" in found[0] or found.start() not in inside
        return result and found[0].lower() not in {"0", "1", "-1", "−1", "two"}

    return list(filter(is_claim, NUMBER.finditer(text)))


def _parts(number):
    """Return the value of a number, half the unit of its last digit, and its bound, 0 without ±."""
    plain, _, bound = number.lower().replace("−", "-").replace(" ", "").partition("\\pm")
    unit, power = 1.0, re.search(_POWER, plain)
    if power:
        unit = 10.0 ** int(power[1] or power[2].translate(_RAISED))
        plain = re.split(r"\\cdot|·", plain)[0] if power.start() else "1"
    value = _WORDS.index(plain) if plain in _WORDS else float(Fraction(plain))
    half = 1e-9 * abs(value) if re.search(r"\de|/", plain) else 0.5 * 10.0 ** -len(plain.partition(".")[2])
    return value * unit, half * unit, float(bound or 0.0)


def is_right(number, exact):
    """Return whether a number is a computed value, rounded, or with a bound that contains it.

    exact : an array is an ensemble, whose mean lies within these limits by five standard errors; a pair is a value and
    the limit that is meant; a function says whether a value is right.
    """
    value, half, bound = _parts(number)
    if callable(exact):
        return bool(exact(value))
    if isinstance(exact, tuple):
        exact, half = exact
    if not isinstance(exact, np.ndarray):
        return abs(exact - value) <= (bound or half * (1.0 + 1e-9))
    if bound:
        return abs(deviations(exact, value, bound / 5.0)) < 5.0
    return deviations(exact, value - half) > 5.0 > -5.0 > deviations(exact, value + half)


def is_setting(text, found, step):
    """Return whether a number follows the symbol of a parameter and "=", and is a value of it in the step."""
    symbol = re.search(r"([^\s$*,(]+)\$?\s*=\s*\$?$", text[: found.start()])
    if symbol is None:
        return False
    name = re.sub(r"_\{?(\d+)\}?", lambda lowered: lowered[1].translate(_LOWERED), symbol[1].replace("\\", ""))
    for written, letter in _LETTERS.items():
        name = name.replace(written, letter)
    places = [step.at, *([step.prediction.then] if step.prediction else [])]
    specs = [spec.name for spec in scenes()[step.at.scene].specs if getattr(spec, "symbol", None) == name]
    values = [place.values[one] for one in specs for place in places]
    if step.animation and step.animation.name in specs:
        values += [step.animation.start, step.animation.end]
    return any(is_right(found[0], value) for value in values)


def places(phrase, text):
    """Return the matches of a phrase in a text, wherever its lines break."""
    return list(re.finditer(r"\s+".join(map(re.escape, phrase.split())), text))


def mistakes(texts, step, rows):
    """Return the numbers in the texts of a step that are wrong, or that neither a row nor the step's state has."""
    wrong = []
    for text in texts:
        said = set()
        for phrase, computed in rows.items():
            for place in places(phrase, text):
                numbers = list(NUMBER.finditer(text, *place.span()))
                exact = computed(step) if callable(computed) else computed
                if len(numbers) != len(exact) or not all(map(is_right, (one[0] for one in numbers), exact)):
                    wrong.append(f"{step.title}: {phrase!r} is {exact}")
                said.update(found.start() for found in numbers)
        wrong += [
            f"{step.title}: nothing computes {found[0]!r} in {text[max(0, found.start() - 60) : found.end() + 20]!r}"
            for found in claims(text)
            if found.start() not in said and not is_setting(text, found, step)
        ]
    return wrong
