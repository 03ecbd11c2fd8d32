"""Clouds of phase points on the (ω1, ω2)-plane and the sphere, drawn by "cloud.js", and their density."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import time_graph
from hess_explorer.views.layers import Axes, Layer, Layers, Sign, Sources, column, levels, line, points
from hess_explorer.views.picture import Picture
from hess_explorer.views.plane.velocity_plane import round_up, symmetric_range
from hess_explorer.views.text import digits, range_text
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.phase_cloud_density import BIN, SMALLEST, Clouds, Density
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.numerics.results import Array

S = TypeVar("S")

_ANGLES = np.linspace(0.0, 2.0 * math.pi, 97)


def _frames(columns: Sequence[Array]) -> np.ndarray:
    """Return columns (n, m) as one block [frame][column][point] in single precision."""
    # Single precision halves the memory of millions of numbers.
    return np.stack([one.T for one in columns], axis=1).astype(np.float32).ravel()


def half_width(clouds: Clouds) -> float:
    """Return the half width of a plane with room for all ω of the clouds."""
    return round_up(1.1 * clouds.largest_speed)


def ends_caption(clouds: Clouds) -> Caption:
    """Return the caption: the number of points, and their median |s| at the start and at the end."""
    before, after = (digits(math.exp(float(np.median(clouds.cloud.log_s[:, i]))), 3) for i in (0, -1))
    return Caption(
        numbers=f"{clouds.cloud.signs.size} points: half start with |s| < {before}, half end with |s| < {after}."
    )


def status_of(clouds: Clouds) -> Iterator[str]:
    """Yield the size, cost and errors of the clouds for the status line."""
    cloud, other = clouds.cloud, clouds.other
    yield (
        f"{cloud.level}: {cloud.signs.size} points, {cloud.times.size} frames, {cloud.cost.steps} Taylor steps, "
        f"error of ω/ν, γ and ln|s| ≤ {cloud.error_estimate:.1e} ({cloud.status})"
    )
    if other is not None:
        yield f"error of the second cloud ≤ {other.errors.max():.1e}"


def history_caption(clouds: Clouds, of_patch: bool) -> Caption:
    """Return the caption: change of the volume of the patch (`of_patch`), or mean of div v and of ln s(t)/s(0)."""
    course = clouds.history
    if of_patch:
        text = f"The patch keeps {digits(course.volume[-1], 3)} of its volume"
    else:
        text = (
            f"Mean of div v {range_text(course.divergence[0, 0], course.divergence[0, -1], 3)}; "
            f"mean of ln s(t)/s(0) at the end {digits(course.log_growth[0, -1], 3)}"
        )
    return Caption(numbers=f"{text}; the second cloud preserves volume." if clouds.other is not None else f"{text}.")


def largest_distance(clouds: Clouds, exact: Clouds) -> float:
    """Return the largest distance in pixels, in the plane or on the sphere, from the same point of `exact`."""
    to_pixels = 0.5 * PIXELS * np.array([1.0 / half_width(exact)] * 2 + [1.0] * 3)
    away = to_pixels * (_points(clouds) - _points(exact))
    return max(float(np.linalg.norm(part, axis=-1).max()) for part in (away[..., :2], away[..., 2:]))


def _points(clouds: Clouds) -> Array:
    """Return ω1, ω2 and γ (n, m, 5) of the points of all clouds in all frames."""
    states = np.concatenate([clouds.cloud.omega, clouds.cloud.gamma], axis=-1)
    return states if clouds.other is None else np.concatenate([states, clouds.other.states])


@dataclass(frozen=True, kw_only=True)
class CloudPlane(Picture[S]):
    """The (ω1, ω2)-plane with clouds; its data source is shared with a sphere that shows the same clouds.

    Attributes
    ----------
    clouds : callable
        `clouds(state)` returns the moving clouds.
    half_width : callable
        `half_width(state)` returns half the length of both axes.
    strip : callable
        `strip(state)` returns the strip between σ1 and σ2 at the energy h, with the line of equilibria.
    b3 : callable
        `b3(state)` returns the field of the second cloud, which has I13 = I23 = 0.
    density : str
        Data source of the density over |s| at the time of the player, which the browser computes.
    """

    clouds: Callable[[S], Clouds]
    strip: Callable[[S], Strip]
    half_width: Callable[[S], float]
    b3: Callable[[S], float]
    density: str

    kind: ClassVar[str] = "cloud"

    @property
    def first_axes(self) -> Axes:
        """The axes before the first state."""
        return Axes(symmetric_range(1.0), symmetric_range(1.0))

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        return (
            Sign("stable half, s = 0", "line", f"border-top: 3px solid {theme.STABLE}"),
            Sign("unstable half, s = 0", "line", f"border-top: 3px dashed {theme.UNSTABLE}"),
            *self.signs,
        )

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture for the browser."""
        return {**super().describe(), "density": self.density}

    def ranges(self, state: S, held: Axes | None) -> Axes:
        """Return the axes that fit a state; `held` is not used."""
        axis = symmetric_range(self.half_width(state))
        return Axes(axis, axis)

    def data(self, state: S) -> Sources:
        """Return the frames of the clouds, and the ends of the halves of the line of equilibria on σ1 and σ2."""
        found, strip = self.clouds(state), self.strip(state)
        cloud, body, log_s = found.cloud, strip.body, found.density.log_s
        count = 2 if body.D else 1
        marks = [
            [look, *map(float, point)]
            for look, ends in (("stable", strip.stable), ("unstable", strip.unstable))
            for point in ends[:count]
        ]
        second = {} if found.other is None else {"frames1": _frames(list(np.moveaxis(found.other.states, -1, 0)))}
        return {
            self.name: {
                "times": column(np.abs(cloud.times)),
                "sense": -1 if cloud.times[-1] < 0.0 else 1,
                "frames0": _frames([cloud.along, cloud.log_s, *np.moveaxis(cloud.gamma, -1, 0)]),
                "signs0": column(cloud.signs),
                "body": [body.I11, body.I22, body.I13, body.I23, body.D, self.b3(state)],
                "points": marks,
                "bins": [float(log_s[0]) - 0.5 * BIN, BIN, log_s.size],
                **second,
            }
        }

    def data_in_axes(self, state: S, axes: Axes | None, drawn: Sources) -> Sources:
        """Return σ1, σ2 and the line of equilibria, extended beyond the frame."""
        assert axes is not None
        strip, half = self.strip(state), axes.x[1]
        xi, _ = line_of_rest(strip.body)
        far = 3.0 * half * xi
        edges = [strip.sigma1(_ANGLES)] + ([strip.sigma2(_ANGLES)] if strip.body.D else [])
        return {
            self.name: {
                "half": half,
                "curves": [
                    *(["muted", *column(edge.T)] for edge in edges),
                    ["stable", [0.0, -far[0]], [0.0, -far[1]]],
                    ["unstable", [0.0, far[0]], [0.0, far[1]]],
                ],
            }
        }


def density_axes(clouds: Clouds) -> Axes:
    """Return logarithmic axes for the density over |s|, without the smallest 2 % of |s| at the end.

    The vertical axis extends 1.5 decades below and above the curve c/|s|.
    """
    lowest = max(SMALLEST, float(np.quantile(clouds.cloud.log_s[:, -1], 0.02)))
    low = math.floor(lowest / math.log(10.0))
    high = max(math.ceil(float(clouds.density.log_s[-1]) / math.log(10.0)), low + 1)
    middle = math.log10(clouds.density.height)
    return Axes((10.0**low, 10.0**high), (10.0 ** (middle - high - 1.5), 10.0 ** (middle - low + 1.5)))


def _inside(s: Array, share: Array, axes: Axes) -> tuple[Array, Array]:
    """Convert the share of points per unit of ln|s| to that per unit of |s|, within the frame."""
    y = np.divide(share, s)
    (x0, x1), (y0, y1) = axes.x, axes.y
    seen = (s >= x0) & (s <= x1) & (y >= y0) & (y <= y1)
    return s[seen], y[seen]


def density_layers(density: Callable[[S], Density]) -> Layers[S]:
    """Return the layers of the density over |s|: at the start, at the end, at the time of the player, and the mean.

    A dotted line shows c/|s|.  The browser fills "now", the density at the time of the player.
    """

    def limit(state: S, axes: Axes) -> tuple[Array, Array]:
        ends = np.array(axes.x)
        return ends, density(state).height / ends

    def of(share: Callable[[Density], Array]) -> Callable[[S, Axes], tuple[Array, Array]]:
        return lambda s, axes: _inside(np.exp(density(s).log_s), share(density(s)), axes)

    now: Layer[S] = points("now", color=theme.POINT, edge=theme.INK, size=7, label="at the current time")
    return (
        line("limit", data_in_axes=limit, color=theme.MUTED, width=3, dash="dotted", label="c/|s|", tag="c/|s|"),
        line(
            "first",
            data_in_axes=of(lambda one: one.first),
            color=theme.MUTED,
            width=1,
            dash="dashed",
            label="start",
            tag="start",
        ),
        line(
            "last", data_in_axes=of(lambda one: one.last), color=theme.MUTED, width=1, label="end; energy h", tag="end"
        ),
        line("mean", data_in_axes=of(lambda one: one.mean), color=theme.ORBIT, label="cloud and its mean", tag="mean"),
        now,
    )


def history_layers(
    times: Callable[[S], Array], history: Callable[[S], Array], beside: Callable[[S], bool]
) -> Layers[S]:
    """Return the layers of a quantity of the cloud over time; the track "orbit" contains the mean.

    Parameters
    ----------
    times : callable
        `times(state)` returns the times (m,).
    history : callable
        `history(state)` returns mean, minimum and maximum (3, m) over the cloud.
    beside : callable
        `beside(state)` returns whether there is a second cloud, of a body with e on a principal axis; its values are 0.
    """

    def extreme(name: str, i: int) -> Layer[S]:
        return time_graph(name, lambda s: (times(s), history(s)[i]), color=theme.MUTED, dash="dashed")

    return (
        levels("levels", lambda s: [0.0]),
        extreme("least", 1),
        extreme("largest", 2),
        line(
            "beside",
            lambda s: ((0.0, times(s)[-1]), (0.0, 0.0)) if beside(s) else None,
            color=theme.MAP,
            dash="dotdash",
            label="cloud of a body with e on a principal axis",
        ),
        line("mean", track="orbit", columns=("t", "mean"), color=theme.ORBIT),
    )
