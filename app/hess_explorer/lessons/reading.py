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
    Text with $formulas$, words that light up a layer of a picture, like [stable cycle](omega/stable), and numbers
    that can be dragged, like [0.5](drag:h).
    ### Question
    ### Answer

`state` is a link of the page.  `example: Two limit`, the beginning of the name of an example of the scene, can replace
it.  A step without both keeps the state of the previous step.  The section "Try this" of a scene has steps two levels
down.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from hess_explorer.lessons.checks import problems_in
from hess_explorer.lessons.images import Images
from hess_explorer.lessons.lesson import Lesson, LessonError, LessonStep, StateLink
from hess_explorer.lessons.markdown import parser
from hess_explorer.lessons.settings import (
    animation_of,
    controls_of,
    corrections,
    enlarged_picture_of,
    example_of,
    hidden_layer_of,
    is_number,
    pictures_of,
    prediction_of,
    require_keys,
    state_of_link,
)
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

MAX_BYTES = 256 * 1024
MAX_STEPS = 200
TRY_THIS = "Try this"
KEYS = ("state", "example", "look", "pictures", "animate", "controls", "hide", "predict")
"""Names of the settings of a step."""
_MOST_MINUTES = 600.0
# The C parser is ten times as fast as the Python parser.
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_file(path: Path) -> Lesson:
    """Return the lesson in a file, named after the file.  Raises the first `LessonError` of an invalid lesson."""
    lesson, mistakes = examine(path)
    if lesson is None or mistakes:
        raise mistakes[0]
    return lesson


def examine(path: Path) -> tuple[Lesson | None, list[LessonError]]:
    """Return the lesson in a file as far as it is valid, and its mistakes, at most one in the settings of a step.

    Parameters
    ----------
    path : Path
        Markdown file.

    Returns
    -------
    lesson : Lesson or None
        The lesson, without steps whose settings are invalid; None if the file cannot be read.
    mistakes : list of LessonError
        The mistakes; empty for a valid lesson.
    """
    lesson = None
    try:
        lesson, mistakes = _read(_text(path), name_of(path), Images(path.parent))
        mistakes += corrections(lesson.steps)
    except LessonError as error:
        mistakes = [error]
    return lesson, [LessonError(one.message, one.line, path.name) for one in mistakes]


def name_of(path: Path) -> str:
    """Return the name of a lesson in links, from its file name."""
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
    """Return the lesson in a Markdown text, which may not have images.  Raises the first `LessonError`."""
    lesson, mistakes = _read(text, name, Images(None))
    if mistakes:
        raise mistakes[0]
    return lesson


def _read(text: str, name: str, images: Images) -> tuple[Lesson, list[LessonError]]:
    """Return the lesson in a text as far as it is valid, and its mistakes."""
    mistakes: list[LessonError] = []
    title, minutes = "", 0.0
    try:
        title, minutes = _facts(text)
    except LessonError as error:
        mistakes.append(error)
    steps = _steps(text, 2, None, images, mistakes)
    return Lesson(name, title, minutes, steps, images.urls), mistakes


def _facts(text: str) -> tuple[str, float]:
    """Return the title and the minutes in the front matter.  Raises `LessonError`."""
    first = next(iter(parser().parse(text)), None)
    if first is None or first.type != "front_matter":
        raise LessonError("the file must begin with front matter: the keys title and minutes between two lines ---.", 1)
    facts = _fields(first.content, 2, ("title", "minutes"))
    title, minutes = facts.get("title"), facts.get("minutes")
    if not isinstance(title, str) or not title.strip():
        raise LessonError("the front matter has no title; write one, like title: Two cycles are born.", 1)
    if not is_number(minutes) or not 0 < float(minutes) <= _MOST_MINUTES:
        why = f"minutes must be a positive number up to {_MOST_MINUTES:g}, like minutes: 20."
        raise LessonError(why, facts.line_of("minutes"))
    return title.strip(), float(minutes)


def read_suggestions(scene: Scene[Any]) -> Lesson | None:
    """Return the section "Try this" of a scene as a lesson, or None if it has none.  Raises `LessonError`."""
    lines = scene.words.split("\n")
    begin, end = _section(lines)
    if begin == end:
        return None
    # Keep the line numbers of the file for error messages.
    text = "\n" * (begin + 1) + "\n".join(lines[begin + 1 : end])
    mistakes: list[LessonError] = []
    steps = _steps(text, 4, StateLink(scene.name, scene.defaults()), Images(None), mistakes)
    if mistakes:
        raise mistakes[0]
    return Lesson(scene.name, f"{TRY_THIS}: {scene.title}", 0.0, steps)


def without_suggestions(words: str) -> str:
    """Return the text of a scene without the section "Try this"."""
    lines = words.split("\n")
    begin, end = _section(lines)
    return "\n".join([*lines[:begin], *lines[end:]])


def _section(lines: list[str]) -> tuple[int, int]:
    begin = next((i for i, line in enumerate(lines) if line.strip() == f"### {TRY_THIS}"), len(lines))
    return begin, next((i for i in range(begin + 1, len(lines)) if re.match(r"#{1,3} ", lines[i])), len(lines))


# ---- steps ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Part:
    """The text between two headings.

    Attributes
    ----------
    line : int
        Number of its first line, from 1.
    fences : tuple of (str, int)
        Content and first line of each code fence named `step`.
    """

    title: str
    text: str
    line: int
    fences: tuple[tuple[str, int], ...]


def _parts(text: str, level: int) -> Iterator[_Part]:
    """Yield the parts under the headings of one level."""
    lines = text.split("\n")
    tokens = [(token, token.map[0], token.map[1]) for token in parser().parse(text) if token.level == 0 and token.map]
    heads = [(begin, end) for token, begin, end in tokens if token.type == "heading_open" and token.tag == f"h{level}"]
    for (at, begin), (end, _) in zip(heads, [*heads[1:], (len(lines), 0)], strict=False):
        fences = []
        words = lines[begin:end]
        for token, first, last in tokens:
            if begin <= first < end and token.type == "fence" and token.info.split()[:1] == ["step"]:
                fences.append((token.content, first + 2))
                words[first - begin : last - begin] = [""] * (last - first)
        yield _Part(re.sub(r"^#+\s*|\s*#*$", "", lines[at].strip()), "\n".join(words), begin + 1, tuple(fences))


@dataclass(frozen=True)
class _Fields:
    """Settings by name, with their lines.

    Attributes
    ----------
    line : int
        Line of the first setting.
    """

    values: Mapping[str, Any] = field(default_factory=dict)
    lines: Mapping[str, int] = field(default_factory=dict)
    line: int = 1

    def get(self, name: str) -> Any:
        return self.values.get(name)

    def line_of(self, name: str) -> int:
        return self.lines.get(name, self.line)


def _fields(text: str, line: int, allowed: tuple[str, ...]) -> _Fields:
    """Return the settings in a YAML text that begins at a line."""
    written = [(re.match(r"([^\s:#][^:]*?)\s*:", one), number) for number, one in enumerate(text.split("\n"), line)]
    lines = {found[1].strip("\"'"): number for found, number in written if found}
    values = _yaml(text, line)
    wrong = next((str(key) for key in values if key not in allowed), "") if isinstance(values, dict) else ""
    return _Fields(require_keys(values, "this", allowed, lines.get(wrong, line)), lines, line)


def _yaml(text: str, line: int) -> Any:
    try:
        # Aliases could expand a short text to a huge structure.
        if any(isinstance(event, yaml.AliasEvent) for event in yaml.parse(text, _Loader)):
            raise LessonError("YAML references (*) are not supported: write the value out.", line)
        found = yaml.load(text, _Loader)
    except LessonError:
        raise
    except (yaml.YAMLError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        raise LessonError(
            f"this is not YAML ({getattr(error, 'problem', None) or 'it cannot be read'}): write one "
            f"“name: value” per line, and put links in quotes.",
            line + (mark.line if mark else 0),
        ) from error
    except RecursionError as error:
        raise LessonError("this YAML is nested too deeply: write it with fewer levels.", line) from error
    return {} if found is None else found


def _steps(
    text: str, level: int, place: StateLink | None, images: Images, mistakes: list[LessonError]
) -> tuple[LessonStep, ...]:
    """Return the steps under the headings of a level.

    Parameters
    ----------
    mistakes : list of LessonError
        Receives all mistakes; a step with invalid settings is omitted.
    """
    parts = list(_parts(text, level))
    steps: list[LessonStep] = []
    for part in parts[:MAX_STEPS]:
        step = None
        try:
            fields = _settings(part)
            place = _state(fields, place)
            step = _step(part, level + 1, fields, place)
        except LessonError as error:
            mistakes.append(error)
        scene = None if place is None else scenes()[place.scene]
        mistakes += problems_in(part.title, part.line - 1, images, scene)
        mistakes += problems_in(part.text, part.line, images, scene)
        # Without a first state, every other step would only report that its own state is missing.
        if place is None:
            break
        if step is not None:
            steps.append(step)
            place = step.state if step.prediction is None else step.prediction.outcome
    if not parts:
        mistakes.append(LessonError(f"there is no step: begin one with a heading, {'#' * level} Its title.", 1))
    if len(parts) > MAX_STEPS:
        mistakes.append(LessonError(f"there are {len(parts)} steps; at most {MAX_STEPS} are allowed.", 1))
    return tuple(steps)


def _settings(part: _Part) -> _Fields:
    for _, line in part.fences[1:]:
        raise LessonError("the step has two fences named step: keep one.", line - 1)
    return _fields(*part.fences[0], KEYS) if part.fences else _Fields(line=part.line)


def _state(fields: _Fields, place: StateLink | None) -> StateLink:
    """Return the state of a step, by default `place`, the state of the previous step."""
    get, line_of = fields.get, fields.line_of
    if "state" in fields.values:
        place = state_of_link(get("state"), line_of("state"))
    if "example" in fields.values:
        place = example_of(get("example"), place, line_of("example"))
    if place is None:
        example = 'state: "?scene=suslov-hess&h=1.5"'
        why = f"the first step needs a state: a link of the page, like {example}, in a fence named step."
        raise LessonError(why, fields.line)
    return place


def _step(part: _Part, level: int, fields: _Fields, place: StateLink) -> LessonStep:
    """Return a step; `level` is the level of the headings Question and Answer."""
    if not part.title:
        raise LessonError("the step has no title: write one after #.", part.line - 1)
    get, line_of = fields.get, fields.line_of
    scene = scenes()[place.scene]
    animation = animation_of(get("animate"), scene, line_of("animate"))
    text, question, answer = _words(part, level)
    return LessonStep(
        part.title,
        text,
        place,
        enlarged_picture_of(get("look"), scene, line_of("look")),
        animation,
        question,
        answer,
        prediction_of(get("predict"), place, line_of("predict")),
        controls_of(get("controls"), animation, scene, line_of("controls")),
        hidden_layer_of(get("hide"), scene, line_of("hide")),
        pictures_of(get("pictures"), scene, line_of("pictures")),
        part.line - 1,
    )


def _words(part: _Part, level: int) -> tuple[str, str, str]:
    """Return the text, the question and the answer of a step."""
    parts = list(_parts(part.text, level))
    lines = [part.line + one.line - 2 for one in parts]
    for one, line in zip(parts, lines, strict=True):
        if one.title.lower() not in ("question", "answer"):
            why = f"{one.title[:40]!r} is not a part of a step: use only the headings Question and Answer."
            raise LessonError(why, line)
    texts = {one.title.lower(): one.text.strip() for one in parts}
    if len(texts) == 1:
        why = "a step needs both a question and an answer, or neither: add the missing heading."
        raise LessonError(why, lines[0])
    text = "\n".join(part.text.split("\n")[: parts[0].line - 2]) if parts else part.text
    return text.strip(), texts.get("question", ""), texts.get("answer", "")
