"""The bridge (S13): one motion of the Suslov–Hess case and of Euler–Poisson, translated, side by side."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.protocol.parameters import Choice, Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import suslov_hess
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.scenes.hess_leak import (
    BY_THE_UNSTABLE_CYCLE,
    FLOOR,
    MOMENTS,
    RIS,
    UNSURE,
    AndoyerGraph,
    admit_motion,
    bridge_of,
    logarithm,
    motion_of,
    top_of,
    torus_of,
)
from hess_explorer.scenes.hess_leak import limits as limits_of_heavy
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.circle_map import CircleMapView
from hess_explorer.views.graph import Graph
from hess_explorer.views.omega_plane import OmegaPlane
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.euler_poisson.andoyer import coordinates
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_manifold import on_manifold, run_free
from hess_mechanics.numerics.accuracy import REFERENCE
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov import equations as suslov
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.torus import MAX_RETURNS, Track, annulus, cycles, track

SUSLOV, HEAVY = "Suslov–Hess", "Euler–Poisson"
_IN_A_PERIOD = 40
_MOST_PERIODS = 200
_IN_A_DRAG = 30
"""Periods of the difference while a slider is held."""
_MOST_GROWTH = 3000.0
"""The strongest leak, as a logarithm, that is held back: it takes longer the larger |a| is."""
_COBWEB = 60
_BOTTOM = -1.0 + 1e-9

_OF_SUSLOV = {spec.name: spec for spec in suslov_hess.SPECS}
_SIDE = tuple(_OF_SUSLOV[name] for name in ("I22", "I23", "b3"))

SPECS = (
    Choice("given", "Given in", (SUSLOV, HEAVY), HEAVY,
           "Whose parameters and integrals the sliders mean; the other side is translated from them."),
    *_SIDE,
    *MOMENTS,
    Number("h", "h", "Energy h", 50.0, -9.0, 100.0, 0.05, -1e3, 1e5,
           "Of the side that is given: in units b = 1 for Suslov–Hess, H itself for Euler–Poisson."),
    Number("f", "f", "Area integral f", 5.0, -8.0, 8.0, 0.05, -1e3, 1e3,
           "Of the side that is given: in units b = 1 for Suslov–Hess, (M, γ) for Euler–Poisson."),
    _OF_SUSLOV["phi0"],
    Number("span", "t", "Time span", 50.0, 1.0, 200.0, 1.0, 0.01, 1e5,
           "How long the motion is followed, in the time that both sides share."),
    ACCURACY,
)

PRESETS = (
    Preset("Figure gess1, given in Euler–Poisson", {"given": HEAVY}),
    Preset("Two limit cycles, given in Suslov–Hess", {"given": SUSLOV, "h": 1.5, "f": 0.6}),
    Preset("No cycles, given in Suslov–Hess", {"given": SUSLOV, "h": 0.2, "f": 0.5}),
    Preset("f = 0: loxodromic pendulum", {"given": HEAVY, "h": 20.0, "f": 0.0}),
    Preset("f = 0: it swings", {"given": HEAVY, "h": 5.0, "f": 0.0}),
    Preset("Body of gess-ris2, f = 1", {"given": HEAVY, **RIS, "h": 2.0, "f": 1.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit; difference, held on r·M = 0</li>
<li><span class="line second"></span>difference, left to itself</li>
<li><span class="line stable"></span>stable cycle; Hess relation</li>
<li><span class="line unstable"></span>unstable cycle; ring: start</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="12" cy="12" rx="9" ry="7" fill="none" stroke="#0072B2" stroke-width="2"/>
<path d="M27 12C31 4 34 4 37 12S43 20 47 12" fill="none" stroke="#009E73" stroke-width="2"/>
<path d="M4 28C14 19 34 19 44 28M14 22.5V28M24 21V28M34 22.5V28M2 28H46" fill="none" stroke="#808080"
  stroke-width="1.5"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Difference:
    """At even times the distance of Euler–Poisson, held on the manifold and left to itself, from Suslov's motion.

    In units b = 1, both computed at reference; error : the estimate for Suslov's, in its own units.
    """

    times: Array
    held: Array
    free: Array
    error: float


@dataclass(frozen=True)
class BridgeResult:
    """What the pictures that are seen need; None what no picture asks for."""

    values: Values
    bridge: Bridge
    turning: TurningPoints
    map: CircleMap
    track: Track | None
    iterates: Array
    cycles: tuple[Track, Track] | None
    difference: Difference | None
    ended: str

    @property
    def period(self) -> float:
        """One period of n3, in the time of the bodies."""
        return self.map.period / self.bridge.hess.frequency_unit


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """What is possible together on the side that is given."""
    if values["given"] == HEAVY:
        return admit_motion(values)
    h = float(values["h"])
    if h >= _BOTTOM:
        return suslov_hess.admit(values)
    out, notes = suslov_hess.admit({**values, "h": _BOTTOM})
    return out, ["In units b = 1 the energy is above −1: h is there now.", *notes]


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The ranges of h and f on the side that is given."""
    if values["given"] == HEAVY:
        return limits_of_heavy(values)
    h = float(values["h"])
    return {"h": (-0.99, max(4.0, h), 0.01), **(suslov_hess.limits(values) if h > -1.0 else {})}


def _given(values: Values) -> tuple[Bridge, float, float, TurningPoints]:
    """Both bodies, and (h, f) in units b = 1.  Raises `ModelError`."""
    if values["given"] == HEAVY:
        bridge = bridge_of(values)
        return bridge, *torus_of(values, bridge)
    I22, I23, b3, h, f = (float(values[name]) for name in ("I22", "I23", "b3", "h", "f"))
    return Bridge.of_suslov(HessBody(I22, I23, b3)), h, f, turning_points(h, f)


def half_width(hess: HessBody, turning: TurningPoints) -> float:
    """The frame of the (ω1, ω2)-plane, a little wider than the ring."""
    return nice_above(1.1 * float(np.max(np.abs(annulus(hess, turning.h, turning)[1]))))


def _difference(bridge: Bridge, start: tuple[float, ...], end: float, count: int) -> Difference:
    """Along the motion from a state of `eq01` with b = 1, over a time `end` of the bodies."""
    hess = bridge.hess
    reduced = hess.from_units_of_b(np.array(start))
    times = np.linspace(0.0, end, count)
    orbit = solve(suslov.SYSTEM, hess.from_reduced(reduced), hess.suslov.parameters, times, REFERENCE)
    there = hess.in_units_of_b(hess.to_reduced(orbit.states))
    heavy = tuple(bridge.from_reduced(reduced).tolist())
    held, free = (bridge.distance(run(bridge.heavy, heavy, end, count, REFERENCE).states, there)
                  for run in (on_manifold, run_free))
    return Difference(frozen(times), frozen(held), frozen(free), orbit.error_estimate)


def compute(values: Values, shown: Collection[str], dragging: bool) -> BridgeResult:
    """What the pictures shown need, from admitted values; each part is cached by itself."""
    work = Work(values, dragging)
    bridge, h, f, turning = _given(values)
    hess = bridge.hess
    phi0, span = float(values["phi0"]), float(values["span"])
    width = half_width(hess, turning)
    theta = work.get(circle_map, hess.a, h, f, work.level)
    pair: tuple[Track, Track] | None = None
    if theta.kind == "hyperbolic" and "omega" in shown:
        pair = work.get(cycles, hess, h, f, theta.fixed_points[0], work.level, width)
    orbit: Track | None = work.get(track, hess, h, f, phi0, span, work.level, width) if shown else None
    difference: Difference | None = None
    if "difference" in shown:
        period = theta.period / hess.frequency_unit
        most = min(_IN_A_DRAG if dragging else _MOST_PERIODS, _MOST_GROWTH / (1.0 + 2.0 * math.pi * abs(hess.a)))
        end = min(span, most * period)
        count = max(64, math.ceil(end / period * _IN_A_PERIOD)) + 1
        start = turning.state_at_lower_turn(phi0)
        difference = work.get(_difference, bridge, tuple(start.tolist()), end, count)
    returns = max(1, math.ceil(span * hess.frequency_unit / theta.period))
    iterates = theta.iterate(phi0, min(returns, MAX_RETURNS))
    return BridgeResult(values=values, bridge=bridge, turning=turning, map=theta, track=orbit, iterates=iterates,
                        cycles=pair, difference=difference, ended=work.ended())


def motion(values: Values) -> Motion:
    """The motion that both sides share, reduced.  Raises `ModelError`."""
    bridge, h, _, turning = _given(values)
    length = min(float(values["span"]) * bridge.hess.frequency_unit, MAX_RETURNS * turning.period)
    return motion_of(bridge.hess, turning.state_at_lower_turn(float(values["phi0"])), h, length)


class BridgeStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "omega-point": ("omega1", "omega2"), "circle-point": ("phi_start", "phi"), "andoyer-point": ("l", "x"),
        "difference-point": ("t", "apart"),
    }
    angles: Sequence[str] = ("phi", "phi_start", "l")

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.omega = OmegaPlane(wire)
        self.circle = CircleMapView(wire)
        self.andoyer = AndoyerGraph(wire)
        self.difference = Graph(wire, "difference", ("t", "lg |difference|"), (0.0, 50.0), (FLOOR, 1.5),
                                [Series("free", theme.MAP, "dotdash"), Series("held", theme.ORBIT)])
        self.pictures = (self.omega, self.circle, self.andoyer, self.difference)

    def show(self, result: BridgeResult, hold_axes: bool) -> Report:
        """Draw the motion on both sides."""
        width = half_width(result.bridge.hess, result.turning)
        end = float(result.values["span"]) if result.difference is None else float(result.difference.times[-1])
        if not hold_axes:
            self.omega.fit(width)
            self.difference.set_ranges((0.0, end), (FLOOR, top_of(result.map.h)))
        for plane in (self.omega, self.circle, self.andoyer, self.difference):
            plane.say("")
        inner, outer = annulus(result.bridge.hess, result.map.h, result.turning)
        self.omega.show_region(inner, outer, width)
        self.omega.show_cycles(result.cycles)
        self.circle.show(result.map, result.iterates[: _COBWEB + 1])
        if result.difference is not None:
            self.difference.show("held", result.difference.times, logarithm(result.difference.held))
            self.difference.show("free", result.difference.times, logarithm(result.difference.free))
        if result.track is not None:
            self._show_motion(result, result.track)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def _show_motion(self, result: BridgeResult, one: Track) -> None:
        points = coordinates(result.bridge.from_suslov(np.hstack([one.omega, one.gamma])))
        self.andoyer.show_motion(result.bridge.heavy, points)
        index = np.floor(one.orbit.times / result.map.period).astype(int)
        apart = np.full(one.times.size, FLOOR)
        if result.difference is not None:
            apart = np.interp(one.times, result.difference.times, logarithm(result.difference.held))
        columns = {"phi": one.phi, "phi_start": result.iterates[np.minimum(index, len(result.iterates) - 1)],
                   "l": points[:, 0], "x": points[:, 1], "apart": apart}
        self.omega.show_orbit(one, **{name: column.astype(np.float32) for name, column in columns.items()})

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the circle map chooses φ0."""
        return {"phi0": x} if picture == "circle" else {}


def _captions(result: BridgeResult) -> tuple[str, str, str, str]:
    theta, turning = result.map, result.turning
    H, F1 = result.bridge.from_units_of_b(theta.h, theta.f)
    high = math.sqrt(2.0 * max(0.0, theta.h + turning.roots[2]))
    if theta.kind == "hyperbolic":
        stable, unstable = theta.fixed_points
        zone = f"Two cycles, multipliers {number(stable.multiplier)}, {number(unstable.multiplier)}"
    elif theta.kind == "parabolic":
        zone = "The two cycles have merged, multiplier 1"
    else:
        zone = f"No cycle, ρ = {number(theta.rotation_number)}"
    return (
        f"Suslov–Hess: the torus, (ω₁, ω₂)\nh = {number(theta.h, 6)}, f = {number(theta.f, 6)} in units b = 1; |w| "
        f"from {number(turning.initial_rho)} to {number(high)}.",
        f"Circle map of both\n{zone}; |trace| {number(theta.trace, 5)}.",
        f"Euler–Poisson: (l, L/G)\nH = {number(H, 6)}, F₁ = {number(F1, 6)}: it keeps to the Hess relation.",
        f"Difference along the orbit\n{_apart(result.difference)}",
    )


def _apart(difference: Difference | None) -> str:
    if difference is None:
        return "Not computed while it is out of sight."
    held, free = (number(float(one.max()), 2) for one in (difference.held, difference.free))
    return f"At most {held} up to t = {number(float(difference.times[-1]))}, held on r·M = 0; left to itself {free}."


def _derived(result: BridgeResult) -> list[str]:
    hess, heavy, theta = result.bridge.hess, result.bridge.heavy, result.map
    H, F1 = result.bridge.from_units_of_b(theta.h, theta.f)
    moments = ", ".join(number(1.0 / a, 5) for a in heavy.a)
    return [
        f"Suslov: I₁₁ = {number(hess.I11, 5)}, I₂₂ = {number(hess.I22, 5)}, I₂₃ = {number(hess.I23, 5)}",
        f"b₂ = {number(hess.b2, 5)}, b₃ = {number(hess.b3, 5)}",
        f"Euler–Poisson: I = ({moments}), μ|r| = {number(math.copysign(heavy.strength, heavy.mu), 5)}",
        f"r/|r| = ({number(heavy.r[0], 5)}, 0, {number(heavy.r[2], 5)})",
        f"a = I₂₃/I₂₂ = b′/a₁′ = {number(hess.a, 6)}",
        f"b = a₁′μ|r| = {number(hess.b, 6)}",
        f"E = H = {number(H, 6)}",
        f"−F₂ = F₁ = {number(F1, 6)}",
        f"In units b = 1: h = {number(theta.h, 6)}, f = {number(theta.f, 6)}",
        f"Period of n₃ = {number(result.period, 6)}, the same on both sides",
        f"Frequencies {number(2.0 * math.pi / result.period, 6)}, "
        f"{number(2.0 * math.pi * theta.rotation_number / result.period, 6)}",
        f"Rigid bodies? Suslov: {_yes(hess.check.is_body)}; Euler–Poisson: {_yes(heavy.check.is_body)}",
    ]


def _yes(is_body: bool) -> str:
    return "yes" if is_body else "no"


def _status(result: BridgeResult) -> str:
    parts = [] if result.track is None else [part.replace("e-", "e−") for part in orbit_status(result.track.orbit)]
    if result.difference is not None:
        parts.append(f"difference at reference, error of the Suslov side ≤ {number(result.difference.error, 2)}")
    return " · ".join([*parts, result.ended])


def _notes(result: BridgeResult) -> list[str]:
    notes = []
    if not result.bridge.hess.check.is_body:
        notes.append(result.bridge.hess.check.sentence)
    shown = math.inf if result.track is None else float(result.track.times[-1])
    if shown < float(result.values["span"]) * (1.0 - 1e-9):
        notes.append(f"The orbit is drawn up to t = {number(shown)}: {MAX_RETURNS} returns.")
    if result.difference is not None and result.difference.error > UNSURE:
        notes.append(BY_THE_UNSTABLE_CYCLE)
    return notes


SCENE = Scene(
    name="bridge",
    title="Bridge: Suslov and Euler–Poisson",
    summary="The Suslov–Hess case and the Hess case of Euler–Poisson are one system: two orbits and their difference.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("omega", "circle", "andoyer", "difference"),
    compute=compute,
    stage=BridgeStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=13,
)
