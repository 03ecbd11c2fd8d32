"""A scene of the page for any system of differential equations."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, make_dataclass
from typing import Any

import numpy as np

from hess_explorer.library.own_state import LevelState, OwnState
from hess_explorer.protocol.expressions import NotANumber
from hess_explorer.protocol.expressions import evaluate as number_of
from hess_explorer.protocol.specs import Value, points_text
from hess_explorer.scenes.framework.charted import Charts, motion_charts
from hess_explorer.scenes.framework.part import part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import number, points
from hess_explorer.scenes.parts.orbits.exponent import exponent_picture
from hess_explorer.scenes.parts.sections import (
    SectionBranch,
    branch_picture,
    colouring,
    coordinate_of_branch,
    end_of_branch,
    first_point,
    orbit_picture,
    parameter_of_branch,
    section_layers,
    section_picture,
)
from hess_explorer.views.layers import Columns
from hess_explorer.views.picture import Picture
from hess_explorer.views.space.poisson_sphere import Sphere, gamma_columns
from hess_mechanics.catalogue import computations_of
from hess_mechanics.dynamics.cells import even_points
from hess_mechanics.dynamics.system import System
from hess_mechanics.dynamics.variable_section import VariableSection, variable_section
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.arguments import check_arguments
from hess_mechanics.parameters import Group

_EXPONENT, _BRANCH, _CHART = "exponent", "branch", "chart"
_SECTION = re.compile(r"section(?: (?!on )(\S+) (\S+))?(?: at (\S+) *= *(\S+))?(?: on (.+))?")
_FARTHEST = 1e6
_MOST_TRIALS = 200
"""Points of a section that are tried as the start of a motion."""
_ESSENTIAL = 4
"""Largest number of parameters whose controls are open at first."""


@dataclass(frozen=True, repr=False)
class OwnScene(Scene[OwnState]):
    """A scene without its own files, created by `hess_explorer.scene`.

    Attributes
    ----------
    text : str
        Text beside the pictures, in Markdown with formulas.
    """

    text: str = ""

    @property
    def words(self) -> str:
        """The text: Markdown with formulas."""
        return self.text

    @property
    def moves(self) -> str:
        """A sentence on the effect of the controls."""
        chosen = "a click in the section chooses" if issubclass(self.state, LevelState) else "the initial values choose"
        return f"The parameters change the equations; {chosen} the motion."


@check_arguments
def scene(
    system: System,
    pictures: Sequence[str] = (),
    *,
    sliders: Mapping[str, tuple[float, float]] | None = None,
    presets: Mapping[str, Mapping[str, float]] | None = None,
    text: str = "",
) -> OwnScene:
    """Create a scene for your own system, with a slider for each parameter and each initial value.

    If the section lies at levels of integrals, these have sliders instead of the initial values, and the scene can
    search for periodic orbits.

    Parameters
    ----------
    system : System
        The system; its example is the first state.
    pictures : sequence of str, optional
        One text for each picture; by default the plane of the first two variables, or the graph of a single one.

        - "x y": orbit in the plane of two variables;
        - "t x": graph of a variable over time;
        - "x y z": direction of the vector of three variables, on a sphere;
        - "exponent": largest Lyapunov exponent over the averaging time;
        - "section", "section x px" or "section x px at y = 0": Poincaré section, optionally with MEGNO as colour.
          Click to choose the motion, scroll or draw a box to zoom;
        - "section x px at y = 0 on E, L": Poincaré section at levels of these integrals;
        - "branch": continuation of a periodic orbit of that section over a parameter or a level;
        - "chart": a number over two of the sliders, such as MEGNO or the largest Lyapunov exponent.
    sliders : mapping of str to (float, float), optional
        Ends of the sliders, by the names of parameters, variables and integrals: increasing, within ±1e6.  Those of a
        coordinate of the section are also its range.
    presets : mapping of str to mapping, optional
        Named states: values by the names of parameters and variables, or integrals if these have sliders instead.  By
        default one preset, the example of the system.
    text : str, optional
        Text beside the pictures, in Markdown with formulas.

    Returns
    -------
    OwnScene
        The scene.  `hess.state(SCENE, …)` returns one of its states; `hess-explorer serve --scene FILE` shows a file
        with `SCENE = hess.scene(…)`.

    Raises
    ------
    InvalidParameter
        If an argument has the wrong type; if a picture, slider or preset names something that the system does not have,
        or a name cannot be used in a link; if a text is not a picture, a picture occurs twice, or there are two
        spheres; if a branch has no section, or the section does not have two coordinates; or if the ends of a slider
        do not increase or exceed ±1e6.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> from hess_mechanics import System
    >>> lorenz = System(
    ...     "lorenz", lambda y, p: (p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]),
    ...     variables="x y z", parameters={"sigma": 10.0, "rho": 28.0, "beta": 8 / 3}, example=(1.0, 1.0, 20.0))
    >>> hess.scene(lorenz, ["x z", "t x", "exponent"], sliders={"rho": (0.0, 50.0)}).pictures
    ('x-z', 't-x', 'exponent')
    """
    section = _section_of(system, pictures)
    fields = _fields(system, section.get("integrals"))
    field_of = {name: field for name, (field, _) in fields.items()}
    for name in (name for values in (presets or {}).values() for name in values):
        _require(system, name, tuple(fields))
    ends = dict(sliders or {})
    for name in ends:
        _require(system, name, tuple(dict.fromkeys((*fields, *system.variables))))
    drawn = [one for one in pictures if one != _CHART] or [_first_picture(system)]
    views = [_picture(system, one, "integrals" in section) for one in drawn]
    names = [view.name for view in views]
    if len(set(names)) < len(names) or sum(isinstance(view, Sphere) for view in views) > 1:
        raise InvalidParameter(f"{system.title}: a picture occurs twice, or there are two spheres: leave one out.")
    sphere = next((view.labels for view in views if isinstance(view, Sphere)), None)

    def track(state: OwnState) -> Columns:
        columns = state.orbit.columns
        if sphere is None:
            return columns
        vector = np.column_stack([columns[name] for name in sphere])
        # Avoid a division by 0 at the origin.
        length = np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-300)
        return {**columns, **gamma_columns(vector / length)}

    controls: list[Any] = [
        (field, float, _slider(system, name, field, default, ends.get(name)))
        for name, (field, default) in fields.items()
    ]
    if section:
        own = _checked_section(system, section)
        section["ranges"] = tuple(ends.get(name, range_) for name, range_ in zip(own.names, own.window, strict=True))
        low, high = (-_FARTHEST, -_FARTHEST), (_FARTHEST, _FARTHEST)
        controls.append(("window", str, points("The window of the section", 2, low, high)))
        controls.append(("indicator", str, colouring(has_density=False)))
        if "integrals" in section:
            controls.append(("place", str, points("Start of the motion", 1, low, high, _point(own))))
        if _BRANCH in names:
            first, second = own.names
            section["branch"] = part(lambda s: SectionBranch(s, s.periodic_orbit, field_of))
            controls += [
                ("over", str, parameter_of_branch(tuple(field_of))),
                ("low", float, end_of_branch("from")),
                ("high", float, end_of_branch("to")),
                ("upwards", str, coordinate_of_branch((first, second))),
            ]
    state = make_dataclass(
        "Motion",
        controls,
        bases=(LevelState if "integrals" in section else OwnState,),
        namespace={"system": system, "angles": system.angles, **section},
        frozen=True,
    )
    chosen: dict[str, Mapping[str, Value]] = {
        title: {field_of[name]: float(value) for name, value in values.items()}
        for title, values in (presets or {"The example of the system": {}}).items()
    }
    variables = f"The variables are {', '.join(system.variables)}"
    parameters = f", the parameters {', '.join(system.parameters)}" if system.parameters else ""
    return OwnScene(
        state,
        f"{re.sub(r'[^a-z0-9]+', '-', system.name.lower()).strip('-') or 'own'}.md",
        title=system.title,
        summary=f"Motions in the variables {', '.join(system.variables)}.",
        group="Your own",
        place=1000,
        presets=tuple(Preset(title, **values) for title, values in chosen.items()),
        views=tuple(views),
        charts=_charts(system, [*field_of.values()]) if _CHART in pictures else None,
        tracks={"orbit": track},
        essential=tuple(field_of.values())[:_ESSENTIAL],
        text=text or f"### {system.title}\n\n{variables}{parameters}.\n",
    )


def _charts(system: System, fields: Sequence[str]) -> Charts:
    """Return the charts over the sliders, initially the first two."""
    motions = motion_charts(system, lambda s: s.chosen_start, lambda s: s.long, computations_of(system))
    first, second = [*fields, "long"][:2]
    return Charts(motions, over=(first, second))


def _section_of(system: System, pictures: Sequence[str]) -> dict[str, Any]:
    """Return surface, coordinates and integrals of the section among the pictures; empty without a section.

    Raises `InvalidParameter`.
    """
    found = next(filter(None, map(_SECTION.fullmatch, pictures)), None)
    if found is None:
        if _BRANCH in pictures:
            raise InvalidParameter(f"{system.title}: a branch needs a section: add the picture section.")
        return {}
    x, y, variable, value, levels = found.groups()
    surface = None
    if variable is not None:
        try:
            surface = _require(system, variable, system.variables), number_of(value)
        except NotANumber as error:
            raise InvalidParameter(f"{system.title}, section at {variable} = {value}: {error}") from error
    section = {"surface": surface, "coordinates": None if x is None else (x, y)}
    if levels is None and _BRANCH not in pictures:
        return section
    integrals = tuple(re.split(r" *, *", levels)) if levels else ()
    known = (*system.integrals(*system.example),)
    return {**section, "integrals": tuple(_require(system, name, known) for name in integrals)}


def _checked_section(system: System, section: Mapping[str, Any]) -> VariableSection:
    """Return the section at the example.  Raises `InvalidParameter` if it does not have two coordinates."""
    found = None
    if len(system.variables) > 2:
        known = {name: float(value) for name, value in system.integrals(*system.example).items()}
        levels = section.get("integrals", [*known][: len(system.variables) - 3])
        found = variable_section(
            system.at(), {name: known[name] for name in levels}, section["surface"], section["coordinates"]
        )
    if found is None or len(found.names) != 2:
        raise InvalidParameter(
            f"{system.title}: its motions have no section with two coordinates: leave out the picture section."
        )
    return found


def _point(section: VariableSection) -> str:
    """Return, as text, where the motion of the example first crosses the section, or else a point with a motion."""
    point = None
    with suppress(ModelError):
        point = first_point(section, section.system.example[0])
    if point is None:
        low, high = np.array(section.window).T
        tried = low + even_points(_MOST_TRIALS).T * (high - low)
        _, there = section.states_at(*tried.T)
        point = tuple(tried[int(np.argmax(there))])
    return points_text([point])


def _fields(system: System, integrals: Sequence[str] | None) -> dict[str, tuple[str, float]]:
    """Return the field and the default of each parameter, and of each variable or, if given, of these integrals.

    Raises `InvalidParameter` if a name cannot be used in a link.
    """
    state, values = system.example
    known = {name: (f"p_{name}", value) for name, value in zip(system.parameters, values, strict=True)}
    if integrals is None:
        known |= {name: (f"y_{name}", value) for name, value in zip(system.variables, state, strict=True)}
    else:
        levels = system.integrals(state, values)
        known |= {name: (f"i_{name}", float(levels[name])) for name in integrals}
    for name, (field, _) in known.items():
        if not field.isidentifier():
            raise InvalidParameter(f"{system.title}: {name!r} cannot be used in a link: name it like x, k2 or ω1.")
    return known


_KINDS: Mapping[str, tuple[str, str, str, Group]] = {
    "p": ("{}", "{}", "A parameter of the equations.", "Body"),
    "y": ("{}(0)", "Initial {}", "The value at t = 0.", "State"),
    "i": ("{}", "Level of {}", "The value of the integral in the section.", "State"),
}
"""Symbol, label, description and group of parameters, initial values and integrals."""


def _slider(system: System, name: str, field: str, default: float, ends: tuple[float, float] | None) -> Any:
    """Return the slider of a parameter, an initial value or an integral.  Raises `InvalidParameter`."""
    symbol, label, doc, group = _KINDS[field[0]]
    around = abs(default) or 1.0 if field[0] == "i" else max(1.0, abs(default))
    low, high = ends or (default - around, default + around)
    if not -_FARTHEST <= low < low + (high - low) / 200.0 < high <= _FARTHEST:
        raise InvalidParameter(
            f"{system.title}: the slider of {name} ({low:g} to {high:g}) needs increasing ends within ±{_FARTHEST:g}."
        )
    return number(
        symbol.format(name),
        default,
        (low, high),
        (high - low) / 200.0,
        bounds=(min(low, -_FARTHEST), _FARTHEST),
        label=label.format(name),
        doc=doc,
        group=group,
        meaning=system.name,
    )


def _require(system: System, name: str, allowed: Sequence[str]) -> str:
    if name not in allowed:
        raise InvalidParameter(f"{system.title} has no {name!r}. Names allowed here: {', '.join(allowed) or 'none'}.")
    return name


def _first_picture(system: System) -> str:
    return " ".join(system.variables[:2]) if len(system.variables) > 1 else f"t {system.variables[0]}"


def _picture(system: System, picture: str, leveled: bool) -> Picture[Any]:
    """Return the picture that a text describes; `leveled` adds periodic orbits to the section.

    Raises `InvalidParameter`.
    """
    if picture == _EXPONENT:
        return exponent_picture()
    if picture == _BRANCH:
        return branch_picture()
    if _SECTION.fullmatch(picture):
        shown = ("megno", "periodic_orbit") if leveled else ("megno",)
        return section_picture(
            layers=section_layers(*shown, ended=lambda s: s.section.points(ends=True)),
            on_box=OwnState.box_window,
        )
    names = picture.split()
    if len(names) == 3:
        a, b, c = (_require(system, name, system.variables) for name in names)
        return Sphere(
            looks={"orbit": "orbit"},
            labels=(a, b, c),
            title=f"Direction of ({a}, {b}, {c})",
            caption=lambda s: s.orbit.caption,
        )
    if len(names) != 2:
        raise InvalidParameter(
            f"{system.title}: {picture!r} is not a picture. Write the names of two variables, t and one of them, three "
            f"for a sphere, section, branch, chart or {_EXPONENT}."
        )
    x, y = _require(system, names[0], ("t", *system.variables)), _require(system, names[1], system.variables)
    return orbit_picture(x, y, f"{y} over {x}", name=f"{x}-{y}")
