"""Proofs of two limit cycles, or none: compared with multiple-precision values; altered certificates are refused."""

import json
import random
import re
import subprocess
import sys
from fractions import Fraction
from functools import cache

import mpmath
from pytest import approx, mark, raises

import oracle
from hess_mechanics import certificate, prove
from hess_mechanics.errors import InvalidParameter, MissingLibrary, OutsideRegion, Separatrix, WorkLimit
from hess_mechanics.numerics.balls import Enclosure, exact
from hess_mechanics.suslov_hess.certificate import statement_text
from manual.check_certificate import Refused, verify
from oracle.kept import KEPT
from support.mechanics import REFERENCE, ROOT
from support.refusals import refused
from support.thorough import sample

STATEMENTS = {True: "two cycles", False: "no cycle"}


def number(rational):
    return mpmath.mpf(rational.numerator) / rational.denominator


def kept_maps(most):
    """Return tori, as exact rationals, and the oracle's stored 40-digit maps of them."""
    found = []
    for question, (_, answer) in KEPT.items():
        name, *arguments = json.loads(question)
        if name == "maps_by_three_orbits" and isinstance(arguments[0], list):
            maps = oracle.circle_maps.as_maps(answer)
            found += [([Fraction(x) for x in torus], one) for torus, one in zip(arguments[0], maps, strict=True)]
    return random.Random(17).sample(found, min(most, len(found)))


# ---- enclosures hold what is known ------------------------------------------------------------------------------


@mark.parametrize(
    ("moved", "row"),
    [(name, row) for name, rows in (("f", "lock_boundary"), ("a", "a_critical")) for row in REFERENCE[rows]],
    ids=str,
)
def test_on_both_sides_of_the_held_boundary_the_statements_differ(moved, row):
    """A boundary of 20 digits, moved by 1e-15 of itself either way."""
    found = []
    for sign in (-1, 1):
        proof = prove(**row | {moved: Fraction(row[moved]) * (1 + sign * Fraction(1, 10**15))})
        found.append(proof.statement)
        assert abs(proof.trace.low - 2) < Fraction(1, 10**13)
    assert sorted(found) == ["no cycle", "two cycles"]


def test_traces_roots_cycles_and_rotation_numbers_of_random_tori_are_those_of_forty_digits():
    """Random tori of other tests: |a| up to 50, down to 1e-14 from the separatrix and the edge, f down to 1e-20."""
    decided, tori = 0, sample(kept_maps(100), 12)
    for (a, h, f), known in tori:
        proof = prove(a, h, f)
        with mpmath.workdps(60):
            held = abs(2 * mpmath.re(known.A))
            slack = mpmath.mpf("1e-17") * max(1, held)
            assert number(proof.trace.low) - slack <= held <= number(proof.trace.high) + slack, (a, h, f)
            for root, known_root in zip(proof.roots, oracle.turning_roots(number(h), number(f)), strict=True):
                assert abs(number(root.low) - known_root) < mpmath.mpf("1e-19") * max(1, abs(known_root))
                assert root.width < Fraction(1, 10**19)
            for phi, multiplier in zip(proof.fixed_points, proof.multipliers, strict=True):
                z = mpmath.expj(number(phi.low))
                image = (known.A * z + known.B) / (mpmath.conj(known.B) * z + mpmath.conj(known.A))
                steep = 1 / abs(known.A * z + known.B) ** 2
                assert abs(image - z) < 1e-9 * max(1, steep)
                assert float(steep) == approx(float(multiplier.low), rel=1e-6)
            if proof.statement == "no cycle":
                cosine = mpmath.cospi(number(proof.rotation_number.low))
                assert abs(abs(2 * cosine) - held) < 1e-14
        decided += proof.statement == STATEMENTS[held > 2]
        assert proof.statement in ("undecided", STATEMENTS[held > 2]), (a, h, f)
    assert decided >= len(tori) - 1


# ---- what is exact, and what is refused -------------------------------------------------------------------------


def test_numbers_are_taken_as_exact_decimals():
    assert exact("a", 0.1) == exact("a", "0.1") == exact("a", "1/10") == Fraction(1, 10)
    for text in ("", "nan", "1/0", "1e999999999", "1/1e-999", "9" * 101, "1_0_", "１"):
        with raises(InvalidParameter, match="is not an exact number"):
            exact("a", text)


def test_decimals_enclose_the_ends():
    rng = random.Random(4)
    for _ in range(50):
        low = Fraction(rng.randint(-(10**9), 10**9), rng.randint(1, 10**9)) * Fraction(10) ** rng.randint(-30, 30)
        found = Enclosure(low, low + abs(low) * Fraction(rng.randint(1, 9), 10 ** rng.randint(1, 25)))
        for pair in (found.decimals(None), found.decimals(3), found.double_decimals()):
            assert Fraction(pair[0]) <= found.low <= found.high <= Fraction(pair[1])


test_what_cannot_be_proved_is_refused_with_a_sentence = refused(
    (lambda: prove("0.5", "1", "0"), "separatrix", Separatrix),
    (lambda: prove("0.5", "-1", "0"), "not above the lowest energy", OutsideRegion),
    (lambda: prove("0.5", "0", "2"), "choose", OutsideRegion),
    (lambda: prove("2e6", "0", "0.1"), "choose"),
    (lambda: prove("0.5", "0", "1e-150"), "choose f = 0 or"),
    (lambda: prove("1e5", "0.5", "0.3"), "smaller", WorkLimit),
)


def test_the_edge_is_told_exactly_from_both_sides():
    """Beyond the edge by 1e-60, undetectable in doubles, no motion exists; before it a torus; on it a circle."""
    h, f = Fraction(13, 8), Fraction(15, 8)
    tiny = Fraction(1, 10**60)
    with raises(OutsideRegion, match="exactly"):
        prove("0.5", h, f + tiny)
    assert prove("0.5", h, f - tiny).statement == "two cycles"
    on_it = prove("0.5", h, f)
    assert on_it.statement == "two equilibria"
    assert "no torus and no limit cycle" in statement_text(on_it)
    assert "exactly two equilibria" in statement_text(on_it)


@mark.parametrize(("a", "statement"), [("0", "undecided"), ("-2", "two cycles"), ("100", "two cycles")])
def test_a_pendulum_that_goes_round_has_the_trace_of_its_closed_form_and_where_it_is_2_nothing_is_claimed(a, statement):
    """f = 0, h > 1: 2 cosh(πa), whatever h."""
    proof = prove(a, "1.7", "0", 64)
    with mpmath.workdps(60):
        assert number(proof.trace.low) <= 2 * mpmath.cosh(mpmath.pi * int(a)) <= number(proof.trace.high)
    assert (proof.statement, proof.bits) == (statement, 64)
    if statement == "undecided":
        verify(certificate(proof))


def test_without_the_library_a_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "flint", None)
    with raises(MissingLibrary, match=r"pip install 'hess-explorer\[prove\]'"):
        prove("0.5", "1.5", "0.6")


# ---- certificates -----------------------------------------------------------------------------------------------

LOCKED, TURNING = ("-0.5", "1.5", "1.7"), ("0.5", "-0.3", "0.6")
LIMIT, EDGE = ("0.3", "0.2", "0"), ("0.5", "13/8", "15/8")


@cache
def written(torus):
    return json.dumps(certificate(prove(*torus)))


def certified(torus):
    """Return the certificate after a round trip through JSON."""
    return json.loads(written(torus))


@mark.parametrize("torus", [LOCKED, TURNING, LIMIT, EDGE, ("0.1", "13/8", "15/8")])
def test_a_certificate_holds_for_a_checker_that_shares_no_code(torus):
    verify(certified(torus))


def changed(found, path, change):
    *before, last = path
    place = found
    for key in before:
        place = place[key]
    place[last] = change(place[last])


def shifted(text):
    return str(Fraction(text) + Fraction(1, 10**6))


def pair(ends):
    return [shifted(end) for end in ends]


@mark.parametrize(
    ("torus", "path", "change"),
    [
        (LOCKED, ["statement"], lambda _: "no cycle"),
        (LOCKED, ["trace"], pair),
        (TURNING, ["rotation_number"], pair),
        (LOCKED, ["fixed_points", 0], pair),
        (LOCKED, ["multipliers", 1], pair),
        (LOCKED, ["roots", 1], pair),
        (LOCKED, ["half", 2], pair),
        (LOCKED, ["steps"], lambda steps: steps[:2] + steps[3:]),
        (LOCKED, ["steps", 1, "matrix", 0], pair),
        (LOCKED, ["steps", 1, "bound"], lambda bound: str(Fraction(bound) / 2)),
        (LOCKED, ["steps", 1, "start"], shifted),
    ],
)
def test_a_certificate_with_a_change_is_refused(torus, path, change):
    found = certified(torus)
    changed(found, path, change)
    with raises(Refused):
        verify(found)


NO_CYCLE = {"statement": "undecided", "fixed_points": [], "multipliers": [], "rotation_number": None}
WIDE = {"statement": "undecided", "rotation_number": None, "trace": ["0", "3"], "trace_ball": ["0", "3"]}


@mark.parametrize(
    ("torus", "change", "words"),
    [
        (LOCKED, {"roots": ...}, "roots is missing"),
        (LOCKED, {"format": "Suslov–Hess torus, 9"}, "the format is neither"),
        (LOCKED, NO_CYCLE, "undecided is not what the steps prove"),
        (TURNING, WIDE, "undecided is not what the steps prove: no cycle"),
        (LIMIT, {"trace_ball": ["0", "1"]}, "trace_ball is 0"),
        (EDGE, {"statement": "periodic orbit"}, "not what the circle does"),
        (EDGE, {"n": "1/3"}, "not on the edge"),
        (EDGE, lambda found: {"fixed_points": found["fixed_points"][::-1]}, "wrong side"),
    ],
)
def test_a_forged_certificate_is_refused_with_a_sentence(torus, change, words):
    found = certified(torus)
    for name, value in (change(found) if callable(change) else change).items():
        found.pop(name, None)
        if value is not ...:
            found[name] = value
    with raises(Refused, match=re.escape(words)):
        verify(found)


def test_the_checker_says_in_a_sentence_what_it_refuses(tmp_path):
    path = tmp_path / "certificate.json"
    path.write_text("[]")
    words = [sys.executable, ROOT / "tests" / "manual" / "check_certificate.py", path]
    run = subprocess.run(words, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert re.fullmatch(r"refused: .+\n", run.stderr)
    assert run.stdout == ""
