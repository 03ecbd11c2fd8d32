"""θ⁺ over the square of all (φ, θ⁻)."""

from __future__ import annotations

import math

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure
from hess_mechanics.numerics.results import Array

__all__ = ["ANGLE_TICKS", "POLAR_TICKS", "ScatteringMap"]

ANGLE_TICKS = [(-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π")]
POLAR_TICKS = [(0.0, "0"), (math.pi / 4, "π/4"), (math.pi / 2, "π/2"), (3 * math.pi / 4, "3π/4"), (math.pi, "π")]


class ScatteringMap(Figure):
    """Colours: θ⁺ from 0 to π.  The line is the curve beside; a click picks (φ, θ⁻)."""

    def __init__(self, wire: Wire) -> None:
        super().__init__(wire, "map", ("φ", "θ⁻"), (-math.pi, math.pi), (0.0, math.pi),
                         picks=("tap", "doubletap", "pan"), ticks=ANGLE_TICKS, y_ticks=POLAR_TICKS)
        self.add_image("theta", theme.NUMBER_MAP, 0.0, math.pi)
        self.add("line", "line", ("x", "y"), color="white", line_width=2, line_dash="dashed")
        # A ring that is seen on any colour.
        self.add("here", "scatter", ("x", "y"), size=19, fill_alpha=0, line_color="white", line_width=6)
        self.add("here-too", "scatter", ("x", "y"), size=19, fill_alpha=0, line_color="black", line_width=2.5)
        self.add_point_and_message()

    def show(self, grid: Array) -> None:
        """θ⁺ (rows of equal θ⁻) at the centres of cells that fill the square."""
        self.assign("theta", image=[grid], x=[-math.pi], y=[0.0], dw=[2 * math.pi], dh=[math.pi])

    def choose(self, phi: float, theta_minus: float) -> None:
        """The curve and the orbit on show."""
        self.assign("line", x=[-math.pi, math.pi], y=[theta_minus, theta_minus])
        for layer in ("here", "here-too"):
            self.assign(layer, x=[phi], y=[theta_minus])
