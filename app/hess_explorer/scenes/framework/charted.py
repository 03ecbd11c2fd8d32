"""The chart of a scene: a number of the catalogue over two of the scene's parameters, as one of its pictures.

A scene declares the computations and their arguments in a state (`Charts`).  The framework adds the choices of a chart
to the parameters of its states, and the picture to its pictures.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, make_dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from bokeh.palettes import Cividis256

from hess_explorer.compute.cache import Task
from hess_explorer.compute.cells import Outcome, evaluate, refused
from hess_explorer.protocol.parameters import Choice, Number, Places, Spec, Values, places, written
from hess_explorer.scenes.framework.cells import COARSE, found_by_rows
from hess_explorer.scenes.framework.parameters import declared, specs_of
from hess_explorer.scenes.framework.part import Part, part
from hess_explorer.scenes.framework.trial import bare
from hess_explorer.scenes.framework.windows import Window, boxed, inside, tidy_window, window_of
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, CellGrid, Layer, Positions, Range, Sign, image, target
from hess_explorer.views.picture import Corners
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, ranging, with_error
from hess_mechanics import catalogue
from hess_mechanics.catalogue import Computation
from hess_mechanics.dynamics.cells import centres
from hess_mechanics.dynamics.system import Body, System
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import DRAFT, Level, level
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["STORED", "Charted", "Charts", "of_motion", "of_torus", "parameters_of", "tensor_of"]

Arguments = Mapping[str, float]
Numbers = Mapping[str, tuple["Charted", str]]
"""Computation and name of each number, by the option of the menu."""

_FIRST, _STAGES = 8, 3
"""Cells along a side of the first stage, and the number of stages; one more where many cells are computed at once."""
_BEYOND = 0.01
"""Share of the numbers beyond each end of the colours: without it one outlier would take all colours."""
_FAR, _LARGEST, _SHORT = 1e6, 1e38, 20.0
"""Bound of windows; largest number in single precision; longest motion that only loads the kernels."""
_KINDS = ("#DCDCDC", theme.ORBIT, theme.SHEET, theme.STABLE, theme.UNSTABLE, "#E69F00", theme.MAP, theme.POINT)
"""Colours of categories."""


@dataclass(frozen=True, eq=False)
class Charted:
    """Numbers of a computation that a scene charts.

    key : of the computation; numbers : names of its numbers; arguments(state) : its arguments other than the defaults,
    raises `ModelError`; known : the computations by key, empty for the catalogue.
    """

    key: str
    numbers: tuple[str, ...]
    arguments: Callable[[Any], Arguments]
    known: Mapping[str, Computation] = field(default_factory=dict)

    @property
    def computation(self) -> Computation:
        """The computation."""
        return self.known[self.key] if self.known else catalogue.find(self.key)

    def values(self, state: Any) -> Arguments:
        """Return the arguments of a state, within their bounds.  Raises `ModelError`."""
        what = self.computation
        return {name: what.parameter(name).check(value) for name, value in self.arguments(state).items()}


@dataclass(frozen=True)
class Side:
    """A parameter of the scene as a side of a chart, or a coordinate of its last place.

    ends : the usual range; bounds : the largest one; axis : index of the coordinate.
    """

    symbol: str
    name: str
    ends: Range
    bounds: Range
    axis: int | None = None

    def of(self, state: Any) -> float:
        """Return the value in a state."""
        value = getattr(state, self.name)
        return float(value) if self.axis is None else places(value)[-1][self.axis]

    def put(self, state: Any, value: float) -> Any:
        """Return the state with another value; of several places only the last one is kept."""
        if self.axis is None:
            return state.changed({self.name: value})
        place = [*places(getattr(state, self.name))[-1]]
        place[self.axis] = value
        return state.changed({self.name: written([tuple(place)])})


@dataclass(frozen=True)
class Cells:
    """A number over two parameters, the others as in a state: the cache key of its cells."""

    charted: Charted
    number: str
    x: Side
    y: Side
    state: Any
    level: Level

    def arguments(self, x: float, y: float) -> Arguments:
        """Return the arguments at a place.  Raises `ModelError`."""
        return self.charted.values(self.y.put(self.x.put(self.state, x), y))


def _evaluated(charted: Charted, number: str, chosen: Level, cells: tuple[Any, ...]) -> Array:
    columns = {name: np.array([cell[i][1] for cell in cells]) for i, (name, _) in enumerate(cells[0])}
    found = evaluate(charted.computation, (number,), columns, chosen)
    errors = found.errors.get(number, np.full(len(cells), np.nan))
    return frozen(np.stack([found.values[number], errors, found.status]))


def _row(cells: Cells, window: Window, count: int, row: int) -> Array:
    """Return values, estimated errors and status (3, count) of a row of `count` × `count` cells."""
    (x0, y0), (x1, y1) = window
    y = float(centres(y0, y1, count)[row])
    found, known = np.full((3, count), np.nan), dict[int, tuple[tuple[str, float], ...]]()
    for i, x in enumerate(centres(x0, x1, count).tolist()):
        try:
            known[i] = tuple(cells.arguments(x, y).items())
        # An error in one cell must not stop the others.
        except Exception as error:
            found[2, i], _ = refused(error, {cells.x.name: x, cells.y.name: y})
    if known:
        # By the arguments, which not every parameter of the scene changes.
        found[:, [*known]] = Task(_evaluated, cells.charted, cells.number, cells.level, tuple(known.values())).get()
    return frozen(found)


STORED: dict[Cells, tuple[Array, Window]] = {}
"""Values, errors and status (n, 3, m) of stored sweeps on show, and their windows."""


@cache
def _swept(of: Any, charted: Charted, sides: tuple[Side, ...]) -> tuple[str, ...]:
    """Return the symbols of the parameters that change the arguments, by trial."""

    def tried(state: Any) -> object:
        try:
            return charted.arguments(state)
        except ModelError as error:
            return str(error)

    state = of()
    before = tried(state)
    return tuple(one.symbol for one in sides if any(tried(one.put(state, end)) != before for end in one.ends))


@dataclass(frozen=True, eq=False)
class _Chart(Part[Any]):
    """The chart of a state, from the numbers by option and the sides by symbol."""

    numbers: Numbers
    sides: Mapping[str, Side]

    @property
    def axes(self) -> tuple[Side, Side]:
        """Both sides."""
        return self.sides[self.host.chart_x], self.sides[self.host.chart_y]

    @property
    def place(self) -> tuple[float, float]:
        """The place of this state."""
        return self.axes[0].of(self.host), self.axes[1].of(self.host)

    @property
    def number(self) -> catalogue.Number:
        """The number on show."""
        charted, number = self.numbers[self.host.chart]
        return charted.computation.number(number)

    @cached_property
    def reason(self) -> str:
        """The reason why there is no chart; an empty string if there is one."""
        (charted, _), (x, y) = self.numbers[self.host.chart], self.axes
        of: Any = type(self.host)
        over = _swept(of, charted, tuple(self.sides.values()))
        for one in (x, y):
            if one.symbol not in over:
                return f"{self.host.chart} does not depend on {one.symbol}: choose among {', '.join(over)}."
        return f"Both axes are {x.symbol}: choose two different parameters." if x == y else ""

    @cached_property
    def key(self) -> Cells:
        """The cells; the values of both sides in this state belong to the ring and not to them."""
        x, y = self.axes
        state = y.put(x.put(bare(self.host), x.ends[0]), y.ends[0])
        return Cells(*self.numbers[self.host.chart], x, y, state, level(self.work.chosen))

    @cached_property
    def window(self) -> Window:
        """The visible window."""
        x, y = self.axes
        whole = (x.ends[0], y.ends[0]), (x.ends[1], y.ends[1])
        return window_of(tidy_window(self.host.chart_window), STORED.get(self.key, ((), whole))[1])

    @cached_property
    def _found(self) -> tuple[Array, int, Window] | None:
        """Rows (n, 3, m), the number of those that are still coarse, and the window of the cells."""
        if self.key in STORED:
            cells, window = STORED[self.key]
            return cells, 0, window
        if self.reason:
            return None
        # The number of this state comes first.
        _ = self.own
        more = self.key.charted.computation.many is not None
        counts = [_FIRST * COARSE**stage for stage in range(_STAGES + more)]
        rows = [[(self.key, self.window, count, row) for row in range(count)] for count in counts]
        found = found_by_rows(self.work, _row, rows)
        return None if found is None else (*found, self.window)

    @cached_property
    def own(self) -> Array | None:
        """Value, error and status (3, 1) in this state; None until known."""
        if self.reason:
            return None
        found: Array | None = self.work.need(Task(_row, self.key, (self.place, self.place), 1, 0), preview=None)
        return found

    @cached_property
    def cells(self) -> CellGrid | None:
        """The cells; their ends are one turn, all numbers but outliers, or None for categories."""
        if self._found is None:
            return None
        values, _, ((x0, y0), (x1, y1)) = self._found
        number, values = self.number, np.where(np.abs(values[:, 0]) < _LARGEST, values[:, 0], np.nan)
        known, ends = values[np.isfinite(values)], None
        if number.turn:
            values, ends = values - number.turn * np.round(values / number.turn), (-number.turn / 2, number.turn / 2)
        elif not number.named and known.size:
            low, high = np.quantile(known, (_BEYOND, 1.0 - _BEYOND)).tolist()
            room = max(1e-6 * abs(low), 1e-9) if low == high else 0.0
            ends = low - room, high + room
        return CellGrid(values, (x0, x1), (y0, y1), ends)

    def here(self) -> Positions:
        """Return the place of the state, if it is in sight."""
        return inside([self.place], self.window)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameters at a place.  Raises `ModelError` if no number is possible there."""
        if self.reason:
            raise InvalidParameter(self.reason)
        across, up = self.axes
        state = up.put(across.put(self.host, x), y)
        self.key.charted.values(state)
        return {one.name: getattr(state, one.name) for one in (across, up)}

    def look_closer(self, corners: Corners) -> Values:
        """Return the window of a box."""
        (x0, x1), (y0, y1) = (one.bounds for one in self.axes)
        return boxed(corners, ((x0, y0), (x1, y1)), "chart_window")

    def _says(self, value: float, error: float, status: float) -> str:
        outcome, number = Outcome(int(status)), self.number
        if not math.isfinite(value):
            return f"No number: {(outcome if outcome >= Outcome.OUTSIDE_REGION else Outcome.NO_VALUE).words}."
        said = number.named.get(round(value)) or (with_error(value, error) if error > 0.0 else digits(value))
        unit = "" if number.unit == "1" else f" {number.unit}"
        return f"{number.symbol} = {said}{unit}{'' if outcome is Outcome.OK else f' ({outcome.words})'}."

    def about(self, x: float, y: float) -> str:
        """Return a line about the cell at a place."""
        if self._found is None:
            return ""
        cells, _, window = self._found
        at = zip((x, y), *window, (cells.shape[2], cells.shape[0]), strict=True)
        column, row = (min(max(int((one - low) / (high - low) * n), 0), n - 1) for one, low, high, n in at)
        across, up = self.axes
        return f"{across.symbol} = {digits(x)}, {up.symbol} = {digits(y)}: {self._says(*cells[row, :, column])}"

    @property
    def caption(self) -> Caption:
        """The number in this state, and what is known of the cells."""
        verdict = "" if self.own is None else self._says(*self.own[:, 0])
        if self._found is None or self.cells is None:
            return Caption(verdict, self.reason or self.work.awaited("The chart is"))
        cells, coarse, _ = self._found
        rows, _, columns = cells.shape
        said = [f"{columns} × {rows} cells" + f", {rows - coarse} rows known" * (coarse > 0)]
        if self.cells.ends is not None:
            said.append(f"colours {ranging(*self.cells.ends, 3)}")
        missing = cells[:, 2][cells[:, 2] >= Outcome.OUTSIDE_REGION].astype(int)
        if missing.size:
            most = Outcome(int(np.bincount(missing).argmax()))
            said.append(f"{digits(100.0 * missing.size / (rows * columns), 2)} % have none: {most.words}")
        return Caption(verdict, f"{'; '.join(said)}.")


@dataclass(frozen=True)
class Charts:
    """The numbers that a scene charts, and over which parameters.

    charted : the computations; over : the first two sides, parameters by name and coordinates by symbol; placed : a
    parameter of places and the symbols of their coordinates, which are sides as well.
    """

    charted: tuple[Charted, ...]
    over: tuple[str, str]
    placed: tuple[str, tuple[str, str]] = ("", ("", ""))

    @property
    def numbers(self) -> Numbers:
        """The numbers by option: their names, or that of the computation if it has only one."""
        return {
            name if len(one.numbers) > 1 else one.key.split()[0]: (one, name)
            for one in self.charted
            for name in one.numbers
        }

    def _sides(self, state: type[Any]) -> Mapping[str, Side]:
        found = []
        for spec in specs_of(state):
            if isinstance(spec, Number):
                found.append(Side(spec.symbol, spec.name, spec.softbounds, spec.bounds))
            elif isinstance(spec, Places) and spec.name == self.placed[0]:
                ends = zip(spec.low, spec.high, strict=True)
                found += [Side(self.placed[1][i], spec.name, both, both, i) for i, both in enumerate(ends)]
        return {one.symbol: one for one in found}

    def added(self, state: type[Any]) -> type[Any]:
        """Return the class of states with the choices of a chart, which do not change other results."""
        numbers, sides = self.numbers, self._sides(state)
        x, y = (next(symbol for symbol, side in sides.items() if one in (symbol, side.name)) for one in self.over)
        along = "Parameter along this axis."
        specs: tuple[Spec, ...] = (
            Choice("chart", "Number", (*numbers,), next(iter(numbers)), "Number on show, as in commands.", "Chart"),
            Choice("chart_x", "Across", (*sides,), x, along, "Chart"),
            Choice("chart_y", "Up", (*sides,), y, along, "Chart"),
            Places("chart_window", "The window of the chart", 2, (-_FAR, -_FAR), (_FAR, _FAR)),
        )

        def carried(self: Any, before: Any) -> Values:
            same = (self.chart_x, self.chart_y) == (before.chart_x, before.chart_y)
            return {**state.carried(self, before), **({} if same else {"chart_window": ""})}

        return make_dataclass(
            state.__name__,
            [(spec.name, str, declared(spec, compare=False)) for spec in specs],
            bases=(state,),
            frozen=True,
            namespace={
                "__module__": state.__module__,
                "charting": part(lambda s: _Chart(s, numbers, sides)),
                "carried": carried,
            },
        )

    def picture(self) -> Plot[Any]:
        """Return the picture."""
        named = [one.computation.number(name) for one, name in self.numbers.values()]
        return Plot(
            name="chart",
            title=lambda s: f"{s.chart.replace('-', ' ').capitalize()} over ({s.chart_x}, {s.chart_y})",
            caption=lambda s: s.charting.caption,
            axes=lambda s: (s.chart_x, s.chart_y),
            x=lambda s: tuple(corner[0] for corner in s.charting.window),
            y=lambda s: tuple(corner[1] for corner in s.charting.window),
            first=Axes((0.0, 1.0), (0.0, 1.0)),
            message=lambda s: s.charting.reason,
            on_click=lambda s, x, y: s.charting.choose(x, y),
            on_drag="here",
            on_box=lambda s, corners: s.charting.look_closer(corners),
            on_hover=lambda s, x, y: s.charting.about(x, y),
            folded="Show the chart",
            layers=(
                _colours("numbers", Cividis256, "number of the chart, small to large", lambda one: not one.turn),
                _colours("turns", theme.TURN_MAP, "number of the chart, one turn", lambda one: one.turn > 0.0),
                *(_kinds(i, one) for i, one in enumerate(named) if one.named),
                *target("here", lambda s: s.charting.here()),
            ),
        )

    def load(self, state: Any) -> None:
        """Compute every number once over a short time, which compiles or loads its kernels.  Raises `ModelError`."""
        for one in self.charted:
            values = one.values(state)
            short = {name: np.array([min(value, _SHORT) if name == "t" else value]) for name, value in values.items()}
            evaluate(one.computation, one.numbers, short, DRAFT)


def _colours(name: str, palette: tuple[str, ...], label: str, shows: Callable[[catalogue.Number], bool]) -> Layer[Any]:
    def cells(s: Any) -> CellGrid | None:
        number = s.charting.number
        return s.charting.cells if shows(number) and not number.named else None

    sign = Sign(label, "box rho", f"background: {theme.gradient(palette)}")
    return image(name, cells, palette=palette, low=0.0, high=1.0, legend=(sign,))


def _kinds(i: int, number: catalogue.Number) -> Layer[Any]:
    least, most = min(number.named), max(number.named)
    colours = tuple(_KINDS[i % len(_KINDS)] for i in range(most - least + 1))
    return image(
        f"kinds-{i}",
        lambda s: s.charting.cells if s.charting.number is number else None,
        palette=colours,
        low=least - 0.5,
        high=most + 0.5,
        kinds=True,
        legend=tuple(
            Sign(name, "box", f"background: {colours[value - least]}", value - 0.5)
            for value, name in number.named.items()
        ),
    )


# ---- arguments ------------------------------------------------------------------------------------------------------


def of_torus(torus: Callable[[Any], tuple[float, float, float]]) -> tuple[Charted, ...]:
    """Return what is charted of a Suslov–Hess torus (a, h, f)."""
    numbers = ("rotation-number", "trace", "locked", "stable", "unstable", "log-multiplier")
    return (
        Charted("circle-map", numbers, lambda s: dict(zip("ahf", torus(s), strict=True))),
        Charted("critical-a", ("a",), lambda s: dict(zip("hf", torus(s)[1:], strict=True))),
    )


def tensor_of(body: Any) -> Arguments:
    """Return the inertia tensor of a body."""
    return {name: getattr(body, name) for name in ("I11", "I22", "I13", "I23")}


def parameters_of(body: Body) -> Arguments:
    """Return the parameters of a body."""
    return dict(zip(body.system.parameters, body.parameters, strict=True))


def of_motion(
    system: System,
    start: Callable[[Any], tuple[float, ...]],
    time: Callable[[Any], float] | None = None,
    known: Mapping[str, Computation] | None = None,
) -> tuple[Charted, ...]:
    """Return MEGNO, exponents and crossings of the chosen motion of a system.

    start(state) : its initial state, raises `ModelError`; time(state) : the averaging time; known : as in `Charted`.
    """
    known = known or {}

    def motion(s: Any) -> Arguments:
        return {**parameters_of(s.body), **dict(zip(system.arguments, start(s), strict=True))}

    def averaged(s: Any) -> Arguments:
        return motion(s) if time is None else {**motion(s), "t": time(s)}

    spectrum = (*(f"exponent-{i + 1}" for i in range(len(system.variables))), "dimension", "divergence")
    return (
        Charted(f"megno {system.name}", ("megno",), motion, known),
        Charted(f"lyapunov {system.name}", ("exponent",), averaged, known),
        Charted(f"spectrum {system.name}", spectrum, averaged, known),
        Charted(f"crossings {system.name}", ("count",), motion, known),
    )
