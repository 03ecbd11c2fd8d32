"""The Poisson sphere: the vertical γ as seen from the body."""

from __future__ import annotations

from collections.abc import Sequence

from app.components import Sphere


class PoissonSphere:
    """Draws the tracks that the (ω1, ω2)-plane holds in its sources `orbit`, `stable`, `unstable`."""

    def __init__(self) -> None:
        self.root = Sphere(sizing_mode="stretch_width", css_classes=["picture-sphere"])

    def look_from(self, azimuth: float, elevation: float) -> None:
        """The direction of sight, in radians."""
        self.root.param.update(azimuth=azimuth, elevation=elevation)

    def show_axis(self, axis: Sequence[float], heights: Sequence[float]) -> None:
        """The axis to the centre of mass, and the parallels between which the motion stays."""
        axis, heights = [float(x) for x in axis], [float(x) for x in heights]
        if (self.root.axis, self.root.heights) != (axis, heights):
            self.root.param.update(axis=axis, heights=heights)
