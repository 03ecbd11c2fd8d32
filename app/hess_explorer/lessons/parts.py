"""Divide a lesson's Markdown into steps, and these into text, question, answer and settings."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml
from markdown_it.token import Token

from hess_explorer.lessons.lesson import LessonError
from hess_explorer.lessons.markdown import parser
from hess_explorer.lessons.problems import Problems
from hess_explorer.lessons.settings import only

__all__ = ["Fields", "Part", "fields_of", "parts_of"]


@dataclass(frozen=True)
class Part:
    """The text from a heading to the next one; line : number of its first line, from 1."""

    title: str
    text: str
    line: int
    fields: str | None = None
    fields_line: int = 0


def parts_of(text: str, tag: str, problems: Problems) -> Iterator[Part]:
    """Yield the parts under the headings of one level, with the contents of their first `step` fences."""
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
        for token in fences[1:]:
            message = "the step has two fences named step: keep one."
            problems.add(message, _line(token))
        kept = list(lines[begin:end])
        for token in fences:
            assert token.map
            kept[token.map[0] - begin : token.map[1] - begin] = [""] * (token.map[1] - token.map[0])
        yield Part(
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


@dataclass(frozen=True)
class Fields:
    """Settings by name, with their lines; line : first line of all."""

    values: Mapping[str, Any] = field(default_factory=dict)
    lines: Mapping[str, int] = field(default_factory=dict)
    line: int = 1

    def get(self, name: str) -> Any:
        """Return a setting, None if it is not there."""
        return self.values.get(name)

    def line_of(self, name: str) -> int:
        """Return the line of a setting, the first line of all if it is not there."""
        return self.lines.get(name, self.line)


def fields_of(text: str, line: int, allowed: tuple[str, ...], problems: Problems) -> Fields:
    """Return the settings in a YAML text that begins at a line; those that are not allowed are left out."""
    values = problems.attempt({}, _yaml, text, line)
    written = [(re.match(r"([^\s:#][^:]*?)\s*:", one), number) for number, one in enumerate(text.split("\n"), line)]
    lines = {found[1].strip("\"'"): number for found, number in written if found}
    if not isinstance(values, dict):
        problems.attempt({}, only, values, line, "this", allowed, problems)
        return Fields(line=line)
    kept: dict[str, Any] = {}
    for key, value in values.items():
        kept |= only({key: value}, lines.get(str(key), line), "this", allowed, problems)
    return Fields(kept, lines, line)


# The parser in C takes a tenth of the time of that in Python.
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def _yaml(text: str, line: int) -> Any:
    try:
        # Aliases could expand a short text to a huge structure.
        if any(isinstance(event, yaml.AliasEvent) for event in yaml.parse(text, _Loader)):
            raise LessonError("YAML references (*) are not supported: write the value out.", line)
        found = yaml.load(text, _Loader)
    except (yaml.YAMLError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        raise LessonError(
            f"this is not YAML ({getattr(error, 'problem', None) or 'it cannot be read'}): write one "
            f"“name: value” in a line, and quotes round a link.",
            line + (mark.line if mark else 0),
        ) from error
    except RecursionError as error:
        raise LessonError("this YAML is nested too deeply.", line) from error
    return {} if found is None else found
