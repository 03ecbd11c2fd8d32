"""The Chaplygin ball with Suslov's constraint and no field (S9): the strip, Nˢ and Nᵘ, scattering."""

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
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.poisson_sphere import Circle, Mark, PoissonSphere
from hess_explorer.views.scattering_map import ANGLE_TICKS, POLAR_TICKS
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import VelocityPlane, nice_above, sphere_columns
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.scattering import BallScattering, ball_scattering, starts
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, Level
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.scattering import scattering

_MOST = 4000
_ORBITS, _FEW_ORBITS = 18, 8
_PHASES, _FEW_PHASES = 65, 33
"""Few: while a slider is dragged, and until the others are known."""
_MOST_STEPS = 1.2e6
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)

SPECS = (
    Number("I11", "I₁₁", "Inertia I₁₁", 1.0, 0.2, 5.0, 0.01, 1e-3, 1e3, "Moment of inertia about the first body axis."),
    Number("I22", "I₂₂", "Inertia I₂₂", 1.5, 0.2, 5.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.7, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia; with I₂₃ it sets the line I₁₃ω₁ + I₂₃ω₂ = 0."),
    Number("I23", "I₂₃", "Inertia I₂₃", 1.2, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia; not 0 together with I₁₃."),
    Number("D", "𝒟", "Ball inside, 𝒟", 10.0, 0.0, 20.0, 0.05, 0.0, 300.0,
           "𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside; 0 is the free Suslov problem."),
    Number("h", "h", "Energy h", 10.0, 0.1, 20.0, 0.1, 1e-6, 1e6,
           "E = h > 0: every such energy is possible. It sets the size of the strip and the unit of time."),
    Number("theta", "θ⁻", "Angle θ⁻ of the circle left", 1.2, 0.0, 3.14, 0.01, 0.0, math.pi,
           "The angle between ξ and γ at the start of the chosen orbit."),
    Number("phi", "φ", "Phase φ of the chosen orbit", 0.5, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Where on that circle γ starts, in radians."),
    Number("digits", "−lg δ", "Distance δ of the start, digits", 4.0, 2.0, 8.0, 0.05, 2.0, 10.0,
           "The chosen orbit starts δ = 10^−digits of |ω| away from Nᵘ."),
    Number("span", "t", "Time span", 60.0, 1.0, 400.0, 1.0, 0.01, 1e4, "How long the chosen orbit is followed."),
    ACCURACY,
)

PRESETS = (
    Preset("Projections of trajectories, 𝒟 = 10, h = 10 (figure)", {}),
    Preset("𝒟 = 0: the free Suslov problem", {"D": 0.0, "span": 15.0}),
    Preset("𝒟 = 0.5, close to it", {"D": 0.5, "span": 15.0}),
    Preset("𝒟 = 2, I₁₃ = 0, k = 1 of S3: no longer flat", {
        "I11": 1.64, "I22": 1.0, "I13": 0.0, "I23": 0.8, "D": 2.0, "theta": 1.0, "span": 30.0}),
    Preset("𝒟 = 0, I₁₃ = 0, k = 1: complete reversal", {
        "I11": 1.64, "I22": 1.0, "I13": 0.0, "I23": 0.8, "D": 0.0, "theta": 1.0, "span": 15.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbits; the chosen one bold</li>
<li><span class="line stable"></span>Nˢ, circle joined</li>
<li><span class="line unstable"></span>Nᵘ, circle left</li>
<li><span class="line second" style="border-top-style: dashed"></span>θ⁺ for 𝒟 = 0</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="24" cy="16" rx="20" ry="13" fill="none" stroke="#808080"/>
<ellipse cx="24" cy="16" rx="8" ry="5" fill="#A8A8A8" stroke="#808080"/>
<path d="M31 12 43 6" stroke="#D55E00" stroke-width="3" stroke-dasharray="3 2"/>
<path d="M17 20 5 26" stroke="#009E73" stroke-width="3"/>
<path d="M36 9C33 1 22 6 14 10S8 20 10 23" fill="none" stroke="#0072B2" stroke-width="2"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class BallResult:
    """`crowd`: tracks (m, 2) of ω over the strip, and where on each its arrow is.

    `map`: θ⁺ over the phases; None where it would take too long, for this `reason`.
    `todo`: what is still to be computed, of `total` pieces.
    """

    values: Values
    body: BallBody
    strip: Strip
    orbit: Orbit | None
    crowd: tuple[tuple[Array, int], ...]
    map: BallScattering | None
    free: Array | None
    reason: str
    todo: Sequence[Task]
    total: int
    ended: str


def body_of(values: Values) -> BallBody:
    """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
    return BallBody(*(float(values[name]) for name in ("I11", "I22", "I13", "I23", "D")))


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """Everything is possible together."""
    return dict(values), []


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """No slider depends on another."""
    return {}


def half_width(body: BallBody, h: float) -> float:
    """The frame of the (ω1, ω2)-plane: room for σ1."""
    return nice_above(1.1 * math.sqrt(2.0 * h / min(body.I11, body.I22)))


def _start(body: BallBody, h: float, theta: float, phi: float, digits: float) -> tuple[float, ...]:
    """E = h, ω along ξ + δη, γ where motions from the circle θ⁻ about ξ then are."""
    states, _ = starts(Strip(body, h), theta, np.array([phi]), 10.0 ** -digits)
    return tuple(map(float, states[0]))


def _weights(body: BallBody, h: float) -> Array:
    radius = 0.5 * PIXELS
    w = radius / half_width(body, h)
    return np.array([w, w, radius, radius, radius])


def _orbit(body: BallBody, h: float, start: tuple[float, ...], span: float, accuracy: Level) -> Orbit:
    times = sample_times(SYSTEM, np.array(start), np.array(body.parameters), span, _weights(body, h), SAGITTA, _MOST)
    return solve(SYSTEM, start, body.parameters, times, accuracy)


def _crowd(body: BallBody, count: int) -> tuple[tuple[Array, int], ...]:
    """Orbits of E = 1 through states spread over the strip, followed both ways until they have all but arrived."""
    strip = Strip(body, 1.0)
    states = strip.spread(count)
    _, eta = line_of_rest(body)
    speed = math.sqrt(2.0 / min(body.I11, body.I22))
    tick = 2.0 * 1.1 * speed / PIXELS
    # No slower than this they leave and arrive, from one pixel to the next one; but not too many turns of γ.
    moment = 2.0 / float(np.sum(strip.unstable[1] ** 2))
    rate = math.hypot(body.I13, body.I23) * math.sqrt(2.0 * moment) / (body.I11 + body.D) / (body.I22 + body.D)
    end = min(10.0 / max(rate, 1e-290), 250.0 / speed)
    times = np.linspace(0.0, end, int(min(1200.0, max(60.0, end * speed / 0.2))) + 1)[1:]
    tracks = []
    there = ensemble(SYSTEM, states, body.parameters, times, DRAFT).states[:, :, :2]
    back = ensemble(SYSTEM, states, body.parameters, -times, DRAFT).states[:, :, :2]
    for i in range(count):
        before, after = (_as_far_as_the_line(states[i, :2], half[i], eta, tick) for half in (back, there))
        track = np.concatenate([before[:0:-1], after])
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(track, axis=0), axis=1))])
        # A point for each pixel is enough.
        kept = np.unique(np.floor(length / tick), return_index=True)[1]
        tracks.append((frozen(track[kept]), int(np.searchsorted(kept, len(before) - 1))))
    return tuple(tracks)


def _as_far_as_the_line(first: Array, others: Array, eta: Array, tick: float) -> Array:
    track = np.vstack([first, others])
    away = np.flatnonzero(np.abs(track @ eta) > tick)
    return track[: away[-1] + 2] if away.size else track[:1]


def _free_curve(body: BallBody, theta: float, digits: float, phis: tuple[float, ...]) -> Array:
    """θ⁺ of the free Suslov problem of the same tensor."""
    free = SuslovBody(body.I11, body.I22, body.I13, body.I23)
    return frozen(scattering(free, LEVELS["standard"], 1, 10.0 ** -digits).theta_plus(theta, np.array(phis)))


def compute(values: Values, shown: Collection[str], dragging: bool) -> BallResult:
    """The chosen orbit, a crowd over the strip, and the map of the phases."""
    work = Work(values, dragging)
    accuracy = work.level
    body = body_of(values)
    h, theta_minus, phi, digits, span = (float(values[name]) for name in ("h", "theta", "phi", "digits", "span"))
    strip = Strip(body, h)
    start = _start(body, h, theta_minus, phi, digits)
    orbit = work.get(_orbit, body, h, start, span, accuracy) if shown else None
    crowd = ()
    if "omega" in shown:
        # Without a field the energy only sets the unit of time: ω → ω√h.
        crowd = tuple((math.sqrt(h) * track, place) for track, place in work.sooner(
            Task(_crowd, (body, _ORBITS)), Task(_crowd, (body, _FEW_ORBITS))))
    found: BallScattering | None = None
    free: Array | None = None
    reason = ""
    if "curve" in shown:
        def phases(count: int, rung: Level) -> Task:
            phis = tuple(np.linspace(-math.pi, math.pi, count).tolist())
            return Task(ball_scattering, (body, theta_minus, phis, 1.0, 10.0 ** -digits, rung, _MOST_STEPS))

        try:
            rung = min(accuracy, LEVELS["standard"], key=lambda one: one.order)
            found = work.sooner(phases(_PHASES, rung), phases(_FEW_PHASES, LEVELS["draft"]))
            free = work.get(_free_curve, body, theta_minus, digits, tuple(found.phis.tolist()))
        except WorkLimit as error:
            reason = f"The map of the phases is left out: {error}"
    return BallResult(values, body, strip, orbit, crowd, found, free, reason, tuple(work.todo), work.pieces,
                      work.ended())


def motion(values: Values) -> Motion:
    """The chosen orbit, for "Speed and accuracy".  Raises `ModelError`."""
    body, h = body_of(values), float(values["h"])
    start = _start(body, h, *(float(values[name]) for name in ("theta", "phi", "digits")))
    return Motion(SYSTEM, start, body.parameters, float(values["span"]), tuple(_weights(body, h)), 1.0)


class BallStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"omega-point": ("omega1", "omega2"), "Gamma-point": ("t", "Gamma")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.omega = VelocityPlane(wire, picks=())
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        self.curve = Graph(wire, "curve", ("φ", "θ⁺"), (-math.pi, math.pi), (0.0, math.pi),
                           [Series("free", theme.MAP, "dashed"), Series("ball", theme.ORBIT)],
                           picks=("tap", "doubletap", "pan"), ticks=ANGLE_TICKS, y_ticks=POLAR_TICKS)
        self.Gamma = Graph(wire, "Gamma", ("t", "Γ"), (0.0, 60.0), (-1.05, 1.05), [Series("first", theme.ORBIT)])
        self.pictures = (self.omega, self.sphere, self.curve, self.Gamma)

    def show(self, result: BallResult, hold_axes: bool) -> Report:
        """Draw the strip, the orbits, the circles and the map."""
        h = float(result.values["h"])
        width = half_width(result.body, h)
        if not hold_axes:
            self.omega.fit(width)
            self.Gamma.set_ranges((0.0, float(result.values["span"])), (-1.05, 1.05))
        for view in (self.omega, self.curve, self.Gamma):
            view.say("")
        xi = line_of_rest(result.body)[0]
        self._show_plane(result, width)
        theta_minus = float(result.values["theta"])
        ends = [Circle((*xi, 0.0), math.cos(theta_minus), "unstable")]
        Gamma = None
        if result.orbit is not None:
            Gamma = result.orbit.states[:, 2:4] @ xi
            ends.append(Circle((*xi, 0.0), float(np.clip(Gamma[-1], -1.0, 1.0)), "stable"))
            self.Gamma.show("first", result.orbit.times, Gamma)
            self.Gamma.show_levels([math.cos(theta_minus), float(Gamma[-1])])
        self.sphere.show((*xi, 0.0), "ξ", ends, [Mark((*xi, 0.0), "muted"), Mark((*-xi, 0.0), "muted")])
        self._show_curve(result)
        for name, text in _captions(result, Gamma).items():
            self.wire.say(name, text)
        notes = [result.reason] if result.reason else []
        return Report(_derived(result), _status(result), notes, result.todo, result.total)

    def _show_plane(self, result: BallResult, width: float) -> None:
        self.omega.show_strip(result.strip.sigma2(_ANGLES), result.strip.sigma1(_ANGLES), width)
        for name, ends in (("stable", result.strip.stable), ("unstable", result.strip.unstable)):
            self.omega.assign(name, x=ends[:, 0].tolist(), y=ends[:, 1].tolist())
        if result.crowd:
            self.omega.show_arcs([track for track, _ in result.crowd], width)
            # Not in the middle of each, where all of them are slow, but where the strip is covered evenly.
            self.omega.assign("arrows", **_arrows(result.crowd))
        if result.orbit is not None:
            states = result.orbit.states
            xi = line_of_rest(result.body)[0]
            self.omega.assign(
                "orbit", t=result.orbit.times.astype(np.float32), Gamma=(states[:, 2:4] @ xi).astype(np.float32),
                **sphere_columns(states[:, :2], states[:, 2:]))

    def _show_curve(self, result: BallResult) -> None:
        if result.map is None or result.free is None:
            if result.reason:
                self.curve.show_nothing(result.reason)
            return
        phis = result.map.phis
        self.curve.show("ball", phis, result.map.theta_plus)
        self.curve.show("free", phis, result.free)
        theta_minus, phi = float(result.values["theta"]), float(result.values["phi"])
        self.curve.show_levels([theta_minus, math.pi - theta_minus])
        self.curve.choose(phi, float(np.interp(phi, phis, result.map.theta_plus)))

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click on the curve chooses the phase."""
        return {"phi": x} if picture == "curve" else {}


def _arrows(crowd: Sequence[tuple[Array, int]]) -> dict[str, list[float]]:
    """Triangles, which point upwards at angle 0, along the tracks."""
    columns: dict[str, list[float]] = {"x": [], "y": [], "angle": []}
    for track, place in crowd:
        if len(track) > 2:
            i = min(max(place, 1), len(track) - 2)
            x, y = track[i]
            step = track[i + 1] - track[i - 1]
            for name, value in (("x", x), ("y", y), ("angle", math.atan2(step[1], step[0]) - 0.5 * math.pi)):
                columns[name].append(float(value))
    return columns


def _captions(result: BallResult, Gamma: Array | None) -> dict[str, str]:
    theta_minus = float(result.values["theta"])
    captions = {
        "omega": "Angular velocity (ω₁, ω₂)\nEvery orbit crosses the strip between σ₂ and σ₁ from Nᵘ to Nˢ."}
    if Gamma is not None:
        left, joined = number(math.cos(theta_minus)), number(float(Gamma[-1]))
        captions["sphere"] = f"Poisson sphere\nFrom Γ = {left} (the circle left) to Γ = {joined} at the end."
        captions["Gamma"] = f"Γ = (ξ, γ) against time\nFrom {left} to {joined}."
    if result.map is not None:
        low, high = float(result.map.theta_plus.min()), float(result.map.theta_plus.max())
        spread = f"θ⁺ = {number(low)} for every φ" if high - low < 1e-4 else f"θ⁺ from {number(low)} to {number(high)}"
        captions["curve"] = f"θ⁺ against the phase φ\nθ⁻ = {number(theta_minus)}: {spread}; dashed: 𝒟 = 0."
    elif result.reason:
        captions["curve"] = "θ⁺ against the phase φ\nLeft out: it would take too many steps."
    return captions


def _derived(result: BallResult) -> list[str]:
    body, strip = result.body, result.strip
    xi = line_of_rest(body)[0]
    outer_ends, inner_ends = (ellipse([0.0, math.pi / 2]) for ellipse in (strip.sigma1, strip.sigma2))
    inner, outer = (float(np.hypot(*end)) for end in strip.unstable)
    return [
        f"σ₁: |ω₁| ≤ {number(float(outer_ends[0, 0]))}, |ω₂| ≤ {number(float(outer_ends[1, 1]))}",
        f"σ₂: |ω₁| ≥ {number(float(inner_ends[0, 0]))} at ω₂ = 0, |ω₂| ≥ {number(float(inner_ends[1, 1]))} at ω₁ = 0",
        f"|ω| on Nˢ and Nᵘ from {number(inner)} to {number(outer)}",
        f"ξ = ({number(xi[0])}, {number(xi[1])}, 0)",
        f"δ = {number(10.0 ** -float(result.values['digits']), 3)}",
    ]


def _status(result: BallResult) -> str:
    parts = []
    if result.orbit is not None:
        parts += orbit_status(result.orbit)
    if result.map is not None:
        parts.append(f"{result.map.phis.size} phases, error ≤ {float(result.map.errors.max()):.1e}")
    parts.append(result.ended)
    return " · ".join(parts).replace("e-", "e−")


SCENE = Scene(
    name="chaplygin-ball",
    title="Chaplygin ball",
    summary="A ball rolls inside the body: every orbit crosses a strip between two ellipses, from Nᵘ to Nˢ.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("omega", "sphere", "curve", "Gamma"),
    compute=compute,
    stage=BallStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=9,
)
