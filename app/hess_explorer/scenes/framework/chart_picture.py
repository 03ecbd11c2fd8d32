"""The picture of the chart of a scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bokeh.palettes import Cividis256

from hess_explorer.scenes.framework.charted import Charts
from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, CellGrid, Layer, Sign, image, target
from hess_explorer.views.plot import Plot
from hess_mechanics import catalogue

_KINDS = ("#DCDCDC", theme.ORBIT, theme.SHEET, theme.STABLE, theme.UNSTABLE, "#E69F00", theme.MAP, theme.POINT)
"""Colours of categories."""


def chart_picture(charts: Charts) -> Plot[Any]:
    """Return the picture of the chart."""
    named = [one.computation.number(name) for one, name in charts.numbers.values()]
    return Plot(
        name="chart",
        title=lambda s: f"{s.chart.replace('-', ' ').capitalize()} over ({s.chart_x}, {s.chart_y})",
        caption=lambda s: s.chart_part.caption,
        axes=lambda s: (s.chart_x, s.chart_y),
        x=lambda s: tuple(corner[0] for corner in s.chart_part.window),
        y=lambda s: tuple(corner[1] for corner in s.chart_part.window),
        first=Axes((0.0, 1.0), (0.0, 1.0)),
        on_click=lambda s, x, y: s.chart_part.choose(x, y),
        on_drag="here",
        on_box=lambda s, corners: s.chart_part.box_window(corners),
        on_hover=lambda s, x, y: s.chart_part.about(x, y),
        button="Show the chart",
        layers=(
            _colours("numbers", Cividis256, "number of the chart, small to large", lambda one: not one.turn),
            _colours("turns", theme.TURN_MAP, "number of the chart, one turn", lambda one: one.turn > 0.0),
            *(_kinds(i, one) for i, one in enumerate(named) if one.categories),
            *target("here", lambda s: s.chart_part.here()),
        ),
    )


def _colours(name: str, palette: tuple[str, ...], label: str, shows: Callable[[catalogue.Number], bool]) -> Layer[Any]:
    def cells(s: Any) -> CellGrid | None:
        number = s.chart_part.number
        return s.chart_part.cells if shows(number) and not number.categories else None

    sign = Sign(label, "box rho", f"background: {theme.gradient(palette)}")
    return image(name, cells, palette=palette, low=0.0, high=1.0, legend=(sign,))


def _kinds(i: int, number: catalogue.Number) -> Layer[Any]:
    least, most = min(number.categories), max(number.categories)
    colours = tuple(_KINDS[i % len(_KINDS)] for i in range(most - least + 1))
    return image(
        f"kinds-{i}",
        lambda s: s.chart_part.cells if s.chart_part.number is number else None,
        palette=colours,
        low=least - 0.5,
        high=most + 0.5,
        kinds=True,
        legend=tuple(
            Sign(name, "box", f"background: {colours[value - least]}", value - 0.5)
            for value, name in number.categories.items()
        ),
    )
