"""Comparison with independent 20-digit values at every accuracy level."""

from pytest import approx, mark

from hess_mechanics import circle_map, critical_a, level, lock_boundary_f, turning_points
from hess_mechanics.numerics.accuracy import Status
from support.mechanics import REFERENCE, angle_between, every_known_torus, numbers

# (level, largest error of an orbit, largest error of anything else).  Chaotic orbits amplify the
# rounding of their initial data, hence the wider bound at the floor.
LADDER = [("draft", 1e-3, 1e-3), ("standard", 1e-6, 1e-6), ("precise", 1e-9, 1e-9), ("reference", 1e-8, 1e-9)]
ladder = mark.parametrize(("name", "orbit_bound", "bound"), LADDER, ids=[row[0] for row in LADDER])


@ladder
@every_known_torus
def test_circle_maps_agree_with_the_reference_and_their_estimates_are_on_the_safe_side(row, name, orbit_bound, bound):
    result = circle_map(float(row["a"]), float(row["h"]), float(row["f"]), name)
    trace = float(row["abs_trace"])
    trace_error = abs(result.trace - trace) / max(1.0, trace)
    theta_error = angle_between(result.theta([0.0, 1.0, 2.0]), numbers(row["theta_of_phi_0_1_2"]))
    error = max(trace_error, theta_error)
    assert error <= bound
    assert error <= 10 * result.error_estimate + 1e-15
    # It says OK exactly where its estimate keeps the promise.
    assert (result.status is Status.OK) == (result.error_estimate <= level(name).promise)


@every_known_torus
def test_turning_points_and_period_agree_with_the_reference(row):
    turning = turning_points(float(row["h"]), float(row["f"]))
    assert turning.roots == approx(numbers(row["n3_roots"]), abs=1e-9)
    assert turning.period == approx(float(row["period"]), abs=1e-9)
    result = circle_map(0.5, float(row["h"]), float(row["f"]), "draft")
    assert result.period == turning.period


@ladder
@mark.parametrize("row", REFERENCE["lock_boundary"], ids=lambda row: f"a={row['a']},h={row['h']}")
def test_the_lock_boundary_agrees_with_the_reference(row, name, orbit_bound, bound):
    f = lock_boundary_f(float(row["a"]), float(row["h"]), name)
    assert f == approx(float(row["f"]), abs=bound)


@ladder
@mark.parametrize("row", REFERENCE["a_critical"], ids=lambda row: f"h={row['h']},f={row['f']}")
def test_the_critical_a_agrees_with_the_reference(row, name, orbit_bound, bound):
    a = critical_a(float(row["h"]), float(row["f"]), name)
    assert a == approx(float(row["a"]), abs=bound)


@mark.parametrize("h", [1.000001, 0.999999])
def test_next_to_the_separatrix_reference_admits_that_it_reached_the_floor(h):
    # One unit in the last place of h moves Θ by 1e-10 here: no double can keep 1e-12.
    assert circle_map(0.5, h, 1e-6, "reference").status is Status.FLOOR
