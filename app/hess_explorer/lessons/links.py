"""Links to states of scenes, as the lessons and their texts contain them."""

from __future__ import annotations

from collections.abc import Sequence
from urllib.parse import urlsplit

from hess_explorer.lessons.lesson import LessonError, StateLink
from hess_explorer.lessons.problems import Problems
from hess_explorer.protocol.parameters import Link, refusal
from hess_explorer.scenes import scenes

__all__ = ["example_of", "not_one_of", "place_of"]


def not_one_of(what: str, given: object, allowed: Sequence[str]) -> str:
    """Return the message that a value is not allowed, with those that are."""
    return f"{what} must be one of {', '.join(allowed)}, not {str(given)[:40]!r}."


def place_of(text: object, line: int, problems: Problems) -> StateLink | None:
    """Return the state of a link, each value within its bounds; None if it has no scene."""
    link = Link(urlsplit(text).query if isinstance(text, str) else "")
    scene = scenes().get(link.given.get("scene", ""))
    values = {} if scene is None else link.values(scene.specs)
    if scene is not None:
        link.require(scene.name, scene.specs)
    for note in link.notes:
        problems.add(f"the link is not valid. {refusal(note)}", line)
    # A link that is too long is not read.
    if scene is None and (link.given or not link.notes):
        names = ", ".join(name for name, one in scenes().items() if one.origin is None)
        problems.add(f"a link of this page needs a scene, one of {names}.", line)
    return None if scene is None else StateLink(scene.name, values)


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
