"""Update the controls of a scene: values, slider ranges, the selected example."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hess_explorer.protocol.specs import NumberSpec, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Scene

CHOOSE = ""
"""Entry of the menu of examples when the values match no example."""


def slider_limits(spec: NumberSpec, limits: Mapping[str, tuple[float, float, float]]) -> tuple[float, float, float]:
    """Return (low, high, step) of a slider, from `limits` if it depends on the state, otherwise from the parameter."""
    return limits.get(spec.name, (*spec.softbounds, spec.step))


def example_of(scene: Scene[Any], values: Values) -> str:
    """Return the name of the first example that matches the values of the enabled controls; `CHOOSE` if none does."""
    idle = scene.idle_values(values)

    def shown(example: Values) -> bool:
        return all(values[name] == value for name, value in example.items() if name not in idle)

    return next((one.name for one in scene.presets if shown(scene.example(one))), CHOOSE)


def show_controls(scene: Scene[Any], values: Values, wire: Wire) -> None:
    """Put the values and ranges of all controls, and the matching example, into `wire`."""
    limits, idle = scene.limits(values), scene.idle_values(values)
    for spec in scene.specs:
        if isinstance(spec, NumberSpec):
            value = idle.get(spec.name, values[spec.name])
            wire.show_number(spec.name, float(value), slider_limits(spec, limits), idle=spec.name in idle)
        else:
            wire.show_choice(spec.name, str(values[spec.name]))
    wire.show_choice("preset", example_of(scene, values))
