"""The settings of a step: what its fence `step` says beside the state."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeGuard

from hess_explorer.lessons.lesson import TIME, Animation, HiddenLayer, LessonError, Prediction, StateLink
from hess_explorer.lessons.links import not_one_of, place_of
from hess_explorer.lessons.problems import Problems
from hess_explorer.protocol.parameters import Controlled, Number
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views.layers import Layer
from hess_explorer.views.plot import Plot

__all__ = ["animation_of", "controls_of", "hidden_of", "is_number", "look_of", "names_of", "only", "prediction_of"]

_MOST_SECONDS, _MOST_TIME = 600.0, 1e6
_MOST_NAMES = 6
# Layers on canvases of the page, which are always shown.
_PAINTED = ("image", "dots")
_CURVES, _POINTS = ("multi_line", "line"), ("scatter",)


def is_number(value: Any) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def only(found: Any, line: int, what: str, allowed: tuple[str, ...], problems: Problems) -> dict[str, Any]:
    """Return the allowed keys of a mapping; the others are mistakes."""
    if not isinstance(found, dict):
        raise LessonError(f"{what} must be a list of keys with values; the keys are {', '.join(allowed)}.", line)
    for key in found:
        if key not in allowed:
            problems.add(f"{str(key)[:40]!r} is not a known key: choose from {', '.join(allowed)}.", line)
    return {key: value for key, value in found.items() if key in allowed}


def look_of(found: object, scene: Scene[Any], line: int) -> str:
    """Return the name of the picture to enlarge, "" for none."""
    if found is None or found == "":
        return ""
    if found not in scene.pictures:
        raise LessonError(not_one_of("look", found, scene.pictures), line)
    return str(found)


def animation_of(found: object, scene: Scene[Any], line: int, problems: Problems) -> Animation | None:
    """Return the animation of a step, None for none."""
    if found is None:
        return None
    names = ("name", "from", "to", "seconds")
    given = only(found, line, "animate", names, problems)
    bounds = {TIME: (0.0, _MOST_TIME), **{spec.name: spec.bounds for spec in scene.specs if isinstance(spec, Number)}}
    name, start, end, seconds = (given.get(one, math.nan) for one in names)
    known = isinstance(name, str) and name in bounds
    low, high = bounds[name] if known else (-math.inf, math.inf)
    ends = [given[one] for one in ("from", "to") if one in given]
    mistakes = [
        message
        for wrong, message in (
            (
                len(given) < len(names),
                "animate needs name, from, to and seconds, like {name: h, from: 0.2, to: 1.5, seconds: 8}.",
            ),
            ("name" in given and not known, not_one_of("name of animate", name, tuple(bounds))),
            (
                not all(is_number(one) and low <= one <= high for one in ends),
                f"from and to of {name} must be numbers from {low:g} to {high:g}.",
            ),
            (
                "seconds" in given and not (is_number(seconds) and 0 < seconds <= _MOST_SECONDS),
                f"seconds must be a positive number up to {_MOST_SECONDS:g}.",
            ),
        )
        if wrong
    ]
    for message in mistakes:
        problems.add(message, line)
    return None if mistakes else Animation(name, float(start), float(end), float(seconds))


def controls_of(
    found: object, animation: Animation | None, scene: Scene[Any], line: int, problems: Problems
) -> tuple[str, ...]:
    """Return the names of the controls beside the text; by default that of the animated parameter."""
    if found is None:
        return (animation.name,) if animation and animation.name != TIME else ()
    return names_of(
        found, "controls", [spec.name for spec in scene.specs if isinstance(spec, Controlled)], line, problems
    )


def names_of(found: object, key: str, allowed: Sequence[str], line: int, problems: Problems) -> tuple[str, ...]:
    """Return the names of a list, each once; none without a list."""
    if found is None:
        return ()
    listed = found if isinstance(found, list) else []
    if listed is not found or len(listed) > _MOST_NAMES:
        problems.add(
            f"{key} must be a list of at most {_MOST_NAMES} names, like {key}: [{', '.join(allowed[:2])}].", line
        )
    for name in listed:
        if name not in allowed:
            problems.add(not_one_of(f"a name in {key}", name, allowed), line)
    return tuple(dict.fromkeys(name for name in listed if name in allowed))


def hidden_of(found: object, scene: Scene[Any], line: int, problems: Problems) -> HiddenLayer | None:
    """Return the layer that a step leaves out, None for none."""
    if found is None:
        return None
    plot, layer = _layer(only(found, line, "hide", ("picture", "layer"), problems), "hide", scene, line)
    return HiddenLayer(plot.name, plot.source_of(layer))


def prediction_of(found: object, place: StateLink, line: int, problems: Problems) -> Prediction | None:
    """Return the prediction of a step, None for none."""
    if found is None:
        return None
    given = only(found, line, "predict", ("picture", "layer", "then"), problems)
    then = (place_of(given["then"], line, problems) if "then" in given else None) or place
    if then.scene != place.scene:
        problems.add(f"then must be a state of the same scene, {place.scene}.", line)
    plot, layer = _layer(given, "predict", scenes()[place.scene], line, (*_CURVES, *_POINTS))
    return Prediction(
        plot.name,
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
        raise LessonError(not_one_of(f"picture of {key}", name, tuple(plots)), line)
    layers = {
        layer.name: layer
        for layer in plots[name].layers
        if (layer.glyph not in _PAINTED if glyphs is None else layer.glyph in glyphs)
    }
    truth = given.get("layer")
    if not isinstance(truth, str) or truth not in layers:
        raise LessonError(not_one_of(f"layer of {key}", truth, tuple(layers)), line)
    return plots[name], layers[truth]
