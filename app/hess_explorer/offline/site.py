"""Build a folder of pages that need no server: all lessons, each scene with two sliders, and a page of links."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from hess_explorer.lessons import package_lessons
from hess_explorer.offline.html import HOME
from hess_explorer.offline.pages import COUNT, has_density_shading, lesson_page, state_page
from hess_explorer.page.controls import slider_limits
from hess_explorer.protocol.specs import NumberSpec, Value, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import DRAFT
from hess_mechanics.numerics.files import write_atomically

_INDEX = "index.html"
_CLOUD = 500.0
"""Number of points of a cloud in the page of a scene."""
_WINDOW = ("first", "last")
"""Parameters without a slider: the ends of an orbit diagram, which set the range that is computed."""

_LINKS = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<title>Hess Explorer</title>
<link rel="icon" href="data:,">
<style>
:root {{ color-scheme: light dark }}
body {{ max-width: 50em; margin: auto; padding: 1em; font: 1em system-ui }}
</style>
<h1>Hess Explorer</h1>
<p>The Suslov problem, its Hess case and their relatives, as pages that need no server. Their sliders move through
computed states; in the explorer every parameter can change.</p>
{parts}
</html>
"""


def pages(names: Sequence[str] = ()) -> dict[str, str]:
    """Return the paths of the pages of lessons and scenes by name.

    Parameters
    ----------
    names : sequence of str
        Names of lessons and scenes; all by default.

    Returns
    -------
    dict of str to str
        Paths relative to the folder, by name.

    Raises
    ------
    InvalidParameter
        If there is no such lesson or scene.
    """
    every = {name: f"lessons/{name}.html" for name in package_lessons()}
    every |= {scene.name: f"scenes/{scene.name}.html" for scene in scenes().values() if not scene.origin}
    for name in names:
        if name not in every:
            raise InvalidParameter(f"There is no page {name!r}: choose among {', '.join(every)}.")
    return {name: path for name, path in every.items() if not names or name in names}


def build(
    folder: Path,
    names: Sequence[str] = (),
    *,
    count: int = COUNT,
    home: str = HOME,
    report: Callable[[str, int, int], None] | None = None,
) -> dict[str, int]:
    """Build the site and return the size of each file in bytes.

    Parameters
    ----------
    folder : Path
        The folder; it is created, and files of an earlier site are replaced.
    names : sequence of str
        Names of lessons and scenes; all by default.
    count : int
        Number of values of a slider.
    home : str
        Address of the explorer, for the links in the pages.
    report : callable, optional
        Called with the name of a written page, the number of written pages and the total number.

    Returns
    -------
    dict of str to int
        Sizes in bytes, by path relative to the folder.

    Raises
    ------
    InvalidParameter
        If there is no such page, or the folder holds other files.
    ModelError
        If a state cannot be computed.
    """
    files = pages(names)
    own = {_INDEX, *(Path(path).parent.name for path in pages().values())}
    if folder.exists() and not {one.name for one in folder.iterdir()} <= own:
        raise InvalidParameter(f"The folder {str(folder)!r} holds other files: choose an empty one.")
    sizes = dict[str, int]()

    def write(path: str, content: bytes) -> None:
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / path, content)
        sizes[path] = len(content)

    for done, (name, path) in enumerate(files.items(), 1):
        lesson = package_lessons().get(name)
        if lesson is None:
            write(path, _scene_page(scenes()[name], count, home))
        else:
            write(path, lesson_page(lesson, count, home=home))
        if report is not None:
            report(name, done, len(files))
    write(_INDEX, _LINKS.format(parts="\n".join(_parts(files))).encode())
    return sizes


def _scene_page(scene: Scene[Any], count: int, home: str) -> bytes:
    """Return the page of a scene: its default state with the sliders of its first two essential numbers.

    All states have the accuracy of a drag, which is right to half a pixel.  Scenes with clouds or densities have a
    quarter of the values, and clouds `_CLOUD` points.
    """
    light: dict[str, Value] = {"accuracy": DRAFT.name, "points": _CLOUD}
    light = {name: value for name, value in light.items() if name in scene.defaults()}
    values, _ = scene.admit({**scene.defaults(), **light})
    if "points" in values or has_density_shading(scene):
        count = max(2, count // 4)
    numbers = {spec.name: spec for spec in scene.specs if isinstance(spec, NumberSpec) and spec.name not in _WINDOW}
    names = [name for name in scene.essential if name in numbers][:2]
    ends = [slider_limits(numbers[name], scene.limits(values))[:2] for name in names]
    sliders = [f"{name}={low}:{high}:{count}" for name, (low, high) in zip(names, ends, strict=True)]
    return state_page(encode(scene.name, values), sliders=sliders, home=home)[1]


def _parts(files: Mapping[str, str]) -> Iterator[str]:
    """Yield a list of links as HTML for the lessons and for each group of scenes."""
    groups: dict[str, list[str]] = {}
    for name, path in files.items():
        if name in package_lessons():
            lesson = package_lessons()[name]
            group, title, words = "Lessons", lesson.title, f"{len(lesson.steps)} steps, {lesson.minutes:g} min"
        else:
            scene = scenes()[name]
            group, title, words = scene.group, scene.title, scene.summary
        groups.setdefault(group, []).append(f'<li><a href="{path}">{escape(title)}</a>: {escape(words)}</li>')
    for group, links in groups.items():
        yield f"<h2>{escape(group)}</h2><ul>{''.join(links)}</ul>"
