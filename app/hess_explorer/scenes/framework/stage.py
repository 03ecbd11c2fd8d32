"""The pictures of a scene in one session: sends the changes of a state, and handles the mouse."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any, Generic, TypeVar

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Report, Scene, State
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Columns
from hess_explorer.views.picture import Corners, Picture, Values

S = TypeVar("S", bound=State)


class Stage(Generic[S]):
    """The pictures of a scene in one session; sends the changed columns of visible pictures.

    Parameters
    ----------
    scene : Scene
        The scene.
    wire : Wire
        Connection to the browser.
    """

    def __init__(self, scene: Scene[S], wire: Wire) -> None:
        self.scene, self.wire = scene, wire
        self._views: dict[str, Picture[S]] = {view.name: view for view in scene.views}
        self._axes = {view.name: view.first_axes for view in scene.views}
        self._canvases = {view.name for view in scene.views if view.kind != "plot"}
        self._sent: dict[str, Columns] = {}
        self._state: S | None = None

    def show(self, state: S, hold_axes: bool) -> Report:
        """Draw a state and return the texts beside the pictures.

        Raises `ModelError`, before anything is sent.

        Parameters
        ----------
        state : State
            A state from `Scene.compute`.
        hold_axes : bool
            True to keep the axes, as during a drag.
        """
        # Compute everything that can fail before drawing, so that a failing state is not partly drawn.
        views = [view for view in self.scene.views if view.name in state.visible]
        captions = {view.name: view.full_caption(state) for view in views}
        held = {view.name: self._axes[view.name] for view in views}
        axes = held if hold_axes else {view.name: view.ranges(state, held[view.name]) for view in views}
        drawn = dict(state.sources)
        for view in views:
            for source, columns in view.data_in_axes(state, axes[view.name], drawn).items():
                drawn[source] = {**drawn.get(source, {}), **columns}
        answer = self.scene.answer(state)
        windowed = " ".join(view.name for view in views if view.is_windowed(state))
        quantities, notes = [*state.quantities()], [*dict.fromkeys(state.notes())]
        status = re.sub(r"(?<=\d)e-(?=\d)", "e−", " · ".join([*state.status(), state.work.status_end()]))
        self._state = state
        for view in views:
            self._set_axes(view, axes[view.name])
            self.wire.caption(view.name, asdict(captions[view.name]))
        for source, columns in drawn.items():
            self._put(source, columns)
        self._name_signs(views, drawn)
        self.wire.set_text("answer", answer)
        self.wire.set_text("windowed", windowed)
        return Report(quantities, status, notes, tuple(state.work.todo), state.work.pieces, state.work.summary())

    def _name_signs(self, views: Sequence[Picture[S]], drawn: Mapping[str, Columns]) -> None:
        """Send the visible entries of the legend."""
        self.wire.set_text(
            "signs", self.scene.visible_signs({sign for view in views for sign in view.visible_legend(drawn)})
        )

    def fail(self, sentence: str, hold_axes: bool = False) -> None:
        """Clear all pictures and show the sentence in their captions; reset the axes unless `hold_axes`."""
        self._state = None
        self.wire.set_text("answer", "")
        self.wire.set_text("windowed", "")
        for name in self.scene.tracks:
            self._put(f"data-{name}", {})
        for name, view in self._views.items():
            self._set_axes(view, None if hold_axes else view.first_axes)
            for source, columns in view.empty_data(sentence, self._axes[name]).items():
                self._put(source, columns)
            self.wire.caption(name, asdict(Caption(title=sentence)))

    def pick(self, picture: str, x: float, y: float) -> Values:
        """Return the values that a click at (x, y) of a picture sets; empty for a hidden picture.

        Raises `ModelError`.
        """
        state, view = self._visible(picture)
        return {} if state is None or view is None or view.on_click is None else view.on_click(state, x, y)

    def box(self, picture: str, corners: Corners) -> Values:
        """Return the values that a box (x0, y0, x1, y1) in a picture sets; empty for a hidden picture.

        Raises `ModelError`.
        """
        state, view = self._visible(picture)
        return {} if state is None or view is None or view.on_box is None else view.on_box(state, corners)

    def hover(self, picture: str, x: float, y: float) -> str:
        """Return the tooltip at (x, y) of a picture; empty for a hidden picture.  Raises `ModelError`."""
        state, view = self._visible(picture)
        return "" if state is None or view is None or view.on_hover is None else view.on_hover(state, x, y)

    def _visible(self, picture: str) -> tuple[S, Picture[S]] | tuple[None, None]:
        """Return the current state and a picture; (None, None) if it is hidden, because it then has no results."""
        state = self._state
        return (None, None) if state is None or picture not in state.visible else (state, self._views[picture])

    def _set_axes(self, view: Picture[S], axes: Axes | None) -> None:
        if axes is not None and axes != self._axes[view.name]:
            self._axes[view.name] = axes
            # Canvases have their axes among their columns.
            if view.name not in self._canvases:
                self.wire.put_ranges(view.name, axes.x, axes.y)

    def _put(self, source: str, columns: Columns) -> None:
        """Send the columns of a source if they differ from those in the browser."""
        before = self._sent.get(source, {})
        # Bokeh requires all columns of a glyph: columns without data are sent empty.
        whole = columns if source in self._canvases else {**{name: [] for name in before}, **columns}
        if not _same(whole, before):
            self._sent[source] = whole
            self.wire.put(source, whole)


def _same(left: Any, right: Any) -> bool:
    """Return whether two columns, or mappings and lists of columns, contain equal numbers."""
    if left is right:
        return True
    if isinstance(left, np.ndarray) or isinstance(right, np.ndarray):
        return (
            isinstance(left, np.ndarray)
            and isinstance(right, np.ndarray)
            and left.shape == right.shape
            and bool(np.array_equal(left, right))
        )
    if isinstance(left, Mapping) and isinstance(right, Mapping):
        return left.keys() == right.keys() and all(_same(value, right[name]) for name, value in left.items())
    if isinstance(left, list) and isinstance(right, list):
        return len(left) == len(right) and all(map(_same, left, right))
    return bool(left == right)
