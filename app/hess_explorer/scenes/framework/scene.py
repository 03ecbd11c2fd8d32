"""Scenes: a state with its parameters, its pictures and its texts."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import InitVar, dataclass, field, replace
from functools import cached_property
from html import escape
from pathlib import Path
from typing import Any, ClassVar, Generic, Self, TypeVar, cast

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import ChoiceSpec, NumberSpec, Spec, Value, Values
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.chart import with_chart
from hess_explorer.scenes.framework.chart_picture import chart_picture
from hess_explorer.scenes.framework.charted import Charts
from hess_explorer.scenes.framework.part import Host, Part, part
from hess_explorer.scenes.framework.sliders import Slider, specs_of
from hess_explorer.scenes.framework.swarm import SWARM, Swarm, with_swarm
from hess_explorer.scenes.framework.swarm_picture import spread_picture
from hess_explorer.scenes.framework.trial import Trial, bare_state, orbit_trial, sufficient_level
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.layers import Columns, Sign
from hess_explorer.views.picture import Picture
from hess_explorer.views.theme import to_css
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import LEVELS, Kind, Level, Plan

S = TypeVar("S", bound="State")
T = TypeVar("T")

_INCLUDE = re.compile(r"^```\{include\} (\S+)\n```$", re.MULTILINE)
"""A file whose text several scenes have, as MyST writes it."""


class Preset:
    """A named state: the differences from the scene's defaults.

    Parameters
    ----------
    name : str
        Title in the menu.
    **values : float or str
        Values of parameters by name.
    """

    def __init__(self, name: str, **values: Value) -> None:
        self.name = name
        self.values: Values = values


@dataclass(frozen=True)
class Motion:
    """One motion of a system, as "Speed and accuracy" measures it.

    Attributes
    ----------
    system : System
        The system.
    start : tuple of float
        Initial state (d,).
    parameters : tuple of float
        Values of the system's parameters.
    duration : float
        Duration in the units of the computation.
    weights : tuple of float
        Pixels of the scene's pictures per unit of each variable, (d,).
    unit : float
        Factor from the time of the computation to the time t of the page.
    """

    system: System
    start: tuple[float, ...]
    parameters: tuple[float, ...]
    duration: float
    weights: tuple[float, ...]
    unit: float = 1.0

    @property
    def arguments(self) -> tuple[str, tuple[float, ...], tuple[float, ...], float]:
        """The arguments of `work_precision`: name of the system, start, parameters and duration."""
        return self.system.name, self.start, self.parameters, self.duration


@dataclass(frozen=True)
class Report:
    """The texts beside the pictures.

    Attributes
    ----------
    quantities : sequence of str
        Derived quantities, one line each.
    status : str
        The status line.
    notes : sequence of str
        Notes on the state.
    todo : sequence of Task
        Background computations whose results are still missing.
    total : int
        Number of all background computations of the state, known ones included.
    summary : str
        The short status line.
    """

    quantities: Sequence[str]
    status: str
    notes: Sequence[str]
    todo: Sequence[Task[Any]]
    total: int
    summary: str


@dataclass(frozen=True)
class State:
    """One state of a scene: its fields are the parameters, its cached properties the results.

    A property is computed once, when a visible picture needs it.  Results that later states can use go through `work`
    into the process-wide cache.

    Attributes
    ----------
    work : Work
        Level of accuracy and cache.
    visible : frozenset of str
        Names of the visible pictures.
    sources : dict of str to Columns
        Columns of these pictures by data source; filled in by `Scene.draw`.
    """

    work: Work = field(default_factory=Work, kw_only=True, compare=False, repr=False)
    visible: frozenset[str] = field(default=frozenset(), kw_only=True, compare=False, repr=False)
    sources: dict[str, Columns] = field(default_factory=dict, kw_only=True, compare=False, repr=False)

    @property
    def level(self) -> Level:
        """The level of accuracy; during a drag at most the cheapest level with an error below half a pixel."""
        return self.work.level

    @property
    def is_preview(self) -> bool:
        """True while a slider is held."""
        return self.work.is_preview

    def plan(self, kind: Kind, steady: bool = False) -> Plan:
        """Return the settings of the level for a kind of computation.

        Parameters
        ----------
        kind : Kind
            The kind of computation.
        steady : bool
            True if hardly any slider changes the result.
        """
        return self.work.plan(kind, steady)

    def peek(self, name: str) -> Any | None:
        """Return the value of a cached property if it has been computed, otherwise None."""
        return vars(self).get(name)

    def pending_caption(self, what: str = "") -> str:
        """Return the caption of a result that is not known yet, see `Work.pending_caption`."""
        return self.work.pending_caption(what)

    def parts(self) -> tuple[Part[Host], ...]:
        """Return the parts declared with `@part`, in the order of their declarations."""
        bases = reversed(type(self).__mro__)
        names = dict.fromkeys(name for base in bases for name, one in vars(base).items() if isinstance(one, part))
        return tuple(getattr(self, name) for name in names)

    def with_values(self, values: Values) -> Self:
        """Return the state with other values of some parameters."""
        typed: dict[str, Any] = dict(values)
        return replace(self, **typed)

    def valid_state(self, notes: list[str]) -> Self:
        """Return the state with its parameters clamped to a valid state; append a note for each change.

        May raise `ModelError` if there is no such state.
        """
        return self.with_values({name: value for one in self.parts() for name, value in one.corrections(notes).items()})

    def limits(self) -> Mapping[str, Slider]:
        """Return the ranges of sliders that depend on the state, by parameter; by default none.

        Raises `ModelError` if they cannot be determined.
        """
        return {}

    def idle_values(self) -> Mapping[str, float]:
        """Return the parameters without effect in this state, with the values shown by their disabled controls.

        Raises `ModelError` if they cannot be determined.
        """
        return {name: value for one in self.parts() for name, value in one.idle_values().items()}

    def meanings(self) -> Mapping[str, str]:
        """Return the meanings, as `NumberSpec.meaning`, of the parameters whose meaning depends on a choice."""
        return {name: meaning for one in self.parts() for name, meaning in one.meanings().items()}

    def adjustments(self, before: Self) -> Values:
        """Return the parameter changes that keep the motion continuous after a different choice.

        Raises `ModelError` if they cannot be determined.
        """
        return {
            name: value
            for one, other in zip(self.parts(), before.parts(), strict=True)
            for name, value in one.adjustments(other).items()
        }

    def motion(self) -> Motion | None:
        """Return the current motion, for "Speed and accuracy"; None without a motion.  Raises `ModelError`."""
        return None

    def quantities(self) -> Iterable[str]:
        """Return derived quantities, one line each."""
        return (line for one in self.parts() for line in one.quantities())

    def status(self) -> Iterable[str]:
        """Return entries of the status line: size, cost and error of the results."""
        return (entry for one in self.parts() for entry in one.status())

    def notes(self) -> Iterable[str]:
        """Return the notes on this state."""
        return (note for one in self.parts() for note in one.notes())


@dataclass(frozen=True, repr=False)
class Scene(Generic[S]):
    """One scene of the explorer.

    Parameters
    ----------
    state : type
        Class of its states.
    module : str
        File that declares the scene (`__file__`); the Markdown file of the same name contains the text.
    title : str
        A few words.
    summary : str
        A sentence for the menu.
    presets : tuple of Preset
        Named states; a new visitor sees the first one.
    views : tuple of Picture
        The pictures.  Only the results for visible pictures are computed.
    tracks : mapping of str to callable
        Columns shared by several pictures and the player, which follows the column t of "orbit".
    angles : tuple of str
        Columns of "orbit" that are angles, in radians.
    level_trials : tuple of Trial
        Computations in addition to the motion whose cost and error are measured at each level.
    charts : Charts, optional
        Numbers that can be charted over the parameters.
    swarm : Swarm, optional
        The starts and columns of a swarm.
    place : int
        Position in the menu; the first scene opens the page.
    group : str
        Heading in the menu.
    essential : tuple of str
        Parameters whose controls are open; the others are folded into their groups.
    handle : str
        Suggested first drag: a parameter (by default the first essential one) or "picture/layer".
    answers : tuple of Answer
        Sentences above the pictures: the first one that holds is shown, or else the summary.
    lead : tuple of str
        Pictures that lead; the others stand in a strip beside them.  By default the first one.
    """

    state: type[S]
    module: str
    title: str
    summary: str
    presets: tuple[Preset, ...]
    views: tuple[Picture[S], ...]
    tracks: Mapping[str, Callable[[S], Columns | None]] = field(default_factory=dict)
    angles: tuple[str, ...] = ()
    level_trials: tuple[Trial[S], ...] = ()
    charts: InitVar[Charts | None] = None
    swarm: InitVar[Swarm[S] | None] = None
    place: int = 0
    group: str = ""
    essential: tuple[str, ...] = ()
    handle: str = ""
    answers: tuple[Answer[S], ...] = ()
    lead: tuple[str, ...] = ()
    chart_set: ClassVar[Charts | None] = None

    def __post_init__(self, charts: Charts | None, swarm: Swarm[S] | None) -> None:
        """Add the swarm and the chart to states and pictures."""
        object.__setattr__(self, "chart_set", charts)
        if swarm is not None:
            object.__setattr__(self, "state", with_swarm(self.state, swarm))
            object.__setattr__(self, "views", (*self.views, spread_picture()))
            object.__setattr__(self, "tracks", {**self.tracks, SWARM: lambda s: s.swarm_part.track()})
        if charts is not None:
            object.__setattr__(self, "state", with_chart(self.state, charts))
            object.__setattr__(self, "views", (*self.views, chart_picture(charts)))

    @cached_property
    def name(self) -> str:
        """The name in links."""
        return Path(self.module).stem.replace("_", "-")

    @property
    def origin(self) -> str | None:
        """The name of the scene whose motion this one measures; None for ordinary scenes."""
        return None

    @cached_property
    def _text(self) -> tuple[str, str]:
        """The front matter of the Markdown file, and its body with all included files."""
        path = Path(self.module).with_suffix(".md")
        text = _INCLUDE.sub(
            lambda part: (path.parent / part[1]).read_text(encoding="utf-8").rstrip(), path.read_text(encoding="utf-8")
        )
        found = re.match(r"---\nmoves: (.+)\n---\n", text)
        assert found is not None, self.module
        return found[1], "\n" * found[0].count("\n") + text[found.end() :]

    @property
    def words(self) -> str:
        """The text: Markdown with formulas."""
        return self._text[1]

    @property
    def moves(self) -> str:
        """A sentence on the effect of the controls."""
        return self._text[0]

    def answer(self, state: S) -> str:
        """Return the sentence on a state: that of the first answer that applies, or the summary.

        Raises `ModelError` if a condition does.
        """
        return next((one.sentence for one in self.answers if one.condition(state)), self.summary)

    def drawing(self, name: str) -> str:
        """Return the text of an SVG file to which the Markdown text refers."""
        return Path(self.module).with_name(name).read_text(encoding="utf-8")

    @cached_property
    def signs(self) -> tuple[Sign, ...]:
        """The entries of the legend: the distinct signs of all pictures."""
        return tuple(dict.fromkeys(replace(sign, least=None) for view in self.views for sign in view.legend))

    def visible_signs(self, there: Collection[Sign]) -> str:
        """Return the indices in `signs` of the visible legend entries, separated by commas."""
        known = {replace(sign, least=None) for sign in there}
        return ",".join(str(i) for i, sign in enumerate(self.signs) if sign in known)

    @cached_property
    def legend(self) -> str:
        """The legend of all pictures as an HTML list, one entry per sign."""
        items = (
            f'<li><span class="{sign.kind}" style="{to_css(sign.style)}"></span>{escape(sign.label)}</li>'
            for sign in self.signs
        )
        return f'<ul class="legend" aria-label="Legend">{"".join(items)}</ul>'

    @cached_property
    def specs(self) -> tuple[Spec, ...]:
        """The parameters."""
        return specs_of(self.state)

    @property
    def pictures(self) -> tuple[str, ...]:
        """The names of the pictures."""
        return tuple(view.name for view in self.views)

    @property
    def open_pictures(self) -> tuple[str, ...]:
        """The names of the pictures that are open at first."""
        return tuple(view.name for view in self.views if not view.button)

    @property
    def dots(self) -> dict[str, tuple[str, str]]:
        """The two columns of "orbit" that each moving point follows, by data source."""
        return {source: columns for view in self.views for source, columns in view.followers.items()}

    @property
    def has_motion(self) -> bool:
        """True if "Speed and accuracy" can measure its motion."""
        return self.state.motion is not State.motion

    @property
    def trials(self) -> tuple[Trial[S], ...]:
        """The trials of all its computations, the motion first."""
        return (orbit_trial(), *self.level_trials) if self.has_motion else self.level_trials

    def defaults(self) -> dict[str, Value]:
        """Return the default value of each parameter."""
        return {spec.name: spec.default for spec in self.specs}

    def example(self, preset: Preset) -> dict[str, Value]:
        """Return the values that a preset sets: all parameters, except choices that no preset of the scene sets."""
        given = {name for one in self.presets for name in one.values}
        plain = {one.name: one.default for one in self.specs if not isinstance(one, ChoiceSpec) or one.name in given}
        return {**plain, **preset.values}

    def of(self, values: Values, visible: Collection[str] = (), is_preview: bool = False) -> S:
        """Return the state of these values, without computing anything.

        Parameters
        ----------
        values : mapping of str
            Values of all parameters by name.
        visible : collection of str
            Names of the visible pictures.
        is_preview : bool
            True while a slider is held.
        """
        work = Work(str(values.get("accuracy", "standard")), is_preview)
        typed: dict[str, Any] = {
            spec.name: float(values[spec.name]) if isinstance(spec, NumberSpec) else str(values[spec.name])
            for spec in self.specs
        }
        return self.state(**typed, work=work, visible=frozenset(visible))

    def admit(self, values: Values) -> tuple[dict[str, Value], list[str]]:
        """Clamp the values to a valid state; return them and a note for each change.

        If `State.valid_state` raises `ModelError`, they are only clamped to the bounds of each parameter.
        """
        within: dict[str, Value] = {}
        notes: list[str] = []
        for spec in self.specs:
            within[spec.name], note = spec.read(values[spec.name])
            notes += [note] if note else []
        try:
            state = self.of(within).valid_state(notes)
        except ModelError:
            # `of` accepts an impossible state; the error is raised when it is computed.
            return within, notes
        return {spec.name: cast(Value, getattr(state, spec.name)) for spec in self.specs}, notes

    def limits(self, values: Values) -> Mapping[str, Slider]:
        """Return slider ranges (low, high, step) that depend on the state; `values` are from `admit`.

        Empty if they cannot be determined.
        """
        return _or_nothing(lambda: self.of(values).limits())

    def idle_values(self, values: Values) -> Mapping[str, float]:
        """Return the parameters without effect in a valid state, with the values that their controls show.

        Empty if they cannot be determined.
        """
        return _or_nothing(lambda: self.of(values).idle_values())

    def adjustments(self, before: Values, values: Values) -> Values:
        """Return the parameter changes that keep the motion continuous after other choices.

        Empty if they cannot be determined.
        """
        return _or_nothing(lambda: self.of(values).adjustments(self.of(self.admit(before)[0])))

    def _meanings(self, values: Values) -> Mapping[str, str]:
        """Return the meanings of the numbers and choices of a state by name, except those without effect."""
        labels = {
            spec.name: (isinstance(spec, NumberSpec) and spec.meaning) or spec.label
            for spec in self.specs
            if isinstance(spec, NumberSpec | ChoiceSpec)
        }
        idle = self.idle_values(values)
        return {name: meaning for name, meaning in {**labels, **self.of(values).meanings()}.items() if name not in idle}

    def transfer(self, there: Values, before: Scene[Any], values: Values) -> dict[str, Value]:
        """Return values of this scene, with those changed in another scene for parameters with the same meaning.

        Parameters
        ----------
        there : mapping of str
            Values of this scene.
        before : Scene
            The other scene.
        values : mapping of str
            Its values.  Those equal to its defaults, or out of bounds in this scene, are not transferred.
        """
        defaults, mine, its = before.defaults(), self._meanings(there), before._meanings(values)
        taken = {
            spec.name: values[spec.name]
            for spec in self.specs
            if spec.name in mine
            and mine[spec.name] == its.get(spec.name)
            and values[spec.name] != defaults[spec.name]
            and spec.read(values[spec.name])[1] is None
        }
        return {**there, **taken}

    def compute(self, values: Values, visible: Collection[str], is_preview: bool) -> S:
        """Return a state with the results for the pictures `visible`, see `of`.  Raises `ModelError`."""
        return self.draw(self.of(values, visible, is_preview))

    def draw(self, state: S) -> S:
        """Compute the columns of all visible pictures and return the state.  Raises `ModelError`."""
        self._settle(state)
        views = [view for view in self.views if view.name in state.visible]
        shown = state.visible.union(*(view.dependencies for view in views))
        for view in self.views:
            if view.name in shown:
                state.sources.update(view.data(state))
        # Every picture with a moving point shows the swarm.
        for name in frozenset({SWARM} & {*self.tracks}).union(*(view.tracks for view in views)):
            state.sources[f"data-{name}"] = self.tracks[name](state) or {}
        return state

    def visible_trials(self, state: S) -> Iterator[tuple[Trial[Any], State]]:
        """Yield the trials of the visible pictures, each with the state to compute, without accuracy and visibility."""
        plain = bare_state(state)
        return (
            (trial, plain)
            for trial in self.trials
            if trial.condition(state) and (not trial.pictures or state.visible.intersection(trial.pictures))
        )

    def _settle(self, state: S) -> None:
        """Set the level of "auto" to the cheapest one with an invisible error in all visible pictures, if measured."""
        if not state.work.auto or state.is_preview:
            return
        found = [
            state.work.need(Task(sufficient_level, trial, plain), preview=None)
            for trial, plain in self.visible_trials(state)
        ]
        known = [name for name in found if name is not None]
        if known and len(known) == len(found):
            state.work.set_measured_level(max(known, key=[*LEVELS].index))


def _or_nothing(compute: Callable[[], Mapping[str, T]]) -> Mapping[str, T]:
    """Return the mapping; empty if its computation raises `ModelError`."""
    try:
        return compute()
    except ModelError:
        return {}
