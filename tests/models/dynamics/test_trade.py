"""Time and error of a computation at each level."""

import numpy as np
import pytest

from hess_mechanics.dynamics.trade import LevelCost, first_sufficient, measure, truth_plan
from hess_mechanics.numerics.accuracy import LEVELS, PLANS, Kind


def rounded(plan):
    """1/3 with as many digits as the tolerance has."""
    step = plan.level.tolerance
    return round(1.0 / 3.0 / step) * step


def test_the_error_of_each_level_is_that_against_the_truth():
    seen = []

    def run(plan):
        seen.append(plan.level.name)
        return rounded(plan)

    samples = list(measure(Kind.ORBIT, run, lambda result, truth: abs(result - truth)))
    assert seen == ["reference", *LEVELS] and [one.level for one in samples] == list(LEVELS)
    for one in samples:
        assert one.error == pytest.approx(abs(rounded(PLANS[Kind.ORBIT][one.level]) - 1.0 / 3.0), abs=1e-16)
    # Until one is enough: no finer level runs.
    seen.clear()
    assert first_sufficient(measure(Kind.ORBIT, run, lambda result, truth: abs(result - truth)), 1e-7) == "standard"
    assert seen == ["reference", "draft", "standard"]
    # What leaves something out is not complete.
    complete = {one.level: one.complete for one in measure(Kind.SECTION, lambda plan: None, lambda *_: 0.0)}
    assert complete == {"draft": False, "standard": True, "precise": True, "reference": True}


def test_enough_is_the_cheapest_that_shows_all_without_an_error_that_is_seen():
    def of(*errors, complete=True):
        return [
            LevelCost(name, 1.0, error, complete or name != "draft") for name, error in zip(LEVELS, errors, strict=True)
        ]

    assert first_sufficient(of(0.4, 0.1, 0.0, 0.0), 0.5) == "draft"
    assert first_sufficient(of(0.4, 0.1, 0.0, 0.0, complete=False), 0.5) == "standard"
    assert first_sufficient(of(4.0, 1.0, 0.5, 0.0), 0.5) == "precise"
    assert first_sufficient(of(np.nan, 9.0, 9.0, 9.0), 0.5) == "reference"
    # More accuracy cannot be shown to help where there is nothing to compare.
    assert first_sufficient(of(np.nan, np.nan, np.nan, np.nan), 0.5) == "standard"


def test_a_result_at_other_points_has_a_truth_of_its_own():
    truths = []

    def run(plan):
        if plan.level == truth_plan(Kind.MAP).level:
            truths.append(plan.cells)
        return plan.cells

    samples = measure(Kind.MAP, run, lambda result, truth: abs(result - truth), shared_setting="cells")
    assert [one.error for one in samples] == [0.0] * 4
    # Levels with as many points share theirs.
    assert sorted(truths) == sorted({plan.cells for plan in PLANS[Kind.MAP].values()})


@pytest.mark.parametrize("kind", Kind)
def test_the_truth_is_more_exact_than_every_level_and_has_other_points_where_these_matter(kind):
    truth, finest = truth_plan(kind), PLANS[kind]["reference"]
    assert truth.level.tolerance < min(plan.level.tolerance for plan in PLANS[kind].values())
    # A mean over returns and a polyline are not compared with as many of them; points of cells lie aside.
    returns = kind in (Kind.ROTATION, Kind.LINE)
    assert (truth.share, truth.cells) == (1.0 + returns, finest.cells * (1.0 + (kind == Kind.CURVE)))
    assert truth.level.is_perturbed
