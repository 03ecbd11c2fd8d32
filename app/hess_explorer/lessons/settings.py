"""The settings of a step in its code fence `step`.

Each function parses one setting, and raises `LessonError` with the line and the allowed values.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeGuard
from urllib.parse import urlsplit

from hess_explorer.lessons.lesson import (
    TIME,
    Animation,
    HiddenLayer,
    LessonError,
    LessonStep,
    Prediction,
    StateLink,
)
from hess_explorer.protocol.specs import ControlSpec, Link, NumberSpec, refusal
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views.layers import Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits

_MOST_SECONDS, _MOST_TIME = 600.0, 1e6
_MOST_NAMES = 6
# These layers lie on canvases of the page, which are always shown.
_FILLS = ("image", "dots")
_CURVES, _POINTS = ("multi_line", "line"), ("scatter",)


def is_number(value: Any) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def require_keys(value: Any, what: str, allowed: Sequence[str], line: int) -> dict[str, Any]:
    """Return the value if it is a mapping with only allowed keys."""
    if not isinstance(value, dict):
        raise LessonError(f"{what} must be a list of keys with values; the keys are {', '.join(allowed)}.", line)
    for key in value:
        if key not in allowed:
            raise LessonError(f"{str(key)[:40]!r} is not a known key: choose from {', '.join(allowed)}.", line)
    return value


def _one_of(value: object, what: str, allowed: Sequence[str], line: int) -> str:
    if not isinstance(value, str) or value not in allowed:
        raise LessonError(f"{what} must be one of {', '.join(allowed)}, not {str(value)[:40]!r}.", line)
    return value


# ---- states ---------------------------------------------------------------------------------------------------------


def state_of_link(text: object, line: int) -> StateLink:
    """Return the state of a link; a value outside its bounds is an error."""
    link = Link(urlsplit(text).query if isinstance(text, str) else "")
    scene = scenes().get(link.texts.get("scene", ""))
    values = {} if scene is None else link.values(scene.specs)
    if scene is not None:
        link.require(scene.name, scene.specs)
    if link.notes:
        raise LessonError(f"the link is not valid. {' '.join(map(refusal, link.notes))}", line)
    if scene is None:
        names = ", ".join(name for name, one in scenes().items() if one.origin is None)
        raise LessonError(f"a link of this page needs a scene, one of {names}.", line)
    return StateLink(scene.name, values)


def example_of(begins: object, before: StateLink | None, line: int) -> StateLink:
    """Return the state of the only example whose name begins with a text, in the scene of `before` or the first scene.

    Raises `LessonError` unless exactly one example matches.
    """
    scene = next(iter(scenes().values())) if before is None else scenes()[before.scene]
    found = [one for one in scene.presets if isinstance(begins, str) and begins and one.name.startswith(begins)]
    if len(found) != 1:
        names = ", ".join(preset.name for preset in scene.presets)
        raise LessonError(f"example must match the beginning of exactly one example of {scene.name}: {names}.", line)
    return StateLink(scene.name, scene.defaults() | scene.example(found[0]))


def corrections(steps: Iterable[LessonStep]) -> Iterator[LessonError]:
    """Yield a mistake with the nearest valid values for each state that the scene would change."""
    for step in steps:
        for what, place in _places(step):
            scene = scenes()[place.scene]
            values, notes = scene.admit(place.values)
            changed = ", ".join(
                f"{name} = {digits(value, 6) if isinstance(value, float) else value}"
                for name, value in values.items()
                if value != place.values[name]
            )
            if notes:
                yield LessonError(f"{what} is not possible: choose {changed}. {' '.join(notes)}", step.line)


def _places(step: LessonStep) -> Iterator[tuple[str, StateLink]]:
    """Yield the states that a step shows, with their names."""
    yield "the state of this step", step.state
    if step.prediction:
        yield "the state of predict", step.prediction.outcome
    if step.animation and step.animation.name != TIME:
        for end in (step.animation.start, step.animation.end):
            yield "an end of animate", StateLink(step.state.scene, {**step.state.values, step.animation.name: end})


# ---- visible elements -----------------------------------------------------------------------------------------------


def enlarged_picture_of(value: object, scene: Scene[Any], line: int) -> str:
    """Return the name of the picture to enlarge, "" for none."""
    return _one_of(value, "look", scene.pictures, line) if value else ""


def pictures_of(value: object, scene: Scene[Any], line: int) -> tuple[str, ...]:
    """Return the names of the pictures that are shown alone; empty for the whole page."""
    return () if value is None else _names_of(value, "pictures", scene.pictures, line)


def controls_of(value: object, animation: Animation | None, scene: Scene[Any], line: int) -> tuple[str, ...]:
    """Return the names of the controls beside the text; by default that of the animated parameter, if any."""
    if value is None:
        return (animation.name,) if animation and animation.name != TIME else ()
    return _names_of(value, "controls", [spec.name for spec in scene.specs if isinstance(spec, ControlSpec)], line)


def _names_of(value: object, key: str, allowed: Sequence[str], line: int) -> tuple[str, ...]:
    if not isinstance(value, list) or len(value) > _MOST_NAMES:
        example = f"{key}: [{', '.join(allowed[:2])}]"
        raise LessonError(f"{key} must be a list of at most {_MOST_NAMES} names, like {example}.", line)
    return tuple(dict.fromkeys(_one_of(name, f"a name in {key}", allowed, line) for name in value))


def animation_of(value: object, scene: Scene[Any], line: int) -> Animation | None:
    """Return the animation of a step, or None without one."""
    if value is None:
        return None
    names = ("name", "from", "to", "seconds")
    settings = require_keys(value, "animate", names, line)
    if len(settings) < len(names):
        example = "{name: h, from: 0.2, to: 1.5, seconds: 8}"
        raise LessonError(f"animate needs name, from, to and seconds, like {example}.", line)
    bounds = {
        TIME: (0.0, _MOST_TIME),
        **{spec.name: spec.bounds for spec in scene.specs if isinstance(spec, NumberSpec)},
    }
    name = _one_of(settings["name"], "name of animate", tuple(bounds), line)
    low, high = bounds[name]
    if not all(is_number(settings[one]) and low <= settings[one] <= high for one in ("from", "to")):
        raise LessonError(f"from and to of {name} must be numbers from {low:g} to {high:g}.", line)
    if not is_number(settings["seconds"]) or not 0 < settings["seconds"] <= _MOST_SECONDS:
        raise LessonError(f"seconds must be a positive number up to {_MOST_SECONDS:g}.", line)
    return Animation(name, float(settings["from"]), float(settings["to"]), float(settings["seconds"]))


def hidden_layer_of(value: object, scene: Scene[Any], line: int) -> HiddenLayer | None:
    """Return the layer that a step hides, or None without one."""
    if value is None:
        return None
    plot, layer = _layer(require_keys(value, "hide", ("picture", "layer"), line), "hide", scene, line)
    return HiddenLayer(plot.name, plot.source_of(layer))


def require_layer(target: str, scene: Scene[Any], line: int) -> None:
    """Raise an error unless "picture/layer" names a curve or points of a planar picture."""
    given = dict(zip(("picture", "layer"), target.split("/"), strict=True))
    _layer(given, f"{target!r}", scene, line, (*_CURVES, *_POINTS))


def require_number(name: str, scene: Scene[Any], line: int) -> None:
    """Raise an error unless a number of the scene has this name."""
    _one_of(name, "a number to drag", [spec.name for spec in scene.specs if isinstance(spec, NumberSpec)], line)


def prediction_of(value: object, place: StateLink, line: int) -> Prediction | None:
    """Return the prediction of a step, or None without one; its outcome is by default the state of the step."""
    if value is None:
        return None
    settings = require_keys(value, "predict", ("picture", "layer", "then"), line)
    then = state_of_link(settings["then"], line) if "then" in settings else place
    if then.scene != place.scene:
        raise LessonError(f"“then” of predict must link to a state of the same scene, {place.scene}.", line)
    plot, layer = _layer(settings, "predict", scenes()[place.scene], line, (*_CURVES, *_POINTS))
    what: Any = "curve" if layer.glyph in _CURVES else "point"
    return Prediction(plot.name, plot.source_of(layer), (layer.columns[0], layer.columns[1]), what, then)


def _layer(
    settings: dict[str, Any], key: str, scene: Scene[Any], line: int, glyphs: tuple[str, ...] | None = None
) -> tuple[Plot[Any], Layer[Any]]:
    """Return the picture and the layer that a mapping names; `glyphs` are the allowed kinds of layers."""
    plots = {view.name: view for view in scene.views if isinstance(view, Plot)}
    plot = plots[_one_of(settings.get("picture"), f"picture of {key}", tuple(plots), line)]
    layers = {
        layer.name: layer
        for layer in plot.layers
        if (layer.glyph not in _FILLS if glyphs is None else layer.glyph in glyphs)
    }
    return plot, layers[_one_of(settings.get("layer"), f"layer of {key}", tuple(layers), line)]
