"""The (ω1, ω2)-plane: columns of a motion, forbidden regions, line of equilibria, arrows, round axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import (
    Axes,
    Columns,
    Layer,
    Layers,
    Range,
    Regions,
    arrows,
    column,
    curves,
    line,
    points,
    rectangle,
    region,
)
from hess_explorer.views.picture import Values
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import gamma_columns
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.numerics.results import Array, Orbit

S = TypeVar("S")


def velocity_columns(times: Array | None, omega: Array, gamma: Array, **more: Array) -> Columns:
    """Return the columns omega1, omega2, g1, g2 and g3 of ω (m, 2) and γ (m, 3), with `more` columns.

    With times (m,) there is also a column t.
    """
    moving = {} if times is None else {"t": column(times)}
    return {
        **moving,
        "omega1": column(omega[:, 0]),
        "omega2": column(omega[:, 1]),
        **gamma_columns(gamma),
        **{name: column(one) for name, one in more.items()},
    }


def orbit_columns(orbit: Orbit, **more: Array) -> Columns:
    """Return the `velocity_columns` of an orbit with states (ω1, ω2, γ1, γ2, γ3)."""
    return velocity_columns(orbit.times, orbit.states[:, :2], orbit.states[:, 2:], **more)


def pixels_per_unit(half_width: float) -> tuple[float, ...]:
    """Return pixels per unit of ω1, ω2, γ1, γ2, γ3; the plane shows |ω| ≤ half_width, the sphere |γ| ≤ 1."""
    radius = 0.5 * PIXELS
    w = radius / half_width
    return w, w, radius, radius, radius


def picture(
    caption: Callable[[S], Caption],
    half_width: Callable[[S], float],
    layers: Layers[S],
    title: str = "Angular velocity (ω₁, ω₂)",
    on_click: Callable[[S, float, float], Values] | None = None,
) -> Plot[S]:
    """Return the plot of the plane, with a point moving along the orbit.

    Parameters
    ----------
    caption : callable
        `caption(state)` returns the caption.
    half_width : callable
        `half_width(state)` returns half the length of both axes.
    layers : sequence of Layer
        Layers from the back to the front.
    title : str
        Heading.
    on_click : callable, optional
        `on_click(state, x, y)` returns the parameter values of another start.
    """
    return Plot(
        name="omega",
        title=title,
        caption=caption,
        axes=("ω₁", "ω₂"),
        x=axis_about_origin(half_width),
        y=axis_about_origin(half_width),
        dot=("omega1", "omega2"),
        on_click=on_click,
        starts=on_click is not None,
        layers=layers,
    )


def orbit(label: str) -> Layer[S]:
    """Return the layer of the orbit, a bold line along the track "orbit"."""
    return line(
        "orbit", track="orbit", columns=("omega1", "omega2"), color=theme.ORBIT, width=2.5, label=label, tag="orbit"
    )


def chosen_orbit(states: Callable[[S], Array], colour: Callable[[S], int]) -> Layers[S]:
    """Return the layers of the orbit `states(state)` (n, 2), one for each colour of `theme.CHOSEN`.

    Only the layer with the index `colour(state)` draws it.
    """

    def of(i: int, color: str) -> Layer[S]:
        return line(
            f"orbit{i or ''}", lambda s: states(s).T if colour(s) == i else None, color=color, width=2.5, tag="orbit"
        )

    return tuple(of(i, color) for i, color in enumerate(theme.CHOSEN))


def band(data: Callable[[S], Regions]) -> Layer[S]:
    """Return the layer of the regions `data(state)` that enclose the true orbit where its error is visible."""
    return region("band", data, color=theme.SHEET, label="proved enclosure of the orbit", is_overlay=True)


def orbit_alone(
    half_width: Callable[[S], float],
    energy: Callable[[S], float],
    proved: Callable[[S], Regions],
    orbits: Layers[S],
) -> Plot[S]:
    """Return the plot of the orbit and the proved band, with the energy in the caption."""
    return picture(
        lambda s: Caption("The chosen orbit.", f"E = {digits(energy(s))}."), half_width, (band(proved), *orbits)
    )


def round_up(value: float) -> float:
    """Round up to 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(step for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * (1 - 1e-12)))


def half_width_for(speed: float) -> float:
    """Return the half width of a plane with room for |ω| = `speed`, a round number."""
    return round_up(1.05 * max(1e-9, speed))


def symmetric_range(half_width: float) -> Range:
    """Return the range ±half_width."""
    return -half_width, half_width


def axis_about_origin(half_width: Callable[[S], float]) -> Callable[[S], Range]:
    """Return the range of an axis about 0 as a function of the state."""
    return lambda state: symmetric_range(half_width(state))


def square(half_width: float) -> Array:
    """Return a square (4, 2) about 0."""
    return rectangle(symmetric_range(half_width), symmetric_range(half_width))


def exterior(curve: Array, half_width: float) -> list[Array]:
    """Return the exterior of a closed curve (m, 2) within the square ±half_width, as a part of a region."""
    return [square(half_width), curve]


def ring_complement(inner: Array, outer: Array, half_width: float) -> Regions:
    """Return the complement of the ring between two closed curves (m, 2), out to four half widths, as a region."""
    return [exterior(outer, 4.0 * half_width), [inner]]


def label_points(inner: Array, outer: Array, half_width: float) -> Array:
    """Return points (2, 2) for two labels, given a point (2,) of an inner and one of an outer curve around 0.

    The first is just inside the inner curve, the second just outside the outer curve.
    """
    gap = 0.09 * half_width
    lengths = np.linalg.norm([inner, outer], axis=1)
    return np.array([inner * (1.0 - min(1.0, gap / lengths[0])), outer * (1.0 + gap / lengths[1])])


def half_lines(
    stable: Callable[[S, Axes], Array], unstable: Callable[[S, Axes], Array], labels: tuple[str, str]
) -> Layers[S]:
    """Return the layers of the stable and the unstable half of the line of equilibria.

    Parameters
    ----------
    stable, unstable : callable
        Functions of the state and the axes that return the two ends of a half, (2, 2).
    labels : tuple of str
        Legend entries.  The part before the comma is the label in the picture.
    """
    tags = [label.split(",")[0] for label in labels]
    return (
        line(
            "stable",
            data_in_axes=lambda s, axes: stable(s, axes).T,
            color=theme.STABLE,
            width=3,
            label=labels[0],
            tag=tags[0],
        ),
        line(
            "unstable",
            data_in_axes=lambda s, axes: unstable(s, axes).T,
            color=theme.UNSTABLE,
            width=3,
            dash="dashed",
            label=labels[1],
            tag=tags[1],
        ),
    )


def half_line(point: Array, half_width: float, axes: Axes) -> Array:
    """Return the ends (2, 2) of the half line from 0 through a point (2,) to beyond the frame."""
    far = max(half_width, axes.x[1]) / max(float(np.max(np.abs(point))), 1e-300)
    return np.array([np.zeros(2), far * np.asarray(point)])


def equilibria(stable: Callable[[S], Array], unstable: Callable[[S], Array]) -> Layers[S]:
    """Return the layers of a stable equilibrium, filled, and of an unstable one, hollow; both functions return (2,)."""
    return (
        points("stable-point", lambda s: stable(s)[:, None], color=theme.STABLE, size=11, edge_width=3),
        points(
            "unstable-point", lambda s: unstable(s)[:, None], color=theme.UNSTABLE, size=11, edge_width=3, hollow=True
        ),
    )


def energy_levels(data: Callable[[S], Sequence[Array]], half_width: Callable[[S], float], label: str) -> Layers[S]:
    """Return the layers of the curves `data(state)`, each (m, 2), at other energies, with arrows in their direction."""
    return (
        curves("levels", data, color=theme.MUTED, width=1, label=label),
        arrows("level-arrows", lambda s: arrows_on(data(s), half_width(s)), color=theme.MUTED, size=8),
    )


def arcs(data: Callable[[S], Sequence[Array]]) -> Layer[S]:
    """Return the layer of thin curves `data(state)`, each (m, 2), along orbits."""
    return curves("arcs", data, color=theme.ORBIT, width=1, alpha=0.5)


def arrows_at(middles: Sequence[tuple[Array, int]]) -> Array:
    """Return x, y and angle (3, n) for `arrows`, given pairs of a curve (m, 2) and the index of its point.

    An end point is replaced by the nearest inner point; curves of fewer than three points get no arrow.
    """
    found = []
    for curve, index in middles:
        if len(curve) > 2:
            i = min(max(index, 1), len(curve) - 2)
            found.append((curve[i], curve[i + 1] - curve[i - 1]))
    return _arrows(found)


def arrows_on(curves: Sequence[Array], half_width: float) -> Array:
    """Return x, y and angle (3, n) for `arrows`, in the middle of each curve (m, 2) that is long enough.

    Curves shorter than 2 % of the half width get no arrow.
    """
    found = []
    for curve in curves:
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
        if length[-1] < 0.02 * half_width:
            continue
        i = min(int(np.searchsorted(length, 0.5 * length[-1])), len(curve) - 1)
        found.append((curve[i], curve[i] - curve[i - 1]))
    return _arrows(found)


def _arrows(arrows: Sequence[tuple[Array, Array]]) -> Array:
    """Return x, y, angle (3, n) of triangles at (point, step); angle 0 points upwards."""
    return np.array([(*point, np.arctan2(*step[::-1]) - np.pi / 2) for point, step in arrows]).reshape(-1, 3).T
