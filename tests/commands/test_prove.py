"""`hess-explorer prove`: words, a certificate that a checker accepts, and a one-sentence message for every error."""

import json
from fractions import Fraction

import pytest

from hess_explorer.__main__ import main
from manual.check_certificate import verify
from support.command_line import typed

TORUS = ("--a", "-0.5", "--h", "1.5", "--f", "1.7")


def test_the_certificate_proves_what_the_words_say(answer, capsys, tmp_path):
    found = answer("prove", *TORUS, "--format", "json")
    verify(found)
    assert (found["statement"], found["a"], found["h"], found["f"]) == ("two cycles", "-1/2", "3/2", "17/10")
    low, high = map(Fraction, found["trace"])
    assert 2 < low < high < low + Fraction(1, 10**12)
    assert set(found["versions"]) == {"hess-explorer", "python-flint", "flint", "python"}
    assert main(["prove", *TORUS]) == 0
    words = capsys.readouterr().out
    assert words.startswith("Proved: the torus h = 1.5, f = 1.7 for a = -0.5 has exactly two limit cycles")
    assert all(end in words for end in (*found["trace"], *found["multipliers"][0], *found["fixed_points"][1]))
    path = tmp_path / "proof.json"
    assert main(["prove", *TORUS, "--format", "json", "--out", str(path)]) == 0
    assert {**json.loads(path.read_text()), "seconds": 0} == {**found, "seconds": 0}
    assert main(typed("prove --a 0 --h 2 --f 0 --bits 64")) == 0
    assert capsys.readouterr().out.startswith("Undecided at 64 bits: the intervals do not tell whether the torus h")


@pytest.mark.parametrize(
    "words, said",
    [
        (("--f", "9"), "No motion has exactly h = 1.5 and f = 9"),
        (("--f", "x"), "f = 'x' is not an exact number; write it like 1.5, -2e-3 or 3/4"),
        (("--h", "1", "--f", "0"), "separatrix"),
    ],
)
def test_bad_numbers_are_refused_with_a_sentence(refusal, words, said):
    assert said in refusal("prove", *TORUS, *words)
