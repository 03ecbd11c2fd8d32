"""The chart of a scene: a number of the catalogue over two of the scene's parameters, as one of its pictures.

A scene declares the computations and their arguments in a state (`Charts`).  The framework adds the choices of a chart
to the parameters of its states, and the picture to its pictures.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, make_dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from bokeh.palettes import Cividis256

from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.compute.cells import CellResults, Outcome, evaluate, refused
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

__all__ = ["STORED", "Chart", "Charted", "Charts", "Stored", "of_motion", "of_torus", "parameters_of", "tensor_of"]

Arguments = Mapping[str, float]

_FIRST, _STAGES, _FAST_STAGES = 8, 3, 4
"""Cells along a side of the first stage, and the number of stages: one more for what is computed for many cells at once."""
_BEYOND = 0.01
"""Share of the numbers beyond each end of the colours: without it one outlier would take all colours."""
_FAR, _LARGEST = 1e6, 1e38
_SHORT = 20.0
"""Longest time of a motion that only loads the kernels."""
_KINDS = ("#DCDCDC", theme.ORBIT, theme.SHEET, theme.STABLE, theme.UNSTABLE, "#E69F00", theme.MAP, theme.POINT)
"""Colours of categories."""


@dataclass(frozen=True, eq=False)
class Charted:
    """Numbers of a computation that a scene charts.

    key : of the computation in the catalogue; numbers : names of its numbers; arguments(state) : its arguments other
    than the defaults, raises `ModelError`.
    """

    key: str
    numbers: tuple[str, ...]
    arguments: Callable[[Any], Arguments]

    @property
    def computation(self) -> Computation:
        """The computation."""
        return catalogue.find(self.key)

    def values(self, state: Any) -> Arguments:
        """Return the arguments of a state, within their bounds.  Raises `ModelError`."""
        return {name: self.computation.parameter(name).check(value) for name, value in self.arguments(state).items()}


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
class Stored:
    """A number of a stored sweep, at the centres of cells (n, m) of a window.

    first, last : the arguments of the computation in the first and the last cell.
    """

    values: Array
    status: Array
    window: Window
    first: Arguments
    last: Arguments


STORED: dict[tuple[str, str, str, str], Stored] = {}
"""The stored sweeps on show, by key, number and the names of both sides."""


@dataclass(frozen=True)
class _Chart:
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

    def at(self, xs: Array, ys: Array) -> CellResults:
        """Return the number at places (n,)."""
        results: CellResults = CACHE.get(_results, self.charted.key, self.number, self.level, *self._cells(xs, ys))[0]
        return results

    def _cells(self, xs: Array, ys: Array) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return the arguments at places (n,), and status and message of those where there are none."""
        cells: list[tuple[tuple[str, float], ...] | None] = []
        wrong = []
        for x, y in zip(xs.tolist(), ys.tolist(), strict=True):
            try:
                cells.append(tuple(self.arguments(x, y).items()))
            # An error in one cell must not stop the others.
            except Exception as error:
                cells.append(None)
                wrong.append((len(cells) - 1, *refused(error, {self.x.name: x, self.y.name: y})))
        return tuple(cells), tuple(wrong)


def _results(key: str, number: str, chosen: Level, cells: tuple[Any, ...], wrong: tuple[Any, ...]) -> CellResults:
    """Return the number at cells with these arguments; None for those that are `wrong`."""
    values, errors = np.full((2, len(cells)), np.nan)
    status, why = np.zeros(len(cells), np.uint8), {}
    there = [i for i, cell in enumerate(cells) if cell is not None]
    if there:
        columns = {name: np.array([cells[i][j][1] for i in there]) for j, (name, _) in enumerate(cells[there[0]])}
        found = evaluate(catalogue.find(key), (number,), columns, chosen)
        values[there], status[there] = found.values[number], found.status
        errors[there] = found.errors.get(number, np.nan)
        why = {there[i]: reason for i, reason in found.why.items()}
    for i, outcome, reason in wrong:
        status[i], why[i] = outcome, reason
    return CellResults({number: frozen(values)}, {number: frozen(errors)}, frozen(status), why)


def _row(chart: _Chart, window: Window, count: int, row: int) -> Array:
    """Return values and status (2, count) of a row of cells."""
    (x0, y0), (x1, y1) = window
    found = chart.at(centres(x0, x1, count), np.full(count, centres(y0, y1, count)[row]))
    return frozen(np.stack([found.values[chart.number], found.status.astype(float)]))


def _one(chart: _Chart, x: float, y: float) -> CellResults:
    return chart.at(np.array([x]), np.array([y]))


@cache
def _swept(of: type[Any], charted: Charted, sides: tuple[Side, ...]) -> tuple[str, ...]:
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
class Chart(Part[Any]):
    """The chart of a state.

    numbers : the numbers by option; sides : the sides by symbol.
    """

    numbers: Mapping[str, tuple[Charted, str]]
    sides: Mapping[str, Side]

    @cached_property
    def _chosen(self) -> tuple[_Chart | None, str]:
        """The chart, or None and the reason why there is none."""
        charted, number = self.numbers[self.host.chart]
        x, y = self.axes
        of: Any = type(self.host)
        over = _swept(of, charted, tuple(self.sides.values()))
        for one in (x, y):
            if one.symbol not in over:
                return None, f"{self.host.chart} does not depend on {one.symbol}: choose among {', '.join(over)}."
        if x == y:
            return None, f"Both axes are {x.symbol}: choose two different parameters."
        # The values of both sides in this state belong to the ring and not to the cells.
        state = y.put(x.put(bare(self.host), x.ends[0]), y.ends[0])
        return _Chart(charted, number, x, y, state, level(self.work.chosen)), ""

    @property
    def reason(self) -> str:
        """The reason why there is no chart; an empty string if there is one."""
        return self._chosen[1]

    @property
    def axes(self) -> tuple[Side, Side]:
        """Both sides."""
        return self.sides[self.host.chart_x], self.sides[self.host.chart_y]

    @property
    def number(self) -> catalogue.Number:
        """The number on show."""
        charted, number = self.numbers[self.host.chart]
        return charted.computation.number(number)

    @property
    def title(self) -> str:
        """The title of the picture."""
        x, y = self.axes
        return f"{self.number.symbol} over ({x.symbol}, {y.symbol})"

    @cached_property
    def window(self) -> Window:
        """The visible window."""
        if self.stored is not None and not self.host.chart_window:
            return self.stored.window
        x, y = self.axes
        return window_of(tidy_window(self.host.chart_window), ((x.ends[0], y.ends[0]), (x.ends[1], y.ends[1])))

    @cached_property
    def stored(self) -> Stored | None:
        """The stored sweep of this state, if any."""
        chart = self._chosen[0]
        kept = None if chart is None else STORED.get((chart.charted.key, chart.number, chart.x.name, chart.y.name))
        if chart is None or kept is None:
            return None
        n, m = kept.values.shape
        low, high = zip(*(centres(a, b, k)[[0, -1]] for a, b, k in zip(*kept.window, (m, n), strict=True)), strict=True)
        try:
            ends = chart.arguments(*low), chart.arguments(*high)
        except ModelError:
            return None
        usual = {one.name: one.default for one in chart.charted.computation.parameters}
        same = all(
            math.isclose({**usual, **own}[name], value, rel_tol=1e-9, abs_tol=1e-12)
            for own, known in zip(ends, (kept.first, kept.last), strict=True)
            for name, value in known.items()
        )
        return kept if same else None

    @cached_property
    def cells(self) -> tuple[Array, int] | None:
        """Values and status (n, 2, m), and the number of rows that are still coarse; None until some are known."""
        if self.stored is not None:
            return np.stack([self.stored.values, self.stored.status], axis=1), 0
        chart = self._chosen[0]
        if chart is None:
            return None
        # The number of this state comes first.
        _ = self.own
        stages = _STAGES if chart.charted.computation.many is None else _FAST_STAGES
        counts = [_FIRST * COARSE**stage for stage in range(stages)]
        return found_by_rows(
            self.work, _row, [[(chart, self.window, count, row) for row in range(count)] for count in counts]
        )

    @cached_property
    def own(self) -> CellResults | None:
        """The number in this state; None until known."""
        chart = self._chosen[0]
        if chart is None:
            return None
        found: CellResults | None = self.work.ask(Task(_one, (chart, *(one.of(self.host) for one in self.axes))))
        return found

    # ---- what the picture shows ---------------------------------------------------------------------------------

    def grid(self, number: catalogue.Number | None, turning: bool = False) -> CellGrid | None:
        """Return the cells, if they are categories of this number, or none and periodic or not."""
        own = self.number
        if self.cells is None or (number is not own if own.named else number is not None or turning != (own.turn > 0)):
            return None
        values = self.cells[0][:, 0]
        # Numbers are sent in single precision.
        values = np.where(np.abs(values) < _LARGEST, values, np.nan)
        if own.turn:
            values = values - own.turn * np.round(values / own.turn)
        (x0, y0), (x1, y1) = self.window if self.stored is None else self.stored.window
        return CellGrid(values, (x0, x1), (y0, y1), self.ends)

    @cached_property
    def ends(self) -> Range | None:
        """The ends of the colours: one turn, or all numbers but outliers; None for categories."""
        own, values = self.number, np.array([]) if self.cells is None else self.cells[0][:, 0]
        if own.named or own.turn:
            return (-own.turn / 2.0, own.turn / 2.0) if own.turn else None
        values = values[np.isfinite(values)]
        if not values.size:
            return 0.0, 1.0
        low, high = np.quantile(values, (_BEYOND, 1.0 - _BEYOND)).tolist()
        if low == high:
            low, high = float(values.min()), float(values.max())
        room = max(1e-6 * abs(low), 1e-9)
        return (low, high) if low < high else (low - room, high + room)

    def here(self) -> Positions:
        """Return the place of the state, if it is in sight."""
        x, y = self.axes
        return inside([(x.of(self.host), y.of(self.host))], self.window)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameters at a place.  Raises `ModelError` if no number is possible there."""
        chart, reason = self._chosen
        if chart is None:
            raise InvalidParameter(reason)
        state = chart.y.put(chart.x.put(self.host, x), y)
        chart.charted.values(state)
        return {one.name: getattr(state, one.name) for one in (chart.x, chart.y)}

    def look_closer(self, corners: Corners) -> Values:
        """Return the window of a box."""
        (x0, x1), (y0, y1) = (one.bounds for one in self.axes)
        return boxed(corners, ((x0, y0), (x1, y1)), "chart_window")

    # ---- words --------------------------------------------------------------------------------------------------

    def _says(self, value: float, error: float, outcome: Outcome) -> str:
        if outcome >= Outcome.OUTSIDE_REGION:
            return f"No number: {outcome.words}."
        number = self.number
        known = number.named.get(round(value)) or (with_error(value, error) if error > 0.0 else digits(value))
        unit = "" if number.unit == "1" or number.named else f" {number.unit}"
        return f"{number.symbol} = {known}{unit}{'' if outcome is Outcome.OK else f' ({outcome.words})'}."

    def about(self, x: float, y: float) -> str:
        """Return a line about the cell at a place."""
        if self.cells is None:
            return ""
        cells, (low, high) = self.cells[0], self.window if self.stored is None else self.stored.window
        n, _, m = cells.shape
        column, row = (
            min(max(int((at - a) / (b - a) * count), 0), count - 1)
            for at, a, b, count in zip((x, y), low, high, (m, n), strict=True)
        )
        value, status = cells[row, :, column]
        place = ", ".join(f"{one.symbol} = {digits(at)}" for one, at in zip(self.axes, (x, y), strict=True))
        return f"{place}: {self._says(value, math.nan, Outcome(int(status)))}"

    @property
    def caption(self) -> Caption:
        """The number in this state, and what is known of the cells."""
        own = self.own
        verdict = ""
        if own is not None:
            name = self.numbers[self.host.chart][1]
            verdict = self._says(own.values[name][0], own.errors[name][0], Outcome(int(own.status[0])))
        if self.cells is None:
            return Caption(verdict, self.reason or self.awaited)
        cells, coarse = self.cells
        rows, _, columns = cells.shape
        status = Counter(cells[:, 1][cells[:, 1] >= Outcome.OUTSIDE_REGION].astype(int).tolist())
        known = f", {rows - coarse} rows known" if coarse else ""
        said = [f"{self.number.title}: {columns} × {rows} cells{known}"]
        if self.ends is not None:
            said.append(f"colours {ranging(*self.ends, 3)}")
        if status:
            share, most = 100.0 * status.total() / (rows * columns), Outcome(status.most_common(1)[0][0])
            said.append(f"{digits(share, 2)} % have none: {most.words}")
        return Caption(verdict, f"{'; '.join(said)}.")

    @property
    def awaited(self) -> str:
        """The words for cells that are not known yet."""
        return self.work.awaited("The chart is")


@dataclass(frozen=True)
class Charts:
    """The numbers that a scene charts, and over which parameters.

    charted : the computations; over : the first two sides, parameters by name and coordinates by symbol; placed : a parameter of places and the symbols of
    their coordinates, which are sides as well.
    """

    charted: tuple[Charted, ...]
    over: tuple[str, str]
    placed: tuple[str, tuple[str, str]] | None = None

    @property
    def numbers(self) -> Mapping[str, tuple[Charted, str]]:
        """The numbers by their names in a link: that of the computation if only one of its numbers is charted."""
        return {
            name if len(one.numbers) > 1 else one.computation.name: (one, name)
            for one in self.charted
            for name in one.numbers
        }

    def _sides(self, state: type[Any]) -> Mapping[str, Side]:
        found = []
        for spec in specs_of(state):
            if isinstance(spec, Number):
                found.append(Side(spec.symbol, spec.name, spec.softbounds, spec.bounds))
            elif self.placed is not None and isinstance(spec, Places) and spec.name == self.placed[0]:
                ends = zip(self.placed[1], zip(spec.low, spec.high, strict=True), strict=True)
                found += [Side(symbol, spec.name, both, both, i) for i, (symbol, both) in enumerate(ends)]
        return {one.symbol: one for one in found}

    def added(self, state: type[Any]) -> type[Any]:
        """Return the class of states with the choices of a chart, which do not change other results."""
        numbers, sides = self.numbers, self._sides(state)
        over = [next(symbol for symbol, side in sides.items() if one in (symbol, side.name)) for one in self.over]
        specs: tuple[Spec, ...] = (
            Choice("chart", "Number", (*numbers,), next(iter(numbers)), "Number that the chart shows, named as in commands.", "Chart"),
            *(
                Choice(f"chart_{axis}", label, (*sides,), first, "Parameter along this axis.", "Chart")
                for axis, label, first in zip("xy", ("Across", "Up"), over, strict=True)
            ),
            Places("chart_window", "The window of the chart", 2, (-_FAR, -_FAR), (_FAR, _FAR)),
        )

        def charting(self: Any) -> Chart:
            return Chart(self, numbers, sides)

        def carried(self: Any, before: Any) -> Mapping[str, Any]:
            same = (self.chart_x, self.chart_y) == (before.chart_x, before.chart_y)
            return {**state.carried(self, before), **({} if same else {"chart_window": ""})}

        return make_dataclass(
            state.__name__,
            [(spec.name, str, declared(spec, compare=False)) for spec in specs],
            bases=(state,),
            frozen=True,
            namespace={"__module__": state.__module__, "charting": part(charting), "carried": carried},
        )

    def picture(self) -> Plot[Any]:
        """Return the picture."""
        named = [one.computation.number(name) for one in self.charted for name in one.numbers]
        return Plot(
            name="chart",
            title=lambda s: s.charting.title,
            caption=lambda s: s.charting.caption,
            axes=lambda s: tuple(one.symbol for one in s.charting.axes),
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
                _colours("numbers", Cividis256, "number of the chart, small to large", False),
                _colours("turns", theme.TURN_MAP, "number of the chart, one turn", True),
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


def _colours(name: str, palette: tuple[str, ...], label: str, turning: bool) -> Layer[Any]:
    return image(
        name,
        lambda s: s.charting.grid(None, turning),
        palette=palette,
        low=0.0,
        high=1.0,
        legend=(Sign(label, "box rho", f"background: {theme.gradient(palette)}"),),
    )


def _kinds(i: int, number: catalogue.Number) -> Layer[Any]:
    least, most = min(number.named), max(number.named)
    colours = tuple(_KINDS[(value - least) % len(_KINDS)] for value in range(least, most + 1))
    return image(
        f"kinds-{i}",
        lambda s: s.charting.grid(number),
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
    return {"I11": body.I11, "I22": body.I22, "I13": body.I13, "I23": body.I23}


def parameters_of(body: Body) -> Arguments:
    """Return the parameters of a body."""
    return dict(zip(body.system.parameters, body.parameters, strict=True))


def of_motion(
    system: System, start: Callable[[Any], tuple[float, ...]], time: Callable[[Any], float] | None = None
) -> tuple[Charted, ...]:
    """Return MEGNO, exponents and crossings of the chosen motion of a system.

    start(state) : its initial state, raises `ModelError`; time(state) : the averaging time.
    """
    name = system.name

    def motion(s: Any) -> Arguments:
        return {**parameters_of(s.body), **dict(zip(system.arguments, start(s), strict=True))}

    def averaged(s: Any) -> Arguments:
        return motion(s) if time is None else {**motion(s), "t": time(s)}

    spectrum = (*(f"exponent-{i + 1}" for i in range(len(system.variables))), "dimension", "divergence")
    return (
        Charted(f"megno {name}", ("megno",), motion),
        Charted(f"lyapunov {name}", ("exponent",), averaged),
        Charted(f"spectrum {name}", spectrum, averaged),
        Charted(f"crossings {name}", ("count",), motion),
    )
