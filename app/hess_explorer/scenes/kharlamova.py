"""e on a principal axis, b3 = 0 (S6, Kharlamova's case; S5): parabolas in an ellipse, and what the equator does."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.plane_domain import PlaneDomain, plane_columns
from hess_explorer.views.poisson_sphere import Circle, Mark, PoissonSphere
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.kharlamova import (
    Arc,
    PlaneBody,
    arc,
    fixed_point_kinds,
    mirrored,
    periods,
    rescaled_time,
    state_at,
    to_plane,
)
from hess_mechanics.suslov.principal_axis import divergence

_MOST = 6000
_DIRECTIONS = np.linspace(-math.pi, math.pi, 721)
_LEVELS = (-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75)
"""Equipotentials, in units of the potential's largest value."""

SPECS = (
    Number("I11", "I₁₁", "Inertia I₁₁", 1.5, 0.2, 5.0, 0.01, 1e-2, 1e2, "Moment of inertia about the first body axis."),
    Number("I22", "I₂₂", "Inertia I₂₂", 1.0, 0.2, 5.0, 0.01, 1e-2, 1e2,
           "Moment of inertia about the second body axis."),
    Number("b1", "b₁", "Centre of mass b₁", 0.4, -2.0, 2.0, 0.01, -1e2, 1e2, "b = −mg r, r the mass centre; b₃ = 0."),
    Number("b2", "b₂", "Centre of mass b₂", 0.7, -2.0, 2.0, 0.01, -1e2, 1e2, "b = −mg r; b₁ = b₂ = 0: straight lines."),
    Number("q1", "q₁", "Start q₁ = √I₁₁ γ₂", 0.3, -1.22, 1.22, 0.01, -10.0, 10.0,
           "A click in the plane chooses the start, on the half γ₃ ≥ 0 of the sphere."),
    Number("q2", "q₂", "Start q₂ = −√I₂₂ γ₁", -0.2, -1.0, 1.0, 0.01, -10.0, 10.0,
           "A click in the plane chooses the start."),
    Number("p", "|p|", "Start |p|", 1.0, 0.0, 4.0, 0.01, 0.0, 1e3, "p = (√I₁₁ ω₁, √I₂₂ ω₂), at the start."),
    Number("alpha", "α", "Start: direction α", 0.5, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "p = |p| (cos α, sin α): where the point runs at first. A click in the graph of T chooses it."),
    Number("span", "t", "Time span", 20.0, 1.0, 100.0, 1.0, 0.01, 1e4, "How long the orbit is followed."),
    ACCURACY,
)

_ROUND = {"I11": 1.0, "I22": 1.0, "b1": 1.0, "b2": 0.0}
PRESETS = (
    Preset("Periodic: a parabola's arc, to and fro", {}),
    Preset("Periodic: a straight line, b = 0", {"b1": 0.0, "b2": 0.0}),
    Preset("Periodic: from rest, along the force", {"p": 0.0}),
    Preset("Periodic: two orbits on one parabola", {**_ROUND, "q1": 0.5, "q2": -0.55, "p": 1.12, "alpha": 1.107}),
    Preset("Fixed point on the equator, unstable", {
        **_ROUND, "q1": 0.0, "q2": -1.0, "p": 0.5, "alpha": 0.0}),
    Preset("Fixed point, stable by its spin", {**_ROUND, "q1": 0.0, "q2": -1.0, "p": 1.5, "alpha": 0.0}),
    # (γ1, γ2) = (1 − τ²/2, τ/2) touches the circle at τ = 0; the start is at τ = 1.
    Preset("Asymptotic: touches the equator from inside", {
        **_ROUND, "q1": 0.5, "q2": -0.5, "p": math.sqrt(1.25), "alpha": math.atan2(1.0, 0.5), "span": 15.0}),
    Preset("Next to it: a long period", {
        **_ROUND, "q1": 0.5, "q2": -0.5, "p": math.sqrt(1.25), "alpha": 1.1072, "span": 40.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="dot" style="background: #CC79A7"></span>its mirror image, t → −t</li>
<li><span class="line stable"></span>stable fixed points</li>
<li><span class="line unstable"></span>unstable fixed points</li>
<li><span class="line muted"></span>equipotentials</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="24" cy="16" rx="21" ry="13" fill="none" stroke="#009E73" stroke-width="2"/>
<path d="M6 23 Q26 -14 42 23" fill="none" stroke="#0072B2" stroke-width="2.5"/>
<circle cx="24" cy="5.5" r="3" fill="#F0E442" stroke="#000000"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class ArcResult:
    """h is the energy; `closed`: the orbit at t = T, of a periodic one; `T`: the period over `_DIRECTIONS`.

    tau : (m,) along the orbit; mirror : (m, 5) the mirror image of the orbit at −t.
    boundary : see `fixed_point_kinds`.
    """

    values: Values
    body: PlaneBody
    start: tuple[float, ...]
    h: float
    arc: Arc
    orbit: Orbit | None
    tau: Array
    mirror: Array
    closed: Orbit | None
    T: Array
    boundary: tuple[Array, Array]
    ended: str

    @property
    def missed(self) -> float:
        """How far from its start the periodic orbit is at t = T."""
        return 0.0 if self.closed is None else float(np.abs(self.closed.states[0] - np.array(self.start)).max())


def body_of(values: Values) -> PlaneBody:
    """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
    return PlaneBody(*(float(values[name]) for name in ("I11", "I22", "b1", "b2")))


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """A start outside the domain moves to its edge."""
    out, notes = dict(values), []
    r1, r2 = body_of(values).axes
    size = math.hypot(float(out["q1"]) / r1, float(out["q2"]) / r2)
    if size > 1.0 + 1e-13:
        out["q1"], out["q2"] = float(out["q1"]) / size, float(out["q2"]) / size
        notes.append(f"The start was outside the ellipse: it is on its edge now, q = ({number(float(out['q1']))}, "
                     f"{number(float(out['q2']))}).")
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The sliders of q span the ellipse, in round steps."""
    ranges = {}
    for name, axis in zip(("q1", "q2"), body_of(values).axes, strict=True):
        digits = 2 - math.floor(math.log10(axis))
        step = float(f"1e{-digits}")
        end = round(math.floor(axis / step) * step, digits)
        ranges[name] = (-end, end, step)
    return ranges


def _start(values: Values) -> tuple[PlaneBody, tuple[float, float], tuple[float, ...]]:
    body = body_of(values)
    q = (float(values["q1"]), float(values["q2"]))
    speed, alpha = float(values["p"]), float(values["alpha"])
    return body, q, state_at(body, q, (speed * math.cos(alpha), speed * math.sin(alpha)))


def _energy(body: PlaneBody, start: tuple[float, ...]) -> float:
    return float(SYSTEM.integrals(start, body.parameters)["E"])


def _weights(body: PlaneBody, h: float) -> tuple[float, ...]:
    """Pixels for a unit of each variable, ω as large as it can be filling half a picture."""
    radius = 0.5 * PIXELS
    largest = 2.0 * max(h + math.hypot(body.b1, body.b2), 1e-300)
    return (radius * math.sqrt(body.I11 / largest), radius * math.sqrt(body.I22 / largest), radius, radius, radius)


def _orbit(body: PlaneBody, start: tuple[float, ...], span: float, accuracy: Level) -> tuple[Orbit, Array]:
    """The orbit, and the mirror image of its past (m, 5)."""
    weights = np.array(_weights(body, _energy(body, start)))
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, weights, SAGITTA, _MOST)
    past = solve(SYSTEM, start, body.parameters, -times, accuracy)
    return solve(SYSTEM, start, body.parameters, times, accuracy), frozen(mirrored(past.states))


def _closed(body: PlaneBody, start: tuple[float, ...], period: float, accuracy: Level) -> Orbit:
    return solve(SYSTEM, start, body.parameters, [period], accuracy)


def _periods(body: PlaneBody, q: tuple[float, float], speed: float) -> Array:
    return frozen(periods(body, q, speed, _DIRECTIONS))


def compute(values: Values, shown: Collection[str], dragging: bool) -> ArcResult:
    """The orbit with its arc, the period for all directions."""
    work = Work(values, dragging)
    body, q, start = _start(values)
    h = _energy(body, start)
    found = work.get(arc, body, start)
    orbit, mirror = work.get(_orbit, body, start, float(values["span"]), work.level)
    tau = rescaled_time(found, orbit.states)
    closed = work.get(_closed, body, start, found.period, work.level) if found.kind == "periodic" else None
    T = work.get(_periods, body, q, float(values["p"])) if "period" in shown else np.empty(0)
    return ArcResult(values, body, start, h, found, orbit, tau, mirror, closed, T,
                     work.get(fixed_point_kinds, body, h), work.ended())


def motion(values: Values) -> Motion:
    """The orbit on show, for "Speed and accuracy".  Raises `ModelError`."""
    body, _, start = _start(values)
    return Motion(SYSTEM, start, body.parameters, float(values["span"]), _weights(body, _energy(body, start)), 1.0)


class ArcStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "domain-point": ("q1", "q2"), "domain-mirror": ("mirror_q1", "mirror_q2"),
        "curve-point": ("tau", "g3"), "curve-mirror": ("mirror_tau", "mirror_g3"),
    }
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.domain = PlaneDomain(wire)
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.curve = Graph(wire, "curve", ("τ", "γ₃"), (-2.0, 2.0), (-1.1, 1.1),
                           [Series("other", theme.MUTED, "dashed"), Series("own", theme.ORBIT)])
        self.curve.add("mirror", "scatter", ("x", "y"), color=theme.MAP, line_color="black", line_width=1.5, size=11)
        self.period = Graph(wire, "period", ("α", "T"), (-math.pi, math.pi), (0.0, 20.0),
                            [Series("T", theme.ORBIT)], picks=("tap", "doubletap", "pan"))
        self.pictures = (self.domain, self.sphere, self.curve, self.period)

    def show(self, result: ArcResult, hold_axes: bool) -> Report:
        """Draw the arc in the domain, on the sphere, over τ; the periods."""
        for view in (self.domain, self.curve, self.period):
            view.say("")
        self._show_domain(result, hold_axes)
        self._show_curve(result, hold_axes)
        self._show_periods(result, hold_axes)
        if result.orbit is not None:
            q, _ = to_plane(result.body, result.orbit.states)
            mirror_q, _ = to_plane(result.body, result.mirror)
            extra = np.column_stack([mirror_q, result.tau, rescaled_time(result.arc, result.mirror),
                                     result.mirror[:, 4]]).astype(np.float32)
            self.domain.assign("orbit", t=result.orbit.times.astype(np.float32),
                               **plane_columns(q, result.orbit.states[:, 2:]), mirror_q1=extra[:, 0].copy(),
                               mirror_q2=extra[:, 1].copy(), tau=extra[:, 2].copy(), mirror_tau=extra[:, 3].copy(),
                               mirror_g3=extra[:, 4].copy())
        self._show_sphere(result)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def _show_domain(self, result: ArcResult, hold_axes: bool) -> None:
        body, (boundary, kind) = result.body, result.boundary
        width = nice_above(1.08 * max(body.axes))
        if not hold_axes:
            self.domain.fit(width)
        levels, forbidden = _levels(body, result.h)
        self.domain.show_forbidden([[self.domain.frame(width), boundary], *([part] for part in forbidden)])
        self.domain.show_curves("levels", levels)
        self.domain.show_curves("stable", _runs(boundary, kind > 0.0))
        self.domain.show_curves("unstable", _runs(boundary, kind < 0.0))
        low, high = _ends(result.arc)
        more = 0.5 * (high - low) or 1.0 / (result.arc.rate or 1.0)
        u = result.arc.u(np.linspace(low - more, high + more, 181))
        self.domain.show_curves("path", [_to_q(body, u)] if result.arc.kind != "fixed" else [])
        self.domain.show_start(_to_q(body, result.arc.u0[None])[0])

    def _show_curve(self, result: ArcResult, hold_axes: bool) -> None:
        found = result.arc
        low, high = _ends(found)
        if not hold_axes:
            half, middle = nice_above(0.6 * ((high - low) or 1.0 / (found.rate or 1.0))), 0.5 * (low + high)
            self.curve.set_ranges((middle - half, middle + half), (-1.1, 1.1))
        self.curve.show("own", *_oval(found, found.tau))
        self.curve.show("other", *(_oval(found, found.other) if found.other else (np.empty(0), np.empty(0))))
        self.curve.choose(0.0, result.start[4])

    def _show_periods(self, result: ArcResult, hold_axes: bool) -> None:
        finite = result.T[np.isfinite(result.T)]
        if finite.size == 0:
            self.period.clear("T", "chosen")
            if result.T.size:
                self.period.say("Nothing moves: no period.")
            return
        if not hold_axes:
            self.period.set_ranges((-math.pi, math.pi), (0.0, nice_above(1.5 * float(np.median(finite)))))
        # What is infinite is drawn beyond the frame.
        top = 4.0 * self.period.y_range[1]
        self.period.show("T", _DIRECTIONS, np.minimum(result.T, top))
        if result.arc.kind == "fixed":
            self.period.clear("chosen")
        else:
            self.period.choose(float(result.values["alpha"]), min(result.arc.period, self.period.y_range[1]))

    def _show_sphere(self, result: ArcResult) -> None:
        b = np.array([result.body.b1, result.body.b2, 0.0])
        length = float(np.linalg.norm(b))
        circles = [Circle((0.0, 0.0, 1.0), 0.0, "limit")]
        ends = [] if result.arc.kind == "fixed" else list(result.arc.tau)
        marks = []
        for tau, (u1, u2) in zip(ends, result.arc.u(np.array(ends)), strict=True):
            marks.append(Mark((u1, u2, 0.0), "unstable" if tau == result.arc.touch else "muted"))
        if result.arc.kind == "fixed" and result.start[4] == 0.0:
            marks.append(Mark(result.start[2:], "stable" if result.arc.stable else "unstable"))
        self.sphere.show(*((-b / length, "r") if length > 0.0 else ((), "")), circles, marks)

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the plane chooses the start, in the graph of T the direction."""
        if picture == "domain":
            return {"q1": x, "q2": y}
        return {"alpha": x} if picture == "period" else {}


def _ends(found: Arc) -> tuple[float, float]:
    """The ends in τ of all that is inside the domain, with the other orbit's arc."""
    both = found.tau + (found.other or ())
    return min(both), max(both)


def _to_q(body: PlaneBody, u: Array) -> Array:
    r1, r2 = body.axes
    return np.column_stack([r1 * u[:, 1], -r2 * u[:, 0]])


def _levels(body: PlaneBody, h: float) -> tuple[list[Array], list[Array]]:
    """Equipotentials, chords of the ellipse (2, 2), and the part (m, 2) of it that E = h forbids, if any."""
    size = math.hypot(body.b1, body.b2)
    if size == 0.0:
        return [], []
    n = np.array([body.b1, body.b2]) / size
    across = np.array([-n[1], n[0]])
    chords = []
    for share in _LEVELS:
        half = math.sqrt(1.0 - share * share)
        chords.append(_to_q(body, share * n + np.outer([-half, half], across)))
    if h >= size:
        return chords, []
    half_angle = math.acos(max(-1.0, h / size))
    s = np.linspace(-half_angle, half_angle, 91)
    return chords, [_to_q(body, np.outer(np.cos(s), n) + np.outer(np.sin(s), across))]


def _runs(points: Array, chosen: Array) -> list[Array]:
    """The parts of a closed curve (n, 2) along which `chosen` (n,) holds."""
    cuts = np.flatnonzero(np.diff(chosen.astype(int))) + 1
    return [part for part, keep in zip(np.split(points, cuts), np.split(chosen, cuts), strict=True)
            if keep[0] and len(part) > 1]


def _oval(found: Arc, ends: tuple[float, float]) -> tuple[Array, Array]:
    """γ3² = P(τ) over (τ₋, τ₊), both signs."""
    angle = np.linspace(0.0, 2.0 * math.pi, 241)
    tau = 0.5 * (ends[0] + ends[1]) + 0.5 * (ends[1] - ends[0]) * np.cos(angle)
    return tau, np.copysign(found.height(tau), np.sin(angle))


def _crossing_speeds(found: Arc) -> list[float]:
    """|γ̇3| = |(u, v)| where the orbit crosses the equator, at τ₋ and τ₊."""
    tau = np.array(found.tau)
    return np.abs(np.sum(found.u(tau) * (found.v0 + tau[:, None] * found.a), axis=1)).tolist()


def _captions(result: ArcResult) -> tuple[str, str, str, str]:
    found = result.arc
    if found.kind == "fixed":
        moving = found.rate > 0.0
        where = "on the equator" if result.start[4] == 0.0 else "no field and no motion"
        stable = {True: ", stable", False: ", unstable", None: ""}[found.stable]
        return (
            f"Domain of (q₁, q₂)\nA fixed point, {where}{stable}: nothing changes.",
            "Poisson sphere\nγ̇₃ = γ₁ω₂ − γ₂ω₁ = 0 and γ₃ = 0: γ stays." if moving else "Poisson sphere\nγ stays.",
            "γ₃ against τ\nτ does not run: dτ = γ₃ dt = 0." if moving else "γ₃ against τ\nNothing depends on τ.",
            "Period T against direction α\nOf the other directions from here.",
        )
    low, high = (number(tau) for tau in found.tau)
    first, second = (number(speed) for speed in _crossing_speeds(found))
    straight = not np.any(found.a)
    if found.kind == "asymptotic":
        last = second if found.touch == found.tau[0] else first
        return (
            "Domain of (q₁, q₂)\nAsymptotic: the arc touches the edge from inside, at an unstable fixed point.",
            f"Poisson sphere\nThe equator is crossed once, |γ̇₃| = {last}; from and to the fixed point for ever.",
            f"γ₃ against τ\nγ₃² = P(τ) from {low} to {high}, with a double zero at {number(found.touch or 0.0)}.",
            "Period T against direction α\nT = ∞ here: ∫dτ/γ₃ diverges.",
        )
    shape = "a straight line" if straight else "an arc of a parabola"
    return (
        f"Domain of (q₁, q₂)\nPeriodic: {shape}, to and fro in T = {number(found.period, 6)}.",
        f"Poisson sphere\nTwice a period it crosses the equator, |γ̇₃| = {first} and {second}.",
        f"γ₃ against τ\nγ₃² = P(τ) from {low} to {high}; dτ = γ₃ dt, ∮dτ/γ₃ = T.",
        f"Period T against direction α\nT = {number(found.period, 6)} here; after T back at the start to "
        f"{_power(result.missed)}.",
    )


def _power(value: float) -> str:
    return f"{value:.0e}".replace("e-", "e−")


def _derived(result: ArcResult) -> list[str]:
    found, body = result.arc, result.body
    rows = [
        f"E = {number(result.h, 6)}",
        f"Start: γ₃ = {number(result.start[4], 6)}",
        f"Force = ({number(-body.b2 / body.axes[0])}, {number(body.b1 / body.axes[1])})",
    ]
    if found.kind == "periodic":
        rows.append(f"T = {number(found.period, 8)}")
        rows.append(f"Back after T: {_power(result.missed)}")
    else:
        rows.append("T = ∞" if found.kind == "asymptotic" else "A fixed point")
    if result.orbit is not None:
        largest = float(np.abs(divergence(result.orbit.states.T, body.parameters)).max())
        rows.append(f"div v = {number(largest)} on the orbit: the standard measure")
    rows.append("In τ: Hamiltonian, measure γ₃ dω dγ")
    return rows


def _status(result: ArcResult) -> str:
    parts = [] if result.orbit is None else orbit_status(result.orbit)
    return " · ".join([*parts, result.ended]).replace("e-", "e−")


def _notes(result: ArcResult) -> list[str]:
    if result.orbit is not None and result.orbit.times.size >= _MOST:
        return [f"So long a motion is drawn with {_MOST} points: choose a shorter time span to see its curves."]
    return []


SCENE = Scene(
    name="kharlamova",
    title="Principal axis, b₃ = 0",
    summary="Parabolas in an ellipse, run to and fro: every orbit closes but those that touch the equator from inside.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("domain", "sphere", "curve", "period"),
    compute=compute,
    stage=ArcStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=6,
)
