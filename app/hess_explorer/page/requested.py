"""The requested state: a scene and the values that the user has chosen."""

from __future__ import annotations

from typing import Any

from hess_explorer.lessons.lesson import StateLink
from hess_explorer.protocol.specs import ChoiceSpec, Formula, Link, Value, Values
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene


def scene_and_values(link: Link, here: str) -> tuple[Scene[Any], dict[str, Value]]:
    """Return the scene of a link, by default the scene `here`, and the values of its parameters."""
    scene = scenes()[str(link.value(ChoiceSpec("scene", "Scene", tuple(scenes()), here)))]
    return scene, link.values(scene.specs)


class RequestedState:
    """The requested scene and values, each value within its bounds; the scene checks their combination.

    Parameters
    ----------
    scene, values, notes
        Initial values of the attributes; a parameter without a value has its default.

    Attributes
    ----------
    scene : Scene
        The scene.
    specs : dict of str to Spec
        Parameters of the scene by name.
    values : dict of str to float or str
        Values of its parameters.
    notes : list of str
        Notes on corrected values of the last change.
    carried : bool
        True if values were transferred from a scene with another motion, so that they may be impossible here.
    """

    def __init__(self, scene: Scene[Any], values: Values, notes: list[str]) -> None:
        self.scene = scene
        self._left: dict[str, Values] = {}
        self._enter(scene, values, notes)

    def _enter(self, scene: Scene[Any], values: Values, notes: list[str]) -> None:
        """Go to a scene; parameters without a value have their defaults."""
        if scene is not self.scene:
            self._left[self.scene.name] = self.values
        self.scene, self.notes, self.carried = scene, [*notes], False
        self.specs = {spec.name: spec for spec in scene.specs}
        self.values: dict[str, Value] = scene.defaults()
        self._set(values)

    def change(self, values: Values) -> None:
        """Set values; when a choice changes, also apply the scene's `adjustments` to the other parameters."""
        before = dict(self.values)
        self.notes = []
        self._set(values)
        if any(isinstance(spec, ChoiceSpec) and self.values[name] != before[name] for name, spec in self.specs.items()):
            adjustments = self.scene.adjustments(before, self.values)
            self._set({name: value for name, value in adjustments.items() if name not in values})

    def change_scene(self, scene: Scene[Any]) -> None:
        """Go to a scene in its last state, and transfer changed values of parameters with the same meaning."""
        if scene is self.scene:
            return
        # A scene and its "Speed and accuracy" scene share one state.
        carried = (scene.origin or scene.name) != (self.scene.origin or self.scene.name)
        values = (
            scene.transfer(self._left.get(scene.name, scene.defaults()), self.scene, self.values)
            if carried
            else {**self._left.get(scene.name, {}), **self.values}
        )
        self._enter(scene, values, [])
        self.carried = carried

    def restore(self, query: str) -> None:
        """Go to the state of a query, from a link or an undo step, and note its corrections."""
        link = Link(query)
        scene, values = scene_and_values(link, self.scene.name)
        self.go_to(StateLink(scene.name, values))
        self.notes = link.notes

    def go_to(self, place: StateLink) -> None:
        """Go to a state, with all of its values."""
        scene = scenes()[place.scene]
        if scene.name == self.scene.name:
            self.change(place.values)
        else:
            self._enter(scene, place.values, [])

    def restart(self) -> None:
        """Go to the default state of the scene, because the transferred values are impossible here."""
        self._enter(self.scene, {}, ["The previous values are not possible here: this is the scene's default state."])

    def _set(self, values: Values) -> None:
        """Set values, clamped to the bounds of their parameters, and note each correction."""
        for name, given in values.items():
            spec = self.specs.get(name)
            if spec is None:
                continue
            value, note = spec.read(given)
            self.notes += [note] if note else []
            # An invalid formula leaves the previous one unchanged.
            if note is None or not isinstance(spec, Formula):
                self.values[name] = value
