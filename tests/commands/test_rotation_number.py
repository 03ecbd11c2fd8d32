"""The commands `rotation-number` and `lyapunov`: their numbers, formats, and one sentence for whatever is wrong."""

import math
from argparse import Namespace

import pytest
from pytest import approx

from hess_explorer.commands import CommandError
from hess_explorer.commands.output import Answer, write
from hess_mechanics import f_max
from support.command_line import replaced, typed
from support.rotation_number import iterated

ROTATION = typed("rotation-number --a 0.5 --h -0.5,0.5,1.5 --f -0.3,0.6")
LYAPUNOV = typed("lyapunov suslov --I 1.5,3,0.4,0.4 --b=-0.5,-0.5,0.7 --omega 0.4,0.6 --gamma 0.6,0,0.8 --t 200")


def test_rotation_numbers_are_those_of_iteration(answer):
    found = answer(*ROTATION)
    assert found["a"] == [0.5] * 6
    assert found["h"] == [-0.5, -0.5, 0.5, 0.5, 1.5, 1.5]
    assert found["f"] == [-0.3, 0.6] * 3
    assert found["possible"] == [abs(f) <= f_max(h) for h, f in zip(found["h"], found["f"], strict=True)]
    assert found["level"] == "precise"
    for i, possible in enumerate(found["possible"]):
        rho, trace = found["rotation_number"][i], found["trace"][i]
        if not possible:
            assert (rho, trace, found["locked"][i]) == (None, None, None)
            continue
        exact = iterated(0.5, found["h"][i], found["f"][i])
        assert rho == approx(exact, abs=1e-4)
        assert found["locked"][i] == (trace > 2.0)
        assert trace == approx(abs(2.0 * math.cos(math.pi * rho)), abs=1e-9) or found["locked"][i]
    assert found["locked"] == [False, None, False, False, True, True]


def test_the_separatrix_and_the_outside_are_not_possible(answer, as_table):
    words = ("rotation-number", "--a", "0.5", "--h", "-1,1,0", "--f", "0,5")
    found = answer(*words)
    assert found["possible"] == [False, False, False, False, True, False]
    for name in ("rotation_number", "trace", "locked"):
        assert [value is not None for value in found[name]] == found["possible"]
    # In a table an impossible torus has empty fields.
    _, header, rows = as_table(*words)
    first = header.index("rotation_number")
    assert [row[first:] for row in rows if row[-1] == "False"] == [["", "", "", "False"]] * 5
    assert all(map(float, rows[4][first : first + 1]))


def test_the_exponent_backward_and_of_a_vector_that_is_normalised(answer):
    found = answer(*replaced(replaced(LYAPUNOV, "--t", "-50"), "--gamma", "3,0,4"))
    assert "normalised" in found["notes"][0]
    assert len(found["t"]) > 20
    assert math.isfinite(found["exponent"])


def test_all_exponents_with_errors_signs_and_a_dimension(answer, as_table):
    words = typed(
        "lyapunov suslov --I 1.7,3,0.3,0.1 --b=-2,-2.1,2.6 --omega 0.8,1.3 --gamma 0.6,0,0.8 --t 1500 --spectrum"
    )
    found = answer(*words)
    assert found["signs"] == ["+", "0", "0", "0", "-"]
    assert found["sum"] == approx(found["divergence"], abs=1e-7)
    assert found["dimension"] == approx(
        2.0 + (found["divergence"] - found["exponents"][4]) / -found["exponents"][4], abs=1e-9
    )
    assert found["pairs_forced"] is False
    alone = answer(*words[:-1])["exponent"]
    assert found["exponents"][0] == approx(alone, abs=4.0 * found["errors"][0])
    _, header, rows = as_table(*words)
    assert header == ["t", *(f"average {i}" for i in range(1, 6))]
    assert float(rows[-1][1]) == found["average 1"][-1]


@pytest.mark.parametrize(
    "words, said",
    [
        (replaced(ROTATION, "--h", "2e12"), "--h: h = 2e12 is not between -1e6 and 1e6"),
        (typed("rotation-number --a 0:1:300 --h 0:1:300 --f 0:1:300"), "27000000 tori, but at most 1000000"),
        (replaced(LYAPUNOV, "--t", "1e9"), "choose a shorter time span"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)


@pytest.mark.parametrize(("form", "column"), [("json", [1.0, math.nan]), ("csv", [[1.0, -math.inf], [0.0, 1.0]])])
def test_no_column_has_a_number_that_is_none(form, column, capsys):
    with pytest.raises(CommandError, match="rate: a number exceeds the range of double precision; choose"):
        write(Namespace(format=form, out=None), Answer({"t": [0.0, None], "rate": column}, {}))
    assert capsys.readouterr().out == ""
