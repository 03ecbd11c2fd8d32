"""Build a folder of pages that works without a server: an index, all lessons, and each scene with two sliders."""

from __future__ import annotations

import base64
import multiprocessing
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.parse import quote

from hess_explorer.assets import STATIC
from hess_explorer.lessons import shipped
from hess_explorer.offline.html import HOME
from hess_explorer.offline.pages import COUNT, lesson_page, scene_page
from hess_explorer.page.showcase import EXHIBITS, IDEAS, Exhibit
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.files import write_whole

__all__ = ["build", "pages"]

_INDEX = "index.html"

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="{program}">
<title>Hess Explorer</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<h1>Hess Explorer</h1>
<p>The Suslov problem, its Hess case and their relatives, as pages that need no server. Their sliders move through
computed states; in the explorer everything moves.</p>
{parts}
<p class="program">{program}</p>
</body>
</html>
"""


def pages(names: Sequence[str] = ()) -> dict[str, str]:
    """Return the files of the pages by name: of lessons, and of scenes that look into no other scene.

    Parameters
    ----------
    names : sequence of str
        Names of lessons and scenes; all by default.

    Returns
    -------
    dict
        Name → path relative to the folder.

    Raises
    ------
    InvalidParameter
        If there is no such lesson or scene.
    """
    found = {name: f"lessons/{name}.html" for name in shipped()}
    found |= {scene.name: f"scenes/{scene.name}.html" for scene in scenes().values() if not scene.origin}
    unknown = [name for name in names if name not in found]
    if unknown:
        raise InvalidParameter(f"There is no page {unknown[0]!r}: choose among {', '.join(found)}.")
    return {name: path for name, path in found.items() if not names or name in names}


def build(
    folder: Path,
    names: Sequence[str] = (),
    *,
    count: int = COUNT,
    home: str = HOME,
    workers: int = 1,
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
    workers : int
        Number of processes.
    report : callable, optional
        Gets the name of a page that is written, the number of written pages and of all pages.

    Returns
    -------
    dict
        Path relative to the folder → bytes.

    Raises
    ------
    InvalidParameter
        If there is no such page, or the folder holds other files.
    ModelError
        If a state cannot be computed.
    """
    wanted = pages(names)
    own = {_INDEX, *(Path(path).parent.name for path in pages().values())}
    if folder.exists() and not {one.name for one in folder.iterdir()} <= own:
        raise InvalidParameter(f"The folder {str(folder)!r} holds other files: choose an empty one.")
    for path in {Path(file).parent for file in wanted.values()}:
        (folder / path).mkdir(parents=True, exist_ok=True)
    sizes = dict[str, int]()
    # New processes, because a fork of one that has compiled kernels and started threads can hang.
    pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))
    with pool:
        running = {pool.submit(_write, folder / path, name, count, home): name for name, path in wanted.items()}
        try:
            for done, one in enumerate(as_completed(running), 1):
                name = running[one]
                sizes[wanted[name]] = one.result()
                if report is not None:
                    report(name, done, len(wanted))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    index = _index(wanted).encode()
    write_whole(folder / _INDEX, index)
    return {**sizes, _INDEX: len(index)}


def _write(path: Path, name: str, count: int, home: str) -> int:
    """Write a page; return its size in bytes."""
    contents = f"../{_INDEX}"
    lesson = shipped().get(name)
    if lesson is not None:
        content = lesson_page(lesson, count, home=home, contents=contents)
    else:
        examples = [one.preset for one in EXHIBITS if one.scene == name]
        content = scene_page(scenes()[name], examples, count, home=home, contents=contents)
    write_whole(path, content)
    return len(content)


def _index(wanted: Mapping[str, str]) -> str:
    program = f"hess-explorer {version('hess-explorer')}"
    return _PAGE.format(
        policy=escape(_POLICY),
        program=escape(program),
        style=(STATIC / "offline/index.css").read_text(encoding="utf-8"),
        parts="\n".join(_parts(wanted)),
    )


def _parts(wanted: Mapping[str, str]) -> Iterator[str]:
    """Yield the sections of the index that have tiles."""
    lessons = [lesson for lesson in shipped().values() if lesson.name in wanted]
    listed: list[Scene[Any]] = [scene for scene in scenes().values() if scene.name in wanted]
    sections = {
        "Lessons": [
            _tile(wanted[one.name], one.title, f"{len(one.steps)} steps, {one.minutes:g} min") for one in lessons
        ],
        **{
            idea: [_exhibit(one, wanted[one.scene]) for one in exhibits if one.scene in wanted]
            for idea, exhibits in IDEAS.items()
        },
    }
    for scene in listed:
        sections.setdefault(scene.group, []).append(_tile(wanted[scene.name], scene.title, scene.summary))
    for title, tiles in sections.items():
        if tiles:
            yield f'<section><h2>{escape(title)}</h2><div class="tiles">{"".join(tiles)}</div></section>'


def _tile(path: str, title: str, words: str) -> str:
    return f'<a class="page" href="{path}"><strong>{escape(title)}</strong><span>{escape(words)}</span></a>'


def _exhibit(one: Exhibit, path: str) -> str:
    """Return the tile of an exhibit, with its picture for a light and a dark page."""
    pictures = {
        theme: base64.b64encode((STATIC / f"thumbnails/{one.file}-{theme}.jpg").read_bytes()).decode()
        for theme in ("light", "dark")
    }
    shown = (
        f'<picture><source media="(prefers-color-scheme: dark)" srcset="data:image/jpeg;base64,{pictures["dark"]}">'
        f'<img alt="" src="data:image/jpeg;base64,{pictures["light"]}"></picture>'
    )
    address = f"{path}#example={quote(one.preset.name)}"
    return f'<a class="page" href="{address}">{shown}<strong>{escape(one.title)}</strong></a>'
