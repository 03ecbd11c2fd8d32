"""One picture of the state that a link describes, with all that it shows computed to the end."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, TypeVar

from hess_explorer.protocol.parameters import CLIENT, Choice, Link, Value, Values, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views.layers import Axes, Columns
from hess_explorer.views.picture import Picture
from hess_mechanics.errors import InvalidParameter

__all__ = ["CLIENT_KEPT", "Address", "Shown", "address", "complete", "picture_of", "show", "shown"]

T = TypeVar("T")

_ROUNDS = 100
"""What is found may ask for more: an orbit diagram there and back comes in 40 parts, each from the one before."""
CLIENT_KEPT = tuple(spec for spec in CLIENT if spec.name != "speed")
"""What the browser keeps of a state and a file shows: the time, and how the spheres are turned."""
_DEFAULTS = {spec.name: spec.default for spec in CLIENT_KEPT}


@dataclass(frozen=True)
class Address:
    """Which picture of which state: what a link says, put right.  Nothing is computed yet.

    values : the parameters as they were admitted; client : time of the player and turn of the spheres, by key.
    notes : what had to be changed in the link.
    """

    scene: Scene[Any]
    picture: Picture[Any]
    values: Mapping[str, Value]
    client: Mapping[str, float]
    notes: tuple[str, ...] = ()

    @property
    def link(self) -> str:
        """The query of the state: what follows ? in its address."""
        return encode(self.scene.name, self.values) + "".join(
            f"&{name}={value!r}" for name, value in self.looks.items()
        )

    @property
    def looks(self) -> dict[str, float]:
        """Those of the time and the turn that are not as at first."""
        return {name: value for name, value in self.client.items() if value != _DEFAULTS[name]}


@dataclass(frozen=True)
class Shown:
    """A picture of one state.

    values : the parameters as they were admitted; client : time of the player and turn of the spheres, by key.
    columns : of all its sources, by source; axes : its axes, None for pictures that have none.
    title, caption : what the page says over it; status : level, errors and drift of what was computed, without times.
    notes : what had to be changed in the link, and what the page notes of the state.
    """

    scene: Scene[Any]
    picture: Picture[Any]
    values: Mapping[str, Value]
    client: Mapping[str, float]
    state: Any
    columns: Mapping[str, Columns]
    axes: Axes | None
    title: str
    caption: str
    status: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def link(self) -> str:
        """The query of the state: what follows ? in its address."""
        return Address(self.scene, self.picture, self.values, self.client).link

    @property
    def facts(self) -> dict[str, Any]:
        """What every file says of itself."""
        return {
            "link": self.link,
            "scene": self.scene.name,
            "picture": self.picture.name,
            "title": self.title,
            "caption": self.caption,
            "parameters": dict(self.values),
            "status": list(self.status),
            "notes": list(self.notes),
            "program": f"hess-explorer {version('hess-explorer')}",
        }

    @property
    def said(self) -> str:
        """The same in one paragraph, for files whose metadata are sentences."""
        parameters = ", ".join(f"{name} = {value}" for name, value in self.values.items())
        return f"{self.facts['program']}, ?{self.link} | {parameters} | {'; '.join(self.status)}" + "".join(
            f" | {note}" for note in self.notes
        )


def shown(query: str, picture: str = "", *, lenient: bool = False) -> Shown:
    """The picture of that name, else the first one, of the state that a query describes.

    lenient : as in `address`.

    Raises
    ------
    InvalidParameter : the scene has no such picture, or the query is wrong.
    ModelError : the state cannot be computed.
    """
    return show(address(query, picture, lenient=lenient))


def address(query: str, picture: str = "", *, lenient: bool = False) -> Address:
    """Return what a query describes.

    lenient : whether what is wrong in the query is put right and noted; else it is refused.

    Raises
    ------
    InvalidParameter : the scene has no such picture, or the query is wrong.
    """
    known = scenes()
    link = Link(query, lenient)
    scene = known[str(link.value(Choice("scene", "Scene", tuple(known), next(iter(known)))))]
    link.require(scene.name, [spec.name for spec in scene.specs])
    client = {name: float(value) for name, value in link.values(CLIENT_KEPT).items()}
    values, changed = scene.admit(link.values(scene.specs))
    for note in changed:
        link.note(note)
    return Address(scene, picture_of(scene, picture), values, client, tuple(link.notes))


def picture_of(scene: Scene[Any], name: str) -> Picture[Any]:
    """The picture of that name, the first one without a name.  Raises `InvalidParameter`."""
    if name and name not in scene.pictures:
        raise InvalidParameter(
            f"The scene {scene.name} has no picture {name!r}: choose one of {', '.join(scene.pictures)}."
        )
    return next(view for view in scene.views if name in ("", view.name))


def show(address: Address) -> Shown:
    """The picture, with all that it shows computed to the end.  Raises `ModelError`."""
    scene, view = address.scene, address.picture
    state, (columns, axes, title, caption, status, said) = complete(
        scene, address.values, [view.name], lambda state: _said(view, state)
    )
    return Shown(
        scene,
        view,
        address.values,
        address.client,
        state,
        columns,
        axes,
        title,
        caption,
        (f"accuracy: {state.work.chosen}", *status),
        tuple(dict.fromkeys([*address.notes, *said])),
    )


def complete(scene: Scene[Any], values: Values, pictures: Collection[str], made: Callable[[Any], T]) -> tuple[Any, T]:
    """The state with all that these pictures ask for, and what is `made` of it.  Raises `ModelError`."""
    for _ in range(_ROUNDS):
        state = scene.compute(values, pictures, False)
        found = made(state)
        if not state.work.todo:
            break
        for task in state.work.todo:
            state.work.get(task.function, *task.arguments)
    return state, found


def _said(view: Picture[Any], state: Any) -> tuple[Any, ...]:
    """What a picture shows of a state, and what is said of it."""
    title, _, caption = view.said(state).partition("\n")
    axes = view.ranges(state) or view.first_axes
    columns = dict(state.drawn)
    for source, more in view.framed(state, axes).items():
        columns[source] = {**columns.get(source, {}), **more}
    return columns, axes, title, caption, tuple(state.status()), tuple(state.notes())
