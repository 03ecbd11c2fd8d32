"""The rotation number of the Suslov–Hess torus and the open problem (S15)."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Choice, Number, Places, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Preset, Report, Scene
from hess_explorer.scenes.framework.sections import boxed
from hess_explorer.scenes.framework.work import ACCURACY, Window, Work, inside, refuse, tidy_window, window_of
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.circle_map import CircleMapView
from hess_explorer.views.graph import Graph
from hess_explorer.views.rotation_plane import RotationPlane
from hess_explorer.views.text import number
from hess_mechanics.errors import Separatrix
from hess_mechanics.numerics.accuracy import REFERENCE, STANDARD
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov_hess.bifurcation import f_max
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.rotation_number import (
    PLANES,
    Torus,
    TorusValues,
    closed_after,
    lock_curve,
    perturbed_rotation,
    place_of,
    values_at,
)

_COARSE, _FINE = (75, 50), (300, 200)
_ROWS = 25
"""Rows of the fine map that are computed together."""
_ON_LINE = 400
_RATIONALS = ("−1/2", "−1/3", "−1/4", "−2/5", "−1/5", "−3/7", "−1/6")
_FULL = {"h": (-1.0, 4.0), "f": (-3.0, 3.0), "a": (0.0, 2.0)}
_AT_MOST = {"h": (-1.0, 1e6), "f": (-1e4, 1e4), "a": (-100.0, 100.0)}
_ITERATES = 40


def _part(plane: str) -> str:
    """The name of the window of the map over a plane: each map has its own."""
    return "part_" + plane.replace(", ", "")


def _corners(plane: str, ranges: Mapping[str, tuple[float, float]]) -> Window:
    """The lower left and the upper right corner of the map over a plane, with these ranges."""
    x, y = (ranges[name] for name in plane.split(", "))
    return (x[0], y[0]), (x[1], y[1])


SPECS = (
    Number("a", "a", "Inertia parameter a", 0.5, 0.0, 2.0, 0.005, -100.0, 100.0,
           "a = I₂₃/I₂₂ in the Suslov problem, √((a₃−a₂)(a₂−a₁))/a₂ in Euler–Poisson; a body has |a| < 1."),
    Number("h", "h", "Energy h", 0.5, -0.99, 4.0, 0.005, -1.0 + 1e-9, 1e6, "Energy integral in units b = 1."),
    Number("f", "f", "Area integral f", 0.8, -3.0, 3.0, 0.005, -1e4, 1e4, "Area integral in units b = 1."),
    Choice("over", "Map over", PLANES, "h, f", "The two parameters of the map; the third stays."),
    Choice("line", "Line along", ("f", "h", "a"), "f", "The parameter along which ρ and the trace are drawn."),
    Choice("rational", "Rational number", _RATIONALS, "−1/4",
           "On the line the torus with this ρ is looked for, and how many cycles it has."),
    Number("epsilon", "ε", "Away from Möbius, ε", 0.25, 0.0, 0.3, 0.005, 0.0, 0.33,
           "The other family: Θ(φ + ε sin 3φ). It is no Möbius map, and its ρ makes a ladder."),
    ACCURACY,
    *(Places(_part(plane), f"The window of the map over {plane}", 2, *_corners(plane, _AT_MOST)) for plane in PLANES),
)

PRESETS = (
    Preset("One plateau, and no ladder", {"over": "h, f", "line": "f"}),
    Preset("Along h", {"over": "h, f", "line": "h", "f": 0.6}),
    Preset("Along a, to the boundary of the plateau", {"over": "h, a", "line": "a", "h": 0.5, "f": 0.6}),
    Preset("A closer look at ρ = −1/3", {
        "over": "h, f", "line": "f", "part_hf": "0.1,0.4;0.3,0.6", "rational": "−1/3", "h": 0.25, "f": 0.45}),
    Preset("Euler–Poisson, figure gess1", {
        "over": "h, f", "line": "h", "h": 5.01253, "f": 2.0025, "part_hf": "-1,-4;8,4"}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="box rho"></span>ρ from −½ to ½</li>
<li><span class="box locked"></span>locked, two limit cycles</li>
<li><span class="line" style="border-top: 2px solid"></span>its boundary, |trace| = 2</li>
<li><span class="box forbidden"></span>impossible</li>
<li><span class="line muted" style="border-top-style: dashed"></span>the line</li>
<li><span class="line orbit"></span>ρ, trace of Θ</li>
<li><span class="line second" style="border-top-style: dashed"></span>ρ of Θ(φ + ε sin 3φ)</li>
</ul>
"""

THUMBNAIL = """
<path d="M4 29V3M4 29H45" fill="none" stroke="#808080" stroke-width="1.5"/>
<path d="M5 27C14 26 20 22 24 15S34 6 44 6" fill="none" stroke="#0072B2" stroke-width="2"/>
<path d="M5 28H13V24H18V20H25V13H30V9H36V6H44" fill="none" stroke="#CC79A7" stroke-width="2" stroke-dasharray="3 2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Rational:
    """The torus of the line with ρ = p/q, and max |Θ^q − id| there."""

    torus: Torus
    defect: float


@dataclass(frozen=True)
class RotationResult:
    """What the pictures that are seen need; None what no picture asks for, or what is not computed yet.

    grid : the map, of cells (m, n); x : (k,) the places on the line, along : what Θ has there, perturbed : its ρ for
    the other family where there is a torus; rational : None where the line has no such torus.
    """

    values: Values
    torus: Torus
    window: Window
    grid: TorusValues | None
    cells: tuple[int, int]
    boundary: Array | None
    x: Array
    along: TorusValues | None
    perturbed: Array | None
    rational: Rational | None
    map: CircleMap | None
    iterates: Array
    todo: Sequence[Task]
    total: int
    ended: str


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """f inside the region of this h, and a window that is one."""
    out, notes = dict(values), []
    h, f = float(out["h"]), float(out["f"])
    largest = f_max(h)
    if abs(f) > largest:
        out["f"] = math.copysign(largest, f)
        notes.append(f"At h = {number(h)} only |f| ≤ {number(largest)} is possible: f is at that edge now.")
    for plane in PLANES:
        out[_part(plane)] = tidy_window(out[_part(plane)])
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """No slider depends on another."""
    return {}


def axes_of(values: Values) -> tuple[str, str]:
    """The parameters on the horizontal and the vertical axis of the map."""
    x, y = str(values["over"]).split(", ")
    return x, y


def ranges_of(values: Values) -> Window:
    """The ranges of both axes, of the horizontal one and of the vertical one."""
    plane = str(values["over"])
    (x0, y0), (x1, y1) = window_of(values[_part(plane)], _corners(plane, _FULL))
    return (x0, x1), (y0, y1)


def _centres(low: float, high: float, count: int) -> Array:
    return low + (np.arange(count) + 0.5) * (high - low) / count


def _rows(plane: str, torus: Torus, window: Window, cells: tuple[int, int], first: int, last: int) -> TorusValues:
    """Rows of the map, from the `first` to before the `last`, one after the other."""
    names = plane.split(", ")
    x, y = (_centres(*window[i], cells[i]) for i in (0, 1))
    X, Y = np.meshgrid(x, y[first:last])
    return values_at(**{**vars(torus), names[0]: X.ravel(), names[1]: Y.ravel()}, level=STANDARD)


def _together(parts: Sequence[TorusValues]) -> TorusValues:
    return TorusValues(*(frozen(np.concatenate([getattr(part, name) for part in parts]))
                         for name in ("rho", "trace", "locked", "possible")))


def _along(name: str, torus: Torus, low: float, high: float, count: int) -> TorusValues:
    return values_at(**{**vars(torus), name: np.linspace(low, high, count)}, level=STANDARD)


def _ladder(name: str, torus: Torus, low: float, high: float, epsilon: float) -> Array:
    """ρ of the other family on the line; 0 where there is no torus."""
    x = np.linspace(low, high, _ON_LINE)
    possible = _along(name, torus, low, high, _ON_LINE).possible
    out = np.zeros(x.size)
    if possible.any():
        out[possible] = perturbed_rotation(**{**vars(torus), name: x[possible]}, epsilon=epsilon, level=STANDARD)
    return frozen(out)


def sought(values: Values) -> Fraction:
    """The rational number that is looked for on the line: for f < 0 ρ is positive."""
    rho = Fraction(str(values["rational"]).replace("−", "-"))
    return -rho if values["line"] != "f" and float(values["f"]) < 0.0 else rho


def _rational(rho: Fraction, name: str, torus: Torus, low: float, high: float) -> tuple[Rational | None]:
    place = place_of(float(rho), name, torus, low, high, REFERENCE)
    if place is None:
        return (None,)
    found = torus.at(**{name: place})
    return (Rational(found, closed_after(found, rho.denominator, REFERENCE)),)


def compute(values: Values, shown: Collection[str], dragging: bool) -> RotationResult:
    """The map, coarse first; ρ and trace along the line; the circle map of the torus."""
    work = Work(values, dragging)
    torus = Torus(*(float(values[name]) for name in ("a", "h", "f")))
    plane, line, window = str(values["over"]), str(values["line"]), ranges_of(values)
    names = axes_of(values)
    # Only what the map depends on: it stays while the torus moves in its plane.
    beside = torus.at(**dict.fromkeys(names, 0.0))
    grid: TorusValues | None = None
    boundary: Array | None = None
    cells = _COARSE
    if "map" in shown:
        grid = work.get(_rows, plane, beside, window, _COARSE, 0, _COARSE[1])
        if not dragging:
            parts = [work.later(_rows, plane, beside, window, _FINE, i, i + _ROWS) for i in range(0, _FINE[1], _ROWS)]
            if all(part is not None for part in parts):
                grid, cells = _together(parts), _FINE
            boundary = work.later(lock_curve, plane, beside, (*window[0], *window[1]), STANDARD)
    low, high = window[names.index(line)] if line in names else _FULL[line]
    if line == "h":
        low = max(low, -1.0 + 1e-9)
    on_line = torus.at(**{line: 0.0})
    count = _ON_LINE // 4 if dragging else _ON_LINE
    along = perturbed = rational = None
    if not {"line", "trace"}.isdisjoint(shown):
        along = work.get(_along, line, on_line, low, high, count)
    if "line" in shown and not dragging:
        perturbed = work.later(_ladder, line, on_line, low, high, float(values["epsilon"]))
        found = work.later(_rational, sought(values), line, on_line, low, high)
        rational = found[0] if found is not None else None
    theta: CircleMap | None = None
    iterates = np.empty(0)
    try:
        theta = work.get(circle_map, torus.a, torus.h, torus.f, work.level)
        iterates = theta.iterate(0.5, _ITERATES)
    except Separatrix:
        pass
    return RotationResult(
        values=values, torus=torus, window=window, grid=grid, cells=cells, boundary=boundary,
        x=np.linspace(low, high, count), along=along, perturbed=perturbed, rational=rational, map=theta,
        iterates=iterates, todo=tuple(work.todo), total=work.pieces, ended=work.ended())


def _parts(x: Array, y: Array, possible: Array, jump: float) -> list[tuple[Array, Array]]:
    """A curve without what is impossible, and not joined across jumps."""
    ends = np.flatnonzero(~possible[1:] | ~possible[:-1] | (np.abs(np.diff(y)) > jump)) + 1
    pieces = zip(np.split(x, ends), np.split(y, ends), np.split(possible, ends), strict=True)
    return [(px, py) for px, py, ok in pieces if ok.all() and px.size > 1]


class RotationStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self._axes = ("h", "f")
        self._line = "f"
        self.map = RotationPlane(wire, "map", (" ", " "), _FULL["h"], _FULL["f"])
        self.line = Graph(wire, "line", (" ", "ρ"), _FULL["f"], (-0.52, 0.52),
                          [Series("other", theme.MAP, "dashed"), Series("rho", theme.ORBIT)],
                          picks=("tap", "doubletap"))
        self.trace = Graph(wire, "trace", (" ", "|trace|"), _FULL["f"], (0.0, 6.0), [Series("t", theme.ORBIT)],
                           picks=("tap", "doubletap"))
        self.circle = CircleMapView(wire)
        self.pictures = (self.map, self.line, self.trace, self.circle)

    def show(self, result: RotationResult, hold_axes: bool) -> Report:
        """Draw what is known by now."""
        self._axes, self._line = axes_of(result.values), str(result.values["line"])
        for view in (self.map, self.line, self.trace):
            view.say("")
        if not hold_axes:
            self.map.set_ranges(*result.window)
            ends = (float(result.x[0]), float(result.x[-1]))
            self.line.set_ranges(ends, (-0.52, 0.52))
            self.trace.set_ranges(ends, (0.0, 6.0))
        self._show_map(result)
        self._show_line(result)
        if result.map is None:
            self.circle.show_nothing("Separatrix: no return")
        elif result.iterates.size:
            self.circle.show(result.map, result.iterates)
        for name, text in _captions(result).items():
            self.wire.say(name, text)
        return Report(_derived(result), _status(result), [], result.todo, result.total)

    def _show_map(self, result: RotationResult) -> None:
        x, y = self._axes
        torus = vars(result.torus)
        if result.grid is not None:
            m, n = result.cells
            grid = result.grid
            cells = (field.reshape(n, m) for field in (grid.rho, grid.possible, grid.locked))
            self.map.show(*cells, *result.window)
        (x0, x1), (y0, y1) = result.window
        across = []
        if self._line == x and y0 <= torus[y] <= y1:
            across = [np.array([[x0, torus[y]], [x1, torus[y]]])]
        elif self._line == y and x0 <= torus[x] <= x1:
            across = [np.array([[torus[x], y0], [torus[x], y1]])]
        curves = []
        if result.boundary is not None and len(result.boundary):
            curves = [result.boundary, result.boundary * np.array([1.0, -1.0])] if y == "f" else [result.boundary]
        self.map.show_lines(curves, across)
        here = inside([(torus[x], torus[y])], ((x0, y0), (x1, y1)))
        self.map.show_here(here, f"{x} across, {y} up")

    def _show_line(self, result: RotationResult) -> None:
        here = vars(result.torus)[self._line]
        for view in (self.line, self.trace):
            view.name_across(self._line)
        if result.along is None:
            return
        along = result.along
        for view, name, y, jump in ((self.line, "rho", along.rho, 0.3), (self.trace, "t", along.trace, math.inf)):
            drawn = _parts(result.x, np.minimum(y, 50.0), along.possible, jump)
            view.assign(name, xs=[part.astype(np.float32) for part, _ in drawn],
                        ys=[part.astype(np.float32) for _, part in drawn])
        self.trace.show_levels([2.0])
        self.line.show_levels([] if result.rational is None else [float(sought(result.values))])
        if result.perturbed is None:
            self.line.clear("other")
        else:
            drawn = _parts(result.x, result.perturbed, result.along.possible, 0.3)
            self.line.assign("other", xs=[part.astype(np.float32) for part, _ in drawn],
                             ys=[part.astype(np.float32) for _, part in drawn])
        for view, y in ((self.line, along.rho), (self.trace, along.trace)):
            height = float(np.interp(here, result.x, np.minimum(y, 50.0)))
            (x0, x1), (y0, y1) = view.x_range, view.y_range
            if inside([(here, height)], ((x0, y0), (x1, y1))):
                view.choose(here, height)
            else:
                view.clear("chosen")

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the map chooses the torus, on the line its place there."""
        if picture == "map":
            return {self._axes[0]: x, self._axes[1]: y}
        return {self._line: x} if picture in {"line", "trace"} else {}

    def box(self, picture: str, corners: tuple[float, float, float, float]) -> Values:
        """A box in the map is the new window."""
        plane = ", ".join(self._axes)
        return boxed(corners, _corners(plane, _AT_MOST), _part(plane)) if picture == "map" else {}


def _steps(rho: Array, possible: Array) -> set[str]:
    """The heights of the plateaus of a ladder: rational numbers that neighbours share to 1e-6."""
    level = np.flatnonzero(possible[1:] & possible[:-1] & (np.abs(np.diff(rho)) < 1e-6))
    return {str(Fraction(float(rho[i])).limit_denominator(12)) for i in level
            if abs(float(Fraction(float(rho[i])).limit_denominator(12)) - rho[i]) < 1e-5}


def _height(step: str) -> tuple[int, float]:
    """For sorting: the least denominators first, as their plateaus are the longest."""
    fraction = Fraction(step)
    return fraction.denominator, float(fraction)


def _captions(result: RotationResult) -> dict[str, str]:
    line = str(result.values["line"])
    torus = result.torus
    captions = {
        "map": f"Rotation number ρ over ({result.values['over']})\nOne plateau, ρ = 0, where it locks; else ρ changes "
               "everywhere.",
        "line": f"ρ along {line}\nNo plateau but ρ = 0.",
        "trace": f"|trace| along {line}\nElliptic below 2: no cycle; hyperbolic above: two limit cycles.",
    }
    rho = sought(result.values)
    name = str(rho).replace("-", "−")
    if result.rational is not None:
        place = number(vars(result.rational.torus)[line], 6)
        captions["line"] = (f"ρ along {line}\nρ = {name} at {line} = {place}: |Θ^{rho.denominator} − id| ≤ "
                            f"{number(result.rational.defect, 1)}, every orbit is periodic.")
    elif result.perturbed is not None:
        captions["line"] = f"ρ along {line}\nNo torus of the line has ρ = {name}."
    if result.map is not None:
        kind = {"elliptic": "no cycle", "parabolic": "one cycle", "hyperbolic": "two cycles"}[result.map.kind]
        captions["circle"] = (f"Circle map\na = {number(torus.a)}, h = {number(torus.h)}, f = {number(torus.f)}: "
                              f"{result.map.kind}, {kind}, ρ = {number(result.map.rotation_number)}.")
    else:
        captions["circle"] = "Circle map\nSeparatrix: no return."
    return captions


def _derived(result: RotationResult) -> list[str]:
    lines = []
    if result.map is not None:
        re, im, beta = (value * math.exp(min(result.map.log_scale, 700.0)) for value in result.map.matrix)
        lines += [
            f"Riccati matrix α = {number(re)} {'−' if im < 0.0 else '+'} {number(abs(im))} i, β = {number(beta)} i",
            f"|trace| = {number(result.map.trace, 6)}, ρ = {number(result.map.rotation_number, 8)}",
        ]
        if result.map.fixed_points:
            lines.append("multipliers " + ", ".join(number(point.multiplier) for point in result.map.fixed_points))
    if result.perturbed is not None and result.along is not None:
        steps = sorted(_steps(result.perturbed, result.along.possible), key=_height)
        lines.append(f"plateaus of Θ(φ + ε sin 3φ): {', '.join(steps[:8]).replace('-', '−') or 'none seen'}")
    return lines


def _status(result: RotationResult) -> str:
    m, n = result.cells
    parts = [f"map {m} × {n}"] if result.grid is not None else []
    if result.map is not None:
        parts.append(f"{result.map.level}: circle map error ≤ {result.map.error_estimate:.1e} ({result.map.status})")
    return " · ".join([*parts, result.ended]).replace("e-", "e−")


SCENE = Scene(
    name="rotation-number",
    title="Rotation number",
    summary="Is ρ of the Suslov–Hess torus a ladder, as the paper asks? One plateau, and a family that has many.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("map", "line", "trace", "circle"),
    compute=compute,
    stage=RotationStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    place=8,
)
