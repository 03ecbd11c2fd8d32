"""Review a lesson: states that its scenes would correct, and sliders that a step names without showing them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from hess_explorer.lessons.lesson import TIME, Lesson, LessonError, LessonStep, StateLink
from hess_explorer.protocol.parameters import Number, Value
from hess_explorer.scenes import scenes
from hess_explorer.views.text import digits

__all__ = ["corrections", "hints"]

# The request to change a value, at the beginning of a sentence or clause.
_ASKED = re.compile(
    r"(?:^|[.:;?!,]\s|\b(?:and|then)\s)(?:change|increase|lower|move|raise|turn|vary)\s[^.?!]*", re.IGNORECASE
)


def corrections(steps: Iterable[LessonStep]) -> Iterator[LessonError]:
    """Yield the states that the scene would change, as a mistake with the nearest valid values."""
    for step in steps:
        for what, place in _places(step):
            scene = scenes()[place.scene]
            values, notes = scene.admit(place.values)
            changed = ", ".join(
                f"{spec.name} = {_short(values[spec.name])}"
                for spec in scene.specs
                if values[spec.name] != place.values[spec.name]
            )
            if notes:
                yield LessonError(f"{what} is not possible: choose {changed}. {' '.join(notes)}", step.line)


def _places(step: LessonStep) -> Iterator[tuple[str, StateLink]]:
    """Yield the states that a step shows, with their names."""
    yield "the state of this step", step.at
    if step.prediction:
        yield "the state of predict", step.prediction.then
    if step.animation and step.animation.name != TIME:
        for end in (step.animation.start, step.animation.end):
            yield "an end of animate", StateLink(step.at.scene, {**step.at.values, step.animation.name: end})


def _short(value: Value) -> str:
    return digits(value, 6) if isinstance(value, float) else value


def hints(lesson: Lesson) -> Iterator[LessonError]:
    """Yield the parameters that a step without controls asks to change: a phone does not show their sliders."""
    for step in lesson.steps:
        if step.controls:
            continue
        asked = " ".join(found[0] for text in (step.text, step.question) for found in _ASKED.finditer(text))
        # As the names of parameters are written: I_{13} is I13.
        formulas = re.sub(r"[_{}\\]", "", " ".join(re.findall(r"\$([^$]+)\$", asked)))
        words = set(re.findall(r"\w+", formulas))
        names = [
            spec.name
            for spec in scenes()[step.at.scene].specs
            if isinstance(spec, Number) and ({spec.name, spec.symbol} & words or spec.label.lower() in asked.lower())
        ]
        if names:
            yield LessonError(
                f"the text asks to change {', '.join(names)}, whose sliders a phone does not show: "
                f"add controls: [{', '.join(names)}].",
                step.line,
            )
