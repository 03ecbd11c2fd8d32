"""Effect of the accuracy levels on each kind of computation."""

import pytest

from hess_mechanics.numerics.accuracy import LEVELS, PLANS, Kind, cheapest, plan


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_has_a_plan_for_every_level_under_its_name(kind):
    assert list(PLANS[kind]) == list(LEVELS)
    for name, found in PLANS[kind].items():
        assert found.level.name == name
        assert plan(kind, name) is found
        # A request for 200 crossings returns 200; only `draft` computes fewer.
        assert name == "draft" or found.share == 1.0
        # No tolerance of a section loses crossings.
        assert kind not in (Kind.SECTION, Kind.ROTATION, Kind.BASINS) or found.level.tolerance <= 1e-6


# The promises of the levels as the README states them.
@pytest.mark.parametrize(
    ("error", "name"),
    [
        (1.0, "draft"),
        (1e-3, "draft"),
        (0.9e-3, "standard"),
        (1e-6, "standard"),
        (0.9e-6, "precise"),
        (1e-9, "precise"),
        (0.9e-9, "reference"),
        (1e-15, "reference"),
    ],
)
def test_the_cheapest_level_is_the_first_that_promises_an_error(error, name):
    assert cheapest(error).name == name


@pytest.mark.parametrize("name", [*LEVELS])
def test_no_run_is_measured_by_one_that_takes_the_same_steps(name):
    """Each comparison run, down to the floor, has another order or at most a third of the tolerance."""
    rung = LEVELS[name]
    for _ in range(12):
        finer = rung.tighter()
        assert finer.order != rung.order or finer.tolerance < rung.tolerance / 3.0
        if rung.is_floor:
            return
        rung = finer
    raise AssertionError("the floor is not reached")
