"""`hess-explorer tube`: decimals that enclose a motion, and an orbit judged by them."""

from fractions import Fraction

import pytest

from hess_mechanics import level, solve, systems

WORDS = ("tube", "suslov", "--start", "0.8,-0.4,0.6,0,0.8", "--parameters", "2,1,0.3,0.5,0.3,-0.5,1", "--t", "0.5,1")


def test_a_motion_is_enclosed_and_its_orbit_judged(answer):
    found = answer(*WORDS, "--accuracy", "draft", "--right-to", "1e-12")
    system = systems()["suslov"]
    fine = solve(*system.example_motion, [0.5, 1.0], level("reference"))
    assert found["complete"]
    assert found["variables"] == list(system.variables)
    for row, state in zip(found["tube"], fine.states, strict=True):
        for (low, high), x in zip(row["state"], state, strict=True):
            assert Fraction(low) - Fraction(1, 10**14) <= Fraction(x) <= Fraction(high) + Fraction(1, 10**14)
            assert 0 <= Fraction(high) - Fraction(low) < Fraction(1, 10**17)
    rough = solve(*system.example_motion, [0.5, 1.0], level("draft"))
    low, high = found["orbit"]["proved_error"]
    assert low <= abs(rough.states - fine.states).max() + 1e-14
    assert abs(rough.states - fine.states).max() <= high + 1e-14
    assert found["orbit"]["right_until"] == (0.0 if high > 1e-12 else 1.0)


def test_a_tube_that_takes_too_much_work_ends_early_and_says_what_to_do(answer, refusal):
    # a = 187: neighbours part as e^(190 t), which takes hundreds of bits.
    hard = ("tube", "hess", "--start", "0.3,1.42,-0.6,0,0.8", "--parameters", "187,1", "--seconds", "0.2", "--t")
    found = answer(*hard, "0.1,2")
    assert [row["t"] for row in found["tube"]] == [0.1]
    assert not found["complete"]
    assert found["notes"] == [
        "Enclosed only up to t = 0.1 of 2: the work limit of 0.2 s is reached. Reduce --digits or the time, or "
        "increase --seconds."
    ]
    assert "No time is enclosed: the work limit of 0.2 s is reached" in refusal(*hard, "2")
    assert "--seconds 0 is not positive: choose a number above 0" in refusal(*hard, "2", "--seconds", "0")


@pytest.mark.parametrize(
    "words, said",
    [
        (("tube", "moon", *WORDS[2:]), "choose one of"),
        ((*WORDS[:3], "1,2", *WORDS[4:]), "takes 5 numbers here"),
        ((*WORDS, "--digits", "0"), "is not a whole number"),
    ],
)
def test_bad_words_are_refused_with_a_sentence(refusal, words, said):
    assert said in refusal(*words)
