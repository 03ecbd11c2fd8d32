"""The Chaplygin ball with a field (S10): an orbit, and the section γ3 = 0 at E = h."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Choice, Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.sections import section_status
from hess_explorer.scenes.framework.work import Work, refuse
from hess_explorer.views.poisson_sphere import PoissonSphere
from hess_explorer.views.scattering_map import ANGLE_TICKS, POLAR_TICKS
from hess_explorer.views.section_plane import SectionPlane
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import VelocityPlane, nice_above, sphere_columns
from hess_mechanics.chaplygin_ball.energy_surface import lowest_energy
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.section import ball_section, coordinates, forbidden_band, seeds, state_at
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.dynamics.section import Points, occupied_cells
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, STANDARD, Level
from hess_mechanics.numerics.results import Array, Orbit

_MOST = 6000
_ORBITS = 20
_FEW = 30
"""Crossings of each, while a slider is dragged and until all are known."""
_CELLS = 32
_MOST_STEPS = 15_000
_ABOVE = 1e-3

SPECS = (
    Number("I11", "I₁₁", "Inertia I₁₁", 1.0, 0.2, 5.0, 0.01, 1e-2, 1e2, "Moment of inertia about the first body axis."),
    Number("I22", "I₂₂", "Inertia I₂₂", 3.0, 0.2, 5.0, 0.01, 1e-2, 1e2,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.0, -1.0, 1.0, 0.01, -20.0, 20.0,
           "Product of inertia; with I₁₃ = I₂₃ = 0 the flow keeps volume."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.0, -1.0, 1.0, 0.01, -20.0, 20.0, "Product of inertia."),
    Number("D", "𝒟", "Ball inside, 𝒟", 5.0, 0.0, 10.0, 0.05, 0.0, 1e2, "𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside."),
    Number("b1", "b₁", "Centre of mass b₁", 0.5, -1.0, 1.0, 0.01, -1e2, 1e2, "b = −mg r, r the centre of mass."),
    Number("b2", "b₂", "Centre of mass b₂", 0.0, -1.0, 1.0, 0.01, -1e2, 1e2, "b = −mg r."),
    Number("b3", "b₃", "Centre of mass b₃", 0.8, -1.0, 1.0, 0.01, -1e2, 1e2, "b = −mg r; b₃ = 0: every orbit closes."),
    Number("h", "h", "Energy above the plane's lowest", 2.0, 0.05, 5.0, 0.01, 1e-3, 1e3,
           "E = h − √(b₁²+b₂²): every h > 0 has motions through γ₃ = 0."),
    Number("psi", "ψ", "Start: ψ, direction of γ", 1.0, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "On the section γ = (cos ψ, sin ψ, 0). A click in the section chooses ψ and δ."),
    Number("delta", "δ", "Start: δ, from γ to ω", 1.5, 0.01, 3.13, 0.01, 1e-6, math.pi - 1e-6,
           "On the section ω points at the angle δ from γ."),
    Number("count", "n", "Crossings of each orbit", 200.0, 50.0, 600.0, 10.0, 1.0, 1000.0, "Points for each orbit."),
    Number("span", "t", "Time span", 40.0, 1.0, 200.0, 1.0, 0.01, 1e4, "How long the chosen orbit is followed."),
    Choice("drop", "Points shown", ("all", "the later half"), "all", "The later half shows what attracts."),
    Choice("accuracy", "Accuracy", tuple(LEVELS), "standard",
           "Of the orbit. Points of the section are right on their integrals; chaos moves them along."),
)

_PLAIN = {"I13": 0.0, "I23": 0.0}
PRESETS = (
    Preset("Mixed: curves and a sea, I₁₃ = I₂₃ = 0", {}),
    Preset("Regular: I₁₁ = I₂₂, b ∥ e₃", {
        **_PLAIN, "I11": 1.0, "I22": 1.0, "D": 3.0, "b1": 0.0, "b3": 1.0, "h": 1.5}),
    Preset("Every orbit closes: b₃ = 0", {
        **_PLAIN, "I11": 1.0, "I22": 2.0, "D": 1.0, "b1": 1.0, "b2": 0.5, "b3": 0.0, "h": 2.618, "psi": 2.0}),
    Preset("A sea nearly everywhere", {
        **_PLAIN, "I11": 1.0, "I22": 4.0, "D": 2.0, "b1": 0.3, "b3": 1.0, "h": 0.8}),
    Preset("Strange attractor, I₁₃ ≠ 0", {
        "I11": 1.5, "I22": 3.0, "I13": -0.3, "I23": 0.0, "D": 1.0, "b1": 1.0, "b2": -0.7, "b3": 0.7, "h": 2.72,
        "psi": 2.5, "count": 600.0, "drop": "the later half"}),
    Preset("A wider one, I₁₃I₂₃ ≠ 0", {
        "I11": 1.5, "I22": 3.0, "I13": -0.1, "I23": 0.4, "D": 4.0, "b1": -0.8, "b2": -0.3, "b3": -0.7, "h": 1.0,
        "psi": 0.4, "count": 600.0, "drop": "the later half"}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>chosen orbit</li>
<li><span class="dot small" style="background: #808080"></span>other orbits</li>
<li><span class="dot" style="background: none; border: 3px solid #D55E00"></span>where it starts</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<rect x="4" y="3" width="40" height="26" fill="none" stroke="#808080"/>
<ellipse cx="16" cy="16" rx="8" ry="9" fill="none" stroke="#0072B2" stroke-width="2"/>
<ellipse cx="16" cy="16" rx="3.5" ry="4" fill="none" stroke="#0072B2" stroke-width="1.5"/>
<path d="M28 8h.1M33 6h.1M38 10h.1M30 14h.1M36 16h.1M40 20h.1M29 20h.1M33 24h.1M38 25h.1M41 7h.1M35 11h.1"
 stroke="#808080" stroke-width="2.5" stroke-linecap="round"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class SectionResult:
    """E is the energy; `others`, `own`: (n, 2) points (ψ, δ); None where no picture asks, or for this `reason`.

    todo : the others in full, where they are not computed yet.
    """

    values: Values
    body: BallBody
    E: float
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


def body_of(values: Values) -> BallBody:
    """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
    return BallBody(*(float(values[name]) for name in ("I11", "I22", "I13", "I23", "D", "b1", "b2", "b3")))


def _energy(body: BallBody, h: float) -> float:
    return h - math.hypot(body.b1, body.b2)


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """ψ outside the band that the energy forbids."""
    out, notes = dict(values), []
    body = body_of(values)
    band = forbidden_band(body, _energy(body, float(out["h"])))
    if band is not None:
        middle, half = band
        away = math.remainder(float(out["psi"]) - middle, 2.0 * math.pi)
        if abs(away) < half + _ABOVE:
            psi = math.remainder(middle + math.copysign(min(half + 2.0 * _ABOVE, math.pi), away), 2.0 * math.pi)
            out["psi"] = max(-math.pi, min(math.pi, psi))
            notes.append(f"With this energy γ cannot point at ψ = {number(float(values['psi']))} on the plane: "
                         f"ψ is {number(float(out['psi']))} now.")
    return out, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """No slider depends on another."""
    return {}


def _half_width(omega: Array) -> float:
    """Room for these ω (n, 2)."""
    return nice_above(1.05 * max(1e-9, float(np.hypot(*omega.T).max())))


def _weights(body: BallBody, start: tuple[float, ...], span: float) -> Array:
    """Pixels for a unit of each variable, as large as the orbit will be drawn.  Raises `ModelError`."""
    coarse = solve(SYSTEM, start, body.parameters, np.linspace(0.0, span, 129), DRAFT)
    radius = 0.5 * PIXELS
    w = radius / _half_width(coarse.states[:, :2])
    return np.array([w, w, radius, radius, radius])


def _orbit(body: BallBody, start: tuple[float, ...], span: float, accuracy: Level) -> Orbit:
    weights = _weights(body, start, span)
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, weights, SAGITTA, _MOST)
    return solve(SYSTEM, start, body.parameters, times, accuracy)


def _others(body: BallBody, E: float, crossings: int) -> Points:
    return ball_section(body, E, seeds(body, E, _ORBITS), crossings, STANDARD, _MOST_STEPS)


def _own(body: BallBody, E: float, start: tuple[float, ...], crossings: int) -> Points:
    return ball_section(body, E, [start], crossings, STANDARD, _MOST_STEPS)


def _points(points: Points, later: bool) -> Array:
    first = max(map(len, points.states), default=0) // 2 if later else 0
    parts = [coordinates(states[first:]) for states in points.states]
    return np.concatenate([np.empty((0, 2)), *parts])


def compute(values: Values, shown: Collection[str], dragging: bool) -> SectionResult:
    """The chosen orbit and its crossings, those of others."""
    work = Work(values, dragging)
    accuracy = work.level
    body = body_of(values)
    E = _energy(body, float(values["h"]))
    start = state_at(body, E, float(values["psi"]), float(values["delta"]))
    count = int(float(values["count"]))
    few = min(count, _FEW)
    later = values["drop"] != "all"
    orbit = work.get(_orbit, body, start, float(values["span"]), accuracy) if shown else None
    others = own = None
    drift: dict[str, float] = {}
    steps, reason = 0, ""
    if not {"section", "returns"}.isdisjoint(shown):
        try:
            one = work.get(_own, body, E, start, few if dragging else count)
            many = work.sooner(Task(_others, (body, E, count)), Task(_others, (body, E, few)))
            others, own = _points(many, later), _points(one, later)
            drift = {name: max(many.drift.get(name, 0.0), one.drift.get(name, 0.0)) for name in ("E", "F1")}
            steps = many.cost.steps + one.cost.steps
        except WorkLimit as error:
            reason = f"The section is left out: {error}"
    return SectionResult(values, body, E, start, orbit, others, own, drift, steps, reason, tuple(work.todo),
                         work.pieces, work.ended())


def motion(values: Values) -> Motion:
    """The chosen orbit, for "Speed and accuracy".  Raises `ModelError`."""
    body = body_of(values)
    E = _energy(body, float(values["h"]))
    start = state_at(body, E, float(values["psi"]), float(values["delta"]))
    span = float(values["span"])
    return Motion(SYSTEM, start, body.parameters, span, tuple(_weights(body, start, span)), 1.0)


class SectionStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"omega-point": ("omega1", "omega2")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.section = SectionPlane(wire, "section", ("ψ", "δ"), (-math.pi, math.pi), (0.0, math.pi),
                                    picks=("tap", "doubletap"), ticks=ANGLE_TICKS, y_ticks=POLAR_TICKS)
        self.returns = SectionPlane(wire, "returns", ("ψ", "ψ at the next crossing"), (-math.pi, math.pi),
                                    (-math.pi, math.pi), ticks=ANGLE_TICKS)
        self.omega = VelocityPlane(wire, picks=())
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.pictures = (self.section, self.returns, self.omega, self.sphere)

    def show(self, result: SectionResult, hold_axes: bool) -> Report:
        """Draw the section, the returns and the chosen orbit."""
        for view in (self.section, self.returns, self.omega):
            view.say("")
        if not hold_axes and result.orbit is not None:
            self.omega.fit(_half_width(result.orbit.states[:, :2]))
        if result.others is not None and result.own is not None:
            self.section.show(result.others, result.own)
            band = forbidden_band(result.body, result.E)
            self.section.show_forbidden([] if band is None else _bands(*band))
            # Which returns belong together only the chosen orbit tells.
            self.returns.show(np.empty((0, 2)), np.column_stack([result.own[:-1, 0], result.own[1:, 0]]))
            self.section.choose(float(result.values["psi"]), float(result.values["delta"]))
        elif result.reason:
            self.section.show_nothing(result.reason)
            self.returns.show_nothing(result.reason)
        if result.orbit is not None:
            states = result.orbit.states
            self.omega.assign("orbit", t=result.orbit.times.astype(np.float32),
                              **sphere_columns(states[:, :2], states[:, 2:]))
        b = np.array(result.body.parameters[5:])
        length = float(np.linalg.norm(b))
        self.sphere.show(*(((-b / length).tolist(), "r") if length > 0.0 else ((), "")))
        for name, text in _captions(result).items():
            self.wire.say(name, text)
        notes = [result.reason] if result.reason else []
        return Report(_derived(result), _status(result), notes, result.todo, result.total)

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the section starts the chosen orbit there."""
        return {"psi": x, "delta": y} if picture == "section" else {}


def _bands(middle: float, half: float) -> list[tuple[float, float]]:
    """The band middle ± half in (−π, π], in two where it goes round."""
    low, high = middle - half, middle + half
    turn = 2.0 * math.pi
    return [(low + shift, high + shift) for shift in (-turn, 0.0, turn)]


def _captions(result: SectionResult) -> dict[str, str]:
    body = result.body
    captions = {
        "omega": f"Angular velocity (ω₁, ω₂)\nThe chosen orbit, E = {number(result.E)}.",
        "sphere": "Poisson sphere\nThe vertical γ along the chosen orbit" + (
            "; r: the centre of mass." if any(body.parameters[5:]) else "; no field, b = 0."),
    }
    if result.own is not None:
        volume = "the flow keeps volume" if body.I13 == body.I23 == 0.0 else "volume is not kept"
        visited = occupied_cells(result.own, _CELLS)
        captions["section"] = (f"Section: γ₃ grows through 0\nThe chosen orbit: {len(result.own)} points in "
                               f"{visited} of {_CELLS**2} cells; {volume}.")
        captions["returns"] = "First return\nψ and the next ψ: a point if closed, a curve if regular, a cloud in chaos."
    elif result.reason:
        captions["section"] = "Section: γ₃ grows through 0\nLeft out: it would take too many steps."
        captions["returns"] = "First return\nLeft out: it would take too many steps."
    return captions


def _derived(result: SectionResult) -> list[str]:
    w1, w2, *gamma = result.start
    return [
        f"E = {number(result.E, 6)}",
        f"lowest energy −|b| = {number(lowest_energy(result.body), 6)}",
        f"ω(0) = ({number(w1)}, {number(w2)})",
        f"γ(0) = ({', '.join(number(x) for x in gamma)})",
    ]


def _status(result: SectionResult) -> str:
    section = "" if result.others is None or result.own is None else (
        f"section {len(result.others) + len(result.own)} points, {result.steps} Taylor steps")
    return section_status(section, result.drift, result.orbit, result.ended)


SCENE = Scene(
    name="ball-section",
    title="Ball with a field",
    summary="The ball in a field: a section at one energy shows curves, seas and, with I₁₃ or I₂₃, attractors.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("section", "returns", "omega", "sphere"),
    compute=compute,
    stage=SectionStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=10,
)
