"""A plain page to compare with, as a first script has it: `python tests/manual/plain_page.py PORT`.

Four Bokeh plots and two sliders of Panel: the orbit, its track on the sphere, the bifurcation diagram, the circle map.
"""

import sys

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource
from bokeh.plotting import figure

from hess_mechanics import circle_map, curve, solve, systems, turning_points

A = 0.75
SYSTEM = systems()["hess"].at((A, 1.0))
PHASES = np.linspace(-np.pi, np.pi, 181)
TIMES = np.linspace(0.0, 40.0, 707)


def computed(h, f):
    """The lines of the four plots."""
    start = turning_points(h, f).state_at_lower_turn(0.0)
    w1, w2, n1, n2, n3 = solve(SYSTEM, start, TIMES, "standard").states.T
    map_ = circle_map(A, h, f, "standard")
    return (w1, w2), (n1, 0.9 * n3 - 0.4 * n2), ([h], [f]), (PHASES, map_.theta(PHASES))


def page():
    """The page of one visitor."""
    h = pn.widgets.FloatSlider(name="h", start=-0.9, end=4.0, step=0.002, value=1.2)
    f = pn.widgets.FloatSlider(name="f", start=-1.0, end=1.0, step=0.01, value=0.3)
    plots, sources = [], []
    for title, (x, y) in zip(("ω", "γ", "h, f", "θ"), computed(h.value, f.value), strict=True):
        plot, source = figure(title=title, width=480, height=400), ColumnDataSource({"x": x, "y": y})
        (plot.scatter if len(x) == 1 else plot.line)("x", "y", source=source)
        plots.append(plot)
        sources.append(source)
    plots[2].line(*curve(4.0).T)

    def change(*_events):
        for source, (x, y) in zip(sources, computed(h.value, f.value), strict=True):
            source.data = {"x": x, "y": y}

    h.param.watch(change, "value")
    f.param.watch(change, "value")
    return pn.Row(pn.Column(h, f), pn.GridBox(*plots, ncols=2))


if __name__ == "__main__":
    pn.serve(page, port=int(sys.argv[1]), show=False)
