"""Trade of speed against accuracy: cost and error of a computation of the catalogue at each level."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hess_mechanics.catalogue.declared import Computation
from hess_mechanics.dynamics.trade import LevelCost, measure
from hess_mechanics.numerics.accuracy import PLANS, Plan
from hess_mechanics.numerics.labelled import Result

__all__ = ["trade"]


def trade(of: Computation, values: Mapping[str, Any] | None = None, repeats: int = 1) -> tuple[LevelCost, ...]:
    """Return time and error of a computation at each level, measured on this machine.

    The error is `Computation.error`, the distance from a run that is finer than `reference`.

    Parameters
    ----------
    of : Computation
        The computation.
    values : mapping, optional
        Values of its arguments that differ from the defaults.
    repeats : int, default 1
        Number of runs, of which the fastest counts.

    Returns
    -------
    tuple of LevelCost
        A sample for each level; the error is NaN if there is nothing to compare.

    Raises
    ------
    ModelError
        If a run is impossible.

    Examples
    --------
    >>> from hess_mechanics.catalogue import find
    >>> from hess_mechanics.catalogue.trade import trade
    >>> [one.level for one in trade(find("circle-map"))]
    ['draft', 'standard', 'precise', 'reference']
    """

    def run(plan: Plan) -> Result:
        is_named = plan is PLANS[of.kind][plan.level.name]
        return of.compute(values, plan.level.name if is_named else plan.level)

    return tuple(measure(of.kind, run, of.error, repeats))
