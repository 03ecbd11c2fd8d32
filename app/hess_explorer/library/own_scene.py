"""A scene of the page for any system of differential equations."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, make_dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from hess_explorer.protocol.expressions import NotANumber
from hess_explorer.protocol.expressions import evaluate as number_of
from hess_explorer.protocol.parameters import Value
from hess_explorer.scenes.framework.parameters import accuracy_level, exponent_time, number, time_span
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.scene import Preset, Scene, State
from hess_explorer.scenes.parts.exponent import Exponent, NotPeriodic, exponent_picture
from hess_explorer.scenes.parts.orbit import Orbit, orbit_picture
from hess_explorer.scenes.parts.section import Section, crossings_of_each, section_picture
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Columns
from hess_explorer.views.picture import Picture
from hess_explorer.views.poisson_sphere import Sphere, gamma_columns
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.system import ParametrizedSystem, System
from hess_mechanics.dynamics.variable_section import VariableSection, variable_section
from hess_mechanics.errors import InvalidParameter

__all__ = ["OwnScene", "scene"]

_EXPONENT = "exponent"
_SECTION = re.compile(r"section(?: (\S+) (\S+))?(?: at (\S+) *= *(\S+))?")
_PIXELS = 300.0
"""Size of an orbit in a picture, in pixels."""
_FARTHEST = 1e6
_ESSENTIAL = 4
"""Largest number of parameters whose controls are open at first."""
_CURVE = '<path d="M5 25C9 2 18 2 22 16S34 30 38 12 43 6 44 9" fill="none" stroke="#0072B2" stroke-width="1.8"/>'


@dataclass(frozen=True)
class OwnState(State):
    """A motion of a system; each scene adds the system's parameters, `p_…`, and initial values, `y_…`, as fields."""

    lasts: float = time_span(30.0, 300.0)
    long: float = exponent_time(500.0, 5000.0, 2e4, "the exponent is")
    count: float = crossings_of_each()
    accuracy: str = accuracy_level()

    system: ClassVar[System]
    surface: ClassVar[tuple[str, float] | None] = None
    coordinates: ClassVar[tuple[str, str] | None] = None
    periodic_orbit: ClassVar[NotPeriodic] = NotPeriodic()

    @cached_property
    def body(self) -> ParametrizedSystem:
        """The system with the values of its parameters."""
        return self.system.at([getattr(self, f"p_{name}") for name in self.system.parameters])

    @property
    def start(self) -> Start:
        """The initial values."""
        return tuple(getattr(self, f"y_{name}") for name in self.system.variables)

    @cached_property
    def weights(self) -> tuple[float, ...]:
        """Pixels of the pictures per unit of each variable."""
        return self.work.get(_pixels, self.system)

    @part
    def orbit(self) -> Orbit:
        """The motion."""
        return Orbit(self)

    @part
    def exponent(self) -> Exponent:
        """Its largest Lyapunov exponent."""
        return Exponent(self)

    @cached_property
    def poincare(self) -> VariableSection:
        """The section at the values that the integrals have along the motion."""
        known = self.system.integrals(self.start, self.body.parameters)
        needed = len(self.system.variables) - 3
        values = {name: float(value) for name, value in [*known.items()][:needed]}
        return variable_section(self.body, values, self.surface, self.coordinates)

    @part
    def section(self) -> Section:
        """The crossings of the motion and of others with the same integrals."""
        return Section(self, lambda: self.start)

    def at(self, x: float, y: float) -> dict[str, Value]:
        """Return the initial values at a place of the section; none where no motion crosses it."""
        states, there = self.poincare.states_at(np.array([x]), np.array([y]))
        named = zip(self.system.variables, states[0].tolist(), strict=True)
        return {f"y_{name}": value for name, value in named} if there[0] else {}


def _pixels(system: System) -> tuple[float, ...]:
    """Return pixels per unit of each variable, such that the example of the system fills a picture."""
    states = solve(*system.example_motion, np.linspace(0.0, 30.0, 200), "draft").states
    return tuple((_PIXELS / np.maximum(np.ptp(states, axis=0), 1e-3)).tolist())


@dataclass(frozen=True, repr=False)
class OwnScene(Scene[OwnState]):
    """A scene without files of its own.

    text : what stands beside the pictures, Markdown with formulas.
    """

    text: str = ""

    @property
    def words(self) -> str:
        """The text: Markdown with formulas."""
        return self.text

    @property
    def moves(self) -> str:
        """A sentence on the controls."""
        return "The parameters change the equations, the initial values choose the motion."

    @property
    def thumbnail(self) -> str:
        """The content of the SVG thumbnail."""
        return _CURVE


def scene(
    system: System,
    pictures: Sequence[str] = (),
    *,
    sliders: Mapping[str, tuple[float, float]] | None = None,
    presets: Mapping[str, Mapping[str, float]] | None = None,
    text: str = "",
) -> OwnScene:
    """Return a scene for a system of one's own, with a slider for each parameter and each initial value.

    Parameters
    ----------
    system : System
        The equations of motion; its example is the first state.
    pictures : sequence of str, optional
        One text for each picture: two names of variables for an orbit in their plane, "t" and a name for a graph over
        time, three names for the direction of a vector on a sphere, "exponent" for the largest Lyapunov exponent, and
        "section", "section x px" or "section x px at y = 0" for a Poincaré section, in which a click chooses the
        motion.  By default the plane of the first two variables, or the graph of a single one.
    sliders : mapping of str to (float, float), optional
        Ends of the sliders, by the names of parameters and variables.
    presets : mapping of str to mapping, optional
        Named states: values by the names of parameters and variables.
    text : str, optional
        What stands beside the pictures: Markdown with formulas.

    Returns
    -------
    OwnScene
        The scene.  A file with `SCENE = hess.scene(…)` is shown by `hess-explorer serve --scene FILE`, and
        `hess.state(SCENE, …)` is one of its states.

    Raises
    ------
    InvalidParameter
        If a picture, slider or preset names something else than variables and parameters of the system.

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
    fields = _fields(system)
    for name in {**(sliders or {}), **{name: 0 for values in (presets or {}).values() for name in values}}:
        _require(system, name, tuple(fields))
    views = [_picture(system, one) for one in pictures or [_first_picture(system)]]
    names = [view.name for view in views]
    if len(set(names)) < len(names) or sum(isinstance(view, Sphere) for view in views) > 1:
        raise InvalidParameter(f"{system.title}: each picture may occur once, and one of them may be a sphere.")
    sphere = next((view.labels for view in views if isinstance(view, Sphere)), None)

    def track(state: OwnState) -> Columns:
        columns = state.orbit.columns
        if sphere is None:
            return columns
        vector = np.column_stack([columns[name] for name in sphere])
        # At the origin it has no direction.
        length = np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-300)
        return {**columns, **gamma_columns(vector / length)}

    state = make_dataclass(
        "Motion",
        [
            (field, float, _slider(system, name, default, (sliders or {}).get(name)))
            for name, (field, default) in fields.items()
        ],
        bases=(OwnState,),
        namespace={"system": system, **_section_of(system, pictures)},
        frozen=True,
    )
    _check_section(state, names)
    chosen: dict[str, Mapping[str, Value]] = {
        title: {fields[name][0]: float(value) for name, value in values.items()}
        for title, values in (presets or {"The example of the system": {}}).items()
    }
    return OwnScene(
        state,
        f"{re.sub(r'[^a-z0-9]+', '-', system.name.lower()).strip('-') or 'own'}.md",
        title=system.title,
        summary=f"Motions in the variables {', '.join(system.variables)}.",
        group="Your own",
        place=1000,
        presets=tuple(Preset(title, **values) for title, values in chosen.items()),
        views=tuple(views),
        tracks={"orbit": track},
        essential=tuple(field for field, _ in fields.values())[:_ESSENTIAL],
        text=text or f"### {system.title}\n\n{_summary(system)}\n",
    )


def _section_of(system: System, pictures: Sequence[str]) -> dict[str, Any]:
    """Return surface and coordinates of the section among the pictures.  Raises `InvalidParameter`."""
    found = next(filter(None, map(_SECTION.fullmatch, pictures)), None)
    if found is None:
        return {}
    x, y, variable, value = found.groups()
    surface = None
    if variable is not None:
        try:
            surface = _require(system, variable, system.variables), number_of(value)
        except NotANumber as error:
            raise InvalidParameter(f"{system.title}, section at {variable} = {value}: {error}") from error
    return {"surface": surface, "coordinates": None if x is None else (x, y)}


def _check_section(state: type[OwnState], pictures: Sequence[str]) -> None:
    """Raise `InvalidParameter` if the section cannot be made, or has one coordinate only."""
    if "section" in pictures and len(state().poincare.names) != 2:
        raise InvalidParameter(
            f"{state.system.title}: a picture of a section needs a system of three or more variables."
        )


def _fields(system: System) -> dict[str, tuple[str, float]]:
    """Return the field and the default of each parameter and variable.  Raises `InvalidParameter`."""
    state, values = system.example
    known = {
        **{name: (f"p_{name}", value) for name, value in zip(system.parameters, values, strict=True)},
        **{name: (f"y_{name}", value) for name, value in zip(system.variables, state, strict=True)},
    }
    for name, (field, _) in known.items():
        if not field.isidentifier():
            raise InvalidParameter(f"{system.title}: {name!r} cannot stand in a link: name it like x, k2 or ω1.")
    return known


def _slider(system: System, name: str, default: float, ends: tuple[float, float] | None) -> Any:
    """Return the field of a parameter or an initial value."""
    is_parameter = name in system.parameters
    around = max(1.0, abs(default))
    low, high = ends or (default - around, default + around)
    if not -_FARTHEST <= low < high <= _FARTHEST:
        raise InvalidParameter(
            f"{system.title}: the slider of {name} must have two different ends between ±{_FARTHEST:g}."
        )
    return number(
        name if is_parameter else f"{name}(0)",
        default,
        (low, high),
        (high - low) / 200.0,
        bounds=(min(low, -_FARTHEST), _FARTHEST),
        label=name if is_parameter else f"Initial {name}",
        doc="A parameter of the equations." if is_parameter else "The value at t = 0.",
        group="Body" if is_parameter else "State",
        means=system.name,
    )


def _require(system: System, name: str, allowed: Sequence[str]) -> str:
    if name not in allowed:
        raise InvalidParameter(f"{system.title} has no {name!r}: choose among {', '.join(allowed)}.")
    return name


def _first_picture(system: System) -> str:
    return " ".join(system.variables[:2]) if len(system.variables) > 1 else f"t {system.variables[0]}"


def _picture(system: System, wanted: str) -> Picture[OwnState]:
    """Return the picture that a text asks for.  Raises `InvalidParameter`."""
    if wanted == _EXPONENT:
        return exponent_picture(lambda s: s.exponent)
    if _SECTION.fullmatch(wanted):
        return replace(section_picture(lambda s: s.section, ""), on_click=lambda s, x, y: s.at(x, y))
    names = wanted.split()
    if len(names) == 3:
        a, b, c = (_require(system, name, system.variables) for name in names)
        return Sphere(
            looks={"orbit": "orbit"},
            labels=(a, b, c),
            title=f"Direction of ({a}, {b}, {c})",
            caption=lambda s: Caption(numbers=f"From t = 0 to t = {digits(s.lasts)}."),
        )
    if len(names) != 2:
        raise InvalidParameter(
            f"{system.title}: {wanted!r} is no picture. Write two names of variables, t and one of them, three for a "
            f"sphere, section, or {_EXPONENT}."
        )
    x, y = _require(system, names[0], ("t", *system.variables)), _require(system, names[1], system.variables)
    return orbit_picture(lambda s: s.orbit, x, y, f"{y} over {x}", name=f"{x}-{y}")


def _summary(system: System) -> str:
    variables = f"The variables are {', '.join(system.variables)}"
    return f"{variables}, the parameters {', '.join(system.parameters)}." if system.parameters else f"{variables}."
