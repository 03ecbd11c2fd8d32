"""The (q1, q2)-plane of a point under a potential: where it may be, equipotentials, its orbit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Columns, Layer, curves, f32, line, region, ring
from hess_explorer.views.velocity_plane import square
from hess_mechanics.numerics.results import Array

__all__ = ["ground", "orbit", "plane_columns"]

S = TypeVar("S")


def plane_columns(times: Array, q: Array, gamma: Array, **more: Array) -> Columns:
    """The columns of a motion for this plane and the sphere: q (m, 2), γ (m, 3), and further ones for the player."""
    return {"t": f32(times), "q1": f32(q[:, 0]), "q2": f32(q[:, 1]),
            **{f"g{i + 1}": f32(gamma[:, i]) for i in range(3)}, **{name: f32(one) for name, one in more.items()}}


def ground(edge: Callable[[S], Array], forbidden: Callable[[S], Sequence[Array]],
           levels: Callable[[S], Sequence[Array]]) -> tuple[Layer[S], Layer[S]]:
    """What lies under the orbit: grey outside the edge (n, 2) and inside closed curves; equipotentials."""

    def grey(state: S, axes: Axes) -> list[list[Array]]:
        outer = edge(state)
        # Axes that are held may be smaller than the domain, or larger.
        frame = square(2.0 * max(axes.x[1], float(abs(outer).max())))
        return [[frame, outer], *([part] for part in forbidden(state))]

    return (region("forbidden", within=grey, label="impossible"),
            curves("levels", levels, color=theme.MUTED, width=1, label="equipotentials"))


def orbit(start: Callable[[S], tuple[float, float]]) -> tuple[Layer[S], Layer[S]]:
    """The track of the orbit, and a ring where it starts."""
    return (line("orbit", track="orbit", columns=("q1", "q2"), color=theme.ORBIT, label="orbit"),
            ring("start", lambda s: [start(s)]))
