"""Formulas that a visitor types: polynomials come out, and nothing else."""

import random

import numpy as np
from pytest import approx, mark, raises

from hess_explorer.protocol.formulas import MAX_LENGTH, drive, polynomial
from hess_explorer.protocol.specs import Formula
from hess_mechanics.errors import InvalidParameter

PIECES = [
    *["g1", "g2", "g3", "0.5", "2", "3e-1", "(", ")", "+", "-", "*", "/", "^", "**", "−"],
    "γ₁",
    ".",
    "__",
    "e",
    "g4",
    "'",
    "[",
    ",",
    "lambda",
    "\n",
    "x",
]


def test_a_formula_is_its_coefficients():
    expected = {(2, 0, 0): 0.5, (1, 1, 0): 1.0, (0, 2, 0): 0.5, (0, 0, 4): -1.0}
    assert polynomial("(g1 + g2)**2/2 − γ₃^4 + 7") == approx(expected)
    assert polynomial("g1 - g1 + 7") == polynomial("") == {}


@mark.parametrize(
    ("text", "message"),
    [
        ("g1^7", "not a whole number"),
        ("(g1*g2)^4", "degree"),
        ("1/g1", "divides by 0 or by something other than a number"),
        ("2^g1", "not a whole number"),
        ("g4", "not a polynomial: use numbers, g1, g2, g3"),
        ("1e9*g1", "larger than 1e"),
        ("g1+" * MAX_LENGTH, f"longer than {MAX_LENGTH}"),
    ],
)
def test_what_is_no_polynomial_is_refused(text, message):
    with raises(InvalidParameter, match=message):
        polynomial(text)


@mark.parametrize("text", ["cos(W*t) + 0.5*sin(2*W*t)", "-sin(Ωt)*cos(5*Ω*t)/3 + 2", "(cos(W*t) - 1)^3", ""])
def test_a_drive_has_the_values_of_its_formula(text):
    found = drive(text)
    python = text.replace("^", "**").replace("Ωt", "Ω*t").replace("Ω", "W") or "0"
    names = {"cos": np.cos, "sin": np.sin, "W": 0.7, "__builtins__": {}}
    values = np.array([eval(python, {**names, "t": t}) for t in np.linspace(0.0, 9.0, 20)])
    phase = 0.7 * np.linspace(0.0, 9.0, 20)
    shape = sum(c * np.cos(phase) ** i * np.sin(phase) ** j for (i, j, _), c in found.items())
    # The constant is left out.
    assert np.ptp(values - shape) == approx(0.0, abs=1e-12)


@mark.parametrize(
    ("text", "message"),
    [
        ("cos(t)", "not a drive: use numbers and cos"),
        ("W*t", "use t only inside cos and sin"),
        ("cos(7*W*t)", "n from 1 to 6"),
        ("cos(4*W*t)*sin(3*W*t)", "degree"),
    ],
)
def test_what_is_no_drive_is_refused(text, message):
    with raises(InvalidParameter, match=message):
        drive(text)


def test_a_parameter_keeps_the_text_and_refuses_with_its_name():
    spec = Formula("U", "Potential", "g3")
    assert spec.read(" g1 ^ 2 ") == ("g1 ^ 2", None)
    assert spec.read("g1 +") == ("g3", spec.read("g1 +")[1])
    assert spec.read("g1 +")[1].startswith("Potential: This is not a polynomial")


def test_random_formulas_are_polynomials_with_the_same_values_or_refused(request):
    draw = random.Random(5)
    place = {f"g{i + 1}": x for i, x in enumerate((0.3, -1.2, 0.7))}
    read = 0
    for _ in range(100_000 if request.config.getoption("thorough") else 3000):
        text = "".join(draw.choice(PIECES[:15] if draw.random() < 0.8 else PIECES) for _ in range(draw.randint(1, 12)))
        try:
            found = polynomial(text)
        except InvalidParameter:
            continue
        read += 1
        python = text.replace("^", "**").replace("−", "-").replace("γ₁", "g1")
        here, there = (
            eval(python.strip() or "0", {"__builtins__": {}}, values) for values in (place, dict.fromkeys(place, 0.0))
        )
        value = sum(c * np.prod(np.array([*place.values()]) ** one) for one, c in found.items())
        assert value == approx(here - there, rel=1e-9, abs=1e-9), text
    assert read > 100
