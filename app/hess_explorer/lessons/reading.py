"""Read a lesson from a Markdown file.

The front matter has `title` and `minutes`.  Each heading of the second level begins a step.  A code fence named `step`
contains its settings as YAML; the headings "Question" and "Answer" one level down are optional:

    ---
    title: Two cycles are born
    minutes: 10
    ---
    ## Across the line
    ```step
    state: "?scene=suslov-hess&h=0.2&f=0.5"
    look: circle
    pictures: [circle, omega]
    animate: {name: h, from: 0.2, to: 1.5, seconds: 8}
    controls: [h, f]
    hide: {picture: omega, layer: stable}
    predict: {picture: circle, layer: stable, then: "?scene=suslov-hess&h=1.5&f=0.6"}
    ```
    Text with $formulas$.
    ### Question
    ### Answer

`state` is a link of the page.  `example: Two limit`, the beginning of the name of an example of the scene, can replace
it.  A step without both keeps the state of the previous step.  The section "Try this" of a scene has steps two levels
down.
"""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

from hess_explorer.lessons.checks import problems_in
from hess_explorer.lessons.images import Images
from hess_explorer.lessons.lesson import Lesson, LessonError, LessonStep, StateLink
from hess_explorer.lessons.links import example_of, place_of
from hess_explorer.lessons.markdown import parser
from hess_explorer.lessons.parts import Fields, Part, fields_of, parts_of
from hess_explorer.lessons.problems import Problems
from hess_explorer.lessons.review import corrections
from hess_explorer.lessons.settings import (
    animation_of,
    controls_of,
    hidden_of,
    is_number,
    look_of,
    names_of,
    prediction_of,
)
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

__all__ = [
    "KEYS",
    "MAX_BYTES",
    "MAX_STEPS",
    "TRY_THIS",
    "examine",
    "name_of",
    "read",
    "read_file",
    "read_tries",
    "without_tries",
]

MAX_BYTES = 256 * 1024
MAX_STEPS = 200
TRY_THIS = "Try this"
KEYS = ("state", "example", "look", "pictures", "animate", "controls", "hide", "predict")
"""Names of the settings of a step."""
_MOST_MINUTES = 600.0


def read_file(path: Path) -> Lesson:
    """Return the lesson in a file, named after the file.  Raises `LessonError`."""
    lesson, problems = examine(path)
    if lesson is None or problems:
        raise problems[0]
    return lesson


def examine(path: Path) -> tuple[Lesson | None, list[LessonError]]:
    """Return the lesson in a file as far as it can be read, and all mistakes, the one to begin with first."""
    problems = Problems()
    text = problems.attempt(None, _text, path)
    lesson = None if text is None else _read(text, name_of(path), Images(path.parent), problems)
    problems.found += [] if lesson is None else corrections(lesson.steps)
    return lesson, [LessonError(one.message, one.line, path.name) for one in problems.found]


def name_of(path: Path) -> str:
    """Return the name in links of the lesson in a file."""
    return re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-") or "lesson"


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            raw = file.read(MAX_BYTES + 1)
        if len(raw) > MAX_BYTES:
            raise LessonError(f"the file has more than {MAX_BYTES // 1024} kB; make two lessons of it.", 1)
        return raw.decode("utf-8-sig")
    except OSError as error:
        raise LessonError(f"the file cannot be read: {error.strerror or error}.", 1) from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise LessonError("the text is not in UTF-8: save the file in that encoding.", line) from error


def read(text: str, name: str) -> Lesson:
    """Return the lesson in a Markdown text, which has no images.  Raises `LessonError`."""
    problems = Problems()
    lesson = _read(text, name, Images(None), problems)
    problems.raise_first()
    return lesson


def _read(text: str, name: str, images: Images, problems: Problems) -> Lesson:
    """Return the lesson in a text as far as it can be read."""
    first = next(iter(parser().parse(text)), None)
    title, minutes = "", 0.0
    if first is None or first.type != "front_matter":
        problems.add("the file must begin with front matter: the keys title and minutes between two lines ---.", 1)
    else:
        facts = fields_of(first.content, 2, ("title", "minutes"), problems)
        title = problems.attempt("", _title, facts)
        minutes = problems.attempt(0.0, _minutes, facts)
    steps = _steps(text, 2, None, images, problems)
    return Lesson(name, title, minutes, steps, images.urls)


def _title(facts: Fields) -> str:
    title = facts.get("title")
    if not isinstance(title, str) or not title.strip():
        raise LessonError("the front matter has no title; write one, like title: Two cycles are born.", 1)
    return title.strip()


def _minutes(facts: Fields) -> float:
    minutes = facts.get("minutes")
    if not is_number(minutes) or not 0 < float(minutes) <= _MOST_MINUTES:
        raise LessonError(
            f"minutes must be a positive number up to {_MOST_MINUTES:g}, like minutes: 20.", facts.line_of("minutes")
        )
    return float(minutes)


def read_tries(scene: Scene[Any]) -> Lesson | None:
    """Return the section "Try this" of a scene as a lesson, or None if it has none.  Raises `LessonError`."""
    lines = scene.words.split("\n")
    begin, end = _section(lines)
    if begin == end:
        return None
    # Keep the line numbers of the file, for error messages.
    text = "\n" * (begin + 1) + "\n".join(lines[begin + 1 : end])
    problems = Problems()
    steps = _steps(text, 4, StateLink(scene.name, scene.defaults()), Images(None), problems)
    problems.raise_first()
    return Lesson(scene.name, f"{TRY_THIS}: {scene.title}", 0.0, steps)


def without_tries(words: str) -> str:
    """Return the text of a scene without the section "Try this"."""
    lines = words.split("\n")
    begin, end = _section(lines)
    return "\n".join([*lines[:begin], *lines[end:]])


def _section(lines: list[str]) -> tuple[int, int]:
    begin = next((i for i, line in enumerate(lines) if line.strip() == f"### {TRY_THIS}"), len(lines))
    return begin, next((i for i in range(begin + 1, len(lines)) if re.match(r"#{1,3} ", lines[i])), len(lines))


# ---- steps ----------------------------------------------------------------------------------------------------------


def _steps(
    text: str, level: int, place: StateLink | None, images: Images, problems: Problems
) -> tuple[LessonStep, ...]:
    steps: list[LessonStep] = []
    parts = list(parts_of(text, f"h{level}", problems))
    for part in parts[:MAX_STEPS]:
        step = problems.attempt(None, _step, part, f"h{level + 1}", place, images, problems)
        if step is not None:
            steps.append(step)
            place = step.at if step.prediction is None else step.prediction.then
    if not parts:
        problems.add(f"there is no step: begin one with a heading, {'#' * level} Its title.", 1)
    if len(parts) > MAX_STEPS:
        problems.add(f"there are {len(parts)} steps; at most {MAX_STEPS} are allowed.", 1)
    return tuple(steps)


def _step(part: Part, tag: str, before: StateLink | None, images: Images, problems: Problems) -> LessonStep | None:
    """Return a step, None if it has no state; before : the state of the step before."""
    if not part.title:
        problems.add("the step has no title: write one after #.", part.line - 1)
    fields = Fields() if part.fields is None else fields_of(part.fields, part.fields_line, KEYS, problems)
    words, asked = _split(part, tag, problems)
    for text, line in ((part.title, part.line - 1), *((one.text, one.line) for one in (words, *asked.values()))):
        problems.found += [*problems_in(text, line, images, partial(place_of, problems=problems))]
    place = _state(fields, part.fields_line or part.line, before, problems)
    if place is None:
        return None
    scene = scenes()[place.scene]
    line_of = fields.line_of
    animation = problems.attempt(None, animation_of, fields.get("animate"), scene, line_of("animate"), problems)
    question, answer = (asked[name].text.strip() if name in asked else "" for name in ("question", "answer"))
    return LessonStep(
        part.title,
        words.text.strip(),
        place,
        problems.attempt("", look_of, fields.get("look"), scene, line_of("look")),
        animation,
        question,
        answer,
        problems.attempt(None, prediction_of, fields.get("predict"), place, line_of("predict"), problems),
        problems.attempt((), controls_of, fields.get("controls"), animation, scene, line_of("controls"), problems),
        problems.attempt(None, hidden_of, fields.get("hide"), scene, line_of("hide"), problems),
        names_of(fields.get("pictures"), "pictures", scene.pictures, line_of("pictures"), problems),
        part.line - 1,
    )


def _state(fields: Fields, line: int, before: StateLink | None, problems: Problems) -> StateLink | None:
    """Return the state of a step, None if there is none."""
    place, had = before, len(problems.found)
    if "state" in fields.values:
        place = place_of(fields.get("state"), fields.line_of("state"), problems) or before
    if "example" in fields.values:
        place = problems.attempt(place, example_of, fields.get("example"), place, fields.line_of("example"))
    if place is None and len(problems.found) == had:
        raise LessonError(
            'the first step needs a state: a link of the page, like state: "?scene=suslov-hess&h=1.5", '
            "in a fence named step.",
            line,
        )
    return place


def _split(part: Part, tag: str, problems: Problems) -> tuple[Part, dict[str, Part]]:
    """Return the text before the question, and a mapping with "question" and "answer"."""
    found = {
        one.title.lower(): Part(one.title, one.text, part.line + one.line - 1)
        for one in parts_of(part.text, tag, problems)
    }
    for name, one in found.items():
        if name not in ("question", "answer"):
            problems.add(
                f"{one.title[:40]!r} is not a part of a step: use only the headings Question and Answer.",
                one.line - 1,
            )
    asked = {name: one for name, one in found.items() if name in ("question", "answer")}
    if len(asked) == 1:
        problems.add(
            "a step needs both a question and an answer, or neither: add the missing heading.",
            next(iter(asked.values())).line - 1,
        )
    if not found:
        return part, {}
    end = min(one.line for one in found.values()) - part.line - 1
    return Part(part.title, "\n".join(part.text.split("\n")[:end]), part.line), asked
