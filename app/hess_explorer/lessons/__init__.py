"""Lessons: the Markdown files of this package, and the "Try this" sections of the scenes."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.lessons.reading import read, read_suggestions
from hess_explorer.scenes import scenes


@cache
def package_lessons() -> Mapping[str, Lesson]:
    """Return the lessons of this package by name, the longest first."""
    found = (read(path.read_text("utf-8"), path.stem) for path in Path(__file__).parent.glob("*.md"))
    return {lesson.name: lesson for lesson in sorted(found, key=lambda lesson: (-lesson.minutes, lesson.title))}


@cache
def suggestions() -> Mapping[str, Lesson]:
    """Return the "Try this" section of each scene that has one, by scene, except for "Speed and accuracy" scenes."""
    found = {scene.name: read_suggestions(scene) for scene in scenes().values() if scene.origin is None}
    return {name: lesson for name, lesson in found.items() if lesson is not None}
