"""Lessons: the Markdown files of this package."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.lessons.reading import read_file

__all__ = ["shipped"]


@cache
def shipped() -> Mapping[str, Lesson]:
    """The lessons of this package by name, the longest first."""
    found = map(read_file, Path(__file__).parent.glob("*.md"))
    return {lesson.name: lesson for lesson in sorted(found, key=lambda lesson: (-lesson.minutes, lesson.title))}
