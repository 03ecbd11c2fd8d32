"""Links to states of scenes, as the lessons and their texts contain them."""

from __future__ import annotations

from urllib.parse import parse_qsl, urlsplit

from hess_explorer.lessons.lesson import LessonError, StateLink
from hess_explorer.protocol.parameters import MAX_QUERY, PAGE_KEYS, decode, refusal
from hess_explorer.scenes import scenes

__all__ = ["example_of", "not_one_of", "place_of"]


def not_one_of(what: str, given: object, allowed: tuple[str, ...]) -> str:
    """Return the message that a value is not allowed, with those that are."""
    return f"{what} must be one of {', '.join(allowed)}, not {str(given)[:40]!r}."


def place_of(link: object, line: int) -> StateLink:
    """Return the state of a link, each value within its bounds."""
    query = urlsplit(link).query if isinstance(link, str) else ""
    given = dict(parse_qsl(query, keep_blank_values=True))
    scene = scenes().get(given.get("scene", ""))
    if scene is None:
        raise LessonError(
            "a link of this page needs a scene, one of "
            f"{', '.join(name for name, one in scenes().items() if one.origin is None)}.",
            line,
        )
    if len(query) > MAX_QUERY:
        raise LessonError(f"the link is longer than {MAX_QUERY} characters.", line)
    names = tuple(spec.name for spec in scene.specs)
    unknown = [name for name in given if name not in names and name not in PAGE_KEYS]
    if unknown:
        raise LessonError(
            f"the scene {scene.name} has no parameter {unknown[0][:40]!r}: choose from {', '.join(names)}.",
            line,
        )
    values, notes = decode(query, scene.specs)
    if notes:
        raise LessonError(f"the link is not valid. {refusal(notes[0])}", line)
    return StateLink(scene.name, values)


def example_of(begins: object, place: StateLink | None, line: int) -> StateLink:
    """Return the state of the example whose name begins with this text."""
    scene = next(iter(scenes().values())) if place is None else scenes()[place.scene]
    found = [one for one in scene.presets if isinstance(begins, str) and begins and one.name.startswith(begins)]
    if len(found) != 1:
        raise LessonError(
            not_one_of(
                f"example must match the beginning of exactly one example of {scene.name}; it",
                begins,
                tuple(preset.name for preset in scene.presets),
            ),
            line,
        )
    return StateLink(scene.name, scene.defaults() | scene.example(found[0]))
