"""Expressions in the box of a number: their values, and refused ones."""

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hess_explorer.protocol.expressions import FUNCTIONS, MAX_LENGTH, NotANumber, evaluate
from support.thorough import examples


@pytest.mark.parametrize(
    ("text", "exact"),
    [
        ("pi/3", lambda: mpmath.pi / 3),
        ("−2^3", lambda: -8),
        ("2**-0.5", lambda: 1 / mpmath.sqrt(2)),
        (" 3·π ", lambda: 3 * mpmath.pi),
        ("(1+e)*(1-e)", lambda: 1 - mpmath.e**2),
        ("log(10)", lambda: mpmath.log(10)),
        ("2**3**2", lambda: 512),
        ("asin(1)+acos(0.5)-atan(1)", lambda: mpmath.pi / 2 + mpmath.pi / 3 - mpmath.pi / 4),
        ("exp(tanh(0.5))", lambda: mpmath.exp(mpmath.tanh(0.5))),
    ],
)
def test_an_expression_has_its_value(text, exact):
    assert evaluate(text) == pytest.approx(float(exact()), rel=1e-14)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "NaN",
        "1 2",
        "'a'*99",
        "x:=1",
        "1or 2",
        "pi(2)",
        "__import__",
        "lambda: 1",
        "2j",
        "(" * MAX_LENGTH,
        "1" + "+1" * MAX_LENGTH,
        "１",
    ],
)
def test_what_is_no_number_is_refused_with_a_sentence(text):
    with pytest.raises(NotANumber, match=r"^(This is not a|The (value|expression) is).*\.$"):
        evaluate(text)


@pytest.mark.parametrize("text", ["1/0", "1e999", "9**9**9", "sqrt(-1)", "(-1)**0.5", "log(0)"])
def test_what_has_no_finite_value_says_so(text):
    with pytest.raises(NotANumber, match="not finite"):
        evaluate(text)


@settings(max_examples=examples(30), deadline=1000)
@given(
    st.lists(
        st.sampled_from([*"0123456789.eπ+-*/() ", "**", "pi", "1e9", *FUNCTIONS, "'", "[", "lambda", "_"]), max_size=40
    )
)
def test_whatever_is_typed_is_a_finite_number_or_a_sentence(parts):
    try:
        value = evaluate("".join(parts))
    except NotANumber as refusal:
        assert str(refusal).endswith(".")
    else:
        assert abs(value) < float("inf")
