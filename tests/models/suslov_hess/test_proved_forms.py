"""Closed forms of the Suslov–Hess case to thirty digits, against the reference and against proofs by Taylor steps."""

from fractions import Fraction

from pytest import mark, raises

from hess_mechanics import prove
from hess_mechanics.errors import InvalidParameter, OutsideRegion, Separatrix
from hess_mechanics.suslov_hess.proved_forms import proved_torus_period, proved_trace_on_curve
from support.mechanics import every_known_torus


@every_known_torus
def test_the_period_of_the_reference_is_enclosed(row):
    found = proved_torus_period(row["h"], row["f"])
    known = Fraction(row["period"])
    slack = known / 10**20
    assert found.low - slack <= known <= found.high + slack
    assert found.width < Fraction(1, 10**29)


@mark.parametrize(
    ("n", "root"),
    [(Fraction(1, 4), Fraction(1, 2)), (Fraction(1, 9), Fraction(1, 3)), (Fraction(81, 100), Fraction(9, 10))],
)
@mark.parametrize("a", ["0.5", "-1.5"])
def test_the_trace_on_the_edge_is_the_limit_of_the_traces_of_tori(a, n, root):
    """Both are proved, by different means; next to the edge |t| is off by as much as (h, f) is."""
    found = proved_trace_on_curve(a, n)
    proof = prove(a, (1 - 3 * n * n) / (2 * n), (1 - n * n) / root - Fraction(1, 10**30), digits=28)
    assert abs(abs(found.low) - proof.trace.low) < max(1, abs(found.low)) * Fraction(1, 10**27)
    assert found.precision < 1e-29


def test_on_the_edge_n3_has_no_period():
    with raises(InvalidParameter, match="n3 is constant and has no period"):
        proved_torus_period("13/8", "15/8")


def test_what_has_no_closed_form_is_refused():
    for torus, error in ((("1", "0"), Separatrix), (("0", "2"), OutsideRegion), (("-1", "0"), OutsideRegion)):
        with raises(error):
            proved_torus_period(*torus)
    for n in ("0", "1.5"):
        with raises(InvalidParameter, match="not on the curve"):
            proved_trace_on_curve("0.5", n)
