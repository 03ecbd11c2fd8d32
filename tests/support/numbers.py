"""The numbers that stand in a text, and whether computed values are what it says."""

import re
import sys
from fractions import Fraction
from math import log10

import numpy as np

from support.deviations import deviations

_WORDS = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"]
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_PLAIN = r"\d+(?:\.\d+|(?: 000)+)?"
_POWER = r"10(?:\^\{?(-?\d+)\}?|([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))"
NUMBER = re.compile(
    rf"(?:(?<![\w.^_])(?<!_\{{)|(?<=\\pm))[−-]?"
    rf"(?:(?:{_PLAIN}(?:\\cdot|·))?{_POWER}|{_PLAIN}(?:e-\d+|/\d+)?)(?:\\pm[\d.]*\d(?![\di.]))?"
    rf"|\b(?:{'|'.join(_WORDS[2:])})\b",
    re.IGNORECASE,
)
DIGITS = -log10(sys.float_info.epsilon)
"""The digits of a double, 15.7."""


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


def places(phrase, text):
    """Return the matches of a phrase in a text, wherever its lines break."""
    return list(re.finditer(r"\s+".join(map(re.escape, phrase.split())), text))


def mistakes(texts, step, phrase, computed):
    """Return what is wrong with the numbers in each place of a phrase, and whether the texts have it."""
    found = [(text, place) for text in texts for place in places(phrase, text)]
    wrong = []
    for text, place in found:
        numbers, exact = [one[0] for one in NUMBER.finditer(text, *place.span())], computed(step)
        if len(numbers) != len(exact) or not all(map(is_right, numbers, exact)):
            wrong.append(f"{step.title}: {phrase!r} is {exact}")
    return wrong, bool(found)
