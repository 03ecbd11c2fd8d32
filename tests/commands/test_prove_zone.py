"""`hess-explorer prove-zone`: cells, their share over time, in words, JSON and CSV."""

import pytest
from pytest import approx
from scipy.integrate import quad

from check_certificate import Refused
from check_zone import verify
from hess_explorer.__main__ import main
from hess_mechanics import f_max, prove

WORDS = ("prove-zone", "--a", "1/2", "--h-end", "2", "--cells", "25")


def test_cells_in_json_and_words_are_the_same(answer, capsys):
    found = answer(*WORDS, "--format", "json")
    assert found["a"] == "1/2"
    assert found["progress"][-1]["cells"] == 25
    assert found["progress"][-1]["decided"] == approx(found["decided"], abs=1e-6)
    area = quad(f_max, -1 + 1e-12, 2)[0]
    assert sum(found["areas"].values()) == approx(area, rel=1e-6)
    assert found["decided"] == approx(1 - found["areas"]["undecided"] / area, rel=1e-6)
    proved = next(cell for cell in found["cells"] if cell["statement"] == "two cycles")
    # As the JSON says what α and β mean.
    (a0, a1), (b0, b1) = proved["alpha"], proved["beta"]
    alpha, beta = (a0 * a1) ** 0.5, (b0 * b1) ** 0.5
    alpha, beta = max(alpha, beta), min(alpha, beta)
    s = 2 / ((1 + alpha + beta) ** 2 - 4 * alpha * beta) ** 0.5
    h, f = (alpha + beta - 1) * s / 2, (2 * alpha * beta) ** 0.5 * s**1.5
    assert 0 < f <= f_max(h)
    assert prove("1/2", repr(h), repr(f)).statement == "two cycles"
    assert main([*WORDS]) == 0
    said = capsys.readouterr().out
    assert f"two limit cycles on {100 * found['areas']['two cycles'] / sum(found['areas'].values()):.2f} %" in said
    assert "provided that the ball arithmetic of Arb is correct" in said


@pytest.mark.parametrize(
    "words, said",
    [
        (("--a", "9"), "|a| ≤ 3"),
        (("--h-end", "-2"), "h > −1"),
        (("--cells", "0"), "is not a whole number"),
    ],
)
def test_bad_numbers_are_refused_with_a_sentence(refusal, words, said):
    assert said in refusal(*WORDS, *words)


def test_cells_hold_for_a_checker_that_shares_no_code_and_changed_ones_do_not(answer):
    """Cells on both sides of the boundary."""
    zone = answer("prove-zone", "--a", "0.5", "--h-end", "1.5", "--cells", "90", "--format", "json")
    proved = [cell for cell in zone["cells"] if cell["statement"] != "undecided"]
    assert verify(zone) == len(proved) > 5
    assert {cell["statement"] for cell in proved} == {"two cycles", "no cycle"}
    other = {"two cycles": "no cycle", "no cycle": "two cycles"}
    first = proved[0]
    for changed in (
        {"statement": other[first["statement"]]},
        {"alpha": [first["alpha"][0] * 1e-4, first["alpha"][1] * 1e4]},
        {"alpha": first["alpha"][::-1]},
    ):
        with pytest.raises(Refused):
            verify({**zone, "cells": [{**first, **changed}]}, halvings=2)
    # For another body the same cell is no longer proved.
    with pytest.raises(Refused):
        verify({**zone, "a": "0.1", "cells": [cell for cell in proved if cell["statement"] == "two cycles"][:1]})
    undecided = next(cell for cell in zone["cells"] if cell["statement"] == "undecided")
    for statement in other:
        with pytest.raises(Refused):
            verify({**zone, "cells": [{**undecided, "statement": statement}]}, halvings=0)


@pytest.mark.parametrize(
    "change, words",
    [
        ({"format": "another"}, "the format is not"),
        ({"cells": [{"alpha": [1, 2], "beta": [1.0, 2.0], "statement": "undecided"}]}, "this is no cell"),
        ({"cells": [{"alpha": [5e-324, 1e308], "beta": [5e-324, 1e308], "statement": "no cycle"}]}, "is not proved"),
    ],
)
def test_a_forged_zone_is_refused_with_a_sentence(change, words):
    zone = {"format": "Suslov–Hess lock zone, 1", "a": "1/2", "cells": []}
    assert verify(zone) == 0
    with pytest.raises(Refused, match=words):
        verify({**zone, **change}, halvings=0)
