"""Comparison with independent 20-digit values at every accuracy level."""

from pytest import approx, mark

from hess_mechanics import circle_map, critical_a
from hess_mechanics.numerics.accuracy import Status
from support.mechanics import REFERENCE


@mark.parametrize(("name", "bound"), [("draft", 1e-3), ("standard", 1e-6), ("precise", 1e-9), ("reference", 1e-9)])
@mark.parametrize(
    "row", REFERENCE["lock_boundary"] + REFERENCE["a_critical"], ids=lambda row: f"h={row['h']},f={row['f']}"
)
def test_the_critical_a_of_the_lock_boundary_agrees_with_the_reference(row, name, bound):
    assert critical_a(float(row["h"]), float(row["f"]), name) == approx(float(row["a"]), abs=bound)


@mark.parametrize("h", [1.000001, 0.999999])
def test_next_to_the_separatrix_reference_admits_that_it_reached_the_floor(h):
    # One unit in the last place of h moves Θ by 1e-10 here: no double can keep 1e-12.
    assert circle_map(0.5, h, 1e-6, "reference").status is Status.FLOOR
