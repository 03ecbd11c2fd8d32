"""The splitting of the separatrices of the Hess manifold near the Hess case, over ε, computed in pieces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.periodic_search import NotFound
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import axis_about_0
from hess_explorer.views.layers import Axes, compose, curves, levels, points, ring
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, with_error
from hess_mechanics.errors import ModelError
from hess_mechanics.euler_poisson.hess_split import HessTorus, Split, slope_of, split_at
from hess_mechanics.numerics.accuracy import PRECISE
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array

_QUARTERS = np.arange(-4, 5) / 4.0
_WIDE = 0.02
"""Half-width of the graph if ε = 0."""
_CLOSE = (1e-3, -1e-3, 2e-3, -2e-3)
"""Values of ε for the slope at ε = 0."""


@dataclass(frozen=True, eq=False)
class HessSplit(Part[Host]):
    """The splitting of the separatrices of the Hess manifold near the Hess case.

    Attributes
    ----------
    torus : HessTorus
        The torus in the Hess case.
    away : float
        ε in radians, the angle by which r is rotated off the Hess condition in the current state.
    """

    torus: HessTorus
    away: float

    @property
    def reach(self) -> float:
        """The half-width of the graph: |ε|, or 0.02 if ε = 0."""
        return abs(self.away) or _WIDE

    @cached_property
    def _splits(self) -> dict[float, Split | NotFound] | None:
        """The splits, or the reasons why they are missing, by ε; None until all are known.

        Without separatrices at ε = 0 there is only the reason at 0.
        """
        # Without separatrices at ε = 0 there is nothing to split.
        first = self.work.need(Task(_split, self.torus, 0.0), preview=None)
        if not isinstance(first, Split):
            return None if first is None else {0.0: first}
        asked = sorted({*(self.reach * _QUARTERS).tolist(), *_CLOSE})
        found = {value: self.work.need(Task(_split, self.torus, value), preview=None) for value in asked}
        known = {value: one for value, one in found.items() if one is not None}
        return known if len(known) == len(found) else None

    def _split_at(self, value: float) -> Split | None:
        found = (self._splits or {}).get(value)
        return found if isinstance(found, Split) else None

    @property
    def splits(self) -> list[Split]:
        """The splits within the graph, sorted by ε; empty until all are known."""
        return [one for value in self._splits or () if abs(value) <= self.reach and (one := self._split_at(value))]

    @property
    def split(self) -> Split | None:
        """The split of the current state; None until all splits are known, and if it is missing."""
        return self._split_at(self.away)

    @property
    def slope(self) -> tuple[float, float] | None:
        """The slope of the split at ε = 0 and its error; None until known, and if a split near ε = 0 is missing."""
        close = [one for value in _CLOSE if (one := self._split_at(value))]
        return slope_of(close) if len(close) == len(_CLOSE) else None

    @property
    def _reasons(self) -> list[str]:
        """The reasons why splits are missing."""
        return sorted({one.reason for one in (self._splits or {}).values() if isinstance(one, NotFound)})

    def caption(self) -> Caption:
        """Return the caption: whether the separatrices are split at the current ε, and by how much."""
        if self._splits is None:
            return Caption(self.work.pending_caption())
        if self.split is None:
            return Caption("No separatrices found here.")
        value, error = self.split.value, self.split.error
        slope = "" if self.slope is None else f"; as ε → 0: {digits(self.slope[0], 4)} ε"
        where = f"at l = {digits(self.split.l)}{slope}."
        if self.away and abs(value) <= error:
            return Caption("No separatrix splitting is visible.", f"Less than {digits(error, 1)} {where}")
        if abs(value) <= error:
            return Caption("The separatrices are not split.", f"Less than {digits(error, 1)} {where}")
        return Caption("The separatrices are split.", f"By {digits(value)} ± {digits(error, 1)} {where}")

    @property
    def message(self) -> str:
        """The reason why the graph is empty; an empty string if it is not, or until the splits are known."""
        return "" if self.splits else next(iter(self._reasons), "")

    def quantities(self) -> Iterator[str]:
        """Yield the slope of the split at ε = 0."""
        if self.has_result("_splits") and self.slope is not None:
            yield f"split/ε → {with_error(*self.slope)}"

    def notes(self) -> Iterator[str]:
        """Yield the reasons for missing splits in the graph."""
        if self.has_result("_splits") and self.splits:
            yield from (f"Some splits are not known. {reason}" for reason in self._reasons)


def _split(torus: HessTorus, away: float) -> Split | NotFound:
    try:
        return split_at(torus, away, PRECISE)
    except ModelError as error:
        check_limit()
        return NotFound(str(error))


def _values(splits: HessSplit) -> Array | None:
    return np.array([(one.away, one.value) for one in splits.splits]).T if splits.splits else None


def _line(splits: HessSplit, axes: Axes) -> list[Array]:
    return [] if splits.slope is None else [np.array([[x, splits.slope[0] * x] for x in axes.x])]


split_picture = Plot[HessSplit](
    name="split",
    title="Separatrix splitting",
    caption=HessSplit.caption,
    button="Show the separatrix splitting",
    axes=("ε", "separatrix splitting in L/G"),
    first=Axes((-_WIDE, _WIDE), (-1.0, 1.0)),
    message=lambda s: s.message,
    on_click=lambda s, x, y: {"away": x},
    x=lambda s: (-1.1 * s.reach, 1.1 * s.reach),
    y=compose(_values, lambda found: axis_about_0(found[1], 1e-12)),
    layers=(
        levels("levels", lambda s: [0.0] if s.splits else []),
        curves("slope", data_in_axes=_line, color=theme.MUTED, dash="dashed", label="linear, with the slope at ε = 0"),
        points(
            "splits",
            _values,
            color=theme.UNSTABLE,
            size=10,
            label="distance between the separatrices",
        ),
        ring("here", lambda s: [(s.split.away, s.split.value)] if s.split else [], color=theme.INK),
    ),
).of
"""The picture of the split over ε."""
