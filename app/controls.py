"""Widgets made from a scene's parameters: a slider and an entry box for each number."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import panel_material_ui as pmui

from app.state import Choice, Number, Spec, Value, Values

__all__ = ["Controls"]

# The knob follows the hand at once; an animation of its own would make the browser paint all the time.
_STILL = {"& .MuiSlider-thumb, & .MuiSlider-track": {"transition": "none"}}

Change = Callable[[Values], None]


class HandSlider(pmui.FloatSlider):
    """A slider whose second, throttled value stays in the browser: each event costs Panel some milliseconds."""

    _debounce = 0

    @property
    def _linked_properties(self) -> tuple[str, ...]:
        return tuple(name for name in super()._linked_properties if name != "value_throttled")


class _NumberControl:
    """A slider for the hand and a box for exact values; typed values may exceed the slider's range."""

    def __init__(self, spec: Number, value: float, change: Change) -> None:
        self.spec = spec
        self._change = change
        self._showing = False
        self._shown: tuple[float, ...] = ()
        self.slider = HandSlider(
            label=spec.label, value=value, start=min(spec.low, value), end=max(spec.high, value), step=spec.step,
            show_value=False, size="small", tooltips=False, description=spec.help, sizing_mode="stretch_width",
            margin=(0, 4), sx=_STILL,
        )
        self.box = pmui.TextInput(
            label=spec.symbol, value=repr(value), size="small", width=104, margin=(4, 6, 0, 0),
        )
        self.box._debounce = 0
        self.root = pmui.Row(
            self.slider, self.box, css_classes=[f"param-{spec.name}"], sizing_mode="stretch_width", margin=0,
        )
        self.slider.param.watch(self._moved, "value")
        self.box.param.watch(self._typed, "value")

    def _moved(self, event: Any) -> None:
        if not self._showing and event.new is not None:
            self._change({self.spec.name: event.new})

    def _typed(self, event: Any) -> None:
        if self._showing:
            return
        try:
            value = float(str(event.new).strip().replace("−", "-").replace(",", "."))
        except ValueError:
            self.box.param.update(error_state=True)
            return
        self._change({self.spec.name: value})

    def show(self, value: Value, limits: tuple[float, float, float] | None) -> None:
        """Display a value, and the slider range that goes with it."""
        number = float(value)
        low, high, step = limits or (self.spec.low, self.spec.high, self.spec.step)
        shown = (number, low, high, step)
        if shown == self._shown and not self.box.error_state:
            return
        self._shown = shown
        self._showing = True
        try:
            self.slider.param.update(start=min(low, number), end=max(high, number), step=step, value=number)
            self.box.param.update(value=repr(number), error_state=False)
        finally:
            self._showing = False


class _ChoiceControl:
    """A menu."""

    def __init__(self, spec: Choice, value: str, change: Change) -> None:
        self._showing = False
        self.root = pmui.Select(
            label=spec.label, value=value, options=list(spec.options), description=spec.help, size="small",
            css_classes=[f"param-{spec.name}"], sizing_mode="stretch_width", margin=(8, 4),
        )

        def chosen(event: Any) -> None:
            if not self._showing:
                change({spec.name: event.new})

        self.root.param.watch(chosen, "value")

    def show(self, value: Value, _: tuple[float, float, float] | None) -> None:
        """Display a value."""
        if self.root.value == value:
            return
        self._showing = True
        try:
            self.root.value = str(value)
        finally:
            self._showing = False


def _control(spec: Spec, value: Value, change: Change) -> _NumberControl | _ChoiceControl:
    if isinstance(spec, Number):
        return _NumberControl(spec, float(value), change)
    return _ChoiceControl(spec, str(value), change)


class Controls:
    """All controls of a scene, by parameter name."""

    def __init__(self, specs: tuple[Spec, ...], values: Values, change: Change) -> None:
        self._controls = {spec.name: _control(spec, values[spec.name], change) for spec in specs}

    @property
    def roots(self) -> list[Any]:
        """The widgets in the order of the parameters."""
        return [control.root for control in self._controls.values()]

    def show(self, values: Values, limits: Mapping[str, tuple[float, float, float]]) -> None:
        """Display these values."""
        for name, control in self._controls.items():
            control.show(values[name], limits.get(name))
