"""The Suslov–Hess case (S8): torus, Poisson sphere, bifurcation diagram, circle map."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.views.bifurcation_diagram import BifurcationDiagram, window
from hess_explorer.views.body import BodyView, Curve, Rod, Shape
from hess_explorer.views.circle_map import CircleMapView
from hess_explorer.views.omega_plane import OmegaPlane
from hess_explorer.views.poisson_sphere import Circle, PoissonSphere
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.errors import Separatrix
from hess_mechanics.numerics.accuracy import DRAFT, STANDARD, Level
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Attitude
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody
from hess_mechanics.suslov_hess.mode_locking import lock_boundary, rotation_number_grid
from hess_mechanics.suslov_hess.torus import (
    MAX_RETURNS,
    Track,
    annulus,
    attitude_of_track,
    cycles,
    pixels_per_unit,
    start_of_track,
    track,
)

GRID = (100, 75)
MAX_A = 100.0
_COBWEB = 60

SPECS = (
    Number("I22", "I₂₂", "Inertia I₂₂", 0.96, 0.2, 3.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis. I₁₁ follows from it and I₂₃."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.28, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia. a = I₂₃/I₂₂ tilts the circular section; a = 0 decouples the motion."),
    Number("b3", "b₃", "Centre of mass b₃", -1.0, -3.0, -0.05, 0.01, -1e3, -1e-3,
           "Third component of b = −mg r. It sets the unit of time; b₂ follows from it."),
    Number("h", "h", "Energy h", 1.5, -0.99, 4.0, 0.01, -1.0 + 1e-9, 1e6,
           "Energy integral in units b = 1: h > −1; the separatrix is at h = 1, f = 0."),
    Number("f", "f", "Area integral f", 0.6, -3.0, 3.0, 0.01, -1e4, 1e4,
           "Area integral in units b = 1. Its range follows h."),
    Number("phi0", "φ₀", "Phase φ₀", 0.5, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Phase of the orbit on the section n₃ = n₃⁽¹⁾, in radians."),
    Number("span", "t", "Time span", 40.0, 1.0, 200.0, 1.0, 0.01, 1e5,
           "How long the orbit is followed, in the time of the body (at most 100 returns)."),
    ACCURACY,
)

PRESETS = (
    Preset("Two limit cycles", {}),
    Preset("No cycle: every orbit winds", {"h": 0.2, "f": 0.5}),
    Preset("At the lock boundary (a = 0.5)", {"I22": 1.0, "I23": 0.5, "h": 0.5, "f": 1.01563456028796105}),
    Preset("Pendulum, f = 0: multiplier e^(2πa)", {"h": 1.5, "f": 0.0, "I22": 1.0, "I23": 0.3}),
    Preset("Oscillation, f → 0: Θ∘Θ = id", {"h": 0.3, "f": 1e-8}),
    Preset("Separatrix: no return", {"h": 1.0, "f": 0.0}),
    Preset("On the bifurcation curve", dict(zip("hf", curve_point(0.5), strict=True))),
    Preset("Strong contraction, a = 3 (not a body)", {"I22": 0.5, "I23": 1.5}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit</li>
<li><span class="line stable"></span>stable cycle</li>
<li><span class="line unstable"></span>unstable cycle</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
<li><span class="box locked"></span>locked</li>
<li><span class="box rho"></span>ρ from −½ to ½</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="24" cy="16" rx="21" ry="14" fill="none" stroke="#808080"/>
<ellipse cx="24" cy="16" rx="7" ry="4.5" fill="none" stroke="#808080"/>
<ellipse cx="22" cy="15" rx="12" ry="9" fill="none" stroke="#009E73" stroke-width="2"/>
<ellipse cx="27" cy="17" rx="14" ry="10" fill="none" stroke="#D55E00" stroke-width="2" stroke-dasharray="3 2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Zones:
    """What the bifurcation diagram shows for all (h, f)."""

    boundary: Array
    curve: Array
    grid: Array


@dataclass(frozen=True)
class HessResult:
    """What the pictures that are seen need.

    `turning`, `map` are None on the separatrix; `track`, `cycles`, `zones`, `attitude` where no picture asks for them,
    and `attitude` where this is no rigid body.
    """

    values: Values
    body: HessBody
    turning: TurningPoints | None
    track: Track | None
    map: CircleMap | None
    iterates: Array | None
    cycles: tuple[Track, Track] | None
    zones: Zones | None
    attitude: Attitude | None
    ended: str


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """|a| ≤ 100, and f inside the region of this h."""
    out, notes = dict(values), []
    bound = MAX_A * float(out["I22"])
    if abs(float(out["I23"])) > bound:
        out["I23"] = math.copysign(bound, float(out["I23"]))
        notes.append(f"a = I₂₃/I₂₂ is kept within ±{MAX_A:g}: I₂₃ is {number(out['I23'])} now.")
    largest = f_max(float(out["h"]))
    if abs(float(out["f"])) > largest:
        out["f"] = math.copysign(largest, float(out["f"]))
        where = f"At h = {number(float(out['h']))} only |f| ≤ {number(largest)} is possible"
        notes.append(f"{where}: f is at that edge now.")
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The slider of f spans the region at this h, in round steps."""
    largest = f_max(float(values["h"]))
    digits = 2 - math.floor(math.log10(largest))
    step = float(f"1e{-digits}")
    end = round(math.floor(largest / step) * step, digits)
    return {"f": (-end, end, step)}


def _grid(a: float, x: tuple[float, float], y: tuple[float, float], accuracy: Level) -> Array:
    """ρ at the centres of the cells of the window; fewer cells where a makes each one dear."""
    share = min(1.0, math.sqrt(10.0 / max(abs(a), 1e-9)))
    m, n = (max(8, round(size * share)) for size in GRID)
    h = x[0] + (np.arange(m) + 0.5) * (x[1] - x[0]) / m
    f = y[0] + (np.arange(n) + 0.5) * (y[1] - y[0]) / n
    return rotation_number_grid(a, np.maximum(h, -1.0 + 1e-6), f, accuracy)


def compute(values: Values, shown: Collection[str], dragging: bool) -> HessResult:
    """What the pictures shown need, from admitted values; each part is cached by itself."""
    work = Work(values, dragging)
    accuracy = work.level
    I22, I23, b3, h, f, phi0, span = (float(values[spec.name]) for spec in SPECS[:-1])
    body = HessBody(I22, I23, b3)
    width = half_width(body, h)
    turning: TurningPoints | None = None
    theta: CircleMap | None = None
    pair: tuple[Track, Track] | None = None
    orbit: Track | None = None
    iterates: Array | None = None
    zones: Zones | None = None
    attitude: Attitude | None = None
    try:
        turning = turning_points(h, f)
        theta = work.get(circle_map, body.a, h, f, accuracy)
        if theta.kind == "hyperbolic" and not {"omega", "sphere"}.isdisjoint(shown):
            pair = work.get(cycles, body, h, f, theta.fixed_points[0], accuracy, width)
    except Separatrix:
        pass
    if shown:
        orbit = work.get(track, body, h, f, phi0, span, accuracy, width)
        if theta is not None:
            returns = math.ceil(orbit.orbit.times[-1] / theta.period)
            iterates = theta.iterate(phi0, max(1, returns))
    if "bifurcation" in shown:
        x, y = window(h)
        zones = Zones(boundary=work.get(lock_boundary, body.a, STANDARD), curve=work.get(curve, x[1]),
                      grid=work.get(_grid, body.a, x, y, DRAFT))
    if "body" in shown and body.check.is_body:
        attitude = work.get(attitude_of_track, body, h, f, phi0, span, accuracy)
    return HessResult(
        values=values, body=body, turning=turning, track=orbit, map=theta, iterates=iterates, cycles=pair,
        zones=zones, attitude=attitude, ended=work.ended(),
    )


def motion(values: Values) -> Motion:
    """The orbit on show, in units b = 1.  Raises `ModelError`."""
    I22, I23, b3, h, f, phi0, span = (float(values[spec.name]) for spec in SPECS[:-1])
    body = HessBody(I22, I23, b3)
    state, length = start_of_track(body, h, f, phi0, span)
    weights = pixels_per_unit(body, half_width(body, h))
    return Motion(SYSTEM, tuple(state), (body.a, 1.0), length, tuple(weights), 1.0 / body.frequency_unit)


def half_width(body: HessBody, h: float) -> float:
    """The frame of the (ω1, ω2)-plane: room for every h of the slider, so that it can stay."""
    largest = math.sqrt(2.0 * (window(h)[0][1] + 1.0))
    return nice_above(1.02 * body.frequency_unit * math.hypot(1.0, body.a) * largest)


class HessStage:
    """The five pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "omega-point": ("omega1", "omega2"),
        "bifurcation-point": ("h", "reach"),
        "circle-point": ("phi_start", "phi"),
    }
    angles: Sequence[str] = ("phi", "phi_start")

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.omega = OmegaPlane(wire)
        self.sphere = PoissonSphere(wire, {f"data-{name}": name for name in ("orbit", "stable", "unstable")})
        self.diagram = BifurcationDiagram(wire)
        self.circle = CircleMapView(wire)
        self._drawn: dict[str, Any] = {}
        self._a = 0.0
        self.body = BodyView(wire, "body", "The body in space", bare=True)
        self.pictures = (self.omega, self.sphere, self.diagram, self.circle, self.body)

    def _once(self, name: str, *things: Any) -> bool:
        """Whether something else than last time is to be drawn under this name."""
        before = self._drawn.get(name)
        self._drawn[name] = things
        return before is None or any(
            # Results are compared by identity: the cache returns the same one for the same question.
            new is not old and (not isinstance(new, float | tuple) or new != old)
            for new, old in zip(things, before, strict=True)
        )

    def show(self, result: HessResult, hold_axes: bool) -> Report:
        """Draw everything that has changed."""
        h, f = float(result.values["h"]), float(result.values["f"])
        width = half_width(result.body, h)
        self._a = result.body.a
        x, y = window(h)
        for plane in (self.omega, self.diagram):
            plane.say("")
        if result.track is not None:
            self._show_motion(result, result.track, h, f)
        inner, outer = annulus(result.body, h, result.turning)
        self.omega.show_region(inner, outer, width)
        if not hold_axes:
            self.omega.fit(width)
            self.diagram.set_ranges(x, y)
        if result.zones is not None:
            self._show_zones(result.zones, x, y)
        if self._once("here", h, f):
            self.diagram.show_here(h, f)
        if result.map is None:
            self._drawn.pop("map", None)
            self.circle.show_nothing("Separatrix: no return")
        elif result.iterates is not None and self._once("map", result.map, result.track):
            self.circle.show(result.map, result.iterates[: _COBWEB + 1])
        if result.attitude is not None:
            self._show_body(result.body, result.attitude)
        elif not result.body.check.is_body and self._once("body", None):
            self.body.show_nothing()
        self._say(_captions(result))
        return Report(_derived(result), _status(result), _notes(result))

    def _say(self, captions: Sequence[str]) -> None:
        for picture, text in zip(self.pictures, captions, strict=True):
            self.wire.say(picture.name, text)

    def _show_zones(self, zones: Zones, x: tuple[float, float], y: tuple[float, float]) -> None:
        if self._once("curve", zones.curve):
            self.diagram.show_region(zones.curve, x, y)
        if self._once("grid", zones.grid):
            self.diagram.show_rotation(zones.grid, x, y)
        if self._once("boundary", zones.boundary, x):
            self.diagram.show_lock(zones.boundary, x, y)

    def _show_motion(self, result: HessResult, track_: Track, h: float, f: float) -> None:
        if self._once("track", track_, result.map):
            n3 = track_.n3
            reach = math.copysign(1.0, f) * np.sqrt(np.maximum(0.0, 2.0 * (h + n3) * (1.0 - n3 * n3)))
            phi_start = track_.phi
            if result.map is not None and result.iterates is not None:
                index = np.floor(track_.orbit.times / result.map.period).astype(int)
                phi_start = result.iterates[np.minimum(index, len(result.iterates) - 1)]
            self.omega.show_orbit(
                track_, phi=track_.phi.astype(np.float32), phi_start=phi_start.astype(np.float32),
                h=np.full(n3.size, h, np.float32), reach=reach.astype(np.float32),
            )
        if self._once("cycles", *(result.cycles or (None, None))):
            self.omega.show_cycles(result.cycles)
        body, sign = result.body, math.copysign(1.0, result.body.b)
        r = math.hypot(1.0, body.a)
        heights = (-1.0, 1.0) if result.turning is None else result.turning.roots[1:]
        n3 = (0.0, -sign * body.a / r, sign / r)
        self.sphere.show(n3, "n₃", [Circle(n3, x, "limit") for x in heights if abs(x) < 1 - 1e-9])

    def _show_body(self, body: HessBody, attitude: Attitude) -> None:
        if self._once("body", attitude):
            centre = (0.0, 0.0, 1.0)
            rods = [Rod(body.turn[:, 2], "muted", "3"), Rod(centre, "mass")]
            self.body.show(Shape.of_tensor(body.tensor(_middle_I33(body)), centre), attitude,
                           attitude.times / body.frequency_unit, rods, [Curve(attitude.in_space(centre), "orbit")])

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        self._drawn.clear()
        refuse(self.pictures, self.wire, sentence)

    def hover(self, picture: str, x: float, y: float) -> str:
        """What the torus (h, f) under the mouse does."""
        if picture != "bifurcation":
            return ""
        if x <= -1.0 or abs(y) > f_max(x):
            return f"h = {number(x)}, f = {number(y)}: impossible"
        theta = circle_map(self._a, x, y, DRAFT)
        text = (f"h = {number(x)}, f = {number(y)}: ρ = {number(theta.rotation_number)}, "
                f"|trace| = {number(theta.trace)}")
        multipliers = ", ".join(number(point.multiplier) for point in theta.fixed_points)
        return f"{text}, multipliers {multipliers}" if multipliers else f"{text}, no cycle"

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the diagram chooses (h, f), in the circle map φ0."""
        if picture == "bifurcation":
            return {"h": x, "f": y}
        if picture == "circle":
            return {"phi0": x}
        return {}


def _middle_I33(body: HessBody) -> float:
    """I33 is no parameter of the problem: here the middle of those of a rigid body, which this must be."""
    assert body.check.I33 is not None
    return 0.5 * sum(body.check.I33)


def _caption_of_body(body: HessBody) -> str:
    title = "The body in space\n"
    if not body.check.is_body:
        return f"{title}Nothing is drawn: with |a| ≥ 1 there is no such rigid body, whatever I₃₃."
    moments = np.linalg.eigvalsh(body.tensor(_middle_I33(body)))
    return (f"{title}Gyration ellipsoid for I₃₃ = {number(_middle_I33(body))}, which is free: moments "
            f"{', '.join(map(number, moments))}.")


def _captions(result: HessResult) -> tuple[str, str, str, str, str]:
    h, f = float(result.values["h"]), float(result.values["f"])
    theta, turning = result.map, result.turning
    where = f"h = {number(h)}, f = {number(f)}"
    if theta is None or turning is None:
        return (
            "Angular velocity (ω₁, ω₂)\nThe orbit needs infinite time to come to rest.",
            "Poisson sphere\nTowards the upper equilibrium, n₃ = −1.",
            f"Bifurcation diagram\n{where}: the separatrix.",
            "Circle map\nSeparatrix: no return.",
            _caption_of_body(result.body),
        )
    n1, n2 = turning.roots[1:]
    low, high = turning.initial_rho, math.sqrt(2 * max(0.0, h + n2))
    rho = number(theta.rotation_number)
    trace = number(theta.trace, 5)
    if theta.kind == "hyperbolic":
        orbit = "The orbit tends to the stable limit cycle"
        zone = "locked, two limit cycles"
        stable, unstable = theta.fixed_points
        multipliers = f"{number(stable.multiplier)}, {number(unstable.multiplier)}"
        last = f"hyperbolic, |trace| {trace}, ρ = {rho}; multipliers {multipliers}"
    elif theta.kind == "parabolic":
        orbit = "The two limit cycles have merged"
        zone = "on the lock boundary"
        last = f"parabolic, |trace| {trace}, ρ = {rho}; multiplier 1"
    else:
        orbit = "The orbit winds round the torus, no limit cycle"
        zone = f"not locked, ρ = {rho}"
        last = f"elliptic, |trace| {trace}, ρ = {rho}; no fixed point"
    if n2 - n1 < 1e-6:
        orbit = "On the bifurcation curve the torus is a circle"
    return (
        f"Angular velocity (ω₁, ω₂)\n{orbit}; |w| from {number(low)} to {number(high)}.",
        f"Poisson sphere\nThe vertical γ, between heights n₃ = {number(n1)} and {number(n2)}.",
        f"Bifurcation diagram\n{where}: {zone}.",
        f"Circle map\n{last}.",
        _caption_of_body(result.body),
    )


def _derived(result: HessResult) -> list[str]:
    body = result.body
    check = body.check
    h, f = float(result.values["h"]), float(result.values["f"])
    rows = [
        f"a = I₂₃/I₂₂ = {number(body.a, 6)}",
        f"b = {number(body.b, 6)}",
        f"I₁₁ = {number(body.I11, 6)}",
        f"b₂ = {number(body.b2, 6)}",
        f"E = I₁₁ b h = {number(body.I11 * body.b * h, 6)}",
        f"F₂ = I₁₁ √b f = {number(body.I11 * body.frequency_unit * f, 6)}",
        f"A rigid body? {'yes' if check.is_body else 'no: |a| ≥ 1'}",
    ]
    if check.I33 is not None:
        rows.append(f"I₃₃ from {number(check.I33[0])} to {number(check.I33[1])}")
    if result.map is not None:
        rows.append(f"Period of n₃ = {number(result.map.period / body.frequency_unit, 6)}")
    return rows


def _status(result: HessResult) -> str:
    parts = []
    if result.track is not None:
        parts += orbit_status(result.track.orbit)
    if result.map is not None:
        theta = result.map
        parts.append(f"circle map {theta.cost.steps} steps, error ≤ {theta.error_estimate:.1e} ({theta.status})")
    else:
        parts.append("circle map: separatrix, no return")
    if result.attitude is not None:
        lying = result.attitude.orbit
        parts.append(f"body {lying.cost.steps} steps, error ≤ {lying.error_estimate:.1e} ({lying.status})")
    parts.append(result.ended)
    return " · ".join(parts).replace("e-", "e−")


def _notes(result: HessResult) -> list[str]:
    notes = []
    check = result.body.check
    if not check.is_body:
        notes.append(check.sentence)
    shown = math.inf if result.track is None else float(result.track.times[-1])
    if shown < float(result.values["span"]) * (1 - 1e-9):
        reason = "after that it is at rest to the eye" if result.map is None else f"{MAX_RETURNS} returns"
        notes.append(f"The orbit is shown up to t = {number(shown)}: {reason}.")
    if float(result.values["f"]) == 0.0 and result.map is not None and float(result.values["h"]) < 1.0:
        notes.append("At f = 0, h < 1 the angle φ jumps where w = 0: the circle map is its limit f → 0.")
    return notes


SCENE = Scene(
    name="suslov-hess",
    title="The Suslov–Hess case",
    summary="A heavy rigid body with ω₃ = 0 whose motions live on tori: rotation, locking, limit cycles.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("omega", "sphere", "bifurcation", "circle", "body"),
    compute=compute,
    stage=HessStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    folded={"body": "Show the body in space"},
    place=1,
)
