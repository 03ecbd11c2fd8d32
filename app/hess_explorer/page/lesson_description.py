"""Descriptions of lessons for the browser, each sent once."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from hess_explorer.lessons.lesson import Lesson, LessonStep
from hess_explorer.lessons.markdown import to_html


@cache
def describe_lesson(lesson: Lesson) -> str:
    """Return the description of a lesson as JSON, which all sessions share."""
    return json.dumps({"name": lesson.name, "title": lesson.title, "minutes": lesson.minutes, "steps": steps(lesson)})


def steps(lesson: Lesson | None) -> list[dict[str, Any]]:
    """Return the descriptions of the steps of a lesson; empty without a lesson."""
    return [_step(step, lesson.images) for step in lesson.steps] if lesson else []


def _step(step: LessonStep, images: Mapping[str, str]) -> dict[str, Any]:
    found: dict[str, Any] = {
        "title": to_html(step.title, inline=True),
        "text": to_html(step.text, images),
        "scene": step.state.scene,
        "look": step.enlarged_picture,
        "pictures": step.pictures,
        "question": to_html(step.question, images),
        "answer": to_html(step.answer, images),
        "controls": step.controls,
    }
    if step.animation:
        found["animation"] = dataclasses.asdict(step.animation)
    if step.hidden_layer:
        found["hide"] = dataclasses.asdict(step.hidden_layer)
    if step.prediction:
        asked = step.prediction
        found["prediction"] = {
            "picture": asked.picture,
            "source": asked.source,
            "columns": asked.columns,
            "what": asked.kind,
        }
    return found
