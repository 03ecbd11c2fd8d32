"""What a link opens: read twice, for the page itself and where its states are computed, with the same outcome."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode

from hess_explorer.lessons import shipped
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.requested import linked
from hess_explorer.protocol.parameters import CLIENT, Choice, Link, Names, Number, Values
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

__all__ = ["THEME", "Opening", "opening", "query_of"]

SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
"""Of the player."""
THEME = Choice("theme", "Theme", ("light", "dark"), "light")
PRESENT = Choice("present", "Present mode", ("0", "1"), "0")
EMBED = Choice("embed", "Embedding", ("0", "1"), "0")


@dataclass(frozen=True)
class Opening:
    """A page as its link has it.

    scene, values : shown first; notes : what had to be changed in the link; lessons : those that can be given;
    reading : the one that is given; pictures : those in sight; client : what the browser itself keeps; dark : its
    theme.
    """

    scene: Scene[Any]
    values: Values
    notes: list[str]
    lessons: Mapping[str, Lesson]
    reading: Lesson | None
    pictures: Collection[str]
    client: dict[str, str]
    dark: bool


def query_of(arguments: Mapping[str, Iterable[bytes]]) -> str:
    """The query of a request: of each name what was given first."""
    pairs = ((name, next(iter(given), None)) for name, given in arguments.items())
    return urlencode([(name, first.decode("utf-8", "replace")) for name, first in pairs if first is not None])


def opening(query: str, own: Lesson | None, *, lenient: bool = True) -> Opening:
    """What the query of a link opens; own : a lesson besides those of the package.

    An address that names neither a scene nor a lesson begins that one.  What is wrong in the query is put right and
    noted, unless it is not read leniently: then `InvalidParameter` is raised.
    """
    lessons = {own.name: own, **shipped()} if own else dict(shipped())
    link = Link(query, lenient)
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
    numbers = link.values(CLIENT)
    numbers["speed"] = min(SPEEDS, key=lambda speed: abs(speed - float(numbers["speed"])))
    client = {
        **{name: repr(value) for name, value in numbers.items()},
        large.name: str(link.value(large)),
        "lesson": reading.name if reading else "",
        "step": str(at) if reading else "",
    }
    dark = link.value(THEME) == "dark"
    # What is not written into the address is empty.
    client |= {spec.name: str(link.value(spec)).strip("0") for spec in (PRESENT, EMBED)}
    # None at all is none meant.
    parts = {spec.name: str(link.value(spec)) or spec.default for spec in _embedded(scene)}
    pictures = scene.open_pictures
    if client[EMBED.name]:
        client |= parts
        pictures = tuple(parts["pictures"].split(","))
    return Opening(scene, state, link.notes, lessons, reading, pictures, client, dark)


def _embedded(scene: Scene[Any]) -> tuple[Names, Names]:
    """The pictures and the controls of a page inside another one (`embed=1`); "none": no control."""
    controls = tuple(spec.name for spec in scene.specs if isinstance(spec, Number | Choice))
    return (
        Names("pictures", "Embedded pictures", scene.pictures, len(scene.pictures), ",".join(scene.open_pictures)),
        Names("controls", "Embedded controls", (*controls, "none"), len(controls), ",".join(scene.essential)),
    )
