"""The page's own browser components.

Each is an ES module under `static/`, and they share one instance of every module that they import.  They know each
other only by the events of "page/bus.js": "page/client.js" tells all of them of a scene that is entered, of texts and
of values; they tell it of changes.
"""

from __future__ import annotations

from typing import Any

import param
from panel.custom import Child, JSComponent

from hess_explorer.assets import STATIC, modules_path

__all__ = ["Bar", "Controls", "Lessons", "Pictures", "Player", "Progress", "Prose", "Ready", "Shell", "Status", "Text"]

_MODULES = modules_path()


def _module(entry: str) -> str:
    """What Panel loads: it fetches the module from its own URL, also where a proxy serves the page under a prefix."""
    url = f'new URL("{_MODULES}/{entry}", document.baseURI).href'
    return f"export const render = async (component) => (await import({url})).render(component)\n"


def _css(*names: str) -> list[str]:
    return [(STATIC / name).read_text(encoding="utf-8") for name in ("page/base.css", *names)]


class Shell(JSComponent):
    """The frame of the page: where everything stands, in every window."""

    bar = Child(doc="The bar.")
    controls = Child(doc="The controls.")
    derived = Child(doc="What follows from them.")
    pictures = Child(doc="The pictures.")
    player = Child(doc="The player, under the pictures.")
    lessons = Child(doc="A lesson, over the words.")
    words = Child(doc="The words beside the pictures.")
    legend = Child(doc="The legend under the words.")
    notes = Child(doc="Notes on the state, under the controls.")
    status = Child(doc="The status line, under the controls.")
    busy = Child(doc="What is said while an answer takes long.")
    progress = Child(doc="How much is computed.")
    ready = Child(doc="What asks for states; it is not seen.")

    _esm = _module("page/shell.js")
    _stylesheets = _css("page/shell.css")


class Lessons(JSComponent):
    """A lesson step by step, the menu of lessons, and what can be tried in the scene on show."""

    index = param.List(default=[], doc="{name, title, minutes} of each lesson.")

    _esm = _module("page/lessons.js")
    _stylesheets = _css("page/page.css", "page/lessons.css")


class Bar(JSComponent):
    """The menu of scenes, and what can be done with the page; a choice travels with the request for its first state."""

    scenes = param.List(default=[], doc="{name, title, summary, picture, origin, group} of each.")
    palettes = param.Dict(default={}, doc="Colours of a chart: of numbers, and of turns.")

    files: Any = param.Dict(default={}, doc="formats: [kind, words, what it holds] of each that Export offers; width, "
                            "seconds: least, most and usual.")

    _esm = _module("controls/bar.js")
    _stylesheets = _css("controls/dialog.css", "controls/bar.css")


class Controls(JSComponent):
    """Sliders, boxes, menus and buttons of the scene on show.

    Written for this page because a control must cost nothing while it is used, nor when a scene is entered: a
    change travels with the request for the next state, and no widget framework runs in between.
    """

    _esm = _module("controls/controls.js")
    _stylesheets = _css("controls/dialog.css", "controls/controls.css")


class Pictures(JSComponent):
    """The pictures of the scene on show, with their captions."""

    _esm = _module("pictures/gallery.js")
    _stylesheets = _css("pictures/pictures.css")


class Player(JSComponent):
    """Play, pause, step, speed, time: moves the point of every picture, in the browser alone."""

    SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)

    _esm = _module("controls/player.js")
    _stylesheets = _css("controls/controls.css", "controls/player.css")


class Progress(JSComponent):
    """How much of a state is computed, while it is on its way, and Stop."""

    _esm = _module("page/progress.js")
    _stylesheets = _css("page/page.css")


class Prose(JSComponent):
    """HTML of the scene on show: its legend or its words."""

    part: Any = param.Selector(default="words", objects=["legend", "words"])

    _esm = _module("page/prose.js")
    _stylesheets = _css("page/page.css")


class Ready(JSComponent):
    """Keeps `<html data-ready data-state>` and the address bar.

    States come by the websocket of `Connection`, and not by Panel.
    """

    lesson = param.String(default="", doc="JSON: the lesson that the link names, see `description`.")
    client = param.Dict(default={}, doc="URL keys that the browser itself keeps: t, speed, az, el, large, present, "
                        "embed, pictures, controls, lesson, step.")

    _esm = _module("page/client.js")


class Status(JSComponent):
    """The status line: one sentence, and all that it sums up on a click."""

    _esm = _module("page/status.js")
    _stylesheets = _css("page/page.css")


class Text(JSComponent):
    """A piece of text that changes often; whatever it contains, it is shown as text."""

    key = param.String(default="", doc="By this the wire finds it.")
    tag: Any = param.Selector(default="p", objects=["p", "div"], doc="The element.")
    look: Any = param.Selector(default="", objects=["", "notes", "derived", "busy"], doc="Its style.")
    live = param.Boolean(default=False, doc="Whether screen readers are told of changes.")

    _esm = _module("page/text.js")
    _stylesheets = _css("page/page.css")
