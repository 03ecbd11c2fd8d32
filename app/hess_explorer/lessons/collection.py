"""Lessons of the user: the files and folders that `serve --lesson` names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from hess_explorer.lessons import shipped
from hess_explorer.lessons.lesson import Lesson, LessonError
from hess_explorer.lessons.reading import read_file
from hess_explorer.lessons.review import corrections

__all__ = ["MAX_LESSONS", "files_in", "read_paths"]

MAX_LESSONS = 100


def read_paths(paths: Iterable[Path]) -> tuple[Lesson, ...]:
    """Return the lessons in files and folders.

    Parameters
    ----------
    paths : iterable of Path
        Markdown files, and folders of which each file `*.md` is a lesson.

    Returns
    -------
    tuple of Lesson
        The lessons in the given order, those of a folder by file name.

    Raises
    ------
    LessonError
        If a file is no lesson, a folder has none, or two lessons have the same name.
    """
    return tuple(_with_own_names(files_in(paths)))


def files_in(paths: Iterable[Path]) -> Sequence[Path]:
    """Return the files of lessons that are named or in a folder.  Raises `LessonError`."""
    files = [file for path in paths for file in _files(path)]
    if len(files) > MAX_LESSONS:
        raise LessonError(f"there are {len(files)} lessons; at most {MAX_LESSONS} are allowed.", 1, str(files[-1]))
    return files


def _files(path: Path) -> Sequence[Path]:
    if not path.is_dir():
        return [path]
    found = sorted(path.glob("*.md"))
    if not found:
        raise LessonError("this folder has no lesson: put a file like lesson.md into it.", 1, str(path))
    return found


def _with_own_names(files: Iterable[Path]) -> Iterator[Lesson]:
    """Yield the lessons, whose names must differ: links of the page contain them."""
    taken = dict.fromkeys(shipped(), "a lesson of this package")
    for file in files:
        lesson = read_file(file)
        if lesson.name in taken:
            raise LessonError(
                f"its name in links, {lesson.name}, is that of {taken[lesson.name]}: rename the file.", 1, str(file)
            )
        taken[lesson.name] = str(file)
        mistake = next(corrections(lesson), None)
        if mistake is not None:
            raise LessonError(mistake.message, mistake.line, file.name)
        yield lesson
