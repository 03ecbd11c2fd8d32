"""Pictures of a section, for a state with the parts `section`, `density`, `megno`, `periodic_orbit` and `clicks`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.trial import Trial, section_error
from hess_explorer.scenes.framework.windows import Window, pixels_in
from hess_explorer.scenes.parts.sections.indicator import indicator_layer, indicator_trial
from hess_explorer.scenes.parts.sections.periodic_orbit import periodic_layers
from hess_explorer.scenes.parts.sections.section import section_caption
from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layers
from hess_explorer.views.plane import density, layered_section, section_plane
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import Array

_MOST_COMPARED = 400.0
"""Largest number of crossings of each orbit for which levels are compared."""


def _density(labels: tuple[str, ...], colors: tuple[str, ...]) -> Layers[Any]:
    return density.layers(lambda s: s.density.tones, lambda s: s.section.frame, labels, colors)


def section_layers(*parts: str, **more: Any) -> Layers[Any]:
    """Return the layers of a section with one kind of orbits.

    Parameters
    ----------
    *parts : str
        Names of the other parts of the state to show; by default all.
    **more
        Other arguments of `section_plane.layers`, except `own` and `others`.
    """
    parts = parts or ("megno", "density", "periodic_orbit")

    def others(s: Any) -> Array | None:
        return None if "density" in parts and s.density.tones else s.section.points()

    return (
        *((indicator_layer(),) if "megno" in parts else ()),
        *(_density(("few to many crossings of other orbits",), (theme.INK,)) if "density" in parts else ()),
        *section_plane.layers(lambda s: s.section.chosen_points, others=others, **more),
        *(periodic_layers() if "periodic_orbit" in parts else ()),
    )


def section_picture(**more: Any) -> Plot[Any]:
    """Return the picture of a section, in which a click starts the orbit; `more` are arguments of `Plot`."""

    def side(axis: int) -> Callable[[Any], tuple[float, float]]:
        return lambda s: tuple(corner[axis] for corner in s.section.frame)

    usual: dict[str, Any] = {
        "title": "Poincaré section",
        "caption": lambda s: s.section_caption or section_caption(s.section),
        "axes": lambda s: s.section.poincare.names,
        "x": side(0),
        "y": side(1),
        "message": lambda s: s.section.known_orbits.reason,
        "on_click": lambda s, x, y: s.start_at(x, y),
        "layers": section_layers(ended=lambda s: s.section.points(ends=True)),
    }
    return Plot(name="section", starts=True, **{**usual, **more})


def _unseen(s: Any) -> str:
    """Return the message for a window without points if everything is computed; otherwise an empty string."""
    low, high = np.array(s.section.frame)
    drawn = s.section.chosen_points, s.section.points(), s.section.points(False)
    if (
        s.is_preview
        or s.work.todo
        or not s.section.is_exclusive
        or s.density.tones
        or any(np.all((points >= low) & (points <= high), axis=1).any() for points in drawn)
    ):
        return ""
    return "None of the points lies in this window: choose more crossings, or press Undo"


def filled_picture(
    full: Window,
    labels: tuple[str, str],
    under: Layers[Any] = (),
    between: Layers[Any] = (),
    over: Layers[Any] | None = None,
    **more: Any,
) -> Plot[Any]:
    """Return the picture of a section filled with two kinds of orbits, in which each click starts another orbit.

    Parameters
    ----------
    full : tuple
        Window of the whole section, shown before the first state.
    labels : tuple of str
        Legend entries of the two kinds.
    under : sequence of Layer
        Layers below all others.
    between : sequence of Layer
        Layers above the points of both kinds and below those of the chosen orbits.
    over : sequence of Layer, optional
        Layers of the periodic orbit, above all others; by default `periodic_layers()`.
    **more
        Other arguments of `Plot`.
    """
    (x0, y0), (x1, y1) = full

    def points(first: bool) -> Callable[[Any], Array]:
        return lambda s: np.empty((0, 2)) if s.density.tones else s.section.points(first)

    return section_picture(
        message=lambda s: s.section.known_orbits.reason or _unseen(s),
        first=Axes((x0, x1), (y0, y1)),
        on_click=lambda s, x, y: s.clicks.add(x, y),
        on_box=lambda s, corners: s.clicks.box_window(corners),
        layers=(
            *under,
            indicator_layer(),
            *_density(labels, (theme.ORBIT, theme.UNSTABLE)),
            *layered_section.layers(
                points(True),
                points(False),
                lambda s: s.section.points_of_each_chosen,
                chosen=lambda s: s.clicks.rings,
                forbidden_cells=lambda s: s.clicks.forbidden_cells,
                window=lambda s: s.section.frame,
                labels=labels,
                between=between,
            ),
            *(periodic_layers() if over is None else over),
        ),
        **more,
    )


def section_trials(**most: float) -> tuple[Trial[Any], Trial[Any]]:
    """Return the trials of a section and of its cells of MEGNO.

    Parameters
    ----------
    **most : float
        Upper limits of further parameters in the comparison of levels.
    """
    return (
        Trial(
            Kind.SECTION,
            ("section",),
            lambda s, plan: s.section.orbits_at(plan),
            lambda s, orbits, truth: section_error(orbits, truth, pixels_in(s.section.frame), s.section.poincare.turns),
            most=(*most.items(), ("count", _MOST_COMPARED)),
        ),
        indicator_trial(),
    )
