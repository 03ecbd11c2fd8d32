"""The pages that a file can hold: a state with sliders, and a lesson."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from hess_explorer.export.picture_data import address, picture_of
from hess_explorer.lessons.lesson import TIME, Lesson, StateLink
from hess_explorer.offline.html import HOME, document
from hess_explorer.offline.plan import Slider, across, family, read_slider
from hess_explorer.offline.recording import Recording
from hess_explorer.page.controls import slider_limits
from hess_explorer.page.description import describe_lesson
from hess_explorer.protocol.parameters import Number, Values, encode
from hess_explorer.scenes import scenes

__all__ = ["COUNT", "lesson_page", "state_page"]

COUNT = 40
"""Number of values of a slider by default."""

Report = Callable[[int, int], None]


def state_page(
    query: str,
    pictures: Sequence[str] = (),
    sliders: Sequence[str] = (),
    *,
    grid: bool = False,
    home: str = HOME,
    contents: str = "",
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
        The sliders that move in the file, as NAME=LOW:HIGH:COUNT.
    grid : bool
        True for all combinations of their values; by default each has its own line through the state.
    home : str
        Address of the explorer, for the links in the file.
    contents : str
        Relative address of a table of contents; "" for none.
    lenient : bool
        True to correct an invalid query, as in `address`.
    report : callable, optional
        Gets the number of computed states and of all states.

    Returns
    -------
    tuple of str and bytes
        The name of the scene and the contents of the file.

    Raises
    ------
    InvalidParameter
        If the scene has no such picture or slider, or the query is invalid.
    ModelError
        If the state cannot be computed.
    """
    found = address(query, lenient=lenient)
    scene = found.scene
    wanted = [picture_of(scene, name).name for name in pictures] or scene.open_pictures
    chosen = [name for name in scene.pictures if name in wanted]
    varied = [read_slider(text, scene, found.values, COUNT) for text in sliders]
    recording = Recording({scene.name: chosen}, report)
    recording.record([family(scene, found.values, varied, grid=grid)])
    parameters = ", ".join(f"{name} = {value}" for name, value in found.values.items())
    facts = {
        "link": found.link,
        "scene": scene.name,
        "title": scene.title,
        "pictures": chosen,
        "parameters": dict(found.values),
        "sliders": {slider.name: list(slider.values) for slider in varied},
        "notes": list(found.notes),
    }
    client = {name: repr(value) for name, value in found.client.items()}
    summary = f"{scene.summary} ?{found.link} | {parameters}"
    return scene.name, document(scene.title, summary, recording, facts, client, home=home, contents=contents)


def _sliders(lesson: Lesson, count: int) -> dict[str, tuple[StateLink, dict[str, Slider]]]:
    """Return the states of the steps by query, each with the sliders that its steps name or animate."""
    found: dict[str, tuple[StateLink, dict[str, Slider]]] = {}
    for step in lesson.steps:
        scene = scenes()[step.at.scene]
        values, _ = scene.admit(step.at.values)
        states = [StateLink(scene.name, values)]
        if step.prediction is not None:
            then, _ = scene.admit(step.prediction.then.values)
            states.append(StateLink(scene.name, then))
        for state in states:
            _, sliders = found.setdefault(encode(scene.name, state.values), (state, {}))
        specs = {spec.name: spec for spec in scene.specs if isinstance(spec, Number)}
        for at in states:
            _, sliders = found[encode(scene.name, at.values)]
            for name in step.controls:
                if name in specs:
                    low, high, _ = slider_limits(specs[name], scene.limits(at.values))
                    sliders[name] = Slider(name, across(low, high, count, float(at.values[name])))
        if step.animation is not None and step.animation.name != TIME:
            animation = step.animation
            low, high = sorted((animation.start, animation.end))
            _, sliders = found[encode(scene.name, values)]
            known = sliders.get(animation.name, Slider(animation.name, ()))
            more = across(low, high, count, float(values[animation.name]))
            sliders[animation.name] = Slider(animation.name, tuple(sorted({*known.values, *more, low, high})))
    return found


def _pictures(lesson: Lesson) -> dict[str, list[str]]:
    """Return the pictures of each scene of a lesson: the open ones, and those that its steps name."""
    found: dict[str, list[str]] = {}
    for step in lesson.steps:
        scene = scenes()[step.at.scene]
        named = {step.look, step.hide.picture if step.hide else "", step.prediction.picture if step.prediction else ""}
        named |= {*found.get(scene.name, scene.open_pictures)}
        found[scene.name] = [name for name in scene.pictures if name in named]
    return found


def lesson_page(
    lesson: Lesson,
    count: int = COUNT,
    *,
    home: str = HOME,
    contents: str = "",
    report: Report | None = None,
) -> bytes:
    """Return the HTML file of a lesson: all its steps, with the sliders that they name.

    Parameters
    ----------
    lesson : Lesson
        The lesson.
    count : int
        Number of values of a slider.
    home : str
        Address of the explorer, for the links in the file.
    contents : str
        Relative address of a table of contents; "" for none.
    report : callable, optional
        Gets the number of computed states and of all states.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    ModelError
        If the state of a step cannot be computed.
    """
    recording = Recording(_pictures(lesson), report)
    states = _sliders(lesson, count)
    recording.record(
        [family(scenes()[state.scene], state.values, [*sliders.values()]) for state, sliders in states.values()]
    )
    steps: dict[str, int] = {}
    for number, step in enumerate(lesson.steps):
        scene = scenes()[step.at.scene]

        def number_of(values: Values, name: str = scene.name) -> int:
            return recording.number_of(encode(name, scenes()[name].admit(values)[0]))

        steps[f"{lesson.name}/{number}/false"] = number_of(step.at.values)
        then = step.prediction.then.values if step.prediction else step.at.values
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
        contents,
    )
