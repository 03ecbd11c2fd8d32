"""The Euler–Poisson equations near the Hess case (S11, S12): Andoyer–Deprit section, rotation number, exponent."""

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
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.lyapunov import Exponent, largest_exponent
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.euler_poisson.andoyer import (
    andoyer_points,
    coordinates,
    hess_curve,
    possible,
    relation,
    seeds,
    states_at,
)
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.numerics.accuracy import STANDARD, Level
from hess_mechanics.numerics.results import Array, Orbit, frozen

_MOST = 4000
_IN_A_DRAG = (16, 40)
"""Orbits and crossings while a slider is held."""
_ACROSS = 48
"""Orbits on the line along which the rotation number is looked at."""
_ON_LINE = 3000
"""Crossings of each: with fewer the rotation number in a chain of islands is not known to `_REGULAR`."""
_MOST_STEPS = 200_000
_CELLS = (96, 64)
_REGULAR = 1e-4
"""Where the rotation numbers of both halves of an orbit agree to this, it is taken for a closed curve."""
_FULL = ((-math.pi, -1.0), (math.pi, 1.0))
_BOUNDS = ((-TURN, -1.0), (TURN, 1.0))
"""The same, as places in a link are written."""

SPECS = (
    Number("I1", "I₁", "Moment I₁", 1.0, 0.1, 3.0, 0.005, 1e-3, 1e3, "First principal moment of inertia."),
    Number("I2", "I₂", "Moment I₂", 0.625, 0.1, 3.0, 0.005, 1e-3, 1e3,
           "Middle principal moment: it lies between I₁ and I₃, else there is no Hess condition."),
    Number("I3", "I₃", "Moment I₃", 0.375, 0.1, 3.0, 0.005, 1e-3, 1e3, "Third principal moment of inertia."),
    Number("away", "ε", "Distance from Hess, ε", 0.0, -0.5, 0.5, 0.005, -math.pi, math.pi,
           "The angle, in radians, by which the centre of mass r is turned away from the direction that the Hess "
           "condition asks for. At 0 the barrier r·M = 0 cannot be crossed."),
    Number("m", "μ|r|", "Weight times distance, μ|r|", 9.975, -20.0, 20.0, 0.005, -1e3, 1e3,
           "The potential is −μ(r, γ). Its sign is that of r."),
    Number("h", "h", "Energy h", 50.0, -1.0, 60.0, 0.05, -1e3, 1e5, "H = h."),
    Number("f", "f", "Area integral f", 5.0, -8.0, 8.0, 0.05, -1e3, 1e3, "(M, γ) = f; the section needs G ≥ |f|."),
    Number("orbits", "n", "Orbits", 60.0, 0.0, 200.0, 1.0, 0.0, 400.0, "How many orbits are spread over the window."),
    Number("count", "N", "Crossings", 300.0, 20.0, 1000.0, 10.0, 2.0, 4000.0, "How many points each orbit leaves."),
    Number("span", "t", "Time span", 20.0, 1.0, 200.0, 1.0, 0.01, 1e4, "How long the chosen orbit is followed."),
    Number("long", "T", "Time of the exponent", 200.0, 10.0, 1000.0, 10.0, 1.0, 1e4,
           "How long the Lyapunov exponent is averaged."),
    Choice("turns", "Rotation number", ("along l", "about the middle"), "along l",
           "Turns counted by the angle l, on a vertical line through the chosen start; or about the middle of the "
           "window, on a line from there to the right."),
    ACCURACY,
    Places("starts", "The places of the chosen orbits", 12, *_BOUNDS, "0,0.2"),
    Places("window", "The window of the section", 2, *_BOUNDS),
)

# An example says also along what the rotation number is looked at: choices else stay as they were.
_ALONG = {"turns": "along l"}
_RIS = {**_ALONG, "I1": 1.0, "I2": 1.5, "I3": 2.0, "m": -math.sqrt(0.5), "span": 60.0, "starts": "2.8,0.3"}
_NONE, _STABLE, _UNSTABLE = "no Hess motion yet", "the Hess motion is stable", "it is unstable, two layers part"
_BELOW, _AT, _ABOVE = "a curve in a regular leaf", "the separatrix", "two layers part"
PRESETS = (
    Preset("Two layers that never mix (figure gess1)", _ALONG),
    Preset("Meandering torus (figure gess2)", {
        "window": "-2.25,-0.27;-1.45,0.33", "turns": "about the middle", "starts": "-1.558,0.03", "orbits": 40.0,
        "count": 600.0}),
    Preset("The barrier breaks: 0.02 away from Hess", {**_ALONG, "away": 0.02, "count": 600.0}),
    *(Preset(f"gess-ris1 {letter}: f = 0, h = {h:.4g}, {what}", {**_RIS, "h": h, "f": 0.0}) for letter, h, what in (
        ("a", -0.4, _BELOW), ("b", 0.0, _BELOW), ("c", 0.5, _BELOW), ("d", math.sqrt(0.5), _AT), ("e", 1.0, _ABOVE),
        ("f", 2.0, _ABOVE))),
    # At the lowest energies the other start is not possible.
    *(Preset(f"gess-ris2 {letter}: f = 1, h = {h:.4g}, {what}", {
        **_RIS, "h": h, "f": 1.0, "starts": _RIS["starts"] if h > 0.4 else "-1.54,-0.86"}) for letter, h, what in (
        ("a", 0.0, _NONE), ("b", 0.2, _STABLE), ("c", 0.5, _STABLE), ("d", 0.8, _UNSTABLE), ("e", 1.0, _UNSTABLE),
        ("f", 1.3, _UNSTABLE), ("g", 2.0, _UNSTABLE), ("h", 4.0, _UNSTABLE))),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="dot small" style="background: #0072B2"></span>r·M &gt; 0</li>
<li><span class="dot small" style="background: #D55E00"></span>r·M &lt; 0</li>
<li><span class="dot small" style="background: #CC79A7"></span>chosen orbit, from its ring</li>
<li><span class="line stable"></span>Hess manifold, r·M = 0</li>
<li><span class="line muted" style="border-top-style: dashed"></span>line of the rotation number</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<rect x="4" y="3" width="40" height="26" fill="none" stroke="#808080"/>
<path d="M4 16C11 4 17 4 24 16S37 28 44 16" fill="none" stroke="#009E73" stroke-width="2"/>
<ellipse cx="14" cy="19" rx="5" ry="4" fill="none" stroke="#D55E00" stroke-width="1.5"/>
<ellipse cx="34" cy="13" rx="6" ry="5" fill="none" stroke="#0072B2" stroke-width="1.5"/>
<g stroke-width="2" stroke-linecap="round">
<path d="M6 25h.1M12 27h.1M20 24h.1M25 26h.1M9 22h.1M41 26h.1" stroke="#D55E00"/>
<path d="M8 7h.1M20 6h.1M27 6h.1M39 6h.1M42 10h.1M24 9h.1" stroke="#0072B2"/>
</g>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Rotation:
    """Rotation numbers `rho` of the orbits that start at `along` on the line `ends`, in parts without a gap.

    complete : whether all orbits of the line are known.
    """

    ends: Window
    complete: bool
    along: tuple[Array, ...]
    rho: tuple[Array, ...]


@dataclass(frozen=True)
class EulerPoissonResult:
    """What the pictures that are seen need; None what no picture asks for, or what is not computed yet.

    first, second : points (n, 2) of orbits that start with r·M > 0, and < 0; kept : how many of `count` orbits keep
    its sign; own : those of the chosen orbits; impossible : cells (m, n).
    """

    values: Values
    body: HeavyBody
    window: Window
    starts: Sequence[tuple[float, float]]
    first: Array
    second: Array
    own: Array
    kept: int
    count: int
    drift: Mapping[str, float]
    impossible: Array | None
    rotation: Rotation | None
    exponent: Exponent | None
    orbit: Orbit | None
    note: str
    todo: Sequence[Task]
    total: int
    ended: str


def body_of(values: Values) -> HeavyBody:
    """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
    I1, I2, I3 = (float(values[name]) for name in ("I1", "I2", "I3"))
    return HeavyBody.hess((I1, I2, I3), float(values["m"]), float(values["away"]))


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """A window that is one, and at least one start."""
    out = {**values, "window": tidy_window(values["window"])}
    if not places(out["starts"]):
        out["starts"] = next(spec.default for spec in SPECS if spec.name == "starts")
    return out, []


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The energy from where the bottom of the potential is."""
    bottom = -math.floor(100.0 * abs(float(values["m"]))) / 100.0
    return {"h": (bottom, max(60.0 if abs(float(values["m"])) > 2.0 else 6.0, bottom + 1.0), 0.01)}


def _starts(body: HeavyBody, h: float, f: float, chosen: Sequence[tuple[float, float]], window: Window
            ) -> tuple[Sequence[tuple[float, float]], Sequence[tuple[float, ...]], str]:
    """Those of the chosen places where a motion is possible, the states there, and a note on the others.

    Raises `InvalidParameter` where nothing is possible in the window.
    """
    l, x = np.array(chosen).T
    states, _, growing = states_at(body, h, f, l, x)

    def instead() -> tuple[tuple[float, float], tuple[float, ...]]:
        others = _seeds(body, h, f, window, 1)
        if not others:
            raise InvalidParameter(f"Nothing is possible here with h = {h:.6g} and f = {f:.6g}: choose a larger h, a "
                                   "smaller |f|, or press Clear for the whole section.")
        l, x = coordinates(np.array(others))[0]
        return (float(l), float(x)), others[0]

    places_, kept_states, kept = possible_starts(chosen, states, growing, instead)
    return places_, kept_states, "" if kept else (
        f"At l = {number(chosen[-1][0])}, L/G = {number(chosen[-1][1])} no motion with this h and f crosses the "
        f"section: the chosen orbit starts at l = {number(places_[0][0])}, L/G = {number(places_[0][1])}.")


def _piece(body: HeavyBody, h: float, f: float, starts: tuple[tuple[float, ...], ...], crossings: int
           ) -> tuple[tuple[Array, ...], tuple[float, ...], tuple[bool, ...], Mapping[str, float]]:
    """Points (n, 2) of each orbit, the sign of r·M at its start, whether all points have it; the drift."""
    points = andoyer_points(body, h, f, starts, crossings, STANDARD, threads=1, most_steps=_MOST_STEPS)
    signs = tuple(float(sign) for sign in np.sign(relation(body, np.array(starts))))
    kept = tuple(bool(np.all(sign * relation(body, states) >= 0.0))
                 for states, sign in zip(points.states, signs, strict=True))
    return tuple(frozen(coordinates(states)) for states in points.states), signs, kept, points.drift


def _seeds(body: HeavyBody, h: float, f: float, window: Window, count: int) -> tuple[tuple[float, ...], ...]:
    (l0, x0), (l1, x1) = window
    return tuple(seeds(body, h, f, (l0, l1, x0, x1), count)) if count else ()


def _impossible(body: HeavyBody, h: float, f: float, window: Window) -> Array:
    (l0, x0), (l1, x1) = window
    m, n = _CELLS
    l, x = np.meshgrid(l0 + (np.arange(m) + 0.5) * (l1 - l0) / m, x0 + (np.arange(n) + 0.5) * (x1 - x0) / n)
    return frozen(1.0 - possible(body, h, f, l.ravel(), np.clip(x.ravel(), -1.0, 1.0)).reshape(n, m))


def _orbit(body: HeavyBody, start: tuple[float, ...], span: float, accuracy: Level) -> Orbit:
    weights = np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]) * 0.5 * PIXELS
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, weights, SAGITTA, _MOST)
    return solve(SYSTEM, start, body.parameters, times, accuracy)


def _line(values: Values, window: Window, start: tuple[float, float]) -> Window:
    """Ends of the line across which the rotation number is looked at."""
    (l0, x0), (l1, x1) = window
    if values["turns"] == "along l":
        return (start[0], x0), (start[0], x1)
    middle = 0.5 * (x0 + x1)
    return (0.5 * (l0 + l1), middle), (l1, middle)


def _on_line(body: HeavyBody, h: float, f: float, ends: Window) -> tuple[tuple[float, tuple[float, ...]], ...]:
    """Shares of the way along the line, and the states there, where there are any."""
    shares = (np.arange(_ACROSS) + 0.5) / _ACROSS
    l, x = ((1.0 - shares) * a + shares * b for a, b in zip(*ends, strict=True))
    states, _, growing = states_at(body, h, f, l, x)
    return tuple((float(share), tuple(map(float, state)))
                 for share, state in zip(shares[growing], states[growing], strict=True))


def _rotation(values: Values, ends: Window, shares: Sequence[float], orbits: Sequence[Array], complete: bool
              ) -> Rotation:
    """Rotation numbers of the orbits that are closed curves."""
    centre = None if values["turns"] == "along l" else ends[0]
    axis = 1 if centre is None else 0
    along: list[list[float]] = [[]]
    rho: list[list[float]] = [[]]
    last = -1.0
    for share, points in zip(shares, orbits, strict=True):
        if len(points) < 20:
            continue
        turns, spread = rotation_number(points, centre)
        if spread > _REGULAR:
            continue
        # A gap, or the jump from ½ to −½, divides the curve.
        if rho[-1] and (share - last > 1.5 / _ACROSS or abs(turns - rho[-1][-1]) > 0.5):
            along.append([])
            rho.append([])
        along[-1].append((1.0 - share) * ends[0][axis] + share * ends[1][axis])
        rho[-1].append(turns)
        last = share
    return Rotation(ends, complete, tuple(map(np.array, along)), tuple(map(np.array, rho)))


def compute(values: Values, shown: Collection[str], dragging: bool) -> EulerPoissonResult:
    """The section, piece by piece; what the other pictures show of the chosen orbit."""
    work = Work(values, dragging)
    body, window = body_of(values), window_of(values["window"], _FULL)
    h, f = float(values["h"]), float(values["f"])
    starts, states, note = _starts(body, h, f, places(values["starts"]), window)
    start = states[-1]
    count, crossings = (int(float(values[name])) for name in ("orbits", "count"))
    if dragging:
        count, crossings = min(count, _IN_A_DRAG[0]), min(crossings, _IN_A_DRAG[1])
    get = work.get if dragging else work.later
    first, second, own = ([np.empty((0, 2))] for _ in range(3))
    kept = total = 0
    drift: dict[str, float] = {}
    impossible: Array | None = None
    if "section" in shown:
        impossible = work.get(_impossible, body, h, f, window)
        for state in states:
            found = get(_piece, body, h, f, (state,), crossings)
            own += found[0] if found is not None else ()
        spread = work.get(_seeds, body, h, f, window, count)
        for i in range(0, len(spread), PIECE):
            found = get(_piece, body, h, f, spread[i : i + PIECE], crossings)
            if found is not None:
                for points, sign in zip(*found[:2], strict=True):
                    (first if sign > 0.0 else second).append(points)
                kept += sum(found[2])
                total += len(found[2])
                drift = worst(drift, found[3])
    rotation: Rotation | None = None
    if "rotation" in shown and not dragging:
        ends = _line(values, window, starts[-1])
        on_line = work.get(_on_line, body, h, f, ends)
        shares: list[float] = []
        orbits: list[Array] = []
        for i in range(0, len(on_line), PIECE):
            piece = on_line[i : i + PIECE]
            found = get(_piece, body, h, f, tuple(state for _, state in piece), max(crossings, _ON_LINE))
            if found is not None:
                shares += [share for share, _ in piece]
                orbits += found[0]
        rotation = _rotation(values, ends, shares, orbits, len(shares) == len(on_line))
    exponent = None
    if "exponent" in shown and not dragging:
        exponent = get(largest_exponent, SYSTEM, start, body.parameters, float(values["long"]))
    orbit = None
    if not {"sphere", "section"}.isdisjoint(shown):
        orbit = work.get(_orbit, body, start, float(values["span"]), work.level)
    return EulerPoissonResult(
        values=values, body=body, window=window, starts=starts, first=np.concatenate(first),
        second=np.concatenate(second), own=np.concatenate(own), kept=kept, count=total, drift=drift,
        impossible=impossible, rotation=rotation, exponent=exponent, orbit=orbit, note=note, todo=tuple(work.todo),
        total=work.pieces, ended=work.ended())


def motion(values: Values) -> Motion:
    """The chosen orbit, for "Speed and accuracy".  Raises `ModelError`."""
    body, window = body_of(values), window_of(values["window"], _FULL)
    _, states, _ = _starts(body, float(values["h"]), float(values["f"]), places(values["starts"]), window)
    start = states[-1]
    radius = 0.5 * PIXELS
    return Motion(SYSTEM, start, body.parameters, float(values["span"]), (0.0, 0.0, 0.0, radius, radius, radius), 1.0)


class EulerPoissonStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"section-point": ("l", "x")}
    angles: Sequence[str] = ("l",)

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self._starts: Sequence[tuple[float, float]] = ()
        self.section = LayeredSection(wire, "section", ("l", "L/G"), (-math.pi, math.pi), (-1.0, 1.0), path=True)
        self.rotation = Graph(wire, "rotation", (" ", "ρ"), (-1.0, 1.0), (-0.5, 0.5), [Series("rho", theme.ORBIT)])
        # An orbit between two gaps is a curve of one point.
        self.rotation.add("orbits", "scatter", ("x", "y"), size=4, color=theme.ORBIT)
        self.exponent = Graph(wire, "exponent", ("t", "λ"), (0.0, 200.0), (0.0, 1.0), [Series("lambda", theme.ORBIT)])
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.pictures = (self.section, self.rotation, self.exponent, self.sphere)

    def show(self, result: EulerPoissonResult, hold_axes: bool) -> Report:
        """Draw what is known of the section, the rotation number, the exponent and the orbit."""
        self._starts = result.starts
        for view in (self.section, self.rotation, self.exponent):
            view.say("")
        self._show_section(result, hold_axes)
        if result.rotation is not None:
            self._show_rotation(result.rotation, str(result.values["turns"]), hold_axes)
        else:
            self.rotation.clear("rho", "orbits", "across")
        if result.exponent is not None:
            exponent = result.exponent
            later = exponent.rates[len(exponent.rates) // 10 :]
            if not hold_axes:
                top = nice_above(1.05 * max(1e-6, float(later.max())))
                self.exponent.set_ranges((0.0, float(exponent.times[-1])), (min(0.0, 1.05 * float(later.min())), top))
            self.exponent.show("lambda", *thinned(exponent.times, exponent.rates))
        else:
            self.exponent.clear("lambda")
        sign = math.copysign(1.0, float(result.values["m"]))
        self.sphere.show(tuple(sign * r for r in result.body.r), "r")
        for name, text in _captions(result).items():
            self.wire.say(name, text)
        notes = [result.note] if result.note else []
        return Report(_derived(result), _status(result), notes, result.todo, result.total)

    def _show_section(self, result: EulerPoissonResult, hold_axes: bool) -> None:
        (l0, x0), (l1, x1) = result.window
        if not hold_axes:
            self.section.set_ranges((l0, l1), (x0, x1))
        self.section.show(result.first, result.second, result.own, whole=not (result.todo or hold_axes))
        if result.impossible is not None:
            self.section.show_impossible(result.impossible, (l0, l1), (x0, x1))
        l = np.linspace(l0, l1, 241)
        self.section.show_line("curve", l, hess_curve(result.body, l))
        ends = inside(_line(result.values, result.window, result.starts[-1]), result.window)
        self.section.show_line("line", [l for l, _ in ends], [x for _, x in ends])
        self.section.choose(inside(result.starts, result.window))
        if result.orbit is not None:
            states = result.orbit.states
            l, x = coordinates(states).T
            self.section.assign(
                "path", t=result.orbit.times.astype(np.float32), l=l.astype(np.float32), x=x.astype(np.float32),
                **{f"g{i + 1}": states[:, 3 + i].astype(np.float32) for i in range(3)})

    def _show_rotation(self, rotation: Rotation, turns: str, hold_axes: bool) -> None:
        self.rotation.assign("rho", xs=[part.astype(np.float32) for part in rotation.along],
                             ys=[part.astype(np.float32) for part in rotation.rho])
        axis = 1 if turns == "along l" else 0
        along, values = (np.concatenate([np.empty(0), *parts]) for parts in (rotation.along, rotation.rho))
        self.rotation.assign("orbits", x=along.astype(np.float32), y=values.astype(np.float32))
        if not hold_axes:
            low, high = (float(values.min()), float(values.max())) if values.size else (-0.5, 0.5)
            room = max(1e-4, 0.06 * (high - low))
            self.rotation.set_ranges((rotation.ends[0][axis], rotation.ends[1][axis]), (low - room, high + room))
        self.rotation.name_across("L/G" if axis else "l")
        if not values.size and rotation.complete:
            self.rotation.say("No orbit of the line is a closed curve")

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the section starts an orbit there, besides those of earlier clicks."""
        return started(self._starts, x, y, _BOUNDS) if picture == "section" else {}

    def box(self, picture: str, corners: tuple[float, float, float, float]) -> Values:
        """A box in the section is the new window."""
        return boxed(corners, _BOUNDS) if picture == "section" else {}


def _extremum(rotation: Rotation) -> tuple[float, float] | None:
    """Where the rotation number turns round between the ends of the line; None where it does not."""
    along, rho = np.concatenate(rotation.along), np.concatenate(rotation.rho)
    for i in (int(np.argmin(rho)), int(np.argmax(rho))):
        if 2 <= i <= len(rho) - 3 and min(abs(rho[i] - rho[0]), abs(rho[i] - rho[-1])) > 3 * _REGULAR:
            return float(along[i]), float(rho[i])
    return None


def _turns(rho: float) -> str:
    """A rotation number, to what is known of it."""
    return number(round(float(rho) / _REGULAR) * _REGULAR)


def _captions(result: EulerPoissonResult) -> dict[str, str]:
    hess = float(result.values["away"]) == 0.0
    kept = f"r·M keeps its sign along {result.kept} of {result.count} orbits"
    captions = {
        "section": f"Section g = π/2 (Andoyer–Deprit)\n{kept}" + (": the layers never mix." if hess else "."),
        "sphere": "Poisson sphere\nThe vertical γ along the chosen orbit; r: the centre of mass.",
        "rotation": "Rotation number across the section\nIt is found when a slider is let go.",
        "exponent": "Largest Lyapunov exponent\nIt is found when a slider is let go.",
    }
    if result.rotation is not None and any(map(len, result.rotation.rho)):
        values = np.concatenate(result.rotation.rho)
        # A line through all of the section meets orbits of many kinds, whose numbers are no one function of the place.
        turning = _extremum(result.rotation) if result.values["turns"] == "about the middle" else None
        captions["rotation"] = (
            f"Rotation number across the section\nFrom {_turns(values.min())} to {_turns(values.max())}"
            + ("." if turning is None else
               f"; it turns round at {number(turning[0])} with ρ = {_turns(turning[1])}: no twist there."))
    elif result.rotation is not None:
        captions["rotation"] = "Rotation number across the section\n" + (
            "No orbit of the line is a closed curve." if result.rotation.complete else "It is being computed.")
    if result.exponent is not None:
        exponent = result.exponent
        # A regular motion's neighbour goes away no faster than t: the mean then falls as ln(t)/t.
        regular = exponent.value < 2.0 * math.log(max(math.e, exponent.times.size)) / exponent.times[-1]
        kind = "falling as ln(t)/t: regular so far" if regular else "chaotic"
        end = number(float(exponent.times[-1]))
        captions["exponent"] = (f"Largest Lyapunov exponent\nλ = {number(exponent.value, 3)} after t = {end}, "
                                f"± {number(exponent.spread, 2)} lately: {kind}.")
    return captions


def _derived(result: EulerPoissonResult) -> list[str]:
    body = result.body
    l, x = result.starts[-1]
    return [
        f"a = {number(body.hess_a)}, r = ({', '.join(number(r) for r in body.r)})",
        f"chosen: l = {number(l)}, L/G = {number(x)}",
        body.check.sentence,
    ]


def _status(result: EulerPoissonResult) -> str:
    points = len(result.first) + len(result.second) + len(result.own)
    return section_status(f"section {points} points", result.drift, result.orbit, result.ended)


SCENE = Scene(
    name="euler-poisson",
    title="Euler–Poisson: sections",
    summary="A heavy body near the Hess case: two stochastic layers with a barrier between them, a meandering torus.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("section", "rotation", "exponent", "sphere"),
    compute=compute,
    stage=EulerPoissonStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=11,
)
