"""A state of the explorer as an object: its parameters, and the data and drawings of its pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from numbers import Real
from pathlib import Path
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from hess_explorer.export.code import code
from hess_explorer.export.columns import Table, columns_of
from hess_explorer.export.formats import FileRequest, formats_of
from hess_explorer.export.picture_data import CLIENT_KEPT, Address, PictureData, address, compute, picture_of
from hess_explorer.protocol.specs import NumberSpec, Points, Spec, Value, points_text, query_in, refusal
from hess_explorer.scenes import scene_named, scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.arguments import as_level_name, check_arguments
from hess_mechanics.numerics.files import write_atomically

__all__ = ["SceneState", "from_link", "state"]

_ENDINGS = formats_of("data", "figure", "film")


@dataclass(frozen=True, eq=False)
class SceneState:
    """A state of a scene, created by `state` and `from_link`.

    Pictures are computed on first use and cached.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> state = hess.state("suslov-hess", h=1.2, f=0.3, accuracy="draft")
    >>> state.parameters["h"], state.pictures
    (1.2, ('body', 'omega', 'sphere', 'bifurcation', 'circle', 'surface', 'torus', 'spread', 'chart'))
    >>> state.body.a
    0.2916666666666667
    """

    _address: Address
    _pictures: dict[str, PictureData] = field(default_factory=dict, repr=False)

    @cached_property
    def _state(self) -> Any:
        address = self._address
        return address.scene.of(address.values)

    @property
    def body(self) -> Any:
        """The body, for example a `HessBody` or `SuslovBody`; None if the scene has no body.

        Some scenes have a `Bridge` between two bodies or a `LoxodromicPendulum` instead.

        Raises
        ------
        ModelError
            If no body has these parameters.
        """
        return _first(self._state, ("body", "bridge", "pendulum"))

    @property
    def motion(self) -> Any:
        """The motion of the scene: system, initial state, parameters and duration; None without a motion.

        Raises
        ------
        ModelError
            If the motion does not exist for these parameters.
        """
        return self._state.motion()

    @property
    def section(self) -> Any:
        """The Poincaré section with its coordinates; None if the scene has no such section.

        A scene of your own without the picture "section" has the default section of `variable_section`.

        Raises
        ------
        ModelError
            If the section does not exist for these parameters.
        """
        return _first(self._state, ("poincare",))

    @property
    def periodic(self) -> Any:
        """The `PeriodicOrbit` shown in the section; None without a periodic orbit.

        Raises
        ------
        ModelError
            If the state cannot be computed.

        Examples
        --------
        >>> import hess_explorer as hess
        >>> state = hess.state("quartic", Q1=0.0, Q2=0.1, periodic="period 1", accuracy="draft")
        >>> state.periodic.kind, state.periodic.period
        ('elliptic', 1)
        """
        closed = _first(self._picture_data("section").state, ("closed_orbit",)) if "section" in self.pictures else None
        return None if closed is None else closed.orbit

    @property
    def scene(self) -> str:
        """The name of the scene, as in a link."""
        return self._address.scene.name

    @property
    def parameters(self) -> Mapping[str, Value]:
        """The values of the parameters of the scene by name, without `t`, `az` and `el`."""
        return MappingProxyType(dict(self._address.values))

    @property
    def link(self) -> str:
        """The query of the state with "?": append it to the address of any server."""
        return f"?{self._address.link}"

    @property
    def notes(self) -> tuple[str, ...]:
        """Corrections of the link that `from_link` has read with `lenient`; otherwise empty."""
        return self._address.notes

    @property
    def pictures(self) -> tuple[str, ...]:
        """The names of the pictures."""
        return self._address.scene.pictures

    def replace(self, **changes: Any) -> SceneState:
        """Return a copy with some parameters changed.

        Parameters
        ----------
        **changes
            New values by name, as in `state`.

        Returns
        -------
        SceneState
            The changed state.

        Raises
        ------
        InvalidParameter
            If a name, a value or a combination of values is not allowed.

        Examples
        --------
        >>> import hess_explorer as hess
        >>> hess.state("suslov-hess").replace(h=2.0).parameters["h"]
        2.0
        """
        return state(self.scene, **{**self.parameters, **self._address.view_values, **changes})

    def data(self, picture: str = "") -> Table:
        """Return the data of a picture, with the columns of its CSV file.

        Parameters
        ----------
        picture : str
            Name of the picture; the first picture by default.

        Returns
        -------
        Table
            The columns: numbers in double precision, except that points of clouds and swarms are only as precise as the
            page receives them, in single precision and 16 bits; "layer" and other labels are texts.

        Raises
        ------
        InvalidParameter
            If the scene has no such picture.
        ModelError
            If the state cannot be computed.
        """
        return columns_of(self._picture_data(picture))

    def plot(self, picture: str = "") -> Any:
        """Return a picture as a HoloViews object, which can be combined and restyled.

        Parameters
        ----------
        picture : str
            Name of the picture; the first picture by default.

        Returns
        -------
        holoviews.Overlay or holoviews.RGB
            The layers of a plot; an image of spheres, bodies, tori and clouds, which a headless browser draws.

        Raises
        ------
        InvalidParameter
            If the scene has no such picture.
        MissingLibrary
            If an image needs Matplotlib and it is not installed.
        BrowserError
            If an image needs a browser and there is none.
        ModelError
            If the state cannot be computed.
        """
        from hess_explorer.library.drawing import draw

        return draw(self._picture_data(picture))

    def figure(self, picture: str = "", *, width: float = 85.0, black: bool = False) -> Any:
        """Return a picture as a figure of Matplotlib, as `save` writes it to SVG and PDF.

        Parameters
        ----------
        picture : str
            Name of the picture; the first picture by default.
        width : float
            Width in millimetres, 20 to 400.
        black : bool
            True for black on white instead of the colours of the page.

        Returns
        -------
        matplotlib.figure.Figure
            The figure; `figure.axes[0]` is its Axes.  A sphere, body, torus or cloud is an image with its texts.

        Raises
        ------
        InvalidParameter
            If the scene has no such picture, the width is not supported, or Matplotlib is not installed.
        BrowserError
            If the picture needs a browser and there is none.
        ModelError
            If the state cannot be computed.

        Examples
        --------
        >>> import hess_explorer as hess
        >>> axes = hess.state("suslov-hess", accuracy="draft").figure("circle").axes[0]
        >>> axes.set_xlabel("phase")  # doctest: +ELLIPSIS
        Text(...)
        """
        from hess_explorer.headless.file import figure

        return figure(self._picture_data(picture), width, black)

    def save(
        self, file: str | Path, picture: str = "", *, width: float = 85.0, black: bool = False, seconds: float = 10.0
    ) -> Path:
        """Write a picture to a file; an existing file is replaced when the new one is complete.

        Parameters
        ----------
        file : str or Path
            Name of the file.  Its suffix determines the format: csv and json for data; png, svg and pdf for a figure;
            webm and mp4 for a film.  A headless browser draws films, spheres, bodies, tori and clouds.
        picture : str
            Name of the picture; the first picture by default.
        width : float
            Width in millimetres: of a figure, 20 to 400; of a film, 60 to 160.
        black : bool
            True for black on white instead of the colours of the page.
        seconds : float
            Duration of a film in seconds, 1 to 60.

        Returns
        -------
        Path
            The path of the file.

        Raises
        ------
        InvalidParameter
            If `file` is not a path, the format is unknown, or the scene has no such picture; if width or duration are
            out of range; if nothing moves in a film; or if a library is not installed.
        BrowserError
            If the file needs a browser and there is none.
        ModelError
            If the state cannot be computed.
        OSError
            If the file cannot be written.
        """
        if not isinstance(file, str | Path):
            raise InvalidParameter(f"{file!r} is not the name of a file: write it like 'circle.csv'.")
        path = Path(file)
        kind = path.suffix.removeprefix(".").lower()
        if kind not in _ENDINGS:
            raise InvalidParameter(
                f"The file format {path.suffix!r} is not supported: choose one of .{', .'.join(_ENDINGS)}."
            )
        # Imported here, because numerical data need no drawing libraries.
        from hess_explorer.headless.file import content

        write_atomically(path, content(self._picture_data(picture), FileRequest(kind, width, black, seconds)))
        return path

    def code(self, picture: str = "") -> str:
        """Return Python code that creates this state, computes its data and draws a picture.

        Parameters
        ----------
        picture : str
            Name of the picture; the first picture by default.

        Returns
        -------
        str
            A complete script.

        Raises
        ------
        InvalidParameter
            If the scene has no such picture.

        Examples
        --------
        >>> import hess_explorer as hess
        >>> print(hess.state("loxodrome").code("angle"))  # doctest: +ELLIPSIS
        # ...
        import hess_explorer as hess
        <BLANKLINE>
        state = hess.state(
            "loxodrome", I1=...)
        data = state.data("angle")
        state.plot("angle")
        <BLANKLINE>
        """
        return code(self._at(picture))

    def _at(self, picture: str) -> Address:
        return replace(self._address, picture=picture_of(self._address.scene, picture))

    def _picture_data(self, picture: str) -> PictureData:
        address = self._at(picture)
        if address.picture.name not in self._pictures:
            # The kernels check their results for overflow themselves.
            with np.errstate(all="ignore"):
                self._pictures[address.picture.name] = compute(address)
        return self._pictures[address.picture.name]

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><th>{escape(spec.symbol if isinstance(spec, NumberSpec) else spec.label)}</th>"
            f"<td>{escape(str(self.parameters[spec.name]))}</td></tr>"
            for spec in self._address.scene.specs
            if spec.name in self.parameters
        )
        pictures_html = f"<code>{escape(self.link)}</code><p>Pictures: {escape(', '.join(self.pictures))}.</p>"
        return f"<b>{escape(self._address.scene.title)}</b><table>{rows}</table>{pictures_html}"

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self.parameters.items())
        return f"hess.state({self.scene!r}, {given})"


def state(scene: str | Scene[Any] = "suslov-hess", /, **parameters: Any) -> SceneState:
    """Return the state of a scene with the given parameters.

    Parameters
    ----------
    scene : str or Scene
        Name of the scene, as in a link, or a scene of your own.
    **parameters
        Values by the names that a link uses; all others have the defaults of the page.  In addition to the parameters
        of the scene: `t`, the time of bodies and clouds; `az` and `el`, azimuth and elevation of the view of a sphere
        in radians.

    Returns
    -------
    SceneState
        The state; nothing is computed yet.

    Raises
    ------
    InvalidParameter
        If there is no such scene, or a name, a value or a combination of values is not allowed; the message says what
        is allowed.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> hess.state("suslov-hess", I22=1.5, h=1.2, f=0.3).parameters["I22"]
    1.5
    >>> hess.state("suslov-hess", height=1.2)
    Traceback (most recent call last):
    hess_mechanics.errors.InvalidParameter: The scene suslov-hess has no parameter 'height': choose one of I22, ...
    """
    found = scene if isinstance(scene, Scene) else scene_named(scene) if isinstance(scene, str) else None
    if found is None:
        public = ", ".join(name for name, one in scenes().items() if one.origin is None)
        raise InvalidParameter(f"There is no scene {scene!r}: choose one of {public}.")
    looks = {spec.name: spec for spec in CLIENT_KEPT}
    specs: dict[str, Spec] = {**{spec.name: spec for spec in found.specs}, **looks}
    for name in parameters:
        if name not in specs:
            raise InvalidParameter(
                f"The scene {found.name} has no parameter {name!r}: choose one of {', '.join(specs)}."
            )
    given = {name: _validate(specs[name], value) for name, value in parameters.items()}
    target = {name: given.get(name, spec.default) for name, spec in specs.items()}
    client = {name: float(target.pop(name)) for name in looks}
    values, notes = found.admit(target)
    if notes:
        raise InvalidParameter(" ".join(map(refusal, notes)))
    return SceneState(Address(found, found.views[0], values, client))


@check_arguments
def from_link(link: str, *, lenient: bool = False) -> SceneState:
    """Return the state that a link describes.

    Parameters
    ----------
    link : str
        A link to the page, or its part after "?".
    lenient : bool
        True to correct errors in the link and list them in `notes`; False to raise an error.

    Returns
    -------
    SceneState
        The state; nothing is computed yet.

    Raises
    ------
    InvalidParameter
        If the link is invalid and `lenient` is False.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> state = hess.from_link("http://localhost:5006/?scene=scattering&theta=1.0")
    >>> state.parameters["theta"]
    1.0
    >>> state.notes
    ()
    """
    return SceneState(address(query_in(link), lenient=lenient))


def _validate(spec: Spec, value: Any) -> Value:
    """Return the given value as the value of a parameter.  Raises `InvalidParameter` if it is not allowed."""
    found: Value
    note: str | None
    if isinstance(spec, NumberSpec):
        if isinstance(value, bool) or not isinstance(value, Real):
            raise InvalidParameter(
                f"{value!r} is not a number: {spec.name} ({spec.label}) must be a number {spec.range}."
            )
        found, note = spec.read(cast(float, value))
    elif isinstance(spec, Points) and not isinstance(value, str):
        try:
            pairs = [(float(x), float(y)) for x, y in value]
        except (TypeError, ValueError, OverflowError):
            raise InvalidParameter(f"{spec.name} ({spec.label}) must be a list of pairs [(x, y), …].") from None
        found, note = spec.read(points_text(pairs))
    else:
        found, note = spec.read(as_level_name(value) if isinstance(value, Level) else str(value))
    if note:
        raise InvalidParameter(refusal(note))
    return found


def _first(state: Any, names: tuple[str, ...]) -> Any:
    """Return the value of the first of these names that is a property of the state; None without one."""
    return next(
        (
            getattr(state, name)
            for name in names
            if isinstance(getattr(type(state), name, None), (property, cached_property))
        ),
        None,
    )
