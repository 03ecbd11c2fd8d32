"""The pages that a file can hold: a state with sliders, and a lesson."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hess_explorer.export.picture_data import Address, address, picture_of
from hess_explorer.lessons.lesson import TIME, Lesson
from hess_explorer.offline.html import HOME, document
from hess_explorer.offline.plan import StateFamily, family, read_slider, slider_of, values_across
from hess_explorer.offline.recording import Recording, Report
from hess_explorer.page.lesson_description import describe_lesson
from hess_explorer.protocol.specs import Values, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.numerics.accuracy import DRAFT

COUNT = 40
"""Number of values of a slider by default."""


def page_family(query: str, sliders: Sequence[str], *, grid: bool = False, lenient: bool = False) -> StateFamily:
    """Return the states of a page before they are computed.  Parameters and `InvalidParameter` as in `state_page`."""
    return _slider_states(address(query, lenient=lenient), sliders, grid)


def _slider_states(at: Address, sliders: Sequence[str], grid: bool) -> StateFamily:
    """Return the states of sliders through a state."""
    return family(at.scene, at.values, [read_slider(text, at.scene, at.values, COUNT) for text in sliders], grid=grid)


def state_page(
    query: str,
    pictures: Sequence[str] = (),
    sliders: Sequence[str] = (),
    *,
    grid: bool = False,
    home: str = HOME,
    lenient: bool = False,
    report: Report | None = None,
) -> tuple[str, bytes]:
    """Return the name of the scene of a query, and the HTML file of its state.

    Parameters
    ----------
    query : str
        Query of the state.
    pictures : sequence of str
        Names of the pictures; by default those that are open at first.
    sliders : sequence of str
        The sliders that move in the file, as NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT.
    grid : bool
        True for all combinations of their values; by default each has its own line through the state.
    home : str
        Address of the explorer, for the links in the file.
    lenient : bool
        True to correct an invalid query, as in `address`.
    report : callable, optional
        See `Recording`.

    Returns
    -------
    tuple of str and bytes
        The name of the scene and the contents of the file.

    Raises
    ------
    InvalidParameter
        If the scene has no such picture or slider, the query is invalid, or there are more than `MAX_STATES` states.
    ModelError
        If the state cannot be computed.
    """
    found = address(query, lenient=lenient)
    scene = found.scene
    wanted = [picture_of(scene, name).name for name in pictures] or scene.open_pictures
    chosen = [name for name in scene.pictures if name in wanted]
    recording = Recording({scene.name: chosen}, report)
    recording.record([_slider_states(found, sliders, grid)])
    parameters = ", ".join(f"{name} = {value}" for name, value in found.values.items())
    facts = {
        "link": found.link,
        "scene": scene.name,
        "title": scene.title,
        "pictures": chosen,
        "parameters": dict(found.values),
        "sliders": list(sliders),
        "notes": list(found.notes),
    }
    client = {name: repr(value) for name, value in found.client.items()}
    summary = f"{scene.summary} ?{found.link} | {parameters}"
    return scene.name, document(scene.title, summary, recording, facts, client, home=home)


def _drag_values(scene: Scene[Any]) -> Values:
    """Return values that replace those of a step in all states of its sliders except the first one.

    Sections and diagrams shaded by density take seconds at full accuracy, so their sliders move at the accuracy of a
    drag.
    """
    return {"accuracy": DRAFT.name} if has_density_shading(scene) else {}


def has_density_shading(scene: Scene[Any]) -> bool:
    """Return whether the pictures of a scene are shaded by the density of very many points."""
    return isinstance(getattr(scene.state, "density", None), part)


def _families(lesson: Lesson, count: int) -> list[StateFamily]:
    """Return the family of each distinct state of the steps, with the sliders that the steps name or animate."""
    found: dict[str, tuple[Scene[Any], Values, dict[str, set[float]]]] = {}
    for step in lesson.steps:
        scene = scenes()[step.state.scene]
        for state in (step.state, *([step.prediction.outcome] if step.prediction else [])):
            values, _ = scene.admit(state.values)
            _, _, sliders = found.setdefault(encode(scene.name, values), (scene, values, {}))
            for name in step.controls:
                sliders.setdefault(name, set()).update(slider_of(scene, name, values, count))
        animation = step.animation
        if animation is not None and animation.name != TIME:
            values, _ = scene.admit(step.state.values)
            ends = sorted((animation.start, animation.end))
            _, _, sliders = found[encode(scene.name, values)]
            own = float(values[animation.name])
            sliders.setdefault(animation.name, set()).update(ends, values_across(ends[0], ends[1], count, own))
    return [
        family(
            scene,
            values,
            [(name, tuple(sorted(each))) for name, each in sliders.items() if each],
            drag_values=_drag_values(scene),
        )
        for scene, values, sliders in found.values()
    ]


def _pictures(lesson: Lesson) -> dict[str, list[str]]:
    """Return the pictures of each scene: the open ones, and those that a step shows, enlarges or predicts in."""
    found: dict[str, list[str]] = {}
    for step in lesson.steps:
        scene = scenes()[step.state.scene]
        named = {
            *step.pictures,
            step.enlarged_picture,
            step.hidden_layer.picture if step.hidden_layer else "",
            step.prediction.picture if step.prediction else "",
        }
        named |= {*found.get(scene.name, scene.open_pictures)}
        found[scene.name] = [name for name in scene.pictures if name in named]
    return found


def lesson_page(
    lesson: Lesson,
    count: int = COUNT,
    *,
    home: str = HOME,
    report: Report | None = None,
) -> bytes:
    """Return the HTML file of a lesson: all its steps, with the sliders that they name or animate.

    Parameters
    ----------
    lesson : Lesson
        The lesson.
    count : int
        Number of values of a slider.
    home : str
        Address of the explorer, for the links in the file.
    report : callable, optional
        See `Recording`.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If the sliders of a step have more than `MAX_STATES` states.
    ModelError
        If the state of a step cannot be computed.
    """
    recording = Recording(_pictures(lesson), report)
    recording.record(_families(lesson, count))
    steps: dict[str, int] = {}
    for number, step in enumerate(lesson.steps):
        scene = scenes()[step.state.scene]

        def number_of(values: Values, name: str = scene.name) -> int:
            return recording.number_of(encode(name, scenes()[name].admit(values)[0]))

        steps[f"{lesson.name}/{number}/false"] = number_of(step.state.values)
        then = step.prediction.outcome.values if step.prediction else step.state.values
        steps[f"{lesson.name}/{number}/true"] = number_of(then)
    facts = {"lesson": lesson.name, "title": lesson.title, "steps": len(lesson.steps)}
    client: Mapping[str, str] = {"lesson": lesson.name, "step": "1"}
    return document(
        lesson.title,
        f"A lesson in {len(lesson.steps)} steps.",
        recording,
        facts,
        client,
        describe_lesson(lesson),
        steps,
        home,
    )
