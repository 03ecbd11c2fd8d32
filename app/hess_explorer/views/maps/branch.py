"""Branches of periodic orbits over a parameter, by stability, with their bifurcations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layers, curves, names, points
from hess_explorer.views.plane.periodic import sign_of, visible_parts, visible_points
from hess_mechanics.dynamics.continuation import Bifurcation, Branch
from hess_mechanics.numerics.results import Array

S = TypeVar("S")
_SHORT = {"Neimark–Sacker": "N–S"}
_LOOKS = (
    ("attracts", theme.STABLE, "solid", "branch of a stable periodic orbit", "stable"),
    ("neither", theme.SHEET, "solid", "branch of an elliptic or parabolic orbit", "elliptic"),
    ("repels", theme.UNSTABLE, "dashed", "branch of an unstable orbit", "unstable"),
)
"""Sign of `sign_of`, colour, dash, label and tag of each layer."""


def _strands(branch: Branch, side: int, sign: str) -> list[Array]:
    """Return the parts (n, 2) of a branch with one sign of `sign_of`: the parameter and one coordinate of each point.

    At a change of sign the parts reach to the bifurcation.
    """
    signs = [sign_of(kind) for kind in branch.kinds]
    runs: list[list[tuple[float, float]]] = []
    for j in range(branch.period):
        run: list[tuple[float, float]] = []
        for i, (value, orbit) in enumerate(zip(branch.values, branch.points, strict=True)):
            between = sorted(
                (one for one in branch.bifurcations if one.index == i - 1),
                key=lambda one: float(np.abs(one.points - branch.points[max(0, i - 1)]).max()),
            )
            for one in between:
                met = (one.value, float(one.points[j, side]))
                runs.append([*run, met] if run else [])
                run = [met] if signs[i] == sign else []
            # A point with the sign "neither" belongs to the previous part, unless a bifurcation lies between them.
            if signs[i] == sign or (run and signs[i] == "neither"):
                run.append((float(value), float(orbit[j, side])))
            else:
                runs.append(run)
                run = []
        runs.append(run)
    return [np.array(run) for run in runs if len(run) > 1]


class HasBranches(Protocol):
    """Branches over a parameter."""

    @property
    def branches(self) -> Sequence[Branch]:
        """The branches."""

    @property
    def side(self) -> int:
        """Index of the coordinate on the vertical axis."""

    @property
    def turn(self) -> float:
        """Period of the coordinate on the vertical axis; ∞ if it is not an angle."""


def layers(of: Callable[[S], HasBranches]) -> Layers[S]:
    """Return the layers of branches over a parameter: one coordinate of all points, and the bifurcations.

    `of(state)` returns the branches.
    """

    def parts(sign: str) -> Callable[[S, Axes], list[Array]]:
        def drawn(state: S, axes: Axes) -> list[Array]:
            shown, up = of(state), Axes(axes.y, axes.x)
            return [
                part[:, ::-1]
                for one in shown.branches
                for strand in _strands(one, shown.side, sign)
                for part in visible_parts(strand[:, ::-1], shown.turn, up)
            ]

        return drawn

    def marked(state: S, axes: Axes) -> list[tuple[float, float, str]]:
        shown, up, found = of(state), Axes(axes.y, axes.x), []
        for one in bifurcations(shown.branches):
            y = one.points[:, shown.side]
            there = visible_points(np.column_stack([y, np.full(len(y), one.value)]), shown.turn, up)
            inside = [(float(x), float(height)) for height, x in there if axes.x[0] <= x <= axes.x[1]]
            # Label only the highest point, because labels at all points would overlap.
            found += [
                (x, y, _SHORT.get(one.kind, one.kind) if y == max(inside, key=lambda at: at[1])[1] else "")
                for x, y in inside
            ]
        return found

    def marks(state: S, axes: Axes) -> Array | None:
        found = [(x, y) for x, y, _ in marked(state, axes)]
        return np.array(found).T if found else None

    return (
        *(
            curves(f"branch-{sign}", data_in_axes=parts(sign), color=color, width=3.0, dash=dash, label=label, tag=tag)
            for sign, color, dash, label, tag in _LOOKS
        ),
        points(
            "bifurcations",
            data_in_axes=marks,
            size=10,
            color=theme.LOCKED,
            edge=theme.INK,
            edge_width=1.5,
            label="bifurcation",
        ),
        names("bifurcation-names", data_in_axes=marked, size=13, above=7),
    )


def bifurcations(branches: Sequence[Branch]) -> list[Bifurcation]:
    """Return all bifurcations, sorted by the parameter; those of one kind that agree within their errors count once."""
    found: list[Bifurcation] = []
    for one in (one for branch in branches for one in branch.bifurcations):
        if not any(
            one.kind == known.kind and abs(one.value - known.value) <= one.error + known.error for known in found
        ):
            found.append(one)
    return sorted(found, key=lambda one: one.value)
