"""The page: Panel's for the document and its theme, with one component that says where everything stands."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable
from typing import Any
from urllib.parse import urlencode

import panel as pn
import panel_material_ui as pmui
from bokeh.palettes import Cividis256
from panel.util import edit_readonly

from hess_explorer.export.formats import FORMATS, SERVED_SECONDS, WIDTHS, Wish
from hess_explorer.lessons import shipped
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.charts import Charts
from hess_explorer.page.components import (
    Bar,
    Controls,
    Lessons,
    Pictures,
    Player,
    Progress,
    Prose,
    Ready,
    Shell,
    Status,
    Text,
)
from hess_explorer.page.description import describe_lesson
from hess_explorer.page.desk import Desk
from hess_explorer.page.session import Session, linked
from hess_explorer.protocol.parameters import CLIENT, Choice, Link, Names, Number
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views import theme

__all__ = ["page"]

logger = logging.getLogger("hess_explorer")

THEME = Choice("theme", "Theme", ("light", "dark"), "light")
PRESENT = Choice("present", "Present mode", ("0", "1"), "0")
EMBED = Choice("embed", "Embedding", ("0", "1"), "0")

_FILES = {"formats": [[kind, one.words, one.holds] for kind, one in FORMATS.items() if one.words],
          "width": [*WIDTHS, Wish.width], "seconds": [*SERVED_SECONDS, Wish.seconds]}
# Of a chart, as of every map of numbers.
_PALETTES = {"plain": [*Cividis256], "round": [*theme.TURN_MAP]}

# The system's font: the fourteen files of another one would come before the first picture.
FONT = "system-ui, sans-serif"

BARE: dict[str, Any] = {
    "height": "100dvh",
    "& .MuiAppBar-root, & .main .MuiToolbar-root": {"display": "none"},
}
"""Of Panel's page neither the bar nor the room for it: its drawers would cover a phone."""


def page(own: Lesson | None = None, follow: Callable[[str], None] | None = None) -> Any:
    """A new page for one session, in the state that its URL describes; own : a lesson besides those of the package;
    follow : told the query of each state that it shows.

    An address that names neither a scene nor a lesson begins that one.
    """
    try:
        return _page(_query(), own, follow)
    # Whatever it is, a user sees a sentence and the log the rest.
    except Exception:
        logger.exception("the page could not be built")
        return pn.pane.Str("The page could not be built. Open it without the part of its address after “?”.")


def _query() -> str:
    """The query of the request that opened this session."""
    context = pn.state.curdoc.session_context if pn.state.curdoc else None
    arguments = getattr(getattr(context, "request", None), "arguments", None) or {}
    return urlencode([(name, given[0].decode("utf-8", "replace")) for name, given in arguments.items() if given])


def _page(query: str, own: Lesson | None, follow: Callable[[str], None] | None) -> pmui.Page:
    lessons = {own.name: own, **shipped()} if own else dict(shipped())
    link = Link(query)
    first = own.name if own and "scene" not in link.given else ""
    reading = lessons.get(str(link.value(Choice("lesson", "Lesson", ("", *lessons), first))))
    most = len(reading.steps) if reading else 1
    at = int(float(link.value(Number("step", "step", "Step", 1.0, (1.0, most), 1.0, (1.0, most)))))
    if reading and "scene" not in link.given:
        # A link to a step alone is one to its state.
        place = reading.steps[at - 1].at
        scene, state = scenes()[place.scene], dict(place.values)
    else:
        scene, state = linked(link, next(iter(scenes())))
    large = Names("large", "Enlarged pictures", scene.pictures, most=2)
    embedded = _embedded(scene)
    looks = link.values((*CLIENT, large, THEME, PRESENT, EMBED, *embedded))
    kept = {spec.name: float(looks[spec.name]) for spec in CLIENT}
    kept["speed"] = min(Player.SPEEDS, key=lambda speed: abs(speed - kept["speed"]))
    client = {**{name: repr(value) for name, value in kept.items()}, large.name: str(looks[large.name]),
              "lesson": reading.name if reading else "", "step": str(at) if reading else ""}
    dark = looks["theme"] == "dark"
    # What is not written into the address is empty.
    for spec in (PRESENT, EMBED):
        client[spec.name] = str(looks[spec.name]).strip("0")
    # None at all is none meant.
    parts = {spec.name: str(looks[spec.name]) or spec.default for spec in embedded}
    pictures = parts["pictures"].split(",") if client[EMBED.name] else scene.open_pictures
    if client[EMBED.name]:
        client |= parts

    ready = Ready(client=client, lesson=describe_lesson(reading) if reading else "")
    if follow is not None:
        ready.param.watch(lambda event: follow(json.loads(event.new)["query"]), "state")
    shell = Shell(
        bar=Bar(scenes=[_entry(one) for one in scenes().values()], files=_FILES, palettes=_PALETTES),
        controls=Controls(),
        derived=Text(key="derived", look="derived", tag="div"),
        pictures=Pictures(),
        player=Player(),
        lessons=Lessons(index=[{"name": one.name, "title": one.title, "minutes": one.minutes}
                               for one in lessons.values()]),
        words=Prose(part="words"),
        legend=Prose(part="legend"),
        notes=Text(key="notes", look="notes", live=True),
        status=Status(css_classes=["status-line"]),
        busy=Text(key="busy", look="busy", live=True),
        progress=Progress(),
        ready=ready,
        sizing_mode="stretch_both",
    )
    result = pmui.Page(
        title="Hess Explorer",
        meta_name="Hess Explorer",
        meta_description=scene.summary,
        dark_theme=dark,
        theme_config={"typography": {"fontFamily": FONT}},
        main=[shell],
        busy_indicator=None,
        sx=BARE,
    )
    desk, notes = Desk(ready), link.notes
    desk.begin(lambda: Session(desk, scene, state, notes, lessons, pictures))
    charts = Charts(desk)

    def end(_: Any) -> None:
        desk.end()
        charts.end()

    pn.state.on_session_destroyed(end)
    # The page's own busy flag is sent with every event and makes Panel walk through all models each
    # time (100 ms); `data-ready` says the same.  It follows Panel's global state, whose watcher would keep every page
    # alive: a reference to what lives as long as this page takes its place, for setting a value would leave it there.
    with edit_readonly(result):
        result.busy = ready.param.loading
        result.busy = False
    return result


def _embedded(scene: Scene[Any]) -> tuple[Names, Names]:
    """The pictures and the controls of a page inside another one (`embed=1`); "none": no control."""
    controls = tuple(spec.name for spec in scene.specs if isinstance(spec, Number | Choice))
    return (Names("pictures", "Embedded pictures", scene.pictures, len(scene.pictures), ",".join(scene.open_pictures)),
            Names("controls", "Embedded controls", (*controls, "none"), len(controls), ",".join(scene.essential)))


def _entry(scene: Scene[Any]) -> dict[str, str | None]:
    """What the menu of scenes says of one."""
    return {"name": scene.name, "title": scene.title, "summary": scene.summary, "picture": scene.thumbnail,
            "origin": scene.origin, "group": scene.group}
