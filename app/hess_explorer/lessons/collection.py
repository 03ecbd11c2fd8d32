"""The user's lessons: files and folders of `serve --lesson`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from hess_explorer.lessons import package_lessons
from hess_explorer.lessons.lesson import Lesson, LessonError
from hess_explorer.lessons.reading import examine, name_of

MAX_LESSONS = 100


def read_paths(paths: Iterable[Path]) -> tuple[tuple[Lesson, ...], list[LessonError]]:
    """Return the valid lessons in files and folders, and the mistakes in the other files.

    Parameters
    ----------
    paths : iterable of Path
        Markdown files, and folders of which each file `*.md` is a lesson.

    Returns
    -------
    lessons : tuple of Lesson
        The lessons in the given order, those of a folder by file name.
    mistakes : list of LessonError
        The mistakes of the other files.

    Raises
    ------
    LessonError
        If there are more than `MAX_LESSONS` files, or a folder has none.
    """
    found = [*examine_files(files_in(paths))]
    lessons = tuple(lesson for _, lesson, mistakes in found if lesson is not None and not mistakes)
    return lessons, [one for _, _, mistakes in found for one in mistakes]


def examine_files(files: Iterable[Path]) -> Iterator[tuple[Path, Lesson | None, list[LessonError]]]:
    """Yield each file with its lesson and its mistakes, see `examine`; a name in links that is taken is a mistake."""
    taken = dict.fromkeys(package_lessons(), "a lesson of this package")
    for file in files:
        lesson, mistakes = examine(file)
        other = taken.setdefault(name_of(file), str(file))
        if other != str(file):
            why = f"its name in links, {name_of(file)}, is that of {other}: rename the file."
            mistakes.append(LessonError(why, 1, file.name))
        yield file, lesson, mistakes


def files_in(paths: Iterable[Path]) -> Sequence[Path]:
    """Return the lesson files in a list of files and folders.  Raises `LessonError`, see `read_paths`."""
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
