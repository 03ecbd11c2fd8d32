"""The Suslov problem with gravity (S1): sections forward and backward in time, exponent, divergence, basins."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Choice, Number, Places, Value, Values, places
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.sections import (
    PIECE,
    TURN,
    boxed,
    possible_starts,
    section_status,
    started,
    thinned,
    worst,
)
from hess_explorer.scenes.framework.work import ACCURACY, Window, Work, inside, refuse, tidy_window, window_of
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.layered_section import LayeredSection
from hess_explorer.views.poisson_sphere import PoissonSphere
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import VelocityPlane, nice_above, sphere_columns
from hess_mechanics.dynamics.lyapunov import Exponent, largest_exponent
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL, PIXELS, SAGITTA, sample_times
from hess_mechanics.dynamics.section import occupied_cells
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import DRAFT, STANDARD, Level, cheapest
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.rigid_body.inertia import check_body
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.section import (
    basins,
    coordinates,
    divergence,
    lowest_energy,
    possible,
    seeds,
    states_at,
    suslov_points,
)

_MOST = 4000
_IN_A_DRAG = (12, 40)
"""Orbits and crossings while a slider is held."""
_MOST_STEPS = 100_000
_BASIN_CELLS = (36, 24)
_BASIN_CROSSINGS = 240
_COURSE = 4001
_CELLS = 32
_FULL = ((-math.pi, 0.0), (math.pi, math.pi))
_BOUNDS = ((-TURN, 0.0), (TURN, TURN))
"""The same, as places in a link are written."""
_PLANES = {"γ₃ = 0": 3, "γ₁ = 0": 1, "γ₂ = 0": 2}

SPECS = (
    Number("I11", "I₁₁", "Inertia I₁₁", 1.5, 0.2, 5.0, 0.01, 1e-3, 1e3, "Moment of inertia about the first body axis."),
    Number("I22", "I₂₂", "Inertia I₂₂", 3.0, 0.2, 5.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.4, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia. With I₂₃ it decides where volume shrinks and where it grows."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.4, -2.0, 2.0, 0.01, -1e3, 1e3, "Product of inertia."),
    Number("b1", "b₁", "Centre of mass b₁", -0.5, -3.0, 3.0, 0.01, -1e3, 1e3, "First component of b = −mg r."),
    Number("b2", "b₂", "Centre of mass b₂", -0.5, -3.0, 3.0, 0.01, -1e3, 1e3, "Second component of b."),
    Number("b3", "b₃", "Centre of mass b₃", 0.7, -3.0, 3.0, 0.01, -1e3, 1e3, "Third component of b."),
    Number("h", "h", "Energy above the bottom, h", 1.0, 0.01, 6.0, 0.01, 1e-6, 1e6,
           "E + |b|, the energy above its smallest possible value."),
    Choice("plane", "Section", tuple(_PLANES), "γ₃ = 0", "The plane is crossed while that component of γ grows."),
    Choice("colours", "Show", ("forward and backward in time", "forward only", "basins"),
           "forward and backward in time", "Basins: to which of two attractors each point of the section leads."),
    Choice("drop", "Points shown", ("all", "the later half"), "all", "The later half shows what attracts."),
    Number("orbits", "n", "Orbits", 40.0, 0.0, 120.0, 1.0, 0.0, 300.0, "How many orbits are spread over the window."),
    Number("count", "N", "Crossings", 200.0, 20.0, 1000.0, 10.0, 2.0, 4000.0, "How many points each orbit leaves."),
    Number("span", "t", "Time span", 60.0, 1.0, 400.0, 1.0, 0.01, 1e4, "How long the chosen orbit is followed."),
    Number("long", "T", "Time of the exponent", 1000.0, 10.0, 5000.0, 10.0, 1.0, 2e4,
           "How long the Lyapunov exponent and the divergence are averaged."),
    ACCURACY,
    Places("starts", "The places of the chosen orbits", 12, *_BOUNDS, "1,1"),
    Places("window", "The window of the section", 2, *_BOUNDS),
)


def _tensor(I11: float, I22: float, I13: float, I23: float, b1: float, b2: float, b3: float, E: float
            ) -> dict[str, Value]:
    return {"I11": I11, "I22": I22, "I13": I13, "I23": I23, "b1": b1, "b2": b2, "b3": b3,
            "h": round(E + math.hypot(b1, b2, b3), 6)}


_BOTH_WAYS = {"plane": "γ₃ = 0", "colours": "forward and backward in time"}

PRESETS = (
    Preset("A chaotic sea", {**_BOTH_WAYS, "drop": "all"}),
    Preset("Regular orbits", {
        **_tensor(1.5, 4.0, 0.0, 0.8, 0.0, 1.0, 0.7, -0.521), **_BOTH_WAYS, "drop": "all", "starts": "-1.5,1"}),
    Preset("Strange attractor", {
        **_tensor(1.0, 2.5, 0.6, 0.6, -1.0, -0.5, 0.7, 0.681), "plane": "γ₃ = 0", "colours": "forward only",
        "count": 600.0, "drop": "the later half", "long": 3000.0}),
    Preset("Two attractors, and their basins", {
        **_tensor(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0, 1.842), "plane": "γ₃ = 0", "colours": "basins",
        "count": 400.0, "drop": "the later half"}),
    Preset("Reversal: what attracts, and what repels", {
        **_tensor(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3, 1.743), **_BOTH_WAYS, "count": 100.0, "drop": "all"}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="dot small" style="background: #0072B2"></span>forward in time</li>
<li><span class="dot small" style="background: #D55E00"></span>backward</li>
<li><span class="dot small" style="background: #CC79A7"></span>chosen orbit, from its ring</li>
<li><span class="line orbit"></span>exponent λ</li>
<li><span class="line second" style="border-top-style: dashed"></span>mean divergence</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
<li><span class="box" style="background: #F0E44290"></span>basin of one,</li>
<li><span class="box" style="background: #009E7370"></span>of the other attractor</li>
</ul>
"""

THUMBNAIL = """
<rect x="4" y="3" width="40" height="26" fill="none" stroke="#808080"/>
<path d="M26 3v26" stroke="#808080" stroke-dasharray="2 2"/>
<g stroke-width="2.4" stroke-linecap="round">
<path d="M8 9h.1M12 13h.1M15 8h.1M20 11h.1M11 18h.1M17 16h.1M22 7h.1M24 14h.1M9 24h.1M15 22h.1" stroke="#0072B2"/>
<path d="M29 20h.1M33 24h.1M37 19h.1M40 23h.1M31 15h.1M36 13h.1M41 15h.1M28 25h.1M24 20h.1M38 8h.1" stroke="#D55E00"/>
</g>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Course:
    """The mean divergence (n,) up to the times (n,)."""

    times: Array
    mean: Array


@dataclass(frozen=True)
class SuslovResult:
    """What the pictures that are seen need; None what no picture asks for, or what is not computed yet.

    E : the energy; forward, backward, own : points (n, 2); later : the later halves of the forward orbits, which show
    what attracts; basin : cells (m, n), 0 or 1, −1 where it is not known yet.
    """

    values: Values
    body: SuslovBody
    E: float
    k: int
    window: Window
    starts: Sequence[tuple[float, float]]
    forward: Array
    backward: Array
    own: Array
    later: Array
    drift: Mapping[str, float]
    impossible: Array | None
    basin: Array | None
    exponent: Exponent | None
    course: Course | None
    orbit: Orbit | None
    note: str
    todo: Sequence[Task]
    total: int
    ended: str


def body_of(values: Values) -> SuslovBody:
    """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
    return SuslovBody(*(float(values[name]) for name in ("I11", "I22", "I13", "I23", "b1", "b2", "b3")))


def energy_of(values: Values) -> float:
    """E = h − |b|."""
    return float(values["h"]) - math.hypot(*(float(values[name]) for name in ("b1", "b2", "b3")))


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """A window that is one, at least one start, an energy that reaches the plane."""
    out, notes = dict(values), []
    out["window"] = tidy_window(out["window"])
    if not places(out["starts"]):
        out["starts"] = next(spec.default for spec in SPECS if spec.name == "starts")
    body = body_of(out)
    bottom = lowest_energy(body, _PLANES[str(out["plane"])]) + math.hypot(body.b1, body.b2, body.b3)
    if float(out["h"]) <= bottom * (1.0 + 1e-9):
        out["h"] = bottom * 1.01 + 1e-6
        notes.append(f"Motions reach {out['plane']} only for h > {number(bottom)}: h is {number(float(out['h']))} now.")
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """No slider depends on another."""
    return {}


def _starts(body: SuslovBody, E: float, k: int, chosen: Sequence[tuple[float, float]], window: Window
            ) -> tuple[Sequence[tuple[float, float]], Sequence[tuple[float, ...]], str]:
    """Those of the chosen places where a motion is possible, the states there, and a note on the last one.

    Raises `InvalidParameter` where nothing is possible in the window.
    """
    psi, delta = np.array(chosen).T
    states, ok = states_at(body, E, k, psi, delta)

    def instead() -> tuple[tuple[float, float], tuple[float, ...]]:
        others = _seeds(body, E, k, window, 1)
        if not others:
            raise InvalidParameter(f"Nothing is possible in this window with the energy E = {E:.6g}: choose a larger "
                                   "h, or press Clear for the whole section.")
        psi, delta = coordinates(np.array(others), k)[0]
        return (float(psi), float(delta)), others[0]

    places_, kept_states, kept = possible_starts(chosen, states, ok, instead)
    return places_, kept_states, "" if kept else (
        f"At ψ = {number(chosen[-1][0])}, δ = {number(chosen[-1][1])} no motion has this energy: the chosen orbit "
        f"starts at ψ = {number(places_[0][0])}, δ = {number(places_[0][1])}.")


def _seeds(body: SuslovBody, E: float, k: int, window: Window, count: int) -> tuple[tuple[float, ...], ...]:
    (x0, y0), (x1, y1) = window
    return seeds(body, E, k, (x0, x1, y0, y1), count) if count else ()


def _piece(body: SuslovBody, k: int, starts: tuple[tuple[float, ...], ...], crossings: int, forward: bool
           ) -> tuple[tuple[Array, ...], Mapping[str, float]]:
    """Points (n, 2) of each orbit, in the order in which they are passed from the start; the drift."""
    points = suslov_points(body, k, starts, crossings, forward, STANDARD, threads=1, most_steps=_MOST_STEPS)
    return tuple(frozen(coordinates(states, k)) for states in points.states), points.drift


def _basin_row(body: SuslovBody, E: float, k: int, window: Window, row: int) -> Array:
    """Averages of ω1 along the last third of the orbits from the cells of one row; ∞ where there is none."""
    (x0, y0), (x1, y1) = window
    m, n = _BASIN_CELLS
    psi = x0 + (np.arange(m) + 0.5) * (x1 - x0) / m
    states, ok = states_at(body, E, k, psi, np.full(m, y0 + (row + 0.5) * (y1 - y0) / n))
    out = np.full(m, np.inf)
    if ok.any():
        found = suslov_points(body, k, states[ok].tolist(), _BASIN_CROSSINGS, True, DRAFT, threads=1,
                              most_steps=_MOST_STEPS)
        out[ok] = [float(orbit[2 * len(orbit) // 3 :, 0].mean()) if len(orbit) > 30 else math.inf
                   for orbit in found.states]
    return frozen(out)


def _course(body: SuslovBody, start: tuple[float, ...], span: float) -> Course:
    times = np.linspace(0.0, span, _COURSE)
    rates = divergence(body, solve(SYSTEM, start, body.parameters, times, DRAFT).states)
    steps = 0.5 * (rates[1:] + rates[:-1]) * np.diff(times)
    return Course(frozen(times[1:]), frozen(np.cumsum(steps) / times[1:]))


def _half_width(body: SuslovBody, E: float) -> float:
    return nice_above(1.05 * math.sqrt(2.0 * (E + math.hypot(body.b1, body.b2, body.b3)) / min(body.I11, body.I22)))


def _weights(body: SuslovBody, E: float) -> Array:
    radius = 0.5 * PIXELS
    w = radius / _half_width(body, E)
    return np.array([w, w, radius, radius, radius])


def _orbit(body: SuslovBody, E: float, start: tuple[float, ...], span: float, accuracy: Level) -> Orbit:
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, _weights(body, E), SAGITTA, _MOST)
    # Near the bottom the motion is small beside the velocities of which a level promises a part.
    share = _half_width(body, E) / float(SYSTEM.frequency(np.array(start), np.array(body.parameters)))
    level = max(accuracy, cheapest(HALF_A_PIXEL * share), key=lambda rung: rung.order)
    return solve(SYSTEM, start, body.parameters, times, level)


def compute(values: Values, shown: Collection[str], dragging: bool) -> SuslovResult:
    """The section, piece by piece; what the other pictures show of the chosen orbit."""
    work = Work(values, dragging)
    body, E, k = body_of(values), energy_of(values), _PLANES[str(values["plane"])]
    window = window_of(values["window"], _FULL)
    starts, states, note = _starts(body, E, k, places(values["starts"]), window)
    count, crossings = (int(float(values[name])) for name in ("orbits", "count"))
    if dragging:
        count, crossings = min(count, _IN_A_DRAG[0]), min(crossings, _IN_A_DRAG[1])
    get = work.get if dragging else work.later
    points: dict[bool, list[Array]] = {True: [np.empty((0, 2))], False: [np.empty((0, 2))]}
    own, later = [np.empty((0, 2))], [np.empty((0, 2))]
    drift: dict[str, float] = {}
    drop = values["drop"] != "all"
    impossible = basin = None
    if "section" in shown:
        psi = np.linspace(*(corner[0] for corner in window), 241)
        impossible = 1.0 - possible(body, E, k, 0.5 * (psi[1:] + psi[:-1]))[None, :]
        spread = work.get(_seeds, body, E, k, window, count)
        directions = (True, False) if values["colours"] == "forward and backward in time" else (True,)
        for i in range(0, len(spread), PIECE):
            for forward in directions:
                found = get(_piece, body, k, spread[i : i + PIECE], crossings, forward)
                if found is not None:
                    points[forward] += [orbit[len(orbit) // 2 if drop else 0 :] for orbit in found[0]]
                    later += [orbit[len(orbit) // 2 :] for orbit in found[0]] if forward else []
                    drift = worst(drift, found[1])
        for state in states:
            found = get(_piece, body, k, (state,), crossings, True)
            own += [orbit[len(orbit) // 2 if drop else 0 :] for orbit in found[0]] if found is not None else []
        if values["colours"] == "basins" and not dragging:
            rows = [work.later(_basin_row, body, E, k, window, row) for row in range(_BASIN_CELLS[1])]
            basin = _basin([row for row in rows if row is not None], [row is not None for row in rows])
    exponent = course = None
    if "exponent" in shown and not dragging:
        exponent = get(largest_exponent, SYSTEM, states[-1], body.parameters, float(values["long"]))
        course = get(_course, body, states[-1], float(values["long"]))
    orbit = None
    if not {"omega", "sphere"}.isdisjoint(shown):
        orbit = work.get(_orbit, body, E, states[-1], float(values["span"]), work.level)
    return SuslovResult(
        values=values, body=body, E=E, k=k, window=window, starts=starts, forward=np.concatenate(points[True]),
        backward=np.concatenate(points[False]), own=np.concatenate(own), later=np.concatenate(later), drift=drift,
        impossible=impossible, basin=basin, exponent=exponent, course=course, orbit=orbit, note=note,
        todo=tuple(work.todo), total=work.pieces, ended=work.ended())


def _basin(rows: Sequence[Array], known: Sequence[bool]) -> Array:
    """Cells (m, n) of `show_basins`."""
    out = np.full((len(known), _BASIN_CELLS[0]), -1.0)
    if rows:
        ends = np.stack(rows)
        found = np.full(ends.shape, -1.0)
        finite = np.isfinite(ends)
        found[finite] = basins(ends[finite])
        out[np.array(known)] = found
    return out


def motion(values: Values) -> Motion:
    """The chosen orbit, for "Speed and accuracy".  Raises `ModelError`."""
    body, E = body_of(values), energy_of(values)
    window = window_of(values["window"], _FULL)
    _, states, _ = _starts(body, E, _PLANES[str(values["plane"])], places(values["starts"]), window)
    return Motion(SYSTEM, states[-1], body.parameters, float(values["span"]), tuple(_weights(body, E)), 1.0)


class SuslovStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"omega-point": ("omega1", "omega2")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self._starts: Sequence[tuple[float, float]] = ()
        self.section = LayeredSection(wire, "section", ("ψ", "δ"), (-math.pi, math.pi), (0.0, math.pi))
        self.exponent = Graph(wire, "exponent", ("t", "λ"), (0.0, 1000.0), (-0.2, 0.2),
                              [Series("divergence", theme.MAP, "dashed"), Series("lambda", theme.ORBIT)])
        self.omega = VelocityPlane(wire, picks=())
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.pictures = (self.section, self.exponent, self.omega, self.sphere)

    def show(self, result: SuslovResult, hold_axes: bool) -> Report:
        """Draw what is known of the section, the exponent and the orbit."""
        self._starts = result.starts
        for view in (self.section, self.exponent, self.omega):
            view.say("")
        self._show_section(result, hold_axes)
        self._show_exponent(result, hold_axes)
        if result.orbit is not None:
            states = result.orbit.states
            if not hold_axes:
                self.omega.fit(_half_width(result.body, result.E))
            self.omega.assign("orbit", t=result.orbit.times.astype(np.float32),
                              **sphere_columns(states[:, :2], states[:, 2:]))
        b = np.array([result.body.b1, result.body.b2, result.body.b3])
        length = float(np.linalg.norm(b))
        self.sphere.show(*(((-b / length).tolist(), "r") if length > 0.0 else ((), "")))
        for name, text in _captions(result).items():
            self.wire.say(name, text)
        notes = [result.note] if result.note else []
        return Report(_derived(result), _status(result), notes, result.todo, result.total)

    def _show_section(self, result: SuslovResult, hold_axes: bool) -> None:
        (x0, y0), (x1, y1) = result.window
        if not hold_axes:
            self.section.set_ranges((x0, x1), (y0, y1))
        self.section.show(result.forward, result.backward, result.own, whole=not (result.todo or hold_axes))
        if result.impossible is not None:
            self.section.show_impossible(result.impossible, (x0, x1), (y0, y1))
        if result.basin is None:
            self.section.clear("basins")
        else:
            self.section.show_basins(result.basin, (x0, x1), (y0, y1))
        self.section.choose(inside(result.starts, result.window))

    def _show_exponent(self, result: SuslovResult, hold_axes: bool) -> None:
        if result.exponent is None or result.course is None:
            self.exponent.clear("lambda", "divergence", "levels")
            return
        curves = {"lambda": (result.exponent.times, result.exponent.rates),
                  "divergence": (result.course.times, result.course.mean)}
        later = np.concatenate([y[len(y) // 10 :] for _, y in curves.values()])
        if not hold_axes:
            low, high = float(later.min()), float(later.max())
            room = 0.08 * max(1e-6, high - low)
            self.exponent.set_ranges((0.0, float(result.values["long"])), (min(0.0, low) - room, max(0.0, high) + room))
        for name, (x, y) in curves.items():
            self.exponent.show(name, *thinned(x, y))
        self.exponent.show_levels([0.0])

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the section starts an orbit there, besides those of earlier clicks."""
        return started(self._starts, x, y, _BOUNDS) if picture == "section" else {}

    def box(self, picture: str, corners: tuple[float, float, float, float]) -> Values:
        """A box in the section is the new window."""
        return boxed(corners, _BOUNDS) if picture == "section" else {}


def _captions(result: SuslovResult) -> dict[str, str]:
    plane = str(result.values["plane"])
    shown = f"{len(result.forward)} points forward"
    if len(result.backward):
        shown += f", {len(result.backward)} backward"
    captions = {
        "section": f"Section {plane}, growing\n{shown}; the later forward ones lie in "
                   f"{occupied_cells(result.later, _CELLS)} of {_CELLS**2} cells.",
        "omega": f"Angular velocity (ω₁, ω₂)\nThe chosen orbit, E = {number(result.E)}.",
        "sphere": "Poisson sphere\nThe vertical γ along the chosen orbit; r: the centre of mass.",
        "exponent": "Lyapunov exponent and divergence\nThey are found when a slider is let go.",
    }
    if result.basin is not None and np.all(result.basin > -1.0):
        share = float(np.mean(result.basin == 1.0))
        captions["section"] = f"Section {plane}: basins\n" + (
            "Two attractors, with " + f"{number(100 * share, 2)} % and {number(100 - 100 * share, 2)} % of the cells."
            if 0.0 < share < 1.0 else "All orbits come to one attractor.")
    if result.exponent is not None and result.course is not None:
        mean, end = float(result.course.mean[-1]), number(float(result.values["long"]))
        captions["exponent"] = (
            f"Lyapunov exponent and divergence\nλ = {number(result.exponent.value, 3)} ± "
            f"{number(result.exponent.spread, 2)}, div = {number(mean, 3)} after t = {end}.")
    return captions


def _derived(result: SuslovResult) -> list[str]:
    body = result.body
    psi, delta = result.starts[-1]
    return [
        f"E = {number(result.E, 6)}",
        f"chosen: ψ = {number(psi)}, δ = {number(delta)}",
        check_body(body.I11, body.I22, body.I13, body.I23).sentence,
    ]


def _status(result: SuslovResult) -> str:
    points = len(result.forward) + len(result.backward) + len(result.own)
    return section_status(f"section {points} points", result.drift, result.orbit, result.ended)


SCENE = Scene(
    name="suslov",
    title="Suslov problem with gravity",
    summary="Regular orbits, seas, strange attractors: sections forward and backward in time.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("section", "exponent", "omega", "sphere"),
    compute=compute,
    stage=SuslovStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=5,
)
