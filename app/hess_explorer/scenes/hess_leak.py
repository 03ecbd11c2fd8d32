"""Leak off the Hess manifold (S12): r·M of an orbit that should keep it 0, its growth, and the exact motion beside."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import euler_poisson
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.figure import columns_of
from hess_explorer.views.graph import Graph
from hess_explorer.views.poisson_sphere import Circle, PoissonSphere
from hess_explorer.views.text import number
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.errors import NoField, Separatrix
from hess_mechanics.euler_poisson.andoyer import coordinates
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_manifold import FreeRun, Growth, growth_of, run_free
from hess_mechanics.numerics.accuracy import REFERENCE
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, f_max, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody

_IN_A_PERIOD = 96
FLOOR = -17.5
"""The logarithm that stands for 0."""
_LN10 = math.log(10.0)
_INSIDE = 1.0 - 1e-12
"""Room for the round-off of the translation at the edge of what is possible."""

UNSURE = 1e-9
BY_THE_UNSTABLE_CYCLE = "This motion starts next to the unstable cycle: on the torus too any round-off grows there."

MOMENTS = tuple(spec for spec in euler_poisson.SPECS if spec.name in ("I1", "I2", "I3", "m"))

SPECS = (
    *MOMENTS,
    Number("h", "h", "Energy h", 50.0, -9.0, 100.0, 0.05, -1e3, 1e5, "H = h; above −μ|r|."),
    Number("f", "f", "Area integral f", 5.0, -8.0, 8.0, 0.05, -1e3, 1e3, "(M, γ) = f. Its range follows h."),
    Number("phi0", "φ₀", "Phase φ₀", 0.5, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Phase of the start on the torus, at the lowest place of the centre of mass, in radians."),
    Number("returns", "N", "Periods", 20.0, 5.0, 60.0, 1.0, 1.0, 200.0, "How many periods of n₃ are followed."),
    ACCURACY,
)

RIS = {"I1": 1.0, "I2": 1.5, "I3": 2.0, "m": math.sqrt(0.5)}
"""The body of figures gess-ris1 and gess-ris2, after half a turn about its middle axis."""

PRESETS = (
    Preset("Figure gess1: h = 50, f = 5", {}),
    Preset("No cycles: the manifold is stable", {"h": 5.0, "f": 0.8, "returns": 60.0}),
    Preset("f = 0: loxodromic pendulum, e^(2πa)", {"h": 20.0, "f": 0.0}),
    Preset("From the unstable cycle", {"phi0": -1.7044856772778523, "returns": 30.0}),
    Preset("Body of gess-ris2, f = 1, h = 2", {**RIS, "h": 2.0, "f": 1.0, "returns": 30.0}),
    Preset("Body of gess-ris2, f = 1, h = 0.3", {**RIS, "h": 0.3, "f": 1.0, "returns": 60.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit at the chosen accuracy; on the sphere the exact one</li>
<li><span class="line second"></span>at reference; on the sphere the one that leaks</li>
<li><span class="line muted" style="border-top-style: dashed"></span>slope ln(multiplier) per period</li>
<li><span class="line stable"></span>Hess manifold, r·M = 0</li>
<li><span class="dot" style="background: none; border-color: #D55E00"></span>start</li>
<li><span class="dot point"></span>moving point</li>
</ul>
"""

THUMBNAIL = """
<path d="M5 3V29H45" fill="none" stroke="#808080"/>
<path d="M7 26 29 8" stroke="#808080" stroke-width="1.5" stroke-dasharray="3 2"/>
<path d="M7 27 9 25 11 26 16 20 18 21 24 13 26 14 31 7 34 8 37 5 40 9 44 6" fill="none" stroke="#0072B2"
  stroke-width="2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class LeakResult:
    """chosen, floor : the orbit left to itself at the accuracy chosen and at reference; `exact` at the same times.

    exact : of `eq01` in units b = 1; states : the same (n, 6) as one of `hh01`; growth : of each, if it is seen.
    """

    values: Values
    bridge: Bridge
    turning: TurningPoints
    map: CircleMap
    chosen: FreeRun
    floor: FreeRun
    growth: tuple[Growth | None, Growth | None]
    exact: Orbit
    states: Array
    ended: str

    @property
    def period(self) -> float:
        """One period of n3, in the body's time."""
        return self.map.period / self.bridge.hess.frequency_unit


def _least_weight(values: Values) -> float:
    return max(1e-3, 1e-9 * abs(float(values["h"])))


def _has_weight(values: Values) -> bool:
    """Whether h in units of μ|r| is a number to compute with."""
    return abs(float(values["m"])) >= _least_weight(values)


def admit_motion(values: Values) -> tuple[dict[str, Value], list[str]]:
    """h above the bottom, and f inside the region of this h, for a heavy body."""
    out: dict[str, Value] = dict(values)
    notes: list[str] = []
    m, h, f = (float(out[name]) for name in ("m", "h", "f"))
    if not _has_weight(values):
        return out, notes
    bottom = -abs(m) * _INSIDE
    if h < bottom:
        out["h"] = bottom
        notes.append(f"The energy is above −μ|r|: h is {number(bottom)} now.")
    largest = largest_f(out)
    if abs(f) > largest:
        out["f"] = math.copysign(largest, f)
        notes.append(f"At h = {number(float(out['h']))} only |f| ≤ {number(largest)} is possible on the Hess manifold: "
                     "f is at that edge now.")
    return out, notes


def largest_f(values: Values) -> float:
    """The largest |f| on the Hess manifold at this h: f_max in the units of Euler–Poisson."""
    m, I2, h = (float(values[name]) for name in ("m", "I2", "h"))
    return f_max(h / abs(m)) * math.sqrt(abs(m) * I2) * _INSIDE


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The sliders of h and f span what is possible, in round steps."""
    m, h = abs(float(values["m"])), float(values["h"])
    if not _has_weight(values) or h <= -m:
        return {}
    step = 10.0 ** (math.floor(math.log10(m)) - 2)
    low = -math.floor(m / step * 0.995) * step
    largest = largest_f(values)
    fine = 10.0 ** (math.floor(math.log10(largest)) - 2)
    end = math.floor(largest / fine) * fine
    return {"h": (low, max(10.0 * m, h), step), "f": (-end, end, fine)}


def bridge_of(values: Values) -> Bridge:
    """The heavy body, and the Suslov body of its motions.  Raises `InvalidParameter`, `NoField`."""
    I1, I2, I3, m = (float(values[spec.name]) for spec in MOMENTS)
    if not _has_weight(values):
        raise NoField(f"μ|r| = {number(m)}: without weight there is no Hess case. Choose μ|r| of at least "
                      f"{number(_least_weight(values))}.")
    return Bridge.of_heavy(HeavyBody.hess((I1, I2, I3), m))


def torus_of(values: Values, bridge: Bridge) -> tuple[float, float, TurningPoints]:
    """(h, f) in units b = 1, and where n3 turns.  Raises `Separatrix`, `OutsideRegion`."""
    h, f = bridge.in_units_of_b(float(values["h"]), float(values["f"]))
    try:
        return h, f, turning_points(h, f)
    except Separatrix:
        raise Separatrix(
            "h = μ|r|, f = 0 is the separatrix: n₃ has no period. Choose another h, or f other than 0.") from None


def _exact(a: float, start: tuple[float, ...], end: float, count: int) -> Orbit:
    return solve(SYSTEM, start, (a, 1.0), np.linspace(0.0, end, count), REFERENCE)


def compute(values: Values, shown: Collection[str], dragging: bool) -> LeakResult:
    """Both runs and the exact motion; a slider that is held keeps the accuracy, which is what is looked at."""
    work = Work(values, False)
    bridge = bridge_of(values)
    hess = bridge.hess
    h, f, turning = torus_of(values, bridge)
    theta = work.get(circle_map, hess.a, h, f, REFERENCE)
    periods = round(float(values["returns"]))
    count = periods * _IN_A_PERIOD + 1
    start = turning.state_at_lower_turn(float(values["phi0"]))
    exact = work.get(_exact, hess.a, tuple(start.tolist()), periods * theta.period, count)
    states = frozen(bridge.from_reduced(hess.from_units_of_b(exact.states)))
    end = periods * theta.period / hess.frequency_unit
    chosen, floor = (work.get(run_free, bridge.heavy, tuple(states[0].tolist()), end, count, rung)
                     for rung in (work.level, REFERENCE))
    growth = growth_of(chosen, _IN_A_PERIOD), growth_of(floor, _IN_A_PERIOD)
    return LeakResult(values=values, bridge=bridge, turning=turning, map=theta, chosen=chosen, floor=floor,
                      growth=growth, exact=exact, states=states, ended=work.ended())


def motion_of(hess: HessBody, start: Array, h: float, length: float) -> Motion:
    """A motion of `eq01` in units b = 1, for "Speed and accuracy"."""
    radius = 0.5 * PIXELS
    w = radius / math.sqrt(2.0 * (h + 1.0))
    return Motion(SYSTEM, tuple(start.tolist()), (hess.a, 1.0), length, (w, w, radius, radius, radius),
                  1.0 / hess.frequency_unit)


def motion(values: Values) -> Motion:
    """The exact motion, of the reduced system.  Raises `ModelError`."""
    bridge = bridge_of(values)
    h, _, turning = torus_of(values, bridge)
    start = turning.state_at_lower_turn(float(values["phi0"]))
    return motion_of(bridge.hess, start, h, round(float(values["returns"])) * turning.period)


def logarithm(distance: Array) -> Array:
    """lg of what is not negative, from the floor of the axis on."""
    return np.log10(np.maximum(distance, 10.0**FLOOR))


def top_of(h: float) -> float:
    """Above the lg of every distance between two motions of energy h, in units b = 1."""
    return math.ceil(2.0 * math.log10(4.0 * math.sqrt(2.0 * (h + 1.0)) + 4.0)) / 2.0


class AndoyerGraph(Graph):
    """(l, L/G) of an orbit, and the curve of the Hess relation."""

    def __init__(self, wire: Wire) -> None:
        ticks = [(-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π")]
        y_ticks = [(-1.0, "−1"), (-0.5, "−½"), (0.0, "0"), (0.5, "½"), (1.0, "1")]
        super().__init__(wire, "andoyer", ("l", "L/G"), (-math.pi, math.pi), (-1.0, 1.0),
                         [Series("hess", theme.STABLE), Series("orbit", theme.ORBIT)], ticks=ticks, y_ticks=y_ticks)

    def show_motion(self, body: HeavyBody, points: Array) -> None:
        """Points (n, 2) along an orbit of this body, a ring round the first."""
        self.choose(float(points[0, 0]), float(points[0, 1]))
        self._draw("orbit", points)
        # M across r, all the way round: also where r lies along an axis, and the curve stands upright.
        turn = np.linspace(-math.pi, math.pi, 241)
        across = np.column_stack([body.r[2] * np.sin(turn), np.cos(turn), -body.r[0] * np.sin(turn)])
        self._draw("hess", coordinates(across))

    def _draw(self, name: str, points: Array) -> None:
        parts = _parts(points)
        self.assign(name, xs=[part[:, 0].astype(np.float32) for part in parts],
                    ys=[part[:, 1].astype(np.float32) for part in parts])


def _parts(points: Array) -> list[Array]:
    """A curve of points (l, L/G), cut where M turns round through 0, and where l passes ±π: there past the edge."""
    l, x = points.T
    s = np.sqrt(np.maximum(0.0, 1.0 - x * x))
    direction = np.column_stack([s * np.sin(l), s * np.cos(l), x])
    round_ = np.sum(direction[1:] * direction[:-1], axis=1) < 0.0
    passes = (np.abs(np.diff(l)) > math.pi) & ~round_
    turn = np.column_stack([2.0 * math.pi * np.sign(np.diff(l)), np.zeros(l.size - 1)])
    cuts = np.flatnonzero(round_ | passes) + 1
    parts = []
    for first, last in zip([0, *cuts], [*cuts, l.size], strict=True):
        pieces = [points[first:last]]
        if first and passes[first - 1]:
            pieces.insert(0, points[first - 1 : first] + turn[first - 1])
        if last < l.size and passes[last - 1]:
            pieces.append(points[last : last + 1] - turn[last - 1])
        parts.append(np.concatenate(pieces))
    return parts


class LeakStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "leak-point": ("t", "lg"), "difference-point": ("t", "apart"), "andoyer-point": ("l", "x"),
    }
    angles: Sequence[str] = ("l",)

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        both = [Series("reference", theme.MAP, "dotdash"), Series("own", theme.ORBIT)]
        self.leak = Graph(wire, "leak", ("t", "lg |r·M|"), (0.0, 10.0), (FLOOR, 0.5),
                          [*both, Series("slope", theme.MUTED, "dashed")])
        self.difference = Graph(wire, "difference", ("t", "lg |difference|"), (0.0, 10.0), (FLOOR, 1.5), both)
        # Their lines are those of the sphere: here only their data are kept.
        self.difference.add("exact", "line", ("t", "apart"), source="data-orbit", line_alpha=0)
        self.difference.add("leaking", "line", ("t", "apart"), source="data-second", line_alpha=0)
        self.andoyer = AndoyerGraph(wire)
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit", "data-second": "second"})
        self.pictures = (self.leak, self.difference, self.andoyer, self.sphere)

    def show(self, result: LeakResult, hold_axes: bool) -> Report:
        """Draw both orbits and the exact one."""
        chosen, floor, bridge = result.chosen, result.floor, result.bridge
        end = float(chosen.times[-1])
        if not hold_axes:
            self.leak.set_ranges((0.0, end), (FLOOR, 0.5))
            self.difference.set_ranges((0.0, end), (FLOOR, top_of(result.map.h)))
        for graph in (self.leak, self.difference, self.andoyer):
            graph.say("")
        lg, apart = {}, {}
        for name, run in (("reference", floor), ("own", chosen)):
            lg[name] = logarithm(np.abs(run.off))
            apart[name] = logarithm(bridge.distance(run.states, result.exact.states))
            self.leak.show(name, run.times, lg[name])
            self.difference.show(name, run.times, apart[name])
        self._show_slope(result)
        points = coordinates(chosen.states)
        self.andoyer.show_motion(bridge.heavy, points)
        l, x = points.T.astype(np.float32)
        both_graphs = {"t": chosen.times.astype(np.float32), "apart": apart["own"].astype(np.float32)}
        self.difference.assign("exact", **both_graphs, lg=lg["own"].astype(np.float32), l=l, x=x,
                               **columns_of(result.states[:, 3:], ("g1", "g2", "g3")))
        self.difference.assign("leaking", **both_graphs, **columns_of(chosen.states[:, 3:], ("g1", "g2", "g3")))
        self._show_sphere(result)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def _show_slope(self, result: LeakResult) -> None:
        growth = result.growth[0]
        if growth is None or result.map.kind != "hyperbolic":
            self.leak.clear("slope")
            return
        rate = exponent(result) / (result.period * _LN10)
        first = growth.first * _IN_A_PERIOD
        straight = slice(first, first + growth.periods * _IN_A_PERIOD)
        t = result.chosen.times[straight]
        at, middle = float(np.mean(np.log10(np.abs(result.chosen.off[straight])))), float(np.mean(t))
        ends = np.array([FLOOR, 0.5])
        self.leak.show("slope", middle + (ends - at) / rate, ends)

    def _show_sphere(self, result: LeakResult) -> None:
        sign = math.copysign(1.0, result.bridge.hess.b)
        r = result.bridge.heavy.r
        self.sphere.show(r, "r", [Circle(r, sign * n3, "limit") for n3 in result.turning.roots[1:]
                                  if abs(n3) < 1.0 - 1e-9])

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """No picture chooses."""
        return {}


def exponent(result: LeakResult) -> float:
    """The exact growth of ln |r·M| in one period on the stable cycle; 0 without cycles."""
    fixed = result.map.fixed_points
    return abs(fixed[0].log_multiplier) if fixed else 0.0


def _captions(result: LeakResult) -> tuple[str, str, str, str]:
    chosen = result.chosen
    largest = float(np.max(np.abs(chosen.off)))
    growth = result.growth[0]
    if result.map.kind != "hyperbolic":
        leak = f"Stable: no cycles, no growth; after {round(float(result.values['returns']))} periods |r·M| ≤ " \
               f"{number(largest, 2)}."
    elif growth is None:
        leak = f"Exact growth {number(exponent(result), 6)} a period; too little of it is straight to measure."
    else:
        leak = f"ln |r·M| grows by {number(growth.per_period, 6)} a period over {growth.periods} of them; exact " \
               f"{number(exponent(result), 6)}."
    apart = result.bridge.distance(chosen.states, result.exact.states)
    side = _side(result)
    return (
        f"r·M against time\n{leak}",
        f"Distance from the exact motion\n{chosen.level}: up to {number(float(apart.max()), 2)} (units b = 1) from "
        "that of the reduced system.",
        f"Andoyer variables (l, L/G)\n{side}",
        f"Poisson sphere\nThe exact γ, n₃ from {number(result.turning.roots[1])} to {number(result.turning.roots[2])}, "
        "and the one that leaks.",
    )


def _side(result: LeakResult) -> str:
    off = result.chosen.off
    far = np.abs(off) > 1e-3
    if not far.any():
        return "The orbit keeps to the Hess relation, to round-off."
    sign = "> 0" if off[far][0] > 0.0 else "< 0"
    if np.all(off[far] * off[far][0] > 0.0):
        return f"The orbit falls into the layer r·M {sign} and stays in it."
    return f"The orbit falls into the layer r·M {sign}, and changes it later."


def _derived(result: LeakResult) -> list[str]:
    bridge, theta = result.bridge, result.map
    rows = [
        f"a = b′/a₁′ = {number(bridge.hess.a, 6)}",
        f"b = a₁′μ|r| = {number(bridge.hess.b, 6)}",
        f"In units b = 1: h = {number(theta.h, 6)}, f = {number(theta.f, 6)}",
        f"Period of n₃ = {number(result.period, 6)}",
        f"|trace| = {number(theta.trace, 6)}: {theta.kind}",
    ]
    if theta.fixed_points:
        rows.append(f"ln(multiplier) = ±{number(exponent(result), 6)}")
        rows.append(f"Rate = {number(exponent(result) / result.period, 6)} in a unit of time")
    for name, growth in zip((result.chosen.level, "reference"), result.growth, strict=True):
        if growth is not None and theta.kind == "hyperbolic":
            rows.append(f"Measured, {name}: {number(growth.per_period, 7)} a period")
    return [*rows, f"A rigid body? {'yes' if bridge.heavy.check.is_body else 'no'}"]


def _status(result: LeakResult) -> str:
    chosen, exact = result.chosen, result.exact
    drifts = " ".join(f"{name} {number(drift, 1)}" for name, drift in chosen.drift.items())
    return (f"{chosen.level}: orbit {chosen.times.size} points, {chosen.steps} Taylor steps, computed once"
            f" · drift {drifts} · exact motion error ≤ {number(exact.error_estimate, 2)} ({exact.status}) · "
            f"{result.ended}")


def _notes(result: LeakResult) -> list[str]:
    check = result.bridge.heavy.check
    notes = [] if check.is_body else [check.sentence]
    if result.exact.error_estimate > UNSURE:
        notes.append(BY_THE_UNSTABLE_CYCLE)
    return notes


SCENE = Scene(
    name="hess-leak",
    title="Leak off the Hess manifold",
    summary="An orbit on the Hess manifold of Euler–Poisson leaves it by round-off alone, at the rate of the cycle.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit_motion,
    limits=limits,
    pictures=("leak", "difference", "andoyer", "sphere"),
    compute=compute,
    stage=LeakStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=12,
)
