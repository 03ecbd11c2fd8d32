"""The (ω1, ω2)-plane: where the motion may be, the orbit, the limit cycles."""

from __future__ import annotations

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, columns_of
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.torus import Track

COLUMNS = ("omega1", "omega2", "g1", "g2", "g3")


def _track_columns(track: Track) -> dict[str, Array]:
    return dict(columns_of(np.hstack([track.omega, track.gamma]), COLUMNS))


class OmegaPlane(Figure):
    """Grey: |ω| that the energy forbids.  The sources `orbit`, `stable`, `unstable` feed the sphere too."""

    def __init__(self, wire: Wire) -> None:
        super().__init__(wire, "omega", ("ω₁", "ω₂"), (-4.0, 4.0), (-4.0, 4.0))
        self.add("forbidden", "multi_polygons", ("xs", "ys"), color=theme.FORBIDDEN, line_color=theme.MUTED)
        self.add("orbit", "line", COLUMNS, source="data-orbit", color=theme.ORBIT, line_width=1.3)
        self.add("stable", "line", COLUMNS, source="data-stable", color=theme.STABLE, line_width=3)
        self.add("unstable", "line", COLUMNS, source="data-unstable", color=theme.UNSTABLE, line_width=3,
                 line_dash="dashed")
        self.add_point_and_message()

    def show_region(self, inner: Array, outer: Array, half_width: float) -> None:
        """The allowed ring between two ellipses; the frame is ± half_width."""
        r = 4.0 * half_width
        frame = np.array([[-r, -r], [r, -r], [r, r], [-r, r]])
        self.assign(
            "forbidden",
            xs=[[[frame[:, 0], outer[:, 0]]], [[inner[:, 0]]]],
            ys=[[[frame[:, 1], outer[:, 1]]], [[inner[:, 1]]]],
        )

    def fit(self, half_width: float) -> None:
        """Axes ± half_width."""
        self.set_ranges((-half_width, half_width), (-half_width, half_width))

    def show_orbit(self, track: Track, **more: Array) -> None:
        """The orbit; further columns travel with it for the player."""
        self.assign("orbit", t=track.times.astype(np.float32), **_track_columns(track), **more)

    def show_cycles(self, pair: tuple[Track, Track] | None) -> None:
        """The stable and the unstable cycle, or neither."""
        if pair is None:
            self.clear("stable", "unstable")
        else:
            self.assign("stable", **_track_columns(pair[0]))
            self.assign("unstable", **_track_columns(pair[1]))
