"""The controls of a scene, made from its parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import panel_material_ui as pmui

from app.components import NumberControl, Text
from app.scenes.base import Scene
from app.state import Number, Spec, Value, Values

__all__ = ["Controls", "ExampleMenu", "slider_limits"]


def slider_limits(spec: Number, limits: Mapping[str, tuple[float, float, float]]) -> tuple[float, float, float]:
    """(low, high, step) of a slider: the scene's where they depend on the state, else the parameter's own."""
    return limits.get(spec.name, (spec.low, spec.high, spec.step))


class Controls:
    """A slider with a box for each number, a menu for each choice.

    Numbers are changed by the browser's request for a state, and shown by the wire; menus are
    ordinary widgets, which call `change`.
    """

    def __init__(self, specs: tuple[Spec, ...], values: Values, limits: Mapping[str, tuple[float, float, float]],
                 change: Callable[[Values], None]) -> None:
        self._menus: dict[str, pmui.Select] = {}
        self._shown = dict(values)
        self._change = change
        self.roots: list[Any] = []
        for spec in specs:
            classes = [f"param-{spec.name}"]
            if isinstance(spec, Number):
                self.roots.append(NumberControl(
                    name=spec.name, label=spec.label, symbol=spec.symbol, help=spec.help, css_classes=classes,
                    shown=[float(values[spec.name]), *slider_limits(spec, limits)],
                    sizing_mode="stretch_width", margin=(3, 8),
                ))
            else:
                menu = pmui.Select(
                    label=spec.label, value=str(values[spec.name]), options=list(spec.options), size="small",
                    css_classes=classes, sizing_mode="stretch_width", margin=(10, 8, 0, 8),
                )
                menu.param.watch(partial(self._chosen, spec.name), "value")
                self._menus[spec.name] = menu
                self.roots += [menu, Text(text=spec.help, look="help", sizing_mode="stretch_width", margin=(2, 8))]

    def _chosen(self, name: str, event: Any) -> None:
        # What we show ourselves is no choice of the user's.
        if event.new != self._shown[name]:
            self._change({name: event.new})

    def show(self, values: Mapping[str, Value]) -> None:
        """Bring the menus up to date."""
        self._shown = dict(values)
        for name, menu in self._menus.items():
            menu.value = str(values[name])


class ExampleMenu:
    """A menu of the scene's presets; it says "Choose…" as soon as the state is none of them."""

    CHOOSE = "Choose an example…"

    def __init__(self, scene: Scene, change: Callable[[Values], None]) -> None:
        self._examples = {preset.name: scene.example(preset) for preset in scene.presets}
        self.root = pmui.Select(
            label="Example", options=[self.CHOOSE, *self._examples], size="small", css_classes=["param-preset"],
            sizing_mode="stretch_width", margin=(8, 8),
        )
        self._shown = self.CHOOSE
        self._change = change
        self.root.param.watch(self._chosen, "value")

    def _chosen(self, event: Any) -> None:
        if event.new != self._shown and event.new in self._examples:
            self._change(self._examples[event.new])

    def show(self, values: Values) -> None:
        """Name the example that these values are."""
        self._shown = next(
            (name for name, example in self._examples.items() if example.items() <= values.items()), self.CHOOSE)
        self.root.value = self._shown
