"""The page's own browser components: Poisson sphere, player, and the keeper of `data-ready` and the URL."""

from __future__ import annotations

from pathlib import Path

import param
from panel.custom import JSComponent

__all__ = ["STATIC", "NumberControl", "Player", "Ready", "SceneMenu", "Sphere", "Text"]

STATIC = Path(__file__).resolve().parent.parent / "static"
_CSS = (STATIC / "components.css").read_text(encoding="utf-8")


class Sphere(JSComponent):
    """The unit sphere with the tracks of the sources `orbit`, `stable`, `unstable` (columns g1, g2, g3)."""

    azimuth = param.Number(default=0.6, doc="Direction of sight, radians about γ3.")
    elevation = param.Number(default=0.35, doc="Direction of sight, radians above the equator.")
    axis = param.List(default=[], doc="A distinguished axis, unit vector; empty for none.")
    heights = param.List(default=[], doc="Heights along that axis between which the motion stays.")
    message = param.String(default="", doc="Shown instead of a track that does not exist.")

    _esm = STATIC / "sphere.js"
    _stylesheets = [_CSS]


class Player(JSComponent):
    """Play, pause, step, speed, time: moves the point of every picture, in the browser alone."""

    t = param.Number(default=0.0, doc="Time shown first.")
    speed = param.Number(default=1.0, doc="Units of t per second.")
    dots = param.Dict(default={}, doc="Source name → the columns of `orbit` that are its x and y.")
    angles = param.List(default=[], doc="Columns that are angles and may jump by 2π.")

    SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)

    _esm = STATIC / "player.js"
    _stylesheets = [_CSS]


class SceneMenu(JSComponent):
    """The scenes as pictures to choose from; a choice travels with the request for its first state."""

    scenes = param.List(default=[], doc="{name, title, summary, picture, origin} of each.")
    shown = param.String(default="", doc="The name of the one on show.")

    _esm = STATIC / "scenes.js"
    _stylesheets = [_CSS]


class Ready(JSComponent):
    """Keeps `<html data-ready data-state>` and the address bar.

    It sends messages, for `on_msg`: {"requested": n, "held": whether a slider is held, "values": {name:
    number, …}, "picked": [picture, x, y] or null, "reset": whether Reset was pressed, "scene": the scene chosen or
    null, "hidden": [the pictures out of sight, …]} asks for the state after the user's n-th change.
    """

    state = param.String(default="", doc="JSON: number of the state, last request that it answers, URL query, "
                         "the tree of its data (see `app.wire`), scene and number of its Bokeh plots.")
    block = param.Bytes(default=b"", doc="The numbers of that tree.")
    client = param.Dict(default={}, doc="URL keys that the browser itself keeps: t, speed, az, el.")

    _esm = STATIC / "ready.js"


class NumberControl(JSComponent):
    """A slider and a box for one parameter.

    Written for this page because a slider must cost nothing while it is dragged: the change travels
    with the request for the next state, and no widget framework runs in between.
    """

    name = param.String(default="", constant=True, doc="The parameter.")
    label = param.String(default="")
    symbol = param.String(default="")
    help = param.String(default="", doc="What it means and which values it may take.")
    shown = param.List(default=[], doc="[value, low, high, step] shown first.")

    _esm = STATIC / "number.js"
    _stylesheets = [_CSS]


class Text(JSComponent):
    """A piece of text that changes often; whatever it contains, it is shown as text."""

    key = param.String(default="", doc="By this the wire finds it.")
    text = param.String(default="", doc="What it says at first.")
    tag = param.Selector(default="p", objects=["p", "h2", "div"], doc="The element.")
    look = param.Selector(default="", objects=["", "caption", "status", "notes", "derived", "help"], doc="Its style.")
    live = param.Boolean(default=False, doc="Whether screen readers are told of changes.")

    _esm = STATIC / "text.js"
    _stylesheets = [_CSS]
