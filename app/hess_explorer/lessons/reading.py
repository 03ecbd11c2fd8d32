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

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeGuard
from urllib.parse import parse_qsl, urlsplit

import yaml
from markdown_it.token import Token

from hess_explorer.lessons.lesson import (
    TIME,
    Animation,
    HiddenLayer,
    Lesson,
    LessonError,
    LessonStep,
    Prediction,
    StateLink,
)
from hess_explorer.lessons.markdown import parser, to_html
from hess_explorer.protocol.parameters import MAX_QUERY, PAGE_KEYS, Choice, Number, decode, refusal
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views.layers import Layer
from hess_explorer.views.plot import Plot

__all__ = ["MAX_BYTES", "MAX_STEPS", "TRY_THIS", "read", "read_file", "read_tries", "without_tries"]

MAX_BYTES = 256 * 1024
MAX_STEPS = 200
TRY_THIS = "Try this"
_MOST_MINUTES, _MOST_SECONDS, _MOST_TIME = 600.0, 600.0, 1e6
_KEYS = ("state", "example", "look", "animate", "controls", "hide", "predict")
_MOST_CONTROLS = 6
# Layers on canvases of the page, which are always shown.
_PAINTED = ("image", "dots")
_CURVES, _POINTS = ("multi_line", "line"), ("scatter",)


def read_file(path: Path) -> Lesson:
    """Return the lesson in a file, named after the file.  Raises `LessonError`."""
    try:
        with path.open("rb") as file:
            raw = file.read(MAX_BYTES + 1)
        if len(raw) > MAX_BYTES:
            raise LessonError(f"the file has more than {MAX_BYTES // 1024} kB; make two lessons of it.", 1)
        name = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-") or "lesson"
        return read(raw.decode("utf-8-sig"), name)
    except OSError as error:
        raise LessonError(f"the file cannot be read: {error.strerror or error}.", 1, path.name) from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise LessonError("the text is not in UTF-8: save the file in that encoding.", line, path.name) from error
    except LessonError as error:
        raise LessonError(error.message, error.line, path.name) from error


def read(text: str, name: str) -> Lesson:
    """Return the lesson in a Markdown text.  Raises `LessonError`."""
    first = next(iter(parser().parse(text)), None)
    if first is None or first.type != "front_matter":
        raise LessonError("the file begins with front matter: --- above and below title: and minutes:.", 1)
    facts = _fields(first.content, 2, ("title", "minutes"))
    title, minutes = facts.get("title"), facts.get("minutes")
    if not isinstance(title, str) or not title.strip():
        raise LessonError("the front matter has no title; write one, like title: Two cycles are born.", 1)
    if not _is_number(minutes) or not 0 < float(minutes) <= _MOST_MINUTES:
        raise LessonError(f"minutes is a number up to {_MOST_MINUTES:g}, like minutes: 20.", 1)
    return Lesson(name, title.strip(), float(minutes), _steps(text, 2, None))


def read_tries(scene: Scene[Any]) -> Lesson | None:
    """Return the section "Try this" of a scene as a lesson, or None if it has none.  Raises `LessonError`."""
    lines = scene.words.split("\n")
    begin, end = _section(lines)
    if begin == end:
        return None
    # Keep the line numbers of the file, for error messages.
    text = "\n" * (begin + 1) + "\n".join(lines[begin + 1 : end])
    steps = _steps(text, 4, StateLink(scene.name, scene.defaults()))
    return Lesson(scene.name, f"{TRY_THIS}: {scene.title}", 0.0, steps)


def without_tries(words: str) -> str:
    """Return the text of a scene without the section "Try this"."""
    lines = words.split("\n")
    begin, end = _section(lines)
    return "\n".join([*lines[:begin], *lines[end:]])


def _section(lines: list[str]) -> tuple[int, int]:
    begin = next((i for i, line in enumerate(lines) if line.strip() == f"### {TRY_THIS}"), len(lines))
    return begin, next((i for i in range(begin + 1, len(lines)) if re.match(r"#{1,3} ", lines[i])), len(lines))


# ---- the parts of a text ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Part:
    """The text from a heading to the next one; line : number of its first line, from 1."""

    title: str
    text: str
    line: int
    fields: str | None = None
    fields_line: int = 0


def _parts(text: str, tag: str) -> Iterator[_Part]:
    """Yield the parts under the headings of one level, with the contents of their `step` fences."""
    lines = text.split("\n")
    tokens = [token for token in parser().parse(text) if token.level == 0]
    heads = [
        (token.map[0], token.map[1])
        for token in tokens
        if token.type == "heading_open" and token.tag == tag and token.map
    ]
    for (at, begin), (end, _) in zip(heads, [*heads[1:], (len(lines), 0)], strict=False):
        inside = [token for token in tokens if token.map and begin <= token.map[0] < end]
        fences = [token for token in inside if _is_fence(token)]
        if len(fences) > 1:
            raise LessonError("this is the second fence named step of one step: leave one.", _line(fences[1]))
        kept = list(lines[begin:end])
        for token in fences:
            assert token.map
            kept[token.map[0] - begin : token.map[1] - begin] = [""] * (token.map[1] - token.map[0])
        yield _Part(
            re.sub(r"^#+\s*|\s*#*$", "", lines[at].strip()),
            "\n".join(kept),
            begin + 1,
            fences[0].content if fences else None,
            _line(fences[0]) + 1 if fences else 0,
        )


def _is_fence(token: Token) -> bool:
    return token.type == "fence" and token.info.split()[:1] == ["step"]


def _line(token: Token) -> int:
    assert token.map
    return token.map[0] + 1


def _fields(text: str, line: int, allowed: tuple[str, ...]) -> dict[str, Any]:
    """Return a YAML mapping, whose keys must be among the allowed ones."""
    try:
        # Aliases could expand a short text to a huge structure.
        if any(isinstance(event, yaml.AliasEvent) for event in yaml.parse(text, yaml.SafeLoader)):
            raise LessonError("references with * are not read here: write it out.", line)
        found = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        raise LessonError(
            f"this is not YAML ({getattr(error, 'problem', None) or 'it cannot be read'}): write one "
            f"“name: value” in a line, and quotes round a link.",
            line + (mark.line if mark else 0),
        ) from error
    except RecursionError as error:
        raise LessonError("this is nested too deeply.", line) from error
    if found is None:
        return {}
    return _only(found, line, "this", allowed)


def _only(found: Any, line: int, what: str, allowed: tuple[str, ...]) -> dict[str, Any]:
    if not isinstance(found, dict) or not all(isinstance(key, str) for key in found):
        raise LessonError(f"{what} is not a list of names with values: allowed are {', '.join(allowed)}.", line)
    unknown = [key for key in found if key not in allowed]
    if unknown:
        raise LessonError(f"{unknown[0][:40]!r} means nothing here: allowed are {', '.join(allowed)}.", line)
    return found


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


# ---- steps ----------------------------------------------------------------------------------------------------------


def _steps(text: str, level: int, place: StateLink | None) -> tuple[LessonStep, ...]:
    steps: list[LessonStep] = []
    for part in _parts(text, f"h{level}"):
        step = _step(part, f"h{level + 1}", place)
        steps.append(step)
        place = step.at if step.prediction is None else step.prediction.then
    if not steps:
        raise LessonError(f"there is no step: begin one with a heading, {'#' * level} Its title.", 1)
    if len(steps) > MAX_STEPS:
        raise LessonError(f"there are {len(steps)} steps; at most {MAX_STEPS} are allowed.", 1)
    return tuple(steps)


def _step(part: _Part, tag: str, place: StateLink | None) -> LessonStep:
    if not part.title:
        raise LessonError("the step has no title: write one after the signs #.", part.line - 1)
    fields = {} if part.fields is None else _fields(part.fields, part.fields_line, _KEYS)
    line = part.fields_line or part.line
    if "state" in fields:
        place = _place(fields["state"], line)
    if "example" in fields:
        place = _example(fields["example"], place, line)
    if place is None:
        raise LessonError(
            'the first step needs a state: a link of the page, like state: "?scene=suslov-hess&h=1.5", '
            "in a fence named step.",
            line,
        )
    scene = scenes()[place.scene]
    look = fields.get("look", "")
    if look != "" and look not in scene.pictures:
        raise LessonError(_not_one("look", look, scene.pictures), line)
    animation = _animation(fields.get("animate"), scene, line)
    text, asked = _split(part, tag)
    step = LessonStep(
        part.title,
        text,
        place,
        look,
        animation,
        **asked,
        controls=_controls(fields.get("controls"), animation, scene, line),
        hide=_hidden(fields.get("hide"), scene, line),
        prediction=_prediction(fields.get("predict"), place, line),
    )
    for words, first in (
        (step.title, part.line - 1),
        (step.text, part.line),
        (step.question, part.line),
        (step.answer, part.line),
    ):
        to_html(words, first)
    return replace(step, text=step.text.strip())


def _split(part: _Part, tag: str) -> tuple[str, dict[str, str]]:
    """Return the text before the question, and a mapping with "question" and "answer"."""
    found = {one.title.lower(): one for one in _parts(part.text, tag)}
    extra = [one for name, one in found.items() if name not in ("question", "answer")]
    if extra:
        raise LessonError(
            f"{extra[0].title[:40]!r} is no part of a step: headings in it are Question and Answer.",
            part.line + extra[0].line - 2,
        )
    if ("question" in found) != ("answer" in found):
        raise LessonError(
            "a question needs an answer, and an answer a question: write both headings.",
            part.line + next(iter(found.values())).line - 2,
        )
    if not found:
        return part.text, {}
    lines = part.text.split("\n")
    return "\n".join(lines[: min(one.line for one in found.values()) - 2]), {
        name: one.text.strip() for name, one in found.items()
    }


def _not_one(what: str, given: object, allowed: tuple[str, ...]) -> str:
    return f"{what} is one of {', '.join(allowed)}, not {str(given)[:40]!r}."


def _place(link: object, line: int) -> StateLink:
    """Return the state of a link, each value within its bounds."""
    query = urlsplit(link).query if isinstance(link, str) else ""
    given = dict(parse_qsl(query, keep_blank_values=True))
    scene = scenes().get(given.get("scene", ""))
    if scene is None:
        raise LessonError(
            "state is a link of this page with its scene, one of "
            f"{', '.join(name for name, one in scenes().items() if one.origin is None)}.",
            line,
        )
    if len(query) > MAX_QUERY:
        raise LessonError(f"the link is longer than {MAX_QUERY} characters.", line)
    names = tuple(spec.name for spec in scene.specs)
    unknown = [name for name in given if name not in names and name not in PAGE_KEYS]
    if unknown:
        raise LessonError(
            f"the link has {unknown[0][:40]!r}, which the scene {scene.name} does not: allowed are {', '.join(names)}.",
            line,
        )
    values, notes = decode(query, scene.specs)
    if notes:
        raise LessonError(f"the link cannot be followed as it is. {refusal(notes[0])}", line)
    return StateLink(scene.name, values)


def _example(begins: object, place: StateLink | None, line: int) -> StateLink:
    """Return the state of the example whose name begins with this text."""
    scene = next(iter(scenes().values())) if place is None else scenes()[place.scene]
    found = [one for one in scene.presets if isinstance(begins, str) and begins and one.name.startswith(begins)]
    if len(found) != 1:
        raise LessonError(
            _not_one(
                f"example is the beginning of just one of the examples of {scene.name}; it",
                begins,
                tuple(preset.name for preset in scene.presets),
            ),
            line,
        )
    return StateLink(scene.name, scene.defaults() | scene.example(found[0]))


def _animation(found: object, scene: Scene[Any], line: int) -> Animation | None:
    if found is None:
        return None
    names = ("name", "from", "to", "seconds")
    given = _only(found, line, "animate", names)
    if any(name not in given for name in names):
        raise LessonError(
            "animate needs name, from, to and seconds, like {name: h, from: 0.2, to: 1.5, seconds: 8}.", line
        )
    bounds = {TIME: (0.0, _MOST_TIME), **{spec.name: spec.bounds for spec in scene.specs if isinstance(spec, Number)}}
    name = given["name"]
    if not isinstance(name, str) or name not in bounds:
        raise LessonError(_not_one("name of animate", name, tuple(bounds)), line)
    low, high = bounds[name]
    if not all(_is_number(given[end]) and low <= given[end] <= high for end in ("from", "to")):
        raise LessonError(f"from and to of {name} are numbers from {low:g} to {high:g}.", line)
    if not _is_number(given["seconds"]) or not 0 < given["seconds"] <= _MOST_SECONDS:
        raise LessonError(f"seconds is a number up to {_MOST_SECONDS:g}.", line)
    return Animation(name, float(given["from"]), float(given["to"]), float(given["seconds"]))


def _controls(found: object, animation: Animation | None, scene: Scene[Any], line: int) -> tuple[str, ...]:
    """Return the names of the controls beside the text; by default that of the animated parameter."""
    if found is None:
        return (animation.name,) if animation and animation.name != TIME else ()
    if not isinstance(found, list) or len(found) > _MOST_CONTROLS:
        raise LessonError(f"controls is a list of at most {_MOST_CONTROLS} names, like controls: [h, f].", line)
    names = tuple(spec.name for spec in scene.specs if isinstance(spec, Number | Choice))
    for name in found:
        if name not in names:
            raise LessonError(_not_one("a name in controls", name, names), line)
    return tuple(dict.fromkeys(found))


def _hidden(found: object, scene: Scene[Any], line: int) -> HiddenLayer | None:
    if found is None:
        return None
    plot, layer = _layer(_only(found, line, "hide", ("picture", "layer")), "hide", scene, line)
    return HiddenLayer(plot.name, layer.name, plot.source_of(layer))


def _prediction(found: object, place: StateLink, line: int) -> Prediction | None:
    if found is None:
        return None
    given = _only(found, line, "predict", ("picture", "layer", "then"))
    then = _place(given["then"], line) if "then" in given else place
    if then.scene != place.scene:
        raise LessonError(f"what is revealed is a state of the same scene, {place.scene}.", line)
    plot, layer = _layer(given, "predict", scenes()[place.scene], line, (*_CURVES, *_POINTS))
    return Prediction(
        plot.name,
        layer.name,
        plot.source_of(layer),
        (layer.columns[0], layer.columns[1]),
        "curve" if layer.glyph in _CURVES else "point",
        then,
    )


def _layer(
    given: dict[str, Any], key: str, scene: Scene[Any], line: int, glyphs: tuple[str, ...] | None = None
) -> tuple[Plot[Any], Layer[Any]]:
    """Return the picture and the layer that a mapping names; glyphs : the allowed kinds of layers, by default all."""
    plots = {view.name: view for view in scene.views if isinstance(view, Plot)}
    name = given.get("picture")
    if not isinstance(name, str) or name not in plots:
        raise LessonError(_not_one(f"picture of {key}", name, tuple(plots)), line)
    layers = {
        layer.name: layer
        for layer in plots[name].layers
        if (layer.glyph not in _PAINTED if glyphs is None else layer.glyph in glyphs)
    }
    truth = given.get("layer")
    if not isinstance(truth, str) or truth not in layers:
        raise LessonError(_not_one(f"layer of {key}", truth, tuple(layers)), line)
    return plots[name], layers[truth]
