"""Proofs of two limit cycles, or none: compared with multiple-precision values; altered certificates are refused."""

import json
import random
import re
import subprocess
import sys
from fractions import Fraction
from functools import cache

import mpmath
from mpmath import iv
from pytest import approx, mark, raises

import oracle
from hess_mechanics import certificate, circle_map, curve_point, f_max, prove
from hess_mechanics.errors import InvalidParameter, MissingLibrary, OutsideRegion, Separatrix, WorkLimit
from hess_mechanics.numerics.balls import Enclosure, exact
from hess_mechanics.numerics.patience import work_limit
from hess_mechanics.suslov_hess.certificate import claim
from manual.check_certificate import Refused, verify
from oracle.kept import KEPT
from support.mechanics import REFERENCE, ROOT, every_known_torus
from support.refusals import refused
from support.thorough import sample

STATEMENTS = {True: "two cycles", False: "no cycle"}


def rational(number):
    """Convert an mpmath number to the rational it represents."""
    mantissa, exponent = mpmath.mpf(number).man_exp
    return Fraction(mantissa) * Fraction(2) ** exponent


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


@every_known_torus
def test_the_trace_and_the_roots_of_the_reference_are_enclosed(row):
    proof = prove(row["a"], row["h"], row["f"])
    low, high = map(Fraction, certificate(proof)["trace"])
    held = Fraction(row["abs_trace"])
    # The reference has 22 digits.
    assert low - held * Fraction(1, 10**20) <= held <= high + held * Fraction(1, 10**20)
    assert high - low < Fraction(1, 10**6) * max(1, high)
    assert proof.statement == STATEMENTS[held > 2]
    for root, known in zip(proof.roots, row["n3_roots"], strict=True):
        assert abs(root.low - Fraction(known)) < max(1, abs(root.low)) * Fraction(1, 10**19)
        assert root.width < Fraction(1, 10**19)


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


def test_traces_of_random_tori_to_forty_digits_are_inside():
    """Random tori of other tests: |a| up to 50, down to 1e-14 from the separatrix and the edge, f down to 1e-20."""
    decided, tori = 0, sample(kept_maps(100), 12)
    for (a, h, f), known in tori:
        proof = prove(a, h, f)
        with mpmath.workdps(60):
            held = rational(abs(2 * mpmath.re(known.A)))
        slack = Fraction(1, 10**17) * max(1, held)
        assert proof.trace.low - slack <= held <= proof.trace.high + slack, (a, h, f)
        decided += proof.statement == STATEMENTS[held > 2]
        assert proof.statement in ("undecided", STATEMENTS[held > 2]), (a, h, f)
    assert decided >= len(tori) - 1


def test_cycles_and_rotation_numbers_are_those_of_the_map_to_forty_digits():
    for (a, h, f), known in kept_maps(4):
        proof = prove(a, h, f)
        with mpmath.workdps(60):
            for phi, multiplier in zip(proof.fixed_points, proof.multipliers, strict=True):
                z = mpmath.expj(mpmath.mpf(phi.low.numerator) / phi.low.denominator)
                image = (known.A * z + known.B) / (mpmath.conj(known.B) * z + mpmath.conj(known.A))
                steep = rational(1 / abs(known.A * z + known.B) ** 2)
                assert abs(image - z) < 1e-9 * max(1, steep)
                assert steep == approx(float(multiplier.low), rel=1e-6)
        approximate = circle_map(float(a), float(h), float(f), "reference").rotation_number
        assert float(proof.rotation_number.low) == approx(approximate, abs=1e-7)
        if proof.statement == "no cycle":
            with mpmath.workdps(40):
                share = mpmath.mpf(proof.rotation_number.low.numerator) / proof.rotation_number.low.denominator
                assert abs(2 * mpmath.cospi(share)) == approx(float(proof.trace.low), abs=1e-14)


@mark.parametrize("a", ["-2", "100"])
def test_a_pendulum_that_goes_round_has_the_trace_of_its_closed_form(a):
    """f = 0, h > 1: 2 cosh(πa), whatever h."""
    proof = prove(a, "1.7", "0", 64)
    with mpmath.workdps(60):
        assert rational(2 * mpmath.cosh(mpmath.pi * mpmath.mpf(a))) in proof.trace
    assert proof.statement == "two cycles"


# ---- what is exact, and what is refused -------------------------------------------------------------------------


def test_numbers_are_taken_as_exact_decimals():
    assert exact("a", 0.1) == exact("a", "0.1") == exact("a", "1/10") == Fraction(1, 10)
    for text in ("", "x", "nan", "inf", "1/0", "1/2/3", "1e999999999", "1/1e-999", "9" * 101, "1_0_", "１"):
        with raises(InvalidParameter, match="is not an exact number"):
            exact("a", text)


@mark.parametrize("decimals", [None, 3])
def test_decimals_enclose_the_ends(decimals):
    rng = random.Random(4)
    for _ in range(50):
        low = Fraction(rng.randint(-(10**9), 10**9), rng.randint(1, 10**9)) * Fraction(10) ** rng.randint(-30, 30)
        found = Enclosure(low, low + abs(low) * Fraction(rng.randint(1, 9), 10 ** rng.randint(1, 25)))
        for pair in (found.decimals(decimals), found.outside_doubles()):
            assert Fraction(pair[0]) <= found.low <= found.high <= Fraction(pair[1])
        low, high = map(float, found.outside_doubles())
        assert Fraction(low) <= found.low <= found.high <= Fraction(high)


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
    assert (float(h), float(f)) == approx(curve_point(0.25), abs=1e-15)
    assert f_max(float(h)) == approx(float(f), abs=1e-15)
    tiny = Fraction(1, 10**60)
    with raises(OutsideRegion, match="exactly"):
        prove("0.5", h, f + tiny)
    assert prove("0.5", h, f - tiny).statement == "two cycles"
    on_it = prove("0.5", h, f)
    assert on_it.statement == "two equilibria"
    assert "no torus and no limit cycle" in claim(on_it)


def test_where_the_trace_is_2_nothing_is_claimed():
    """a = 0, f = 0: Θ is the identity, and the trace exactly 2."""
    proof = prove("0", "1.5", "0", 64)
    assert (proof.statement, proof.bits) == ("undecided", 64)
    assert 2 in proof.trace
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
        (LOCKED, ["a"], shifted),
        (LOCKED, ["trace"], pair),
        (LOCKED, ["rotation_number"], lambda _: ["1", "1"]),
        (TURNING, ["rotation_number"], pair),
        (LOCKED, ["fixed_points", 0], pair),
        (LOCKED, ["multipliers", 1], pair),
        (LOCKED, ["roots", 1], pair),
        (LOCKED, ["half", 2], pair),
        (LOCKED, ["steps"], lambda steps: steps[:2] + steps[3:]),
        (LOCKED, ["steps", 1, "matrix", 0], pair),
        (LOCKED, ["steps", 1, "bound"], lambda bound: str(Fraction(bound) / 2)),
        (LOCKED, ["steps", 1, "radius"], lambda radius: str(Fraction(radius) * 8)),
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
        (LOCKED, {"roots": None}, "only for f = 0, h < 1 is the map a limit"),
        (LOCKED, {"roots": ...}, "roots is missing"),
        (LOCKED, {"format": "Suslov–Hess torus, 9"}, "the format is neither"),
        (LOCKED, {"steps": []}, "there are no steps"),
        (LOCKED, NO_CYCLE, "undecided is not what the steps prove"),
        (TURNING, WIDE, "undecided is not what the steps prove: no cycle"),
        (LOCKED, {"fixed_points": [["0", "1"]]}, "1 entries instead of 2"),
        (LOCKED, {"bits": -5}, "bits is not between"),
        (LOCKED, {"a": "1e999999999"}, "a is no number"),
        (TURNING, {"trace": ["2", "0"]}, "exchanged"),
        (LIMIT, {"trace_ball": ["0", "1"]}, "trace_ball is 0"),
        (LOCKED, {"a": "1/2", "h": "13/8", "f": "15/8"}, "a root is not isolated"),
        (EDGE, {"statement": "periodic orbit"}, "not what the circle does"),
        (EDGE, {"n": "1/3"}, "not on the edge"),
        (EDGE, {"period": ["1", "2"]}, "no period"),
        (("0.1", "13/8", "15/8"), {"period": ["1", "2"]}, "the period is not enclosed"),
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


@mark.parametrize("text", ["{", "[]"])
def test_the_checker_says_in_a_sentence_what_it_refuses(text, tmp_path):
    path = tmp_path / "certificate.json"
    path.write_text(text)
    words = [sys.executable, ROOT / "tests" / "manual" / "check_certificate.py", path]
    run = subprocess.run(words, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert re.fullmatch(r"refused: .+\n", run.stderr)
    assert run.stdout == ""


def test_the_precision_of_a_check_does_not_depend_on_checks_before_it():
    """The steps are kept from one check to the next; the numbers after them need the precision of this certificate."""
    found = certified(LOCKED)
    before = iv.prec
    for _ in range(2):
        iv.prec = 8
        verify(found)
        assert iv.prec == 8
    iv.prec = before


def test_a_proof_asks_before_each_step_whether_to_go_on():
    asks = []

    def end():
        asks.append(None)
        if len(asks) > 3:
            raise WorkLimit("enough")

    with work_limit(end, lambda seconds: None), raises(WorkLimit, match="enough"):
        prove("0.5", "1.5", "0.6")
    assert len(asks) == 4
