"""Clouds of phase points on the (ω1, ω2)-plane and the sphere, drawn by "cloud.js", and their density."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure
from hess_explorer.views.poisson_sphere import PoissonSphere
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
from hess_mechanics.numerics.results import Array

__all__ = ["CloudPlane", "CloudSphere", "DensityPlot"]

_ANGLES = np.linspace(0.0, 2.0 * math.pi, 97)


def _frames(columns: Sequence[Array]) -> Array:
    """Columns (n, m) as one block of numbers [frame][column][point] in single precision."""
    block = np.empty((columns[0].shape[1], len(columns), columns[0].shape[0]), np.float32)
    for i, column in enumerate(columns):
        block[:, i] = column.T
    return block.ravel()


class CloudPlane:
    """The (ω1, ω2)-plane; its source holds the frames of all clouds, for the sphere too.

    density : the source into which the browser puts the density over |s| at the moving time.
    """

    kind = "cloud"

    def __init__(self, wire: Wire, name: str, density: str) -> None:
        self.wire = wire
        self.name = name
        self._density = density
        self._half = 1.0

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        return {"name": self.name, "kind": self.kind, "density": self._density}

    def fit(self, half: float) -> None:
        """Axes ± half, from the next clouds on."""
        self._half = half

    def show(self, cloud: Cloud, h: float, bins: tuple[float, float, int], other: Array | None, b3: float) -> None:
        """A cloud; σ1, σ2 and the line of equilibria at the energy h; a second cloud, states (n, m, 5).

        bins : first edge, width and number of those of ln|s|, for the density at the moving time.
        b3 : the field in which the second cloud moves, with I13 = I23 = 0.
        """
        body = cloud.body
        strip = Strip(body, h)
        xi, _ = line_of_rest(body)
        far = 3.0 * self._half * xi
        edges = [strip.sigma1(_ANGLES)] + ([strip.sigma2(_ANGLES)] if body.D else [])
        curves = [["muted", *edge.T.astype(np.float32)] for edge in edges]
        curves += [["stable", [0.0, -far[0]], [0.0, -far[1]]], ["unstable", [0.0, far[0]], [0.0, far[1]]]]
        ends = 2 if body.D else 1
        points = [["stable", *map(float, point)] for point in strip.stable[:ends]]
        points += [["unstable", *map(float, point)] for point in strip.unstable[:ends]]
        second = {} if other is None else {"frames1": _frames(list(np.moveaxis(other, -1, 0)))}
        self.wire.put(self.name, {
            "times": np.abs(cloud.times).astype(np.float32), "sense": -1 if cloud.times[-1] < 0.0 else 1,
            "frames0": _frames([cloud.along, cloud.log_s, *np.moveaxis(cloud.gamma, -1, 0)]),
            "signs0": cloud.signs.astype(np.float32), "body": [body.I11, body.I22, body.I13, body.I23, body.D, b3],
            "half": self._half, "curves": curves, "points": points, "bins": list(bins), **second})

    def show_nothing(self, sentence: str) -> None:
        """The axes alone; the reason is for the caption to say."""
        self.wire.put(self.name, {})


class CloudSphere(PoissonSphere):
    """The Poisson sphere with the clouds of another picture's source."""

    def __init__(self, wire: Wire, clouds: str) -> None:
        super().__init__(wire, {})
        self._clouds = clouds

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        return {**super().describe(), "clouds": self._clouds}


class DensityPlot(Figure):
    """The density of a cloud over |s| on logarithmic axes, at the start, the end, the moving time, and its mean."""

    def __init__(self, wire: Wire, name: str) -> None:
        super().__init__(wire, name, ("|s| = |I₁₃ω₁ + I₂₃ω₂|", "share of points per |s|"), (1e-6, 10.0), (1e-3, 1e5),
                         log="xy", y_tick_count=5)
        self.add("limit", "line", ("x", "y"), color=theme.MUTED, line_dash="dotted", line_width=3)
        for layer, dash in (("first", "dashed"), ("last", "solid")):
            self.add(layer, "line", ("x", "y"), color=theme.MUTED, line_dash=dash, line_width=1)
        self.add("mean", "line", ("x", "y"), color=theme.ORBIT, line_width=2)
        self.add("now", "scatter", ("x", "y"), color=theme.POINT, line_color="black", line_width=1, size=7)
        self.add_point_and_message()

    def fit(self, s: tuple[float, float], height: float) -> None:
        """Axes from whole powers of ten about |s| = s[0] … s[1]; the curve `height`/|s| leaves by the corners."""
        low, high = (round_to(value) for value, round_to in ((math.log10(s[0]), math.floor),
                                                             (math.log10(s[1]), math.ceil)))
        high = max(high, low + 1)
        middle = math.log10(height)
        self.set_ranges((10.0**low, 10.0**high), (10.0 ** (middle - high - 1.5), 10.0 ** (middle - low + 1.5)))

    def show(self, name: str, s: Array, share: Array) -> None:
        """The curve "first", "last" or "mean": `share` of the points per unit of ln|s| at the places `s`."""
        y = np.divide(share, s)
        (x0, x1), (y0, y1) = self.x_range, self.y_range
        seen = (s >= x0) & (s <= x1) & (y >= y0) & (y <= y1)
        self.assign(name, x=s[seen].astype(np.float32), y=y[seen].astype(np.float32))

    def show_limit(self, height: float) -> None:
        """The line height/|s|."""
        ends = np.array(self.x_range)
        self.assign("limit", x=ends.astype(np.float32), y=(height / ends).astype(np.float32))
