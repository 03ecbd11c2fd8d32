"""A chart of the page: a quantity over two parameters of a scene, whose cells are states of that scene.

Requests come from a browser: names are looked up, numbers are checked and clamped, and nothing else is used.  Charts do
not need xarray or the other libraries of stores.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_explorer.protocol.parameters import Link, Number, Places, Value, places, written
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.sweep.quantities import quantity as named
from hess_explorer.sweep.quantity import CellResults, Outcome, Outcomes, Quantity, evaluate, refused
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import DRAFT, Level, level
from hess_mechanics.numerics.results import Array

__all__ = ["MOST_SIDE", "Chart", "Side", "at_first", "sides_of_places", "swept"]

MOST_SIDE = 256
"""Maximum number of cells along a side, which gives at most 65 536 cells."""
_COARSE = 24
"""Number of cells along a side in the first, coarse pass."""
_SHORT = 20.0
_AUTO = "standard"
"""Accuracy of the chart of a state with automatic accuracy."""

Indices = NDArray[np.int32]
Ends = tuple[float, float]


@dataclass(frozen=True)
class Side:
    """One side of a chart: a parameter of the scene, or a coordinate of its places.

    It has `count` evenly spaced values from `low` to `high`, both included.
    """

    name: str
    low: float
    high: float
    count: int

    @property
    def places(self) -> Array:
        """Return the coordinates of the cells (count,), the same as in a sweep."""
        return np.linspace(self.low, self.high, self.count)


@dataclass(frozen=True)
class Chart:
    """A quantity over two parameters of a scene; the other parameters have the values of one state.

    values : the parameters of that state; part : index of the number, if the quantity has several; x, y : the sides.
    """

    scene: Scene[Any]
    values: Mapping[str, Value]
    charted: Charted[Any]
    part: int
    x: Side
    y: Side

    @classmethod
    def read(cls, given: Mapping[Any, Any]) -> Chart:
        """Return the chart that a browser requests; raise `InvalidParameter` if the request is invalid.

        given : {"state": query, "quantity": name, "part": number, "x" and "y": [name, low, high, count]}.
        """
        query = given.get("state")
        link = Link(query if isinstance(query, str) else "")
        scene = scenes().get(link.given.get("scene", ""))
        if scene is None:
            raise InvalidParameter(
                "A chart needs the link of a state that names its scene: open the scene and choose Chart again."
            )
        charted = next((one for one in scene.charts if one.quantity == given.get("quantity")), None)
        if charted is None:
            can = ", ".join(one.quantity for one in scene.charts) or "nothing"
            raise InvalidParameter(f"In the scene {scene.name} {can} can be charted: choose one of these.")
        part, parts = given.get("part"), named(charted.quantity).numbers
        # bool is a subclass of int, but True is not an index.
        if not (type(part) is int and 0 <= part < parts):
            raise InvalidParameter(f"{charted.quantity} has {parts} numbers, counted from 0: choose one of these.")
        over = swept(scene.name, charted.quantity)
        x, y = (_side(scene, over, given.get(side)) for side in ("x", "y"))
        if x.name == y.name:
            raise InvalidParameter(f"Both axes are {x.name}: choose two different parameters.")
        values, _ = scene.admit(link.values(scene.specs))
        return cls(scene, values, charted, part, x, y)

    @property
    def quantity(self) -> Quantity:
        """The quantity of the chart."""
        return named(self.charted.quantity)

    @property
    def cells(self) -> int:
        """The number of cells."""
        return self.x.count * self.y.count

    @property
    def level(self) -> Level:
        """The accuracy of the state."""
        chosen = str(self.values.get("accuracy", _AUTO))
        return level(_AUTO if chosen == "auto" else chosen)

    @property
    def order(self) -> Indices:
        """The cells, coarse first, each once: row × count along x + column, the lowest row first."""
        step = 1
        while max(self.x.count, self.y.count) > _COARSE * step:
            step *= 2
        numbers = np.arange(self.cells, dtype=np.int32).reshape(self.y.count, self.x.count)
        known, parts = np.zeros(numbers.shape, bool), []
        while step:
            fresh = np.zeros(numbers.shape, bool)
            fresh[::step, ::step] = True
            parts.append(numbers[fresh & ~known])
            known |= fresh
            step //= 2
        return np.concatenate(parts)

    def arguments(self, cell: Mapping[str, float]) -> Mapping[str, float]:
        """Return the parameters of the quantity at a cell, given by its sides.  Raises `ModelError`."""
        return _arguments(self.scene, self.charted, _put(self.scene, self.values, cell))

    def compute(self, indices: Indices) -> CellResults:
        """Return the quantity at these cells, one number for each."""
        rows, columns = np.divmod(indices, self.x.count)
        return self.at(self.x.places[columns], self.y.places[rows])

    def at(self, xs: Array, ys: Array) -> CellResults:
        """Return the quantity at points (n,), with a message for each point without a value."""
        values, errors = np.full(xs.size, np.nan), np.full(xs.size, np.nan)
        status: Outcomes = np.zeros(xs.size, np.uint8)
        why: dict[int, str] = {}
        asked: list[tuple[int, Mapping[str, float]]] = []
        for i, (x, y) in enumerate(zip(xs.tolist(), ys.tolist(), strict=True)):
            try:
                cell = _put(self.scene, self.values, {self.x.name: x, self.y.name: y})
                asked.append((i, _arguments(self.scene, self.charted, cell)))
            # An error in one cell must not stop the others.
            except Exception as error:
                status[i], why[i] = refused(error, {self.x.name: x, self.y.name: y})
        if asked:
            own = [i for i, _ in asked]
            found = evaluate(
                self.quantity,
                {one.name: np.array([cell[one.name] for _, cell in asked]) for one in self.quantity.parameters},
                self.level,
            )
            values[own] = found.values[:, self.part] if self.quantity.parts else found.values
            errors[own], status[own] = found.errors, found.status
            why |= {own[i]: why_not for i, why_not in found.why.items()}
        return CellResults(np.where(status < Outcome.OUTSIDE_REGION, values, np.nan), errors, status, why)

    def why(self, x: float, y: float) -> str:
        """Return a sentence on the status of the cell at (x, y); outside the chart, of the nearest cell."""
        found = self.at(*(np.clip([place], side.low, side.high) for place, side in ((x, self.x), (y, self.y))))
        return found.why.get(0, f"{Outcome(int(found.status[0])).words}.")


def _put(scene: Scene[Any], values: Mapping[str, Value], sides: Mapping[str, float]) -> dict[str, Value]:
    """Return the values with those of some sides replaced; of several points only the last is kept, as in a link."""
    found, placed = dict(values), scene.placed
    for name, value in sides.items():
        if placed is None or name not in placed.names:
            found[name] = value
            continue
        place = list(places(found[placed.places])[-1])
        place[placed.names.index(name)] = value
        found[placed.places] = written([tuple(place)])
    return found


def _numbers(scene: Scene[Any]) -> dict[str, tuple[str, Ends, Ends]]:
    """Return the possible sides: symbol, initial ends and bounds, by name."""
    found = {spec.name: (spec.symbol, spec.softbounds, spec.bounds) for spec in scene.specs if isinstance(spec, Number)}
    if scene.placed is not None:
        spec = next(spec for spec in scene.specs if spec.name == scene.placed.places)
        assert isinstance(spec, Places)
        ends = zip(spec.low, spec.high, strict=True)
        found |= {
            name: (symbol, each, each)
            for name, symbol, each in zip(scene.placed.names, scene.placed.symbols, ends, strict=True)
        }
    return found


def _arguments(scene: Scene[Any], charted: Charted[Any], values: Mapping[str, Value]) -> Mapping[str, float]:
    """Return the parameters of the quantity in a state, each within its bounds.  Raises `ModelError`."""
    found = charted.arguments(scene.of(values))
    return {one.name: one.check(found.get(one.name, one.default)) for one in named(charted.quantity).parameters}


def sides_of_places(scene: Scene[Any]) -> list[dict[str, Any]]:
    """Return the sides without a control, for the browser: name, symbol, range and default."""
    if scene.placed is None:
        return []
    numbers = _numbers(scene)
    return [
        {
            "name": name,
            "symbol": numbers[name][0],
            "range": list(numbers[name][1]),
            "place": scene.defaults()[scene.placed.places],
        }
        for name in scene.placed.names
    ]


def at_first(scene: Scene[Any]) -> Iterator[CellResults]:
    """Compute one cell of every chart of a scene, over a short time, to compile or load the kernels.

    Raises `ModelError`.
    """
    values = scene.defaults()
    for charted in scene.charts:
        cell = dict(_arguments(scene, charted, values))
        if "t" in cell:
            cell["t"] = min(cell["t"], _SHORT)
        yield evaluate(named(charted.quantity), {name: np.array([value]) for name, value in cell.items()}, DRAFT)


@cache
def swept(scene: str, quantity: str) -> tuple[str, ...]:
    """Return the parameters of a scene that affect a quantity, found by trial; those with open controls first."""
    found = scenes()[scene]
    charted = next(one for one in found.charts if one.quantity == quantity)

    def tried(values: Mapping[str, Value]) -> object:
        try:
            return _arguments(found, charted, values)
        except ModelError as error:
            return str(error)

    defaults = found.defaults()
    before = tried(defaults)
    names = [
        name
        for name, (_, ends, _) in _numbers(found).items()
        if any(tried(_put(found, defaults, {name: end})) != before for end in ends)
    ]
    return tuple(sorted(names, key=lambda name: [*found.essential, name].index(name)))


def _side(scene: Scene[Any], over: tuple[str, ...], given: Any) -> Side:
    """Return the side clamped to its bounds.  Raises `InvalidParameter`."""
    match given:
        case [str(name), int() | float() as low, int() | float() as high, int(count)] if name in over:
            symbol, _, (least, most) = _numbers(scene)[name]
            try:
                ends = float(low), float(high)
            except OverflowError:
                ends = math.nan, math.nan
            if not all(map(math.isfinite, ends)):
                raise InvalidParameter(f"The range of {symbol} must be two numbers.")
            low, high = sorted(min(max(end, least), most) for end in ends)
            if not high > low:
                raise InvalidParameter(
                    f"{symbol} goes from {low:g} to {high:g}: give two different numbers "
                    f"between {least:g} and {most:g}."
                )
            return Side(name, low, high, min(max(count, 2), MOST_SIDE))
    raise InvalidParameter(f"A side is one of {', '.join(over)}, with two ends and a number of cells.")
