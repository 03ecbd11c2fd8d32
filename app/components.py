"""The page's own browser components: Poisson sphere, player, and the keeper of `data-ready` and the URL."""

from __future__ import annotations

from pathlib import Path

import param
from panel.custom import JSComponent

__all__ = ["STATIC", "Player", "Ready", "Sphere", "Text"]

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

    _esm = STATIC / "player.js"
    _stylesheets = [_CSS]


class Ready(JSComponent):
    """Keeps `<html data-ready data-state>` and the address bar; tells the server what is painted."""

    sequence = param.Dict(
        default={"number": 0, "answers": 0, "tree": {}},
        doc="Number of the state, last request answered by it, and the tree of its data (see `app.wire`).")
    block = param.Bytes(default=b"", doc="The numbers of that tree.")
    query = param.String(default="", doc="The state as a URL query.")
    client = param.Dict(default={}, doc="URL keys that the browser itself keeps: t, speed, az, el.")
    requested = param.Integer(default=0, doc="Changes by the user so far; written by the browser.")
    painted = param.Integer(default=0, doc="Number of the last painted state; written by the browser.")
    picked = param.List(default=[], doc="Last pick in a picture: [picture, x, y, count]; written by the browser.")

    _esm = STATIC / "ready.js"
    _debounce = 0


class Text(JSComponent):
    """A piece of text that changes often; whatever it contains, it is shown as text."""

    text = param.String(default="")
    tag = param.Selector(default="p", objects=["p", "h2", "div"], doc="The element.")
    look = param.Selector(default="", objects=["", "caption", "status", "notes", "derived"], doc="Its style.")
    live = param.Boolean(default=False, doc="Whether screen readers are told of changes.")

    _esm = STATIC / "text.js"
    _stylesheets = [_CSS]
