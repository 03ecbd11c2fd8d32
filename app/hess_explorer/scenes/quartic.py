"""e on a principal axis, b1 = b2 = 0 (S7): a point in a quartic potential, its section, and the body again."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.sections import section_status
from hess_explorer.scenes.framework.work import ACCURACY, Work, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.plane_domain import PlaneDomain, plane_columns
from hess_explorer.views.poisson_sphere import Circle, PoissonSphere
from hess_explorer.views.section_plane import SectionPlane
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.dynamics.section import Points, occupied_cells
from hess_mechanics.errors import ModelError, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Level
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.quartic import (
    QuarticBody,
    angular_momentum,
    quartic_section,
    seeds,
    state_at,
    state_on_section,
)

_MOST = 6000
_ORBITS = 20
_FEW = 30
"""Crossings of each, while a slider is dragged and until all are known."""
_MOST_STEPS = 40_000
_CELLS = 32
_LEVELS = (-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75)
"""Of γ3."""
_INSIDE = 1e-9
_ANGLE = np.linspace(0.0, 2.0 * math.pi, 181)
_CIRCLE = np.column_stack([np.cos(_ANGLE), np.sin(_ANGLE)])

SPECS = (
    Number("I22", "I₂₂", "Inertia I₂₂", 1.0, 0.2, 3.0, 0.01, 1e-2, 1e2,
           "Moment of inertia about the second body axis."),
    Number("ratio", "I₁₁/I₂₂", "Ratio I₁₁/I₂₂", 2.0, 0.2, 5.0, 0.01, 1e-2, 1e2,
           "At 1 the potential is central and the motion integrable."),
    Number("b3", "b₃", "Centre of mass b₃", 1.0, -3.0, 3.0, 0.01, -1e2, 1e2, "b = −mg r; not 0 here, b₁ = b₂ = 0."),
    Number("h", "h", "Energy E = h", 0.8, -0.9, 4.0, 0.01, -1e2, 1e3,
           "Above −|b₃|. Beyond |b₃| the point may not come near the middle."),
    Number("Q1", "q₁", "Start q₁ = I₂₂ω₂/b₃", 0.6, -2.0, 2.0, 0.01, -1e30, 1e30,
           "A click in the plane chooses the start."),
    Number("Q2", "q₂", "Start q₂ = −I₁₁ω₁/b₃", 0.3, -2.0, 2.0, 0.01, -1e30, 1e30,
           "A click in the plane chooses the start."),
    Number("beta", "β", "Start: direction β", 1.0, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Where the point runs at first: q̇ = −p, |p| = √(1 − γ₃²). A click in the section chooses all three."),
    Number("count", "n", "Crossings of each orbit", 200.0, 50.0, 600.0, 10.0, 1.0, 1000.0, "Points for each orbit."),
    Number("span", "t", "Time span", 40.0, 1.0, 200.0, 1.0, 0.01, 1e3, "How long the chosen orbit is followed."),
    ACCURACY,
)

PRESETS = (
    Preset("Mixed: in the sea", {}),
    Preset("Mixed: on a curve", {"Q1": 0.2, "Q2": 1.9, "beta": 0.0}),
    Preset("Integrable: I₁₁ = I₂₂", {"ratio": 1.0, "h": 0.6}),
    Preset("Integrable, in a ring: h > |b₃|", {"ratio": 1.0, "h": 1.5, "Q1": 1.8, "Q2": 0.0}),
    Preset("Regular: nearly round", {"ratio": 1.05, "h": 0.6}),
    Preset("A sea nearly everywhere", {"ratio": 3.0, "h": 1.2, "Q1": 0.9, "Q2": 1.2}),
    Preset("In a ring: bouncing at its far end", {
        "ratio": 1.5, "h": 3.0, "Q1": 0.3, "Q2": 3.0, "beta": 1.571, "span": 60.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>chosen orbit</li>
<li><span class="dot small" style="background: #808080"></span>other orbits</li>
<li><span class="dot" style="background: none; border: 3px solid #D55E00"></span>where it starts</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="line muted"></span>equipotentials</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="24" cy="16" rx="21" ry="13" fill="none" stroke="#808080"/>
<ellipse cx="24" cy="16" rx="12" ry="7" fill="none" stroke="#808080"/>
<path d="M8 16C14 2 18 2 24 16S34 30 40 16 34 2 24 16 14 30 8 16" fill="none" stroke="#0072B2" stroke-width="2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class QuarticResult:
    """`others`, `own`: (n, 2) points of the section; None where no picture asks, or for this `reason`.

    todo : the others in full, where they are not computed yet.
    """

    values: Values
    body: QuarticBody
    start: tuple[float, ...]
    orbit: Orbit | None
    others: Array | None
    own: Array | None
    drift: Mapping[str, float]
    steps: int
    reason: str
    todo: Sequence[Task]
    total: int
    ended: str


def body_of(values: Values) -> QuarticBody:
    """The body at its energy.  Raises `NoField`, `OutsideRegion`, `InvalidParameter`, `NotPositiveDefinite`."""
    I22 = float(values["I22"])
    return QuarticBody(float(values["ratio"]) * I22, I22, float(values["b3"]), float(values["h"]))


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """A start that the energy forbids moves to the edge of the region."""
    out, notes = dict(values), []
    try:
        body = body_of(values)
    except ModelError:
        # Its sentence is that of the computation.
        return out, notes
    first, second = body.axes
    x, y = float(out["Q1"]) / first, float(out["Q2"]) / second
    size, inner = math.hypot(x, y), body.hole
    if not inner <= size <= 1.0:
        if size < 1e-100:
            x, y, size = 1.0, 0.0, 1.0
        # The ring may be thin.
        room = min(_INSIDE, 0.25 * (1.0 - inner))
        inside = min(1.0 - room, max(inner + room, size)) / size
        out["Q1"], out["Q2"] = inside * x * first, inside * y * second
        notes.append(f"With this energy the point cannot be at the start: it is at the edge now, q = "
                     f"({number(float(out['Q1']))}, {number(float(out['Q2']))}).")
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The slider of h begins above −|b3|, those of q span the region."""
    try:
        body = body_of(values)
    except ModelError:
        return {}
    field, ranges = abs(body.b3), {}
    for name, end in (("h", field), ("Q1", body.axes[0]), ("Q2", body.axes[1])):
        digits = 2 - math.floor(math.log10(end))
        step = float(f"1e{-digits}")
        top = round(math.floor(end / step) * step, digits)
        ranges[name] = (-0.9 * top, 4.0 * top, step) if name == "h" else (-top, top, step)
    return ranges


def _start(values: Values) -> tuple[QuarticBody, tuple[float, ...]]:
    body = body_of(values)
    return body, state_at(body, (float(values["Q1"]), float(values["Q2"])), float(values["beta"]))


def _half_width(body: QuarticBody) -> float:
    return nice_above(1.05 * max(body.axes))


def _weights(body: QuarticBody) -> tuple[float, ...]:
    """Pixels for a unit of each variable."""
    radius = 0.5 * PIXELS
    scale = radius / (_half_width(body) * abs(body.b3))
    return (scale * body.I11, scale * body.I22, radius, radius, radius)


def _orbit(body: QuarticBody, start: tuple[float, ...], span: float, accuracy: Level) -> Orbit:
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, np.array(_weights(body)), SAGITTA,
                         _MOST)
    return solve(SYSTEM, start, body.parameters, times, accuracy)


def _others(body: QuarticBody, crossings: int) -> Points:
    return quartic_section(body, seeds(body, _ORBITS), crossings, STANDARD, _MOST_STEPS)


def _own(body: QuarticBody, start: tuple[float, ...], crossings: int) -> Points:
    return quartic_section(body, [start], crossings, STANDARD, _MOST_STEPS)


def _points(body: QuarticBody, points: Points) -> Array:
    return frozen(np.concatenate([np.empty((0, 2)), *(body.on_section(states) for states in points.states)]))


def compute(values: Values, shown: Collection[str], dragging: bool) -> QuarticResult:
    """The chosen orbit and its crossings, those of others."""
    work = Work(values, dragging)
    body, start = _start(values)
    count = int(float(values["count"]))
    few = min(count, _FEW)
    orbit = work.get(_orbit, body, start, float(values["span"]), work.level)
    others = own = None
    drift: dict[str, float] = {}
    steps, reason = 0, ""
    if "section" in shown:
        try:
            one = work.get(_own, body, start, few if dragging else count)
            many = work.sooner(Task(_others, (body, count)), Task(_others, (body, few)))
            others, own = _points(body, many), _points(body, one)
            drift = {name: max(many.drift.get(name, 0.0), one.drift.get(name, 0.0)) for name in ("E", "F1")}
            steps = many.cost.steps + one.cost.steps
        except WorkLimit as error:
            reason = f"The section is left out: {error}"
    return QuarticResult(values, body, start, orbit, others, own, drift, steps, reason, tuple(work.todo), work.pieces,
                         work.ended())


def motion(values: Values) -> Motion:
    """The chosen orbit, for "Speed and accuracy".  Raises `ModelError`."""
    body, start = _start(values)
    return Motion(SYSTEM, start, body.parameters, float(values["span"]), _weights(body), 1.0)


class QuarticStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"domain-point": ("q1", "q2"), "momentum-point": ("t", "momentum")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.domain = PlaneDomain(wire)
        self.section = SectionPlane(wire, "section", ("q", "p"), (-1.5, 1.5), (-1.05, 1.05), picks=("tap", "doubletap"))
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.momentum = Graph(wire, "momentum", ("t", "q₁p₂ − q₂p₁"), (0.0, 40.0), (-1.0, 1.0),
                              [Series("G", theme.ORBIT)])
        self.pictures = (self.domain, self.section, self.sphere, self.momentum)
        self._body: QuarticBody | None = None

    def show(self, result: QuarticResult, hold_axes: bool) -> Report:
        """Draw the orbit in the potential, on the sphere and in the section."""
        body = self._body = result.body
        for view in (self.domain, self.section, self.momentum):
            view.say("")
        if not hold_axes:
            self.domain.fit(_half_width(body))
            reach = nice_above(1.05 * body.axes[1 - body.across])
            self.section.set_ranges((-reach, reach), (-1.05, 1.05))
        self._show_region(body)
        self.domain.show_start((float(result.values["Q1"]), float(result.values["Q2"])))
        self._show_section(result)
        self._show_orbit(result, hold_axes)
        bound = body.h / body.b3
        circles = [Circle((0.0, 0.0, 1.0), bound, "limit")] if abs(bound) < 1.0 else []
        self.sphere.show((0.0, 0.0, -math.copysign(1.0, body.b3)), "r", circles)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        notes = [result.reason] if result.reason else []
        return Report(_derived(result), _status(result), notes, result.todo, result.total)

    def _show_region(self, body: QuarticBody) -> None:
        unit = _CIRCLE * np.array(body.axes)
        hole = [[body.hole * unit]] if body.hole > 0.0 else []
        self.domain.show_forbidden([[self.domain.frame(_half_width(body)), unit], *hole])
        share = [(body.h - body.b3 * g3) / (body.h + abs(body.b3)) for g3 in _LEVELS]
        self.domain.show_curves("levels", [math.sqrt(one) * unit for one in share if one > 0.0])

    def _show_section(self, result: QuarticResult) -> None:
        if result.others is not None and result.own is not None:
            self.section.show(result.others, result.own)
            curve = result.body.section_boundary()
            r = 4.0 * max(self.section.x_range[1], result.body.axes[1 - result.body.across])
            frame = np.array([[-r, -4.0], [r, -4.0], [r, 4.0], [-r, 4.0]])
            mirror = [curve * np.array([-1.0, 1.0])] if result.body.hole > 0.0 else []
            rings = [frame, curve, *mirror]
            self.section.assign("forbidden", xs=[[[ring[:, 0] for ring in rings]]],
                                ys=[[[ring[:, 1] for ring in rings]]])
        elif result.reason:
            self.section.show_nothing(result.reason)

    def _show_orbit(self, result: QuarticResult, hold_axes: bool) -> None:
        if result.orbit is None:
            return
        states, times = result.orbit.states, result.orbit.times
        q, _ = result.body.to_plane(states)
        G = angular_momentum(result.body, states)
        self.domain.assign("orbit", t=times.astype(np.float32), **plane_columns(q, states[:, 2:]),
                           momentum=G.astype(np.float32))
        self.momentum.show("G", times, G)
        if not hold_axes:
            top = nice_above(1.2 * max(float(np.abs(G).max()), 1e-3 * max(result.body.axes)))
            self.momentum.set_ranges((0.0, float(times[-1])), (-top, top))

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        self._body = None
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the plane chooses the start, in the section the start and its direction."""
        if picture == "domain":
            return {"Q1": x, "Q2": y}
        if picture != "section" or self._body is None:
            return {}
        try:
            state = np.array([state_on_section(self._body, x, y)])
        except ModelError:
            return {}
        (q,), (p,) = self._body.to_plane(state)
        return {"Q1": float(q[0]), "Q2": float(q[1]), "beta": math.atan2(-p[1], -p[0])}


def _visited(result: QuarticResult) -> int:
    """Cells of the section that the chosen orbit comes to."""
    assert result.own is not None
    half = math.pi / result.body.axes[1 - result.body.across]
    return occupied_cells(np.column_stack([half * result.own[:, 0], 0.5 * math.pi * (1.0 + result.own[:, 1])]), _CELLS)


def _integrable(body: QuarticBody) -> bool:
    return body.I11 == body.I22


def _captions(result: QuarticResult) -> tuple[str, str, str, str]:
    body, orbit = result.body, result.orbit
    first, second = (number(axis) for axis in body.axes)
    ring = f"a ring, inside {number(body.hole)} of it grey" if body.hole > 0.0 else "no hole"
    held = "q₁" if body.across == 0 else "q₂"
    section = result.reason if result.own is None else (
        f"The orbit: {len(result.own)} points in {_visited(result)} of {_CELLS * _CELLS} cells.")
    heights, momentum = "", ""
    if orbit is not None:
        g3, G = orbit.states[:, 4], angular_momentum(body, orbit.states)
        heights = f"Back to the body: γ = (p₁, p₂, γ₃), γ₃ from {number(float(g3.min()))} to {number(float(g3.max()))}."
        low, high = float(G.min()), float(G.max())
        momentum = (f"I₁₁ = I₂₂: an integral, {number(float(G[0]))}, kept to {_power(high - low)}." if _integrable(body)
                    else f"I₁₁ ≠ I₂₂: no integral, from {number(low)} to {number(high)}.")
    return (
        f"Point in the potential γ₃²/2\nLevel ½, half axes {first} and {second}, {ring}.",
        f"Section {held} = 0, {held} growing\n{section}",
        f"Poisson sphere\n{heights}",
        f"q₁p₂ − q₂p₁ against time\n{momentum}",
    )


def _power(value: float) -> str:
    return f"{value:.0e}".replace("e-", "e−")


def _derived(result: QuarticResult) -> list[str]:
    body = result.body
    rows = [
        f"I₁₁ = {number(body.I11, 6)}",
        f"h/|b₃| = {number(body.h / abs(body.b3), 6)}",
        f"Start: γ₃ = {number(result.start[4], 6)}",
        f"ω(0) = ({number(result.start[0])}, {number(result.start[1])})",
    ]
    if result.orbit is not None:
        q, p = body.to_plane(result.orbit.states)
        level = 0.5 * (np.sum(p * p, axis=1) + body.height(q) ** 2)
        rows.append(f"H = ½ to {_power(float(np.abs(level - 0.5).max()))}")
    rows.append("Integrable" if _integrable(body) else "Not integrable")
    rows.append("div v = 0: the standard measure")
    return rows


def _status(result: QuarticResult) -> str:
    section = "" if result.others is None or result.own is None else (
        f"section {len(result.others) + len(result.own)} points, {result.steps} Taylor steps")
    return section_status(section, result.drift, result.orbit, result.ended)


SCENE = Scene(
    name="quartic",
    title="Principal axis, b₁ = b₂ = 0",
    summary="The body as a point in a quartic potential: integrable for I₁₁ = I₂₂, else curves and seas in a section.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("domain", "section", "sphere", "momentum"),
    compute=compute,
    stage=QuarticStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=7,
)
