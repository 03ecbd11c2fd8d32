"""Parse the link of a page, in the same way for the document and the websocket."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode

from hess_explorer.lessons import package_lessons
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.requested import scene_and_values
from hess_explorer.protocol.specs import CLIENT, ChoiceSpec, ControlSpec, Link, Names, NumberSpec, Values
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
"""Playback speeds."""
THEME = ChoiceSpec("theme", "Theme", ("system", "light", "dark"), "system")
PRESENT = ChoiceSpec("present", "Present mode", ("0", "1"), "0")
EMBED = ChoiceSpec("embed", "Embedding", ("0", "1"), "0")


@dataclass(frozen=True)
class Opening:
    """The initial content of a page.

    Attributes
    ----------
    scene : Scene
        The initial scene.
    values : mapping of str to float or str
        Values of its parameters.
    notes : list of str
        Corrections of the link.
    lessons : mapping of str to Lesson
        Available lessons by name.
    reading : Lesson or None
        The open lesson.
    pictures : collection of str
        Names of the visible pictures.
    client : dict of str to str
        Values of the URL keys that the browser keeps.
    """

    scene: Scene[Any]
    values: Values
    notes: list[str]
    lessons: Mapping[str, Lesson]
    reading: Lesson | None
    pictures: Collection[str]
    client: dict[str, str]


def query_of(arguments: Mapping[str, Iterable[bytes]]) -> str:
    """Return the query string of the decoded arguments of an HTTP request, by name."""
    return urlencode([(name, one.decode("utf-8", "replace")) for name, given in arguments.items() for one in given])


def opening(query: str, own: Sequence[Lesson] = (), *, lenient: bool = True) -> Opening:
    """Return the initial content of a page.

    Parameters
    ----------
    query : str
        Query of the link.
    own : sequence of Lesson
        Lessons in addition to those of the package.  A link that names neither scene nor lesson opens the first.
    lenient : bool
        True to correct errors and append notes; False to raise an error.

    Returns
    -------
    Opening
        The content of the page.

    Raises
    ------
    InvalidParameter
        If the query is invalid and `lenient` is False.
    """
    lessons = {**{lesson.name: lesson for lesson in own}, **package_lessons()}
    link = Link(query, lenient)
    first = own[0].name if own and "scene" not in link.texts else ""
    reading = lessons.get(str(link.value(ChoiceSpec("lesson", "Lesson", ("", *lessons), first))))
    most = len(reading.steps) if reading else 1
    at = int(float(link.value(NumberSpec("step", "step", "Step", 1.0, (1.0, most), 1.0, (1.0, most)))))
    if reading and "scene" not in link.texts:
        # A link that names only a step opens the state of that step.
        place = reading.steps[at - 1].state
        scene, state = scenes()[place.scene], dict(place.values)
    else:
        scene, state = scene_and_values(link, next(iter(scenes())))
    link.require(scene.name, scene.specs)
    large = Names("large", "Enlarged pictures", scene.pictures, most=2)
    numbers = link.values(CLIENT)
    numbers["speed"] = min(SPEEDS, key=lambda speed: abs(speed - float(numbers["speed"])))
    client = {
        **{name: repr(value) for name, value in numbers.items()},
        large.name: str(link.value(large)),
        "lesson": reading.name if reading else "",
        "step": str(at) if reading else "",
    }
    theme = str(link.value(THEME))
    # The browser writes no URL key for an empty text.
    client["theme"] = "" if theme == THEME.default else theme
    client |= {spec.name: str(link.value(spec)).strip("0") for spec in (PRESENT, EMBED)}
    # An empty list stands for the default.
    parts = {spec.name: str(link.value(spec)) or spec.default for spec in _embedding(scene)}
    pictures = scene.open_pictures
    # The steps of an embedded lesson, which may be of several scenes, choose pictures and controls themselves.
    if client[EMBED.name] and reading is None:
        client |= parts
        pictures = tuple(parts["pictures"].split(","))
    return Opening(scene, state, link.notes, lessons, reading, pictures, client)


def _embedding(scene: Scene[Any]) -> tuple[Names, Names]:
    """Return the parameters "pictures" and "controls" of an embedded page; "none" means no control."""
    controls = tuple(spec.name for spec in scene.specs if isinstance(spec, ControlSpec))
    return (
        Names("pictures", "Embedded pictures", scene.pictures, len(scene.pictures), ",".join(scene.open_pictures)),
        Names("controls", "Embedded controls", (*controls, "none"), len(controls), ",".join(scene.essential)),
    )
