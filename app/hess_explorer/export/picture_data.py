"""A picture of the state that a link describes, with complete data."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, TypeVar

from hess_explorer.protocol.specs import CLIENT, ChoiceSpec, Link, Value, Values, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.views.layers import Axes, Columns
from hess_explorer.views.picture import Picture
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter

T = TypeVar("T")

_ROUNDS = 100
"""Maximum number of rounds, because results may add tasks: an orbit diagram there and back takes 40."""
CLIENT_KEPT = tuple(spec for spec in CLIENT if spec.name != "speed")
"""The parameters that the browser keeps and a file uses: the time, and the view of spheres."""
_DEFAULTS = {spec.name: spec.default for spec in CLIENT_KEPT}


@dataclass(frozen=True)
class Address:
    """A picture of a state that is not computed yet.

    Attributes
    ----------
    scene : Scene
        The scene.
    picture : Picture
        The picture.
    values : mapping of str to float or str
        Admitted values of the parameters.
    client : mapping of str to float
        Time and view of spheres, by key of the link.
    notes : tuple of str
        Corrections of the link.
    """

    scene: Scene[Any]
    picture: Picture[Any]
    values: Mapping[str, Value]
    client: Mapping[str, float]
    notes: tuple[str, ...] = ()

    @property
    def link(self) -> str:
        """The query of the state, without "?"."""
        return encode(self.scene.name, self.values) + "".join(
            f"&{name}={value!r}" for name, value in self.view_values.items()
        )

    @property
    def view_values(self) -> dict[str, float]:
        """The values of time and view that differ from their defaults."""
        return {name: value for name, value in self.client.items() if value != _DEFAULTS[name]}


@dataclass(frozen=True, kw_only=True)
class PictureData(Address):
    """A picture of a state, with its data.

    Attributes
    ----------
    state : State
        The state of the scene.
    columns : mapping of str
        Columns of the picture by data source.
    axes : Axes or None
        Axis ranges; None for a picture without axes.
    title, caption : str
        Texts above the picture.
    status : tuple of str
        Accuracy, errors and drift, without run times.
    notes : tuple of str
        Corrections of the link, and notes on the state.
    """

    state: Any
    columns: Mapping[str, Columns]
    axes: Axes | None
    title: str
    caption: str
    status: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the axes of a plot; empty for other pictures."""
        return self.picture.names(self.state) if isinstance(self.picture, Plot) else ()

    @property
    def facts(self) -> dict[str, Any]:
        """The metadata of the picture, which exported files contain."""
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
    def metadata_text(self) -> str:
        """The metadata as one paragraph, for formats whose metadata are text."""
        parameters = ", ".join(f"{name} = {value}" for name, value in self.values.items())
        return f"{self.facts['program']}, ?{self.link} | {parameters} | {'; '.join(self.status)}" + "".join(
            f" | {note}" for note in self.notes
        )

    @property
    def texts(self) -> dict[str, str]:
        """The metadata of a PNG file by keyword."""
        return {
            "Title": self.title,
            "Description": self.metadata_text,
            "Comment": self.caption,
            "Software": self.facts["program"],
        }


def picture_data(query: str, picture: str = "", *, lenient: bool = False) -> PictureData:
    """Return a picture of the state that a query describes, with its data.

    Parameters
    ----------
    query, picture, lenient
        As in `address`.

    Returns
    -------
    PictureData
        The picture and its data.

    Raises
    ------
    InvalidParameter
        If the scene has no such picture, or the query is invalid.
    ModelError
        If the state cannot be computed.
    """
    return compute(address(query, picture, lenient=lenient))


def address(query: str, picture: str = "", *, lenient: bool = False) -> Address:
    """Return the picture and state that a query describes, without computing them.

    Parameters
    ----------
    query : str
        Query of the state.
    picture : str
        Name of the picture; the first picture by default.
    lenient : bool
        True to correct errors and append notes; False to raise an error.

    Returns
    -------
    Address
        The picture and the state.

    Raises
    ------
    InvalidParameter
        If the scene has no such picture, or the query is invalid and `lenient` is False.
    """
    known = scenes()
    link = Link(query, lenient)
    scene = known[str(link.value(ChoiceSpec("scene", "Scene", tuple(known), next(iter(known)))))]
    link.require(scene.name, scene.specs)
    client = {name: float(value) for name, value in link.values(CLIENT_KEPT).items()}
    values, changed = scene.admit(link.values(scene.specs))
    for note in changed:
        link.note(note)
    return Address(scene, picture_of(scene, picture), values, client, tuple(link.notes))


def picture_of(scene: Scene[Any], name: str) -> Picture[Any]:
    """Return the picture of that name, by default the first one.  Raises `InvalidParameter`."""
    if name != "" and name not in scene.pictures:
        raise InvalidParameter(
            f"The scene {scene.name} has no picture {name!r}: choose one of {', '.join(scene.pictures)}."
        )
    return next(view for view in scene.views if name in ("", view.name))


def compute(address: Address) -> PictureData:
    """Return a picture with complete data.  Raises `ModelError` if the state cannot be computed."""
    _, data = complete(
        address.scene, address.values, [address.picture.name], lambda state: _picture_data(address, state)
    )
    return data


def complete(
    scene: Scene[Any], values: Values, pictures: Collection[str], result_of: Callable[[Any], T]
) -> tuple[Any, T]:
    """Return a state with all data of some pictures, after computing its tasks round by round.

    Parameters
    ----------
    scene : Scene
        The scene.
    values : mapping of str
        Values of its parameters.
    pictures : collection of str
        Names of the pictures.
    result_of : callable
        Draws the pictures of a state and returns a result; called in each round.

    Returns
    -------
    state : State
        The state.
    result
        The last result of `result_of`.

    Raises
    ------
    ModelError
        If the state cannot be computed.
    """
    for _ in range(_ROUNDS):
        state = scene.compute(values, pictures, False)
        found = result_of(state)
        if not state.work.todo:
            break
        for task in state.work.todo:
            state.work.need(task)
    return state, found


def _picture_data(address: Address, state: Any) -> PictureData:
    """Return a picture with the data computed so far."""
    view = address.picture
    caption = view.full_caption(state)
    axes = view.ranges(state, view.first_axes)
    columns = dict(state.sources)
    for source, more in view.data_in_axes(state, axes, columns).items():
        columns[source] = {**columns.get(source, {}), **more}
    return PictureData(
        address.scene,
        view,
        address.values,
        address.client,
        tuple(dict.fromkeys([*address.notes, *state.notes()])),
        state=state,
        columns=columns,
        axes=axes,
        title=caption.title,
        caption=caption.words,
        status=(f"accuracy: {state.work.level_name}", *state.status()),
    )
